// SPDX-License-Identifier: Apache-2.0
// Looking pictures up: time of each filter and storage, near and far from the point before, against
// a native scalar bilinear lookup; bytes and error of each storage. Writes its part of
// docs/performance.md.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "bench/document.h"
#include "bench/measure.h"
#include "materials/colour.h"
#include "materials/curve.h"
#include "renderer/textures.h"

namespace mms::bench {
namespace {

constexpr int kSize = 1024, kPoints = 2048, kBatch = 256, kRounds = 9;
constexpr double kLarge = 1024, kSmall = 4;  // megabytes

/// Waves, edges and a little noise, as photographs have.
std::vector<unsigned char> picture() {
  std::vector<unsigned char> bytes;
  std::mt19937 random(1);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      for (int c = 0; c < 3; ++c) {
        const double wave = std::sin(0.013 * x * (1 + c) + 0.007 * y) * std::cos(0.021 * y - c);
        const double edge = (x / 96 + y / 96) % 2 ? 40 : 0;
        bytes.push_back(static_cast<unsigned char>(100 + 60 * wave + edge + double(random() % 8)));
      }
  return bytes;
}

struct Points {
  std::vector<float> values[vm::kImageArguments];
  /// `far`: anywhere; else along rows, half a texel from one to the next. `pixel`: its width.
  Points(bool far, float pixel) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    for (auto& v : values) v.assign(kPoints, 0);
    for (int i = 0; i < kPoints; ++i) {
      values[0][i] = far ? unit(random) : 0.5f * float(i % kSize) / kSize;
      values[1][i] = far ? unit(random) : 0.4f + 0.5f * float(i / kSize) / kSize;
      values[2][i] = pixel;
      values[5][i] = pixel;
    }
  }
};

class Lookup {
 public:
  Lookup(std::shared_ptr<const vm::Image> image, vm::ImageAsk ask, const Points& points)
      : image_(std::move(image)), ask_(ask), points_(&points), results_(6 * kPoints) {}
  void operator()() {
    for (int first = 0; first < kPoints; first += kBatch) {
      const float* in[vm::kImageArguments];
      float* out[6];
      for (int k = 0; k < vm::kImageArguments; ++k) in[k] = points_->values[k].data() + first;
      for (int k = 0; k < 6; ++k) out[k] = results_.data() + k * kPoints + first;
      image_->look_up(ask_, in, out, kBatch);
    }
  }
  const std::vector<float>& results() const { return results_; }

 private:
  std::shared_ptr<const vm::Image> image_;
  vm::ImageAsk ask_;
  const Points* points_;
  std::vector<float> results_;
};

/// A bilinear lookup as a native shader would have it: all of the picture as linear floats.
class Native {
 public:
  Native(const std::vector<unsigned char>& bytes, const Points& points)
      : points_(&points), results_(3 * kPoints) {
    for (const unsigned char b : bytes) texels_.push_back(float(materials::srgb_decode(b / 255.0)));
  }
  void operator()() {
    for (int i = 0; i < kPoints; ++i) {
      const float x = points_->values[0][i] * kSize - 0.5f;
      const float y = (1 - points_->values[1][i]) * kSize - 0.5f;
      const float fx = std::floor(x), fy = std::floor(y), u = x - fx, v = y - fy;
      const int x0 = int(fx) & (kSize - 1), x1 = (x0 + 1) & (kSize - 1);
      const int y0 = int(fy) & (kSize - 1), y1 = (y0 + 1) & (kSize - 1);
      for (int c = 0; c < 3; ++c) {
        const auto at = [&](int column, int row) {
          return texels_[std::size_t((row * kSize + column) * 3 + c)];
        };
        const float top = at(x0, y0) + u * (at(x1, y0) - at(x0, y0));
        const float bottom = at(x0, y1) + u * (at(x1, y1) - at(x0, y1));
        results_[std::size_t(c * kPoints + i)] = top + v * (bottom - top);
      }
    }
  }
  const std::vector<float>& results() const { return results_; }

 private:
  const Points* points_;
  std::vector<float> texels_, results_;
};

struct Case {
  const char* title;
  const char* filter;
  vm::ImageAsk ask;
  float pixel;
};
constexpr Case kCases[] = {
    {"nearest", "nearest", vm::ImageAsk::Colour, 0},
    {"bilinear", "bilinear", vm::ImageAsk::Colour, 0},
    {"bilinear, slope", "bilinear", vm::ImageAsk::ColourSlope, 0},
    {"bicubic", "bicubic", vm::ImageAsk::Colour, 0},
    {"smart, pixel of 4 texels", "smart", vm::ImageAsk::Colour, 4.0f / kSize},
};

/// Root mean square and largest difference.
std::pair<double, double> difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0, most = 0;
  for (std::size_t k = 0; k < 3 * kPoints; ++k) {
    const double d = std::abs(double(a[k]) - double(b[k]));
    sum += d * d;
    most = std::max(most, d);
  }
  return {std::sqrt(sum / (3 * kPoints)), most};
}

/// Looking tables over the wavelength up (`measured`), 256 points a call and one by one.
std::string curve_table() {
  std::string text =
      "\nns per lookup in a table over the wavelength (`measured`), anywhere in it:\n\n| rows | "
      "value | "
      "value, alone | slope | slope, alone |\n|---|---|---|---|---|\n";
  std::mt19937 random(3);
  std::uniform_real_distribution<float> nanometres(360, 830);
  std::vector<float> metres, results(kPoints);
  for (int i = 0; i < kPoints; ++i) metres.push_back(1e-9f * nanometres(random));
  for (const int rows : {16, 95, 471, 4701}) {
    std::string table;
    for (int k = 0; k < rows; ++k)
      table += fmt::format("{} {}\n", 360 + 470.0 * k / (rows - 1), std::sin(0.1 * k));
    const auto curve =
        materials::read_curve(table, {"table", std::string(vm::kCurveFilter), "", "nm", "", ""});
    std::vector<std::function<void()>> contenders;
    for (const vm::ImageAsk ask : {vm::ImageAsk::Curve, vm::ImageAsk::CurveSlope})
      for (const int batch : {kBatch, 1})
        contenders.push_back([&, ask, batch] {
          for (int first = 0; first < kPoints; first += batch) {
            const float* const in = metres.data() + first;
            float* const out = results.data() + first;
            (*curve)->look_up(ask, &in, &out, batch);
          }
        });
    text += fmt::format("| {} |", rows);
    for (const Series& s : interleave(contenders, kPoints, kRounds))
      text += fmt::format(" {:.1f} |", least(s));
    text += "\n";
  }
  return text;
}

std::string document() {
  const std::vector<unsigned char> bytes = picture();
  const std::string file =
      (std::filesystem::temp_directory_path() / "mms_bench_images.ppm").string();
  std::ofstream out(file, std::ios::binary);
  out << fmt::format("P6 {} {} 255\n", kSize, kSize);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  out.close();
  struct Storage {
    const char* title;
    const char* space;
    const char* storage;
    double megabytes;
  };
  const Storage storages[] = {{"raw, linear bytes", "linear", "raw", kLarge},
                              {"raw, from sRGB", "sRGB", "raw", kLarge},
                              {"compressed, 4 MB of tiles", "sRGB", "compressed", kSmall},
                              {"compressed", "sRGB", "compressed", kLarge}};
  std::vector<std::unique_ptr<vm::ImageSource>> sources;
  for (const Storage& s : storages) sources.push_back(renderer::open_textures(s.megabytes));
  const auto open = [&](std::size_t s, const char* filter) {
    auto image =
        sources[s]->open({file, filter, "repeat", storages[s].space, "", storages[s].storage});
    if (!image) {
      fmt::print(stderr, "error: {}\n", image.error().what);
      std::exit(1);
    }
    return *image;
  };
  std::string text = fmt::format(
      "\n## Images\n\nns per lookup of a colour in a picture of {0} x {0}, least of {1} rounds: "
      "points along a "
      "row / anywhere. The native one is\nscalar, bilinear and has all of the picture as linear "
      "floats.\n\n| lookup |",
      kSize, kRounds);
  for (const Storage& s : storages) text += fmt::format(" {} |", s.title);
  text += "\n|---|---|---|---|---|\n";
  std::string native;
  double native_error = 0;
  for (const Case& c : kCases) {
    std::vector<std::string> cells(std::size(storages));
    for (const bool far : {false, true}) {
      const Points points(far, c.pixel);
      std::vector<Lookup> lookups;
      for (std::size_t s = 0; s < std::size(storages); ++s)
        lookups.emplace_back(open(s, c.filter), c.ask, points);
      Native twin(bytes, points);
      std::vector<std::function<void()>> contenders;
      for (Lookup& l : lookups) contenders.push_back([&l] { l(); });
      contenders.push_back([&twin] { twin(); });
      const auto series = interleave(contenders, kPoints, kRounds);
      for (std::size_t s = 0; s < cells.size(); ++s)
        cells[s] += fmt::format("{}{:.0f}", far ? " / " : "", least(series[s]));
      if (std::string_view(c.title) == "bilinear") {
        native += fmt::format("{}{:.0f}", far ? " / " : "", least(series.back()));
        native_error =
            std::max(native_error, difference(lookups[1].results(), twin.results()).second);
      }
    }
    text += fmt::format("| {} |", c.title);
    for (const std::string& cell : cells) text += fmt::format(" {} |", cell);
    text += "\n";
  }
  text += fmt::format("| native bilinear | | {} | | |\n", native);
  const Points points(true, 0);
  Lookup raw(open(1, "bilinear"), vm::ImageAsk::Colour, points);
  Lookup packed(open(3, "bilinear"), vm::ImageAsk::Colour, points);
  raw();
  packed();
  const auto [rms, most] = difference(raw.results(), packed.results());
  const auto megabytes = [&](std::size_t s) { return *open(s, "bilinear")->number("bytes") / 1e6; };
  text += fmt::format(
      "\nBytes, all of it decoded: {:.1f} MB as linear bytes, {:.1f} MB from sRGB, {:.1f} MB "
      "compressed. Compressed "
      "colours are off by\n{:.2g} (root mean square; at most {:.2g}); raw ones differ from the "
      "native lookup by at most "
      "{:.1g}.\n",
      megabytes(0), megabytes(1), megabytes(3), rms, most, native_error);
  std::filesystem::remove(file);
  return text + curve_table();
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  return mms::bench::part_main(count, arguments, "images", mms::bench::document);
}
