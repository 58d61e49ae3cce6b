// SPDX-License-Identifier: Apache-2.0
// mms profile: which lines of a script take the time.
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/accuracy.h"
#include "api/excerpts.h"
#include "api/inputs.h"
#include "tools/commands.h"
#include "tools/samples.h"
#include "vm/profile.h"

namespace mms::tools {

namespace {

using Json = nlohmann::ordered_json;

/// Runs every entry of every descriptor over the points.
void run_all(const vm::Program& program, const vm::Executable& exe, const api::Samples& samples,
             vm::Profile& profile) {
  vm::InputBatch<float> in(exe.width());
  vm::Interpreter<float> machine(exe.width());
  api::fill_defaults(in);
  for (const vm::Descriptor& d : program.descriptors)
    for (const vm::Entry* e : {&d.shade, &d.pass, &d.emit, &d.displace}) {
      if (!e->function) continue;
      machine.run(exe, *e->function, in, 1);  // what is made once does not count
      for (int first = 0; first < samples.count; first += exe.width()) {
        const int lanes = std::min(exe.width(), samples.count - first);
        api::fill_samples(in, samples, first, lanes);
        profile.run(machine, *e->function, in, lanes);
      }
    }
}

void print_json(const vm::Program& program, const std::vector<vm::Profile::LineCost>& lines,
                api::Excerpts& excerpts) {
  Json json = Json::array();
  for (const vm::Profile::LineCost& l : lines)
    json.push_back({{"place", api::place(program, l.line)},
                    {"share", l.share},
                    {"seconds", l.seconds},
                    {"instructions", l.instructions},
                    {"text", excerpts.line(l.line)}});
  fmt::print("{}\n", json.dump(2));
}

/// Every line of the script from its first to its last that took time, with its share.
void print_listing(const vm::Program& program, const std::vector<vm::Profile::LineCost>& lines,
                   const std::string& file, api::Excerpts& excerpts) {
  std::map<std::uint32_t, double> shares;
  std::uint32_t source = 0;
  for (const vm::Profile::LineCost& l : lines)
    if (l.line.source < program.sources.size() && program.sources[l.line.source] == file) {
      shares[l.line.line] = l.share;
      source = l.line.source;
    }
  if (shares.empty()) return;
  fmt::print("\n{}\n", file);
  for (std::uint32_t n = shares.begin()->first; n <= shares.rbegin()->first; ++n) {
    const auto share = shares.find(n);
    const std::string text = excerpts.line({source, n, 0});
    fmt::print("{:>6} {:>4} | {}\n",
               share == shares.end() ? "" : fmt::format("{:.1f}%", 100 * share->second), n, text);
  }
}

Exit profile(const SampleOptions& options) {
  const auto samples = samples_of(options);
  if (!samples) return fail(Exit::Usage, samples.error(), options);
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  const vm::Program& program = linked->program;
  const vm::Executable exe(program);
  vm::Profile profile(exe);
  run_all(program, exe, *samples, profile);
  std::vector<vm::Profile::LineCost> lines = profile.by_line();
  std::erase_if(lines, [](const auto& l) { return l.seconds == 0; });
  api::Excerpts excerpts(program);
  if (options.json()) {
    print_json(program, lines, excerpts);
    return exit;
  }
  if (lines.empty()) fmt::print("every output is constant: there is nothing to run\n");
  for (const vm::Profile::LineCost& l : lines)
    fmt::print("{:>6} {:>9.3g} ns a point  {}  {}\n", fmt::format("{:.1f}%", 100 * l.share),
               1e9 * l.seconds / samples->count, api::place(program, l.line),
               excerpts.line(l.line));
  for (const std::string& file : options.files) print_listing(program, lines, file, excerpts);
  return exit;
}

}  // namespace

Verb profile_verb() {
  auto options = std::make_shared<SampleOptions>();
  Verb verb{"profile",
            "Tell which lines of a script take the time",
            "Examples:\n  mms profile marble.mms\n  mms profile --samples=1000000 marble.mms",
            {},
            [options] { return profile(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_sample_options(verb, *options, "65536");
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
