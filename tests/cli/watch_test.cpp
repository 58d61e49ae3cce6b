// SPDX-License-Identifier: Apache-2.0
// mms render --watch: the picture follows its files.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::Folder;
using mms::cli::Outcome;

#if MMS_RENDERER

namespace {

/// `until_line COUNT TEXT` waits for the COUNT-th line with TEXT in the file `log`; `the_end` and
/// `end_as_another WHAT` end the watching; `follows FILE WHAT` puts FILE where it is waited for,
/// then another.
const std::string kWaiting = R"BASH(
fail() { echo "$*"; cat log err; kill -9 $child; exit 1; }
until_line() {
  for i in $(seq 1500); do
    [ "$(grep -c "$2" log)" -ge "$1" ] && return; sleep 0.02
  done
  fail "no $1. line with $2"
}
the_end() { kill -INT $child; wait $child; echo "ended $?"; }
# The picture has become another than before.png.
end_as_another() {
  cmp -s before.png p.png && fail "another $1 changed nothing"
  the_end
}
follows() {
  printf 'P6 1 1 255\n@@@' >new; mv new $1
  until_line 1 'estimated error'
  cp p.png before.png
  printf 'P6 1 1 255\nccc' >new; mv new $1
  until_line 2 'estimated error'
  end_as_another $2
}
touch log err
)BASH";

/// Runs `script` behind these: it ends the watching, and prints `rest` after that.
void check_watched(const Folder& folder, const std::string& script, const std::string& rest = "") {
  const Outcome run = folder.bash(kWaiting + script);
  INFO(run.out, run.err);
  CHECK(run.exit == 0);
  CHECK(run.out == "ended 130\n" + rest);
}

}  // namespace

TEST_CASE(
    "a watched picture follows the script, its imports, images and the scene, past mistakes") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  folder.write("scene.json",
               R"({"environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})");
  // `same`: the picture is the one that a plain render makes.
  check_watched(folder, R"BASH(
options="--size 24x24 --samples 3 --seed 9 --scene scene.json"
same() {
  mms render s.mms --quiet $options -o plain.png || fail "$1 does not render"
  cmp plain.png p.png || fail "the $1 is another"
}
mms-render render s.mms $options --watch --format=json -o p.png >log 2>err & child=$!
until_line 1 '"seconds"'
same first
cp p.png before.png
echo 'import "lib.mms"; surface "s" bsdf = matte(shade); end' >new; mv new s.mms
until_line 1 '"code"'
cmp before.png p.png || fail "a mistake changed the picture"
echo 'const real shade = 0.2;' >lib.mms
until_line 2 '"seconds"'
same second
echo 'const real shade = 0.7;' >lib.mms
until_line 3 '"seconds"'
same third
sed 's/"constant": 1/"constant": 0.5/' scene.json >new; mv new scene.json
until_line 4 '"seconds"'
same fourth
printf 'P6 1 1 255\n\300\100\040' >p.ppm
echo 'surface "s" bsdf = matte(image("p.ppm", $uv)); end' >new; mv new s.mms
until_line 5 '"seconds"'
same fifth
cp p.png before.png
printf 'P6 1 1 255\n\040\100\300' >new; mv new p.ppm
until_line 6 '"seconds"'
same sixth
end_as_another image
grep -c first_picture_seconds log
)BASH",
                "6\n");
}

TEST_CASE("files that a watched picture waits for: not there yet, deleted and written again") {
  const Folder folder;
  folder.write("s.mms",
               R"(import "lib.mms"; surface "s" bsdf = matte(image("maps/p.ppm", $uv)); end)");
  folder.write("scene.json", R"({"environment": {"image": "sky.ppm"},
                                 "objects": [{"sphere": {}, "test": true}]})");
  check_watched(folder, R"BASH(
mms-render render s.mms --size 24x24 --samples 3 --scene scene.json --watch -o p.png >log 2>&1 & child=$!
until_line 1 'lib.mms'
echo 'const real unused = 1;' >lib.mms
until_line 1 'does not exist'
mkdir maps
printf 'P6 1 1 255
À@ ' >maps/new; mv maps/new maps/p.ppm
until_line 1 'sky.ppm'
printf 'P6 1 1 255
@@À' >new; mv new sky.ppm
until_line 1 'estimated error'
cp p.png before.png
rm maps/p.ppm
until_line 2 'does not exist'
printf 'P6 1 1 255
 @À' >maps/new; mv maps/new maps/p.ppm
until_line 2 'estimated error'
end_as_another image
)BASH");
}

TEST_CASE("a folder in place of a watched scene") {
  const Folder folder;
  folder.write("s.mms", "surface s bsdf = matte(0.5); end\n");
  check_watched(folder, R"BASH(
mkdir scene.json
mms-render render s.mms --size 24x24 --samples 3 --scene scene.json --watch -o p.png >log 2>&1 & child=$!
until_line 1 '`scene.json` is a folder'
rmdir scene.json
echo '{"environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]}' >new; mv new scene.json
until_line 1 'estimated error'
the_end
)BASH");
}

TEST_CASE("a watched compiled program waits for its image, and follows it") {
  const Folder folder;
  folder.write("s.mms", R"(surface "s" bsdf = matte(image("p.ppm", $uv)); end)");
  check_watched(folder, R"BASH(
printf 'P6 1 1 255\n@@@' >p.ppm
mms compile s.mms -o s.mmsc && rm p.ppm
mms-render render s.mmsc --size 24x24 --samples 3 --watch -o p.png >log 2>&1 & child=$!
until_line 1 'put it there'
follows p.ppm image
)BASH");
}

TEST_CASE("a watched picture follows the environment that it was given") {
  const Folder folder;
  folder.write("s.mms", "surface s bsdf = matte(0.5); end\n");
  check_watched(folder, R"BASH(
mms-render render s.mms --size 24x24 --samples 3 --scene furnace --environment sky.ppm --watch -o p.png >log 2>&1 & child=$!
until_line 1 'sky.ppm'
follows sky.ppm picture
)BASH");
}

TEST_CASE("only one script can be watched") {
  const Folder folder;
  folder.write("s.mms", "surface \"s\" bsdf = matte(0.5); end\n");
  for (const char* args : {"s.mms s.mms", "- -o a.png", "s.mms -o s.film"})
    CHECK(folder.mms("render --watch " + std::string(args)).exit == 2);
}

#endif
