// SPDX-License-Identifier: Apache-2.0
#include "materials/film_coat.h"

namespace mms::materials {

#include "film_glass_tables.inc"  // made by the build: materials/tables/film_glass.cpp

const FilmGlassTables kGgxFilmGlass{{{kGgxFilmGlassOutsideDense, kGgxFilmGlassOutsideRare},
                                     {kGgxFilmGlassInsideDense, kGgxFilmGlassInsideRare}},
                                    {{kGgxFilmGlassOutsideDenseBent, kGgxFilmGlassOutsideRareBent},
                                     {kGgxFilmGlassInsideDenseBent, kGgxFilmGlassInsideRareBent}},
                                    {kGgxFilmGlassFurtherDense, kGgxFilmGlassFurtherRare}};

}  // namespace mms::materials
