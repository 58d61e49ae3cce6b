// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in two minutes of one core.
#include <algorithm>
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
namespace tables {
namespace {

double index_at(double place) {
  return index_of(axes::kLeastGlassIndex +
                  (axes::kMostGlassIndex - axes::kLeastGlassIndex) * place);
}
double alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}

/// Reflected fractions of coats of many indices at one cosine, side by side.
template <int Count>
void reflected(const std::array<double, Count>& indices, double z, double* to) {
  for (int k = 0; k < Count; ++k) to[k] = fresnel_dielectric(z, indices[k]);
}

/// The four functions of kRestCosine: what is 1 at one of the cosines and 0 at the others, of 1 and
/// of L of three indices.
class RestFunctions {
 public:
  static std::array<double, kRest> at(double z) {
    static const RestFunctions functions;
    const auto terms = functions.terms(z);
    std::array<double, kRest> to{};
    for (int k = 0; k < kRest; ++k)
      for (int m = 0; m < kRest; ++m) to[m] += functions.inverse_[k][m] * terms[k];
    return to;
  }

 private:
  static constexpr std::array<double, kRest - 1> kIndices = {1.1, 1.4, 2};
  std::array<std::array<double, kRest>, kRest> inverse_;  // [term][function]

  RestFunctions() {
    std::vector<std::vector<double>> a(kRest, std::vector<double>(2 * kRest));
    for (int m = 0; m < kRest; ++m) {
      const auto at = terms(kRestCosine[m]);
      for (int k = 0; k < kRest; ++k) a[k][m] = at[k];
      a[m][kRest + m] = 1;
    }
    solve(a);
    for (int k = 0; k < kRest; ++k)
      for (int m = 0; m < kRest; ++m) inverse_[k][m] = a[m][kRest + k];
  }
  static std::array<double, kRest> terms(double z) {
    std::array<double, kRest> to{1};
    reflected<kRest - 1>(kIndices, held::cosine(z), &to[1]);
    return to;
  }
};

/// A number for each of `Count` indices of coats on an axis, and then for each of the four
/// functions.
template <int Count>
using Parts = Numbers<Count + kRest>;

template <int Count>
Parts<Count> parts_at(double z) {
  static const auto indices = [] {
    std::array<double, Count> all;
    for (int k = 0; k < Count; ++k) all[k] = index_at(double(k) / (Count - 1));
    return all;
  }();
  Parts<Count> to;
  reflected<Count>(indices, z, to.of.data());
  const auto rest = RestFunctions::at(z);
  std::copy(rest.begin(), rest.end(), to.of.begin() + Count);
  return to;
}

/// What GlassTables hold the integral of, at |cosine| `z` outside.
template <bool Inside, int Count>
Parts<Count> lacks(double z) {
  static const Parts<Count> normal = parts_at<Count>(1);
  Parts<Count> lack = parts_at<Count>(z);
  if (Inside) return lack;
  for (int k = 0; k < Count; ++k) lack.of[k] = (lack.of[k] - normal.of[k]) / (1 - normal.of[k]);
  for (int m = 0; m < kRest; ++m) lack.of[Count + m] -= normal.of[Count + m];
  return lack;
}

/// That of further bounces: its mean over l outside (materials/energy.h), as a share of all of
/// them.
template <bool Inside, int Count, class Facets>
Parts<Count> further(const Facets& facets, double glass) {
  const InterfaceLoss<double> outside{facets.interface(), facets.ax, facets.ay, glass},
      inside{facets.interface(), facets.ax, facets.ay, 1 / glass};
  const double mean_outside = outside.mean(), mean_inside = inside.mean();
  const double across = Inside ? transmitted_share(mean_inside, mean_outside, 1 / glass)
                               : transmitted_share(mean_outside, mean_inside, glass);
  const bool round = facets.ax == facets.ay;
  const auto azimuth_mean = [&](const auto& f) {
    return quarter_mean(facets.ax / facets.ay, round ? 1 : 6, f);
  };
  std::vector<decltype(along_azimuth(outside, 0, 0))> along;
  azimuth_mean([&](double x, double y) {
    along.push_back(along_azimuth(outside, x, y));
    return 0.0;
  });
  const auto sum = height_mean(
      [&](double z, double s) {
        auto next = along.begin();
        const double l = azimuth_mean([&](double, double) { return (*next++)(z, s); });
        Numbers<Count + kRest + 1> to;
        const auto lack = lacks<Inside, Count>(z) * l;
        std::copy(lack.of.begin(), lack.of.end(), to.of.begin());
        to.of.back() = l;
        return to;
      },
      facets.ax * facets.ay, 0, round ? 24 : 12);
  Parts<Count> parts;
  std::copy_n(sum.of.begin(), Count + kRest, parts.of.begin());
  return parts * ((Inside ? across : 1 - across) / sum.of.back());
}

/// The integrals for light along `w`, z > 0.
template <bool Inside, int Count, class Facets>
Parts<Count> sent_back(const Facets& facets, double glass, Vec3d w, const Parts<Count>& further) {
  const double eta = Inside ? 1 / glass : glass;
  Parts<Count> sent =
      interface_mean(facets, eta, w, Inside ? 14 : 24, [](const Way& up, const Way& down) {
        const Way& out = Inside ? down : up;
        const double leaves = out.share * (1 - out.taken);
        return leaves > 0 ? lacks<Inside, Count>(out.cosine) * leaves : Parts<Count>();
      });
  sent += further * InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, eta}.at(w);
  return sent;
}

/// The |cosine| at a place on the axis of directions.
double cosine_at(bool inside, double place, double alpha, double glass) {
  return cosine(std::min(place, 1 - kLeast), [&](double c, double s) {
    return axes::glass_direction(inside, c, s, alpha, glass);
  });
}

/// What is in both tables of stretched facets.
struct Bent {
  std::vector<float> steep, rest;
};
/// From those of round ones.
template <bool Inside, template <class> class Distribution>
Bent bent_side(const GlassTables& round) {
  constexpr axes::BentGlassGrid grid = axes::kBentGlass[Inside];
  constexpr int coats = grid.coat, columns = coats + kRest;
  const ShapeFit shapes(grid.degree);
  const int count = shapes.count(), terms = shapes.terms();
  const auto zero = [](const double*) { return 0.0; };
  Grid steep({grid.width, grid.index, grid.direction, coats, terms}, zero);
  Grid rest({grid.width, grid.index, grid.direction, kRest * terms}, zero);
  parallel(grid.width * grid.index, [&](int i) {
    const double like = alpha_at(double(i / grid.index) / (grid.width - 1));
    const double glass = index_at(double(i % grid.index) / (grid.index - 1));
    std::vector<std::vector<double>> values(grid.direction * columns, std::vector<double>(count));
    for (int shape = 0; shape < count; ++shape) {
      auto seen = shapes.facets_like(shape, like, axes::widening(Inside ? 1 / glass : glass, like));
      const double x = seen.x, y = seen.y;
      const Distribution<double> facets{{seen.wide, seen.narrow}};
      const auto further_bounces = further<Inside, coats>(facets, glass);
      for (int d = 0; d < grid.direction; ++d) {
        const double z = std::max(cosine_at(Inside, double(d) / (grid.direction - 1), like, glass),
                                  kLeast * seen.root());
        const double s = std::sqrt(1 - z * z);
        seen.x = x * s, seen.y = y * s, seen.z = z;
        const auto sent =
            sent_back<Inside, coats>(facets, glass, {seen.x, seen.y, z}, further_bounces);
        CoatOnGlass<double> coat{.steep = 1, .rest = {1, 1, 1, 1}};
        const auto value = [&](int column) -> double& {
          return values[d * columns + column][shape];
        };
        for (int k = 0; k < coats; ++k) {
          coat.eta = index_at(double(k) / (coats - 1));
          value(k) = sent.of[k] - round_parts(round, seen, Inside, glass, coat).steep;
        }
        const auto parts = round_parts(round, seen, Inside, glass, coat);
        for (int m = 0; m < kRest; ++m) value(coats + m) = sent.of[coats + m] - parts.rest[m];
      }
    }
    for (int d = 0; d < grid.direction; ++d)
      for (int column = 0; column < columns; ++column)
        for (int t = 0; t < terms; ++t) {
          const double term = shapes.term(t, values[d * columns + column].data());
          const int at = i * grid.direction + d, m = column - coats;
          (m < 0 ? steep.values[(at * coats + column) * terms + t]
                 : rest.values[(at * kRest + m) * terms + t]) = term;
        }
  });
  const std::vector<double> of_steep = steep.spline(1), of_rest = rest.spline(1);
  return {{of_steep.begin(), of_steep.end()}, {of_rest.begin(), of_rest.end()}};
}

template <bool Inside, template <class> class Distribution>
void write_side(const TableFiles& to, const std::string& name) {
  using namespace axes;
  constexpr int widths = kGlassAlpha, indices = kGlassIndex, directions = kGlassDirection[Inside],
                coats = kGlassCoat[Inside];
  const std::string side = Inside ? "Inside" : "Outside";
  const auto zero = [](const double*) { return 0.0; };
  Grid steep({widths, indices, directions, coats}, zero);
  Grid rest({widths, indices, directions, kRest}, zero);
  parallel(widths * indices, [&](int i) {
    const double alpha = alpha_at(double(i / indices) / (widths - 1));
    const double glass = index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto further_bounces = further<Inside, coats>(facets, glass);
    for (int d = 0; d < directions; ++d) {
      const double z =
          std::max(cosine_at(Inside, double(d) / (directions - 1), alpha, glass), kLeast * alpha);
      const auto sent =
          sent_back<Inside, coats>(facets, glass, {std::sqrt(1 - z * z), 0, z}, further_bounces);
      const int at = i * directions + d;
      for (int k = 0; k < coats; ++k)
        steep.values[at * coats + k] = Inside ? std::sqrt(std::max(sent.of[k], 0.0)) : sent.of[k];
      for (int m = 0; m < kRest; ++m) rest.values[at * kRest + m] = sent.of[coats + m];
    }
  });
  const auto write = [&](const std::string& part, const std::vector<double>& spline) {
    std::vector<float> numbers(spline.begin(), spline.end());
    write_numbers(to, name + part + side, numbers);
    return numbers;
  };
  const auto round_steep = write("Steep", steep.spline());
  const auto round_rest = write("Rest", rest.spline(1));
  GlassTables tables{};
  tables.steep[Inside] = round_steep.data();
  tables.rest[Inside] = round_rest.data();
  const Bent bent = bent_side<Inside, Distribution>(tables);
  write_numbers(to, name + "BentSteep" + side, bent.steep);
  write_numbers(to, name + "BentRest" + side, bent.rest);
}

}  // namespace
}  // namespace tables
}  // namespace mms::materials

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](const tables::TableFiles& to) {
    tables::write_side<false, Ggx>(to, "kGgx");
    tables::write_side<true, Ggx>(to, "kGgx");
    tables::write_side<false, Beckmann>(to, "kBeckmann");
    tables::write_side<true, Beckmann>(to, "kBeckmann");
  });
}
