// SPDX-License-Identifier: Apache-2.0
// Pictures with all their layers as .exr, in memory.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "materials/colour.h"
#include "renderer/openimageio.h"

namespace mms::renderer {
namespace {

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

}  // namespace

Result<std::string> in_module::exr(const Picture& picture) {
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
  for (const auto& [name, value] : picture.metadata) spec.attribute(name, value);
  if (picture.layers) spec.attribute("mms:descriptors", legend(*picture.layers));
  constexpr const char* kName = "picture.exr";  // tells the format
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(kName, &memory);
  if (!out) return Error{"", "cannot make the picture: " + OIIO::geterror(), ""};
  if (!out->open(kName, spec) || !out->write_image(spec.format, values.data()) || !out->close())
    return Error{"", "cannot make the picture: " + out->geterror(), ""};
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace mms::renderer
