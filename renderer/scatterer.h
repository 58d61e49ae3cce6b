// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What scatters at a vertex of the integrator's paths, for its own files.

#include "materials/bsdf.h"
#include "materials/phase.h"
#include "renderer/integrator.h"
#include "renderer/vertex.h"

namespace mms::renderer {

/// A direction and what is scattered from there.
struct Integrator::Sampled {
  Vec3d wi;
  Spectrumf f, pdf;
  bool specular = false;
};

/// Scattering at a vertex with one face for surfaces and volumes. Values hold the cosine.
struct Integrator::Scatterer {
  const materials::Layout& layout;
  const float* params;
  bool medium = false;
  Frame<double> frame;
  Vec3f view;                                              ///< of a surface, in its frame
  const materials::Bsdf<float>::Choice* choice = nullptr;  ///< likewise
  int directions = 1;                  ///< that are drawn: densities are of all of them
  const LampImages* images = nullptr;  ///< where one more is drawn by them, by their chance

  /// Of a medium.
  Scatterer(const materials::Layout& l, const float* p) : layout(l), params(p), medium(true) {}
  /// Of a surface, seen along `from`. Keeps its choice in `c`.
  Scatterer(const materials::Layout& l, const float* p, const Frame<double>& f, Vec3d from,
            materials::Bsdf<float>::Choice& c)
      : layout(l), params(p), frame(f), view(f.to_local(from)), choice(&c) {
    materials::Bsdf<float>(l, p).choose(view, c);
  }

  /// What `consistent` leaves out comes from below the horizon.
  Receives receives(const ScriptPoint& p) const {
    if (medium || layout.transmits()) return {};
    const Vec3d n = p.surface.geometric_normal;
    return {Vec3f(dot(n, p.view) < 0 ? -n : n), even()};
  }

  /// Whether no direction is much likelier than others.
  bool even() const {
    using materials::Lobe;
    if (layout.nodes().size() != 1) return false;
    const Lobe lobe = layout.nodes()[0].lobe;
    return lobe == Lobe::Matte || lobe == Lobe::RoughMatte;
  }

  bool can_connect() const {
    return medium ||
           (layout.has_smooth() && !materials::Bsdf<float>(layout, params).specular_only());
  }

  /// Of all directions that a surface draws, from that of one.
  Spectrumf density(const Spectrumf& pdf, Vec3d wi) const {
    const Spectrumf drawn = pdf * float(directions);
    return images ? drawn + Spectrumf(float(images->chance() * images->pdf(wi))) : drawn;
  }

  Sampled evaluate(const ScriptPoint& p, Vec3d wi) const {
    if (medium) {
      const materials::Phase<float> phase(layout, params);
      const auto lobes = phase.evaluate(Vec3f(p.view), Vec3f(wi));
      return {wi, lobes.f, lobes.pdf * float(directions)};
    }
    if (!consistent(p.surface, frame, wi)) return {wi, {}, {}};
    const materials::Bsdf<float> bsdf(layout, params);
    const Vec3f local(frame.to_local(wi));
    const auto lobes = bsdf.evaluate(view, local, materials::Mode::Radiance, *choice);
    return {wi, lobes.f * std::abs(local.z), density(lobes.pdf, wi)};
  }

  std::optional<Sampled> sample(const ScriptPoint& p, float u_lobe, float u, float v) const {
    if (medium) {
      const auto s = materials::Phase<float>(layout, params).sample(Vec3f(p.view), u_lobe, u, v);
      if (!s) return {};
      return Sampled{Vec3d(s->wi), s->f, s->pdf * float(directions)};
    }
    const auto s = materials::Bsdf<float>(layout, params)
                       .sample(view, u_lobe, u, v, materials::Mode::Radiance, *choice);
    if (!s) return {};
    const Vec3d wi = normalize(frame.to_world(Vec3d(s->wi)));
    if (!consistent(p.surface, frame, wi)) return {};
    return Sampled{wi, s->f * std::abs(s->wi.z), density(s->pdf, wi), s->specular};
  }

  /// Whether light is only mirrored and bent here, each in one direction.
  bool divides() const {
    return layout.nodes().size() == 1 && layout.transmits() && !can_connect();
  }

  /// Where that is so, all ways on, at most two, as if none were a matter of chance: a wavelength
  /// as the hero would have gone every way that it can go.
  int all_ways(const ScriptPoint& p, std::array<Sampled, 2>& ways) const {
    int count = 0;
    for (const float u_lobe : {0.0f, kLastWay}) {
      const auto s = sample(p, u_lobe, 0, 0);
      if (!s || (count > 0 && dot(s->wi, ways[0].wi) == dot(ways[0].wi, ways[0].wi))) continue;
      ways[count] = *s;
      ways[count++].pdf = possible(s->pdf);
    }
    return count;
  }
};

}  // namespace mms::renderer
