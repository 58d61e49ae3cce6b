// SPDX-License-Identifier: Apache-2.0
#include "renderer/scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "base/warp.h"
#include "hand_program.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

Error error_of(const std::string& text, SceneSource source = {}) {
  HandProgram h;
  h.matte("marble", 0.5);
  h.matte("wood", 0.5);
  h.volume("wax", 1, 1);
  Result<SceneData> r = parse_scene(h.program, source, text, "s.json", "");
  REQUIRE_FALSE(bool(r));
  return r.error();
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string kBall = R"({"sphere": {"radius": 1}, "surface": "wood"})";

std::string with_ball(const std::string& rest) {
  return R"({"objects": [)" + kBall + "]" + rest + "}";
}

}  // namespace

TEST_CASE("every mistake names its place and what to try") {
  Error e = error_of(R"({"objects": [{"sphere": {"radius": 1}, "surfce": "wood"}]})");
  CHECK(e.where == "s.json: objects[0].surfce");
  CHECK(e.what == "unknown key `surfce`");
  CHECK(holds(e.hint, "did you mean `surface`?"));

  e = error_of(R"({"objects": [{"sphere": {"radius": -1}, "surface": "wood"}]})");
  CHECK(e.where == "s.json: objects[0].sphere.radius");
  CHECK(holds(e.what, "-1"));
  CHECK(holds(e.what, "[1e-09, 1000000000"));

  e = error_of(R"({"objects": [{"sphere": {}, "surface": "wood", "priority": 1.5}]})");
  CHECK(e.where == "s.json: objects[0].priority");
  CHECK(e.what == "a priority is a whole number");

  e = error_of(R"({"objects": [{"sphere": {}, "test": 1.5}]})");
  CHECK(e.where == "s.json: objects[0].test");

  e = error_of(R"({"objects": [{"disc": {}, "surface": "wood", "priority": 1}]})");
  CHECK(holds(e.what, "only a closed object has an inside"));

  e = error_of(R"({"objects": [{"sphere": {"radius": "big"}, "surface": "wood"}]})");
  CHECK(holds(e.what, "expected a number, found the string \"big\""));

  e = error_of(R"({"objects": [{"sphere": {"center": [1, 2]}, "surface": "wood"}]})");
  CHECK(e.where == "s.json: objects[0].sphere.center");
  CHECK(holds(e.what, "expected 3 numbers, found 2"));

  e = error_of(R"({"objects": [{"surface": "wood"}]})");
  CHECK(holds(e.what, "one of `sphere`, `quad`, `disc`, `box`, `lathe`, `knot`, `mesh`"));

  e = error_of(R"({"objects": []})");
  CHECK(holds(e.what, "no object"));

  e = error_of("{}");
  CHECK(holds(e.what, "missing key `objects`"));

  e = error_of("[1]");
  CHECK(holds(e.what, "expected an object"));

  e = error_of(R"({"objects": [{"sphere": {}, "surface": "wodo"}]})");
  CHECK(e.where == "s.json: objects[0].surface");
  CHECK(e.what == "unknown surface `wodo`");
  CHECK(holds(e.hint, "`wood`"));

  e = error_of(R"({"objects": [{"quad": {"corner": [0,0,0], "u": [1,0,0], "v": [0,1,0]},
                                "surface": "wood", "volume": "wax"}]})");
  CHECK(holds(e.what, "closed"));

  e = error_of(R"({"objects": [{"sphere": {}, "surface": "wood", "volume": "wx"}]})");
  CHECK(e.where == "s.json: objects[0].volume");

  e = error_of(with_ball(R"(, "camera": {"position": [0, 0, 0], "target": [0, 0, 0]})"));
  CHECK(e.where == "s.json: camera.target");

  e = error_of(with_ball(R"(, "camera": {"position": [0, 5, 0], "target": [0, 0, 0]})"));
  CHECK(holds(e.what, "parallel"));

  e = error_of(with_ball(R"(, "environment": {"image": "nowhere.exr"})"));
  CHECK(e.where == "s.json: environment.image");
  CHECK(e.cause == Error::Cause::File);

  e = error_of(with_ball(R"(, "environment": {"constant": 1, "image": "x.exr"})"));
  CHECK(e.where == "s.json: environment");

  e = error_of(with_ball(R"(, "environment": {"constant": 1, "scale": 2})"));
  CHECK(holds(e.what, "with `image` or `sky`"));

  e = error_of(with_ball(R"(, "environment": {"sky": "clear", "constant": 1})"));
  CHECK(e.what == "an environment has one of `constant`, `image` and `sky`");

  e = error_of(with_ball(R"(, "environment": {"sky": "claer"})"));
  CHECK(e.where == "s.json: environment.sky");
  CHECK(e.hint == "did you mean `clear`? known: `overcast`, `clear`");

  e = error_of(with_ball(R"(, "environment": {"sky": 12})"));
  CHECK(holds(e.what, "expected a string"));

  e = error_of(with_ball(R"(, "environment": {"sky": "clear", "snu": [0, 1, 0]})"));
  CHECK(e.where == "s.json: environment.snu");
  CHECK(holds(e.hint, "did you mean `sun`?"));

  for (const char* below : {"[1, 0, 0]", "[0, -1, 0]"}) {
    e = error_of(
        with_ball(fmt::format(R"(, "environment": {{"sky": "clear", "sun": {}}})", below)));
    CHECK(e.where == "s.json: environment.sun");
    CHECK(holds(e.what, "not above the horizon"));
  }

  e = error_of(with_ball(R"(, "environment": {"sky": "overcast", "sun": [0, 1, 0]})"));
  CHECK(holds(e.what, "does not depend on the sun"));

  e = error_of(with_ball(R"(, "environment": {"constant": 1, "sun": [0, 1, 0]})"));
  CHECK(holds(e.what, "`sun` belongs to an environment with `sky`"));

  e = error_of(R"({"objects": [{"mesh": "nowhere.obj", "surface": "wood"}]})");
  CHECK(e.where == "s.json: objects[0].mesh");
  CHECK(e.cause == Error::Cause::File);

  e = error_of(R"({"objects": [})");
  CHECK(holds(e.what, "line 1, column"));

  e = error_of("");
  CHECK(e.where == "s.json");
}

TEST_CASE("the test object asks which surface when there are several, and the option answers") {
  const std::string test = R"({"objects": [{"sphere": {}, "test": true}]})";
  Error e = error_of(test);
  CHECK(e.where == "--surface");
  CHECK(holds(e.hint, "`marble`, `wood`"));
  SceneSource source;
  source.surface = "wod";
  e = error_of(test, source);
  CHECK(e.where == "--surface");
  CHECK(holds(e.hint, "did you mean `wood`?"));
  source.surface = "wood";
  source.volume = "waxx";
  e = error_of(test, source);
  CHECK(e.where == "--volume");

  HandProgram h;
  h.matte("marble", 0.5);
  h.volume("marble", 1, 1);
  const Result<SceneData> one = parse_scene(h.program, {}, test, "s", "");
  REQUIRE(bool(one));
  CHECK(one->test_surface == "marble");
  CHECK(one->test_volume == "marble");  // a volume fills the surface of its name
}

TEST_CASE("the test object wears the script's surface, whatever the scene calls its materials") {
  HandProgram h;
  h.matte("ground", 0.1);
  h.matte("other", 0.2);
  const auto is_script = [&](const SceneSource& source, const std::string& test) {
    const Result<SceneData> r =
        parse_scene(h.program, source,
                    R"({"materials": {"ground": {}, "plain": {}}, "objects": [
        {"disc": {}, "surface": "ground"}, {"sphere": {}, )" +
                        test + "}]}",
                    "s", "");
    REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + r.error().what));
    CHECK(r->surfaces[std::size_t(r->objects[0].surface)].script == nullptr);
    return r->surfaces[std::size_t(r->objects[1].surface)].script != nullptr;
  };
  CHECK(is_script({"s", "ground", ""}, R"("test": true)"));
  CHECK(is_script({"s", "", ""}, R"("test": 0)"));
  CHECK_FALSE(is_script({"s", "plain", ""}, R"("test": true)"));
  // What the scene itself names is the scene's.
  CHECK_FALSE(is_script({"s", "", ""}, R"("test": true, "surface": "ground")"));
}

TEST_CASE("a key that is there twice is a mistake, wherever it is") {
  const struct {
    const char *text, *where;
  } cases[] = {
      {R"({"objects": [], "objects": []})", "s.json: objects"},
      {R"({"materials": {"a": {}, "b": {"matte": [0, 0, 0], "matte": 1}, "a": {}}})",
       "s.json: materials.b.matte"},
      {R"({"objects": [{"sphere": {"center": [1, 2, 3]}}, {"a": [[{}, {}], {"x": 1, "x": 2}]}]})",
       "s.json: objects[1].a[1].x"}};
  for (const auto& c : cases) {
    const Error e = error_of(c.text);
    CHECK(e.where == c.where);
    CHECK(holds(e.what, "twice"));
  }
}

TEST_CASE("comments are allowed, transforms apply, and built-in scenes load") {
  HandProgram h;
  h.matte("x", 0.5);
  const Result<SceneData> s = parse_scene(h.program, {}, R"({
    // one object
    "objects": [{"sphere": {"center": [1, 0, 0], "radius": 2}, "scale": 3, "rotate": [0, 0, 90],
                 "translate": [0, 0, 7], "surface": "x"}] /* no camera */
  })",
                                          "s", "");
  REQUIRE(bool(s));
  const Sphere& ball = std::get<Sphere>(s->objects[0].shape);
  CHECK(ball.radius == doctest::Approx(6));
  CHECK(ball.centre.x == doctest::Approx(0).epsilon(1e-12));
  CHECK(ball.centre.y == doctest::Approx(3));
  CHECK(ball.centre.z == doctest::Approx(7));
  for (const std::string& name : builtin_scenes())
    CHECK_MESSAGE(bool(load_scene(h.program, {name, "", ""})), name);
  const Result<Scene> none = load_scene(h.program, {"spere", "", ""});
  REQUIRE_FALSE(bool(none));
  CHECK(holds(none.error().hint, "did you mean `sphere`?"));
}

TEST_CASE("meshes come from OBJ and PLY") {
  const auto folder = std::filesystem::temp_directory_path() / "mms_scene_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "t.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  std::ofstream(folder / "t.ply") << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                     "property float y\nproperty float z\nelement face 1\n"
                                     "property list uchar int vertex_indices\nend_header\n"
                                     "0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n";
  std::ofstream(folder / "bad.obj") << "nothing\n";
  const Result<Mesh> quad = load_mesh((folder / "t.obj").string(), {});
  REQUIRE(bool(quad));
  CHECK(quad->triangles.size() == 2);
  CHECK(area(Shape(*quad)) == doctest::Approx(1));
  Transform twice;
  twice.scale = 2;
  const Result<Mesh> triangle = load_mesh((folder / "t.ply").string(), twice);
  REQUIRE(bool(triangle));
  CHECK(area(Shape(*triangle)) == doctest::Approx(8));
  CHECK_FALSE(bool(load_mesh((folder / "bad.obj").string(), {})));
  CHECK_FALSE(bool(load_mesh((folder / "none.obj").string(), {})));
  CHECK(holds(load_mesh("/etc/hostname", {}).error().hint, ".obj"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("boxes and written meshes: turned, scaled and moved like all, their mistakes told") {
  HandProgram h;
  h.matte("wood", 0.5);
  const auto objects = [](const std::string& o) {
    return R"({"objects": [{"surface": "wood", "scale": 2, "rotate": [0, 90, 0], "translate": [0, 1, 0],)" +
           o + "}]}";
  };
  Result<SceneData> r =
      parse_scene(h.program, {}, objects(R"("box": {"size": [1, 2, 6]})"), "s", "");
  REQUIRE(bool(r));
  Bounds b = bounds(r->objects[0].shape);
  CHECK(b.high.x == doctest::Approx(6));  // z turned to x
  CHECK(b.high.y == doctest::Approx(3));
  CHECK(b.low.z == doctest::Approx(-1));

  const std::string corners = R"("mesh": {"positions": [[0, 0, 0], [0, 0, 1], [0, 1, 0]],)";
  r = parse_scene(h.program, {}, objects(corners + R"("triangles": [[0, 1, 2]],
      "normals": [[1, 0, 0], [0, 0, 2], [1, 0, 0]], "uvs": [[0, 0], [0.5, 0], [0, 1]]})"),
                  "s", "");
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + r.error().what));
  const Mesh& m = std::get<Mesh>(r->objects[0].shape);
  CHECK(m.positions[1].x == doctest::Approx(2));
  CHECK(m.positions[1].y == doctest::Approx(1));
  CHECK(m.normals[1].x == doctest::Approx(1));
  CHECK(m.uvs[1][0] == 0.5f);

  CHECK(error_of(objects(corners + R"("triangles": [[0, 1, 3]]})")).where ==
        "s.json: objects[0].mesh.triangles[0][2]");
  CHECK(holds(error_of(objects(corners + R"("triangles": [[0, 1, 1]]})")).what, "without area"));
  CHECK(holds(error_of(objects(corners + R"("triangles": []})")).what, "no triangle"));
  CHECK(holds(
      error_of(objects(corners + R"("triangles": [[0, 1, 2]], "normals": [[1, 0, 0]]})")).what,
      "1 entries for 3 positions"));
  CHECK(error_of(objects(R"("box": {"size": [1, 0, 1]})")).where ==
        "s.json: objects[0].box.size[1]");
}

TEST_CASE("a lathe turns a profile: closed, smooth where it is flat, sharp where it is not") {
  HandProgram h;
  h.matte("wood", 0.5);
  std::string arc;
  for (int i = 0; i <= 64; ++i) {
    const double t = kPi<double> * i / 64;
    arc += fmt::format("{}[{}, {}]", i > 0 ? ", " : "", i == 64 ? 0 : std::sin(t), -std::cos(t));
  }
  const auto turned = [&](const std::string& profile) {
    Result<SceneData> r = parse_scene(
        h.program, {},
        R"({"objects": [{"surface": "wood", "lathe": {"profile": [)" + profile + "]}}]}", "s", "");
    REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + r.error().what));
    return std::get<Mesh>(r->objects[0].shape);
  };
  const Mesh ball = turned(arc);
  // Chords of 1/64 and 2/128 of a half turn: short by their angle squared over 24, twice.
  CHECK(area(Shape(ball)) == doctest::Approx(4 * kPi<double>).epsilon(5e-4));
  CHECK(contains(Shape(ball), {0.5, 0.3, -0.4}));
  CHECK_FALSE(contains(Shape(ball), {0.9, 0.6, 0}));
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) {
    const SurfacePoint p = surface_at(ball, t, 0.3, 0.3);
    CHECK(dot(p.geometric_normal, normalize(p.position)) > 0.998);
    CHECK(dot(p.normal, normalize(p.position)) > 0.9995);
  }
  const Mesh can = turned("[0, 0], [1, 0], [1, 2], [0, 2]");
  CHECK(area(Shape(can)) == doctest::Approx(6 * kPi<double>).epsilon(2e-3));
  for (std::uint32_t t = 0; t < can.triangles.size(); ++t) {
    const SurfacePoint p = surface_at(can, t, 0.3, 0.3);
    const double upright = std::abs(p.normal.y);
    CHECK((upright < 1e-6 || upright > 1 - 1e-6));
    CHECK(dot(p.normal, p.geometric_normal) > 0.999);
  }
  CHECK(
      holds(error_of(R"({"objects": [{"lathe": {"profile": [[1, 0]]}, "surface": "wood"}]})").what,
            "at least two"));
  CHECK(holds(error_of(R"({"objects": [{"lathe": {"profile": [[1, 0], [-1, 1]]},
                                        "surface": "wood"}]})")
                  .what,
              "below 0"));
}

TEST_CASE("a sheet's objects wear the script's surfaces in turn, from the chosen one on") {
  HandProgram h;
  h.matte("a", 0.1);
  h.matte("b", 0.2);
  h.matte("c", 0.3);
  const auto worn = [&](const std::string& chosen) {
    const Result<Scene> s = load_scene(h.program, {"grid", chosen, ""});
    REQUIRE(bool(s));
    std::string names;
    for (const Object& o : s->data().objects)
      if (o.test) names += s->data().surfaces[std::size_t(o.surface)].name;
    return names;
  };
  CHECK(worn("") == "abcabcabcabc");
  CHECK(worn("b") == "bcabcabcabca");
}

TEST_CASE("an instance has the shape of a named object, and a place and surface of its own") {
  HandProgram h;
  h.matte("wood", 0.5);
  h.matte("clay", 0.2);
  const Result<SceneData> r = parse_scene(h.program, {}, R"({"objects": [
      {"name": "pin", "surface": "wood", "scale": 2, "translate": [5, 0, 0],
       "mesh": {"positions": [[0, 0, 0], [0, 0, 1], [0, 1, 0]], "triangles": [[0, 1, 2]]}},
      {"instance": "pin", "surface": "clay", "scale": 3, "rotate": [0, 90, 0]}]})",
                                          "s", "");
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + r.error().what));
  const Mesh& m = std::get<Mesh>(r->objects[1].shape);
  CHECK(m.positions[1].x == doctest::Approx(3));
  CHECK(m.positions[2].y == doctest::Approx(3));
  CHECK(r->surfaces[std::size_t(r->objects[1].surface)].name == "clay");

  const Error none = error_of(R"({"objects": [{"name": "pin", "sphere": {}, "surface": "wood"},
                                              {"instance": "pni", "surface": "wood"}]})");
  CHECK(none.where == "s.json: objects[1].instance");
  CHECK(holds(none.hint, "did you mean `pin`?"));
  const Error both = error_of(R"({"objects": [{"name": "pin", "sphere": {}, "surface": "wood"},
                                              {"name": "pin", "disc": {}, "surface": "wood"},
                                              {"instance": "pin", "surface": "wood"}]})");
  CHECK(both.where == "s.json: objects[2].instance");
  CHECK(both.what == "objects[0] and objects[1] are both called `pin`");
  CHECK(holds(error_of(R"({"objects": [{"name": "pin", "sphere": {}, "surface": "wood"},
                           {"instance": "pin", "disc": {}, "surface": "wood"}]})")
                  .what,
              "either `instance` or `disc`"));
}

TEST_CASE("a knot is a closed tube around a curve") {
  HandProgram h;
  h.matte("wood", 0.5);
  Result<SceneData> r = parse_scene(
      h.program, {},
      R"({"objects": [{"surface": "wood", "knot": {"windings": [2, 3], "radius": 3, "tube": 0.4}}]})",
      "s", "");
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().where + r.error().what));
  const Mesh m = std::get<Mesh>(r->objects[0].shape);
  // The curve's length by its own formula; by Pappus and Guldin a tube's area is that times its
  // girth.
  double curve = 0;
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * kPi<double> * i / n, far = 2 + std::cos(3 * a);
    curve += std::sqrt(9 + 4 * far * far) * 2 * kPi<double> / n;
  }
  // Chords of 1/64 of the girth and 1/256 of each winding: short by angle squared over 24, each.
  CHECK(area(Shape(m)) == doctest::Approx(curve * 2 * kPi<double> * 0.4).epsilon(1e-3));
  CHECK(contains(Shape(m), {3, 0, 0}));
  CHECK_FALSE(contains(Shape(m), {0, 0, 0}));
  CHECK_FALSE(contains(Shape(m), {3.5, 0, 0}));
  for (std::uint32_t t = 0; t < m.triangles.size(); t += 7) {
    const SurfacePoint p = surface_at(m, t, 0.3, 0.3);
    CHECK(dot(p.geometric_normal, p.normal) > 0.99);
  }
  CHECK(holds(error_of(R"({"objects": [{"knot": {"windings": [2, 4]}, "surface": "wood"}]})").what,
              "without a common divisor"));
}
