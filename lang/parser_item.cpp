// SPDX-License-Identifier: Apache-2.0
// Items: imports, params, constants, types, functions, descriptors, and the bodies of these.

#include "lang/parser_impl.h"

namespace mms::lang {
namespace {

template <class T>
std::uint32_t push(std::vector<T>& list, T value) {
  list.push_back(std::move(value));
  return static_cast<std::uint32_t>(list.size() - 1);
}

}  // namespace

Graph Parser::program() && {
  while (!at(Tok::Eof)) {
    const std::uint32_t before = pos_;
    item();
    recovered();
    if (pos_ == before) take();
  }
  report_foreign_types();
  return std::move(graph_);
}

Graph Parser::signature() && {
  Function f;
  const std::uint32_t begin = peek().begin;
  f.result = type();
  f.name = name("the function's name");
  f.formals = formals();
  f.span = f.header = from(begin);
  finish("signature");
  if (!panicking_) {
    graph_.functions.push_back(std::move(f));
    graph_.top_functions.push_back({0});
  }
  report_foreign_types();
  return std::move(graph_);
}

Graph Parser::expression() && {
  const ExprHandle root = expr();
  finish("expression");
  // Whatever was understood, the root is the last.
  if (root.index + 1 != graph_.exprs.size()) graph_.exprs.push_back(Expr(graph_[root]));
  report_foreign_types();
  return std::move(graph_);
}

void Parser::item() {
  if (is_keyword(peek().tok) && peek(1).tok == Tok::Assign) return top_definition();
  switch (peek().tok) {
    case Tok::Semicolon:
      take();
      return;
    case Tok::KwImport:
      return import();
    case Tok::KwParam:
      return param();
    case Tok::KwSurface:
    case Tok::KwVolume:
      return descriptor();
    case Tok::KwConst: {
      Constant c = constant();
      if (!panicking_) graph_.constants.push_back(std::move(c));
      return;
    }
    default:
      break;
  }
  if (peek(1).tok == Tok::KwAlias) return alias();
  if (at(Tok::Identifier, Tok::KwTypeid)) {
    TypeDefinition t = type_definition();
    if (!panicking_) graph_.type_definitions.push_back(std::move(t));
    return;
  }
  if (!stray() && !statement()) top_definition();
}

void Parser::import() {
  Import i;
  const std::uint32_t begin = take().begin;
  if (at(Tok::StringLiteral))
    i.file = string_value(text(take()));
  else
    unexpected("the name of a file in quotes");
  if (accept(Tok::KwAs)) i.as = name("a name after `as`");
  semicolon();
  i.span = from(begin);
  if (!panicking_) graph_.imports.push_back(std::move(i));
}

void Parser::alias() {
  Alias a;
  const std::uint32_t begin = peek().begin;
  a.outside = name_or_string("a name or a string");
  accept(Tok::KwAlias);
  if (at(Tok::StringLiteral))
    a.inside = {name_or_string("")};
  else
    a.inside = path();
  semicolon();
  a.span = from(begin);
  if (!panicking_) graph_.aliases.push_back(std::move(a));
}

void Parser::param() {
  Param p;
  p.doc = doc();
  const std::uint32_t begin = take().begin;
  p.type = type();
  p.name = name("the param's name");
  expect(Tok::Assign);
  p.value = expr();
  if (accept(Tok::KwIn)) {
    const Token opener = peek();
    if (expect(Tok::LeftBracket)) {
      closers_.push_back(Tok::RightBracket);
      p.lower = expr();
      expect(Tok::Comma);
      p.upper = expr();
      close(Tok::RightBracket, opener);
    }
  }
  while (accept(Tok::Comma)) {
    Param::Meta m;
    m.key = name("a key such as `label`");
    expect(Tok::Assign);
    m.value = expr();
    p.meta.push_back(std::move(m));
  }
  semicolon();
  p.span = from(begin);
  if (!panicking_) graph_.params.push_back(std::move(p));
}

Constant Parser::constant() {
  Constant c;
  c.doc = doc();
  const std::uint32_t begin = take().begin;
  if (peek(1).tok != Tok::Assign) c.type = type();
  c.name = name("the constant's name");
  expect(Tok::Assign);
  c.value = expr();
  semicolon();
  c.span = from(begin);
  return c;
}

TypeDefinition Parser::type_definition() {
  TypeDefinition t;
  t.doc = doc();
  const Token first = take();
  t.name = {std::string(text(first)), span(first)};
  defined_types_.push_back(t.name.text);
  take();
  if (accept(Tok::KwStruct)) {
    t.form = TypeDefinition::Form::Struct;
    fields(t);
  } else if (accept(Tok::KwEnum)) {
    t.form = TypeDefinition::Form::Enum;
    do t.enumerators.push_back(name("the name of an enumerator"));
    while (accept(Tok::Comma));
    semicolon();
  } else {
    t.type = type();
    semicolon();
  }
  t.span = from(first.begin);
  return t;
}

// The fields of a struct, and its `end`.
void Parser::fields(TypeDefinition& t) {
  const Token opener = previous_;
  do {
    const TypeHandle field_type = type();
    do t.fields.push_back({field_type, name("the name of a field")});
    while (accept(Tok::Comma));
    semicolon();
    if (panicking_) {
      t.fields.pop_back();
      skip_statement();
      panicking_ = stopped_;
    }
  } while (at(Tok::Identifier) || at(Tok::LeftParen) || at(Tok::KwFunction) || at(Tok::KwGeneric) ||
           basic_type(peek().tok));
  if (accept(Tok::KwEnd) || panicking_) return;
  report(Diag::MissingEnd, span(peek()), "the `struct`")
      .labelled("expected `end` before this")
      .note(span(opener), "the `struct` begins here");
  if (!starts_item()) panic();
}

void Parser::descriptor() {
  Descriptor d;
  d.doc = doc();
  const Token first = take();
  d.form = first.tok == Tok::KwSurface ? Descriptor::Form::Surface : Descriptor::Form::Volume;
  if (at(Tok::Identifier, Tok::Assign))
    unexpected(fmt::format("the name of the {}", text(first)));
  else
    d.name = name_or_string(fmt::format("the name of the {}", text(first)));
  panicking_ = false;
  const Span header = from(first.begin);
  const bool braces = accept_brace(Tok::LeftBrace);
  outside_reported_ = false;
  for (body(d.body); at(Tok::KwReturn) || (at(Tok::RightBrace) && !braces); body(d.body)) {
    stray();
    recovered();
  }
  if (!accept(Tok::KwEnd) && !(braces && accept(Tok::RightBrace)))
    report(Diag::MissingEnd, span(peek()), fmt::format("the {}", text(first)))
        .labelled("expected `end` before this")
        .note(header, fmt::format("the {} begins here", text(first)));
  d.span = from(first.begin);
  graph_.descriptors.push_back(std::move(d));
}

bool Parser::accept_brace(Tok brace) {
  if (!at(brace)) return false;
  if (!quiet()) habit(Want::Token);
  take();
  return true;
}

// A function, or an assignment that is outside a body.
void Parser::top_definition() {
  const std::string comment = doc();
  const std::uint32_t begin = peek().begin;
  const TypeHandle t = peek(1).tok == Tok::Assign || missing_result_type() ? TypeHandle{} : type();
  Name n = name("a name");
  if (!panicking_ && at(Tok::LeftParen)) {
    outside_reported_ = false;
    const FunctionHandle f = function(t, std::move(n), begin, comment);
    graph_.top_functions.push_back(f);
    return;
  }
  if (!panicking_ && !at(Tok::Assign)) unexpected("`(` and the formals of a function");
  if (panicking_) return;
  if (!outside_reported_)
    report(Diag::AssignmentOutside, n.span)
        .help(
            "write `const` or `param` before it, or put it into a `surface`, a `volume` or a "
            "function");
  outside_reported_ = true;
  take();
  expr();
  semicolon();
}

// `f(real x) ...` without the type of its result.
bool Parser::missing_result_type() {
  if (!at(Tok::Identifier, Tok::LeftParen)) return false;
  const Tok formal = peek(2).tok;
  const bool definition = basic_type(formal) || formal == Tok::KwGeneric ||
                          formal == Tok::KwFunction ||
                          (formal == Tok::Identifier && peek(3).tok == Tok::Identifier);
  if (definition) {
    report(Diag::MissingResultType, span(peek()), shortened(text(peek())))
        .help(fmt::format("write `real {}(...)`, or another type", shortened(text(peek()))));
  } else {
    report(Diag::Statement, span(peek()), "a call").help("use its value: `name = f(x);`");
    panic();
  }
  return true;
}

FunctionHandle Parser::function(TypeHandle result, Name name, std::uint32_t begin,
                                std::string doc) {
  Function f;
  f.result = result;
  f.name = std::move(name);
  f.doc = std::move(doc);
  f.formals = formals();
  if (panicking_) skip_formals();
  f.header = from(begin);
  function_body(f);
  f.span = from(begin);
  return {push(graph_.functions, std::move(f))};
}

// After an error in the formals: to what follows them.
void Parser::skip_formals() {
  panicking_ = stopped_;
  closers_.clear();
  for (int depth = 0; !at(Tok::Eof) && !at(Tok::Semicolon) && !at(Tok::KwReturn); take()) {
    if (at(Tok::LeftParen)) ++depth;
    if (at(Tok::RightParen) && depth-- <= 0) break;
  }
  accept(Tok::RightParen);
}

void Parser::function_body(Function& f) {
  if (accept(Tok::Assign)) {
    f.value = expr();
    return semicolon();
  }
  Nested nested(*this);
  const bool braces = accept_brace(Tok::LeftBrace);
  body(f.body);
  if (accept(Tok::KwReturn)) {
    f.value = expr();
    semicolon();
    if (panicking_) recovered();
  } else {
    report(Diag::MissingReturn, span(peek()), shortened(f.name.text))
        .labelled("expected `return` before this")
        .note(f.header, "the function begins here");
    f.value = add(Expr{}, peek().begin);
  }
  if (braces) accept(Tok::RightBrace);
}

// Items up to `return`, `end`, or whatever cannot be in a body.
void Parser::body(Body& b) {
  for (;;) {
    if (stopped_ || (statement_ends() && !at(Tok::KwConst))) return;
    if (panicking_) return;
    const std::uint32_t before = pos_;
    body_item(b);
    recovered();
    if (pos_ == before) take();
  }
}

void Parser::body_item(Body& b) {
  if (accept(Tok::Semicolon)) return;
  if (at(Tok::KwConst)) {
    Constant c = constant();
    if (!panicking_) b.items.push_back({Item::Form::Constant, push(b.constants, std::move(c))});
  } else if (at(Tok::Identifier, Tok::KwTypeid)) {
    TypeDefinition t = type_definition();
    if (!panicking_) b.items.push_back({Item::Form::Type, push(b.types, std::move(t))});
  } else if (!statement()) {
    body_definition(b);
  }
}

// `[type] name = value;` or `type name(...) ...`.
void Parser::body_definition(Body& b) {
  Assignment a;
  a.doc = doc();
  const std::uint32_t begin = peek().begin;
  if (peek(1).tok != Tok::Assign && !missing_result_type()) a.type = type();
  a.name = name("a name");
  if (!panicking_ && at(Tok::LeftParen)) {
    const FunctionHandle f = function(a.type, std::move(a.name), begin, std::move(a.doc));
    b.items.push_back({Item::Form::Function, push(b.functions, f)});
    return;
  }
  expect(Tok::Assign);
  a.value = expr();
  semicolon();
  a.span = from(begin);
  if (!panicking_) b.items.push_back({Item::Form::Assignment, push(b.assignments, std::move(a))});
}

// A statement of another language, where an item should begin.
bool Parser::statement() {
  const std::string_view word = text(peek());
  const bool loop = (word == "for" || word == "while" || word == "do") &&
                    (peek(1).tok == Tok::LeftParen || peek(1).tok == Tok::LeftBrace);
  // `else` may be a type's name, where no `if` was before it.
  const bool other = word == "else" && at(Tok::Identifier) &&
                     (statement_reported_ || peek(1).tok != Tok::Identifier);
  const bool branch = at(Tok::KwIf) || other;
  if (!loop && !branch) {
    statement_reported_ = false;
    if (!at(Tok::LeftBrace) && !at(Tok::Identifier, Tok::PlusPlus) &&
        !at(Tok::Identifier, Tok::PlusAssign) && !at(Tok::Identifier, Tok::MinusAssign) &&
        !at(Tok::Identifier, Tok::StarAssign) && !at(Tok::Identifier, Tok::SlashAssign))
      return false;
    if (at(Tok::Identifier)) take();
    unexpected("a definition");
    return true;
  }
  if (word != "else" || !statement_reported_)
    report(Diag::Statement, span(peek()), fmt::format("`{}`", word))
        .help(loop ? "iteration is recursion: a function that calls itself in its `return`"
                   : "choose between values: `x = select a, if c; b otherwise end;`");
  statement_reported_ = true;
  if (loop) skip_head();
  panic();
  return true;
}

// `for (...)`: the `;` inside end nothing.
void Parser::skip_head() {
  take();
  if (!at(Tok::LeftParen)) return;
  int depth = 0;
  do {
    if (at(Tok::LeftParen)) ++depth;
    if (at(Tok::RightParen)) --depth;
    take();
  } while (depth > 0 && !statement_ends());
}

// What ends something, where nothing is open.
bool Parser::stray() {
  const Span where = span(peek());
  switch (peek().tok) {
    case Tok::KwEnd:
      if (!outside_reported_)
        report(Diag::StrayEnd, where)
            .help(
                "a function ends with its `return`; only `surface`, `volume`, `struct` and "
                "`select` have an `end`");
      take();
      return true;
    case Tok::KwReturn:
      if (!outside_reported_) report(Diag::StrayReturn, where);
      take();
      expr();
      semicolon();
      return true;
    case Tok::LeftBrace:
    case Tok::RightBrace:
      return accept_brace(peek().tok);
    default:
      return false;
  }
}

}  // namespace mms::lang
