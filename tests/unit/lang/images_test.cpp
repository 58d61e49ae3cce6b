// SPDX-License-Identifier: Apache-2.0
// Images from link to machine, over pictures that are formulas.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lang/link.h"
#include "lang/parser.h"
#include "stdlib/stdlib.h"
#include "vm/bounds.h"
#include "vm/interpreter.h"
#include "vm/serialise.h"

using namespace mms;
using namespace mms::lang;

namespace {

/// Red is u^2 / 2, green v / 2, blue the width of the pixel along u; a number is u v.
class Formula : public vm::Image {
 public:
  void look_up(vm::ImageAsk ask, const float* const* in, float* const* out,
               int lanes) const override {
    run(ask, in, out, lanes);
  }
  void look_up64(vm::ImageAsk ask, const double* const* in, double* const* out,
                 int lanes) const override {
    run(ask, in, out, lanes);
  }
  std::optional<double> number(std::string_view name) const override {
    if (name == "width") return 7;
    return name == "height" ? std::optional<double>(5) : std::nullopt;
  }
  void range(double& low, double& high) const override {
    low = 0.25;
    high = 0.5;
  }
  std::vector<std::string> files() const override { return {"formula.tx"}; }

 private:
  template <class R>
  static void run(vm::ImageAsk ask, const R* const* in, R* const* out, int lanes) {
    for (int i = 0; i < lanes; ++i) {
      const R u = in[0][i], v = in[1][i];
      const R colour[] = {u * u / 2, v / 2, in[2][i]};
      const R colour_slope[] = {u, 0, 0, R(0.5), 0, 0};
      const R number[] = {u * v}, number_slope[] = {v, u};
      const R* const answers[] = {number, number_slope, colour, colour_slope};
      for (int k = 0; k < vm::result_count(ask); ++k) out[k][i] = answers[int(ask)][k];
    }
  }
};

/// Has tiles of that name, for which no file is looked for.
struct Formulas : vm::ImageSource {
  int opened = 0;
  std::vector<vm::ImageUse> uses;
  Result<std::shared_ptr<const vm::Image>> open(const vm::ImageUse& use) override {
    ++opened;
    uses.push_back(use);
    if (use.file.find("formula") == std::string::npos)
      return Error{use.file, "does not exist: there is no tile of it", ""};
    return std::shared_ptr<const vm::Image>(std::make_shared<Formula>());
  }
};

Library library() { return {stdlib::builtins(), stdlib::modules()}; }

struct Script {
  Diagnostics diagnostics;
  std::optional<Linked> linked;
  Formulas formulas;

  explicit Script(const std::string& text, MissingImages missing = MissingImages::Refuse,
                  Level level = Level::O2) {
    const std::vector<Graph> graphs{parse(make_source("test.mms", text), diagnostics)};
    LinkOptions options;
    options.level = level;
    options.images = &formulas;
    options.missing_images = missing;
    linked = link(graphs, library(), options, diagnostics);
  }

  /// Results of the export at u = 0.25, v = 0.75.
  template <class R>
  std::vector<double> values(const std::string& name) const {
    REQUIRE(linked);
    const vm::Program& p = linked->program;
    const vm::Executable executable(p);
    vm::InputBatch<R> in(16);
    for (int i = 0; i < 16; ++i) {
      in.lanes(vm::Variable::Uv, 0)[i] = R(0.25);
      in.lanes(vm::Variable::Uv, 1)[i] = R(0.75);
      in.lanes(vm::Variable::UvTangent, 0)[i] = R(2);
      in.lanes(vm::Variable::Footprint, 0)[i] = R(0.125);
    }
    vm::Interpreter<R> machine(16);
    for (const vm::Export& e : p.exports) {
      if (e.name != name) continue;
      machine.run(executable, e.function, in, 16);
      std::vector<double> all;
      for (std::size_t k = 0; k < p.functions[e.function].results.size(); ++k)
        all.push_back(machine.result(int(k))[15]);
      return all;
    }
    FAIL("no export ", name);
    return {};
  }
};

constexpr const char* kFile = "\"formula<UDIM>.tx\"";

std::string lookup(const std::string& function, const std::string& rest) {
  return function + "(" + kFile + ", " + rest + ")";
}

}  // namespace

TEST_CASE("images: both machines look up the same, at every level") {
  const std::string text = "real[3] c() = " + lookup("image_rgb", "$uv") + ";\n" +
                           "real n() = " + lookup("image_value", "2 * $uv") + ";\n" +
                           "real w() = " + lookup("image_rgb", "$uv, width = 0") + "[2];\n";
  for (const Level level : {Level::O0, Level::O2}) {
    const Script script(text, MissingImages::Refuse, level);
    CHECK(script.values<float>("c") == std::vector<double>{0.03125, 0.375, 0.25});
    CHECK(script.values<double>("c") == std::vector<double>{0.03125, 0.375, 0.25});
    CHECK(script.values<float>("n") == std::vector<double>{0.75});
    CHECK(script.values<float>("w") == std::vector<double>{0});
  }
}

TEST_CASE("images: gradients are those of the image, through whatever leads to it") {
  const Script script(
      "real[2] n() = gradient(function(p) -> " + lookup("image_value", "2 * p") + ", $uv);\n" +
      "real r() = gradient(function(x) -> " + lookup("image_rgb", "[3 * x, x]") + "[0], 0.5);\n" +
      "real g() = gradient(function(x) -> " + lookup("image_rgb", "[3 * x, x]") + "[1], 0.5);\n" +
      "surface s height = " + lookup("image_value", "$uv") + "; end\n");
  // d (2u 2v) = (4 v, 4 u); d ((3x)^2 / 2) = 9 x; d (x / 2) = 1 / 2.
  CHECK(script.values<float>("n") == std::vector<double>{3, 1});
  CHECK(script.values<double>("n") == std::vector<double>{3, 1});
  CHECK(script.values<float>("r") == std::vector<double>{4.5});
  CHECK(script.values<float>("g") == std::vector<double>{0.5});
  CHECK(!script.linked->program.find(vm::DescriptorForm::Surface, "s")->shade.gradient[0].constant);
}

TEST_CASE("images: one picture with one set of words is opened once, and is a dependency") {
  const Script script("real a() = " + lookup("image_value", "$uv") +
                      ";\nreal b() = " + lookup("image_value", "$uv") + " + " +
                      lookup("image_value", "$uv, wrap = \"clamp\"") + ";\n");
  REQUIRE(script.linked);
  CHECK(script.formulas.opened == 2);
  CHECK(script.linked->program.images.size() == 2);
  CHECK(script.linked->dependencies == std::vector<std::string>{"formula.tx"});
  CHECK(script.formulas.uses[0].wrap == "repeat");
  CHECK(script.formulas.uses[1].wrap == "clamp");
  CHECK(script.formulas.uses[0].space == "linear");
}

TEST_CASE("images: what the file states is known at link") {
  const Script script("const integer n = image_size(" + std::string(kFile) +
                      ")[0];\nreal[n] all() = array(n, function(k) -> k / 2);\n" +
                      "real none() = image_fact(" + kFile + ", \"depth\", 3);\n");
  CHECK(script.values<float>("all") == std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3});
  CHECK(script.values<float>("none") == std::vector<double>{3});
}

TEST_CASE("images: a missing one is told once, with every place; or is magenta") {
  const std::string text =
      "real a() = image_value(\"gone<UDIM>.tx\", $uv);\n"
      "real[3] b() = image_rgb(\"gone<UDIM>.tx\", $uv);\n"
      "real[3] c() = image_rgb(\"gone.tx\", $uv);\n"
      "real[2] slope() = gradient(function(p) -> image_value(\"gone.tx\", p), $uv);\n";
  const Script refused(text);
  CHECK(!refused.linked);
  REQUIRE(refused.diagnostics.all().size() == 2);
  for (const Diagnostic& d : refused.diagnostics.all()) {
    CHECK(d.id == Diag::NoImage);
    REQUIRE(d.notes.size() == 1);
    CHECK(d.notes[0].span.begin > d.span.begin);
  }
  const Script magenta(text, MissingImages::Magenta);
  CHECK(magenta.diagnostics.all().size() == 2);
  CHECK(magenta.diagnostics.all()[0].id == Diag::ImageReplaced);
  CHECK(magenta.values<float>("a") == std::vector<double>{1});
  CHECK(magenta.values<double>("b") == std::vector<double>{1, 0, 1});
  CHECK(magenta.values<float>("c") == std::vector<double>{1, 0, 1});
  CHECK(magenta.values<float>("slope") == std::vector<double>{0, 0});
}

TEST_CASE("images: enclosures are the picture's own range, and 0") {
  const Script script("real n() = 2 * " + lookup("image_value", "$uv") + ";\n");
  REQUIRE(script.linked);
  vm::BoundsMachine machine(script.linked->program);
  const auto e =
      machine.run(script.linked->program.exports[0].function, vm::Box::unit_sphere()).results[0];
  CHECK(e.lo <= 0);
  CHECK(e.lo > -1e-6);
  CHECK(e.hi >= 1);
  CHECK(e.hi < 1 + vm::kImageRounding + 1e-6);
}

TEST_CASE(
    "images: stored programs keep how a picture is read, and are magenta until it is opened") {
  Script script("real n() = " + lookup("image_value", "$uv, filter = \"nearest\"") + ";\n");
  REQUIRE(script.linked);
  const auto file = vm::save({script.linked->program, {}, {}}, stdlib::builtins());
  auto loaded = vm::load(file, stdlib::builtins());
  REQUIRE(loaded);
  REQUIRE(loaded->program.images.size() == 1);
  CHECK(loaded->program.images[0].use == script.linked->program.images[0].use);
  script.linked->program = std::move(loaded->program);
  CHECK(script.values<float>("n") == std::vector<double>{1});
  script.linked->program.images[0].image = std::make_shared<Formula>();
  CHECK(script.values<float>("n") == std::vector<double>{0.1875});
}

TEST_CASE("images: words that are no words are told") {
  for (const char* word : {"filter = \"soft\"", "wrap = \"torus\"", "storage = \"tape\""}) {
    const Script script("real f() = " + lookup("image_value", std::string("$uv, ") + word) + ";\n");
    CHECK(!script.linked);
    REQUIRE(script.diagnostics.all().size() == 1);
    CHECK(script.diagnostics.all()[0].id == Diag::ImageWord);
    CHECK(!script.diagnostics.all()[0].helps.empty());
  }
  const Script choice(
      "real f(string s) = image_value(s, $uv);\nreal g() = f(\"formula<UDIM>\");\n");
  CHECK(choice.values<float>("g") == std::vector<double>{0.1875});
}
