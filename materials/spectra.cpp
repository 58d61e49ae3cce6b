// SPDX-License-Identifier: Apache-2.0
#include "materials/spectra.h"

#include "materials/colour.h"
#include "materials/optical_tables.h"

namespace mms::materials {

double illuminant_d65(double lambda_nm) {
  return optical_table(Optical::illuminant_d65).at(lambda_nm);
}
double illuminant_a(double lambda_nm) { return optical_table(Optical::illuminant_a).at(lambda_nm); }

double illuminant_d65_luminance() {
  static const double y = xyz_of_spectrum(illuminant_d65).y;
  return y;
}

}  // namespace mms::materials
