// SPDX-License-Identifier: Apache-2.0
#include "materials/weight.h"

#include <algorithm>

#include "base/spectrum.h"

namespace mms::materials {

namespace {

/// From `a` to `b` by `share`, which is clamped to [0, 1].
Spectrumf between(const Spectrumf& a, const Spectrumf& b, const Spectrumf& share) {
  Spectrumf to;
  for (int j = 0; j < kWavelengths; ++j)
    to[j] = a[j] + (b[j] - a[j]) * std::clamp(share[j], 0.0f, 1.0f);
  return to;
}

Spectrumf weight_of(const Layout& layout, const float* params, int k) {
  const Layout::Node& node = layout.nodes()[std::size_t(k)];
  const auto part = [&](int i) { return weight_of(layout, params, node.children[i]); };
  const auto first = [&] {  // a spectrum
    Spectrumf x;
    std::copy_n(params + node.first_param, kWavelengths, x.v.begin());
    return x;
  };
  switch (node.lobe) {
    case Lobe::Add:
      return part(0) + part(1);
    case Lobe::Scale:
      return between(Spectrumf(0.0f), part(0), first());
    case Lobe::Mix:
      return between(part(0), part(1), first());
    case Lobe::Turn:
    case Lobe::Tilt:
      return part(0);
    default:
      break;
  }
  if (node.child_count == 2)
    return Spectrumf::map([](float x, float y) { return std::min(x, y); }, part(0), part(1));
  return formals(node.lobe).tint[0] ? first() : Spectrumf(0.0f);
}

}  // namespace

float stated_weight(const Layout& layout, const float* params) {
  if (layout.empty()) return 0;
  const Spectrumf w = weight_of(layout, params, int(layout.nodes().size()) - 1);
  return *std::max_element(w.v.begin(), w.v.end());
}

}  // namespace mms::materials
