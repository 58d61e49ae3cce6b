// SPDX-License-Identifier: Apache-2.0
// Spectra and Fresnel's equations against long double forms, published figures and materials/.
#include <doctest/doctest.h>

#include <complex>

#include "materials/fresnel.h"
#include "materials/optical_tables.h"
#include "materials/spectra.h"
#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {
namespace {

using L = long double;

/// Error in units of 2^-24 of the result, but at least of a denormal's half spacing: rounding to
/// float costs one.
double float_error(double got, L exact) {
  return double(fabsl(got - exact) / std::max(fabsl(exact) * 0x1p-24L, 0x1p-150L));
}

L planck_exact(L wavelength, L t) {
  const L h = 6.62607015e-34L, c = 299792458.0L, k = 1.380649e-23L;
  return 2 * h * c * c * 1e-9L / powl(wavelength, 5) / expm1l(h * c / (wavelength * k * t));
}

TEST_CASE("planck against long double with the constants of the SI") {
  const vm::Builtin& row = find("real planck(real wavelength, temperature)");
  for (float t : {300.0f, 1000.0f, 2856.0f, 6500.0f, 1e5f})
    for (float nm = 360; nm <= 830; nm += 7) {
      const float wavelength = nm * 1e-9f;
      const L exact = planck_exact(wavelength, t);
      CHECK(float_error(call<float>(row, wavelength, t), exact) < 1.01);
      CHECK(std::fabs(call<double>(row, wavelength, t) / double(exact) - 1) < 1e-13);
    }
  CHECK(call<float>(row, 5e-7f, 0.0f) == 0);
  CHECK(call<float>(row, 5e-7f, -1.0f) == 0);
  CHECK(call<float>(row, 5e-7f, 1.0f) == 0);  // e^-28776
  CHECK(call<float>(row, 1e-20f, 300.0f) == 0);
}

/// Textbook form, in long double complex arithmetic.
L fresnel_exact(L c, std::complex<L> eta) {
  const std::complex<L> ct = std::sqrt(1.0L - (1 - c * c) / (eta * eta));
  const std::complex<L> rs = (c - eta * ct) / (c + eta * ct), rp = (eta * c - ct) / (eta * c + ct);
  return (std::norm(rs) + std::norm(rp)) / 2;
}

TEST_CASE("fresnel against the textbook form in long double") {
  const vm::Builtin& row = find("real fresnel(real cos_theta, ior)");
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const float c = i % 2 ? u(random) : std::pow(u(random), 8.0f);
    const float ior = 0.4f + 2.2f * u(random);
    const L g2 = L(ior) * ior - 1 + L(c) * c;
    const float r = call<float>(row, c, ior);
    if (g2 <= 0) {
      CHECK(r == 1);
    } else if (std::fabs(ior - 1) > 0.02f) {  // nearer to 1 the textbook form cancels
      CHECK(float_error(r, fresnel_exact(c, ior)) < 1.01);
    }
    CHECK(call<double>(row, c, ior) ==
          doctest::Approx(materials::fresnel_dielectric<double>(c, ior)).epsilon(1e-12));
  }
  for (float ior = 1e-30f; ior < 1e15f; ior *= 7) {  // along the normal
    const L exact = powl((1 - L(ior)) / (1 + L(ior)), 2);
    CHECK(float_error(call<float>(row, 1.0f, ior), exact) < 1.01);
    CHECK(std::fabs(call<double>(row, 1.0, double(ior)) / double(exact) - 1) < 1e-14);
  }
  CHECK(call<float>(row, 1.0f, 1.5f) == doctest::Approx(0.04));
  CHECK(call<float>(row, 0.3f, 1.0f) == 0);
  CHECK(call<float>(row, 0.0f, 1.5f) == 1);
  CHECK(std::isnan(call<float>(row, 0.5f, NAN)));
}

TEST_CASE("fresnel_conductor against the textbook form in long double") {
  const vm::Builtin& row = find("real fresnel_conductor(real cos_theta, n, k)");
  std::mt19937 random(6);
  std::uniform_real_distribution<float> u(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const float c = u(random), n = 0.05f + 4 * u(random), k = 0.1f + 8 * u(random);
    CHECK(float_error(call<float>(row, c, n, k), fresnel_exact(c, {n, k})) < 1.01);
    CHECK(call<double>(row, c, n, k) ==
          doctest::Approx(materials::fresnel_conductor<double>(c, n, k)).epsilon(1e-10));
  }
  CHECK(call<float>(row, 0.5f, 1.0f, 1e25f) == 1);
  CHECK(call<float>(row, 0.0f, 0.2f, 3.0f) == 1);
}

TEST_CASE("sellmeier and cauchy against catalogue figures") {
  const vm::Builtin& row = find("real sellmeier(real wavelength, b1, c1, b2, c2, b3, c3)");
  // N-BK7 at the d, F and C lines, as the Schott catalogue prints them to five decimals.
  const double nm[] = {587.5618, 486.1327, 656.2725}, n[] = {1.51680, 1.52238, 1.51432};
  for (int i = 0; i < 3; ++i)
    CHECK(std::fabs(call<double>(row, nm[i] * 1e-9, 1.03961212, 0.00600069867, 0.231792344,
                                 0.0200179144, 1.01046945, 103.560653) -
                    n[i]) < 6e-6);
  CHECK(call<double>(row, 5e-7, -3.0, 0.0, 0.0, 0.0, 0.0, 0.0) == 1);
  CHECK(call<double>(find("real cauchy(real wavelength, a, b)"), 5e-7, 1.5, 0.004) ==
        doctest::Approx(1.516).epsilon(1e-12));
}

TEST_CASE("optical_table reads the tables of materials/, by number, ends held") {
  const vm::Builtin& row = find("real optical_table(real wavelength, table)");
  const vm::Builtin& slope = find("real optical_table_slope(real wavelength, table)");
  for (int k = 0; k < materials::kOpticalTables; ++k) {
    const materials::OpticalTable& table = materials::optical_tables[k];
    INFO(table.name);
    for (double nm = 290; nm <= 900; nm += 7.7) {
      CHECK(call<double>(row, nm * 1e-9, double(k)) == doctest::Approx(table.at(nm)).epsilon(1e-9));
      CHECK(call<double>(slope, nm * 1e-9, double(k)) * 1e-9 ==
            doctest::Approx(table.slope(nm)).epsilon(1e-9));
    }
    // A float wavelength is off by 2^-24 of itself.
    const float l = 555.5e-9f;
    CHECK(call<float>(row, l, float(k)) ==
          doctest::Approx(table.at(double(l) * 1e9)).epsilon(1e-6));
  }
  CHECK(call<double>(row, 555e-9, -1.0) == call<double>(row, 555e-9, 0.0));
  CHECK(call<double>(row, 555e-9, 1e9) ==
        call<double>(row, 555e-9, double(materials::kOpticalTables - 1)));
}

}  // namespace
}  // namespace mms::stdlib::testing
