// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Integer mixing. Every random number of a render comes from these and a sequence's matrices:
/// nothing owns a random state.

#include <cstdint>
#include <cstring>
#include <span>

namespace mms {

/// Bijective 64-bit mixer (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) {
  return mix64(a ^ mix64(b));
}

/// Of bytes, eight at a time. Not for adversaries: it tells mistakes, not forgeries.
inline std::uint64_t hash_bytes(std::span<const char> bytes, std::uint64_t start = 0) {
  std::uint64_t h = hash_combine(start, bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, bytes.size() - i < 8 ? bytes.size() - i : 8);
    h = mix64(h ^ word);
  }
  return h;
}

/// A number in [0, 1) from the top 53 bits.
constexpr double to_unit(std::uint64_t h) { return double(h >> 11) * 0x1p-53; }

}  // namespace mms
