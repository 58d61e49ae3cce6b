// SPDX-License-Identifier: Apache-2.0
// mms converge: its options.
#include "tools/converge.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/picture.h"

namespace mms::tools {

namespace {

constexpr int kMost = 1 << 20;

std::optional<Error> read_numbers(ConvergeRequest& r) {
  const std::size_t colon = r.range.find(':');
  const auto first = number<long long>(r.range.substr(0, colon));
  const auto last =
      colon == std::string::npos ? first : number<long long>(r.range.substr(colon + 1));
  if (!first || !last || *first < 1 || *last < *first || *last > kMost)
    return Error{"--samples", fmt::format("`{}` is no range of samples", r.range),
                 "from how many samples a pixel to how many, doubling, as in --samples 1:64"};
  r.first = int(*first);
  r.last = int(*last);
  r.reference_samples = 8 * r.last;
  if (r.reference.empty()) return {};
  const auto reference = number<long long>(r.reference);
  if (!reference || *reference < 1 || *reference > 8 * kMost)
    return Error{"--reference", fmt::format("`{}` is no number of samples", r.reference),
                 "several times the most of --samples: the reference is taken to be the truth"};
  r.reference_samples = int(*reference);
  return {};
}

/// Switches of renders that make more or less than one picture.
constexpr std::string_view kNotOne[] = {"sweep", "turntable", "watch"};

std::optional<Error> check_switches(const char* option, const std::vector<std::string>& sets) {
  for (const std::string& text : sets) {
    std::istringstream in(text);
    for (std::string word; in >> word;) {
      word = word.substr(std::min(word.find_first_not_of('-'), word.size()));
      const std::string name = word.substr(0, word.find('='));
      if (std::ranges::find(kNotOne, name) != std::end(kNotOne))
        return Error{option, fmt::format("`{}` does not make one picture", name), "leave it out"};
    }
  }
  return std::nullopt;
}

Exit converge(ConvergeRequest request) {
  if (const auto error = read_numbers(request)) return fail(Exit::Usage, *error, request);
  if (const auto error = check_switches("--vary", request.vary))
    return fail(Exit::Usage, *error, request);
  if (const auto error = check_switches("--with", request.with))
    return fail(Exit::Usage, *error, request);
  if (!request.output.ends_with(".csv"))
    return fail(Exit::Usage,
                {"-o", fmt::format("`{}` is no .csv file", request.output),
                 "name one; the plot goes beside it, as .svg"},
                request);
  if (request.files.size() > 1)
    return fail(Exit::Usage,
                {"mms converge", fmt::format("one script, but {} are given", request.files.size()),
                 "measure one at a time"},
                request);
  return measure_convergence(request);
}

}  // namespace

Verb converge_verb() {
  auto request = std::make_shared<ConvergeRequest>();
  ConvergeRequest& r = *request;
  r.output = "converge.csv";
  Verb verb{
      "converge",
      "Measure error against time and samples, for any set of switches",
      "Renders a reference with many samples and another seed, then the same picture with more "
      "and more,\nand writes a table (.csv) and a plot (.svg) of the difference. --vary is "
      "given once for each curve.\nA curve whose switches change the picture itself, as filter, "
      "max-depth, set or scene do, has a\nreference of its own, with the same. Ctrl-C leaves a "
      "table of what was rendered.\n\nExamples:\n"
      "  mms converge marble.mms -o marble.csv\n"
      "  mms converge glass.mms --samples 4:256 --with size=128x128 --with scene=cornell\n"
      "  mms converge marble.mms --vary sampler=niederreiter --vary sampler=random\n"
      "  mms converge marble.mms --vary filter=box --vary 'filter=gaussian max-depth=8'",
      {},
      [request] { return converge(*request); }};
  add_files(verb, r, "The script");
  verb.add({"-o,--output", &r.output, "FILE.csv", "Table; the plot goes beside it"});
  verb.add({"--samples", &r.range, "A:B", "Samples for each pixel, doubling from A to B"});
  verb.add({"--reference", &r.reference, "N", "Samples of the reference [8 B]"});
  verb.add({"--vary", &r.vary, "SWITCHES", "Switches of `mms render` for one curve, without --"});
  verb.add({"--with", &r.with, "SWITCHES", "Switches for all renders, the reference too"});
  verb.add({"--quiet", &r.quiet, "", "Print errors only"});
  add_colour_option(verb, r);
  add_format_option(verb, r);
  return verb;
}

}  // namespace mms::tools
