// SPDX-License-Identifier: Apache-2.0
/// \file
/// Nodes and conversions of the elaborator.

#include "lang/elaborator.h"
#include "lang/fold.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

}  // namespace

Ref Elaborator::node(Op op, Refs args, std::uint32_t a, std::uint32_t b, SlotTypes results) {
  for (Ref& r : args) r = localise(r);
  IrFunction& f = module.functions[function_];
  if (f.nodes.size() >= static_cast<std::size_t>(vm::limits::kNodes) && !full_) {
    full_ = true;
    diagnostics_.add(Diag::TooManyNodes, Span{}, vm::limits::kNodes)
        .help(
            "a recursion whose end is known at link time is unrolled: make it shorter, or let its "
            "end depend on the hit");
  }
  std::optional<vm::Constant> folded;
  std::vector<vm::Constant> values;
  for (Ref r : args) {
    const vm::Constant* k = known(r);
    if (!k) break;
    values.push_back(*k);
  }
  if (values.size() == args.size() && !args.empty()) {
    if (op == Op::CallBuiltin) {
      if (results.size() == 1 && !module.builtins[a]->image32)
        folded = fold_builtin(*module.builtins[a], results[0], values);
    } else if (op != Op::Call && op != Op::If && op != Op::CallSpectral) {
      folded = fold(op, values);
    }
  }
  const Ref r = add_node(f, function_, {op, a, b, std::move(args), std::move(results), line_, -1});
  if (folded) f.nodes[r.node].known = static_cast<std::int32_t>(module.constant(*folded));
  return r;
}

Ref Elaborator::constant(vm::Constant c) {
  const std::uint32_t k = module.constant(c);
  const Ref r = add_node(module.functions[function_], function_,
                         {Op::PushConst, k, 0, {}, {c.type}, line_, -1});
  module.functions[function_].nodes[r.node].known = static_cast<std::int32_t>(k);
  return r;
}

Ref Elaborator::real(double v) { return constant({SlotType::Real, static_cast<float>(v), v, 0}); }
Ref Elaborator::integer(std::int64_t v) {
  return constant({SlotType::Integer, 0, 0, static_cast<std::int32_t>(v)});
}
Ref Elaborator::logic(bool v) { return constant({SlotType::Logic, 0, 0, v ? 1 : 0}); }

Ref Elaborator::zero(SlotType t) {
  switch (t) {
    case SlotType::Integer:
      return integer(0);
    case SlotType::Logic:
      return logic(false);
    case SlotType::Spectrum:
      return node(Op::Splat, {real(0)});
    default:
      return real(0);
  }
}

Ref Elaborator::input(int index) {
  return node(Op::PushInput, {}, static_cast<std::uint32_t>(index), 0, {vm::input_type(index)});
}

/// A value of another function, seen from the current one: constants and inputs are had again,
/// anything else becomes a parameter that every call hands over.
Ref Elaborator::localise(Ref r) {
  if (r.function == function_) return r;
  const Node from = module.functions[r.function].nodes[r.node];
  if (from.known >= 0 && from.results.size() == 1) return constant(module.constants[from.known]);
  if (from.op == Op::PushInput) return input(static_cast<int>(from.a));
  auto it = instance_of_.find(function_);
  if (it == instance_of_.end()) {  // only after an error: nothing captures into a descriptor
    return zero(module.functions[r.function].type(r));
  }
  Instance& inst = *it->second;
  for (std::size_t k = 0; k < inst.captures.size(); ++k)
    if (inst.captures[k] == r)
      return node(Op::LoadLocal, {}, static_cast<std::uint32_t>(inst.own_params + k), 0,
                  {from.results[r.result]});
  inst.captures.push_back(r);
  IrFunction& f = module.functions[function_];
  f.params.push_back(from.results[r.result]);
  const std::uint32_t index = static_cast<std::uint32_t>(f.params.size() - 1);
  // Every call made so far must hand the new one over too.
  const FunctionId here = function_;
  for (std::size_t k = 0; k < inst.sites.size(); ++k) {
    const CallSite site = inst.sites[k];
    function_ = site.function;
    const Ref arg = localise(r);
    module.functions[site.function].nodes[site.node].args.push_back(arg);
    function_ = here;
  }
  return node(Op::LoadLocal, {}, index, 0, {from.results[r.result]});
}

const vm::Constant* Elaborator::known(Ref r) const {
  const Node& n = module.functions[r.function].nodes[r.node];
  return n.known >= 0 && r.result == 0 ? &module.constants[n.known] : nullptr;
}

std::optional<std::int64_t> Elaborator::known_integer(const Value& v) const {
  if (v.refs.size() != 1 || slot_type(v.refs[0]) != SlotType::Integer) return std::nullopt;
  const vm::Constant* k = known(v.refs[0]);
  return k ? std::optional<std::int64_t>(k->integer) : std::nullopt;
}

std::optional<bool> Elaborator::known_logic(const Value& v) const {
  if (v.refs.size() != 1) return std::nullopt;
  const vm::Constant* k = known(v.refs[0]);
  return k ? std::optional<bool>(k->integer != 0) : std::nullopt;
}

void Elaborator::flatten(const Value& v, std::vector<Ref>& refs) const {
  refs.insert(refs.end(), v.refs.begin(), v.refs.end());
  for (const Value& p : v.parts) flatten(p, refs);
}

Value Elaborator::unflatten(TypeId type, const std::vector<Ref>& refs, std::size_t& next) {
  Value v;
  v.type = type;
  const Type t = types_[type];
  if (t.form == Type::Form::Array) {
    for (int i = 0; i < t.size; ++i) v.parts.push_back(unflatten(t.parts[0], refs, next));
  } else if (t.form == Type::Form::Struct) {
    for (TypeId p : t.parts) v.parts.push_back(unflatten(p, refs, next));
  } else {
    v.refs.push_back(refs[next++]);
    if (type == kComplex) v.refs.push_back(refs[next++]);
  }
  return v;
}

void Elaborator::slot_types(TypeId type, std::vector<SlotType>& out) const {
  const Type& t = types_[type];
  switch (t.form) {
    case Type::Form::Array:
      for (int i = 0; i < t.size; ++i) slot_types(t.parts[0], out);
      break;
    case Type::Form::Struct:
      for (TypeId p : t.parts) slot_types(p, out);
      break;
    case Type::Form::Complex:
      out.insert(out.end(), 2, SlotType::Real);
      break;
    case Type::Form::Spectrum:
      out.push_back(SlotType::Spectrum);
      break;
    case Type::Form::Integer:
    case Type::Form::Enum:
      out.push_back(SlotType::Integer);
      break;
    case Type::Form::Logic:
      out.push_back(SlotType::Logic);
      break;
    default:
      out.push_back(SlotType::Real);
      break;
  }
}

/// \pre types_.widening(v.type, to) >= 0
Value Elaborator::widen(const Value& v, TypeId to) {
  if (v.type == to || v.poison() || to == kPoison) return v;
  if (types_.is_array(to)) {
    Value r;
    r.type = to;
    for (const Value& p : v.parts) r.parts.push_back(widen(p, types_[to].parts[0]));
    return r;
  }
  if (types_.is_function(to)) {
    Value r = v;
    r.type = to;
    return r;
  }
  Ref r = v.refs[0];
  if (v.type == kInteger) r = node(Op::RealOfInt, {r});
  if (to == kSpectrum) return scalar(kSpectrum, node(Op::Splat, {r}));
  if (to == kComplex) return {kComplex, {r, real(0)}, {}, {}, {}, {}};
  return scalar(to, r);
}

Value Elaborator::convert(const Value& v, TypeId to, Span span, Span why) {
  if (types_.widening(v.type, to) >= 0) return widen(v, to);
  Diagnostic& d = diagnostics_.add(Diag::TypeMismatch, span, types_.spell(to), spell(v));
  d.labelled(fmt::format("this is `{}`", spell(v)));
  if (why) d.note(why, "the type is stated here");
  if (TypeTable::is_number(v.type) && (to == kInteger || to == kReal))
    d.help(fmt::format("write `{}(...)` to convert it", types_.spell(to)));
  if (to == kSpectrum && types_.is_array(v.type) && v.parts.size() == 3)
    d.help("for a colour of red, green and blue write `rgb(r, g, b)`");
  if (v.type == kReal && to == kMaterial)
    d.help("a material is made by a function, for example `matte(0.5)`");
  if (v.type == kSpectrum && to == kMaterial)
    d.help("a colour alone is no material: write `matte(...)` around it");
  return {};
}

Value Elaborator::choose_refs(Ref condition, const Value& a, const Value& b) {
  std::vector<Ref> args{condition};
  flatten(a, args);
  flatten(b, args);
  std::vector<SlotType> results;
  slot_types(a.type, results);
  const std::size_t count = results.size();
  const Ref r = node(Op::If, std::move(args), 0, 0, std::move(results));
  std::vector<Ref> refs;
  for (std::size_t k = 0; k < count; ++k)
    refs.push_back({r.node, static_cast<std::uint16_t>(k), r.function});
  std::size_t next = 0;
  return unflatten(a.type, refs, next);
}

/// `a` where `condition` holds, else `b`; both have the same type.
Value Elaborator::choose(Ref condition, const Value& a, const Value& b, Span span) {
  if (a.poison() || b.poison()) return {};
  if (types_.is_numeric(a.type)) return choose_refs(condition, a, b);
  if (a.type == kMaterial) {
    Value v;
    v.type = kMaterial;
    v.material = choose_material(condition, a.material, b.material);
    return v;
  }
  if (!a.parts.empty() && a.parts.size() == b.parts.size()) {
    Value v;
    v.type = a.type;
    for (std::size_t i = 0; i < a.parts.size(); ++i)
      v.parts.push_back(choose(condition, a.parts[i], b.parts[i], span));
    return v;
  }
  if (unknown_arguments_) return {};
  diagnostics_.add(Diag::DynamicChoice, span, types_.spell(a.type))
      .help("choose between results instead: call both functions inside `select`");
  return {};
}

namespace {

void collect(const MaterialTree& m, std::vector<Ref>& refs) {
  refs.insert(refs.end(), m.params.begin(), m.params.end());
  for (const auto& c : m.children) collect(*c, refs);
}

bool same_shape(const MaterialTree& a, const MaterialTree& b) {
  if (a.row != b.row || a.children.size() != b.children.size()) return false;
  for (std::size_t i = 0; i < a.children.size(); ++i)
    if (!same_shape(*a.children[i], *b.children[i])) return false;
  return true;
}

MaterialPtr with_params(const MaterialTree& m, const std::vector<Ref>& refs, std::size_t& next) {
  auto r = std::make_shared<MaterialTree>();
  r->row = m.row;
  r->types = m.types;
  for (std::size_t i = 0; i < m.params.size(); ++i) r->params.push_back(refs[next++]);
  for (const auto& c : m.children) r->children.push_back(with_params(*c, refs, next));
  return r;
}

}  // namespace

/// A choice between materials becomes a mix of weight 0 or 1; the numbers of the arm that is not
/// taken are not computed. Two materials of one shape become one whose numbers are chosen.
MaterialPtr Elaborator::choose_material(Ref condition, const MaterialPtr& a, const MaterialPtr& b) {
  std::vector<Ref> ra, rb;
  collect(*a, ra);
  collect(*b, rb);
  const bool merge = same_shape(*a, *b);
  std::vector<Ref> args{condition}, first, second;
  std::vector<SlotType> results;
  auto value = [&](Ref x, Ref y) {
    first.push_back(x);
    second.push_back(y);
    results.push_back(slot_type(x));
  };
  auto constant_like = [&](Ref r) {
    return known(r) || (module.functions[r.function].nodes[r.node].op == Op::Splat &&
                        known(module.functions[r.function].nodes[r.node].args[0]));
  };
  std::vector<int> from_a(ra.size(), -1), from_b(rb.size(), -1);
  if (merge) {
    for (std::size_t i = 0; i < ra.size(); ++i) {
      if (ra[i] == rb[i]) continue;
      from_a[i] = static_cast<int>(results.size());
      value(ra[i], rb[i]);
    }
  } else {
    for (std::size_t i = 0; i < ra.size(); ++i)
      if (!constant_like(ra[i])) {
        from_a[i] = static_cast<int>(results.size());
        value(ra[i], zero(slot_type(ra[i])));
      }
    for (std::size_t i = 0; i < rb.size(); ++i)
      if (!constant_like(rb[i])) {
        from_b[i] = static_cast<int>(results.size());
        value(zero(slot_type(rb[i])), rb[i]);
      }
    value(real(0), real(1));
  }
  if (results.empty()) return a;
  args.insert(args.end(), first.begin(), first.end());
  args.insert(args.end(), second.begin(), second.end());
  const std::size_t weight = results.size() - 1;
  const Ref r = node(Op::If, std::move(args), 0, 0, std::move(results));
  auto result = [&](std::size_t k) {
    return Ref{r.node, static_cast<std::uint16_t>(k), r.function};
  };
  for (std::size_t i = 0; i < ra.size(); ++i)
    if (from_a[i] >= 0) ra[i] = result(static_cast<std::size_t>(from_a[i]));
  for (std::size_t i = 0; i < rb.size(); ++i)
    if (from_b[i] >= 0) rb[i] = result(static_cast<std::size_t>(from_b[i]));
  std::size_t next = 0;
  const MaterialPtr arm_a = with_params(*a, ra, next);
  if (merge) return arm_a;
  next = 0;
  const MaterialPtr arm_b = with_params(*b, rb, next);
  Value va, vb;
  va.type = vb.type = kMaterial;
  va.material = arm_a;
  vb.material = arm_b;
  return call_library("mix", {va, vb, scalar(kReal, result(weight))}, {}).material;
}

}  // namespace mms::lang
