// SPDX-License-Identifier: Apache-2.0
// A whole script of the library, under its name.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

TEST_CASE("the library's script is found by its name, by verbs and by imports") {
  const Folder folder;
  CHECK(folder.mms("check -Werror openpbr").exit == 0);
  folder.write("own.mms", "import \"openpbr\";\npaint alias openpbr;\n");
  CHECK(folder.mms("check own.mms --set coat_weight=0.5").exit == 0);
  const Outcome out = folder.mms("check own.mms --set coat_weight=2");
  CHECK(out.exit == 2);
  CHECK(contains(out.err, "coat_weight"));
  // A file of that name comes first.
  folder.write("openpbr", "surface mine bsdf = matte(0.5); end\n");
  CHECK(contains(folder.mms("info openpbr").out, "surface mine"));
  const Outcome near = folder.mms("check opnpbr.mms");
  CHECK(near.exit != 0);
}
