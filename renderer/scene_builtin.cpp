// SPDX-License-Identifier: Apache-2.0
// The scenes that need no file, in the same format as a file: `docs/scene.md`.
#include "renderer/scene.h"

namespace mms::renderer {
namespace {

/// Where the test object of several scenes stands, besides the chart of greys before it.
struct Place {
  std::string_view light_and_materials;  ///< the list of materials is open at its end
  std::string_view objects;  ///< so is that of the objects, which the chart goes on with
};

/// A matte checkered ground before a plain backdrop, and three lights. Most things are placed along
/// the camera's own axes: turned by 29.87 degrees about y.
constexpr Place kStudio{R"(
  "environment": {"constant": [0.15, 0.16, 0.18]},
  "materials": {
    "ground": {"matte": 0.26, "checker": 0.40, "size": 0.5},
    "backdrop": {"matte": 0.3},
    "key": {"matte": 0, "emission": 7.5},
    "top": {"matte": 0, "emission": 1.1},
    "rim": {"matte": 0, "emission": [4.6, 5.0, 5.6]},)",
                        R"(,
    {"quad": {"corner": [-14, -1, 12], "u": [28, 0, 0], "v": [0, 0, -28]}, "surface": "ground"},
    {"quad": {"corner": [-14, -1, -5], "u": [28, 0, 0], "v": [0, 12, 0]}, "rotate": [0, 29.87, 0], "surface": "backdrop"},
    // Key light: large and soft, to the left, above and before the ball.
    {"name": "key", "disc": {"center": [-3.4, 3.9, 2.6], "normal": [3.4, -3.9, -2.6], "radius": 1.9},
     "rotate": [0, 29.87, 0], "surface": "key"},
    // Top light: broad and dim, a second horizon for what mirrors.
    {"name": "top", "quad": {"corner": [-2.6, 5.2, -3.4], "u": [5.2, 0, 0], "v": [0, 0, 4.4]},
     "rotate": [0, 29.87, 0], "surface": "top"},
    // Rim light: a strip behind and to the right, which draws the edge of dark and glossy balls.
    {"name": "rim", "quad": {"corner": [3.155, 2.646, -2.239], "u": [-0.566, 0, -0.566], "v": [0.555, -2.892, -0.555]},
     "rotate": [0, 29.87, 0], "surface": "rim"},)"};

/// Under the sky. The sun lights a white ground to a luminance of 0.7, the sky to 0.3. Its colour
/// is CIE daylight of 5200 K, so that both together are about white. Seen from the ball its radius
/// is one degree; the real one's is 0.27, but that would be much noisier where light is mirrored.
/// The ground ends 4 km from the camera, 0.02 degrees below the horizon.
constexpr Place kOutdoors{R"(
  "environment": {"sky": "clear", "sun": [-1, 2, 2], "scale": 0.3},
  "materials": {
    "ground": {"matte": 0.26, "checker": 0.40, "size": 0.5},
    "sun": {"matte": 0, "emission": [3950, 3345, 2610]},)",
                          R"(,
    {"quad": {"corner": [-4000, -1, 4000], "u": [8000, 0, 0], "v": [0, 0, -8000]}, "surface": "ground"},
    {"name": "sun", "disc": {"center": [-1000, 2000, 2000], "normal": [1, -2, -2], "radius": 52.365}, "surface": "sun"},)"};

/// Reflectances of a standard chart.
constexpr std::string_view kChartMaterials = R"(
    "grey90": {"matte": 0.90}, "grey59": {"matte": 0.591}, "grey36": {"matte": 0.362},
    "grey20": {"matte": 0.198}, "grey09": {"matte": 0.090}, "grey03": {"matte": 0.031}
  },
)";
constexpr std::string_view kChartObjects = R"(
    // Reference greys, light to dark: reflectances of a standard chart.
    {"quad": {"corner": [-1.02, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey90"},
    {"quad": {"corner": [-0.68, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey59"},
    {"quad": {"corner": [-0.34, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey36"},
    {"quad": {"corner": [0.00, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey20"},
    {"quad": {"corner": [0.34, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey09"},
    {"quad": {"corner": [0.68, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey03"}
)";

/// Without the outer braces; the list of objects is open at its end.
struct BuiltinScene {
  std::string_view name;
  const Place* place;  ///< or null: the scene says all itself
  std::string_view text;
};

constexpr BuiltinScene kScenes[] = {
    {"sphere", &kStudio, R"(
  // The test sphere: radius 1, resting on the ground.
  "camera": {"position": [3.1, 1.75, 5.4], "target": [0, -0.12, 0], "fov": 30},
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true})"},
    {"shaderball", &kStudio, R"(
  // A ball on a foot, turned on a lathe: a groove with sharp edges, a thin neck, a rounded rim.
  "camera": {"position": [3.1, 1.75, 5.4], "target": [0, -0.12, 0], "fov": 28},
  "objects": [
    {"name": "ball", "test": true, "lathe": {"segments": 192, "profile": [
      [0, -1], [0.72, -1], [0.74, -0.9946], [0.7546, -0.98], [0.76, -0.96], [0.7546, -0.94],
      [0.74, -0.9254], [0.72, -0.92], [0.5, -0.9], [0.36, -0.84], [0.36, -0.641],
      [0.412, -0.6149], [0.4622, -0.5852], [0.5102, -0.5523], [0.5559, -0.5162],
      [0.5991, -0.477], [0.6395, -0.4351], [0.6769, -0.3905], [0.7113, -0.3434],
      [0.7424, -0.2942], [0.77, -0.2429], [0.7942, -0.1899], [0.8147, -0.1354],
      [0.8315, -0.0796], [0.8444, -0.0228], [0.8535, 0.0347], [0.8587, 0.0927],
      [0.8599, 0.1509], [0.8572, 0.2091], [0.8506, 0.267], [0.8476, 0.2855], [0.7589, 0.2703],
      [0.7285, 0.3895], [0.8136, 0.4187], [0.8074, 0.4361], [0.7855, 0.49], [0.76, 0.5424],
      [0.7311, 0.5929], [0.6987, 0.6414], [0.6632, 0.6875], [0.6246, 0.7312], [0.5832, 0.7721],
      [0.539, 0.8101], [0.4924, 0.8451], [0.4436, 0.8768], [0.3927, 0.9051], [0.34, 0.9299],
      [0.2858, 0.9511], [0.2302, 0.9686], [0.1736, 0.9823], [0.1162, 0.9921], [0.0582, 0.998],
      [0, 1]
    ]}})"},
    {"outdoors", &kOutdoors, R"(
  // The test sphere under a clear sky and the sun, which stands before it to the left.
  "camera": {"position": [3.1, 0.8, 5.4], "target": [0, -0.1, 0], "fov": 30},
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true})"},
    {"furnace", nullptr, R"(
  // A ball in uniform light: one that absorbs nothing vanishes.
  "camera": {"position": [0, 0, 6], "target": [0, 0, 0], "fov": 26},
  "environment": {"constant": 1},
  "objects": [{"name": "ball", "sphere": {"radius": 1}, "test": true})"},
    {"cornell", nullptr, R"(
  // A closed box of coloured walls with one lamp: light bounces many times.
  "camera": {"position": [0, 0, 7.6], "target": [0, 0, 0], "fov": 36},
  "materials": {
    "white": {"matte": 0.73}, "red": {"matte": [0.57, 0.043, 0.044]}, "green": {"matte": [0.105, 0.378, 0.076]},
    "lamp": {"matte": 0.73, "emission": 16}
  },
  "objects": [
    {"name": "ball", "sphere": {"center": [0, -1, 0], "radius": 1}, "test": true},
    {"quad": {"corner": [-2, -2, 2], "u": [4, 0, 0], "v": [0, 0, -4]}, "surface": "white"},
    {"quad": {"corner": [-2, 2, -2], "u": [4, 0, 0], "v": [0, 0, 4]}, "surface": "white"},
    {"quad": {"corner": [-2, -2, -2], "u": [4, 0, 0], "v": [0, 4, 0]}, "surface": "white"},
    {"quad": {"corner": [-2, -2, 2], "u": [0, 0, -4], "v": [0, 4, 0]}, "surface": "red"},
    {"quad": {"corner": [2, -2, -2], "u": [0, 0, 4], "v": [0, 4, 0]}, "surface": "green"},
    {"quad": {"corner": [-0.5, 1.999, -0.5], "u": [1, 0, 0], "v": [0, 0, 1]}, "surface": "lamp"})"},
    {"backlit", nullptr, R"(
  // The ball between the camera and a large lamp: what lets light through glows.
  "camera": {"position": [0, 0.6, 6], "target": [0, 0, 0], "fov": 28},
  "environment": {"constant": 0.04},
  "materials": {"ground": {"matte": 0.2, "checker": 0.35, "size": 0.5}, "lamp": {"matte": 0, "emission": 1.5}},
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true},
    {"quad": {"corner": [-9, -1, 9], "u": [18, 0, 0], "v": [0, 0, -18]}, "surface": "ground"},
    {"name": "lamp", "quad": {"corner": [-3, -0.6, -3.5], "u": [6, 0, 0], "v": [0, 4, 0]}, "surface": "lamp"})"},
    {"prism", nullptr, R"(
  // A prism, seen before six bright slits that stand aside: what its glass bends shows each of them
  // where its index puts it, and as a spectrum.
  "camera": {"position": [0, 0.3, 5], "target": [0, 0.25, 0], "fov": 34},
  "environment": {"constant": 0.01},
  "materials": {"ground": {"matte": 0.2, "checker": 0.35, "size": 0.5}, "slit": {"matte": 0, "emission": 3}},
  "objects": [
    {"name": "prism", "test": true, "rotate": [0, 12, 0], "mesh": {
      "positions": [[1.1547, -1, 0], [-0.57735, -1, 1], [-0.57735, -1, -1],
                    [1.1547, 1.4, 0], [-0.57735, 1.4, 1], [-0.57735, 1.4, -1]],
      "triangles": [[0, 3, 1], [1, 3, 4], [1, 4, 2], [2, 4, 5], [2, 5, 0], [0, 5, 3], [0, 1, 2], [3, 5, 4]]}},
    {"quad": {"corner": [-20, -1, 20], "u": [40, 0, 0], "v": [0, 0, -40]}, "surface": "ground"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-2.481, 0, -8.651], "rotate": [0, 16, 0], "surface": "slit"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-4.225, 0, -7.947], "rotate": [0, 28, 0], "surface": "slit"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-5.785, 0, -6.894], "rotate": [0, 40, 0], "surface": "slit"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-7.092, 0, -5.541], "rotate": [0, 52, 0], "surface": "slit"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-8.089, 0, -3.945], "rotate": [0, 64, 0], "surface": "slit"},
    {"quad": {"corner": [-0.07, -1, 0], "u": [0.14, 0, 0], "v": [0, 3.2, 0]}, "translate": [-8.733, 0, -2.177], "rotate": [0, 76, 0], "surface": "slit"})"},
    {"grid", nullptr, R"(
  // A sheet of materials: each ball wears another surface of the script, from the chosen one on.
  "camera": {"position": [0, 0, 9], "target": [0, 0, 0], "fov": 29},
  "environment": {"constant": [0.15, 0.16, 0.18]},
  "materials": {"backdrop": {"matte": 0.3, "checker": 0.36, "size": 0.5}, "key": {"matte": 0, "emission": 9},
    "rim": {"matte": 0, "emission": [3, 3.3, 3.6]}},
  "objects": [
    {"sphere": {"radius": 0.46}, "translate": [-1.575, 1.05, 0], "test": 0},
    {"sphere": {"radius": 0.46}, "translate": [-0.525, 1.05, 0], "test": 1},
    {"sphere": {"radius": 0.46}, "translate": [0.525, 1.05, 0], "test": 2},
    {"sphere": {"radius": 0.46}, "translate": [1.575, 1.05, 0], "test": 3},
    {"sphere": {"radius": 0.46}, "translate": [-1.575, 0, 0], "test": 4},
    {"sphere": {"radius": 0.46}, "translate": [-0.525, 0, 0], "test": 5},
    {"sphere": {"radius": 0.46}, "translate": [0.525, 0, 0], "test": 6},
    {"sphere": {"radius": 0.46}, "translate": [1.575, 0, 0], "test": 7},
    {"sphere": {"radius": 0.46}, "translate": [-1.575, -1.05, 0], "test": 8},
    {"sphere": {"radius": 0.46}, "translate": [-0.525, -1.05, 0], "test": 9},
    {"sphere": {"radius": 0.46}, "translate": [0.525, -1.05, 0], "test": 10},
    {"sphere": {"radius": 0.46}, "translate": [1.575, -1.05, 0], "test": 11},
    {"quad": {"corner": [-8, 0, -8], "u": [16, 0, 0], "v": [0, 0, 16]}, "rotate": [90, 0, 0], "translate": [0, 0, -0.5], "surface": "backdrop"},
    {"name": "key", "disc": {"center": [-4, 5, 6], "normal": [4, -5, -6], "radius": 2}, "surface": "key"},
    {"name": "rim", "quad": {"corner": [5, -3, 2], "u": [0, 0, 3], "v": [0, 6, 0]}, "surface": "rim"})"},
};

}  // namespace

std::vector<std::string> builtin_scenes() {
  std::vector<std::string> names;
  for (const BuiltinScene& s : kScenes) names.emplace_back(s.name);
  return names;
}

std::optional<std::string> builtin_scene_text(std::string_view name) {
  for (const BuiltinScene& s : kScenes) {
    if (s.name != name) continue;
    std::string text = "{";
    if (s.place) (text += s.place->light_and_materials) += kChartMaterials;
    text += s.text;
    if (s.place) (text += s.place->objects) += kChartObjects;
    return text + "]}";
  }
  return std::nullopt;
}

}  // namespace mms::renderer
