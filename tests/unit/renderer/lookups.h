// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures to look up in tests: files of random texels, opened and asked at a place.

#include <doctest/doctest.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "renderer/textures.h"
#include "tests/unit/renderer/tiff.h"

namespace mms::renderer::testing {

inline Texels random_texels(int width, int height, int channels) {
  Texels t{width, height, channels, {}};
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-1, 2);
  for (int k = 0; k < width * height * channels; ++k) t.values.push_back(value(random));
  return t;
}

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "mms_textures_test";
  Folder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }

  std::string write(const std::string& name, const Texels& t,
                    TiffNumbers numbers = TiffNumbers::Float) const {
    testing::write_tiff(*this / name, t, numbers);
    return *this / name;
  }
};

inline vm::ImageUse use_of(const std::string& file) {
  return {file, "bilinear", "repeat", "linear", "", "raw"};
}

inline std::shared_ptr<const vm::Image> open(const vm::ImageUse& use) {
  const auto source = open_textures(64);
  auto image = source->open(use);
  REQUIRE_MESSAGE(image, image.error().what);
  return *image;
}

/// Where to look, and how the pixel lies.
struct Place {
  float u, v;
  float across[4] = {0, 0, 0, 0};
  float blur = 0;
  float blur_v = blur;
};

/// What the machine over R, float or double, looks up there.
template <class R>
std::vector<double> look_up(const vm::Image& image, vm::ImageAsk ask, const Place& p) {
  const R arguments[] = {p.u,         p.v,         p.across[0], p.across[1],
                         p.across[2], p.across[3], p.blur,      p.blur_v};
  R results[6];
  const R* in[8];
  R* out[6];
  for (int k = 0; k < 8; ++k) in[k] = arguments + k;
  for (int k = 0; k < 6; ++k) out[k] = results + k;
  if constexpr (std::is_same_v<R, float>)
    image.look_up(ask, in, out, 1);
  else
    image.look_up64(ask, in, out, 1);
  return {results, results + vm::result_count(ask)};
}

}  // namespace mms::renderer::testing
