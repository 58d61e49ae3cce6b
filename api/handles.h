// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What stands behind the handles of mms.h.

#include <deque>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/images.h"
#include "api/mms.h"
#include "base/result.h"
#include "lang/link.h"
#include "materials/bsdf.h"
#include "materials/layout.h"
#include "vm/interpreter.h"

namespace mms::api {

struct LinkedProgram;

/// The messages of the last call on a handle, and who is told of each.
struct Messages {
  std::string text;
  MMsLog log = nullptr;
  void* user = nullptr;

  void add(int severity, const std::string& message) {
    text += message;
    if (log) log(user, severity, message.c_str());
  }
  void add(const Error& error);
};

}  // namespace mms::api

struct MMsGraph {
  std::optional<mms::lang::Graph> graph;  ///< of the last parse without errors
  mms::api::Messages messages;
};

struct MMsSurface {
  const mms::api::LinkedProgram* owner;
  const mms::vm::Descriptor* descriptor;
  mms::materials::Layout bsdf, emission;
};

struct MMsVolume {
  const mms::api::LinkedProgram* owner;
  const mms::vm::Descriptor* descriptor;
  mms::materials::Layout phase, emission;
};

namespace mms::api {

/// What a link gives. Immutable; contexts share it, so that one may outlive the next link.
struct LinkedProgram {
  explicit LinkedProgram(lang::Linked l);

  lang::Linked linked;
  vm::Executable executable;
  std::deque<MMsSurface> surfaces;  // addresses stay
  std::deque<MMsVolume> volumes;
};

}  // namespace mms::api

struct MMsProgram {
  std::vector<mms::lang::Graph> graphs;
  mms::lang::LinkOptions options;
  mms::api::ImageLibrary images;
  MMsResolve resolve = nullptr;
  void* resolve_user = nullptr;
  std::shared_ptr<const mms::api::LinkedProgram>
      linked;  ///< none before a link, or after a failed one
  mms::api::Messages messages;
};

struct MMsContext {
  explicit MMsContext(std::shared_ptr<const mms::api::LinkedProgram> l)
      : linked(std::move(l)), in(linked->executable.width()), machine(linked->executable.width()) {}

  std::shared_ptr<const mms::api::LinkedProgram> linked;
  mms::vm::InputBatch<float> in;
  mms::vm::Interpreter<float> machine;
  mms::api::Messages messages;
  /// Of the last surface that was asked, once there is one: what is solved for is kept.
  std::unique_ptr<mms::materials::Bsdf<float>::Choice> choice;
};

namespace mms::api {

/// Runs `body`, which returns whether it succeeded. What it throws (no memory; an exception of a
/// host's callback; a fault of ours) goes to `messages`.
template <class Body>
int guarded(Messages& messages, Body body) noexcept {
  const auto say = [&](const char* what) noexcept {
    try {
      messages.text.clear();
      messages.add(MMS_ERROR, what);
    } catch (...) {  // the log stays empty
    }
    return 0;
  };
  try {
    messages.text.clear();
    return body() ? 1 : 0;
  } catch (const std::bad_alloc&) {
    return say("out of memory");
  } catch (const std::exception& e) {
    return say(e.what());
  } catch (...) {
    return say("a callback threw");
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
