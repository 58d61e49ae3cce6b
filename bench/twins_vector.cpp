// SPDX-License-Identifier: Apache-2.0
// The shaders vectorised by hand: eight points at a time in AVX2 registers, no memory between
// operations, table-free noise with shared hashes. Sine and exponential come from the C library's
// vector functions (up to 4 ulp). What a batch machine is to be measured by.
#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

#include <cstdint>

#include "bench/twins.h"

extern "C" __m256 _ZGVdN8v_sinf(__m256);
extern "C" __m256 _ZGVdN8v_expf(__m256);

namespace mms::bench {
namespace {

typedef float F __attribute__((vector_size(32)));
typedef std::int32_t I __attribute__((vector_size(32)));
typedef std::uint32_t U __attribute__((vector_size(32)));

inline F all(float x) { return F(_mm256_set1_ps(x)); }
inline F load(const float* p) { return F(_mm256_loadu_ps(p)); }
inline void store(float* p, F x) { _mm256_storeu_ps(p, __m256(x)); }
inline F floor(F x) { return F(_mm256_floor_ps(__m256(x))); }
inline F root(F x) { return F(_mm256_sqrt_ps(__m256(x))); }
inline F least(F a, F b) { return F(_mm256_min_ps(__m256(a), __m256(b))); }
inline F most(F a, F b) { return F(_mm256_max_ps(__m256(a), __m256(b))); }
inline F fma(F a, F b, F c) { return F(_mm256_fmadd_ps(__m256(a), __m256(b), __m256(c))); }
inline F real(U x) { return F(_mm256_cvtepi32_ps(__m256i(x))); }
inline U whole(F x) { return U(_mm256_cvttps_epi32(__m256(x))); }
inline F bits(U x) { return F(x); }
inline U bits(F x) { return U(x); }
inline F sine(F x) { return F(_ZGVdN8v_sinf(__m256(x))); }
inline F exponential(F x) { return F(_ZGVdN8v_expf(__m256(x))); }
inline F mix(F a, F b, F t) { return fma(b - a, t, a); }
inline F smoothstep(float a, float b, F x) {
  const F t = least(most((x - a) * (1 / (b - a)), all(0)), all(1));
  return t * t * (3 - 2 * t);
}

struct Vec {
  F x, y, z;
};
inline Vec operator*(float s, Vec v) { return {s * v.x, s * v.y, s * v.z}; }
inline Vec load(const float* const (&p)[3], int i) {
  return {load(p[0] + i), load(p[1] + i), load(p[2] + i)};
}
inline F dot(Vec a, Vec b) { return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x)); }
inline Vec mix(Vec a, Vec b, F t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)}; }

inline U take(U h, U i) {
  h = (h ^ i) * 0x9e3779b1u;
  return h ^ h >> 15;
}
inline U finish(U h) {
  h *= 0x85ebca77u;
  return h ^ h >> 16;
}
constexpr std::uint32_t kSeed = 0x6d6d7331u;

/// A cell of a lattice: its corner, the point in it, the weights of the upper sides.
struct Cell {
  U i, j, k;
  F x, y, z, u, v, w;
};
inline F fade(F t) { return t * t * t * fma(t, fma(t, all(6), all(-15)), all(10)); }
inline Cell cell(Vec p) {
  const F fx = floor(p.x), fy = floor(p.y), fz = floor(p.z);
  const F x = p.x - fx, y = p.y - fy, z = p.z - fz;
  return {whole(fx), whole(fy), whole(fz), x, y, z, fade(x), fade(y), fade(z)};
}

inline Vec vector(U h) {
  h = finish(h);
  const U one = bits(all(1)), top = U{} + 0x80000000u;
  const U low = h & 0x0fffffffu, zero = (low + (low + low)) >> 28;
  return {bits((one | (h & top)) & ~U(zero == 0)), bits((one | (h << 1 & top)) & ~U(zero == 1)),
          bits((one | (h << 2 & top)) & ~U(zero == 2))};
}
inline F slope(U h, F x, F y, F z) { return dot(vector(h), {x, y, z}); }

inline F perlin(Vec p) {
  const Cell c = cell(p);
  const auto line = [&c](U hb, F x, F y) {
    return mix(slope(take(hb, c.k), x, y, c.z), slope(take(hb, c.k + 1), x, y, c.z - 1), c.w);
  };
  const auto plane = [&](U ha, F x) {
    return mix(line(take(ha, c.j), x, c.y), line(take(ha, c.j + 1), x, c.y - 1), c.v);
  };
  const U seed = U{} + kSeed;
  return 0.964919f * mix(plane(take(seed, c.i), c.x), plane(take(seed, c.i + 1), c.x - 1), c.u);
}
inline F fbm(Vec p, int octaves) {
  F total = {};
  float amplitude = 1;
  for (; octaves > 0; --octaves) {
    total += amplitude * perlin(p);
    p = 2 * p;
    amplitude *= 0.5f;
  }
  return total;
}

struct Jet {
  F value;
  Vec gradient;
};
inline Jet mix(const Jet& a, const Jet& b, F t) {
  return {mix(a.value, b.value, t), mix(a.gradient, b.gradient, t)};
}
inline Vec perlin_gradient(Vec p) {
  const Cell c = cell(p);
  const auto derivative = [](F t) { return 30 * t * t * fma(t, t - 2, all(1)); };
  const F du = derivative(c.x), dv = derivative(c.y), dw = derivative(c.z);
  const auto corner = [](U h, F x, F y, F z) {
    const Vec g = vector(h);
    return Jet{dot(g, {x, y, z}), g};
  };
  const auto line = [&](U hb, F x, F y) {
    const Jet a = corner(take(hb, c.k), x, y, c.z), b = corner(take(hb, c.k + 1), x, y, c.z - 1);
    Jet r = mix(a, b, c.w);
    r.gradient.z = fma(dw, b.value - a.value, r.gradient.z);
    return r;
  };
  const auto plane = [&](U ha, F x) {
    const Jet a = line(take(ha, c.j), x, c.y), b = line(take(ha, c.j + 1), x, c.y - 1);
    Jet r = mix(a, b, c.v);
    r.gradient.y = fma(dv, b.value - a.value, r.gradient.y);
    return r;
  };
  const U seed = U{} + kSeed;
  const Jet a = plane(take(seed, c.i), c.x), b = plane(take(seed, c.i + 1), c.x - 1);
  Jet r = mix(a, b, c.u);
  r.gradient.x = fma(du, b.value - a.value, r.gradient.x);
  return 0.964919f * r.gradient;
}

// Shaders

void gradient(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const F u = load(p.uv[0] + i), v = load(p.uv[1] + i);
    const F near = fma(all(0.8f), u, all(0.1f)), far = fma(all(-0.3f), u, all(0.9f));
    const F t = mix(near, far, v);
    store(out[0] + i, fma(t, fma(all(-0.5f), t, all(1.5f)), 0.25f * u * v));
  }
}

void checker(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const F u = load(p.uv[0] + i), v = load(p.uv[1] + i);
    const I odd = I((whole(floor(8 * u)) + whole(floor(8 * v))) << 31);
    const F even_shade = fma(all(-0.2f), u, all(0.9f)), odd_shade = fma(all(0.2f), v, all(0.1f));
    store(out[0] + i, F(_mm256_blendv_ps(__m256(even_shade), __m256(odd_shade), __m256(odd))));
  }
}

void noise(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) store(out[0] + i, perlin(4 * load(p.position, i)));
}

void marble(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const Vec q = load(p.position, i);
    store(out[0] + i, fma(all(0.5f), sine(fma(all(3), q.x, 4 * fbm(2 * q, 6))), all(0.5f)));
  }
}

inline F corner(U h, F x, F y, F z) {
  const U i = h * 1664525u + 1013904223u, j = i * 1664525u + 1013904223u;
  return 4.656612873077393e-10f * fma(real(j), z, fma(real(i), y, real(h) * x));
}
inline F slopes(Vec p) {
  const Cell c = cell(p);
  const U i[] = {c.i * 73856093u, (c.i + 1) * 73856093u};
  const auto line = [&](U jk, F y, F z) {
    const auto end = [&](U h, F x) {
      return corner(h * (h * h * 15731u + 789221u) + 1376312589u, x, y, z);
    };
    return mix(end(i[0] + jk, c.x), end(i[1] + jk, c.x - 1), c.u);
  };
  const auto plane = [&](U k, F z) {
    return mix(line(c.j * 19349663u + k, c.y, z), line((c.j + 1) * 19349663u + k, c.y - 1, z), c.v);
  };
  return mix(plane(c.k * 83492791u, c.z), plane((c.k + 1) * 83492791u, c.z - 1), c.w);
}
void marble_in_script(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const Vec at = load(p.position, i);
    Vec q = 2 * at;
    F total = {};
    float amplitude = 1;
    for (int left = 6; left > 0; --left) {
      total += amplitude * slopes(q);
      q = 2 * q;
      amplitude *= 0.5f;
    }
    store(out[0] + i, fma(all(0.5f), sine(fma(all(3), at.x, 4 * total)), all(0.5f)));
  }
}

inline F nearest_point(Vec p) {
  const Cell c = cell(p);
  const auto unit = [](U h) { return real(h >> 8) * 0x1p-24f; };
  const auto next = [](U h) {
    h *= 0xc2b2ae3du;
    return h ^ h >> 15;
  };
  F best = all(1e30f);
  for (int a = -1; a <= 1; ++a) {
    const U ha = take(U{} + kSeed, c.i + std::uint32_t(a));
    for (int b = -1; b <= 1; ++b) {
      const U hb = take(ha, c.j + std::uint32_t(b));
      for (int k = -1; k <= 1; ++k) {
        const U h0 = finish(take(hb, c.k + std::uint32_t(k))), h1 = next(h0), h2 = next(h1);
        const Vec d = {c.x - float(a) - unit(h0), c.y - float(b) - unit(h1),
                       c.z - float(k) - unit(h2)};
        best = least(best, dot(d, d));
      }
    }
  }
  return root(best);
}
void worley(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) store(out[0] + i, nearest_point(4 * load(p.position, i)));
}

void mandelbrot(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const F a = fma(all(3), load(p.uv[0] + i), all(-2.2f));
    const F b = fma(all(2.6f), load(p.uv[1] + i), all(-1.3f));
    F x = {}, y = {};
    U steps = {};
    for (int k = 0; k < 128; ++k) {
      const F yy = y * y;
      const I inside = fma(x, x, yy) <= all(4);
      if (!_mm256_movemask_ps(__m256(inside))) break;
      steps -= U(inside);  // all ones is -1; a lane that left never comes back
      y = fma(2 * x, y, b);
      x = fma(x, x, a - yy);
    }
    store(out[0] + i, real(steps) * (1.0f / 128));
  }
}

void spectral(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const F t = load(p.uv[0] + i), depth = -2 * load(p.uv[1] + i);
    const F b = mix(all(0.3f), all(0.7f), t);
    const F r = mix(all(0.9f), all(0.1f), t) - b, g = mix(all(0.6f), all(0.3f), t) - b;
    for (int k = 0; k < 8; ++k) {
      const F red = load(p.red[k] + i), green = load(p.green[k] + i);
      const F absorbed = fma(all(-0.5f), green, fma(all(-1.2f), red, all(1.4f)));
      store(out[k] + i, fma(g, green, fma(r, red, b)) * exponential(depth * absorbed));
    }
  }
}

inline F fresnel(F cosine, float ior) {
  const F c = least(most(cosine, -cosine), all(1));
  const F t = root(1 - (1 - c * c) * (1 / (ior * ior)));  // ior > 1: no total reflection
  const F s = (c - ior * t) / (c + ior * t), q = (ior * c - t) / (ior * c + t);
  return 0.5f * fma(s, s, q * q);
}
void layered(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const F rusty = smoothstep(-0.2f, 0.3f, fbm(3 * load(p.position, i), 4));
    const F mirror = fresnel(dot(load(p.normal, i), load(p.view, i)), 1.5f);
    const F b = mix(all(0.6f), all(0.05f), rusty);
    const F r = mix(all(0.1f), all(0.4f), rusty) - b, g = mix(all(0.3f), all(0.15f), rusty) - b;
    for (int k = 0; k < 8; ++k) {
      const F body = fma(g, load(p.green[k] + i), fma(r, load(p.red[k] + i), b));
      store(out[k] + i, mix(body, all(0.95f), mirror));
    }
  }
}

void bump(const Lanes& p, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    Vec q = 6 * load(p.position, i), along = {};
    for (int octave = 0; octave < 4; ++octave) {
      const Vec g = perlin_gradient(q);
      along = {along.x + g.x, along.y + g.y, along.z + g.z};
      q = 2 * q;
    }
    store(out[0] + i, 0.06f * dot(along, load(p.tangent, i)));
    store(out[1] + i, 0.06f * dot(along, load(p.bitangent, i)));
  }
}

void wood(const Lanes& lanes, float* const* out, int n) {
  for (int i = 0; i < n; i += 8) {
    const Vec p = load(lanes.position, i), d = 2 * p;
    const Vec q = {fma(all(0.3f), perlin(d), p.x),
                   fma(all(0.3f), perlin({d.x + 17.5f, d.y + 17.5f, d.z + 17.5f}), p.y), p.z};
    const F x = fma(all(9), root(fma(q.x, q.x, q.y * q.y)), 0.4f * fbm(3 * q, 3));
    const F ring = x - floor(x);
    const F late = smoothstep(0.3f, 0.9f, ring) * (1 - smoothstep(0.92f, 1, ring));
    store(out[0] + i, fma(all(0.5f), late, all(0.25f)));
  }
}

}  // namespace

const Named<VectorTwin> kVectorTwins[] = {{"gradient", gradient},
                                          {"checker", checker},
                                          {"noise", noise},
                                          {"marble", marble},
                                          {"marble_in_script", marble_in_script},
                                          {"worley", worley},
                                          {"mandelbrot", mandelbrot},
                                          {"spectral", spectral},
                                          {"layered", layered},
                                          {"bump", bump},
                                          {"wood", wood},
                                          {nullptr, nullptr}};

}  // namespace mms::bench
#else
#include "bench/twins.h"

namespace mms::bench {
const Named<VectorTwin> kVectorTwins[] = {{nullptr, nullptr}};
}
#endif
