// SPDX-License-Identifier: Apache-2.0
// Pictures that are read.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "materials/colour.h"
#include "renderer/openimageio.h"
#include "renderer/png_fault.h"

namespace mms::renderer {
namespace {

/// OpenImageIO may say the same in several lines.
Error unreadable(const std::string& path, const std::string& why) {
  return {path, "cannot read the picture: " + why.substr(0, why.find('\n')),
          "is it whole, and a picture that OpenImageIO reads?", Error::Cause::File};
}

/// The channels of `layer`, three; nothing where there is no such layer.
std::optional<std::array<int, 3>> channels(const OIIO::ImageSpec& spec, const std::string& layer) {
  if (layer.empty()) return spec.nchannels >= 3 ? std::array{0, 1, 2} : std::array{0, 0, 0};
  if (const int only = spec.channelindex(layer); only >= 0) return std::array{only, only, only};
  std::array<int, 3> found{-1, -1, -1};
  for (const char* letters : {"RGB", "XYZ"})
    for (std::size_t k = 0; k < 3; ++k)
      if (const int c = spec.channelindex(layer + "." + letters[k]); c >= 0) found[k] = c;
  if (std::find(found.begin(), found.end(), -1) != found.end()) return {};
  return found;
}

/// Names of all layers, for a message.
std::string layers(const OIIO::ImageSpec& spec) {
  std::vector<std::string> names;
  for (const std::string& channel : spec.channelnames) {
    std::string name = channel.substr(0, channel.find('.'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Metadata texts(const OIIO::ImageSpec& spec) {
  Metadata all;
  for (const auto& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      all.emplace_back(attribute.name().string(), attribute.get_string());
  return all;
}

}  // namespace

Result<ReadPicture> in_module::read(const std::string& path, const std::string& layer) {
  if (const std::string fault = png_fault(path); !fault.empty()) return unreadable(path, fault);
  const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path);
  if (!in) return unreadable(path, OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.nchannels < 1 || spec.width < 1 || spec.height < 1)
    return Error{path, "the picture has no pixels", ""};
  const auto wanted = channels(spec, layer);
  if (!wanted)
    return Error{path, fmt::format("has no layer `{}`", layer), "it has: " + layers(spec)};
  const std::size_t area = std::size_t(spec.width) * std::size_t(spec.height);
  const std::size_t stride = std::size_t(spec.nchannels);
  std::vector<float> pixels(area * stride);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
    return unreadable(path, in->geterror());
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const bool encoded = space.empty() ? spec.format.is_floating_point() == false : space == "sRGB";
  const int variance = spec.channelindex("variance");
  ReadPicture picture{spec.width, spec.height, {}, {}, texts(spec), encoded};
  picture.rgb.reserve(area);
  for (std::size_t i = 0; i < area; ++i) {
    const float* p = &pixels[i * stride];
    std::array<float, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = p[(*wanted)[k]];
      if (encoded) c[k] = float(materials::srgb_decode(std::clamp(c[k], 0.0f, 1.0f)));
    }
    picture.rgb.push_back(c);
    if (variance >= 0) picture.variance.push_back(p[variance]);
  }
  return picture;
}

}  // namespace mms::renderer
