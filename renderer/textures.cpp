// SPDX-License-Identifier: Apache-2.0
#include "renderer/textures.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "renderer/profile.h"
#include "renderer/texel_bounds.h"
#include "renderer/texel_lookup.h"
#include "renderer/texels.h"
#include "vm/interval.h"

namespace mms::renderer {
namespace {

namespace fs = std::filesystem;
using vm::ImageAsk;
using vm::ImageUse;

constexpr std::string_view kUdim = "<UDIM>";
constexpr int kFirstTile = 1001, kTilesInRow = 10;

/// A tile of a picture, and its place: (0, 0) is all of a picture without tiles.
struct Tile {
  TexelFile file;
  TexelPyramid pyramid;
  std::shared_ptr<const Packed> packed;  ///< null: as the file has it
};

TexelFilter filter_of(const std::string& word) {
  if (word == "nearest") return TexelFilter::Nearest;
  if (word == "bilinear") return TexelFilter::Bilinear;
  return word == "bicubic" ? TexelFilter::Bicubic : TexelFilter::Smart;
}

TexelWrap wrap_of(const std::string& word) {
  if (word == "mirror") return TexelWrap::Mirror;
  if (word == "clamp") return TexelWrap::Clamp;
  return word == "black" ? TexelWrap::Black : TexelWrap::Repeat;
}

class Texture final : public vm::Image {
 public:
  Texture(std::shared_ptr<const TexelCache> cache, const ImageUse& use,
          std::map<std::pair<int, int>, Tile> tiles, bool tiled, int channel)
      : cache_(std::move(cache)),
        tiles_(std::move(tiles)),
        tiled_(tiled),
        channel_(channel),
        filter_(filter_of(use.filter)),
        wrap_(tiled ? TexelWrap::Clamp : wrap_of(use.wrap)) {}

  void look_up(ImageAsk ask, const float* const* in, float* const* out, int lanes) const override {
    run(ask, in, out, lanes);
  }
  void look_up64(ImageAsk ask, const double* const* in, double* const* out,
                 int lanes) const override {
    run(ask, in, out, lanes);
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

  void enclose(ImageAsk ask, const vm::Interval* in, vm::Interval* out) const override {
    vm::Image::enclose(ask, in, out);
    if (vm::is_slope(ask)) {
      enclose_slopes(ask, out);
    } else if (const auto near = enclosed_nearby(in)) {
      std::fill_n(out, vm::result_count(ask), *near);
    }
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> all;
    for (const auto& [place, tile] : tiles_) all.push_back(tile.file.path);
    return all;
  }

 private:
  /// Of each tile, read when they are first asked for.
  const std::vector<TexelBounds>& bounds() const {
    std::call_once(bounded_, [this] {
      for (const auto& [place, tile] : tiles_) bounds_.emplace_back(tile.file);
    });
    return bounds_;
  }

  /// How much further apart two texels of a tile are than it says. Those that were packed may be
  /// as far apart as any two; beside a black border there is 0.
  double jump(const Tile& tile, const TexelBounds& b) const {
    const double most = std::max(std::abs(b.low()), std::abs(b.high()));
    const bool bordered = wrap_ == TexelWrap::Black || tile.pyramid.cropped();
    const double black = bordered ? most : 0;
    const double packed = tile.packed ? b.high() - b.low() + 2 * Packed::kRounding * most : 0;
    return std::max(black, packed);
  }

  /// Means of texels are no steeper than these change, whatever the pixel.
  void enclose_slopes(ImageAsk ask, vm::Interval* out) const {
    constexpr double kMade = 0x1p-20;  // of levels made in float: two texels of 8 roundings
    double u = 0, v = 0;
    auto b = bounds().begin();
    for (const auto& [place, tile] : tiles_) {
      const double far = b->known() ? jump(tile, *b) : vm::Interval::kInf;
      const double made = kMade * std::max(std::abs(b->low()), std::abs(b->high()));
      u = std::max(u, std::max(b->slope_u(), far * tile.file.width) + made * tile.file.width);
      v = std::max(v, std::max(b->slope_v(), far * tile.file.height) + made * tile.file.height);
      ++b;
    }
    if (filter_ == TexelFilter::Nearest) u = v = 0;
    for (int k = 0; k < vm::result_count(ask); ++k) {
      const double most = k % 2 ? v : u;
      out[k] = {-most, most, false};
    }
  }

  /// Which of `count` texels of an axis are looked at where x, in texels from the first one's
  /// middle, is in a range: two to either side. All where they go round a border.
  struct Stretch {
    int first, last;
    bool outside;
  };
  Stretch stretch(double lo, double hi, int count) const {
    const double first = std::floor(lo) - 1, last = std::floor(hi) + 2;
    const bool outside = first < 0 || last >= count;
    if (!outside) return {int(first), int(last), false};
    const double round = std::floor(first / count) * count;
    if (wrap_ == TexelWrap::Repeat && last - round < count)
      return {int(first - round), int(last - round), false};
    if (wrap_ != TexelWrap::Clamp) return {0, count - 1, true};
    const double most = count - 1;
    return {int(std::clamp(first, 0.0, most)), int(std::clamp(last, 0.0, most)), true};
  }

  /// What colours can be over a box of places, where the pixel is a point and so texels near them
  /// are all that is looked at; nothing where it is not.
  std::optional<vm::Interval> enclosed_nearby(const vm::Interval* in) const {
    for (int k = 2; k < vm::kImageArguments; ++k)
      if (!(in[k] == vm::Interval::point(0))) return std::nullopt;
    const TexelFile& file = tiles_.begin()->second.file;
    constexpr double kMost = 0x1p20;  // beyond, floats miss the texel
    for (int k = 0; k < 2; ++k)
      if (in[k].nan || !(in[k].magnitude() * std::max(file.width, file.height) < kMost))
        return std::nullopt;
    if (tiled_ || tiles_.begin()->second.pyramid.cropped() || !bounds()[0].known())
      return std::nullopt;
    const double w = file.width, h = file.height;
    const Stretch x = stretch(in[0].lo * w - 0.5, in[0].hi * w - 0.5, file.width);
    const Stretch y = stretch((1 - in[1].hi) * h - 0.5, (1 - in[1].lo) * h - 0.5, file.height);
    vm::Interval r;
    bounds()[0].within(x.first, x.last, y.first, y.last, r.lo, r.hi);
    if (tiles_.begin()->second.packed) {
      const double slack = Packed::kRounding * r.magnitude();
      r = {r.lo - slack, r.hi + slack, false};
    }
    if (wrap_ == TexelWrap::Black && (x.outside || y.outside))
      r = vm::join(r, vm::Interval::point(0));
    return r;
  }

  /// What all of it takes in memory: packed, or decoded.
  double bytes() const {
    double sum = 0;
    for (const auto& [place, tile] : tiles_)
      sum += tile.packed ? double(tile.packed->bytes())
                         : double(tile.file.width) * tile.file.height * tile.file.channels *
                               tile.file.number_bytes;
    return sum;
  }

  template <class R>
  void run(ImageAsk ask, const R* const* in, R* const* out, int lanes) const {
    TexelReader reader(*cache_);
    const int results = vm::result_count(ask);
    R last[vm::kImageArguments];
    for (int i = 0; i < lanes; ++i) {
      R at[vm::kImageArguments];
      for (int k = 0; k < vm::kImageArguments; ++k) at[k] = in[k][i];
      if (i > 0 && std::equal(at, at + vm::kImageArguments, last)) {  // lanes that only fill up
        for (int k = 0; k < results; ++k) out[k][i] = out[k][i - 1];
        continue;
      }
      std::copy_n(at, vm::kImageArguments, last);
      R values[vm::result_count(ImageAsk::ColourSlope)] = {};
      one(reader, ask, at, values);
      for (int k = 0; k < results; ++k) out[k][i] = values[k];
    }
  }

  /// One point.
  template <class R>
  void one(TexelReader& reader, ImageAsk ask, R* at, R* values) const {
    if (!std::all_of(at, at + vm::kImageArguments, [](R x) { return std::isfinite(x); })) return;
    const Tile* const tile = find(at[0], at[1]);
    if (!tile) return;
    const bool colour = ask == ImageAsk::Colour || ask == ImageAsk::ColourSlope;
    const bool all = (colour || channel_ < 0) && tile->file.channels >= 3;
    TexelSums<R> sums;
    TexelLookup<R> look_up(reader, tile->pyramid, filter_, wrap_,
                           colour || channel_ < 0 ? 0 : channel_, all ? 3 : 1, vm::is_slope(ask));
    if (!look_up.run(at, sums)) sums = {{1, 0, 1}, {}, {}};  // magenta
    if (!all)
      for (R* v : {sums.value, sums.u, sums.v}) v[1] = v[2] = v[0];
    const auto weighed = [&](const R* v) {  // ITU-R BT.709
      return all ? R(0.2126) * v[0] + R(0.7152) * v[1] + R(0.0722) * v[2] : v[0];
    };
    if (ask == ImageAsk::Colour) {
      std::copy_n(sums.value, 3, values);
    } else if (ask == ImageAsk::Number) {
      values[0] = weighed(sums.value);
    } else if (ask == ImageAsk::NumberSlope) {
      values[0] = weighed(sums.u);
      values[1] = weighed(sums.v);
    } else {
      for (int k = 0; k < 3; ++k) {
        values[2 * k] = sums.u[k];
        values[2 * k + 1] = sums.v[k];
      }
    }
  }

  /// The tile that holds the point, whose place in it is left in `s` and `t`; null outside.
  template <class R>
  const Tile* find(R& s, R& t) const {
    if (!tiled_) return &tiles_.begin()->second;
    const R column = std::floor(s), row = std::floor(t);
    if (!(column >= 0 && column < kTilesInRow && row >= 0 && row < 1000)) return nullptr;
    const auto it = tiles_.find({int(column), int(row)});
    if (it == tiles_.end()) return nullptr;
    s -= column;
    t -= row;
    return &it->second;
  }

  std::shared_ptr<const TexelCache> cache_;
  std::map<std::pair<int, int>, Tile> tiles_;
  bool tiled_;
  int channel_;  ///< of a number; -1: luminance, or the only one
  TexelFilter filter_;
  TexelWrap wrap_;
  mutable std::once_flag bounded_;
  mutable std::vector<TexelBounds> bounds_;
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
  explicit Textures(double megabytes) : cache_(std::make_shared<const TexelCache>(megabytes)) {}

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
      auto pyramid =
          TexelPyramid::open(*cache_, packed ? add_packed(cache_->handle(), *file, *packed)
                                             : add_texels(cache_->handle(), *file));
      if (!pyramid) return Error{path, pyramid.error().what, ""};
      tiles[place] = {*file, std::move(*pyramid), packed};
    }
    const auto channel = channel_of(use, tiles.begin()->second.file);
    if (!channel) return channel.error();
    return std::shared_ptr<const vm::Image>(
        std::make_shared<Texture>(cache_, use, std::move(tiles), tiled, *channel));
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

  std::shared_ptr<const TexelCache> cache_;
  std::map<std::string, std::shared_ptr<const Packed>> packed_;  ///< by path and space
};

}  // namespace

std::unique_ptr<vm::ImageSource> open_textures(double megabytes) {
  return std::make_unique<Textures>(megabytes);
}

}  // namespace mms::renderer
