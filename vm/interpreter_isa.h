// SPDX-License-Identifier: Apache-2.0
// No include guard: included once by each interpreter_<isa>.cpp, which defines MMS_ISA, the
// namespace of that build.

/// \file
/// The execution loop. Uses no inline function from outside this namespace (see vm/kernels.h).

#include <cstddef>
#include <cstdint>

#include "vm/machine.h"

namespace mms::vm::MMS_ISA {
namespace {

#include "vm/kernels.h"

/// One call of one function.
template <class R>
class Frame {
 public:
  Frame(Machine& m, std::uint32_t function, std::byte* memory, int depth)
      : m_(m), f_(m.functions[function]), n_(m.lanes), depth_(depth) {
    base_[Operand::Constant] = m.constants;
    base_[Operand::Input] = m.inputs;
    base_[Operand::Mask] = memory;
    stride_[Operand::Constant] = m.constant_stride;
    stride_[Operand::Input] = m.input_stride;
    stride_[Operand::Mask] = std::size_t(n_) * sizeof(int32_t);
    base_[Operand::Slot] = memory + f_.masks * stride_[Operand::Mask];
    stride_[Operand::Slot] = std::size_t(n_) * sizeof(R);
  }

  void run() {
    if (f_.loops) clear(mask(1));
    do pass();
    while (f_.loops && restart());
  }

 private:
  using In = LoweredInstruction;

  template <class T>
  T* at(Operand o) const {
    return reinterpret_cast<T*>(base_[o.base()] + o.index() * stride_[o.base()]);
  }
  int32_t* mask(uint32_t k) const {
    return reinterpret_cast<int32_t*>(base_[Operand::Mask] + k * stride_[Operand::Mask]);
  }

  template <class F, class D, class A>
  void unary(const In& i) {
    map1<F>(at<D>(i.dst), at<const A>(i.a), n_);
  }
  template <class F, class D, class A>
  void binary(const In& i) {
    map2<F>(at<D>(i.dst), at<const A>(i.a), at<const A>(i.b), n_);
  }
  template <class F, class D, class A, class B>
  void ternary(const In& i) {
    map3<F>(at<D>(i.dst), at<const A>(i.a), at<const B>(i.b), at<const B>(i.c), n_);
  }

  /// Reals from one component of a spectrum operand to the next.
  std::ptrdiff_t step(Operand o) const {
    return o.splat() ? 0 : std::ptrdiff_t(stride_[o.base()] / sizeof(R));
  }

  /// Calls `f(k, lanes)` for each wavelength k, or once for all where every operand is contiguous.
  template <class... O, class F>
  void each_wavelength(F f, O... operands) {
    if (((step(operands) == n_) && ...)) return f(0, kWavelengths * n_);
    for (int k = 0; k < kWavelengths; ++k) f(k, n_);
  }
  template <class F>
  void unary_s(const In& i) {
    R* d = at<R>(i.dst);
    const R* a = at<const R>(i.a);
    const std::ptrdiff_t da = step(i.a);
    each_wavelength([=, n = n_](int k, int lanes) { map1<F>(d + k * n, a + k * da, lanes); }, i.a);
  }
  template <class F>
  void binary_s(const In& i) {
    R* d = at<R>(i.dst);
    const R *a = at<const R>(i.a), *b = at<const R>(i.b);
    const std::ptrdiff_t da = step(i.a), db = step(i.b);
    each_wavelength(
        [=, n = n_](int k, int lanes) { map2<F>(d + k * n, a + k * da, b + k * db, lanes); }, i.a,
        i.b);
  }
  void fma_s(const In& i) {
    R* d = at<R>(i.dst);
    const R *a = at<const R>(i.a), *b = at<const R>(i.b), *c = at<const R>(i.c);
    const std::ptrdiff_t da = step(i.a), db = step(i.b), dc = step(i.c);
    each_wavelength(
        [=, n = n_](int k, int lanes) {
          map3<Fma>(d + k * n, a + k * da, b + k * db, c + k * dc, lanes);
        },
        i.a, i.b, i.c);
  }
  void select_s(const In& i) {
    R* d = at<R>(i.dst);
    const R *b = at<const R>(i.b), *c = at<const R>(i.c);
    const std::ptrdiff_t db = step(i.b), dc = step(i.c);
    for (int k = 0; k < kWavelengths; ++k)
      map3<Select>(d + k * n_, at<const int32_t>(i.a), b + k * db, c + k * dc, n_);
  }
  void splat(const In& i) {
    for (int k = 0; k < kWavelengths; ++k)
      __builtin_memcpy(at<R>(i.dst) + k * n_, at<const R>(i.a) + k * step(i.a),
                       std::size_t(n_) * sizeof(R));
  }

  void copy(std::byte* to, const std::byte* from) {
    __builtin_memcpy(to, from, std::size_t(n_) * sizeof(R));
  }
  void clear(int32_t* m) { __builtin_memset(m, 0, std::size_t(n_) * sizeof(int32_t)); }

  // Calls and faults

  void builtin(const CallSite& s) {
    const Operand* arg = m_.operands + s.first_arg;
    const Operand* result = m_.operands + s.first_result;
    for (uint32_t r = 0; r < s.repeats; ++r) {
      for (uint32_t k = 0; k < s.args; ++k) m_.in[k] = at<const void>(*arg++);
      for (uint32_t k = 0; k < s.results; ++k) m_.out[k] = at<void>(*result++);
      (sizeof(R) == sizeof(float) ? s.f32 : s.f64)(m_.in, m_.out, n_);
    }
  }

  void give_up(int lane, Fault::Cause cause, SourceLine line) {
    m_.faults[m_.fault_count++] = Fault{cause, lane, line};
    m_.alive[lane] = 0;
    m_.spent[lane] = 0;
  }
  /// Takes lanes that were given up out of every mask of this frame.
  void sweep() {
    for (uint32_t k = 0; k < f_.masks; ++k) map2<And>(mask(k), mask(k), m_.alive, n_);
  }
  /// One more back edge or recursive call for the lanes of `lanes`.
  void spend(const int32_t* lanes, SourceLine line) {
    if (!count(m_.spent, lanes, limits::kBackEdges, n_)) return;
    for (int i = 0; i < n_; ++i)
      if (lanes[i] && m_.spent[i] > limits::kBackEdges) give_up(i, Fault::Cause::BackEdges, line);
    sweep();
  }

  void call(const CallSite& s, const int32_t* lanes, SourceLine line) {
    const LoweredFunction& callee = m_.functions[s.function];
    if (callee.recursive) spend(lanes, line);
    if (!any_of(lanes, n_)) return;
    const std::size_t blocks = callee.masks + callee.blocks;
    if (depth_ >= limits::kCallDepth || m_.open_blocks + blocks > limits::kStackBlocks) {
      for (int i = 0; i < n_; ++i)
        if (lanes[i]) give_up(i, Fault::Cause::CallDepth, line);
      return sweep();
    }
    const int faults = m_.fault_count;
    const std::size_t bytes = frame_bytes(callee);
    m_.open_blocks += blocks;
    std::byte* memory = m_.push_frame(m_.frames, bytes);
    enter(s, callee, memory, lanes);
    m_.pop_frame(m_.frames, bytes);
    m_.open_blocks -= blocks;
    if (m_.fault_count != faults) sweep();
  }
  void enter(const CallSite& s, const LoweredFunction& callee, std::byte* memory,
             const int32_t* lanes) {
    Frame inner(m_, s.function, memory, depth_ + 1);
    __builtin_memcpy(inner.mask(0), lanes, std::size_t(n_) * sizeof(int32_t));
    const Operand* arg = m_.operands + s.first_arg;
    for (uint32_t k = 0; k < s.args; ++k)
      copy(inner.slot(callee.result_blocks + k), at<std::byte>(arg[k]));
    inner.run();
    const Operand* result = m_.operands + s.first_result;
    for (uint32_t k = 0; k < s.results; ++k) copy(at<std::byte>(result[k]), inner.slot(k));
  }
  std::byte* slot(uint32_t k) const { return base_[Operand::Slot] + k * stride_[Operand::Slot]; }
  std::size_t frame_bytes(const LoweredFunction& f) const {
    return f.masks * stride_[Operand::Mask] + f.blocks * stride_[Operand::Slot];
  }

  void tail_call(const In& i, SourceLine line) {
    int32_t* lanes = at<int32_t>(i.a);
    spend(lanes, line);
    binary<Or, int32_t, int32_t>({i.op, i.dst, i.dst, i.a, {}, 0});
  }
  /// Whether any lane starts again; those are then the lanes that run.
  bool restart() {
    if (!any_of(mask(1), n_)) return false;
    __builtin_memcpy(mask(0), mask(1), std::size_t(n_) * sizeof(int32_t));
    clear(mask(1));
    return true;
  }

  /// The code once, from its start to its end.
  void pass();

  Machine& m_;
  const LoweredFunction& f_;
  int n_, depth_;
  std::byte* base_[4];
  std::size_t stride_[4];
};

template <class R>
void Frame<R>::pass() {
  using L = int32_t;
  const LoweredInstruction* code = m_.code;
  for (uint32_t pc = f_.begin;; ++pc) {
    const In& i = code[pc];
    switch (i.op) {
      case LoweredOp::AddR:
        binary<Add, R, R>(i);
        break;
      case LoweredOp::SubR:
        binary<Sub, R, R>(i);
        break;
      case LoweredOp::MulR:
        binary<Mul, R, R>(i);
        break;
      case LoweredOp::DivR:
        binary<Div, R, R>(i);
        break;
      case LoweredOp::ModR:
        binary<Mod, R, R>(i);
        break;
      case LoweredOp::NegR:
        unary<Neg, R, R>(i);
        break;
      case LoweredOp::FmaR:
        ternary<Fma, R, R, R>(i);
        break;

      case LoweredOp::AddS:
        binary_s<Add>(i);
        break;
      case LoweredOp::SubS:
        binary_s<Sub>(i);
        break;
      case LoweredOp::MulS:
        binary_s<Mul>(i);
        break;
      case LoweredOp::DivS:
        binary_s<Div>(i);
        break;
      case LoweredOp::NegS:
        unary_s<Neg>(i);
        break;
      case LoweredOp::FmaS:
        fma_s(i);
        break;
      case LoweredOp::Splat:
        splat(i);
        break;

      case LoweredOp::AddI:
        binary<AddWrap, L, L>(i);
        break;
      case LoweredOp::SubI:
        binary<SubWrap, L, L>(i);
        break;
      case LoweredOp::MulI:
        binary<MulWrap, L, L>(i);
        break;
      case LoweredOp::ModI:
        binary<ModFloored, L, L>(i);
        break;
      case LoweredOp::NegI:
        unary<NegWrap, L, L>(i);
        break;

      case LoweredOp::RealOfInt:
        unary<ToReal<R>, R, L>(i);
        break;
      case LoweredOp::IntOfReal:
        unary<Truncate, L, R>(i);
        break;

      case LoweredOp::LtR:
        binary<Lt, L, R>(i);
        break;
      case LoweredOp::LeR:
        binary<Le, L, R>(i);
        break;
      case LoweredOp::EqR:
        binary<Eq, L, R>(i);
        break;
      case LoweredOp::NeR:
        binary<Ne, L, R>(i);
        break;
      case LoweredOp::LtI:
        binary<Lt, L, L>(i);
        break;
      case LoweredOp::LeI:
        binary<Le, L, L>(i);
        break;
      case LoweredOp::EqI:
        binary<Eq, L, L>(i);
        break;
      case LoweredOp::NeI:
        binary<Ne, L, L>(i);
        break;
      case LoweredOp::And:
        binary<And, L, L>(i);
        break;
      case LoweredOp::Or:

        binary<Or, L, L>(i);
        break;
      case LoweredOp::Not:
        unary<Not, L, L>(i);
        break;

      case LoweredOp::SelectR:
        ternary<Select, R, L, R>(i);
        break;
      case LoweredOp::SelectI:
      case LoweredOp::SelectL:
        ternary<Select, L, L, L>(i);
        break;
      case LoweredOp::SelectS:
        select_s(i);
        break;
      case LoweredOp::Copy:
        copy(at<std::byte>(i.dst), at<const std::byte>(i.a));
        break;

      case LoweredOp::If:
        if (!split(at<L>(i.dst), at<L>(i.c), at<const L>(i.b), at<const L>(i.a), n_))
          pc = i.target - 1;
        break;
      case LoweredOp::SkipIfNone:
        if (!any_of(at<const L>(i.a), n_)) pc = i.target - 1;
        break;
      case LoweredOp::Call:
        call(m_.sites[i.target], at<const L>(i.a), m_.lines[pc]);
        break;
      case LoweredOp::CallBuiltin:
        builtin(m_.sites[i.target]);
        break;
      case LoweredOp::TailCall:
        tail_call(i, m_.lines[pc]);
        break;
      case LoweredOp::Return:
        return;

      case LoweredOp::PushConst:
      case LoweredOp::PushInput:
      case LoweredOp::LoadLocal:
      case LoweredOp::StoreLocal:
      case LoweredOp::Else:
      case LoweredOp::End:
      case LoweredOp::CallSpectral:
        __builtin_unreachable();
    }
  }
}

}  // namespace

void execute(float, Machine& m, std::uint32_t function, std::byte* frame, int depth) {
  Frame<float>(m, function, frame, depth).run();
}
void execute(double, Machine& m, std::uint32_t function, std::byte* frame, int depth) {
  Frame<double>(m, function, frame, depth).run();
}

}  // namespace mms::vm::MMS_ISA
