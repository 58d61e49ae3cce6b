// SPDX-License-Identifier: Apache-2.0
// Scene files. Every key is known, every value has its type and range checked, and every message
// names the place: `file: objects[2].material`. docs/scene.md is the manual of this file.
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <span>
#include <sstream>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/warp.h"
#include "lang/diagnostics.h"
#include "renderer/scene.h"

namespace mms::renderer {
namespace {

using Json = nlohmann::json;
using vm::DescriptorForm;

/// A mistake in the scene, on its way to `parse_scene`; it never leaves this file.
struct Mistake {
  Error error;
};

std::string join(const std::vector<std::string>& words) {
  std::string s;
  for (const std::string& w : words) s += (s.empty() ? "`" : ", `") + w + "`";
  return s;
}

/// A hint for an unknown word: the nearest of what could stand there, and all of it.
std::string hint_for(const std::string& word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "there is none";
  const std::string near = lang::nearest(word, candidates);
  const std::string all = "known: " + join(candidates);
  return near.empty() ? all : fmt::format("did you mean `{}`? {}", near, all);
}

/// A JSON value and where it stands.
class Node {
 public:
  Node(const Json& json, std::string file, std::string path)
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(std::string what, std::string hint = {}) const {
    throw Mistake{{path_.empty() ? file_ : file_ + ": " + path_, std::move(what), std::move(hint)}};
  }

  /// Checks that this is an object with no other keys than `keys`.
  void keys(std::initializer_list<const char*> keys) const {
    if (!json_->is_object()) fail(fmt::format("expected an object {{...}}, found {}", kind()));
    const std::vector<std::string> known(keys.begin(), keys.end());
    for (const auto& [key, value] : json_->items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        member(key).fail(fmt::format("unknown key `{}`", key), hint_for(key, known));
  }

  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  Node operator[](const char* key) const {
    if (!has(key)) fail(fmt::format("missing key `{}`", key));
    return member(key);
  }
  std::vector<std::pair<std::string, Node>> members() const {
    if (!json_->is_object()) fail(fmt::format("expected an object {{...}}, found {}", kind()));
    std::vector<std::pair<std::string, Node>> r;
    for (const auto& [key, value] : json_->items()) r.emplace_back(key, member(key));
    return r;
  }
  std::vector<Node> elements() const {
    if (!json_->is_array()) fail(fmt::format("expected an array [...], found {}", kind()));
    std::vector<Node> r;
    for (std::size_t i = 0; i < json_->size(); ++i)
      r.emplace_back((*json_)[i], file_, fmt::format("{}[{}]", path_, i));
    return r;
  }

  double number(double low = -1e9, double high = 1e9) const {
    if (!json_->is_number()) fail(fmt::format("expected a number, found {}", kind()));
    const double x = json_->get<double>();
    if (!(x >= low && x <= high))
      fail(fmt::format("{} is out of range: it must lie in [{}, {}]", x, low, high));
    return x;
  }
  double number_or(const char* key, double otherwise, double low, double high) const {
    return has(key) ? (*this)[key].number(low, high) : otherwise;
  }
  bool logic() const {
    if (!json_->is_boolean()) fail(fmt::format("expected true or false, found {}", kind()));
    return json_->get<bool>();
  }
  std::string text() const {
    if (!json_->is_string()) fail(fmt::format("expected a string, found {}", kind()));
    return json_->get<std::string>();
  }
  Vec3d vec3(double low = -1e9, double high = 1e9) const {
    const std::vector<Node> e = elements();
    if (e.size() != 3) fail(fmt::format("expected 3 numbers, found {}", e.size()));
    return {e[0].number(low, high), e[1].number(low, high), e[2].number(low, high)};
  }
  Vec3d direction() const {
    const Vec3d v = vec3();
    if (!(length(v) > 1e-12)) fail("a direction must not be zero");
    return v;
  }
  /// One number for grey, or linear red, green and blue.
  Rgb rgb(double high) const {
    if (json_->is_number()) {
      const double x = number(0, high);
      return {x, x, x};
    }
    const Vec3d v = vec3(0, high);
    return {v.x, v.y, v.z};
  }
  bool is_object() const { return json_->is_object(); }

 private:
  Node member(const std::string& key) const {
    return {(*json_)[key], file_, path_.empty() ? key : path_ + "." + key};
  }
  std::string kind() const {
    return json_->is_string() ? "the string \"" + json_->get<std::string>() + "\""
                              : std::string(json_->type_name());
  }

  const Json* json_;
  std::string file_, path_;
};

constexpr double kDegree = kPi<double> / 180;

/// Turn about x, then y, then z.
Frame<double> euler(Vec3d degrees) {
  const Vec3d a = degrees * kDegree;
  const auto turn = [&](Vec3d v) {
    v = {v.x, std::cos(a.x) * v.y - std::sin(a.x) * v.z, std::sin(a.x) * v.y + std::cos(a.x) * v.z};
    v = {std::cos(a.y) * v.x + std::sin(a.y) * v.z, v.y,
         -std::sin(a.y) * v.x + std::cos(a.y) * v.z};
    return Vec3d{std::cos(a.z) * v.x - std::sin(a.z) * v.y,
                 std::sin(a.z) * v.x + std::cos(a.z) * v.y, v.z};
  };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

class Parser {
 public:
  Parser(const vm::Program& program, const SceneSource& source, std::string folder)
      : program_(program), source_(source), folder_(std::move(folder)) {}

  SceneData scene(const Node& root) {
    root.keys({"camera", "environment", "materials", "objects"});
    if (root.has("camera")) camera(root["camera"]);
    if (root.has("environment")) environment(root["environment"]);
    if (root.has("materials"))
      for (const auto& [name, node] : root["materials"].members()) fixed_surface(name, node);
    for (const Node& n : root["objects"].elements()) object(n);
    if (data_.objects.empty()) root["objects"].fail("the scene has no object");
    return std::move(data_);
  }

 private:
  void camera(const Node& n) {
    n.keys({"position", "target", "up", "fov", "aperture", "focus"});
    Camera& c = data_.camera;
    c.position = n["position"].vec3();
    c.target = n["target"].vec3();
    if (n.has("up")) c.up = n["up"].direction();
    c.fov = n.number_or("fov", 35, 0.01, 175) * kDegree;
    c.aperture = n.number_or("aperture", 0, 0, 1e6);
    const Vec3d view = c.target - c.position;
    if (!(length(view) > 1e-9)) n["target"].fail("target and position are the same point");
    if (!(length(cross(view, c.up)) > 1e-9 * length(view) * length(c.up)))
      n.fail("`up` is parallel to the view direction", "state another \"up\"");
    c.focus = n.number_or("focus", length(view), 1e-6, 1e9);
  }

  void environment(const Node& n) {
    n.keys({"constant", "image", "scale", "rotate"});
    Environment& e = data_.environment;
    if (n.has("constant") == n.has("image"))
      n.fail("an environment has either `constant` or `image`");
    if (n.has("constant")) {
      e.radiance = n["constant"].rgb(1e9);
      if (n.has("scale") || n.has("rotate"))
        n.fail("`scale` and `rotate` belong to an environment with `image`");
      return;
    }
    Result<EnvironmentImage> image = load_environment(path_of(n["image"]));
    if (!image) n["image"].fail(image.error().what, image.error().hint);
    e.image = std::move(*image);
    const double scale = n.number_or("scale", 1, 0, 1e9);
    e.radiance = {scale, scale, scale};
    e.rotation = n.number_or("rotate", 0, -1e6, 1e6) * kDegree;
  }

  void fixed_surface(const std::string& name, const Node& n) {
    n.keys({"matte", "checker", "size", "emission", "invisible"});
    Surface s{name, nullptr, {}};
    if (n.has("matte")) s.fixed.matte = n["matte"].rgb(1);
    if (n.has("checker")) s.fixed.checker = n["checker"].rgb(1);
    s.fixed.checker_size = n.number_or("size", 0.25, 1e-6, 1e6);
    if (n.has("emission")) s.fixed.emission = n["emission"].rgb(1e9);
    if (n.has("invisible")) s.fixed.invisible = n["invisible"].logic();
    data_.surfaces.push_back(std::move(s));
  }

  void object(const Node& n) {
    n.keys({"name", "sphere", "quad", "disc", "box", "mesh", "translate", "rotate", "scale",
            "surface", "volume", "test"});
    Object o;
    if (n.has("name")) o.name = n["name"].text();
    if (n.has("translate")) o.transform.move = n["translate"].vec3();
    if (n.has("rotate")) o.transform.axes = euler(n["rotate"].vec3());
    o.transform.scale = n.number_or("scale", 1, 1e-9, 1e9);
    o.test = n.has("test") && n["test"].logic();
    if (o.test) turn(o.transform);
    o.shape = shape(n, o.transform);
    bind(n, o);
    if (o.volume >= 0 && open(o.shape))
      n.fail("a volume needs a closed object", "a sphere, a box, or a closed mesh");
    data_.objects.push_back(std::move(o));
  }

  /// As `SceneSource::turn` asks.
  void turn(Transform& t) const {
    const double c = std::cos(source_.turn), s = std::sin(source_.turn);
    for (Vec3d* axis : {&t.axes.s, &t.axes.t, &t.axes.n})
      *axis = {c * axis->x + s * axis->z, axis->y, c * axis->z - s * axis->x};
  }

  Shape shape(const Node& n, Transform& transform) {
    const int count =
        n.has("sphere") + n.has("quad") + n.has("disc") + n.has("box") + n.has("mesh");
    if (count != 1) n.fail("an object has one of `sphere`, `quad`, `disc`, `box` and `mesh`");
    const Transform& t = transform;
    if (n.has("sphere")) {
      const Node s = n["sphere"];
      s.keys({"center", "radius"});
      const Vec3d centre = s.has("center") ? s["center"].vec3() : Vec3d{};
      return Sphere{t.point(centre), s.number_or("radius", 1, 1e-9, 1e9) * t.scale, t.axes};
    }
    if (n.has("quad")) {
      const Node s = n["quad"];
      s.keys({"corner", "u", "v"});
      const Vec3d u = s["u"].direction(), v = s["v"].direction();
      if (!(length(cross(u, v)) > 1e-12)) s.fail("`u` and `v` are parallel");
      return Quad{t.point(s["corner"].vec3()), t.direction(u) * t.scale, t.direction(v) * t.scale};
    }
    if (n.has("disc")) {
      const Node s = n["disc"];
      s.keys({"center", "normal", "radius"});
      const Vec3d centre = s.has("center") ? s["center"].vec3() : Vec3d{};
      const Vec3d normal = s.has("normal") ? s["normal"].direction() : Vec3d{0, 1, 0};
      return Disc{t.point(centre), Frame<double>::around(normalize(t.direction(normal))),
                  s.number_or("radius", 1, 1e-9, 1e9) * t.scale};
    }
    if (n.has("box")) {
      const Node s = n["box"];
      s.keys({"center", "size"});
      const Vec3d centre = s.has("center") ? s["center"].vec3() : Vec3d{};
      const Vec3d size = s.has("size") ? s["size"].vec3(1e-9, 1e9) : Vec3d{2, 2, 2};
      return Box{t.point(centre), t.axes, size * (0.5 * t.scale)};
    }
    if (n["mesh"].is_object()) return written_mesh(n["mesh"], t);
    Result<Mesh> mesh = load_mesh(path_of(n["mesh"]), t);
    if (!mesh) n["mesh"].fail(mesh.error().what, mesh.error().hint);
    return std::move(*mesh);
  }

  /// A mesh whose corners stand in the scene itself.
  Mesh written_mesh(const Node& n, const Transform& t) {
    n.keys({"positions", "triangles", "normals", "uvs"});
    Mesh m;
    for (const Node& p : n["positions"].elements()) m.positions.emplace_back(t.point(p.vec3()));
    const auto one_each = [&](const char* key, std::size_t count) {
      if (count != m.positions.size())
        n[key].fail(fmt::format("{} entries for {} positions", count, m.positions.size()));
    };
    if (n.has("normals")) {
      for (const Node& p : n["normals"].elements())
        m.normals.emplace_back(t.direction(normalize(p.direction())));
      one_each("normals", m.normals.size());
    }
    if (n.has("uvs")) {
      for (const Node& p : n["uvs"].elements()) {
        const std::vector<Node> e = p.elements();
        if (e.size() != 2) p.fail(fmt::format("expected 2 numbers, found {}", e.size()));
        m.uvs.push_back({float(e[0].number()), float(e[1].number())});
      }
      one_each("uvs", m.uvs.size());
    }
    for (const Node& triangle : n["triangles"].elements()) {
      std::array<std::uint32_t, 3> corners{};
      const std::vector<Node> e = triangle.elements();
      if (e.size() != 3) triangle.fail(fmt::format("expected 3 corners, found {}", e.size()));
      for (int k = 0; k < 3; ++k) {
        const double corner = e[k].number(0, double(m.positions.size()) - 1);
        if (corner != std::floor(corner)) e[k].fail("expected the number of a position");
        corners[k] = std::uint32_t(corner);
      }
      m.triangles.push_back(corners);
      if (!(triangle_area(m, std::uint32_t(m.triangles.size() - 1)) > 0))
        triangle.fail("a triangle without area");
    }
    if (m.triangles.empty()) n["triangles"].fail("the mesh has no triangle");
    return m;
  }

  /// Finds the descriptors of an object: what the caller asked for, what the scene says, or the
  /// only one there is.
  void bind(const Node& n, Object& o) {
    std::string surface = n.has("surface") ? n["surface"].text() : "";
    std::string volume = n.has("volume") ? n["volume"].text() : "";
    if (o.test) {
      if (!source_.surface.empty()) surface = source_.surface;
      if (!source_.volume.empty()) volume = source_.volume;
      if (surface.empty()) surface = only_surface(n, volume);
      if (volume.empty() && program_.find(DescriptorForm::Volume, surface)) volume = surface;
      data_.test_surface = surface;
      data_.test_volume = volume;
    }
    const bool asked = o.test && !source_.surface.empty();
    if (surface.empty() && volume.empty())
      n.fail("the object has no `surface`",
             "name a material of the scene or a surface of the script");
    o.surface = surface.empty() ? invisible_surface() : surface_index(n, surface, asked);
    if (volume.empty()) return;
    const bool asked_volume = o.test && !source_.volume.empty();
    const vm::Descriptor* d = program_.find(DescriptorForm::Volume, volume);
    if (!d) unknown(n, "volume", volume, names(DescriptorForm::Volume), asked_volume);
    data_.volumes.push_back({volume, d});
    o.volume = int(data_.volumes.size()) - 1;
  }

  /// What an unbound test object wears: the program's only surface; nothing if it has volumes only.
  std::string only_surface(const Node& n, std::string& volume) {
    const std::vector<std::string> surfaces = names(DescriptorForm::Surface);
    if (surfaces.size() == 1) return surfaces[0];
    if (surfaces.empty()) {
      const std::vector<std::string> volumes = names(DescriptorForm::Volume);
      if (volume.empty() && volumes.size() == 1) volume = volumes[0];
      if (!volume.empty()) return "";
      if (volumes.empty()) {
        throw Mistake{{"script", "the script describes no surface and no volume",
                       "add `surface \"name\" ... end`"}};
      }
      throw Mistake{
          {"--volume", "the script has several volumes", "choose one of " + join(volumes)}};
    }
    (void)n;
    throw Mistake{
        {"--surface", "the script has several surfaces", "choose one of " + join(surfaces)}};
  }

  int invisible_surface() {
    FixedSurface nothing;
    nothing.invisible = true;
    data_.surfaces.push_back({"", nullptr, nothing});
    return int(data_.surfaces.size()) - 1;
  }

  int surface_index(const Node& n, const std::string& name, bool asked) {
    const auto known = [&] {
      for (std::size_t i = 0; i < data_.surfaces.size(); ++i)
        if (data_.surfaces[i].name == name) return int(i);
      return -1;
    };
    if (const int i = known(); i >= 0) return i;
    const vm::Descriptor* d = program_.find(DescriptorForm::Surface, name);
    if (!d) {
      std::vector<std::string> candidates = names(DescriptorForm::Surface);
      for (const Surface& s : data_.surfaces)
        if (!s.script && !s.name.empty()) candidates.push_back(s.name);
      unknown(n, "surface", name, candidates, asked);
    }
    data_.surfaces.push_back({name, d, {}});
    return int(data_.surfaces.size()) - 1;
  }

  [[noreturn]] void unknown(const Node& n, const char* key, const std::string& name,
                            const std::vector<std::string>& candidates, bool asked) {
    const std::string what = fmt::format("unknown {} `{}`", key, name);
    if (asked) throw Mistake{{fmt::format("--{}", key), what, hint_for(name, candidates)}};
    n[key].fail(what, hint_for(name, candidates));
  }

  std::vector<std::string> names(DescriptorForm form) const {
    std::vector<std::string> r;
    for (const vm::Descriptor& d : program_.descriptors)
      if (d.form == form) r.push_back(d.name);
    return r;
  }

  std::string path_of(const Node& n) const {
    const std::filesystem::path p = n.text();
    return (p.is_absolute() || folder_.empty() ? p : std::filesystem::path(folder_) / p).string();
  }

  const vm::Program& program_;
  const SceneSource& source_;
  std::string folder_;
  SceneData data_;
};

/// Of the text, of what was read from the files that it names, and of what the test object wears.
std::uint64_t hash_of(const SceneData& data, std::string_view text) {
  const auto add = [](std::uint64_t h, const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, h);
  };
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));  // no padding
  std::uint64_t h = hash_bytes(text);
  h = hash_bytes(data.test_surface, h);
  h = hash_bytes(data.test_volume, h);
  for (const Object& o : data.objects)
    if (const Mesh* mesh = std::get_if<Mesh>(&o.shape)) {
      h = add(h, mesh->positions);
      h = add(h, mesh->triangles);
      h = add(h, mesh->normals);
      h = add(h, mesh->uvs);
    }
  if (data.environment.image) h = add(h, data.environment.image->rgb);
  return h;
}

}  // namespace

Result<SceneData> parse_scene(const vm::Program& program, const SceneSource& source,
                              std::string_view text, const std::string& origin,
                              const std::string& folder) {
  Json json;
  try {
    json = Json::parse(text, nullptr, true, /*ignore_comments=*/true);
  } catch (const Json::parse_error& e) {
    std::string what = e.what();  // "[json.exception.parse_error.101] parse error at line 3, ..."
    if (const std::size_t end = what.find("] "); end != std::string::npos) what.erase(0, end + 2);
    return Error{origin, what, "scene files are JSON; comments are allowed (docs/scene.md)"};
  }
  try {
    SceneData data = Parser(program, source, folder).scene(Node(json, origin, ""));
    data.name = origin;
    return data;
  } catch (const Mistake& m) {
    return m.error;
  }
}

Result<Scene> load_scene(const vm::Program& program, const SceneSource& source) {
  std::string text, origin = source.name, folder;
  if (const auto builtin = builtin_scene_text(source.name)) {
    text = *builtin;
    origin = "scene `" + source.name + "`";
  } else {
    std::ifstream in(source.name, std::ios::binary);
    std::error_code ignored;
    if (!in || std::filesystem::is_directory(source.name, ignored)) {
      std::vector<std::string> names = builtin_scenes();
      const std::string near = lang::nearest(source.name, names);
      return Error{"--scene", fmt::format("no scene `{}`", source.name),
                   (near.empty() ? "" : fmt::format("did you mean `{}`? ", near)) +
                       "a path to a .json file, or one of " + join(names)};
    }
    std::ostringstream s;
    s << in.rdbuf();
    text = std::move(s).str();
    folder = std::filesystem::path(source.name).parent_path().string();
  }
  Result<SceneData> data = parse_scene(program, source, text, origin, folder);
  if (!data) return data.error();
  data->hash = hash_combine(hash_of(*data, text), std::bit_cast<std::uint64_t>(source.turn));
  return Scene(std::make_shared<const SceneData>(std::move(*data)));
}

const std::string& Scene::surface() const { return data_->test_surface; }
const std::string& Scene::volume() const { return data_->test_volume; }

Bounds SceneData::scene_bounds() const {
  Bounds b;
  for (const Object& o : objects) b.add(bounds(o.shape));
  return b;
}

}  // namespace mms::renderer
