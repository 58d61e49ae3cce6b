// SPDX-License-Identifier: Apache-2.0
// The scalar twins by the compiler that builds everything else.
#include "bench/twins_scalar.h"

namespace mms::bench {
const Named<Twin<float>> kGccTwins[] = {MMS_TWINS(float)};
}
