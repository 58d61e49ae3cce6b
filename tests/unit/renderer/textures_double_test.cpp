// SPDX-License-Identifier: Apache-2.0
// Lookups of the float machine against those of the double machine: the same texels, weighed in
// either. Nothing is left out: where texels change, both see the same ones.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/sanitized.h"
#include "tests/unit/renderer/lookups.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::testing;
using vm::ImageAsk;

namespace {

/// Of a picture of w columns: middles and borders of texels, and what is next to them.
float edge(std::mt19937& random, int w) {
  const float at = float(int(random() % unsigned(6 * w)) - 2 * w) / float(2 * w);
  switch (random() % 5) {
    case 0:
      return at;
    case 1:
      return std::nextafter(at, 9.0f);
    case 2:
      return std::nextafter(at, -9.0f);
    case 3:
      return at + 4096;
    default:
      return std::array{0.0f, -0.0f, 1.0f, -1e-30f, 1e-9f, -1e-9f, 1e30f, -1e30f}[random() % 8];
  }
}

Place random_place(std::mt19937& random, int w, int h) {
  std::uniform_real_distribution<float> anywhere(-3, 3);
  if (random() % 2) return {anywhere(random), anywhere(random)};
  return {edge(random, w), edge(random, h)};
}

/// Pixels from a thousandth of a texel to some pictures: round, long, turned, without area; blurs.
void random_pixel(std::mt19937& random, Place& p) {
  std::uniform_real_distribution<float> unit(0, 1);
  const auto size = [&] { return std::exp2(-14 + 16 * unit(random)); };
  const float turn = 2 * std::numbers::pi_v<float> * unit(random), c = std::cos(turn),
              s = std::sin(turn), a = size(),
              b = random() % 3   ? size()
                  : random() % 2 ? a
                                 : 0;
  const float pixel[] = {a * c, a * s, -b * s, b * c};
  std::copy_n(pixel, 4, p.across);
  if (random() % 3 == 0) p.blur = size();
  if (random() % 3 == 0) p.blur_v = size();
}

/// The largest difference between the machines, as a part of `most`.
struct Worst {
  double value = 0, slope = 0;
  void take(const vm::Image& image, const Place& p, double most, double steepest) {
    const auto differ = [&](ImageAsk ask) {
      const auto narrow = look_up<float>(image, ask, p), wide = look_up<double>(image, ask, p);
      double largest = 0;
      for (std::size_t k = 0; k < narrow.size(); ++k) {
        REQUIRE(std::isfinite(narrow[k]));
        largest = std::max(largest, std::abs(narrow[k] - wide[k]));
      }
      return largest;
    };
    value = std::max({value, differ(ImageAsk::Colour) / most, differ(ImageAsk::Number) / most});
    slope = std::max({slope, differ(ImageAsk::ColourSlope) / steepest,
                      differ(ImageAsk::NumberSlope) / steepest});
  }
};

}  // namespace

TEST_CASE("textures: float lookups are within their stated error of double ones") {
  const Folder folder;
  const int w = 37, h = 52;
  const Texels t = random_texels(w, h, 3);  // in [-1, 2]: no step is steeper than 3 h
  vm::ImageUse use = use_of(folder.write("a.tif", t));
  std::mt19937 random(21);
  const int rounds = kSanitized ? 30 : 400;
  for (const std::string filter : {"nearest", "bilinear", "bicubic", "smart"})
    for (const std::string wrap : {"repeat", "mirror", "clamp", "black"})
      for (const std::string storage : {"raw", "compressed"}) {
        use.filter = filter;
        use.wrap = wrap;
        use.storage = storage;
        const auto image = open(use);
        Worst point, pixel;
        for (int k = 0; k < rounds; ++k) {
          Place p = random_place(random, w, h);
          point.take(*image, p, 2, 3 * h);
          random_pixel(random, p);
          if (use.filter != "nearest") pixel.take(*image, p, 2, 3 * h);
        }
        CAPTURE(filter);
        CAPTURE(wrap);
        CAPTURE(storage);
        CHECK(point.value <= vm::kImagePointError);
        CHECK(point.slope <= vm::kImagePointError);
        if (use.filter == "nearest") CHECK(point.value <= 3 * 0x1p-24);  // of a luminance alone
        CHECK(pixel.value <= vm::kImagePixelError);
        // A straight filter's slope jumps where texels change, and probes are there by rounding.
        if (use.filter == "bicubic") CHECK(pixel.slope <= vm::kImagePixelError);
      }
}

TEST_CASE("textures: tiles are the same for the double machine, and so is what is not there") {
  const Folder folder;
  folder.write("t.1001.tif", random_texels(3, 2, 1));
  folder.write("t.1012.tif", random_texels(3, 2, 1));
  const auto image = open(use_of(folder / "t.<UDIM>.tif"));
  for (const float u : {-1e-9f, 0.0f, 0.3f, 0.99999994f, 1.0f, 1.4f, 2.0f, NAN, INFINITY})
    for (const float v : {-0.1f, 0.0f, 0.99999994f, 1.0f, 1.5f, -INFINITY}) {
      const double narrow = look_up<float>(*image, ImageAsk::Number, {u, v})[0];
      const double wide = look_up<double>(*image, ImageAsk::Number, {u, v})[0];
      CHECK(std::abs(narrow - wide) <= 2 * vm::kImagePointError);
    }
}
