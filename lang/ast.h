// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The syntax tree of one source: a `Graph` in the thesis' words. Syntax only: names are not
/// resolved, nothing has a type. Nodes live in arenas and point to each other by index.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/seldom.h"
#include "base/short_list.h"
#include "lang/source.h"

namespace mms::lang {

/// Index of a `T` in its arena; the default is none.
template <class T>
struct Handle {
  std::uint32_t index = UINT32_MAX;
  explicit operator bool() const { return index != UINT32_MAX; }
  friend bool operator==(Handle, Handle) = default;
};

struct Name {  ///< an identifier, and where it stands
  std::string text;
  Span span;
};
using Path = std::vector<Name>;  ///< `a::b::c`; never empty where a name is required

struct Expr;
struct TypeExpr;
struct Function;
using ExprHandle = Handle<Expr>;
using TypeHandle = Handle<TypeExpr>;
using FunctionHandle = Handle<Function>;

enum class BasicType : std::uint8_t { Logic, Integer, Real, Complex, Spectrum, Material, String };

struct TypeExpr {
  enum class Form : std::uint8_t { Basic, Generic, Named, Array, Function };
  Form form = Form::Basic;
  Span span;
  BasicType basic = BasicType::Real;  ///< Basic
  Path path;                          ///< Named; Generic has its one name here

  /// One dimension of an array.
  struct Dim {
    enum class Form : std::uint8_t { Open, Integer, Named, Generic };  // [] [3] [n] [generic n]
    Form form = Form::Open;
    std::int64_t value = 0;  ///< Integer
    Path path;               ///< Named; Generic has its one name here
    Span span;
  };
  std::vector<Dim> dims;            ///< Array: one or two. `T[c][r]` has been turned to `T[r,c]`
  TypeHandle element;               ///< Array: the element; Function: the result
  std::vector<TypeHandle> formals;  ///< Function
};

enum class Operator : std::uint8_t {
  Add,
  Sub,
  Mul,
  Div,
  Mod,
  Pow,
  Neg,
  Not,
  And,
  Or,
  Eq,
  Ne,
  Lt,
  Gt,
  Le,
  Ge
};
std::string_view spelling(Operator op);  ///< `+`, `and`, ...

struct Formal {
  TypeHandle type;  ///< none in an untyped lambda formal; a bare name has its neighbour's
  Name name;
  ExprHandle default_value;  ///< none where there is no default
};

struct Argument {
  std::optional<Name> name;  ///< `name = value`
  ExprHandle value;
};

struct Expr {
  enum class Form : std::uint8_t {
    Integer,        ///< integer
    Real,           ///< real, SI suffix applied
    Imaginary,      ///< real: the imaginary part
    String,         ///< text, escapes applied
    Logic,          ///< integer: 0 or 1
    Name,           ///< path
    Variable,       ///< path[0]: `$name` without the `$`
    FunctionValue,  ///< `#path`, or `#op` when path is empty
    Unary,          ///< op (Neg, Not), args[0]
    Binary,         ///< op, args[0], args[1]
    Chain,          ///< args[0] ops[0] args[1] ops[1] args[2] ...: two or more comparisons
    Call,           ///< args[0] is what is called; arguments
    Convert,        ///< `real(x)`: basic, arguments
    Index,          ///< args[0] [ args[1] ( , args[2] ) ]
    Field,          ///< args[0] . path[0]
    Lambda,         ///< formals, args[0] is the body
    Select,         ///< args: value, condition, value, condition, ..., otherwise
    Array,          ///< args: elements row by row; rows
    Error           ///< where a syntax error was reported
  };
  Form form = Form::Error;
  Operator op = Operator::Add;
  BasicType basic = BasicType::Real;
  bool parenthesised = false;
  std::uint32_t rows = 1;  ///< Array
  Span span;               ///< all of it
  union {
    std::int64_t integer = 0;
    double real;
  };
  Path path;
  ShortList<ExprHandle, 2> args;
  std::vector<Argument> arguments;

  /// What few expressions have: most of a script's memory is expressions.
  struct Rare {
    std::string text;
    std::vector<Operator> ops;
    std::vector<Formal> formals;
  };
  Seldom<Rare> rare;
};

/// `name = value;`, with or without a type, in a body.
struct Assignment {
  TypeHandle type;  ///< none where inferred
  Name name;
  ExprHandle value;
  std::string doc;
  Span span;
};

/// `const [type] name = value;`
struct Constant {
  TypeHandle type;
  Name name;
  ExprHandle value;
  std::string doc;
  Span span;
};

/// `name typeid ...;`
struct TypeDefinition {
  enum class Form : std::uint8_t { Alias, Enum, Struct };
  struct Field {
    TypeHandle type;
    Name name;
  };
  Form form = Form::Alias;
  Name name;
  TypeHandle type;                ///< Alias
  std::vector<Name> enumerators;  ///< Enum
  std::vector<Field> fields;      ///< Struct
  std::string doc;
  Span span;
};

/// One thing of a body or of the top level, in source order.
struct Item {
  enum class Form : std::uint8_t { Assignment, Constant, Type, Function };
  Form form;
  std::uint32_t index;  ///< in the body's vector of that form
};

struct Body {
  std::vector<Assignment> assignments;
  std::vector<Constant> constants;
  std::vector<TypeDefinition> types;
  std::vector<FunctionHandle> functions;
  std::vector<Item> items;  ///< all of the above in order
};

struct Function {
  TypeHandle result;
  Name name;
  std::vector<Formal> formals;
  Body body;         ///< empty in the one-line form
  ExprHandle value;  ///< what is returned; none in a signature
  std::string doc;
  Span span;    ///< the whole definition
  Span header;  ///< result type to closing parenthesis
};

struct Descriptor {
  enum class Form : std::uint8_t { Surface, Volume };
  Form form;
  Name name;
  Body body;
  std::string doc;
  Span span;
};

struct Param {
  TypeHandle type;
  Name name;
  ExprHandle value;
  ExprHandle lower, upper;  ///< `in [lower, upper]`, both or none
  struct Meta {
    Name key;  ///< label, unit, page, ...
    ExprHandle value;
  };
  std::vector<Meta> meta;
  std::string doc;
  Span span;
};

struct Import {
  std::string file;
  std::optional<Name> as;
  Span span;
};

struct Alias {
  Name outside;  ///< the name seen from outside
  Path inside;   ///< a name, or one element if it was a string
  Span span;
};

/// The syntax of one source. Nodes are reached through its arenas.
struct Graph {
  SourcePtr source;
  std::vector<Expr> exprs;
  std::vector<TypeExpr> types;
  std::vector<Function> functions;

  std::vector<Import> imports;
  std::vector<Alias> aliases;
  std::vector<Param> params;
  std::vector<Constant> constants;
  std::vector<TypeDefinition> type_definitions;
  std::vector<FunctionHandle> top_functions;
  std::vector<Descriptor> descriptors;

  const Expr& operator[](ExprHandle h) const { return exprs[h.index]; }
  const TypeExpr& operator[](TypeHandle h) const { return types[h.index]; }
  const Function& operator[](FunctionHandle h) const { return functions[h.index]; }
};

}  // namespace mms::lang
