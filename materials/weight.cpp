// SPDX-License-Identifier: Apache-2.0
#include "materials/weight.h"

#include <algorithm>
#include <optional>

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

Spectrumf least_of(const Spectrumf& a, const Spectrumf& b) {
  return Spectrumf::map([](float x, float y) { return std::min(x, y); }, a, b);
}

/// The least of the colours of a model, whose numbers begin at `p`; 0 without any.
Spectrumf least_colour(const Formals& f, const float* p) {
  std::optional<Spectrumf> least;
  for (int i = 0; i < f.count; ++i) {
    if (f.tint[i]) {
      Spectrumf colour;
      std::copy_n(p, kWavelengths, colour.v.begin());
      least = least ? least_of(*least, colour) : colour;
    }
    p += f.kinds[i] == 's' ? kWavelengths : 1;
  }
  return least.value_or(Spectrumf(0.0f));
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
  if (node.child_count == 2) return least_of(part(0), part(1));
  return least_colour(formals(node.lobe), params + node.first_param);
}

}  // namespace

float stated_weight(const Layout& layout, const float* params) {
  if (layout.empty()) return 0;
  const Spectrumf w = weight_of(layout, params, int(layout.nodes().size()) - 1);
  return *std::max_element(w.v.begin(), w.v.end());
}

}  // namespace mms::materials
