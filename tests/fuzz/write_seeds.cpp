// SPDX-License-Identifier: Apache-2.0
// fuzz_seeds FOLDER SCRIPT...: writes what the scripts that link are stored as, at two levels.
#include <filesystem>
#include <fstream>

#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  for (int i = 2; i < argc; ++i)
    for (const auto level : {mms::lang::Level::O0, mms::lang::Level::O2}) {
      const auto bytes = mms::fuzz::store(argv[i], level);
      if (bytes.empty()) continue;
      const std::string name =
          std::to_string(static_cast<int>(level)) + fs::path(argv[i]).filename().string();
      std::ofstream out(fs::path(argv[1]) / name, std::ios::binary);
      out.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
    }
}
