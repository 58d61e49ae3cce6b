// SPDX-License-Identifier: Apache-2.0
// mms converge: renders by `mms render` itself, so that every switch of it can be measured.
#include "tools/converge.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "renderer/compare.h"
#include "tools/output.h"
#include "tools/plot.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;

/// Far from every seed that a user tries.
constexpr const char* kReferenceSeed = "9007199254740993";

/// A folder for pictures, removed at the end.
struct Scratch {
  fs::path path;  ///< empty where none could be made
  std::string why;
  Scratch() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    if (error) {
      why = fmt::format("no folder for temporary files: {}", error.message());
      return;
    }
    std::string name = (folder / "mms-converge-XXXXXX").string();
    if (mkdtemp(name.data()))
      path = name;
    else
      why = fmt::format("{}: no folder can be made there: {}", folder.string(),
                        std::error_code(errno, std::generic_category()).message());
  }
  ~Scratch() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

/// `filter=box max-depth=8` as words for the shell: `--filter=box --max-depth=8`.
std::string switches(const std::string& text) {
  std::string words;
  std::istringstream in(text);
  for (std::string word; in >> word;)
    words += " " + quoted(word.starts_with("-") ? word : "--" + word);
  return words;
}

/// What one render left.
struct Run {
  double seconds = 0, estimate = 0;
  renderer::ReadPicture picture;
};

Result<Run> render(const ConvergeRequest& request, const std::string& path, int samples,
                   const std::string& more) {
  std::error_code ignored;
  std::string command = quoted(fs::read_symlink("/proc/self/exe", ignored).string()) + " render";
  for (const std::string& file : request.files) command += " " + quoted(file);
  command += fmt::format(" --samples {} --checkpoint 0 --format=json -o {}", samples, quoted(path));
  for (const std::string& text : request.with) command += switches(text);
  command += more;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return Error{"mms render", "cannot be started", ""};
  std::string out;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
  const int status = pclose(pipe);
  const auto json = nlohmann::json::parse(out, nullptr, false);
  if (status != 0 || json.is_discarded() || !json.contains("seconds"))
    return Error{"mms render", more.empty() ? std::string("failed") : "failed with" + more,
                 "its own message says why"};
  auto picture = renderer::read_picture(path);
  if (!picture) return picture.error();
  return Run{json["seconds"].get<double>(), json["error"].get<double>(), std::move(*picture)};
}

/// One point of one curve.
struct Row {
  std::string name;
  int samples = 0;
  double seconds = 0, estimate = 0;
  renderer::Comparison error;
};

/// Of log error over log samples, by least squares; 0 where it is not known.
double slope(const std::vector<Row>& rows, const std::string& name) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Row& r : rows) {
    const double e = r.error[renderer::Measure::Rmse];
    if (r.name != name || !(e > 0)) continue;
    const double u = std::log(r.samples), v = std::log(e);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  const double spread = n * xx - x * x;
  return spread > 0 ? (n * xy - x * y) / spread : 0;
}

std::string table(const std::vector<Row>& rows) {
  std::string csv = "switches,samples,seconds,estimated_error";
  for (const renderer::MeasureInfo& m : renderer::measures()) csv += fmt::format(",{}", m.name);
  csv += "\n";
  for (const Row& r : rows) {
    csv += fmt::format("{},{},{:.6g},{:.6g}", r.name, r.samples, r.seconds, r.estimate);
    for (const renderer::MeasureInfo& m : renderer::measures())
      csv += fmt::format(",{:.6g}", r.error[m.measure]);
    csv += "\n";
  }
  return csv;
}

std::string plot(const ConvergeRequest& request, const std::vector<std::string>& names,
                 const std::vector<Row>& rows) {
  Panel by_samples{"samples a pixel", "RMSE", {}}, by_time{"seconds", "RMSE", {}};
  for (const std::string& name : names) {
    Series samples{fmt::format("{}  (slope {:.2f})", name, slope(rows, name)), {}}, time{name, {}};
    for (const Row& r : rows) {
      if (r.name != name) continue;
      const double e = r.error[renderer::Measure::Rmse];
      samples.points.emplace_back(r.samples, e);
      time.points.emplace_back(r.seconds, e);
    }
    by_samples.series.push_back(samples);
    by_time.series.push_back(time);
  }
  return log_plots(fs::path(request.files[0]).filename().string() +
                       fmt::format(", against {} samples", request.reference_samples),
                   {by_samples, by_time});
}

void print(const ConvergeRequest& request, const Row& r) {
  const double e = r.error[renderer::Measure::Rmse];
  if (request.json())
    fmt::print("{}\n", nlohmann::ordered_json{{"switches", r.name},
                                              {"samples", r.samples},
                                              {"seconds", r.seconds},
                                              {"estimated_error", r.estimate},
                                              {"rmse", e}}
                           .dump());
  else if (!request.quiet)
    fmt::print("{:<32}{:>8} samples{:>10.3f} s   rmse {:<10.4g} estimated {:.4g}\n", r.name,
               r.samples, r.seconds, e, r.estimate);
  std::fflush(stdout);
}

}  // namespace

Exit measure_convergence(const ConvergeRequest& request) {
  const Scratch scratch;
  if (scratch.path.empty())
    return fail(
        Exit::File,
        {"converge", scratch.why,
         "its pictures stay a while in the folder that $TMPDIR names, else in /tmp: name one "
         "that can be written"},
        request);
  const auto reference =
      render(request, (scratch.path / "reference.exr").string(), request.reference_samples,
             std::string(" --seed ") + kReferenceSeed);
  if (!reference) return fail(Exit::Script, reference.error(), request);
  std::vector<std::string> names = request.vary;
  if (names.empty()) names.push_back("");
  std::vector<Row> rows;
  for (std::string& name : names) {
    const std::string more = switches(name);
    if (name.empty()) name = "default";
    for (int samples = request.first; samples <= request.last; samples *= 2) {
      const auto run = render(request, (scratch.path / "run.exr").string(), samples, more);
      if (!run) return fail(Exit::Script, run.error(), request);
      const auto error = renderer::compare(run->picture, reference->picture, {});
      if (!error) return fail(Exit::Usage, error.error(), request);
      rows.push_back({name, samples, run->seconds, run->estimate, *error});
      print(request, rows.back());
    }
  }
  const std::string svg = fs::path(request.output).replace_extension(".svg").string();
  if (const auto error = replace_file(request.output, table(rows)))
    return fail(Exit::File, *error, request);
  if (const auto error = replace_file(svg, plot(request, names, rows)))
    return fail(Exit::File, *error, request);
  if (!request.quiet && !request.json())
    fmt::print("{}, {}: {} renders; the reference is known to {:.2g}\n", request.output, svg,
               rows.size(), reference->estimate);
  return Exit::Ok;
}

}  // namespace mms::tools
