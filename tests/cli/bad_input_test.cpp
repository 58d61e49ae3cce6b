// SPDX-License-Identifier: Apache-2.0
// Every mistake a user can make ends in a message that says where, what, and what to try, in an
// exit code of the documented list, and without a file.
#include <unistd.h>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::contains;
using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

constexpr const char* kGood = "surface \"good\"\n  bsdf = matte(0.5);\nend\n";

/// The message names the place and the matter, and helps; nothing else was printed.
void check_message(const Outcome& run, int exit, const std::string& where,
                   const std::string& what) {
  INFO(run.err);
  CHECK(run.exit == exit);
  CHECK(contains(run.err, "error"));
  CHECK(contains(run.err, where));
  CHECK(contains(run.err, what));
  CHECK(contains(run.err, "help: "));
  CHECK(run.out == "");
}

/// A mistake in a script: `check` finds it, and so does `render`, which then writes nothing.
void check_script(const std::string& script, const std::string& where, const std::string& what) {
  const Folder folder;
  folder.write("bad.mms", script);
  check_message(folder.mms("check bad.mms"), 1, where, what);
#if MMS_RENDERER
  check_message(folder.mms("render bad.mms -o bad.png"), 1, where, what);
#endif
  CHECK(folder.file_count() == 1);
}

#if MMS_RENDERER
constexpr const char* kSmall = " --size 8x8 --samples 1 ";

void check_render(const std::string& args, int exit, const std::string& where,
                  const std::string& what, const std::string& script = kGood) {
  const Folder folder;
  folder.write("good.mms", script);
  check_message(folder.mms("render good.mms " + args), exit, where, what);
  CHECK(folder.file_count() == 1);
}
#endif

}  // namespace

TEST_CASE("missing file") {
  const Folder folder;
  for (const char* verb : {"check", "info", "disasm"})
    check_message(folder.mms(std::string(verb) + " missing.mms"), 3, "missing.mms", "No such file");
#if MMS_RENDERER
  check_message(folder.mms("render missing.mms -o out.png"), 3, "missing.mms", "No such file");
#endif
  CHECK(folder.file_count() == 0);
}

TEST_CASE("a folder is no script") {
  const Folder folder;
  check_message(folder.mms("check ."), 3, ".", "is a folder");
}

TEST_CASE("every verb over scripts says what is wrong with its file") {
  const Folder folder;
  folder.write("empty.mms", "");
  folder.write("bad.mms", "surface \"s\"\n  bsdf = matte(0.5;\nend\n");
  for (const std::string verb : {"check", "info", "disasm", "fmt", "test", "doc", "eval"}) {
    INFO(verb);
    check_message(folder.mms(verb + " missing.mms"), 3, "missing.mms", "No such file");
    check_message(folder.mms(verb + " empty.mms"), 3, "empty.mms", "empty");
    check_message(folder.mms(verb + " bad.mms"), 1, "bad.mms:2:", "error");
    check_message(folder.mms(verb + " -", "surface s bsdf = ;"), 1, "<stdin>:1:", "error");
    check_message(folder.mms(verb + " --no-such-option bad.mms"), 2, "mms " + verb,
                  "no-such-option");
  }
  std::filesystem::create_directory(folder.path("dir.mms"));
  for (const std::string verb : {"check", "info", "disasm", "fmt", "test", "doc", "eval"})
    check_message(folder.mms(verb + " dir.mms"), 3, "dir.mms", "is a folder");
}

TEST_CASE("a file that may not be read") {
  if (::geteuid() == 0) return;  // root may
  const Folder folder;
  folder.write("secret.mms", kGood);
  std::filesystem::permissions(folder.path("secret.mms"), std::filesystem::perms::none);
  check_message(folder.mms("check secret.mms"), 3, "secret.mms", "Permission denied");
}

TEST_CASE("a disk that is full") {
  const Folder folder;
  folder.write("good.mms", kGood);
  for (const std::string args :
       {"doc stdlib", "doc --html stdlib", "info good.mms", "eval 1", "disasm good.mms", "fmt -",
        "explain E0203", "completion bash", "test good.mms", "--help"}) {
    INFO(args);
    check_message(
        folder.bash("echo 'surface s bsdf = matte(1); end' | mms " + args + " >/dev/full"), 3,
        "standard output", "cannot be written");
  }
}

TEST_CASE("warnings by name") {
  const Folder folder;
  folder.write("w.mms", "surface s\n  spare = 1;\n  bsdf = matte(0.7) + matte(0.7);\nend\n");
  const auto run = [&](const std::string& words) {
    return folder.mms("check " + words + " w.mms");
  };
  const Outcome plain = run("");
  CHECK(plain.exit == 0);
  CHECK(contains(plain.err, "warning[W0401]"));
  CHECK(contains(plain.err, "[-Wnon-conserving]"));
  CHECK(run("-Wno-unused -Wno-non-conserving").err == "");
  const Outcome one = run("-Werror=unused");
  CHECK(one.exit == 1);
  CHECK(contains(one.err, "error[W0401]"));
  CHECK(contains(one.err, "warning[W0407]"));
  CHECK(run("-Werror -Wno-unused -Wno-error=non-conserving").exit == 0);
  check_message(run("-Wno-unusd"), 2, "-Wno-unusd", "no warning is called `unusd`");
}

TEST_CASE("empty file") {
  const Folder folder;
  folder.write("empty.mms", "");
  check_message(folder.mms("check empty.mms"), 3, "empty.mms", "empty");
#if MMS_RENDERER
  check_message(folder.mms("render empty.mms -o out.png"), 3, "empty.mms", "empty");
#endif
  CHECK(folder.file_count() == 1);
}

TEST_CASE("what is no text is told in one message, and no layout is made of it") {
  const Folder folder;
  folder.write("s.mms", kGood);
  REQUIRE(folder.mms("compile s.mms -o s.mmsc").exit == 0);
  const std::string program = folder.read("s.mmsc");
  check_message(folder.mms("fmt s.mmsc"), 3, "s.mmsc", "is a compiled program");
  folder.write("wide.mms", std::string("s\0u\0r\0", 6));
  for (const char* verb : {"check", "fmt", "info"}) {
    const Outcome run = folder.mms(std::string(verb) + " wide.mms");
    check_message(run, 3, "wide.mms", "is no text");
    CHECK(run.err.size() < 200);
  }
  CHECK(folder.read("s.mmsc") == program);
}

TEST_CASE("nothing to evaluate, and options that are given twice") {
  const Folder folder;
  check_message(folder.mms("eval ''"), 2, "mms eval", "empty");
  check_message(folder.mms("eval 1 --precision float --precision double"), 2, "--precision",
                "given more than once");
}

TEST_CASE("syntax error") {
  check_script("surface \"s\"\n  bsdf = matte(0.5;\nend\n", "bad.mms:2:", "error");
}

TEST_CASE("unknown name") {
  check_script("surface \"s\"\n  bsdf = mate(0.5);\nend\n", "bad.mms:2:10", "mate");
}

TEST_CASE("wrong type") {
  check_script("surface \"s\"\n  bsdf = 0.5;\nend\n", "bad.mms:2:", "material");
}

TEST_CASE("a misspelt output") {
  check_script("surface \"s\"\n  heigth = 0.5;\nend\n", "bad.mms:2:3", "height");
}

TEST_CASE("an unknown param") {
  const Folder folder;
  folder.write("good.mms", kGood);
  check_message(folder.mms("check good.mms --set scale=2"), 2, "--set",
                "nothing is called `scale`");
  check_message(folder.mms("check good.mms --set scale"), 2, "--set", "scale");
  check_message(folder.mms("check good.mms --set '$time=2'"), 2, "--set", "time");
  folder.write("grain.mms", "param real grain = 1.0;\n");
  check_message(folder.mms("check grain.mms --set grian=2"), 2, "--set", "did you mean `grain`?");
  check_message(folder.mms("check grain.mms --set grain=2+"), 2, "--set grain:1:", "expected");
  check_message(folder.mms("check grain.mms --set grain=true"), 2, "--set grain:1:1", "real");
}

TEST_CASE("a material is no value to print") {
  const Folder folder;
  check_message(folder.mms("eval 'matte(1)'"), 1, "matte(1)", "no value");
}

TEST_CASE("endless recursion, evaluated") {
  const Folder folder;
  folder.write("loop.mms", "real f(real x) =\n  f(x + 1);\n");
  check_message(folder.mms("eval -f loop.mms 'f($position[0])'"), 4, "loop.mms:", "does not end");
}

TEST_CASE("unknown verb, option or message code") {
  const Folder folder;
  check_message(folder.mms("chekc x.mms"), 2, "mms", "did you mean `mms check`?");
  check_message(folder.mms(""), 2, "mms", "verb");
  check_message(folder.mms("check"), 2, "mms check", "FILE");
  check_message(folder.mms("check --colour=maybe x.mms"), 2, "mms check", "--colour");
  check_message(folder.mms("check --color=maybe x.mms"), 2, "mms check", "maybe");
  check_message(folder.mms("explain E9999"), 2, "mms explain", "E9999");
  check_message(folder.mms("check --seting a=1 x.mms"), 2, "mms check: no such option: --seting",
                "`mms check --help`");
  check_message(folder.mms("check --mising=magenta x.mms"), 2, "no such option: --mising",
                "did you mean `--missing`?");
  check_message(folder.mms("explain unusd"), 2, "mms explain", "did you mean `unused`?");
  check_message(folder.mms("explain semicolon"), 2, "mms explain", "these speak of it: E0120");
  check_message(folder.mms("doc stdlb"), 2, "mms doc", "did you mean `stdlib`?");
  check_message(folder.mms("doc perln"), 2, "mms doc", "did you mean `perlin`?");
  check_message(folder.mms("eval --set 'positoin=[1,2,3]' 1"), 2, "--set",
                "did you mean `$position`?");
  check_message(folder.mms("eval --set 'position=[1,2]' 1"), 2, "--set $position", "real[3]");
}

TEST_CASE("numbers that are none, or absurd") {
  const Folder folder;
  folder.write("good.mms", kGood);
  for (const std::string number : {"inf", "nan", "-1", "0", "1e300", "many", "4096x"})
    check_message(folder.mms("check good.mms --image-memory=" + number), 2, "--image-memory",
                  "`" + number + "` is not a number from 1 to");
  for (const std::string number : {"inf", "nan", "99999999999", "20000x", "-5"})
    check_message(folder.mms("furnace good.mms --samples=" + number), 2, "--samples=" + number,
                  "no number from 1");
  for (const std::string number : {"inf", "nan", "-1"})
    check_message(folder.mms("compare a.png b.png --threshold=" + number), 2, "--threshold",
                  "`" + number + "` is no threshold");
}

TEST_CASE("a folder of imports that is not there is warned of") {
  const Folder folder;
  folder.write("good.mms", kGood);
  std::filesystem::create_directory(folder.path("lib"));
  const Outcome run = folder.mms("check good.mms -I lib -I lbi -I good.mms");
  CHECK(run.exit == 0);
  CHECK(run.err.starts_with("warning: -I lbi: there is no such folder\n  = help: "));
  CHECK(contains(run.err, "warning: -I good.mms: there is no such folder"));
  CHECK_FALSE(contains(run.err, "-I lib"));
}

TEST_CASE("a compiled program over a picture") {
  const Folder folder;
  folder.write("good.mms", kGood);
  folder.write("x.png", "\x89PNG");
  check_message(folder.mms("compile good.mms -o x.png"), 2, "x.png", "no compiled program");
  CHECK(folder.read("x.png") == "\x89PNG");
  folder.write("empty.mmsc", "");
  for (const std::string file : {"new.png", "new.png", "empty.mmsc"})
    CHECK(folder.mms("compile good.mms -o " + file).exit == 0);
}

TEST_CASE("a compiled program over its script") {
  const Folder folder;
  folder.write("lib.mms", "const real shade = 0.5;\n");
  folder.write("good.mms", "import \"lib.mms\"; surface \"good\" bsdf = matte(shade); end\n");
  const std::string text = folder.read("good.mms");
  check_message(folder.mms("compile good.mms -o ./good.mms"), 2, "./good.mms", "made from");
  check_message(folder.mms("compile good.mms -o lib.mms"), 2, "lib.mms", "made from");
  CHECK(folder.read("good.mms") == text);
  CHECK(folder.mms("compile good.mms -o good.mmsc").exit == 0);
}

TEST_CASE("a word that an option does not take") {
  const Folder folder;
  check_message(folder.mms("render x.mms --filter=gausian"), 2, "--filter",
                "did you mean `gaussian`? there are: box, gaussian, blackman-harris");
  check_message(folder.mms("render x.mms --sampler halton"), 2, "--sampler", "`halton`");
  check_message(folder.mms("render x.mms --estimator bdpt"), 2, "--estimator", "unweighted");
  check_message(folder.mms("compare a.png b.png --measure flip"), 2, "--measure", "dssim");
  check_message(folder.mms("check -O3 x.mms"), 2, "-O", "there are: 0, 1, 2");
}

#if MMS_RENDERER

TEST_CASE("unknown surface and volume") {
  check_render("-o out.png --surface god" + std::string(kSmall), 1, "god", "surface");
  check_render("-o out.png --volume fog" + std::string(kSmall), 1, "fog", "volume");
}

TEST_CASE("nothing to render") {
  check_render("-o out.png" + std::string(kSmall), 1, "good.mms", "nothing to render",
               "real twice(real x) = 2 * x;\n");
}

TEST_CASE("unwritable output") {
  check_render("-o no/such/folder/out.png" + std::string(kSmall), 3, "no/such/folder", "");
  check_render("-o good.mms/out.png" + std::string(kSmall), 3, "good.mms/out.png", "");
}

TEST_CASE("unsupported image type") {
  check_render("-o out.gif" + std::string(kSmall), 3, "out.gif", ".exr");
  check_render("-o out" + std::string(kSmall), 3, "out", ".exr");
}

TEST_CASE("numbers out of range") {
  check_render("-o out.png --size 8x8 --samples 0", 2, "--samples", "0 is not in");
  check_render("-o out.png --size 8x8 --samples -5", 2, "--samples", "-5 is not in");
  check_render("-o out.png --size 8x8 --samples many", 2, "--samples", "`many`");
  check_render("-o out.png --size 0x8 --samples 1", 2, "--size", "0 is not in");
  check_render("-o out.png --size 8 --samples 1", 2, "--size", "`8`");
  check_render("-o out.png --max-depth 0", 2, "--max-depth", "0 is not in");
  check_render("-o out.png --threads -1", 2, "--threads", "-1 is not in");
  check_render("-o out.png --seed x", 2, "--seed", "`x`");
  for (const std::string number : {"inf", "nan", "-1"})
    check_render("-o out.png --checkpoint=" + number, 2, "--checkpoint", "`" + number + "`");
}

TEST_CASE("one picture for two scripts") {
  check_render("good.mms -o out.exr" + std::string(kSmall), 2, "-o", "2 scripts");
}

TEST_CASE("a scene that is missing, or with an unknown key") {
  check_render("-o out.png --scene missing.json" + std::string(kSmall), 3, "missing.json", "");
  check_render("-o out.png --scene spehre" + std::string(kSmall), 2, "spehre", "sphere");
  const Folder folder;
  folder.write("good.mms", kGood);
  folder.write("scene.json", "{\n  \"camra\": {}\n}\n");
  check_message(folder.mms("render good.mms -o out.png --scene scene.json" + std::string(kSmall)),
                1, "scene.json", "camra");
  folder.write("scene.json", "{\n  \"camera\": \n");
  check_message(folder.mms("render good.mms -o out.png --scene scene.json" + std::string(kSmall)),
                1, "scene.json", "");
  CHECK(folder.file_count() == 2);
}

TEST_CASE("scenes that hold nothing, too much, or what is no number") {
  const Folder folder;
  folder.write("good.mms", kGood);
  const std::string deep(1000000, '[');
  const struct {
    std::string scene;
    const char *where, *what;
  } cases[] = {
      {"", "scene.json", "the file is empty"},
      {" \n", "scene.json", "the file is empty"},
      {"// nothing\n/* yet */ // at all", "scene.json", "the file is empty"},
      {"/* open", "scene.json", "missing closing"},
      {"null", "scene.json", "expected an object"},
      {R"({"objects": []})", "scene.json: objects", "no object"},
      {deep, "scene.json", "unexpected end of input"},
      {deep + std::string(deep.size(), ']'), "scene.json", "expected an object"},
      {R"({"camera": ")" + std::string(100000, 'x') + "\"}", "scene.json: camera", "xxx..."},
      {R"({"objects": [{"sphere": {"radius": 1e999}}]})", "scene.json", "1e999"}};
  for (const auto& c : cases) {
    folder.write("scene.json", c.scene);
    const Outcome run =
        folder.mms("render good.mms -o out.png --scene scene.json" + std::string(kSmall));
    check_message(run, 1, c.where, c.what);
    CHECK(run.err.size() < 400);
  }
  CHECK(folder.file_count() == 2);
  // What the message of an empty scene tells to write is a scene.
  folder.write("scene.json", "");
  const std::string scene = "--scene scene.json" + std::string(kSmall);
  const std::string said = folder.mms("render good.mms -o out.png " + scene).err;
  folder.write("scene.json", said.substr(said.find("a first scene: ") + 15));
  CHECK(folder.mms("render good.mms -o out.png " + scene).exit == 0);
}

TEST_CASE("options for the object under test, where the scene has none") {
  const Folder folder;
  folder.write("good.mms", kGood);
  folder.write("scene.json", R"({"objects": [{"sphere": {}, "surface": "good"}]})");
  const std::string render = "render good.mms --scene scene.json -o out.png" + std::string(kSmall);
  for (const std::string option : {"--surface good", "--volume good", "--turntable 2"})
    check_message(folder.mms(render + option), 2, option.substr(0, option.find(' ')),
                  "scene.json has none");
  CHECK(folder.file_count() == 2);
  // Without them it is a scene like others; this one is dark.
  const Outcome dark = folder.mms(render);
  CHECK(dark.exit == 0);
  CHECK(contains(dark.err, "note: out.png is black"));
  CHECK(folder.mms(render + "--environment white").err == "");
}

TEST_CASE("folders in place of a scene and of what it names") {
  const Folder folder;
  folder.write("good.mms", kGood);
  std::filesystem::create_directory(folder.path("box.obj"));
  const std::string render = "render good.mms -o out.png" + std::string(kSmall);
  check_message(folder.mms(render + "--scene box.obj"), 3, "--scene", "`box.obj` is a folder");
  check_message(folder.mms(render + "--environment ./box.obj"), 3, "--environment", "is a folder");
  folder.write("scene.json", R"({"objects": [{"mesh": "box.obj", "test": true}]})");
  check_message(folder.mms(render + "--scene scene.json"), 3, "scene.json: objects[0].mesh",
                "`box.obj` is a folder, not a mesh file");
  folder.write("scene.json", R"({"environment": {"image": "box.obj"},
                                 "objects": [{"sphere": {}, "test": true}]})");
  check_message(folder.mms(render + "--scene scene.json"), 3, "scene.json: environment.image",
                "`box.obj` is a folder, not a picture file");
  CHECK_FALSE(folder.has("out.png"));
}

TEST_CASE("an environment that is missing") {
  check_render("-o out.png --environment claer" + std::string(kSmall), 2, "--environment",
               "did you mean `clear`?");
  check_render("-o out.png --environment dusk" + std::string(kSmall), 2, "--environment",
               "`white`, `black`, `overcast`, `clear`");
  check_render("-o out.png --environment sky.exr" + std::string(kSmall), 3, "--environment",
               "no environment `sky.exr`");
}

TEST_CASE("pictures and meshes that are missing or broken") {
  const Folder folder;
  check_message(folder.mms("compare a.png b.png"), 3, "a.png", "there is no such picture");
  folder.write("good.mms", kGood);
  folder.write("scene.json", R"({"environment": {"image": "sky.exr"},
                                 "objects": [{"sphere": {}, "test": true}]})");
  const std::string render = "render good.mms -o out.png --scene scene.json" + std::string(kSmall);
  check_message(folder.mms(render), 3, "scene.json: environment.image",
                "no picture file `sky.exr`");
  CHECK(contains(folder.mms(render).err, "relative to the scene file"));
  folder.write("sky.exr", "v/1");
  check_message(folder.mms(render), 3, "scene.json: environment.image", "cannot read the picture");
  check_message(folder.mms("render good.mms -o out.png --environment sky.exr"), 3, "sky.exr",
                "cannot read the picture");
  // One that is not asked for is not read.
  CHECK(folder.mms(render + "--quiet --environment overcast").exit == 0);
  CHECK(std::filesystem::remove(folder.path("out.png")));
  folder.write("scene.json", R"({"objects": [{"mesh": "m.obj", "test": true}]})");
  folder.write("m.obj", "v");
  check_message(folder.mms(render), 3, "scene.json: objects[0].mesh", "cannot read the mesh");
  check_message(folder.mms("render good.mms -o out.tiff"), 3, "out.tiff", ".film");
  CHECK_FALSE(folder.has("out.png"));
}

TEST_CASE("a report that cannot be printed") {
  const Folder folder;
  folder.write("good.mms", kGood);
  check_message(folder.bash("mms render good.mms -o a.png --size 8x8 --samples 1 >/dev/full"), 3,
                "standard output", "cannot be written");
}

TEST_CASE("a folder in place of a film") {
  const Folder folder;
  folder.write("good.mms", kGood);
  std::filesystem::create_directory(folder.path("a.png.film"));
  check_message(folder.mms("merge a.png.film -o a.png"), 3, "a.png.film", "is a folder");
  check_message(folder.mms("render good.mms -o a.png --resume" + std::string(kSmall)), 3,
                "a.png.film", "is a folder");
}

TEST_CASE("pictures over what they are made from") {
  const Folder folder;
  const std::string picture = mms::cli::project_text("examples/star_tile.png");
  folder.write("map.png", picture);
  folder.write("s.mms", "surface s bsdf = matte(image_value(\"map.png\", $uv, width = 0)); end\n");
  folder.write("good.mms", kGood);
  folder.write("good.png", kGood);
  std::filesystem::create_symlink(folder.path("map.png"), folder.path("link.png"));
  const auto refused = [&](const std::string& args, const std::string& where) {
    CAPTURE(args);
    check_message(folder.mms(args), 2, where, "over what it is made from");
  };
  refused("render s.mms -o map.png" + std::string(kSmall), "map.png");
  refused("render s.mms -o ./link.png" + std::string(kSmall), "./link.png");
  refused("render s.mms --watch -o map.png" + std::string(kSmall), "map.png");
  refused("render s.mms good.mms -o map.png" + std::string(kSmall), "map.png");
  refused("render good.mms --environment map.png -o map.png" + std::string(kSmall), "map.png");
  refused("render good.png" + std::string(kSmall), "good.png");
  refused("compare map.png map.png -o map.png", "map.png");
  // What a scene names is looked for beside it; a mesh may have a second name.
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::filesystem::create_directory(folder.path("set"));
  folder.write("set/mesh.obj", mesh);
  std::filesystem::create_hard_link(folder.path("set/mesh.obj"), folder.path("mesh.exr"));
  folder.write("set/scene.json", R"({"environment": {"image": "../map.png"},
                                     "objects": [{"mesh": "mesh.obj", "test": true}]})");
  for (const std::string watch : {"", " --watch"})
    for (const std::string output : {"map.png", "mesh.exr"})
      refused("render good.mms --scene set/scene.json -o " + output + watch + kSmall, output);
  CHECK(folder.read("set/mesh.obj") == mesh);
  CHECK(folder.read("map.png") == picture);
  CHECK(folder.read("good.png") == kGood);
}

TEST_CASE("a volume whose largest rates nobody knows") {
  check_render("-o out.png" + std::string(kSmall), 1, "good.mms:1", "states no `bound`",
               "volume \"good\" scattering = 1 / abs($object_position.z); end\n"
               "surface \"good\" bsdf = refraction(1.0); end\n");
}

TEST_CASE("endless recursion, rendered") {
  check_render("-o out.png" + std::string(kSmall), 4, "good.mms:2", "",
               "real f(real x) =\n  f(x + 1);\n"
               "surface \"good\" bsdf = matte(f($position[0])); end\n");
}

#endif
