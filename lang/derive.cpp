// SPDX-License-Identifier: Apache-2.0
/// \file
/// Exact derivatives: forward differentiation of the linker's graph. The opcode rules are here, and
/// stated in their table; those of builtins are expressions in the rows (derive_rules.cpp), those
/// of variables are names in their table.
///
/// A choice is differentiated arm by arm: at a jump the derivative is the one of the arm taken, a
/// step has derivative zero. `floor`-like rows state the derivative 0.

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {

using vm::Op;
using vm::SlotType;

namespace {

/// Whether values of the type have derivatives: integers and logic values do not move.
bool moves(SlotType t) { return t == SlotType::Real || t == SlotType::Spectrum; }

/// The type of a value's derivative: real for what does not move.
SlotType derivative_type(SlotType t) { return t == SlotType::Spectrum ? t : SlotType::Real; }

/// The nodes whose derivative the derivative of `roots` asks for: conditions and integers are not
/// among them, so what only they need may lack a rule.
std::vector<bool> needed(const IrFunction& f, const std::vector<Ref>& roots) {
  return reached(f, roots, [&](Ref r) { return moves(f.type(r)) && !f.nodes[r.node].steady; });
}

}  // namespace

std::optional<Ref> Elaborator::tangent(const Tangents& t, Ref r) const {
  auto it = t.find(r);
  return it == t.end() ? std::nullopt : std::optional<Ref>(it->second);
}

/// `op` over reals, or its counterpart over spectra where one of the arguments is one.
Ref Elaborator::derived_op(Op op, Op spectral, std::vector<Ref> args) {
  bool any = false;
  for (Ref a : args) any = any || slot_type(a) == SlotType::Spectrum;
  if (!any) return node(op, std::move(args));
  for (Ref& a : args)
    if (slot_type(a) == SlotType::Real) a = node(Op::Splat, {a});
  return node(spectral, std::move(args));
}

Ref Elaborator::sum(std::optional<Ref> a, std::optional<Ref> b) {
  return a && b ? derived_op(Op::AddR, Op::AddS, {*a, *b}) : a ? *a : *b;
}

int Elaborator::derivative_order(FunctionId function) const {
  const auto it = derivative_orders_.find(function);
  return it == derivative_orders_.end() ? 0 : it->second;
}

/// Whether the function can be differentiated; says why where it cannot.
bool Elaborator::can_derive(FunctionId function) {
  if (derivative_order(function) >= vm::limits::kDerivativeOrder) {
    diagnostics_.add(Diag::NoDerivative, deriving_.span, module.functions[function].name)
        .help(fmt::format("a recursive function is differentiated {} times at most",
                          vm::limits::kDerivativeOrder));
    return false;
  }
  auto instance = instance_of_.find(function);
  if (instance == instance_of_.end() || instance->second->complete) return true;
  diagnostics_.add(Diag::NoDerivative, deriving_.span, module.functions[function].name)
      .help("a function cannot differentiate itself while it is being defined");
  return false;
}

/// The function of the derivatives: parameters of `function`, then the derivative of each that
/// moves; results: the derivative of each result (zero for what does not move).
FunctionId Elaborator::derive_function(FunctionId function, int direction) {
  auto it = derived_.find({function, direction});
  if (it != derived_.end()) return it->second;
  const FunctionId derived = new_function(module.functions[function].name + "'");
  derived_[{function, direction}] = derived;
  derivative_orders_[derived] = derivative_order(function) + 1;
  const IrFunction& from = module.functions[function];
  IrFunction& to = module.functions[derived];
  to.recursive = true;
  to.params = from.params;
  to.nodes = from.nodes;
  for (Node& n : to.nodes)
    for (Ref& a : n.args) a.function = derived;
  const FunctionId here = function_;
  function_ = derived;
  Tangents t;
  std::map<std::uint32_t, std::uint32_t> tangent_param;
  for (std::uint32_t p = 0; p < from.params.size(); ++p) {
    if (!moves(from.params[p])) continue;
    tangent_param[p] = static_cast<std::uint32_t>(to.params.size());
    to.params.push_back(from.params[p]);
  }
  const std::uint32_t count = static_cast<std::uint32_t>(to.nodes.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const Node& n = to.nodes[i];
    if (n.op != Op::LoadLocal || !tangent_param.count(n.a)) continue;
    const std::uint32_t p = tangent_param[n.a];
    t[{i, 0, derived}] = node(Op::LoadLocal, {}, p, 0, {to.params[p]});
  }
  const std::vector<bool> wanted = needed(to, from.results);
  for (std::uint32_t i = 0; i < count; ++i)
    if (wanted[i]) derive_node(i, direction, t);
  std::vector<Ref> results;
  for (Ref r : from.results) {
    r.function = derived;
    const auto d = tangent(t, r);
    results.push_back(d ? *d : zero(derivative_type(to.type(r))));
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
  auto product = [&](Ref a, Ref b) { return derived_op(Op::MulR, Op::MulS, {a, b}); };
  auto times = [&](std::size_t k, std::optional<Ref> x) {
    return x ? std::optional<Ref>(product(n.args[k], *x)) : std::nullopt;
  };
  auto set = [&](std::optional<Ref> x) {
    if (x) t[r] = *x;
  };
  auto negative = [&](std::optional<Ref> x) {
    return x ? std::optional<Ref>(derived_op(Op::NegR, Op::NegS, {*x})) : std::nullopt;
  };
  auto add = [&](std::optional<Ref> x, std::optional<Ref> y) {
    return x || y ? std::optional<Ref>(sum(x, y)) : std::nullopt;
  };
  auto or_zero = [&](std::size_t k) {
    const auto x = d(k);
    return x ? *x : zero(slot_type(n.args[k]));
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
    case Op::AddS:
      return set(add(d(0), d(1)));
    case Op::SubR:
    case Op::SubS:
      return set(add(d(0), negative(d(1))));
    case Op::NegR:
    case Op::NegS:
      return set(negative(d(0)));
    case Op::MulR:
    case Op::MulS:
      return set(add(times(0, d(1)), times(1, d(0))));
    case Op::FmaR:
    case Op::FmaS:
      return set(add(add(times(0, d(1)), times(1, d(0))), d(2)));
    case Op::DivR:
    case Op::DivS: {  // (da - (a / b) db) / b
      const auto top = add(d(0), d(1) ? negative(product(r, *d(1))) : std::nullopt);
      return set(top ? std::optional<Ref>(derived_op(Op::DivR, Op::DivS, {*top, n.args[1]}))
                     : std::nullopt);
    }
    case Op::ModR: {  // a - b floor(a / b)
      if (!d(1)) return set(d(0));
      const Value quotient = scalar(kReal, node(Op::DivR, {n.args[0], n.args[1]}));
      const Ref whole = call_library("floor", {quotient}, deriving_.span).refs[0];
      return set(add(d(0), negative(product(whole, *d(1)))));
    }
    case Op::SelectR:
    case Op::SelectS:
      return d(1) || d(2) ? set(node(n.op, {n.args[0], or_zero(1), or_zero(2)})) : void();
    case Op::Splat:
    case Op::Component:
      return d(0) ? set(node(n.op, {*d(0)}, n.a)) : void();
    case Op::Pack: {
      std::vector<Ref> parts;
      bool active = false;
      for (std::size_t k = 0; k < n.args.size(); ++k) {
        active = active || d(k);
        parts.push_back(or_zero(k));
      }
      return active ? set(node(n.op, std::move(parts))) : void();
    }
    case Op::If: {
      const std::size_t count = n.results.size();
      std::vector<std::size_t> moving;
      for (std::size_t k = 0; k < count; ++k)
        if (moves(n.results[k]) && (d(1 + k) || d(1 + count + k))) moving.push_back(k);
      if (moving.empty()) return;
      std::vector<Ref> args{n.args[0]};
      for (int arm = 0; arm < 2; ++arm)
        for (std::size_t k : moving)
          args.push_back(or_zero(1 + static_cast<std::size_t>(arm) * count + k));
      std::vector<SlotType> types;
      for (std::size_t k : moving) types.push_back(n.results[k]);
      const Ref choice = node(Op::If, std::move(args), 0, 0, std::move(types));
      for (std::size_t k = 0; k < moving.size(); ++k)
        t[{index, static_cast<std::uint16_t>(moving[k]), function_}] = {
            choice.node, static_cast<std::uint16_t>(k), function_};
      return;
    }
    case Op::CallBuiltin:
    case Op::CallSpectral:
      return derive_builtin(n, r, direction, t);
    case Op::Call: {
      bool active = false;
      for (Ref a : n.args) active = active || t.count(a);
      if (!active || !can_derive(n.a)) return;
      const FunctionId derived = derive_function(n.a, direction);
      std::vector<Ref> args = n.args;
      for (std::size_t k = 0; k < n.args.size(); ++k)
        if (moves(module.functions[n.a].params[k])) args.push_back(or_zero(k));
      std::vector<SlotType> types;
      for (SlotType type : n.results) types.push_back(derivative_type(type));
      const Ref call = node(Op::Call, std::move(args), derived, 0, std::move(types));
      for (std::size_t k = 0; k < n.results.size(); ++k)
        if (moves(n.results[k]))
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
      return;  // what gives integers and logic values, and RealOfInt, whose argument does not move
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
Value Elaborator::derive_gradient(const Value& height, const Deriving& what) {
  const Deriving outer = deriving_;
  deriving_ = what;
  std::vector<Value> parts;
  for (int direction : {kAlongTangent, kAlongBitangent}) {
    Tangents t;
    const auto d = derive(t, localise(height.refs[0]), 0, direction);
    parts.push_back(scalar(kReal, d ? *d : real(0)));
  }
  deriving_ = outer;
  Value v;
  v.type = types_.array(kReal, 2);
  v.parts = std::move(parts);
  return v;
}

/// The same where an expression asks for it.
Value Elaborator::slope_of(const Value& height) {
  return derive_gradient(
      height,
      {user_span_, "where a recursion begins, find the slope and hand it on as an argument"});
}

/// How much each real of `value` changes for a step of one column of `$footprint` and for one of
/// the other: two values like `value`, which differentiation takes for constant.
std::vector<Value> Elaborator::footprint_columns(const Value& value) {
  std::vector<Ref> all, columns[2];
  flatten(value, all);
  const int footprint = vm::input_index(vm::Variable::Footprint);
  for (const Ref r : all) {
    std::optional<Ref> along[2];
    for (int direction : {kAlongTangent, kAlongBitangent}) {
      Tangents t;
      along[direction] = derive(t, localise(r), 0, direction);
    }
    for (int column = 0; column < 2; ++column) {
      std::optional<Ref> across;
      for (int row = 0; row < 2; ++row)
        if (along[row])
          across = sum(across, node(Op::MulR, {*along[row], input(footprint + 2 * row + column)}));
      columns[column].push_back(across ? *across : real(0));
      module.functions[function_].nodes[columns[column].back().node].steady = true;
    }
  }
  std::vector<Value> values;
  for (const std::vector<Ref>& column : columns) {
    std::size_t next = 0;
    values.push_back(unflatten(value.type, column, next));
  }
  return values;
}

/// How much each real of `value` changes across the pixel: the length of its changes along both
/// axes. A box as wide has the variance of the pixel's projection.
Value Elaborator::across_footprint(const Value& value) {
  const Deriving outer = deriving_;
  deriving_ = {user_span_,
               "where a recursion begins, find the width and hand it on as an argument"};
  std::vector<Ref> x, y;
  const std::vector<Value> columns = footprint_columns(value);
  flatten(columns[0], x);
  flatten(columns[1], y);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (known(x[k]) && known(y[k])) continue;  // it does not move
    x[k] = call_library("hypot", {scalar(kReal, x[k]), scalar(kReal, y[k])}, user_span_).refs[0];
    module.functions[function_].nodes[x[k].node].steady = true;
  }
  deriving_ = outer;
  std::size_t next = 0;
  return unflatten(value.type, x, next);
}

/// How much each real of `value` changes across the pixel along its x axis (column 0) or y axis.
Value Elaborator::along_footprint(const Value& value, const Value& column) {
  const Deriving outer = deriving_;
  deriving_ = {user_span_, "with `width = 0` a picture is looked up as it is, unfiltered"};
  std::vector<Value> columns = footprint_columns(value);
  deriving_ = outer;
  return columns[known_integer(column).value_or(0) != 0];
}

}  // namespace mms::lang
