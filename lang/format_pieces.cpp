// SPDX-License-Identifier: Apache-2.0
#include "lang/format_pieces.h"

#include <algorithm>
#include <set>

#include "lang/lexer.h"

namespace mms::lang {
namespace {

bool is_basic_type(Tok t) {
  return t == Tok::KwLogic || t == Tok::KwInteger || t == Tok::KwReal || t == Tok::KwComplex ||
         t == Tok::KwSpectrum || t == Tok::KwMaterial || t == Tok::KwString;
}

bool is_operator(Tok t) {
  switch (t) {
    case Tok::Plus:
    case Tok::Minus:
    case Tok::Star:
    case Tok::Slash:
    case Tok::Percent:
    case Tok::Equal:
    case Tok::NotEqual:
    case Tok::Less:
    case Tok::Greater:
    case Tok::LessEqual:
    case Tok::GreaterEqual:
    case Tok::KwAnd:
    case Tok::KwOr:
      return true;
    default:
      return false;
  }
}

/// A value or a type may end with it.
bool ends_operand(Tok t) {
  switch (t) {
    case Tok::Identifier:
    case Tok::Variable:
    case Tok::IntegerLiteral:
    case Tok::RealLiteral:
    case Tok::ImaginaryLiteral:
    case Tok::StringLiteral:
    case Tok::RightParen:
    case Tok::RightBracket:
    case Tok::KwEnd:
    case Tok::KwTrue:
    case Tok::KwFalse:
      return true;
    default:
      return is_basic_type(t);
  }
}

/// Tokens and comments in the order of the text.
class Reader {
 public:
  explicit Reader(const Source& source) : text_(source.text) {
    Diagnostics ignored;
    Lexer lexer(source, ignored);
    std::vector<Token> tokens;
    do tokens.push_back(lexer.next());
    while (tokens.back().tok != Tok::Eof);
    std::size_t comment = 0;
    for (std::uint32_t i = 0; i < tokens.size(); ++i) {
      const std::vector<Comment>& all = lexer.comments();
      for (; comment < all.size() && all[comment].before <= i; ++comment) add(all[comment]);
      if (tokens[i].tok != Tok::Eof) add({tokens[i].tok, cut(tokens[i].begin, tokens[i].end)});
    }
  }
  std::vector<Piece> pieces;

 private:
  std::string_view cut(std::uint32_t begin, std::uint32_t end) const {
    return text_.substr(begin, end - begin);
  }
  void add(const Comment& c) {
    Piece p;
    p.text = cut(c.begin, c.end);
    p.comment = true;
    p.ends_line = c.form != Comment::Form::Block;
    if (p.ends_line) p.text = p.text.substr(0, p.text.find_last_not_of(" \t\r") + 1);
    add(p);
  }
  void add(Piece p) {
    const auto begin = static_cast<std::size_t>(p.text.data() - text_.data());
    const std::string_view gap = text_.substr(end_, begin - end_);
    p.width = static_cast<int>(
        std::count_if(p.text.begin(), p.text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    p.newlines = static_cast<int>(std::count(gap.begin(), gap.end(), '\n'));
    end_ = begin + p.text.size();
    pieces.push_back(p);
  }

  std::string_view text_;
  std::size_t end_ = 0;
};

/// Finds the blocks, and what begins and ends in them. The syntax is known to be right.
class Structure {
 public:
  Structure(Pieces& all, const Graph& graph) : all_(all) {
    for (const Function& f : graph.functions)
      if (f.header) headers_.insert(graph.source->text.data() + f.header.end);
    all_.blocks.push_back({});
    open_.push_back({});
    for (at_ = 0; at_ < all_.pieces.size(); ++at_) {
      Piece& p = all_.pieces[at_];
      p.block = top().block;
      p.starts = top().at_start;
      if (!p.comment) token(p);
    }
    for (std::size_t i = all_.pieces.size(); i-- > 1;) {  // comments stand as what follows does
      Piece& c = all_.pieces[i - 1];
      if (c.comment && all_.pieces[i].comment) c.closes = false;
    }
  }

 private:
  struct Open {
    std::size_t block = 0;
    bool at_start = true;
    bool returning = false, function = false;  ///< a function's body ends with its `return`
    bool named = true;                         ///< of a surface or volume: its name has been met
    std::size_t first = kNone;                 ///< of the statement
  };
  Open& top() { return open_.back(); }
  Block::Form form() { return all_.blocks[top().block].form; }

  void open(Block::Form form, bool function = false) {
    all_.blocks.push_back({form, top().block, at_, kNone});
    open_.push_back({});
    top().block = all_.blocks.size() - 1;
    top().function = function;
    top().at_start = form != Block::Form::Bracket;
  }
  void close() {
    all_.blocks[top().block].closer = at_;
    open_.pop_back();
  }
  const Piece* token_before() const {
    for (std::size_t i = at_; i-- > 0;)
      if (!all_.pieces[i].comment) return &all_.pieces[i];
    return nullptr;
  }
  Tok token_after() const {
    for (std::size_t i = at_ + 1; i < all_.pieces.size(); ++i)
      if (!all_.pieces[i].comment) return all_.pieces[i].tok;
    return Tok::Eof;
  }

  void token(Piece& p) {
    const Piece* before = token_before();
    const bool hashed = before && before->tok == Tok::Hash;
    p.unary = p.tok == Tok::Minus && !hashed && !(before && before->operand);
    p.operand = ends_operand(p.tok) || hashed;
    if (p.tok == Tok::Semicolon) return semicolon();
    if (top().at_start) begin(p);
    if (hashed) return;
    switch (p.tok) {
      case Tok::LeftParen:
      case Tok::LeftBracket:
        return open(Block::Form::Bracket);
      case Tok::KwSelect:
        return open(Block::Form::Select);
      case Tok::KwStruct:
        return open(Block::Form::Struct);
      case Tok::RightParen:
      case Tok::RightBracket:
        p.closes = true;
        close();
        if (headers_.contains(p.text.data() + p.text.size()) && token_after() != Tok::Assign)
          open(Block::Form::Body, true);
        return;
      case Tok::KwEnd:
        p.closes = true;
        p.starts = false;
        if (form() == Block::Form::Select) return close();
        close();
        top().at_start = true;
        return;
      case Tok::Assign:
        if (form() == Block::Form::Body && before && before->tok == Tok::Identifier &&
            top().first != kNone && all_.pieces[top().first].assign == kNone)
          all_.pieces[top().first].assign = at_;
        return;
      default:
        if (before && (before->tok == Tok::KwSurface || before->tok == Tok::KwVolume))
          open(Block::Form::Body);
    }
  }

  void begin(const Piece& p) {
    if (p.tok == Tok::KwEnd) return;
    top().at_start = false;
    top().returning = p.tok == Tok::KwReturn;
    const bool may_be_assignment = top().block != 0 && p.tok != Tok::KwConst;
    top().first = may_be_assignment ? at_ : kNone;
  }

  void semicolon() {
    if (form() == Block::Form::Bracket) return;
    all_.pieces[at_].starts = false;
    top().at_start = true;
    if (!top().function || !top().returning) return;
    close();
    top().at_start = true;
  }

  Pieces& all_;
  std::set<const char*> headers_;  ///< where headers of functions end
  std::vector<Open> open_;
  std::size_t at_ = 0;
};

/// Brackets and selects around piece `i`, counted from its statement.
int depth(const Pieces& all, std::size_t i) {
  int n = 0;
  for (std::size_t b = all.pieces[i].block; b != kNone && all.blocks[b].form != Block::Form::Body;
       b = all.blocks[b].parent)
    ++n;
  return n;
}

}  // namespace

Pieces pieces_of(const Graph& graph) {
  Pieces all{Reader(*graph.source).pieces, {}};
  Structure(all, graph);
  return all;
}

bool space_between(const Piece* before, const Piece& a, const Piece& b) {
  const bool opens = a.tok == Tok::LeftParen || a.tok == Tok::LeftBracket;
  const bool ends = b.tok == Tok::RightParen || b.tok == Tok::RightBracket || b.tok == Tok::Comma ||
                    b.tok == Tok::Semicolon;
  if ((opens && !a.comment) || (ends && !b.comment)) return false;
  if (a.comment || b.comment) return true;
  if (a.unary || a.tok == Tok::Hash) return false;
  for (const Tok tight : {Tok::Dot, Tok::DoubleColon, Tok::Caret}) {
    const bool value = before && before->tok == Tok::Hash;  // `#^`
    if (b.tok == tight || (a.tok == tight && !value)) return false;
  }
  if (b.tok == Tok::LeftParen)
    return !((a.operand && a.tok != Tok::KwEnd) || a.tok == Tok::KwFunction);
  if (b.tok == Tok::LeftBracket) return !(a.operand && a.tok != Tok::KwEnd);
  return true;
}

int break_penalty(const Pieces& all, std::size_t a, std::size_t b) {
  const Piece &p = all.pieces[a], &q = all.pieces[b];
  if (p.comment || q.comment) return -1;
  const int deep = 2 * depth(all, b);
  const bool in_bracket = all.blocks[q.block].form == Block::Form::Bracket;
  if (p.tok == Tok::Comma && q.tok != Tok::KwIf) return deep;
  if (p.tok == Tok::Semicolon && in_bracket) return deep;
  if (is_operator(q.tok) && !q.unary && p.tok != Tok::Hash) return deep + 1;
  if (p.tok == Tok::Assign && !in_bracket) return deep + 5;
  if (p.tok == Tok::Arrow) return deep + 5;
  if (p.tok == Tok::LeftParen && q.tok != Tok::RightParen) return deep + 5;
  return -1;
}

}  // namespace mms::lang
