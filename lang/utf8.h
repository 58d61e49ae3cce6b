// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// UTF-8, one character at a time.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mms::lang {

inline constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  ///< U+FFFD

struct Character {
  char32_t value = 0;
  std::uint32_t length = 1;  ///< bytes; 1 for a byte that is not valid UTF-8
  bool valid = true;
};

/// The character at byte `i`, which is inside `text`. Overlong forms, surrogates and values past
/// U+10FFFF are not valid (Unicode 15, table 3-7).
inline Character character_at(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) -> std::uint32_t {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0;
  };
  const std::uint32_t lead = byte(i);
  if (lead < 0x80) return {lead, 1, true};
  const std::uint32_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  std::uint32_t value = lead & (0xFFu >> (length + 1));
  if (lead < 0xC2 || lead > 0xF4) return {0xFFFD, 1, false};
  for (std::uint32_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return {0xFFFD, 1, false};
    value = value << 6 | (byte(i + k) & 0x3F);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xD800 && value < 0xE000;
  if (value < kSmallest[length] || surrogate || value > 0x10FFFF) return {0xFFFD, 1, false};
  return {value, length, true};
}

}  // namespace mms::lang
