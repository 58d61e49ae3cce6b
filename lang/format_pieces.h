// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the formatter works on: tokens and comments in one row, and the blocks they stand in.
/// Internal to lang/format*.

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/ast.h"
#include "lang/token.h"

namespace mms::lang {

inline constexpr std::size_t kNone = SIZE_MAX;

/// A token, or a comment (then `tok` is Eof).
struct Piece {
  Tok tok = Tok::Eof;
  std::string_view text;
  int width = 0;     ///< columns
  int newlines = 0;  ///< line breaks before it in the source
  bool comment = false;
  bool ends_line = false;  ///< a comment that reaches to the end of its line

  std::size_t block = 0;       ///< where it stands; of a closing token, the block it closes
  std::size_t assign = kNone;  ///< of the first token of an assignment in a body: its `=`
  bool starts = false;         ///< a statement (an arm, a field) begins here
  bool closes = false;   ///< its block ends with it, and it is indented like the block's opener
  bool operand = false;  ///< a value ends here, so a `-` after it is binary
  bool unary = false;    ///< a `-` that is
};

/// Something that is indented: from the token that opens it to the one that closes it.
struct Block {
  enum class Form : std::uint8_t { Bracket, Select, Struct, Body };
  Form form = Form::Body;
  std::size_t parent = kNone;
  std::size_t opener = kNone, closer = kNone;  ///< pieces; the whole text has neither
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<Block> blocks;  ///< the first is the whole text
};

/// \pre `graph` was parsed without errors, and outlives the pieces.
Pieces pieces_of(const Graph& graph);

/// Whether a space stands between two pieces of a line, `before` being what `a` follows.
bool space_between(const Piece* before, const Piece& a, const Piece& b);

/// Whether a line may be broken before `b`, which follows `a`, and how little that is liked:
/// -1 is not at all.
int break_penalty(const Pieces& all, std::size_t a, std::size_t b);

}  // namespace mms::lang
