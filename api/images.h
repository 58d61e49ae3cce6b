// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Images and tables for scripts, wherever they are linked. What reads images is a module of its
/// own: it is loaded when the first image is named, for loading OpenImageIO takes longer than
/// linking a script.

#include <memory>

#include "vm/images.h"

namespace mms::api {

/// Megabytes of decoded tiles that images may take together.
inline constexpr double kImageMegabytes = 1024;
/// A petabyte: more is a mistake.
inline constexpr double kMostImageMegabytes = 1 << 30;

/// An entry of the module `mms_images`, which reads and writes images through OpenImageIO; null
/// where there is no such module. Once loaded it stays: what comes from it lives as long as
/// programs.
void* image_module(const char* entry);
/// Says so, of `file`.
Error no_image_module(const std::string& file);

class ImageLibrary final : public vm::ImageSource {
 public:
  explicit ImageLibrary(double megabytes = kImageMegabytes) : megabytes_(megabytes) {}
  Result<std::shared_ptr<const vm::Image>> open(const vm::ImageUse& use) override;

 private:
  double megabytes_;
  std::unique_ptr<vm::ImageSource> source_;
};

}  // namespace mms::api
