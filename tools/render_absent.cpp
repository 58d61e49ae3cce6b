// SPDX-License-Identifier: Apache-2.0
// mms render in a build without Embree and OpenImageIO.
#include "tools/render.h"

namespace mms::tools {

Exit render_pictures(const RenderRequest& request) {
  return fail(Exit::Usage,
              {"mms render", "this mms was built without the renderer",
               "build the preset `release`; `mms check` and `mms eval` work here too"},
              request);
}

}  // namespace mms::tools
