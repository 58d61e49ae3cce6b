/* SPDX-License-Identifier: Apache-2.0 */
/* The grammar of the language: LALR(1) without conflicts and without precedence declarations.
   `bison docs/grammar.y` checks that; the parser itself is written by hand (lang/parser*.cpp). What
   the words mean is in docs/language.md.

   Comments (`// ...` to the end of the line, `/` `* ... *` `/` not nested) and white space separate
   tokens and mean nothing else; `/// ...` before an item is its documentation.

   IDENTIFIER  a letter or _, then letters, digits and _; no keyword
   INTEGER     digits
   REAL        digits "." digits, or either with an exponent; or a number with one of the units
               nm um mm cm m km deg rad K glued to it
   IMAGINARY   a number with the suffix i glued to it
   STRING      "..." on one line; \" \\ \n \t
   VARIABLE    $ and a name, without a space */

%token IDENTIFIER INTEGER REAL IMAGINARY STRING VARIABLE
%token ALIAS "alias" AND "and" AS "as" COMPLEX "complex" CONST "const" END "end" ENUM "enum"
%token FALSE "false" FUNCTION "function" GENERIC "generic" IF "if" IMPORT "import" IN "in"
%token INTEGER_TYPE "integer" LOGIC "logic" MATERIAL "material" NOT "not" OR "or"
%token OTHERWISE "otherwise" PARAM "param" REAL_TYPE "real" RETURN "return" SELECT "select"
%token SPECTRUM "spectrum" STRING_TYPE "string" STRUCT "struct" SURFACE "surface" TRUE "true"
%token TYPEID "typeid" VOLUME "volume"
%token EQ "==" NE "!=" LE "<=" GE ">=" ARROW "->" SCOPE "::"

%start program
%%

program: %empty | program item;

item: "import" STRING ';'
    | "import" STRING "as" IDENTIFIER ';'
    | param
    | const
    | typeid
    | function
    | descriptor
    | outer_name "alias" outer_name_or_path ';'
    | ';';

outer_name: IDENTIFIER | STRING;
outer_name_or_path: name | STRING;

param: "param" type IDENTIFIER '=' expr range metas ';';
range: %empty | "in" '[' expr ',' expr ']';
metas: %empty | metas ',' IDENTIFIER '=' expr;

const: "const" IDENTIFIER '=' expr ';'
     | "const" type IDENTIFIER '=' expr ';';

typeid: IDENTIFIER "typeid" type ';'
      | IDENTIFIER "typeid" "enum" identifiers ';'
      | IDENTIFIER "typeid" "struct" fields "end";
/* A `;` after that `end` is an empty item, or an empty definition. */
fields: field | fields field;
field: type identifiers ';';
identifiers: IDENTIFIER | identifiers ',' IDENTIFIER;

function: type IDENTIFIER '(' formals ')' body "return" expr ';'
        | type IDENTIFIER '(' formals ')' '=' expr ';';

descriptor: "surface" outer_name body "end"
          | "volume" outer_name body "end";

body: %empty | body definition;
definition: function
          | typeid
          | const
          | IDENTIFIER '=' expr ';'
          | type IDENTIFIER '=' expr ';'
          | ';';

/* The first formal has a type; a bare name has that of its neighbour. */
formals: %empty | typed_formal | typed_formal more_formals;
more_formals: ',' formal | more_formals ',' formal;
formal: typed_formal | IDENTIFIER default;
typed_formal: type IDENTIFIER default;
default: %empty | '=' expr;

/* Formals of a lambda may go without a type altogether. */
lambda_formals: %empty | lambda_formal_list;
lambda_formal_list: lambda_formal | lambda_formal_list ',' lambda_formal;
lambda_formal: IDENTIFIER | type IDENTIFIER;

type: simple_type | "function" '(' types ')' "->" type;
types: %empty | type_list;
type_list: type | type_list ',' type;
simple_type: basic
           | "generic" IDENTIFIER
           | name
           | '(' type ')'
           | simple_type '[' ']'
           | simple_type '[' dimension ']'
           | simple_type '[' dimension ',' dimension ']';
dimension: INTEGER | name | "generic" IDENTIFIER;
basic: "logic" | "integer" | "real" | "complex" | "spectrum" | "material" | "string";
name: IDENTIFIER | name "::" IDENTIFIER;

expr: or | "function" '(' lambda_formals ')' "->" expr;
or: and | or "or" and;
and: not | and "and" not;
not: equality | "not" not;
equality: relation | equality "==" relation | equality "!=" relation;
relation: sum | relation '<' sum | relation '>' sum | relation "<=" sum | relation ">=" sum;
sum: product | sum '+' product | sum '-' product;
product: unary | product '*' unary | product '/' unary | product '%' unary;
unary: power | '-' unary;
power: base | base '^' exponent;
exponent: power | '-' exponent;
base: literal | postfix;
literal: INTEGER | REAL | IMAGINARY | STRING | "true" | "false";

postfix: term
       | postfix '(' arguments ')'
       | postfix '[' expr ']'
       | postfix '[' expr ',' expr ']'
       | postfix '.' IDENTIFIER;
arguments: %empty | argument_list;
argument_list: argument | argument_list ',' argument;
argument: expr | IDENTIFIER '=' expr;

term: '(' expr ')'
    | name
    | VARIABLE
    | '#' name
    | '#' operator
    | basic '(' arguments ')'
    | "select" arms expr "otherwise" last_semicolon "end"
    | '[' rows ']';
arms: %empty | arms expr ',' "if" expr ';';
last_semicolon: %empty | ';';
rows: row | rows ';' row;
row: expr | row ',' expr;
operator: '+' | '-' | '*' | '/' | '%' | '^' | "and" | "or" | "==" | "!=" | '<' | '>' | "<=" | ">=";

%%
