// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the numbers of a picture file can be, all of it or a part, and how steep they are: every
/// filter of textures is a mean of texels, its slope one of differences of neighbours. Internal to
/// the textures.

#include <vector>

#include "renderer/texels.h"

namespace mms::renderer {

class TexelBounds {
 public:
  /// Reads all levels of the file.
  explicit TexelBounds(const TexelFile& file);

  /// Whether there are texels, and all of them are finite. Else nothing below is known.
  bool known() const { return known_; }
  double low() const { return low_; }
  double high() const { return high_; }
  /// No slope by u is larger, nor one by v, while texels of opposite borders may be neighbours.
  double slope_u() const { return slope_u_; }
  double slope_v() const { return slope_v_; }

  /// The least and the greatest number of those columns and rows of the first level, rows from
  /// the top; of some around them too. \pre They are in the picture, first <= last.
  void within(int first_column, int last_column, int first_row, int last_row, double& low,
              double& high) const;

 private:
  static constexpr int kBlock = 16;  ///< a multiple of what is packed together
  struct Span {
    double low, high;
  };
  void take_level(const TexelFile& file, const TexelLevel& level);
  void take_blocks(const TexelFile& file, const TexelLevel& level);

  bool known_ = false;
  double low_ = 0, high_ = 0, slope_u_ = 0, slope_v_ = 0;
  int columns_ = 0;           ///< of blocks
  std::vector<Span> blocks_;  ///< of the first level, row by row
};

}  // namespace mms::renderer
