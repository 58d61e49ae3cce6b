// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Tokens: what the lexer makes of the text. A token is a form and its bytes; values are read from
/// the bytes when they are needed.

#include <cstdint>
#include <string_view>

namespace mms::lang {

enum class Tok : std::uint8_t {
  Eof,
  Error,  ///< stands where the lexer has already reported something
  Identifier,
  Variable,  ///< `$name`
  IntegerLiteral,
  RealLiteral,  ///< unit included
  ImaginaryLiteral,
  StringLiteral,
#define SYMBOL(name, text) name,
#define KEYWORD(name, text) Kw##name,
#include "lang/tokens.def"
};

struct Token {
  Tok tok = Tok::Eof;
  std::uint32_t begin = 0, end = 0;  ///< bytes of the source
};

/// A comment between tokens; the parser takes documentation from it, the formatter keeps it.
struct Comment {
  enum class Form : std::uint8_t { Line, Block, Doc };
  Form form = Form::Line;
  std::uint32_t begin = 0, end = 0;  ///< bytes, without the end of the line
  std::uint32_t before = 0;          ///< number of the token that follows
};

/// How a symbol or keyword is spelled; empty for the other tokens.
std::string_view spelling(Tok tok);
bool is_keyword(Tok tok);
/// The keyword that is spelled so, or Identifier. The word is not empty.
Tok keyword(std::string_view word);

}  // namespace mms::lang
