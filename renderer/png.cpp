// SPDX-License-Identifier: Apache-2.0
#include "renderer/png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <new>
#include <vector>

namespace mms::renderer {
namespace {

/// What libpng is given to write to, and to complain to.
struct Target {
  std::string bytes, complaint;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  bool enough = true;
  try {
    static_cast<Target*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<char*>(data), size);
  } catch (const std::bad_alloc&) {
    enough = false;  // exceptions are not to pass through C
  }
  if (!enough) png_error(png, "out of memory");
}

void flush(png_structp) {}

[[noreturn]] void complain(png_structp png, png_const_charp why) {
  static_cast<Target*>(png_get_error_ptr(png))->complaint = why;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

/// Texts are Latin by default, UTF-8 where they are marked.
png_text text_of(const std::pair<std::string, std::string>& entry) {
  const auto plain = [](unsigned char c) { return c < 0x80; };
  png_text t{};
  t.compression = std::ranges::all_of(entry.second, plain) ? PNG_TEXT_COMPRESSION_NONE
                                                           : PNG_ITXT_COMPRESSION_NONE;
  t.key = const_cast<char*>(entry.first.c_str());
  t.text = const_cast<char*>(entry.second.c_str());
  return t;
}

/// False where libpng jumped back.
bool encode(png_structp png, png_infop info, png_uint_32 width, png_uint_32 height,
            const std::vector<png_text>& texts, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(png, info, texts.data(), int(texts.size()));
  png_set_rows(png, info, rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

}  // namespace

Result<std::string> png(int width, int height, std::span<const unsigned char> pixels,
                        const Metadata& metadata) {
  Target target;
  std::vector<png_text> texts;
  for (const auto& entry : metadata) texts.push_back(text_of(entry));
  std::vector<png_bytep> rows;
  for (int y = 0; y < height; ++y)
    rows.push_back(const_cast<png_bytep>(&pixels[std::size_t(y) * std::size_t(width) * 3]));
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, &target, complain, ignore);
  png_infop info = writer ? png_create_info_struct(writer) : nullptr;
  bool done = false;
  if (info) {
    png_set_write_fn(writer, &target, append, flush);
    done = encode(writer, info, png_uint_32(width), png_uint_32(height), texts, rows);
  }
  png_destroy_write_struct(&writer, &info);
  if (done) return std::move(target.bytes);
  return Error{"", "cannot make the picture: " + target.complaint, ""};
}

}  // namespace mms::renderer
