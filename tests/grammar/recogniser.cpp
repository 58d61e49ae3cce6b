// SPDX-License-Identifier: Apache-2.0
#include "tests/grammar/recogniser.h"

#include <cstdarg>
#include <cstring>
#include <fstream>
#include <map>

#include "lang/lexer.h"
#include "tests/grammar/bison.h"

extern "C" {
#include "grammar.h"  // bison's
}

namespace mms::grammar {
namespace {

using lang::Tok;

/// What bison calls a token. Its names of single characters are the characters.
int number_of(Tok tok) {
  static const std::map<std::string_view, int> kWords = {{"alias", ALIAS},
                                                         {"and", AND},
                                                         {"as", AS},
                                                         {"complex", COMPLEX},
                                                         {"const", CONST},
                                                         {"end", END},
                                                         {"enum", ENUM},
                                                         {"false", FALSE},
                                                         {"function", FUNCTION},
                                                         {"generic", GENERIC},
                                                         {"if", IF},
                                                         {"import", IMPORT},
                                                         {"in", IN},
                                                         {"integer", INTEGER_TYPE},
                                                         {"logic", LOGIC},
                                                         {"material", MATERIAL},
                                                         {"not", NOT},
                                                         {"or", OR},
                                                         {"otherwise", OTHERWISE},
                                                         {"param", PARAM},
                                                         {"real", REAL_TYPE},
                                                         {"return", RETURN},
                                                         {"select", SELECT},
                                                         {"spectrum", SPECTRUM},
                                                         {"string", STRING_TYPE},
                                                         {"struct", STRUCT},
                                                         {"surface", SURFACE},
                                                         {"true", TRUE},
                                                         {"typeid", TYPEID},
                                                         {"volume", VOLUME},
                                                         {"==", EQ},
                                                         {"!=", NE},
                                                         {"<=", LE},
                                                         {">=", GE},
                                                         {"->", ARROW},
                                                         {"::", SCOPE}};
  switch (tok) {
    case Tok::Eof:
      return YYEOF;
    case Tok::Identifier:
      return IDENTIFIER;
    case Tok::IntegerLiteral:
      return INTEGER;
    case Tok::RealLiteral:
      return REAL;
    case Tok::ImaginaryLiteral:
      return IMAGINARY;
    case Tok::StringLiteral:
      return STRING;
    case Tok::Variable:
      return VARIABLE;
    default:
      break;
  }
  const std::string_view word = lang::spelling(tok);
  if (const auto it = kWords.find(word); it != kWords.end()) return it->second;
  // `{`, `&&` and their like are tokens only so that the parser can speak of them.
  const bool sign = word.size() == 1 && std::strchr(";,()[].=<>+-*/%^#", word[0]);
  return sign ? int{word[0]} : int{YYUNDEF};
}

/// What yylex and the trace work on: bison's parser takes no arguments.
struct State {
  lang::Lexer* lexer = nullptr;
  std::set<int>* rules = nullptr;
};
State state;

}  // namespace

extern "C" {

int yylex(void) { return number_of(state.lexer->next().tok); }
void yyerror(const char*) {}

// Of all that bison traces, the reductions: `Reducing stack by rule 12 (line 34):`.
int mms_grammar_trace(void*, const char* format, ...) {
  if (std::strncmp(format, "Reducing stack by rule %d", 25) != 0 || !state.rules) return 0;
  va_list arguments;
  va_start(arguments, format);
  state.rules->insert(va_arg(arguments, int));
  va_end(arguments);
  return 0;
}

}  // extern "C"

Recognition recognise(const lang::SourcePtr& source, Rules rules) {
  Recognition result;
  lang::Diagnostics diagnostics;
  lang::Lexer lexer(*source, diagnostics);
  state = {&lexer, rules == Rules::Noted ? &result.rules : nullptr};
  yydebug = rules == Rules::Noted;
  result.accepted = yyparse() == 0 && diagnostics.all().empty();
  state = {};
  return result;
}

// In the report: `    1 program: %empty`, `    2        | program item`.
std::vector<std::string> all_rules() {
  std::ifstream in(MMS_GRAMMAR_REPORT);
  std::vector<std::string> all;
  std::string left;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "Grammar") inside = true;
    if (line.starts_with("Terminals")) break;
    const std::size_t digit = line.find_first_of("0123456789");
    if (!inside || digit == line.npos || line.find_first_not_of(' ') != digit) continue;
    std::size_t at = line.find(' ', digit);
    at = line.find_first_not_of(' ', at);
    const std::size_t mark = line.find_first_of(line[at] == '|' ? "|" : ":", at);
    if (line[at] != '|') left = line.substr(at, mark - at);
    all.push_back(left + ":" + line.substr(mark + 1));
  }
  return all;
}

}  // namespace mms::grammar
