// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in a minute of one core.
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/glass_coat.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/shapes.h"
#include "materials/tables/slopes.h"

namespace mms::materials {
namespace {

#pragma GCC diagnostic ignored "-Wunused"
#include "energy_tables.inc"  // made by the build: materials/tables/energy.cpp

}  // namespace

namespace tables {
namespace {

const InterfaceTables& losses_of(const Ggx<double>&) {
  static const InterfaceTables tables{{kGgxDense, kGgxRare},
                                      {kGgxDenseMean, kGgxRareMean},
                                      kGgxBent,
                                      {kGgxDenseStretched, kGgxRareStretched},
                                      {kGgxDenseStretchedMean, kGgxRareStretchedMean},
                                      kGgxLeastMean,
                                      kGgxKink};
  return tables;
}
const InterfaceTables& losses_of(const Beckmann<double>&) {
  static const InterfaceTables tables{{kBeckmannDense, kBeckmannRare},
                                      {kBeckmannDenseMean, kBeckmannRareMean},
                                      kBeckmannBent,
                                      {kBeckmannDenseStretched, kBeckmannRareStretched},
                                      {kBeckmannDenseStretchedMean, kBeckmannRareStretchedMean},
                                      kBeckmannLeastMean,
                                      kBeckmannKink};
  return tables;
}

double index_at(double place) {
  using namespace axes;
  const double x = kLeastGlassIndex + (kMostGlassIndex - kLeastGlassIndex) * place;
  return (1 + x * x * x * x) / (1 - x * x * x * x);
}
double alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}

/// A number for each index of coats on an axis.
template <bool Inside, int Count>
struct Coats {
  static constexpr int kCount = Count;
  std::array<double, kCount> of{};

  Coats operator*(double x) const {
    Coats product = *this;
    for (double& v : product.of) v *= x;
    return product;
  }
  Coats& operator+=(const Coats& b) {
    for (int k = 0; k < kCount; ++k) of[k] += b.of[k];
    return *this;
  }

  /// Fresnel's T along a direction of |cosine| `z`.
  static Coats through(double z) {
    Coats t;
    for (int k = 0; k < kCount; ++k)
      t.of[k] = fresnel_split(z, index_at(double(k) / (kCount - 1))).transmitted;
    return t;
  }
  /// What the coats do not let through of light that leaves outside along a direction of |cosine|
  /// `z`: F where it comes from inside, else what its factor lacks.
  static Coats lacks(double z) {
    static const Coats normal = through(1);
    Coats lack = through(z);
    for (int k = 0; k < kCount; ++k)
      lack.of[k] = 1 - lack.of[k] / (Inside ? 1 : std::max(normal.of[k], lack.of[k]));
    return lack;
  }
};

/// What the coats do not let through of further bounces: their mean over l outside (materials/
/// energy.h), as a share of all of them.
template <bool Inside, int Count, class Facets>
Coats<Inside, Count> further(const Facets& facets, double glass) {
  const InterfaceTables& tables = losses_of(facets);
  const InterfaceLoss<double> outside{&tables, facets.ax, facets.ay, glass},
      inside{&tables, facets.ax, facets.ay, 1 / glass};
  const double a2 = facets.ax * facets.ay, log = std::log1p(1 / a2);
  const double mean_outside = outside.mean(), mean_inside = inside.mean();
  const double across = Inside ? transmitted_share(mean_inside, mean_outside, 1 / glass)
                               : transmitted_share(mean_outside, mean_inside, glass);
  const bool round = facets.ax == facets.ay;
  Coats<Inside, Count> sum;
  double all = 0;
  const int panels = round ? 24 : 12, turns = round ? 1 : 6;
  for (int n = 0; n < 8 * panels; ++n) {  // z^2 + alpha^2 spread evenly over its logarithm
    const double u = (n / 8 + gauss<8>().x[n % 8]) / panels;
    const double z2 = std::min(1.0, a2 * std::expm1(u * log)), z = std::sqrt(z2),
                 s = std::sqrt(1 - z2);
    double l = 0;
    for (int k = 0; k < turns; ++k) {
      const double turn = (k + 0.5) / turns * kPi<double> / 2;
      l += outside.at({s * std::cos(turn), s * std::sin(turn), z}) / turns;
    }
    const double share = l * (z2 + a2) * gauss<8>().w[n % 8];
    sum += Coats<Inside, Count>::lacks(z) * share;
    all += share;
  }
  return sum * ((Inside ? across : 1 - across) / all);
}

/// What coats send back of light along `w`, z > 0.
template <bool Inside, int Count, class Facets>
Coats<Inside, Count> sent_back(const Facets& facets, double glass, Vec3d w,
                               const Coats<Inside, Count>& further) {
  using All = Coats<Inside, Count>;
  const double eta = Inside ? 1 / glass : glass;
  All sent = interface_mean(facets, eta, w, 16, [](const Way& up, const Way& down) {
    const Way& out = Inside ? down : up;
    const double leaves = out.share * (1 - out.taken);
    return leaves > 0 ? All::lacks(out.cosine) * leaves : All();
  });
  sent += further * InterfaceLoss<double>{&losses_of(facets), facets.ax, facets.ay, eta}.at(w);
  if (Inside) return sent;
  const All through = All::through(w.z);
  for (int k = 0; k < Count; ++k) sent.of[k] *= through.of[k];
  return sent;
}

/// The |cosine| at a place on the axis of directions.
double cosine_at(bool inside, double place, double alpha, double glass) {
  return cosine(std::min(place, 1 - kLeast), [&](double c, double s) {
    return axes::glass_direction(inside, c, s, alpha, glass);
  });
}

/// Of stretched facets less what the tables of round ones hold.
template <bool Inside, template <class> class Distribution>
std::vector<float> bent_side(const GlassTables& round) {
  constexpr axes::BentGlassGrid grid = axes::kBentGlass[Inside];
  constexpr int coats = grid.coat;
  const ShapeFit shapes(grid.degree);
  const int count = shapes.count(), terms = shapes.terms();
  Grid fitted({grid.width, grid.index, grid.direction, coats, terms},
              [](const double*) { return 0.0; });
  parallel(grid.width * grid.index, [&](int i) {
    const double like = alpha_at(double(i / grid.index) / (grid.width - 1));
    const double glass = index_at(double(i % grid.index) / (grid.index - 1));
    std::vector<std::vector<double>> values(grid.direction * coats, std::vector<double>(count));
    for (int shape = 0; shape < count; ++shape) {
      auto seen = shapes.facets(shape);
      const double x = seen.x, y = seen.y, along = std::hypot(seen.wide * x, seen.narrow * y);
      const double root = like / (along + like * (1 - along));  // the inverse of like()
      seen.wide *= root, seen.narrow *= root;
      const Distribution<double> facets{{seen.wide, seen.narrow}};
      const auto rest = further<Inside, coats>(facets, glass);
      for (int d = 0; d < grid.direction; ++d) {
        const double z = std::max(cosine_at(Inside, double(d) / (grid.direction - 1), like, glass),
                                  kLeast * root);
        const double s = std::sqrt(1 - z * z);
        seen.x = x * s, seen.y = y * s, seen.z = z;
        const auto sent = sent_back<Inside, coats>(facets, glass, {seen.x, seen.y, z}, rest);
        for (int k = 0; k < coats; ++k)
          values[d * coats + k][shape] =
              sent.of[k] -
              sent_back_by_round(round, seen, Inside, glass, index_at(double(k) / (coats - 1)));
      }
    }
    double* p = &fitted.values[std::size_t(i) * grid.direction * coats * terms];
    for (const auto& of_shapes : values)
      for (int t = 0; t < terms; ++t) *p++ = shapes.term(t, of_shapes.data());
  });
  const std::vector<double> spline = fitted.spline(1);
  return {spline.begin(), spline.end()};
}

template <bool Inside, template <class> class Distribution>
void write_side(std::FILE* to, const std::string& name) {
  using namespace axes;
  constexpr int widths = kGlassAlpha[Inside], indices = kGlassIndex[Inside],
                directions = kGlassDirection[Inside], coats = kGlassCoat[Inside];
  const std::string side = Inside ? "Inside" : "Outside";
  Grid grid({widths, indices, directions, coats}, [](const double*) { return 0.0; });
  parallel(widths * indices, [&](int i) {
    const double alpha = alpha_at(double(i / indices) / (widths - 1));
    const double glass = index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto rest = further<Inside, coats>(facets, glass);
    for (int d = 0; d < directions; ++d) {
      const double z =
          std::max(cosine_at(Inside, double(d) / (directions - 1), alpha, glass), kLeast * alpha);
      const auto sent = sent_back<Inside, coats>(facets, glass, {std::sqrt(1 - z * z), 0, z}, rest);
      for (int k = 0; k < coats; ++k)
        grid.values[(i * directions + d) * coats + k] =
            Inside ? std::sqrt(std::max(sent.of[k], 0.0)) : sent.of[k];
    }
  });
  const std::vector<double> spline = grid.spline();
  const std::vector<float> round(spline.begin(), spline.end());
  write_numbers(to, name + side, round, 6);
  GlassTables tables{};
  tables.sent[Inside] = round.data();
  write_numbers(to, name + "Bent" + side, bent_side<Inside, Distribution>(tables), 4);
}

}  // namespace
}  // namespace tables
}  // namespace mms::materials

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](std::FILE* to) {
    tables::write_side<false, Ggx>(to, "kGgx");
    tables::write_side<true, Ggx>(to, "kGgx");
    tables::write_side<false, Beckmann>(to, "kBeckmann");
    tables::write_side<true, Beckmann>(to, "kBeckmann");
  });
}
