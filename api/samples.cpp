// SPDX-License-Identifier: Apache-2.0
#include "api/samples.h"

#include <charconv>
#include <cmath>
#include <numbers>

namespace mms::api {

namespace {

using Numbers = std::array<double, 3>;

/// Fraction k alpha mod 1 of the additive recurrence that fills squares and cubes evenly (Roberts
/// 2018; alpha from the root of x^4 = x + 1).
double spread(int k, int axis) {
  constexpr double root = 1.2207440846057596;
  const double x = (k + 0.5) / std::pow(root, axis + 1);
  return x - std::floor(x);
}

template <class R>
void put(vm::InputBatch<R>& in, vm::Variable v, int lane, const Numbers& x, int count = 3) {
  for (int c = 0; c < count; ++c) in.lanes(v, c)[lane] = R(float(x[c]));
}

template <class R>
void fill_box(vm::InputBatch<R>& in, const std::array<double, 6>& box, int k, int lane) {
  Numbers p;
  for (int c = 0; c < 3; ++c) p[c] = box[c] + (box[c + 3] - box[c]) * spread(k, c);
  put(in, vm::Variable::Position, lane, p);
  put(in, vm::Variable::ObjectPosition, lane, p);
}

/// Point k of a golden spiral over the unit sphere.
template <class R>
void fill_sphere(vm::InputBatch<R>& in, int count, int k, int lane) {
  constexpr double pi = std::numbers::pi;
  const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
  const double phi = 2 * pi * std::fmod(k / std::numbers::phi, 1.0);
  const Numbers n = {r * std::cos(phi), r * std::sin(phi), z};
  const Numbers t = {-std::sin(phi), std::cos(phi), 0};
  const Numbers b = {-z * std::cos(phi), -z * std::sin(phi), r};
  using V = vm::Variable;
  for (V v : {V::Position, V::ObjectPosition, V::Normal, V::GeometricNormal, V::View})
    put(in, v, lane, n);
  for (V v : {V::Tangent, V::ObjectTangent, V::NormalTangent}) put(in, v, lane, t);
  for (V v : {V::Bitangent, V::ObjectBitangent, V::NormalBitangent}) put(in, v, lane, b);
  put(in, V::Uv, lane, {phi / (2 * pi), std::acos(z) / pi, 0}, 2);
  put(in, V::UvTangent, lane, {1 / (2 * pi * r), 0, 0}, 2);
  put(in, V::UvBitangent, lane, {0, -1 / pi, 0}, 2);
}

}  // namespace

Result<std::array<double, 6>> parse_box(const std::string& text) {
  const Error error{"--box", "`" + text + "` is no box",
                    "six numbers with commas between, the lower corner first: -1,-1,-1,1,1,1"};
  std::array<double, 6> box;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t k = 0; k < box.size(); ++k) {
    if (k > 0 && (at == end || *at++ != ',')) return error;
    const auto [next, failed] = std::from_chars(at, end, box[k]);
    if (failed != std::errc() || !std::isfinite(box[k])) return error;
    at = next;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (!(box[k] < box[k + 3])) return error;
  return at == end ? Result<std::array<double, 6>>(box) : error;
}

template <class R>
void fill_samples(vm::InputBatch<R>& in, const Samples& samples, int first, int lanes) {
  for (int i = 0; i < lanes; ++i) {
    if (samples.box)
      fill_box(in, *samples.box, first + i, i);
    else
      fill_sphere(in, samples.count, first + i, i);
  }
}

template void fill_samples(vm::InputBatch<float>&, const Samples&, int, int);
template void fill_samples(vm::InputBatch<double>&, const Samples&, int, int);

}  // namespace mms::api
