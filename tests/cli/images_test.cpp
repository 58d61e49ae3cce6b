// SPDX-License-Identifier: Apache-2.0
// Images, from a file to every verb.
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kScript =
    "real a() = image_value(\"p.pgm\", [0.5, 0.5], filter = \"bilinear\", width = 0);\n"
    "real g() = gradient(function(u) -> image_value(\"p.pgm\", [u, 0.5], filter = \"bilinear\","
    " width = 0), 0.5);\n"
    "surface s bsdf = matte(image(\"p.pgm\", $uv)); height = 0.01 * image_value(\"p.pgm\", $uv);"
    " end\n";

}  // namespace

TEST_CASE("a missing image is told with every place, and --missing=magenta goes on") {
  const Folder folder;
  folder.write("s.mms", kScript);
  const Outcome refused = folder.mms("check s.mms");
  CHECK(refused.exit == 1);
  CHECK(contains(refused.err, "error[E0312]: the image `p.pgm` does not exist"));
  CHECK(contains(refused.err, "s.mms:1:12"));
  CHECK(contains(refused.err, "-I"));
  std::size_t places = 0;
  for (std::size_t at = refused.err.find("and here"); at != std::string::npos;
       at = refused.err.find("and here", at + 1))
    ++places;
  CHECK(places == 3);
  const Outcome magenta = folder.mms("eval s.mms --missing=magenta");
  CHECK(magenta.exit == 0);
  CHECK(contains(magenta.out, "a = 1\n"));
  CHECK(contains(magenta.err, "warning[W0408]"));
  const Outcome memory = folder.mms("check s.mms --image-memory none");
  CHECK(memory.exit == 2);
  CHECK(contains(memory.err, "--image-memory"));
}

TEST_CASE(
    "tables of files: eval, deps, compile, bounds; a missing or broken one names every place") {
  const Folder folder;
  folder.write("s.mms",
               "real a() = round(100 * measured(\"lamp.csv\", 450nm));\n"
               "real k() = round(100 * measured(\"lamp.csv\", 450nm, column = \"k\"));\n"
               "real g() = gradient(function(l) -> measured(\"lamp.csv\", l), 450nm) * 1nm;\n"
               "surface s emission = measured(\"lamp.csv\", $wavelength); end\n");
  const Outcome missing = folder.mms("check s.mms");
  CHECK(missing.exit == 1);
  CHECK(contains(missing.err, "error[E0312]: the table `lamp.csv` does not exist"));
  std::size_t places = 0;
  for (std::size_t at = missing.err.find("and here"); at != std::string::npos;
       at = missing.err.find("and here", at + 1))
    ++places;
  CHECK(places == 3);
  const Outcome without = folder.mms("eval s.mms --missing=magenta");
  CHECK(without.exit == 0);
  CHECK(contains(without.out, "a = 100\n"));
  CHECK(contains(without.err, "1 stands for it"));
  folder.write("lamp.csv", "nm,value,k\n400,1,5\n500,3,7\n");
  const Outcome eval = folder.mms("eval s.mms");
  CHECK(eval.err == "");
  CHECK(contains(eval.out, "a = 200\n"));
  CHECK(contains(eval.out, "k = 600\n"));
  CHECK(contains(eval.out, "g = 0.02\n"));
  CHECK(folder.mms("check --deps s.mms").out == "lamp.csv\n");
  CHECK(folder.mms("compile s.mms -o s.mmsc").exit == 0);
  CHECK(folder.mms("eval s.mmsc").out == eval.out);
  folder.bash("rm lamp.csv");
  const Outcome refused = folder.mms("eval s.mmsc");
  CHECK(refused.exit == 3);
  CHECK(contains(refused.err, "error: s.mmsc: the table `lamp.csv` cannot be read\n"));
  const Outcome stored = folder.mms("eval s.mmsc --missing=magenta");
  CHECK(stored.exit == 0);
  CHECK(stored.out == without.out);
  // The table is read by two columns and by its slope, and told once.
  CHECK(stored.err ==
        "warning[W0408]: the table `lamp.csv` cannot be read: 1 stands for it [-Wimage-replaced]\n"
        "   = note: the compiled program `s.mmsc` reads it\n"
        "   = help: `mms explain W0408` says more\n");
  CHECK(folder.mms("eval s.mmsc --missing=magenta -Wno-image-replaced").err == "");
  CHECK(folder.mms("eval s.mmsc --missing=magenta -Werror").exit == 1);
  folder.write("lamp.csv", "400,1\n500,three\n");
  const Outcome broken = folder.mms("check s.mms");
  CHECK(broken.exit == 1);
  CHECK(contains(broken.err, "the table `lamp.csv` is broken: line 2: `three` is no number"));
  folder.write("s.mms", "real a() = measured(\"lamp.csv\", 450nm, unit = \"inch\");\n");
  CHECK(contains(folder.mms("check s.mms").err, "`inch` is no unit of tables"));
}

#if MMS_RENDERER

namespace {

/// Two columns, black and white.
void write_picture(const Folder& folder, const std::string& name) {
  folder.write(name, std::string("P5 2 1 255\n") + '\0' + '\xff');
}

}  // namespace

TEST_CASE("images reach eval, bounds, compile, deps and render") {
  const Folder folder;
  folder.write("s.mms", kScript);
  write_picture(folder, "p.pgm");
  const Outcome eval = folder.mms("eval s.mms");
  CHECK(eval.err == "");
  CHECK(contains(eval.out, "a = 0.5\n"));
  CHECK(contains(eval.out, "g = 2\n"));
  CHECK(folder.mms("check --deps s.mms").out == "p.pgm\n");
  CHECK(contains(folder.mms("check --deps=make s.mms").out, "s.png: s.mms p.pgm"));
  const Outcome accuracy = folder.mms("accuracy s.mms");
  CHECK(accuracy.exit == 0);
  const Outcome compiled = folder.mms("compile s.mms -o s.mmsc");
  CHECK(compiled.exit == 0);
  CHECK(folder.mms("eval s.mmsc").out == eval.out);
  const Outcome render = folder.mms("render s.mms --size 8x8 --samples 1 -o out.png");
  CHECK(render.exit == 0);
  CHECK(folder.has("out.png"));
  CHECK(folder.mms("render s.mmsc --size 8x8 --samples 1 -o again.png").exit == 0);
  CHECK(folder.read("again.png") == folder.read("out.png"));
  folder.write("p.pgm", "P5 2 1 255\n");
  const Outcome broken = folder.mms("check s.mms");
  CHECK(broken.exit == 1);
  CHECK(contains(broken.err, "the image `p.pgm` is broken"));
}

TEST_CASE("a PNG that is cut off or damaged is told once, wherever pictures are read") {
  const Folder folder;
  folder.write("s.mms", "surface s bsdf = matte(image(\"p.png\", $uv)); end\n");
  folder.write("plain.mms", "surface s bsdf = matte(0.5); end\n");
  const std::string whole = mms::cli::project_text("examples/star_tile.png");
  REQUIRE(whole.size() > 1000);
  std::string flipped = whole;
  flipped[1000] = char(flipped[1000] ^ 1);
  std::string renamed = whole;
  renamed[12] = 'j';  // the first chunk is no longer the header
  const auto cut = [&](std::size_t at) { return whole.substr(0, at); };
  // 8 bytes of signature; then chunks, 12 bytes and what they hold each, the first with 13, the
  // last with nothing.
  for (const std::string& text :
       {cut(8), cut(20), cut(33), cut(1000), cut(whole.size() - 12), flipped, renamed}) {
    CAPTURE(text.size());
    folder.write("p.png", text);
    const Outcome check = folder.mms("check s.mms");
    CHECK(check.exit == 1);
    CHECK(check.err.starts_with("error[E0312]: the image `p.png` is broken: "));
    CHECK(contains(check.err, "write the file again"));
    const Outcome compare = folder.mms("compare p.png p.png");
    CHECK(compare.exit == 3);
    CHECK(compare.err.starts_with("error: p.png: cannot read the picture: "));
  }
  CHECK(folder.mms("render plain.mms -o o.png --environment p.png")
            .err.starts_with("error: p.png: cannot read the picture: "));
  folder.write("p.png", cut(1000));
  CHECK(contains(folder.mms("check s.mms").err,
                 "the image `p.png` is broken: it is cut off within its chunk `IDAT`\n"));
  folder.write("p.png", flipped);
  CHECK(contains(folder.mms("compare p.png p.png").err,
                 "cannot read the picture: its chunk `IDAT` is damaged\n"));
  folder.write("p.png", whole);
  CHECK(folder.mms("check s.mms").err == "");
}

TEST_CASE("a lamp's photometric file lights a scene, and a damaged one is told with its line") {
  const Folder folder;
  folder.write("s.mms",
               "real down() = ies(\"lamp.ies\", [0, -1, 0]);\n"
               "real slant() = ies(\"lamp.ies\", normalize([1.0, -1.0, 0.0]));\n"
               "real east() = ies(\"lamp.ies\", [1, 0, 0]);\n"
               "real south() = ies(\"lamp.ies\", [0, 0, 1]);\n"
               "real lumens() = image_fact(\"lamp.ies\", \"lumens\");\n"
               "surface s bsdf = matte(0); emission = ies(\"lamp.ies\"); end\n");
  const std::string head = "TILT=NONE\n1 700 1 3 2 1 2 0 0 0\n1 1 9\n0 90 180\n0 90\n";
  folder.write("lamp.ies", head + "100 50 0 100 30 0\n");
  const Outcome eval = folder.mms("eval s.mms");
  CHECK(eval.err == "");
  CHECK(contains(eval.out, "down = 100\nslant = 75\neast = 50\nsouth = 30\nlumens = 700\n"));
  CHECK(folder.mms("render s.mms --size 8x8 --samples 1 -o out.png").exit == 0);
  folder.write("folder.mms", "surface s bsdf = matte(0); emission = ies(\"lamps.ies\"); end\n");
  folder.bash("mkdir lamps.ies");
  const Outcome lamps = folder.mms("check folder.mms");
  CHECK(lamps.exit == 1);
  CHECK(contains(lamps.err, "the image `lamps.ies` is a folder, not a photometric file"));
  folder.write("lamp.ies", head + "100 50 0 100 much 0\n");
  const Outcome broken = folder.mms("check s.mms");
  CHECK(broken.exit == 1);
  CHECK(contains(broken.err,
                 "the image `lamp.ies` is not understood: line 6: expected candela, found `much`"));
}

TEST_CASE("without the module for OpenImageIO a .png is rendered; all else is refused at once") {
  const Folder folder;
  folder.write("s.mms", "surface s bsdf = matte(0.5); end\n");
  const Outcome run = folder.bash(
      "cp $(command -v mms) $(command -v mms-render) .\n"
      "small='render s.mms --quiet --size 8x8 --samples 1'\n"
      "./mms $small -o a.png && echo rendered\n"
      "./mms $small -o a.exr; echo $?\n"
      "./mms $small s.mms -o t.png; echo $?\n"
      "./mms compare a.png a.png; echo $?\n"
      "[ -e a.exr.film ] || echo 'nothing begun'\n");
  INFO(run.err);
  CHECK(run.out == "rendered\n3\n3\n3\nnothing begun\n");
  for (const char* file : {"a.exr", "t.png", "a.png"})
    CHECK(contains(run.err, std::string("error: ") + file + ": there is no OpenImageIO here"));
}

#endif
