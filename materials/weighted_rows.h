// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Weighted sums of rows of a table with AVX2: the inner loop of tables that hold many numbers at
/// each node. Each number is summed by itself and in the order of the rows, and nothing is
/// contracted: the bits are those of a plain loop. Pure; allocates nothing.

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace mms::materials {

/// Where up to `kMost` rows begin in a table, and what each weighs.
template <class R, int kMost>
struct WeightedRows {
  int count = 0;
  int first[kMost];
  R weight[kMost];

  void add(int at, R by) {
    first[count] = at;
    weight[count++] = by;
  }
};

#if defined(__x86_64__)
namespace avx2 {

#define MMS_AVX2_INLINE [[gnu::target("avx2"), gnu::always_inline]] static inline
template <class R>
struct Lanes;
template <>
struct Lanes<float> {
  using Vector = __m256;
  static constexpr int kCount = 8;
  MMS_AVX2_INLINE Vector load(const float* p) { return _mm256_loadu_ps(p); }
  MMS_AVX2_INLINE Vector widened(const float* p) { return _mm256_loadu_ps(p); }
  MMS_AVX2_INLINE Vector all(float x) { return _mm256_set1_ps(x); }
  MMS_AVX2_INLINE void store(float* p, Vector v) { _mm256_storeu_ps(p, v); }
};
template <>
struct Lanes<double> {
  using Vector = __m256d;
  static constexpr int kCount = 4;
  MMS_AVX2_INLINE Vector load(const double* p) { return _mm256_loadu_pd(p); }
  MMS_AVX2_INLINE Vector widened(const float* p) { return _mm256_cvtps_pd(_mm_loadu_ps(p)); }
  MMS_AVX2_INLINE Vector all(double x) { return _mm256_set1_pd(x); }
  MMS_AVX2_INLINE void store(double* p, Vector v) { _mm256_storeu_pd(p, v); }
};

/// The sums of `kVectors` vectors from the `t`th number on, kept in registers. The last vector ends
/// where the row does: of numbers that the one before it has too, both find the same from `last`.
template <int kVectors, class R, int kRows, class L = Lanes<R>>
MMS_AVX2_INLINE void add_vectors(R* sums, int t, int end, typename L::Vector last,
                                 const float* table, const WeightedRows<R, kRows>& rows) {
  int at[kVectors];
  typename L::Vector sum[kVectors];
#pragma GCC unroll 8
  for (int i = 0; i < kVectors; ++i) {
    at[i] = std::min(t + i * L::kCount, end);
    sum[i] = at[i] == end ? last : L::load(sums + at[i]);
  }
  for (int k = 0; k < rows.count; ++k) {
    const float* row = table + rows.first[k];
    const auto weight = L::all(rows.weight[k]);
#pragma GCC unroll 8
    for (int i = 0; i < kVectors; ++i) sum[i] += weight * L::widened(row + at[i]);
  }
#pragma GCC unroll 8
  for (int i = 0; i < kVectors; ++i) L::store(sums + at[i], sum[i]);
}
#undef MMS_AVX2_INLINE

/// Adds the rows, of `terms` numbers each, to `sums`: at least as many as a vector has.
template <class R, int kRows>
[[gnu::target("avx2"), gnu::noinline]] void add_rows(R* sums, int terms, const float* table,
                                                     const WeightedRows<R, kRows>& rows) {
  using L = Lanes<R>;
  const int end = terms - L::kCount;
  const auto last = L::load(sums + end);
  int t = 0;
  for (; t + 4 * L::kCount < terms; t += 8 * L::kCount)
    add_vectors<8>(sums, t, end, last, table, rows);
  if (t < terms) add_vectors<4>(sums, t, end, last, table, rows);
}

}  // namespace avx2
#endif

/// Adds the rows, of `terms` numbers each, to `sums`.
template <class R, int kRows>
inline void add_rows(R* sums, int terms, const float* table, const WeightedRows<R, kRows>& rows) {
#if defined(__x86_64__)
  if constexpr (sizeof(R) <= sizeof(double))  // no long double
    if (terms >= avx2::Lanes<R>::kCount && __builtin_cpu_supports("avx2"))
      return avx2::add_rows(sums, terms, table, rows);
#endif
  for (int k = 0; k < rows.count; ++k)
    for (int t = 0; t < terms; ++t) sums[t] += rows.weight[k] * R(table[rows.first[k] + t]);
}

}  // namespace mms::materials
