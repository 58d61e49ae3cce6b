// SPDX-License-Identifier: Apache-2.0
#include "renderer/sampler.h"

#include <array>
#include <initializer_list>

namespace mms::renderer {
namespace {

using Matrix = std::array<std::uint32_t, 32>;  ///< column by column

constexpr std::array<Matrix, 4> kNiederreiterXing = {{
#include "renderer/nx4.inc"
}};

/// Columns of a coordinate of Sobol's sequence: of the primitive polynomial of degree `s` whose
/// inner coefficients are the bits of `a`, begun with the odd numbers `m`.
constexpr Matrix sobol_matrix(int s, unsigned a, std::array<unsigned, 3> m) {
  Matrix v{};
  for (int i = 0; i < 32; ++i) {
    if (s == 0) {
      v[i] = 1u << (31 - i);
    } else if (i < s) {
      v[i] = m[i] << (31 - i);
    } else {
      v[i] = v[i - s] ^ (v[i - s] >> s);
      for (int k = 1; k < s; ++k)
        if (a >> (s - 1 - k) & 1) v[i] ^= v[i - k];
    }
  }
  return v;
}

/// The first four polynomials, with the numbers of Joe and Kuo 2008.
constexpr std::array<Matrix, 4> kSobol = {sobol_matrix(0, 0, {}), sobol_matrix(1, 0, {1}),
                                          sobol_matrix(2, 1, {1, 3}),
                                          sobol_matrix(3, 1, {1, 3, 1})};

/// The 32 digits of point `number`.
std::uint32_t digits(const Matrix& columns, std::uint64_t number) {
  std::uint32_t sum = 0;
  for (std::uint32_t n = std::uint32_t(number); n != 0; n &= n - 1)
    sum ^= columns[__builtin_ctz(n)];
  return sum;
}

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
  return digits(kNiederreiterXing[coordinate], number);
}

std::uint32_t sobol(std::uint64_t number, int coordinate) {
  return digits(kSobol[coordinate], number);
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
  if (coordinate < 4) switch (generator_) {
      case Generator::Niederreiter:
        return unit_float(owen_scramble(nx4(sample_, coordinate), std::uint32_t(key >> 32)));
      case Generator::Sobol:
        return unit_float(owen_scramble(sobol(sample_, coordinate), std::uint32_t(key >> 32)));
      case Generator::Unscrambled:
        return unit_float(nx4(sample_, coordinate));
      case Generator::Random:
        break;
    }
  return unit_float(std::uint32_t(hash_combine(key, sample_) >> 32));
}

float Sampler::hashed(std::uint32_t stream, std::uint32_t n) const {
  const std::uint64_t key = hash_combine(key_ ^ 0x5bf03635f0935ad1ULL, sample_);
  return unit_float(std::uint32_t(hash_combine(key, (std::uint64_t(stream) << 32) | n) >> 32));
}

}  // namespace mms::renderer
