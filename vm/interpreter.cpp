// SPDX-License-Identifier: Apache-2.0
#include "vm/interpreter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <new>

#include "vm/lower.h"
#include "vm/machine.h"
#include "vm/uniform.h"

namespace mms::vm {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kChunkBytes = std::size_t(1) << 16;
constexpr int kWorkingSetBytes = 192 * 1024;  // well within an L2 cache
constexpr int kLeastWidth = 32, kMostWidth = 512;

constexpr int round_up(int lanes) {
  return (lanes + kLaneMultiple - 1) / kLaneMultiple * kLaneMultiple;
}

/// Zeroed memory, aligned to a cache line.
class Memory {
 public:
  Memory() = default;
  explicit Memory(std::size_t bytes)
      : size_(bytes),
        data_(static_cast<std::byte*>(::operator new(bytes, std::align_val_t(kCacheLine)))) {
    std::memset(data_.get(), 0, bytes);
  }
  std::byte* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Delete {
    void operator()(std::byte* p) const { ::operator delete(p, std::align_val_t(kCacheLine)); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<std::byte, Delete> data_;
};

/// Frames of open calls, in chunks that are kept.
class Frames {
 public:
  void reset() {
    for (Chunk& c : chunks_) c.used = 0;
    current_ = 0;
  }
  std::byte* push(std::size_t bytes) {
    if (chunks_.empty()) chunks_.push_back({Memory(std::max(bytes, kChunkBytes)), 0});
    if (chunks_[current_].memory.size() - chunks_[current_].used < bytes) next(bytes);
    Chunk& c = chunks_[current_];
    std::byte* p = c.memory.data() + c.used;
    c.used += bytes;
    return p;
  }
  void pop(std::size_t bytes) {
    chunks_[current_].used -= bytes;
    if (chunks_[current_].used == 0 && current_ > 0) --current_;
  }

 private:
  struct Chunk {
    Memory memory;
    std::size_t used;
  };
  void next(std::size_t bytes) {
    if (chunks_[current_].used != 0) ++current_;
    if (current_ == chunks_.size()) chunks_.emplace_back();
    if (chunks_[current_].memory.size() < bytes)
      chunks_[current_] = {Memory(std::max(bytes, kChunkBytes)), 0};
  }
  std::vector<Chunk> chunks_;
  std::size_t current_ = 0;
};

/// First block of each machine input.
constexpr auto kInputBlocks = [] {
  std::array<int, input_count() + 1> blocks{};
  for (int i = 0; i < input_count(); ++i) blocks[i + 1] = blocks[i] + block_count(input_type(i));
  return blocks;
}();

bool use_avx2(Isa isa) {
#if defined(__x86_64__)
  return isa == Isa::Best && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false && isa == Isa::Best;
#endif
}

template <class R>
void execute(bool avx2, Machine& m, std::uint32_t function, std::byte* frame) {
#if defined(__x86_64__)
  if (avx2) return avx2::execute(R(), m, function, frame, 0);
#endif
  (void)avx2;
  baseline::execute(R(), m, function, frame, 0);
}

/// Whether the first lanes have one value of what belongs to the frame. The double machine, whose
/// lanes have different sizes, never asks.
bool is_uniform(const InputBatch<float>& in, int lanes) {
  const float* v = in.data() + input_block(input_index(kUniformVariable)) * round_up(in.width());
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return std::all_of(v, v + lanes, [&](float x) { return bits(x) == bits(v[0]); });
}
bool is_uniform(const InputBatch<double>&, int) { return false; }

}  // namespace

Executable::Executable(const Program& program)
    : code_(std::make_unique<const LoweredCode>(lower(program))) {}
Executable::~Executable() = default;
Executable::Executable(Executable&&) noexcept = default;
Executable& Executable::operator=(Executable&&) noexcept = default;

int Executable::width() const {
  const std::uint32_t blocks = std::max(code_->frame_blocks, 1u);
  const int fit = int(kWorkingSetBytes / (sizeof(float) * blocks));
  return std::clamp(fit / kLaneMultiple * kLaneMultiple, kLeastWidth, kMostWidth);
}

template <class R>
InputBatch<R>::InputBatch(int width)
    : width_(width), data_(std::size_t(kInputBlocks.back()) * round_up(width)) {}

template <class R>
R* InputBatch<R>::lanes(Variable v, int c) {
  const int block = info(v).slot_type() == SlotType::Spectrum ? kInputBlocks[input_index(v)] + c
                                                              : kInputBlocks[input_index(v, c)];
  return data_.data() + std::size_t(block) * round_up(width_);
}

template <class R>
struct Interpreter<R>::State {
  /// The constants of one executable, each in all lanes of a block.
  struct Constants {
    std::weak_ptr<const char> identity;  ///< lest interpreters keep what others have seen
    Memory blocks;

    bool are_of(const LoweredCode& code) const {
      return !identity.owner_before(code.identity) && !code.identity.owner_before(identity);
    }
  };

  int width;
  bool avx2;
  Frames frames;
  std::vector<Constants> constants;
  std::vector<std::int32_t> spent, alive;
  std::vector<Fault> faults;
  std::vector<const void*> in;
  std::vector<void*> out;
  Machine machine{};
  // of the last run:
  const std::byte* result_base = nullptr;
  const LoweredResult* results = nullptr;

  /// The constant blocks of `code`, made when it is first seen.
  std::byte* prepare(const LoweredCode& code);
  std::byte* enter(const LoweredFunction& f, int lanes);
  void clear_faulted(const std::vector<LoweredResult>& of);
  std::byte* result_block(std::uint32_t slot) const {
    return const_cast<std::byte*>(result_base) + std::size_t(slot) * machine.lanes * sizeof(R);
  }
};

template <class R>
std::byte* Interpreter<R>::State::prepare(const LoweredCode& code) {
  for (const Constants& c : constants)
    if (c.are_of(code)) return c.blocks.data();
  std::erase_if(constants, [](const Constants& c) { return c.identity.expired(); });
  in.resize(std::max<std::size_t>(in.size(), code.builtin_blocks));
  out.resize(std::max<std::size_t>(out.size(), code.builtin_blocks));
  Memory blocks(code.constants.size() * width * sizeof(R));
  for (std::size_t k = 0; k < code.constants.size(); ++k) {
    const Constant& c = code.constants[k];
    std::byte* block = blocks.data() + k * width * sizeof(R);
    if (c.type == SlotType::Real)
      std::fill_n(reinterpret_cast<R*>(block), width,
                  sizeof(R) == sizeof(float) ? R(c.f32) : R(c.f64));
    else
      std::fill_n(reinterpret_cast<std::int32_t*>(block), width, c.integer);
  }
  constants.push_back({code.identity, std::move(blocks)});
  return constants.back().blocks.data();
}

/// A frame for the entry function, with the first `lanes` lanes running.
template <class R>
std::byte* Interpreter<R>::State::enter(const LoweredFunction& f, int lanes) {
  const int n = machine.lanes;
  if (f.calls) {
    std::fill_n(spent.begin(), n, 0);
    std::fill_n(alive.begin(), n, 1);
  }
  frames.reset();
  std::byte* frame = frames.push(frame_bytes<R>(f, n));
  std::int32_t* running = reinterpret_cast<std::int32_t*>(frame);
  if (f.masked) {
    std::fill_n(running, lanes, 1);
    std::fill(running + lanes, running + n, 0);
  }
  result_base = frame + std::size_t(f.masks) * n * sizeof(std::int32_t);
  return frame;
}

template <class R>
void Interpreter<R>::State::clear_faulted(const std::vector<LoweredResult>& of) {
  for (int k = 0; k < machine.fault_count; ++k)
    for (const LoweredResult& r : of)
      for (int b = 0; b < block_count(r.type); ++b) {
        std::byte* block = result_block(r.slot + b);
        if (r.type == SlotType::Real || r.type == SlotType::Spectrum)
          reinterpret_cast<R*>(block)[faults[k].lane] = 0;
        else
          reinterpret_cast<std::int32_t*>(block)[faults[k].lane] = 0;
      }
}

template <class R>
Interpreter<R>::Interpreter(int width, Isa isa) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.width = round_up(width);
  s.avx2 = use_avx2(isa);
  s.spent.resize(s.width);
  s.alive.resize(s.width);
  s.faults.resize(s.width);
}
template <class R>
Interpreter<R>::~Interpreter() = default;
template <class R>
Interpreter<R>::Interpreter(Interpreter&&) noexcept = default;
template <class R>
Interpreter<R>& Interpreter<R>::operator=(Interpreter&&) noexcept = default;

template <class R>
void Interpreter<R>::run(const Executable& exe, std::uint32_t function, const InputBatch<R>& in,
                         int lanes, const RunOptions& options) {
  State& s = *state_;
  const LoweredCode& code = exe.code();
  assert(function < code.functions.size() && code.functions[function].param_blocks == 0);
  assert(1 <= lanes && lanes <= in.width() && lanes <= s.width);
  const LoweredFunction& f = code.functions[function];
  Machine& m = s.machine;
  m.constants = s.prepare(code);
  m.constant_stride = std::size_t(s.width) * sizeof(R);
  m.code = code.instructions.data();
  m.lines = code.lines.data();
  m.functions = code.functions.data();
  m.sites = code.sites.data();
  m.operands = code.operands.data();
  m.images = code.image_table.data();
  m.image_count = int(code.image_table.size());
  m.inputs = reinterpret_cast<std::byte*>(const_cast<R*>(in.data()));  // only read
  m.input_stride = std::size_t(round_up(in.width())) * sizeof(R);
  m.lanes = round_up(lanes);
  m.uniform = code.uniform_sites && is_uniform(in, lanes);
  m.spent = s.spent.data();
  m.alive = s.alive.data();
  m.faults = s.faults.data();
  m.fault_count = 0;
  m.back_edges = options.back_edges;
  m.in = s.in.data();
  m.out = s.out.data();
  m.open_blocks = f.masks + f.blocks;
  m.frames = &s.frames;
  m.push_frame = [](void* frames, std::size_t bytes) {
    return static_cast<Frames*>(frames)->push(bytes);
  };
  m.pop_frame = [](void* frames, std::size_t bytes) { static_cast<Frames*>(frames)->pop(bytes); };
  execute<R>(s.avx2, m, function, s.enter(f, lanes));
  s.results = code.results[function].data();
  s.clear_faulted(code.results[function]);
}

template <class R>
void Interpreter<R>::observe(void (*watch)(void*, std::uint32_t), void* watcher) {
  state_->machine.watch = watch;
  state_->machine.watcher = watcher;
}

template <class R>
const R* Interpreter<R>::result(int k, int c) const {
  return reinterpret_cast<const R*>(state_->result_block(state_->results[k].slot + c));
}

template <class R>
const std::int32_t* Interpreter<R>::integer_result(int k) const {
  return reinterpret_cast<const std::int32_t*>(state_->result_block(state_->results[k].slot));
}

template <class R>
std::span<const Fault> Interpreter<R>::faults() const {
  return {state_->faults.data(), std::size_t(state_->machine.fault_count)};
}

template class InputBatch<float>;
template class InputBatch<double>;
template class Interpreter<float>;
template class Interpreter<double>;

}  // namespace mms::vm
