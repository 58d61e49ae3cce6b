// SPDX-License-Identifier: Apache-2.0
/// \file
/// Derivatives of builtins: their rows state rules in the language, over the formals
/// (vm/builtin.h). Spectra are differentiated at each wavelength, complex numbers as pairs of
/// reals.

#include "lang/elaborator.h"
#include "lang/parser.h"

namespace mms::lang {

using vm::Op;
using vm::SlotType;

namespace {

/// The next part of a rule.
std::string_view take_part(std::string_view& rest) {
  const std::size_t end = rest.find(';');
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return part;
}

}  // namespace

/// Evaluates an expression of the language over the formals of `row`.
Value Elaborator::rule_value(const vm::Builtin& row, std::string_view rule, Scope* scope) {
  graphs_.push_back(parse_expression(
      make_source("<derivative of " + std::string(row.signature) + ">", std::string(rule)),
      diagnostics_));
  const Graph& g = graphs_.back();
  return expr({&g, scope}, {static_cast<std::uint32_t>(g.exprs.size() - 1)});
}

/// The partial derivatives of all results by the slots of one formal, one result after another.
std::vector<Ref> Elaborator::partials_of(const Value& rule, TypeId formal, TypeId result) {
  const bool scalar_rule = rule.parts.empty();
  std::vector<Ref> refs;
  if (result == kComplex && scalar_rule) {
    flatten(widen(rule, kComplex), refs);
    if (formal != kComplex) return refs;
    return {refs[0], node(Op::NegR, {refs[1]}), refs[1], refs[0]};  // Cauchy and Riemann
  }
  flatten(rule, refs);
  for (Ref& r : refs)
    if (slot_type(r) == SlotType::Integer) r = node(Op::RealOfInt, {r});
  return refs;
}

/// `dr += partial dx`, without what is known to be zero or one.
void Elaborator::add_partial(Tangents& t, Ref r, Ref partial, Ref dx) {
  const vm::Constant* c = known(partial);
  if (c && c->f64 == 0) return;
  const Ref term = c && c->f64 == 1 ? dx : derived_op(Op::MulR, Op::MulS, {partial, dx});
  t[r] = sum(tangent(t, r), term);
}

/// A rule `= expression`: the derivative is that of the expression, which has the row's value.
void Elaborator::derive_twin(const Value& twin, std::uint32_t first,
                             const std::vector<Ref>& results, int direction, Tangents& t) {
  const auto last = static_cast<std::uint32_t>(module.functions[function_].nodes.size());
  for (std::uint32_t i = first; i < last; ++i) derive_node(i, direction, t);
  std::vector<Ref> refs;
  flatten(twin, refs);
  for (std::size_t k = 0; k < refs.size() && k < results.size(); ++k)
    if (const auto d = tangent(t, refs[k])) t[results[k]] = *d;
}

/// Differentiates the results of a call by its row's rule.
void Elaborator::derive_builtin(const Node& n, Ref r, int direction, Tangents& t) {
  const vm::Builtin* row = module.builtins[n.a];
  bool active = false;
  for (Ref a : n.args) active = active || t.count(a);
  if (!active) return;
  if (row->derivative.empty()) {
    diagnostics_.add(Diag::NoDerivative, deriving_.span, row->signature).help(deriving_.help);
    return;
  }
  std::vector<Ref> results;
  for (std::size_t k = 0; k < n.results.size(); ++k)
    results.push_back({r.node, static_cast<std::uint16_t>(k), r.function});
  graphs_.push_back(
      parse_signature(make_source("<library>", std::string(row->signature)), diagnostics_));
  const Context c{&graphs_.back(), library_scope_};
  const Function& f = c.graph->functions[0];
  const TypeId result = resolve_type(c, f.result, nullptr);
  Scope* scope = new_scope(library_scope_, true);
  std::size_t next = 0;
  std::vector<Value> formals;
  for (const Formal& formal : f.formals) {
    Binding b;
    const TypeId type = n.op == Op::CallSpectral && (n.b >> formals.size() & 1)
                            ? kSpectrum
                            : resolve_type(c, formal.type, nullptr);
    b.value = unflatten(type, n.args, next);
    formals.push_back(b.value);
    declare(scope, formal.name, std::move(b));
  }
  const auto first = static_cast<std::uint32_t>(module.functions[function_].nodes.size());
  std::string_view rest = row->derivative;
  if (rest.starts_with('='))
    return derive_twin(rule_value(*row, rest.substr(1), scope), first, results, direction, t);
  for (const Value& formal : formals) {
    const std::string_view rule = take_part(rest);
    std::vector<Ref> slots;
    flatten(formal, slots);
    bool moving = false;
    for (Ref s : slots) moving = moving || t.count(s);
    if (!moving) continue;
    const std::vector<Ref> partials =
        partials_of(rule_value(*row, rule, scope), formal.type, result);
    for (std::size_t k = 0; k < partials.size() && k < results.size() * slots.size(); ++k)
      if (const auto dx = tangent(t, slots[k % slots.size()]))
        add_partial(t, results[k / slots.size()], partials[k], *dx);
  }
}

}  // namespace mms::lang
