// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Text to tokens. Reports what is no token; never fails, never looks back, linear in the text.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics.h"
#include "lang/token.h"

namespace mms::lang {

class Lexer {
 public:
  /// Borrows both; `source` is at most limits::kSourceBytes long. Reads [begin, end) of it.
  Lexer(const Source& source, Diagnostics& diagnostics, std::uint32_t begin = 0,
        std::uint32_t end = UINT32_MAX);

  /// The next token; Eof for ever after the last one.
  Token next();

  /// Comments met so far, in order.
  const std::vector<Comment>& comments() const { return comments_; }

 private:
  char at(std::size_t ahead = 0) const {
    return pos_ + ahead < text_.size() ? text_[pos_ + ahead] : '\0';
  }
  bool done() const { return pos_ >= text_.size(); }
  Span span(std::size_t begin, std::size_t end) const;
  Token token(Tok tok, std::size_t begin) const;

  bool skip_comment();
  void skip_space();
  void check_text(std::size_t begin, std::size_t end);

  Token word();
  Token variable();
  Token number();
  Token unit(std::size_t begin, bool real, bool bad);
  Token hexadecimal();
  Token string(char quote);
  Token symbol();
  Token stray();

  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::vector<Comment> comments_;
  std::size_t pos_ = 0;
  bool open_comment_ = false;
  std::uint32_t count_ = 0;  // tokens given out
};

/// The number that a literal's text states, unit applied: nm um mm cm m km in metres, deg and rad
/// in radians, K in kelvin, `i` taken off. Infinite if it is too large for a double.
double real_value(std::string_view literal);
/// The value of an integer literal; -1 if it is too large for 64 bits.
std::int64_t integer_value(std::string_view literal);
/// The text of a string literal, quotes taken off and escapes applied.
std::string string_value(std::string_view literal);
/// The text of a `///` comment.
std::string_view doc_text(std::string_view comment);

}  // namespace mms::lang
