// SPDX-License-Identifier: Apache-2.0
// The table of lobes and what a Layout makes of it.
#include <doctest/doctest.h>

#include "materials/weight.h"
#include "tests/unit/materials/make.h"

using namespace mms;
using namespace mms::test;
using materials::Layout;

TEST_CASE("rows are complete and in order") {
  const auto rows = materials::rows();
  REQUIRE(int(rows.size()) == materials::kLobeCount);
  for (int i = 0; i < int(rows.size()); ++i) {
    CHECK(rows[i].lobe == i);
    CHECK(rows[i].signature.starts_with("material "));
    CHECK(rows[i].module == "materials");
    CHECK(rows[i].doc.ends_with("."));
    CHECK(!rows[i].example.empty());
    CHECK((rows[i].f32 == nullptr));
    const unsigned t = materials::traits(Lobe(i));
    const auto& f = materials::formals(Lobe(i));
    int numbers = 0;
    for (char kind : std::string_view(f.kinds, f.count))
      numbers += kind == 's' ? kWavelengths : kind == 'r';
    CHECK(numbers <= materials::kMostNumbers);
    const bool takes_material =
        std::string_view(f.kinds, f.count).find('m') != std::string_view::npos;
    CHECK(takes_material == ((t & materials::Combiner) != 0));
  }
}

TEST_CASE("formals are read off the signature") {
  const auto kinds = [](Lobe l) {
    const auto& f = materials::formals(l);
    return std::string(f.kinds, f.count);
  };
  CHECK(kinds(Lobe::Conductor) == "ssrr");
  CHECK(kinds(Lobe::Dielectric) == "srssr");
  CHECK(kinds(Lobe::Mix) == "mms");
  CHECK(kinds(Lobe::Isotropic) == "");
  CHECK(kinds(Lobe::Scale) == "ms");
  CHECK(kinds(Lobe::Turn) == "mr");
  CHECK(kinds(Lobe::Tilt) == "mrr");
  CHECK(kinds(Lobe::Glossy) == "sr");
}

TEST_CASE("layout offsets and flags") {
  const Material m = mix(glossy(0.5, 30), dielectric(1.5, 0.2), 0.25);
  const Layout l = m.layout();
  REQUIRE(l.nodes().size() == 3);
  CHECK(l.nodes()[0].first_param == 0);
  CHECK(l.nodes()[1].first_param == kWavelengths + 1);
  CHECK(l.nodes()[2].first_param == 4 * kWavelengths + 3);
  CHECK(l.param_count() == 5 * kWavelengths + 3);
  CHECK(l.param_count() == int(m.numbers.size()));
  CHECK(l.nodes()[2].children[1] == 1);
  CHECK(l.has_specular());
  CHECK(l.has_smooth());
  CHECK(l.transmits());
  CHECK(l.reflects());
  CHECK(!l.phase());

  const Layout plain = matte(0.5).layout();
  CHECK(!plain.has_specular());
  CHECK(!plain.transmits());
  const Layout polished = mirror(1).layout();
  CHECK(!polished.has_smooth());
  CHECK(Layout().empty());
}

TEST_CASE("stated weights: sums add, mixtures lie between their parts, what has no colour is 0") {
  const auto weight = [](const Material& m) {
    return materials::stated_weight(m.layout(), m.params<float>().data());
  };
  Spectrum<double> green(0.25);
  green[1] = 0.5;
  CHECK(weight(matte(0.5)) == 0.5f);
  CHECK(weight(matte(green)) == 0.5f);
  CHECK(weight(add(matte(0.75), mirror(green))) == 1.25f);
  CHECK(weight(scale(add(matte(1), mirror(1)), 0.25)) == 0.5f);
  CHECK(weight(scale(matte(1), 3)) == 1);  // factors are held to [0, 1]
  CHECK(weight(mix(matte(1.5), matte(0.5), 0.75)) == 0.75f);
  CHECK(weight(fresnel_mix(matte(0.5), mirror(0.25), 1.5)) == 0.25f);
  CHECK(weight(turn(add(matte(0.75), mirror(1)), 0.5)) == 1.75f);
  CHECK(weight(tilt(add(matte(0.75), mirror(1)), 0.5, 0)) == 1.75f);
  CHECK(weight(dielectric(1.5)) == 1);
  CHECK(weight(dielectric(1.5, 0.3, 0.75, 0.5)) == 0.5f);
  CHECK(weight(glossy_refraction(0.7, {60, 20}, 1.5)) == 1.5f);
  CHECK(weight(conductor(0.2, 3.4, 0.3)) == 0);
  CHECK(materials::stated_weight(Layout(), nullptr) == 0);
}
