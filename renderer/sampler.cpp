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

/// The same columns, those of the four coordinates next to each other.
using Columns = std::array<std::array<std::uint32_t, 4>, 32>;

constexpr Columns interleaved(const std::array<Matrix, 4>& matrices) {
  Columns c{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 32; ++i) c[i][k] = matrices[k][i];
  return c;
}

constexpr Columns kNiederreiterXingColumns = interleaved(kNiederreiterXing);
constexpr Columns kSobolColumns = interleaved(kSobol);

/// The 32 digits of the four coordinates of point `number`.
std::array<std::uint32_t, 4> digits(const Columns& columns, std::uint32_t number) {
  std::array<std::uint32_t, 4> sum{};
  for (std::uint32_t n = number; n != 0; n &= n - 1) {
    const std::array<std::uint32_t, 4>& column = columns[std::size_t(__builtin_ctz(n))];
    for (std::size_t k = 0; k < 4; ++k) sum[k] ^= column[k];
  }
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

/// Owen's scrambling of digits that begin with the lowest bit. A product with an even number
/// changes a digit by what is below it only; so does adding a key. Two rounds, each with its own
/// half of `keys`, let every digit reach all above it.
constexpr std::uint32_t scramble_reversed(std::uint32_t r, std::uint64_t keys) {
  for (const std::uint32_t key : {std::uint32_t(keys), std::uint32_t(keys >> 32)}) {
    r += key;
    r ^= r * (0x6c50b47cu ^ (key & ~1u));
    r ^= r * 0xb82f1e52u;
    r *= key | 1u;
    r ^= r * 0xc7afe638u;
  }
  return r;
}
constexpr std::uint32_t scramble(std::uint32_t x, std::uint64_t keys) {
  return reverse_bits(scramble_reversed(reverse_bits(x), keys));
}

/// Digits of the second coordinate of Sobol's sequence, the lowest bit first: digit i of point n is
/// the sum of the digits j of n whose binomial coefficient (j, i) is odd, which by Lucas is where j
/// has all bits of i; so the sum is taken bit by bit of the index. The first coordinate is n
/// itself.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t n) {
  n ^= (n >> 1) & 0x55555555u;
  n ^= (n >> 2) & 0x33333333u;
  n ^= (n >> 4) & 0x0f0f0f0fu;
  n ^= (n >> 8) & 0x00ff00ffu;
  return n ^ (n >> 16);
}

/// Digits of a sample's number that are shuffled: as many as a render may need.
constexpr int kShuffled = 24;

/// Which point sample `number` takes: of each 2^k numbers from a multiple of 2^k on, the points are
/// such a block again.
constexpr std::uint32_t shuffled(std::uint64_t number, std::uint64_t keys) {
  constexpr std::uint32_t kLow = (1u << kShuffled) - 1;
  const auto n = std::uint32_t(number);
  return (n & ~kLow) | scramble((n & kLow) << (32 - kShuffled), keys) >> (32 - kShuffled);
}

}  // namespace

std::uint32_t nx4(std::uint64_t number, int coordinate) {
  return digits(kNiederreiterXingColumns, std::uint32_t(number))[std::size_t(coordinate)];
}

std::uint32_t sobol(std::uint64_t number, int coordinate) {
  return digits(kSobolColumns, std::uint32_t(number))[std::size_t(coordinate)];
}

std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return scramble(x, mix64(seed));
}

std::array<float, 4> Sampler::first() const {
  std::array<float, 4> u;
  if (generator_ == Generator::Random) {
    const std::uint64_t key = hash_combine(key_, sample_);
    for (std::size_t k = 0; k < 4; ++k) u[k] = unit_float(std::uint32_t(mix64(key + k) >> 32));
    return u;
  }
  const bool sobols = generator_ == Generator::Sobol;
  const std::array<std::uint32_t, 4> x =
      digits(sobols ? kSobolColumns : kNiederreiterXingColumns, std::uint32_t(sample_));
  for (std::size_t k = 0; k < 4; ++k)
    u[k] =
        unit_float(generator_ == Generator::Unscrambled ? x[k] : scramble(x[k], mix64(key_ + k)));
  return u;
}

std::array<float, 2> Sampler::pair(int number, int draw, int draws) const {
  const std::uint64_t sample = sample_ * std::uint64_t(draws) + std::uint64_t(draw);
  const std::uint64_t key = hash_combine(key_, std::uint64_t(number));
  if (generator_ == Generator::Random || generator_ == Generator::Unscrambled) {
    const std::uint64_t both = hash_combine(key, sample);
    return {unit_float(std::uint32_t(both)), unit_float(std::uint32_t(both >> 32))};
  }
  const std::uint32_t point = shuffled(sample, key);
  const std::uint32_t x = scramble_reversed(point, mix64(key + 1));
  const std::uint32_t y = scramble_reversed(sobol_second_reversed(point), mix64(key + 2));
  return {unit_float(reverse_bits(x)), unit_float(reverse_bits(y))};
}

float Sampler::operator()(int coordinate) const {
  return coordinate < 4 ? first()[std::size_t(coordinate)]
                        : pair(coordinate / 2)[std::size_t(coordinate % 2)];
}

Sampler Sampler::branch(int event) const {
  Sampler other = *this;
  other.key_ = hash_combine(key_ ^ 0x9d8f3ac1e27b5c64ULL, std::uint64_t(event));
  return other;
}

float Sampler::hashed(std::uint32_t stream, std::uint32_t n) const {
  const std::uint64_t key = hash_combine(key_ ^ 0x5bf03635f0935ad1ULL, sample_);
  return unit_float(std::uint32_t(hash_combine(key, (std::uint64_t(stream) << 32) | n) >> 32));
}

}  // namespace mms::renderer
