// SPDX-License-Identifier: Apache-2.0
// The text of a scene file.
#include <set>

#include "renderer/scene_node.h"

namespace mms::renderer {

namespace {

/// Follows a parser through nested values and finds a key that an object has twice.
class Keys {
 public:
  bool operator()(int /*depth*/, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    switch (event) {
      case Event::object_start:
      case Event::array_start:
        open_.emplace_back();
        break;
      case Event::key:
        open_.back().last = value.get<std::string>();
        if (!open_.back().keys.insert(open_.back().last).second && twice_.empty()) twice_ = place();
        break;
      case Event::object_end:
      case Event::array_end:
        open_.pop_back();
        next();
        break;
      case Event::value:
        next();
    }
    return true;
  }

  /// `objects[2].surface`, or empty where there is none.
  const std::string& twice() const { return twice_; }

 private:
  /// An object or an array that has not ended.
  struct Open {
    std::set<std::string> keys;
    std::string last;       ///< of the object's keys; empty: in an array
    std::size_t index = 0;  ///< of the array's elements
  };

  void next() {
    if (!open_.empty()) ++open_.back().index;
  }

  std::string place() const {
    std::string path;
    for (const Open& o : open_)
      path += o.keys.empty() ? fmt::format("[{}]", o.index) : (path.empty() ? "" : ".") + o.last;
    return path;
  }

  std::vector<Open> open_;
  std::string twice_;
};

/// Whether there is nothing but space and comments: then a value after it is the only one.
bool is_empty(std::string_view text) {
  return Json::parse(std::string(text) + "\nnull", nullptr, /*allow_exceptions=*/false,
                     /*ignore_comments=*/true)
      .is_null();
}

}  // namespace

Result<Json> json_of(std::string_view text, const std::string& origin) {
  Keys keys;
  try {
    Json json = Json::parse(text, std::ref(keys), true, /*ignore_comments=*/true);
    if (keys.twice().empty()) return json;
    return Error{origin + ": " + keys.twice(), "the object has this key twice", "leave one out"};
  } catch (const Json::exception& e) {  // what is not JSON, and numbers beyond double
    if (is_empty(text))
      return Error{origin, "the file is empty",
                   R"(a first scene: {"environment": {"constant": 1}, )"
                   R"("objects": [{"sphere": {"radius": 1}, "test": true}]})"};
    std::string what = e.what();  // "[json.exception.parse_error.101] parse error at line 3, ..."
    if (const std::size_t end = what.find("] "); end != std::string::npos) what.erase(0, end + 2);
    return Error{origin, what, "scene files are JSON; comments are allowed (docs/scene.md)"};
  }
}

}  // namespace mms::renderer
