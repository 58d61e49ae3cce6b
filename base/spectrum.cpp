// SPDX-License-Identifier: Apache-2.0
#include "base/spectrum.h"

namespace mms {
namespace {

constexpr double kA = 0.0072;  // per nanometre
constexpr double kB = 538.0;   // nanometres

double tanh_at(double lambda_nm) { return std::tanh(kA * (lambda_nm - kB)); }

}  // namespace

double wavelength_pdf(double lambda_nm) {
  // The normalisation is thesis (4.9) with tanh where it prints atanh.
  static const double norm = (tanh_at(kLambdaMax) - tanh_at(kLambdaMin)) / kA;
  const double c = std::cosh(kA * (lambda_nm - kB));
  return 1.0 / (norm * c * c);
}

Wavelengths sample_wavelengths(double u) {
  static const double lo = tanh_at(kLambdaMin);
  static const double hi = tanh_at(kLambdaMax);
  Wavelengths w;
  for (int i = 0; i < kWavelengths; ++i) {
    double ui = u + double(i) / kWavelengths;
    ui -= std::floor(ui);
    const double lambda = kB + std::atanh(lo + ui * (hi - lo)) / kA;
    w.nm[i] = float(lambda < kLambdaMin ? kLambdaMin : lambda > kLambdaMax ? kLambdaMax : lambda);
    w.pdf[i] = float(wavelength_pdf(w.nm[i]));
  }
  return w;
}

}  // namespace mms
