// SPDX-License-Identifier: Apache-2.0
// Enclosures of spectra and Fresnel's equations. Formulas, constants and tables are those of
// physics.h.
#include <algorithm>
#include <cmath>

#include "stdlib/bounds.h"
#include "stdlib/bounds_math.h"

#define MMS_ISA tables
#include "stdlib/physics.h"

namespace mms::stdlib::bounds {

using vm::Interval;

namespace {

constexpr double kInf = Interval::kInf;

double planck_at(double l, double t) {
  if (l <= 0 || t <= 0) return 0;
  const double x = 0.014387768775039338 / (l * t);
  return 1.19104297239718841e-25 / (l * l * l * l * l) / std::expm1(x);
}

/// Tables that the argument may mean.
struct Tables {
  int first, last;
};
Tables tables_of(const Interval& number) {
  if (number.nan) return {0, materials::kOpticalTables - 1};
  return {tables::table_number(number.lo), tables::table_number(number.hi)};
}

/// What `join_row(table, k)` gives over the rows of a table that [lo, hi], in nanometres, touches.
/// A hair more: kernels round the wavelength on the way.
template <class F>
void for_rows(const materials::OpticalTable& t, double lo, double hi, F join_row) {
  for (int k = 0; k + 1 < t.rows; ++k)
    if (t.nm[k] <= hi * (1 + 1e-12) && lo * (1 - 1e-12) <= t.nm[k + 1]) join_row(k);
}

}  // namespace

/// Rises with the temperature; over the wavelength one peak (Wien's law).
void planck(const Interval* in, Interval* out) {
  const Interval &l = in[0], &t = in[1];
  if (l.contains_infinity() || t.contains_infinity()) {
    out[0] = {0, kInf, true};
    return;
  }
  const double low = std::min(planck_at(l.lo, t.lo), planck_at(l.hi, t.lo));
  double high = std::max(planck_at(l.lo, t.hi), planck_at(l.hi, t.hi));
  if (t.hi > 0) {
    constexpr double wien = 2.897771955e-3;
    const double peak = wien / t.hi;
    if (l.lo <= peak && peak <= l.hi) high = std::max(high, planck_at(peak, t.hi));
  }
  // Cancellation near the last digits of double, and products that leave its range.
  const bool extreme =
      l.hi > 0 && t.hi > 0 &&
      (std::max(l.lo, 1e-45) < 1e-12 || l.hi * t.hi < 1e-290 || l.hi > 1e30 || t.hi > 1e30);
  // An error of the exponent is one of the power, times the exponent: at most 745.
  constexpr double slack = 1e-12;
  out[0] =
      extreme ? Interval{0, kInf, true} : Interval{low * (1 - slack), high * (1 + slack), false};
}

/// Each term as b + b c / (l^2 - c), where l^2 occurs once.
void sellmeier(const Interval* in, Interval* out) {
  const Interval& l = in[0];
  out[0] = {0, kInf, true};
  for (int k = 0; k < 7; ++k)
    if (in[k].nan || in[k].contains_infinity()) return;
  const Interval um = magnitude(l);
  const double lo2 = um.lo * um.lo * 1e12, hi2 = um.hi * um.hi * 1e12;
  double low = 1, high = 1, size = 1;
  for (int k = 0; k < 3; ++k) {
    const Interval &b = in[1 + 2 * k], &c = in[2 + 2 * k];
    // c / (l^2 - c) rises with c and falls with l^2 on either side of its pole.
    const double d_lo = lo2 - c.hi, d_hi = hi2 - c.lo;
    if (c.is_point() && c.lo == 0) {
      // b l^2 / l^2
      if (lo2 == 0) return;
      low += b.lo;
      high += b.hi;
      size += b.magnitude();
      continue;
    }
    const double gap = 1e-9 * (hi2 + c.magnitude());
    if (d_lo <= gap && d_hi >= -gap) return;
    const double q[] = {c.lo / (lo2 - c.lo), c.lo / (hi2 - c.lo), c.hi / (lo2 - c.hi),
                        c.hi / (hi2 - c.hi)};
    const double q_lo = *std::min_element(q, q + 4), q_hi = *std::max_element(q, q + 4);
    const double t[] = {b.lo * (1 + q_lo), b.lo * (1 + q_hi), b.hi * (1 + q_lo), b.hi * (1 + q_hi)};
    low += *std::min_element(t, t + 4);
    high += *std::max_element(t, t + 4);
    // What the difference l^2 - c loses is amplified by its cancellation.
    size += b.magnitude() * (1 + std::max(std::fabs(q_lo), std::fabs(q_hi))) *
            (1 + 1e3 * std::max(std::fabs(q_lo), std::fabs(q_hi)));
  }
  const double slack = 1e-15 * size;
  low -= slack;
  high += slack;
  Interval r{std::sqrt(std::max(low, 0.0)), std::sqrt(std::max(high, 0.0)), false};
  if (low <= 0) r = join(r, Interval::point(1));
  out[0] = r;
}

void cauchy(const Interval* in, Interval* out) {
  const Interval um = magnitude(in[0]), &a = in[1], &b = in[2];
  if (um.lo < 1e-20 || um.hi > 1e20 || a.contains_infinity() || b.contains_infinity()) return;
  const double i_lo = 1e-12 / (um.hi * um.hi), i_hi = 1e-12 / (um.lo * um.lo);
  const double low = std::min(b.lo * i_lo, b.lo * i_hi), high = std::max(b.hi * i_lo, b.hi * i_hi);
  const double slack = 1e-15 * (a.magnitude() + std::max(std::fabs(low), std::fabs(high)));
  out[0] = {a.lo + low - slack, a.hi + high + slack, false};
}

/// The two polarisations apart. r_s^2 falls with the cosine and rises with the index's distance
/// from 1; r_p = (q - 1) / (q + 1) rises with q = ior^2 c / g.
void fresnel(const Interval* in, Interval* out) {
  const Interval& ior = in[1];
  out[0] = {0, 1, in[0].contains_infinity() || ior.contains_infinity()};
  if (in[0].nan || ior.nan || ior.contains_infinity()) return;
  const Interval a = magnitude(in[0]), n = magnitude(ior);
  const Interval c{std::min(a.lo, 1.0), std::min(a.hi, 1.0), false};
  const double m_lo = n.lo * n.lo, m_hi = n.hi * n.hi;
  // g^2 = c^2 + ior^2 - 1; anything where total reflection begins.
  const double g2_lo = c.lo * c.lo + m_lo - 1, g2_hi = c.hi * c.hi + m_hi - 1;
  if (g2_lo < 1e-9) {
    // Without a finer look; only the side beyond is certain.
    if (g2_hi < -1e-9) out[0] = {1, 1, false};
    return;
  }
  const auto rs = [](double cosine, double m) {
    const double g = std::sqrt(std::max(cosine * cosine + m - 1, 0.0));
    const double r = (cosine - g) / (cosine + g);
    return r * r;
  };
  const double s[] = {rs(c.lo, m_lo), rs(c.lo, m_hi), rs(c.hi, m_lo), rs(c.hi, m_hi)};
  double s_lo = *std::min_element(s, s + 4);
  const double s_hi = *std::max_element(s, s + 4);
  if (m_lo <= 1 && 1 <= m_hi) s_lo = 0;
  // q^2 = m^2 c^2 / (m - 1 + c^2): in c monotone for one m; in m falling to m = 2 (1 - c^2), then
  // rising.
  const auto q2 = [](double cosine, double m) {
    return m * m * cosine * cosine / std::max(m - 1 + cosine * cosine, 1e-300);
  };
  double q_lo = kInf, q_hi = 0;
  for (const double cosine : {c.lo, c.hi}) {
    const double turn = std::clamp(2 * (1 - cosine * cosine), m_lo, m_hi);
    for (const double m : {m_lo, turn, m_hi}) {
      q_lo = std::min(q_lo, std::sqrt(q2(cosine, m)));
      q_hi = std::max(q_hi, std::sqrt(q2(cosine, m)));
    }
  }
  const auto rp = [](double q) { return (q - 1) / (q + 1); };
  const Interval p = magnitude({rp(q_lo), rp(q_hi), false});
  // For a small index (ior^2 + 1) c^2 - 1 cancels, and is divided by about g^2.
  const double slack = 1e-12 + 1e-15 / g2_lo;
  out[0] = {std::max(0.0, 0.5 * (s_lo + p.lo * p.lo) - slack),
            std::min(1.0, 0.5 * (s_hi + p.hi * p.hi) + slack), false};
}

/// The range, where the indices make sense.
void fresnel_conductor(const Interval* in, Interval* out) {
  const bool physical = in[1].lo >= 0 && in[2].lo >= 0;
  bool nan = false;
  for (int k = 0; k < 3; ++k) nan |= in[k].contains_infinity() || in[k].hi > 1e37;
  out[0] = {0, physical ? 1 : kInf, nan || !physical};
}

/// Extremes are at the ends of the argument, or at rows between them.
void optical_table(const Interval* in, Interval* out) {
  // Of NaN kernels make a number of the table.
  const bool any = in[0].nan;
  // Kernels round the wavelength, and where the curve is between rows.
  const auto moved = [](double m, double by) { return m * 1e9 + by * std::fabs(m * 1e9); };
  const double lo = any ? -kInf : moved(in[0].lo, -1e-12), hi = any ? kInf : moved(in[0].hi, 1e-12);
  const Tables which = tables_of(in[1]);
  Interval r{kInf, -kInf, false};
  for (int n = which.first; n <= which.last; ++n) {
    const materials::OpticalTable& t = materials::optical_tables[n];
    for (const double x : {lo, hi}) r = join(r, Interval::point(t.at(x)));
    for (int k = 0; k < t.rows; ++k)
      if (lo <= t.nm[k] && t.nm[k] <= hi) r = join(r, Interval::point(t.value[k]));
  }
  const double slack = 1e-15 * r.magnitude();
  out[0] = {r.lo - slack, r.hi + slack, false};
}

/// Slopes of the rows that the argument may find, and the 0 beside them.
void optical_table_slope(const Interval* in, Interval* out) {
  const Tables which = tables_of(in[1]);
  Interval r = Interval::point(0);
  for (int n = which.first; n <= which.last; ++n) {
    const materials::OpticalTable& t = materials::optical_tables[n];
    for_rows(t, in[0].lo * 1e9, in[0].hi * 1e9, [&](int k) {
      r = join(r, Interval::point((t.value[k + 1] - t.value[k]) / (t.nm[k + 1] - t.nm[k]) * 1e9));
    });
  }
  const double slack = 1e-12 * r.magnitude();
  out[0] = {r.lo - slack, r.hi + slack, in[0].nan};
}

}  // namespace mms::stdlib::bounds
