// SPDX-License-Identifier: Apache-2.0
#include "vm/images.h"

#include <algorithm>

#include "vm/interval.h"

namespace mms::vm {
namespace {

class Magenta : public Image {
 public:
  void look_up(ImageAsk ask, const float* const*, float* const* out, int lanes) const override {
    fill(ask, out, lanes);
  }
  void look_up64(ImageAsk ask, const double* const*, double* const* out, int lanes) const override {
    fill(ask, out, lanes);
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
  bool answers(ImageAsk) const override { return true; }
  void enclose(ImageAsk ask, const Interval*, Interval* out) const override {
    for (int k = 0; k < result_count(ask); ++k) out[k] = Interval::point(part(ask, k));
  }

 private:
  static int part(ImageAsk ask, int k) { return is_slope(ask) || k == 1 ? 0 : 1; }
  template <class R>
  static void fill(ImageAsk ask, R* const* out, int lanes) {
    for (int k = 0; k < result_count(ask); ++k) std::fill_n(out[k], lanes, R(part(ask, k)));
  }
};

void look_up_run(const Image& image, ImageAsk ask, const float* const* in, float* const* out,
                 int lanes) {
  image.look_up(ask, in, out, lanes);
}
void look_up_run(const Image& image, ImageAsk ask, const double* const* in, double* const* out,
                 int lanes) {
  image.look_up64(ask, in, out, lanes);
}

template <class R>
void look_up(ImageAsk ask, const Image* const* images, int count, const void* const* in,
             void* const* out, int lanes) {
  const auto* handles = static_cast<const std::int32_t*>(in[0]);
  for (int first = 0, end; first < lanes; first = end) {
    const std::int32_t handle = handles[first];
    for (end = first + 1; end < lanes && handles[end] == handle;) ++end;
    const R* from[kImageArguments];
    R* to[result_count(ImageAsk::ColourSlope)];
    for (int k = 0; k < argument_count(ask); ++k)
      from[k] = static_cast<const R*>(in[1 + k]) + first;
    for (int k = 0; k < result_count(ask); ++k) to[k] = static_cast<R*>(out[k]) + first;
    look_up_run(image_of(ask, images, count, handle), ask, from, to, end - first);
  }
}

}  // namespace

void Image::enclose(ImageAsk ask, const Interval*, Interval* out) const {
  double low = -Interval::kInf, high = Interval::kInf;
  if (!is_slope(ask)) range(low, high);
  std::fill_n(out, result_count(ask), Interval{std::min(low, 0.0), std::max(high, 0.0), false});
}

std::shared_ptr<const Image> magenta() {
  static const auto image = std::make_shared<const Magenta>();
  return image;
}

const Image& image_of(ImageAsk ask, const Image* const* images, int count, double number) {
  const bool there = number >= 0 && number < count;
  const Image* const image = there ? images[static_cast<int>(number)] : nullptr;
  return image && image->answers(ask) ? *image : *magenta();
}

template <ImageAsk ask, class R>
void image_kernel(const Image* const* images, int count, const void* const* in, void* const* out,
                  int lanes) {
  look_up<R>(ask, images, count, in, out, lanes);
}
template <ImageAsk ask, class R>
void no_image_kernel(const void* const* in, void* const* out, int lanes) {
  look_up<R>(ask, nullptr, 0, in, out, lanes);
}

#define KERNELS(ask, R)                                                                          \
  template void image_kernel<ask, R>(const Image* const*, int, const void* const*, void* const*, \
                                     int);                                                       \
  template void no_image_kernel<ask, R>(const void* const*, void* const*, int);
#define KERNELS_OF(ask) KERNELS(ImageAsk::ask, float) KERNELS(ImageAsk::ask, double)
KERNELS_OF(Number)
KERNELS_OF(NumberSlope)
KERNELS_OF(Colour)
KERNELS_OF(ColourSlope)
KERNELS_OF(Curve)
KERNELS_OF(CurveSlope)
#undef KERNELS_OF
#undef KERNELS

}  // namespace mms::vm
