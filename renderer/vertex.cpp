// SPDX-License-Identifier: Apache-2.0
#include "renderer/vertex.h"

#include <algorithm>
#include <cmath>

#include "base/warp.h"
#include "materials/emission.h"
#include "materials/frames.h"

namespace mms::renderer {

Frame<double> shading_frame(const SurfacePoint& s, const std::array<double, 2>& gradient,
                            Vec3d view) {
  const bool bumpy = gradient[0] != 0 || gradient[1] != 0;
  Vec3d n = s.normal;
  if (bumpy) {
    n = n - s.tangent * gradient[0] - s.bitangent * gradient[1];
    const double l2 = dot(n, n);
    n = std::isfinite(l2) && l2 > 0 ? n / std::sqrt(l2) : s.normal;
  }
  const Vec3d shown = materials::held_back(n, s.geometric_normal, view);
  if (!bumpy && shown == n) return {s.tangent, s.bitangent, n};
  return Frame<double>::with_tangent(shown, s.tangent);
}

void immerse(const materials::Layout& layout, const Spectrumf& outside, float* params) {
  for (const materials::Layout::Node& node : layout.nodes()) {
    if (!(materials::traits(node.lobe) & materials::Dispersive)) continue;
    const materials::Formals& formals = materials::formals(node.lobe);
    float* at = params + node.first_param;
    for (int i = 0; i < formals.count; ++i) {
      const bool spectrum = formals.kinds[i] == 's';
      for (int k = 0; formals.index[i] && k < kWavelengths; ++k)
        if (outside[k] > 0) at[k] /= outside[k];
      at += spectrum ? kWavelengths : 1;
    }
  }
}

Spectrumf scripted_emission(const Compiled& compiled, const Scripts& scripts,
                            const vm::Descriptor& d, EntryKind entry, int lane,
                            const SurfacePoint& s, Vec3d to, std::vector<float>& scratch) {
  const vm::Entry& e = entry_of(d, entry);
  const Spectrumf emission =
      Spectrumf::map([](float x) { return x < 0 ? 0.0f : x; }, scripts.spectrum(e.emission, lane));
  if (emission.is_black()) return emission;
  const CompiledDescriptor& c = compiled.of(&d);
  const materials::Layout& layout = entry == EntryKind::Emit ? c.emit_emission : c.shade_emission;
  scratch.resize(std::max(1, layout.param_count()));
  scripts.params(e.emission_material, lane, scratch.data());
  const Frame<double> frame = Frame<double>::with_tangent(s.normal, s.tangent);
  return emission * materials::emission_shape(layout, scratch.data(), Vec3f(frame.to_local(to)));
}

Spectrumf fixed_emission(const FixedSurface& surface, const SurfacePoint& s, Vec3d to,
                         const Cluster& cluster) {
  if (!surface.emits() || !(dot(s.normal, to) > 0)) return Spectrumf(0.0f);
  return cluster.light(surface.emission);
}

Spectrumf fixed_albedo(const FixedSurface& surface, const Object& object, Vec3d position,
                       const Cluster& cluster) {
  if (!surface.checker) return cluster.reflectance(surface.matte);
  const Vec3d p = object.transform.inverse_point(position) / surface.checker_size;
  const bool odd = (std::int64_t(std::floor(p.x)) + std::int64_t(std::floor(p.z))) & 1;
  return cluster.reflectance(odd ? *surface.checker : surface.matte);
}

}  // namespace mms::renderer
