// SPDX-License-Identifier: Apache-2.0
#include "tools/dependencies.h"

#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mms::tools {

namespace {

/// A file name as make reads it.
std::string escaped(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == ' ' || c == '#' || c == '\\') out += '\\';
    if (c == '$') out += '$';
    out += c;
  }
  return out;
}

}  // namespace

void add_deps_option(Verb& verb, DepsOption& option) {
  verb.add({"--deps",
            &option.form,
            "",
            "Print only the files that are imported; --deps=make as a rule for make",
            {"list", "make"},
            false,
            "list"});
}

void print_deps(const std::string& file, const lang::Linked& linked, const DepsOption& option,
                const ScriptOptions& options) {
  if (options.json()) {
    const nlohmann::ordered_json json{{"file", file}, {"dependencies", linked.dependencies}};
    fmt::print("{}\n", json.dump());
    return;
  }
  if (option.form == "make") {
    fmt::print("{}: {}", escaped(std::filesystem::path(file).stem().string() + ".png"),
               escaped(file));
    for (const std::string& name : linked.dependencies) fmt::print(" {}", escaped(name));
    fmt::print("\n");
    return;
  }
  for (const std::string& name : linked.dependencies) fmt::print("{}\n", name);
}

}  // namespace mms::tools
