// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Luminous intensity over directions as makers of lamps publish it: text files after IES LM-63
/// (1986 to 2019), of type C. Reads text that it is given; touches no files. Immutable once read.
///
/// Angles in degrees: `vertical` from 0 (down, the lamp's axis) to 180, `horizontal` around it.

#include <string_view>
#include <vector>

#include "base/result.h"

namespace mms::materials {

class Photometry {
 public:
  /// Reads a whole file. The error's `what` begins with `line N:`, N counted from 1.
  static Result<Photometry> parse(std::string_view text);

  /// Candela, linear between the angles of the file, mirrored where it states a half or a quarter;
  /// 0 beyond its vertical angles. `horizontal` may be any finite number, `vertical` in [0, 180].
  double intensity(double horizontal, double vertical) const;

  /// Its change for each degree of both angles.
  struct Slope {
    double horizontal, vertical;
  };
  Slope slope(double horizontal, double vertical) const;

  double largest() const { return largest_; }  ///< candela
  double lumens() const { return lumens_; }  ///< of all lamps; -1 where the file has absolute ones
  double watts() const { return watts_; }
  int columns() const { return int(horizontal_.size()); }
  int rows() const { return int(vertical_.size()); }

 private:
  friend class PhotometryReader;
  struct Cell;
  Cell cell(double horizontal, double vertical) const;

  std::vector<double> vertical_, horizontal_;  ///< ascending
  std::vector<double> candela_;                ///< [horizontal][vertical]
  double largest_ = 0, lumens_ = 0, watts_ = 0;
};

}  // namespace mms::materials
