// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/energy.h and writes them as C++ to the named file: run by the
// build, on two threads or more, for about one and a half minutes of one core.
#include <atomic>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include "materials/fresnel.h"
#include "materials/glossy.h"
#include "materials/tables/visible.h"

namespace mms::materials::tables {
namespace {

/// Calls body(i) for 0 <= i < n on all cores.
void parallel(int n, const std::function<void(int)>& body) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i; (i = next++) < n;) body(i);
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
}

/// Coefficients of the spline through `values` (at least five) at uniform nodes; the third
/// derivative is continuous at the second and the last but one ("not a knot").
std::vector<double> fit(const std::vector<double>& values) {
  const int n = int(values.size()), size = n + 2;
  std::vector<std::vector<double>> a(size, std::vector<double>(size + 1));
  for (int i = 0; i < n; ++i) {
    a[i][i] = a[i][i + 2] = 1.0 / 6;
    a[i][i + 1] = 4.0 / 6;
    a[i][size] = values[i];
  }
  constexpr double fourth[] = {1, -4, 6, -4, 1};
  for (int j = 0; j < 5; ++j) a[n][j] = a[n + 1][size - 5 + j] = fourth[j];
  for (int p = 0; p < size; ++p) {
    int best = p;
    for (int i = p; i < size; ++i)
      if (std::abs(a[i][p]) > std::abs(a[best][p])) best = i;
    std::swap(a[p], a[best]);
    for (int i = 0; i < size; ++i) {
      if (i == p || a[i][p] == 0) continue;
      const double factor = a[i][p] / a[p][p];
      for (int j = p; j <= size; ++j) a[i][j] -= factor * a[p][j];
    }
  }
  std::vector<double> c(size);
  for (int i = 0; i < size; ++i) c[i] = a[i][size] / a[i][i];
  return c;
}

/// Values over a grid of any dimension, the last axis innermost.
struct Grid {
  std::vector<int> nodes;
  std::vector<double> values;

  /// `value(x)`: x[k] in [0, 1] along axis k.
  Grid(std::vector<int> n, const std::function<double(const double*)>& value)
      : nodes(std::move(n)) {
    int total = 1;
    for (int k : nodes) total *= k;
    values.resize(total);
    parallel(total, [&](int i) {
      double x[8];
      int rest = i;
      for (int k = int(nodes.size()) - 1; k >= 0; --k) {
        x[k] = double(rest % nodes[k]) / (nodes[k] - 1);
        rest /= nodes[k];
      }
      values[i] = value(x);
    });
  }

  /// Coefficients along every axis, in the same order.
  std::vector<double> spline() const {
    std::vector<double> data = values;
    int inner = 1;
    for (int k = int(nodes.size()) - 1; k >= 0; --k) {
      const int n = nodes[k], m = coefficients(n), outer = int(data.size()) / (n * inner);
      std::vector<double> out(std::size_t(outer) * m * inner);
      for (int o = 0; o < outer; ++o)
        for (int i = 0; i < inner; ++i) {
          std::vector<double> line(n);
          for (int j = 0; j < n; ++j) line[j] = data[(o * n + j) * inner + i];
          line = fit(line);
          for (int j = 0; j < m; ++j) out[(o * m + j) * inner + i] = line[j];
        }
      data = std::move(out);
      inner *= m;
    }
    return data;
  }
};

/// Writes the table and returns it.
std::vector<float> write(std::FILE* to, const std::string& name, const Grid& grid) {
  const std::vector<double> spline = grid.spline();
  const std::vector<float> table(spline.begin(), spline.end());
  std::fprintf(to, "const float %s[] = {", name.c_str());
  for (std::size_t i = 0; i < table.size(); ++i)
    std::fprintf(to, "%s%.8eF,", i % 8 ? "" : "\n", double(table[i]));
  std::fprintf(to, "\n};\n");
  return table;
}

constexpr double kTolerance = 4e-6;

/// The loss of one bounce off lossless facets.
template <class Facets>
double loss(const Facets& facets, Vec3d wo, double tolerance = kTolerance) {
  const auto mirrored = [&](Vec3d h) { return h * (2 * dot(wo, h)) - wo; };
  const double so = facets.shadow(wo);
  return visible_mean(
      facets, wo,
      [&](Vec3d h) {
        const Vec3d wi = mirrored(h);
        if (!(wi.z > 0)) return 1.0;
        const double s = wo.z * facets.shadow(wi);
        return s / (wo.z * wi.z + so * wi.z + s);
      },
      [&](Vec3d h) { return std::array{mirrored(h).z}; }, tolerance);
}

/// cos theta from its place on the axis axes::direction of a surface of that width.
double cosine(double place, double width) {
  const double half = place * kPi<double> / 2, s = std::sin(half), c = std::cos(half);
  const double z = s * s, t = c * std::sqrt(1 + s * s);  // of the stretched direction
  return width * z / std::hypot(width * z, t);
}

constexpr double kLeast = 1e-7;  // an axis' first direction and width, instead of 0

template <template <class> class Distribution>
double isotropic_loss(double alpha, double place) {
  alpha = std::max(alpha, 1e-5);
  const double z =
      std::max(cosine(std::min(place, 1 - kLeast), axes::width(alpha)), kLeast * alpha);
  return loss(Distribution<double>{{alpha, alpha}}, {std::sqrt(1 - z * z), 0, z});
}

/// Mean over the hemisphere in units of mean_unit of what the tables say, so that what is given
/// back sums to what they say is lost; z^2 + alpha^2 spread evenly over its logarithm.
template <class Loss>
double mean_loss(const Loss& loss, double alpha2, int azimuths) {
  const double log = std::log1p(1 / alpha2);
  double sum = 0;
  for (int i = 0; i < azimuths; ++i) {
    const double phi = (i + 0.5) / azimuths * kPi<double> / 2;
    const auto f = [&](double u) {
      const double z2 = std::min(1.0, alpha2 * std::expm1(u * log)), s = std::sqrt(1 - z2);
      const Vec3d w{s * std::cos(phi), s * std::sin(phi), std::sqrt(z2)};
      return loss.at(w) * (z2 / alpha2 + 1);
    };
    constexpr int panels = 24;
    for (int k = 0; k < panels; ++k) sum += integrate<8>(f, double(k) / panels, (k + 1.0) / panels);
  }
  return sum / azimuths;
}

/// The loss at one facet's interface of relative index `eta`: what it reflects or refracts and
/// other facets then take, or what leaves to the wrong side.
double interface_loss(double alpha, double eta, double z) {
  const Ggx<double> facets{{alpha, alpha}};
  const Vec3d wo{std::sqrt(1 - z * z), 0, z};
  const double so = facets.shadow(wo);
  const auto hidden = [&](Vec3d wi) {  // G2 / G1 away from 1
    const double s = z * facets.shadow(wi), c = std::abs(wi.z);
    return s / (z * c + so * c + s);
  };
  const auto refraction = [&](Vec3d h, double c) {
    const double g2 = refraction_g2(c, eta);
    return (h * ((1 - eta) * (1 + eta) / (c + std::sqrt(std::max(0.0, g2)))) - wo);
  };
  return visible_mean(
      facets, wo,
      [&](Vec3d h) {
        const double c = std::clamp(dot(wo, h), 0.0, 1.0);
        const FresnelSplit<double> f = fresnel_split(c, eta);
        const Vec3d r = h * (2 * c) - wo, t = normalize(refraction(h, c));
        return f.reflected * (r.z > 0 ? hidden(r) : 1) + f.transmitted * (t.z < 0 ? hidden(t) : 1);
      },
      [&](Vec3d h) {
        const double c = std::clamp(dot(wo, h), 0.0, 1.0);
        return std::array{2 * c * h.z - z, refraction(h, c).z, refraction_g2(c, eta)};
      },
      1e-5);
}

/// The relative index of a place on its axis; `rising`: above 1.
double index_at(double place, bool rising) {
  const double x = std::clamp(place * place * place * place, 1e-7, 1 - 1e-4);
  return rising ? (1 + x) / (1 - x) : (1 - x) / (1 + x);
}

/// How a mean's width is laid out: the inverse of axes::log_alpha.
double from_log(double x, double largest) {
  return axes::kMinMeanAlpha * std::pow(largest / axes::kMinMeanAlpha, x);
}

/// cos theta from its place on axes::interface_direction, by halving.
double interface_cosine(double place, double width) {
  double lo = 0, hi = 1;
  for (int i = 0; i < 60; ++i) {
    const double angle = (lo + hi) * kPi<double> / 4;
    (axes::interface_direction(std::sin(angle), std::cos(angle), width) < place ? lo : hi) =
        (lo + hi) / 2;
  }
  return std::sin(lo * kPi<double> / 2);
}

void write_interface(std::FILE* to, const std::string& name, bool rising) {
  using namespace axes;
  const auto table = write(
      to, name,
      Grid({kInterfaceAlpha, kIndex[!rising], kInterfaceDirection[!rising]}, [&](const double* x) {
        const double a = std::max(x[0] * x[0], 1e-5);
        const double z = interface_cosine(std::min(x[2], 1 - kLeast), axes::width(a));
        return interface_loss(a, index_at(x[1], rising), std::max(z, kLeast * a));
      }));
  const InterfaceTables tables{{table.data(), table.data()}, {}};
  write(to, name + "Mean", Grid({kInterfaceMean, kIndex[!rising]}, [&](const double* x) {
          const double a = from_log(x[0], 1);
          return mean_loss(InterfaceLoss<double>{a, index_at(x[1], rising), &tables}, a * a, 1);
        }));
}

/// Over x = cos^2, by the inverse of the latitudal distribution.
double coat_mean(double gloss, double eta, double z) {
  const Latitude<double> latitude(gloss);
  const double y = z * z, s2 = (1 - z) * (1 + z);
  const auto f = [&](double u) {
    const double x = latitude.inverse(u, 1 - u, y, s2);
    return fresnel_dielectric(std::sqrt(std::clamp(x, 0.0, 1.0)), eta);
  };
  // x grows as a square where it is small: substitute it away at both ends.
  const auto g = [&](double v) { return 6 * v * (1 - v) * f(v * v * (3 - 2 * v)); };
  return integrate_adaptive(g, 0, 0.5, 1e-7, 12) + integrate_adaptive(g, 0.5, 1, 1e-7, 12);
}

void write_coat(std::FILE* to) {
  using namespace axes;
  write(to, "kGlossyCoatTable", Grid({kGloss, kCoatIndex, kCoatDirection}, [](const double* x) {
          const double gloss = std::expm1(x[0] * std::log1p(kLargestGloss));
          const double eta = index_at(x[1], true);
          const double z = std::sin(std::max(x[2] * x[2] * x[2] * x[2], 1e-9) * kPi<double> / 2);
          return coat_mean(gloss, eta, z) - fresnel_dielectric(z, eta);
        }));
}

template <template <class> class Distribution>
void write_facets(std::FILE* to, const std::string& name) {
  using namespace axes;
  const auto round = write(to, name + "Loss", Grid({kAlpha, kDirection}, [](const double* x) {
                             return isotropic_loss<Distribution>(x[0] * x[0], x[1]);
                           }));
  const auto stretched =
      write(to, name + "Stretched",
            Grid({kStretchedAlpha, kAspect, kAzimuth, kStretchedDirection}, [](const double* x) {
              const double wide = std::max(x[0] * x[0] * kMaxStretched, 1e-5);
              const double narrow = wide * std::pow(10, -x[1]);
              // The stretched direction: x[2] is the share of its tangent's square along x.
              const double c = std::sqrt(x[2]) / wide, s = std::sqrt(1 - x[2]) / narrow;
              const double stretch = 1 / std::hypot(c, s);
              const double z = std::max(
                  cosine(std::min(x[3], 1 - kLeast), stretch / (1 + wide * wide)), kLeast * wide);
              const double r = std::sqrt(1 - z * z) * stretch;
              return loss(Distribution<double>{{wide, narrow}}, {r * c, r * s, z}, 4e-5);
            }));
  const FacetTables tables{round.data(), nullptr, stretched.data(), nullptr};
  write(to, name + "Mean", Grid({kMean}, [&](const double* x) {
          const double a = from_log(x[0], 1);
          return mean_loss(FacetLoss<double>{&tables, a, a}, a * a, 1);
        }));
  write(to, name + "StretchedMean", Grid({kStretchedMean, kMeanAspect}, [&](const double* x) {
          const double wide = from_log(x[0], kMaxStretched);
          const double narrow = wide * std::pow(10, -x[1] - 1e-9);
          return mean_loss(FacetLoss<double>{&tables, wide, narrow}, wide * narrow, 12);
        }));
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  if (argc != 2) {
    std::fprintf(stderr, "usage: mms_tables FILE\n");
    return 2;
  }
  std::FILE* to = std::fopen(argv[1], "w");
  if (!to) {
    std::perror(argv[1]);
    return 1;
  }
  tables::write_facets<Ggx>(to, "kGgx");
  tables::write_facets<Beckmann>(to, "kBeckmann");
  tables::write_coat(to);
  tables::write_interface(to, "kGgxDense", true);
  tables::write_interface(to, "kGgxRare", false);
  if (std::fclose(to) != 0) {
    std::perror(argv[1]);
    return 1;
  }
  return 0;
}
