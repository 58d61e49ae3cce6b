// SPDX-License-Identifier: Apache-2.0
// The twins in double: what every output is compared with.
#include "bench/twins_scalar.h"

namespace mms::bench {
const Named<Twin<double>> kOracles[] = {MMS_TWINS(double)};
}
