// SPDX-License-Identifier: Apache-2.0
#include "tools/sheet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/diagnostics.h"
#include "renderer/film_file.h"
#include "renderer/openimageio.h"
#include "renderer/picture.h"
#include "renderer/sheet.h"
#include "tools/output.h"
#include "tools/overwrite.h"
#include "tools/render_job.h"

namespace mms::tools {

namespace {

/// More columns make captions too small to read on a screen.
constexpr int kMostColumns = 8;
constexpr int kMostPictures = 400;

/// One param at values from `low` to `high`.
struct Sweep {
  std::string param;
  double low = 0, high = 0;
  int steps = 1;

  std::string value(int i) const {
    return fmt::format("{:.6g}", std::lerp(low, high, double(i) / std::max(1, steps - 1)));
  }
};

/// `roughness=0:1:6`.
Result<Sweep> read_sweep(const std::string& text) {
  const Error wrong{
      "--sweep", fmt::format("`{}` is no sweep", text),
      fmt::format("a param, its first and last value and how many, 2 to {}, as in roughness=0:1:6",
                  kMostPictures)};
  const std::size_t equals = text.find('='), first = text.find(':'), last = text.rfind(':');
  if (equals == 0 || equals == std::string::npos || first == last || first < equals) return wrong;
  const auto low = number<double>(text.substr(equals + 1, first - equals - 1));
  const auto high = number<double>(text.substr(first + 1, last - first - 1));
  const auto steps = number<long long>(text.substr(last + 1));
  if (!low || !high || !steps || *steps < 2 || *steps > kMostPictures || !std::isfinite(*low) ||
      !std::isfinite(*high))
    return wrong;
  return Sweep{text.substr(0, equals), *low, *high, int(*steps)};
}

/// None, one across, or a second one down.
using Sweeps = std::vector<Sweep>;

/// Of pictures of each script.
int count(const Sweeps& sweeps) {
  int n = 1;
  for (const Sweep& s : sweeps) n *= s.steps;
  return n;
}

Result<Sweeps> read_sweeps(const std::vector<std::string>& texts) {
  Sweeps all;
  for (const std::string& text : texts) {
    auto sweep = read_sweep(text);
    if (!sweep) return sweep.error();
    all.push_back(std::move(*sweep));
  }
  if (all.size() > 2)
    return Error{"--sweep", "more than two",
                 "one goes across, the second down: leave the others out"};
  if (all.size() == 2 && all[0].param == all[1].param)
    return Error{"--sweep", fmt::format("`{}` is swept twice", all[0].param), "leave one out"};
  if (count(all) > kMostPictures)
    return Error{"--sweep", fmt::format("{} pictures", count(all)),
                 fmt::format("take fewer steps: {} pictures at most", kMostPictures)};
  return all;
}

/// The params and their values in the `i`-th picture, row by row.
std::vector<std::string> values(const Sweeps& sweeps, int i, const char* between) {
  std::vector<std::string> all;
  for (const Sweep& s : sweeps) {
    all.push_back(s.param + between + s.value(i % s.steps));
    i /= s.steps;
  }
  return all;
}

/// One tile to be: a script with settings.
struct Variant {
  std::string file;
  std::vector<std::string> caption;  ///< lines
  RenderRequest request;
};

/// The same with the `i`-th values of the sweeps.
RenderRequest with_values(RenderRequest request, const Sweeps& sweeps, int i) {
  for (std::string& s : values(sweeps, i, "=")) request.settings.push_back(std::move(s));
  return request;
}

std::vector<Variant> variants(const RenderRequest& request, const Sweeps& sweeps) {
  std::vector<Variant> all;
  for (const std::string& file : request.files) {
    if (sweeps.empty()) {
      all.push_back({file, {stem(file)}, request});
      continue;
    }
    for (int i = 0; i < count(sweeps); ++i) {
      Variant v{file, values(sweeps, i, " = "), with_values(request, sweeps, i)};
      if (request.files.size() > 1) v.caption.front() = stem(file) + ": " + v.caption.front();
      all.push_back(std::move(v));
    }
  }
  return all;
}

/// Whether the script `file` has the params that are swept, and each value fits; says once what is
/// wrong, before any tile is rendered.
Exit check_sweeps(const RenderRequest& request, const Sweeps& sweeps, const std::string& file) {
  if (file == "-")
    return fail(Exit::Usage, {"--sweep", "standard input can be read only once", "name a file"},
                request);
  Exit exit = Exit::Ok;
  const auto sources = read_sources({file}, request, exit);
  if (!sources) return exit;
  lang::Diagnostics diagnostics;
  const auto links = [&](const RenderRequest& r) {
    auto linked = compile(*sources, r, diagnostics, exit);
    if (linked && !diagnostics.has_errors()) return linked;
    if (linked) exit = Exit::Script;
    print(diagnostics, request);
    return std::optional<Compiled>();
  };
  const auto linked = links(request);
  if (!linked) return exit;
  std::vector<std::string> names;
  for (const lang::ParamInfo& p : linked->params) names.push_back(p.name);
  for (const Sweep& sweep : sweeps) {
    if (std::ranges::find(names, sweep.param) != names.end()) continue;
    const std::string near = lang::nearest(sweep.param, names);
    return fail(Exit::Usage,
                {"--sweep", fmt::format("{} has no param `{}`", file, sweep.param),
                 !near.empty()    ? fmt::format("did you mean `{}`?", near)
                 : !names.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                                  : "add one to the script: param real roughness = 0.3;"},
                request);
  }
  for (int i = 0; i < count(sweeps); ++i)
    if (!links(with_values(request, sweeps, i))) return exit;
  return Exit::Ok;
}

/// Renders one tile of the sheet at `path`; its pixels are left empty where that fails.
Exit render_tile(const Variant& v, const std::string& path, renderer::SheetTile& tile) {
  tile.caption = v.caption;
  Exit exit = Exit::Ok;
  const auto job = prepare(v.request, v.file, exit);
  if (!job) return exit;
  if (const auto error = overwrites(path, inputs_of(v.request, *job)))
    return fail(Exit::Usage, *error, v.request);
  const auto r = renderer::render(job->linked->program, job->scene, render_options(v.request));
  if (!r) return fail(exit_of(r.error()), r.error(), v.request);
  auto pixels = renderer::display_pixels(r->film, view_of(v.request));
  if (!pixels) return fail(Exit::File, pixels.error(), v.request);
  tile.pixels = std::move(*pixels);
  print_report(v.request, *job, v.file, fmt::format("{}", fmt::join(v.caption, ", ")), r->report);
  return r->report.too_many_faults ? Exit::Budget : r->report.stopped ? Exit::Interrupted : exit;
}

std::string sheet_path(const RenderRequest& request) {
  const std::string name = stem(request.files[0]) + ".png";
  if (request.output.empty()) return name;
  std::error_code ignored;
  if (request.output.back() == '/' || std::filesystem::is_directory(request.output, ignored))
    return (std::filesystem::path(request.output) / name).string();
  return request.output;
}

}  // namespace

bool wants_sheet(const RenderRequest& request) {
  return !request.sweeps.empty() || (request.files.size() > 1 && request.output.ends_with(".png"));
}

Exit render_sheet(const RenderRequest& request) {
  const auto sweeps = read_sweeps(request.sweeps);
  if (!sweeps) return fail(Exit::Usage, sweeps.error(), request);
  const std::string path = sheet_path(request);
  if (!path.ends_with(".png"))
    return fail(Exit::Usage, {"-o", "a sheet is a .png", "name one, or render one picture"},
                request);
  if (const auto ok = check_output({path}, request); !ok)
    return fail(Exit::File, ok.error(), request);
  const auto io = renderer::open_image_io(path);  // rather than when all is rendered
  if (!io) return fail(Exit::File, io.error(), request);
  const std::vector<Variant> all = variants(request, *sweeps);
  std::vector<renderer::SheetTile> tiles(all.size());
  Exit worst = Exit::Ok;
  if (!sweeps->empty())
    for (const std::string& file : request.files)
      worst = std::max(worst, check_sweeps(request, *sweeps, file));
  if (worst != Exit::Ok) return worst;
  int done = 0;
  for (std::size_t i = 0; i < all.size() && !interrupted(); ++i) {
    const Exit exit = render_tile(all[i], path, tiles[i]);
    if (exit == Exit::Usage) return exit;  // what was asked for is wrong, and so for all tiles
    done += exit == Exit::Ok;
    worst = std::max(worst, exit);
  }
  const int all_tiles = int(tiles.size());
  const bool cut = interrupted() && done < all_tiles;
  if (cut) worst = Exit::Interrupted;
  if (std::all_of(tiles.begin(), tiles.end(), [](const auto& t) { return t.pixels.empty(); }))
    return worst;
  // A sweep of few steps stays in one row, a row for each script; two are a table.
  const bool rows =
      sweeps->size() == 2 || (sweeps->size() == 1 && sweeps->front().steps <= kMostColumns);
  const int columns =
      rows ? sweeps->front().steps : std::min(kMostColumns, int(std::ceil(std::sqrt(all_tiles))));
  const renderer::Sheet sheet = (*io)->sheet(tiles, request.width, request.height, columns);
  const auto written = renderer::write_png(path, sheet.width, sheet.height, sheet.pixels);
  if (!written) return fail(Exit::File, written.error(), request);
  if (!sheet.captions && !request.quiet)
    fmt::print(stderr, "note: {}: no captions, since there is no font: install fonts-dejavu-core\n",
               path);
  if (cut)
    fmt::print(stderr, "stopped: {} has {} of {} in full\n", path, done,
               counted(std::uint64_t(all_tiles), "picture"));
  else if (!request.quiet && !request.json())
    fmt::print("{}: {}{} of {}x{}\n", path, done < all_tiles ? fmt::format("{} of ", done) : "",
               counted(std::uint64_t(all_tiles), "picture"), request.width, request.height);
  return worst;
}

}  // namespace mms::tools
