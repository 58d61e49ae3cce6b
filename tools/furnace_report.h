// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms furnace` found, as a table, JSON, a plot and a page.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "materials/furnace.h"
#include "vm/program.h"

namespace mms::tools {

/// One surface, or the phase function of a volume.
struct Furnace {
  vm::DescriptorForm form = vm::DescriptorForm::Surface;
  std::string name;
  materials::FurnaceReport report;
};

std::string furnace_text(const Furnace& furnace, const std::vector<double>& nanometres);
nlohmann::ordered_json furnace_json(const Furnace& furnace, const std::vector<double>& nanometres);

/// Three panels for each: albedo over angle, albedo over wavelength, efficiency over angle. Dashed
/// lines are of light that comes from inside, at 180 degrees minus its angle.
std::string furnace_svg(const std::vector<Furnace>& all, const std::vector<double>& nanometres);

/// A page of Markdown: the contract that all models keep, then a section for each with its picture
/// `images/materials/NAME.png` and a table.
std::string furnace_page(const std::vector<Furnace>& all);

}  // namespace mms::tools
