// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A surface's scattering at one point: the lobes of a Layout with the numbers of one lane.
/// Borrows both; owns nothing; never allocates, throws or prints. Cheap to make.
///
/// The contract of every function here:
///
/// * Frame. Local, z the shading normal. `wo` (towards where the path came from) and `wi` (towards
///   where it goes) are unit vectors that both point away from the surface. z < 0 is the inside:
///   `ior` of a dielectric is inside over outside. Lobes that reflect do so on both sides.
/// * Value. `f` per steradian, the cosine NOT included: contribution = f |wi.z| Li / pdf.
/// * Pdf. Per steradian. Element j is the density with which this direction would have been
///   drawn if wavelength j had been the hero (lobe choice included), with the same numbers.
///   Element 0, the hero's, is the density it was drawn with. For the one-sample MIS over
///   wavelengths sum over j; for a single wavelength use element 0.
/// * Deltas. `eval` and `pdf` see only what is not a delta. A sample with `specular` set is of the
///   deltas alone: `f` and `pdf` then share one implicit delta, so the same quotient holds, and
///   pdf[j] is the discrete probability that j as the hero would have led to this very direction: 0
///   (and f[j] = 0) where a refraction is dispersed away from the hero's. Deltas that coincide
///   are summed in both f and pdf.
/// * No sample. An empty optional: nothing scatters at the hero's wavelength, or the direction fell
///   where f is 0. It is part of the distribution: count the path as ended, do not draw again.
/// * Mode. Radiance: `wi` is where light comes from, refraction scales f by (n_o/n_i)^2 (radiance
///   is compressed). Importance: `wi` is where light goes on to (light and photon paths), no scale.
///   f_Importance(wo, wi) = f_Radiance(wi, wo). Nothing else depends on the mode, but that `sheen`
///   and what it covers by `layer` are not reciprocal on one side either, nor is `tilt`, whose
///   normal is held back by `wo` in both modes (materials/frames.h), and in and below coats favours
///   `wo` too (materials/combine.h).
/// * Numbers out of range (negative or NaN colour, roughness, ...) are clamped into range.

#include <algorithm>
#include <array>
#include <bitset>
#include <cstring>
#include <memory>
#include <optional>
#include <variant>

#include "materials/coats_above.h"
#include "materials/dielectric.h"
#include "materials/film.h"
#include "materials/frames.h"
#include "materials/layout.h"
#include "materials/lobe.h"
#include "materials/microfacet.h"
#include "materials/under_coats.h"

namespace mms::materials {

template <class R>
struct BsdfSample {
  Vec3<R> wi;
  Spectrum<R> f;    ///< cosine not included
  Spectrum<R> pdf;  ///< element 0 > 0
  bool specular = false;
  bool transmitted = false;  ///< wi and wo are on different sides
};

/// A copy of numbers, at most `kMost`, by which they are found again.
template <class R, int kMost>
class KnownNumbers {
 public:
  void keep(const R* numbers, int count) { std::copy_n(numbers, count, numbers_.begin()); }
  bool are(const R* numbers, int count) const {
    return std::memcmp(numbers, numbers_.data(), count * sizeof(R)) == 0;
  }

 private:
  std::array<R, kMost> numbers_;
};

/// The same of a material.
template <class R>
class KnownMaterial {
 public:
  void keep(const Layout& layout, const R* params) {
    count_ = int(layout.nodes().size());
    std::copy_n(layout.nodes().begin(), count_, nodes_.of.begin());
    numbers_.keep(params, layout.param_count());
  }
  bool is(const Layout& layout, const R* params) const {
    return std::equal(layout.nodes().begin(), layout.nodes().end(), nodes_.of.begin(),
                      nodes_.of.begin() + count_) &&
           numbers_.are(params, layout.param_count());
  }

 private:
  int count_ = 0;
  PerNode<Layout::Node> nodes_;
  KnownNumbers<R, kMaxNodes * kMostNumbers> numbers_;
};

/// What of a node's model is alike along all directions, and the numbers that it is of.
template <class R>
class SolvedModel {
 public:
  template <class Model>
  void solve(const Layout::Node& node, const R* params, const Model& model) {
    lobe_ = node.lobe;
    numbers_.keep(params + node.first_param, node.param_count);
    solved_ = model.solved();
  }
  template <class Model>
  bool solves(const Layout::Node& node, const R* params, const Model&) const {
    return node.lobe == lobe_ && numbers_.are(params + node.first_param, node.param_count);
  }
  /// \pre the last model that was solved for said that
  template <class Solved>
  const Solved& get() const {
    return *std::get_if<Solved>(&solved_);
  }

 private:
  Lobe lobe_{};
  KnownNumbers<R, kMostNumbers> numbers_;
  std::variant<FacetsSolved<R>, typename Dielectric<R>::Solved, typename FilmDielectric<R>::Solved>
      solved_;
};

/// Of float and double; materials/bsdf_definitions.h for other numbers.
template <class R>
class Bsdf {
 public:
  /// `params` holds layout.param_count() numbers in the order layout.h states. Both are borrowed.
  Bsdf(const Layout& layout, const R* params) : layout_(&layout), params_(params) {}

  /// f without deltas; black where wo or wi is in the surface (|z| < 1e-19 in float).
  Spectrum<R> eval(Vec3<R> wo, Vec3<R> wi, Mode mode) const { return evaluate(wo, wi, mode).f; }

  /// Densities without deltas.
  Spectrum<R> pdf(Vec3<R> wo, Vec3<R> wi, Mode mode) const { return pdf(wo, wi, mode, choose(wo)); }

  /// How likely each lobe is chosen, for each wavelength as the hero.
  struct Choice {
    PerNode<Spectrum<R>> probability;  ///< of lobes only
    bool any = false;                  ///< the hero has something to choose from
    Frames<R> frames;                  ///< of parts
    PerNode<Spectrum<R>> scaling;      ///< g along `wo`, of lobes known under coats or in one
    PerNode<Spectrum<R>> tilted;       ///< of those in a `tilt`, what r is at most along `wi`
    PerNode<FacetsSeen<R>> seen;       ///< what models with a function `solved` said of `wo`

    // Kept while the material is the same, but for what coats do along `wo`; where there is more
    // than one node.
    KnownMaterial<R> material;
    CoatTree<R> coats;
    PerNode<OverGlass<R>> glass;  ///< of coats that are over glass
    /// The mean of what each sends back spread, seen from outside and from inside, where known.
    PerNode<Spectrum<R>> mean_spread[2];
    std::bitset<kMaxNodes> spread_known[2];
    std::bitset<kMaxNodes> solved;  ///< for which nodes `under` is asked

    // Kept while what they are of is the same, of whatever material.
    SolvedPerNode<UnderCoats<R>> under;  ///< of lobes that have several coats above or are of one
    std::unique_ptr<StretchedSolutions<R>> stretched;  ///< of these, once there is one
    SolvedPerNode<MeanThrough<R>> means;               ///< of Lambert lobes that have coats above
    SolvedPerNode<SolvedModel<R>> models;

    const UnderCoats<R>* solution(int node) const { return solved[node] ? &under[node] : nullptr; }
  };
  /// For all that comes along `wo`: made once where one `wo` meets many `wi`. What a choice was
  /// before saves time where the material is the same, or its coats, rough metal and rough glass.
  void choose(Vec3<R> wo, Choice& choice) const;
  Choice choose(Vec3<R> wo) const {
    Choice choice;
    choose(wo, choice);
    return choice;
  }

  /// `eval` and `pdf` at once, for about the price of `eval`.
  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode) const {
    return evaluate(wo, wi, mode, choose(wo));
  }
  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const;
  /// The densities of that, to the bit.
  Spectrum<R> pdf(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const;

  /// Draws `wi` for the hero from three numbers in [0, 1).
  std::optional<BsdfSample<R>> sample(Vec3<R> wo, R u_lobe, R u1, R u2, Mode mode) const {
    return sample(wo, u_lobe, u1, u2, mode, choose(wo));
  }
  std::optional<BsdfSample<R>> sample(Vec3<R> wo, R u_lobe, R u1, R u2, Mode mode,
                                      const Choice& choice) const;

  bool transmits() const { return layout_->transmits(); }

  /// With these very numbers every lobe is a delta: `eval` is black, connecting to a light is vain.
  bool specular_only() const;

 private:
  /// Of `kDensities` no f is asked for, which takes longer.
  template <bool kDensities>
  Lobes<R> lobes(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const;
  template <bool kDensities>
  Lobes<R> sum_of_lobes(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const;
  std::optional<BsdfSample<R>> sample_specular(int lobe, Vec3<R> wo, R u, Mode mode,
                                               const Choice& choice) const;
  std::optional<BsdfSample<R>> sample_smooth(int lobe, Vec3<R> wo, R u, R u1, R u2, Mode mode,
                                             const Choice& choice) const;

  /// What is alike along all directions, where there is more than one node.
  void know_material(Choice& choice) const;
  void see_coated_glass(Vec3<R> wo, Choice& choice) const;
  /// Over what a coat right above node `base` lies, light along `w`, of the surface's frame, being
  /// seen.
  Sent<R> sent_back(int base, Vec3<R> w, const Choice& choice) const;
  Spectrum<R> mean_spread(int base, bool inside, const Choice& choice) const;
  /// The coat that node `i` is the combiner of, over glass, or null.
  const OverGlass<R>* over_glass(int i, const Choice& choice) const;
  /// Of the coats above a Lambert lobe, right below which node `base` is.
  Spectrum<R> mean_through_coats(int lobe, int base, Choice& choice) const;

  /// `visit(model)` for the lobe of node `i`; `none` for combiners and phase functions.
  template <class Result, class Visit>
  Result with_model(int i, Result none, const Visit& visit) const;

  bool node_is_specular(int i) const;
  int node_count() const { return int(layout_->nodes().size()); }

  const Layout* layout_;
  const R* params_;
};

extern template class Bsdf<float>;
extern template class Bsdf<double>;

}  // namespace mms::materials
