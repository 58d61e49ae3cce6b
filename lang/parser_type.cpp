// SPDX-License-Identifier: Apache-2.0
// Names, types and formals.

#include <algorithm>
#include <iterator>

#include "lang/parser_impl.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

struct ForeignName {
  std::string_view word, help;
};
constexpr ForeignName kForeign[] = {
    {"float", "write `real`"},
    {"double", "write `real`"},
    {"half", "write `real`"},
    {"number", "write `real`"},
    {"int", "write `integer`"},
    {"uint", "write `integer`"},
    {"long", "write `integer`"},
    {"bool", "write `logic`"},
    {"boolean", "write `logic`"},
    {"vec2", "write `real[2]`"},
    {"vec3", "write `real[3]`"},
    {"vec4", "write `real[4]`"},
    {"float2", "write `real[2]`"},
    {"float3", "write `real[3]`"},
    {"float4", "write `real[4]`"},
    {"mat2", "write `real[2, 2]`"},
    {"mat3", "write `real[3, 3]`"},
    {"mat4", "write `real[4, 4]`"},
    {"matrix", "write `real[4, 4]`"},
    {"vector", "write `real[3]`"},
    {"point", "write `real[3]`"},
    {"normal", "write `real[3]`"},
    {"color", "colours are spectra: write `spectrum`"},
    {"colour", "colours are spectra: write `spectrum`"},
    {"rgb", "colours are spectra: write `spectrum`"},
    {"char", "write `string`"},
    {"closure", "write `material`"},
    {"bsdf", "write `material`"},
    {"void", "a function always has a value: write the type of it"},
    {"let", "leave it out: a type is inferred, as in `x = 1;`"},
    {"var", "leave it out: a type is inferred, as in `x = 1;`"},
    {"auto", "leave it out: a type is inferred, as in `x = 1;`"},
};

}  // namespace

const BasicType* basic_type(Tok tok) {
  struct Row {
    Tok tok;
    BasicType type;
  };
  static constexpr Row kRows[] = {
      {Tok::KwLogic, BasicType::Logic},       {Tok::KwInteger, BasicType::Integer},
      {Tok::KwReal, BasicType::Real},         {Tok::KwComplex, BasicType::Complex},
      {Tok::KwSpectrum, BasicType::Spectrum}, {Tok::KwMaterial, BasicType::Material},
      {Tok::KwString, BasicType::String},
  };
  for (const Row& r : kRows)
    if (r.tok == tok) return &r.type;
  return nullptr;
}

std::string_view type_instead_of(std::string_view word) {
  for (const ForeignName& f : kForeign)
    if (f.word == word) return f.help;
  return {};
}

Name Parser::name(std::string_view what) {
  if (panicking_) return {};
  if (!at(Tok::Identifier)) {
    unexpected(what, Want::Name);
    return {};
  }
  const Token t = take();
  return {std::string(text(t)), span(t)};
}

Path Parser::path() {
  Path p{name("a name")};
  while (accept(Tok::DoubleColon)) p.push_back(name("a name after `::`"));
  return p;
}

Name Parser::name_or_string(std::string_view what) {
  if (!at(Tok::StringLiteral)) return name(what);
  const Token t = take();
  return {string_value(text(t)), span(t)};
}

TypeHandle Parser::type() {
  Nested nested(*this);
  if (!nested) return {};
  return at(Tok::KwFunction) ? function_type() : simple_type();
}

TypeHandle Parser::add(TypeExpr t) {
  if (graph_.types.size() >= vm::limits::kNodes) too_long(t.span, vm::limits::kNodes, "types");
  graph_.types.push_back(std::move(t));
  return {static_cast<std::uint32_t>(graph_.types.size() - 1)};
}

TypeHandle Parser::function_type() {
  const std::uint32_t begin = take().begin;
  TypeExpr t;
  t.form = TypeExpr::Form::Function;
  const Token opener = peek();
  if (expect(Tok::LeftParen)) {
    closers_.push_back(Tok::RightParen);
    if (!at(Tok::RightParen)) {
      do t.formals.push_back(type());
      while (accept(Tok::Comma));
    }
    close(Tok::RightParen, opener);
  }
  expect(Tok::Arrow);
  t.element = type();
  if (panicking_) return {};
  t.span = from(begin);
  return add(std::move(t));
}

TypeHandle Parser::simple_type() {
  if (panicking_) return {};
  const Token first = peek();
  TypeExpr t;
  TypeHandle inner;
  if (const BasicType* basic = basic_type(first.tok)) {
    take();
    t.basic = *basic;
  } else if (accept(Tok::KwGeneric)) {
    t.form = TypeExpr::Form::Generic;
    t.path = {name("a name after `generic`")};
  } else if (accept(Tok::LeftParen)) {
    closers_.push_back(Tok::RightParen);
    inner = type();
    close(Tok::RightParen, first);
  } else if (at(Tok::Identifier)) {
    t.form = TypeExpr::Form::Named;
    t.path = path();
    if (t.path.size() == 1 && !type_instead_of(t.path[0].text).empty())
      foreign_types_.emplace_back(t.path[0].span, t.path[0].text);
  } else {
    unexpected("a type");
  }
  if (panicking_) return {};
  if (!inner) {
    t.span = from(first.begin);
    inner = add(std::move(t));
  }
  while (!panicking_ && at(Tok::LeftBracket)) inner = array_type(inner, first.begin);
  return panicking_ ? TypeHandle{} : inner;
}

// `T[c][r]` becomes `T[r, c]`: r rows of c numbers.
TypeHandle Parser::array_type(TypeHandle element, std::uint32_t begin) {
  const Token opener = take();
  closers_.push_back(Tok::RightBracket);
  TypeExpr t;
  t.form = TypeExpr::Form::Array;
  t.dims.push_back(dimension());
  while (accept(Tok::Comma)) {
    if (at(Tok::RightBracket)) unexpected("the size of a dimension");
    t.dims.push_back(dimension());
  }
  close(Tok::RightBracket, opener);
  if (panicking_) return {};
  t.element = element;
  t.span = from(begin);
  if (const TypeExpr& e = graph_[element]; e.form == TypeExpr::Form::Array) {
    t.dims.insert(t.dims.end(), e.dims.begin(), e.dims.end());
    t.element = e.element;
  }
  if (t.dims.size() > 2) {
    report(Diag::TooManyDimensions, t.span, t.dims.size());
    panic();
    return {};
  }
  return add(std::move(t));
}

TypeExpr::Dim Parser::dimension() {
  TypeExpr::Dim d;
  const Token first = peek();
  d.span = span(first);
  if (panicking_ || at(Tok::RightBracket)) return d;
  if (accept(Tok::IntegerLiteral)) {
    d.form = TypeExpr::Dim::Form::Integer;
    d.value = integer_value(text(first));
    if (d.value < 0 || d.value > INT32_MAX) {
      report(Diag::IntegerTooLarge, d.span, shortened(text(first)));
      d.value = 1;
    }
    return d;
  }
  if (accept(Tok::KwGeneric)) {
    d.form = TypeExpr::Dim::Form::Generic;
    d.path = {name("a name after `generic`")};
  } else if (at(Tok::Identifier)) {
    d.form = TypeExpr::Dim::Form::Named;
    d.path = path();
  } else {
    unexpected("an integer or a name as the size of an array");
  }
  d.span = from(first.begin);
  return d;
}

bool Parser::at_bare_formal() {
  const Tok next = peek(1).tok;
  return at(Tok::Identifier) &&
         (next == Tok::Comma || next == Tok::RightParen || next == Tok::Assign);
}

// `( [type] name [= value], ... )`. A bare name has its neighbour's type; the first has one.
std::vector<Formal> Parser::formals() {
  std::vector<Formal> list;
  const Token opener = peek();
  if (!expect(Tok::LeftParen)) return list;
  closers_.push_back(Tok::RightParen);
  TypeHandle current;
  bool more = !at(Tok::RightParen);
  while (more && !panicking_) {
    Formal f;
    if (!at_bare_formal()) {
      current = type();
    } else if (!current && list.empty()) {
      report(Diag::FormalType, span(peek()), shortened(text(peek())))
          .help(fmt::format("write its type before it, for example `real {}`",
                            shortened(text(peek()))));
    }
    f.type = current;
    f.name = name("a name for the formal");
    if (accept(Tok::Assign)) f.default_value = expr();
    if (!panicking_) list.push_back(std::move(f));
    more = accept(Tok::Comma);
  }
  close(Tok::RightParen, opener);
  return list;
}

}  // namespace mms::lang
