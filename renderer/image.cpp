// SPDX-License-Identifier: Apache-2.0
// Picture files, through OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/file.h"
#include "materials/colour.h"
#include "renderer/film_file.h"
#include "renderer/render.h"
#include "renderer/scene.h"

namespace mms::renderer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSupported = "supported: .png (8-bit sRGB), .exr (linear float)";

/// Thesis 6.1.3: y' = 1 - 2^(-(sensitivity y)^contrast). At these, mid grey (0.18 of a white matte
/// surface in light of 1) is shown at luminance 0.19 and white at 0.69, highlights roll off.
constexpr double kSensitivity = 1.7, kContrast = 1.0;

std::string extension_of(const std::string& path) {
  std::string e = fs::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

std::vector<unsigned char> display_pixels(const Film& film, double exposure) {
  std::vector<unsigned char> bytes;
  bytes.reserve(film.xyz.size() * 3);
  for (const auto& p : film.xyz) {
    const Vec3d rgb =
        materials::tone_map({p[0], p[1], p[2]}, kSensitivity * std::exp2(exposure), kContrast);
    for (int k = 0; k < 3; ++k)
      bytes.push_back(
          static_cast<unsigned char>(std::lround(255 * materials::srgb_encode(rgb[k]))));
  }
  return bytes;
}

std::vector<float> linear_pixels(const Film& film) {
  std::vector<float> values;
  values.reserve(film.xyz.size() * 4);
  for (std::size_t i = 0; i < film.xyz.size(); ++i) {
    const auto& p = film.xyz[i];
    const Vec3d rgb = materials::linear_srgb_of_xyz({p[0], p[1], p[2]});
    for (int k = 0; k < 3; ++k) values.push_back(float(rgb[k]));
    values.push_back(float(film.variance[i]));
  }
  return values;
}

/// The picture file as bytes, in memory: it is put in place in one step.
Result<std::string> encode(const std::string& path, const OIIO::ImageSpec& spec,
                           const void* pixels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path, &memory);
  if (!out) return Error{path, "cannot make the picture: " + OIIO::geterror(), kSupported};
  if (!out->open(path, spec) || !out->write_image(spec.format, pixels) || !out->close())
    return Error{path, "cannot make the picture: " + out->geterror(), ""};
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace

Result<Done> check_writable(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".png" && extension != ".exr" && extension != kFilmExtension)
    return Error{path,
                 extension.empty() ? "the output has no extension"
                                   : fmt::format("unsupported image type `{}`", extension),
                 kSupported};
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return Error{path, "the output is a folder", "name a file in it"};
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    return Error{path, fmt::format("no folder `{}`", folder.string()), "make it first"};
  if (fs::exists(path, ignored) && ::access(path.c_str(), W_OK) != 0)
    return Error{path, "the output cannot be written", "check its permissions"};
  // What replaces a file is made beside it.
  const std::string beside = folder.empty() ? "." : folder.string();
  if (::access(beside.c_str(), W_OK) != 0)
    return Error{path, "the output cannot be written", "check the permissions of its folder"};
  return Done{};
}

Result<Done> write_image(const std::string& path, const Film& film, const ToneOptions& tone) {
  if (const Result<Done> ok = check_writable(path); !ok) return ok;
  const bool png = extension_of(path) == ".png";
  OIIO::ImageSpec spec(film.width, film.height, png ? 3 : 4,
                       png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  Result<std::string> bytes = std::string();
  if (png) {
    spec.attribute("oiio:ColorSpace", "sRGB");
    bytes = encode(path, spec, display_pixels(film, tone.exposure).data());
  } else {
    spec.channelnames = {"R", "G", "B", "variance"};
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    bytes = encode(path, spec, linear_pixels(film).data());
  }
  if (!bytes) return bytes.error();
  if (const auto error = replace_file(path, *bytes)) return *error;
  return Done{};
}

Result<EnvironmentImage> load_environment(const std::string& path) {
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in) return Error{path, "cannot read the picture: " + OIIO::geterror(), "try .exr or .hdr"};
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.nchannels < 1 || spec.width < 1 || spec.height < 1)
    return Error{path, "the picture has no pixels", ""};
  std::vector<float> pixels(std::size_t(spec.width) * spec.height * spec.nchannels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    return Error{path, "cannot read the picture: " + in->geterror(), ""};
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const bool encoded = space.empty() ? spec.format.is_floating_point() == false : space == "sRGB";
  EnvironmentImage image{path, spec.width, spec.height, {}};
  image.rgb.reserve(std::size_t(spec.width) * spec.height);
  for (std::size_t i = 0; i < std::size_t(spec.width) * spec.height; ++i) {
    std::array<float, 3> c{};
    for (int k = 0; k < 3; ++k) {
      const float v = pixels[i * spec.nchannels + (spec.nchannels >= 3 ? k : 0)];
      if (!std::isfinite(v)) return Error{path, "a pixel of the picture is not finite", ""};
      c[k] = encoded ? float(materials::srgb_decode(std::clamp(v, 0.0f, 1.0f))) : std::max(0.0f, v);
    }
    image.rgb.push_back(c);
  }
  return image;
}

}  // namespace mms::renderer
