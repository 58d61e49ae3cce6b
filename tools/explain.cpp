// SPDX-License-Identifier: Apache-2.0
// mms explain: the page of the error index about one message.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

Exit explain(std::string code) {
  std::string upper = code;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::vector<std::string> codes;
  for (const lang::DiagInfo& row : lang::all_diagnostics()) {
    if (row.code == upper || row.name == code) {
      fmt::print("{}", lang::page(row));
      return Exit::Ok;
    }
    codes.emplace_back(row.code);
  }
  const std::string near = lang::nearest(upper, codes);
  print_error({"mms explain", fmt::format("no message has the code `{}`", code),
               near.empty() ? "codes look like E0203; docs/errors.md lists them"
                            : fmt::format("did you mean `{}`? docs/errors.md lists all", near)});
  return Exit::Usage;
}

}  // namespace

Verb explain_verb() {
  auto code = std::make_shared<std::string>();
  Verb verb{
      "explain", "Explain a message by its code", "Examples:\n  mms explain E0203", {}, [code] {
        return explain(*code);
      }};
  verb.add({"CODE", code.get(), "", "The code in brackets, as in error[E0203]", {}, true});
  return verb;
}

}  // namespace mms::tools
