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
#include <fstream>
#include <iostream>
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
#include "tools/child.h"
#include "tools/output.h"
#include "tools/overwrite.h"
#include "tools/plot.h"
#include "tools/render_job.h"

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

/// What is to be measured, and what is needed on the way.
struct Measurement {
  const ConvergeRequest& request;
  fs::path scratch;
  std::string input;  ///< a file with what was read from standard input; empty: none
};

using Names = std::span<const std::string_view>;

/// `mms render` with the switches of `--with` and `more`, but for what is left out of each.
std::string render_command(const Measurement& m, const std::string& more, Names left_out_of_with,
                           Names left_out_of_more) {
  std::error_code ignored;
  std::string command = quoted(fs::read_symlink("/proc/self/exe", ignored).string()) + " render";
  for (const std::string& file : m.request.files) command += " " + quoted(file);
  command += " --checkpoint 0";
  for (const std::string& text : m.request.with) command += switches(text, left_out_of_with);
  command += switches(more, left_out_of_more);
  if (!m.input.empty()) command += " <" + quoted(m.input);
  return command;
}

/// Runs `mms render`; its report, or empty after saying what is wrong. `more`: the switches to
/// blame.
std::optional<nlohmann::json> report_of(const Measurement& m, const std::string& command,
                                        const std::string& more, Exit& exit) {
  const auto give_up = [&](Exit code, const Error& error) {
    exit = fail(code, error, m.request);
    return std::nullopt;
  };
  auto ended = run_child(command + " --format=json");
  if (interrupted()) {
    exit = Exit::Interrupted;
    return std::nullopt;
  }
  if (!ended) return give_up(Exit::File, {"mms render", "cannot be started", ""});
  if (ended->status != 0) {
    show_messages(m.request, command, ended->out);
    const Exit code = WIFEXITED(ended->status) ? Exit(WEXITSTATUS(ended->status)) : Exit::Internal;
    return give_up(code, {"mms render", "failed" + (more.empty() ? "" : " with" + switches(more)),
                          "its own message says why"});
  }
  // The last line; warnings of the script stand before it.
  std::string& out = ended->out;
  out.erase(0, out.rfind('\n', out.size() - 2) + 1);
  return nlohmann::json::parse(out);
}

/// Renders by `command`; empty after saying what is wrong.
std::optional<Run> render(const Measurement& m, const std::string& command, int samples,
                          const std::string& more, Exit& exit) {
  const std::string path = (m.scratch / "picture.exr").string();
  const auto json = report_of(
      m, fmt::format("{} --samples {} -o {}", command, samples, quoted(path)), more, exit);
  if (!json) return std::nullopt;
  auto picture = renderer::read_picture(path);
  if (!picture) {
    exit = fail(Exit::File, picture.error(), m.request);
    return std::nullopt;
  }
  Run run{(*json)["seconds"].get<double>(), {}, std::move(*picture)};
  if (json->contains("error")) run.estimate = (*json)["error"].get<double>();
  return run;
}

/// Tries a curve with one pixel: what is wrong with its switches is told before hours are spent on
/// others, and so is what would be written over.
Exit try_curve(const Measurement& m, const std::string& more, const std::string& svg) {
  constexpr std::string_view kSize[] = {"--size"};
  const std::string command = render_command(m, more, kSize, kSize) +
                              " --samples 1 --size 1x1 -o " +
                              quoted((m.scratch / "picture.exr").string());
  Exit exit = Exit::Ok;
  const auto json = report_of(m, command, more, exit);
  if (!json) return exit;
  const auto inputs = (*json)["files"].get<std::vector<std::string>>();
  for (const std::string& output : {m.request.output, svg})
    if (const auto error = overwrites(output, inputs)) return fail(Exit::Usage, *error, m.request);
  return Exit::Ok;
}

/// References, by what of their switches changes the mean.
class References {
 public:
  explicit References(const Measurement& m) : measurement_(m) {}

  /// The truth of a curve; null after saying what is wrong.
  const Run* of(const std::string& curve, Exit& exit) {
    const std::string key = switches(curve, kSameMean);
    if (const auto known = runs_.find(key); known != runs_.end()) return &known->second;
    constexpr std::string_view kSeed[] = {"--seed"};
    const Measurement& m = measurement_;
    const std::string command =
        render_command(m, curve, kSeed, kSameMean) + " --seed " + kReferenceSeed;
    auto run = render(m, command, m.request.reference_samples, curve, exit);
    return run ? &runs_.emplace(key, std::move(*run)).first->second : nullptr;
  }

  /// How well the worst is known.
  double known_to() const {
    double worst = 0;
    for (const auto& [key, run] : runs_) worst = std::max(worst, run.estimate.value_or(0));
    return worst;
  }

 private:
  const Measurement& measurement_;
  std::map<std::string, Run> runs_;
};

/// Name of the curve without switches.
constexpr const char* kDefault = "default";

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

/// A cell of a table as RFC 4180 has it: switches may hold commas.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string table(const std::vector<Row>& rows) {
  std::string csv = "switches,samples,seconds,estimated_error";
  for (const renderer::MeasureInfo& m : renderer::measures()) csv += fmt::format(",{}", m.name);
  csv += "\n";
  for (const Row& r : rows) {
    csv += fmt::format("{},{},{:.6g},", cell(r.name), r.samples, r.seconds);
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
  return log_plots(fs::path(request.files[0]).filename().string() + ", against " +
                       counted(std::uint64_t(request.reference_samples), "sample"),
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

/// A row for each number of samples of a curve.
Exit measure_curve(const Measurement& m, const std::string& curve, References& references,
                   std::vector<Row>& rows) {
  Exit exit = Exit::Ok;
  const Run* reference = references.of(curve, exit);
  if (!reference) return exit;
  const std::string command = render_command(m, curve, {}, {});
  for (int samples = m.request.first; samples <= m.request.last; samples *= 2) {
    const auto run = render(m, command, samples, curve, exit);
    if (!run) return exit;
    const auto error = renderer::compare(run->picture, reference->picture, {});
    if (!error) return fail(Exit::Usage, error.error(), m.request);
    rows.push_back(
        {curve.empty() ? kDefault : curve, samples, run->seconds, run->estimate, *error});
    print(m.request, rows.back());
  }
  return exit;
}

}  // namespace

Exit measure_convergence(const ConvergeRequest& request) {
  const std::string svg = fs::path(request.output).replace_extension(".svg").string();
  for (const std::string& output : {request.output, svg})
    if (const auto error = check_replaceable(output)) return fail(Exit::File, *error, request);
  catch_interrupts();
  const Scratch scratch;
  if (scratch.path.empty())
    return fail(
        Exit::File,
        {"converge", scratch.why,
         "its pictures stay a while in the folder that $TMPDIR names, else in /tmp: name one "
         "that can be written"},
        request);
  Measurement m{request, scratch.path, {}};
  if (request.files[0] == "-") {
    m.input = (scratch.path / "stdin").string();
    std::ofstream(m.input, std::ios::binary) << std::cin.rdbuf();
  }
  std::vector<std::string> names = request.vary;
  if (names.empty()) names.push_back("");
  std::vector<Row> rows;
  References references(m);
  Exit exit = Exit::Ok;
  for (const std::string& name : names)
    if (exit == Exit::Ok) exit = try_curve(m, name, svg);
  for (const std::string& name : names)
    if (exit == Exit::Ok) exit = measure_curve(m, name, references, rows);
  if (exit != Exit::Ok && exit != Exit::Interrupted) return exit;
  if (rows.empty()) {
    fmt::print(stderr, "stopped: {} is not written, no render was finished\n", request.output);
    return exit;
  }
  for (std::string& name : names)
    if (name.empty()) name = kDefault;
  if (const auto error = replace_file(request.output, table(rows)))
    return fail(Exit::File, *error, request);
  if (const auto error = replace_file(svg, plot(request, names, rows)))
    return fail(Exit::File, *error, request);
  if (exit == Exit::Interrupted)
    fmt::print(stderr, "stopped: {} has what was there, {}\n", request.output,
               counted(rows.size(), "render"));
  else if (!request.quiet && !request.json())
    fmt::print("{}, {}: {}; the truth is known to {:.2g}\n", request.output, svg,
               counted(rows.size(), "render"), references.known_to());
  return exit;
}

}  // namespace mms::tools
