// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A material as the directional shape of emission.
///
/// The rule: the shape towards `w` is pi f(n, w), n the normal: what the material would show of a
/// white beam along the normal, in units of a white matte surface. So `matte(c)` emits c evenly
/// over the front (w.z > 0) and nothing behind; `translucent(c)` emits c behind; a `glossy` or
/// `microfacet` emits a beam around the normal; `mix`, `add`, `scale` and `fresnel_mix` combine
/// these. Deltas emit nothing.

#include "materials/bsdf.h"
#include "materials/phase.h"

namespace mms::materials {

/// Shape of emission towards `w`, unit, local (z = shading normal, n outwards). Radiance is this
/// times the emission's spectrum. `params` as for Bsdf. The power per area is pi times the albedo
/// at normal incidence without deltas: `Bsdf(layout, params).sample(n, ...)` draws from it.
template <class R>
inline Spectrum<R> emission_shape(const Layout& layout, const R* params, Vec3<R> w) {
  return Bsdf<R>(layout, params).eval({0, 0, 1}, w, Mode::Importance) * kPi<R>;
}

/// Shape of a volume's emission towards `w`, a unit vector in world space: 4 pi times the phase
/// function for light that came along the y axis, so that `isotropic()` and no material are 1.
template <class R>
inline Spectrum<R> volume_emission_shape(const Layout& layout, const R* params, Vec3<R> w) {
  if (layout.empty()) return Spectrum<R>(R(1));
  return Phase<R>(layout, params).eval({0, 1, 0}, w) * (4 * kPi<R>);
}

}  // namespace mms::materials
