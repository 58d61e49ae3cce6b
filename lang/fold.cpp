// SPDX-License-Identifier: Apache-2.0
#include "lang/fold.h"

#include <array>
#include <cstdint>

namespace mms::lang {
namespace {

using vm::kLaneMultiple;
#include "vm/kernels.h"

using vm::Op;
using vm::SlotType;
using Args = std::span<const vm::Constant>;

template <class F>
vm::Constant real1(Args a) {
  return {SlotType::Real, F::eval(a[0].f32), F::eval(a[0].f64), 0};
}
template <class F>
vm::Constant real2(Args a) {
  return {SlotType::Real, F::eval(a[0].f32, a[1].f32), F::eval(a[0].f64, a[1].f64), 0};
}
template <class F>
vm::Constant integer2(Args a) {
  return {SlotType::Integer, 0, 0, F::eval(a[0].integer, a[1].integer)};
}
/// The float machine decides what is true: both machines must take the same way through a script.
template <class F>
vm::Constant real_logic(Args a) {
  return {SlotType::Logic, 0, 0, F::eval(a[0].f32, a[1].f32)};
}
template <class F>
vm::Constant integer_logic(Args a) {
  return {SlotType::Logic, 0, 0, F::eval(a[0].integer, a[1].integer)};
}
vm::Constant logic(std::int32_t v) { return {SlotType::Logic, 0, 0, v}; }

}  // namespace

std::optional<vm::Constant> fold(vm::Op op, Args a) {
  switch (op) {
    case Op::AddR:
      return real2<Add>(a);
    case Op::SubR:
      return real2<Sub>(a);
    case Op::MulR:
      return real2<Mul>(a);
    case Op::DivR:
      return real2<Div>(a);
    case Op::ModR:
      return real2<Mod>(a);
    case Op::NegR:
      return real1<Neg>(a);
    case Op::FmaR:
      return vm::Constant{SlotType::Real, Fma::eval(a[0].f32, a[1].f32, a[2].f32),
                          Fma::eval(a[0].f64, a[1].f64, a[2].f64), 0};
    case Op::AddI:
      return integer2<AddWrap>(a);
    case Op::SubI:
      return integer2<SubWrap>(a);
    case Op::MulI:
      return integer2<MulWrap>(a);
    case Op::ModI:
      return integer2<ModFloored>(a);
    case Op::NegI:
      return vm::Constant{SlotType::Integer, 0, 0, NegWrap::eval(a[0].integer)};
    case Op::RealOfInt:
      return vm::Constant{SlotType::Real, ToReal<float>::eval(a[0].integer),
                          ToReal<double>::eval(a[0].integer), 0};
    case Op::IntOfReal:
      return vm::Constant{SlotType::Integer, 0, 0, Truncate::eval(a[0].f32)};
    case Op::LtR:
      return real_logic<Lt>(a);
    case Op::LeR:
      return real_logic<Le>(a);
    case Op::EqR:
      return real_logic<Eq>(a);
    case Op::NeR:
      return real_logic<Ne>(a);
    case Op::LtI:
      return integer_logic<Lt>(a);
    case Op::LeI:
      return integer_logic<Le>(a);
    case Op::EqI:
      return integer_logic<Eq>(a);
    case Op::NeI:
      return integer_logic<Ne>(a);
    case Op::And:
      return logic(And::eval(a[0].integer, a[1].integer));
    case Op::Or:
      return logic(Or::eval(a[0].integer, a[1].integer));
    case Op::Not:
      return logic(Not::eval(a[0].integer));
    case Op::SelectR:
    case Op::SelectI:
    case Op::SelectL:
      return a[0].integer ? a[1] : a[2];
    default:
      return std::nullopt;
  }
}

vm::Constant fold_builtin(const vm::Builtin& row, SlotType result, Args args) {
  constexpr int kLanes = vm::kLaneMultiple;
  vm::Constant out{result, 0, 0, 0};
  auto run = [&]<class R>(vm::Kernel kernel, R (*of)(const vm::Constant&), R& answer) {
    constexpr std::size_t kMaxArgs = 16;
    alignas(64) std::array<std::array<R, kLanes>, kMaxArgs> blocks;
    alignas(64) std::array<R, kLanes> first{};
    const void* in[kMaxArgs];
    for (std::size_t k = 0; k < args.size() && k < kMaxArgs; ++k) {
      in[k] = blocks[k].data();
      if (args[k].type == SlotType::Real) {
        blocks[k].fill(of(args[k]));
      } else {
        auto* lanes = reinterpret_cast<std::int32_t*>(blocks[k].data());
        for (int i = 0; i < kLanes; ++i) lanes[i] = args[k].integer;
      }
    }
    void* to[] = {first.data()};
    kernel(in, to, kLanes);
    if (result == SlotType::Real) {
      answer = first[0];
    } else {
      out.integer = reinterpret_cast<const std::int32_t*>(first.data())[0];
    }
  };
  // Integer results come from the float kernel, which runs last.
  run(
      row.f64, +[](const vm::Constant& c) { return c.f64; }, out.f64);
  run(
      row.f32, +[](const vm::Constant& c) { return c.f32; }, out.f32);
  return out;
}

}  // namespace mms::lang
