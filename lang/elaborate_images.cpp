// SPDX-License-Identifier: Apache-2.0
/// \file
/// Images and tables of the elaborator: a name becomes a number of the program's list, and the
/// machine looks that up. What cannot be read is told once for each file, with every place that
/// names it.

#include <algorithm>
#include <filesystem>

#include "lang/elaborator.h"

namespace mms::lang {
namespace {

constexpr std::string_view kUdim = "<UDIM>";

template <std::size_t N>
bool known_word(const vm::ImageWord (&words)[N], std::string_view word) {
  return std::any_of(std::begin(words), std::end(words),
                     [&](const vm::ImageWord& w) { return w.word == word; });
}

template <std::size_t N>
std::string words_of(const vm::ImageWord (&words)[N]) {
  std::string all = "there are";
  for (const vm::ImageWord& w : words)
    all += fmt::format("{} `{}`", &w == words ? "" : ",", w.word);
  return all;
}

}  // namespace

/// Says what is wrong with the words of `use`; whether they are right.
bool Elaborator::check_words(const vm::ImageUse& use) {
  const bool curve = use.filter == vm::kCurveFilter;
  auto check = [&](const auto& words, const std::string& word, const char* what) {
    if (known_word(words, word)) return true;
    diagnostics_.add(Diag::ImageWord, user_span_, word, what, curve ? "tables" : "images")
        .help(words_of(words));
    return false;
  };
  if (curve) return check(vm::kCurveUnits, use.space, "unit");
  const bool filter = check(vm::kImageFilters, use.filter, "filter");
  const bool wrap = check(vm::kImageWraps, use.wrap, "wrap mode");
  const bool storage = check(vm::kImageStorages, use.storage, "storage");
  return filter && wrap && storage;
}

/// Opens what `use` names, first beside the script, then in the folders of imports.
Result<std::shared_ptr<const vm::Image>> Elaborator::open_image(vm::ImageUse& use) {
  namespace fs = std::filesystem;
  if (!options_.images)
    return Error{"", "cannot be read: there is nothing here that reads images",
                 "images need mms with OpenImageIO"};
  const std::string written = use.file;
  std::vector<fs::path> places{fs::path(written)};
  if (user_span_.source) places[0] = fs::path(user_span_.source->name).parent_path() / written;
  for (const std::string& dir : options_.import_path) places.push_back(fs::path(dir) / written);
  Error first{"", "does not exist", ""};
  for (const fs::path& place : places) {
    if (options_.looked_for) options_.looked_for(place.string());
    std::error_code ignored;
    const bool tiles = written.find(kUdim) != std::string::npos;
    if (!tiles && !fs::exists(place, ignored)) continue;
    use.file = place.string();
    auto image = options_.images->open(use);
    if (image || !tiles) return image;
    first = image.error();
  }
  use.file = written;
  if (first.hint.empty())
    first.hint = "files are looked for beside the script, then in each `-I` folder";
  return first;
}

/// The number of an image of the program; none where it is not there, which `report_images` tells.
std::optional<std::uint32_t> Elaborator::image_number(vm::ImageUse use) {
  const std::string folder =
      user_span_.source ? std::filesystem::path(user_span_.source->name).parent_path().string()
                        : std::string();
  const vm::ImageUse written = use;
  const auto known_image = image_numbers_.find({folder, written.file});
  if (known_image != image_numbers_.end())
    for (const std::uint32_t k : known_image->second) {
      use.file = module.images[k].use.file;
      if (module.images[k].use == use) return k;
    }
  for (MissingImage& missing : missing_images_)
    if (missing.folder == folder && missing.use == written) {
      missing.places.push_back(user_span_);
      return std::nullopt;
    }
  use = written;
  auto image = open_image(use);
  if (!image) {
    missing_images_.push_back({folder, written, image.error(), {user_span_}});
    return std::nullopt;
  }
  for (std::string& file : (*image)->files())
    if (std::find(dependencies.begin(), dependencies.end(), file) == dependencies.end())
      dependencies.push_back(std::move(file));
  const auto number = static_cast<std::uint32_t>(module.images.size());
  module.images.push_back({use, *image});
  image_numbers_[{folder, written.file}].push_back(number);
  return number;
}

/// `intrinsic::image(file, filter, wrap, space, channel, storage)`: an integer.
Value Elaborator::image_handle(const std::vector<BoundArgument>& args) {
  const auto text = [&](std::size_t k) { return args[k].value.text; };
  return handle_of({text(0), text(1), text(2), text(3), text(4), text(5)});
}

Value Elaborator::handle_of(const vm::ImageUse& use) {
  if (use.file.empty() && unknown_arguments_) return unknown_value(kInteger);
  if (!check_words(use)) return {};
  const auto number = image_number(use);
  return scalar(kInteger, integer(number ? std::int64_t(*number) : -1));
}

/// `intrinsic::curve(file, unit, column)`: an integer.
Value Elaborator::curve_handle(const std::vector<BoundArgument>& args) {
  const auto text = [&](std::size_t k) { return args[k].value.text; };
  return handle_of({text(0), std::string(vm::kCurveFilter), "", text(1), text(2), ""});
}

/// `intrinsic::image_fact(handle, name, otherwise)`: a real that the file states.
Value Elaborator::image_fact(const std::vector<BoundArgument>& args) {
  const auto handle = known_integer(args[0].value);
  if (!handle) return unknown_value(kReal);
  const std::string& name = args[1].value.text;
  const auto fact = *handle < 0 ? vm::magenta()->number(name)
                                : module.images[std::size_t(*handle)].image->number(name);
  return fact ? scalar(kReal, real(*fact)) : args[2].value;
}

/// Tells of every image that could not be read, and of all places that name it, whatever they want
/// of it.
void Elaborator::report_images() {
  const bool refused = options_.missing_images == MissingImages::Refuse;
  for (auto m = missing_images_.begin(); m != missing_images_.end(); ++m) {
    const auto same = [&](const MissingImage& o) {
      return o.use.file == m->use.file && o.error.what == m->error.what;
    };
    if (std::any_of(missing_images_.begin(), m, same)) continue;
    std::vector<Span> places;
    for (auto other = m; other != missing_images_.end(); ++other)
      if (same(*other)) places.insert(places.end(), other->places.begin(), other->places.end());
    const auto order = [](const Span& s) {
      return std::pair(s.source ? s.source->name : "", s.begin);
    };
    std::stable_sort(places.begin(), places.end(),
                     [&](const Span& a, const Span& b) { return order(a) < order(b); });
    const auto end = std::unique(places.begin(), places.end(), [&](const Span& a, const Span& b) {
      return order(a) == order(b);
    });
    const bool curve = m->use.filter == vm::kCurveFilter;
    const char* const form = curve ? "table" : "image";
    Diagnostic& d =
        refused ? diagnostics_.add(Diag::NoImage, places[0], form, m->use.file, m->error.what)
                : diagnostics_.add(Diag::ImageReplaced, places[0], form, m->use.file, m->error.what,
                                   curve ? "1" : "magenta");
    for (auto place = places.begin() + 1; place != end; ++place) d.note(*place, "and here");
    if (!m->error.hint.empty()) d.help(m->error.hint);
  }
}

}  // namespace mms::lang
