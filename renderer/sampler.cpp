// SPDX-License-Identifier: Apache-2.0
#include "renderer/sampler.h"

#include <initializer_list>

namespace mms::renderer {
namespace {

constexpr std::uint32_t kMatrices[4][32] = {
#include "renderer/nx4.inc"
};

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// 24 bits: the most that a float in [0, 1) holds evenly.
constexpr float unit_float(std::uint32_t x) { return float(x >> 8) * 0x1p-24f; }

}  // namespace

std::uint32_t nx4(std::uint64_t number, int coordinate) {
  std::uint32_t digits = 0;
  const std::uint32_t* column = kMatrices[coordinate];
  for (std::uint32_t n = std::uint32_t(number); n != 0; n &= n - 1)
    digits ^= column[__builtin_ctz(n)];
  return digits;
}

std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  // Reversed, a product with an even number changes a digit by what is above it only; so does
  // adding the seed. Two rounds, each with its own part of the seed, let every digit reach all
  // below it.
  std::uint32_t r = reverse_bits(x);
  const std::uint64_t keys = mix64(seed);
  for (const std::uint32_t key : {std::uint32_t(keys), std::uint32_t(keys >> 32)}) {
    r += key;
    r ^= r * (0x6c50b47cu ^ (key & ~1u));
    r ^= r * 0xb82f1e52u;
    r *= key | 1u;
    r ^= r * 0xc7afe638u;
  }
  return reverse_bits(r);
}

float Sampler::operator()(int coordinate) const {
  const std::uint64_t key = hash_combine(key_, std::uint64_t(coordinate));
  if (coordinate < 4)
    return unit_float(owen_scramble(nx4(sample_, coordinate), std::uint32_t(key >> 32)));
  return unit_float(std::uint32_t(hash_combine(key, sample_) >> 32));
}

float Sampler::hashed(std::uint32_t stream, std::uint32_t n) const {
  const std::uint64_t key = hash_combine(key_ ^ 0x5bf03635f0935ad1ULL, sample_);
  return unit_float(std::uint32_t(hash_combine(key, (std::uint64_t(stream) << 32) | n) >> 32));
}

}  // namespace mms::renderer
