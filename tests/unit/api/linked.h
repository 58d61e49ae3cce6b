// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A script through mms.h, for tests.

#include <string>
#include <utility>
#include <vector>

#include "api/mms.h"

namespace mms::api {

/// Values of params, as expressions.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// A program of one script that links, and a context for it.
struct Linked {
  explicit Linked(const std::string& script, int level = O2, const Settings& settings = {}) {
    MMsGraph* graph = mmsMkGraph();
    for (const auto& [name, value] : settings) mmsSetParam(program, name.c_str(), value.c_str());
    if (mmsParseString(*graph, script) && mmsAddGraph(*program, *graph) &&
        mmsLinkProgram(*program, level))
      context = mmsMkContext(*program);
    log = std::string(mmsGetGraphLog(*graph)) + mmsGetProgramLog(*program);
    mmsDeleteGraph(graph);
  }
  ~Linked() {
    mmsDeleteContext(context);
    mmsDeleteProgram(program);
  }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  MMsProgram* program = mmsMkProgram();
  MMsContext* context = nullptr;
  std::string log;
};

}  // namespace mms::api
