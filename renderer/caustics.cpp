// SPDX-License-Identifier: Apache-2.0
#include "renderer/caustics.h"

#include <cmath>
#include <optional>

#include "materials/bsdf.h"

namespace mms::renderer {
namespace {

constexpr double kTurn = 2 * kPi<double>, kQuarter = kPi<double> / 2;

/// More are left to chance: each takes its time for every light that is drawn.
constexpr std::size_t kMostBalls = 4;

/// Endless, in radii: a ray is then off by as little as a double is.
constexpr double kFar = 1e8;

/// Below this index hardly anything is bent.
constexpr float kLeastIndex = 1.01f;

/// How far rays turn about the centre between their ends.
struct Turn {
  double from, to;  ///< radius over the distances of the ends
  int chords;       ///< inside: 1 if it goes through
  double dense;     ///< 1 / index

  double angle(double theta, double s) const {
    return 2 * theta - std::asin(from * s) - std::asin(to * s) + inside(s);
  }
  double inside(double s) const { return chords > 0 ? kPi<double> - 2 * std::asin(dense * s) : 0; }
  /// Its derivative, of the sine and cosine of theta.
  double slope(double s, double c) const {
    const auto part = [&](double k) { return k * c / cosine(k * s); };
    return 2 - part(from) - part(to) - (chords > 0 ? 2 * part(dense) : 0);
  }
  static double cosine(double sine) { return std::sqrt((1 - sine) * (1 + sine)); }

  double last() const { return angle(kQuarter, 1); }
  /// No turn of a ray through is less: where the tangents at both ends of [0, pi / 2] meet.
  double least() const {
    const double fall = std::max(0.0, from + to + 2 * dense - 2);
    return kPi<double> - fall * std::max(0.0, kTurn - last()) / (2 + fall);
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
};

}  // namespace

BallOptics::BallOptics(const materials::Layout& layout, const float* params) {
  if (!materials::Bsdf<float>(layout, params).specular_only()) return;
  mirrors = layout.reflects();
  if (layout.transmits()) index = params[0] > kLeastIndex ? params[0] : 0;
}

BallShare share_of(const ClearBall& ball, const float* params, const BallRay& ray) {
  constexpr float kLast = 1 - 0x1p-24f;  // to let light through is the last that a lobe may do
  const Vec3f view{float(Turn::cosine(ray.cosine)), 0, float(ray.cosine)};
  const auto s = materials::Bsdf<float>(*ball.layout, params)
                     .sample(view, ray.through ? kLast : 0, 0, 0, materials::Mode::Importance);
  if (!s || s->transmitted != ray.through) return {};
  // What narrows radiance on the way in widens it on the way out.
  const Spectrumf once = s->f * std::abs(s->wi.z);
  return {ray.through ? once * once : once,
          Spectrumf::map([](float p) { return p > 0 ? 1.0f : 0.0f; }, s->pdf)};
}

int rays_by(const ClearBall& ball, const BallOptics& optics, Vec3d from, Vec3d to,
            std::span<BallRay, kMostBallRays> rays) {
  const Vec3d a = from - ball.centre, b = to - ball.centre;
  const double da = length(a), db = length(b);
  if (!(std::min(da, db) > ball.radius * (1 + 1e-9))) return 0;
  const Vec3d axis = a / da;
  const double along = dot(b, axis);
  const Vec3d rest = b - axis * along;
  const double off = length(rest);
  if (!(off > 1e-12 * db)) return 0;  // all round the axis, if at all
  const double between = std::atan2(off, along);

  int count = 0;
  // `side`: of the plane, as seen along the axis; the other one is across it.
  const auto add = [&](const Turn& turn, std::optional<double> theta, double side) {
    if (!theta) return;
    const double s = std::sin(*theta), first = *theta - std::asin(turn.from * s);
    const auto at = [&](double angle) {
      return ball.centre +
             (axis * std::cos(angle) + rest * (side / off * std::sin(angle))) * ball.radius;
    };
    rays[count++] = {turn.chords > 0, std::cos(*theta), at(first), at(first + turn.inside(s))};
  };
  Turn turn{ball.radius / da, ball.radius / db, 0, 1};
  if (optics.mirrors && between < turn.last()) add(turn, turn.solve(between, kQuarter), 1);
  if (!(optics.index > 0)) return count;
  turn.chords = 1;
  turn.dense = 1 / double(optics.index);
  const double last = turn.last();
  if (between > turn.least()) {
    add(turn, turn.solve(between, 0), 1);
    if (between < last) add(turn, turn.solve(between, kQuarter), 1);
  }
  if (kTurn - between < last) add(turn, turn.solve(kTurn - between, kQuarter), -1);
  return count;
}

double mirror_share(const ClearBall& ball, Vec3d from) {
  const Vec3d a = from - ball.centre;
  const double much = ball.layout->transmits() ? 0.5 : 2;
  return std::min(1.0, much * ball.radius * ball.radius / dot(a, a));
}

double spread_by(const ClearBall& ball, const BallWay& way, Vec3d from, Vec3d to) {
  const Vec3d a = from - ball.centre, b = to - ball.centre;
  const double da = length(a), db = length(b), sine = Turn::cosine(way.cosine);
  const Turn turn{ball.radius / da, ball.radius / db, int(way.through), 1 / way.index};
  const double down = length(cross(a, b)) * da * db * Turn::cosine(turn.from * sine) *
                      Turn::cosine(turn.to * sine) * std::abs(turn.slope(sine, way.cosine));
  return down > 0 ? ball.radius * ball.radius * sine * way.cosine / down : 0;
}

double density_by(const ClearBall& ball, const BallWay& way, Vec3d from, const SurfacePoint& to,
                  double straight, Vec3d back) {
  const Vec3d line = from - to.position;
  const double d2 = dot(line, line);
  const double shown =
      std::abs(dot(to.geometric_normal, back)) * spread_by(ball, way, from, to.position);
  if (!(shown > 0)) return 0;
  if (!way.through) straight *= mirror_share(ball, from);
  return straight * std::abs(dot(to.geometric_normal, line)) / (d2 * std::sqrt(d2)) / shown;
}

Vec3d far_point(const ClearBall& ball, Vec3d direction) {
  return ball.centre + direction * (kFar * ball.radius);
}

double far_density_by(const ClearBall& ball, const BallWay& way, Vec3d from, Vec3d direction,
                      double straight) {
  const double spread = spread_by(ball, way, from, far_point(ball, direction));
  const double far = kFar * ball.radius;
  if (!way.through) straight *= mirror_share(ball, from);
  return spread > 0 ? straight / (spread * far * far) : 0;
}

std::vector<ClearBall> clear_balls(const SceneData& scene, const Compiled& compiled) {
  std::vector<ClearBall> balls;
  for (int i = 0; i < int(scene.objects.size()) && balls.size() < kMostBalls; ++i) {
    const Object& o = scene.objects[i];
    const Sphere* sphere = std::get_if<Sphere>(&o.shape);
    const vm::Descriptor* d = scene.surfaces[o.surface].script;
    if (!sphere || !d) continue;
    const CompiledDescriptor& c = compiled.of(d);
    const auto nodes = c.material.nodes();
    if (!c.placeless_material || c.bumps || nodes.size() != 1) continue;
    if (!c.material.has_specular()) continue;
    // Of what lets light through it is known of one how rays go.
    if (!c.material.transmits() || nodes[0].lobe == materials::Lobe::Dielectric)
      balls.push_back({i, sphere->centre, sphere->radius, &c.material});
  }
  return balls;
}

}  // namespace mms::renderer
