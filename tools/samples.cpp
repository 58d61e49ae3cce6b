// SPDX-License-Identifier: Apache-2.0
#include "tools/samples.h"

#include <charconv>

#include <fmt/format.h>

namespace mms::tools {

namespace {

constexpr int kMostSamples = 10'000'000;

}  // namespace

void add_sample_options(Verb& verb, SampleOptions& options, const std::string& count) {
  options.samples = count;
  verb.add({"--samples", &options.samples, "N", "Points to run the script at"});
  verb.add({"--box", &options.box, "X0,Y0,Z0,X1,Y1,Z1",
            "Spread the points over a box, metres; else over the unit sphere"});
}

Result<api::Samples> samples_of(const SampleOptions& options) {
  api::Samples samples;
  const std::string& text = options.samples;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), samples.count);
  if (failed != std::errc() || end != text.data() + text.size() || samples.count < 1 ||
      samples.count > kMostSamples)
    return Error{"--samples", fmt::format("`{}` is no number of points", text),
                 fmt::format("a whole number from 1 to {}", kMostSamples)};
  if (options.box.empty()) return samples;
  const auto box = api::parse_box(options.box);
  if (!box) return box.error();
  samples.box = *box;
  return samples;
}

}  // namespace mms::tools
