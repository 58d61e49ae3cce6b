// SPDX-License-Identifier: Apache-2.0
#include "api/library.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include <fmt/format.h>

#include "stdlib/stdlib.h"
#include "vm/limits.h"

namespace mms::api {

const lang::Library& standard_library() {
  static const lang::Library library{stdlib::builtins(), stdlib::modules(), stdlib::scripts()};
  return library;
}

namespace {

/// Everything in `in`, but no more than one byte past the limit.
std::string read_all(std::istream& in) {
  std::string text;
  char buffer[1 << 16];
  while (text.size() <= vm::limits::kSourceBytes) {
    in.read(buffer, sizeof buffer);
    if (in.gcount() <= 0) break;
    text.append(buffer, static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

}  // namespace

Result<lang::SourcePtr> read_source(const std::string& path) {
  std::string text, name = path;
  if (path == "-") {
    name = "<stdin>";
    text = read_all(std::cin);
  } else {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      return Error{path, "is a folder, not a script", "name a file in it"};
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) {
      const int cause = errno;
      if (const auto* script = cause == ENOENT ? standard_library().script(path) : nullptr)
        return lang::make_source(fmt::format("<{}>", script->name), std::string(script->text));
      return Error{path, fmt::format("cannot be read: {}", std::strerror(cause)),
                   cause == ENOENT ? "check the spelling and the folder you are in"
                                   : "check who may read it"};
    }
    text = read_all(in);
    if (in.bad()) return Error{path, "reading failed half way", "check the disk"};
  }
  if (text.size() > vm::limits::kSourceBytes)
    return Error{name, fmt::format("is larger than {} bytes", vm::limits::kSourceBytes),
                 "is it a script at all? Split it and `import` the parts"};
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    return Error{name, "the file is empty",
                 "a first surface: surface \"plain\" bsdf = matte(0.5); end"};
  return lang::make_source(std::move(name), std::move(text));
}

}  // namespace mms::api
