// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/materials/cases.h"

#include <utility>

namespace mms::test {

namespace {

Material facets(double roughness) { return microfacet(1, roughness); }

}  // namespace

Spectrum<double> ramp(double first, double last) {
  Spectrum<double> s;
  for (int j = 0; j < kWavelengths; ++j) s[j] = first + (last - first) * j / (kWavelengths - 1);
  return s;
}

std::vector<Case> smooth_cases() {
  std::vector<Case> c;
  const auto put = [&](const char* name, Material m) { c.push_back({name, std::move(m)}); };
  const auto lossless = [&](const char* name, Material m) {
    c.push_back({name, std::move(m), true});
  };
  lossless("matte", matte(1));
  put("translucent", translucent(ramp(0.2, 0.9)));
  for (double gloss : {0.0, 0.5, 4.0, 40.0, 1000.0}) lossless("glossy", glossy(1, gloss));
  put("glossy_product", tinted(Lobe::GlossyProduct, ramp(0.3, 0.8), {20, 60}));
  lossless("glossy_product, latitude alone", tinted(Lobe::GlossyProduct, 1, {30, 0}));
  lossless("glossy_product, longitude alone", tinted(Lobe::GlossyProduct, 1, {0, 30}));
  lossless("glossy_back", tinted(Lobe::GlossyBack, 1, {200, 200}));
  lossless("glossy_through", tinted(Lobe::GlossyThrough, 1, {15, 100}));
  lossless("glossy_refraction", glossy_refraction(1.5, {15, 100}));
  lossless("glossy_refraction, dispersive", glossy_refraction(ramp(1.45, 1.3), {8, 10}));
  for (double sigma : {0.1, 0.8}) put("oren_nayar", tinted(Lobe::OrenNayar, 0.7, {sigma}));
  for (double r : {0.2, 1.0}) lossless("rough_matte", tinted(Lobe::RoughMatte, 1, {r}));
  put("rough_matte, coloured", tinted(Lobe::RoughMatte, ramp(0.2, 0.9), {0.6}));
  for (double n : {0.0, 2.5, 200.0}) {
    put("phong", tinted(Lobe::Phong, 1, {n}));
    put("max_phong", tinted(Lobe::MaxPhong, ramp(0.3, 1), {n}));
  }
  put("spot", tinted(Lobe::Spot, 1, {0.2, 0.5}));
  put("ward 0.2", tinted(Lobe::Ward, 1, {0.2, 0}));
  put("ward 0.7, anisotropic", tinted(Lobe::Ward, ramp(0.3, 1), {0.7, 0.8}));
  put("ashikhmin_shirley", tinted(Lobe::AshikhminShirley, ramp(0.1, 0.9), {100, 10}));
  put("ashikhmin_shirley, round", tinted(Lobe::AshikhminShirley, 1, {3, 3}));
  for (double r : {0.15, 0.8}) put("sheen", tinted(Lobe::Sheen, 1, {r}));
  lossless("microfacet 0.1", microfacet(1, 0.1));
  put("microfacet 0.5", microfacet(ramp(0.3, 0.8), 0.5));
  lossless("microfacet 1", microfacet(1, 1));
  lossless("microfacet anisotropic", microfacet(1, 0.5, 0.8));
  lossless("microfacet anisotropic across", microfacet(1, 0.4, -0.5));
  lossless("beckmann 0.1", beckmann(1, 0.1));
  put("beckmann 0.5", beckmann(ramp(0.3, 0.8), 0.5));
  lossless("beckmann 1", beckmann(1, 1));
  lossless("beckmann anisotropic", beckmann(1, 0.5, 0.8));
  put("conductor", conductor(ramp(0.2, 1.3), ramp(3.4, 2.1), 0.3));
  put("coloured_metal", coloured_metal(ramp(0.9, 0.3), ramp(0.2, 1), 0.4));
  lossless("dielectric 1.5, 0.3", dielectric(1.5, 0.3));
  lossless("dielectric dispersive, 0.5", dielectric(ramp(1.6, 1.4), 0.5));
  lossless("dielectric 1.1, 0.8", dielectric(1.1, 0.8));
  put("dielectric 2.5, 0.6, tinted", dielectric(2.5, 0.6, 0.5, ramp(0.2, 0.8)));
  put("phong_glass 1.5, 3", phong_glass(1.5, 3));
  put("phong_glass dispersive, 1000", phong_glass(ramp(1.35, 1.2), 1000));
  put("phong_glass 0.6, 40, tinted", phong_glass(0.6, 40, 0.5, ramp(0.2, 0.8)));
  put("film_conductor", film_conductor(2.5, ramp(3, 4), 1.5, 400e-9, ramp(400e-9, 700e-9), 0.4));
  put("coat absorbing", coat(glossy(1, 40), matte(ramp(0.9, 0.5)), 0.5, ramp(0.1, 2), 1.5));
  put("coat over facets", coat(mirror(1), conductor(ramp(0.2, 1.3), ramp(3.4, 2.1), 0.4), 0.2,
                               ramp(0.1, 1), ramp(1.6, 1.4)));
  put("coat of stretched facets",
      coat(scale(microfacet(1, 0.5, 0.8), ramp(1, 0.6)),
           mix(matte(ramp(0.2, 0.8)), glossy(1, 20), 0.3), 0.2, ramp(0.1, 1), ramp(1.6, 1.4)));
  put("layer", layer(tinted(Lobe::Sheen, ramp(0.3, 0.9), {0.4}),
                     fresnel_mix(matte(0.8), glossy(1, 40), 1.5), 0.7));
  put("mix", mix(matte(ramp(0.1, 0.9)), glossy(1, 20), ramp(0.2, 0.7)));
  put("coat of several lobes over stretched facets",
      coat(mix(scale(beckmann(1, 0.4, -0.6), ramp(1, 0.7)), glossy(1, 40), 0.4),
           conductor(ramp(0.2, 1.3), ramp(3.4, 2.1), 0.5, 0.7), 0.1, ramp(0.1, 2), ramp(1.6, 1.4)));
  put("turned facets under a turned coat",
      turn(coat(microfacet(1, 0.4, 0.7), turn(beckmann(ramp(0.9, 0.5), 0.5, -0.8), 0.7), 0, 0, 1.5),
           -0.4));
  put("tilted parts under a rough coat",
      coat(microfacet(1, 0.4),
           mix(tilt(matte(ramp(0.3, 0.9)), 0.4, -0.2),
               tilt(conductor(ramp(0.2, 1.3), ramp(3.4, 2.1), 0.4, 0.5), -0.3, 0.2), 0.4),
           0.2, ramp(0.1, 1), 1.5));
  put("tilted coat over rough glass, on a matte",
      mix(tilt(coat(microfacet(ramp(0.9, 1), 0.5), dielectric(ramp(1.6, 1.4), 0.6), 0, 0, 1.3), 0.2,
               0.3),
          matte(0.7), 0.3));
  put("three coats",
      coat(glossy(1, 100),
           coat(microfacet(1, 0.4, 0.5),
                fresnel_mix(microfacet(0.8, 0.5), glossy(1, 40), ramp(1.3, 1.5)), 0, 0, 1.4),
           0.2, ramp(0.1, 2), ramp(1.6, 1.4)));
  put("coats, a lower index below",
      coat(mirror(1), coat(microfacet(1, 0.4), matte(0.8), 0.2, ramp(0.1, 2), 0.8), 0, 0, 1.5));
  put("film_dielectric, rough", film_dielectric(ramp(1.6, 1.4), ramp(1.3, 1.4), 300e-9,
                                                ramp(400e-9, 700e-9), 0.4, 0.8, ramp(0.5, 1)));
  put("film_dielectric, stretched, of a low index",
      film_dielectric(0.7, 2.2, 400e-9, ramp(400e-9, 700e-9), 0.6, 1, 1, 0.7));
  put("coat", fresnel_mix(matte(0.8), glossy(1, 40), ramp(1.6, 1.4)));
  put("coat of facets", fresnel_mix(matte(0.8), microfacet(1, 0.4), ramp(1.6, 1.4)));
  put("coat over rough matte",
      fresnel_mix(tinted(Lobe::RoughMatte, 0.8, {0.5}), glossy(1, 9), 1.5));
  put("coat of mirror", fresnel_mix(matte(0.8), mirror(1), 1.5));
  put("film over plastic",
      film_mix(matte(0.8), microfacet(1, 0.4), 1.5, ramp(1.3, 1.4), 400e-9, ramp(400e-9, 700e-9)));
  put("film between coats", coat(mirror(1),
                                 film_mix(mix(matte(0.8), microfacet(1, 0.5), 0.4), glossy(1, 30),
                                          ramp(1.3, 1.5), 2, 200e-9, ramp(400e-9, 700e-9)),
                                 0.2, ramp(0.1, 2), 1.6));
  put("nested", add(scale(fresnel_mix(mix(matte(0.5), translucent(ramp(0.1, 0.5)), 0.4),
                                      microfacet(1, 0.4), 1.8),
                          ramp(1, 0.5)),
                    scale(mirror(1), 0.1)));
  lossless("dielectric anisotropic", dielectric(1.5, 0.4, 1, 1, 0.8));
  put("dielectric anisotropic across, dispersive",
      dielectric(ramp(1.6, 1.4), 0.6, ramp(0.5, 1), 0.8, -0.5));
  lossless("beckmann_dielectric 1.5, 0.3", beckmann_dielectric(1.5, 0.3));
  lossless("beckmann_dielectric dispersive, 0.5", beckmann_dielectric(ramp(1.6, 1.4), 0.5));
  lossless("beckmann_dielectric 1.1, 0.8", beckmann_dielectric(1.1, 0.8));
  put("beckmann_dielectric 2.5, 0.6, tinted", beckmann_dielectric(2.5, 0.6, 0.5, ramp(0.2, 0.8)));
  lossless("beckmann_dielectric 0.8, 1", beckmann_dielectric(0.8, 1));
  lossless("beckmann_dielectric anisotropic", beckmann_dielectric(1.5, 0.4, 1, 1, 0.8));
  put("beckmann_dielectric anisotropic across, dispersive",
      beckmann_dielectric(ramp(1.6, 1.4), 0.6, ramp(0.5, 1), 0.8, -0.5));
  lossless("coat over glass", coat(mirror(1), dielectric(1.5, 0.3), 0, 0, 1.5));
  put("coat over dispersive glass, absorbing",
      coat(mirror(ramp(0.6, 1)), dielectric(ramp(1.6, 1.4), 0.5, ramp(0.5, 1), ramp(1, 0.6)), 0.2,
           ramp(0.1, 1), ramp(1.4, 1.7)));
  put("coat over a mixture with glass",
      fresnel_mix(mix(matte(0.8), scale(beckmann_dielectric(1.3, 0.6, 1, 1, 0.5), ramp(1, 0.7)),
                      ramp(0.2, 0.9)),
                  microfacet(1, 0), 2.2));
  lossless("coat over glass of a lower index", coat(mirror(1), dielectric(0.7, 0.4), 0, 0, 1.5));
  lossless(
      "coat over filmed glass of a lower index",
      coat(mirror(1), film_dielectric(0.7, 2.2, 400e-9, ramp(400e-9, 700e-9), 0.4), 0, 0, 1.5));
  put("coat over phong_glass of a lower index",
      coat(microfacet(1, 0.4), phong_glass(ramp(0.6, 0.8), 30), 0, 0, 1.5));
  lossless("coat over glossy_refraction of a lower index",
           coat(microfacet(1, 0.4), glossy_refraction(ramp(0.6, 0.8), {30, 10}), 0, 0, 1.5));
  put("rough coat over stretched glass of a lower index",
      coat(microfacet(ramp(0.9, 1), 0.5), dielectric(ramp(0.6, 0.8), 0.5, 1, 1, 0.6), 0, 0, 1.4));
  put("rough coat over rough glass",
      coat(microfacet(ramp(0.9, 1), 0.5), dielectric(ramp(1.6, 1.4), 0.6, ramp(0.5, 1)), 0.2,
           ramp(0.1, 1), ramp(1.4, 1.7)));
  put("rough coat over a mixture with glass of stretched facets",
      fresnel_mix(mix(matte(0.8), beckmann_dielectric(1.3, 0.5, 1, 1, 0.7), ramp(0.4, 0.9)),
                  mix(mirror(1), glossy(1, 10), 0.7), 1.8));
  put("rough coats over glass",
      coat(microfacet(1, 0.4, 0.5), fresnel_mix(dielectric(1.5, 0.4), beckmann(1, 0.7), 1.3), 0.1,
           ramp(0.1, 1), 1.7));
  lossless("two coats over glass",
           coat(mirror(1), fresnel_mix(dielectric(1.5, 0.4), mirror(1), 1.3), 0, 0, 1.7));
  put("rough coat over rough glass under a film",
      coat(microfacet(ramp(0.9, 1), 0.5),
           film_dielectric(ramp(1.6, 1.4), 1.9, 350e-9, ramp(400e-9, 700e-9), 0.5, ramp(0.5, 1), 1,
                           0.4),
           0.2, ramp(0.1, 1), 1.4));
  put("film over rough glass",
      film_mix(dielectric(ramp(1.6, 1.4), 0.5), microfacet(ramp(0.9, 1), 0.4), 1.3, 1.8, 300e-9,
               ramp(400e-9, 700e-9)));
  put("rough coat over phong_glass",
      coat(microfacet(ramp(0.9, 1), 0.5), phong_glass(1.5, 40, ramp(0.5, 1)), 0.2, ramp(0.1, 1),
           1.4));
  lossless("coat over glossy_through",
           coat(mirror(1), tinted(Lobe::GlossyThrough, 1, {15, 40}), 0, 0, ramp(1.4, 1.6)));
  lossless("coat over glossy_refraction",
           coat(mirror(1), glossy_refraction(1.5, {15, 100}), 0, 0, 1.5));
  put("rough coat over a mixture with dispersive glossy_refraction",
      coat(microfacet(ramp(0.9, 1), 0.5),
           mix(glossy_refraction(ramp(1.45, 1.3), {8, 10}), dielectric(1.4, 0.3), ramp(0.2, 0.7)),
           0.2, ramp(0.1, 1), 1.5));
  lossless(
      "two coats over glossy_refraction",
      coat(facets(0.4), coat(mirror(1), glossy_refraction(ramp(1.45, 1.3), {8, 10}), 0, 0, 1.3), 0,
           0, 1.7));
  return c;
}

std::vector<Case> lossless_cases() {
  std::vector<Case> c = smooth_cases();
  std::erase_if(c, [](const Case& one) { return !one.lossless; });
  const auto put = [&](const char* name, Material m) { c.push_back({name, std::move(m), true}); };
  put("translucent, white", translucent(1));
  put("glossy, m = 1e4", glossy(1, 5000));
  put("glossy_product, white", tinted(Lobe::GlossyProduct, 1, {20, 60}));
  put("glossy_product, wider along", tinted(Lobe::GlossyProduct, 1, {200, 3}));
  put("glossy_back, wide", tinted(Lobe::GlossyBack, 1, {5, 9}));
  put("glossy_through, narrow", tinted(Lobe::GlossyThrough, 1, {200, 200}));
  put("glossy_refraction of a low index", glossy_refraction(0.5, {5, 9}));
  put("microfacet 0.5, white", facets(0.5));
  put("beckmann 0.5, white", beckmann(1, 0.5));
  put("conductor, k 1e25", conductor(1, 1e25, 0.3));
  put("conductor, n 0", conductor(0, ramp(3.4, 2.1), 0.3));  // a plasma: nothing enters
  put("coloured_metal, white", coloured_metal(1, 1, 0.4));
  put("film_conductor, n 0", film_conductor(0, ramp(3, 4), 1.5, 400e-9, ramp(400e-9, 700e-9), 0.4));
  put("mix of reflection and transmission",
      mix(mix(matte(1), glossy(1, 20), ramp(0.2, 0.7)), translucent(1), ramp(0.4, 0.1)));
  put("coat, white", fresnel_mix(matte(1), glossy(1, 40), ramp(1.6, 1.4)));
  put("coat of facets, white", fresnel_mix(matte(1), facets(0.4), ramp(1.6, 1.4)));
  put("coat of mirror, white", fresnel_mix(matte(1), mirror(1), 1.5));
  put("film over facets, white",
      film_mix(facets(0.6), facets(0.4), ramp(1.6, 1.4), 1.8, 400e-9, ramp(400e-9, 700e-9)));
  put("film of mirror over matte, white",
      film_mix(matte(1), mirror(1), 1.5, 1.38, 600e-9, ramp(400e-9, 700e-9)));
  put("coat over rough matte, white",
      fresnel_mix(tinted(Lobe::RoughMatte, 1, {0.5}), glossy(1, 9), 1.5));
  put("coat over facets, white", coat(mirror(1), conductor(1, 1e25, 0.4), 0.2, 0, ramp(1.6, 1.4)));
  put("coat of stretched facets, white",
      coat(microfacet(1, 0.5, 0.5), mix(matte(1), glossy(1, 20), 0.3), 0.2, 0, ramp(1.6, 1.4)));
  put("three coats, white",
      coat(glossy(1, 100),
           coat(microfacet(1, 0.4, 0.5), fresnel_mix(facets(0.5), glossy(1, 40), ramp(1.3, 1.5)), 0,
                0, 1.4),
           0.2, 0, ramp(1.6, 1.4)));
  put("dielectric 2.5, 0.6, white", dielectric(2.5, 0.6));
  put("beckmann_dielectric 2.5, 0.6, white", beckmann_dielectric(2.5, 0.6));
  put("dielectric anisotropic across, white", dielectric(ramp(1.6, 1.4), 0.6, 1, 1, -0.5));
  put("rough coat over rough glass, white",
      coat(facets(0.5), beckmann_dielectric(ramp(1.6, 1.4), 0.6), 0.2, 0, ramp(1.4, 1.7)));
  put("mirror", mirror(1));
  put("microfacet, polished", facets(0));
  put("conductor, polished, n 0", conductor(0, ramp(3.4, 2.1)));
  put("glossy_through, polished", tinted(Lobe::GlossyThrough, 1, {1e9, 1e9}));
  put("refraction", refraction(1.5));
  put("glossy_refraction, polished", glossy_refraction(1.5, {1e9, 1e9}));
  put("dielectric, polished", dielectric(1.5));
  put("phong_glass, polished", phong_glass(0.6, 1e9));
  put("slab", slab(ramp(1.6, 1.4), 0.1));
  put("film_dielectric", film_dielectric(1.5, 1.38, 100e-9, ramp(400e-9, 700e-9)));
  put("film_dielectric of a high index, seen through",
      film_dielectric(0.7, 2.2, 400e-9, ramp(400e-9, 700e-9)));
  return c;
}

}  // namespace mms::test
