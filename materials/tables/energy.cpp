// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/energy.h and writes them as C++ to the named file: run by the
// build, on two threads or more, for about seven minutes of one core.
#include <cstdio>
#include <string>

#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/shapes.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {
namespace {

/// Writes the table and returns it.
std::vector<float> write(const TableFiles& to, const std::string& name, const Grid& grid) {
  const std::vector<double> spline = grid.spline();
  const std::vector<float> table(spline.begin(), spline.end());
  write_numbers(to, name, table);
  return table;
}

/// Mean over the hemisphere in units of mean_unit of what the tables say, so that what is given
/// back sums to what they say is lost. Of twelve azimuths, or one where all are alike.
template <class Loss>
double mean_loss(const Loss& loss, double ridge = 0) {
  return quarter_mean(loss.ax / loss.ay, loss.ax > loss.ay ? 12 : 1, [&](double x, double y) {
    return height_mean(along_azimuth(loss, x, y), loss.ax * loss.ay, ridge, 32);
  });
}

/// How a mean's width is laid out: the inverse of axes::log_alpha.
double from_log(double x) { return std::pow(axes::kMinMeanAlpha, 1 - x); }

/// Tables of round facets: the loss and its mean; and what else is said of a distribution.
struct RoundInterface {
  float least_mean = 0, kink = 0;
  const BentGrid* bent = nullptr;
  std::vector<float> loss{}, mean{};
  InterfaceTables tables() const {
    return {{loss.data(), loss.data()}, {mean.data(), mean.data()}, bent, {}, {}, least_mean, kink};
  }
};

/// The tables hold the root of the loss: it falls less steeply, and float keeps more of its digits.
template <template <class> class Distribution>
RoundInterface write_round_interface(const TableFiles& to, const std::string& name, bool rising,
                                     RoundInterface round) {
  using namespace axes;
  round.loss = write(
      to, name,
      Grid({kInterfaceAlpha[!rising], kIndex[!rising], kInterfaceDirection[!rising]},
           [&](const double* x) {
             const double a = std::max(x[0] * x[0] * x[0], 1e-5), eta = index_of(x[1], rising);
             const double c = cosine(std::min(x[2], 1 - kLeast), [&](double z, double s) {
               return interface_direction(z, s, a, eta);
             });
             const double z = std::max(c, kLeast * a);
             return std::sqrt(interface_loss(Distribution<double>{{a, a}}, eta,
                                             {std::sqrt(1 - z * z), 0, z}, 24));
           }));
  const InterfaceTables tables = round.tables();
  round.mean =
      write(to, name + "Mean", Grid({kInterfaceMean, kIndex[!rising]}, [&](const double* x) {
              const double a = from_log(x[0]), eta = index_of(x[1], rising);
              return mean_loss(InterfaceLoss<double>{tables, a, a, eta}, ridge_of(eta));
            }));
  return round;
}

/// Both widths of stretched facets, their geometric mean `root` and the place of their quotient.
std::array<double, 2> bent_widths(double root, double place) {
  const double aspect = std::pow(10, std::pow(place, 1 / 0.7) / 2);
  return {root * aspect, root / aspect};
}

/// What stretched facets, as wide as round ones of `like` along a direction of |cosine| `c`, lose
/// above these, over their scale: polynomials of `value(facets, sine)` at all shapes.
template <class Value>
void fit_shapes(const ShapeFit& shapes, double like, double c, double widening, const Value& value,
                double* to) {
  std::vector<double> values;
  for (int shape = 0; shape < shapes.count(); ++shape) {
    auto seen = shapes.facets_like(shape, like, widening);
    const double z = std::max(c, kLeast * seen.root()), s = std::sqrt(1 - z * z);
    seen.x *= s, seen.y *= s, seen.z = z;
    values.push_back(value(seen, s) / seen.scale());
  }
  for (int t = 0; t < shapes.terms(); ++t) to[t] = shapes.term(t, values.data());
}

/// InterfaceTables::stretched, of one side.
template <template <class> class Distribution>
std::vector<float> stretched_difference(bool rising, const InterfaceTables& round) {
  using namespace axes;
  const BentGrid& nodes = round.bent[!rising];
  const int widths = nodes.width, indices = nodes.index, directions = nodes.direction;
  const ShapeFit shapes(nodes.shapes);
  Grid fitted({widths, indices, directions, shapes.terms()});
  parallel(widths * indices * directions, [&](int i) {
    const double x[] = {double(i / (indices * directions)) / (widths - 1),
                        double(i / directions % indices) / (indices - 1),
                        double(i % directions) / (directions - 1)};
    const double like = bent_width_at(x[0]), eta = bent_index_at(x[1], rising, round.kink);
    const RoundInterfaceLoss<double> loss(round, like, eta);
    fit_shapes(
        shapes, like, bent_cosine_at(x[2], like, eta, round.kink), widening(eta, like),
        [&](const StretchedFacets<double>& f, double s) {
          const Distribution<double> facets{{f.wide, f.narrow}};
          return interface_loss(facets, eta, {f.x, f.y, f.z}, slopes_of(facets).kPoints) -
                 loss.at(f.z, s);
        },
        &fitted.values[i * shapes.terms()]);
  });
  const std::vector<double> spline = fitted.spline(1);
  return {spline.begin(), spline.end()};
}

/// And its mean.
template <template <class> class Distribution>
void write_stretched_interface(const TableFiles& to, const std::string& name, bool rising,
                               const RoundInterface& round) {
  using namespace axes;
  InterfaceTables tables = round.tables();
  const auto difference = stretched_difference<Distribution>(rising, tables);
  write_numbers(to, name + "Stretched", difference);
  tables.stretched[!rising] = difference.data();
  write(to, name + "StretchedMean",
        Grid({kBentMeanAlpha, kBentMeanAspect, kBentMeanIndex}, [&](const double* x) {
          const double root = kLeastBentFourthRoot + (1 - kLeastBentFourthRoot) * x[0];
          const double alpha = std::pow(root, 4);
          const auto [wide, narrow] = bent_widths(alpha, x[1]);
          const double eta = bent_index_at(x[2], rising);
          const InterfaceLoss<double> like{tables, alpha, alpha, eta},
              loss{tables, wide, narrow, eta};
          return mean_loss(loss, ridge_of(eta)) * mean_unit(alpha * alpha) / like.mean();
        }));
}

template <template <class> class Distribution>
void write_interface(const TableFiles& to, const std::string& name, const RoundInterface& known) {
  for (const bool rising : {true, false}) {
    const std::string side = name + (rising ? "Dense" : "Rare");
    write_stretched_interface<Distribution>(
        to, side, rising, write_round_interface<Distribution>(to, side, rising, known));
  }
}

/// FacetTables::stretched.
template <template <class> class Distribution>
std::vector<float> stretched_mirrors(const FacetTables& round) {
  using namespace axes;
  const ShapeFit shapes(kStretchedShapes);
  Grid fitted({kStretchedWidth, kStretchedDirection, shapes.terms()});
  parallel(kStretchedWidth * kStretchedDirection, [&](int i) {
    const double like = bent_width_at(double(i / kStretchedDirection) / (kStretchedWidth - 1));
    const double place = double(i % kStretchedDirection) / (kStretchedDirection - 1);
    const double c = cosine(std::min(place, 1 - kLeast),
                            [&](double z, double s) { return dense_direction(z, s, width(like)); });
    const FacetLoss<double> same{&round, like, like};
    fit_shapes(
        shapes, like, c, kMirrorWidening,
        [&](const StretchedFacets<double>& f, double s) {
          return loss(Distribution<double>{{f.wide, f.narrow}}, {f.x, f.y, f.z}, 44) -
                 same.round(like, f.z, s);
        },
        &fitted.values[i * shapes.terms()]);
  });
  const std::vector<double> spline = fitted.spline(1);
  return {spline.begin(), spline.end()};
}

template <template <class> class Distribution>
void write_facets(const TableFiles& to, const std::string& name) {
  using namespace axes;
  const std::vector<float> round = round_losses<Distribution>();
  write_numbers(to, name + "Loss", round);
  FacetTables tables{round.data(), nullptr, nullptr, nullptr};
  const std::vector<float> stretched = stretched_mirrors<Distribution>(tables);
  write_numbers(to, name + "Stretched", stretched);
  tables.stretched = stretched.data();
  write(to, name + "Mean", Grid({kMean}, [&](const double* x) {
          const double a = from_log(x[0]);
          return mean_loss(FacetLoss<double>{&tables, a, a});
        }));
  write(to, name + "StretchedMean", Grid({kStretchedMean, kMeanAspect}, [&](const double* x) {
          const double alpha = from_log(x[0]), wide = alpha * std::pow(10, x[1] / 2 + 1e-9);
          const double narrow = alpha * alpha / wide;
          return mean_loss(FacetLoss<double>{&tables, wide, narrow});
        }));
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](const tables::TableFiles& to) {
    tables::write_facets<Ggx>(to, "kGgx");
    tables::write_facets<Beckmann>(to, "kBeckmann");
    tables::write_interface<Ggx>(to, "kGgx", {kGgxLeastMean, kGgxKink, kGgxBent});
    tables::write_interface<Beckmann>(to, "kBeckmann",
                                      {kBeckmannLeastMean, kBeckmannKink, kBeckmannBent});
  });
}
