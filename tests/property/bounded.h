// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How far the float machine may be from the double one: a running error analysis.
///
/// The machine below runs one lane of a program as the double machine does, and carries with every
/// real a bound of the distance of the float machine's value from it (Higham, Accuracy and
/// Stability of Numerical Algorithms, section 3.3). With u = 2^-24:
///
/// * Arithmetic. The errors of the operands are carried through exactly (|a| eb + |b| ea + ea eb
/// for a
///   product), and rounding adds u |result|. Where the operands have no error, the rounding is
///   known: it is the difference of the two results.
/// * Rows of the library. With n arguments in error by e_k, the result moves, to first order, by
///   sum |df/dx_k| e_k <= max_k n |df/dx_k| e_k, which is how far it moves when one argument alone
///   moves by n e_k. That is tried in double, upwards and downwards (a jump that the arguments can
///   cross together is crossed by one of them that way), and doubled for the terms of higher order.
///   Rounding adds what the row states (`max_ulp`). Noise states nothing: its kernel makes at most
///   64 roundings of numbers up to the dimension, which is 64 n u of the value, and for the cells
///   it decides between a shift of the arguments by 2^-20.
/// * Where an argument is in error by more than 1/64 of the scale on which the row varies, or a
///   result is near the end of float's range, nothing is known: the bound is infinite.
/// * A comparison of numbers nearer than their bounds is unsure, and so is what it decides. A
/// choice
///   between values that both are there is within the distance of both; a branch ends the lane.
/// * The double machine's own rounding is 2^-29 of all this: u is taken larger by 2^-20.

#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "tests/unit/vm/reference.h"
#include "vm/program.h"

namespace mms::property {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kRounding = 0x1p-24 * (1 + 0x1p-20);

/// The double machine has `v`, the float machine a value within `e` of it.
struct Bounded {
  double v = 0, e = 0;
  /// Both machines have NaN.
  bool nan() const { return std::isnan(v) && e == 0; }
};

struct BoundedCell : vm::test::Cell<Bounded> {
  bool sure = true;  ///< the float machine has the same `i`
};

/// `v` in error by `e` before it is rounded to float.
inline Bounded rounded(double v, double e) {
  const double reach = std::fabs(v) + e;
  if (!(reach < 0.999 * double(FLT_MAX))) return {v, kInfinity};
  return {v, e + kRounding * reach + 0x1p-149};
}

/// An arithmetic instruction on reals.
inline Bounded arithmetic(vm::Op op, Bounded a, Bounded b, Bounded c) {
  using vm::Op;
  const double v = vm::test::arithmetic<double>(op, a.v, b.v, c.v);
  if (op == Op::NegR || op == Op::NegS) return {v, a.e};
  const bool three = op == Op::FmaR || op == Op::FmaS;
  if (a.nan() || b.nan() || (three && c.nan())) return {v, 0};
  if (a.e == 0 && b.e == 0 && (!three || c.e == 0)) {  // rounded once, or twice by ModR
    const double f = vm::test::arithmetic<float>(op, float(a.v), float(b.v), float(c.v));
    if (std::isnan(f) && std::isnan(v)) return {v, 0};
    if (f == v) return {v, 0};
    const double e = std::fabs(f - v);
    return {v, std::isnan(e) ? kInfinity : e};
  }
  if (!std::isfinite(v)) return {v, kInfinity};
  const double product = std::fabs(a.v) * b.e + std::fabs(b.v) * a.e + a.e * b.e;
  const double left = std::fabs(b.v) - b.e;
  switch (op) {
    case Op::AddR:
    case Op::AddS:
    case Op::SubR:
    case Op::SubS:
      return rounded(v, a.e + b.e);
    case Op::MulR:
    case Op::MulS:
      return rounded(v, product);
    case Op::FmaR:
    case Op::FmaS:
      return rounded(v, product + c.e);
    case Op::DivR:
    case Op::DivS:
      return left > 0 ? rounded(v, (a.e + std::fabs(v) * b.e) / left) : Bounded{v, kInfinity};
    case Op::ModR: {  // a - b floor(q): the floor may be of another side of a whole number
      if (!(left > 0)) return {v, kInfinity};
      const double q = a.v / b.v;
      const Bounded near = rounded(q, (a.e + std::fabs(q) * b.e) / left);
      const double low = std::floor(q - near.e), high = std::floor(q + near.e);
      const double floors = std::max(std::fabs(low), std::fabs(high));
      return rounded(v, a.e + floors * b.e + (high - low) * (std::fabs(b.v) + b.e));
    }
    default:
      return {v, kInfinity};
  }
}

/// Whether a < b (or <=, ==) in the float machine too.
inline bool compare_surely(vm::Op op, Bounded a, Bounded b, std::int32_t& result) {
  vm::test::Cell<double> x, y;
  x.r[0] = a.v;
  y.r[0] = b.v;
  result = vm::test::apply<double>(op, x, y, {}).i;
  if ((a.e == 0 && b.e == 0) || a.nan() || b.nan()) return true;
  return std::fabs(a.v - b.v) > a.e + b.e;
}

/// Of a choice that is unsure: near both.
inline Bounded either(Bounded chosen, Bounded other) {
  if (chosen.nan() && other.nan()) return chosen;
  if (chosen.v == other.v) return {chosen.v, std::max(chosen.e, other.e)};
  const double e = std::max(chosen.e, std::fabs(other.v - chosen.v) + other.e);
  return {chosen.v, std::isnan(e) ? kInfinity : e};
}

/// A call of a row of the library. Arguments and results are its flattened slots.
class LibraryCall {
 public:
  LibraryCall(const vm::Builtin& row, std::span<const vm::SlotType> params,
              std::span<const vm::SlotType> results)
      : row_(row), params_(params), results_(results) {
    const std::string_view s = row.signature;
    const std::size_t space = s.find(' ');
    name_ = s.substr(space + 1, s.find('(') - space - 1);
    noise_ = row.module == "noise" && !name_.starts_with("hash") && name_ != "cellnoise";
  }

  std::vector<BoundedCell> operator()(std::span<const BoundedCell> args) const {
    std::vector<double> at;
    double in_error = 0;
    bool sure = true;
    for (std::size_t k = 0; k < args.size(); ++k) {
      const bool real = params_[k] == vm::SlotType::Real;
      at.push_back(real ? args[k].r[0].v : args[k].i);
      if (real ? error(args[k]) > 0 : !args[k].sure) ++in_error;
      if (real ? !in_scale(args[k].r[0].v, double(args.size()) * error(args[k])) : !args[k].sure)
        sure = false;
    }
    // fmod(a, b) jumps wherever a / b is whole: with b, on the scale b^2 / a.
    if (name_ == "fmod" && !(128 * error(args[1]) * std::fabs(at[0]) <= at[1] * at[1]) &&
        error(args[1]) > 0)
      sure = false;
    const std::vector<double> here = evaluate(at);
    std::vector<double> moved(here.size(), 0.0);
    // Exponents of Minkowski's distances below 1 count as 1. By that one several points are equally
    // far over whole regions, where rounding chooses, and only a larger exponent shows it.
    const bool minkowski = row_.signature.ends_with(", exponent)");
    if (minkowski) at.back() = std::max(1.0, at.back());
    for (std::size_t k = 0; sure && k < args.size(); ++k) {
      const double e = params_[k] == vm::SlotType::Real ? error(args[k]) : 0.0;
      if (e == 0 || std::isnan(at[k])) continue;
      for (const double step : {-in_error * e, in_error * e}) {
        std::vector<double> there = at;
        there[k] += step;
        const std::vector<double> values = evaluate(there);
        for (std::size_t j = 0; j < here.size(); ++j)
          if (values[j] != here[j] && !(std::isnan(values[j]) && std::isnan(here[j])))
            moved[j] = std::max(moved[j], std::isfinite(values[j] - here[j])
                                              ? std::fabs(values[j] - here[j])
                                              : kInfinity);
      }
    }
    return bounds(here, moved, sure, double(args.size()) * size_of_sums(at));
  }

 private:
  std::vector<BoundedCell> bounds(const std::vector<double>& here, const std::vector<double>& moved,
                                  bool sure, double rounded) const {
    double largest = 0;
    for (const double v : here)
      if (std::isfinite(v)) largest = std::max(largest, std::fabs(v));
    std::vector<BoundedCell> out(here.size());
    for (std::size_t j = 0; j < here.size(); ++j) {
      out[j].r[0].v = here[j];
      if (results_[j] != vm::SlotType::Real) {
        out[j].i = std::int32_t(here[j]);
        out[j].sure = sure && moved[j] == 0;
        continue;
      }
      double e = sure ? 2 * moved[j] : kInfinity;
      if (std::isfinite(here[j])) {
        e += row_.max_ulp * 2 * kRounding * (std::fabs(here[j]) + e);
        if (row_.max_ulp > 0) e += double(FLT_MIN);  // small results may be flushed
        if (noise_) e += 64 * rounded * kRounding * (1 + largest);
        if (here.size() > 1) e += 0x1p-46 * largest;  // the double kernel where parts cancel
        if (!(std::fabs(here[j]) + e < 0.999 * double(FLT_MAX))) e = kInfinity;
      }
      out[j].r[0].e = e;
    }
    return out;
  }

  /// What a derivative of noise is the sum of, which may cancel: each order along an axis
  /// multiplies that by up to 30.
  double size_of_sums(const std::vector<double>& at) const {
    double size = 1;
    for (std::size_t k = 0; name_.ends_with("_derivative") && k < at.size(); ++k)
      if (params_[k] != vm::SlotType::Real) size *= std::pow(30, std::clamp(at[k], 0.0, 9.0));
    return size;
  }

  double error(const BoundedCell& c) const { return c.r[0].e + (noise_ ? 0x1p-20 : 0.0); }

  /// Whether a shift by `e` is small beside the scale on which the row varies at `v`.
  bool in_scale(double v, double e) const {
    if (e == 0) return true;
    if (name_.starts_with("hash")) return false;  // white: it varies on no scale
    if (row_.module == "physics" || row_.module == "spectra") return 64 * e <= std::fabs(v);
    if (64 * e <= 1) return true;
    constexpr std::string_view kMonotone[] = {"abs",   "sqrt", "cbrt",  "hypot", "atan",
                                              "floor", "ceil", "trunc", "round", "sign",
                                              "min",   "max",  "clamp", "log",   "tanh"};
    for (const std::string_view name : kMonotone)
      if (name == name_ && row_.signature.find("complex") == std::string_view::npos)
        return 64 * e <= std::fabs(v);
    return false;
  }

  std::vector<double> evaluate(const std::vector<double>& at) const {
    alignas(64) double in[16][vm::kLaneMultiple] = {}, out[16][vm::kLaneMultiple] = {};
    const void* ins[16];
    void* outs[16];
    for (int j = 0; j < 16; ++j) ins[j] = in[j], outs[j] = out[j];
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (params_[k] == vm::SlotType::Real) {
        std::fill_n(in[k], vm::kLaneMultiple, at[k]);
      } else {
        const auto integer = std::int32_t(at[k]);
        for (int i = 0; i < vm::kLaneMultiple; ++i)
          std::memcpy(reinterpret_cast<char*>(in[k]) + 4 * i, &integer, 4);
      }
    }
    row_.f64(ins, outs, vm::kLaneMultiple);
    std::vector<double> values;
    for (std::size_t j = 0; j < results_.size(); ++j) {
      std::int32_t integer;
      std::memcpy(&integer, out[j], 4);
      values.push_back(results_[j] == vm::SlotType::Real ? out[j][0] : integer);
    }
    return values;
  }

  const vm::Builtin& row_;
  std::span<const vm::SlotType> params_, results_;
  std::string_view name_;
  bool noise_ = false;
};

}  // namespace mms::property
