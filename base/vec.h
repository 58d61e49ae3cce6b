// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Three-component vectors and orthonormal frames over any real type.
/// Owns nothing; every function is pure.

#include <cmath>
#include <type_traits>

namespace mms {

/// `s` rounded to an `R`. g++ 12 for x86 leaves the rounding out where it converts two numbers at
/// once and they become double again (its SLP vectoriser; without it rendering takes a tenth more
/// time): the empty instruction is what it cannot look through.
template <class R, class S>
constexpr R rounded(S s) {
  R r = R(s);
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
  if constexpr (sizeof(R) < sizeof(S))
    if (!std::is_constant_evaluated()) asm("" : "+x"(r));
#endif
  return r;
}

/// A point, direction or normal; the name of the variable says which, and in which space.
template <class R>
struct Vec3 {
  R x{}, y{}, z{};

  constexpr Vec3() = default;
  constexpr Vec3(R x_, R y_, R z_) : x(x_), y(y_), z(z_) {}
  template <class S>
  constexpr explicit Vec3(const Vec3<S>& v)
      : x(rounded<R>(v.x)), y(rounded<R>(v.y)), z(rounded<R>(v.z)) {}

  constexpr R operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator*(Vec3 a, R s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(R s, Vec3 a) { return a * s; }
  friend constexpr Vec3 operator/(Vec3 a, R s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr bool operator==(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  constexpr Vec3& operator*=(R s) { return *this = *this * s; }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class R>
constexpr R dot(Vec3<R> a, Vec3<R> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// `a b + c` of the exact product. Of floats in double, where it is exact too: the plain function
/// is a call where not every processor has the instruction.
template <class R>
inline R fused(R a, R b, R c) {
  if constexpr (std::is_same_v<R, float>)
    return float(double(a) * double(b) + double(c));
  else
    return std::fma(a, b, c);
}

/// `a b - c d` with one rounding error left (Kahan's fused form).
template <class R>
inline R difference_of_products(R a, R b, R c, R d) {
  const R cd = c * d;
  const R error = fused(-c, d, cd);
  return fused(a, b, -cd) + error;
}

/// Cross product without cancellation between the two products of a component.
template <class R>
inline Vec3<R> cross(Vec3<R> a, Vec3<R> b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

template <class R>
inline R length(Vec3<R> a) {
  return std::sqrt(dot(a, a));
}

/// Unit vector along `a`; `a` must not be zero.
template <class R>
inline Vec3<R> normalize(Vec3<R> a) {
  return a / length(a);
}

/// A right-handed orthonormal basis; local z is `n`.
template <class R>
struct Frame {
  Vec3<R> s, t, n;

  /// Any basis around the unit vector `n` (Duff et al. 2017, continuous but for n.z = -0).
  static Frame around(Vec3<R> n) {
    const R sign = std::copysign(R(1), n.z);
    const R a = R(-1) / (sign + n.z);
    const R b = n.x * n.y * a;
    return {
        {R(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// Basis with normal `n` (unit) whose `s` is the part of `tangent` orthogonal to `n`.
  /// Falls back to `around(n)` where they are parallel.
  static Frame with_tangent(Vec3<R> n, Vec3<R> tangent) {
    const Vec3<R> s = tangent - n * dot(n, tangent);
    const R l2 = dot(s, s);
    if (!(l2 > R(1e-12))) return around(n);
    const Vec3<R> su = s / std::sqrt(l2);
    return {su, cross(n, su), n};
  }

  Vec3<R> to_local(Vec3<R> v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3<R> to_world(Vec3<R> v) const { return s * v.x + t * v.y + n * v.z; }
};

}  // namespace mms
