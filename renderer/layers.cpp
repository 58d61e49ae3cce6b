// SPDX-License-Identifier: Apache-2.0
#include "renderer/layers.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>

#include "materials/bsdf.h"
#include "materials/colour.h"
#include "materials/phase.h"
#include "renderer/batches.h"
#include "renderer/flight.h"
#include "renderer/surroundings.h"
#include "renderer/vertex.h"
#include "renderer/world.h"

namespace mms::renderer {
namespace {

/// Directions drawn at each vertex for its albedo.
constexpr int kDirections = 4;
/// Tells the numbers of those directions from all others of a path (Flight::stream).
constexpr std::uint32_t kStream = 0xa1bed0;

using Triple = std::array<double, 3>;

void add(Triple& sum, Vec3d v) { sum[0] += v.x, sum[1] += v.y, sum[2] += v.z; }

Vec3d linear_srgb(const Cluster& cluster, const Spectrumf& radiance) {
  const auto xyz = cluster.xyz(radiance);
  return materials::linear_srgb_of_xyz({xyz[0], xyz[1], xyz[2]});
}

/// One camera ray, and what it found.
struct Look {
  Sampler sampler;
  Cluster cluster;
  Spectrumf radiance;  ///< met on the way and at the end
  Spectrumf albedo;
  Vec3d normal, position;
  float distance = 0;
  int kind = -1;  ///< surfaces first, then volumes; -1 is nothing
};

/// Pixels of a row that are looked at together.
constexpr int kRun = 256;

/// One thread's work: all samples of a run of pixels at a time.
class Gaze {
 public:
  Gaze(const World& world, int samples)
      : world_(world),
        scripts_(world.compiled),
        flights_(world, scripts_),
        surroundings_(world, scripts_),
        samples_(samples) {}

  /// Fills the layers of pixels [x0, x1) of row y of a picture that is `width` wide.
  void trace(int y, int x0, int x1, int width, Layers& layers) {
    start(y, x0, x1);
    flights_.fly(rays_, views_);
    meet();
    for (int x = x0; x < x1; ++x)
      write(std::span(looks_).subspan(std::size_t(x - x0) * samples_, samples_),
            std::size_t(y) * std::size_t(width) + std::size_t(x), layers);
  }

 private:
  struct Vertex {
    const Flight* from;
    ScriptPoint point;
    Spectrumf outside{1.0f};  ///< index of what its surface lies in
  };

  /// Weight of what the end of `f` sends back.
  static Spectrumf arriving(const Flight& f) {
    return f.carried.weighted(Technique::Scattering, 0, Estimator::Clustered);
  }
  int surfaces() const { return int(world_.scene.surfaces.size()); }

  void start(int y, int x0, int x1) {
    looks_.assign(std::size_t(x1 - x0) * samples_, {});
    rays_.clear();
    views_.clear();
    for (int i = 0; i < int(looks_.size()); ++i) {
      const int x = x0 + i / samples_;
      Look& l = looks_[i];
      l.sampler = Sampler(world_.seed, x, y, std::uint64_t(i % samples_));
      const std::array<float, 4> u = l.sampler.first();
      l.cluster = sample_cluster(u[kWavelength], kWavelengths, world_.matter);
      views_.push_back(
          {&l.cluster, &l.sampler, &l.radiance, &l.radiance, world_.camera.pixel_angle()});
      rays_.push_back(
          camera_flight(world_, i, l.sampler, x + double(u[kFilmX]), y + double(u[kFilmY])));
    }
  }

  /// Orders what was met by what has to be run for it, and runs that.
  void meet() {
    std::vector<Vertex> vertices;
    for (const Flight& f : rays_) {
      Look& l = looks_[f.path];
      if (f.end == End::Free)
        l.radiance += arriving(f) * world_.lights.environment(Vec3d(f.direction), l.cluster);
      if (f.end != End::Surface && f.end != End::Medium) continue;
      const bool medium = f.end == End::Medium;
      l.kind = medium ? surfaces() + world_.scene.objects[f.medium].volume
                      : world_.scene.objects[f.hit.object].surface;
      vertices.push_back({&f, script_point(world_, f, medium ? nullptr : &f.hit, views_[f.path]),
                          Spectrumf(1.0f)});
      l.position = vertices.back().point.surface.position;
      l.distance = f.t;
    }
    const auto kind = [&](const Vertex& v) { return looks_[v.from->path].kind; };
    if (world_.nested) {
      std::vector<Surroundings::Place> places;
      for (Vertex& v : vertices) places.push_back({v.from, &v.point, &v.outside});
      surroundings_.ask(places);
    }
    std::ranges::stable_sort(vertices, {}, kind);
    for_each_batch(std::span(vertices), scripts_.width(), kind, [&](std::span<const Vertex> group) {
      const int k = kind(group[0]);
      const vm::Descriptor* script = k < surfaces() ? world_.scene.surfaces[k].script
                                                    : world_.scene.volumes[k - surfaces()].script;
      if (script)
        ask(*script, k >= surfaces(), group);
      else
        for (const Vertex& v : group) look_up(world_.scene.surfaces[k].fixed, v);
    });
  }

  /// A surface that the scene describes: matte.
  void look_up(const FixedSurface& surface, const Vertex& v) {
    const SurfacePoint& s = v.point.surface;
    Look& l = looks_[v.from->path];
    const Spectrumf weight = arriving(*v.from);
    l.normal = s.normal;
    l.albedo = weight * fixed_albedo(surface, *v.point.object, s.position, l.cluster);
    if (!v.from->emission_seen)
      l.radiance += weight * fixed_emission(surface, s, v.point.view, l.cluster);
  }

  void ask(const vm::Descriptor& d, bool medium, std::span<const Vertex> group) {
    lanes_.clear();
    for (const Vertex& v : group) lanes_.push_back(&v.point);
    scripts_.run(d, EntryKind::Shade, lanes_);
    const CompiledDescriptor& c = world_.compiled.of(&d);
    params_.resize(std::size_t(std::max(1, world_.compiled.max_params())));
    for (int i = 0; i < int(group.size()); ++i) {
      if (scripts_.given_up(i)) continue;
      const Vertex& v = group[i];
      scripts_.params(d.shade.material, i, params_.data());
      if (medium) {
        scatter(v, [&](float u, float a, float b) {
          return materials::Phase<float>(c.material, params_.data())
              .sample(Vec3f(v.point.view), u, a, b);
        });
      } else {
        if (world_.nested) immerse(c.material, v.outside, params_.data());
        surface(d, c, v, i);
      }
    }
  }

  void surface(const vm::Descriptor& d, const CompiledDescriptor& c, const Vertex& v, int lane) {
    Look& l = looks_[v.from->path];
    std::array<double, 2> gradient{0, 0};
    if (c.bumps && !v.point.object->displaced)
      gradient = {scripts_.real(d.shade.gradient[0], lane),
                  scripts_.real(d.shade.gradient[1], lane)};
    const Frame<double> frame = shading_frame(v.point.surface, gradient, v.point.view);
    l.normal = frame.n;
    // Glass is asked for light sent the other way: what enters is not squeezed into a narrower
    // cone, so a clean one has albedo 1.
    using materials::Mode;
    const Mode mode = c.material.transmits() ? Mode::Importance : Mode::Radiance;
    const Vec3f wo(frame.to_local(v.point.view));
    const materials::Bsdf<float> bsdf(c.material, params_.data());
    bsdf.choose(wo, choice_);
    scatter(v, [&](float u, float a, float b) {
      auto s = bsdf.sample(wo, u, a, b, mode, choice_);
      if (s) s->f *= std::abs(s->wi.z);
      return s;
    });
    if (c.emits && !v.from->emission_seen)
      l.radiance +=
          arriving(*v.from) * scripted_emission(world_.compiled, scripts_, d, EntryKind::Shade,
                                                lane, v.point.surface, v.point.view, scratch_);
  }

  /// The albedo, by directions that `sample` draws.
  template <class Sample>
  void scatter(const Vertex& v, Sample sample) {
    Look& l = looks_[v.from->path];
    for (std::uint32_t i = 0; i < 3 * kDirections; i += 3) {
      const auto s = sample(l.sampler.hashed(kStream, i), l.sampler.hashed(kStream, i + 1),
                            l.sampler.hashed(kStream, i + 2));
      if (!s) continue;
      Carried c = v.from->carried;
      c.happened(s->f, s->pdf);
      l.albedo += c.weighted(Technique::Scattering, 0, Estimator::Clustered) * (1.0f / kDirections);
    }
  }

  void write(std::span<const Look> looks, std::size_t at, Layers& layers) {
    Triple albedo{}, normal{}, position{}, emission{};
    double depth = 0;
    int there = 0;
    counts_.assign(layers.names.size() + 1, 0);
    for (const Look& l : looks) {
      add(emission, linear_srgb(l.cluster, l.radiance));
      ++counts_[std::size_t(l.kind + 1)];
      if (l.kind < 0) continue;
      ++there;
      add(albedo, linear_srgb(l.cluster, l.albedo * l.cluster.daylight));
      add(normal, l.normal);
      add(position, l.position);
      depth += l.distance;
    }
    const auto mean = [](const Triple& sum, int n) {
      const double scale = 1.0 / std::max(1, n);
      return Layers::Triple{float(sum[0] * scale), float(sum[1] * scale), float(sum[2] * scale)};
    };
    const int all = int(looks.size());
    layers.albedo[at] = mean(albedo, all);
    layers.emission[at] = mean(emission, all);
    layers.normal[at] = mean(normal, all);
    layers.position[at] = mean(position, there);
    layers.depth[at] = there > 0 ? float(depth / there) : std::numeric_limits<float>::infinity();
    layers.descriptor[at] =
        std::uint32_t(std::max_element(counts_.begin(), counts_.end()) - counts_.begin());
  }

  const World& world_;
  Scripts scripts_;
  Flights flights_;
  Surroundings surroundings_;
  int samples_;
  std::vector<Look> looks_;
  std::vector<Flight> rays_;
  std::vector<PathView> views_;
  std::vector<const ScriptPoint*> lanes_;
  std::vector<float> params_, scratch_;
  materials::Bsdf<float>::Choice choice_;  ///< of the surface that is looked at
  std::vector<int> counts_;
};

}  // namespace

Layers trace_layers(const World& world, int width, int height, int samples, int threads) {
  const std::size_t area = std::size_t(width) * std::size_t(height);
  Layers layers;
  layers.samples = std::min(samples, kLayerSamples);
  for (auto* triples : {&layers.albedo, &layers.normal, &layers.position, &layers.emission})
    triples->resize(area);
  layers.depth.resize(area);
  layers.descriptor.resize(area);
  for (const Surface& s : world.scene.surfaces) layers.names.push_back(s.name);
  for (const Volume& v : world.scene.volumes) layers.names.push_back(v.name);
  if (threads <= 0) threads = int(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<int> next{0};
  const auto work = [&] {
    Gaze gaze(world, layers.samples);
    for (int y = next++; y < height; y = next++)
      for (int x = 0; x < width; x += kRun)
        gaze.trace(y, x, std::min(x + kRun, width), width, layers);
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < std::min(threads, height); ++i) others.emplace_back(work);
  work();
  return layers;
}

}  // namespace mms::renderer
