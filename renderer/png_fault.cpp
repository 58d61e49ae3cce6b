// SPDX-License-Identifier: Apache-2.0
#include "renderer/png_fault.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <vector>

namespace mms::renderer {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);

/// Of `bytes` behind what has the checksum `c`.
std::uint32_t checksum(std::uint32_t c, std::string_view bytes) {
  return std::uint32_t(crc32(c, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

std::uint32_t number(const char* bytes) {
  std::uint32_t n = 0;
  for (int i = 0; i < 4; ++i) n = n << 8 | static_cast<unsigned char>(bytes[i]);
  return n;
}

}  // namespace

std::string png_fault(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  char head[8];  // length and name of a chunk
  if (!in.read(head, 8) || std::string_view(head, 8) != kSignature) return "";
  std::vector<char> piece(1 << 16);
  for (;;) {
    if (!in.read(head, 8)) return "it is cut off between its chunks";
    const std::string_view name(head + 4, 4);
    const bool word = std::ranges::all_of(name, [](unsigned char c) { return std::isalpha(c); });
    const std::string called = word ? "its chunk `" + std::string(name) + "`" : "a chunk of it";
    std::uint32_t sum = checksum(0, name);
    for (std::uint32_t left = number(head); left > 0;) {
      const std::uint32_t count = std::min(left, std::uint32_t(piece.size()));
      if (!in.read(piece.data(), count)) return "it is cut off within " + called;
      sum = checksum(sum, {piece.data(), count});
      left -= count;
    }
    char stated[4];
    if (!in.read(stated, 4)) return "it is cut off within " + called;
    if (number(stated) != sum) return called + " is damaged";
    if (name == "IEND") return "";
  }
}

}  // namespace mms::renderer
