// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make tables of films share. Nothing here is used when rendering.

#include "materials/film_energy.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {

/// t_k of the |cosine| at a facet on the side of the lower index.
inline auto film_terms(double eta, const Way& up, const Way& down) {
  return chebyshev_terms<axes::kFilmTerms>(eta < 1 ? down.facet : up.facet);
}

/// Of each D_k of materials/film_energy.h, what one facet adds.
inline Numbers<axes::kFilmTerms> changes_at(double eta, const Way& up, const Way& down) {
  Numbers<axes::kFilmTerms> to;
  const auto t = film_terms(eta, up, down);
  for (int k = 0; k < axes::kFilmTerms; ++k) to.of[k] = t[k] * down.share * (up.taken - down.taken);
  return to;
}

}  // namespace mms::materials::tables
