// SPDX-License-Identifier: Apache-2.0
// Images through mms.h.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/api/linked.h"

namespace {

namespace fs = std::filesystem;

/// A script in a file of a fresh folder, with a picture of two columns, black and white, beside it.
struct Program {
  fs::path folder = fs::temp_directory_path() / "mms_api_images_test";
  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();

  explicit Program(const std::string& script) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "p.pgm", std::ios::binary) << "P5 2 1 255\n" << '\0' << '\xff';
    std::ofstream(folder / "s.mms") << script;
    REQUIRE(mmsParseFile(graph, (folder / "s.mms").c_str()));
    REQUIRE(mmsAddGraph(program, graph));
  }
  ~Program() {
    mmsDeleteGraph(graph);
    mmsDeleteProgram(program);
    fs::remove_all(folder);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  float value(const char* name) {
    MMsContext* context = mmsMkContext(program);
    const MMsPoints points{1, nullptr, 0};
    float v = -1;
    CHECK(mmsEvalValue(context, name, &points, &v));
    mmsDeleteContext(context);
    return v;
  }
};

}  // namespace

TEST_CASE("images: what is missing fails the link or is magenta, as the host says") {
  Program p("real a() = image_value(\"none.png\", $uv);\n");
  CHECK(!mmsLinkProgram(*p.program, mms::O2));
  CHECK(std::string(mmsGetProgramLog(*p.program)).find("the image `none.png` does not exist") !=
        std::string::npos);
  CHECK(!mmsSetImages(p.program, 0, 1));
  CHECK(!mmsSetImages(p.program, HUGE_VAL, 1));
  CHECK(!mmsSetImages(nullptr, 64, 1));
  REQUIRE(mmsSetImages(p.program, 64, 1));
  REQUIRE(mmsLinkProgram(*p.program, mms::O2));
  CHECK(p.value("a") == 1);
}

#ifdef MMS_IMAGES
TEST_CASE("images: are looked up, listed, and outlive their program in a context") {
  Program p(
      "real a() = image_value(\"p.pgm\", [0.5, 0.5], filter = \"bilinear\", width = 0);\n"
      "real b() = image_value(\"p.pgm\", [0.75, 0.5], filter = \"nearest\", width = 0,"
      " storage = \"compressed\");\n");
  REQUIRE_MESSAGE(mmsLinkProgram(*p.program, mms::O2), mmsGetProgramLog(*p.program));
  CHECK(p.value("a") == 0.5f);
  CHECK(p.value("b") == 1);
  CHECK(mmsGetImport(p.program, 0) == (p.folder / "p.pgm").string());
  MMsContext* context = mmsMkContext(p.program);
  mmsDeleteProgram(p.program);
  p.program = nullptr;
  const MMsPoints points{1, nullptr, 0};
  float v = -1;
  CHECK(mmsEvalValue(context, "a", &points, &v));
  CHECK(v == 0.5f);
  mmsDeleteContext(context);
}
#endif
