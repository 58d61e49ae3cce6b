// SPDX-License-Identifier: Apache-2.0
#include "lang/parser.h"

#include <algorithm>

#include "base/large_pages.h"
#include "lang/parser_impl.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

// Tokens of one source: 64 for each node that a linked program may have, so a source that could
// ever be linked is far below it; bounds the memory that a hostile one costs.
constexpr std::size_t kTokens = std::size_t{4} * vm::limits::kNodes;

// How far ahead a `;` looks for the `]` that makes it a separator of rows.
constexpr std::uint32_t kRowLookAhead = 256;

// Bytes from which on room for what a text may need is worth more than the pages it takes.
constexpr std::size_t kLongText = 1 << 16;

bool ends_statement(Tok tok) {
  switch (tok) {
    case Tok::Eof:
    case Tok::KwConst:
    case Tok::KwEnd:
    case Tok::KwImport:
    case Tok::KwParam:
    case Tok::KwReturn:
    case Tok::KwSurface:
    case Tok::KwVolume:
    case Tok::RightBrace:
      return true;
    default:
      return false;
  }
}

bool starts_type(Tok tok) { return basic_type(tok) || tok == Tok::KwGeneric; }

}  // namespace

std::string shortened(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  if (text.size() <= kLongest) return std::string(text);
  return std::string(text.substr(0, kLongest - 3)) + "...";
}

Parser::Parser(SourcePtr source, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end)
    : graph_{.source = std::move(source),
             .exprs = {},
             .types = {},
             .functions = {},
             .imports = {},
             .aliases = {},
             .params = {},
             .constants = {},
             .type_definitions = {},
             .top_functions = {},
             .descriptors = {}},
      diagnostics_(diagnostics),
      lexer_(*graph_.source, diagnostics, begin, end) {
  diagnostics.keep(graph_.source);
  // A long text gets room for as many as there can be in ordinary text: pages that are not needed
  // are never touched. A short one, for as many as there mostly are: there each page counts.
  const std::size_t length = std::min<std::size_t>(end, graph_.source->text.size()) - begin;
  const auto reserve = [&](auto& list, std::size_t most, std::size_t mostly) {
    list.reserve(length / (length < kLongText ? mostly : most));
  };
  reserve(tokens_, 8, 4);
  reserve(graph_.exprs, 5, 13);
  reserve(graph_.types, 16, 78);
  reserve(graph_.functions, 40, 300);
  prefer_large_pages(graph_.exprs.data(), graph_.exprs.capacity() * sizeof(Expr));
  heights_.reserve(graph_.exprs.capacity());
}

// Token k, which has perhaps not been read yet.
const Token& Parser::fetch(std::size_t k) {
  static constexpr Token kEof{};
  if (stopped_) return kEof;
  while (tokens_.size() <= k) {
    if (tokens_.size() == kTokens) {
      too_long(span(tokens_.back()), kTokens, "tokens");
      return kEof;
    }
    tokens_.push_back(lexer_.next());
  }
  return tokens_[k];
}

Token Parser::take() {
  const Token t = peek();
  if (t.tok != Tok::Eof) {
    previous_ = t;
    ++pos_;
  }
  return t;
}

bool Parser::accept(Tok tok) {
  if (panicking_ || !at(tok)) return false;
  take();
  return true;
}

bool Parser::expect(Tok tok) {
  if (panicking_) return false;
  if (accept(tok)) return true;
  unexpected(fmt::format("`{}`", spelling(tok)));
  return false;
}

std::string_view Parser::text(const Token& t) const {
  return text_of({graph_.source.get(), t.begin, t.end});
}

bool Parser::on_new_line() {
  const std::uint32_t end = previous_.end, next = peek().begin;
  if (at(Tok::Eof)) return true;
  const std::string_view between = text_of({graph_.source.get(), end, next});
  return between.find('\n') != std::string_view::npos;
}

// The `///` lines just before the next token.
std::string Parser::doc() {
  peek();
  const std::vector<Comment>& comments = lexer_.comments();
  auto c = std::lower_bound(comments.begin(), comments.end(), pos_,
                            [](const Comment& a, std::uint32_t b) { return a.before < b; });
  std::string lines;
  for (; c != comments.end() && c->before == pos_; ++c) {
    if (c->form != Comment::Form::Doc) continue;
    if (!lines.empty()) lines += '\n';
    lines += doc_text(text({Tok::Error, c->begin, c->end}));
  }
  return lines;
}

// Nothing is said about a token twice, nor about what the lexer has already reported.
bool Parser::quiet() {
  if (diagnostics_.error_count() > kMaxErrors) stopped_ = true;
  return panicking_ || stopped_ || reported_at_ == pos_ || at(Tok::Error) ||
         previous_.tok == Tok::Error;
}

void Parser::panic() { panicking_ = true; }

void Parser::too_long(Span where, std::size_t limit, std::string_view of) {
  if (!stopped_) diagnostics_.add(Diag::SourceTooLong, where, limit, of);
  stopped_ = panicking_ = true;
}

void Parser::too_deep(Span where) {
  report(Diag::NestingTooDeep, where, vm::limits::kNesting);
  panic();
  stopped_ = true;
}

std::string Parser::found() {
  const Token& t = peek();
  switch (t.tok) {
    case Tok::Eof:
      return "the end of the source";
    case Tok::Identifier:
    case Tok::Variable:
      return fmt::format("`{}`", shortened(text(t)));
    case Tok::IntegerLiteral:
    case Tok::RealLiteral:
    case Tok::ImaginaryLiteral:
      return fmt::format("the number `{}`", shortened(text(t)));
    case Tok::StringLiteral:
      return "a string";
    default:
      return fmt::format("{}`{}`", is_keyword(t.tok) ? "the keyword " : "", text(t));
  }
}

void Parser::unexpected(std::string_view wanted, Want want) {
  if (!quiet() && !habit(want)) {
    Diagnostic& d = report(Diag::UnexpectedToken, span(peek()), wanted, found());
    if (want == Want::Expression && at(Tok::KwNot))
      d.help("`not` binds loosely: put `(not ...)` in parentheses");
    if (want == Want::Expression && at(Tok::RightBracket, Tok::Semicolon))
      d.help("an array has at least one element");
    if (want != Want::Expression && at(Tok::Assign))
      d.help("a name is given its value once; parts of a value are not assigned");
    if (want == Want::Token && at(Tok::LeftParen)) d.help("a product is written with `*`");
  }
  panic();
}

// A habit from another language, where something else was expected.
bool Parser::habit(Want want) {
  const Token t = peek();
  const Span where = span(t);
  switch (t.tok) {
    case Tok::Question:
    case Tok::Colon:
      report(Diag::Ternary, where).help("write `select a, if c; b otherwise end` for `c ? a : b`");
      return true;
    case Tok::PlusPlus:
    case Tok::PlusAssign:
    case Tok::MinusAssign:
    case Tok::StarAssign:
    case Tok::SlashAssign:
      report(Diag::CompoundAssignment, where, text(t))
          .help("give the new value a new name, as in `next = value + 1;`");
      return true;
    case Tok::LeftBrace:
    case Tok::RightBrace:
      report(Diag::Braces, where, text(t))
          .help(
              "a descriptor ends with `end`, a function with its `return`; arrays are written "
              "`[1, 2, 3]`");
      return true;
    case Tok::KwIf:
      if (want != Want::Expression) break;
      report(Diag::IfExpression, where).help("write `select a, if c; b otherwise end`");
      return true;
    case Tok::KwFunction:
      if (want != Want::Expression) break;
      report(Diag::LambdaOperand, where).help("write `(function(x) -> ...)`");
      return true;
    default:
      break;
  }
  if (want == Want::Expression && basic_type(t.tok)) {
    report(Diag::TypeAsValue, where, text(t));
    return true;
  }
  if (want == Want::Name && is_keyword(t.tok)) {
    report(Diag::KeywordAsName, where, text(t)).help("choose another name");
    return true;
  }
  return false;
}

// Does a statement that is being skipped end here? A keyword before `=` is a name gone wrong.
bool Parser::statement_ends() {
  return ends_statement(peek().tok) && (at(Tok::Eof) || peek(1).tok != Tok::Assign);
}

// Is the next token, after a statement without `;`, plainly the beginning of another?
bool Parser::starts_item() {
  const Tok tok = peek().tok, next = peek(1).tok;
  if (ends_statement(tok)) return true;
  if (tok == Tok::Identifier)
    return next == Tok::Assign || next == Tok::KwTypeid || next == Tok::KwAlias ||
           (on_new_line() && (next == Tok::Identifier || next == Tok::DoubleColon));
  return on_new_line() && (starts_type(tok) || tok == Tok::KwFunction);
}

void Parser::semicolon() {
  if (panicking_ || accept(Tok::Semicolon)) return;
  if (!at(Tok::RightBrace) && !starts_item()) return unexpected("`;`");
  report(Diag::MissingSemicolon, after_previous()).labelled("`;` is missing here");
}

// A closing bracket. If what follows goes on after it, it was only forgotten.
void Parser::close(Tok closer, const Token& opener) {
  closers_.pop_back();
  if (panicking_ || accept(closer)) return;
  const Tok tok = peek().tok;
  const bool other = tok == Tok::RightParen || tok == Tok::RightBracket;
  const bool goes_on = other || tok == Tok::Semicolon || tok == Tok::Comma || tok == Tok::KwIf ||
                       tok == Tok::KwOtherwise || tok == Tok::LeftBrace || starts_item();
  if (!goes_on) return unexpected(fmt::format("`{}` or an operator", spelling(closer)));
  report(Diag::UnclosedBracket, other ? span(peek()) : after_previous(), spelling(closer), found())
      .note(span(opener), "opened here");
  if (other && std::find(closers_.begin(), closers_.end(), tok) == closers_.end()) take();
}

// After an error in an array: does this `;` separate rows?
bool Parser::array_goes_on() {
  int depth = 0;
  for (std::uint32_t ahead = 1; ahead < kRowLookAhead; ++ahead) {
    const Tok tok = peek(ahead).tok;
    if (tok == Tok::LeftBracket) ++depth;
    if (tok == Tok::RightBracket && depth-- == 0) return true;
    if (tok == Tok::Assign || ends_statement(tok)) return false;
  }
  return false;
}

void Parser::skip_statement() {
  const bool in_array = arrays_ > 0;
  int selects = 0, braces = 0;
  for (bool first = true;; first = false) {
    const Tok tok = peek().tok;
    if (selects > 0 && tok == Tok::KwEnd) {
      --selects;
    } else if (braces > 0 && tok == Tok::RightBrace) {
      if (--braces == 0) {
        take();
        break;
      }
    } else if (statement_ends()) {
      break;
    } else if (tok == Tok::Semicolon && selects == 0 && braces == 0 &&
               !(in_array && array_goes_on())) {
      take();
      break;
    } else if (tok == Tok::KwSelect) {
      ++selects;
    } else if (tok == Tok::LeftBrace) {
      ++braces;
    } else if (!first && tok == Tok::Identifier && peek(1).tok == Tok::KwTypeid) {
      break;
    }
    take();
  }
}

// To the end of an arm of the `select` that is being parsed; its `end` is left.
void Parser::skip_arm() {
  for (int selects = 0;;) {
    const Tok tok = peek().tok;
    if (tok == Tok::KwEnd && selects == 0) return;
    if (tok == Tok::KwEnd)
      --selects;
    else if (statement_ends())
      return;
    if (tok == Tok::KwSelect) ++selects;
    take();
    if (tok == Tok::Semicolon && selects == 0) return;
  }
}

// At the end of a statement: true if it was in order, else skips what is left of it.
bool Parser::recovered() {
  const bool in_order = !panicking_;
  if (!in_order) skip_statement();
  panicking_ = false;
  arrays_ = 0;
  closers_.clear();
  return in_order;
}

void Parser::finish(std::string_view what) {
  if (!panicking_ && !at(Tok::Eof)) unexpected(fmt::format("the end of the {}", what));
}

// A script may define a type named `vec3`, or import one: then it is no habit.
void Parser::report_foreign_types() {
  for (const Import& i : graph_.imports)
    if (!i.as) return;
  panicking_ = false;
  for (const auto& [where, word] : foreign_types_) {
    if (std::find(defined_types_.begin(), defined_types_.end(), word) != defined_types_.end())
      continue;
    diagnostics_.add(Diag::ForeignType, where, word).help(fmt::format("{}", type_instead_of(word)));
  }
}

namespace {

// Sources past the limit are not looked at.
bool too_long(const SourcePtr& source, Diagnostics& diagnostics) {
  if (source->text.size() <= vm::limits::kSourceBytes) return false;
  diagnostics.keep(source);
  diagnostics.add(Diag::SourceTooLong, Span{source.get(), 0, 0}, vm::limits::kSourceBytes, "bytes");
  return true;
}

Graph empty(SourcePtr source) {
  Graph g;
  g.source = std::move(source);
  return g;
}

}  // namespace

Graph parse(SourcePtr source, Diagnostics& diagnostics) {
  if (too_long(source, diagnostics)) return empty(std::move(source));
  return Parser(std::move(source), diagnostics).program();
}

Graph parse(SourcePtr source, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end) {
  return Parser(std::move(source), diagnostics, begin, end).program();
}

Graph parse_signature(SourcePtr source, Diagnostics& diagnostics) {
  if (too_long(source, diagnostics)) return empty(std::move(source));
  return Parser(std::move(source), diagnostics).signature();
}

Graph parse_expression(SourcePtr source, Diagnostics& diagnostics) {
  if (too_long(source, diagnostics)) return empty(std::move(source));
  return Parser(std::move(source), diagnostics).expression();
}

}  // namespace mms::lang
