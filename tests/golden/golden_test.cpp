// SPDX-License-Identifier: Apache-2.0
// Runs every script under tests/golden: one idea each, its expectations beside the lines they
// concern. The directives, each in a `//` comment:
//
//   // expect: V          on the line of a top-level function without formals, or of a const: its
//                         value at the point of api::fill_defaults. V is a number, true, false, a
//                         list of all its scalars [a, b, c] (complex: real and imaginary part), or
//                         one number for a spectrum that is the same at every wavelength.
//   // expect~T: V        the same with relative tolerance T (else 1e-6 for reals, 0 for integers)
//   // fault: C line N    likewise: a run gives lanes up, with that cause, at that line
//   // expect-output: FORM NAME OUTPUT [at variable=(a,b,c) ...] = V
//                         an output of a descriptor. A material is written as its tree:
//                         mix(matte(0.5), mirror(1), 0.2), all arguments by position.
//   // expect-info: FORM NAME OUTPUT = constant | varying [spectral] [reads $a $b ...]
//   // check-gradient: FORM NAME     the derived gradient agrees with central differences
//   //   ^^^^ error E0203[: text]    a message about the line above, at just those columns
//   //   vvvv warning W0401[: text]  a message about the line below
//   // error E0311[: text]           a message without a place in this file
//   // param: name=expression        links with that --param
//   // near: T            bound of |float - double| / max(1, |double|), instead of kNear
//   // known-issue: text  in the first line: the script fails, and must be unmarked when it passes
//
// A message that is not expected fails, and so does an expected one that is not given. `text` is a
// part of the message, its label, or its help. Whatever links is run as it comes from O0, O1 and
// O2, with one lane, an odd number and a whole batch, on both builds of the machine: floats agree
// bit for bit. The double machine's results lie near.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/golden/expectations.h"

namespace mms::golden {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(MMS_SOURCE_DIR) / "tests" / "golden";

std::vector<fs::path> scripts() {
  std::vector<fs::path> all;
  for (const auto& e : fs::recursive_directory_iterator(kFolder)) {
    // `parts` folders hold what the scripts import.
    if (e.path().extension() == ".mms" && e.path().parent_path().filename() != "parts")
      all.push_back(e.path());
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string name_of(const fs::path& p) { return fs::relative(p, kFolder).generic_string(); }

TEST_CASE("golden scripts") {
  for (const fs::path& path : scripts()) {
    SUBCASE(name_of(path).c_str()) {
      const auto source = api::read_source(path.string());
      REQUIRE(source);
      const Outcome outcome = examine(*source);
      std::string all;
      for (const std::string& f : outcome.failures) all += "\n  " + f;
      if (outcome.known_issue.empty()) {
        CHECK_MESSAGE(outcome.failures.empty(), name_of(path), all);
      } else {
        CHECK_MESSAGE(!outcome.failures.empty(), name_of(path),
                      " passes: take its known-issue off");
      }
    }
  }
}

TEST_CASE("golden scripts are many, and each says its rule first") {
  const auto all = scripts();
  CHECK(all.size() >= 120);
  for (const fs::path& path : all) {
    CAPTURE(name_of(path));
    const auto source = api::read_source(path.string());
    REQUIRE(source);
    CHECK((*source)->text.starts_with("// "));
  }
}

/// Messages that no script of readable size provokes, and what does.
const std::map<std::string, std::string> kElsewhere = {
    {"E0100", "a hundred errors: limits_test.cpp"},
    {"E0160", "257 brackets: limits_test.cpp"},
    {"E0161", "1025 operators: limits_test.cpp"},
    {"E0162", "a source of 64 MiB: limits_test.cpp"},
    {"E0303", "a million operations: limits_test.cpp"},
    {"E0306", "an option of the command line, without a place in a script: limits_test.cpp"},
    {"E0310", "a library function without a rule: limits_test.cpp"},
    {"E0307", "4097 recursive functions: limits_test.cpp"},
};

TEST_CASE("every message is provoked by a golden script") {
  std::set<std::string> provoked;
  for (const fs::path& path : scripts()) {
    const auto source = api::read_source(path.string());
    REQUIRE(source);
    const Outcome outcome = examine(*source, Thoroughness::Messages);
    if (outcome.known_issue.empty()) provoked.insert(outcome.codes.begin(), outcome.codes.end());
  }
  for (const lang::DiagInfo& row : lang::all_diagnostics()) {
    const std::string code(row.code);
    CAPTURE(code);
    CAPTURE(row.name);
    CHECK(provoked.contains(code) != kElsewhere.contains(code));
  }
}

}  // namespace
}  // namespace mms::golden
