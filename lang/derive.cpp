// SPDX-License-Identifier: Apache-2.0
/// \file
/// Exact derivatives: forward differentiation of the linker's graph. The opcode rules are here,
/// those of builtins are expressions in the rows, those of variables are names in their table.
///
/// A choice is differentiated arm by arm: at a jump the derivative is the one of the arm taken, a
/// step has derivative zero. `floor`-like rows state the derivative 0.

#include "lang/elaborator.h"
#include "lang/parser.h"

namespace mms::lang {

using vm::Op;
using vm::SlotType;

namespace {

/// The nodes whose derivative the derivative of `roots` asks for: conditions and integers are not
/// among them, so what only they need may lack a rule.
std::vector<bool> needed(const IrFunction& f, const std::vector<Ref>& roots) {
  std::vector<bool> seen(f.nodes.size(), false);
  std::vector<std::uint32_t> pending;
  auto visit = [&](Ref r) {
    if (f.type(r) != SlotType::Real || f.nodes[r.node].steady || seen[r.node]) return;
    seen[r.node] = true;
    pending.push_back(r.node);
  };
  for (Ref r : roots) visit(r);
  while (!pending.empty()) {
    const std::uint32_t n = pending.back();
    pending.pop_back();
    for (Ref a : f.nodes[n].args) visit(a);
  }
  return seen;
}

}  // namespace

std::optional<Ref> Elaborator::tangent(const Tangents& t, Ref r) const {
  auto it = t.find(r);
  return it == t.end() ? std::nullopt : std::optional<Ref>(it->second);
}

Ref Elaborator::sum(std::optional<Ref> a, std::optional<Ref> b) {
  return a && b ? node(Op::AddR, {*a, *b}) : a ? *a : *b;
}

/// Differentiates results of a builtin by its row's rule: one expression for each formal.
void Elaborator::derive_builtin(const Node& n, Ref r, Tangents& t) {
  const vm::Builtin* row = module.builtins[n.a];
  bool active = false;
  for (Ref a : n.args) active = active || t.count(a);
  if (!active) return;
  if (row->derivative.empty() || n.results.size() != 1) {
    diagnostics_.add(Diag::NoDerivative, deriving_.span, row->signature).help(deriving_.help);
    return;
  }
  graphs_.push_back(
      parse_signature(make_source("<library>", std::string(row->signature)), diagnostics_));
  const Graph& signature = graphs_.back();
  Scope* scope = new_scope(library_scope_, true);
  std::size_t next = 0;
  std::vector<std::pair<std::size_t, Value>> formals;  // first argument, value
  for (const Formal& f : signature.functions[0].formals) {
    const std::size_t first = next;
    Binding b;
    b.value = unflatten(resolve_type({&signature, library_scope_}, f.type, nullptr), n.args, next);
    formals.emplace_back(first, b.value);
    declare(scope, f.name, std::move(b));
  }
  std::string_view rest = row->derivative;
  std::optional<Ref> total;
  for (const auto& [first, formal] : formals) {
    const std::size_t end = rest.find(';');
    const std::string_view rule = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    std::vector<Ref> flat;
    flatten(formal, flat);
    bool moves = false;
    for (Ref a : flat) moves = moves || t.count(a);
    if (!moves) continue;
    graphs_.push_back(parse_expression(
        make_source("<derivative of " + std::string(row->signature) + ">", std::string(rule)),
        diagnostics_));
    const Graph& g = graphs_.back();
    const Value partial = expr({&g, scope}, {static_cast<std::uint32_t>(g.exprs.size() - 1)});
    std::vector<Ref> partials;
    flatten(widen(partial, formal.type), partials);
    for (std::size_t k = 0; k < flat.size() && k < partials.size(); ++k) {
      const auto d = tangent(t, flat[k]);
      const vm::Constant* zero = known(partials[k]);
      if (!d || (zero && zero->f64 == 0)) continue;
      total = sum(total, node(Op::MulR, {partials[k], *d}));
    }
  }
  if (total) t[r] = *total;
}

/// Whether all of the function is there to be differentiated; says so where it is not.
bool Elaborator::is_complete(std::uint16_t function) {
  auto instance = instance_of_.find(function);
  if (instance == instance_of_.end() || instance->second->complete) return true;
  diagnostics_.add(Diag::NoDerivative, deriving_.span, module.functions[function].name)
      .help("a function cannot differentiate itself while it is being defined");
  return false;
}

/// The function of the derivatives: parameters of `function`, then the derivative of each real one;
/// results: the derivative of each result (zero for what is no real).
std::uint16_t Elaborator::derive_function(std::uint16_t function, int direction) {
  auto it = derived_.find({function, direction});
  if (it != derived_.end()) return it->second;
  const std::uint16_t derived = new_function(module.functions[function].name + "'");
  derived_[{function, direction}] = derived;
  const IrFunction& from = module.functions[function];
  IrFunction& to = module.functions[derived];
  to.recursive = true;
  to.params = from.params;
  to.nodes = from.nodes;
  for (Node& n : to.nodes)
    for (Ref& a : n.args) a.function = derived;
  const std::uint16_t here = function_;
  function_ = derived;
  Tangents t;
  std::map<std::uint32_t, std::uint32_t> tangent_param;
  for (std::uint32_t p = 0; p < from.params.size(); ++p) {
    if (from.params[p] != SlotType::Real) continue;
    tangent_param[p] = static_cast<std::uint32_t>(to.params.size());
    to.params.push_back(SlotType::Real);
  }
  const std::uint32_t count = static_cast<std::uint32_t>(to.nodes.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const Node& n = to.nodes[i];
    if (n.op != Op::LoadLocal || !tangent_param.count(n.a)) continue;
    const std::uint32_t p = tangent_param[n.a];
    t[{i, 0, derived}] = node(Op::LoadLocal, {}, p, 0, {SlotType::Real});
  }
  const std::vector<bool> wanted = needed(to, from.results);
  for (std::uint32_t i = 0; i < count; ++i)
    if (wanted[i]) derive_node(i, direction, t);
  std::vector<Ref> results;
  for (Ref r : from.results) {
    r.function = derived;
    const auto d = tangent(t, r);
    results.push_back(d ? *d : real(0));
  }
  to.results = std::move(results);
  function_ = here;
  return derived;
}

/// Differentiates node `index` of the current function.
void Elaborator::derive_node(std::uint32_t index, int direction, Tangents& t) {
  const Node n = module.functions[function_].nodes[index];
  const Ref r{index, 0, function_};
  auto d = [&](std::size_t k) { return tangent(t, n.args[k]); };
  auto times = [&](std::size_t k, std::optional<Ref> x) {
    return x ? std::optional<Ref>(node(Op::MulR, {n.args[k], *x})) : std::nullopt;
  };
  auto set = [&](std::optional<Ref> x) {
    if (x) t[r] = *x;
  };
  auto negative = [&](std::optional<Ref> x) {
    return x ? std::optional<Ref>(node(Op::NegR, {*x})) : std::nullopt;
  };
  auto add = [&](std::optional<Ref> x, std::optional<Ref> y) {
    return x || y ? std::optional<Ref>(sum(x, y)) : std::nullopt;
  };
  if (n.known >= 0) return;
  switch (n.op) {
    case Op::PushInput: {
      if (direction == kAlongNothing) return;
      const vm::Variable v = vm::input_variable(static_cast<int>(n.a));
      const std::string_view along =
          direction == kAlongTangent ? vm::info(v).along_tangent : vm::info(v).along_bitangent;
      for (const vm::VariableInfo& row : vm::kVariables)
        if (!along.empty() && row.name == along)
          t[r] = input(vm::input_index(row.variable) + static_cast<int>(n.a) - vm::input_index(v));
      return;
    }
    case Op::AddR:
      return set(add(d(0), d(1)));
    case Op::SubR:
      return set(add(d(0), negative(d(1))));
    case Op::NegR:
      return set(negative(d(0)));
    case Op::MulR:
      return set(add(times(0, d(1)), times(1, d(0))));
    case Op::FmaR:
      return set(add(add(times(0, d(1)), times(1, d(0))), d(2)));
    case Op::DivR: {  // (da - (a / b) db) / b
      const auto top = add(d(0), d(1) ? negative(node(Op::MulR, {r, *d(1)})) : std::nullopt);
      return set(top ? std::optional<Ref>(node(Op::DivR, {*top, n.args[1]})) : std::nullopt);
    }
    case Op::ModR: {  // a - b floor(a / b)
      if (!d(1)) return set(d(0));
      const Value quotient = scalar(TypeTable::kReal, node(Op::DivR, {n.args[0], n.args[1]}));
      const Ref whole = call_library("floor", {quotient}, deriving_.span).refs[0];
      return set(add(d(0), negative(node(Op::MulR, {whole, *d(1)}))));
    }
    case Op::SelectR: {
      if (!d(1) && !d(2)) return;
      return set(node(Op::SelectR, {n.args[0], d(1) ? *d(1) : real(0), d(2) ? *d(2) : real(0)}));
    }
    case Op::If: {
      const std::size_t count = n.results.size();
      std::vector<std::size_t> moving;
      for (std::size_t k = 0; k < count; ++k)
        if (n.results[k] == SlotType::Real && (d(1 + k) || d(1 + count + k))) moving.push_back(k);
      if (moving.empty()) return;
      std::vector<Ref> args{n.args[0]};
      for (int arm = 0; arm < 2; ++arm)
        for (std::size_t k : moving) {
          const auto x = d(1 + static_cast<std::size_t>(arm) * count + k);
          args.push_back(x ? *x : real(0));
        }
      const Ref choice =
          node(Op::If, std::move(args), 0, 0, std::vector<SlotType>(moving.size(), SlotType::Real));
      for (std::size_t k = 0; k < moving.size(); ++k)
        t[{index, static_cast<std::uint16_t>(moving[k]), function_}] = {
            choice.node, static_cast<std::uint16_t>(k), function_};
      return;
    }
    case Op::CallBuiltin:
      return derive_builtin(n, r, t);
    case Op::Call: {
      bool active = false;
      for (Ref a : n.args) active = active || t.count(a);
      if (!active || !is_complete(static_cast<std::uint16_t>(n.a))) return;
      const std::uint16_t derived = derive_function(static_cast<std::uint16_t>(n.a), direction);
      std::vector<Ref> args = n.args;
      for (std::size_t k = 0; k < n.args.size(); ++k)
        if (module.functions[n.a].params[k] == SlotType::Real)
          args.push_back(d(k) ? *d(k) : real(0));
      const Ref call = node(Op::Call, std::move(args), derived, 0,
                            std::vector<SlotType>(n.results.size(), SlotType::Real));
      for (std::size_t k = 0; k < n.results.size(); ++k)
        if (n.results[k] == SlotType::Real)
          t[{index, static_cast<std::uint16_t>(k), function_}] = {
              call.node, static_cast<std::uint16_t>(k), function_};
      return;
    }
    case Op::LoadLocal: {
      if (direction == kAlongNothing || t.count(r) || unknown_arguments_) return;
      const auto meant = stands_for_.find(r);
      if (meant != stands_for_.end()) return set(derive(t, meant->second, 0, direction));
      diagnostics_.add(Diag::NoDerivative, deriving_.span, "what a recursion hands on")
          .help(deriving_.help);
      return;
    }
    default:
      return;  // integers, logic and spectra do not move a height
  }
}

/// The derivative of `root`, where those of `t` are given and nothing before node `first` moves.
std::optional<Ref> Elaborator::derive(Tangents& t, Ref root, std::uint32_t first, int direction) {
  const std::vector<bool> wanted = needed(module.functions[function_], {root});
  for (std::uint32_t i = first; i < wanted.size(); ++i)
    if (wanted[i]) derive_node(i, direction, t);
  return tangent(t, root);
}

/// The derivative of `height` along `$tangent` and `$bitangent`: a `real[2]`.
Value Elaborator::derive_gradient(const Value& height, Span span) {
  deriving_ = {span, "state the `gradient` output beside `height`"};
  std::vector<Value> parts;
  for (int direction : {kAlongTangent, kAlongBitangent}) {
    Tangents t;
    const auto d = derive(t, height.refs[0], 0, direction);
    parts.push_back(scalar(TypeTable::kReal, d ? *d : real(0)));
  }
  Value v;
  v.type = types_.array(TypeTable::kReal, 2);
  v.parts = std::move(parts);
  return v;
}

/// How much each real of `value` changes across the pixel: the length of its change for a step of
/// one column of `$footprint` and for one of the other. A box as wide has the variance of the
/// pixel's projection.
Value Elaborator::across_footprint(const Value& value) {
  const Deriving outer = deriving_;
  deriving_ = {user_span_,
               "where a recursion begins, find the width and hand it on as an argument"};
  std::vector<Ref> all;
  flatten(value, all);
  for (Ref& r : all) {
    std::optional<Ref> along[2], across[2];
    for (int direction : {kAlongTangent, kAlongBitangent}) {
      Tangents t;
      along[direction] = derive(t, localise(r), 0, direction);
    }
    const int footprint = vm::input_index(vm::Variable::Footprint);
    for (int column = 0; column < 2; ++column)
      for (int row = 0; row < 2; ++row)
        if (along[row])
          across[column] = sum(across[column],
                               node(Op::MulR, {*along[row], input(footprint + 2 * row + column)}));
    r = across[0] ? call_library("hypot",
                                 {scalar(TypeTable::kReal, *across[0]),
                                  scalar(TypeTable::kReal, *across[1])},
                                 user_span_)
                        .refs[0]
                  : real(0);
    module.functions[function_].nodes[r.node].steady = true;
  }
  deriving_ = outer;
  std::size_t next = 0;
  return unflatten(value.type, all, next);
}

}  // namespace mms::lang
