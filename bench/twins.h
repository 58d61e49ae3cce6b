// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The suite's shaders written in C++: what each is compared with, in time and in value.

#include <cstddef>

namespace mms::bench {

/// One shading point, as a native renderer would hand it to a shader.
template <class R>
struct Point {
  R position[3], uv[2], normal[3], view[3], tangent[3], bitangent[3];
  R red[8], green[8];  ///< thesis Table 6.1 at the wavelengths of the path
};

/// Shades one point; writes as many numbers as the shader has.
template <class R>
using Twin = void (*)(const Point<R>&, R*);

/// Inputs of a hand-vectorised twin: arrays of lanes.
struct Lanes {
  const float *position[3], *uv[2], *normal[3], *view[3], *tangent[3], *bitangent[3];
  const float *red[8], *green[8];
};
/// Shades `n` points, a multiple of 8. `out[k]` is an array of lanes.
using VectorTwin = void (*)(const Lanes&, float* const* out, int n);

template <class F>
struct Named {
  const char* name;
  F twin;
};

/// Each ends with a null name. Which compiler and which options: bench/CMakeLists.txt.
extern const Named<Twin<float>> kGccTwins[];
extern const Named<Twin<float>> kClangTwins[];  // only a terminator where there is no clang
extern const Named<Twin<double>> kOracles[];
extern const Named<VectorTwin> kVectorTwins[];

}  // namespace mms::bench
