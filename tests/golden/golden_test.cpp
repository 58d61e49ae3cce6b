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
//   // param: name=expression        links with that value of a param
//   // near: T            bound of |float - double| / max(1, |double|), instead of kNear
//   // known-issue: text  in the first line: the script fails, and must be unmarked when it passes
//
// A message that is not expected fails, and so does an expected one that is not given. `text` is a
// part of the message, its label, or its help. Whatever links is run as it comes from O0, O1 and
// O2, with one lane, an odd number and a whole batch, on both builds of the machine, stored and
// loaded again: floats agree bit for bit. The double machine's results lie near.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <set>

#include "tests/golden/corpus.h"
#include "tests/golden/expectations.h"

namespace mms::golden {
namespace {

/// What became of a script, which is looked at once.
const Outcome& examined(const std::filesystem::path& path) {
  static std::map<std::filesystem::path, Outcome> known;
  const auto found = known.find(path);
  if (found != known.end()) return found->second;
  const auto source = api::read_source(path.string());
  REQUIRE(source);
  return known[path] = examine(*source);
}

TEST_CASE("golden scripts") {
  for (const std::filesystem::path& path : scripts()) {
    SUBCASE(name_of(path).c_str()) {
      const Outcome& outcome = examined(path);
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
  CHECK(scripts().size() >= 300);
  for (const std::filesystem::path& path : scripts()) {
    CAPTURE(name_of(path));
    const auto source = api::read_source(path.string());
    REQUIRE(source);
    CHECK((*source)->text.starts_with("// "));
  }
}

TEST_CASE("every message is provoked by a golden script") {
  std::set<std::string> provoked;
  for (const std::filesystem::path& path : scripts()) {
    const Outcome& outcome = examined(path);
    if (outcome.known_issue.empty()) provoked.insert(outcome.codes.begin(), outcome.codes.end());
  }
  // And by the large ones, which limits_test.cpp looks at.
  const auto large = [&](const std::string& text) {
    const Compiled c = compile(text);
    for (const lang::Diagnostic& d : c.diagnostics.all()) provoked.emplace(lang::info(d.id).code);
  };
  large(flood());
  large(deep_sum());
  for (const Limit& l : limit_scripts())
    if (!provoked.contains(l.code)) large(l.broken);
  lang::LinkOptions magenta;
  magenta.missing_images = lang::MissingImages::Magenta;
  const auto script = lang::make_source("test.mms", "real f() = image_value(\"gone\", $uv);");
  const Compiled replaced = compile(script, magenta);
  for (const lang::Diagnostic& d : replaced.diagnostics.all())
    provoked.emplace(lang::info(d.id).code);
  for (const lang::DiagInfo& row : lang::all_diagnostics()) {
    CAPTURE(row.code);
    CAPTURE(row.name);
    CHECK(provoked.contains(std::string(row.code)));
  }
}

}  // namespace
}  // namespace mms::golden
