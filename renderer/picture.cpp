// SPDX-License-Identifier: Apache-2.0
// Pictures that are written, through OpenImageIO.
#include "renderer/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/file.h"
#include "materials/colour.h"
#include "renderer/film_file.h"

namespace mms::renderer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSupported =
    "supported: .png (8-bit sRGB), .exr (linear float), .film (exact sums)";

std::string extension_of(const std::string& path) {
  std::string e = fs::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
  return e;
}

/// Channels of one layer of an EXR file, and what one pixel has of them.
struct Channels {
  std::vector<const char*> names;
  std::function<void(std::size_t pixel, float* to)> get;
};

Channels triple(std::vector<const char*> names, const std::vector<Layers::Triple>& from) {
  return {std::move(names),
          [&from](std::size_t i, float* to) { std::copy(from[i].begin(), from[i].end(), to); }};
}

template <class T>
Channels number(const char* name, const std::vector<T>& from) {
  return {{name}, [&from](std::size_t i, float* to) { *to = float(from[i]); }};
}

/// All layers that there are. The first three channels are the picture, as every viewer expects.
std::vector<Channels> channels_of(const Picture& picture) {
  const Film& film = picture.film;
  std::vector<Channels> all;
  all.push_back({{"R", "G", "B"}, [&film](std::size_t i, float* to) {
                   const auto& p = film.xyz[i];
                   const Vec3d rgb = materials::linear_srgb_of_xyz({p[0], p[1], p[2]});
                   for (int k = 0; k < 3; ++k) to[k] = float(rgb[k]);
                 }});
  // One sample does not tell how far it may be off.
  if (std::ranges::any_of(film.samples, [](std::uint32_t n) { return n > 1; }))
    all.push_back(number("variance", film.variance));
  if (!film.samples.empty()) all.push_back(number("samples", film.samples));
  if (!film.dropped.empty()) all.push_back(number("dropped", film.dropped));
  if (const Layers* l = picture.layers) {
    all.push_back(triple({"albedo.R", "albedo.G", "albedo.B"}, l->albedo));
    all.push_back(triple({"emission.R", "emission.G", "emission.B"}, l->emission));
    all.push_back(triple({"normal.X", "normal.Y", "normal.Z"}, l->normal));
    all.push_back(triple({"position.X", "position.Y", "position.Z"}, l->position));
    all.push_back(number("depth", l->depth));
    all.push_back(number("descriptor", l->descriptor));
  }
  return all;
}

/// `1 marble, 2 floor`: what the numbers of the layer `descriptor` mean.
std::string legend(const Layers& layers) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < layers.names.size(); ++i)
    rows.push_back(fmt::format("{} {}", i + 1, layers.names[i]));
  return fmt::format("{}", fmt::join(rows, ", "));
}

void describe(OIIO::ImageSpec& spec, const Metadata& metadata) {
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
}

/// The picture file as bytes, in memory: it is put in place in one step.
Result<Done> write(const std::string& path, const OIIO::ImageSpec& spec, const void* pixels) {
  if (const Result<Done> ok = check_writable(path); !ok) return ok;
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path, &memory);
  if (!out) return Error{path, "cannot make the picture: " + OIIO::geterror(), kSupported};
  if (!out->open(path, spec) || !out->write_image(spec.format, pixels) || !out->close())
    return Error{path, "cannot make the picture: " + out->geterror(), ""};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const auto error = replace_file(path, text)) return *error;
  return Done{};
}

Result<Done> write_exr(const std::string& path, const Picture& picture) {
  const Film& film = picture.film;
  OIIO::ImageSpec spec(film.width, film.height, 0, OIIO::TypeDesc::FLOAT);
  const std::vector<Channels> all = channels_of(picture);
  for (const Channels& c : all)
    for (const char* name : c.names) spec.channelnames.push_back(name);
  spec.nchannels = int(spec.channelnames.size());
  std::vector<float> values(film.xyz.size() * spec.channelnames.size());
  float* to = values.data();
  for (std::size_t i = 0; i < film.xyz.size(); ++i)
    for (const Channels& c : all) {
      c.get(i, to);
      to += c.names.size();
    }
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  constexpr float kSrgb[] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), kSrgb);
  describe(spec, picture.metadata);
  if (picture.layers) spec.attribute("mms:descriptors", legend(*picture.layers));
  return write(path, spec, values.data());
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

Result<Done> write_png(const std::string& path, int width, int height,
                       std::span<const unsigned char> pixels, const Metadata& metadata) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  describe(spec, metadata);
  return write(path, spec, pixels.data());
}

Result<Done> write_picture(const std::string& path, const Picture& picture, const View& view) {
  if (extension_of(path) == ".exr") return write_exr(path, picture);
  const auto pixels = display_pixels(picture.film, view);
  if (!pixels) return pixels.error();
  return write_png(path, picture.film.width, picture.film.height, *pixels, picture.metadata);
}

}  // namespace mms::renderer
