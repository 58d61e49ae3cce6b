// SPDX-License-Identifier: Apache-2.0
// The scenes that need no file, in the same format as a file: `docs/scene.md`.
#include "renderer/scene.h"

namespace mms::renderer {
namespace {

struct BuiltinScene {
  std::string_view name, text;
};

constexpr BuiltinScene kScenes[] = {
    {"sphere", R"({
  // The test sphere: radius 1, resting on a matte checkered ground before a plain backdrop.
  // Most things are placed along the camera's own axes: turned by 29.87 degrees about y.
  "camera": {"position": [3.1, 1.75, 5.4], "target": [0, -0.12, 0], "fov": 30},
  "environment": {"constant": [0.15, 0.16, 0.18]},
  "materials": {
    "ground": {"matte": 0.26, "checker": 0.40, "size": 0.5},
    "backdrop": {"matte": 0.3},
    "key": {"matte": 0, "emission": 7.5},
    "top": {"matte": 0, "emission": 1.1},
    "rim": {"matte": 0, "emission": [4.6, 5.0, 5.6]},
    "grey90": {"matte": 0.90}, "grey59": {"matte": 0.591}, "grey36": {"matte": 0.362},
    "grey20": {"matte": 0.198}, "grey09": {"matte": 0.090}, "grey03": {"matte": 0.031}
  },
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true},
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
     "rotate": [0, 29.87, 0], "surface": "rim"},
    // Reference greys, light to dark: reflectances of a standard chart.
    {"quad": {"corner": [-1.02, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey90"},
    {"quad": {"corner": [-0.68, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey59"},
    {"quad": {"corner": [-0.34, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey36"},
    {"quad": {"corner": [0.00, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey20"},
    {"quad": {"corner": [0.34, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey09"},
    {"quad": {"corner": [0.68, -0.999, 1.62], "u": [0.32, 0, 0], "v": [0, 0, -0.26]}, "rotate": [0, 29.87, 0], "surface": "grey03"}
  ]
})"},
    {"furnace", R"({
  // A ball in uniform light: one that absorbs nothing vanishes.
  "camera": {"position": [0, 0, 6], "target": [0, 0, 0], "fov": 26},
  "environment": {"constant": 1},
  "objects": [{"name": "ball", "sphere": {"radius": 1}, "test": true}]
})"},
    {"cornell", R"({
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
    {"quad": {"corner": [-0.5, 1.999, -0.5], "u": [1, 0, 0], "v": [0, 0, 1]}, "surface": "lamp"}
  ]
})"},
};

}  // namespace

std::vector<std::string> builtin_scenes() {
  std::vector<std::string> names;
  for (const BuiltinScene& s : kScenes) names.emplace_back(s.name);
  return names;
}

std::optional<std::string_view> builtin_scene_text(std::string_view name) {
  for (const BuiltinScene& s : kScenes)
    if (s.name == name) return s.text;
  return std::nullopt;
}

}  // namespace mms::renderer
