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
#include "materials/phase_functions.h"

namespace mms::materials {

template <class R>
struct PhaseSample {
  Vec3<R> wi;
  Spectrum<R> f;
  Spectrum<R> pdf;  ///< of each wavelength as the hero; element 0 > 0
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
      if (is_phase(i))
        total.f +=
            weights.of[i] * with_function(i, [&](const auto& m) { return m.density(wo, wi); });
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
    s.wi = with_function(chosen, [&](const auto& m) { return m.sample(wo, u1, u2); });
    const Lobes<R> l = evaluate(wo, s.wi);
    s.f = l.f;
    s.pdf = l.pdf;
    if (!(s.pdf[0] > 0)) return {};
    return s;
  }

 private:
  int node_count() const { return int(layout_->nodes().size()); }
  bool is_phase(int i) const { return (traits(layout_->nodes()[i].lobe) & PhaseFunction) != 0; }

  /// `visit(function)` for the phase function of node `i`.
  template <class Visit>
  auto with_function(int i, Visit visit) const {
    const Layout::Node& node = layout_->nodes()[i];
    const R* p = params_ + node.first_param;
    switch (node.lobe) {
      case Lobe::Isotropic:
        return visit(HenyeyGreenstein<R>(R(0)));
      case Lobe::RayleighPhase:
        return visit(Draine<R>(R(0), R(1)));
      case Lobe::Draine:
        return visit(Draine<R>(p[0], p[1]));
      default:
        return visit(HenyeyGreenstein<R>(p[0]));
    }
  }

  /// Fills the weight of every node; the sum over phase functions.
  Spectrum<R> weigh_nodes(PerNode<Spectrum<R>>& weights) const {
    Spectrum<R> sum;
    if (node_count() == 0) return sum;
    Frames<R> none;  // all directions are alike
    weigh_for_choice(*layout_, params_, none, Vec3<R>{0, 0, 1}, nullptr, weights);
    for (int i = 0; i < node_count(); ++i)
      if (is_phase(i)) sum += weights.of[i];
    return sum;
  }

  const Layout* layout_;
  const R* params_;
};

}  // namespace mms::materials
