// SPDX-License-Identifier: Apache-2.0
#include "renderer/profile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "materials/photometry.h"

namespace mms::renderer {
namespace {

class Profile final : public vm::Image {
 public:
  Profile(materials::Photometry photometry, std::string file)
      : photometry_(std::move(photometry)), file_(std::move(file)) {}

  void look_up(vm::ImageAsk ask, const float* const* in, float* const* out,
               int lanes) const override {
    run(ask, in, out, lanes);
  }
  void look_up64(vm::ImageAsk ask, const double* const* in, double* const* out,
                 int lanes) const override {
    run(ask, in, out, lanes);
  }

  std::optional<double> number(std::string_view name) const override {
    if (name == "width") return photometry_.columns();
    if (name == "height") return photometry_.rows();
    if (name == "channels") return 1;
    if (name == "bytes") return 8.0 * photometry_.columns() * photometry_.rows();
    if (name == "candela") return photometry_.largest();
    if (name == "lumens") return photometry_.lumens();
    if (name == "watts") return photometry_.watts();
    return std::nullopt;
  }

  void range(double& low, double& high) const override {
    low = 0;
    high = photometry_.largest();
  }

  std::vector<std::string> files() const override { return {file_}; }

 private:
  template <class R>
  void run(vm::ImageAsk ask, const R* const* in, R* const* out, int lanes) const {
    const int results = vm::result_count(ask);
    for (int i = 0; i < lanes; ++i) {
      const R u = in[0][i], v = in[1][i];
      R values[2] = {0, 0};
      if (std::isfinite(u) && std::isfinite(v) && v >= 0 && v <= 1) {
        const double h = 360.0 * u, t = 180.0 * v;
        if (vm::is_slope(ask)) {
          const auto s = photometry_.slope(h, t);
          values[0] = R(s.horizontal * 360);
          values[1] = R(s.vertical * 180);
        } else {
          values[0] = values[1] = R(photometry_.intensity(h, t));
        }
      }
      for (int k = 0; k < results; ++k) out[k][i] = values[k % 2];
    }
  }

  materials::Photometry photometry_;
  std::string file_;
};

}  // namespace

bool is_profile(const std::string& file) {
  if (file.size() < 4) return false;
  std::string end = file.substr(file.size() - 4);
  std::transform(end.begin(), end.end(), end.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return end == ".ies";
}

Result<std::shared_ptr<const vm::Image>> open_profile(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return Error{file, "is a folder, not a photometric file", "name a file in it"};
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  if (!in.good() && !in.eof()) return Error{file, "cannot be read", ""};
  auto photometry = materials::Photometry::parse(text);
  if (!photometry)
    return Error{file, "is not understood: " + photometry.error().what, photometry.error().hint};
  return std::shared_ptr<const vm::Image>(std::make_shared<Profile>(std::move(*photometry), file));
}

}  // namespace mms::renderer
