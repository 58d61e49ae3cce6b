// SPDX-License-Identifier: Apache-2.0
// Reading the directives of a golden script.
#include "tests/golden/expectations.h"

#include <cstdlib>

namespace mms::golden {
namespace {

std::string trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r'))
    s.remove_suffix(1);
  return std::string(s);
}

std::uint32_t characters(std::string_view s) {
  std::uint32_t n = 0;
  for (char c : s) n += (c & 0xC0) != 0x80;
  return n;
}

/// Takes the first word off `s`.
std::string word(std::string& s) {
  s = trimmed(s);
  const std::size_t end = std::min(s.find(' '), s.size());
  std::string w = s.substr(0, end);
  s = trimmed(std::string_view(s).substr(end));
  return w;
}

/// `error E0203: text` after the columns; false if it is no message.
bool read_message(std::string rest, ExpectedMessage& m) {
  const std::string severity = word(rest);
  if (severity != "error" && severity != "warning") return false;
  m.code = rest.substr(0, 5);
  if (m.code.size() != 5 || m.code[0] != (severity == "error" ? 'E' : 'W')) return false;
  if (rest.size() > 5 && rest[5] != ':') return false;
  if (rest.size() > 5) m.text = trimmed(std::string_view(rest).substr(6));
  return true;
}

bool is_pointer(std::string_view comment, char& mark) {
  const std::string t = trimmed(comment);
  mark = t.empty() ? ' ' : t[0];
  if (mark != '^' && mark != 'v') return false;
  const std::size_t end = t.find_first_not_of(mark);
  return end != t.npos && t[end] == ' ' &&
         (t.compare(end + 1, 5, "error") == 0 || t.compare(end + 1, 7, "warning") == 0);
}

bool read_output(std::string rest, ExpectedOutput& o, bool value) {
  if (value) {
    const std::size_t equals = rest.rfind(" = ");
    if (equals == rest.npos) return false;
    o.value = trimmed(std::string_view(rest).substr(equals + 3));
    rest.resize(equals);
  }
  o.form = word(rest);
  o.name = word(rest);
  o.output = word(rest);
  if (rest.empty()) return true;
  if (word(rest) != "at") return false;
  while (!rest.empty()) {
    const std::string setting = word(rest);
    const std::size_t equals = setting.find('=');
    if (equals == setting.npos) return false;
    o.at.emplace_back(setting.substr(0, equals), numbers_of(setting.substr(equals + 1)));
  }
  return true;
}

class Reader {
 public:
  explicit Reader(const lang::Source& s) : source_(s) {}

  Expectations read() {
    const std::uint32_t lines = static_cast<std::uint32_t>(source_.line_starts.size());
    for (std::uint32_t n = 1; n <= lines; ++n) line(n, lang::line_text(source_, n));
    return std::move(e_);
  }

 private:
  bool pointer_line(std::uint32_t n) const {
    const std::string_view text = lang::line_text(source_, n);
    const std::size_t slashes = text.find("//");
    char mark;
    return slashes != text.npos && trimmed(text.substr(0, slashes)).empty() &&
           is_pointer(text.substr(slashes + 2), mark);
  }

  void line(std::uint32_t n, std::string_view text) {
    for (std::size_t at = text.find("//"); at != text.npos; at = text.find("//", at + 2)) {
      if (at + 2 < text.size() && text[at + 2] == '/') return;
      const std::string comment = trimmed(text.substr(at + 2));
      if (n == 1 && comment.starts_with("known-issue:")) e_.known_issue = comment.substr(12);
      if (pointer_line(n)) return pointer(n, text, at);
      if (directive(n, comment)) return;
    }
  }

  void pointer(std::uint32_t n, std::string_view text, std::size_t slashes) {
    char mark;
    is_pointer(text.substr(slashes + 2), mark);
    const std::size_t begin = text.find(mark, slashes), end = text.find_first_not_of(mark, begin);
    ExpectedMessage m;
    if (!read_message(trimmed(text.substr(end)), m)) return malformed(n);
    m.column = characters(text.substr(0, begin)) + 1;
    m.length = static_cast<std::uint32_t>(end - begin);
    m.line = n;
    while (pointer_line(m.line)) m.line += mark == '^' ? -1 : 1;
    e_.messages.push_back(std::move(m));
  }

  /// True if the comment is a directive.
  bool directive(std::uint32_t n, const std::string& comment) {
    const std::size_t colon = comment.find(':');
    const std::string key = comment.substr(0, colon);
    const std::string rest = colon == comment.npos ? "" : trimmed(comment.substr(colon + 1));
    ExpectedMessage m;
    if (read_message(comment, m)) {
      e_.messages.push_back(m);
    } else if (colon == comment.npos) {
      return false;
    } else if (key == "expect") {
      e_.values.push_back({n, rest, 1e-6});
    } else if (key.starts_with("expect~")) {
      e_.values.push_back({n, rest, std::strtod(key.c_str() + 7, nullptr)});
    } else if (key == "fault") {
      std::string r = rest;
      ExpectedFault f{n, word(r), 0};
      if (word(r) != "line") malformed(n);
      f.at = static_cast<std::uint32_t>(std::strtoul(r.c_str(), nullptr, 10));
      e_.faults.push_back(std::move(f));
    } else if (key == "expect-output" || key == "expect-info" || key == "check-gradient") {
      ExpectedOutput o;
      if (!read_output(rest, o, key != "check-gradient")) malformed(n);
      (key == "expect-output" ? e_.outputs
       : key == "expect-info" ? e_.infos
                              : e_.gradients)
          .push_back(std::move(o));
    } else if (key == "param") {
      const std::size_t equals = rest.find('=');
      if (equals == rest.npos)
        malformed(n);
      else
        e_.params.emplace_back(rest.substr(0, equals), rest.substr(equals + 1));
    } else if (key == "near") {
      e_.near = std::strtod(rest.c_str(), nullptr);
    } else {
      return false;
    }
    return true;
  }

  void malformed(std::uint32_t n) {
    e_.malformed.push_back(fmt::format("line {}: a directive that cannot be read", n));
  }

  const lang::Source& source_;
  Expectations e_;
};

}  // namespace

std::vector<double> numbers_of(const std::string& text) {
  std::string flat = text;
  for (char& c : flat)
    if (std::string_view("[](),;").find(c) != std::string_view::npos) c = ' ';
  std::vector<double> all;
  while (!(flat = trimmed(flat)).empty()) {
    const std::string w = word(flat);
    char* end = nullptr;
    const double v = std::strtod(w.c_str(), &end);
    if (w == "true" || w == "false")
      all.push_back(w == "true");
    else if (*end == 0)
      all.push_back(v);
    else
      return {};
  }
  return all;
}

Expectations read_expectations(const lang::Source& source) { return Reader(source).read(); }

}  // namespace mms::golden
