// SPDX-License-Identifier: Apache-2.0
#include "vm/profile.h"

#include <algorithm>
#include <map>

#include "vm/lower.h"

namespace mms::vm {

Profile::Profile(const Executable& exe) : exe_(exe), costs_(exe.code().instructions.size()) {
  constexpr int kReads = 1000;
  double least = 1;
  for (int round = 0; round < 10; ++round) {
    const auto start = Clock::now();
    for (int k = 0; k < kReads; ++k) last_ = Clock::now();
    least = std::min(least, std::chrono::duration<double>(last_ - start).count() / kReads);
  }
  clock_seconds_ = least;
}

void Profile::watch(void* self, std::uint32_t instruction) {
  static_cast<Profile*>(self)->see(instruction);
}

void Profile::see(std::uint32_t instruction) {
  const auto now = Clock::now();
  if (any_) {
    const double seconds = std::chrono::duration<double>(now - last_).count() - clock_seconds_;
    costs_[running_].seconds += std::max(seconds, 0.0);
    ++costs_[running_].runs;
  }
  any_ = true;
  running_ = instruction;
  last_ = Clock::now();
}

template <class R>
void Profile::run(Interpreter<R>& machine, std::uint32_t function, const InputBatch<R>& in,
                  int lanes) {
  any_ = false;
  machine.observe(&Profile::watch, this);
  machine.run(exe_, function, in, lanes);
  machine.observe(nullptr, nullptr);
  see(running_);  // the last one
}

template void Profile::run(Interpreter<float>&, std::uint32_t, const InputBatch<float>&, int);
template void Profile::run(Interpreter<double>&, std::uint32_t, const InputBatch<double>&, int);

std::vector<Profile::LineCost> Profile::by_line() const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, LineCost> lines;
  double total = 0;
  for (std::size_t k = 0; k < costs_.size(); ++k) {
    const SourceLine at = exe_.code().lines[k];
    LineCost& line = lines[{at.source, at.line}];
    line.line = {at.source, at.line};
    line.seconds += costs_[k].seconds;
    ++line.instructions;
    total += costs_[k].seconds;
  }
  std::vector<LineCost> all;
  for (auto& [at, line] : lines) {
    line.share = total > 0 ? line.seconds / total : 1 / double(lines.size());
    all.push_back(line);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const LineCost& a, const LineCost& b) { return a.seconds > b.seconds; });
  return all;
}

}  // namespace mms::vm
