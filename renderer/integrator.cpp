// SPDX-License-Identifier: Apache-2.0
#include "renderer/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "materials/weight.h"
#include "renderer/batches.h"
#include "renderer/scatterer.h"

namespace mms::renderer {
namespace {

/// Scattering events before Russian roulette begins.
constexpr int kFirstRoulette = 3;

/// Vertices at which a path divides at most: where it meets glass, where it comes to the other
/// side, and where what was mirrored there comes out.
constexpr int kDivisions = 3;

/// Directions in which a path goes on from its first vertex: the ray that came there and the light
/// that was drawn cost more than another direction. Where no light can be drawn all is found by
/// these directions.
constexpr int kDirectionsOfFirst = 2, kDirectionsUnlit = 4;

/// Scattering events up to which each of few lights is drawn: more where the surface is not matte,
/// and then in several directions, as those differ most where it mirrors a lamp about as wide as
/// its lobe; fewer at later events, and where a path came for one of the lamps.
constexpr int kEachLightOfEven = 1, kEachLightOfUneven = 3;
constexpr int kDrawsOfUneven = 8;

/// Paths are given up below this mean contribution only: in glass of index n radiance is 1 / n^2 of
/// what it is again outside, so a path that carries a third may have lost nothing; and each of the
/// directions from the first vertex carries its part of this.
constexpr float kSafeContribution = 1.0f / 3;

/// Rays that fly together, at least: enough to fill batches though scripts differ.
constexpr std::size_t kTogether = 2048;
/// And where no script runs: few enough to stay in the cache.
constexpr std::size_t kTogetherUnasked = 256;

/// Share of them that is left for the next time, lest few long ways hold up the rest.
constexpr double kLeftFlying = 0.5;

/// `matte`: what a surface of the scene scatters by, and the default of a script that gave up.
const materials::Layout& matte_layout() {
  static const materials::Layout layout(
      vm::MaterialLayout{{{int(materials::Lobe::Matte), {{vm::SlotType::Spectrum, true, 0}}, {}}}});
  return layout;
}
bool any_nan(std::span<const float> numbers) {
  return std::any_of(numbers.begin(), numbers.end(), [](float x) { return std::isnan(x); });
}

const materials::Layout& isotropic_layout() {
  static const materials::Layout layout(
      vm::MaterialLayout{{{int(materials::Lobe::Isotropic), {}, {}}}});
  return layout;
}

}  // namespace

Integrator::Integrator(const World& world)
    : world_(world),
      scripts_(world.compiled),
      flights_(world, scripts_),
      surroundings_(world, scripts_),
      directions_of_first_(world.lights.any() || world.glows.any() ? kDirectionsOfFirst
                                                                   : kDirectionsUnlit) {}

void Integrator::trace(std::span<const PixelSample> samples, std::span<FilmSample> stream) {
  paths_.clear();
  views_.clear();
  now_.clear();
  optics_.resize(samples.size() * world_.balls.size());
  ball_params_.resize(optics_.size() * std::size_t(world_.compiled.max_params()));
  std::size_t started = 0;
  const std::size_t together = world_.compiled.executable() ? kTogether : kTogetherUnasked;
  for (;;) {
    make_room(together);
    const std::size_t first = paths_.size();
    for (; started < samples.size() && now_.size() < together; ++started)
      start(samples[started], int(started), stream[started]);
    ask_balls(first);
    if (now_.empty()) break;
    // Branches of a path at one vertex: the other directions, and one by images of lamps.
    make_room(std::size_t(directions_of_first_) * now_.size());
    flights_.fly(now_, views_, kLeftFlying);
    next_.clear();
    shadows_.clear();
    connections_.clear();
    gather(started < samples.size());
    if (world_.nested) ask_surroundings();
    for_each_batch(
        std::span(vertices_), scripts_.width(), [](const Vertex& v) { return v.kind; },
        [&](std::span<const Vertex> group) { shade(group); });
    ask_emitters();
    send_shadow_rays();
    std::swap(now_, next_);
  }
  // Branches come after what they left, so each is whole when it is added.
  for (std::size_t i = paths_.size(); i-- > 0;) {
    const Path& p = paths_[i];
    if (p.parent >= 0)
      paths_[p.parent].lit += p.light();
    else
      stream[p.sample].xyz = p.cluster.xyz(p.light());
  }
}

/// For so many more paths, whose places in memory are known to others until the next call.
void Integrator::make_room(std::size_t more) {
  if (paths_.size() + more <= paths_.capacity()) return;
  paths_.reserve(2 * (paths_.size() + more));
  views_.clear();
  for (Path& p : paths_) views_.push_back(view(p));
}

PathView Integrator::view(Path& p) const {
  return {&p.cluster, &p.sampler, &p.radiance, &p.gathered, world_.camera.pixel_angle()};
}

/// Draws wavelengths and the camera ray of a new path.
void Integrator::start(const PixelSample& s, int sample, FilmSample& point) {
  const int i = int(paths_.size());
  Path& p = paths_.emplace_back();
  p.sample = sample;
  p.sampler = Sampler(world_.seed, s.x, s.y, std::uint64_t(s.sample), world_.generator);
  const std::array<float, 4> u = p.sampler.first();
  const int wavelengths = wavelengths_of(world_.estimator);
  p.cluster =
      sample_cluster(cluster_number(u[kWavelength], wavelengths), wavelengths, world_.matter);
  p.first_part = u[kFirstPart];
  point.x = s.x + double(u[kFilmX]);
  point.y = s.y + double(u[kFilmY]);
  point.number = std::uint32_t(s.sample);
  views_.push_back(view(p));
  now_.push_back(camera_flight(world_, i, p.sampler, point.x, point.y));
}

/// Adds what shadow rays found and what the environment sends along rays that left the scene, and
/// orders the rest by what has to be run for them. What is not done stays for the next time.
/// `more`: paths are still to begin.
void Integrator::gather(bool more) {
  for (const Flight& f : now_) {
    if (f.errand == Errand::Path || f.end == End::Flying || go_beyond(f)) continue;
    --paths_[f.path].asks;
    receive(f);
  }
  vertices_.clear();
  arrived_.clear();
  for (const Flight& f : now_) {
    Path& p = paths_[f.path];
    const bool vertex = f.end == End::Surface || f.end == End::Medium;
    if (f.end == End::Flying || (vertex && p.asks > 0)) {
      next_.push_back(f);
    } else if (vertex) {
      const int kind = f.end == End::Medium ? int(world_.scene.surfaces.size()) +
                                                  world_.scene.objects[f.medium].volume
                                            : world_.scene.objects[f.hit.object].surface;
      arrived_.push_back({kind, &f});
    } else if (f.end == End::Free && f.errand == Errand::Path) {
      const Vec3d d(f.direction);
      const Spectrumf weight =
          f.carried.weighted(Technique::Scattering, environment_density(f, d), world_.estimator);
      p.radiance += weight * world_.lights.environment(d, p.cluster);
    }
  }
  std::ranges::stable_sort(arrived_, {}, &Arrived::kind);
  hold_back(more);
  for (const auto& [kind, f] : arrived_) {
    const Hit* hit = f->end == End::Surface ? &f->hit : nullptr;
    Path& p = paths_[f->path];
    Vertex v{f, kind, script_point(world_, *f, hit, views_[f->path]), Spectrumf(1.0f)};
    p.travelled += f->t;
    v.point.cone = world_.camera.pixel_angle() * p.travelled;
    vertices_.push_back(v);
  }
}

/// Whether a script is run at vertices of that kind.
bool Integrator::runs(int kind) const {
  const int surfaces = int(world_.scene.surfaces.size());
  const bool medium = kind >= surfaces;
  const vm::Descriptor* d =
      medium ? world_.scene.volumes[kind - surfaces].script : world_.scene.surfaces[kind].script;
  return d && d->shade.function && !(medium && world_.compiled.of(d).constant_material);
}

/// Of what is ordered, leaves for later what fills no batch, if something else goes on meanwhile.
void Integrator::hold_back(bool more) {
  if (!world_.compiled.executable()) return;
  const std::size_t width = std::size_t(scripts_.width());
  const auto held = [&](std::span<const Arrived> of_a_kind) {
    return runs(of_a_kind[0].kind) ? of_a_kind.size() % width : 0;
  };
  kept_.clear();
  const std::size_t waiting = next_.size();
  for_each_batch(
      std::span(arrived_), int(arrived_.size()), [](const Arrived& a) { return a.kind; },
      [&](std::span<const Arrived> of_a_kind) {
        const std::size_t keep = of_a_kind.size() - held(of_a_kind);
        kept_.insert(kept_.end(), of_a_kind.begin(), of_a_kind.begin() + std::ptrdiff_t(keep));
        for (const Arrived& a : of_a_kind.subspan(keep)) next_.push_back(*a.flight);
      });
  if (more || waiting > 0 || !kept_.empty())
    std::swap(arrived_, kept_);
  else
    next_.clear();
}

void Integrator::add_emission(const Vertex& v, const Spectrumf& emitted) {
  if (emitted.is_black() || v.from->emission_seen) return;
  paths_[v.from->path].radiance +=
      v.from->carried.weighted(Technique::Scattering, light_density(v), world_.estimator) * emitted;
}

/// One batch: vertices that wear the same surface or lie in volumes of the same descriptor.
void Integrator::shade(std::span<const Vertex> group) {
  const int n = int(group.size());
  const int surfaces = int(world_.scene.surfaces.size());
  const bool medium = group[0].kind >= surfaces;
  params_.resize(std::size_t(n) * std::max(world_.compiled.max_params(), kWavelengths));
  const std::size_t stride = params_.size() / n;
  const vm::Descriptor* d = medium ? world_.scene.volumes[group[0].kind - surfaces].script
                                   : world_.scene.surfaces[group[0].kind].script;
  if (!d) {
    const FixedSurface& fixed = world_.scene.surfaces[group[0].kind].fixed;
    for (const Vertex& v : group) {
      const SurfacePoint& s = v.point.surface;
      add_emission(v, fixed_emission(fixed, s, v.point.view, *v.point.cluster));
      const Spectrumf albedo = fixed_albedo(fixed, *v.point.object, s.position, *v.point.cluster);
      if (albedo.is_black()) continue;
      std::copy(albedo.v.begin(), albedo.v.end(), params_.begin());
      scatter(v, {matte_layout(), params_.data(), shading_frame(s, {0, 0}, v.point.view),
                  v.point.view, choice_});
    }
    return;
  }
  lanes_.clear();
  for (const Vertex& v : group) lanes_.push_back(&v.point);
  const CompiledDescriptor& c = world_.compiled.of(d);
  if (medium && c.constant_material)
    scripts_.rest();  // the coefficients were asked for on the way
  else
    scripts_.run(*d, EntryKind::Shade, lanes_);
  Weighed* weighed = medium || c.constant_material ? nullptr : &weighed_[d];
  for (int i = 0; i < n; ++i) {
    const Vertex& v = group[i];
    float* params = &params_[i * stride];
    const bool lost = scripts_.given_up(i);
    if (!lost) scripts_.params(d->shade.material, i, params);
    std::array<double, 2> gradient{0, 0};
    if (!lost && c.bumps && !v.point.object->displaced)
      gradient = {scripts_.real(d->shade.gradient[0], i), scripts_.real(d->shade.gradient[1], i)};
    if (!lost && (any_nan({params, std::size_t(c.material.param_count())}) ||
                  !std::isfinite(gradient[0] + gradient[1]))) {
      // Told, not black: the sample is dropped and counted.
      paths_[v.from->path].radiance = Spectrumf(std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    if (medium) {
      scatter(v, {lost ? isotropic_layout() : c.material, params});
      continue;
    }
    const SurfacePoint& s = v.point.surface;
    if (lost) {
      std::fill_n(params, kWavelengths, 1.0f);
      scatter(v, {matte_layout(), params, shading_frame(s, {0, 0}, v.point.view), v.point.view,
                  choice_});
      continue;
    }
    if (weighed) weighed->add(materials::stated_weight(c.material, params));
    if (world_.nested) immerse(c.material, v.outside, params);
    if (c.emits)
      add_emission(v, scripted_emission(world_.compiled, scripts_, *d, EntryKind::Shade, i, s,
                                        v.point.view, scratch_));
    scatter(v,
            {c.material, params, shading_frame(s, gradient, v.point.view), v.point.view, choice_});
  }
}

/// Puts a flight that leaves a surface towards `direction` into the medium there.
void Integrator::follow(Flight& f, const Vertex& v, Vec3d direction) const {
  const Vec3d n = v.point.surface.geometric_normal;
  const double in = dot(direction, n);
  if (in * dot(v.point.view, n) >= 0) return;
  world_.cross(f.media, v.from->hit.object, in < 0);
  f.forget_media();
}

/// Lights a vertex, and sends the path on.
void Integrator::scatter(const Vertex& v, Scatterer&& s) {
  Path& p = paths_[v.from->path];
  if (++p.depth > world_.max_depth) return;
  if (s.divides() && p.specular++ < kDivisions) return go_all_ways(v, s);
  int draws = 0;
  const bool by_image = std::exchange(p.by_image, false);
  std::optional<LampImages> images;
  if (s.can_connect()) {
    if (p.depth == 1 && !s.medium) s.directions = directions_of_first_;
    const bool even = s.even();
    if (p.depth <= (even ? kEachLightOfEven : kEachLightOfUneven) && world_.each_light)
      draws = even || by_image ? 1 : kDrawsOfUneven / p.depth;
    if (p.depth == 1 && even && !world_.glossy_balls.empty()) {
      images.emplace(world_.glossy_balls, world_.lights, v.point.surface.position,
                     Vec3d(s.receives(v.point).normal));
      if (images->chance() > 0) s.images = &*images;
    }
    if (world_.lights.any()) connect(v, s, draws);
    if (world_.glows.any()) connect_to_glows(v, s);
  }
  go_on(v, s, draws);
  if (s.images) go_to_image(v, s, draws);
}

/// Sends a path on from where it is only mirrored and bent, both ways at once: a lamp may be seen
/// by the less likely one.
void Integrator::go_all_ways(const Vertex& v, const Scatterer& s) {
  std::array<Sampled, 2> ways;
  const int count = s.all_ways(v.point, ways);
  for (int i = count; i-- > 0;) leave(v, s, ways[i], i > 0 ? divide(v.from->path) : v.from->path);
}

/// Sends a path on in directions drawn for the hero.
void Integrator::go_on(const Vertex& v, const Scatterer& s, int draws) {
  const Path& p = paths_[v.from->path];
  const int bounce = p.depth - 1;
  const auto [part, roulette] = bounce > 0 ? p.sampler.pair(pair_of_bounce(bounce, kChoices))
                                           : std::array{p.first_part, 0.0f};
  for (int i = 0; i < s.directions; ++i) {
    const auto [direction_u, direction_v] =
        p.sampler.pair(pair_of_bounce(bounce, kDirection), i, s.directions);
    const float turned = part + float(i) / float(s.directions);
    const auto sampled =
        s.sample(v.point, turned < 1 ? turned : turned - 1, direction_u, direction_v);
    if (!sampled) continue;
    Flight* f = leave(v, s, *sampled, i > 0 ? divide(v.from->path) : v.from->path);
    if (!f) continue;
    f->receives.draws = draws;
    // Of ways that are followed together some carry next to nothing.
    if (!survives(f->carried, p.specular > 0 ? kFirstRoulette : p.depth, roulette))
      next_.pop_back();
  }
}

/// Sends a branch of a path to where a ball shows a lamp, by the chance of that.
void Integrator::go_to_image(const Vertex& v, const Scatterer& s, int draws) {
  const Sampler& sampler = paths_[v.from->path].sampler;
  if (sampler.pair(pair_of_bounce(0, kChoices))[0] >= s.images->chance()) return;
  const auto [image_u, image_v] = sampler.pair(pair_of_light(0, kLampImage));
  const Sampled sampled = s.evaluate(v.point, s.images->sample(image_u, image_v));
  if (sampled.f.is_black()) return;
  const int branch = divide(v.from->path);
  paths_[branch].by_image = true;
  if (Flight* f = leave(v, s, sampled, branch)) f->receives.draws = draws;
}

/// A path like `path` from here on, with numbers of its own, whose light is added to that of
/// `path`.
int Integrator::divide(int path) {
  Path& p = paths_.emplace_back(paths_[path]);
  p.parent = path;
  p.sampler = p.sampler.branch(p.depth);
  p.radiance = p.lit = p.gathered = Spectrumf(0.0f);
  views_.push_back(view(p));
  return int(paths_.size()) - 1;
}

/// Sends a path on from a vertex; null if it carries nothing.
Flight* Integrator::leave(const Vertex& v, const Scatterer& s, const Sampled& sampled, int path) {
  Flight f = *v.from;
  f.path = path;
  // The same vertex lit by a light drawn with density 1 has the density of the path up to here.
  Detour& detour = paths_[path].detour;
  detour = next_detour(v, sampled);
  if (detour.ball >= 0)
    f.carried.light_pdf *= possible(sampled.pdf);
  else
    f.carried.light_pdf = sampled.specular ? Spectrumf(0.0f) : v.from->carried.pdf;
  f.carried.happened(sampled.f, sampled.pdf);
  f.carried.rescale();
  if (!(f.carried.beta.sum() > 0)) return nullptr;
  if (s.medium) {
    f.origin = Vec3f(v.point.surface.position);
  } else {
    f.origin = ray_origin(v.point.surface, sampled.wi);
    follow(f, v, sampled.wi);
  }
  f.direction = Vec3f(sampled.wi);
  f.receives = s.receives(v.point);
  f.end = End::Flying;
  f.emission_seen = false;
  f.look_step = 1;
  f.glow_chance = detour.ball < 0 ? glow_chance(paths_[path].depth) : 0;
  f.t = 0;
  f.t_max = std::numeric_limits<float>::infinity();
  f.step = 0;
  f.stream = 2 * std::uint32_t(paths_[path].depth);
  next_.push_back(f);
  return &next_.back();
}

/// Russian roulette by the mean contribution that the path still carries. It is the same whatever
/// wavelength is the hero, so the spectral weights do not see it.
bool Integrator::survives(Carried& c, int depth, float u) const {
  const float carried = c.beta.sum() / c.pdf.sum();
  if (!(carried > 0)) return false;
  if (depth < kFirstRoulette) return true;
  const float q = std::min(1.0f, carried * float(directions_of_first_) / kSafeContribution);
  if (u >= q) return false;
  c.beta *= 1 / q;
  return true;
}

}  // namespace mms::renderer
