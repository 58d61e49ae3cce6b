// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The recursive-descent parser behind parser.h: one function for each production of the grammar.
///
/// After an error it is in panic: every function returns at once, without further messages, until
/// a statement or an arm of a `select` skips to its end. A token that should be there and is
/// plainly only forgotten (`;`, `)`, `end`) is reported and taken as given instead.

#include <string>
#include <utility>
#include <vector>

#include "lang/ast.h"
#include "lang/diagnostics.h"
#include "lang/lexer.h"
#include "lang/token.h"
#include "vm/limits.h"

namespace mms::lang {

class Parser {
 public:
  Parser(SourcePtr source, Diagnostics& diagnostics, std::uint32_t begin = 0,
         std::uint32_t end = UINT32_MAX);

  Graph program() &&;
  Graph signature() &&;
  Graph expression() &&;

 private:
  enum class Want : std::uint8_t { Token, Name, Expression };

  // Counts one level of nesting while it lives; false if there are too many of them.
  struct Nested {
    explicit Nested(Parser& p) : parser(p) {
      if (++parser.depth_ > vm::limits::kNesting) parser.too_deep(parser.span(parser.peek()));
    }
    ~Nested() { --parser.depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;
    explicit operator bool() const { return !parser.panicking_; }
    Parser& parser;
  };

  // Tokens (parser.cpp).
  const Token& peek(std::uint32_t ahead = 0) {
    const std::size_t k = std::size_t{pos_} + ahead;
    return k < tokens_.size() && !stopped_ ? tokens_[k] : fetch(k);
  }
  const Token& fetch(std::size_t k);
  bool at(Tok tok) { return peek().tok == tok; }
  bool at(Tok tok, Tok following) { return at(tok) && peek(1).tok == following; }
  Token take();
  bool accept(Tok tok);
  bool expect(Tok tok);
  std::string_view text(const Token& t) const;
  Span span(const Token& t) const { return {graph_.source.get(), t.begin, t.end}; }
  Span from(std::uint32_t begin) const { return {graph_.source.get(), begin, previous_.end}; }
  Span after_previous() const { return {graph_.source.get(), previous_.end, previous_.end}; }
  bool on_new_line();
  std::string doc();

  // Errors and recovery (parser.cpp).
  bool quiet();
  template <class... Args>
  Diagnostic& report(Diag id, Span where, const Args&... args) {
    if (quiet()) return scrap_ = {};
    reported_at_ = pos_;
    return diagnostics_.add(id, where, args...);
  }
  void panic();
  void unexpected(std::string_view wanted, Want want = Want::Token);
  bool habit(Want want);
  std::string found();
  void too_deep(Span where);
  void too_long(Span where, std::size_t limit, std::string_view of);
  bool statement_ends();
  bool starts_item();
  bool array_goes_on();
  void skip_statement();
  void skip_arm();
  bool recovered();
  void semicolon();
  void close(Tok closer, const Token& opener);
  void finish(std::string_view what);
  void report_foreign_types();

  // Names and types (parser_type.cpp).
  Name name(std::string_view what);
  Path path();
  Name name_or_string(std::string_view what);
  TypeHandle type();
  TypeHandle add(TypeExpr t);
  TypeHandle function_type();
  TypeHandle simple_type();
  TypeHandle array_type(TypeHandle element, std::uint32_t begin);
  TypeExpr::Dim dimension();
  std::vector<Formal> formals();
  bool at_bare_formal();

  // Expressions (parser_expr.cpp).
  ExprHandle expr();
  ExprHandle lambda();
  ExprHandle infix(int level);
  ExprHandle comparisons(ExprHandle first, int level);
  ExprHandle percentage(ExprHandle value, Span sign);
  ExprHandle negation();
  ExprHandle unary();
  ExprHandle minus(ExprHandle (Parser::*operand)());
  ExprHandle power();
  ExprHandle exponent();
  ExprHandle postfix();
  ExprHandle term();
  ExprHandle literal();
  ExprHandle integer(std::int64_t largest);
  ExprHandle parenthesised();
  ExprHandle function_value();
  ExprHandle conversion();
  ExprHandle select();
  bool select_arm(Expr& e, const Token& opener);
  bool condition_of_arm(Expr& e);
  void end_select(const Token& opener);
  ExprHandle condition();
  ExprHandle array();
  ExprHandle field(ExprHandle of);
  std::vector<Argument> arguments();
  ExprHandle index(ExprHandle what);
  ExprHandle missing();
  ExprHandle add(Expr e, std::uint32_t begin);
  ExprHandle binary(Operator op, ExprHandle a, ExprHandle b);

  // Items (parser_item.cpp).
  void item();
  void import();
  void alias();
  void param();
  Constant constant();
  TypeDefinition type_definition();
  void fields(TypeDefinition& t);
  void descriptor();
  void top_definition();
  bool missing_result_type();
  void skip_formals();
  FunctionHandle function(TypeHandle result, Name name, std::uint32_t begin, std::string doc);
  void function_body(Function& f);
  void body(Body& b);
  void body_item(Body& b);
  void body_definition(Body& b);
  bool accept_brace(Tok brace);
  bool statement();
  void skip_head();
  bool stray();

  Graph graph_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  std::vector<Token> tokens_;
  std::uint32_t pos_ = 0;
  Token previous_;  // the token before pos_

  bool panicking_ = false;
  bool stopped_ = false;                    // a limit is reached: only Eof from now on
  std::uint32_t reported_at_ = UINT32_MAX;  // token of the last message: one for each token
  bool arm_failed_ = false;                 // in the `select` that is being parsed
  bool outside_reported_ = false;           // since the last item: assignments outside a body
  bool statement_reported_ = false;         // so the `else` of a reported `if` is passed over
  Diagnostic scrap_{};

  int depth_ = 0;
  int arrays_ = 0;                      // array literals open in this statement or arm
  std::vector<Tok> closers_;            // brackets open
  std::vector<std::uint16_t> heights_;  // of each expression's tree
  std::vector<std::pair<Span, std::string>> foreign_types_;
  std::vector<std::string> defined_types_;
};

/// The basic type that a keyword names, or null.
const BasicType* basic_type(Tok tok);

/// How this language says a type name of other languages: `real` for `float`, `real[3]` for `vec3`,
/// ... Empty if `word` is no such name.
std::string_view type_instead_of(std::string_view word);

/// `text`, cut to a length that fits a message.
std::string shortened(std::string_view text);

}  // namespace mms::lang
