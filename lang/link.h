// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Graphs to a verified Program: resolve, check, specialise, optimise, emit. After a successful
/// link nothing about types can fail.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lang/ast.h"
#include "lang/diagnostics.h"
#include "vm/images.h"
#include "vm/library.h"
#include "vm/program.h"

namespace mms::lang {

using vm::Library;

enum class Level : std::uint8_t { O0, O1, O2 };

/// What becomes of a value for a param that no script has: an error, or a name in
/// `Linked::unknown_params`.
enum class UnknownParams : std::uint8_t { Refuse, Report };
/// Called when a stage of the linker (`lint`, `library`, `elaborate`, a pass, `emit`, `verify`) is
/// done: for measuring. The passes come once for each function.
using StageDone = std::function<void(std::string_view stage)>;

/// A source found for an import. Two of one name are one source.
struct Imported {
  std::string name;  ///< what messages call it
  std::string text;
};

/// Finds what the source called `importer` imports as `written`; empty if there is no such thing.
using Resolver =
    std::function<std::optional<Imported>(const std::string& importer, const std::string& written)>;

/// What becomes of an image that cannot be read: an error, or a warning and magenta in its place.
enum class MissingImages : std::uint8_t { Refuse, Magenta };

/// Called with each file that is looked for, as an import or an image, before it is known whether
/// it is there: for who waits for files.
using LookedFor = std::function<void(const std::string& file)>;

struct LinkOptions {
  Level level = Level::O2;
  std::string dump_after;  ///< `Linked::dump`: a name of passes()
  Resolver resolve;        ///< where there is one, no file is read and `import_path` means nothing
  std::vector<std::string> import_path;                     ///< `-I`, in order
  std::vector<std::pair<std::string, std::string>> params;  ///< `--set name=expression`
  UnknownParams unknown_params = UnknownParams::Refuse;
  vm::ImageSource* images = nullptr;  ///< opens images; null: there are none
  MissingImages missing_images = MissingImages::Refuse;
  StageDone stage_done;  ///< may be empty
  LookedFor looked_for;  ///< may be empty
};

/// A pass from graphs to bytecode: what `--dump-after` and the manual print.
struct PassInfo {
  std::string_view name, doc;
  Level from;  ///< the lowest level that runs it
};
/// All passes, in the order in which they run.
std::span<const PassInfo> passes();

using vm::ParamInfo;

struct Linked {
  vm::Program program;
  std::vector<ParamInfo> params;
  std::vector<std::string> dependencies;  ///< imported files, and those of images
  std::string dump;  ///< every function after the pass `dump_after`; empty where no pass that
                     ///< runs at the level has that name
  std::vector<std::string> unknown_params;  ///< of LinkOptions::params, where they are reported
};

/// Links `graphs` (and what they import) into a program, or says why not.
std::optional<Linked> link(std::span<const Graph> graphs, const Library& library,
                           const LinkOptions& options, Diagnostics& diagnostics);

}  // namespace mms::lang
