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

TEST_CASE("openpbr's weights are proven never to exceed one") {
  const Folder folder;
  for (const char* settings :
       {"", "--set base_metalness=0.5 --set coat_weight=1 --set thin_film_weight=0.5",
        "--set transmission_weight=0.5 --set coat_weight=0.4 --set fuzz_weight=1",
        "--set subsurface_weight=0.5 --set geometry_thin_walled=true --set "
        "base_diffuse_roughness=1"}) {
    const Outcome run = folder.mms(std::string("info openpbr ") + settings);
    INFO(settings, run.err);
    CHECK(run.exit == 0);
    CHECK(contains(run.out, "proven: weights never exceed one"));
  }
}
