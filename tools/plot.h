// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Plots as SVG, both axes logarithmic.

#include <string>
#include <utility>
#include <vector>

namespace mms::tools {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< those that are not above 0 are left out
};

struct Panel {
  std::string x_label, y_label;
  std::vector<Series> series;
};

/// Panels beside each other under a title, with one legend: series of one place are one colour.
std::string log_plots(const std::string& title, const std::vector<Panel>& panels);

}  // namespace mms::tools
