// SPDX-License-Identifier: Apache-2.0
// The scalar twins by clang, where there is one: bench/CMakeLists.txt compiles this with it.
#ifdef __clang__
#include "bench/twins_scalar.h"

namespace mms::bench {
extern const Named<Twin<float>> kClangTwins[];
const Named<Twin<float>> kClangTwins[] = {MMS_TWINS(float)};
}  // namespace mms::bench
#else
#include "bench/twins.h"

namespace mms::bench {
const Named<Twin<float>> kClangTwins[] = {{nullptr, nullptr}};
}
#endif
