// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `glossy_refraction`: the thesis' glossy lobe (section 6.3) around ideal refraction, without
/// Fresnel loss. Directions on the side of the higher index n within the critical angle are those
/// on the other side, bent: (t, z) there is (n t, sqrt(1 - n^2 t^2)), and covers n^2 times as much
/// projected solid angle. With g the lobe of `glossy_through` between two directions of the side of
/// the lower index,
///
///   f = n_i^2 g       of importance, n_i the index on the side of wi: n, or 1
///
/// Beyond the critical angle light is reflected, by the lobe over what is left: with
/// k = 1 - 1 / n^2, X = cos^2 theta / k and f_theta, f_phi of materials/glossy.h,
///
///   f = 2 f_theta(X, Y) f_phi / k
///
/// All of it is lossless for colour 1 from both sides, and reciprocal. At index 1 it is
/// `glossy_through`, and beyond all gloss `refraction`.

#include <algorithm>
#include <cmath>
#include <optional>

#include "materials/glass_coat.h"
#include "materials/glossy.h"
#include "materials/spread.h"

namespace mms::materials {

template <class R>
struct GlossyRefraction {
  const R* numbers;
  GlossyProduct<R> lobe;

  explicit GlossyRefraction(const R* p) : numbers(p), lobe(p + kWavelengths) {}

  bool specular() const { return lobe.specular(); }
  /// Whether it is known what coats send back.
  bool knows_coats() const { return true; }
  /// Whether coats lie on the side of the higher index, at wavelength j.
  bool falls(int j) const { return relative_eta(numbers[j], Vec3<R>{0, 0, 1}) < 1; }
  /// How coats see what passes at wavelength j: as the lobe of `glossy_through` that it is outside.
  /// Of `w` beyond the critical angle, along the surface. \pre not falls(j)
  CoatedLobe<R> coated(Vec3<R> w, int j) const {
    const R eta = relative_eta(numbers[j], w);
    const Vec3<R> up = to_upper(w, w);
    return lobe.coated(eta < 1 ? beyond(up.z, eta) ? Vec3<R>{} : refracted(up, eta) : up);
  }
  /// What coats send back of light along `w`, as a mirror; `coats` as in SentBack::smooth.
  /// \pre not specular
  template <class Coats>
  SentBack<R> sent_back(Vec3<R> w, const Coats& coats) const {
    SentBack<R> back = SentBack<R>::smooth(terms(w), w, coats);
    std::optional<SpreadMatrix<R>> matrix;
    for (int j = 0; j < kWavelengths; ++j) {
      if (!falls(j) || !coats.law[j].counts) continue;
      if (!matrix) matrix.emplace(lobe.coated(w));
      const R share =
          w.z > 0 ? sent_outside(w.z, j, *matrix, coats) : sent_inside(-w.z, j, *matrix, coats);
      back.share[j] = lobe.colour[j] * limited(share, R(0), R(1));
    }
    return back;
  }

  Spectrum<R> estimate(Vec3<R>) const { return lobe.colour; }
  SpecularTerms<R> terms(Vec3<R> wo) const { return Refraction<R>(numbers).terms(wo); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode) const {
    Lobes<R> out;
    R eta = 1, f = 0;
    for_each_index(numbers, [&](int j, bool repeated) {
      if (!repeated) {
        eta = relative_eta(numbers[j], wo);
        f = value(wo, wi, eta);
      }
      const R scale = same_side(wo, wi) || mode == Mode::Importance ? R(1) : 1 / (eta * eta);
      out.f[j] = lobe.colour[j] * f * scale;
      out.pdf[j] = f * std::abs(wi.z);
    });
    return out;
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    const R eta = relative_eta(numbers[0], wo);
    const Vec3<R> o = to_upper(wo, wo);
    if (beyond(o.z, eta)) {
      const R k = (1 - eta) * (1 + eta), y = std::min(o.z * o.z / k, R(1));
      const R x = k * lobe.draw_latitude(u1, y, 1 - y).first;
      wi = lobe.turned(o, x, 1 - x, u2);
      if (!(wi.z > 0)) return false;
    } else {
      Vec3<R> i;
      if (!lobe.sample(eta < 1 ? -refracted(o, eta) : o, 0, u1, u2, i)) return false;
      wi = eta < 1 ? Vec3<R>{i.x, i.y, -i.z} : refracted(Vec3<R>{-i.x, -i.y, i.z}, eta);
      if (!(wi.z < 0)) return false;
    }
    wi = to_upper(wi, wo);
    return true;
  }

 private:
  /// What coats send back where the index is the lower one, for colour 1. Light that is reflected
  /// outside beyond the critical angle, at cos^2 = k X, lacks 1 - T / M, what comes outside E.
  template <class Coats>
  R sent_outside(R z, int j, const SpreadMatrix<R>& matrix, const Coats& coats) const {
    const R eta = relative_eta(numbers[j], Vec3<R>{0, 0, 1}), k = (1 - eta) * (1 + eta);
    if (!beyond(z, eta)) return 0;
    const R most = coats.law[j].most, y = std::min(z * z / k, R(1));
    return coats.split(j, z).transmitted *
           mean_along(matrix, lobe.coated({std::sqrt(1 - y), 0, std::sqrt(y)}), [&](R x) {
             return std::max(1 - coats.split(j, std::sqrt(k) * x).transmitted / most, R(0));
           });
  }
  template <class Coats>
  R sent_inside(R z, int j, const SpreadMatrix<R>& matrix, const Coats& coats) const {
    const R eta = relative_eta(numbers[j], Vec3<R>{0, 0, 1});
    return mean_along(matrix, lobe.coated({std::sqrt((1 - z) * (1 + z)), 0, z}), [&](R c) {
      const R outside2 = 1 - eta * eta * (1 - c) * (1 + c);
      return coats.split(j, std::sqrt(std::max(outside2, R(0)))).reflected;
    });
  }

  /// Whether light at the cosine `c` is reflected totally; `eta` is the index beyond over its own.
  static bool beyond(R c, R eta) { return eta < 1 && !(refraction_g2(std::min(c, R(1)), eta) > 0); }

  /// f of importance for colour 1; `eta` as of wo.
  R value(Vec3<R> wo, Vec3<R> wi, R eta) const {
    const Vec3<R> o = to_upper(wo, wo), i = to_upper(wi, wo);
    if (same_side(wo, wi))
      return beyond(o.z, eta) && beyond(i.z, eta) ? reflected(o, i, eta) : R(0);
    const Vec3<R> through{i.x, i.y, -i.z};
    if (eta < 1) return beyond(o.z, eta) ? R(0) : lobe.value(-refracted(o, eta), through);
    if (beyond(through.z, 1 / eta)) return 0;
    return eta * eta * lobe.value(o, eta == 1 ? through : -refracted(through, 1 / eta));
  }

  R reflected(Vec3<R> o, Vec3<R> i, R eta) const {
    const R k = (1 - eta) * (1 + eta), x = std::min(i.z * i.z / k, R(1)),
            y = std::min(o.z * o.z / k, R(1));
    return 2 / k *
           Latitude<R>(lobe.gloss)
               .density((x + y) / 2, ((1 - x) + (1 - y)) / 2, (i.z - o.z) * (i.z + o.z) / k) *
           lobe.around_normal(-o.x, -o.y, i.x, i.y);
  }
};

}  // namespace mms::materials
