// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the verbs that render share: from a script and options to a scene that is ready, and what
/// is said of a render.

#include <memory>
#include <optional>
#include <string>

#include "renderer/render.h"
#include "tools/render.h"
#include "tools/script.h"

namespace mms::tools {

/// A script, linked.
struct RenderScript {
  std::shared_ptr<const Compiled> linked;
  std::string surface;     ///< that the test object wears; empty: whatever the scene says
  std::uint64_t hash = 0;  ///< of the linked program, wherever its files are
};

/// The same, bound to a scene.
struct RenderJob : RenderScript {
  renderer::Scene scene;
};

/// Compiles `file`; empty after saying what is wrong with it.
std::optional<RenderScript> compile_script(const RenderRequest& request, const std::string& file,
                                           Exit& exit);

/// A scene that is a file, and what may name a file in it, there or not: meshes and pictures, and
/// other strings too. The scene alone where it cannot be read.
std::vector<std::string> files_of_scene(const std::string& scene);

/// The files that a picture of `script` is made from, as far as they are named.
std::vector<std::string> inputs_of(const RenderRequest& request, const RenderScript& script);

/// Of a scene that did not load, or of which no picture can be made.
Exit exit_of(const Error& error);

/// Loads the scene, or a turn of it; empty after saying what is wrong.
std::optional<RenderJob> set_scene(const RenderRequest& request, const RenderScript& script,
                                   Exit& exit);

/// Both.
std::optional<RenderJob> prepare(const RenderRequest& request, const std::string& file, Exit& exit);

/// What the command asked for; Ctrl-C stops it.
renderer::RenderOptions render_options(const RenderRequest& request);

/// Makes Ctrl-C and SIGTERM stop renders; the second one ends the process.
void catch_interrupts();
bool interrupted();

/// File name without folder and extension; `stdin` of `-`.
std::string stem(const std::string& file);

/// One line, or the counters, or JSON; and warnings.
void print_report(const RenderRequest& request, const RenderScript& linked,
                  const std::string& script, const std::string& path, const renderer::Report& r);

}  // namespace mms::tools
