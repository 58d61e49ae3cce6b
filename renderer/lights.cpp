// SPDX-License-Identifier: Apache-2.0
#include "renderer/lights.h"

#include <algorithm>
#include <cmath>

#include "base/warp.h"
#include "renderer/latlong.h"
#include "renderer/light_places.h"

namespace mms::renderer {
namespace {

constexpr double kTwoPi = 2 * kPi<double>;

/// Share of choices that is spread evenly over all lights, for what estimates get wrong: a lamp
/// that shines backwards, a small one beside a large one.
constexpr double kEvenly = 0.1;

double luminance(const Rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

/// Index of the step of a cumulative table (from 0 to its last entry) that `u` falls in, and what
/// is left of `u` within the step, in [0, 1).
int step_of(const double* table, int n, double u, double& rest) {
  const double x = u * table[n];
  int i = int(std::upper_bound(table, table + n + 1, x) - table) - 1;
  i = std::clamp(i, 0, n - 1);
  while (i > 0 && table[i + 1] == table[i]) --i;  // a step of no width is never chosen
  const double width = table[i + 1] - table[i];
  rest = width > 0 ? std::clamp((x - table[i]) / width, 0.0, 1 - 0x1p-53) : 0;
  return i;
}

/// Half-angle terms of the cone that a sphere fills: 1 - cos, without cancellation.
double one_minus_cos_cone(const Sphere& s, Vec3d from) {
  const Vec3d to = s.centre - from;
  const double sin2 = s.radius * s.radius / dot(to, to);
  return sin2 / (1 + std::sqrt(std::max(0.0, 1 - sin2)));
}

bool outside(const Sphere& s, Vec3d from) {
  const Vec3d to = s.centre - from;
  return dot(to, to) > s.radius * s.radius * (1 + 1e-9);
}

/// Whether a point of a sphere is turned away; at the rim, where rounding decides, none is.
bool far_side(const SurfacePoint& at, Vec3d from) {
  const Vec3d to = from - at.position;
  return dot(at.geometric_normal, to) < -1e-4 * length(to);
}

/// Area density to solid-angle density.
double to_solid_angle(double pdf_area, Vec3d from, const SurfacePoint& at) {
  const Vec3d to = at.position - from;
  const double d2 = dot(to, to);
  const double cosine = std::abs(dot(to, at.geometric_normal)) / std::sqrt(d2);
  return cosine > 0 ? pdf_area * d2 / cosine : 0;
}

/// Whether light is drawn by what comes from each place on a light, of that radius. Where more than
/// the cosine matters it is not; places on a small light hardly differ; and those next to a large
/// one differ too much for what is known of a few.
bool tells_apart(const Receiver& at, double radius, Vec3d centre) {
  const Vec3d to = centre - at.position;
  const double d2 = dot(to, to), r2 = radius * radius;
  return at.even && r2 > 1e-3 * d2 && r2 < d2;
}

/// What a matte receiver gets from a place on a flat light, but for a factor that is the same for
/// all places.
double received(const Receiver& at, Vec3d place) {
  const Vec3d to = place - at.position;
  const double d2 = dot(to, to);
  return d2 > 0 ? std::max(0.0, dot(to, at.normal)) / (d2 * d2) : 0;
}

/// Density over the edges of a quad.
SquareDensity places(const Quad& q, const Receiver& from) {
  return SquareDensity(
      [&](double u, double v) { return received(from, q.corner + q.edge_u * u + q.edge_v * v); });
}

/// Density over a disc of radius 1, from its middle and four places on the circle that halves it.
DiscDensity places(const Disc& d, const Receiver& from) {
  const double r = d.radius * std::numbers::sqrt2 / 2;
  const auto at = [&](Vec3d side) { return received(from, d.centre + side * r); };
  const double right = at(d.axes.s), left = at(-d.axes.s), up = at(d.axes.t), down = at(-d.axes.t);
  const double centre = received(from, d.centre);
  return {centre, (right + left + up + down) / 2 - centre, (right - left) / std::numbers::sqrt2,
          (up - down) / std::numbers::sqrt2};
}

/// The cone that a sphere fills: directions of even solid angle are places on a disc.
struct Cone {
  Frame<double> axes;
  double one_minus_cos;
  DiscDensity density{1, 1, 0, 0};

  Cone(const Sphere& s, const Receiver& from)
      : axes(Frame<double>::around(normalize(s.centre - from.position))),
        one_minus_cos(one_minus_cos_cone(s, from.position)) {
    if (!tells_apart(from, s.radius, s.centre)) return;
    const Vec3d n = axes.to_local(from.normal);
    const double sine = std::sqrt(one_minus_cos * (2 - one_minus_cos));
    density = {std::max(0.0, n.z), std::max(0.0, n.z * (1 - one_minus_cos)), n.x * sine,
               n.y * sine};
  }

  /// A unit vector.
  Vec3d sample(double u, double v) const {
    const Place p = density.sample(u, v);
    const double c = one_minus_cos * (p.x * p.x + p.y * p.y);
    const double stretch = std::sqrt(one_minus_cos * (2 - c));
    return axes.to_world({p.x * stretch, p.y * stretch, 1 - c});
  }
  /// Per steradian.
  double pdf(Vec3d direction) const {
    const Vec3d d = axes.to_local(direction);
    const double stretch = std::sqrt(one_minus_cos * (1 + std::max(0.0, d.z)));
    return density.at(d.x / stretch, d.y / stretch) / (kTwoPi * one_minus_cos);
  }
};

/// Mean of the cosine over a light that fills a cone of sine `blur`, `cosine` in its middle, where
/// what lies below the horizon counts nothing; the cosine as if it were spread evenly.
double above_horizon(double cosine, double blur) {
  if (cosine >= blur) return cosine;
  return cosine > -blur ? (cosine + blur) * (cosine + blur) / (4 * blur) : 0;
}

/// Of a light of weight `w` among `n` whose weights have the sum `sum`.
double mixed(double w, double sum, int n) {
  return kEvenly / n + (1 - kEvenly) * (sum > 0 ? w / sum : 1.0 / n);
}

}  // namespace

TexelDensity::TexelDensity(std::vector<double> weight, int width, int height)
    : width_(width), height_(height), rows_(1, 0.0) {
  columns_.reserve(std::size_t(height) * (width + 1));
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    columns_.push_back(0);
    for (int x = 0; x < width; ++x) columns_.push_back(sum += weight[std::size_t(y) * width + x]);
    rows_.push_back(rows_.back() + sum);
  }
}

TexelDensity::Drawn TexelDensity::sample(double u, double v) const {
  double rest_x = 0, rest_y = 0;
  const int row = step_of(rows_.data(), height_, v, rest_y);
  const int column = step_of(&columns_[std::size_t(row) * (width_ + 1)], width_, u, rest_x);
  const double x = (column + rest_x) / width_, y = (row + rest_y) / height_;
  return {x, y, pdf(x, y)};
}

double TexelDensity::pdf(double x, double y) const {
  const int row = std::clamp(int(y * height_), 0, height_ - 1);
  const int column = std::clamp(int(x * width_), 0, width_ - 1);
  const double* c = &columns_[std::size_t(row) * (width_ + 1) + column];
  return (c[1] - c[0]) / rows_.back() * width_ * height_;
}

Lights::Lights(const SceneData& scene, const std::vector<double>& radiance)
    : scene_(&scene), choice_of_(scene.objects.size(), -1) {
  for (int i = 0; i < int(scene.objects.size()); ++i) {
    if (!(radiance[i] > 0)) continue;
    const Shape& shape = scene.objects[i].shape;
    const Bounds box = bounds(shape);
    Choice c{{i, radiance[i], area(shape), box.radius(), box.centre(), {}}, {}};
    if (open(shape)) c.facing = sample_surface(shape, 0.5, 0.5).normal;
    if (const Mesh* m = std::get_if<Mesh>(&shape)) {
      c.triangles.push_back(0);
      for (std::uint32_t t = 0; t < m->triangles.size(); ++t)
        c.triangles.push_back(c.triangles.back() + triangle_area(*m, t));
    }
    choice_of_[i] = int(choices_.size());
    powers_.push_back(powers_.back() + c.radiance * c.area);
    choices_.push_back(std::move(c));
  }
  // Scattering directions find an even environment better than any density of light directions
  // that knows nothing of the surface, so only a picture is sampled as a light.
  if (scene.environment.image) add_environment();
  if (choices_.size() <= kLightsWeighed) return;
  std::vector<LightExtent> extents;
  for (const Choice& c : choices_) {
    if (c.object == kEnvironment) continue;  // the last; it is chosen beside the tree
    const double seen = dot(c.facing, c.facing) > 0 ? 1 : 0.25;
    extents.push_back(
        {bounds(scene.objects[c.object].shape), c.radiance * c.area * seen, c.facing});
  }
  tree_ = LightTree(extents);
}

void Lights::add_environment() {
  const EnvironmentImage& image = *scene_->environment.image;
  const int w = image.width, h = image.height;
  const auto at = [&](int x, int y) {
    const auto& c = image.rgb[std::size_t(std::clamp(y, 0, h - 1)) * w + (x + w) % w];
    return std::max(0.0, luminance({c[0], c[1], c[2]}));
  };
  std::vector<double> weight(std::size_t(w) * h);
  double total = 0, norm = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const double sine = std::sin(kPi<double> * (y + 0.5) / h);
      double box = 0;  // texels are blended, so a texel's light reaches into its neighbours
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) box += at(x + dx, y + dy);
      weight[std::size_t(y) * w + x] = box / 9 * sine;
      total += box / 9 * sine;
      norm += sine;
    }
  const double mean = luminance(scene_->environment.radiance) * total / norm;
  if (!(mean > 0)) return;
  texels_ = TexelDensity(std::move(weight), w, h);
  environment_choice_ = int(choices_.size());
  choices_.push_back({{kEnvironment, mean, 0, 0, {}, {}}, {}});
}

/// A closed shape shows a quarter of its area, a flat one its front.
double Lights::solid_angle(const Lamp& lamp, Vec3d from) {
  const Vec3d to = lamp.centre - from;
  const double d2 = std::max(dot(to, to), 1e-12);
  const bool flat = dot(lamp.facing, lamp.facing) > 0;
  const double seen = flat ? std::max(0.0, -dot(to, lamp.facing) / std::sqrt(d2)) : 0.25;
  return std::min(kTwoPi, lamp.area * seen / d2);
}

/// Radiance times the solid angle and the receiver's cosine.
double Lights::irradiance(const Lamp& lamp, const Receiver& at) {
  if (lamp.object == kEnvironment) return lamp.radiance * kPi<double>;
  const Vec3d to = lamp.centre - at.position;
  const double nearness = 1 / std::sqrt(std::max(dot(to, to), 1e-12));
  const bool one_side = dot(at.normal, at.normal) > 0;
  const double cosine =
      one_side ? above_horizon(dot(to, at.normal) * nearness, std::min(1.0, lamp.radius * nearness))
               : 1;
  return lamp.radiance * solid_angle(lamp, at.position) * cosine;
}

double Lights::irradiance(const Receiver& at) const {
  std::array<double, kLightsWeighed> weights;
  return weigh(at, weights);
}

bool Lights::below_horizon(int choice, const Receiver& from) const {
  const Choice& c = choices_[choice];
  return c.object != kEnvironment && dot(c.centre - from.position, from.normal) < -c.radius;
}

double Lights::weigh(const Receiver& from, std::array<double, kLightsWeighed>& weights) const {
  double sum = 0;
  for (std::size_t i = 0; i < choices_.size(); ++i)
    sum += weights[i] = irradiance(choices_[i], from);
  return sum;
}

/// Probability that the environment is drawn rather than the tree.
double Lights::environment_share(Vec3d from) const {
  if (environment_choice_ < 0) return 0;
  const double sky = irradiance(choices_[environment_choice_], from);
  return sky / (sky + tree_.importance(from));
}

double Lights::probability(int i, const Receiver& from) const {
  const int n = int(choices_.size());
  if (from.draws > 0) return below_horizon(i, from) ? 0 : from.draws;
  if (n == 1) return 1;
  if (n <= kLightsWeighed) {
    std::array<double, kLightsWeighed> weights;
    const double sum = weigh(from, weights);
    return mixed(weights[i], sum, n);
  }
  const double sky = environment_share(from.position);
  return mixed(i == environment_choice_ ? sky : (1 - sky) * tree_.probability(i, from.position), 1,
               n);
}

/// Draws a light, and leaves in `u` what is not used up.
Lights::Drawn Lights::choose(const Receiver& from, double& u) const {
  const int n = int(choices_.size());
  const auto spend = [&](double low, double width) {
    u = std::clamp((u - low) / width, 0.0, 1 - 0x1p-53);
  };
  if (n == 1) return {0, 1};
  if (n <= kLightsWeighed) {
    std::array<double, kLightsWeighed> weights;
    const double sum = weigh(from, weights);
    int chosen = 0;
    double below = 0, p = mixed(weights[0], sum, n);
    while (chosen + 1 < n && u >= below + p) {
      below += p;
      p = mixed(weights[++chosen], sum, n);
    }
    spend(below, p);
    return {chosen, p};
  }
  if (u < kEvenly) {
    const int chosen = std::min(int(u / kEvenly * n), n - 1);
    spend(kEvenly * chosen / n, kEvenly / n);
    return {chosen, probability(chosen, from)};
  }
  spend(kEvenly, 1 - kEvenly);
  const double sky = environment_share(from.position);
  if (u < sky) {
    spend(0, sky);
    return {environment_choice_, mixed(sky, 1, n)};
  }
  spend(sky, 1 - sky);
  const LightTree::Drawn d = tree_.sample(from.position, u);
  u = d.rest;
  return {d.light, mixed((1 - sky) * d.probability, 1, n)};
}

/// A point of a light's surface, all of its area alike.
SurfacePoint Lights::place(const Choice& c, double u, double v) const {
  const Shape& shape = scene_->objects[c.object].shape;
  const Mesh* m = std::get_if<Mesh>(&shape);
  if (!m) return sample_place(shape, u, v);
  double rest = 0;
  const int t = step_of(c.triangles.data(), int(m->triangles.size()), u, rest);
  const double r = std::sqrt(rest);
  SurfacePoint at = surface_at(*m, std::uint32_t(t), r * (1 - v), r * v);
  at.error += scene_->objects[c.object].slack;
  return at;
}

EmissionPoint Lights::sample_point(double u, double v) const {
  double rest = 0;
  const Choice& c = choices_[step_of(powers_.data(), int(powers_.size()) - 1, u, rest)];
  const SurfacePoint at = place(c, rest, v);
  return {c.object, complete(scene_->objects[c.object].shape, at), pdf_point(c.object)};
}

double Lights::pdf_point(int object) const {
  return choice_of_[object] < 0 ? 0 : choices_[choice_of_[object]].radiance / powers_.back();
}

LightSample Lights::sample(const Receiver& from, double u, double v) const {
  const Drawn drawn = choose(from, u);
  LightSample s = sample_one(drawn.choice, from, u, v);
  s.pdf *= drawn.probability;
  return s;
}

LightSample Lights::sample_one(int choice, const Receiver& from, double u, double v) const {
  const Choice& c = choices_[choice];
  LightSample s;
  s.object = c.object;
  if (c.object == kEnvironment) {
    const TexelDensity::Drawn d = texels_.sample(u, v);
    s.direction = latlong_direction(d.x, d.y, scene_->environment.rotation);
    s.pdf = density_environment(s.direction);
    return s;
  }
  const Shape& shape = scene_->objects[c.object].shape;
  const Sphere* sphere = std::get_if<Sphere>(&shape);
  if (sphere && outside(*sphere, from.position)) {
    const Cone cone(*sphere, from);
    const Vec3d d = cone.sample(u, v);
    const Roots r = intersect(*sphere, from.position, d, 0, 1e300);
    // At the rim rounding may miss the sphere: its point nearest to the ray.
    s.surface =
        place_at(*sphere, from.position +
                              d * (r.count > 0 ? r.t[0] : dot(sphere->centre - from.position, d)));
    s.direction = normalize(s.surface.position - from.position);
    s.pdf = far_side(s.surface, from.position) ? 0 : cone.pdf(s.direction);
    return s;
  }
  double relative = 1;
  const bool apart = tells_apart(from, c.radius, c.centre);
  if (const Quad* q = std::get_if<Quad>(&shape); q && apart) {
    const SquareDensity p = places(*q, from);
    const auto [x, y] = p.sample(u, v);
    s.surface = place_at(*q, q->corner + q->edge_u * x + q->edge_v * y);
    relative = p.at(x, y);
  } else if (const Disc* d = std::get_if<Disc>(&shape); d && apart) {
    const DiscDensity p = places(*d, from);
    const auto [x, y] = p.sample(u, v);
    s.surface = place_at(*d, d->centre + (d->axes.s * x + d->axes.t * y) * d->radius);
    relative = p.at(x, y);
  } else {
    s.surface = place(c, u, v);
  }
  const Vec3d to = s.surface.position - from.position;
  if (!(dot(to, to) > 0)) return s;
  s.direction = normalize(to);
  s.pdf = to_solid_angle(relative / c.area, from.position, s.surface);
  return s;
}

/// Per steradian, the light being chosen.
double Lights::density(const Choice& c, const Receiver& from, const SurfacePoint& at) const {
  const Shape& shape = scene_->objects[c.object].shape;
  if (const Sphere* s = std::get_if<Sphere>(&shape); s && outside(*s, from.position))
    return far_side(at, from.position) ? 0
                                       : Cone(*s, from).pdf(normalize(at.position - from.position));
  double relative = 1;
  const bool apart = tells_apart(from, c.radius, c.centre);
  if (const Quad* q = std::get_if<Quad>(&shape); q && apart) {
    const auto [x, y] = along_edges(*q, at.position - q->corner);
    relative = places(*q, from).at(x, y);
  } else if (const Disc* d = std::get_if<Disc>(&shape); d && apart) {
    const Vec3d l = d->axes.to_local(at.position - d->centre) / d->radius;
    relative = places(*d, from).at(l.x, l.y);
  }
  return to_solid_angle(relative / c.area, from.position, at);
}

double Lights::pdf(const Receiver& from, int object, const SurfacePoint& at) const {
  const int i = choice_of_[object];
  return i < 0 ? 0 : probability(i, from) * density(choices_[i], from, at);
}

/// Per steradian, the environment being chosen.
double Lights::density_environment(Vec3d direction) const {
  const auto [x, y] = latlong_of(direction, scene_->environment.rotation);
  const double sine = std::sqrt(std::max(0.0, 1 - direction.y * direction.y));
  return sine > 0 ? texels_.pdf(x, y) / (kTwoPi * kPi<double> * sine) : 0;
}

double Lights::pdf_environment(const Receiver& from, Vec3d direction) const {
  if (environment_choice_ < 0) return 0;
  return probability(environment_choice_, from) * density_environment(direction);
}

Rgb Lights::texel(double x, double y) const {
  const EnvironmentImage& im = *scene_->environment.image;
  const double fx = x * im.width - 0.5, fy = y * im.height - 0.5;
  const int x0 = int(std::floor(fx)), y0 = int(std::floor(fy));
  Rgb sum{0, 0, 0};
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double w = (dx ? fx - x0 : 1 - fx + x0) * (dy ? fy - y0 : 1 - fy + y0);
      const auto& t = im.rgb[std::size_t(std::clamp(y0 + dy, 0, im.height - 1)) * im.width +
                             (x0 + dx + im.width) % im.width];
      for (int k = 0; k < 3; ++k) sum[k] += w * t[k];
    }
  return sum;
}

Spectrumf Lights::environment(Vec3d direction, const Cluster& cluster) const {
  const Environment& e = scene_->environment;
  if (!e.image) return cluster.light(e.radiance);
  const auto [x, y] = latlong_of(direction, e.rotation);
  Rgb c = texel(x, y);
  for (int k = 0; k < 3; ++k) c[k] *= e.radiance[k];
  return cluster.light(c);
}

}  // namespace mms::renderer
