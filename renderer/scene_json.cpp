// SPDX-License-Identifier: Apache-2.0
// Scene files. Every key is known, every value has its type and range checked, and every message
// names the place: `file: objects[2].material`. docs/scene.md is the manual of this file.
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <sstream>

#include "base/hash.h"
#include "base/warp.h"
#include "lang/diagnostics.h"
#include "renderer/scene_node.h"

namespace mms::renderer {

std::string join(const std::vector<std::string>& words) {
  std::string s;
  for (const std::string& w : words) s += (s.empty() ? "`" : ", `") + w + "`";
  return s;
}

std::string hint_for(const std::string& word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "there is none";
  const std::string near = lang::nearest(word, candidates);
  const std::string all = "known: " + join(candidates);
  return near.empty() ? all : fmt::format("did you mean `{}`? {}", near, all);
}

Error no_such(const char* option, const char* thing, const std::string& name,
              const std::vector<std::string>& names) {
  std::error_code ignored;
  if (std::filesystem::is_directory(name, ignored))
    return {option, fmt::format("`{}` is a folder", name), "name a file in it", Error::Cause::File};
  const std::string near = lang::nearest(name, names);
  const bool path =
      name.find('/') != std::string::npos || std::filesystem::path(name).has_extension();
  return {option, fmt::format("no {} `{}`", thing, name),
          (near.empty() ? "" : fmt::format("did you mean `{}`? ", near)) +
              "the path of a file, or one of " + join(names),
          path ? Error::Cause::File : Error::Cause::Name};
}

Error no_file(const char* thing, const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return {path, fmt::format("`{}` is a folder, not a {} file", path, thing), "name a file in it",
            Error::Cause::File};
  return {path, fmt::format("no {} file `{}`", thing, path), "paths are relative to the scene file",
          Error::Cause::File};
}

namespace {

using vm::DescriptorForm;

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
  /// An object that states a shape.
  struct Named {
    std::string name;
    Node node;
    int object;
  };

 public:
  Parser(const vm::Program& program, const SceneSource& source, std::string folder)
      : program_(program), source_(source), folder_(std::move(folder)) {}

  SceneData scene(const Node& root) {
    root.keys({"camera", "environment", "materials", "objects"});
    if (root.has("camera")) camera(root["camera"]);
    if (!source_.environment.empty())
      data_.environment = environment_named(source_.environment);
    else if (root.has("environment"))
      data_.environment = parse_environment(root["environment"], folder_);
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
    std::vector<std::string> keys = shape_keys();
    for (const char* key : {"name", "instance", "translate", "rotate", "scale", "surface", "volume",
                            "displace", "displace_pixels", "priority", "test"})
      keys.emplace_back(key);
    n.keys(keys);
    if (n.has("instance"))
      for (const std::string& key : shape_keys())
        if (n.has(key.c_str())) n.fail(fmt::format("an object has either `instance` or `{}`", key));
    Object o;
    if (n.has("name")) o.name = n["name"].text();
    if (n.has("translate")) o.transform.move = n["translate"].vec3();
    if (n.has("rotate")) o.transform.axes = euler(n["rotate"].vec3());
    o.transform.scale = n.number_or("scale", 1, 1e-9, 1e9);
    o.test = n.has("test") && (n["test"].is_number() || n["test"].logic());
    if (o.test && n["test"].is_number() && n["test"].number() != std::floor(n["test"].number()))
      n["test"].fail("the number of a place is whole");
    if (o.test) turn(o.transform);
    if (n.has("instance")) {
      const Named& first = original(n);
      o.shape = parse_shape(first.node, o.transform, folder_);
      share(o, first.object);
    } else {
      o.shape = parse_shape(n, o.transform, folder_);
      if (!o.name.empty()) named_.push_back({o.name, n, int(data_.objects.size())});
    }
    o.displace = n.number_or("displace", 0, 1e-9, 1e9);
    o.displace_pixels = n.number_or("displace_pixels", 0, 1e-3, 1e3);
    const char* key = o.displace_pixels > 0 ? "displace_pixels" : "displace";
    if (o.to_displace() && !std::holds_alternative<Sphere>(o.shape) &&
        !std::holds_alternative<Mesh>(o.shape))
      n[key].fail("only spheres and meshes are displaced",
                  fmt::format("write the shape as a mesh, or leave `{}` out: `height` bumps", key));
    if (o.displace > 0 && o.displace_pixels > 0)
      n[key].fail("an edge is in metres or in pixels", "leave one of the two out");
    bind(n, o);
    const bool asked = o.test && !source_.surface.empty();
    if (o.to_displace() && n.has("surface") && !asked &&
        !data_.surfaces[std::size_t(o.surface)].script)
      n[key].fail("a material of the scene has no `height` to displace by",
                  fmt::format("wear a surface of the script that has one, or leave `{}` out", key));
    if (o.volume >= 0 && open(o.shape))
      n.fail("a volume needs a closed object", "a sphere, a box, or a closed mesh");
    const double priority = n.number_or("priority", 0, 0, 1000);
    if (priority != std::floor(priority)) n["priority"].fail("a priority is a whole number");
    o.priority = int(priority);
    if (o.priority > 0 && open(o.shape))
      n["priority"].fail("only a closed object has an inside to take the place of others",
                         "a sphere, a box, or a closed mesh or lathe");
    data_.objects.push_back(std::move(o));
  }

  /// As `SceneSource::turn` asks.
  void turn(Transform& t) const {
    const double c = std::cos(source_.turn), s = std::sin(source_.turn);
    for (Vec3d* axis : {&t.axes.s, &t.axes.t, &t.axes.n})
      *axis = {c * axis->x + s * axis->z, axis->y, c * axis->z - s * axis->x};
  }

  /// Lets rays meet a mesh where its first object stands, turned and moved (renderer/accel.h).
  void share(Object& o, int first) const {
    if (!std::holds_alternative<Mesh>(o.shape)) return;
    o.instance_of = first;
    const Object& f = data_.objects[std::size_t(first)];
    // The transform between both is rounded, and so is each point that goes through it: some units
    // in the last place of all that is added up on the way.
    const Bounds box = bounds(o.shape);
    const double reach = std::max(length(box.low), length(box.high)) + length(o.transform.move) +
                         length(f.transform.move) * o.transform.scale / f.transform.scale;
    o.slack = 32 * 0x1p-24 * reach;
  }

  /// The object whose shape `n` has too.
  const Named& original(const Node& n) const {
    const std::string name = n["instance"].text();
    std::vector<std::string> known;
    const Named* found = nullptr;
    for (const Named& other : named_) {
      if (found && other.name == name)
        n["instance"].fail(fmt::format("objects[{}] and objects[{}] are both called `{}`",
                                       found->object, other.object, name),
                           "give one of them another name");
      if (other.name == name) found = &other;
      known.push_back(other.name);
    }
    if (found) return *found;
    n["instance"].fail(fmt::format("no object `{}` before this one", name), hint_for(name, known));
  }

  /// Finds the descriptors of an object: what the caller asked for, what the scene says, or the
  /// only one there is.
  void bind(const Node& n, Object& o) {
    std::string surface = n.has("surface") ? n["surface"].text() : "";
    std::string volume = n.has("volume") ? n["volume"].text() : "";
    // Named by who knows nothing of the scene's materials, one of which may have that name too.
    const bool of_script = o.test && (!source_.surface.empty() || surface.empty());
    if (o.test) {
      if (!source_.surface.empty()) surface = source_.surface;
      if (!source_.volume.empty()) volume = source_.volume;
      const bool counted = n["test"].is_number();
      if (surface.empty()) surface = counted ? first_surface(n, volume) : only_surface(n, volume);
      if (counted) surface = counted_from(surface, int(n["test"].number(0, 1e6)));
      if (volume.empty() && program_.find(DescriptorForm::Volume, surface)) volume = surface;
      if (data_.test_surface.empty()) data_.test_surface = surface;
      if (data_.test_volume.empty()) data_.test_volume = volume;
    }
    const bool asked = o.test && !source_.surface.empty();
    if (surface.empty() && volume.empty())
      n.fail("the object has no `surface`",
             "name a material of the scene or a surface of the script");
    o.surface = surface.empty() ? invisible_surface() : surface_index(n, surface, of_script, asked);
    if (volume.empty()) return;
    const bool asked_volume = o.test && !source_.volume.empty();
    const vm::Descriptor* d = program_.find(DescriptorForm::Volume, volume);
    if (!d) unknown(n, "volume", volume, names(DescriptorForm::Volume), asked_volume);
    data_.volumes.push_back({volume, d});
    o.volume = int(data_.volumes.size()) - 1;
  }

  /// Of a sheet of materials: the script's first surface.
  std::string first_surface(const Node& n, std::string& volume) const {
    const std::vector<std::string> surfaces = names(DescriptorForm::Surface);
    return surfaces.empty() ? only_surface(n, volume) : surfaces[0];
  }

  /// The surface that stands `count` places after `surface` in the script, round and round.
  std::string counted_from(const std::string& surface, int count) const {
    const std::vector<std::string> all = names(DescriptorForm::Surface);
    const auto at = std::find(all.begin(), all.end(), surface);
    return at == all.end() ? surface
                           : all[(std::size_t(at - all.begin()) + std::size_t(count)) % all.size()];
  }

  /// What an unbound test object wears: the program's only surface; nothing if it has volumes only.
  std::string only_surface(const Node& n, std::string& volume) const {
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

  /// Of the scene's material `name`, else of the script's surface; the other way where `of_script`.
  int surface_index(const Node& n, const std::string& name, bool of_script, bool asked) {
    const auto known = [&](bool script) {
      for (std::size_t i = 0; i < data_.surfaces.size(); ++i)
        if (data_.surfaces[i].name == name && bool(data_.surfaces[i].script) == script)
          return int(i);
      return -1;
    };
    const vm::Descriptor* d = program_.find(DescriptorForm::Surface, name);
    if (!(of_script && d))
      if (const int i = known(false); i >= 0) return i;
    if (const int i = known(true); i >= 0) return i;
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

  const vm::Program& program_;
  const SceneSource& source_;
  std::string folder_;
  std::vector<Named> named_;
  SceneData data_;
};

/// Of the text, of what was read from the files that it names, of the environment that was asked
/// for in place of the text's, and of what the test object wears.
std::uint64_t hash_of(const SceneData& data, const SceneSource& source, std::string_view text) {
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
  const auto& image = data.environment.image;
  const bool read = image && !image->path.empty();  // else all of it follows from the text
  if (read) h = add(h, image->rgb);
  if (!source.environment.empty())
    h = read ? add(h, std::array{image->width, image->height}) : hash_bytes(source.environment, h);
  return hash_combine(h, std::bit_cast<std::uint64_t>(source.turn));
}

}  // namespace

Result<SceneData> parse_scene(const vm::Program& program, const SceneSource& source,
                              std::string_view text, const std::string& origin,
                              const std::string& folder) {
  const Result<Json> json = json_of(text, origin);
  if (!json) return json.error();
  try {
    SceneData data = Parser(program, source, folder).scene(Node(*json, origin, ""));
    data.name = origin;
    return data;
  } catch (Mistake& m) {
    if (m.error.hint.empty()) m.error.hint = "docs/scene.md tells what scenes are made of";
    return std::move(m.error);
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
    if (!in || std::filesystem::is_directory(source.name, ignored))
      return no_such("--scene", "scene", source.name, builtin_scenes());
    std::ostringstream s;
    s << in.rdbuf();
    text = std::move(s).str();
    folder = std::filesystem::path(source.name).parent_path().string();
  }
  Result<SceneData> data = parse_scene(program, source, text, origin, folder);
  if (!data) return data.error();
  data->hash = hash_of(*data, source, text);
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
