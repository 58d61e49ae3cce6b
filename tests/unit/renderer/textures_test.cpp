// SPDX-License-Identifier: Apache-2.0
// Pictures as scripts see them, against lookups written out here: texels of generated files,
// weighed by the formulas of each filter.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "materials/colour.h"
#include "renderer/picture.h"
#include "renderer/textures.h"
#include "tests/sanitized.h"
#include "tests/source_dir.h"
#include "tests/unit/renderer/lookups.h"
#include "vm/interval.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::testing;
using vm::ImageAsk;
using vm::ImageUse;
namespace fs = std::filesystem;

namespace {

/// Column or row `k` of `n` under a wrap mode; -1: black.
int wrapped(int k, int n, const std::string& wrap) {
  const int period = ((k % n) + n) % n;
  if (wrap == "repeat") return period;
  if (wrap == "clamp") return std::clamp(k, 0, n - 1);
  if (wrap == "black") return k < 0 || k >= n ? -1 : k;
  const int round = (k - period) / n;
  return round % 2 == 0 ? period : n - 1 - period;
}

/// Weights of the texels from floor(x) - 1 on, x in texels from the middle of the first one, and
/// how they change with x.
struct Weights {
  int first;
  std::array<double, 4> value, slope;
};
Weights weights(double x, const std::string& filter) {
  if (filter == "nearest") return {int(std::floor(x + 0.5)) - 1, {0, 1, 0, 0}, {}};
  const int i = int(std::floor(x));
  const double f = x - i, g = 1 - f;
  if (filter == "bilinear") return {i - 1, {0, g, f, 0}, {0, -1, 1, 0}};
  return {i - 1,  // the uniform cubic B-spline
          {g * g * g / 6, (4 - 6 * f * f + 3 * f * f * f) / 6, (4 - 6 * g * g + 3 * g * g * g) / 6,
           f * f * f / 6},
          {-g * g / 2, (-4 * f + 3 * f * f) / 2, (4 * g - 3 * g * g) / 2, f * f / 2}};
}

/// Value and slopes by u and v of one channel.
std::array<double, 3> expected(const Texels& t, int c, const ImageUse& use, double u, double v) {
  const Weights x = weights(u * t.width - 0.5, use.filter);
  const Weights y = weights((1 - v) * t.height - 0.5, use.filter);
  std::array<double, 3> sum{};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int column = wrapped(x.first + i, t.width, use.wrap);
      const int row = wrapped(y.first + j, t.height, use.wrap);
      if (column < 0 || row < 0) continue;
      const double texel = t.at(column, row, c);
      sum[0] += x.value[i] * y.value[j] * texel;
      sum[1] += x.slope[i] * y.value[j] * texel * t.width;
      sum[2] -= x.value[i] * y.slope[j] * texel * t.height;
    }
  return sum;
}

double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

}  // namespace

TEST_CASE("textures: every filter and wrap mode, with its slopes, is its formula") {
  const Folder folder;
  const Texels t = random_texels(12, 9, 3);
  ImageUse use = use_of(folder.write("a.tif", t));
  std::mt19937 random(9);
  std::uniform_real_distribution<float> anywhere(-1.6f, 2.6f);
  for (const char* filter : {"nearest", "bilinear", "bicubic"})
    for (const char* wrap : {"repeat", "mirror", "clamp", "black"}) {
      use.filter = filter;
      use.wrap = wrap;
      const auto image = open(use);
      double worst = 0, worst_slope = 0, worst64 = 0, worst_slope64 = 0;
      const auto keep = [](double& most, double a, double b) {
        most = std::max(most, std::abs(a - b));
      };
      for (int k = 0; k < 300; ++k) {
        const Place p{anywhere(random), anywhere(random)};
        // The texel changes here, and the slope with it: where 12 u of doubles falls is rounding.
        const double x = p.u * 12 - 0.5, y = (1 - p.v) * 9 - 0.5;
        const double half = use.filter == "nearest" ? 0.5 : 0;
        if (std::abs(std::remainder(x + half, 1)) < 1e-12) continue;
        if (std::abs(std::remainder(y + half, 1)) < 1e-12) continue;
        const auto colour = look_up<float>(*image, ImageAsk::Colour, p);
        const auto slope = look_up<float>(*image, ImageAsk::ColourSlope, p);
        const auto colour64 = look_up<double>(*image, ImageAsk::Colour, p);
        const auto slope64 = look_up<double>(*image, ImageAsk::ColourSlope, p);
        for (std::size_t c = 0; c < 3; ++c) {
          const auto e = expected(t, int(c), use, p.u, p.v);
          keep(worst, colour[c], e[0]);
          keep(worst64, colour64[c], e[0]);
          for (std::size_t d = 0; d < 2; ++d) {
            keep(worst_slope, slope[2 * c + d], e[1 + d]);
            keep(worst_slope64, slope64[2 * c + d], e[1 + d]);
          }
        }
      }
      CAPTURE(filter);
      CAPTURE(wrap);
      // Texels are at most 2, and differ by at most 3, 36 times as much for each unit of u. Parts
      // of a texel are right to 1.5 units in the last place, and make 3 times that of either axis;
      // weights of the cubic have 5 roundings each, sums 4: 24 of 2 in all.
      CHECK(worst < 60 * 0x1p-24);
      CHECK(worst_slope < 36 * 60 * 0x1p-24);
      // Beside that, the formula here forgets some of 12 u: u < 3 by 2^-52 of 36, on two axes.
      CHECK(worst64 < 160 * 0x1p-53);
      CHECK(worst_slope64 < 36 * 160 * 0x1p-53);
    }
}

TEST_CASE("textures: channels, luminance, and colours of grey files") {
  const Folder folder;
  const Texels t = random_texels(5, 4, 4);
  ImageUse use = use_of(folder.write("a.tif", t));
  use.filter = "nearest";
  const Place p{0.5f, 0.375f};  // column 2, row 2
  CHECK(look_up<float>(*open(use), ImageAsk::Number, p)[0] ==
        doctest::Approx(luminance(t.at(2, 2, 0), t.at(2, 2, 1), t.at(2, 2, 2))).epsilon(1e-6));
  for (const auto& [name, channel] : {std::pair{"G", 1}, {"A", 3}, {"2", 2}}) {
    use.channel = name;
    CHECK(look_up<float>(*open(use), ImageAsk::Number, p)[0] == t.at(2, 2, channel));
  }
  use.channel = "Q";
  const auto none = open_textures(64)->open(use);
  REQUIRE(!none);
  CHECK(none.error().hint == "its channels are R, G, B, A");
  const Texels grey = random_texels(5, 4, 1);
  use = use_of(folder.write("grey.tif", grey));
  use.filter = "nearest";
  const double g = grey.at(2, 2, 0);
  CHECK(look_up<float>(*open(use), ImageAsk::Colour, p) == std::vector<double>{g, g, g});
  CHECK(look_up<float>(*open(use), ImageAsk::Number, p)[0] == g);
}

TEST_CASE("textures: colours are made linear before they are filtered") {
  const Folder folder;
  Texels t{2, 1, 3, {0, 0.2f, 0.4f, 1, 0.6f, 0.8f}};
  for (float& v : t.values) v = std::round(v * 255) / 255;  // what 8 bits hold
  ImageUse use = use_of(folder.write("a.tif", t, TiffNumbers::Byte));
  const Place middle{0.5f, 0.5f};
  const auto mean = [&](int c, auto f) { return (f(t.at(0, 0, c)) + f(t.at(1, 0, c))) / 2; };
  const auto same = [](double x) { return x; };
  for (const char* space : {"linear", "sRGB", "auto"}) {
    use.space = space;
    const auto colour = look_up<float>(*open(use), ImageAsk::Colour, middle);
    for (int c = 0; c < 3; ++c)
      CHECK(colour[std::size_t(c)] ==
            doctest::Approx(use.space == "linear" ? mean(c, same) : mean(c, materials::srgb_decode))
                .epsilon(1e-6));
  }
  double low, high;
  open(use)->range(low, high);
  CHECK((low == 0 && high == 1));
  // Numbers of more than 8 bits are taken for linear.
  use = use_of(folder.write("float.tif", t));
  use.space = "auto";
  CHECK(look_up<float>(*open(use), ImageAsk::Colour, middle)[1] == doctest::Approx(mean(1, same)));
  use.space = "ultraviolet";
  const auto none = open_textures(64)->open(use);
  REQUIRE(!none);
  CHECK(none.error().what.find("no colour space `ultraviolet`") != std::string::npos);
}

TEST_CASE("textures: the pixel is filtered away along its own axes") {
  const Folder folder;
  // 64 columns, black and white in turn; the same in rows.
  Texels columns{64, 64, 1, {}}, rows{64, 64, 1, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      columns.values.push_back(float(x % 2));
      rows.values.push_back(float(y % 2));
    }
  const auto c = open(use_of(folder.write("c.tif", columns)));
  const auto r = open(use_of(folder.write("r.tif", rows)));
  const auto value = [](const vm::Image& image, Place p) {
    return look_up<float>(image, ImageAsk::Number, p)[0];
  };
  const float white = 0.5f + 0.5f / 64;  // the middle of a white column
  const float row = 0.5f + 0.5f / 64;    // and of a black row, counted from below
  CHECK(value(*c, {white, row}) == 0);
  const double sharp = value(*c, {white + 1.0f / 64, row});
  CHECK(sharp == 1);
  // A pixel as wide as sixteen columns sees their mean; one that is long across them all the more.
  const Place wide{white, row, {0.25f, 0, 0, 0.25f}};
  CHECK(value(*c, wide) == doctest::Approx(0.5).epsilon(0.02));
  CHECK(value(*r, wide) == doctest::Approx(0.5).epsilon(0.02));
  const Place along_u{white, row, {0.2f, 0, 0, 0.01f}}, along_v{white, row, {0.01f, 0, 0, 0.2f}};
  CHECK(value(*c, along_u) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(std::abs(value(*r, along_u) - 0.5) > 0.4);
  CHECK(value(*r, along_v) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(std::abs(value(*c, along_v) - 0.5) > 0.4);
  // So does a blur, in all directions.
  const Place blurred{white, row, {0, 0, 0, 0}, 0.25f};
  CHECK(value(*c, blurred) == doctest::Approx(0.5).epsilon(0.02));
  CHECK(value(*r, blurred) == doctest::Approx(0.5).epsilon(0.02));
  // Or along one axis: lines across it are gone, lines along it as sharp as ever.
  const Place blurred_u{white, row, {0, 0, 0, 0}, 0.2f, 0};
  const Place blurred_v{white, row, {0, 0, 0, 0}, 0, 0.2f};
  CHECK(value(*c, blurred_u) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(std::abs(value(*r, blurred_u) - 0.5) > 0.4);
  CHECK(value(*r, blurred_v) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(std::abs(value(*c, blurred_v) - 0.5) > 0.4);
}

TEST_CASE("textures: packed blocks keep within a step of their line, and a quarter of the memory") {
  const Folder folder;
  // Smooth, with channels that rise and fall against each other: lines fit well.
  Texels t{37, 22, 3, {}};
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x) {
      const float f = 0.5f + 0.4f * std::sin(0.3f * float(x) + 0.2f * float(y));
      t.values.insert(t.values.end(), {f, 1 - f, 8 * f});
    }
  ImageUse use = use_of(folder.write("a.tif", t));
  use.filter = "nearest";
  const auto raw = open(use);
  use.storage = "compressed";
  const auto packed = open(use);
  CHECK(raw->number("bytes") == 37 * 22 * 3 * 4.0);
  CHECK(*packed->number("bytes") == 10 * 6 * 20.0);  // blocks of 6 halves and 16 half-bytes
  double low, high;
  packed->range(low, high);
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x) {
      // A block's change is at most 3 (0.3 + 0.2) 0.4 of the first channel, 8 times that of the
      // last; a thirtieth of it is half a step, and ends are off by 2^-11 of themselves.
      const Place p{(float(x) + 0.5f) / 37, 1 - (float(y) + 0.5f) / 22};
      const auto colour = look_up<float>(*packed, ImageAsk::Colour, p);
      for (int c = 0; c < 3; ++c) {
        const double scale = c == 2 ? 8 : 1;
        CHECK(std::abs(colour[std::size_t(c)] - t.at(x, y, c)) <=
              scale * (0.6 / 30 + 2 * 0x1p-11) + 1e-6);
        CHECK(colour[std::size_t(c)] >= low);
        CHECK(colour[std::size_t(c)] <= high);
      }
    }
  // Two values to a block come back as they are, negative and bright ones too.
  Texels two{8, 8, 4, {}};
  for (int k = 0; k < 64; ++k) two.values.insert(two.values.end(), {-2, k % 3 ? 0.5f : 1024, 1, 0});
  use.file = folder.write("two.tif", two);
  const auto exact = open(use);
  for (int k = 0; k < 64; ++k) {
    const Place p{(float(k % 8) + 0.5f) / 8, 1 - (float(k / 8) + 0.5f) / 8};
    CHECK(look_up<float>(*exact, ImageAsk::Colour, p) ==
          std::vector<double>{-2, k % 3 ? 0.5 : 1024, 1});
  }
}

TEST_CASE("textures: tiles have their places, and there is nothing outside") {
  const Folder folder;
  for (const auto& [number, value] : {std::pair{"1001", 0.25f}, {"1002", 0.5f}, {"1012", 0.75f}})
    folder.write(std::string("t.") + number + ".tif", {1, 1, 1, {value}});
  folder.write("t.0001.tif", {1, 1, 1, {9}});
  const auto image = open(use_of(folder / "t.<UDIM>.tif"));
  CHECK(image->files().size() == 3);
  const auto value = [&](float u, float v) {
    return look_up<float>(*image, ImageAsk::Number, {u, v})[0];
  };
  CHECK(value(0.5f, 0.5f) == 0.25);
  CHECK(value(1.25f, 0.5f) == 0.5);
  CHECK(value(1.25f, 1.5f) == 0.75);
  CHECK(value(0.5f, 1.5f) == 0);
  CHECK(value(-0.5f, 0.5f) == 0);
  CHECK(value(NAN, 0.5f) == 0);
  CHECK(!open_textures(64)->open(use_of(folder / "x.<UDIM>.tif")));
}

TEST_CASE("textures: what a file states, and its range") {
  const Folder folder;
  const Texels t = random_texels(7, 3, 3);
  const auto image = open(use_of(folder.write("a.tif", t)));
  CHECK(image->number("width") == 7);
  CHECK(image->number("height") == 3);
  CHECK(image->number("channels") == 3);
  CHECK(image->number("XResolution") == 2.5);
  CHECK(!image->number("nothing"));
  double low, high;
  image->range(low, high);
  const auto [least, most] = std::minmax_element(t.values.begin(), t.values.end());
  CHECK(low <= *least);
  CHECK(low >= std::min(*least, 0.0f));
  CHECK(high == *most);
}

TEST_CASE("textures: bounds hold any lookup; near the texels that it sees, and for slopes") {
  const Folder folder;
  // Steep on one side only, so that bounds of a part are those of the part.
  Texels t{64, 48, 3, {}};
  std::mt19937 random(4);
  std::uniform_real_distribution<float> noise(-1, 1), unit(0, 1);
  for (int y = 0; y < t.height; ++y)
    for (int x = 0; x < t.width; ++x)
      for (int c = 0; c < 3; ++c)
        t.values.push_back(x < 32 ? noise(random) : 0.01f * noise(random));
  ImageUse use = use_of(folder.write("a.tif", t));
  const int rounds = kSanitized ? 20 : 200;
  for (const char* filter : {"nearest", "bilinear", "bicubic", "smart"})
    for (const char* wrap : {"repeat", "mirror", "clamp", "black"})
      for (const char* storage : {"raw", "compressed"}) {
        CAPTURE(filter);
        CAPTURE(wrap);
        CAPTURE(storage);
        use.filter = filter;
        use.wrap = wrap;
        use.storage = storage;
        const auto image = open(use);
        int beyond = 0;
        for (int k = 0; k < rounds; ++k) {
          vm::Interval box[vm::kImageArguments] = {};
          const double size = k % 4 == 0 ? 0.5 : 0.02;
          for (int a = 0; a < 2; ++a) {
            const double at = 4 * unit(random) - 1.5;
            box[a] = {at, at + size * unit(random), false};
          }
          if (k % 2)  // a pixel that is not a point
            for (int a = 2; a < vm::kImageArguments; ++a)
              box[a] = vm::Interval::point(double(0.1f * noise(random)));
          for (const ImageAsk ask :
               {ImageAsk::Colour, ImageAsk::ColourSlope, ImageAsk::Number, ImageAsk::NumberSlope}) {
            vm::Interval bounds[6];
            image->enclose(ask, box, bounds);
            for (int p = 0; p < 10; ++p) {
              Place place{};
              float* const to[] = {&place.u, &place.v};
              for (int a = 0; a < 2; ++a)
                *to[a] = float(std::lerp(box[a].lo, box[a].hi, double(unit(random))));
              for (int a = 0; a < 4; ++a) place.across[a] = float(box[2 + a].lo);
              place.blur = float(box[6].lo);
              place.blur_v = float(box[7].lo);
              const auto found = look_up<float>(*image, ask, place);
              for (std::size_t r = 0; r < found.size(); ++r) {
                const double slack = 1e-5 * (1 + std::abs(found[r]));
                beyond += found[r] < bounds[r].lo - slack || found[r] > bounds[r].hi + slack;
              }
            }
          }
        }
        CHECK(beyond == 0);
        // A part is known better than all of it: here its texels are at most 0.01.
        vm::Interval part[vm::kImageArguments] = {}, bounds[3];
        part[0] = {0.85, 0.87, false};
        part[1] = {0.4, 0.5, false};
        image->enclose(ImageAsk::Colour, part, bounds);
        CHECK(bounds[0].lo >= -0.011);
        CHECK(bounds[0].hi <= 0.011);
        // Texels differ by at most 2: no slope is above twice as many a unit, and black and
        // packing.
        vm::Interval slopes[2];
        image->enclose(ImageAsk::NumberSlope, part, slopes);
        CHECK(slopes[0].hi <= 2.01 * 64);
        CHECK(slopes[1].hi <= 2.01 * 48);
        if (use.filter == "nearest") CHECK(slopes[0].hi == 0);
      }
}

TEST_CASE("textures: what is no picture or is cut off is an error") {
  const Folder folder;
  folder.write("a.tif", random_texels(64, 64, 3));
  fs::copy_file(mms::source_dir() / "docs/images/hero.png", folder / "a.png");
  Film film{64, 64, {}, {}};
  film.xyz.resize(64 * 64, {0.5, 0.25, 1});
  film.variance.resize(64 * 64, 0);
  REQUIRE(write_picture(folder / "a.exr", {film}));
  for (const char* name : {"a.tif", "a.png", "a.exr"}) {
    CAPTURE(name);
    // libpng leaves OpenImageIO by a long jump, past the destructor of a string.
    if (kSanitized && std::string_view(name) == "a.png") continue;
    const std::string file = folder / name;
    CHECK(open_textures(64)->open(use_of(file)));
    fs::resize_file(file, fs::file_size(file) / 2);
    const auto half = open_textures(64)->open(use_of(file));
    REQUIRE(!half);
    CHECK(half.error().what.find('\n') == std::string::npos);
  }
  std::ofstream(folder / "text.png") << "no picture";
  CHECK(!open_textures(64)->open(use_of(folder / "text.png")));
}

TEST_CASE("textures: a lamp's photometric file is a picture over its two angles") {
  const Folder folder;
  const auto write = [&](const char* name, const char* candela) {
    std::ofstream(folder / name) << "IESNA:LM-63-2002\nTILT=NONE\n1 900 2 3 2 1 2 0 0 0\n1 1 60\n"
                                    "0 90 180\n0 180\n"
                                 << candela;
    return folder / name;
  };
  const auto image = open(use_of(write("LAMP.IES", "100 50 0  100 10 0\n")));
  CHECK(image->number("candela") == 200);
  CHECK(image->number("lumens") == 900);
  CHECK(image->number("watts") == 60);
  CHECK(image->number("width") == 2);
  CHECK(!image->number("nothing"));
  double low, high;
  image->range(low, high);
  CHECK(low == 0);
  CHECK(high == 200);
  CHECK(image->files() == std::vector<std::string>{folder / "LAMP.IES"});
  // u in turns, v in half turns; a quarter turn is halfway between the two planes.
  CHECK(look_up<float>(*image, ImageAsk::Number, {0, 0.5f})[0] == doctest::Approx(100));
  CHECK(look_up<float>(*image, ImageAsk::Number, {0.25f, 0.5f})[0] == doctest::Approx(60));
  CHECK(look_up<float>(*image, ImageAsk::Number, {-0.25f, 0.25f})[0] == doctest::Approx(130));
  CHECK(look_up<float>(*image, ImageAsk::Colour, {0.5f, 0.5f}) == std::vector<double>(3, 20.0));
  CHECK(look_up<float>(*image, ImageAsk::Number, {0, 1.5f})[0] == 0);
  CHECK(look_up<float>(*image, ImageAsk::Number, {float(NAN), 0.5f})[0] == 0);
  const auto slope = look_up<float>(*image, ImageAsk::NumberSlope, {0.2f, 0.25f});
  CHECK(slope[0] == doctest::Approx(-40 * 2));           // from 150 to 110 in half a turn
  CHECK(slope[1] == doctest::Approx((68 - 200) / 0.5));  // from 200 to 68 in a quarter turn
  const auto bad = open_textures(64)->open(use_of(write("bad.ies", "100 50 0 100 10\n")));
  REQUIRE(!bad);
  CHECK(bad.error().what == "is not understood: line 7: the file ends before candela");
}
