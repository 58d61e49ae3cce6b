// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/materials/make.h"

#include <cmath>
#include <utility>

namespace mms::test {
namespace {

/// The same material, whose wavelength `k` is what `from(k)` was.
template <class From>
Material with_wavelengths(const Material& m, From from) {
  Material r = m;
  std::size_t at = 0;
  for (const vm::LayoutNode& n : m.tree.nodes) {
    const auto& f = materials::formals(static_cast<Lobe>(n.lobe));
    for (int i = 0; i < f.count; ++i) {
      if (f.kinds[i] == 's') {
        for (int k = 0; k < kWavelengths; ++k) r.numbers[at + k] = m.numbers[at + from(k)];
        at += kWavelengths;
      } else if (f.kinds[i] == 'r') {
        ++at;
      }
    }
  }
  return r;
}

}  // namespace

void append(Material& m, const Material& child) {
  const auto shift = static_cast<std::uint32_t>(m.tree.nodes.size());
  for (vm::LayoutNode node : child.tree.nodes) {
    for (auto& c : node.children) c += shift;
    m.tree.nodes.push_back(node);
  }
  m.numbers.insert(m.numbers.end(), child.numbers.begin(), child.numbers.end());
}

Material node(Lobe lobe, std::vector<Material> children, std::vector<Value> spectra,
              std::vector<double> reals) {
  Material m;
  vm::LayoutNode n;
  n.lobe = static_cast<int>(lobe);
  for (const Material& child : children) {
    append(m, child);
    n.children.push_back(static_cast<std::uint32_t>(m.tree.nodes.size() - 1));
  }
  n.params.resize(spectra.size() + reals.size());
  for (const Value& v : spectra) m.numbers.insert(m.numbers.end(), v.s.v.begin(), v.s.v.end());
  m.numbers.insert(m.numbers.end(), reals.begin(), reals.end());
  m.tree.nodes.push_back(n);
  return m;
}

Material matte(Value c) { return node(Lobe::Matte, {}, {c}); }

Material translucent(Value c) { return node(Lobe::Translucent, {}, {c}); }

Material glossy(Value c, double gloss) { return node(Lobe::Glossy, {}, {c}, {gloss}); }

Material tinted(Lobe lobe, Value c, std::vector<double> reals) {
  return node(lobe, {}, {c}, std::move(reals));
}

Material film_conductor(Value n, Value k, Value film, double thickness, Value wavelength,
                        double roughness) {
  Material m = node(Lobe::FilmConductor, {}, {n, k, film}, {thickness});
  m.tree.nodes.back().params.resize(7);
  m.numbers.insert(m.numbers.end(), wavelength.s.v.begin(), wavelength.s.v.end());
  m.numbers.insert(m.numbers.end(), {roughness, 0.0});
  return m;
}

Material film_dielectric(Value ior, Value film, double thickness, Value wavelength,
                         double roughness, Value reflected, Value transmitted, double anisotropy) {
  Material m = node(Lobe::FilmDielectric, {}, {ior, film}, {thickness});
  m.tree.nodes.back().params.resize(8);
  const auto put = [&m](const Value& v) {
    m.numbers.insert(m.numbers.end(), v.s.v.begin(), v.s.v.end());
  };
  put(wavelength);
  m.numbers.push_back(roughness);
  put(reflected);
  put(transmitted);
  m.numbers.push_back(anisotropy);
  return m;
}

Material coat(Material top, Material base, double thickness, Value absorption, Value ior) {
  Material m = node(Lobe::Coat, {top, base}, {}, {thickness});
  m.tree.nodes.back().params.resize(3);
  m.numbers.insert(m.numbers.end(), absorption.s.v.begin(), absorption.s.v.end());
  m.numbers.insert(m.numbers.end(), ior.s.v.begin(), ior.s.v.end());
  return m;
}

Material microfacet(Value c, double roughness, double anisotropy) {
  return node(Lobe::Microfacet, {}, {c}, {roughness, anisotropy});
}

Material beckmann(Value c, double roughness, double anisotropy) {
  return node(Lobe::Beckmann, {}, {c}, {roughness, anisotropy});
}

Material conductor(Value n, Value k, double roughness, double anisotropy) {
  return node(Lobe::Conductor, {}, {n, k}, {roughness, anisotropy});
}

Material coloured_metal(Value facing, Value edge, double roughness) {
  return node(Lobe::ColouredMetal, {}, {facing, edge}, {roughness, 0});
}

Material mirror(Value c) { return node(Lobe::Mirror, {}, {c}); }

Material refraction(Value ior, Value c) { return node(Lobe::Refraction, {}, {ior, c}); }
Material glossy_refraction(Value ior, std::vector<double> gloss, Value c) {
  return node(Lobe::GlossyRefraction, {}, {ior, c}, std::move(gloss));
}

Material interface(Lobe lobe, Value ior, double number, Value r, Value t) {
  Material m = node(lobe, {}, {ior}, {number});
  m.tree.nodes.back().params.resize(4);
  m.numbers.insert(m.numbers.end(), r.s.v.begin(), r.s.v.end());
  m.numbers.insert(m.numbers.end(), t.s.v.begin(), t.s.v.end());
  return m;
}

Material dielectric(Value ior, double roughness, Value r, Value t, double anisotropy, Lobe lobe) {
  Material m = interface(lobe, ior, roughness, r, t);
  m.tree.nodes.back().params.resize(5);
  m.numbers.push_back(anisotropy);
  return m;
}

Material beckmann_dielectric(Value ior, double roughness, Value r, Value t, double anisotropy) {
  return dielectric(ior, roughness, r, t, anisotropy, Lobe::BeckmannDielectric);
}

Material phong_glass(Value ior, double n, Value r, Value t) {
  return interface(Lobe::PhongGlass, ior, n, r, t);
}

Material slab(Value ior, double thickness, Value absorption) {
  Material m = node(Lobe::Slab, {}, {ior}, {thickness});
  m.tree.nodes.back().params.resize(3);
  m.numbers.insert(m.numbers.end(), absorption.s.v.begin(), absorption.s.v.end());
  return m;
}

Material isotropic() { return node(Lobe::Isotropic, {}, {}); }

Material rayleigh_phase() { return node(Lobe::RayleighPhase, {}, {}); }

Material draine(double g, double a) { return node(Lobe::Draine, {}, {}, {g, a}); }

Material henyey_greenstein(double g) { return node(Lobe::HenyeyGreenstein, {}, {}, {g}); }

Material mix(Material a, Material b, Value t) { return node(Lobe::Mix, {a, b}, {t}); }

Material film_mix(Material base, Material coat, Value ior, Value film, double thickness,
                  Value wavelength) {
  Material m = node(Lobe::FilmMix, {base, coat}, {ior, film}, {thickness});
  m.tree.nodes.back().params.resize(4);
  m.numbers.insert(m.numbers.end(), wavelength.s.v.begin(), wavelength.s.v.end());
  return m;
}

Material fresnel_mix(Material base, Material coat, Value ior) {
  return node(Lobe::FresnelMix, {base, coat}, {ior});
}

Material scale(Material a, Value t) { return node(Lobe::Scale, {a}, {t}); }

Material layer(Material top, Material base, double weight) {
  return node(Lobe::Layer, {top, base}, {}, {weight});
}

Material turn(Material a, double angle) { return node(Lobe::Turn, {a}, {}, {angle}); }

Material tilt(Material a, double u, double v) { return node(Lobe::Tilt, {a}, {}, {u, v}); }

Material add(Material a, Material b) { return node(Lobe::Add, {a, b}, {}); }

double value(const Material& m, Vec3d o, Vec3d i, materials::Mode mode) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  return materials::Bsdf<double>(layout, p.data()).eval(o, i, mode)[0];
}

Vec3d direction(double degrees, double phi) {
  const double a = degrees * kPi<double> / 180;
  return {std::sin(a) * std::cos(phi), std::sin(a) * std::sin(phi), std::cos(a)};
}

Material with_hero(const Material& m, int j) {
  return with_wavelengths(m, [j](int k) { return (k + j) % kWavelengths; });
}

Material hero_only(const Material& m) {
  return with_wavelengths(m, [](int) { return 0; });
}

}  // namespace mms::test
