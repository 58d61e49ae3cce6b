// SPDX-License-Identifier: Apache-2.0
// Flights through volumes: sums of coefficients, in closed form and by tentative collisions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/emission.h"
#include "renderer/flight.h"

namespace mms::renderer {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Coefficients are not negative.
Spectrumf not_negative(const Spectrumf& s) {
  return Spectrumf::map([](float x) { return x > 0 ? x : 0.0f; }, s);
}

Spectrumf transmittance(const Spectrumf& extinction, float length) {
  return Spectrumf::map([=](float s) { return s > 0 ? std::exp(-s * length) : 1.0f; }, extinction);
}

}  // namespace

/// Takes a flight through what fills the space before distance `to`: true if it comes there. Else
/// it ended, or `need` says what to ask.
///
/// Sums of coefficients: the even volumes are one in closed form, and each that varies has
/// tentative collisions of its own. The nearest event of all is where something happens, since
/// independent Poisson processes add.
bool Flights::along_media(Flight& f, float to, const PathView& path, Need& need) {
  const Filling filling = world_.filling(f.media);
  if (f.known < filling.even_count) {
    f.medium = filling.even[f.known];
    need = Need::Coefficients;
    return false;
  }
  const Vec3d origin(f.origin), direction(f.direction);
  double end = to;
  for (int i = 0; i < filling.varied_count; ++i) {
    const int object = filling.varied[i];
    // More of them know better how much light comes through; where it shines, much depends on that.
    const float step = world_.emission_rates[object].empty() ? 1 : f.look_step;
    const double depth = -std::log1p(-random(f, path)) * step;
    const RateGrid::Event c = world_.majorants[object].next(origin, direction, f.t, end, depth);
    if (!(c.t < end)) continue;  // never where the medium is empty
    end = c.t;
    f.medium = object;
    f.rate = c.rate / step;
    need = Need::Collision;
  }
  if (f.errand != Errand::Shadow) find_emission(f, filling, to, end, need, path);
  if (filling.even_count > 0 && through_even(f, float(end) - f.t, path)) {
    need = Need::Nothing;
    return false;
  }
  f.t = float(end);
  if (need == Need::Emission && f.look.t == end)
    f.look = world_.emission_rates[f.medium].next(origin, direction, end, to, f.look_step);
  return need == Need::Nothing;
}

/// Where emission is asked for, if before `end`, which then is there. In the first of the volumes
/// that emit that is at even steps of its rate, which is less noise than independent places make;
/// in others, of which flights keep nothing, at such.
void Flights::find_emission(Flight& f, const Filling& filling, float to, double& end, Need& need,
                            const PathView& path) {
  bool first = true;
  for (int i = 0; i < filling.varied_count; ++i) {
    const int object = filling.varied[i];
    const RateGrid& rates = world_.emission_rates[object];
    if (rates.empty()) continue;
    RateGrid::Event e = f.look;
    if (!first || e.t < 0) {
      const double u = random(f, path);
      e = rates.next(Vec3d(f.origin), Vec3d(f.direction), f.t, to,
                     f.look_step * (first ? u : -std::log1p(-u)));
      if (first) f.look = e;
    }
    first = false;
    if (!(e.t < end)) continue;
    end = e.t;
    f.medium = object;
    f.rate = e.rate;
    need = Need::Emission;
  }
}

/// A stretch of even volumes in closed form; true if the flight ended in it. Where to scatter
/// is drawn for the hero and weighed over all wavelengths (thesis (4.14), pdf_tr). Absorption only
/// dims: if it took part in the choice, coloured absorption would tear the wavelengths apart.
bool Flights::through_even(Flight& f, float length, const PathView& path) {
  ++counters_.media_steps;
  const Spectrumf& scattering = f.even.scattering;
  const Spectrumf extinction = scattering + f.even.absorption;
  if (f.errand != Errand::Shadow && !f.even.emission.is_black()) {
    Spectrumf optical;  // integral of the transmittance over the stretch
    for (int k = 0; k < kWavelengths; ++k)
      optical[k] =
          extinction[k] > 0 ? -std::expm1(-extinction[k] * length) / extinction[k] : length;
    see(f, f.even.emission * optical, path);
  }
  if (f.errand != Errand::Path) {
    // A path would have had to decide not to scatter, with this very probability.
    f.carried.beta *= transmittance(extinction, length);
    f.carried.pdf *= transmittance(scattering, length);
    if (f.carried.beta.is_black()) f.end = End::Lost;
    return f.end != End::Flying;
  }
  const float hero = scattering[0];
  const float s = hero > 0 ? -std::log1p(-random(f, path)) / hero : kInfinity;
  if (s < length) {
    // All of them scatter with this density together, and the one that was drawn has its share.
    f.carried.happened(f.drawn_scattering * transmittance(extinction, s),
                       f.drawn_scattering * transmittance(scattering, s));
    f.carried.rescale();
    f.t += s;
    f.medium = f.drawn;
    if (f.known > 1) f.forget_media();  // the next event draws anew
    f.end = End::Medium;
    return true;
  }
  f.carried.happened(transmittance(extinction, length), transmittance(scattering, length));
  f.carried.rescale();
  if (f.carried.beta.is_black()) f.end = End::Lost;
  return f.end != End::Flying;
}

/// What the last run says that a volume does to light, for a lane: nothing where it gave up.
Coefficients Flights::removed(const vm::Descriptor& d, int lane, const PathView& path) {
  if (scripts_.given_up(lane)) return {};
  return {not_negative(answered(d.shade.scattering, lane, path)),
          not_negative(answered(d.shade.absorption, lane, path)),
          {}};
}

/// What it says of emission towards where a flight came from. Its shape in a volume is a phase
/// function, 1 for the isotropic one.
Spectrumf Flights::emission(const vm::Entry& entry, const materials::Layout& shape, const Flight& f,
                            int lane, const PathView& path) {
  if (scripts_.given_up(lane)) return {};
  const Spectrumf emitted = not_negative(answered(entry.emission, lane, path));
  if (emitted.is_black()) return emitted;
  params_.resize(std::max(1, shape.param_count()));
  scripts_.params(entry.emission_material, lane, params_.data());
  return emitted * materials::volume_emission_shape(shape, params_.data(), -f.direction);
}

/// One more of the even volumes around a flight. Which of them is to scatter is drawn as they come:
/// the newest by its share of the sum so far.
void Flights::add_even(Flight& f, const Coefficients& c, const PathView& path) {
  const float before = f.even.scattering[0], hero = c.scattering[0];
  f.even.scattering += c.scattering;
  f.even.absorption += c.absorption;
  f.even.emission += c.emission;
  if (f.known++ == 0 || (hero > 0 && random(f, path) * (before + hero) < hero)) {
    f.drawn = f.medium;
    f.drawn_scattering = c.scattering;
  }
}

/// A tentative collision of delta tracking (a path) or ratio tracking (a shadow ray): real, or
/// with the fictitious matter that fills the medium up to its majorant. Carried weighs all
/// wavelengths and both techniques over paths with their null collisions (Miller et al. 2019); for
/// lack of a choice for absorption, which dims, a path goes on with probability 1 - scattering /
/// majorant.
void Flights::collide(Flight& f, const Coefficients& c, const PathView& path) {
  ++counters_.media_steps;
  ++counters_.medium_samples;
  const float majorant = f.rate;
  bool denser = false;
  Spectrumf scattered, nothing;  // probabilities, per wavelength; what is left is absorbed
  for (int k = 0; k < kWavelengths; ++k) {
    const float extinction = c.scattering[k] + c.absorption[k];
    // Beyond the bound that the author stated, the medium is as dense as the bound.
    denser |= extinction > majorant * 1.00001f;  // rounding is no news
    const float held = extinction > majorant ? majorant / extinction : 1;
    scattered[k] = c.scattering[k] * held / majorant;
    nothing[k] = std::max(0.0f, 1 - extinction * held / majorant);
  }
  counters_.denser_samples += denser;
  // As in an even medium a path decides on scattering alone, and absorption dims it.
  const Spectrumf p_on = Spectrumf(1.0f) - scattered;
  if (f.errand != Errand::Path) {
    f.carried.beta *= nothing;
    f.carried.pdf *= p_on;
    if (f.carried.beta.is_black()) f.end = End::Lost;
    return;
  }
  if (random(f, path) < scattered[0]) {
    f.carried.happened(scattered, scattered);
    if (f.known > 1) f.forget_media();
    f.end = End::Medium;
  } else {
    f.carried.happened(nothing, p_on);
    if (f.carried.beta.is_black()) f.end = End::Lost;
  }
  f.carried.rescale();
}

/// Adds light that a volume sends towards where a flight came from.
void Flights::see(const Flight& f, const Spectrumf& light, const PathView& path) {
  const bool gathers = f.errand == Errand::Gather;
  const double density = gathers ? f.light_density
                         : f.glow_chance > 0
                             ? f.glow_chance * world_.glows.pdf(Vec3d(f.origin), Vec3d(f.direction))
                             : 0;
  const Technique by = gathers ? Technique::Light : Technique::Scattering;
  (gathers ? *path.gathered : *path.radiance) +=
      f.carried.weighted(by, density, world_.estimator) * light;
}

}  // namespace mms::renderer
