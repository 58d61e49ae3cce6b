// SPDX-License-Identifier: Apache-2.0
#include "lang/lexer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>
#include <numbers>
#include <span>

#include "lang/utf8.h"

namespace mms::lang {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word(char c) { return is_word_start(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

struct Spelled {
  Tok tok;
  std::string_view text;
};
constexpr Spelled kSymbols[] = {
#define SYMBOL(name, text) {Tok::name, text},
#include "lang/tokens.def"
};
constexpr Spelled kKeywords[] = {
#define KEYWORD(name, text) {Tok::Kw##name, text},
#include "lang/tokens.def"
};

// A table by first character, in which the order of those that share it stays.
template <std::size_t n>
struct ByFirstCharacter {
  std::array<Spelled, n> rows{};
  std::array<std::uint8_t, 129> first{};  // of each ASCII character; the last is the end

  constexpr explicit ByFirstCharacter(const Spelled (&table)[n]) {
    std::size_t k = 0;
    for (std::size_t c = 0; c < 128; ++c) {
      first[c] = static_cast<std::uint8_t>(k);
      for (const Spelled& s : table)
        if (s.text[0] == static_cast<char>(c)) rows[k++] = s;
    }
    first[128] = static_cast<std::uint8_t>(k);
  }
  constexpr std::span<const Spelled> starting_with(char c) const {
    const auto at = static_cast<unsigned char>(c);
    if (at >= 128) return {};
    return std::span(rows).subspan(first[at], first[at + 1] - first[at]);
  }
};
constexpr ByFirstCharacter<std::size(kSymbols)> kSymbolsByFirst(kSymbols);
constexpr ByFirstCharacter<std::size(kKeywords)> kKeywordsByFirst(kKeywords);

// A literal is `number * multiply / divide`. Powers of ten divide, because 10^9 is a double and
// 10^-9 is not: so `550nm` is the double nearest to 5.5e-7.
struct Unit {
  std::string_view text;
  double multiply, divide;
};
constexpr Unit kUnits[] = {
    {"i", 1, 1},    {"nm", 1, 1e9}, {"um", 1, 1e6}, {"mm", 1, 1e3},
    {"cm", 1, 100}, {"m", 1, 1},    {"km", 1e3, 1}, {"deg", std::numbers::pi / 180, 1},
    {"rad", 1, 1},  {"K", 1, 1},
};

const Unit* find_unit(std::string_view text) {
  for (const Unit& u : kUnits)
    if (u.text == text) return &u;
  return nullptr;
}

// Signs of typography that people paste, and what they mean here.
struct LookAlike {
  char32_t value;
  std::string_view meant;
};
constexpr LookAlike kLookAlikes[] = {
    {0x2212, "-"},  {0x2013, "-"},  {0x00D7, "*"},  {0x00B7, "*"},   {0x22C5, "*"},
    {0x00F7, "/"},  {0x2264, "<="}, {0x2265, ">="}, {0x2260, "!="},  {0x201C, "\""},
    {0x201D, "\""}, {'&', "and"},   {'|', "or"},    {0x00B0, "deg"}, {0x2192, "->"},
};

std::string shown(char32_t c, std::string_view bytes) {
  if (c > 0x20 && c != 0x7F && !(c >= 0x80 && c < 0xA0)) return fmt::format("`{}`", bytes);
  return fmt::format("U+{:04X}", static_cast<std::uint32_t>(c));
}

}  // namespace

std::string_view spelling(Tok tok) {
  for (const Spelled& s : kSymbols)
    if (s.tok == tok) return s.text;
  for (const Spelled& s : kKeywords)
    if (s.tok == tok) return s.text;
  return {};
}

bool is_keyword(Tok tok) { return tok >= kKeywords[0].tok; }

Tok keyword(std::string_view word) {
  for (const Spelled& s : kKeywordsByFirst.starting_with(word[0]))
    if (s.text == word) return s.tok;
  return Tok::Identifier;
}

Lexer::Lexer(const Source& source, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end)
    : source_(source), text_(source.text.substr(0, end)), diagnostics_(diagnostics), pos_(begin) {
  if (begin == 0 && text_.starts_with("\xEF\xBB\xBF")) pos_ = 3;  // a byte-order mark says nothing
}

Span Lexer::span(std::size_t begin, std::size_t end) const {
  return {&source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

Token Lexer::token(Tok tok, std::size_t begin) const {
  return {tok, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(pos_)};
}

Token Lexer::next() {
  skip_space();
  ++count_;
  if (done() && open_comment_) {
    open_comment_ = false;  // reported: what is missing after it is not
    return token(Tok::Error, pos_);
  }
  if (done()) return token(Tok::Eof, pos_);
  const char c = at();
  if (is_word_start(c)) return word();
  if (is_digit(c) || (c == '.' && is_digit(at(1)))) return number();
  if (c == '"' || c == '\'') return string(c);
  if (c == '$') return variable();
  return symbol();
}

void Lexer::skip_space() {
  while (!done() && (is_space(at()) || skip_comment()))
    if (is_space(at())) ++pos_;
}

bool Lexer::skip_comment() {
  if (at() != '/' || (at(1) != '/' && at(1) != '*')) return false;
  const std::size_t begin = pos_;
  Comment::Form form = Comment::Form::Block;
  if (at(1) == '/') {
    const bool doc = at(2) == '/' && at(3) != '/';
    form = doc ? Comment::Form::Doc : Comment::Form::Line;
    pos_ = std::min(text_.find('\n', pos_), text_.size());
  } else {
    const std::size_t close = text_.find("*/", pos_ + 2);
    pos_ = close == std::string_view::npos ? text_.size() : close + 2;
    open_comment_ = close == std::string_view::npos;
    if (open_comment_)
      diagnostics_.add(Diag::UnterminatedComment, span(begin, begin + 2))
          .labelled("this has no `*/`");
  }
  std::size_t end = pos_;
  if (form != Comment::Form::Block && text_[end - 1] == '\r') --end;
  check_text(begin, end);
  comments_.push_back(
      {form, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), count_});
  return true;
}

// Comments and strings may hold any character, but only characters: each run of bytes that are
// none is reported once.
void Lexer::check_text(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end;) {
    const Character c = character_at(text_, i);
    if (c.valid && c.value != 0) {
      i += c.length;
      continue;
    }
    const std::size_t first = i;
    if (c.valid) {
      while (i < end && text_[i] == '\0') ++i;
      diagnostics_.add(Diag::NulByte, span(first, i));
    } else {
      while (i < end && !character_at(text_, i).valid) ++i;
      diagnostics_.add(Diag::InvalidUtf8, span(first, i));
    }
  }
}

Token Lexer::word() {
  const std::size_t begin = pos_;
  bool reported = false;
  for (; !done(); ++pos_) {
    if (is_word(at())) continue;
    const Character c = character_at(text_, pos_);
    if (!c.valid || c.value < 0xC0 || (c.value >= 0x2000 && c.value < 0x3000)) break;
    if (!reported)
      diagnostics_
          .add(Diag::UnexpectedCharacter, span(pos_, pos_ + c.length),
               shown(c.value, text_.substr(pos_, c.length)))
          .help("names are made of the letters a-z and A-Z, digits and `_`");
    reported = true;
    pos_ += c.length - 1;
  }
  return token(keyword(text_.substr(begin, pos_ - begin)), begin);
}

Token Lexer::variable() {
  const std::size_t begin = pos_++;
  if (!is_word_start(at())) {
    diagnostics_.add(Diag::VariableName, span(begin, pos_));
    return token(Tok::Error, begin);
  }
  while (is_word(at())) ++pos_;
  return token(Tok::Variable, begin);
}

Token Lexer::number() {
  const std::size_t begin = pos_;
  if (at() == '0' && (at(1) == 'x' || at(1) == 'X') && std::isxdigit(at(2))) return hexadecimal();
  while (is_digit(at())) ++pos_;
  bool real = false, bad = begin == pos_;
  if (at() == '.') {
    real = true;
    ++pos_;
    bad = bad || !is_digit(at());
    while (is_digit(at())) ++pos_;
    for (; at() == '.'; bad = true)  // `1.2.3`, `1..2`
      for (++pos_; is_digit(at());) ++pos_;
  }
  if (bad)
    diagnostics_.add(Diag::NumberPoint, span(begin, pos_))
        .help("write `0.5` for `.5`, and `5.0` for `5.`");
  if (at() == 'e' || at() == 'E') {
    const bool sign = at(1) == '+' || at(1) == '-';
    if (is_digit(at(sign ? 2 : 1))) {
      real = true;
      for (pos_ += sign ? 2 : 1; is_digit(at());) ++pos_;
    } else if (sign) {
      pos_ += 2;
      if (!bad) diagnostics_.add(Diag::NumberExponent, span(begin, pos_));
      return token(Tok::Error, begin);
    }
  }
  return unit(begin, real, bad);
}

// What is glued to the number: nothing, a unit, or a mistake.
Token Lexer::unit(std::size_t begin, bool real, bool bad) {
  const std::size_t suffix = pos_;
  while (is_word(at())) ++pos_;
  const std::string_view name = text_.substr(suffix, pos_ - suffix);
  // `a.5`: the one message is enough.
  const bool glued =
      begin > 0 && text_[begin] == '.' &&
      (is_word(text_[begin - 1]) || text_[begin - 1] == ')' || text_[begin - 1] == ']');
  if (glued) return token(Tok::Error, begin);
  if (name.empty()) return token(real ? Tok::RealLiteral : Tok::IntegerLiteral, begin);
  if (!find_unit(name)) {
    if (!bad) {
      const std::string_view factor = text_.substr(begin, suffix - begin);
      Diagnostic& d = diagnostics_.add(Diag::GluedNumber, span(suffix, pos_), name.substr(0, 40));
      if (name.size() + factor.size() < 40)
        d.help(fmt::format("for a product write `{} * {}`", factor, name));
      d.help("the units are i nm um mm cm m km deg rad K");
    }
    return token(Tok::Error, begin);
  }
  return token(name == "i" ? Tok::ImaginaryLiteral : Tok::RealLiteral, begin);
}

Token Lexer::hexadecimal() {
  const std::size_t begin = pos_;
  for (pos_ += 2; is_word(at());) ++pos_;
  Diagnostic& d = diagnostics_.add(Diag::HexNumber, span(begin, pos_));
  std::uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(text_.data() + begin + 2, text_.data() + pos_, value, 16);
  if (error == std::errc{} && end == text_.data() + pos_) d.help(fmt::format("write `{}`", value));
  return token(Tok::Error, begin);
}

Token Lexer::string(char quote) {
  const std::size_t begin = pos_++;
  while (!done() && at() != quote && at() != '\n') {
    if (at() == '\\' && pos_ + 1 < text_.size() && at(1) != '\n') {
      if (std::string_view("\"\\nt").find(at(1)) == std::string_view::npos && quote == '"') {
        const std::uint32_t length = character_at(text_, pos_ + 1).length;
        diagnostics_.add(Diag::UnknownEscape, span(pos_, pos_ + 1 + length))
            .help("the escapes are \\\" \\\\ \\n \\t");
      }
      ++pos_;
    }
    ++pos_;
  }
  check_text(begin, pos_);
  if (at() != quote || done()) {
    if (at(0) == '\n' && text_[pos_ - 1] == '\r') --pos_;
    diagnostics_.add(Diag::UnterminatedString, span(begin, begin + 1))
        .labelled("this has no closing quote on its line");
    return token(Tok::Error, begin);
  }
  ++pos_;
  if (quote == '\'')
    diagnostics_.add(Diag::SingleQuotes, span(begin, pos_)).help("use double quotes");
  return token(Tok::StringLiteral, begin);
}

Token Lexer::symbol() {
  const std::size_t begin = pos_;
  for (const Spelled& s : kSymbolsByFirst.starting_with(at())) {
    if (!text_.substr(pos_).starts_with(s.text)) continue;
    pos_ += s.text.size();
    return token(s.tok, begin);
  }
  return stray();
}

// A run of characters that begin no token: one message, at the first of them.
Token Lexer::stray() {
  const std::size_t begin = pos_;
  const Character first = character_at(text_, pos_);
  const auto same = [&] {
    const Character c = character_at(text_, pos_);
    if (!first.valid || !c.valid || first.value == 0 || c.value == 0)
      return c.valid == first.valid && c.value == first.value;
    return c.value >= 0x80 ? first.value >= 0x80 : c.value == first.value;
  };
  while (!done() && same()) pos_ += character_at(text_, pos_).length;
  if (!first.valid) {
    diagnostics_.add(Diag::InvalidUtf8, span(begin, pos_)).help("save the file as UTF-8");
  } else if (first.value == 0) {
    diagnostics_.add(Diag::NulByte, span(begin, pos_));
  } else {
    Diagnostic& d = diagnostics_.add(Diag::UnexpectedCharacter, span(begin, pos_),
                                     shown(first.value, text_.substr(begin, first.length)));
    for (const LookAlike& l : kLookAlikes)
      if (l.value == first.value) d.help(fmt::format("write `{}`", l.meant));
  }
  return token(Tok::Error, begin);
}

double real_value(std::string_view literal) {
  double value = 0;
  const char* const last = literal.data() + literal.size();
  const auto [end, error] = std::from_chars(literal.data(), last, value);
  if (error == std::errc::result_out_of_range) {
    // Too small is zero; too large is infinite. Without a negative exponent only digits after a
    // zero can make it too small.
    const std::size_t e = literal.find_first_of("eE");
    const bool small = e != std::string_view::npos && literal.substr(e + 1).starts_with('-');
    value = small || literal.starts_with("0.") ? 0 : std::numeric_limits<double>::infinity();
  }
  const Unit* const u = find_unit({end, static_cast<std::size_t>(last - end)});
  return u ? value * u->multiply / u->divide : value;
}

std::int64_t integer_value(std::string_view literal) {
  std::int64_t value = 0;
  const auto result = std::from_chars(literal.data(), literal.data() + literal.size(), value);
  return result.ec == std::errc{} ? value : -1;
}

std::string string_value(std::string_view literal) {
  std::string text;
  if (literal.size() < 2) return text;
  for (std::size_t i = 1; i + 1 < literal.size(); ++i) {
    char c = literal[i];
    if (c == '\\' && i + 2 < literal.size()) {
      c = literal[++i];
      c = c == 'n' ? '\n' : c == 't' ? '\t' : c;
    }
    text += c;
  }
  return text;
}

std::string_view doc_text(std::string_view comment) {
  comment.remove_prefix(std::min<std::size_t>(3, comment.size()));
  if (comment.starts_with(' ')) comment.remove_prefix(1);
  while (!comment.empty() && is_space(comment.back())) comment.remove_suffix(1);
  return comment;
}

}  // namespace mms::lang
