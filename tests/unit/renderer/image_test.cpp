// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "renderer/picture.h"
#include "renderer/scene.h"

using namespace mms::renderer;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / "mms_image_test";
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

Film ramp() {
  Film f{4, 2, {}, {}};
  // Equal-energy white scaled: XYZ of D65 white is (0.9505, 1, 1.089).
  for (int i = 0; i < 8; ++i) {
    f.xyz.push_back({0.9505 * i, 1.0 * i, 1.089 * i});
    f.variance.push_back(0.25 * i);
  }
  return f;
}

}  // namespace

TEST_CASE("EXR keeps linear values and no part file stays") {
  const Folder folder;
  const std::string path = folder / "a.exr";
  REQUIRE(bool(check_writable(path)));
  CHECK(folder.files() == 0);
  REQUIRE(bool(write_picture(path, {ramp()})));
  CHECK(folder.files() == 1);
  const auto back = load_environment(path);
  REQUIRE(bool(back));
  CHECK(back->width == 4);
  CHECK(back->height == 2);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)  // XYZ of white are given to 4 digits
      CHECK(back->rgb[i][k] == doctest::Approx(i).epsilon(2e-3));
}

TEST_CASE("PNG is tone mapped: grey stays grey, brighter stays brighter, black is black") {
  const Folder folder;
  const std::string path = folder / "a.png";
  REQUIRE(bool(write_picture(path, {ramp()})));
  const auto back = load_environment(path);
  REQUIRE(bool(back));
  CHECK(back->rgb[0][1] == 0);
  for (int i = 1; i < 8; ++i) {
    CHECK(back->rgb[i][1] >= back->rgb[i - 1][1]);
    CHECK(std::abs(back->rgb[i][0] - back->rgb[i][2]) < 0.02);  // one 8-bit step near white
  }
  CHECK(back->rgb[1][1] > 0.3);
  CHECK(back->rgb[7][1] > 0.95);
}

TEST_CASE("what cannot be written is known before, and says what can be") {
  const Folder folder;
  CHECK(check_writable(folder / "a.gif").error().hint.find(".png") != std::string::npos);
  CHECK(check_writable(folder / "a.gif").error().what.find("`.gif`") != std::string::npos);
  CHECK(check_writable(folder / "noext").error().what.find("no extension") != std::string::npos);
  CHECK(check_writable(folder / "none/a.png").error().what.find("no folder") != std::string::npos);
  fs::create_directory(folder.path / "d.png");
  CHECK(check_writable(folder / "d.png").error().what.find("folder") != std::string::npos);
  CHECK_FALSE(bool(write_picture(folder / "a.gif", {ramp()})));
  CHECK(folder.files() == 1);
}

TEST_CASE("a picture that is there is only replaced by a whole one") {
  const Folder folder;
  const std::string path = folder / "a.png";
  std::ofstream(path) << "old";
  REQUIRE(bool(check_writable(path)));
  CHECK(fs::file_size(path) == 3);
  REQUIRE(bool(write_picture(path, {ramp()})));
  CHECK(fs::file_size(path) > 3);
}
