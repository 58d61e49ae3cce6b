// SPDX-License-Identifier: Apache-2.0
#include "bench/setting.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "api/library.h"
#include "lang/link.h"
#include "lang/parser.h"
#include "renderer/scene.h"

namespace mms::bench {
namespace {

vm::Program compile(const std::string& text) {
  lang::Diagnostics diagnostics;
  const lang::Graph graph = lang::parse(lang::make_source("transport", text), diagnostics);
  auto linked = lang::link({&graph, 1}, api::standard_library(), {}, diagnostics);
  if (!linked) give_up(lang::render(diagnostics));
  return std::move(linked->program);
}

}  // namespace

void give_up(const std::string& why) {
  fmt::print(stderr, "error: {}\n", why);
  std::exit(1);
}

std::string example(const char* name) {
  std::ifstream in(fmt::format(MMS_SOURCE_DIR "/examples/{}", name));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.empty()) give_up(fmt::format("no example {}", name));
  return text;
}

Setting::Setting(const std::string& script, const std::string& scene, const std::string& surface)
    : program_(compile(script)) {
  if (scene.find('{') == scene.npos) {
    auto loaded = renderer::load_scene(program_, {scene, surface, "", 0});
    if (!loaded) give_up(loaded.error().what);
    scene_ = *loaded;
    return;
  }
  auto data = renderer::parse_scene(program_, {"", surface, "", 0}, scene, "transport", "");
  if (!data) give_up(data.error().where + ": " + data.error().what);
  scene_.emplace(std::make_shared<const renderer::SceneData>(std::move(*data)));
}

renderer::Rendered Setting::render(int side, int samples, int threads, std::uint64_t seed,
                                   renderer::Generator generator) const {
  renderer::RenderOptions o;
  o.samples = samples;
  o.threads = threads;
  o.seed = seed;
  o.generator = generator;
  return render(side, o);
}

renderer::Rendered Setting::render(int side, renderer::RenderOptions options) const {
  options.width = options.height = side;
  options.filter = renderer::FilterShape::Box;
  auto r = renderer::render(program_, *scene_, options);
  if (!r) give_up(r.error().where + ": " + r.error().what);
  return std::move(*r);
}

std::vector<Material> materials() {
  return {{"matte", "surface s\n bsdf = matte(0.5);\nend\n"},
          {"glossy metal", "surface s\n bsdf = conductor(0.2, 3.4, 0.4);\nend\n"},
          {"glass", "surface s\n bsdf = dielectric(1.5);\nend\n"},
          {"marble", example("marble.mms")},
          {"murky glass", example("murky_glass.mms")}};
}

std::string quartiles(const Series& series, const char* format) {
  const auto f = [&](double q) { return fmt::format(fmt::runtime(format), quantile(series, q)); };
  return fmt::format("{} [{}, {}]", f(0.5), f(0.25), f(0.75));
}

}  // namespace mms::bench
