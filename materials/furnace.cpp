// SPDX-License-Identifier: Apache-2.0
#include "materials/furnace.h"

#include <memory>

#include "materials/bsdf.h"
#include "materials/phase.h"

namespace mms::materials {
namespace {

/// The digits of `i` in `base`, mirrored at the point.
double mirrored_digits(int i, int base) {
  double value = 0;
  for (double digit = 1.0 / base; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

/// The point `i` of Halton's sequence in the unit cube.
Vec3d cube_point(int i) {
  return {mirrored_digits(i + 1, 2), mirrored_digits(i + 1, 3), mirrored_digits(i + 1, 5)};
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

/// A surface, and what is kept of it from one direction to the next.
class Surface {
 public:
  Surface(const Layout& layout, const double* numbers) : bsdf_(layout, numbers) {}

  /// From here on light is seen along `wo`.
  void see(Vec3d wo) {
    wo_ = wo;
    bsdf_.choose(wo, *choice_);
  }
  /// Of the sample that `u` draws; 0 where there is none. In a furnace the side of the larger index
  /// is brighter, which radiance would have to be told; of one side alone it is what is seen, also
  /// of what is not reciprocal.
  double weight(Vec3d u) const {
    const Mode mode = bsdf_.transmits() ? Mode::Importance : Mode::Radiance;
    const auto s = bsdf_.sample(wo_, u.x, u.y, u.z, mode, *choice_);
    return s ? s->f[0] * std::abs(s->wi.z) / s->pdf[0] : 0;
  }
  Spectrum<double> value(Vec3d wi, Mode mode) const {
    return bsdf_.evaluate(wo_, wi, mode, *choice_).f;
  }

 private:
  Bsdf<double> bsdf_;
  Vec3d wo_;
  std::unique_ptr<Bsdf<double>::Choice> choice_ = std::make_unique<Bsdf<double>::Choice>();
};

/// The same of a phase function.
class Volume {
 public:
  Volume(const Layout& layout, const double* numbers) : phase_(layout, numbers) {}

  void see(Vec3d wo) { wo_ = wo; }
  double weight(Vec3d u) const {
    const auto s = phase_.sample(wo_, u.x, u.y, u.z);
    return s ? s->f[0] / s->pdf[0] : 0;
  }
  Spectrum<double> value(Vec3d wi, Mode) const { return phase_.eval(wo_, wi); }

 private:
  Phase<double> phase_;
  Vec3d wo_;
};

template <class Scattering>
Mean albedo(Scattering& scattering, Vec3d wo, int samples) {
  scattering.see(wo);
  double mean = 0, squares = 0;  // Welford's sums
  for (int i = 0; i < samples; ++i) {
    const double weight = scattering.weight(cube_point(i));
    const double step = weight - mean;
    mean += step / (i + 1);
    squares += step * (weight - mean);
  }
  return {mean, squares / samples};
}

template <class Scattering>
double reciprocity(Scattering scattering) {
  double worst = 0;
  for (int i = 1; i <= 2000; ++i) {
    const auto at = [i](int base) { return mirrored_digits(i, base); };
    const Vec3d a = square_to_sphere(at(2), at(3)), b = square_to_sphere(at(5), at(7));
    // From one side to the other f itself is not symmetric, as an index may lie between.
    const Mode back = same_side(a, b) ? Mode::Radiance : Mode::Importance;
    scattering.see(a);
    const auto ab = scattering.value(b, Mode::Radiance);
    scattering.see(b);
    const auto ba = scattering.value(a, back);
    for (int j = 0; j < kWavelengths; ++j) {
      const double larger = std::max(ab[j], ba[j]);
      if (larger > 0) worst = std::max(worst, std::abs(ab[j] - ba[j]) / larger);
    }
  }
  return worst;
}

template <class Scattering>
FurnaceReport measure(const Layout& layout, const std::vector<double>& numbers, int samples,
                      std::vector<FurnaceRow> rows) {
  FurnaceReport report{std::move(rows), 0};
  std::vector<double> turned;
  for (int j = 0; j < kWavelengths; ++j) {
    const bool other = turn(layout, numbers, j, turned);
    Scattering scattering(layout, turned.data());
    for (FurnaceRow& row : report.rows) {
      if (j > 0 && !other) {
        row.albedo[j] = row.albedo[0];
        continue;
      }
      const Mean m = albedo(scattering, direction(row.degrees), samples);
      row.albedo[j] = m.mean;
      if (j > 0) continue;
      row.standard_error = std::sqrt(m.variance / samples);
      row.relative_variance = m.mean > 0 ? m.variance / (m.mean * m.mean) : 0;
    }
  }
  report.reciprocity = reciprocity(Scattering(layout, numbers.data()));
  return report;
}

}  // namespace

double FurnaceRow::lost() const {
  double most = 0;
  for (const double a : albedo.v)
    if (std::abs(1 - a) > std::abs(most)) most = 1 - a;
  return most;
}

FurnaceReport furnace(const Layout& layout, const std::vector<double>& numbers, int samples) {
  if (layout.phase()) return measure<Volume>(layout, numbers, samples, {FurnaceRow()});
  std::vector<FurnaceRow> rows;
  for (double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0, 89.0, 89.9, 180.0, 150.0,
                         120.0, 100.0, 91.0})
    if (degrees < 90 || layout.transmits()) rows.push_back({degrees, {}, 0, 0});
  return measure<Surface>(layout, numbers, samples, std::move(rows));
}

}  // namespace mms::materials
