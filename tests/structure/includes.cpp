// SPDX-License-Identifier: Apache-2.0
#include "tests/structure/includes.h"

#include <sstream>

namespace mms::structure {

namespace {

/// A third-party library: its name in the table, how its headers begin, and whether only .cpp
/// files may include it.
struct Library {
  std::string name, prefix;
  bool sources_only;
};

const std::vector<Library>& third_party() {
  static const std::vector<Library> all = {
      {"Embree", "embree", true},    {"OpenImageIO", "OpenImageIO/", true},
      {"oneTBB", "tbb/", true},      {"oneTBB", "oneapi/", true},
      {"libpng", "png.h", true},     {"zlib", "zlib.h", true},
      {"Assimp", "assimp/", true},   {"nlohmann", "nlohmann/", false},
      {"CLI11", "CLI/", true},       {"fmt", "fmt/", false},
      {"doctest", "doctest", false}, {"Google Benchmark", "benchmark/", false},
  };
  return all;
}

std::string trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" `");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" `") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(trim(part));
  return parts;
}

/// The header that a line includes, without quotes or brackets; empty for other lines.
std::string included(const std::string& line) {
  const std::size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return "";
  const std::size_t word = line.find_first_not_of(" \t", hash + 1);
  if (word == std::string::npos || line.compare(word, 7, "include") != 0) return "";
  const std::size_t open = line.find_first_of("\"<", word);
  if (open == std::string::npos) return "";
  const std::size_t close = line.find_first_of("\">", open + 1);
  return line.substr(open + 1, close - open - 1);
}

}  // namespace

Rules read_rules(const std::string& markdown) {
  Rules rules;
  std::set<std::string> above;
  std::stringstream in(markdown);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| Folder |")) inside = true;
    if (!inside) continue;
    if (!line.starts_with("|")) break;
    const std::vector<std::string> cells = split(line, '|');
    if (cells.size() < 4 || !cells[1].ends_with("/")) continue;
    const std::string folder = cells[1].substr(0, cells[1].size() - 1);
    Rule rule;
    rule.folders.insert(folder);
    for (const std::string& word : split(cells[3], ',')) {
      if (word == "all above")
        rule.folders.insert(above.begin(), above.end());
      else if (above.contains(word))
        rule.folders.insert(word);
      else if (word != "standard library")
        rule.libraries.insert(word);
    }
    above.insert(folder);
    rules[folder] = rule;
  }
  return rules;
}

std::vector<std::string> check(const Rules& rules, const std::string& path,
                               const std::string& text) {
  std::vector<std::string> complaints;
  const std::string folder = path.substr(0, path.find('/'));
  const auto rule = rules.find(folder);
  if (rule == rules.end()) return {path + ": the table has no row for `" + folder + "/`"};
  std::stringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string header = included(line);
    if (header.empty()) continue;
    const std::string where = path + ":" + std::to_string(number) + ": ";
    const std::string target = header.substr(0, header.find('/'));
    if (target != header && rules.contains(target) && !rule->second.folders.contains(target))
      complaints.push_back(where + folder + "/ may not include " + target + "/");
    for (const Library& library : third_party()) {
      if (!header.starts_with(library.prefix)) continue;
      if (!rule->second.libraries.contains(library.name))
        complaints.push_back(where + folder + "/ may not include " + library.name);
      else if (library.sources_only && !path.ends_with(".cpp"))
        complaints.push_back(where + library.name + " may stand in .cpp files only");
    }
  }
  return complaints;
}

}  // namespace mms::structure
