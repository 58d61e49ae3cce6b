// SPDX-License-Identifier: Apache-2.0
// What the module `mms_images` is loaded for.
#include "renderer/openimageio.h"
#include "renderer/textures.h"

/// The caller owns what it gets.
extern "C" mms::vm::ImageSource* mms_open_images(double megabytes) {
  return mms::renderer::open_textures(megabytes).release();
}

extern "C" const mms::renderer::OpenImageIo* mms_open_image_io() {
  using namespace mms::renderer;
  static constexpr OpenImageIo all{in_module::exr, in_module::read, in_module::sheet,
                                   in_module::display};
  return &all;
}
