// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a coat does to light along a direction of |cosine| z. It reflects E and lets T = 1 - E
/// through, and E is a sum of what does not depend on the direction, of Fresnel's reflectance F,
/// and of L, F at a cosine that is held up from 0:
///
///   E = level + steep F(z) + held L(z),   L(z) = F(sqrt(0.09 + 0.91 z^2))
///
/// as rough interfaces reflect less towards grazing, whose facets meet light at many angles. A
/// mirror reflects F. Facets have
///
///   E = (1 - s) F + s ((1 - u) L + u m),   s = 1 - exp(-7 alpha^0.75),   u = 0.35 alpha
///
/// with m the mean of F over the hemisphere and alpha the geometric mean of both: fitted to the
/// first bounce of interfaces, and so that highlights near the normal are as bright as F times the
/// facets there. `glossy` counts as the facets that are as wide. Of several lobes all shares are
/// means by their weights.
///
/// Under a film (`film_mix`) F is what interface and film reflect, which rises and falls.
///
/// A coat below another is met by light that this one has refracted, whose cosine is at least b =
/// sqrt(1 - 1 / index^2) however far outside it grazes. There F rises no further than F(b): so much
/// of F becomes L that it is that at grazing, and where L rises further, so much of L does not
/// depend on the direction. Right above interfaces, as of glass, a coat is met as from outside.

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

#include "base/quadrature.h"
#include "base/spectrum.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"
#include "materials/thin_film.h"

namespace mms::materials {

/// Of E, how much is L and how much is m; the rest is F.
template <class R>
struct Broadness {
  R held{}, even{};

  bool mirror() const { return held == 0; }
  /// Of facets, from the geometric mean of both alphas. s is below 1, so that E is above 0.
  static Broadness facets(R alpha) {
    const R root = std::sqrt(alpha), s = -std::expm1(-7 * (root * std::sqrt(root))),
            u = R(0.35) * alpha;
    return {s * (1 - u), s * u};
  }
};

/// Alpha of the facets that are as wide as `glossy`.
template <class R>
inline R glossy_as_facets(R gloss) {
  return 1 / std::sqrt(1 + 2 * gloss);
}

/// Calls `visit(z, weight)` for the points of `parts` rules of eight for the mean over the
/// hemisphere, z the |cosine|. They are dense towards grazing.
template <class Visit>
inline void for_each_on_hemisphere(int parts, const Visit& visit) {
  for (int k = 0; k < parts; ++k)
    for (int i = 0; i < 8; ++i) {
      const double u = (k + gauss<8>().x[i]) / parts, z = u * u * u;
      visit(z, 6 * u * u * z * gauss<8>().w[i] / parts);
    }
}

template <class R>
class FacesAlong;

/// What a coat reflects by: an interface, or one under a film. More fringes than one, and those of
/// films of more than two waves of where the index is 1, fade to the mean of films of all
/// thicknesses: few points see what E and T are (materials/under_coats.h), and films of that
/// thickness, which is not even to a wave, look so.
template <class R>
struct Face {
  R eta{1};  ///< index below over index above
  Film<R> film{};

  Face(R index, const Film<R>& above = {}) : eta(index), film(above) {}

  R contrast() const { return faded(std::max(film.fringes - 1, film.waves() - 2)); }
  R reflected(R z) const { return FacesAlong<R>(z).split(*this).reflected; }
  /// Rules that see each fringe of a film that is left.
  int parts() const { return 4 + int(std::min(film.fringes, R(4))); }
};

/// Faces along one direction. Films of the same indices, as at most wavelengths, differ there by
/// their phases alone.
template <class R>
class FacesAlong {
 public:
  explicit FacesAlong(R z) : z_(z) {}

  FresnelSplit<R> split(const Face<R>& face) {
    if (!face.film.there()) return fresnel_split(z_, face.eta);
    if (!film_.is_of(face.film.ior, face.eta)) film_ = {{z_}, face.film.ior, face.eta};
    const auto e = film_.split(face.film.phases, face.contrast());
    return {e.reflected[0], e.transmitted[0]};
  }

 private:
  R z_;
  FilmAlong<R> film_;
};

/// Means of F over the hemisphere; of films by four points.
template <class R>
class FaceMeans {
 public:
  R operator()(const Face<R>& face) {
    if (!face.film.there()) return std::max(fresnel_dielectric_diffuse(face.eta), R(0));
    if (!films_.is_of(face.film.ior, face.eta)) {
      std::array<R, kPoints> z;
      for (int k = 0; k < kPoints; ++k) z[k] = R(std::sqrt(gauss<kPoints>().x[k]));
      films_ = {z, face.film.ior, face.eta};
    }
    const auto e = films_.split(face.film.phases, face.contrast());
    double sum = 0;
    for (int k = 0; k < kPoints; ++k) sum += gauss<kPoints>().w[k] * double(e.reflected[k]);
    return R(sum);
  }

 private:
  static constexpr int kPoints = 4;
  FilmAlong<R, kPoints> films_;
};

namespace held {
inline constexpr double kLeast = 0.3;  ///< the cosine at which L is F at grazing

template <class R>
inline R cosine(R z) {
  constexpr R least2 = R(kLeast * kLeast);
  return std::sqrt(least2 + (1 - least2) * z * z);
}
/// The mean of L over the hemisphere.
template <class R>
inline R mean(R eta) {
  constexpr double least2 = kLeast * kLeast;
  const auto at = [eta](double z) { return 2 * z * double(fresnel_dielectric(R(z), eta)); };
  return R((integrate<4>(at, kLeast, 0.5) + integrate<4>(at, 0.5, 1)) / (1 - least2));
}
}  // namespace held

/// What F and L of faces are along a direction of |cosine| z.
template <class R>
struct CoatDirection {
  FacesAlong<R> steep, held;

  explicit CoatDirection(R z) : steep(z), held(held::cosine(z)) {}
};

/// E and T of one face: level + steep F + held L, and the rest.
template <class R>
struct CoatShape {
  FresnelSplit<R> level{R(0), R(0)};
  R steep{1}, held{};

  CoatShape() = default;
  CoatShape(const Broadness<R>& broad, R mean)
      : level{broad.even * mean, broad.even * (1 - mean)},
        steep(1 - broad.held - broad.even),
        held(broad.held) {}
  bool operator==(const CoatShape& b) const {
    return level.reflected == b.level.reflected && steep == b.steep && held == b.held;
  }

  FresnelSplit<R> split(CoatDirection<R>& along, const Face<R>& face) const {
    FresnelSplit<R> e = level;
    const auto add = [&e](R share, const FresnelSplit<R>& f) {
      e.reflected += share * f.reflected;
      e.transmitted += share * f.transmitted;
    };
    if (steep != 0) add(steep, along.steep.split(face));
    if (held != 0) add(held, along.held.split(face));
    return e;
  }
  FresnelSplit<R> split(R z, const Face<R>& face) const {
    CoatDirection<R> along(z);
    return split(along, face);
  }

  /// The mean of E over the hemisphere, `mean` being that of F, which no film is part of.
  R mean(R mean, R eta) const {
    return level.reflected + steep * mean + (held != 0 ? held * held::mean(eta) : R(0));
  }

  /// Of a coat that light meets at cosines of at least `least`.
  CoatShape below(R least, const Face<R>& face) const {
    constexpr R held_least = R(held::kLeast);
    const R most = face.reflected(least), held_most = face.reflected(held_least);
    CoatShape to = *this;
    if (least < held_least) {
      to.steep = steep * limited((most - held_most) / (1 - held_most), R(0), R(1));
      to.held = held + (steep - to.steep);
      return to;
    }
    const FresnelSplit<R> normal = FacesAlong<R>(1).split(face);
    const R rises = held_most - normal.reflected;
    const R kept = rises > 0 ? limited((most - normal.reflected) / rises, R(0), R(1)) : R(0);
    to.steep = 0;
    to.held = kept * (steep + held);
    const R flat = (steep + held) - to.held;
    to.level.reflected += flat * normal.reflected;
    to.level.transmitted += flat * normal.transmitted;
    return to;
  }
};

/// A film at each wavelength.
template <class R>
using Films = std::array<Film<R>, kWavelengths>;

/// A coat at each wavelength. One of an index below 1 counts as one of the inverse, so that nothing
/// is reflected in full; light that has passed it is bent as the index says, but if nothing is
/// above it goes straight on.
template <class R>
struct CoatNumbers {
  Spectrum<R> eta{R(1)};  ///< index below over index above, or its inverse: at least 1
  Films<R> films;
  Spectrum<R> mean{};   ///< of F over the hemisphere; where a film is, if it matters
  Spectrum<R> least{};  ///< |cosine| at which light meets the coat, below others
  CoatShape<R> shape[kWavelengths];

  CoatNumbers() = default;
  CoatNumbers(const R* ior, const Films<R>& above, const Spectrum<R>& held, const Spectrum<R>& even,
              const Spectrum<R>& least_cosine)
      : films(above), least(least_cosine), held_(held), even_(even) {
    for (int j = 0; j < kWavelengths; ++j) {
      eta[j] = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      // Under a film an index of 1 is a coat like others; on one below there is no film.
      if (films[j].there() && eta[j] < 1 - kNextToOne) films[j] = {};
      if (films[j].there()) eta[j] = std::max(eta[j], 1 + kNextToOne);
      if (eta[j] < 1) {
        least[j] = std::sqrt(std::max(1 - bent_sine2(j), R(0)));
        eta[j] = 1 / eta[j];
        falls_.set(j);
      }
    }
    find_shapes();
  }

  Face<R> face(int j) const { return {eta[j], films[j]}; }
  /// Whether a film is part of it at some wavelength.
  bool filmed() const {
    return std::any_of(films.begin(), films.end(), [](const Film<R>& f) { return f.there(); });
  }

  bool operator==(const CoatNumbers& b) const {
    return eta.v == b.eta.v && films == b.films && least.v == b.least.v &&
           std::ranges::equal(shape, b.shape);
  }
  /// Whether wavelength j is as the one before.
  bool repeated(int j) const { return repeated_[j]; }

  /// What a lobe of the coat is at wavelength j.
  CoatShape<R> of(int j, const Broadness<R>& lobe) const {
    if (!(eta[j] > 1)) return {};
    const CoatShape<R> alone(lobe, mean[j]);
    return least[j] > 0 ? alone.below(least[j], face(j)) : alone;
  }
  /// The coat as if it were of that lobe alone.
  CoatNumbers as(const Broadness<R>& lobe) const {
    CoatNumbers to = *this;
    to.held_ = Spectrum<R>(lobe.held), to.even_ = Spectrum<R>(lobe.even);
    for (int j = 0; j < kWavelengths; ++j)
      to.shape[j] = repeated(j) ? to.shape[j - 1] : of(j, lobe);
    to.find_repeated();
    return to;
  }
  FresnelSplit<R> split(int j, CoatDirection<R>& along) const {
    return shape[j].split(along, face(j));
  }
  FresnelSplit<R> split(int j, R z) const { return shape[j].split(z, face(j)); }
  /// \pre no film
  R mean_reflected(int j) const { return shape[j].mean(mean[j], eta[j]); }
  /// |Cosine| at which light that has passed meets what lies below, at least.
  R least_below(int j) const {
    return falls_[j] ? least[j] : std::sqrt(std::max(1 - bent_sine2(j), R(0)));
  }
  /// |Cosine| of light that has passed, from that outside all coats.
  R cosine_inside(int j, R z) const {
    const R most_sine2 = falls_[j] ? (1 - least[j]) * (1 + least[j]) : bent_sine2(j);
    return std::sqrt(std::max(1 - (1 - z) * (1 + z) * most_sine2, R(0)));
  }

 private:
  static constexpr R kNextToOne = R(1e-4);  ///< how near films let an index be

  std::bitset<kWavelengths> repeated_, falls_;
  Spectrum<R> held_{}, even_{};

  /// The square of the sine of light along the surface, once it has passed.
  R bent_sine2(int j) const { return (1 - least[j]) * (1 + least[j]) / (eta[j] * eta[j]); }

  void find_shapes() {
    FaceMeans<R> means;
    for (int j = 0; j < kWavelengths; ++j) {
      const bool repeated = j > 0 && eta[j] == eta[j - 1] && films[j] == films[j - 1];
      mean[j] = repeated ? mean[j - 1] : films[j].there() && even_[j] == 0 ? R(0) : means(face(j));
      const bool same = repeated && held_[j] == held_[j - 1] && even_[j] == even_[j - 1] &&
                        least[j] == least[j - 1];
      shape[j] = same ? shape[j - 1] : of(j, {held_[j], even_[j]});
    }
    find_repeated();
  }

  void find_repeated() {
    for (int j = 1; j < kWavelengths; ++j)
      repeated_[j] = eta[j] == eta[j - 1] && films[j] == films[j - 1] && least[j] == least[j - 1] &&
                     shape[j] == shape[j - 1];
  }
};

/// E and T of a coat along one direction, at each wavelength.
template <class R>
struct CoatAlong {
  Spectrum<R> reflected{}, through{};

  CoatAlong() = default;
  CoatAlong(const CoatNumbers<R>& coat, R z) {
    CoatDirection<R> along(limited(z, R(0), R(1)));
    FresnelSplit<R> e{};
    for (int j = 0; j < kWavelengths; ++j) {
      if (!coat.repeated(j)) e = coat.split(j, along);
      reflected[j] = e.reflected;
      through[j] = e.transmitted;
    }
  }
};

}  // namespace mms::materials
