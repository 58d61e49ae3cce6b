// SPDX-License-Identifier: Apache-2.0
#include "renderer/caustics.h"

#include <cmath>
#include <optional>

#include "materials/dielectric.h"

namespace mms::renderer {
namespace {

constexpr double kTurn = 2 * kPi<double>, kQuarter = kPi<double> / 2;

/// More are left to chance: each takes its time for every light that is drawn.
constexpr std::size_t kMostBalls = 4;

/// Below this index hardly anything is bent.
constexpr float kLeastIndex = 1.01f;

/// How far rays turn about the centre between their ends.
struct Turn {
  double from, to;  ///< radius over the distances of the ends
  double dense;     ///< 1 / index

  double angle(double theta, double s) const {
    return kPi<double> + 2 * theta - std::asin(from * s) - std::asin(to * s) -
           2 * std::asin(dense * s);
  }
  /// Its derivative, of the sine and cosine of theta.
  double slope(double s, double c) const {
    const auto part = [&](double k) { return k * c / cosine(k * s); };
    return 2 - part(from) - part(to) - 2 * part(dense);
  }
  static double cosine(double sine) { return std::sqrt((1 - sine) * (1 + sine)); }

  /// No turn is less: where the tangents at both ends of [0, pi / 2] meet.
  double least(double last) const {
    const double fall = std::max(0.0, from + to + 2 * dense - 2);
    return kPi<double> - fall * std::max(0.0, kTurn - last) / (2 + fall);
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

BallGlass::BallGlass(const float* params) {
  const materials::Dielectric<float> glass(params);
  if (!glass.specular() || !(glass.ior[0] > kLeastIndex)) return;
  index = glass.ior[0];
  for (int k = 0; k < kWavelengths; ++k)
    transmitted[k] = glass.ior[k] == index ? glass.transmitted[k] : 0;
}

Spectrumf BallGlass::carried(double cosine) const {
  const Spectrumf once = transmitted * materials::fresnel_split(float(cosine), index).transmitted;
  return once * once;
}

int rays_through(const ClearBall& ball, double index, Vec3d from, Vec3d to,
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
  const Turn turn{ball.radius / da, ball.radius / db, 1 / index};
  const double last = kTurn - std::asin(turn.from) - std::asin(turn.to) - 2 * std::asin(turn.dense);

  int count = 0;
  // `side`: of the plane, as seen along the axis; the other one is across it.
  const auto add = [&](std::optional<double> theta, double side) {
    if (!theta) return;
    const double s = std::sin(*theta), first = *theta - std::asin(turn.from * s);
    const double second = first + kPi<double> - 2 * std::asin(turn.dense * s);
    const auto at = [&](double angle) {
      return ball.centre +
             (axis * std::cos(angle) + rest * (side / off * std::sin(angle))) * ball.radius;
    };
    rays[count++] = {std::cos(*theta), at(first), at(second)};
  };
  if (between > turn.least(last)) {
    add(turn.solve(between, 0), 1);
    if (between < last) add(turn.solve(between, kQuarter), 1);
  }
  if (kTurn - between < last) add(turn.solve(kTurn - between, kQuarter), -1);
  return count;
}

double spread_through(const ClearBall& ball, double index, Vec3d from, Vec3d to, double cosine) {
  const Vec3d a = from - ball.centre, b = to - ball.centre;
  const double da = length(a), db = length(b), sine = Turn::cosine(cosine);
  const Turn turn{ball.radius / da, ball.radius / db, 1 / index};
  const double down = length(cross(a, b)) * da * db * Turn::cosine(turn.from * sine) *
                      Turn::cosine(turn.to * sine) * std::abs(turn.slope(sine, cosine));
  return down > 0 ? ball.radius * ball.radius * sine * cosine / down : 0;
}

double density_through(const ClearBall& ball, double index, Vec3d from, const SurfacePoint& to,
                       double straight, Vec3d back, double cosine) {
  const Vec3d way = from - to.position;
  const double d2 = dot(way, way), spread = spread_through(ball, index, from, to.position, cosine);
  const double shown = std::abs(dot(to.geometric_normal, back)) * spread;
  if (!(shown > 0)) return 0;
  return straight * std::abs(dot(to.geometric_normal, way)) / (d2 * std::sqrt(d2)) / shown;
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
    if (c.placeless_material && !c.bumps && nodes.size() == 1 &&
        nodes[0].lobe == materials::Lobe::Dielectric)
      balls.push_back({i, sphere->centre, sphere->radius});
  }
  return balls;
}

}  // namespace mms::renderer
