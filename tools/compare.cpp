// SPDX-License-Identifier: Apache-2.0
// mms compare: its options.
#include "tools/compare.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "tools/commands.h"

namespace mms::tools {

namespace {

Exit compare(CompareRequest request) {
  if (const auto error = read_picture_options(request)) return fail(Exit::Usage, *error, request);
  if (!request.threshold.empty()) {
    const auto limit = number<double>(request.threshold);
    if (!limit || !(*limit >= 0) || !std::isfinite(*limit))
      return fail(Exit::Usage,
                  {"--threshold", fmt::format("`{}` is no threshold", request.threshold),
                   "a number from 0 up; 0 asks for equal pictures"},
                  request);
    request.limit = *limit;
  }
  return compare_pictures(request);
}

}  // namespace

Verb compare_verb() {
  auto request = std::make_shared<CompareRequest>();
  CompareRequest& r = *request;
  Verb verb{
      "compare",
      "Tell how two pictures differ",
      "The second picture is the reference. Measures are 0 for equal pictures:\n"
      "  rmse        root mean square of linear values, channels weighted 0.21, 0.72, 0.07\n"
      "  rmse-shown  the same of display values in [0, 1]; .exr by --view\n"
      "  relmse      mean of (a - b)^2 / (b^2 + 0.01)\n"
      "  dssim       1 - structural similarity of display values\n"
      "For pictures that hold their variance, z is the root mean square of the difference in\n"
      "standard errors: near 1 for renders of one scene with other seeds.\n\nExamples:\n"
      "  mms compare marble.exr reference.exr\n"
      "  mms compare marble.png old.png --threshold 0.002 -o difference.png\n"
      "  mms compare a.exr b.exr --layer albedo --format=json",
      {},
      [request] { return compare(*request); }};
  verb.add(
      {"PICTURE", &r.picture, "PICTURE", "Picture, of any kind that OpenImageIO reads", {}, true});
  verb.add({"REFERENCE", &r.reference, "REFERENCE", "What it is compared with", {}, true});
  verb.add({"--threshold", &r.threshold, "T", "End with code 5 where the measure is above T"});
  verb.add({"--measure",
            &r.measure,
            "NAME",
            "The measure that --threshold is for [rmse]",
            {"rmse", "rmse-shown", "relmse", "dssim"}});
  verb.add(
      {"-o,--output", &r.output, "PATH", "Difference: .png in false colours, .exr as numbers"});
  verb.add({"--layer", &r.layer, "NAME", "Compare a layer of .exr pictures instead"});
  verb.add({"--crop", &r.crop, "X,Y,W,H", "Compare a part only, pixels from the top left"});
  add_picture_options(verb, r);
  add_colour_option(verb, r);
  add_format_option(verb, r);
  return verb;
}

}  // namespace mms::tools
