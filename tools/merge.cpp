// SPDX-License-Identifier: Apache-2.0
// mms merge: its options.
#include "tools/merge.h"

#include <memory>

#include "tools/commands.h"

namespace mms::tools {

namespace {

Exit merge(MergeRequest request) {
  if (const auto error = read_picture_options(request)) return fail(Exit::Usage, *error, request);
  return merge_films(request);
}

}  // namespace

Verb merge_verb() {
  auto request = std::make_shared<MergeRequest>();
  Verb verb{"merge",
            "Add parts of one picture up, rendered apart, or develop a film again",
            "The result has the bits of one render of all the samples.\n\nExamples:\n"
            "  mms render marble.mms --samples 0:64 -o a.film\n"
            "  mms render marble.mms --samples 64:128 -o b.film\n"
            "  mms merge a.film b.film -o marble.exr\n"
            "  mms merge a.film -o bright.png --exposure 1",
            {},
            [request] { return merge(*request); }};
  verb.add(
      {"FILE", &request->films, "FILE...", "Films of one picture, of different samples", {}, true});
  verb.add({"-o,--output",
            &request->output,
            "PATH",
            "Picture (.png or .exr) or film (.film)",
            {},
            true});
  add_picture_options(verb, *request);
  add_colour_option(verb, *request);
  add_format_option(verb, *request);
  return verb;
}

}  // namespace mms::tools
