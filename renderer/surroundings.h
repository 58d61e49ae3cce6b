// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a surface lies in, for nested dielectrics: an object that lies in another has its index
/// over that object's, which is asked for at the very point.

#include <span>
#include <vector>

#include "renderer/flight.h"

namespace mms::renderer {

/// One thread's.
class Surroundings {
 public:
  Surroundings(const World& world, Scripts& scripts) : world_(world), scripts_(scripts) {}

  /// Where a flight met a surface.
  struct Place {
    const Flight* flight;
    const ScriptPoint* point;
    Spectrumf* outside;  ///< index around it; left alone where nothing is known of one
  };
  /// Answers for all places at once; runs scripts.
  void ask(std::span<const Place> places);

 private:
  struct Nested {
    Place place;
    int around;  ///< object
  };

  const World& world_;
  Scripts& scripts_;
  std::vector<Nested> nested_;
  std::vector<ScriptPoint> points_;
  std::vector<const ScriptPoint*> lanes_;
};

}  // namespace mms::renderer
