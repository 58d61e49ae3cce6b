// SPDX-License-Identifier: Apache-2.0
#include "vm/trace.h"

#include <algorithm>
#include <cmath>

#include "vm/limits.h"

namespace mms::vm {
namespace {

#include "vm/kernels.h"

template <class R>
class Tracer {
 public:
  Tracer(const Program& program, InputBatch<R>& in, int lane, std::size_t most)
      : program_(program), in_(in), lane_(lane), most_(most) {
    for (const ProgramImage& i : program.images) images_.push_back(i.image.get());
  }

  Trace run(std::uint32_t function) {
    const std::vector<Cell> results = call(function, {}, 0);
    if (!trace_.fault)
      for (const Cell& c : results) trace_.results.push_back(traced(c));
    return std::move(trace_);
  }

 private:
  struct Cell {
    SlotType type = SlotType::Real;
    R r[kWavelengths] = {};
    int32_t i = 0;
    int origin = -1;
  };
  using Stack = std::vector<Cell>;

  /// Where the machine stands.
  struct Place {
    std::uint32_t function;
    std::size_t pc;
    int depth;
  };

  static bool real(SlotType t) { return t == SlotType::Real || t == SlotType::Spectrum; }
  static bool finite(const Cell& c) {
    if (!real(c.type)) return true;
    return std::all_of(c.r, c.r + block_count(c.type), [](R x) { return std::isfinite(x); });
  }
  static TracedValue traced(const Cell& c) {
    TracedValue v{c.type, {}, c.i, c.origin};
    std::copy(std::begin(c.r), std::end(c.r), std::begin(v.real));
    return v;
  }
  SourceLine line(const Place& at) const { return program_.functions[at.function].lines[at.pc]; }

  /// Notes that `c` was made here of `operands`, and whose fault it is if it is not finite.
  void note(const Place& at, Cell& c, const Cell* operands, std::size_t count) {
    if (!finite(c)) {
      bool all_finite = true;
      for (std::size_t k = 0; k < count; ++k) {
        if (finite(operands[k])) continue;
        all_finite = false;
        if (c.origin < 0) c.origin = operands[k].origin;
      }
      if (all_finite) c.origin = static_cast<int>(trace_.origins.size());
    }
    TraceStep step{at.function, static_cast<std::uint32_t>(at.pc), line(at), at.depth, traced(c)};
    if (c.origin == static_cast<int>(trace_.origins.size())) trace_.origins.push_back(step);
    if (trace_.step_count++ < most_) trace_.steps.push_back(std::move(step));
  }

  Cell input(std::uint32_t index) {
    const Variable v = input_variable(static_cast<int>(index));
    const int first = static_cast<int>(index) - input_index(v);
    Cell c;
    c.type = info(v).slot_type();
    for (int k = 0; k < block_count(c.type); ++k) c.r[k] = in_.lanes(v, first + k)[lane_];
    return c;
  }
  Cell constant(const Constant& k) const {
    Cell c;
    c.type = k.type;
    c.r[0] = sizeof(R) == sizeof(float) ? R(k.f32) : R(k.f64);
    c.i = k.integer;
    return c;
  }

  template <class F>
  static Cell unary(SlotType type, const Cell& a) {
    Cell c;
    c.type = type;
    for (int k = 0; k < block_count(type); ++k) c.r[k] = F::eval(a.r[k]);
    return c;
  }
  template <class F>
  static Cell binary(SlotType type, const Cell& a, const Cell& b) {
    Cell c;
    c.type = type;
    for (int k = 0; k < block_count(type); ++k) c.r[k] = F::eval(a.r[k], b.r[k]);
    return c;
  }
  static Cell fused(SlotType type, const Cell& a, const Cell& b, const Cell& x) {
    Cell c;
    c.type = type;
    for (int k = 0; k < block_count(type); ++k) c.r[k] = Fma::eval(a.r[k], b.r[k], x.r[k]);
    return c;
  }
  static Cell whole(SlotType type, int32_t i) {
    Cell c;
    c.type = type;
    c.i = i;
    return c;
  }
  static Cell splat(const Cell& a) {
    Cell c;
    c.type = SlotType::Spectrum;
    std::fill(std::begin(c.r), std::end(c.r), a.r[0]);
    return c;
  }
  static Cell pack(const Cell* parts) {
    Cell c;
    c.type = SlotType::Spectrum;
    for (int k = 0; k < kWavelengths; ++k) c.r[k] = parts[k].r[0];
    return c;
  }
  static Cell of_real(R x) {
    Cell c;
    c.r[0] = x;
    return c;
  }

  /// What an instruction without side effects makes of its operands.
  static Cell value(const Instruction& in, const Cell* o) {
    constexpr SlotType kReal = SlotType::Real, kInt = SlotType::Integer, kLogic = SlotType::Logic,
                       kSpectrum = SlotType::Spectrum;
    switch (in.op) {
      case Op::AddR:
        return binary<Add>(kReal, o[0], o[1]);
      case Op::SubR:
        return binary<Sub>(kReal, o[0], o[1]);
      case Op::MulR:
        return binary<Mul>(kReal, o[0], o[1]);
      case Op::DivR:
        return binary<Div>(kReal, o[0], o[1]);
      case Op::ModR:
        return binary<Mod>(kReal, o[0], o[1]);
      case Op::NegR:
        return unary<Neg>(kReal, o[0]);
      case Op::FmaR:
        return fused(kReal, o[0], o[1], o[2]);
      case Op::AddS:
        return binary<Add>(kSpectrum, o[0], o[1]);
      case Op::SubS:
        return binary<Sub>(kSpectrum, o[0], o[1]);
      case Op::MulS:
        return binary<Mul>(kSpectrum, o[0], o[1]);
      case Op::DivS:
        return binary<Div>(kSpectrum, o[0], o[1]);
      case Op::NegS:
        return unary<Neg>(kSpectrum, o[0]);
      case Op::FmaS:
        return fused(kSpectrum, o[0], o[1], o[2]);
      case Op::Splat:
        return splat(o[0]);
      case Op::Component:
        return of_real(o[0].r[in.a]);
      case Op::Pack:
        return pack(o);
      case Op::AddI:
        return whole(kInt, AddWrap::eval(o[0].i, o[1].i));
      case Op::SubI:
        return whole(kInt, SubWrap::eval(o[0].i, o[1].i));
      case Op::MulI:
        return whole(kInt, MulWrap::eval(o[0].i, o[1].i));
      case Op::ModI:
        return whole(kInt, ModFloored::eval(o[0].i, o[1].i));
      case Op::NegI:
        return whole(kInt, NegWrap::eval(o[0].i));
      case Op::RealOfInt:
        return of_real(ToReal<R>::eval(o[0].i));
      case Op::IntOfReal:
        return whole(kInt, Truncate::eval(o[0].r[0]));
      case Op::LtR:
        return whole(kLogic, Lt::eval(o[0].r[0], o[1].r[0]));
      case Op::LeR:
        return whole(kLogic, Le::eval(o[0].r[0], o[1].r[0]));
      case Op::EqR:
        return whole(kLogic, Eq::eval(o[0].r[0], o[1].r[0]));
      case Op::NeR:
        return whole(kLogic, Ne::eval(o[0].r[0], o[1].r[0]));
      case Op::LtI:
        return whole(kLogic, Lt::eval(o[0].i, o[1].i));
      case Op::LeI:
        return whole(kLogic, Le::eval(o[0].i, o[1].i));
      case Op::EqI:
        return whole(kLogic, Eq::eval(o[0].i, o[1].i));
      case Op::NeI:
        return whole(kLogic, Ne::eval(o[0].i, o[1].i));
      case Op::And:
        return whole(kLogic, And::eval(o[0].i, o[1].i));
      case Op::Or:
        return whole(kLogic, Or::eval(o[0].i, o[1].i));
      case Op::Not:
        return whole(kLogic, Not::eval(o[0].i));
      case Op::SelectR:
      case Op::SelectI:
      case Op::SelectL:
      case Op::SelectS:
        return o[0].i ? o[1] : o[2];
      case Op::PushConst:
      case Op::PushInput:
      case Op::LoadLocal:
      case Op::StoreLocal:
      case Op::If:
      case Op::Else:
      case Op::End:
      case Op::Call:
      case Op::CallBuiltin:
      case Op::CallSpectral:
      case Op::TailCall:
      case Op::Return:
        break;
    }
    return {};
  }

  static Stack pop(Stack& stack, std::size_t count) {
    Stack top(stack.end() - static_cast<std::ptrdiff_t>(count), stack.end());
    stack.resize(stack.size() - count);
    return top;
  }

  /// One call of a kernel, every lane of it with the same arguments.
  void kernel(const Builtin& row, const Stack& args, int component, Stack& results) {
    struct alignas(64) Block {
      R r[kLaneMultiple];
      int32_t i[kLaneMultiple];
    };
    std::vector<Block> in(args.size()), out(results.size());
    std::vector<const void*> in_pointers(args.size() + 1);
    std::vector<void*> out_pointers(results.size() + 1);
    for (std::size_t k = 0; k < args.size(); ++k) {
      const bool spectrum = args[k].type == SlotType::Spectrum;
      std::fill_n(in[k].r, kLaneMultiple, args[k].r[spectrum ? component : 0]);
      std::fill_n(in[k].i, kLaneMultiple, args[k].i);
      in_pointers[k] = real(args[k].type) ? static_cast<const void*>(in[k].r) : in[k].i;
    }
    for (std::size_t k = 0; k < results.size(); ++k)
      out_pointers[k] = real(results[k].type) ? static_cast<void*>(out[k].r) : out[k].i;
    if (const auto look_up = sizeof(R) == sizeof(float) ? row.image32 : row.image64)
      look_up(images_.data(), int(images_.size()), in_pointers.data(), out_pointers.data(),
              kLaneMultiple);
    else
      (sizeof(R) == sizeof(float) ? row.f32 : row.f64)(in_pointers.data(), out_pointers.data(),
                                                       kLaneMultiple);
    for (std::size_t k = 0; k < results.size(); ++k)
      real(results[k].type) ? void(results[k].r[component] = out[k].r[0])
                            : void(results[k].i = out[k].i[0]);
  }
  void builtin(const Place& at, const Instruction& in, Stack& stack) {
    const Stack args = pop(stack, program_.builtin_params[in.a].size());
    Stack results;
    for (SlotType t : program_.builtin_results[in.a]) results.emplace_back().type = t;
    if (in.op == Op::CallSpectral) results[0].type = SlotType::Spectrum;
    const int repeats = in.op == Op::CallSpectral ? kWavelengths : 1;
    for (int k = 0; k < repeats; ++k) kernel(*program_.builtins[in.a], args, k, results);
    for (Cell& c : results) note(at, c, args.data(), args.size());
    stack.insert(stack.end(), results.begin(), results.end());
  }

  /// From behind an If or Else to behind the Else or End of the same nesting.
  static std::size_t behind_arm(const Function& f, std::size_t pc) {
    for (int depth = 0;; ++pc) {
      const Op op = f.code[pc].op;
      if (depth == 0 && (op == Op::Else || op == Op::End)) return pc + 1;
      depth += (op == Op::If) - (op == Op::End);
    }
  }

  bool spend(const Place& at) {
    if (++spent_ <= limits::kBackEdges) return true;
    trace_.fault = Fault{Fault::Cause::BackEdges, lane_, line(at)};
    return false;
  }

  std::vector<Cell> call(std::uint32_t function, Stack args, int depth) {
    const Function& f = program_.functions[function];
    Stack locals = std::move(args), stack;
    locals.resize(f.locals.size());
    for (std::size_t pc = 0; !trace_.fault; ++pc) {
      const Instruction& in = f.code[pc];
      const Place at{function, pc, depth};
      switch (in.op) {
        case Op::PushConst:
          stack.push_back(constant(program_.constants[in.a]));
          break;
        case Op::PushInput:
          stack.push_back(input(in.a));
          note(at, stack.back(), &stack.back(), 1);
          break;
        case Op::LoadLocal:
          stack.push_back(locals[in.a]);
          break;
        case Op::StoreLocal:
          locals[in.a] = pop(stack, 1)[0];
          break;
        case Op::If:
          if (!pop(stack, 1)[0].i) pc = behind_arm(f, pc + 1) - 1;
          break;
        case Op::Else:
          pc = behind_arm(f, pc + 1) - 1;
          break;
        case Op::End:
          break;
        case Op::Call: {
          if (depth >= limits::kCallDepth) {
            trace_.fault = Fault{Fault::Cause::CallDepth, lane_, line(at)};
            break;
          }
          if (!spend(at)) break;
          Stack inner = pop(stack, program_.functions[in.a].params.size());
          const Stack results = call(in.a, std::move(inner), depth + 1);
          stack.insert(stack.end(), results.begin(), results.end());
          break;
        }
        case Op::CallBuiltin:
        case Op::CallSpectral:
          builtin(at, in, stack);
          break;
        case Op::TailCall:
          if (!spend(at)) break;
          locals = pop(stack, f.params.size());
          locals.resize(f.locals.size());
          stack.clear();
          pc = std::size_t(-1);
          break;
        case Op::Return:
          return pop(stack, f.results.size());
        default: {
          const Stack operands = pop(stack, info(in.op).pops.size());
          Cell c = value(in, operands.data());
          // What is chosen keeps its origin; what is not chosen has no part in it.
          const bool chosen = info(in.op).pops.starts_with('l') && real(c.type);
          note(at, c, chosen ? &c : operands.data(), chosen ? 1 : operands.size());
          stack.push_back(c);
        }
      }
    }
    return {};
  }

  const Program& program_;
  std::vector<const Image*> images_;
  InputBatch<R>& in_;
  int lane_;
  std::size_t most_;
  int spent_ = 0;
  Trace trace_;
};

}  // namespace

template <class R>
Trace trace(const Program& program, std::uint32_t function, InputBatch<R>& in, int lane,
            std::size_t most) {
  return Tracer<R>(program, in, lane, most).run(function);
}

template Trace trace(const Program&, std::uint32_t, InputBatch<float>&, int, std::size_t);
template Trace trace(const Program&, std::uint32_t, InputBatch<double>&, int, std::size_t);

}  // namespace mms::vm
