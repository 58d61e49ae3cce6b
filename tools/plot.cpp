// SPDX-License-Identifier: Apache-2.0
#include "tools/plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mms::tools {

namespace {

// Of one panel, in pixels; margins hold the labels.
constexpr double kWidth = 420, kHeight = 320, kLeft = 64, kTop = 44, kBottom = 46, kRight = 14;
constexpr double kRow = 16;  ///< of the legend

/// Told apart with any common deficiency of colour vision (Okabe and Ito 2008).
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#e69f00", "#56b4e9", "#000000"};

const char* colour(std::size_t i) { return kColours[i % std::size(kColours)]; }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

bool drawn(const std::pair<double, double>& p) {
  return p.first > 0 && p.second > 0 && std::isfinite(p.first) && std::isfinite(p.second);
}

/// Decades that hold all values of one axis.
struct Axis {
  double low = 1e300, high = -1e300;  ///< of the logarithm to base 10
  void add(double v) {
    low = std::min(low, std::log10(v));
    high = std::max(high, std::log10(v));
  }
  void widen() {
    if (low > high) low = 0, high = 1;
    const double room = std::max(0.15, 0.05 * (high - low));
    low -= room;
    high += room;
  }
  double at(double v, double from, double to) const {
    return from + (std::log10(v) - low) / (high - low) * (to - from);
  }
  /// Powers of ten, and where there are few 2 and 5 times them.
  std::vector<double> ticks() const {
    std::vector<double> all;
    for (int e = int(std::floor(low)); e <= int(std::ceil(high)); ++e)
      for (const double m : {1.0, 2.0, 5.0}) {
        const double l = e + std::log10(m);
        if (l >= low && l <= high && (m == 1 || high - low < 3)) all.push_back(m * std::pow(10, e));
      }
    return all;
  }
};

std::string text(double x, double y, const std::string& words, const char* anchor,
                 const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     anchor, more, escaped(words));
}

std::string line(double x1, double y1, double x2, double y2) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", x1, y1,
      x2, y2);
}

std::string draw(const Panel& panel, double left) {
  Axis x, y;
  for (const Series& s : panel.series)
    for (const auto& p : s.points)
      if (drawn(p)) x.add(p.first), y.add(p.second);
  x.widen();
  y.widen();
  const double x0 = left + kLeft, x1 = left + kWidth - kRight, y0 = kHeight - kBottom, y1 = kTop;
  std::string svg;
  for (const double t : x.ticks()) {
    svg += line(x.at(t, x0, x1), y0, x.at(t, x0, x1), y1);
    svg += text(x.at(t, x0, x1), y0 + 15, fmt::format("{:g}", t), "middle");
  }
  for (const double t : y.ticks()) {
    svg += line(x0, y.at(t, y0, y1), x1, y.at(t, y0, y1));
    svg += text(x0 - 5, y.at(t, y0, y1) + 4, fmt::format("{:g}", t), "end");
  }
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    std::string path, dots;
    for (const auto& p : panel.series[i].points) {
      if (!drawn(p)) continue;
      const double px = x.at(p.first, x0, x1), py = y.at(p.second, y0, y1);
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", px, py);
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", px, py,
                          colour(i));
    }
    svg +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n",
                    path, colour(i)) +
        dots;
  }
  svg += text((x0 + x1) / 2, kHeight - 10, panel.x_label, "middle");
  return svg + text(x0, kTop - 8, panel.y_label, "start");
}

}  // namespace

std::string log_plots(const std::string& title, const std::vector<Panel>& panels) {
  std::string body;
  for (std::size_t i = 0; i < panels.size(); ++i) body += draw(panels[i], double(i) * kWidth);
  double y = kHeight + kRow;
  for (std::size_t i = 0; !panels.empty() && i < panels[0].series.size(); ++i, y += kRow) {
    body += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", kLeft, y - 4,
                        colour(i));
    body += text(kLeft + 12, y, panels[0].series[i].name, "start");
  }
  const double width = kWidth * double(panels.size());
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"11\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
             width, y) +
         text(width / 2, 18, title, "middle", " font-size=\"14\"") + body + "</svg>\n";
}

}  // namespace mms::tools
