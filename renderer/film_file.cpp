// SPDX-License-Identifier: Apache-2.0
#include "renderer/film_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "base/file.h"
#include "base/hash.h"
#include "renderer/scene.h"

namespace mms::renderer {
namespace {

// Sums are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(PixelSums) == 80 && std::is_trivially_copyable_v<PixelSums>);

constexpr std::string_view kFilmMagic = "\x89mmf\r\n\x1a\n";
/// Goes up too where a sample of a number becomes another: films of both would not add up.
constexpr std::uint32_t kFilmVersion = 45;
constexpr std::size_t kHashAt = 12, kBodyAt = 20;
constexpr int kLargestSide = 32768;

void put(std::string& out, const void* data, std::size_t size) {
  out.append(static_cast<const char*>(data), size);
}
template <class T>
void put(std::string& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>);
  put(out, &value, sizeof value);
}

/// Takes values from the front of bytes; past the end it gives zeros and remembers.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  T get() {
    T value{};
    get(&value, sizeof value);
    return value;
  }
  void get(void* to, std::size_t size) {
    if (size > rest_.size()) {
      good_ = false;
      rest_ = {};
      return;
    }
    std::copy_n(rest_.data(), size, static_cast<char*>(to));  // of none, `to` may be null
    rest_.remove_prefix(size);
  }
  std::size_t left() const { return rest_.size(); }
  bool good() const { return good_; }

 private:
  std::string_view rest_;
  bool good_ = true;
};

void put_key(std::string& out, const FilmKey& k) {
  put(out, std::int32_t(k.width));
  put(out, std::int32_t(k.height));
  put(out, std::int32_t(k.filter));
  put(out, std::int32_t(k.max_depth));
  put(out, std::int32_t(k.estimator));
  put(out, std::int32_t(k.generator));
  put(out, k.seed);
  put(out, k.script);
  put(out, k.scene);
}

/// Empty where no picture can have such a key.
std::optional<FilmKey> get_key(Reader& in) {
  FilmKey k;
  k.width = in.get<std::int32_t>();
  k.height = in.get<std::int32_t>();
  const auto filter = in.get<std::int32_t>();
  k.max_depth = in.get<std::int32_t>();
  const auto estimator = in.get<std::int32_t>(), generator = in.get<std::int32_t>();
  k.seed = in.get<std::uint64_t>();
  k.script = in.get<std::uint64_t>();
  k.scene = in.get<std::uint64_t>();
  if (k.width < 1 || k.width > kLargestSide || k.height < 1 || k.height > kLargestSide) return {};
  if (filter < 0 || filter >= int(filters().size())) return {};
  if (estimator < 0 || estimator >= int(estimators().size())) return {};
  if (generator < 0 || generator >= int(generators().size())) return {};
  k.filter = FilterShape(filter);
  k.estimator = Estimator(estimator);
  k.generator = Generator(generator);
  return k;
}

void put_samples(std::string& out, const SampleSet& set) {
  put(out, std::uint32_t(set.ranges().size()));
  for (const SampleSet::Range& r : set.ranges()) {
    put(out, r.first);
    put(out, r.second);
  }
}

bool get_samples(Reader& in, SampleSet& set) {
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.good(); ++i) {
    const auto first = in.get<std::uint32_t>(), second = in.get<std::uint32_t>();
    if (first >= second || second > std::uint32_t(kMostSamples)) return false;
    set.add({first, second});
  }
  return in.good();
}

void put_sums(std::string& out, const FilmSums& sums) {
  put(out, sums.pixels().data(), sums.pixels().size_bytes());
  put(out, std::uint32_t(sums.blocks()));
  for (int b = 0; b < sums.blocks(); ++b) {
    put(out, std::uint8_t(!sums.block(b).empty()));
    for (const BlockSums& s : sums.block(b)) {
      put(out, s.y);
      put(out, s.weight);
    }
  }
}

bool get_sums(Reader& in, FilmSums& sums) {
  std::vector<PixelSums> pixels(sums.pixels().size());
  in.get(pixels.data(), pixels.size() * sizeof(PixelSums));
  const auto blocks = in.get<std::uint32_t>();
  if (!in.good() || blocks > 32) return false;
  std::vector<std::vector<BlockSums>> all(blocks);
  for (auto& block : all) {
    if (in.get<std::uint8_t>() == 0) continue;
    block.resize(sums.probes());
    for (BlockSums& b : block) {
      b.y = in.get<Int128>();
      b.weight = in.get<std::int64_t>();
    }
  }
  if (!in.good()) return false;
  sums.restore(std::move(pixels), std::move(all));
  return true;
}

bool get_film(Reader& in, PartialFilm& film) {
  for (SampleSet& s : film.done)
    if (!get_samples(in, s)) return false;
  film.wanted.resize(in.get<std::uint8_t>() != 0 ? film.done.size() : 0);
  in.get(film.wanted.data(), film.wanted.size() * sizeof film.wanted[0]);
  return std::all_of(film.parts.begin(), film.parts.end(),
                     [&](FilmSums& part) { return get_sums(in, part); });
}

/// Calls `f` with each array of a value for every pixel.
template <class L, class F>
void for_each_array(L& layers, F f) {
  f(layers.albedo);
  f(layers.normal);
  f(layers.position);
  f(layers.depth);
  f(layers.emission);
  f(layers.descriptor);
}

void put_layers(std::string& out, const Layers& layers) {
  put(out, std::int32_t(layers.samples));
  put(out, std::uint32_t(layers.names.size()));
  for (const std::string& name : layers.names) {
    put(out, std::uint32_t(name.size()));
    out += name;
  }
  for_each_array(
      layers, [&](const auto& array) { put(out, array.data(), array.size() * sizeof array[0]); });
}

bool get_layers(Reader& in, std::size_t pixels, Layers& layers) {
  layers.samples = in.get<std::int32_t>();
  const auto names = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < names && in.good(); ++i) {
    const auto size = in.get<std::uint32_t>();
    if (size > in.left()) return false;
    in.get(layers.names.emplace_back(size, ' ').data(), size);
  }
  if (!in.good() || layers.samples < 1 || layers.samples > kLayerSamples) return false;
  for_each_array(layers, [&](auto& array) {
    array.resize(pixels);
    in.get(array.data(), pixels * sizeof array[0]);
  });
  return in.good() && std::all_of(layers.descriptor.begin(), layers.descriptor.end(),
                                  [&](std::uint32_t d) { return d <= layers.names.size(); });
}

std::string contents(const FilmKey& key, const PartialFilm& film, const Layers* layers) {
  std::string out(kFilmMagic);
  put(out, kFilmVersion);
  put(out, std::uint64_t(0));  // of the hash
  put_key(out, key);
  for (const SampleSet& s : film.done) put_samples(out, s);
  put(out, std::uint8_t(!film.wanted.empty()));
  put(out, film.wanted.data(), film.wanted.size() * sizeof(std::uint32_t));
  for (const FilmSums& part : film.parts) put_sums(out, part);
  put(out, std::uint8_t(layers != nullptr));
  if (layers) put_layers(out, *layers);
  const std::uint64_t hash = hash_bytes(std::span(out).subspan(kBodyAt));
  std::memcpy(out.data() + kHashAt, &hash, sizeof hash);
  return out;
}

}  // namespace

FilmKey film_key(const Scene& scene, const RenderOptions& options, std::uint64_t script) {
  return {options.width,     options.height,    options.filter, options.seed,     options.max_depth,
          options.estimator, options.generator, script,         scene.data().hash};
}

std::string difference(const FilmKey& a, const FilmKey& b) {
  if (a.width != b.width || a.height != b.height)
    return fmt::format("size {}x{} and {}x{}", a.width, a.height, b.width, b.height);
  if (a.filter != b.filter)
    return fmt::format("filter {} and {}", filters()[std::size_t(a.filter)].name,
                       filters()[std::size_t(b.filter)].name);
  if (a.seed != b.seed) return fmt::format("seed {} and {}", a.seed, b.seed);
  if (a.max_depth != b.max_depth) return fmt::format("depth {} and {}", a.max_depth, b.max_depth);
  if (a.estimator != b.estimator)
    return fmt::format("estimator {} and {}", estimators()[std::size_t(a.estimator)].name,
                       estimators()[std::size_t(b.estimator)].name);
  if (a.generator != b.generator)
    return fmt::format("sampler {} and {}", generators()[std::size_t(a.generator)].name,
                       generators()[std::size_t(b.generator)].name);
  if (a.script != b.script) return "other scripts or settings";
  if (a.scene != b.scene) return "other scenes, surfaces or volumes";
  return "";
}

Result<Done> save_film(const std::string& path, const FilmKey& key, const PartialFilm& film,
                       const Layers* layers) {
  if (const auto error = replace_file(path, contents(key, film, layers))) return *error;
  return Done{};
}

Result<StoredFilm> load_film(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return Error{path, "is a folder, not a film", "name a file in it"};
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file && bytes.empty())
    return Error{path, "cannot be read", "check the spelling and the folder you are in"};
  const std::string hint = "films are what `mms render -o NAME.film` and checkpoints write";
  if (!bytes.starts_with(kFilmMagic) || bytes.size() < kBodyAt)
    return Error{path, "is no film", hint};
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + kFilmMagic.size(), sizeof version);
  if (version != kFilmVersion)
    return Error{path,
                 fmt::format("is a film of version {}; this mms reads {}", version, kFilmVersion),
                 "render it anew"};
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes.data() + kHashAt, sizeof hash);
  const Error damaged{path, "is damaged", "render it anew"};
  if (hash != hash_bytes(std::span(bytes).subspan(kBodyAt))) return damaged;
  Reader in(std::string_view(bytes).substr(kBodyAt));
  const std::optional<FilmKey> key = get_key(in);
  // Nothing is allocated that the file's length does not pay for.
  if (!key || in.left() < std::size_t(key->width) * std::size_t(key->height) * sizeof(PixelSums))
    return damaged;
  StoredFilm stored{*key, PartialFilm(key->width, key->height, key->filter)};
  if (!get_film(in, stored.film)) return damaged;
  if (in.get<std::uint8_t>() != 0) {
    Layers layers;
    if (!get_layers(in, std::size_t(key->width) * std::size_t(key->height), layers)) return damaged;
    stored.layers = std::make_shared<const Layers>(std::move(layers));
  }
  if (!in.good() || in.left() > 0) return damaged;
  return stored;
}

}  // namespace mms::renderer
