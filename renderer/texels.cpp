// SPDX-License-Identifier: Apache-2.0
#include "renderer/texels.h"

#include <OpenImageIO/color.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/colour.h"
#include "renderer/png_fault.h"

namespace mms::renderer {
namespace {

constexpr const char* kFile = "mms:file";
constexpr const char* kSpace = "mms:space";
constexpr const char* kPacked = "mms:packed";
constexpr const char* kSrgb = "sRGB";
constexpr const char* kLinear = "linear";

OIIO::ImageSpec as_written() {
  OIIO::ImageSpec config;  // colours are not to be multiplied by alpha
  config.attribute("oiio:UnassociatedAlpha", 1);
  return config;
}

std::unique_ptr<OIIO::ImageInput> open_file(const std::string& path) {
  const OIIO::ImageSpec config = as_written();
  return OIIO::ImageInput::open(path, &config);
}

/// From the space of a file to linear; empty for sRGB and linear themselves, and where there is no
/// such space.
OIIO::ColorProcessorHandle processor_of(const std::string& space) {
  if (space == kSrgb || space == kLinear) return {};
  const OIIO::ColorConfig config;
  return config.createColorProcessor(space, kLinear);
}

/// Makes `count` pixels linear; channels behind the third, and the second of two, are coverage.
void make_linear(const std::string& space, const OIIO::ColorProcessorHandle& processor,
                 float* pixels, std::size_t count, int channels) {
  const int colours = channels >= 3 ? 3 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    float* p = pixels + i * std::size_t(channels);
    if (space == kSrgb) {
      for (int k = 0; k < colours; ++k) p[k] = float(materials::srgb_decode(p[k]));
    } else if (processor) {
      float rgb[3] = {p[0], p[colours / 2], p[colours - 1]};
      processor->apply(rgb);
      std::copy_n(rgb, colours, p);
    }
  }
}

/// A file as OpenImageIO reads it, but linear and in float.
class LinearInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "mms"; }
  int supports(OIIO::string_view) const override { return 0; }

  bool open(const std::string& name, OIIO::ImageSpec& spec) override {
    return open(name, spec, OIIO::ImageSpec());
  }
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    space_ = config.get_string_attribute(kSpace);
    processor_ = processor_of(space_);
    file_ = open_file(config.get_string_attribute(kFile));
    if (!file_) {
      errorfmt("{}", OIIO::geterror());
      return false;
    }
    take_spec();
    spec = m_spec;
    return true;
  }
  bool close() override {
    file_.reset();
    return true;
  }
  int current_subimage() const override { return file_ ? file_->current_subimage() : 0; }
  int current_miplevel() const override { return file_ ? file_->current_miplevel() : 0; }
  bool seek_subimage(int subimage, int miplevel) override {
    if (!file_ || !file_->seek_subimage(subimage, miplevel)) return false;
    take_spec();
    return true;
  }
  bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
    lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    return file_->read_scanline(y, z, OIIO::TypeDesc::FLOAT, data)
               ? finish(data, std::size_t(m_spec.width))
               : fail();
  }
  bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override {
    lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    return file_->read_tile(x, y, z, OIIO::TypeDesc::FLOAT, data)
               ? finish(data, std::size_t(m_spec.tile_pixels()))
               : fail();
  }

 private:
  void take_spec() {
    m_spec = file_->spec();
    m_spec.set_format(OIIO::TypeDesc::FLOAT);
    m_spec.channelformats.clear();
    m_spec.attribute("oiio:ColorSpace", "Linear");
  }
  bool finish(void* data, std::size_t pixels) {
    make_linear(space_, processor_, static_cast<float*>(data), pixels, m_spec.nchannels);
    return true;
  }
  bool fail() {
    errorfmt("{}", file_->geterror());
    return false;
  }

  std::unique_ptr<OIIO::ImageInput> file_;
  std::string space_;
  OIIO::ColorProcessorHandle processor_;
};

/// A packed picture, unpacked tile by tile.
class PackedInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "mms packed"; }
  int supports(OIIO::string_view) const override { return 0; }

  bool open(const std::string&, OIIO::ImageSpec&) override { return false; }
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    constexpr int kTile = 64;
    const OIIO::ParamValue* p = config.find_attribute(kPacked);
    if (!p) return false;
    packed_ = *static_cast<const Packed* const*>(p->data());
    m_spec = OIIO::ImageSpec(packed_->width(), packed_->height(), packed_->channels(),
                             OIIO::TypeDesc::FLOAT);
    m_spec.tile_width = m_spec.tile_height = kTile;
    m_spec.tile_depth = 1;
    spec = m_spec;
    return true;
  }
  bool close() override { return true; }
  bool seek_subimage(int subimage, int miplevel) override {
    return packed_ && subimage == 0 && miplevel == 0;
  }
  bool read_native_scanline(int, int, int, int, void*) override { return false; }
  bool read_native_tile(int subimage, int miplevel, int x, int y, int, void* data) override {
    if (!seek_subimage(subimage, miplevel)) return false;
    packed_->unpack(x, y, m_spec.tile_width, m_spec.tile_height, static_cast<float*>(data));
    return true;
  }

 private:
  const Packed* packed_ = nullptr;
};

/// The space of a file that is to say so itself: what it states, else sRGB for numbers of 8 bits.
std::string own_space(const OIIO::ImageSpec& spec) {
  const std::string stated = spec.get_string_attribute("oiio:ColorSpace");
  if (OIIO::Strutil::iequals(stated, kSrgb)) return kSrgb;
  if (OIIO::Strutil::iequals(stated, kLinear)) return kLinear;
  if (!stated.empty() && processor_of(stated)) return stated;
  return spec.format == OIIO::TypeDesc::UINT8 ? kSrgb : kLinear;
}

/// Whether the last pixels of the first level can be read.
bool reads_to_the_end(OIIO::ImageInput& file) {
  const OIIO::ImageSpec& s = file.spec();
  const int last = s.y + s.height - 1;
  if (s.tile_width == 0) {
    std::vector<float> row(std::size_t(s.width) * std::size_t(s.nchannels));
    return file.read_scanline(last, s.z, OIIO::TypeDesc::FLOAT, row.data());
  }
  std::vector<float> tile(std::size_t(s.tile_pixels()) * std::size_t(s.nchannels));
  const int x = s.x + (s.width - 1) / s.tile_width * s.tile_width;
  const int y = s.y + (s.height - 1) / s.tile_height * s.tile_height;
  return file.read_tile(x, y, s.z, OIIO::TypeDesc::FLOAT, tile.data());
}

/// An error of OpenImageIO on one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

Result<TexelFile> inspect_texels(const std::string& path, const std::string& space) {
  constexpr const char* kBroken = "write the file again; `oiiotool --info -v FILE` looks at it too";
  if (const std::string fault = png_fault(path); !fault.empty())
    return Error{path, "is broken: " + fault, kBroken};
  const auto file = open_file(path);
  if (!file) return Error{path, "cannot be read: " + one_line(OIIO::geterror()), kBroken};
  const OIIO::ImageSpec spec = file->spec();
  TexelFile t{path, space, spec.width, spec.height, spec.nchannels, spec.channelnames, false, 0};
  if (space == "auto") t.space = own_space(spec);
  if (t.space != kSrgb && t.space != kLinear && !processor_of(t.space))
    return Error{path, "cannot be made linear: there is no colour space `" + t.space + "`",
                 "`auto`, `sRGB` and `linear` are always there; $OCIO names a file with others"};
  const auto format = static_cast<OIIO::TypeDesc::BASETYPE>(spec.format.basetype);
  t.bounded = (format == OIIO::TypeDesc::UINT8 || format == OIIO::TypeDesc::UINT16) &&
              (t.space == kSrgb || t.space == kLinear);
  t.number_bytes = t.space == kLinear ? int(spec.format.basesize()) : int(sizeof(float));
  if (spec.deep || spec.depth > 1 || spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    return Error{path, "cannot be read: it is no flat picture", "flatten it"};
  if (!reads_to_the_end(*file))
    return Error{path, "is broken: " + one_line(file->geterror()), kBroken};
  return t;
}

bool texel_fact(const std::string& path, std::string_view name, double& value) {
  const auto file = open_file(path);
  if (!file) return false;
  const OIIO::ImageSpec spec = file->spec();
  const OIIO::ParamValue* p = spec.find_attribute(OIIO::string_view(name.data(), name.size()));
  if (!p || p->type().basetype == OIIO::TypeDesc::STRING || p->type().numelements() != 1 ||
      p->type().aggregate != OIIO::TypeDesc::SCALAR)
    return false;
  value = double(p->get_float());
  return true;
}

bool read_texels(const TexelFile& t, int level, TexelLevel& to) {
  const auto file = open_file(t.path);
  if (!file || !file->seek_subimage(0, level)) return false;
  const OIIO::ImageSpec spec = file->spec();
  const auto count = std::size_t(spec.image_pixels());
  to.width = spec.width;
  to.height = spec.height;
  to.pixels.resize(count * std::size_t(spec.nchannels));
  if (!file->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, to.pixels.data()))
    return false;
  make_linear(t.space, processor_of(t.space), to.pixels.data(), count, spec.nchannels);
  return true;
}

void texel_range(const TexelFile& t, double& low, double& high) {
  low = 0;
  high = 1;
  if (t.bounded) return;
  low = std::numeric_limits<double>::infinity();
  high = -low;
  TexelLevel texels;
  for (int level = 0; read_texels(t, level, texels); ++level)
    for (const float v : texels.pixels) {
      if (std::isnan(v)) continue;
      low = std::min(low, double(v));
      high = std::max(high, double(v));
    }
  if (low > high) {
    high = std::numeric_limits<double>::infinity();
    low = -high;
  }
}

Result<std::shared_ptr<const Packed>> pack_texels(const TexelFile& t) {
  TexelLevel texels;
  if (!read_texels(t, 0, texels))
    return Error{t.path, "cannot be read: " + one_line(OIIO::geterror()), ""};
  return std::make_shared<const Packed>(t.width, t.height, t.channels, texels.pixels.data());
}

std::string add_packed(void* cache, const TexelFile& t, const Packed& packed) {
  const std::string name = t.path + "|" + t.space + "|packed";
  OIIO::ImageSpec config;
  const Packed* const pointer = &packed;
  config.attribute(kPacked, OIIO::TypeDesc(OIIO::TypeDesc::PTR), &pointer);
  static_cast<OIIO::ImageCache*>(cache)->add_file(
      OIIO::ustring(name), []() -> OIIO::ImageInput* { return new PackedInput; }, &config);
  return name;
}

std::string add_texels(void* cache, const TexelFile& t) {
  if (t.space == kLinear) return t.path;
  const std::string name = t.path + "|" + t.space;
  OIIO::ImageSpec config = as_written();
  config.attribute(kFile, t.path);
  config.attribute(kSpace, t.space);
  static_cast<OIIO::ImageCache*>(cache)->add_file(
      OIIO::ustring(name), []() -> OIIO::ImageInput* { return new LinearInput; }, &config);
  return name;
}

}  // namespace mms::renderer
