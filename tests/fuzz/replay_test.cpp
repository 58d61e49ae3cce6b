// SPDX-License-Identifier: Apache-2.0
// Every target over the inputs that fuzzing found interesting (tests/fuzz/corpus), and over all
// scripts there are: without libFuzzer, so with any compiler and in every test run.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <doctest/doctest.h>

#include "tests/fuzz/seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/source_dir.h"

namespace mms::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = mms::source_dir();

std::vector<std::uint8_t> read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Files below `folder`; scripts only, where asked.
std::vector<fs::path> files(const fs::path& folder, bool scripts) {
  std::vector<fs::path> all;
  for (const auto& e : fs::recursive_directory_iterator(folder))
    if (e.is_regular_file() && (!scripts || e.path().extension() == ".mms"))
      all.push_back(e.path());
  return all;
}

std::vector<fs::path> all_scripts() {
  std::vector<fs::path> all;
  for (const char* folder : {"tests/golden", "examples", "stdlib"})
    for (fs::path& p : files(kRoot / folder, true)) all.push_back(std::move(p));
  return all;
}

TEST_CASE("what fuzzing has found ends as it should") {
  for (const Target& target : kTargets) {
    const auto inputs = files(kRoot / "tests/fuzz/corpus" / target.name, false);
    CAPTURE(target.name);
    CHECK(!inputs.empty());
    for (const fs::path& path : inputs) {
      CAPTURE(path.filename().string());
      CHECK_NOTHROW(target.run(read(path)));
    }
  }
}

TEST_CASE("the scripts that fuzzing starts from") {
  for (const fs::path& path : all_scripts()) {
    CAPTURE(path.string());
    const std::vector<std::uint8_t> text = read(path);
    CHECK_NOTHROW(parse(text));
    CHECK_NOTHROW(link(text));
  }
}

TEST_CASE("the programs that fuzzing starts from are accepted, and run") {
  int programs = 0;
  for (const fs::path& path : all_scripts()) {
    CAPTURE(path.string());
    const auto stored = store(path.string(), lang::Level::O2);
    if (stored.empty()) continue;
    ++programs;
    CHECK_NOTHROW(load({reinterpret_cast<const std::uint8_t*>(stored.data()), stored.size()}));
  }
  CHECK(programs > 100);
}

}  // namespace
}  // namespace mms::fuzz
