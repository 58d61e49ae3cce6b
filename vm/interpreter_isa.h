// SPDX-License-Identifier: Apache-2.0
// No include guard: included once by each interpreter_<isa>.cpp, which defines MMS_ISA, the
// namespace of that build.

/// \file
/// The execution loop. Uses no inline function from outside this namespace (see vm/kernels.h).

#include <cstddef>
#include <cstdint>
#include <utility>

#include "vm/machine.h"

namespace mms::vm::MMS_ISA {
namespace {

#include "vm/kernels.h"

using L = int32_t;
template <class R, LoweredOp>
struct KernelOf;
#define KERNEL(op, functor, result, ...) \
  template <class R>                     \
  struct KernelOf<R, LoweredOp::op> {    \
    using F = functor;                   \
    using Result = result;               \
    using Operands = Types<__VA_ARGS__>; \
  };
#include "vm/kernels.def"
#undef KERNEL

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
    do m_.watch ? pass<true>() : pass<false>();
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

  // One kernel over its operands: the result's type, then theirs.
  template <class F, class D, class A>
  void apply(const In& i) {
    map<F>(at<D>(i.dst), n_, Block<A>{at<const A>(i.a)});
  }
  template <class F, class D, class A, class B>
  void apply(const In& i) {
    D* const d = at<D>(i.dst);
    const Block<A> a{at<const A>(i.a)};
    const Block<B> b{at<const B>(i.b)};
    if (i.a.base() == Operand::Constant)
      map<F>(d, n_, Same<A>{a[0]}, b);
    else if (i.b.base() == Operand::Constant)
      map<F>(d, n_, a, Same<B>{b[0]});
    else
      map<F>(d, n_, a, b);
  }
  template <class F, class D, class A, class B, class C>
  void apply(const In& i) {
    map_last2<F>(at<D>(i.dst), Block<A>{at<const A>(i.a)}, Block<B>{at<const B>(i.b)},
                 Block<C>{at<const C>(i.c)}, i, n_);
  }
  /// map with the second and the third operand as they are.
  template <class F, class D, class A, class B>
  static void map_last2(D* d, Block<A> a, Block<B> b, Block<B> c, const In& i, int n) {
    const bool same_b = i.b.base() == Operand::Constant, same_c = i.c.base() == Operand::Constant;
    if (same_b && same_c)
      map<F>(d, n, a, Same<B>{b[0]}, Same<B>{c[0]});
    else if (same_b)
      map<F>(d, n, a, Same<B>{b[0]}, c);
    else if (same_c)
      map<F>(d, n, a, b, Same<B>{c[0]});
    else
      map<F>(d, n, a, b, c);
  }

  /// The kernel of `first`, and of `second` over its result as operand `position`. The operands of
  /// the first stand first; bit k of `constants` says that operand k of all is a constant.
  template <LoweredOp first, LoweredOp second, int position, unsigned constants>
  void pair(const In& i) {
    using F = KernelOf<R, first>;
    using G = KernelOf<R, second>;
    using Others = typename Without<position, typename G::Operands>::Type;
    pair_over<Chain<F, G, position>, typename G::Result, constants>(
        i, typename Joined<typename F::Operands, Others>::Type{});
  }
  template <class C, class D, unsigned constants, class... T>
  void pair_over(const In& i, Types<T...> types) {
    pair_over<C, D, constants>(i, types, std::index_sequence_for<T...>{});
  }
  template <class C, class D, unsigned constants, class... T, std::size_t... k>
  void pair_over(const In& i, Types<T...>, std::index_sequence<k...>) {
    const Operand o[] = {i.a, i.b, i.c, i.d, i.e};
    map<C>(at<D>(i.dst), n_, operand<T, (constants >> k & 1) != 0>(o[k])...);
  }
  template <class T, bool constant>
  auto operand(Operand o) const {
    if constexpr (constant)
      return Same<T>{*at<const T>(o)};
    else
      return Block<T>{at<const T>(o)};
  }

  /// Reals from one component of a spectrum operand to the next.
  ptrdiff_t step(Operand o) const {
    return o.splat() ? 0 : ptrdiff_t(stride_[o.base()] / sizeof(R));
  }
  /// Whether the components follow one another, as those of every result do.
  bool is_run(Operand o) const { return !o.splat() && step(o) == n_; }
  /// Whether one loop can take the operand through all components: they are a run or one number.
  bool runs_through(Operand o) const { return o.base() == Operand::Constant || is_run(o); }

  /// Calls `f(k, lanes)` for each wavelength k, or once for all.
  template <class F>
  void each_wavelength(bool once, F f) {
    if (once) return f(0, kWavelengths * n_);
    for (int k = 0; k < kWavelengths; ++k) f(k, n_);
  }
  Block<R> component(Operand o, int k) const { return {at<const R>(o) + k * step(o)}; }
  template <class F>
  void unary_s(const In& i) {
    each_wavelength(is_run(i.a),
                    [&](int k, int n) { map<F>(at<R>(i.dst) + k * n_, n, component(i.a, k)); });
  }
  template <class F>
  void binary_s(const In& i) {
    const bool same_a = i.a.base() == Operand::Constant, same_b = i.b.base() == Operand::Constant;
    const bool once = runs_through(i.a) && runs_through(i.b) && !(same_a && same_b);
    each_wavelength(once, [&](int k, int n) {
      R* const d = at<R>(i.dst) + k * n_;
      const Block<R> a = component(i.a, k), b = component(i.b, k);
      if (same_a)
        map<F>(d, n, Same<R>{a[0]}, b);
      else if (same_b)
        map<F>(d, n, a, Same<R>{b[0]});
      else
        map<F>(d, n, a, b);
    });
  }
  void fma_s(const In& i) {
    const bool once = is_run(i.a) && runs_through(i.b) && runs_through(i.c);
    each_wavelength(once, [&](int k, int n) {
      map_last2<Fma>(at<R>(i.dst) + k * n_, component(i.a, k), component(i.b, k), component(i.c, k),
                     i, n);
    });
  }
  void select_s(const In& i) {
    for (int k = 0; k < kWavelengths; ++k)
      map_last2<Select>(at<R>(i.dst) + k * n_, Block<int32_t>{at<const int32_t>(i.a)},
                        component(i.b, k), component(i.c, k), i, n_);
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
    const bool once = s.uniform && m_.uniform;
    for (uint32_t r = 0; r < s.repeats; ++r) {
      for (uint32_t k = 0; k < s.args; ++k) m_.in[k] = at<const void>(*arg++);
      for (uint32_t k = 0; k < s.results; ++k) m_.out[k] = at<void>(*result++);
      const int lanes = once ? kLaneMultiple : n_;
      if (const auto kernel = sizeof(R) == sizeof(float) ? s.image32 : s.image64)
        kernel(m_.images, m_.image_count, m_.in, m_.out, lanes);
      else
        (sizeof(R) == sizeof(float) ? s.f32 : s.f64)(m_.in, m_.out, lanes);
      for (uint32_t k = 0; once && k < s.results; ++k) spread(static_cast<int32_t*>(m_.out[k]));
    }
  }
  /// The first cell of a block to all its lanes. Only where all cells have one size.
  void spread(int32_t* block) {
    for (int k = kLaneMultiple; k < n_; ++k) block[k] = block[0];
  }

  void give_up(int lane, Fault::Cause cause, SourceLine line) {
    m_.faults[m_.fault_count++] = Fault{cause, lane, line};
    m_.alive[lane] = 0;
    m_.spent[lane] = 0;
  }
  /// Takes lanes that were given up out of every mask of this frame.
  void sweep() {
    for (uint32_t k = 0; k < f_.masks; ++k)
      map<And>(mask(k), n_, Block<int32_t>{mask(k)}, Block<int32_t>{m_.alive});
  }
  /// One more back edge or recursive call for the lanes of `lanes`.
  void spend(const int32_t* lanes, SourceLine line) {
    if (!count(m_.spent, lanes, m_.back_edges, n_)) return;
    for (int i = 0; i < n_; ++i)
      if (lanes[i] && m_.spent[i] > m_.back_edges) give_up(i, Fault::Cause::BackEdges, line);
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
    map<Or>(mask(1), n_, Block<int32_t>{mask(1)}, Block<int32_t>{lanes});
  }
  /// Whether lanes start again here; those are then the lanes that run.
  bool restart() {
    const int left = move_mask(mask(0), mask(1), n_);
    if (left == 0) return false;
    if (sizeof(R) != sizeof(int32_t) || lanes_of(left) * 2 > n_) return true;
    run_compacted(lanes_of(left));
    return false;
  }
  static int lanes_of(int lanes) { return (lanes + kLaneMultiple - 1) & -kLaneMultiple; }

  /// Runs the lanes that start again to their end side by side, as a batch of `n` lanes, and puts
  /// their results where the others' are. Only parameters and inputs live across a back edge.
  /// Only where all cells have one size: not in the double machine.
  void run_compacted(int n) {
    const uint32_t results = f_.result_blocks, first_param = f_.result_blocks;
    const std::size_t block = std::size_t(n) * sizeof(int32_t), input_blocks = f_.input_end;
    const std::size_t bytes = block * (3 + input_blocks + f_.masks + f_.blocks);
    std::byte* const memory = m_.push_frame(m_.frames, bytes);
    int32_t* const lanes = reinterpret_cast<int32_t*>(memory);
    const int left = list(lanes, n);
    const Machine outer = m_;
    m_.lanes = n;
    m_.spent = lanes + n;
    m_.alive = lanes + 2 * n;
    m_.inputs = memory + 3 * block;
    m_.input_stride = block;
    gather(m_.spent, outer.spent, lanes, n);
    gather(m_.alive, outer.alive, lanes, n);
    for (uint32_t k = 0; k < f_.inputs; ++k) {
      const Operand o = m_.operands[f_.first_input + k];
      gather(cells(m_.inputs + o.index() * block), at<int32_t>(o), lanes, n);
    }
    Frame inner(m_, uint32_t(&f_ - m_.functions), m_.inputs + input_blocks * block, depth_);
    for (int k = 0; k < n; ++k) inner.mask(0)[k] = k < left;
    for (uint32_t k = first_param; k < first_param + f_.param_blocks; ++k)
      gather(cells(inner.slot(k)), cells(slot(k)), lanes, n);
    inner.run();
    for (uint32_t k = 0; k < results; ++k)
      scatter(cells(slot(k)), cells(inner.slot(k)), lanes, left);
    scatter(outer.spent, m_.spent, lanes, left);
    scatter(outer.alive, m_.alive, lanes, left);
    for (int k = outer.fault_count; k < m_.fault_count; ++k)
      m_.faults[k].lane = lanes[m_.faults[k].lane];
    m_.lanes = outer.lanes;
    m_.spent = outer.spent;
    m_.alive = outer.alive;
    m_.inputs = outer.inputs;
    m_.input_stride = outer.input_stride;
    m_.pop_frame(m_.frames, bytes);
  }
  static int32_t* cells(std::byte* block) { return reinterpret_cast<int32_t*>(block); }
  /// Lists the lanes that start again, and for padding up to `n` the first of them; how many.
  int list(int32_t* lanes, int n) const {
    int left = 0;
    for (int i = 0; i < n_; ++i)
      if (mask(0)[i]) lanes[left++] = i;
    for (int k = left; k < n; ++k) lanes[k] = lanes[0];
    return left;
  }

  /// The code once, from its start to its end; telling the watcher of each instruction, if watched.
  template <bool watched>
  void pass();

  Machine& m_;
  const LoweredFunction& f_;
  int n_, depth_;
  std::byte* base_[4];
  std::size_t stride_[4];
};

template <class R>
template <bool watched>
void Frame<R>::pass() {
  const LoweredInstruction* code = m_.code;
  for (uint32_t pc = f_.begin;; ++pc) {
    const In& i = code[pc];
    if constexpr (watched) m_.watch(m_.watcher, pc);
    switch (i.op) {
#define KERNEL(op, ...)    \
  case LoweredOp::op:      \
    apply<__VA_ARGS__>(i); \
    break;
#include "vm/kernels.def"
#undef KERNEL
#define PAIR(first, second, position, constants)                       \
  case LoweredOp::first##_##second##_##position##_##constants:         \
    pair<LoweredOp::first, LoweredOp::second, position, constants>(i); \
    break;
#include "vm/pairs.def"
#undef PAIR

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
      case LoweredOp::Component:
      case LoweredOp::Pack:
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
