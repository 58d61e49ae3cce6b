// SPDX-License-Identifier: Apache-2.0
// Pictures that are written and read.
#include "renderer/picture.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "api/images.h"
#include "base/file.h"
#include "renderer/film_file.h"
#include "renderer/openimageio.h"
#include "renderer/png.h"

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

/// In one step.
Result<Done> put(const std::string& path, const Result<std::string>& bytes) {
  if (!bytes) return Error{path, bytes.error().what, bytes.error().hint};
  if (const auto error = replace_file(path, *bytes)) return *error;
  return Done{};
}

}  // namespace

Result<Done> check_writable(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".png" && extension != ".exr" && extension != kFilmExtension)
    return Error{path,
                 extension.empty() ? "the output has no extension"
                                   : fmt::format("unsupported image type `{}`", extension),
                 kSupported};
  if (const auto error = check_replaceable(path)) return *error;
  if (extension == ".exr")
    if (const auto io = open_image_io(path); !io) return io.error();
  return Done{};
}

Result<Done> write_png(const std::string& path, int width, int height,
                       std::span<const unsigned char> pixels, const Metadata& metadata) {
  if (const Result<Done> ok = check_writable(path); !ok) return ok;
  return put(path, png(width, height, pixels, metadata));
}

Result<Done> write_picture(const std::string& path, const Picture& picture, const View& view) {
  if (extension_of(path) == ".exr") {
    if (const Result<Done> ok = check_writable(path); !ok) return ok;  // so what writes it is there
    return put(path, (*open_image_io(path))->exr(picture));
  }
  const auto pixels = display_pixels(picture.film, view);
  if (!pixels) return pixels.error();
  return write_png(path, picture.film.width, picture.film.height, *pixels, picture.metadata);
}

Result<ReadPicture> read_picture(const std::string& path, const std::string& layer) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    return Error{path, "there is no such picture", "check the spelling and the folder you are in"};
  if (extension_of(path) == kFilmExtension)
    return Error{path, "is a film, exact sums, not a picture",
                 "make a picture of it: mms merge A.film -o A.exr"};
  const auto io = open_image_io(path);
  if (!io) return io.error();
  return (*io)->read(path, layer);
}

Result<const OpenImageIo*> open_image_io(const std::string& file) {
  static void* const entry = api::image_module("mms_open_image_io");
  if (!entry) return api::no_image_module(file);
  return reinterpret_cast<const OpenImageIo* (*)()>(entry)();
}

}  // namespace mms::renderer
