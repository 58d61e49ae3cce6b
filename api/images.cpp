// SPDX-License-Identifier: Apache-2.0
#include "api/images.h"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "materials/curve.h"

namespace mms::api {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "mms_images.so";

/// Where the module may be: beside the program or library that this is part of, or in the folder of
/// libraries beside it.
std::vector<fs::path> places() {
  std::vector<fs::path> all;
  std::error_code error;
  std::vector<fs::path> objects{fs::read_symlink("/proc/self/exe", error)};
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&places), &self) && self.dli_fname)
    objects.push_back(fs::absolute(self.dli_fname, error));
  for (const fs::path& object : objects) {
    const fs::path folder = object.parent_path();
    for (const fs::path& place :
         {folder, folder / "mms", folder / ".." / MMS_LIBRARY_FOLDER / "mms"})
      all.push_back(place / kModule);
  }
  return all;
}

}  // namespace

void* image_module(const char* entry) {
  std::error_code error;
  for (const fs::path& place : places()) {
    if (!fs::exists(place, error)) continue;
    void* const module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) continue;
    if (void* const found = dlsym(module, entry)) return found;
  }
  return nullptr;
}

Error no_image_module(const std::string& file) {
  return {file, "there is no OpenImageIO here",
          std::string("install `") + kModule + "`, which is built with the renderer"};
}

Result<std::shared_ptr<const vm::Image>> ImageLibrary::open(const vm::ImageUse& use) {
  if (use.filter == vm::kCurveFilter) return materials::open_curve(use);
  if (!source_) {
    void* const entry = image_module("mms_open_images");
    if (!entry) return no_image_module(use.file);
    source_.reset(reinterpret_cast<vm::ImageSource* (*)(double)>(entry)(megabytes_));
  }
  return source_->open(use);
}

}  // namespace mms::api
