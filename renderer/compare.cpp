// SPDX-License-Identifier: Apache-2.0
#include "renderer/compare.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "materials/colour.h"

namespace mms::renderer {
namespace {

constexpr MeasureInfo kMeasures[] = {
    {Measure::Rmse, "rmse", "root mean square of linear values, 0.21 R + 0.72 G + 0.07 B (7.1)"},
    {Measure::RmseShown, "rmse-shown", "the same of what is shown, in [0, 1]"},
    {Measure::RelativeMse, "relmse", "mean of (a - b)^2 / (b^2 + 0.01) over channels"},
    {Measure::Dssim, "dssim", "1 - structural similarity of what is shown"},
};

/// Thesis 7.1: what the channels weigh in the distance of colour pictures.
constexpr double kWeights[] = {0.21, 0.72, 0.07};

/// Keeps relative errors of dark pixels finite: an error of 0.1 there counts as 1.
constexpr double kRelativeFloor = 0.01;

/// A part of a picture.
struct Part {
  Rect rect;
  int stride;  ///< of the whole picture
  std::size_t at(std::size_t i) const {
    const std::size_t w = std::size_t(rect.width());
    return (std::size_t(rect.y0) + i / w) * std::size_t(stride) + std::size_t(rect.x0) + i % w;
  }
};

bool finite(const std::array<float, 3>& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

double luminance(const std::array<float, 3>& p) {
  return materials::xyz_of_linear_srgb({p[0], p[1], p[2]}).y;
}

/// Root mean squares of the channels, and their weighted sum.
struct Roots {
  double sum[3] = {0, 0, 0};
  void add(int k, double difference) { sum[k] += difference * difference; }
  std::array<double, 3> roots(double count) const {
    std::array<double, 3> r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = std::sqrt(sum[k] / count);
    return r;
  }
  static double weighted(const std::array<double, 3>& r) {
    return kWeights[0] * r[0] + kWeights[1] * r[1] + kWeights[2] * r[2];
  }
};

/// Display values of the part, three a pixel; pixels that are not finite are black.
Result<std::vector<float>> shown(const ReadPicture& picture, const Part& part, const View& view) {
  const Rect& r = part.rect;
  Film film{r.width(), r.y1 - r.y0, {}, {}};
  std::vector<float> values;
  for (std::size_t i = 0; i < r.area(); ++i) {
    std::array<float, 3> p = picture.rgb[part.at(i)];
    if (!finite(p)) p = {0, 0, 0};
    if (picture.encoded) {
      for (const float v : p) values.push_back(float(materials::srgb_encode(v)));
      continue;
    }
    const Vec3d xyz = materials::xyz_of_linear_srgb({p[0], p[1], p[2]});
    film.xyz.push_back({xyz.x, xyz.y, xyz.z});
  }
  if (picture.encoded) return values;
  return display_values(film, view);
}

/// Luma of encoded values, by the same weights.
std::vector<double> luma(const std::vector<float>& values) {
  std::vector<double> y(values.size() / 3);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) y[i] += kWeights[k] * double(values[3 * i + k]);
  return y;
}

/// Gaussian of deviation 1.5 over 11 x 11 pixels; at the edges over those that there are.
class Window {
 public:
  Window(int width, int height) : width_(width), height_(height) {
    for (int i = -kReach; i <= kReach; ++i)
      weight_[i + kReach] = std::exp(-i * i / (2 * kDeviation * kDeviation));
  }

  std::vector<double> blur(const std::vector<double>& from) const {
    return pass(pass(from, width_, 1), height_, width_);
  }

 private:
  static constexpr int kReach = 5;
  static constexpr double kDeviation = 1.5;

  /// Along one axis of `length` pixels that are `step` apart.
  std::vector<double> pass(const std::vector<double>& from, int length, int step) const {
    std::vector<double> to(from.size());
    for (int i = 0; i < int(from.size()); ++i) {
      const int place = i / step % length;
      double sum = 0, weights = 0;
      for (int k = std::max(-kReach, -place); k <= std::min(kReach, length - 1 - place); ++k) {
        sum += weight_[k + kReach] * from[std::size_t(i + k * step)];
        weights += weight_[k + kReach];
      }
      to[std::size_t(i)] = sum / weights;
    }
    return to;
  }

  int width_, height_;
  double weight_[2 * kReach + 1];
};

/// Mean structural similarity (Wang et al. 2004) of two pictures in [0, 1], with the constants of
/// the paper.
double similarity(const std::vector<double>& a, const std::vector<double>& b, int width,
                  int height) {
  const auto times = [](const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> product(x.size());
    std::transform(x.begin(), x.end(), y.begin(), product.begin(), std::multiplies<>());
    return product;
  };
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const Window w(width, height);
  const auto ma = w.blur(a), mb = w.blur(b);
  const auto aa = w.blur(times(a, a)), bb = w.blur(times(b, b)), ab = w.blur(times(a, b));
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double m = ma[i] * mb[i], ma2 = ma[i] * ma[i], mb2 = mb[i] * mb[i];
    sum += (2 * m + c1) * (2 * (ab[i] - m) + c2) /
           ((ma2 + mb2 + c1) * (aa[i] - ma2 + bb[i] - mb2 + c2));
  }
  return sum / double(a.size());
}

/// Of a value that is a sum of floats, relative to it.
constexpr double kRounding = 0x1p-22;

void compare_linear(const ReadPicture& a, const ReadPicture& b, const Part& part, Comparison& c) {
  const bool known = !a.variance.empty() && !b.variance.empty();
  Roots linear;
  double relative = 0, z = 0;
  std::size_t count = 0, with_variance = 0;
  for (std::size_t i = 0; i < part.rect.area(); ++i) {
    const std::size_t at = part.at(i);
    const auto &p = a.rgb[at], &q = b.rgb[at];
    if (!finite(p) || !finite(q)) {
      for (std::size_t k = 0; k < 3; ++k)
        if (!(p[k] == q[k])) {
          ++c.not_finite;
          break;
        }
      continue;
    }
    ++count;
    for (int k = 0; k < 3; ++k) {
      const double d = double(p[std::size_t(k)]) - double(q[std::size_t(k)]);
      linear.add(k, d);
      relative += d * d / (double(q[std::size_t(k)]) * q[std::size_t(k)] + kRelativeFloor);
      c.largest = std::max(c.largest, std::abs(d));
    }
    if (!known) continue;
    const double chance = double(a.variance[at]) + double(b.variance[at]);
    if (!(chance > 0)) continue;
    ++with_variance;
    // Where next to nothing is left to chance, what float keeps of a value is.
    const double d = luminance(p) - luminance(q), kept = kRounding * luminance(q);
    z += d * d / (chance + kept * kept);
  }
  const double n = double(std::max<std::size_t>(1, count));
  c.channel = linear.roots(n);
  c.value[std::size_t(Measure::Rmse)] = Roots::weighted(c.channel);
  c.value[std::size_t(Measure::RelativeMse)] = relative / (3 * n);
  if (with_variance > 0) c.z = std::sqrt(z / double(with_variance));
}

}  // namespace

std::span<const MeasureInfo> measures() { return kMeasures; }

Result<Comparison> compare(const ReadPicture& a, const ReadPicture& b, const View& view,
                           std::optional<Rect> part) {
  if (a.width != b.width || a.height != b.height)
    return Error{"",
                 fmt::format("sizes differ: {}x{} and {}x{}", a.width, a.height, b.width, b.height),
                 "compare pictures of one size"};
  const Rect r = part.value_or(Rect{0, 0, a.width, a.height});
  if (r.x0 < 0 || r.y0 < 0 || r.x1 > a.width || r.y1 > a.height || r.x0 >= r.x1 || r.y0 >= r.y1)
    return Error{"--crop", "the part is not in the picture",
                 fmt::format("the picture is {}x{}", a.width, a.height)};
  const Part within{r, a.width};
  const auto sa = shown(a, within, view), sb = shown(b, within, view);
  if (!sa) return sa.error();
  if (!sb) return sb.error();
  Comparison c;
  compare_linear(a, b, within, c);
  Roots roots;
  for (std::size_t i = 0; i < sa->size(); ++i)
    roots.add(int(i % 3), double((*sa)[i]) - double((*sb)[i]));
  c.value[std::size_t(Measure::RmseShown)] = Roots::weighted(roots.roots(double(r.area())));
  const std::vector<double> la = luma(*sa), lb = luma(*sb);
  c.value[std::size_t(Measure::Dssim)] =
      std::max(0.0, 1 - similarity(la, lb, r.width(), r.y1 - r.y0));
  for (std::size_t i = 0; i < la.size(); ++i) {
    double d = 0;
    for (std::size_t k = 0; k < 3; ++k)
      d += kWeights[k] * std::abs(double((*sa)[3 * i + k]) - double((*sb)[3 * i + k]));
    c.map.push_back(float(d));
  }
  return c;
}

}  // namespace mms::renderer
