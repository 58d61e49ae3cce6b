// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Writes plain TIFF files (revision 6.0, one strip, little-endian) of 8-bit or float numbers, so
/// that what reads pictures is not tested with what it writes itself.

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace mms::renderer::testing {

/// A picture in memory, row 0 on top as in files.
struct Texels {
  int width, height, channels;
  std::vector<float> values;
  float at(int x, int y, int c) const {
    return values[std::size_t((y * width + x) * channels + c)];
  }
};

enum class TiffNumbers : std::uint8_t { Float, Byte };

/// Four channels are red, green, blue and coverage. The file states an `XResolution` of 2.5.
inline void write_tiff(const std::string& path, const Texels& t, TiffNumbers numbers) {
  std::string file;
  const auto put16 = [&](std::uint32_t v) {
    file += char(v & 0xff);
    file += char(v >> 8 & 0xff);
  };
  const auto put32 = [&](std::uint32_t v) {
    put16(v & 0xffff);
    put16(v >> 16);
  };
  const bool bytes = numbers == TiffNumbers::Byte;
  const auto channels = std::uint32_t(t.channels);
  const std::uint32_t size = std::uint32_t(t.values.size()) * (bytes ? 1 : 4);
  const std::uint32_t entries = channels == 4 ? 14 : 13;
  const std::uint32_t lists = 8 + 2 + 12 * entries + 4;  // after the directory
  const std::uint32_t bits = lists, formats = bits + 8, resolution = formats + 8,
                      pixels = resolution + 8;
  file += "II";
  put16(42);
  put32(8);
  put16(entries);
  constexpr std::uint32_t kShort = 3, kLong = 4, kRational = 5;
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                         std::uint32_t value) {
    put16(tag);
    put16(type);
    put32(count);
    put32(value);
  };
  const auto per_channel = [&](std::uint32_t tag, std::uint32_t value, std::uint32_t at) {
    entry(tag, kShort, channels, channels > 2 ? at : value | value << 16);
  };
  entry(256, kLong, 1, std::uint32_t(t.width));
  entry(257, kLong, 1, std::uint32_t(t.height));
  per_channel(258, bytes ? 8 : 32, bits);
  entry(259, kShort, 1, 1);                      // not compressed
  entry(262, kShort, 1, channels >= 3 ? 2 : 1);  // RGB, or black is 0
  entry(273, kLong, 1, pixels);
  entry(277, kShort, 1, channels);
  entry(278, kLong, 1, std::uint32_t(t.height));
  entry(279, kLong, 1, size);
  entry(282, kRational, 1, resolution);
  entry(284, kShort, 1, 1);  // pixel by pixel
  entry(296, kShort, 1, 1);
  if (channels == 4) entry(338, kShort, 1, 2);  // coverage that multiplies nothing yet
  per_channel(339, bytes ? 1 : 3, formats);
  put32(0);
  for (int k = 0; k < 4; ++k) put16(bytes ? 8 : 32);
  for (int k = 0; k < 4; ++k) put16(bytes ? 1 : 3);
  put32(5);
  put32(2);
  for (const float v : t.values) {
    if (bytes)
      file += char(static_cast<unsigned char>(v * 255 + 0.5f));
    else
      put32(std::bit_cast<std::uint32_t>(v));
  }
  std::ofstream(path, std::ios::binary) << file;
}

}  // namespace mms::renderer::testing
