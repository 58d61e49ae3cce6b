// SPDX-License-Identifier: Apache-2.0
#include "base/spectrum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace mms {
namespace {

/// Thesis (4.8) without its normalisation.
long double sech2(long double nm) {
  const long double c = std::cosh(0.0072L * (nm - 538.0L));
  return 1 / (c * c);
}

/// Integral by Simpson's rule over n (even) intervals. The integrands here have fourth derivatives
/// below 1e-7, so with intervals under a nanometre its error is below (b - a) 1e-7 / 180 < 1e-6.
template <class F>
long double simpson(F f, long double a, long double b, int n = 1000) {
  const long double h = (b - a) / n;
  long double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i) sum += (i % 2 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

TEST_CASE("the wavelength density is sech^2, normalised over the range") {
  const long double norm = simpson(sech2, kLambdaMin, kLambdaMax);
  for (double nm = kLambdaMin; nm <= kLambdaMax; nm += 23.5)
    CHECK(wavelength_pdf(nm) == doctest::Approx(double(sech2(nm) / norm)).epsilon(1e-8));
  CHECK(double(simpson([](long double x) { return wavelength_pdf(double(x)); }, kLambdaMin,
                       kLambdaMax)) == doctest::Approx(1).epsilon(1e-8));
}

TEST_CASE("a sampled wavelength stands where the distribution reaches its number") {
  // A float near 830 is off by at most 2^-15 nm, and the density is at most 4e-3 / nm.
  constexpr double tolerance = 0x1p-15 * 4e-3 + 1e-8;
  for (int k = 0; k < 64; ++k) {
    const double u = (k + 0.37) / 64;
    const Wavelengths w = sample_wavelengths(u);
    for (int i = 0; i < kWavelengths; ++i) {
      const double expected = std::fmod(u + double(i) / kWavelengths, 1.0);
      const double reached = double(
          simpson([](long double x) { return wavelength_pdf(double(x)); }, kLambdaMin, w.nm[i]));
      CHECK(std::abs(reached - expected) < tolerance);
      CHECK(w.pdf[i] == float(wavelength_pdf(w.nm[i])));
    }
  }
}

TEST_CASE("the ends of the range are kept, and a cluster has eight wavelengths") {
  for (const double u : {0.0, 1e-17, 0.125, 0.5, 0x1.fffffffffffffp-1}) {
    const Wavelengths w = sample_wavelengths(u);
    for (int i = 0; i < kWavelengths; ++i) {
      CHECK(w.nm[i] >= float(kLambdaMin));
      CHECK(w.nm[i] <= float(kLambdaMax));
      CHECK(w.pdf[i] > 0);
    }
    std::vector<float> sorted(w.nm.v.begin(), w.nm.v.end());
    std::sort(sorted.begin(), sorted.end());
    CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
  }
}

TEST_CASE("a spectrum combines element by element") {
  Spectrumf a, b;
  for (int i = 0; i < kWavelengths; ++i) a[i] = float(i + 1), b[i] = float(2 * i - 3);
  for (int i = 0; i < kWavelengths; ++i) {
    CHECK((a + b)[i] == float(3 * i - 2));
    CHECK((a - b)[i] == float(4 - i));
    CHECK((a * b)[i] == float((i + 1) * (2 * i - 3)));
    CHECK((b / a)[i] == float(2 * i - 3) / float(i + 1));
    CHECK((a * 2.0f)[i] == float(2 * i + 2));
  }
  CHECK(a.sum() == 36);
  CHECK(a.average() == 4.5f);
  CHECK(b.max() == 11);
  CHECK(Spectrumf().is_black());
  CHECK(!a.is_black());
  a[3] = INFINITY;
  CHECK(!a.is_finite());
}

}  // namespace
}  // namespace mms
