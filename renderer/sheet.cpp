// SPDX-License-Identifier: Apache-2.0
// Contact sheets, as OpenImageIO draws them.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>

#include "renderer/openimageio.h"

namespace mms::renderer {
namespace {

/// Where Debian puts fonts-dejavu-core and fonts-liberation, the first that is there.
constexpr const char* kFonts[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

constexpr int kMargin = 4;  ///< pixels around tiles
constexpr float kPaper = 0.14f, kInk = 0.88f;

std::string find_font() {
  for (const char* font : kFonts)
    if (OIIO::ImageBufAlgo::text_size("x", 12, font).defined()) return font;
  return "";
}

/// The size of letters, at most `size`, at which no line of a caption is wider than `width`.
int fitting_size(const std::vector<SheetTile>& tiles, const std::string& font, int width,
                 int size) {
  int widest = width;
  for (const SheetTile& tile : tiles)
    for (const std::string& line : tile.caption) {
      const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(line, size, font);
      if (box.defined()) widest = std::max(widest, box.width());
    }
  return std::max(6, size * width / widest);
}

}  // namespace

Sheet in_module::sheet(const std::vector<SheetTile>& tiles, int width, int height, int columns) {
  std::size_t lines = 1;
  for (const SheetTile& tile : tiles) lines = std::max(lines, tile.caption.size());
  const int size = std::clamp(width / 13, 9, 28), strip = size * 7 / 4;
  const int across = width + kMargin, down = height + int(lines) * strip + kMargin;
  const int rows = (int(tiles.size()) + columns - 1) / columns;
  OIIO::ImageBuf image(
      OIIO::ImageSpec(columns * across + kMargin, rows * down + kMargin, 3, OIIO::TypeDesc::UINT8));
  const std::array<float, 3> paper{kPaper, kPaper, kPaper}, ink{kInk, kInk, kInk};
  OIIO::ImageBufAlgo::fill(image, paper);
  const std::string font = find_font();
  const int letters = font.empty() ? size : fitting_size(tiles, font, width, size);
  for (int i = 0; i < int(tiles.size()); ++i) {
    const int x = kMargin + i % columns * across, y = kMargin + i / columns * down;
    const SheetTile& tile = tiles[std::size_t(i)];
    if (!tile.pixels.empty())
      image.set_pixels(OIIO::ROI(x, x + width, y, y + height, 0, 1, 0, 3), OIIO::TypeDesc::UINT8,
                       tile.pixels.data());
    if (font.empty()) continue;
    int below = y + height + strip / 2;
    for (const std::string& line : tile.caption) {
      OIIO::ImageBufAlgo::render_text(image, x + width / 2, below, line, letters, font, ink,
                                      OIIO::ImageBufAlgo::TextAlignX::Center,
                                      OIIO::ImageBufAlgo::TextAlignY::Center);
      below += strip;
    }
  }
  Sheet sheet{image.spec().width, image.spec().height, {}, !font.empty()};
  sheet.pixels.resize(std::size_t(sheet.width) * std::size_t(sheet.height) * 3);
  image.get_pixels(image.roi(), OIIO::TypeDesc::UINT8, sheet.pixels.data());
  return sheet;
}

}  // namespace mms::renderer
