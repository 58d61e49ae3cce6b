// SPDX-License-Identifier: Apache-2.0
// mms converge: renders by `mms render` itself, so that every switch of it can be measured.
#include "tools/converge.h"

#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
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

/// Switches that leave the mean of a picture as it is.
constexpr std::string_view kSameMean[] = {"--error", "--estimator", "--sampler",
                                          "--seed",  "--threads",   "--time"};

/// `filter=box max-depth=8` as words for the shell: `--filter=box --max-depth=8`, all but those
/// named by `left_out`.
std::string switches(const std::string& text, std::span<const std::string_view> left_out = {}) {
  std::string words;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (!word.starts_with("-")) word = "--" + word;
    const std::string_view name = std::string_view(word).substr(0, word.find('='));
    if (std::ranges::find(left_out, name) == left_out.end()) words += " " + tools::quoted(word);
  }
  return words;
}

/// What one render left.
struct Run {
  double seconds = 0;
  std::optional<double> estimate;  ///< of the error; not known of one sample
  renderer::ReadPicture picture;
};

/// Shows what is wrong with a script: the render was asked for JSON, and says it to people when it
/// is asked again.
void show_messages(const ConvergeRequest& request, const std::string& command,
                   const std::string& json) {
  if (request.json()) {
    fmt::print("{}", json);
    std::fflush(stdout);
  } else if (json.find("\"severity\":\"error\"") != std::string::npos) {
    [[maybe_unused]] const int again = std::system(command.c_str());
  }
}

/// Renders with the switches `more`, and with `seed` instead of that of `--with`; empty after
/// saying what is wrong.
std::optional<Run> render(const ConvergeRequest& request, const std::string& path, int samples,
                          const std::string& more, Exit& exit, const std::string& seed = "") {
  std::error_code ignored;
  std::string command = quoted(fs::read_symlink("/proc/self/exe", ignored).string()) + " render";
  for (const std::string& file : request.files) command += " " + quoted(file);
  command += fmt::format(" --samples {} --checkpoint 0 -o {}", samples, quoted(path));
  constexpr std::string_view kSeed[] = {"--seed"};
  for (const std::string& text : request.with)
    command += seed.empty() ? switches(text) : switches(text, kSeed);
  command += more;
  if (!seed.empty()) command += " --seed " + seed;
  const auto give_up = [&](Exit code, const Error& error) {
    exit = fail(code, error, request);
    return std::nullopt;
  };
  std::FILE* pipe = popen((command + " --format=json").c_str(), "r");
  if (!pipe) return give_up(Exit::File, {"mms render", "cannot be started", ""});
  std::string out;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.append(buffer, n);
  const int status = pclose(pipe);
  if (status != 0) {
    show_messages(request, command, out);
    const Exit code = WIFEXITED(status) ? Exit(WEXITSTATUS(status)) : Exit::Internal;
    return give_up(code, {"mms render", "failed" + (more.empty() ? "" : " with" + more),
                          "its own message says why"});
  }
  // The last line; warnings of the script stand before it.
  out.erase(0, out.rfind('\n', out.size() - 2) + 1);
  const auto json = nlohmann::json::parse(out);
  auto picture = renderer::read_picture(path);
  if (!picture) return give_up(Exit::File, picture.error());
  Run run{json["seconds"].get<double>(), {}, std::move(*picture)};
  if (json.contains("error")) run.estimate = json["error"].get<double>();
  return run;
}

/// References, by what of their switches changes the mean.
class References {
 public:
  explicit References(const ConvergeRequest& request) : request_(request) {}

  /// The truth of a curve; null after saying what is wrong.
  const Run* of(const std::string& curve, const fs::path& folder, Exit& exit) {
    const std::string key = switches(curve, kSameMean);
    if (const auto known = runs_.find(key); known != runs_.end()) return &known->second;
    auto run = render(request_, (folder / "reference.exr").string(), request_.reference_samples,
                      key, exit, kReferenceSeed);
    return run ? &runs_.emplace(key, std::move(*run)).first->second : nullptr;
  }

  /// How well the worst is known.
  double known_to() const {
    double worst = 0;
    for (const auto& [key, run] : runs_) worst = std::max(worst, run.estimate.value_or(0));
    return worst;
  }

 private:
  const ConvergeRequest& request_;
  std::map<std::string, Run> runs_;
};

/// One point of one curve.
struct Row {
  std::string name;
  int samples = 0;
  double seconds = 0;
  std::optional<double> estimate;
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
    csv += fmt::format("{},{},{:.6g},", r.name, r.samples, r.seconds);
    if (r.estimate) csv += fmt::format("{:.6g}", *r.estimate);
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
  if (request.json()) {
    nlohmann::ordered_json json{
        {"switches", r.name}, {"samples", r.samples}, {"seconds", r.seconds}, {"rmse", e}};
    if (r.estimate) json["estimated_error"] = *r.estimate;
    fmt::print("{}\n", json.dump());
  } else if (!request.quiet) {
    fmt::print("{:<32}{:>8} samples{:>10.3f} s   rmse {:<10.4g} estimated {}\n", r.name, r.samples,
               r.seconds, e, r.estimate ? fmt::format("{:.4g}", *r.estimate) : "unknown");
  }
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
  References references(request);
  std::vector<std::string> names = request.vary;
  if (names.empty()) names.push_back("");
  std::vector<Row> rows;
  Exit exit = Exit::Ok;
  for (std::string& name : names) {
    const std::string more = switches(name);
    const Run* reference = references.of(name, scratch.path, exit);
    if (!reference) return exit;
    if (name.empty()) name = "default";
    for (int samples = request.first; samples <= request.last; samples *= 2) {
      const auto run = render(request, (scratch.path / "run.exr").string(), samples, more, exit);
      if (!run) return exit;
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
    fmt::print("{}, {}: {} renders; the truth is known to {:.2g}\n", request.output, svg,
               rows.size(), references.known_to());
  return Exit::Ok;
}

}  // namespace mms::tools
