// SPDX-License-Identifier: Apache-2.0
// The `mms` command. Everything that can go wrong past the verbs' own messages ends here.
#include <exception>
#include <new>
#include <string>

#include "tools/command.h"
#include "tools/script.h"

int main(int argc, char** argv) {
  using mms::tools::Exit;
  try {
    return static_cast<int>(mms::tools::run_command(argc, argv));
  } catch (const std::bad_alloc&) {
    mms::tools::print_error({"mms", "out of memory", "try a smaller picture or script"});
  } catch (const std::exception& e) {
    mms::tools::print_error({"mms", std::string("internal failure: ") + e.what(),
                             "this is our fault: please report it with the script"});
  }
  return static_cast<int>(Exit::Internal);
}
