// SPDX-License-Identifier: Apache-2.0
#include "materials/furnace.h"

#include "materials/bsdf.h"

namespace mms::materials {
namespace {

/// The point `i` of an additive recurrence in the unit cube: steps 1/g, 1/g^2, 1/g^3, g^4 = g + 1.
Vec3d cube_point(int i) {
  const auto at = [&](double step) { return std::fmod(0.5 + step * i, 1.0); };
  return {at(0.8191725133961645), at(0.6710436067037893), at(0.5497004779019703)};
}

Vec3d direction(double degrees) {
  const double a = degrees * kPi<double> / 180;
  // Off the axes, so that anisotropy shows.
  return {std::sin(a) * 0.8, std::sin(a) * 0.6, std::cos(a)};
}

/// The numbers with every spectrum turned so that wavelength `hero` is first; whether that changed
/// anything.
bool turn(const Layout& layout, const std::vector<double>& numbers, int hero,
          std::vector<double>& turned) {
  turned = numbers;
  for (const Layout::Node& node : layout.nodes()) {
    const Formals& f = formals(node.lobe);
    int at = node.first_param;
    for (int i = 0; i < f.count; ++i) {
      if (f.kinds[i] == 's')
        for (int k = 0; k < kWavelengths; ++k)
          turned[at + k] = numbers[at + (k + hero) % kWavelengths];
      if (f.kinds[i] != 'm') at += f.kinds[i] == 's' ? kWavelengths : 1;
    }
  }
  return turned != numbers;
}

struct Mean {
  double mean = 0, variance = 0;
};

Mean albedo(const Bsdf<double>& bsdf, Vec3d wo, int samples) {
  double mean = 0, squares = 0;  // Welford's sums
  for (int i = 0; i < samples; ++i) {
    const Vec3d u = cube_point(i);
    const auto s = bsdf.sample(wo, u.x, u.y, u.z, Mode::Importance);
    const double weight = s ? s->f[0] * std::abs(s->wi.z) / s->pdf[0] : 0;
    const double step = weight - mean;
    mean += step / (i + 1);
    squares += step * (weight - mean);
  }
  return {mean, squares / samples};
}

double reciprocity(const Bsdf<double>& bsdf) {
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d u = cube_point(2 * i), v = cube_point(2 * i + 1);
    const Vec3d a = square_to_sphere(u.x, u.y), b = square_to_sphere(v.x, v.y);
    const auto ab = bsdf.eval(a, b, Mode::Radiance), ba = bsdf.eval(b, a, Mode::Importance);
    for (int j = 0; j < kWavelengths; ++j) {
      const double larger = std::max(ab[j], ba[j]);
      if (larger > 0) worst = std::max(worst, std::abs(ab[j] - ba[j]) / larger);
    }
  }
  return worst;
}

}  // namespace

FurnaceReport furnace(const Layout& layout, const std::vector<double>& numbers, int samples) {
  FurnaceReport report;
  for (double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0, 89.0, 89.9, 180.0, 150.0,
                         120.0, 100.0, 91.0})
    if (degrees < 90 || layout.transmits()) report.rows.push_back({degrees, {}, 0, 0});
  std::vector<double> turned;
  for (int j = 0; j < kWavelengths; ++j) {
    const bool other = turn(layout, numbers, j, turned);
    const Bsdf<double> bsdf(layout, turned.data());
    for (FurnaceRow& row : report.rows) {
      if (j > 0 && !other) {
        row.albedo[j] = row.albedo[0];
        continue;
      }
      const Mean m = albedo(bsdf, direction(row.degrees), samples);
      row.albedo[j] = m.mean;
      if (j > 0) continue;
      row.standard_error = std::sqrt(m.variance / samples);
      row.relative_variance = m.mean > 0 ? m.variance / (m.mean * m.mean) : 0;
    }
  }
  report.reciprocity = reciprocity(Bsdf<double>(layout, numbers.data()));
  return report;
}

}  // namespace mms::materials
