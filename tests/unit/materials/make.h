// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Materials for tests, written as expressions: a layout and its flat array of numbers.

#include <vector>

#include "materials/bsdf.h"
#include "materials/layout.h"

namespace mms::test {

using materials::Lobe;

struct Material {
  vm::MaterialLayout tree;
  std::vector<double> numbers;

  materials::Layout layout() const { return materials::Layout(tree); }
  template <class R>
  std::vector<R> params() const {
    return std::vector<R>(numbers.begin(), numbers.end());
  }
};

/// A spectrum argument: a number, or one for each wavelength.
struct Value {
  Spectrum<double> s;
  Value(double x) : s(x) {}
  Value(const Spectrum<double>& x) : s(x) {}
};

/// Puts the nodes and numbers of another material behind those of `m`.
void append(Material& m, const Material& child);

/// `spectra` then `reals` must be the formal order of the lobe but for Dielectric, see below.
Material node(Lobe lobe, std::vector<Material> children, std::vector<Value> spectra,
              std::vector<double> reals = {});

Material matte(Value c);
Material translucent(Value c);
Material glossy(Value c, double gloss);
/// A model of a colour and real numbers.
Material tinted(Lobe lobe, Value c, std::vector<double> reals);
Material film_conductor(Value n, Value k, Value film, double thickness, Value wavelength,
                        double roughness);
Material film_dielectric(Value ior, Value film, double thickness, Value wavelength,
                         double roughness = 0, Value reflected = 1, Value transmitted = 1,
                         double anisotropy = 0);
Material coat(Material top, Material base, double thickness, Value absorption, Value ior);
Material microfacet(Value c, double roughness, double anisotropy = 0);
Material beckmann(Value c, double roughness, double anisotropy = 0);
Material conductor(Value n, Value k, double roughness = 0, double anisotropy = 0);
Material coloured_metal(Value facing, Value edge, double roughness);
Material mirror(Value c);
Material refraction(Value ior, Value c = 1);
Material glossy_refraction(Value ior, std::vector<double> gloss, Value c = 1);
/// An interface: index, a number, two tints.
Material interface(Lobe lobe, Value ior, double number, Value r, Value t);
Material dielectric(Value ior, double roughness = 0, Value r = 1, Value t = 1,
                    double anisotropy = 0, Lobe lobe = Lobe::Dielectric);
Material beckmann_dielectric(Value ior, double roughness = 0, Value r = 1, Value t = 1,
                             double anisotropy = 0);
Material phong_glass(Value ior, double n, Value r = 1, Value t = 1);
Material slab(Value ior, double thickness = 0, Value absorption = 0);
Material isotropic();
Material rayleigh_phase();
Material draine(double g, double a);
Material henyey_greenstein(double g);
Material mix(Material a, Material b, Value t);
Material fresnel_mix(Material base, Material coat, Value ior);
Material film_mix(Material base, Material coat, Value ior, Value film, double thickness,
                  Value wavelength);
Material scale(Material a, Value t);
Material layer(Material top, Material base, double weight = 1);
Material turn(Material a, double angle);
Material tilt(Material a, double u, double v);
Material add(Material a, Material b);

/// f of the hero between two directions.
double value(const Material& m, Vec3d o, Vec3d i, materials::Mode mode = materials::Mode::Radiance);

/// Direction `degrees` from +z (above 90: inside), at azimuth `phi` in radians.
Vec3d direction(double degrees, double phi);

/// Wavelengths rotated so that wavelength `j` is the hero.
Material with_hero(const Material& m, int j);

/// Every wavelength as the hero: what the hero alone decides, without working out the others.
Material hero_only(const Material& m);

}  // namespace mms::test
