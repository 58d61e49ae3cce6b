// SPDX-License-Identifier: Apache-2.0
// Every row of the library is judged by something that is not the library: a published table, libm
// in long double, a closed form, an exhaustive search, a Fourier transform, finite differences.
// This is the list of which, and a row that is not on it fails.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tests/source_dir.h"
#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {
namespace {

/// Rows by the names that scripts call, and the test that holds them against its oracle.
struct Judge {
  std::string_view module, rows;      ///< names between blanks; `*`: all of the module
  std::string_view file, test, says;  ///< below tests/; says: a text of it that names the rows
};
constexpr std::string_view kDifferences =
    "every row that gives reals has a derivative rule, which agrees with differences";
const Judge kJudges[] = {
    // libm in long double, and the values that C99 prescribes. Those tests have an oracle for each
    // row of their module, or fail.
    {"math", "*", "unit/stdlib/elementary_test.cpp",
     "every real function of module math has an oracle here", "kOracles"},
    {"math", "*", "unit/stdlib/complex_test.cpp",
     "every complex function of one argument has an oracle here", "kOracles"},
    {"math", " pow ", "unit/stdlib/complex_test.cpp", "complex pow and powi", "powi"},
    {"math", " powi ", "unit/stdlib/elementary_test.cpp", "powi", "powl"},
    {"math", " abs sign min max clamp ", "unit/stdlib/elementary_test.cpp", "integer functions",
     "integer clamp"},
    // The range is that of a search over all vectors; zeros at lattice points, and seams; what is
    // in between has the gradient that differences find, and the spectrum that a Fourier
    // transform finds.
    {"noise", " perlin ", "unit/stdlib/noise_test.cpp",
     "perlin's scale makes the largest possible value 1, and never more", "perlin"},
    {"noise", " perlin valuenoise simplex ", "golden/noise_spectrum_test.cpp",
     "noise has the frequencies that docs/noise.md says, and no more", "valuenoise"},
    {"noise", " perlin_gradient ", "unit/stdlib/noise_test.cpp",
     "perlin_gradient is the derivative of perlin", "perlin_gradient"},
    {"noise", " perlin_gradient valuenoise_gradient simplex_gradient ",
     "unit/stdlib/seeded_noise_test.cpp",
     "noise: the gradient is the derivative, with seeds and periods", "_gradient"},
    // The derivative rule of one order is the row of the next; differences judge the rule.
    {"noise", " perlin_derivative valuenoise_derivative simplex_derivative ",
     "property/rows_test.cpp", kDifferences, "derivative"},
    // Chi-square of their distribution.
    {"noise", " hash cellnoise ", "unit/stdlib/noise_test.cpp",
     "hash and cellnoise are uniform, also along the lattice", "chi_square"},
    // The point that was found is there; a search over all points near finds no nearer one.
    {"noise", " worley worley_pair worley_gradient voronoi ", "unit/stdlib/noise_test.cpp",
     "worley: distances, gradient and Voronoi cells belong together", "worley_pair"},
    {"noise", " worley worley_pair worley_ways ", "unit/stdlib/worley_test.cpp",
     "worley_ways have the points of worley, where that looks far enough", "worley"},
    {"noise", " worley_ways worley_cell worley_nearest worley_nearest_squared ",
     "unit/stdlib/worley_test.cpp", "worley_ways: the nearest three points, by every distance",
     "worley_ways"},
    {"noise", " worley_cell ", "unit/stdlib/worley_test.cpp",
     "worley_ways lead to points that are one's own, in the middle without jitter", "cell_row"},
    {"noise", " worley_border worley_border_distance ", "unit/stdlib/worley_test.cpp",
     "worley_border: the border is there, and none is nearer", "worley_border"},
    // They are the derivative rules of worley_pair, worley_ways and worley_border.
    {"noise", " worley_second_gradient worley_shifts worley_border_shifts ",
     "property/rows_test.cpp", kDifferences, "derivative"},
    // Long double, catalogues, published tables.
    {"spectra", " planck ", "unit/stdlib/physics_test.cpp",
     "planck against long double with the constants of the SI", "planck"},
    {"physics", " fresnel ", "unit/stdlib/physics_test.cpp",
     "fresnel against the textbook form in long double", "fresnel"},
    {"physics", " fresnel_conductor ", "unit/stdlib/physics_test.cpp",
     "fresnel_conductor against the textbook form in long double", "fresnel_conductor"},
    {"physics", " sellmeier cauchy ", "unit/stdlib/physics_test.cpp",
     "sellmeier and cauchy against catalogue figures", "cauchy"},
    {"physics", " optical_table ", "unit/materials/colour_test.cpp", "chromaticities of white",
     "optical_tables"},
    {"physics", " optical_table_slope ", "unit/stdlib/physics_test.cpp",
     "optical_table reads the tables of materials/, by number, ends held", "optical_table_slope"},
    // Sums over texels and rows that the tests write out.
    {"images", "*", "unit/renderer/textures_test.cpp",
     "textures: every filter and wrap mode, with its slopes, is its formula", "ColourSlope"},
    {"images", " image_number image_number_slope ", "unit/renderer/textures_test.cpp",
     "textures: channels, luminance, and colours of grey files", "Number"},
    {"spectra", " curve_value curve_slope ", "unit/materials/curve_test.cpp",
     "tables: straight between rows, level outside, with slopes, floats and bounds", "CurveSlope"},
};

std::string name_of(const vm::Builtin& row) {
  const std::string_view call = row.signature.substr(0, row.signature.find('('));
  return std::string(call.substr(call.rfind(' ') + 1));
}

bool judges(const Judge& judge, const vm::Builtin& row) {
  return judge.module == row.module &&
         (judge.rows == "*" || judge.rows.find(" " + name_of(row) + " ") != judge.rows.npos);
}

TEST_CASE("every row has an oracle that is not the library, and the tests that ask it are there") {
  std::map<std::string_view, bool> used;
  for (const vm::Builtin& row : builtins()) {
    if (row.lobe >= 0) continue;  // models of scattering: tests/unit/materials
    bool judged = false;
    for (const Judge& judge : kJudges)
      if (judges(judge, row)) judged = used[judge.test] = true;
    CHECK_MESSAGE(judged, row.signature << " has no outside oracle in kJudges");
  }
  for (const Judge& judge : kJudges) {
    CHECK_MESSAGE(used[judge.test], judge.test << " judges no row");
    std::ifstream in(mms::source_dir() / "tests" / judge.file);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const std::string head = "TEST_CASE(";
    bool found = false;
    for (std::size_t at = text.find(head); at != text.npos; at = text.find(head, at + 1)) {
      std::size_t title = at + head.size();
      while (title < text.size() && text[title] != '"') ++title;
      found = found || text.compare(title + 1, judge.test.size(), judge.test) == 0;
    }
    CHECK_MESSAGE(found, judge.file << " has no test `" << judge.test << "`");
    CHECK_MESSAGE(text.find(judge.says) != text.npos, judge.file << " does not name its rows");
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
