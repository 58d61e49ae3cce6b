// SPDX-License-Identifier: Apache-2.0
#include "vm/images.h"

#include <algorithm>

namespace mms::vm {
namespace {

class Magenta : public Image {
 public:
  void look_up(ImageAsk ask, const float* const*, float* const* out, int lanes) const override {
    const bool slope = ask == ImageAsk::NumberSlope || ask == ImageAsk::ColourSlope;
    for (int k = 0; k < result_count(ask); ++k)
      std::fill_n(out[k], lanes, slope || k == 1 ? 0.0f : 1.0f);
  }
  std::optional<double> number(std::string_view name) const override {
    if (name == "width" || name == "height") return 1;
    return name == "channels" ? std::optional<double>(3) : std::nullopt;
  }
  void range(double& low, double& high) const override {
    low = 0;
    high = 1;
  }
  std::vector<std::string> files() const override { return {}; }
};

/// Lanes of one picture, `at` on.
void look_up_run(const Image& image, ImageAsk ask, const void* const* in, void* const* out, int at,
                 int lanes, float) {
  const float* from[kImageArguments];
  float* to[result_count(ImageAsk::ColourSlope)];
  for (int k = 0; k < kImageArguments; ++k) from[k] = static_cast<const float*>(in[1 + k]) + at;
  for (int k = 0; k < result_count(ask); ++k) to[k] = static_cast<float*>(out[k]) + at;
  image.look_up(ask, from, to, lanes);
}

/// Pictures are made of floats: so is what the double machine is told of them.
void look_up_run(const Image& image, ImageAsk ask, const void* const* in, void* const* out, int at,
                 int lanes, double) {
  constexpr int kChunk = 64, kMost = result_count(ImageAsk::ColourSlope);
  float arguments[kImageArguments][kChunk], results[kMost][kChunk];
  for (int first = at; first < at + lanes; first += kChunk) {
    const int n = std::min(kChunk, at + lanes - first);
    const float* from[kImageArguments];
    float* to[kMost];
    for (int k = 0; k < kImageArguments; ++k) {
      const double* values = static_cast<const double*>(in[1 + k]) + first;
      for (int i = 0; i < n; ++i) arguments[k][i] = static_cast<float>(values[i]);
      from[k] = arguments[k];
    }
    for (int k = 0; k < kMost; ++k) to[k] = results[k];
    image.look_up(ask, from, to, n);
    for (int k = 0; k < result_count(ask); ++k)
      std::copy_n(results[k], n, static_cast<double*>(out[k]) + first);
  }
}

}  // namespace

std::shared_ptr<const Image> magenta() {
  static const auto image = std::make_shared<const Magenta>();
  return image;
}

template <class R>
void look_up(ImageAsk ask, const Image* const* images, int count, const void* const* in,
             void* const* out, int lanes) {
  const auto* handles = static_cast<const std::int32_t*>(in[0]);
  for (int first = 0, end; first < lanes; first = end) {
    const std::int32_t handle = handles[first];
    for (end = first + 1; end < lanes && handles[end] == handle;) ++end;
    const bool there = handle >= 0 && handle < count && images[handle];
    look_up_run(there ? *images[handle] : *magenta(), ask, in, out, first, end - first, R());
  }
}

template void look_up<float>(ImageAsk, const Image* const*, int, const void* const*, void* const*,
                             int);
template void look_up<double>(ImageAsk, const Image* const*, int, const void* const*, void* const*,
                              int);

}  // namespace mms::vm
