// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <vector>

#include "api/inputs.h"
#include "api/library.h"
#include "tests/fuzz/targets.h"
#include "vm/interpreter.h"
#include "vm/serialise.h"
#include "vm/verify.h"

namespace mms::fuzz {

namespace {

constexpr int kLanes = 20;  // a remainder is left
/// A lane that recurses for ever is given up soon, and as the others are.
constexpr vm::RunOptions kOptions{.back_edges = 40};

/// Every value that the last run of a function left, as bytes.
template <class R>
std::vector<unsigned char> values(const vm::Interpreter<R>& machine, const vm::Function& f) {
  std::vector<unsigned char> bytes;
  const auto add = [&](const auto* block) {
    const auto* data = reinterpret_cast<const unsigned char*>(block);
    bytes.insert(bytes.end(), data, data + kLanes * sizeof *block);
  };
  for (std::size_t k = 0; k < f.results.size(); ++k) {
    const int slot = static_cast<int>(k);
    if (f.results[k] == vm::SlotType::Integer || f.results[k] == vm::SlotType::Logic)
      add(machine.integer_result(slot));
    else
      for (int c = 0; c < vm::block_count(f.results[k]); ++c) add(machine.result(slot, c));
  }
  return bytes;
}

/// Runs a function on a new machine and on one that has run before: what is read before it is
/// written shows as a difference.
template <class R>
void run(const vm::Program& program, const vm::Executable& executable, std::uint32_t function,
         vm::Interpreter<R>& used) {
  vm::InputBatch<R> in(kLanes);
  api::fill_defaults(in);
  for (int i = 0; i < kLanes; ++i)
    in.lanes(vm::Variable::Position)[i] = static_cast<R>(i - kLanes / 2) / 4;
  vm::InputBatch<R> elsewhere(kLanes);
  for (int i = 0; i < kLanes; ++i) elsewhere.lanes(vm::Variable::Position)[i] = R(i);
  const vm::Function& f = program.functions[function];
  vm::Interpreter<R> fresh(kLanes);
  fresh.run(executable, function, in, kLanes, kOptions);
  used.run(executable, function, elsewhere, kLanes, kOptions);
  used.run(executable, function, in, kLanes, kOptions);
  if (values(fresh, f) != values(used, f)) __builtin_trap();
}

}  // namespace

void load(Bytes input) {
  std::vector<std::byte> file(std::max(input.size(), vm::kHeaderBytes));
  std::copy(input.begin(), input.end(), reinterpret_cast<std::uint8_t*>(file.data()));
  const auto library = api::standard_library().builtins;
  (void)vm::load(std::as_bytes(input), library);
  std::memcpy(file.data(), vm::kMagic.data(), vm::kMagic.size());
  const std::uint32_t format = vm::kFormat;
  std::memcpy(file.data() + vm::kMagic.size(), &format, sizeof format);
  vm::seal(file);
  const auto package = vm::load(file, library);
  if (!package) {
    if (package.error().what.empty()) __builtin_trap();
    return;
  }
  if (vm::save(*package, library).size() > file.size()) __builtin_trap();
  const vm::Program& program = package->program;
  vm::disassemble(program);
  const vm::Executable executable(program);
  vm::Interpreter<float> f32(kLanes);
  vm::Interpreter<double> f64(kLanes);
  for (std::uint32_t k = 0; k < program.functions.size(); ++k) {
    if (!program.functions[k].params.empty()) continue;
    run(program, executable, k, f32);
    run(program, executable, k, f64);
  }
}

}  // namespace mms::fuzz
