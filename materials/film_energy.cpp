// SPDX-License-Identifier: Apache-2.0
#include "materials/film_energy.h"

namespace mms::materials {

#include "film_tables.inc"  // made by the build: materials/tables/film.cpp

const FilmTables kGgxFilm{{kGgxFilmDense, kGgxFilmRare},
                          {kGgxFilmDenseStretched, kGgxFilmRareStretched},
                          {kGgxFilmDenseMean, kGgxFilmRareMean}};

}  // namespace mms::materials
