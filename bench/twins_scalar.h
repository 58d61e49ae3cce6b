// SPDX-License-Identifier: Apache-2.0
// No include guard: included once by each twins_<compiler>.cpp.

/// \file
/// The shaders as plain scalar C++, over float (the twins that are timed) and double (the oracles).
/// Written the way one writes for speed: shared subexpressions named, branches where they save
/// work, hashes shared between corners. The noise is that of the library: same hash, same vectors,
/// same fade.

#include <cmath>
#include <cstdint>

#include "bench/twins.h"

namespace mms::bench {
namespace {

using Bits = std::uint32_t;

template <class R>
struct Vec {
  R x, y, z;
};
template <class R>
Vec<R> operator*(R s, Vec<R> v) {
  return {s * v.x, s * v.y, s * v.z};
}
template <class R>
Vec<R> position(const Point<R>& p) {
  return {p.position[0], p.position[1], p.position[2]};
}
template <class R>
R dot(const R (&a)[3], const R (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class R>
R mix(R a, R b, R t) {
  return a + (b - a) * t;
}
template <class R>
R smoothstep(R a, R b, R x) {
  R t = (x - a) / (b - a);
  t = t < 0 ? R(0) : t > 1 ? R(1) : t;
  return t * t * (3 - 2 * t);
}

// Noise of the library

inline Bits take(Bits h, Bits i) {
  h = (h ^ i) * 0x9e3779b1u;
  return h ^ h >> 15;
}
inline Bits finish(Bits h) {
  h *= 0x85ebca77u;
  return h ^ h >> 16;
}
constexpr Bits kSeed = 0x6d6d7331u;

/// The corner's vector, a midpoint of a cube's edge. Without branches: its bits are random.
inline Vec<float> vector(Bits h, float) {
  h = finish(h);
  const Bits zero = (h & 0x0fffffffu) * 3 >> 28;
  const auto part = [](Bits sign, bool none) {
    return __builtin_bit_cast(float, (0x3f800000u | (sign & 0x80000000u)) & (Bits(none) - 1));
  };
  return {part(h, zero == 0), part(h << 1, zero == 1), part(h << 2, zero == 2)};
}
inline Vec<double> vector(Bits h, double) {
  const Vec<float> v = vector(h, 0.0f);
  return {v.x, v.y, v.z};
}
template <class R>
R slope(Bits h, R x, R y, R z) {
  const Vec<R> g = vector(h, R());
  return g.x * x + g.y * y + g.z * z;
}
template <class R>
R fade(R t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

template <class R>
R perlin(Vec<R> p) {
  const R fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const Bits i = Bits(int(fx)), j = Bits(int(fy)), k = Bits(int(fz));
  const R x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const R u = fade(x), v = fade(y), w = fade(z);
  const auto line = [=](Bits h, R dx, R dy) {
    return mix(slope(take(h, k), dx, dy, z), slope(take(h, k + 1), dx, dy, z - 1), w);
  };
  const auto plane = [=](Bits h, R dx) {
    return mix(line(take(h, j), dx, y), line(take(h, j + 1), dx, y - 1), v);
  };
  return R(0.964919) * mix(plane(take(kSeed, i), x), plane(take(kSeed, i + 1), x - 1), u);
}
template <class R>
R fbm(Vec<R> p, int octaves) {
  R total = 0, amplitude = 1;
  for (; octaves > 0; --octaves) {
    total += amplitude * perlin(p);
    p = R(2) * p;
    amplitude *= R(0.5);
  }
  return total;
}

template <class R>
Vec<R> mix(Vec<R> a, Vec<R> b, R t) {
  return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}
/// Gradient of the noise.
template <class R>
Vec<R> perlin_gradient(Vec<R> p) {
  const R fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const Bits i = Bits(int(fx)), j = Bits(int(fy)), k = Bits(int(fz));
  const R x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const R u = fade(x), v = fade(y), w = fade(z);
  const auto slope_of = [](R t) { return 30 * t * t * (t * (t - 2) + 1); };
  R plane[2];
  Vec<R> plane_g[2];
  for (int a = 0; a < 2; ++a) {
    const Bits ha = take(kSeed, i + a);
    R line[2];
    Vec<R> line_g[2];
    for (int b = 0; b < 2; ++b) {
      const Bits hb = take(ha, j + b);
      const Vec<R> g0 = vector(take(hb, k), R()), g1 = vector(take(hb, k + 1), R());
      const R n0 = g0.x * (x - R(a)) + g0.y * (y - R(b)) + g0.z * z;
      const R n1 = g1.x * (x - R(a)) + g1.y * (y - R(b)) + g1.z * (z - 1);
      line[b] = mix(n0, n1, w);
      line_g[b] = mix(g0, g1, w);
      line_g[b].z += slope_of(z) * (n1 - n0);
    }
    plane[a] = mix(line[0], line[1], v);
    plane_g[a] = mix(line_g[0], line_g[1], v);
    plane_g[a].y += slope_of(y) * (line[1] - line[0]);
  }
  Vec<R> g = mix(plane_g[0], plane_g[1], u);
  g.x += slope_of(x) * (plane[1] - plane[0]);
  return R(0.964919) * g;
}

template <class R>
R nearest_point(Vec<R> p) {
  const R fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const Bits i = Bits(int(fx)), j = Bits(int(fy)), k = Bits(int(fz));
  const R x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const auto unit = [](Bits h) { return R(int(h >> 8)) * R(0x1p-24); };
  const auto next = [](Bits h) {
    h *= 0xc2b2ae3du;
    return h ^ h >> 15;
  };
  R best = 1e30f;
  for (int a = -1; a <= 1; ++a) {
    const Bits ha = take(kSeed, i + a);
    for (int b = -1; b <= 1; ++b) {
      const Bits hb = take(ha, j + b);
      for (int c = -1; c <= 1; ++c) {
        const Bits h0 = finish(take(hb, k + c)), h1 = next(h0), h2 = next(h1);
        const R dx = x - R(a) - unit(h0), dy = y - R(b) - unit(h1), dz = z - R(c) - unit(h2);
        const R d = dx * dx + dy * dy + dz * dz;
        if (d < best) best = d;
      }
    }
  }
  return std::sqrt(best);
}

// Noise of marble_in_script.mms

inline Bits scramble(Bits i, Bits j, Bits k) {
  const Bits h = i * 73856093u + j * 19349663u + k * 83492791u;
  return h * (h * h * 15731u + 789221u) + 1376312589u;
}
template <class R>
R corner(Bits h, R x, R y, R z) {
  const Bits i = h * 1664525u + 1013904223u, j = i * 1664525u + 1013904223u;
  return R(4.656612873077393e-10) *
         (R(std::int32_t(h)) * x + R(std::int32_t(i)) * y + R(std::int32_t(j)) * z);
}
template <class R>
R slopes(Vec<R> p) {
  const R fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const Bits i = Bits(int(fx)), j = Bits(int(fy)), k = Bits(int(fz));
  const R x = p.x - fx, y = p.y - fy, z = p.z - fz;
  const R u = fade(x), v = fade(y), w = fade(z);
  R plane[2];
  for (int c = 0; c < 2; ++c) {
    R line[2];
    for (int b = 0; b < 2; ++b)
      line[b] = mix(corner(scramble(i, j + b, k + c), x, y - R(b), z - R(c)),
                    corner(scramble(i + 1, j + b, k + c), x - 1, y - R(b), z - R(c)), u);
    plane[c] = mix(line[0], line[1], v);
  }
  return mix(plane[0], plane[1], w);
}

// Shaders

template <class R>
void constant(const Point<R>&, R* out) {
  *out = R(0.75);
}

template <class R>
void gradient(const Point<R>& p, R* out) {
  const R u = p.uv[0], v = p.uv[1];
  const R near = R(0.1) + R(0.8) * u, far = R(0.9) - R(0.3) * u;
  const R t = near + (far - near) * v;
  *out = t * (R(1.5) - R(0.5) * t) + R(0.25) * u * v;
}

template <class R>
void checker(const Point<R>& p, R* out) {
  const R u = p.uv[0], v = p.uv[1];
  const int odd = (int(std::floor(8 * u)) + int(std::floor(8 * v))) & 1;
  *out = odd == 0 ? R(0.9) - R(0.2) * u : R(0.1) + R(0.2) * v;
}

template <class R>
void noise(const Point<R>& p, R* out) {
  *out = perlin(R(4) * position(p));
}

template <class R>
void marble(const Point<R>& p, R* out) {
  *out = R(0.5) + R(0.5) * std::sin(3 * p.position[0] + 4 * fbm(R(2) * position(p), 6));
}

template <class R>
void marble_in_script(const Point<R>& p, R* out) {
  Vec<R> q = R(2) * position(p);
  R total = 0, amplitude = 1;
  for (int left = 6; left > 0; --left) {
    total += amplitude * slopes(q);
    q = R(2) * q;
    amplitude *= R(0.5);
  }
  *out = R(0.5) + R(0.5) * std::sin(3 * p.position[0] + 4 * total);
}

template <class R>
void worley(const Point<R>& p, R* out) {
  *out = nearest_point(R(4) * position(p));
}

template <class R>
void mandelbrot(const Point<R>& p, R* out) {
  const R a = 3 * p.uv[0] - R(2.2), b = R(2.6) * p.uv[1] - R(1.3);
  R x = 0, y = 0;
  int n = 0;
  for (; n < 128; ++n) {
    const R xx = x * x, yy = y * y;
    if (xx + yy > 4) break;
    y = 2 * x * y + b;
    x = xx - yy + a;
  }
  *out = R(n) / 128;
}

template <class R>
void spectral(const Point<R>& p, R* out) {
  const R t = p.uv[0], depth = 2 * p.uv[1];
  // Mixing weights commute with the basis: three scalars a point rather than two spectra.
  const R r = mix(R(0.9), R(0.1), t), g = mix(R(0.6), R(0.3), t), b = mix(R(0.3), R(0.7), t);
  for (int k = 0; k < 8; ++k) {
    const R colour = b + (r - b) * p.red[k] + (g - b) * p.green[k];
    const R absorbed = R(1.4) + R(0.2 - 1.4) * p.red[k] + R(0.9 - 1.4) * p.green[k];
    out[k] = colour * std::exp(-depth * absorbed);
  }
}

template <class R>
R fresnel(R cosine, R ior) {
  const R c = cosine < 0 ? -cosine : cosine > 1 ? R(1) : cosine;
  const R t2 = 1 - (1 - c * c) / (ior * ior);
  if (t2 <= 0) return 1;
  const R t = std::sqrt(t2);
  const R s = (c - ior * t) / (c + ior * t), q = (ior * c - t) / (ior * c + t);
  return R(0.5) * (s * s + q * q);
}

template <class R>
void layered(const Point<R>& p, R* out) {
  const R rusty = smoothstep(R(-0.2), R(0.3), fbm(R(3) * position(p), 4));
  const R mirror = fresnel(dot(p.normal, p.view), R(1.5));
  const R r = mix(R(0.1), R(0.4), rusty), g = mix(R(0.3), R(0.15), rusty);
  const R b = mix(R(0.6), R(0.05), rusty);
  for (int k = 0; k < 8; ++k)
    out[k] = mix(b + (r - b) * p.red[k] + (g - b) * p.green[k], R(0.95), mirror);
}

template <class R>
void bump(const Point<R>& p, R* out) {
  Vec<R> q = R(6) * position(p);
  R along[3] = {0, 0, 0};
  for (int octave = 0; octave < 4; ++octave) {  // half the height at twice the frequency
    const Vec<R> g = perlin_gradient(q);
    along[0] += g.x;
    along[1] += g.y;
    along[2] += g.z;
    q = R(2) * q;
  }
  out[0] = R(0.06) * dot(along, p.tangent);
  out[1] = R(0.06) * dot(along, p.bitangent);
}

template <class R>
void wood(const Point<R>& point, R* out) {
  const Vec<R> p = position(point), d = R(2) * p;
  const R move = R(17.5);
  const Vec<R> q = {p.x + R(0.3) * perlin(d),
                    p.y + R(0.3) * perlin(Vec<R>{d.x + move, d.y + move, d.z + move}), p.z};
  const R radius = std::sqrt(q.x * q.x + q.y * q.y);
  const R x = 9 * radius + R(0.4) * fbm(R(3) * q, 3), ring = x - std::floor(x);
  *out = mix(R(0.25), R(0.75),
             smoothstep(R(0.3), R(0.9), ring) * (1 - smoothstep(R(0.92), R(1), ring)));
}

}  // namespace

#define MMS_TWINS(R)                                                                         \
  {"constant", constant<R>}, {"gradient", gradient<R>}, {"checker", checker<R>},             \
      {"noise", noise<R>}, {"marble", marble<R>}, {"marble_in_script", marble_in_script<R>}, \
      {"worley", worley<R>}, {"mandelbrot", mandelbrot<R>}, {"spectral", spectral<R>},       \
      {"layered", layered<R>}, {"bump", bump<R>}, {"wood", wood<R>}, {                       \
    nullptr, nullptr                                                                         \
  }

}  // namespace mms::bench
