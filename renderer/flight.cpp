// SPDX-License-Identifier: Apache-2.0
#include "renderer/flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/batches.h"
#include "renderer/vertex.h"

namespace mms::renderer {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Flights from the camera ask for emission so many times as often as others: a pixel has one of
/// them to many of those.
constexpr float kLookStepOfCamera = 0.25f;

Spectrumf unit_clamped(const Spectrumf& s) {
  return Spectrumf::map([](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; }, s);
}

}  // namespace

void Carried::happened(const Spectrumf& f, const Spectrumf& p) {
  const float scale = 1 / p[0];
  beta *= f * scale;
  pdf *= p * scale;
  light_pdf *= scale;
}

void Carried::rescale() {
  const float largest = pdf.max();
  if (!(largest > 0)) return;
  const float scale = 1 / largest;
  beta *= scale;
  pdf *= scale;
  light_pdf *= scale;
}

Spectrumf Carried::weighted(Technique by, double light_density, Estimator estimator) const {
  // 1 / density, times density^2 over the sum of both techniques' squares.
  const auto weight = [&](float scattering, float light) {
    const double s = scattering, l = light_density > 0 ? light_density * light : 0;
    const double squares = s * s + l * l;
    return squares > 0 ? (by == Technique::Light ? l : s) / squares : 0;
  };
  if (estimator == Estimator::Clustered || estimator == Estimator::Four)
    return beta * float(weight(pdf.sum(), light_pdf.sum()));
  const double hero = weight(pdf[0], light_pdf[0]);
  if (estimator == Estimator::Unweighted) return beta * float(hero / kWavelengths);
  Spectrumf one;
  one[0] = beta[0] * float(hero);
  return one;
}

Flight camera_flight(const World& world, int path, const Sampler& sampler, double x, double y) {
  const auto [lens_u, lens_v] =
      world.camera.pinhole() ? std::array<float, 2>{0.5f, 0.5f} : sampler.pair(kLensPair);
  const CameraRay ray = world.camera.at(x, y, lens_u, lens_v);
  Flight f;
  f.origin = ray.origin;
  f.direction = ray.direction;
  f.path = path;
  f.t_max = kInfinity;
  f.media = world.camera_media;
  f.look_step = kLookStepOfCamera;
  return f;
}

ScriptPoint script_point(const World& world, const Flight& f, const Hit* hit,
                         const PathView& path) {
  ScriptPoint p;
  p.cluster = path.cluster;
  p.view = -Vec3d(f.direction);
  p.distance = f.t;
  p.cone = path.cone * f.t;
  p.screen_x = world.camera.right();
  p.screen_y = world.camera.down();
  if (hit) {
    p.object = &world.scene.objects[hit->object];
    p.surface = surface_of(world.scene, *hit, f.origin, f.direction);
    return p;
  }
  p.object = &world.scene.objects[f.medium];
  p.surface.position = Vec3d(f.origin) + Vec3d(f.direction) * double(f.t);
  const Frame<double> axes = Frame<double>::around(p.view);
  p.surface.normal = p.surface.geometric_normal = axes.n;
  p.surface.tangent = axes.s;
  p.surface.bitangent = axes.t;
  return p;
}

void Flights::fly(std::vector<Flight>& flights, const std::vector<PathView>& paths, double left) {
  if (world_.plain) {
    Crossings none;
    for (Flight& f : flights)
      if (f.end == End::Flying) trace(f, none, 0);
    return;
  }
  flying_.clear();
  for (int i = 0; i < int(flights.size()); ++i) {
    if (flights[i].end != End::Flying) continue;
    if (flights[i].crossings < 0) begin(flights[i]);
    if (flights[i].end == End::Flying) flying_.push_back(i);
  }
  const auto enough = std::size_t(left * double(flying_.size()));
  while (flying_.size() > enough) {
    advance_all(flights, paths);
    std::erase_if(flying_, [&](int i) {
      Flight& f = flights[i];
      if (f.end == End::Flying) return false;
      free_crossings_.push_back(f.crossings);
      f.crossings = -1;
      return true;
    });
  }
}

/// Traces a flight that has not begun.
void Flights::begin(Flight& f) {
  if (free_crossings_.empty()) {
    free_crossings_.push_back(int(crossings_.size()));
    crossings_.emplace_back();
  }
  trace(f, crossings_[free_crossings_.back()], 0);
  if (f.end != End::Flying) return;
  f.crossings = free_crossings_.back();
  free_crossings_.pop_back();
  f.look = {-1, 0};
}

/// Each flight goes on to its end or to where a script has to be asked, and is answered. What fills
/// no batch waits, if something else goes on.
void Flights::advance_all(std::vector<Flight>& flights, const std::vector<PathView>& paths) {
  requests_.clear();
  bool onward = false;
  for (int i : flying_) {
    Flight& f = flights[i];
    Crossings& crossings = crossings_[f.crossings];
    if (f.need == Need::Nothing) f.need = advance(f, crossings, paths[f.path]);
    if (f.need == Need::Nothing) {
      onward = true;
      continue;
    }
    const int key = f.need == Need::Crossing
                        ? world_.scene.objects[crossings.hits[f.next].object].surface
                        : world_.scene.objects[f.medium].volume;
    requests_.push_back({i, f.need, key});
  }
  const auto key = [](const Request& r) { return std::pair(r.need, r.key); };
  std::ranges::stable_sort(requests_, {}, key);
  part_filled_.clear();
  for_each_batch(std::span(std::as_const(requests_)), scripts_.width(), key,
                 [&](std::span<const Request> batch) {
                   if (int(batch.size()) < scripts_.width()) return part_filled_.push_back(batch);
                   answer(flights, paths, batch);
                   onward = true;
                 });
  if (onward) return;
  for (std::span<const Request> batch : part_filled_) answer(flights, paths, batch);
}

bool Flights::open(Vec3f from, Vec3f to) {
  ++counters_.shadow_rays;
  const Vec3f way = to - from;
  const float distance = length(way);
  return !(distance > 0) || !world_.accel.occluded(from, way / distance, distance);
}

/// Finds what lies on the ray beyond distance `from`.
void Flights::trace(Flight& f, Crossings& crossings, float from) {
  const bool shadow = f.errand == Errand::Shadow;
  if (from == 0) ++(f.errand == Errand::Path ? counters_.rays : counters_.shadow_rays);
  if (shadow && world_.plain) {
    f.end = world_.accel.occluded(f.origin, f.direction, f.t_max) ? End::Lost : End::Free;
    return;
  }
  f.hit = world_.accel.intersect(f.origin, f.direction, from, f.t_max, crossings);
  f.next = 0;
  if (shadow && f.hit.object >= 0) f.end = End::Lost;
  if (world_.plain && !shadow) {
    f.end = f.hit.object >= 0 ? End::Surface : End::Free;
    f.t = f.hit.object >= 0 ? f.hit.t : kInfinity;
  }
}

/// Takes a flight to its end, or to where a script has to be asked.
Need Flights::advance(Flight& f, Crossings& crossings, const PathView& path) {
  for (;;) {
    if (f.next == crossings.count && crossings.overflow) {
      trace(f, crossings, std::nextafter(f.t, kInfinity));
      if (f.end != End::Flying) return Need::Nothing;
    }
    const bool at_crossing = f.next < crossings.count;
    const float to = at_crossing ? crossings.hits[f.next].t : f.hit.object >= 0 ? f.hit.t : f.t_max;
    if (to == kInfinity) f.media.clear();  // left through a gap of a mesh that is not closed
    Need need = Need::Nothing;
    if (!f.media.empty() && to > f.t && !along_media(f, to, path, need)) return need;
    f.t = to;
    if (at_crossing) {
      const Hit& hit = crossings.hits[f.next];
      if (hidden(world_.scene, f.media, hit.object)) {
        pass_false_surface(f, hit);
        continue;
      }
      if (world_.semi_transparent[hit.object]) return Need::Crossing;
      f.hit = hit;  // collected only because it might have been hidden
      f.end = f.errand == Errand::Path ? End::Surface : End::Lost;
      return Need::Nothing;
    }
    f.end = f.hit.object < 0 ? End::Free : f.errand == Errand::Path ? End::Surface : End::Lost;
    return Need::Nothing;
  }
}

/// Goes on where the surface that was met is not there, being inside of what has priority.
void Flights::pass_false_surface(Flight& f, const Hit& hit) {
  const SurfacePoint s = surface_of(world_.scene, hit, f.origin, f.direction);
  world_.cross(f.media, hit.object, dot(s.geometric_normal, Vec3d(f.direction)) < 0);
  f.forget_media();
  ++f.next;
}

/// Runs the script that a group of flights waits for, and lets each act on its answer.
void Flights::answer(std::vector<Flight>& flights, const std::vector<PathView>& paths,
                     std::span<const Request> requests) {
  const Need need = requests[0].need;
  points_.clear();
  for (const Request& r : requests) {
    Flight& f = flights[r.flight];
    f.need = Need::Nothing;
    const Hit* hit = need == Need::Crossing ? &crossings_[f.crossings].hits[f.next] : nullptr;
    points_.push_back(script_point(world_, f, hit, paths[f.path]));
  }
  lanes_.clear();
  for (const ScriptPoint& p : points_) lanes_.push_back(&p);
  const int n = int(requests.size());

  if (need != Need::Crossing) {
    const vm::Descriptor& d = *world_.scene.volumes[requests[0].key].script;
    const CompiledDescriptor& c = world_.compiled.of(&d);
    scripts_.run(d, need == Need::Emission ? EntryKind::Emit : EntryKind::Shade, lanes_);
    for (int i = 0; i < n; ++i) {
      Flight& f = flights[requests[i].flight];
      const PathView& path = paths[f.path];
      if (need == Need::Emission) {
        see(f, emission(d.emit, c.emit_emission, f, i, path) * (f.look_step / f.rate), path);
        continue;
      }
      Coefficients coefficients = removed(d, i, path);
      if (need == Need::Collision) {
        collide(f, coefficients, path);
      } else {
        coefficients.emission = emission(d.shade, c.shade_emission, f, i, path);
        add_even(f, coefficients, path);
      }
    }
    return;
  }

  const Surface& surface = world_.scene.surfaces[requests[0].key];
  if (!surface.script) {  // only an invisible one comes here
    for (int i = 0; i < n; ++i)
      cross(flights[requests[i].flight], points_[i], Spectrumf(), Spectrumf(),
            paths[flights[requests[i].flight].path]);
    return;
  }
  const vm::Descriptor& d = *surface.script;
  if (world_.compiled.of(&d).emits) {
    scripts_.run(d, EntryKind::Emit, lanes_);
    for (int i = 0; i < n; ++i) {
      const Flight& f = flights[requests[i].flight];
      if (f.errand == Errand::Path && !scripts_.given_up(i))
        add_crossing_emission(f, points_[i],
                              scripted_emission(world_.compiled, scripts_, d, EntryKind::Emit, i,
                                                points_[i].surface, points_[i].view, params_),
                              paths[f.path]);
    }
  }
  scripts_.run(d, EntryKind::Pass, lanes_);
  for (int i = 0; i < n; ++i) {
    Flight& f = flights[requests[i].flight];
    const PathView& path = paths[f.path];
    const bool lost = scripts_.given_up(i);
    cross(f, points_[i],
          lost ? Spectrumf(1.0f) : unit_clamped(answered(d.pass.scattering, i, path)),
          lost ? Spectrumf() : unit_clamped(answered(d.pass.absorption, i, path)), path);
  }
}

/// What the last run says for a lane. Where that is not a number the sample is dropped and counted,
/// whatever stands in for it on the way.
Spectrumf Flights::answered(const vm::ValueSource& v, int lane, const PathView& path) const {
  const Spectrumf s = scripts_.spectrum(v, lane);
  for (int k = 0; k < kWavelengths; ++k)
    if (std::isnan(s[k])) *path.radiance = Spectrumf(std::numeric_limits<float>::quiet_NaN());
  return s;
}

/// A semi-transparent surface: scattered there, or straight through with (1 - s)(1 - a).
void Flights::cross(Flight& f, const ScriptPoint& point, const Spectrumf& scattering,
                    const Spectrumf& absorption, const PathView& path) {
  const Spectrumf one(1.0f);
  const Spectrumf through = (one - scattering) * (one - absorption);
  const Spectrumf either = scattering + through;
  Spectrumf p_through;
  for (int k = 0; k < kWavelengths; ++k) p_through[k] = either[k] > 0 ? through[k] / either[k] : 0;
  const Hit& hit = crossings_[f.crossings].hits[f.next];
  const bool inwards = dot(point.surface.geometric_normal, point.view) > 0;
  if (f.errand != Errand::Path) {
    f.carried.beta *= through;
    f.carried.pdf *= p_through;
    if (f.carried.beta.is_black()) {
      f.end = End::Lost;
      return;
    }
  } else {
    if (!(either[0] > 0)) {
      f.end = End::Lost;
      return;
    }
    if (!(p_through[0] > 0) || random(f, path) >= p_through[0]) {
      f.carried.happened(scattering, one - p_through);
      f.carried.rescale();
      f.hit = hit;
      f.emission_seen = true;
      f.end = scattering[0] > 0 ? End::Surface : End::Lost;
      return;
    }
    f.carried.happened(through, p_through);
    f.carried.rescale();
  }
  world_.cross(f.media, hit.object, inwards);
  f.forget_media();
  ++f.next;
}

void Flights::add_crossing_emission(const Flight& f, const ScriptPoint& point,
                                    const Spectrumf& emitted, const PathView& path) {
  const int object = int(point.object - world_.scene.objects.data());
  const double light = world_.lights.pdf(f.left(), object, point.surface);
  *path.radiance += f.carried.weighted(Technique::Scattering, light, world_.estimator) * emitted;
}

}  // namespace mms::renderer
