// SPDX-License-Identifier: Apache-2.0
// mms compare: two pictures to numbers and a picture.
#include "tools/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "materials/colour.h"
#include "renderer/compare.h"
#include "tools/output.h"
#include "tools/overwrite.h"

namespace mms::tools {

namespace {

using renderer::Comparison;
using renderer::ReadPicture;
using renderer::Rect;
using Json = nlohmann::ordered_json;

/// `X,Y,W,H`; nothing where that is not given.
Result<std::optional<Rect>> read_crop(const std::string& text) {
  if (text.empty()) return std::optional<Rect>();
  int v[4];
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &v[0], &v[1], &v[2], &v[3], &rest) != 4)
    return Error{"--crop", fmt::format("`{}` is no part of a picture", text),
                 "left, top, width and height in pixels, as in --crop 128,64,200,100"};
  return std::optional<Rect>(Rect{v[0], v[1], v[0] + v[2], v[1] + v[3]});
}

/// Black, blue, red, yellow, white for 0 to 1.
std::array<unsigned char, 3> false_colour(double t) {
  constexpr double kRamp[][3] = {
      {0, 0, 0}, {40, 40, 200}, {220, 30, 30}, {250, 220, 40}, {255, 255, 255}};
  const double at = std::clamp(t, 0.0, 1.0) * 4;
  const int i = std::min(3, int(at));
  std::array<unsigned char, 3> c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = static_cast<unsigned char>(
        std::lround(kRamp[i][k] + (at - i) * (kRamp[i + 1][k] - kRamp[i][k])));
  return c;
}

/// What is white in the difference picture.
double brightest(const Comparison& c) {
  const double most = c.map.empty() ? 0 : double(*std::max_element(c.map.begin(), c.map.end()));
  return most > 0 ? most : 1;
}

Result<renderer::Done> write_difference(const CompareRequest& request, const ReadPicture& a,
                                        const ReadPicture& b, const Rect& r, const Comparison& c) {
  const int width = r.width(), height = r.y1 - r.y0;
  if (request.output.ends_with(".exr")) {
    renderer::Film film{width, height, {}, std::vector<double>(r.area())};
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) {
        const std::size_t i = std::size_t(y) * std::size_t(a.width) + std::size_t(x);
        const auto &p = a.rgb[i], &q = b.rgb[i];
        const Vec3d xyz = materials::xyz_of_linear_srgb({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
        film.xyz.push_back({xyz.x, xyz.y, xyz.z});
      }
    return renderer::write_picture(request.output, {film});
  }
  std::vector<unsigned char> pixels;
  const double white = brightest(c);
  for (const float v : c.map)
    for (const unsigned char k : false_colour(double(v) / white)) pixels.push_back(k);
  return renderer::write_png(request.output, width, height, pixels);
}

Json to_json(const CompareRequest& request, const Comparison& c, bool above) {
  Json json{{"picture", request.picture}, {"reference", request.reference}};
  for (const renderer::MeasureInfo& m : renderer::measures())
    json[std::string(m.name)] = c[m.measure];
  json["rmse_channels"] = c.channel;
  json["largest"] = c.largest;
  if (c.z) json["z"] = *c.z;
  json["not_finite"] = c.not_finite;
  if (request.limit >= 0) json["above_threshold"] = above;
  return json;
}

void print_report(const CompareRequest& request, const Comparison& c, bool above) {
  if (request.json()) {
    fmt::print("{}\n", to_json(request, c, above).dump());
  } else if (!request.quiet) {
    for (const renderer::MeasureInfo& m : renderer::measures())
      fmt::print("{:<12}{:<12.5g}{}\n", m.name, c[m.measure], m.doc);
    fmt::print("{:<12}{:<12.5g}largest difference of a linear channel\n", "largest", c.largest);
    if (c.z) fmt::print("{:<12}{:<12.5g}in standard errors; 1 is chance\n", "z", *c.z);
    if (!request.output.empty() && !request.output.ends_with(".exr"))
      fmt::print("{}: white is a difference of {:.3g} in [0, 1]\n", request.output, brightest(c));
  }
  if (c.not_finite > 0)
    fmt::print(stderr, "warning: {}: {} {} not finite in one of the pictures\n", request.picture,
               counted(c.not_finite, "pixel"), c.not_finite == 1 ? "is" : "are");
}

}  // namespace

Exit compare_pictures(const CompareRequest& request) {
  if (!request.output.empty()) {
    if (const auto ok = renderer::check_writable(request.output); !ok)
      return fail(Exit::File, ok.error(), request);
    const std::string inputs[] = {request.picture, request.reference};
    if (const auto error = overwrites(request.output, inputs))
      return fail(Exit::Usage, *error, request);
  }
  const auto part = read_crop(request.crop);
  if (!part) return fail(Exit::Usage, part.error(), request);
  const auto a = renderer::read_picture(request.picture, request.layer);
  if (!a) return fail(Exit::File, a.error(), request);
  const auto b = renderer::read_picture(request.reference, request.layer);
  if (!b) return fail(Exit::File, b.error(), request);
  auto c = renderer::compare(*a, *b, view_of(request), *part);
  if (!c) {
    Error error = c.error();
    const bool usage = error.where.starts_with("--");
    if (error.where.empty()) error.where = request.picture;
    return fail(usage ? Exit::Usage : Exit::File, error, request);
  }
  double value = 0;
  for (const renderer::MeasureInfo& m : renderer::measures())
    if (m.name == request.measure) value = (*c)[m.measure];
  const bool above = request.limit >= 0 && (value > request.limit || c->not_finite > 0);
  if (!request.output.empty()) {
    const Rect whole{0, 0, a->width, a->height};
    const auto written = write_difference(request, *a, *b, part->value_or(whole), *c);
    if (!written) return fail(Exit::File, written.error(), request);
  }
  print_report(request, *c, above);
  if (!above) return Exit::Ok;
  return fail(Exit::Differs,
              {request.picture,
               fmt::format("{} is {:.4g}, above {:g}", request.measure, value, request.limit),
               "-o difference.png shows where"},
              request);
}

}  // namespace mms::tools
