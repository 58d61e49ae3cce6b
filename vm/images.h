// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures from files, as scripts look them up. Who reads the files is handed in: the machine and
/// the linker know this interface alone.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "vm/builtin.h"

namespace mms::vm {

/// Which picture, and how it is read. The words are those of the tables below.
struct ImageUse {
  std::string file;    ///< `<UDIM>` stands for the numbers of tiles, 1001 on
  std::string filter;  ///< between texels
  std::string wrap;    ///< outside [0, 1]
  std::string space;   ///< of the file's numbers: `auto`, `linear`, `sRGB`, or one of OpenColorIO
  std::string
      channel;  ///< of a number: a name or a place from 0; empty: luminance, or the only one
  std::string storage;  ///< in memory
  friend bool operator==(const ImageUse&, const ImageUse&) = default;
};

/// A word that a script may write, and what it means: the manual prints it.
struct ImageWord {
  std::string_view word, doc;
};
inline constexpr ImageWord kImageFilters[] = {
    {"nearest", "the texel itself"},
    {"bilinear", "straight between texels"},
    {"bicubic", "a cubic B-spline: smooth, and a little soft"},
    {"smart", "bicubic where the picture is magnified, else bilinear"},
};
inline constexpr ImageWord kImageWraps[] = {
    {"repeat", "again and again"},
    {"mirror", "again and again, every other one mirrored"},
    {"clamp", "the texels of the border"},
    {"black", "0"},
};
inline constexpr ImageWord kImageStorages[] = {
    {"raw", "numbers as they are; pieces are read from the file, and kept within the budget"},
    {"compressed", "all of it in memory, in blocks of 4 x 4: smaller, slower, and not exact"},
};

/// In the place of a filter: a table of numbers over the wavelength, not a picture. `space` is then
/// the unit of its wavelengths, `channel` the column.
inline constexpr std::string_view kCurveFilter = "table";
inline constexpr ImageWord kCurveUnits[] = {
    {"nm", "nanometres"}, {"um", "micrometres"}, {"m", "metres"}};

/// What a row wants of a picture or a curve.
enum class ImageAsk : std::uint8_t { Number, NumberSlope, Colour, ColourSlope, Curve, CurveSlope };
constexpr int result_count(ImageAsk ask) {
  constexpr int kCounts[] = {1, 2, 3, 6, 1, 1};
  return kCounts[static_cast<int>(ask)];
}
/// Whether the results are slopes: 0 of what is not there.
constexpr bool is_slope(ImageAsk ask) {
  return ask == ImageAsk::NumberSlope || ask == ImageAsk::ColourSlope ||
         ask == ImageAsk::CurveSlope;
}
/// Reals that say where: of a picture the point, its change across the pixel's x and y axis, and
/// the blur, each u and v. (0, 0) is the lower left corner of the picture, (1, 1) the upper right
/// one. Of a curve the wavelength in metres.
inline constexpr int kImageArguments = 8;
constexpr int argument_count(ImageAsk ask) {
  return ask == ImageAsk::Curve || ask == ImageAsk::CurveSlope ? 1 : kImageArguments;
}

/// How far a lookup in float is from one in double, at most, as a part of the largest magnitude of
/// its texels; of a slope, of the largest difference of neighbours times columns or rows. At a
/// point: part of a texel to 1.5 units in the last place on two axes, each worth twice the largest
/// magnitude, and 18 roundings of weights and sums.
inline constexpr double kImagePointError = 0x1p-19;
/// Where the pixel covers texels: probes are up to 32 of a level away, 12 in the mean, and all of
/// them move, by some 50 units in the last place, with the axes of the pixel.
inline constexpr double kImagePixelError = 0x1p-13;

/// How far it may be outside what its texels span, as a part of their largest magnitude: 10
/// roundings of weights and sums along each axis, 34 of sums over probes, 5 of levels. Of a slope
/// too, which is a mean of differences.
inline constexpr double kImageRounding = 0x1p-18;

/// An open picture or curve. Immutable; any number of threads may ask.
class Image {
 public:
  virtual ~Image() = default;
  /// Fills result_count(ask) blocks. Slopes are by u and v: of red by u, by v, of green by u, ...
  /// Where an argument is not finite the results are 0.
  virtual void look_up(ImageAsk ask, const float* const* in, float* const* out,
                       int lanes) const = 0;
  /// The same for the double machine: reckoned in double, from what is stored.
  virtual void look_up64(ImageAsk ask, const double* const* in, double* const* out,
                         int lanes) const = 0;
  /// `width`, `height`, `channels`, `bytes` in memory, or a number that the file itself states by
  /// that name.
  virtual std::optional<double> number(std::string_view name) const = 0;
  /// Nothing but slopes is ever outside.
  virtual void range(double& low, double& high) const = 0;
  /// Whether that can be asked. Scripts may name a picture where a curve is meant.
  virtual bool answers(ImageAsk ask) const { return argument_count(ask) == kImageArguments; }
  /// What the results can be over a box of the arguments, before what float rounds: here their
  /// range and 0, and any slope.
  virtual void enclose(ImageAsk ask, const Interval* in, Interval* out) const;
  /// The files it is read from.
  virtual std::vector<std::string> files() const = 0;
};

/// Opens pictures.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  /// The error's `what` goes on after the file's name: `does not exist`.
  virtual Result<std::shared_ptr<const Image>> open(const ImageUse& use) = 0;
};

/// What stands for a picture that is not there: magenta everywhere; as a number 1.
std::shared_ptr<const Image> magenta();

/// A picture of a program. Stored programs have it opened after they are loaded.
struct ProgramImage {
  ImageUse use;
  std::shared_ptr<const Image> image;  ///< null: magenta
  friend bool operator==(const ProgramImage& a, const ProgramImage& b) { return a.use == b.use; }
};

/// The picture with that number among `count`, if it is there and answers; else magenta.
const Image& image_of(ImageAsk ask, const Image* const* images, int count, double number);

/// Looks up lanes whose first argument is the place of a picture among `count` images; others, and
/// all lanes of `no_image_kernel`, are magenta. Both are in images.cpp for every `ask`, R is float
/// or double.
template <ImageAsk ask, class R>
void image_kernel(const Image* const* images, int count, const void* const* in, void* const* out,
                  int lanes);
template <ImageAsk ask, class R>
void no_image_kernel(const void* const* in, void* const* out, int lanes);

/// All kernels of `ask` in a row.
template <ImageAsk ask>
constexpr Builtin image_builtin(Builtin row) {
  row.f32 = no_image_kernel<ask, float>;
  row.f64 = no_image_kernel<ask, double>;
  row.image32 = image_kernel<ask, float>;
  row.image64 = image_kernel<ask, double>;
  row.image_ask = ask;
  return row;
}

}  // namespace mms::vm
