// SPDX-License-Identifier: Apache-2.0
#include "materials/photometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace mms::materials {
namespace {

constexpr int kMaxAngles =
    10'000;  ///< of either kind, so that a damaged file asks for no gigabytes

/// A line of text without its end.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  return line;
}

/// Where `x` lies among the ascending `at`: the place before it, and how far on to the next.
struct Place {
  int before = 0;
  double share = 0, step = 0;  ///< `step` 0 where nothing changes
};
Place place_among(const std::vector<double>& at, double x) {
  if (at.size() < 2 || !(x > at.front())) return {0, 0, at.size() < 2 ? 0 : at[1] - at[0]};
  const int last = int(at.size()) - 2;
  const int k = std::min(int(std::upper_bound(at.begin(), at.end(), x) - at.begin()) - 1, last);
  const double step = at[k + 1] - at[k];
  return {k, std::min((x - at[k]) / step, 1.0), step};
}

}  // namespace

/// Numbers separated by blanks, commas and ends of lines.
class PhotometryReader {
 public:
  explicit PhotometryReader(std::string_view text) : rest_(text) {}

  Result<Photometry> read() {
    Photometry p;
    if (skip_keywords() && read_head() && read_angles(p) && read_candela(p)) return p;
    return *error_;
  }

 private:
  /// Up to the line TILT=, and what that announces.
  bool skip_keywords() {
    while (!rest_.empty()) {
      ++line_;
      const std::string_view line = take_line(rest_);
      if (!line.starts_with("TILT=")) continue;
      // What tilting the lamp does is of no use where it hangs as it was measured.
      if (line != "TILT=INCLUDE") return true;
      double geometry, pairs;
      if (!number("the lamp's geometry", geometry)) return false;
      if (!count("the number of tilt angles", pairs)) return false;
      std::vector<double> skipped;
      return numbers("a tilt angle or factor", 2 * int(pairs), skipped);
    }
    line_ = std::max(line_, 1);
    return fail("there is no line `TILT=`", "is this a photometric file (IES LM-63)?");
  }

  bool read_head() {
    double lamps, type, units, ignored;
    if (!number("the number of lamps", lamps) || !number("the lumens of a lamp", lumens_) ||
        !number("the multiplier of candela", scale_) ||
        !count("the number of vertical angles", vertical_) ||
        !count("the number of horizontal angles", horizontal_) ||
        !number("the photometric type", type))
      return false;
    if (type != 1)
      return fail("the photometric type is not 1 (type C)", "convert the file to type C");
    if (!number("the type of units", units) || !number("the width", ignored) ||
        !number("the length", ignored) || !number("the height", ignored))
      return false;
    double ballast, lamp_ballast;
    if (!number("the ballast factor", ballast)) return false;
    if (!number("the ballast-lamp factor", lamp_ballast) || !number("the watts", watts_))
      return false;
    scale_ *= ballast * (lamp_ballast > 0 ? lamp_ballast : 1);
    if (!(scale_ > 0)) return fail("multiplier times ballast factor is not above 0", "");
    if (lumens_ > 0) lumens_ *= std::max(lamps, 1.0);
    return true;
  }

  bool read_angles(Photometry& p) {
    if (!numbers("a vertical angle", int(vertical_), p.vertical_)) return false;
    if (!ascending(p.vertical_) || p.vertical_.front() < 0 || p.vertical_.back() > 180)
      return fail("the vertical angles do not ascend from 0 or more to at most 180", "");
    if (!numbers("a horizontal angle", int(horizontal_), p.horizontal_)) return false;
    const double first = p.horizontal_.front(), last = p.horizontal_.back();
    const bool from_0 = first == 0 && (last == 0 || last == 90 || last == 180 || last == 360);
    if (!ascending(p.horizontal_) || !(from_0 || (first == 90 && last == 270)))
      return fail(
          "the horizontal angles do not ascend from 0 to 0, 90, 180 or 360, nor from 90 to "
          "270",
          "");
    return true;
  }

  bool read_candela(Photometry& p) {
    if (!numbers("candela", int(vertical_) * int(horizontal_), p.candela_)) return false;
    for (double& c : p.candela_) {
      if (c < 0) return fail("candela are below 0", "");
      c *= scale_;
      p.largest_ = std::max(p.largest_, c);
    }
    if (!std::isfinite(p.largest_)) return fail("candela are too large", "");
    p.lumens_ = lumens_;
    p.watts_ = watts_;
    return true;
  }

  static bool ascending(const std::vector<double>& v) {
    return std::adjacent_find(v.begin(), v.end(), std::greater_equal<>()) == v.end();
  }

  bool numbers(const char* what, int n, std::vector<double>& to) {
    to.reserve(std::min<std::size_t>(std::size_t(n), rest_.size()));
    for (int i = 0; i < n; ++i) {
      to.push_back(0);
      if (!number(what, to.back())) return false;
    }
    return true;
  }

  bool count(const char* what, double& to) {
    if (!number(what, to)) return false;
    if (to >= 1 && to <= kMaxAngles && to == std::floor(to)) return true;
    return fail(std::string(what) + " is not in 1 .. " + std::to_string(kMaxAngles), "");
  }

  bool number(const char* what, double& to) {
    constexpr std::string_view blanks = " \t\r\n,";
    while (!rest_.empty() && blanks.find(rest_[0]) != blanks.npos) {
      line_ += new_line_;
      new_line_ = rest_[0] == '\n';
      rest_.remove_prefix(1);
    }
    if (rest_.empty()) return fail(std::string("the file ends before ") + what, "");
    line_ += new_line_;
    new_line_ = false;
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    std::string_view digits = word;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
    if (wrong != std::errc() || end != digits.data() + digits.size() || !std::isfinite(to))
      return fail(
          "expected " + std::string(what) + ", found `" + std::string(word.substr(0, 20)) + "`",
          "numbers are separated by blanks or commas");
    rest_.remove_prefix(word.size());
    return true;
  }

  bool fail(const std::string& what, std::string hint) {
    error_ = Error{"", "line " + std::to_string(line_) + ": " + what, std::move(hint)};
    return false;
  }

  std::string_view rest_;
  int line_ = 0;
  bool new_line_ = true;  ///< the next number is on a line after `line_`
  std::optional<Error> error_;
  double lumens_ = 0, scale_ = 0, vertical_ = 0, horizontal_ = 0, watts_ = 0;
};

Result<Photometry> Photometry::parse(std::string_view text) {
  return PhotometryReader(text).read();
}

/// The four values around a direction, and where it lies between them.
struct Photometry::Cell {
  double value[2][2];  ///< [horizontal][vertical]
  double u, v, du, dv;
  double sign;  ///< -1 where the horizontal angle runs back
  bool outside;
};

Photometry::Cell Photometry::cell(double horizontal, double vertical) const {
  const double first = horizontal_.front(), last = horizontal_.back();
  double h = std::fmod(horizontal, 360.0), sign = 1;
  if (h < 0) h += 360;
  const auto mirror = [&](double about) {
    h = 2 * about - h;
    sign = -sign;
  };
  if (first == 90) {
    if (h < 90) mirror(90);
    if (h > 270) mirror(270);
  } else {
    if (last <= 180 && h > 180) mirror(180);
    if (last <= 90 && h > 90) mirror(90);
  }
  const Place a = place_among(horizontal_, h), b = place_among(vertical_, vertical);
  Cell c{{}, a.share, b.share, a.step, b.step, sign, false};
  c.outside = vertical < vertical_.front() || vertical > vertical_.back();
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      c.value[i][k] = candela_[std::size_t(std::min(a.before + i, columns() - 1)) * rows() +
                               std::min(b.before + k, rows() - 1)];
  return c;
}

double Photometry::intensity(double horizontal, double vertical) const {
  const Cell c = cell(horizontal, vertical);
  if (c.outside) return 0;
  const double low = c.value[0][0] * (1 - c.v) + c.value[0][1] * c.v,
               high = c.value[1][0] * (1 - c.v) + c.value[1][1] * c.v;
  return low * (1 - c.u) + high * c.u;
}

Photometry::Slope Photometry::slope(double horizontal, double vertical) const {
  const Cell c = cell(horizontal, vertical);
  if (c.outside) return {0, 0};
  const double h =
      (c.value[1][0] - c.value[0][0]) * (1 - c.v) + (c.value[1][1] - c.value[0][1]) * c.v;
  const double v =
      (c.value[0][1] - c.value[0][0]) * (1 - c.u) + (c.value[1][1] - c.value[1][0]) * c.u;
  return {c.du > 0 ? c.sign * h / c.du : 0, c.dv > 0 ? v / c.dv : 0};
}

}  // namespace mms::materials
