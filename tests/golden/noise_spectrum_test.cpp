// SPDX-License-Identifier: Apache-2.0
// What frequencies noise has, by a discrete Fourier transform of a period of it; Gabor noise's
// contrast, range and filter. MMS_SPECTRA=1 prints the table of docs/noise.md.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <array>
#include <complex>
#include <cstdio>
#include <cstdlib>

#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"

namespace mms::golden {
namespace {

/// An expression in $uv, at points that `at(i)` gives.
template <class At>
std::vector<double> evaluated(const std::string& expression, int count, At at) {
  const Compiled c = compile("const value = " + expression + ";");
  INFO(c.text_of_errors());
  REQUIRE(c.linked);
  const vm::Program& p = c.linked->program;
  const vm::Executable executable(p);
  const int width = executable.width();
  vm::Interpreter<float> machine(width);
  auto in = points<float>(width);
  std::vector<double> all;
  for (int first = 0; first < count; first += width) {
    for (int i = 0; i < width; ++i) {
      const std::array<double, 2> uv = at(std::min(first + i, count - 1));
      for (int k = 0; k < 2; ++k) in.lanes(vm::Variable::Uv, k)[i] = float(uv[k]);
    }
    const Run r = run(machine, p, executable, p.exports.at(0).function, in, width);
    all.insert(all.end(), r.values[0].begin(), r.values[0].end());
  }
  all.resize(std::size_t(count));
  return all;
}

constexpr int kCells = 24, kPerCell = 8, kSize = kCells * kPerCell;

/// Powers of the frequencies (i, j) / kCells cycles a cell of one period of noise in the plane.
class Spectrum {
 public:
  explicit Spectrum(const std::string& expression) : power_(kSize * kSize) {
    const auto at = [](int i) {
      return std::array<double, 2>{double(i % kSize) / kPerCell, double(i / kSize) / kPerCell};
    };
    const std::vector<double> v = evaluated(expression, kSize * kSize, at);
    std::vector<std::complex<double>> rows(v.begin(), v.end());
    transform(rows);
    transform(rows);
    for (std::size_t k = 0; k < power_.size(); ++k) power_[k] = std::norm(rows[k]);
    power_[0] = 0;  // the mean
    for (double p : power_) total_ += p;
  }

  /// The share of the power at frequencies in [low, high) cycles a cell.
  double share(double low, double high) const {
    double sum = 0;
    for_each([&](double f, int, int, double power) {
      if (f >= low && f < high) sum += power;
    });
    return sum / total_;
  }
  /// The share within `radius` of the frequencies (fx, fy) and (-fx, -fy).
  double around(double fx, double fy, double radius) const {
    double sum = 0;
    for_each([&](double, int i, int j, double power) {
      for (const int sign : {-1, 1})
        if (std::hypot(double(i) / kCells - sign * fx, double(j) / kCells - sign * fy) < radius)
          sum += power;
    });
    return sum / total_;
  }
  /// The largest power at a whole number of cycles a cell along an axis, up to 3, over the mean of
  /// all frequencies as high, within a tenth.
  double lattice_peak() const {
    double most = 0;
    for (int f = 1; f <= 3; ++f) {
      double ring = 0, peak = 0;
      int count = 0;
      for_each([&](double r, int i, int j, double power) {
        if (std::fabs(r - f) < 0.1) ring += power, ++count;
        if (std::abs(i) + std::abs(j) == f * kCells && (i == 0 || j == 0)) peak += power / 4;
      });
      most = std::max(most, peak / (ring / count));
    }
    return most;
  }

 private:
  /// Of each row, and transposes.
  static void transform(std::vector<std::complex<double>>& rows) {
    std::array<std::complex<double>, kSize> turn;
    for (int k = 0; k < kSize; ++k) turn[k] = std::polar(1.0, -2 * std::acos(-1.0) * k / kSize);
    std::vector<std::complex<double>> out(rows.size());
    for (int row = 0; row < kSize; ++row)
      for (int k = 0; k < kSize; ++k) {
        double re = 0, im = 0;
        for (int i = 0, phase = 0; i < kSize; ++i, phase = (phase + k) % kSize) {
          const std::complex<double> a = rows[std::size_t(row * kSize + i)], b = turn[phase];
          re += a.real() * b.real() - a.imag() * b.imag();
          im += a.real() * b.imag() + a.imag() * b.real();
        }
        out[std::size_t(k * kSize + row)] = {re, im};
      }
    rows = std::move(out);
  }
  /// f(cycles a cell, i, j, power), i and j signed.
  template <class F>
  void for_each(F f) const {
    const auto wrap = [](int k) { return k < kSize / 2 ? k : k - kSize; };
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i) {
        const int x = wrap(i), y = wrap(j);
        f(std::hypot(x, y) / kCells, x, y, power_[std::size_t(j * kSize + i)]);
      }
  }

  std::vector<double> power_;
  double total_ = 0;
};

/// Shares of power in bands of cycles a cell, and the lattice's peak; means over seeds.
struct Row {
  std::array<double, 6> bands{};
  double peak = 0;
};
constexpr double kBands[] = {0, 0.25, 0.5, 1, 1.5, 2, 4};

Row measured(const std::string& format) {
  const int seeds = kSanitized ? 1 : 4;
  Row row;
  for (int seed = 0; seed < seeds; ++seed) {
    const Spectrum s(fmt::format(fmt::runtime(format), seed));
    for (std::size_t b = 0; b < 6; ++b) row.bands[b] += s.share(kBands[b], kBands[b + 1]) / seeds;
    row.peak += s.lattice_peak() / seeds;
  }
  if (std::getenv("MMS_SPECTRA")) {
    std::string text = fmt::format("| {} |", format.substr(0, format.find('(')));
    for (double b : row.bands) text += fmt::format(" {:.4f} |", b);
    fmt::print("{} {:.2f} |\n", text, row.peak);
  }
  return row;
}

TEST_CASE("noise has the frequencies that docs/noise.md says, and no more") {
  // {band, least and most share of the power}: limits a little beyond what four seeds give.
  struct Limit {
    double low, high, least, most;
  };
  struct Kind {
    std::string format;
    std::vector<Limit> limits;
    double peak;
  };
  const Kind kinds[] = {
      {"perlin($uv, {}, [24, 24])", {{0, 0.25, 0, 0.05}, {0.25, 1, 0.9, 1}, {1.5, 4, 0, 0.005}}, 8},
      {"valuenoise($uv, {}, [24, 24])", {{0, 1, 0.98, 1}, {1.5, 4, 0, 0.001}}, 0.01},
      {"simplex($uv, {}, [24, 24])", {{0, 0.25, 0, 0.01}, {0.5, 2, 0.9, 1}, {2, 4, 0, 0.005}}, 4},
      {"worley_f1($uv, {}, period = [24, 24])", {{0, 0.25, 0, 0.05}, {1.5, 4, 0, 0.04}}, 16},
      {"gabor($uv, [2, 0], {}, period = [24, 24])", {{0, 1, 0, 0.005}, {1, 4, 0.99, 1}}, 1e9},
      {"gabor_isotropic($uv, 1.5, {}, period = [24, 24])",
       {{0, 0.5, 0, 0.002}, {1, 2, 0.8, 1}},
       4}};
  for (const Kind& kind : kinds) {
    CAPTURE(kind.format);
    const Row row = measured(kind.format);
    for (const Limit& limit : kind.limits) {
      double share = 0;
      for (std::size_t k = 0; k < 6; ++k)
        if (kBands[k] >= limit.low && kBands[k + 1] <= limit.high) share += row.bands[k];
      // The last band ends before the corner of the spectrum.
      CHECK(share >= limit.least);
      CHECK(share <= limit.most);
    }
    if (!kSanitized) CHECK(row.peak <= kind.peak);  // of one seed it is anything
  }
  // Waves along one direction: nearly all within a cycle a cell of it.
  const Spectrum s("gabor($uv, [1.6, 1.2], 5, period = [24, 24])");
  CHECK(s.around(1.6, 1.2, 1) > 0.98);
  CHECK(s.around(1.6, -1.2, 0.5) < 0.02);
}

TEST_CASE("Gabor noise: range, mean and contrast") {
  const char* places[] = {"[37.1 * $uv.x]", "$uv", "[$uv.x, $uv.y, 0.7 * $uv.x + 3.3 * $uv.y]",
                          "[$uv.x, $uv.y, 0.7 * $uv.x + 3.3 * $uv.y, 1.9 * $uv.y - $uv.x]"};
  const char* frequencies[] = {"[3]", "[2, 1]", "[2, 1, 1]", "[1, 1, 1, 2]"};
  for (int n = 1; n <= 4; ++n) {
    CAPTURE(n);
    const int count = kSanitized ? 1000 : 20000;
    for (const std::string& call :
         {fmt::format("gabor({}, {}, 5)", places[n - 1], frequencies[n - 1]),
          fmt::format("gabor_isotropic({}, 3.0, 5)", places[n - 1])}) {
      CAPTURE(call);
      std::mt19937 random(4);
      std::uniform_real_distribution<double> any(-500, 500);
      const auto v = evaluated(call, count, [&](int) {
        return std::array{any(random), any(random)};
      });
      double most = 0, mean = 0, square = 0;
      for (double x : v)
        most = std::max(most, std::fabs(x)), mean += x / count, square += x * x / count;
      CHECK(most <= 1);
      CHECK(most > 0.7);
      // Five standard errors of 20000 points, of which few share packets.
      CHECK(std::fabs(mean) < 5 * 0.3 / std::sqrt(count / 2));
      // 0.3 before the limit, which takes a little.
      CHECK(std::fabs(std::sqrt(square) - 0.29) < (kSanitized ? 0.03 : 0.015));
    }
  }
}

TEST_CASE("filtered Gabor noise is the mean over the pixel") {
  for (const double width : {0.1, 0.25, 0.4}) {
    const std::string f = "gabor($uv, [2, 0.5], 5";
    const int pixels = kSanitized ? 100 : 200, across = 16;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-50, 50);
    std::vector<std::array<double, 2>> centres;
    for (int i = 0; i < pixels; ++i) centres.push_back({any(random), any(random)});
    const auto filtered = evaluated(fmt::format("{}, [{}, {}])", f, width, width), pixels,
                                    [&](int i) { return centres[i]; });
    const auto fine = evaluated(f + ")", pixels * across * across, [&](int i) {
      const auto& c = centres[i / (across * across)];
      const int k = i % (across * across);
      return std::array{c[0] + width * ((k % across + 0.5) / across - 0.5),
                        c[1] + width * ((k / across + 0.5) / across - 0.5)};
    });
    double error = 0, size = 0;
    for (int i = 0; i < pixels; ++i) {
      double mean = 0;
      for (int k = 0; k < across * across; ++k)
        mean += fine[i * across * across + k] / (across * across);
      error += (mean - filtered[i]) * (mean - filtered[i]) / pixels;
      size += mean * mean / pixels;
    }
    // The packet changes its form a little too: what is off is at most a tenth of the noise's 0.3.
    CHECK(std::sqrt(error) < (width < 0.2 ? 0.01 : 0.035));
    CHECK(std::sqrt(error) < 0.6 * std::sqrt(size));
  }
}

}  // namespace
}  // namespace mms::golden
