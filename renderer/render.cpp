// SPDX-License-Identifier: Apache-2.0
// From a program and a scene to the world that a job renders.
#include "renderer/render.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "renderer/displace.h"
#include "renderer/job.h"
#include "renderer/layers.h"
#include "renderer/prepare.h"

namespace mms::renderer {
namespace {

constexpr int kLargestSide = 32768;

std::optional<Error> check(const RenderOptions& o) {
  if (o.width < 1 || o.width > kLargestSide || o.height < 1 || o.height > kLargestSide)
    return Error{"size", fmt::format("a picture of {} x {} pixels", o.width, o.height),
                 fmt::format("each side must be in [1, {}]", kLargestSide)};
  if (o.samples < 1 || o.samples > kMostSamples)
    return Error{"samples", fmt::format("{} samples a pixel", o.samples),
                 fmt::format("from 1 to {}", kMostSamples)};
  if (o.first_sample < 0 || o.first_sample >= o.samples)
    return Error{"samples", fmt::format("samples {} to {}", o.first_sample, o.samples),
                 "the first is at least 0, and before the last"};
  if (!(o.seconds >= 0) || !(o.error >= 0))
    return Error{"time", "a negative limit of time or error", "0 means none"};
  if (o.max_depth < 1)
    return Error{"depth", fmt::format("paths of {} scattering events", o.max_depth), "at least 1"};
  if (o.threads < 0) return Error{"threads", fmt::format("{} threads", o.threads), "0 means all"};
  return {};
}

}  // namespace

Result<Rendered> render(const vm::Program& program, const Scene& scene,
                        const RenderOptions& options) {
  if (const std::optional<Error> e = check(options)) return *e;
  const Compiled compiled(program);
  SceneData moved;
  if (any_displaced(scene.data())) {
    Result<SceneData> made = displaced(
        scene.data(), compiled, CameraRays(scene.data().camera, options.width, options.height));
    if (!made) return made.error();
    moved = std::move(*made);
  }
  const SceneData& data = any_displaced(scene.data()) ? moved : scene.data();
  Result<Findings> findings = probe(data, compiled);
  if (!findings) return findings.error();

  std::vector<bool> passes, collected;
  bool plain = true, nested = false;
  for (const Object& o : data.objects) {
    passes.push_back(semi_transparent(data, compiled, o));
    collected.push_back(passes.back() || may_be_hidden(data, o));
    nested |= o.priority > 0;
    plain &= !collected.back() && !tracked(o);
    if (o.priority > 0 && emits(data, compiled, o))
      return Error{data.name, "an object with a `priority` emits light",
                   "a light takes no other object's place: leave its `priority` out"};
  }
  const Accel accel(data, collected);
  const Lights lights(data, findings->radiance);
  const bool each_light = plain && lights.count() <= kLightsDrawnEach;
  const bool clustered = options.estimator == Estimator::Clustered;
  const Matter matter = clustered ? matter_of(data, compiled) : Matter::Coloured;
  World world{
      data,
      compiled,
      accel,
      lights,
      CameraRays(data.camera, options.width, options.height),
      {},
      {},
      std::move(passes),
      plain,
      nested,
      each_light,
      matter,
      options.seed,
      options.max_depth,
      std::move(findings->majorants),
      std::move(findings->emission_rates),
      Glows(std::move(findings->glows)),
      // Grey matter has the same densities for all wavelengths: none are to be weighed.
      matter == Matter::Grey ? Estimator::Unweighted : options.estimator,
      options.generator,
      !nested && lights.any() ? polished_balls(data, compiled, plain) : std::vector<PolishedBall>(),
      each_light && lights.any() ? glossy_balls(data, compiled) : std::vector<GlossyBall>()};
  for (int i = 0; i < int(data.objects.size()); ++i)
    world.sealed.push_back(sealed(data, compiled, i));
  for (int i = 0; i < int(data.objects.size()); ++i)
    if (tracked(data.objects[i]) && contains(data.objects[i].shape, data.camera.position))
      world.camera_media.enter(i);
  Rendered rendered = Job(world, options).run();
  if (options.layers)
    rendered.layers = std::make_shared<const Layers>(
        trace_layers(world, options.width, options.height, options.samples, options.threads));
  return rendered;
}

}  // namespace mms::renderer
