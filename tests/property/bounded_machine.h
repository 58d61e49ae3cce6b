// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The plain machine of tests/unit/vm/reference.h over the values of bounded.h.

#include <vector>

#include "tests/property/bounded.h"

namespace mms::property {

/// Thrown where the float machine may go another way than the double one.
struct Unsure {};

/// The domain of numbers with bounds.
struct WithBounds {
  using Cell = BoundedCell;

  static BoundedCell constant(const vm::Constant& c) {
    const double e = std::fabs(c.f64 - double(c.f32));
    BoundedCell cell;
    cell.r[0] = {c.f64, same(c.f64, c.f32) ? 0.0 : std::isnan(e) ? kInfinity : e};
    cell.i = c.integer;
    return cell;
  }

  static bool truth(const BoundedCell& c) {
    if (!c.sure) throw Unsure{};
    return c.i;
  }

  static std::vector<BoundedCell> builtin(const vm::Builtin& row,
                                          const std::vector<vm::SlotType>& params,
                                          const std::vector<vm::SlotType>& results,
                                          const std::vector<BoundedCell>& args) {
    return LibraryCall(row, params, results)(args);
  }

  static BoundedCell select(const BoundedCell& condition, const BoundedCell& yes,
                            const BoundedCell& no) {
    const BoundedCell &chosen = condition.i ? yes : no, &other = condition.i ? no : yes;
    if (condition.sure) return chosen;
    BoundedCell d;
    for (std::size_t k = 0; k < d.r.size(); ++k) d.r[k] = either(chosen.r[k], other.r[k]);
    d.i = chosen.i;
    d.sure = chosen.sure && other.sure && chosen.i == other.i;
    return d;
  }

  /// An instruction whose operands are all on the stack.
  static BoundedCell apply(vm::Op op, const BoundedCell& a, const BoundedCell& b,
                           const BoundedCell& c) {
    using vm::Op;
    BoundedCell d;
    switch (op) {
      case Op::Splat:
        d.r.fill(a.r[0]);
        return d;
      case Op::RealOfInt:
        d.r[0] = {double(a.i), a.sure ? std::fabs(double(float(a.i)) - a.i) : kInfinity};
        return d;
      case Op::IntOfReal: {
        const Bounded x = a.r[0];
        d.i = vm::test::truncated(x.v);
        d.sure = x.e == 0 || (x.e < kInfinity && !std::isnan(x.v) &&
                              vm::test::truncated(x.v - x.e) == vm::test::truncated(x.v + x.e));
        return d;
      }
      case Op::LtR:
      case Op::LeR:
      case Op::EqR:
      case Op::NeR:
        d.sure = compare_surely(op, a.r[0], b.r[0], d.i);
        return d;
      case Op::SelectR:
      case Op::SelectI:
      case Op::SelectL:
      case Op::SelectS:
        return select(a, b, c);
      default:
        break;
    }
    const std::string_view pops = vm::info(op).pops;
    if (pops[0] == 'r' || pops[0] == 's') {
      const int n = pops[0] == 'r' ? 1 : kWavelengths;
      for (int k = 0; k < n; ++k) {
        const auto at = static_cast<std::size_t>(k);
        d.r[at] = arithmetic(op, a.r[at], b.r[at], c.r[at]);
      }
      return d;
    }
    vm::test::Cell<double> x, y;
    x.i = a.i;
    y.i = b.i;
    d.i = vm::test::apply<double>(op, x, y, {}).i;
    d.sure = a.sure && (pops.size() < 2 || b.sure);
    if (op == Op::And) d.sure |= (a.sure && !a.i) || (b.sure && !b.i);
    if (op == Op::Or) d.sure |= (a.sure && a.i) || (b.sure && b.i);
    return d;
  }

 private:
  static bool same(double a, float b) { return a == double(b) || (std::isnan(a) && std::isnan(b)); }
};

using BoundedMachine = vm::test::Machine<WithBounds>;

}  // namespace mms::property
