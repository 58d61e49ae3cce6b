// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Values of a scene file that know where they stand: what reads a scene throws a `Mistake`, and
/// `parse_scene` catches it, so none leaves the reading of scenes.

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/warp.h"
#include "renderer/scene.h"

namespace mms::renderer {

using Json = nlohmann::json;

inline constexpr double kDegree = kPi<double> / 180;

/// The text of a scene file as JSON. Errors: it is empty, no JSON, or an object has a key twice, of
/// which JSON would keep the last only.
Result<Json> json_of(std::string_view text, const std::string& origin);

/// A mistake in the scene, on its way to `parse_scene`.
struct Mistake {
  Error error;
};

/// `a`, `b`, `c`.
std::string join(const std::vector<std::string>& words);

/// A hint for an unknown word: the nearest of what could stand there, and all of it.
std::string hint_for(const std::string& word, const std::vector<std::string>& candidates);

/// That an option which takes one of `names` or the path of a file was given `name`, which is
/// neither.
Error no_such(const char* option, const char* thing, const std::string& name,
              const std::vector<std::string>& names);

/// That `path`, which a scene names as a `thing`, is no file.
Error no_file(const char* thing, const std::string& path);

/// A JSON value and where it stands.
class Node {
 public:
  Node(const Json& json, std::string file, std::string path)
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(std::string what, std::string hint = {}) const {
    throw Mistake{{path_.empty() ? file_ : file_ + ": " + path_, std::move(what), std::move(hint)}};
  }

  /// As an error of a file that is named here.
  [[noreturn]] void fail(const Error& e) const {
    throw Mistake{{path_.empty() ? file_ : file_ + ": " + path_, e.what, e.hint, e.cause}};
  }

  /// Checks that this is an object with no other keys than `keys`.
  void keys(std::initializer_list<const char*> keys) const {
    this->keys(std::vector<std::string>(keys.begin(), keys.end()));
  }
  void keys(const std::vector<std::string>& known) const {
    if (!json_->is_object()) fail(fmt::format("expected an object {{...}}, found {}", kind()));
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
  std::array<double, 2> pair() const {
    const std::vector<Node> e = elements();
    if (e.size() != 2) fail(fmt::format("expected 2 numbers, found {}", e.size()));
    return {e[0].number(), e[1].number()};
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
  bool is_number() const { return json_->is_number(); }
  bool is_object() const { return json_->is_object(); }

 private:
  Node member(const std::string& key) const {
    return {(*json_)[key], file_, path_.empty() ? key : path_ + "." + key};
  }
  std::string kind() const {
    constexpr std::size_t kShown = 60;
    if (!json_->is_string()) return json_->type_name();
    const std::string text = json_->get<std::string>();
    return "the string \"" + text.substr(0, kShown) + (text.size() > kShown ? "...\"" : "\"");
  }

  const Json* json_;
  std::string file_, path_;
};

/// Keys of an object that state its shape.
std::vector<std::string> shape_keys();

/// The shape of an object, in the world; meshes are looked up in `folder`.
Shape parse_shape(const Node& object, const Transform& transform, const std::string& folder);

/// What `environment` of a scene says; pictures are looked up in `folder`.
Environment parse_environment(const Node& environment, const std::string& folder);

/// As `SceneSource::environment` asks.
Environment environment_named(const std::string& name);

/// `path` as a file of `folder`.
std::string in_folder(const std::string& path, const std::string& folder);

}  // namespace mms::renderer
