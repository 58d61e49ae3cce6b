// SPDX-License-Identifier: Apache-2.0
// Our lookups against OpenImageIO's own: the same files through OIIO::TextureSystem::texture.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <cmath>

#include "tests/sanitized.h"
#include "tests/unit/renderer/lookups.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::testing;
using vm::ImageAsk;

namespace {

/// Colours, and their slopes by u and v, as OpenImageIO has them. It counts rows from the top, and
/// knows slopes of nothing that is nearest.
struct Theirs {
  OIIO::TextureSystem& system = *OIIO::TextureSystem::create(true);  // shared: nobody deletes it
  OIIO::TextureOpt options;

  Theirs(const std::string& filter, const std::string& wrap) {
    system.attribute("automip", 1);
    system.attribute("autotile", 64);
    system.attribute("unassociatedalpha", 1);
    options.interpmode = filter == "nearest"    ? OIIO::TextureOpt::InterpClosest
                         : filter == "bilinear" ? OIIO::TextureOpt::InterpBilinear
                                                : OIIO::TextureOpt::InterpBicubic;
    options.swrap = options.twrap =
        OIIO::TextureOpt::decode_wrapmode(wrap == "repeat" ? "periodic" : wrap.c_str());
  }

  std::vector<double> colour(const std::string& file, const Place& p, std::vector<double>& slopes) {
    float rgb[3] = {}, ds[3] = {}, dt[3] = {};
    OIIO::TextureOpt o = options;
    o.sblur = p.blur;
    o.tblur = p.blur_v;
    const bool nearest = o.interpmode == OIIO::TextureOpt::InterpClosest;
    REQUIRE(system.texture(OIIO::ustring(file), o, p.u, 1 - p.v, p.across[0], -p.across[1],
                           p.across[2], -p.across[3], 3, rgb, nearest ? nullptr : ds,
                           nearest ? nullptr : dt));
    slopes.clear();
    for (int c = 0; c < 3; ++c) slopes.insert(slopes.end(), {ds[c], -dt[c]});
    return {rgb, rgb + 3};
  }
};

/// A number whose difference from 1 is a float.
float even(float x) { return std::round(x * 0x1p18f) * 0x1p-18f; }

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

/// A file of all levels, as maketx makes it.
std::string with_levels(const Folder& folder, const std::string& name, const std::string& file) {
  const OIIO::ImageBuf source(file);
  const std::string made = folder / name;
  OIIO::ImageSpec config;
  config.attribute("maketx:filtername", "box");
  REQUIRE(
      OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, source, made, config));
  return made;
}

}  // namespace

TEST_CASE("textures: a point of a picture is what OpenImageIO's texture calls give") {
  const Folder folder;
  const int w = 12, h = 9;
  vm::ImageUse use = use_of(folder.write("theirs_point.tif", random_texels(w, h, 3)));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anywhere(-1.6f, 2.6f);
  for (const std::string filter : {"nearest", "bilinear", "bicubic"})
    for (const std::string wrap : {"repeat", "mirror", "clamp", "black"}) {
      CAPTURE(filter);
      CAPTURE(wrap);
      use.filter = filter;
      use.wrap = wrap;
      const auto image = open(use);
      Theirs theirs(filter, wrap);
      double worst = 0, worst_slope = 0;
      for (int k = 0; k < (kSanitized ? 50 : 500); ++k) {
        const Place p{even(anywhere(random)), even(anywhere(random))};
        // Where texels change, which one it is, and what the slope is, is rounding of theirs.
        const double half = filter == "nearest" ? 0 : 0.5;
        if (std::abs(std::remainder(p.u * w - half, 1)) < 1e-3 ||
            std::abs(std::remainder((1 - p.v) * h - half, 1)) < 1e-3)
          continue;
        std::vector<double> slopes;
        const auto colour = theirs.colour(use.file, p, slopes);
        worst = std::max(worst,
                         largest_difference(look_up<float>(*image, ImageAsk::Colour, p), colour));
        worst_slope =
            std::max(worst_slope,
                     largest_difference(look_up<float>(*image, ImageAsk::ColourSlope, p), slopes));
      }
      // They round 12 u of |u| < 3 to a float, by 2^-19 at most; texels differ by 3 along either
      // axis, and weights of theirs are floats too. Slopes differ by twice 3 a texel, 12 times.
      CHECK(worst < 2 * 3 * 0x1p-19 + 60 * 0x1p-24);
      CHECK(worst_slope < w * (2 * 6 * 0x1p-19 + 60 * 0x1p-24));
    }
}

TEST_CASE("textures: a round pixel of a picture with levels is what OpenImageIO's calls give") {
  const Folder folder;
  const int w = 64;
  const std::string plain = folder.write("theirs_plain.tif", random_texels(w, w, 3));
  const std::string levels = with_levels(folder, "theirs_levels.tx", plain);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const std::string& file : {plain, levels})
    for (const std::string filter : {"bilinear", "bicubic"}) {
      CAPTURE(file);
      CAPTURE(filter);
      vm::ImageUse use = use_of(file);
      use.filter = filter;
      const auto image = open(use);
      Theirs theirs(filter, "repeat");
      double worst = 0;
      for (int k = 0; k < (kSanitized ? 50 : 500); ++k) {
        Place p{even(unit(random)), even(unit(random))};
        const float size = std::exp2(-8 + 7.5f * unit(random));  // 1/4 to 45 texels
        p.across[0] = p.across[3] = size;
        std::vector<double> slopes;
        const auto colour = theirs.colour(file, p, slopes);
        worst = std::max(worst,
                         largest_difference(look_up<float>(*image, ImageAsk::Colour, p), colour));
      }
      // They round 64 u to a float, by 2^-19, and texels differ by 3 along either axis; weights of
      // texels and levels have a few dozen roundings.
      CHECK(worst < 2 * 3 * 0x1p-19 + 100 * 0x1p-24);
    }
}

TEST_CASE("textures: a long pixel is not quite OpenImageIO's, but agrees on what is straight") {
  const Folder folder;
  const int w = 256;
  Texels t{w, w, 3, {}};
  for (int y = 0; y < w; ++y)
    for (int x = 0; x < w; ++x)
      t.values.insert(t.values.end(), {float(x) / w, float(y) / w, float(x + 2 * y) / w});
  const vm::ImageUse use = use_of(folder.write("theirs_ramp.tif", t));
  const auto image = open(use);
  Theirs theirs("bilinear", "repeat");
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  double worst = 0;
  for (int k = 0; k < (kSanitized ? 50 : 500); ++k) {
    Place p{even(0.4f + 0.2f * unit(random)), even(0.4f + 0.2f * unit(random))};
    const float turn = 6.3f * unit(random), length = 0.02f + 0.1f * unit(random);
    const float thin = length / (1 + 11 * unit(random));
    p.across[0] = length * std::cos(turn);
    p.across[1] = length * std::sin(turn);
    p.across[2] = -thin * std::sin(turn);
    p.across[3] = thin * std::cos(turn);
    std::vector<double> slopes;
    const auto colour = theirs.colour(use.file, p, slopes);
    worst =
        std::max(worst, largest_difference(look_up<float>(*image, ImageAsk::Colour, p), colour));
  }
  // Weights that are positive, sum to 1 and are as many on either side leave 3 or less as it is.
  CHECK(worst < 3 * 100 * 0x1p-24);
}
