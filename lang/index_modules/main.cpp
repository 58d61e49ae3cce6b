// SPDX-License-Identifier: Apache-2.0
// Run while building: writes OUTPUT, a C++ source that holds the texts of modules written in the
// language and says where in them each definition stands. `prelude` comes first. A file with
// surfaces or volumes is no module but a script.
//
//   index_modules OUTPUT FILE.mms...
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "lang/parser.h"

namespace mms::lang {
namespace {

struct Definition {
  std::uint32_t begin;
  std::string name;
};

std::vector<Definition> definitions(const Graph& graph) {
  std::vector<Definition> all;
  for (const FunctionHandle h : graph.top_functions)
    all.push_back({graph[h].span.begin, graph[h].name.text});
  for (const Constant& k : graph.constants) all.push_back({k.span.begin, k.name.text});
  for (const TypeDefinition& t : graph.type_definitions) all.push_back({t.span.begin, t.name.text});
  std::stable_sort(all.begin(), all.end(),
                   [](const Definition& a, const Definition& b) { return a.begin < b.begin; });
  return all;
}

/// The rows of one module: each definition reaches to the next one. Or that of one script.
bool write(const std::filesystem::path& file, std::string& items, std::string& modules,
           std::string& scripts) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Diagnostics diagnostics;
  const Graph graph = parse(make_source(file.string(), text), diagnostics);
  if (!in || diagnostics.has_errors()) {
    fmt::print(stderr, "{}: cannot be read\n{}", file.string(), render(diagnostics));
    return false;
  }
  const std::string name = file.stem().string();
  if (!graph.descriptors.empty()) {
    scripts += fmt::format("    {{\"{}\", R\"mms({})mms\"}},\n", name, text);
    return true;
  }
  items += fmt::format("constexpr Library::Item k_{}[] = {{\n", name);
  const std::vector<Definition> all = definitions(graph);
  for (std::size_t i = 0; i < all.size(); ++i)
    items += fmt::format("    {{\"{}\", {}, {}}},\n", all[i].name, all[i].begin,
                         i + 1 < all.size() ? all[i + 1].begin : text.size());
  items += "};\n";
  modules += fmt::format("    {{\"{}\", R\"mms({})mms\", k_{}}},\n", name, text, name);
  return true;
}

}  // namespace
}  // namespace mms::lang

int main(int count, char** arguments) {
  if (count < 3) return 2;
  std::vector<std::filesystem::path> files(arguments + 2, arguments + count);
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return std::pair(a.stem() != "prelude", a) < std::pair(b.stem() != "prelude", b);
  });
  std::string items, modules, scripts;
  for (const std::filesystem::path& file : files)
    if (!mms::lang::write(file, items, modules, scripts)) return 1;
  std::ofstream out(arguments[1]);
  out << "// Made from stdlib/*.mms by lang/index_modules.\n"
      << "#include \"stdlib/stdlib.h\"\n\nnamespace mms::stdlib {\nnamespace {\n\n"
      << "using vm::Library;\n\n"
      << items << "\nconstexpr Library::Module kModules[] = {\n"
      << modules << "};\n\nconstexpr Library::Script kScripts[] = {\n"
      << scripts << "};\n\n}  // namespace\n\n"
      << "std::span<const Library::Module> modules() { return kModules; }\n"
      << "std::span<const Library::Script> scripts() { return kScripts; }\n\n}  // namespace "
         "mms::stdlib\n";
  return out.flush() ? 0 : 1;
}
