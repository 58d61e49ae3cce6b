// SPDX-License-Identifier: Apache-2.0
// `select`: the one expression with statements' punctuation, and so with its own recovery.

#include "lang/parser_impl.h"

namespace mms::lang {

ExprHandle Parser::select() {
  const Token opener = take();
  Expr e;
  e.form = Expr::Form::Select;
  // Inside, errors are recovered arm by arm, and `;` belongs to this `select`.
  const int arrays = std::exchange(arrays_, 0);
  const bool failed = std::exchange(arm_failed_, false);
  while (select_arm(e, opener)) {
  }
  arrays_ = arrays;
  arm_failed_ = failed;
  end_select(opener);
  return add(std::move(e), opener.begin);
}

// One arm: `value, if condition;` or, as the last, `value otherwise [;]`. True if more may follow.
bool Parser::select_arm(Expr& e, const Token& opener) {
  const bool unfinished = at(Tok::Identifier, Tok::Assign) || at(Tok::Eof);
  if (at(Tok::KwEnd) || unfinished) {
    if (at(Tok::KwEnd) && !arm_failed_)
      report(Diag::MissingOtherwise, span(peek()))
          .labelled("`value otherwise` is missing before this")
          .note(span(opener), "the `select` begins here");
    e.args.push_back(add(Expr{}, peek().begin));
    return false;
  }
  const bool habit = at(Tok::Identifier) && text(peek()) == "else" && peek(1).tok != Tok::KwIf;
  if (habit) {
    report(Diag::ElseInSelect, span(peek())).help("write the last value as `value otherwise`");
    take();
  }
  e.args.push_back(expr());
  if (at(Tok::Comma) || at(Tok::KwIf)) return condition_of_arm(e);
  if (accept(Tok::KwOtherwise) || (habit && !panicking_)) {
    accept(Tok::Semicolon);
    return false;
  }
  if (!panicking_ && at(Tok::Semicolon, Tok::KwEnd)) {
    report(Diag::MissingOtherwise, after_previous())
        .labelled("`otherwise` is missing here")
        .note(span(opener), "the `select` begins here");
    take();
    return false;
  }
  if (!panicking_) unexpected("`, if` or `otherwise`");
  return condition_of_arm(e);
}

// `, if condition;` after a value, or what is left of an arm that failed.
bool Parser::condition_of_arm(Expr& e) {
  if (!panicking_ && at(Tok::KwIf)) {
    report(Diag::UnexpectedToken, span(peek()), "`,` before `if`", "`if`");
    take();
    e.args.push_back(condition());
  } else {
    accept(Tok::Comma);
    expect(Tok::KwIf);
    e.args.push_back(condition());
  }
  // A forgotten `;` between two arms: the next one stands on its own line.
  if (!panicking_ && !at(Tok::Semicolon) && on_new_line())
    report(Diag::MissingSemicolon, after_previous()).labelled("`;` is missing here");
  else
    expect(Tok::Semicolon);
  if (!panicking_) return true;
  arm_failed_ = true;
  skip_arm();
  panicking_ = stopped_;
  arrays_ = 0;
  if (!panicking_ && (at(Tok::KwEnd) || !statement_ends())) return true;
  e.args.push_back(add(Expr{}, peek().begin));
  return false;
}

void Parser::end_select(const Token& opener) {
  if (panicking_ || accept(Tok::KwEnd)) return;
  report(Diag::MissingEnd, after_previous(), "the `select`")
      .labelled("`end` is missing here")
      .note(span(opener), "the `select` begins here");
  const Tok tok = peek().tok;
  const bool goes_on = tok == Tok::Semicolon || tok == Tok::Comma || tok == Tok::RightParen ||
                       tok == Tok::RightBracket || starts_item();
  if (!goes_on) panic();
}

}  // namespace mms::lang
