// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Source text and places in it.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mms::lang {

/// One file or string of source. Immutable once parsed; graphs and diagnostics share it.
struct Source {
  std::string name;  ///< as the user wrote it; `<string>` for text without a file
  std::string_view text;
  std::string own;                         ///< what `text` is a view of, unless it was borrowed
  std::vector<std::uint32_t> line_starts;  ///< byte offset of each line, from `index_lines`
};
using SourcePtr = std::shared_ptr<const Source>;

SourcePtr make_source(std::string name, std::string text);
/// Of a text that outlives everything that is made of the source.
SourcePtr borrow_source(std::string name, std::string_view text);

/// 1-based line, and 1-based column in characters (UTF-8 sequences count once).
struct Position {
  std::uint32_t line = 0, column = 0;
};
Position position_at(const Source& source, std::uint32_t offset);
/// Only the line of `offset`, which is faster.
std::uint32_t line_at(const Source& source, std::uint32_t offset);
/// 1-based column in bytes.
std::uint32_t byte_column(const Source& source, std::uint32_t offset, std::uint32_t line);
/// The text of a 1-based line, without its end.
std::string_view line_text(const Source& source, std::uint32_t line);

/// Bytes [begin, end) of a source. A default span is nowhere.
struct Span {
  const Source* source = nullptr;  ///< kept alive by the Graph
  std::uint32_t begin = 0, end = 0;
  explicit operator bool() const { return source != nullptr; }
  friend bool operator==(const Span&, const Span&) = default;
};

/// What a span that is somewhere holds.
inline std::string_view text_of(Span span) {
  return span.source->text.substr(span.begin, span.end - span.begin);
}

/// From the start of `a` to the end of `b`, which is in the same source.
inline Span join(Span a, Span b) { return {a.source, a.begin, b.end}; }

}  // namespace mms::lang
