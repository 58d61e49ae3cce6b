// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A volume's scattering at one point: the phase functions of a Layout with the numbers of one
/// lane. Same interface as materials/bsdf.h over the whole sphere, with these differences:
///
/// * `wo` and `wi` are unit vectors in world space that both point away from the point.
/// * `f` is per steradian; there is no cosine: contribution = f Li / pdf. A phase function alone
///   has f = pdf and integrates to 1 over `wi`; `mix`, `add`, `scale` weigh f.
/// * There are no deltas and no modes; everything is symmetric in wo and wi.
///
/// Surface lobes in the layout scatter nothing here, and phase functions nothing in a Bsdf.

#include <optional>

#include "materials/combine.h"

namespace mms::materials {

template <class R>
struct PhaseSample {
  Vec3<R> wi;
  Spectrum<R> f;
  Spectrum<R> pdf;  ///< of each wavelength as the hero; element 0 > 0
};

/// |g| is limited to this: a peak about 1 - g wide must stay wider than what a float direction
/// resolves (1e-7 rad: a relative error near 1e-3).
inline constexpr double kMaxPhaseG = 0.9999;

/// Henyey-Greenstein. The cosine `c` is that of the angle of deflection; its distance from 1 and
/// from -1 is formed without subtraction.
template <class R>
struct HenyeyGreenstein {
  R g;

  explicit HenyeyGreenstein(R mean_cosine)
      : g(std::isnan(mean_cosine) ? R(0) : limited(mean_cosine, R(-kMaxPhaseG), R(kMaxPhaseG))) {}

  /// Density per steradian: (1 - g^2) / (4 pi (1 + g^2 - 2 g c)^(3/2)).
  R density(Vec3<R> wo, Vec3<R> wi) const {
    const Vec3<R> off = g > 0 ? wi + wo : wi - wo;  // its square is 2 (1 - |g|/g c)
    const R a = 1 - std::abs(g);
    const R d = a * a + std::abs(g) * dot(off, off);
    return a * (1 + std::abs(g)) / (4 * kPi<R> * d * std::sqrt(d));
  }

  Vec3<R> sample(Vec3<R> wo, R u1, R u2) const {
    // With t = 2 u1 - 1 (which is c for g = 0): 1 - c and 1 + c without division by g.
    const R below = 2 * u1, above = 2 * (1 - u1);                   // 1 + t, 1 - t
    const R q = g > 0 ? (1 - g) + g * below : (1 + g) - g * above;  // 1 + g t
    const R k = 1 / (2 * q * q);
    const R one_minus_c = (1 - g) * (1 - g) * above * (2 + g * below) * k;
    const R one_plus_c = (1 + g) * (1 + g) * below * (2 - g * above) * k;
    const R c = one_minus_c < one_plus_c ? 1 - one_minus_c : one_plus_c - 1;
    const R s = std::sqrt(one_minus_c * one_plus_c), phi = 2 * kPi<R> * u2;
    const Frame<R> frame = Frame<R>::around(-wo);
    return normalize(frame.to_world({s * std::cos(phi), s * std::sin(phi), c}));
  }
};

template <class R>
class Phase {
 public:
  /// `params` holds layout.param_count() numbers. Both are borrowed.
  Phase(const Layout& layout, const R* params) : layout_(&layout), params_(params) {}

  Spectrum<R> eval(Vec3<R> wo, Vec3<R> wi) const { return evaluate(wo, wi).f; }
  Spectrum<R> pdf(Vec3<R> wo, Vec3<R> wi) const { return evaluate(wo, wi).pdf; }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi) const {
    PerNode<Spectrum<R>> weights;
    const Spectrum<R> sum = weigh_nodes(weights);
    Lobes<R> total;
    for (int i = 0; i < node_count(); ++i)
      if (is_phase(i)) total.f += weights.of[i] * model(i).density(wo, wi);
    // Every function is its own density, so choosing by weight makes pdf a multiple of f.
    for (int j = 0; j < kWavelengths; ++j) total.pdf[j] = sum[j] > 0 ? total.f[j] / sum[j] : R(0);
    return total;
  }

  /// Draws `wi` for the hero; empty where nothing scatters at the hero's wavelength.
  std::optional<PhaseSample<R>> sample(Vec3<R> wo, R u_lobe, R u1, R u2) const {
    PerNode<Spectrum<R>> weights;
    const R sum = weigh_nodes(weights)[0];
    if (!(sum > 0)) return {};
    R left = u_lobe * sum;
    int chosen = -1;
    for (int i = 0; i < node_count(); ++i) {
      if (!is_phase(i) || !(weights.of[i][0] > 0)) continue;
      chosen = i;
      if (left < weights.of[i][0]) break;
      left -= weights.of[i][0];
    }
    PhaseSample<R> s;
    s.wi = model(chosen).sample(wo, u1, u2);
    const Lobes<R> l = evaluate(wo, s.wi);
    s.f = l.f;
    s.pdf = l.pdf;
    if (!(s.pdf[0] > 0)) return {};
    return s;
  }

 private:
  int node_count() const { return int(layout_->nodes().size()); }
  bool is_phase(int i) const { return (traits(layout_->nodes()[i].lobe) & PhaseFunction) != 0; }

  HenyeyGreenstein<R> model(int i) const {
    const Layout::Node& node = layout_->nodes()[i];
    return HenyeyGreenstein<R>(node.lobe == Lobe::Isotropic ? R(0) : params_[node.first_param]);
  }

  /// Fills the weight of every node; the sum over phase functions.
  Spectrum<R> weigh_nodes(PerNode<Spectrum<R>>& weights) const {
    Spectrum<R> sum;
    if (node_count() == 0) return sum;
    weigh_for_choice(*layout_, params_, R(1), weights);
    for (int i = 0; i < node_count(); ++i)
      if (is_phase(i)) sum += weights.of[i];
    return sum;
  }

  const Layout* layout_;
  const R* params_;
};

}  // namespace mms::materials
