// SPDX-License-Identifier: Apache-2.0
// The two callbacks: messages as they arise, and imports from the host's own storage.
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "api/mms.h"

namespace {

struct Heard {
  std::vector<int> severities;
  std::string text;
};

void hear(void* user, int severity, const char* message) {
  auto* heard = static_cast<Heard*>(user);
  heard->severities.push_back(severity);
  heard->text += message;
}

/// A host's storage: texts by the name they are found under, and what was asked for.
struct Storage {
  std::map<std::string, std::string> texts;
  std::vector<std::string> asked;
  std::string name;  ///< what `*name` points to
};

const char* look_up(void* user, const char* importer, const char* written, const char** name) {
  auto* s = static_cast<Storage*>(user);
  s->asked.push_back(std::string(importer) + " > " + written);
  s->name = std::string("asset:") + written;
  const auto found = s->texts.find(s->name);
  if (found == s->texts.end()) return nullptr;
  *name = s->name.c_str();
  return found->second.c_str();
}

const char* refuse(void*, const char*, const char*, const char**) {
  throw std::runtime_error("the disk is on fire");
}

/// A graph and a program that are deleted at the end.
struct Handles {
  explicit Handles(const char* script) {
    parsed = mmsParseNamed(graph, "main", script) && mmsAddGraph(program, graph);
  }
  ~Handles() {
    mmsDeleteProgram(program);
    mmsDeleteGraph(graph);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  float height() const {
    float value = -1;
    MMsContext* context = mmsMkContext(static_cast<const MMsProgram*>(program));
    const MMsPoints one{1, nullptr, 0};
    mmsEvalSurface(context, mmsGetSurface(program, "s"), "height", &one, &value);
    mmsDeleteContext(context);
    return value;
  }
  std::string log() const { return mmsGetProgramLog(static_cast<const MMsProgram*>(program)); }

  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();
  bool parsed = false;
};

bool contains(const std::string& text, const char* part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE("the log callback hears what the log says") {
  Heard heard;
  MMsGraph* graph = mmsMkGraph();
  mmsSetGraphLog(graph, hear, &heard);
  CHECK_FALSE(mmsParseString(graph, "surface s height = ; end surface t height = ; end"));
  REQUIRE(heard.severities == std::vector<int>{MMS_ERROR, MMS_ERROR});
  CHECK(contains(heard.text, "<string>:1:"));
  CHECK(mmsParseString(graph, "surface s height = 1; end"));
  CHECK(heard.severities.size() == 2);
  mmsSetGraphLog(graph, nullptr, nullptr);
  CHECK_FALSE(mmsParseString(graph, "surface"));
  CHECK(heard.severities.size() == 2);
  mmsDeleteGraph(graph);
}

TEST_CASE("warnings and errors of a link are told apart") {
  Heard heard;
  const Handles warns("surface s bsdf = matte($view[2]); end");  // W: no reciprocity
  REQUIRE(warns.parsed);
  mmsSetProgramLog(warns.program, hear, &heard);
  CHECK(mmsLinkProgram(warns.program, 2));
  CHECK(heard.severities == std::vector<int>{MMS_WARNING});
  CHECK(heard.text == warns.log());
  CHECK_FALSE(mmsLinkProgram(warns.program, 7));
  CHECK(heard.severities == std::vector<int>{MMS_WARNING, MMS_ERROR});
}

TEST_CASE("imports come from the host's storage, once each, with their importers") {
  Storage storage;
  storage.texts["asset:a"] = "import \"c\"; real a() = 2 * c();";
  storage.texts["asset:b"] =
      "import \"c\"; import \"noise\" as n; real b() = n::perlin(0.0) + c();";
  storage.texts["asset:c"] = "real c() = 5;";
  const Handles h("import \"a\"; import \"b\"; surface s height = a() + b(); end");
  REQUIRE(h.parsed);
  mmsSetResolver(h.program, look_up, &storage);
  REQUIRE_MESSAGE(mmsLinkProgram(h.program, 2), h.log());
  CHECK(h.height() == 15.0f);
  CHECK(storage.asked == std::vector<std::string>{"main > a", "asset:a > c", "main > b",
                                                  "asset:b > c", "asset:b > noise"});
  const auto imported = [&](std::size_t k) {
    const char* name = mmsGetImport(h.program, k);
    return std::string(name ? name : "");
  };
  CHECK(imported(0) == "asset:a");
  CHECK(imported(1) == "asset:c");
  CHECK(imported(2) == "asset:b");
  CHECK(imported(3) == "");
}

TEST_CASE("what the storage does not have is an error at the import; its errors have its names") {
  Storage storage;
  const Handles h("import \"gone\"; surface s height = 1; end");
  mmsSetResolver(h.program, look_up, &storage);
  CHECK_FALSE(mmsLinkProgram(h.program, 2));
  CHECK(contains(h.log(), "main:1:"));
  CHECK(contains(h.log(), "gone"));
  storage.texts["asset:gone"] = "real f() = no_such_name;";
  CHECK_FALSE(mmsLinkProgram(h.program, 2));
  CHECK(contains(h.log(), "asset:gone:1:12"));
  storage.texts["asset:gone"] = "real f() = 3;";
  CHECK(mmsLinkProgram(h.program, 2));
  CHECK(h.height() == 1.0f);
}

TEST_CASE("a circle of imports is told by the names that the storage gave") {
  Storage storage;
  storage.texts["asset:a"] = "import \"b\"; real a() = 1;";
  storage.texts["asset:b"] = "import \"a\"; real b() = 2;";
  const Handles h("import \"a\"; surface s height = a(); end");
  mmsSetResolver(h.program, look_up, &storage);
  CHECK_FALSE(mmsLinkProgram(h.program, 2));
  CHECK(contains(h.log(), "asset:a -> asset:b -> asset:a"));
}

TEST_CASE("an exception of a callback stays behind the interface") {
  const Handles h("import \"a\"; surface s height = 1; end");
  mmsSetResolver(h.program, refuse, nullptr);
  CHECK_FALSE(mmsLinkProgram(h.program, 2));
  CHECK(h.log() == "the disk is on fire");
  CHECK(mmsGetSurface(h.program, "s") == nullptr);
}
