// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a golden script says of itself (golden_test.cpp lists the directives), and whether it is
/// so.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/golden/evaluate.h"

namespace mms::golden {

/// `// expect~T: V`
struct ExpectedValue {
  std::uint32_t line;
  std::string value;
  double tolerance;
};
/// `// fault: C line N`
struct ExpectedFault {
  std::uint32_t line;
  std::string cause;
  std::uint32_t at;
};
/// `// expect-output: FORM NAME OUTPUT at ... = V`, `// expect-info:`, `// check-gradient:`
struct ExpectedOutput {
  std::string form, name, output, value;
  std::vector<std::pair<std::string, std::vector<double>>> at;
};
/// A message, at columns of a line (0: without a place in this file).
struct ExpectedMessage {
  std::string code, text;
  std::uint32_t line = 0, column = 0, length = 0;
};

struct Expectations {
  std::string known_issue;
  std::vector<ExpectedValue> values;
  std::vector<ExpectedFault> faults;
  std::vector<ExpectedOutput> outputs, infos, gradients;
  std::vector<ExpectedMessage> messages;
  std::vector<std::pair<std::string, std::string>> params;
  double near = 1e-5;  ///< float and double machine; a few operations cost a few 6e-8
  std::vector<std::string> malformed;
};

Expectations read_expectations(const lang::Source& source);

/// Numbers of a list, in whatever brackets; `true` is 1.
std::vector<double> numbers_of(const std::string& text);

struct Outcome {
  std::string known_issue;
  std::vector<std::string> failures;
  std::set<std::string> codes;  ///< of the messages that were given as expected
};

/// Compiles the script and checks all that it says.
Outcome examine(const lang::SourcePtr& source);

/// All levels, lane counts and machines agree; what does not is added to `failures`. The double
/// machine is left out where `near` is infinite.
void check_agreement(const lang::SourcePtr& source, const lang::LinkOptions& options, double near,
                     std::vector<std::string>& failures);

}  // namespace mms::golden
