// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// For tests of the parser: what it read as S-expressions, what it reported as `E0101@1:5-7`.

#include <string>

#include "lang/parser.h"

namespace mms::lang::test {

struct Parsed {
  Graph graph;
  Diagnostics diagnostics;
};

inline Parsed parse_text(std::string text) {
  Parsed p;
  p.graph = parse(make_source("test.mms", std::move(text)), p.diagnostics);
  return p;
}

/// `E0101@1:5-7 ...`: the code, the line, the first column and the column after the last.
inline std::string reported(const Diagnostics& d) {
  std::string out;
  for (const Diagnostic& one : d.all()) {
    const Position a = position_at(*one.span.source, one.span.begin);
    const Position b = position_at(*one.span.source, one.span.end);
    if (!out.empty()) out += ' ';
    out += fmt::format("{}@{}:{}-{}", info(one.id).code, a.line, a.column, b.column);
  }
  return out;
}
inline std::string reported(std::string text) {
  return reported(parse_text(std::move(text)).diagnostics);
}

inline std::string shape(const Path& path) {
  std::string out;
  for (const Name& n : path) out += (out.empty() ? "" : "::") + n.text;
  return out;
}

inline std::string shape(const Graph& g, TypeHandle h) {
  static constexpr const char* kBasic[] = {"logic",    "integer",  "real",  "complex",
                                           "spectrum", "material", "string"};
  if (!h) return "_";
  const TypeExpr& t = g[h];
  switch (t.form) {
    case TypeExpr::Form::Basic:
      return kBasic[static_cast<int>(t.basic)];
    case TypeExpr::Form::Generic:
      return "generic " + shape(t.path);
    case TypeExpr::Form::Named:
      return shape(t.path);
    case TypeExpr::Form::Array: {
      std::string dims;
      for (const TypeExpr::Dim& d : t.dims) {
        if (!dims.empty()) dims += ",";
        switch (d.form) {
          case TypeExpr::Dim::Form::Open:
            dims += "*";
            break;
          case TypeExpr::Dim::Form::Integer:
            dims += std::to_string(d.value);
            break;
          case TypeExpr::Dim::Form::Named:
            dims += shape(d.path);
            break;
          case TypeExpr::Dim::Form::Generic:
            dims += "generic " + shape(d.path);
            break;
        }
      }
      return shape(g, t.element) + "[" + dims + "]";
    }
    case TypeExpr::Form::Function: {
      std::string out;
      for (const TypeHandle f : t.formals) out += (out.empty() ? "" : ",") + shape(g, f);
      return "function(" + out + ")->" + shape(g, t.element);
    }
  }
  return "?";
}

inline std::string shape(const Graph& g, ExprHandle h) {
  if (!h) return "none";
  const Expr& e = g[h];
  const auto list = [&] {
    std::string out;
    for (const ExprHandle a : e.args) out += " " + shape(g, a);
    for (const Argument& a : e.arguments)
      out += " " + (a.name ? a.name->text + "=" : std::string()) + shape(g, a.value);
    return out;
  };
  switch (e.form) {
    case Expr::Form::Integer:
      return std::to_string(e.integer);
    case Expr::Form::Real:
      return fmt::format("{}r", e.real);
    case Expr::Form::Imaginary:
      return fmt::format("{}i", e.real);
    case Expr::Form::String:
      return "'" + e.rare->text + "'";
    case Expr::Form::Logic:
      return e.integer ? "true" : "false";
    case Expr::Form::Name:
      return shape(e.path);
    case Expr::Form::Variable:
      return "$" + shape(e.path);
    case Expr::Form::FunctionValue:
      return "#" + (e.path.empty() ? std::string(spelling(e.op)) : shape(e.path));
    case Expr::Form::Unary:
    case Expr::Form::Binary:
      return fmt::format("({}{})", spelling(e.op), list());
    case Expr::Form::Chain: {
      std::string out = "(chain " + shape(g, e.args[0]);
      for (std::size_t i = 0; i < e.rare->ops.size(); ++i)
        out += fmt::format(" {} {}", spelling(e.rare->ops[i]), shape(g, e.args[i + 1]));
      return out + ")";
    }
    case Expr::Form::Call:
      return "(call" + list() + ")";
    case Expr::Form::Convert:
      return fmt::format("(convert {}{})", static_cast<int>(e.basic), list());
    case Expr::Form::Index:
      return "(index" + list() + ")";
    case Expr::Form::Field:
      return "(field" + list() + " " + shape(e.path) + ")";
    case Expr::Form::Lambda: {
      std::string formals;
      for (const Formal& f : e.rare->formals)
        formals += (formals.empty() ? "" : ",") + shape(g, f.type) + " " + f.name.text;
      return "(lambda [" + formals + "]" + list() + ")";
    }
    case Expr::Form::Select:
      return "(select" + list() + ")";
    case Expr::Form::Array:
      return fmt::format("(array {}{})", e.rows, list());
    case Expr::Form::Error:
      return "error";
  }
  return "?";
}

/// The shape of one expression, or what was reported about it.
inline std::string expression(std::string text) {
  Diagnostics d;
  const Graph g = parse_expression(make_source("test.mms", std::move(text)), d);
  if (d.has_errors()) return reported(d);
  return shape(g, ExprHandle{static_cast<std::uint32_t>(g.exprs.size() - 1)});
}

/// The shape of a type, or what was reported about it.
inline std::string type(const std::string& text) {
  Diagnostics d;
  const Graph g = parse_signature(make_source("test.mms", text + " f()"), d);
  return d.has_errors() ? reported(d) : shape(g, g.functions.at(0).result);
}

}  // namespace mms::lang::test
