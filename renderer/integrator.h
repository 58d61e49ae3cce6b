// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Path tracing after thesis 4.4.1, in wavefronts: many paths take each step together, so that hits
/// on one descriptor are shaded in batches. New paths begin as others end, and what takes long on
/// its way does not hold up the rest. One Integrator is one thread's.

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "materials/bsdf.h"
#include "renderer/film.h"
#include "renderer/flight.h"
#include "renderer/surroundings.h"

namespace mms::renderer {

struct PixelSample {
  int x = 0, y = 0, sample = 0;
};

class Integrator {
 public:
  explicit Integrator(const World& world);

  /// Estimates the picture at a point of each sample's pixel, all of the pixel with equal density.
  /// A sample's value does not depend on the company it is traced in.
  void trace(std::span<const PixelSample> samples, std::span<FilmSample> stream);

  const Scripts& scripts() const { return scripts_; }
  /// Looks at what scripts say from now on: `Scripts::not_finite`.
  void watch_scripts() { scripts_.watch(); }
  const FlightCounters& counters() const { return flights_.counters(); }

  /// How much a descriptor's material weighs where it varies.
  struct Weighed {
    std::uint64_t points = 0, above_one = 0;
    float most = 0;

    void add(float weight) {
      ++points;
      above_one += weight > 1 + 1e-4f;  // rounding aside
      most = std::max(most, weight);
    }
    void add(const Weighed& b) {
      points += b.points, above_one += b.above_one;
      most = std::max(most, b.most);
    }
  };
  const std::map<const vm::Descriptor*, Weighed>& weighed() const { return weighed_; }

 private:
  /// Of a path that goes on by way of a ball (renderer/caustics.h): where it left the vertex
  /// before, from where light can be drawn that comes the same way.
  struct Detour {
    int ball = -1;  ///< index into World::balls; -1: on no such way
    Course course = Course::Mirrored;
    bool inside = false;  ///< has not left the ball yet
    float cosine = 0;     ///< to the normal, where it entered
    Vec3f origin;         ///< of the Flight that came to the ball
    Receives receives;    ///< likewise

    Receiver left() const { return {Vec3d(origin), receives}; }
  };
  struct Path {
    Sampler sampler;
    Cluster cluster;
    float first_part = 0;   ///< drawn with the place on the film
    Spectrumf radiance;     ///< that the path has met
    Spectrumf lit;          ///< that shadow rays have found
    Spectrumf gathered;     ///< likewise, of what volumes emit
    int asks = 0;           ///< such rays on their way: the next vertex waits for them, so that
                            ///< sums are made in one order
    float travelled = 0;    ///< m
    int depth = 0;          ///< scattering events so far
    int sample = 0;         ///< which of those to be traced
    int parent = -1;        ///< path that this one branched off, or -1
    int specular = 0;       ///< vertices so far that only mirror and bend
    bool by_image = false;  ///< was sent to where a ball shows a lamp
    Detour detour;
    std::uint32_t choices = 0;  ///< counts its numbers for which rays by a ball are sought

    Spectrumf light() const { return radiance + lit + gathered; }
  };
  /// A point of a path where it is scattered.
  struct Vertex {
    const Flight* from;
    int kind;  ///< surfaces first, then volumes: what to run
    ScriptPoint point;
    Spectrumf outside{1.0f};  ///< index of what its surface lies in
  };
  /// What scatters at a vertex: a Bsdf in its frame or a Phase in world space.
  struct Scatterer;
  struct Sampled;
  /// A flight that came to a vertex.
  struct Arrived {
    int kind;  ///< as in Vertex
    const Flight* flight;
  };
  /// How a shadow ray goes on where it leaves a ball.
  struct Beyond {
    int object;  ///< the ball
    Vec3f origin, direction;
    float distance;
  };
  /// Light drawn for a vertex of which a script is to say what it radiates.
  struct Connection {
    int flight;  ///< in shadows_
    LightSample light;
  };

  void make_room(std::size_t more);
  PathView view(Path& p) const;
  void start(const PixelSample& pixel, int sample, FilmSample& stream);
  bool go_beyond(const Flight& arrived);
  void receive(const Flight& f);
  void gather(bool more);
  bool runs(int kind) const;
  void hold_back(bool more);
  void ask_surroundings();
  void shade(std::span<const Vertex> group);
  void scatter(const Vertex& v, Scatterer&& s);  ///< which is large
  void go_all_ways(const Vertex& v, const Scatterer& s);
  void go_on(const Vertex& v, const Scatterer& s, int draws);
  void go_to_image(const Vertex& v, const Scatterer& s, int draws);
  int divide(int path);
  Flight* leave(const Vertex& v, const Scatterer& s, const Sampled& sampled, int path);
  void follow(Flight& f, const Vertex& v, Vec3d direction) const;
  void connect(const Vertex& v, const Scatterer& s, int draws);
  void connect(const Vertex& v, const Scatterer& s, const LightSample& light);
  void connect_by(int ball, const Vertex& v, const Scatterer& s, const LightSample& light);
  /// Of drawing volumes that emit, at a scattering event: later ones bring less.
  static float glow_chance(int depth) { return 1 / float(depth); }
  void connect_to_glows(const Vertex& v, const Scatterer& s);
  void start_for_light(Flight& f, Errand errand) const;
  void send_to_light(Flight& f, const Vertex& v, const Sampled& towards, const LightSample& light,
                     Vec3f origin);
  Detour next_detour(const Vertex& v, const Sampled& sampled) const;
  double light_density(const Vertex& v) const;
  double environment_density(const Flight& f, Vec3d direction) const;
  int rays_out(int path, Vec3d to) const;
  void leave_first(Flight& f, int ball, Vec3f origin, Vec3f exit);
  void ask_balls(std::size_t first);
  /// Of `optics_`, and times their size of `ball_params_`.
  std::size_t at_ball(int path, int ball) const {
    return std::size_t(paths_[path].sample) * world_.balls.size() + std::size_t(ball);
  }
  BallWay way(int path, const Detour& d) const {
    return {d.course, optics_[at_ball(path, d.ball)].index, d.cosine};
  }
  void ask_emitters();
  void send_shadow_rays();
  bool survives(Carried& c, int depth, float u) const;
  void add_emission(const Vertex& v, const Spectrumf& emitted);

  const World& world_;
  Scripts scripts_;
  Flights flights_;
  Surroundings surroundings_;
  const int directions_of_first_;  ///< in which a path goes on from its first vertex
  std::vector<Path> paths_;
  std::vector<PathView> views_;
  std::vector<Flight> now_, next_, shadows_;
  std::vector<Arrived> arrived_, kept_;
  std::vector<Vertex> vertices_;
  std::vector<Connection> connections_;
  std::vector<Beyond> beyond_;
  std::vector<int> free_beyond_;
  std::vector<Surroundings::Place> places_;
  std::vector<ScriptPoint> light_points_;
  std::vector<const ScriptPoint*> lanes_;
  std::vector<float> params_, scratch_;
  std::map<const vm::Descriptor*, Weighed> weighed_;
  materials::Bsdf<float>::Choice choice_;  ///< of the vertex that is being shaded
  std::vector<BallOptics> optics_;         ///< of each sample's wavelengths, ball after ball
  std::vector<float> ball_params_;         ///< what the balls scatter by, likewise
};

}  // namespace mms::renderer
