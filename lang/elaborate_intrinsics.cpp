// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the library's own sources may call as `intrinsic::name`: the few things that the language
/// cannot say. A function argument is elaborated once, on values that stand for its arguments; what
/// it computes is then copied to where the arguments are known.

#include <algorithm>

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {

using vm::Op;
using vm::SlotType;

namespace {

/// What does over spectra what `op` does over reals, bit for bit at each wavelength.
std::optional<Op> over_spectra(Op op) {
  switch (op) {
    case Op::AddR:
      return Op::AddS;
    case Op::SubR:
      return Op::SubS;
    case Op::MulR:
      return Op::MulS;
    case Op::DivR:
      return Op::DivS;
    case Op::NegR:
      return Op::NegS;
    case Op::FmaR:
      return Op::FmaS;
    default:
      return std::nullopt;
  }
}

bool all_real(const std::vector<SlotType>& types) {
  return std::all_of(types.begin(), types.end(), [](SlotType t) { return t == SlotType::Real; });
}

}  // namespace

Value Elaborator::call_intrinsic(std::string_view name, const std::vector<BoundArgument>& args) {
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  if (name == "array") return tabulate(args[0].value, args[1].value);
  if (name == "gradient") return gradient_of(args[0].value, args[1].value);
  if (name == "slope") return slope_of(args[0].value);
  if (name == "across_footprint") return across_footprint(args[0].value);
  if (name == "values") return values_of(args[0].value);
  if (name == "along_footprint") return along_footprint(args[0].value, args[1].value);
  if (name == "image") return image_handle(args);
  if (name == "curve") return curve_handle(args);
  if (name == "image_fact") return image_fact(args);
  return at_each_wavelength(args[0].value, args[1].value);
}

/// The array of a spectrum's values.
Value Elaborator::values_of(const Value& spectrum) {
  const Value whole = convert(spectrum, kSpectrum, user_span_);
  if (whole.poison()) return {};
  const Ref s = localise(whole.refs[0]);
  std::vector<Value> parts;
  for (std::uint32_t k = 0; k < kWavelengths; ++k) parts.push_back(scalar(kReal, component(s, k)));
  return array_of(std::move(parts), {});
}

/// `[f(0), f(1), ...]` of `count` elements.
Value Elaborator::tabulate(const Value& count, const Value& f) {
  const auto n = known_integer(count);
  if (!n) {
    if (!unknown_arguments_)
      diagnostics_.add(Diag::NeedsConstant, user_span_, "the size of an array");
    return {};
  }
  if (*n < 1 || *n > vm::limits::kAggregate) {
    diagnostics_.add(Diag::ArraySize, user_span_, *n, vm::limits::kAggregate);
    return {};
  }
  std::vector<Value> parts;
  for (std::int64_t k = 0; k < *n; ++k) {
    const Value index = scalar(kInteger, integer(k));
    parts.push_back(call_function_value(f, {{std::nullopt, index, user_span_}}, user_span_));
    if (parts.back().poison()) return {};
  }
  return array_of(std::move(parts), {});
}

/// `roots` as they are where the values `from`, made from node `first` on, are `to`.
std::vector<Ref> Elaborator::substitute(std::uint32_t first, const std::vector<Ref>& from,
                                        const std::vector<Ref>& to, std::vector<Ref> roots) {
  std::map<Ref, Ref> now;
  for (std::size_t k = 0; k < from.size(); ++k) now[from[k]] = to[k];
  auto mapped = [&](Ref r) {
    auto it = now.find(r);
    return it == now.end() ? r : it->second;
  };
  const std::vector<bool> wanted =
      reached(module.functions[function_], roots, [&](Ref r) { return r.node >= first; });
  const vm::SourceLine line = line_;
  for (std::uint32_t i = first; i < wanted.size(); ++i) {
    const Node n = module.functions[function_].nodes[i];
    const bool moves =
        std::any_of(n.args.begin(), n.args.end(), [&](Ref a) { return now.count(a); });
    if (!wanted[i] || !moves) continue;
    std::vector<Ref> args;
    for (Ref a : n.args) args.push_back(mapped(a));
    line_ = n.line;
    const std::size_t count = n.results.size();
    const vm::Constant* decided = n.op == Op::If ? known(args[0]) : nullptr;
    Ref r;
    if (!decided) {
      r = node(n.op, args, n.a, n.b, n.results);
      module.functions[function_].nodes[r.node].steady = n.steady;
    }
    for (std::size_t k = 0; k < count; ++k)
      now[{i, static_cast<std::uint16_t>(k), function_}] =
          decided ? args[1 + k + (decided->integer ? 0 : count)]
                  : Ref{r.node, static_cast<std::uint16_t>(k), function_};
    auto callee = n.op == Op::Call ? instance_of_.find(n.a) : instance_of_.end();
    if (callee != instance_of_.end()) callee->second->sites.push_back({function_, r.node});
  }
  line_ = line;
  for (Ref& r : roots) r = mapped(r);
  return roots;
}

/// A real that stands for an argument nobody knows yet.
Ref Elaborator::stand_in() { return node(Op::LoadLocal, {}, 0, 0, {SlotType::Real}); }

/// The real value of `f` at `x`.
std::optional<Ref> Elaborator::call_for_real(const Value& f, Value x) {
  const Value y = call_function_value(f, {{std::nullopt, std::move(x), user_span_}}, user_span_);
  const Value r = y.poison() ? y : convert(y, kReal, user_span_);
  return r.poison() ? std::nullopt : std::optional<Ref>(localise(r.refs[0]));
}

/// The partial derivatives of `f` at `point`, a real or an array of them.
Value Elaborator::gradient_of(const Value& f, const Value& point) {
  std::vector<Ref> at, x, partials;
  flatten(point, at);
  const std::uint32_t first = static_cast<std::uint32_t>(module.functions[function_].nodes.size());
  for (const Ref r : at) {
    x.push_back(stand_in());
    stands_for_[x.back()] = localise(r);
    ++kept_;
  }
  std::size_t next = 0;
  const auto value = call_for_real(f, unflatten(point.type, x, next));
  if (!value) return {};
  const Deriving outer = deriving_;
  deriving_ = {user_span_, "`gradient` differentiates what the function is made of"};
  for (Ref r : x) {
    Tangents t;
    t[r] = real(1);
    const auto d = derive(t, *value, first, kAlongNothing);
    partials.push_back(d ? *d : real(0));
  }
  deriving_ = outer;
  partials = substitute(first, x, at, std::move(partials));
  next = 0;
  return unflatten(point.type, partials, next);
}

/// The spectrum of `f` of each value of `spectrum`.
Value Elaborator::at_each_wavelength(const Value& f, const Value& spectrum) {
  const std::uint32_t first = static_cast<std::uint32_t>(module.functions[function_].nodes.size());
  const Ref x = stand_in();
  ++kept_;
  stands_for_[x] = real(0);  // a wavelength is the same in all of the pixel
  const auto value = call_for_real(f, scalar(kReal, x));
  if (!value) return {};
  const Ref s = localise(spectrum.refs[0]);
  if (const auto whole = widened(first, x, s, *value)) return scalar(kSpectrum, *whole);
  std::vector<Ref> values;
  for (std::uint32_t k = 0; k < kWavelengths; ++k)
    values.push_back(substitute(first, {x}, {component(s, k)}, {*value})[0]);
  return scalar(kSpectrum, node(Op::Pack, std::move(values)));
}

Ref Elaborator::component(Ref spectrum, std::uint32_t k) {
  const Node& n = module.functions[function_].nodes[spectrum.node];
  if (n.op == Op::Splat) return n.args[0];
  if (n.op == Op::Pack) return n.args[k];
  return node(Op::Component, {spectrum}, k);
}

/// `root`, computed from the real `x`, over all wavelengths at once with the spectrum `s` in its
/// place; none where an operation on the way has no counterpart over spectra.
std::optional<Ref> Elaborator::widened(std::uint32_t first, Ref x, Ref s, Ref root) {
  std::map<Ref, Ref> wide{{x, s}};
  auto spectrum = [&](Ref r) {
    auto it = wide.find(r);
    return it == wide.end() ? node(Op::Splat, {r}) : it->second;
  };
  const std::vector<bool> wanted =
      reached(module.functions[function_], {&root, 1}, [&](Ref r) { return r.node >= first; });
  for (std::uint32_t i = first; i < wanted.size(); ++i) {
    const Node n = module.functions[function_].nodes[i];
    const bool moves =
        std::any_of(n.args.begin(), n.args.end(), [&](Ref a) { return wide.count(a); });
    if (!wanted[i] || !moves) continue;
    std::vector<Ref> args;
    Ref r;
    if (const auto op = over_spectra(n.op)) {
      for (Ref a : n.args) args.push_back(spectrum(a));
      r = node(*op, std::move(args));
    } else if (n.op == Op::SelectR && !wide.count(n.args[0])) {
      r = node(Op::SelectS, {n.args[0], spectrum(n.args[1]), spectrum(n.args[2])});
    } else if (n.op == Op::CallBuiltin && !module.builtins[n.a]->image32 &&
               all_real(module.builtin_params[n.a]) && all_real(n.results) &&
               n.results.size() == 1 && n.args.size() <= 32) {
      std::uint32_t mask = 0;
      for (std::size_t k = 0; k < n.args.size(); ++k) {
        const bool varies = wide.count(n.args[k]) > 0;
        args.push_back(varies ? wide[n.args[k]] : n.args[k]);
        mask |= varies ? 1u << k : 0;
      }
      r = node(Op::CallSpectral, std::move(args), n.a, mask);
    } else {
      return std::nullopt;
    }
    wide[{i, 0, function_}] = r;
  }
  return spectrum(root);
}

}  // namespace mms::lang
