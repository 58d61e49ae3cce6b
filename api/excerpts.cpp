// SPDX-License-Identifier: Apache-2.0
#include "api/excerpts.h"

#include <algorithm>

#include "api/library.h"

namespace mms::api {

namespace {

std::string trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r");
  if (first == s.npos) return "";
  return std::string(s.substr(first, s.find_last_not_of(" \t\r") + 1 - first));
}

/// Bytes of the first `count` characters.
std::size_t bytes_of(std::string_view s, std::size_t count) {
  std::size_t at = 0;
  for (; count > 0 && at < s.size(); --count) do
      ++at;
    while (at < s.size() && (static_cast<unsigned char>(s[at]) & 0xc0) == 0x80);
  return at;
}

}  // namespace

Excerpts::Excerpts(const vm::Program& program, std::vector<lang::SourcePtr> sources)
    : program_(program) {
  for (lang::SourcePtr& s : sources) sources_[s->name] = std::move(s);
}

const lang::Source* Excerpts::source(std::uint32_t index) {
  if (index >= program_.sources.size()) return nullptr;
  const std::string& name = program_.sources[index];
  const auto known = sources_.find(name);
  if (known != sources_.end()) return known->second.get();
  lang::SourcePtr& s = sources_[name];
  for (const lang::Library::Module& m : standard_library().modules)
    if (name == "<" + std::string(m.name) + ">") s = lang::make_source(name, std::string(m.text));
  for (const lang::Library::Script& m : standard_library().scripts)
    if (name == "<" + std::string(m.name) + ">") s = lang::make_source(name, std::string(m.text));
  if (!s && !name.starts_with('<'))
    if (const auto file = read_source(name)) s = *file;
  return s.get();
}

std::string Excerpts::line(vm::SourceLine at) {
  const lang::Source* s = source(at.source);
  if (!s || at.line == 0 || at.line > s->line_starts.size()) return "";
  return trimmed(lang::line_text(*s, at.line));
}

std::string Excerpts::from_column(vm::SourceLine at, std::size_t length) {
  const lang::Source* s = source(at.source);
  if (!s || at.line == 0 || at.line > s->line_starts.size()) return "";
  std::string_view text = lang::line_text(*s, at.line);
  if (at.column > 1) text.remove_prefix(std::min<std::size_t>(at.column - 1, text.size()));
  const std::string all = trimmed(text);
  const std::size_t end = bytes_of(all, length);
  return end < all.size() ? all.substr(0, end) + "..." : all;
}

}  // namespace mms::api
