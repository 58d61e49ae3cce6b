// SPDX-License-Identifier: Apache-2.0
// The verbs over pictures in a build without Embree and OpenImageIO.
#include "tools/compare.h"
#include "tools/converge.h"
#include "tools/merge.h"
#include "tools/render.h"

namespace mms::tools {

namespace {

Exit no_renderer(const char* verb, const ScriptOptions& options) {
  return fail(Exit::Usage,
              {verb, "this mms was built without the renderer",
               "build the preset `release`; `mms check` and `mms eval` work here too"},
              options);
}

}  // namespace

Exit render_pictures(const RenderRequest& request) { return no_renderer("mms render", request); }
Exit merge_films(const MergeRequest& request) { return no_renderer("mms merge", request); }
Exit compare_pictures(const CompareRequest& request) { return no_renderer("mms compare", request); }
Exit measure_convergence(const ConvergeRequest& request) {
  return no_renderer("mms converge", request);
}

}  // namespace mms::tools
