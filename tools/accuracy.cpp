// SPDX-License-Identifier: Apache-2.0
// mms accuracy: what rounding to float does to the outputs of a script.
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/accuracy.h"
#include "tools/commands.h"
#include "tools/samples.h"

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

void print_json(const api::Accuracy& report) {
  Json json{{"outputs", Json::array()}, {"speeds", Json::array()}, {"given_up", report.given_up}};
  for (const api::OutputAccuracy& o : report.outputs)
    json["outputs"].push_back({{"descriptor", o.descriptor},
                               {"output", o.output},
                               {"compared", o.compared},
                               {"worst_ulp", o.worst_ulp},
                               {"median_ulp", o.median_ulp},
                               {"worst_absolute", o.worst_absolute},
                               {"median_absolute", o.median_absolute},
                               {"point", o.point},
                               {"float", o.float_value},
                               {"double", o.double_value},
                               {"not_finite", o.not_finite},
                               {"lost", o.lost},
                               {"made_at", o.made_at}});
  for (const api::EntrySpeed& s : report.speeds)
    json["speeds"].push_back({{"descriptor", s.descriptor},
                              {"entry", s.entry},
                              {"float_points_per_second", s.float_points},
                              {"double_points_per_second", s.double_points}});
  fmt::print("{}\n", json.dump(2));
}

void print_text(const api::Accuracy& report) {
  if (report.outputs.empty()) fmt::print("every output is constant\n");
  for (const api::OutputAccuracy& o : report.outputs) {
    fmt::print("{} {}: {}\n", o.descriptor, o.output, counted(o.compared, "number"));
    if (o.compared > 0) {
      fmt::print("  ulp       worst {:<10.3g} median {:.3g}\n", o.worst_ulp, o.median_ulp);
      fmt::print("  absolute  worst {:<10.3g} median {:.3g}\n", o.worst_absolute,
                 o.median_absolute);
      fmt::print("  worst in ulp at [{:.9g}, {:.9g}, {:.9g}]: {:.9g} for {:.17g}\n", o.point[0],
                 o.point[1], o.point[2], o.float_value, o.double_value);
    }
    if (o.not_finite > 0)
      fmt::print("  {} infinite or NaN, {} of them in float alone; first made at {}\n",
                 o.not_finite, o.lost, o.made_at);
  }
  for (const api::EntrySpeed& s : report.speeds)
    fmt::print("{} {}: {:.3g} points a second in float, {:.3g} in double ({:.2f} times)\n",
               s.descriptor, s.entry, s.float_points, s.double_points,
               s.float_points / s.double_points);
  if (report.given_up > 0) fmt::print("{} ran out of budget\n", counted(report.given_up, "point"));
}

Exit accuracy(const SampleOptions& options) {
  const auto samples = samples_of(options);
  if (!samples) return fail(Exit::Usage, samples.error(), options);
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  const api::Accuracy report = api::accuracy(linked->program, *samples);
  options.json() ? print_json(report) : print_text(report);
  return exit;
}

}  // namespace

Verb accuracy_verb() {
  auto options = std::make_shared<SampleOptions>();
  Verb verb{"accuracy",
            "Compare a script's outputs in float with the same in double",
            "Examples:\n  mms accuracy marble.mms\n"
            "  mms accuracy --samples=100000 --box=0,0,0,1000,1000,1000 marble.mms\n"
            "  mms accuracy --format=json marble.mms | jq '.outputs[].worst_ulp'",
            {},
            [options] { return accuracy(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_sample_options(verb, *options, "4096");
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
