// SPDX-License-Identifier: Apache-2.0
#include "tools/output.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "renderer/error.h"

namespace mms::tools {

std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("-_./=:,+%@").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

namespace {

/// The words this process was started with, quoted for a shell.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string words{std::istreambuf_iterator<char>(file), {}};
  std::string line;
  for (std::size_t at = 0, end; at < words.size(); at = end + 1) {
    end = std::min(words.find('\0', at), words.size());
    line += (at > 0 ? " " : "") + quoted(words.substr(at, end - at));
  }
  return line;
}

}  // namespace

renderer::View view_of(const PictureOptions& o) {
  renderer::View view;
  view.exposure = o.stops;
  view.contrast = o.power;
  view.config = o.ocio;
  for (const renderer::CurveInfo& c : renderer::curves())
    if (o.view == c.name) view.curve = c.curve;
  if (!o.view.starts_with("ocio")) return view;
  view.curve = renderer::Curve::OpenColorIO;
  const std::size_t colon = o.view.find(':'), slash = o.view.find('/');
  if (colon == std::string::npos) return view;
  if (slash != std::string::npos) view.display = o.view.substr(colon + 1, slash - colon - 1);
  view.view = o.view.substr((slash == std::string::npos ? colon : slash) + 1);
  return view;
}

Result<renderer::Done> check_output(const std::vector<std::string>& paths,
                                    const PictureOptions& options) {
  for (const std::string& path : paths)
    if (const auto ok = renderer::check_writable(path); !ok) return ok.error();
  const renderer::Film one{1, 1, {{0, 0, 0}}, {0}};
  if (const auto shown = renderer::display_values(one, view_of(options)); !shown)
    return shown.error();
  return renderer::Done{};
}

std::string error_text(std::uint32_t samples, double error) {
  return tells_error(samples) ? fmt::format("{:.2g}", error) : "unknown";
}

namespace {

/// Numbers of all samples that there are: `0:64`, `0:64 128:192`.
std::string numbers(const renderer::PartialFilm& film) {
  renderer::SampleSet all;
  for (const renderer::SampleSet& tile : film.done)
    for (const renderer::SampleSet::Range& r : tile.ranges()) all.add(r);
  std::string text;
  for (const auto& [first, end] : all.ranges())
    text += fmt::format("{}{}:{}", text.empty() ? "" : " ", first, end);
  return text;
}

}  // namespace

renderer::Metadata metadata(const std::string& path, const renderer::FilmKey& key,
                            const renderer::PartialFilm& film) {
  const std::uint32_t fewest = film.fewest_samples();
  renderer::Metadata all{
      {"Software", "mms " MMS_VERSION},
      {"mms:seed", fmt::format("{}", key.seed)},
      {"mms:samples", fmt::format("{}", fewest)},
      {"mms:sample_numbers", numbers(film)},
      {"mms:filter", std::string(renderer::filters()[std::size_t(key.filter)].name)},
      {"mms:depth", fmt::format("{}", key.max_depth)},
      {"mms:sampler", std::string(renderer::generators()[std::size_t(key.generator)].name)},
      {"mms:estimator", std::string(renderer::estimators()[std::size_t(key.estimator)].name)},
      {"mms:script", fmt::format("{:016x}", key.script)},
      {"mms:scene", fmt::format("{:016x}", key.scene)}};
  if (tells_error(fewest)) {
    const double error = renderer::ErrorEstimate(film).rmse();
    all.emplace_back("mms:error", fmt::format("{:.4g}", error));
  }
  if (path.ends_with(".exr")) all.emplace_back("mms:command", command_line());
  return all;
}

}  // namespace mms::tools
