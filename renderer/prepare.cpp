// SPDX-License-Identifier: Apache-2.0
#include "renderer/prepare.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/enclosure.h"
#include "renderer/sampler.h"
#include "renderer/vertex.h"
#include "renderer/world.h"
#include "vm/limits.h"

namespace mms::renderer {

std::string place(const vm::Program& program, std::uint32_t source, std::uint32_t line) {
  if (line == 0 || source >= program.sources.size()) return "script";
  return fmt::format("{}:{}", program.sources[source], line);
}

std::string cause_text(vm::Fault::Cause cause) {
  if (cause == vm::Fault::Cause::BackEdges)
    return fmt::format("more than {} recursive steps at one point", vm::limits::kBackEdges);
  return fmt::format("recursion deeper than {} calls", vm::limits::kCallDepth);
}

bool emits(const SceneData& scene, const Compiled& compiled, const Object& o) {
  const Surface& s = scene.surfaces[o.surface];
  return s.script ? compiled.of(s.script).emits : s.fixed.emits();
}

Matter matter_of(const SceneData& scene, const Compiled& compiled) {
  const auto grey = [](const Rgb& c) { return c[0] == c[1] && c[1] == c[2]; };
  const auto even = [&](const vm::Descriptor* d) {
    using vm::Output;
    return !d ||
           (!compiled.of(d).emits && !d->output(Output::Material).spectral &&
            !d->output(Output::Scattering).spectral && !d->output(Output::Absorption).spectral);
  };
  bool all = true;
  for (const Object& o : scene.objects) {
    const Surface& s = scene.surfaces[o.surface];
    all &= even(s.script) &&
           (s.script || (grey(s.fixed.matte) && grey(s.fixed.checker.value_or(s.fixed.matte))));
    all &= o.volume < 0 || even(scene.volumes[o.volume].script);
  }
  return all ? Matter::Grey : Matter::Coloured;
}

bool semi_transparent(const SceneData& scene, const Compiled& compiled, const Object& o) {
  const Surface& s = scene.surfaces[o.surface];
  return s.script ? compiled.of(s.script).semi_transparent : s.fixed.invisible;
}

bool may_be_hidden(const SceneData& scene, const Object& o) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& other) { return other.priority > o.priority; }) &&
         tracked(o);
}

Filling World::filling(const Media& media) const {
  int highest = 0;
  for (int i = 0; i < media.count; ++i)
    highest = std::max(highest, scene.objects[media.objects[i]].priority);
  Filling f;
  for (int i = 0; i < media.count; ++i) {
    const int object = media.objects[i];
    const Object& o = scene.objects[object];
    if (o.priority < highest || o.volume < 0) continue;
    if (volume_of_object(object).homogeneous)
      f.even[f.even_count++] = object;
    else
      f.varied[f.varied_count++] = object;
  }
  return f;
}

bool sealed(const SceneData& scene, const Compiled& compiled, int i) {
  const Object& o = scene.objects[i];
  if (!tracked(o) || semi_transparent(scene, compiled, o) || may_be_hidden(scene, o)) return false;
  const Bounds box = bounds(o.shape);
  for (const Object& other : scene.objects)
    if (emits(scene, compiled, other) && overlap(box, bounds(other.shape))) return false;
  return true;
}

namespace {

/// Points of the surface of an object.
std::vector<ScriptPoint> points_of(const Object& o, const Cluster& cluster) {
  std::vector<ScriptPoint> points(kProbePoints);
  const Sampler random(0, 0, 0, 0);
  for (int i = 0; i < kProbePoints; ++i) {
    const std::uint32_t k = 3 * std::uint32_t(i);
    ScriptPoint& p = points[i];
    p.object = &o;
    p.cluster = &cluster;
    p.surface = sample_surface(o.shape, random.hashed(0, k), random.hashed(0, k + 1));
    p.view = p.surface.normal;
    p.distance = 1;
    p.cone = 1e-3;
    p.screen_x = p.surface.tangent;
    p.screen_y = p.surface.bitangent;
  }
  return points;
}

/// As many more of a box in the volume of an object.
void add_points(std::vector<ScriptPoint>& points, const Object& o, const Bounds& box, int count,
                const Cluster& cluster) {
  const Sampler random(0, 0, 0, 0);
  const Frame<double> axes = Frame<double>::around({0, 0, 1});
  for (int i = 0; i < count; ++i) {
    const std::uint32_t k = 3 * std::uint32_t(points.size());
    const Vec3d u{random.hashed(0, k), random.hashed(0, k + 1), random.hashed(0, k + 2)};
    ScriptPoint& p = points.emplace_back();
    p.object = &o;
    p.cluster = &cluster;
    p.surface.position = box.low + (box.high - box.low) * u;
    p.surface.normal = p.surface.geometric_normal = p.view = axes.n;
    p.surface.tangent = p.screen_x = axes.s;
    p.surface.bitangent = p.screen_y = axes.t;
    p.distance = 1;
    p.cone = 1e-3;
  }
}

/// Nothing to do with the answers.
struct None {};

/// How often along half of the diagonal of a volume that is as bright everywhere its emission is
/// asked for, and at most along that of a cell; what part of it by what it may be at most.
constexpr double kLooks = 2, kLooksOfCell = 1, kBoundShare = 0.2;

/// Points of a cell at which it is asked before.
constexpr int kCellProbes = 4;

class Probe {
 public:
  Probe(const SceneData& scene, const Compiled& compiled)
      : scene_(scene), compiled_(compiled), scripts_(compiled), cluster_(sample_cluster(0.5)) {}

  Result<Findings> run() {
    Findings findings;
    for (const Object& o : scene_.objects) {
      Result<RateGrid> grid = majorants(o);
      if (!grid) return grid.error();
      findings.majorants.push_back(std::move(*grid));
      findings.emission_rates.push_back(emission_rates(o));
      findings.radiance.push_back(radiance_of(o));
      if (o.volume >= 0) {
        const vm::Descriptor& d = *scene_.volumes[o.volume].script;
        run_all(d, EntryKind::Shade, points_in(o), None{});
        if (compiled_.of(&d).emits)
          findings.glows.push_back(glow_of(o, findings.emission_rates.back()));
      }
      if (scripts_.fault_lanes() > 0) return fault();
    }
    return findings;
  }

 private:
  Result<RateGrid> majorants(const Object& o) const {
    if (o.volume < 0) return RateGrid();
    const vm::Descriptor& d = *scene_.volumes[o.volume].script;
    const CompiledDescriptor& c = compiled_.of(&d);
    if (c.homogeneous) return RateGrid();
    RateGrid grid =
        majorants_of(compiled_.program(), d, o, c.majorant > 0 ? c.majorant : vm::Interval::kInf);
    if (std::isfinite(grid.largest())) return grid;
    return Error{
        place(compiled_.program(), d.line.source, d.line.line),
        fmt::format("volume `{}` varies from place to place, states no `bound`, and none is found",
                    d.name),
        "add `bound = ...`: the largest scattering + absorption anywhere in it, in 1/m; "
        "`mms bounds` shows what is known"};
  }

  std::vector<ScriptPoint> points_in(const Object& o) const {
    std::vector<ScriptPoint> points;
    add_points(points, o, bounds(o.shape), kProbePoints, cluster_);
    return points;
  }

  /// Where flights ask for the emission of a volume that varies: as it was found at points of each
  /// cell, and lest one was missed, as enclosures bound it.
  RateGrid emission_rates(const Object& o) {
    if (o.volume < 0) return {};
    const vm::Descriptor& d = *scene_.volumes[o.volume].script;
    const CompiledDescriptor& c = compiled_.of(&d);
    if (c.homogeneous || !c.emits) return {};
    const std::vector<float> most = most_emission(compiled_.program(), d, o);
    const double mean_most = mean(most);
    if (mean_most == 0) return {};
    const std::vector<float> found = found_emission(o, most);
    const double mean_found = mean(found);
    const Bounds box = bounds(o.shape);
    const double diagonal = length(box.high - box.low);
    std::vector<float> rates;
    for (std::size_t i = 0; i < most.size(); ++i) {
      const double bound = most[i] / mean_most;
      const double share = mean_found > 0
                               ? (1 - kBoundShare) * (found[i] / mean_found) + kBoundShare * bound
                               : bound;
      rates.push_back(float(std::min(2 * kLooks * share, kLooksOfCell * kRateCells) / diagonal));
    }
    return {box, kRateCells, std::move(rates)};
  }

  static double mean(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum / double(values.size());
  }

  /// The largest that is found at a few points of each cell where it may not be 0; no more than
  /// `most`.
  std::vector<float> found_emission(const Object& o, const std::vector<float>& most) {
    const vm::Descriptor& d = *scene_.volumes[o.volume].script;
    std::vector<ScriptPoint> points;
    std::vector<int> cells;
    for (int i = 0; i < int(most.size()); ++i) {
      if (!(most[i] > 0)) continue;
      add_points(points, o, cell_of(bounds(o.shape), kRateCells, i), kCellProbes, cluster_);
      cells.resize(points.size(), i);
    }
    std::vector<float> found(most.size());
    run_all(d, EntryKind::Emit, points, [&](const ScriptPoint& p, int lane) {
      const float e = scripts_.spectrum(d.emit.emission, lane).sum() / kWavelengths;
      float& largest = found[cells[&p - points.data()]];
      if (e > largest) largest = std::min(e, most[cells[&p - points.data()]]);
    });
    return found;
  }

  template <class F>
  void run_all(const vm::Descriptor& d, EntryKind kind, const std::vector<ScriptPoint>& points,
               F each) {
    std::vector<const ScriptPoint*> lanes;
    for (std::size_t first = 0; first < points.size(); first += lanes.size()) {
      lanes.clear();
      for (std::size_t i = first; i < points.size() && int(lanes.size()) < scripts_.width(); ++i)
        lanes.push_back(&points[i]);
      scripts_.run(d, kind, lanes);
      if constexpr (!std::is_same_v<F, None>)
        for (int lane = 0; lane < int(lanes.size()); ++lane) each(*lanes[lane], lane);
    }
  }
  /// Runs what a render will run for the object's surface; mean luminance along the normal.
  double radiance_of(const Object& o) {
    const Surface& surface = scene_.surfaces[o.surface];
    if (!surface.script) {
      const Rgb& e = surface.fixed.emission;
      return 0.2126 * e[0] + 0.7152 * e[1] + 0.0722 * e[2];
    }
    const vm::Descriptor& d = *surface.script;
    const std::vector<ScriptPoint> points = points_of(o, cluster_);
    run_all(d, EntryKind::Shade, points, None{});
    if (compiled_.of(&d).semi_transparent) run_all(d, EntryKind::Pass, points, None{});
    if (!compiled_.of(&d).emits) return 0;
    double sum = 0;
    run_all(d, EntryKind::Emit, points, [&](const ScriptPoint& p, int lane) {
      const Spectrumf e = scripted_emission(compiled_, scripts_, d, EntryKind::Emit, lane,
                                            p.surface, p.surface.normal, scratch_);
      sum += std::max(0.0, cluster_.xyz(e)[1] / kWavelengths);
    });
    // Too small to matter is still an emitter.
    return std::isfinite(sum) ? std::max(sum / kProbePoints, 1e-6) : 1.0;
  }

  /// The volume of an object, which emits, at `rates` if that varies.
  Glow glow_of(const Object& o, const RateGrid& rates) {
    const vm::Descriptor& d = *scene_.volumes[o.volume].script;
    double sum = 0;
    run_all(d, EntryKind::Emit, points_in(o), [&](const ScriptPoint&, int lane) {
      sum += std::max(0.0, cluster_.xyz(scripts_.spectrum(d.emit.emission, lane))[1]);
    });
    const Bounds box = rates.empty() ? bounds(o.shape) : rates.support(rates.largest() / 8);
    Glow glow{(box.low + box.high) * 0.5, length(box.high - box.low) / 2, 1};
    if (const Sphere* s = std::get_if<Sphere>(&o.shape); s && s->radius < glow.radius)
      glow.centre = s->centre, glow.radius = s->radius;
    // Too little to matter is still light.
    if (std::isfinite(sum)) glow.radiance = std::max(sum / kProbePoints, 1e-6) * glow.radius;
    return glow;
  }

  Error fault() const {
    const auto& [where, lanes] = *scripts_.faults().begin();
    return {place(compiled_.program(), where.source, where.line),
            "the script does not come to an end: " + cause_text(where.cause),
            "check that every recursion reaches its end", Error::Cause::Budget};
  }

  const SceneData& scene_;
  const Compiled& compiled_;
  Scripts scripts_;
  Cluster cluster_;
  std::vector<float> scratch_;
};

}  // namespace

Result<Findings> probe(const SceneData& scene, const Compiled& compiled) {
  return Probe(scene, compiled).run();
}

}  // namespace mms::renderer
