// SPDX-License-Identifier: Apache-2.0
// Colours that become spectra come back as the same colours under D65. The way back is no part of
// the library: the observer's 1 nm table, and the matrix of the standard.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "materials/colour.h"
#include "materials/spectra.h"
#include "tests/golden/evaluate.h"

namespace mms::golden {
namespace {

/// CIE L*a*b* of a linear colour, white being D65.
Vec3d lab(Vec3d rgb) {
  const Vec3d xyz = materials::xyz_of_linear_srgb(rgb);
  const Vec3d white = materials::xyz_of_linear_srgb({1, 1, 1});
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const double x = f(xyz.x / white.x), y = f(xyz.y / white.y), z = f(xyz.z / white.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// How a reflectance looks under D65, white being (1, 1, 1).
template <class F>
Vec3d seen(F reflectance) {
  const auto lit = [&](auto r) {
    return materials::linear_srgb_of_xyz(materials::xyz_of_spectrum(
        [&](double nm) { return r(nm) * materials::illuminant_d65(nm); }));
  };
  const Vec3d c = lit(reflectance), white = lit([](double) { return 1.0; });
  return {c.x / white.x, c.y / white.y, c.z / white.z};
}

/// Colours over the cube of sRGB, `steps` + 1 along each axis.
std::vector<Vec3d> cube(int steps) {
  std::vector<Vec3d> all;
  const auto at = [&](int k) { return materials::srgb_decode(double(k) / steps); };
  for (int r = 0; r <= steps; ++r)
    for (int g = 0; g <= steps; ++g)
      for (int b = 0; b <= steps; ++b) all.push_back({at(r), at(g), at(b)});
  return all;
}

/// The coefficients that the library finds for colours, by the machine that computes in R.
template <class R>
std::vector<Vec3d> coefficients(const std::vector<Vec3d>& colours) {
  const Compiled c = compile("real[3] value() = sigmoid_coefficients($position);\n");
  REQUIRE_MESSAGE(c.linked, c.text_of_errors());
  const vm::Program& program = c.linked->program;
  const vm::Executable executable(program);
  std::vector<Vec3d> all;
  constexpr int kBatch = 64;
  for (std::size_t first = 0; first < colours.size(); first += kBatch) {
    vm::InputBatch<R> in(kBatch);
    api::fill_defaults(in);
    const int lanes = int(std::min<std::size_t>(kBatch, colours.size() - first));
    for (int i = 0; i < lanes; ++i)
      for (int k = 0; k < 3; ++k)
        in.lanes(vm::Variable::Position, k)[i] = R(colours[first + std::size_t(i)][k]);
    const Run r = run(program, executable, program.exports[0].function, in, lanes);
    for (std::size_t i = 0; i < std::size_t(lanes); ++i)
      all.push_back({r.values[0][i], r.values[1][i], r.values[2][i]});
  }
  return all;
}

struct Errors {
  double mean = 0, median = 0, worst = 0;
};

/// Differences in L*a*b* between colours and what becomes of them.
template <class F>
Errors round_trip(const std::vector<Vec3d>& colours, F reflectance_of) {
  std::vector<double> all;
  Errors e;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const Vec3d back = seen(reflectance_of(i));
    all.push_back(length(lab(back) - lab(colours[i])));
    e.mean += all.back() / double(colours.size());
  }
  std::sort(all.begin(), all.end());
  e.median = all[all.size() / 2];
  e.worst = all.back();
  return e;
}

TEST_CASE("rgb_sigmoid comes back as the same colour over the sRGB cube, rgb about as") {
  const std::vector<Vec3d> colours = cube(10);
  const auto smooth = [&](const std::vector<Vec3d>& c) {
    return round_trip(colours, [&c](std::size_t i) {
      return [q = c[i]](double nm) {
        const double u = (nm - 550) / 100, x = (q.x * u + q.y) * u + q.z;
        return 0.5 + 0.5 * x / std::sqrt(1 + x * x);
      };
    });
  };
  const Errors in_float = smooth(coefficients<float>(colours));
  const Errors in_double = smooth(coefficients<double>(colours));
  const Errors table = round_trip(colours, [&](std::size_t i) {
    return [c = colours[i]](double nm) {
      const double r = materials::rgb_red(nm), g = materials::rgb_green(nm);
      return c.x * r + c.y * g + c.z * (1 - (r + g));
    };
  });
  MESSAGE(
      fmt::format("Delta E*ab, mean, median, largest: rgb_sigmoid {:.3f} {:.3f} {:.2f}, in "
                  "double {:.3f} {:.3f} {:.2f}; rgb {:.2f} {:.2f} {:.1f}",
                  in_float.mean, in_float.median, in_float.worst, in_double.mean, in_double.median,
                  in_double.worst, table.mean, table.median, table.worst));
  // Sums of 10 nm in place of 1 nm make the median; 2.3 is what the eye can just tell apart. At the
  // edges of the cube curves are nearly steps, and their coefficients hundreds: floats feel it.
  CHECK(in_float.median < 0.05);
  CHECK(in_float.mean < 0.1);
  CHECK(in_float.worst < 5);
  CHECK(in_double.mean < 0.05);
  CHECK(in_double.worst < 1);
  CHECK(table.mean > in_float.mean);
}

}  // namespace
}  // namespace mms::golden
