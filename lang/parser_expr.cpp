// SPDX-License-Identifier: Apache-2.0
// Expressions. Infix operators by precedence climbing: `infix(level)` takes everything that binds
// at least as tightly as `level`.

#include <algorithm>
#include <cmath>

#include "lang/parser_impl.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

enum Level : int { kOr = 1, kAnd, kNot, kEquality, kRelation, kSum, kProduct };

// A tree may be higher than brackets may nest: a sum of many terms leans to the left. What walks
// the tree after the parser recurses this deep.
constexpr int kTreeHeight = 4 * vm::limits::kNesting;

constexpr std::int64_t kLargestInteger = INT32_MAX;

struct Infix {
  Tok tok;
  Operator op;
  int level;
  bool habit = false;  // spelled so in other languages
};
constexpr Infix kInfix[] = {
    {Tok::KwOr, Operator::Or, kOr},
    {Tok::OrOr, Operator::Or, kOr, true},
    {Tok::KwAnd, Operator::And, kAnd},
    {Tok::AndAnd, Operator::And, kAnd, true},
    {Tok::Equal, Operator::Eq, kEquality},
    {Tok::NotEqual, Operator::Ne, kEquality},
    {Tok::Less, Operator::Lt, kRelation},
    {Tok::Greater, Operator::Gt, kRelation},
    {Tok::LessEqual, Operator::Le, kRelation},
    {Tok::GreaterEqual, Operator::Ge, kRelation},
    {Tok::Plus, Operator::Add, kSum},
    {Tok::Minus, Operator::Sub, kSum},
    {Tok::Star, Operator::Mul, kProduct},
    {Tok::Slash, Operator::Div, kProduct},
    {Tok::Percent, Operator::Mod, kProduct},
};

const Infix* find_infix(Tok tok) {
  for (const Infix& i : kInfix)
    if (i.tok == tok) return &i;
  return nullptr;
}

bool ends_operand(Tok tok) {
  return tok == Tok::Semicolon || tok == Tok::Comma || tok == Tok::RightParen ||
         tok == Tok::RightBracket || tok == Tok::KwIf || tok == Tok::KwOtherwise ||
         tok == Tok::KwEnd || tok == Tok::Eof;
}

bool is_literal(Tok tok) {
  return tok == Tok::IntegerLiteral || tok == Tok::RealLiteral || tok == Tok::ImaginaryLiteral ||
         tok == Tok::StringLiteral || tok == Tok::KwTrue || tok == Tok::KwFalse;
}

}  // namespace

std::string_view spelling(Operator op) {
  switch (op) {
    case Operator::Neg:
      return "-";
    case Operator::Not:
      return "not";
    case Operator::Pow:
      return "^";
    default:
      break;
  }
  for (const Infix& i : kInfix)
    if (i.op == op) return spelling(i.tok);
  return {};
}

ExprHandle Parser::add(Expr e, std::uint32_t begin) {
  e.span = from(begin);
  int height = 0;
  const auto below = [&](ExprHandle h) { height = std::max<int>(height, heights_[h.index]); };
  for (const ExprHandle h : e.args) below(h);
  for (const Argument& a : e.arguments) below(a.value);
  if (++height > kTreeHeight) {
    if (!stopped_) diagnostics_.add(Diag::ExpressionTooLong, e.span, kTreeHeight);
    stopped_ = panicking_ = true;
  }
  if (graph_.exprs.size() >= vm::limits::kNodes)
    too_long(e.span, vm::limits::kNodes, "expressions");
  graph_.exprs.push_back(std::move(e));
  heights_.push_back(static_cast<std::uint16_t>(height));
  return {static_cast<std::uint32_t>(graph_.exprs.size() - 1)};
}

ExprHandle Parser::binary(Operator op, ExprHandle a, ExprHandle b) {
  Expr e;
  e.form = Expr::Form::Binary;
  e.op = op;
  e.args = {a, b};
  return add(std::move(e), graph_[a].span.begin);
}

// Where an expression should be: reported, and a node that later stages pass over.
ExprHandle Parser::missing() {
  if (!panicking_) unexpected("an expression", Want::Expression);
  const ExprHandle h = add(Expr{}, peek().begin);
  graph_.exprs[h.index].span = span(peek());
  return h;
}

ExprHandle Parser::expr() {
  Nested nested(*this);
  if (!nested) return missing();
  return at(Tok::KwFunction) ? lambda() : infix(kOr);
}

ExprHandle Parser::lambda() {
  Expr e;
  e.form = Expr::Form::Lambda;
  const std::uint32_t begin = take().begin;
  const Token opener = peek();
  if (!expect(Tok::LeftParen)) return missing();
  closers_.push_back(Tok::RightParen);
  bool more = !at(Tok::RightParen);
  while (more && !panicking_) {
    Formal f;
    if (!at_bare_formal()) f.type = type();
    f.name = name("a name for the formal");
    if (!panicking_) e.rare.make().formals.push_back(std::move(f));
    more = accept(Tok::Comma);
  }
  close(Tok::RightParen, opener);
  expect(Tok::Arrow);
  e.args = {expr()};
  return add(std::move(e), begin);
}

ExprHandle Parser::infix(int level) {
  ExprHandle left = level <= kNot && (at(Tok::KwNot) || at(Tok::Bang)) ? negation() : unary();
  while (!panicking_) {
    const Infix* const i = find_infix(peek().tok);
    if (!i || i->level < level) break;
    const Span sign = span(peek());
    if (i->level == kEquality || i->level == kRelation) {
      left = comparisons(left, i->level);
      continue;
    }
    if (i->habit)
      report(Diag::LogicSign, sign, spelling(i->op), spelling(i->tok))
          .help(fmt::format("write `{}`", spelling(i->op)));
    take();
    if (i->op == Operator::Mod && ends_operand(peek().tok)) return percentage(left, sign);
    const ExprHandle right = infix(i->level + 1);
    left = binary(i->op, left, right);
  }
  return left;
}

// One comparison, or a chain of them: `0 < x < 1`.
ExprHandle Parser::comparisons(ExprHandle first, int level) {
  Expr e;
  e.form = Expr::Form::Chain;
  e.args = {first};
  for (const Infix* i = find_infix(peek().tok); i && i->level == level && !panicking_;
       i = find_infix(peek().tok)) {
    if (e.rare->ops.size() == kTreeHeight) {
      if (!stopped_)
        diagnostics_.add(Diag::ExpressionTooLong, from(graph_[first].span.begin), kTreeHeight);
      stopped_ = panicking_ = true;
      return first;
    }
    take();
    e.rare.make().ops.push_back(i->op);
    e.args.push_back(infix(level + 1));
  }
  if (e.rare->ops.size() == 1) return binary(e.rare->ops[0], e.args[0], e.args[1]);
  return add(std::move(e), graph_[first].span.begin);
}

ExprHandle Parser::percentage(ExprHandle value, Span sign) {
  const Expr& e = graph_[value];
  const bool number = e.form == Expr::Form::Integer || e.form == Expr::Form::Real;
  const double percent = e.form == Expr::Form::Integer ? static_cast<double>(e.integer) : e.real;
  Diagnostic& d = report(Diag::Percent, sign);
  if (number) d.help(fmt::format("write `{}`", percent / 100));
  return value;
}

ExprHandle Parser::negation() {
  Nested nested(*this);
  if (!nested) return missing();
  const Token t = peek();
  if (t.tok == Tok::Bang) report(Diag::LogicSign, span(t), "not", "!").help("write `not`");
  take();
  Expr e;
  e.form = Expr::Form::Unary;
  e.op = Operator::Not;
  e.args = {infix(kNot)};
  return add(std::move(e), t.begin);
}

ExprHandle Parser::unary() {
  if (at(Tok::Bang)) return negation();
  return at(Tok::Minus) ? minus(&Parser::unary) : power();
}

// `-` and its operand. Only here may 2^31 be written.
ExprHandle Parser::minus(ExprHandle (Parser::*operand)()) {
  Nested nested(*this);
  if (!nested) return missing();
  const Token t = take();
  Expr e;
  e.form = Expr::Form::Unary;
  e.op = Operator::Neg;
  const bool literal = at(Tok::IntegerLiteral) && peek(1).tok != Tok::Caret;
  e.args = {literal ? integer(kLargestInteger + 1) : (this->*operand)()};
  return add(std::move(e), t.begin);
}

ExprHandle Parser::power() {
  const ExprHandle base = is_literal(peek().tok) ? literal() : postfix();
  if (panicking_ || (!at(Tok::Caret) && !at(Tok::StarStar))) return base;
  const Span sign = span(peek());
  if (at(Tok::StarStar)) report(Diag::PowerSign, sign).help("write `^`");
  take();
  const ExprHandle right = exponent();
  return binary(Operator::Pow, base, right);
}

ExprHandle Parser::exponent() {
  Nested nested(*this);
  if (!nested) return missing();
  return at(Tok::Minus) ? minus(&Parser::exponent) : power();
}

ExprHandle Parser::literal() {
  if (at(Tok::IntegerLiteral)) return integer(kLargestInteger);
  const Token t = take();
  Expr e;
  switch (t.tok) {
    case Tok::StringLiteral:
      e.form = Expr::Form::String;
      e.rare.make().text = string_value(text(t));
      break;
    case Tok::KwTrue:
    case Tok::KwFalse:
      e.form = Expr::Form::Logic;
      e.integer = t.tok == Tok::KwTrue ? 1 : 0;
      break;
    default:
      e.form = t.tok == Tok::ImaginaryLiteral ? Expr::Form::Imaginary : Expr::Form::Real;
      e.real = real_value(text(t));
      if (std::isinf(e.real)) report(Diag::RealTooLarge, span(t), shortened(text(t)));
  }
  return add(std::move(e), t.begin);
}

ExprHandle Parser::integer(std::int64_t largest) {
  const Token t = take();
  Expr e;
  e.form = Expr::Form::Integer;
  e.integer = integer_value(text(t));
  if (e.integer < 0 || e.integer > largest) {
    report(Diag::IntegerTooLarge, span(t), shortened(text(t)))
        .help("a real number has a point: `3000000000.0`");
    e.integer = 0;
  }
  return add(std::move(e), t.begin);
}

ExprHandle Parser::postfix() {
  ExprHandle e = term();
  while (!panicking_) {
    if (at(Tok::LeftParen)) {
      Expr call;
      call.form = Expr::Form::Call;
      call.args = {e};
      call.arguments = arguments();
      e = add(std::move(call), graph_[e].span.begin);
    } else if (at(Tok::LeftBracket)) {
      e = index(e);
    } else if (at(Tok::Dot)) {
      e = field(e);
    } else {
      break;
    }
  }
  return e;
}

ExprHandle Parser::field(ExprHandle of) {
  take();
  Expr e;
  e.form = Expr::Form::Field;
  e.args = {of};
  e.path = {name("a name after `.`")};
  return add(std::move(e), graph_[of].span.begin);
}

ExprHandle Parser::index(ExprHandle what) {
  const Token opener = take();
  closers_.push_back(Tok::RightBracket);
  Expr e;
  e.form = Expr::Form::Index;
  e.args = {what, expr()};
  if (accept(Tok::Comma)) e.args.push_back(expr());
  close(Tok::RightBracket, opener);
  return add(std::move(e), graph_[what].span.begin);
}

std::vector<Argument> Parser::arguments() {
  std::vector<Argument> list;
  const Token opener = take();
  closers_.push_back(Tok::RightParen);
  bool more = !at(Tok::RightParen);
  while (more && !panicking_) {
    Argument a;
    if (peek(1).tok == Tok::Assign && (at(Tok::Identifier) || is_keyword(peek().tok))) {
      a.name = name("the name of a formal");
      accept(Tok::Assign);
    }
    a.value = expr();
    list.push_back(std::move(a));
    more = accept(Tok::Comma);
  }
  close(Tok::RightParen, opener);
  return list;
}

ExprHandle Parser::term() {
  const Token t = peek();
  Expr e;
  switch (t.tok) {
    case Tok::Error:
      take();
      return add(std::move(e), t.begin);
    case Tok::LeftParen:
      return parenthesised();
    case Tok::LeftBracket:
      return array();
    case Tok::Hash:
      return function_value();
    case Tok::KwSelect:
      return select();
    case Tok::Identifier:
      e.form = Expr::Form::Name;
      e.path = path();
      return add(std::move(e), t.begin);
    case Tok::Variable:
      take();
      e.form = Expr::Form::Variable;
      e.path = {{std::string(text(t).substr(1)), span(t)}};
      return add(std::move(e), t.begin);
    default:
      break;
  }
  return basic_type(t.tok) && peek(1).tok == Tok::LeftParen ? conversion() : missing();
}

ExprHandle Parser::parenthesised() {
  const Token opener = take();
  closers_.push_back(Tok::RightParen);
  const ExprHandle e = condition();
  close(Tok::RightParen, opener);
  graph_.exprs[e.index].parenthesised = true;
  graph_.exprs[e.index].span = from(opener.begin);
  return e;
}

// An expression; `=` in it was meant as `==`.
ExprHandle Parser::condition() {
  const ExprHandle left = expr();
  if (panicking_ || !at(Tok::Assign)) return left;
  const Span sign = span(peek());
  report(Diag::AssignmentInCondition, sign).help("write `==` to compare");
  take();
  const ExprHandle right = expr();
  return binary(Operator::Eq, left, right);
}

ExprHandle Parser::function_value() {
  const Token hash = take();
  Expr e;
  e.form = Expr::Form::FunctionValue;
  const Infix* const i = find_infix(peek().tok);
  if (at(Tok::Identifier)) {
    e.path = path();
  } else if (at(Tok::Caret)) {
    e.op = Operator::Pow;
    take();
  } else if (i && !i->habit) {
    e.op = i->op;
    take();
  } else if (!panicking_) {
    unexpected("a function's name or an operator after `#`", Want::Name);
  }
  return add(std::move(e), hash.begin);
}

ExprHandle Parser::conversion() {
  const Token t = take();
  Expr e;
  e.form = Expr::Form::Convert;
  e.basic = *basic_type(t.tok);
  e.arguments = arguments();
  return add(std::move(e), t.begin);
}

ExprHandle Parser::array() {
  const Token opener = take();
  closers_.push_back(Tok::RightBracket);
  ++arrays_;
  Expr e;
  e.form = Expr::Form::Array;
  e.rows = 0;
  std::size_t columns = 0;
  do {
    const std::size_t row = e.args.size();
    const std::uint32_t begin = peek().begin;
    do e.args.push_back(expr());
    while (accept(Tok::Comma));
    if (++e.rows == 1) columns = e.args.size();
    if (!panicking_ && e.args.size() - row != columns)
      report(Diag::RaggedRows, from(begin), columns, e.args.size() - row);
  } while (accept(Tok::Semicolon));
  close(Tok::RightBracket, opener);
  if (!panicking_) --arrays_;
  if (e.args.size() != columns * e.rows) e.rows = 1;
  return add(std::move(e), opener.begin);
}

}  // namespace mms::lang
