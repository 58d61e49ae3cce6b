// SPDX-License-Identifier: Apache-2.0
#include "renderer/lamp_images.h"

#include <algorithm>
#include <cmath>

#include "materials/bsdf.h"

namespace mms::renderer {
namespace {

/// Wider lobes than this are found by chance.
constexpr double kWidestAlpha = 0.4;

/// A direction is always drawn where images send this part of what lamps send straight.
constexpr double kLargeShare = 0.1;

/// Grazing rays, where the lobe is nothing like its first order.
constexpr double kLeastCosine = 0.02;

/// The width of the slopes that a material scatters by, from the median of drawn ones; GGX's is
/// alpha. Endless where nothing is scattered.
double alpha_of(const materials::Bsdf<float>& bsdf) {
  constexpr int kSide = 16;
  const Vec3f wo{0.6f, 0, 0.8f};
  const auto choice = bsdf.choose(wo);
  std::vector<double> squares;
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto middle = [](int k) { return (float(k) + 0.5f) / kSide; };
    const auto part = [](float x) { return x - std::floor(x); };
    const auto s = bsdf.sample(wo, part(float(i) * std::numbers::phi_v<float>), middle(i % kSide),
                               middle(i / kSide), materials::Mode::Radiance, choice);
    if (!s) continue;
    const Vec3d h = Vec3d(s->wi + wo);
    squares.push_back((h.x * h.x + h.y * h.y) / (h.z * h.z));
  }
  if (squares.empty()) return std::numeric_limits<double>::infinity();
  const auto median = squares.begin() + std::ptrdiff_t(squares.size() / 2);
  std::nth_element(squares.begin(), median, squares.end());
  return std::sqrt(*median);
}

}  // namespace

std::vector<GlossyBall> glossy_balls(const SceneData& scene, const Compiled& compiled) {
  std::vector<GlossyBall> balls;
  for (int i = 0; i < int(scene.objects.size()) && balls.size() < LampImages::kMostBalls; ++i) {
    const std::vector<float> params = ball_params(scene, compiled, i);
    if (params.empty()) continue;
    const Object& o = scene.objects[i];
    const materials::Layout& layout = compiled.of(scene.surfaces[o.surface].script).material;
    const materials::Bsdf<float> bsdf(layout, params.data());
    if (layout.transmits() || bsdf.specular_only()) continue;
    const Sphere& sphere = std::get<Sphere>(o.shape);
    if (const double alpha = alpha_of(bsdf); alpha <= kWidestAlpha)
      balls.push_back({{i, sphere.centre, sphere.radius, &layout}, alpha});
  }
  return balls;
}

LampImages::LampImages(std::span<const GlossyBall> balls, const Lights& lights, Vec3d from,
                       Vec3d normal) {
  for (const GlossyBall& ball : balls)
    for (int i = 0; i < lights.count(); ++i) {
      const Lights::Lamp& lamp = lights.lamp(i);
      if (lamp.object == kEnvironment || lamp.object == ball.polished.object) continue;
      if (!image_of(ball, lamp, from, normal, images_[std::size_t(count_)])) continue;
      power_ += images_[std::size_t(count_++)].power;
    }
  if (!(power_ > 0)) return;
  const double straight = lights.irradiance({from, {Vec3f(normal)}});
  chance_ = std::min(1.0, power_ / (kLargeShare * straight));
}

/// False where there is none.
bool LampImages::image_of(const GlossyBall& ball, const Lights::Lamp& lamp, Vec3d from,
                          Vec3d normal, Image& image) {
  BallOptics mirror;
  mirror.mirrors = true;
  std::array<BallRay, kMostBallRays> rays;
  if (rays_by(ball.polished, mirror, from, lamp.centre, rays) < 1) return false;
  const Vec3d place = rays[0].entry, to = place - from;
  const double c = rays[0].cosine, distance = length(to);
  const double nearness = 1 / distance + 1 / length(lamp.centre - place);
  const double slope_s = c / 2 * nearness + 1 / ball.polished.radius;
  const double slope_t = nearness / (2 * c) + 1 / ball.polished.radius;
  const double solid_angle = Lights::solid_angle(lamp, place);
  const Vec3d d = to / distance;
  // Radiance D / (4 cos(theta)) of the lamp's radiance and solid angle, over the lobe.
  image.power =
      lamp.radiance * solid_angle * dot(d, normal) / (4 * slope_s * slope_t * distance * distance);
  if (!(c > kLeastCosine) || !(image.power > 0)) return false;
  // Slopes that the lamp's places differ by: twice the variance of a disc's, as alpha^2 counts.
  const double alpha2 = ball.alpha * ball.alpha, lamp2 = solid_angle / (8 * kPi<double>);
  image.width_s = std::min(1.0, std::sqrt(alpha2 + lamp2) * c / (slope_s * distance));
  image.width_t = std::min(1.0, std::sqrt(alpha2 + lamp2 / (c * c)) / (slope_t * distance));
  image.axes = Frame<double>::with_tangent(d, place - ball.polished.centre);
  return true;
}

Vec3d LampImages::sample(double u, double v) const {
  double left = u * power_;
  int i = 0;
  while (i + 1 < count_ && left >= images_[std::size_t(i)].power)
    left -= images_[std::size_t(i++)].power;
  const Image& image = images_[std::size_t(i)];
  const double x = std::clamp(left / image.power, 0.0, 1 - 0x1p-53);
  const double r = std::sqrt(x / (1 - x)), phi = 2 * kPi<double> * v;
  return normalize(image.axes.to_world(
      {r * std::cos(phi) * image.width_s, r * std::sin(phi) * image.width_t, 1}));
}

double LampImages::pdf(Vec3d direction) const {
  double sum = 0;
  for (int i = 0; i < count_; ++i) {
    const Image& image = images_[std::size_t(i)];
    const Vec3d d = image.axes.to_local(direction);
    if (!(d.z > 0)) continue;
    const double x = d.x / (d.z * image.width_s), y = d.y / (d.z * image.width_t);
    const double t = (1 + x * x + y * y) * d.z;
    sum += image.power / (kPi<double> * image.width_s * image.width_t * t * t * d.z);
  }
  return power_ > 0 ? sum / power_ : 0;
}

}  // namespace mms::renderer
