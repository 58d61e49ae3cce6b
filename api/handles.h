// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What stands behind the handles of mms.h.

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/mms.h"
#include "lang/link.h"
#include "materials/layout.h"
#include "vm/interpreter.h"

struct MMsGraph {
  std::optional<mms::lang::Graph> graph;  ///< of the last parse without errors
  std::string log;
};

struct MMsSurface {
  const mms::vm::Descriptor* descriptor;
  mms::materials::Layout bsdf;
};

struct MMsVolume {
  const mms::vm::Descriptor* descriptor;
};

struct MMsProgram {
  std::vector<mms::lang::Graph> graphs;
  mms::lang::LinkOptions options;
  std::optional<mms::lang::Linked> linked;
  std::optional<mms::vm::Executable> executable;
  std::deque<MMsSurface> surfaces;  // addresses stay
  std::deque<MMsVolume> volumes;
  std::string log;
};

struct MMsContext {
  explicit MMsContext(const MMsProgram& p)
      : program(&p), in(p.executable->width()), machine(p.executable->width()) {}

  const MMsProgram* program;
  mms::vm::InputBatch<float> in;
  mms::vm::Interpreter<float> machine;
  std::string log;
};

namespace mms::api {

/// Runs `body`, which returns whether it succeeded; what it throws (no memory) goes to `log`.
template <class Body>
int guarded(std::string& log, Body body) noexcept {
  try {
    log.clear();
    return body() ? 1 : 0;
  } catch (...) {
    log.clear();
    try {
      log = "out of memory";
    } catch (...) {  // the log stays empty
    }
    return 0;
  }
}

/// A new `T`, or null where there is no memory.
template <class T, class... Args>
T* make(const Args&... args) noexcept {
  try {
    return new T(args...);
  } catch (...) {
    return nullptr;
  }
}

}  // namespace mms::api
