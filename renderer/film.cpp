// SPDX-License-Identifier: Apache-2.0
#include "renderer/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mms::renderer {
namespace {

constexpr double kValueUnit = 0x1p40;   // of one sample; times a weight it is 2^64
constexpr double kWeightUnit = 0x1p24;  // two axes of Filter::kBits
constexpr double kSumUnit = 0x1p64;
static_assert(kWeightUnit == double(1 << 2 * Filter::kBits));

/// As many pixels tell the error of a picture to better than one part in a hundred.
constexpr double kProbes = 0x1p18;

int stride_of(int width, int height) {
  return std::max(1, int(std::ceil(std::sqrt(double(width) * height / kProbes))));
}

/// Whole units; nearly all are few enough for half of the digits, which is quicker.
Int128 whole(double units) {
  return std::abs(units) < 0x1p62 ? Int128(std::int64_t(units)) : Int128(units);
}

SampleFate fate_of(const std::array<double, 3>& xyz) {
  for (double v : xyz) {
    if (std::isnan(v)) return SampleFate::NotANumber;
    if (std::isinf(v)) return SampleFate::Infinite;
    if (!(std::abs(v) < kLargestSample)) return SampleFate::Overflow;
  }
  return SampleFate::Added;
}

/// The pixels whose centre is within `radius` of `at`: the first, and the one after the last.
struct Reach {
  int begin, end;
};
Reach reach(double at, double radius, int low, int high) {
  return {std::max(low, int(std::floor(at - 0.5 - radius)) + 1),
          std::min(high, int(std::floor(at - 0.5 + radius)) + 1)};
}

}  // namespace

PixelSums& PixelSums::operator+=(const PixelSums& other) {
  for (int i = 0; i < 3; ++i) xyz[i] += other.xyz[i];
  luminance_square += other.luminance_square;
  weight += other.weight;
  samples += other.samples;
  dropped += other.dropped;
  return *this;
}

BlockSums& BlockSums::operator+=(const BlockSums& other) {
  y += other.y;
  weight += other.weight;
  return *this;
}

FilmSums::FilmSums(int width, int height, FilterShape filter, Rect rect)
    : width_(width),
      height_(height),
      stride_(stride_of(width, height)),
      shape_(filter),
      filter_(&filter_of(filter)) {
  restart(rect);
}

void FilmSums::restart(Rect rect) {
  rect_ = rect;
  pixels_.assign(rect.area(), {});
  for (auto& b : blocks_) b.clear();
  first_across_ = (rect.x0 + stride_ - 1) / stride_;
  first_down_ = (rect.y0 + stride_ - 1) / stride_;
  across_ = (rect.x1 + stride_ - 1) / stride_ - first_across_;
  down_ = (rect.y1 + stride_ - 1) / stride_ - first_down_;
}

std::vector<BlockSums>& FilmSums::open_block(int b) {
  if (b >= int(blocks_.size())) blocks_.resize(std::size_t(b) + 1);
  if (blocks_[b].empty()) blocks_[b].resize(probes());
  return blocks_[b];
}

void FilmSums::restore(std::vector<PixelSums> pixels, std::vector<std::vector<BlockSums>> blocks) {
  assert(pixels.size() == pixels_.size());
  pixels_ = std::move(pixels);
  blocks_ = std::move(blocks);
}

SampleFate FilmSums::add(const FilmSample& s) {
  const SampleFate fate = fate_of(s.xyz);
  Int128 xyz[3] = {0, 0, 0}, y = 0, square = 0;
  if (fate == SampleFate::Added) {
    for (int i = 0; i < 3; ++i) xyz[i] = whole(s.xyz[i] * kValueUnit);
    const double cut = std::clamp(s.xyz[1], -kLargestForVariance, kLargestForVariance);
    y = whole(cut * kValueUnit);
    square = whole(cut * cut * kValueUnit);
  }
  spread(y, square, xyz, s);
  const int column = int(std::floor(s.x)), row = int(std::floor(s.y));
  if (rect_.has(column, row)) {
    PixelSums& home = pixels_[index(column, row)];
    ++home.samples;
    home.dropped += fate != SampleFate::Added;
  }
  return fate;
}

void FilmSums::spread(Int128 y, Int128 square, const Int128 (&xyz)[3], const FilmSample& s) {
  std::vector<BlockSums>& block = open_block(block_of(s.number));
  const Reach columns = reach(s.x, filter_->radius(), rect_.x0, rect_.x1);
  const Reach rows = reach(s.y, filter_->radius(), rect_.y0, rect_.y1);
  for (int row = rows.begin; row < rows.end; ++row) {
    const std::int64_t vertical = filter_->weight(std::abs(row + 0.5 - s.y));
    for (int column = columns.begin; column < columns.end; ++column) {
      const std::int64_t w = vertical * filter_->weight(std::abs(column + 0.5 - s.x));
      PixelSums& p = pixels_[index(column, row)];
      for (int i = 0; i < 3; ++i) p.xyz[i] += xyz[i] * w;
      p.luminance_square += square * w;
      p.weight += w;
      if (stride_ > 1 && (column % stride_ != 0 || row % stride_ != 0)) continue;
      BlockSums& b = block[probe(column, row)];
      b.y += y * w;
      b.weight += w;
    }
  }
}

void FilmSums::merge(const FilmSums& part) {
  assert(part.width_ == width_ && part.height_ == height_ && part.shape_ == shape_);
  const Rect& r = part.rect_;
  const PixelSums* from = part.pixels_.data();
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x, ++from) pixels_[index(x, y)] += *from;
  for (int b = 0; b < part.blocks(); ++b) {
    if (part.blocks_[b].empty()) continue;
    std::vector<BlockSums>& block = open_block(b);
    for (int y = 0; y < part.down_; ++y)
      for (int x = 0; x < part.across_; ++x) {
        block[std::size_t(y + part.first_down_ - first_down_) * std::size_t(across_) +
              std::size_t(x + part.first_across_ - first_across_)] +=
            part.blocks_[b][std::size_t(y) * std::size_t(part.across_) + std::size_t(x)];
      }
  }
}

double FilmSums::samples_seen(const PixelSums& p) const {
  return double(p.weight) / kWeightUnit / filter_->integral();
}

double FilmSums::samples_worth(const PixelSums& p) const {
  return samples_seen(p) * filter_->sharing();
}

double FilmSums::mean(const PixelSums& p, int i) {
  return double(p.xyz[i]) / kSumUnit / (double(p.weight) / kWeightUnit);
}

double FilmSums::variance(const PixelSums& p) const {
  const double n = samples_worth(p);
  if (!(n > 1 && p.samples > 1)) return 0;
  const double weight = double(p.weight) / kWeightUnit, y = mean(p, 1);
  return std::max(0.0, double(p.luminance_square) / kSumUnit / weight - y * y) / (n - 1);
}

Film FilmSums::develop() const {
  Film film{rect_.width(), rect_.y1 - rect_.y0, {}, {}};
  film.xyz.reserve(pixels_.size());
  film.variance.reserve(pixels_.size());
  film.samples.reserve(pixels_.size());
  film.dropped.reserve(pixels_.size());
  for (const PixelSums& p : pixels_) develop(p, film);
  return film;
}

void FilmSums::develop(const PixelSums& p, Film& film) const {
  film.xyz.push_back(p.weight > 0 ? std::array{mean(p, 0), mean(p, 1), mean(p, 2)}
                                  : std::array<double, 3>{});
  film.variance.push_back(variance(p));
  film.samples.push_back(p.samples);
  film.dropped.push_back(p.dropped);
}

}  // namespace mms::renderer
