// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What is fuzzed: functions that take any bytes and return. A finding is what a sanitizer, an
/// assertion, a time limit or a memory limit says. tests/fuzz/entry.cpp hands one of them to
/// libFuzzer; tests/fuzz/replay_test.cpp runs all of them over the kept inputs.

#include <cstdint>
#include <span>

namespace mms::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// The bytes as a script: every token, the Graph, and each message in all its renderings.
void parse(Bytes input);

/// The bytes as a script, linked with the standard library. The last byte, which is most often
/// white space, chooses the level: tab O0, newline O1, space O2.
void link(Bytes input);

/// The bytes as a stored program: as they are, and with a header that is right. A program that is
/// accepted is run, in both machines: its values must be written before they are read.
void load(Bytes input);

struct Target {
  const char* name;  ///< also the folder of its kept inputs
  void (*run)(Bytes);
};
inline constexpr Target kTargets[] = {{"parse", parse}, {"link", link}, {"load", load}};

}  // namespace mms::fuzz
