// SPDX-License-Identifier: Apache-2.0
#include "tools/furnace_report.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "materials/table.h"

namespace mms::tools {

namespace {

using materials::FurnaceRow;

std::string_view form_name(const Furnace& f) {
  return f.form == vm::DescriptorForm::Surface ? "surface" : "volume";
}

/// What a row loses, with so many digits; never -0.
std::string lost_text(const FurnaceRow& row, int digits) {
  const std::string text = fmt::format("{:.{}f}", row.lost(), digits);
  return text.find_first_not_of("-0.") == text.npos ? text.substr(text[0] == '-') : text;
}

/// What holds of all rows.
struct Summary {
  double lost = 0, gained = 0;  ///< the most, both >= 0
  double efficiency = 1;        ///< the least
};

Summary summary(const Furnace& f) {
  Summary s;
  for (const FurnaceRow& row : f.report.rows) {
    for (const double a : row.albedo.v) {
      s.lost = std::max(s.lost, 1 - a);
      s.gained = std::max(s.gained, a - 1);
    }
    s.efficiency = std::min(s.efficiency, row.efficiency());
  }
  return s;
}

std::string summary_text(const Furnace& f) {
  const Summary s = summary(f);
  return fmt::format(
      "loses at most {:.4f}, gains at most {:.4f}, is reciprocal within {:.1e}, efficiency from "
      "{:.3f}",
      s.lost, s.gained, f.report.reciprocity, s.efficiency);
}

/// A curve of a panel.
struct Curve {
  std::vector<std::pair<double, double>> points;
  double hue = 0;
  bool dashed = false;
};

constexpr int kWidth = 260, kHeight = 180, kGap = 50, kTop = 48;

/// Axes from x0 to x1 and from 0 to 1.2, `marks` on the first, and the curves, all with their lower
/// left corner at (left, bottom).
std::string panel(std::string_view title, int left, int bottom, double x0, double x1,
                  const std::vector<double>& marks, const std::vector<Curve>& curves) {
  const auto x = [&](double v) { return left + kWidth * (v - x0) / (x1 - x0); };
  const auto y = [&](double v) { return bottom - kHeight * std::min(v, 1.2) / 1.2; };
  std::string svg =
      fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", left, bottom - kHeight - 4, title);
  for (const double v : {0.0, 0.5, 1.0})
    svg += fmt::format(
        "<path d=\"M{} {:.1f}h{}\" stroke=\"#bbb\"/><text x=\"{}\" y=\"{:.1f}\">{}</text>\n", left,
        y(v), kWidth, left - 22, y(v) + 4, v);
  for (const double v : marks)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\">{:.0f}</text>\n", x(v) - 8, bottom + 14, v);
  for (const Curve& c : curves) {
    std::string points;
    for (const auto& [px, py] : c.points) points += fmt::format("{:.1f},{:.1f} ", x(px), y(py));
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"hsl({:.0f},80%,45%)\"{}/>\n",
                       points, c.hue, c.dashed ? " stroke-dasharray=\"4 3\"" : "");
  }
  return svg;
}

/// `value(row)` over the angle from the normal, of the rows outside or those inside.
template <class Value>
Curve over_angle(const Furnace& f, bool inside, double hue, Value value) {
  Curve c{{}, hue, inside};
  for (const FurnaceRow& row : f.report.rows)
    if ((row.degrees > 90) == inside)
      c.points.emplace_back(inside ? 180 - row.degrees : row.degrees, value(row));
  return c;
}

double hue_of(int k, int count) { return 270 - 270.0 * k / std::max(count - 1, 1); }

std::string panels(const Furnace& f, const std::vector<double>& nanometres, int bottom) {
  std::vector<Curve> angles, wavelengths, efficiencies;
  for (const bool inside : {false, true}) {
    for (int j = 0; j < kWavelengths; ++j)
      angles.push_back(over_angle(f, inside, hue_of(j, kWavelengths),
                                  [j](const FurnaceRow& row) { return row.albedo[j]; }));
    efficiencies.push_back(
        over_angle(f, inside, 210, [](const FurnaceRow& row) { return row.efficiency(); }));
  }
  const int count = static_cast<int>(f.report.rows.size());
  for (int k = 0; k < count; ++k) {
    const FurnaceRow& row = f.report.rows[k];
    Curve c{{}, hue_of(k, count), row.degrees > 90};
    for (int j = 0; j < kWavelengths; ++j) c.points.emplace_back(nanometres[j], row.albedo[j]);
    wavelengths.push_back(std::move(c));
  }
  const std::vector<double> degrees{0, 30, 60, 90};
  const int step = kWidth + kGap;
  return fmt::format(
             "<text x=\"{}\" y=\"{}\" font-weight=\"bold\">{} {}</text>"
             "<text x=\"{}\" y=\"{}\">{}</text>\n",
             kGap, bottom - kHeight - 32, form_name(f), f.name, kGap, bottom - kHeight - 18,
             summary_text(f)) +
         panel("albedo over degrees, by wavelength", kGap, bottom, 0, 90, degrees, angles) +
         panel("albedo over nm, by angle", kGap + step, bottom, nanometres.front(),
               nanometres.back(), {nanometres.front(), nanometres.back()}, wavelengths) +
         panel("efficiency over degrees", kGap + 2 * step, bottom, 0, 90, degrees, efficiencies);
}

/// `value(row)` of each row, as the cells of a table.
template <class Value>
std::string cells(const Furnace& f, Value value) {
  std::string text;
  for (const FurnaceRow& row : f.report.rows) text += fmt::format(" {} |", value(row));
  return text + "\n";
}

/// One number, or the least and the most of a spectrum.
std::string span_of(const Spectrum<double>& s) {
  const auto [least, most] = std::minmax_element(s.v.begin(), s.v.end());
  return *most - *least < 5e-5 ? fmt::format("{:.4f}", *most)
                               : fmt::format("{:.3f}..{:.3f}", *least, *most);
}

std::string section(const Furnace& f) {
  std::string doc;
  for (const vm::Builtin& row : materials::rows())
    if (row.signature.substr(0, row.signature.find('(')) == "material " + f.name)
      doc = fmt::format("`{}`\n\n{}\n\n", row.signature, row.doc);
  std::string table =
      "| degrees |" + cells(f, [](const FurnaceRow& row) { return row.degrees; }) + "|---|";
  for (std::size_t k = 0; k < f.report.rows.size(); ++k) table += "---|";
  table += "\n| albedo |" + cells(f, [](const FurnaceRow& row) { return span_of(row.albedo); });
  table += "| lost |" + cells(f, [](const FurnaceRow& row) { return lost_text(row, 4); });
  table += "| +- |" + cells(f, [](const FurnaceRow& row) {
             return fmt::format("{:.4f}", row.standard_error);
           });
  table += "| efficiency |" +
           cells(f, [](const FurnaceRow& row) { return fmt::format("{:.3f}", row.efficiency()); });
  return fmt::format("\n## {0}\n\n![{0}](images/materials/{0}.png)\n\n{1}{2}\nIt {3}.\n", f.name,
                     doc, table, summary_text(f));
}

constexpr std::string_view kHead = R"(# Materials

<!-- Made by `./run figures`; change the scripts, not the page. -->

Every scattering model, phase function and combiner, as `examples/figures/materials.mms` uses it: a
sphere under the default light, and what `mms furnace` says of it.

## What every model keeps to

- **Frame.** Directions are unit vectors in the frame of the shading normal, which is z; both point away from the surface. Below 0 is
  the inside; an index is that of the inside over that of the outside. What reflects does so on both sides.
- **Value.** `f` is per steradian of solid angle, without the cosine: what a sample brings is f |cos| L / pdf.
- **Density.** `pdf` is per steradian too, and one number for each wavelength of the path: with what density this direction would
  have been drawn had that wavelength been the one that draws (the hero), with the choice among parts included. The weights over wavelengths are found
  from these hypothetical densities (thesis 4.3.3); the first is the real one. Where no direction depends on wavelength they differ by the choice of a part only.
- **Deltas.** Mirrors and smooth glass are never seen by value or density, only by samples: there `f` and `pdf` share the one delta, and `pdf` is the
  probability of this direction for each wavelength: 0 where dispersion bends that wavelength elsewhere.
- **No sample.** A draw may give none: nothing scatters at the hero's wavelength, or the direction fell where f is 0. That is part of the
  distribution; the path ends, and nothing is drawn again.
- **Radiance and importance.** A path from the camera asks for radiance, one from a light for importance. f of importance is f of radiance with its directions exchanged. They differ
  by the square of the relative index where light is refracted, and in `sheen` and what it covers by `layer`, which are fits and not reciprocal.
- **Wavelengths.** Colours, indices and weights may differ at each wavelength; roughness, gloss and exponents do not. Directions depend on
  wavelength only where an index does.
- **Phase functions** are per steradian without a cosine, over the whole sphere; each is its own density.
- Numbers out of range are taken for the nearest that is in it.

## How much energy is kept

What absorbs nothing gives back all light, seen from any direction, but for at most this much. Coats are `coat` and `fresnel_mix` of an index
from 1.02 to 4, films `film_mix`; round facets are of anisotropy 0.

| material | off by |
|---|---|
| `glossy` of exponents to 1e4 | 1e-6 |
| `microfacet`, `beckmann` and metals of roughness from 0.02, of any anisotropy | 1e-4 |
| `dielectric` and `beckmann_dielectric` of an index from 1/4 to 4 and roughness from 0.02, of any anisotropy | 1e-3 |
| `film_dielectric`; at anisotropy 1 one setting in 4000 | 1e-3; 4e-3 |
| `mirror`, `glossy` and round facets of roughness from 0.05, as coats and, with `matte` and `rough_matte`, below coats and under films of any thickness | 1e-4 |
| glass below coats and films; at anisotropy 1 one setting in 500 | 1e-3; 5e-3 |
| other facets, of roughness from 0.2, as coats and below coats, to anisotropy 0.9; at 1 | 2e-4; 3e-4 |
| other facets, of roughness from 0.2, under films of up to 1 um, and as coats under these, of any anisotropy | 1e-4 |

Other models may lose light as coats and below them, most towards grazing angles. `ctest --preset release -R accuracy` holds materials to such bounds
at its own settings; what is said of anisotropy 1, and of other facets with coats and films, are the largest errors that wider random searches found, which are no part of
the project. `materials/combine.h` says more.

In the tables below `albedo` is what comes back of light along a direction that many degrees from the normal (above 90: from inside), from the least to the
most of eight wavelengths; `lost` is what is missing to 1 (negative: gained), `+-` the standard error were the samples independent, and `efficiency` what one sample is worth against one
whose weight never varies: 1 / (1 + variance / mean^2).

Rims are dark where a model loses energy, and nowhere else: `phong`, `max_phong`, `spot`, `phong_glass`, `ward`, `ashikhmin_shirley`; `sheen` is dark in its middle, where light
passes it. `glossy` and the facets keep it. Bright specks in and under rough glass are no model's: paths from the camera find the small lamp through two rough faces by chance.
)";

}  // namespace

std::string furnace_text(const Furnace& furnace, const std::vector<double>& nanometres) {
  std::string text =
      fmt::format("{} {}: {}\n  degrees", form_name(furnace), furnace.name, summary_text(furnace));
  for (const double nm : nanometres) text += fmt::format("{:>6.0f} nm", nm);
  text += "     lost       +-  variance\n";
  for (const FurnaceRow& row : furnace.report.rows) {
    text += fmt::format("  {:>7}", row.degrees);
    for (const double a : row.albedo.v) text += fmt::format("{:>9.5f}", a);
    text += fmt::format("{:>9}{:>9.5f}{:>10.4f}\n", lost_text(row, 5), row.standard_error,
                        row.relative_variance);
  }
  return text;
}

nlohmann::ordered_json furnace_json(const Furnace& furnace, const std::vector<double>& nanometres) {
  using Json = nlohmann::ordered_json;
  const Summary s = summary(furnace);
  Json json{{"form", form_name(furnace)},
            {"surface", furnace.name},
            {"reciprocity_error", furnace.report.reciprocity},
            {"most_lost", s.lost},
            {"most_gained", s.gained},
            {"least_efficiency", s.efficiency},
            {"wavelengths_nm", nanometres},
            {"rows", Json::array()}};
  for (const FurnaceRow& row : furnace.report.rows)
    json["rows"].push_back({{"degrees", row.degrees},
                            {"albedo", row.albedo.v},
                            {"lost", row.lost()},
                            {"standard_error", row.standard_error},
                            {"relative_variance", row.relative_variance},
                            {"efficiency", row.efficiency()}});
  return json;
}

std::string furnace_svg(const std::vector<Furnace>& all, const std::vector<double>& nanometres) {
  const int each = kHeight + kTop + 32;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n",
      3 * (kWidth + kGap) + kGap, static_cast<int>(all.size()) * each);
  int bottom = kHeight + kTop;
  for (const Furnace& f : all) {
    svg += panels(f, nanometres, bottom);
    bottom += each;
  }
  return svg + "</svg>\n";
}

std::string furnace_page(const std::vector<Furnace>& all) {
  std::string text(kHead);
  for (const Furnace& f : all) text += section(f);
  return text;
}

}  // namespace mms::tools
