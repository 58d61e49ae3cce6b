// SPDX-License-Identifier: Apache-2.0
#include "lang/source.h"

#include <algorithm>

#include "lang/utf8.h"

namespace mms::lang {
namespace {

std::vector<std::uint32_t> index_lines(std::string_view text) {
  std::vector<std::uint32_t> starts{0};
  starts.reserve(text.size() / 32);  // as ordinary text has
  for (std::size_t i = text.find('\n'); i != std::string_view::npos; i = text.find('\n', i + 1))
    starts.push_back(static_cast<std::uint32_t>(i + 1));
  return starts;
}

}  // namespace

SourcePtr borrow_source(std::string name, std::string_view text) {
  return std::make_shared<Source>(Source{std::move(name), text, {}, index_lines(text)});
}

SourcePtr make_source(std::string name, std::string text) {
  auto source = std::make_shared<Source>();
  source->name = std::move(name);
  source->own = std::move(text);
  source->text = source->own;
  source->line_starts = index_lines(source->text);
  return source;
}

std::uint32_t line_at(const Source& source, std::uint32_t offset) {
  const auto next = std::upper_bound(source.line_starts.begin(), source.line_starts.end(), offset);
  return static_cast<std::uint32_t>(next - source.line_starts.begin());
}

std::uint32_t byte_column(const Source& source, std::uint32_t offset, std::uint32_t line) {
  return offset - source.line_starts[line - 1] + 1;
}

Position position_at(const Source& source, std::uint32_t offset) {
  offset = std::min(offset, static_cast<std::uint32_t>(source.text.size()));
  const auto next = std::upper_bound(source.line_starts.begin(), source.line_starts.end(), offset);
  Position at{static_cast<std::uint32_t>(next - source.line_starts.begin()), 1};
  for (std::uint32_t i = *(next - 1); i < offset; ++at.column)
    i += character_at(source.text, i).length;
  return at;
}

std::string_view line_text(const Source& source, std::uint32_t line) {
  if (line == 0 || line > source.line_starts.size()) return {};
  const std::size_t begin = source.line_starts[line - 1];
  std::string_view text = source.text.substr(begin);
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

}  // namespace mms::lang
