// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a verb of the command is: its words, its options, and what runs. command.cpp hands this
/// to the command-line library; help, docs/cli.md and the completions are made from it.

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "tools/exit.h"

namespace mms::tools {

/// One option, or what stands on the line without a dash.
struct Option {
  /// Where the value goes. A vector takes many: positionals all that is left, others one each time.
  using Target = std::variant<bool*, std::string*, std::vector<std::string>*>;

  std::string names;                    ///< `-o,--output`; without a dash: a positional
  Target target;                        ///< outlives the Verb
  std::string value;                    ///< what stands for the value in help: `PATH`
  std::string doc;                      ///< one sentence without a full stop
  std::vector<std::string> words = {};  ///< the only values it takes; empty: any
  bool required = false;
  /// The value where only the name is given; another must then be glued on: `--deps=make`.
  std::string bare = {};

  bool positional() const { return names[0] != '-'; }
};

struct Verb {
  std::string name;
  std::string doc;     ///< one sentence without a full stop
  std::string footer;  ///< examples, at the foot of its help
  std::vector<Option> options;
  std::function<Exit()> run;  ///< after the options have been read

  Verb& add(Option option) {
    options.push_back(std::move(option));
    return *this;
  }
};

}  // namespace mms::tools
