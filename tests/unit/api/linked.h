// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A script through mms.h, for tests.

#include <string>

#include "api/mms.h"

namespace mms::api {

/// A program of one script that links, and a context for it.
struct Linked {
  explicit Linked(const std::string& script, int level = O2) {
    MMsGraph* graph = mmsMkGraph();
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
