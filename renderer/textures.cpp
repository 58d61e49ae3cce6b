// SPDX-License-Identifier: Apache-2.0
#include "renderer/textures.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/texture.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "renderer/profile.h"
#include "renderer/texels.h"

namespace mms::renderer {
namespace {

namespace fs = std::filesystem;
using vm::ImageAsk;
using vm::ImageUse;

constexpr std::string_view kUdim = "<UDIM>";
constexpr int kFirstTile = 1001, kTilesInRow = 10;

/// The texture system and its cache of tiles: pictures share it and keep it alive.
class System {
 public:
  explicit System(double megabytes) : cache_(OIIO::ImageCache::create(false)) {
    cache_->attribute("max_memory_MB", float(megabytes));
    cache_->attribute("autotile", 64);
    cache_->attribute("automip", 1);
    cache_->attribute("unassociatedalpha", 1);
    textures_ = OIIO::TextureSystem::create(false, cache_);
  }
  ~System() {
    // OpenImageIO 2.4 deletes a texture system by a base that has no virtual destructor: a few
    // hundred bytes stay behind, and the address sanitizer stops there.
#ifdef __SANITIZE_ADDRESS__
    __lsan_ignore_object(textures_);
#else
    OIIO::TextureSystem::destroy(textures_);
#endif
    OIIO::ImageCache::destroy(cache_);
  }
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  OIIO::TextureSystem& textures() const { return *textures_; }
  OIIO::ImageCache& cache() const { return *cache_; }

 private:
  OIIO::ImageCache* cache_;
  OIIO::TextureSystem* textures_;
};

/// A tile of a picture, and its place: (0, 0) is all of a picture without tiles.
struct Tile {
  TexelFile file;
  OIIO::TextureSystem::TextureHandle* handle = nullptr;
  std::shared_ptr<const Packed> packed;  ///< null: as the file has it
};

OIIO::TextureOpt::InterpMode interpolation(const std::string& word) {
  if (word == "nearest") return OIIO::TextureOpt::InterpClosest;
  if (word == "bilinear") return OIIO::TextureOpt::InterpBilinear;
  return word == "bicubic" ? OIIO::TextureOpt::InterpBicubic : OIIO::TextureOpt::InterpSmartBicubic;
}

OIIO::TextureOpt::Wrap wrapping(const std::string& word) {
  if (word == "mirror") return OIIO::TextureOpt::WrapMirror;
  if (word == "clamp") return OIIO::TextureOpt::WrapClamp;
  return word == "black" ? OIIO::TextureOpt::WrapBlack : OIIO::TextureOpt::WrapPeriodic;
}

class Texture final : public vm::Image {
 public:
  Texture(std::shared_ptr<const System> system, const ImageUse& use,
          std::map<std::pair<int, int>, Tile> tiles, bool tiled, int channel)
      : system_(std::move(system)), tiles_(std::move(tiles)), tiled_(tiled), channel_(channel) {
    options_.interpmode = interpolation(use.filter);
    options_.swrap = options_.twrap = tiled ? OIIO::TextureOpt::WrapClamp : wrapping(use.wrap);
    options_.missingcolor = kMissing;
  }

  void look_up(ImageAsk ask, const float* const* in, float* const* out, int lanes) const override {
    OIIO::TextureSystem::Perthread* thread = system_->textures().get_perthread_info();
    OIIO::TextureOpt options = options_;
    const int results = vm::result_count(ask);
    float last[vm::kImageArguments];
    for (int i = 0; i < lanes; ++i) {
      float at[vm::kImageArguments];
      for (int k = 0; k < vm::kImageArguments; ++k) at[k] = in[k][i];
      if (i > 0 && std::equal(at, at + vm::kImageArguments, last)) {  // lanes that only fill up
        for (int k = 0; k < results; ++k) out[k][i] = out[k][i - 1];
        continue;
      }
      std::copy_n(at, vm::kImageArguments, last);
      float values[vm::result_count(ImageAsk::ColourSlope)] = {};
      one(ask, options, thread, at, values);
      for (int k = 0; k < results; ++k) out[k][i] = values[k];
    }
  }

  std::optional<double> number(std::string_view name) const override {
    const TexelFile& file = tiles_.begin()->second.file;
    if (name == "width") return file.width;
    if (name == "height") return file.height;
    if (name == "channels") return file.channels;
    if (name == "bytes") return bytes();
    double value;
    return texel_fact(file.path, name, value) ? std::optional(value) : std::nullopt;
  }

  void range(double& low, double& high) const override {
    std::call_once(ranged_, [this] {
      for (const auto& [place, tile] : tiles_) {
        double lo, hi;
        texel_range(tile.file, lo, hi);
        const double slack =
            tile.packed ? Packed::kRounding * std::max(std::abs(lo), std::abs(hi)) : 0;
        low_ = std::min(low_, lo - slack);
        high_ = std::max(high_, hi + slack);
      }
    });
    low = low_;
    high = high_;
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> all;
    for (const auto& [place, tile] : tiles_) all.push_back(tile.file.path);
    return all;
  }

 private:
  /// What all of it takes in memory: packed, or decoded.
  double bytes() const {
    double sum = 0;
    for (const auto& [place, tile] : tiles_)
      sum += tile.packed ? double(tile.packed->bytes())
                         : double(tile.file.width) * tile.file.height * tile.file.channels *
                               tile.file.number_bytes;
    return sum;
  }

  static constexpr float kMissing[4] = {1, 0, 1, 1};
  static constexpr float kLuminance[3] = {0.2126f, 0.7152f, 0.0722f};  // ITU-R BT.709

  /// One point. OpenImageIO counts rows from the top, so v is turned over.
  void one(ImageAsk ask, OIIO::TextureOpt& options, OIIO::TextureSystem::Perthread* thread,
           const float* at, float* values) const {
    if (!std::all_of(at, at + vm::kImageArguments, [](float x) { return std::isfinite(x); }))
      return;
    float s = at[0], t = at[1];
    const Tile* tile = find(s, t);
    if (!tile) return;
    const int channels = tile->file.channels;
    const bool colour = ask == ImageAsk::Colour || ask == ImageAsk::ColourSlope;
    const bool slope = ask == ImageAsk::NumberSlope || ask == ImageAsk::ColourSlope;
    // OpenImageIO leaves the slopes of single texels as they were.
    const bool steep = slope && options.interpmode != OIIO::TextureOpt::InterpClosest;
    const bool all = (colour || channel_ < 0) && channels >= 3;
    options.firstchannel = colour || channel_ < 0 ? 0 : channel_;
    options.sblur = std::abs(at[6]);
    options.tblur = std::abs(at[7]);
    float rgb[4] = {}, ds[4] = {}, dt[4] = {};
    system_->textures().texture(tile->handle, thread, options, s, 1 - t, at[2], -at[3], at[4],
                                -at[5], all ? 3 : 1, rgb, steep ? ds : nullptr,
                                steep ? dt : nullptr);
    for (float& d : dt) d = -d;
    if (!all)
      for (float* v : {rgb, ds, dt}) v[1] = v[2] = v[0];
    const auto weighed = [&](const float* v) {
      if (!all) return v[0];
      return kLuminance[0] * v[0] + kLuminance[1] * v[1] + kLuminance[2] * v[2];
    };
    if (ask == ImageAsk::Colour) {
      std::copy_n(rgb, 3, values);
    } else if (ask == ImageAsk::Number) {
      values[0] = weighed(rgb);
    } else if (ask == ImageAsk::NumberSlope) {
      values[0] = weighed(ds);
      values[1] = weighed(dt);
    } else {
      for (int k = 0; k < 3; ++k) {
        values[2 * k] = ds[k];
        values[2 * k + 1] = dt[k];
      }
    }
  }

  /// The tile that holds the point, whose place in it is left in `s` and `t`; null outside.
  const Tile* find(float& s, float& t) const {
    if (!tiled_) return &tiles_.begin()->second;
    const float column = std::floor(s), row = std::floor(t);
    if (!(column >= 0 && column < kTilesInRow && row >= 0 && row < 1000)) return nullptr;
    const auto it = tiles_.find({int(column), int(row)});
    if (it == tiles_.end()) return nullptr;
    s -= column;
    t -= row;
    return &it->second;
  }

  std::shared_ptr<const System> system_;
  std::map<std::pair<int, int>, Tile> tiles_;
  bool tiled_;
  int channel_;  ///< of a number; -1: luminance, or the only one
  OIIO::TextureOpt options_;
  mutable std::once_flag ranged_;
  mutable double low_ = 0, high_ = 0;
};

/// The files whose names are `pattern` with the number of a tile, by the tile's place.
std::map<std::pair<int, int>, std::string> find_tiles(const std::string& pattern) {
  std::map<std::pair<int, int>, std::string> found;
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const std::size_t at = name.find(kUdim);
  if (at == name.npos) return found;
  const std::string before = name.substr(0, at), behind = name.substr(at + kUdim.size());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (file.size() != before.size() + 4 + behind.size() || !file.starts_with(before) ||
        !file.ends_with(behind))
      continue;
    int number = 0;
    const char* digits = file.data() + before.size();
    const auto [end, wrong] = std::from_chars(digits, digits + 4, number);
    if (wrong != std::errc() || end != digits + 4 || number < kFirstTile) continue;
    const int k = number - kFirstTile;
    found[{k % kTilesInRow, k / kTilesInRow}] = (path.parent_path() / file).string();
  }
  return found;
}

class Textures final : public vm::ImageSource {
 public:
  explicit Textures(double megabytes) : system_(std::make_shared<const System>(megabytes)) {}

  Result<std::shared_ptr<const vm::Image>> open(const ImageUse& use) override {
    if (is_profile(use.file)) return open_profile(use.file);
    const bool tiled = use.file.find(kUdim) != std::string::npos;
    std::map<std::pair<int, int>, std::string> files{{{0, 0}, use.file}};
    if (tiled) files = find_tiles(use.file);
    if (files.empty()) return Error{use.file, "does not exist: there is no tile of it", ""};
    std::map<std::pair<int, int>, Tile> tiles;
    for (const auto& [place, path] : files) {
      const auto file = inspect_texels(path, use.space);
      if (!file) return file.error();
      std::shared_ptr<const Packed> packed;
      if (use.storage == "compressed") {
        std::shared_ptr<const Packed>& kept = packed_[path + "|" + file->space];
        if (!kept) {
          auto made = pack_texels(*file);
          if (!made) return made.error();
          kept = *made;
        }
        packed = kept;
      }
      const OIIO::ustring name(packed ? add_packed(&system_->cache(), *file, *packed)
                                      : add_texels(&system_->cache(), *file));
      tiles[place] = {*file, system_->textures().get_texture_handle(name), packed};
      if (!system_->textures().good(tiles[place].handle))
        return Error{path, "cannot be read: " + system_->textures().geterror(), ""};
    }
    const auto channel = channel_of(use, tiles.begin()->second.file);
    if (!channel) return channel.error();
    return std::shared_ptr<const vm::Image>(
        std::make_shared<Texture>(system_, use, std::move(tiles), tiled, *channel));
  }

 private:
  /// The place of the channel that `use` names; -1 where it names none.
  static Result<int> channel_of(const ImageUse& use, const TexelFile& file) {
    if (use.channel.empty()) return -1;
    std::string names;
    for (std::size_t k = 0; k < file.channel_names.size(); ++k) {
      if (use.channel == file.channel_names[k] || use.channel == std::to_string(k)) return int(k);
      names += (k ? ", " : "") + file.channel_names[k];
    }
    return Error{use.file, "has no channel `" + use.channel + "`", "its channels are " + names};
  }

  std::shared_ptr<const System> system_;
  std::map<std::string, std::shared_ptr<const Packed>> packed_;  ///< by path and space
};

}  // namespace

std::unique_ptr<vm::ImageSource> open_textures(double megabytes) {
  return std::make_unique<Textures>(megabytes);
}

}  // namespace mms::renderer

mms::vm::ImageSource* mms_open_images(double megabytes) {
  return mms::renderer::open_textures(megabytes).release();
}
