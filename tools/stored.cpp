// SPDX-License-Identifier: Apache-2.0
#include "tools/stored.h"

#include <algorithm>

#include <fmt/format.h>

#include "api/library.h"
#include "vm/serialise.h"

namespace mms::tools {

namespace {

bool is_stored(const lang::SourcePtr& source) {
  return vm::is_stored(source->text) || source->name.ends_with(".mmsc");
}

/// Opens an image of the program in `file`. Where it cannot be read it is an error, or magenta.
std::optional<Error> open_image(vm::ProgramImage& image, const std::string& file,
                                const ScriptOptions& options, vm::ImageSource& images,
                                lang::Diagnostics& diagnostics) {
  if (options.looked_for) options.looked_for(image.use.file);
  const auto opened = images.open(image.use);
  if (opened) {
    image.image = *opened;
    return std::nullopt;
  }
  const bool curve = image.use.filter == vm::kCurveFilter;
  const char* const form = curve ? "table" : "image";
  const std::string& what = opened.error().what;
  if (options.missing != "magenta")
    return Error{file, fmt::format("the {} `{}` {}", form, image.use.file, what),
                 "put it there, or compile the script again; --missing=magenta goes on without"};
  diagnostics
      .add(lang::Diag::ImageReplaced, {}, form, image.use.file, what, curve ? "1" : "magenta")
      .note({}, fmt::format("the compiled program `{}` reads it", file));
  return std::nullopt;
}

}  // namespace

bool any_stored(const std::vector<lang::SourcePtr>& sources) {
  return std::any_of(sources.begin(), sources.end(), is_stored);
}

Result<lang::Linked> load_stored(const std::vector<lang::SourcePtr>& sources,
                                 const ScriptOptions& options, vm::ImageSource& images,
                                 lang::Diagnostics& diagnostics) {
  const lang::Source& file = **std::find_if(sources.begin(), sources.end(), is_stored);
  if (sources.size() > 1)
    return Error{file.name, "is a compiled program, which cannot be linked with anything more",
                 "compile the scripts together: mms compile FILE... -o FILE.mmsc"};
  auto loaded = vm::load(std::as_bytes(std::span(file.text)), api::standard_library().builtins);
  if (!loaded) {
    Error error = loaded.error();
    error.where = error.where.empty() ? file.name : file.name + ": " + error.where;
    return error;
  }
  for (vm::ProgramImage& image : loaded->program.images)
    if (auto error = open_image(image, file.name, options, images, diagnostics)) return *error;
  lang::Linked linked;
  linked.program = std::move(loaded->program);
  linked.params = std::move(loaded->params);
  linked.dependencies = std::move(loaded->dependencies);
  return linked;
}

}  // namespace mms::tools
