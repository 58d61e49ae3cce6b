// SPDX-License-Identifier: Apache-2.0
#include "renderer/caustics.h"

#include <cmath>
#include <optional>

#include "materials/bsdf.h"
#include "renderer/vertex.h"
#include "renderer/world.h"

namespace mms::renderer {
namespace {

constexpr double kTurn = 2 * kPi<double>, kQuarter = kPi<double> / 2;

/// More are left to chance: each takes its time for every light that is drawn.
constexpr std::size_t kMostBalls = 4;

/// Endless, in radii: a ray is then off by as little as a double is.
constexpr double kFar = 1e8;

/// Below this index hardly anything is bent.
constexpr float kLeastIndex = 1.01f;

double cosine_of(double sine) { return std::sqrt(std::max(0.0, (1 - sine) * (1 + sine))); }

/// Whether object `i` holds a volume that nothing else reaches into, and no light straight.
bool alone(const SceneData& scene, const Compiled& compiled, int i) {
  const Bounds box = bounds(scene.objects[i].shape);
  for (int k = 0; k < int(scene.objects.size()); ++k) {
    const Object& other = scene.objects[k];
    if (k != i && (tracked(other) || semi_transparent(scene, compiled, other)) &&
        overlap(box, bounds(other.shape)))
      return false;
  }
  return sealed(scene, compiled, i);
}

/// How far rays turn about the centre between their ends, over theta.
struct Turn {
  double base, turns;
  double from, from_weight;  ///< of asin(from sin(theta)), as it is taken away
  double to;                 ///< likewise
  double dense, dense_weight;

  static Turn of(const PolishedBall& ball, Course course, double index, double from, double to) {
    const double k = ball.radius / from, b = ball.radius / to, dense = 1 / index;
    switch (course) {
      case Course::Mirrored:
        return {0, 2, k, 1, b, 0, 0};
      case Course::Through:
        return {kPi<double>, 2, k, 1, b, dense, 2};
      case Course::Out:
        return {0, 1, k * dense, -1, b, dense, 1};
      case Course::OutPast:
        break;
    }
    return {kPi<double>, 1, k * dense, 1, b, dense, 1};
  }

  double angle(double theta, double s) const {
    return base + turns * theta - from_weight * std::asin(std::min(1.0, from * s)) -
           std::asin(to * s) - dense_weight * std::asin(dense * s);
  }
  /// Its derivative, of the sine and cosine of theta.
  double slope(double s, double c) const {
    const auto part = [&](double k) { return k * c / cosine_of(k * s); };
    return turns - from_weight * part(from) - part(to) - dense_weight * part(dense);
  }

  double last() const { return angle(kQuarter, 1); }
  /// None is less, where it is convex: where the tangents at both ends of [0, pi / 2] meet.
  double least() const {
    const double fall = std::max(0.0, -slope(0, 1));
    return base - fall * std::max(0.0, base - last() + turns * kQuarter) / (turns + fall);
  }

  /// Where it is `target`, by Newton's method from an end of the interval where it is more: being
  /// convex, it is never passed but where there is no such place.
  std::optional<double> solve(double target, double end) const {
    const double side = end > 0 ? 1 : -1;
    double theta = end;
    for (int i = 0; i < 32; ++i) {
      const double s = std::sin(theta), rise = slope(s, std::cos(theta));
      if (!(rise * side > 0)) return {};
      const double step = (angle(theta, s) - target) / rise;
      theta -= step;
      if (!(theta > 0 && theta < kQuarter)) return {};
      if (std::abs(step) < 1e-7) return theta;
    }
    return {};
  }

  /// The same between 0 and `end`, over which it grows, or falls, from one side of `target` to the
  /// other.
  double solve_within(double target, double end) const {
    const bool grows = angle(end, std::sin(end)) > base;
    double low = 0, high = end, theta = end / 2;
    for (int i = 0; i < 64; ++i) {
      const double s = std::sin(theta), over = angle(theta, s) - target;
      ((over > 0) == grows ? high : low) = theta;
      const double newton = theta - over / slope(s, std::cos(theta));
      const double next = newton > low && newton < high ? newton : (low + high) / 2;
      if (std::abs(next - theta) < 1e-10) return next;
      theta = next;
    }
    return theta;
  }
};

}  // namespace

BallOptics::BallOptics(const materials::Layout& layout, const float* params) {
  if (!materials::Bsdf<float>(layout, params).specular_only()) return;
  mirrors = layout.reflects();
  if (layout.transmits()) index = params[0] > kLeastIndex ? params[0] : 0;
}

BallShare share_of(const PolishedBall& ball, const float* params, const BallOptics& optics,
                   const BallRay& ray) {
  const bool mirrored = ray.course == Course::Mirrored, through = ray.course == Course::Through;
  const double sine = cosine_of(ray.cosine), inside = sine / double(optics.index);
  const Vec3f view = mirrored || through ? Vec3f{float(sine), 0, float(ray.cosine)}
                                         : Vec3f{float(inside), 0, -float(cosine_of(inside))};
  // What narrows radiance on the way in widens it on the way out.
  const auto mode = through ? materials::Mode::Importance : materials::Mode::Radiance;
  const auto s = materials::Bsdf<float>(*ball.layout, params)
                     .sample(view, mirrored ? 0 : kLastWay, 0, 0, mode);
  if (!s || s->transmitted == mirrored) return {};
  const Spectrumf once = s->f * std::abs(s->wi.z);
  return {through ? once * once : once, possible(s->pdf)};
}

int rays_by(const PolishedBall& ball, const BallOptics& optics, Vec3d from, Vec3d to,
            std::span<BallRay, kMostBallRays> rays) {
  const Vec3d a = from - ball.centre, b = to - ball.centre;
  const double da = length(a), db = length(b);
  if (!(da > 0) || !(db > ball.radius * (1 + 1e-9))) return 0;
  if (std::abs(da - ball.radius) < 1e-9 * ball.radius) return 0;
  const Vec3d axis = a / da;
  const double along = dot(b, axis);
  const Vec3d rest = b - axis * along;
  const double off = length(rest);
  if (!(off > 1e-12 * db)) return 0;  // all round the axis, if at all
  const double between = std::atan2(off, along);

  int count = 0;
  // `target` is more than a half turn for a ray on the other side of the centre.
  const auto add = [&](Course course, const Turn& turn, std::optional<double> theta,
                       double target) {
    if (!theta) return;
    const double s = std::sin(*theta), side = target > kPi<double> ? -1 : 1;
    const auto at = [&](double angle) {
      return ball.centre +
             (axis * std::cos(angle) + rest * (side / off * std::sin(angle))) * ball.radius;
    };
    const Vec3d exit = at(target - *theta + std::asin(turn.to * s));
    const bool through = course == Course::Through;
    rays[count++] = {course, std::cos(*theta),
                     through ? at(*theta - std::asin(turn.from * s)) : exit, exit};
  };
  const auto turn = [&](Course course) { return Turn::of(ball, course, optics.index, da, db); };
  const auto add_convex = [&](Course course, const Turn& t) {
    const double last = t.last(), other = kTurn - between;
    if (between > t.least()) {
      add(course, t, t.solve(between, 0), between);
      if (between < last) add(course, t, t.solve(between, kQuarter), between);
    }
    if (other < last) add(course, t, t.solve(other, kQuarter), other);
  };

  if (da > ball.radius) {
    if (optics.mirrors)
      if (const Turn t = turn(Course::Mirrored); between < t.last())
        add(Course::Mirrored, t, t.solve(between, kQuarter), between);
    if (optics.index > 0) add_convex(Course::Through, turn(Course::Through));
    return count;
  }
  if (!(optics.index > 0)) return 0;
  const Turn out = turn(Course::Out), past = turn(Course::OutPast);
  const bool convex = past.from < 1;
  const double end = convex ? kQuarter : std::asin(1 / past.from);
  const bool outwards = between < out.angle(end, std::sin(end));
  if (outwards) add(Course::Out, out, out.solve_within(between, end), between);
  if (convex)
    add_convex(Course::OutPast, past);
  else if (!outwards)
    add(Course::OutPast, past, past.solve_within(between, end), between);
  return count;
}

double mirror_share(const PolishedBall& ball, Vec3d from) {
  const Vec3d a = from - ball.centre;
  const double much = ball.layout->transmits() ? 0.5 : 2;
  return std::min(1.0, much * ball.radius * ball.radius / dot(a, a));
}

double spread_by(const PolishedBall& ball, const BallWay& way, Vec3d from, Vec3d to) {
  const Vec3d a = from - ball.centre, b = to - ball.centre;
  const double da = length(a), db = length(b), sine = cosine_of(way.cosine);
  const Turn turn = Turn::of(ball, way.course, way.index, da, db);
  const double down = length(cross(a, b)) * db * cosine_of(turn.from * sine) *
                      cosine_of(turn.to * sine) * std::abs(turn.slope(sine, way.cosine));
  return down > 0 ? turn.from * turn.from * sine * way.cosine * da / down : 0;
}

double density_by(const PolishedBall& ball, const BallWay& way, Vec3d from, const SurfacePoint& to,
                  double straight, Vec3d back) {
  const Vec3d line = from - to.position;
  const double d2 = dot(line, line);
  const double shown =
      std::abs(dot(to.geometric_normal, back)) * spread_by(ball, way, from, to.position);
  if (!(shown > 0)) return 0;
  if (way.course == Course::Mirrored) straight *= mirror_share(ball, from);
  return straight * std::abs(dot(to.geometric_normal, line)) / (d2 * std::sqrt(d2)) / shown;
}

Vec3d far_point(const PolishedBall& ball, Vec3d direction) {
  return ball.centre + direction * (kFar * ball.radius);
}

double far_density_by(const PolishedBall& ball, const BallWay& way, Vec3d from, Vec3d direction,
                      double straight) {
  const double spread = spread_by(ball, way, from, far_point(ball, direction));
  const double far = kFar * ball.radius;
  if (way.course == Course::Mirrored) straight *= mirror_share(ball, from);
  return spread > 0 ? straight / (spread * far * far) : 0;
}

std::vector<float> ball_params(const SceneData& scene, const Compiled& compiled, int i) {
  const Object& o = scene.objects[i];
  const vm::Descriptor* d = scene.surfaces[o.surface].script;
  if (!std::holds_alternative<Sphere>(o.shape) || !d) return {};
  const CompiledDescriptor& c = compiled.of(d);
  if (!c.placeless_material || c.bumps) return {};
  const Cluster cluster = sample_cluster(0.5);
  Scripts scripts(compiled);
  ScriptPoint point;
  point.object = &o;
  point.cluster = &cluster;
  const ScriptPoint* const lane = &point;
  scripts.run(*d, EntryKind::Shade, {&lane, 1});
  if (scripts.given_up(0)) return {};
  std::vector<float> params(std::size_t(c.material.param_count()));
  scripts.params(d->shade.material, 0, params.data());
  return params;
}

std::vector<PolishedBall> polished_balls(const SceneData& scene, const Compiled& compiled,
                                         bool plain) {
  std::vector<PolishedBall> balls;
  for (int i = 0; i < int(scene.objects.size()) && balls.size() < kMostBalls; ++i) {
    const std::vector<float> params = ball_params(scene, compiled, i);
    if (params.empty()) continue;
    const Object& o = scene.objects[i];
    const materials::Layout& layout = compiled.of(scene.surfaces[o.surface].script).material;
    if (layout.nodes().size() != 1) continue;
    using materials::Lobe;
    // Of what lets light through it is known of one model how rays go, whatever its facets.
    if (layout.transmits() && layout.nodes()[0].lobe != Lobe::Dielectric &&
        layout.nodes()[0].lobe != Lobe::BeckmannDielectric)
      continue;
    if (!plain && !alone(scene, compiled, i)) continue;
    const Sphere& sphere = std::get<Sphere>(o.shape);
    if (BallOptics(layout, params.data()).any())
      balls.push_back({i, sphere.centre, sphere.radius, &layout, plain});
  }
  return balls;
}

}  // namespace mms::renderer
