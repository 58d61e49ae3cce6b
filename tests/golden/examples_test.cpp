// SPDX-License-Identifier: Apache-2.0
// The examples of the error index: the wrong one gives that message and no other, the right one
// none. They may hold the directives `error` (without effect here) and `param`.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "tests/golden/expectations.h"

namespace mms::golden {
namespace {

/// Messages whose example is no text that a page can show, and where they are tested.
const std::map<std::string_view, std::string_view> kWithout = {
    {"E0100", "a hundred errors: flood() of corpus.cpp"},
    {"E0103", "bytes that are no text: errors/E0103_invalid_utf8.mms"},
    {"E0104", "a NUL byte: errors/E0104_nul_byte.mms"},
    {"E0160", "256 brackets: kNesting of corpus.cpp"},
    {"E0161", "1024 operators: deep_sum() of corpus.cpp"},
    {"E0162", "64 MiB: kSourceBytes of corpus.cpp"},
    {"W0408", "an option: `every message is provoked by a golden script`"},
    {"E0303", "a million operations: kNodes of corpus.cpp"},
    {"E0307", "4097 functions: kInstances of corpus.cpp"},
    {"E0313", "files that import each other: imports/circular.mms"},
    {"E0314", "two files: errors/E0314_ambiguous_import.mms"},
    {"E0315", "thousands of values: kSlots of corpus.cpp"},
    {"E0316", "750 constants: kExpressionDepth of corpus.cpp"},
};

Compiled compile_example(std::string_view text) {
  const auto source = lang::make_source("example", std::string(text));
  lang::LinkOptions options;
  options.params = read_expectations(*source).params;
  return compile(source, options);
}

TEST_CASE("the examples of the error index") {
  for (const lang::DiagInfo& row : lang::all_diagnostics()) {
    CAPTURE(row.code);
    CAPTURE(row.name);
    CHECK(row.wrong.empty() == kWithout.contains(row.code));
    CHECK(row.right.empty() == row.wrong.empty());
    if (row.wrong.empty()) continue;
    const Compiled wrong = compile_example(row.wrong);
    CHECK(!wrong.diagnostics.all().empty());
    for (const lang::Diagnostic& d : wrong.diagnostics.all())
      CHECK_MESSAGE(lang::info(d.id).code == row.code, lang::render(d));
    const Compiled right = compile_example(row.right);
    CHECK_MESSAGE(right.linked, right.text_of_errors());
    CHECK_MESSAGE(right.diagnostics.all().empty(), right.text_of_errors());
  }
}

}  // namespace
}  // namespace mms::golden
