// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The rows of the library that random scripts call: read off the table, so that a new row is
/// called from the day it is there.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "stdlib/stdlib.h"

namespace mms::property {

/// A row by its signature. Types are those of the generator: Logic, Integer, Real, Complex, Vector
/// of three; '2' and '4' are vectors of that many reals, which arguments may be.
struct LibraryRow {
  std::string name;
  char result;
  std::string formals;
};

/// The generator's letter of a type as a signature spells it; 0 where it has none.
inline char letter_of(std::string_view type) {
  struct Row {
    std::string_view type;
    char letter;
  };
  constexpr Row kRows[] = {{"logic", 'L'},   {"integer", 'I'}, {"real", 'R'},   {"complex", 'C'},
                           {"real[3]", 'V'}, {"real[2]", '2'}, {"real[4]", '4'}};
  for (const Row& row : kRows)
    if (row.type == type) return row.letter;
  return 0;
}

/// Every row that is made of these types and whose result the generator has.
inline std::vector<LibraryRow> library_rows() {
  std::vector<LibraryRow> all;
  for (const vm::Builtin& b : stdlib::builtins()) {
    std::string_view s = b.signature;
    const std::size_t open = s.find('('), space = s.find(' ');
    LibraryRow row{
        std::string(s.substr(space + 1, open - space - 1)), letter_of(s.substr(0, space)), {}};
    s = s.substr(open + 1, s.rfind(')') - open - 1);
    char type = 0;
    while (!s.empty()) {
      std::string_view formal = s.substr(0, s.find(','));
      s.remove_prefix(std::min(s.size(), formal.size() + 1));
      while (formal.starts_with(' ')) formal.remove_prefix(1);
      if (const std::size_t end = formal.find(' '); end != formal.npos)
        type = letter_of(formal.substr(0, end));
      row.formals += type;
    }
    const bool known = row.formals.find('\0') == row.formals.npos && !row.formals.empty();
    if (known && std::string_view("LIRCV").find(row.result) != std::string_view::npos)
      all.push_back(std::move(row));
  }
  return all;
}

}  // namespace mms::property
