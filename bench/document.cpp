// SPDX-License-Identifier: Apache-2.0
#include "bench/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mms::bench {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  std::string name = "unknown", family = "?";
  for (std::string line; std::getline(info, line) && !line.empty();) {
    const std::string value = line.substr(std::min(line.size(), line.find(':') + 2));
    if (line.starts_with("model name")) name = value;
    if (line.starts_with("cpu family")) family = value;
  }
  return fmt::format("{} (family {})", name, family);
}

std::string load() {
  std::ifstream file("/proc/loadavg");
  std::string one;
  return file >> one ? one : "unknown";
}

bool write_part(std::string_view name, std::string_view text) {
  const std::string path = MMS_SOURCE_DIR "/docs/performance.md";
  const std::string begin = fmt::format("<!-- begin {} -->\n", name),
                    end = fmt::format("<!-- end {} -->\n", name);
  std::ifstream in(path);
  std::string all{std::istreambuf_iterator<char>(in), {}};
  if (all.empty()) all = "# Performance\n\nWritten by `./run bench`; do not edit.\n";
  const std::size_t from = all.find(begin), to = all.find(end);
  const std::string part = fmt::format("{}{}{}", begin, text, end);
  if (from != std::string::npos && to != std::string::npos && from < to)
    all.replace(from, to + end.size() - from, part);
  else
    all += "\n" + part;
  std::ofstream out(path);
  out << all;
  if (out.flush()) return true;
  fmt::print(stderr, "error: cannot write {}\n", path);
  return false;
}

int part_main(int count, char** arguments, std::string_view name, std::string (*make)()) {
  const bool quiet = count == 2 && std::string_view(arguments[1]) == "--no-document";
  if (count > 1 && !quiet) {
    fmt::print(stderr, "usage: bench_{} [--no-document]\n", name);
    return 2;
  }
  const std::string text = make();
  fmt::print("{}", text);
  return quiet || write_part(name, text) ? 0 : 1;
}

}  // namespace mms::bench
