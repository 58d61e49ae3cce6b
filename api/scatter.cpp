// SPDX-License-Identifier: Apache-2.0
// Materials over arrays of points: what surfaces and volumes scatter, and the shape of emission.
#include "api/evaluation.h"
#include "materials/bsdf.h"
#include "materials/emission.h"
#include "materials/phase.h"

using namespace mms;

namespace {

constexpr materials::Mode kMode = materials::Mode::Radiance;

Vec3f load(const float* lanes, std::size_t count, std::size_t i) {
  return {lanes[i], lanes[count + i], lanes[2 * count + i]};
}

void store(const Spectrumf& s, float* lanes, std::size_t count, std::size_t i) {
  for (int c = 0; c < kWavelengths; ++c) lanes[static_cast<std::size_t>(c) * count + i] = s[c];
}

void store(Vec3f v, float* lanes, std::size_t count, std::size_t i) {
  lanes[i] = v.x;
  lanes[count + i] = v.y;
  lanes[2 * count + i] = v.z;
}

/// Calls `use(params, point)` for every point, with the numbers of the material of an entry.
template <class Handle, class Use>
int for_each_point(MMsContext* context, const Handle* handle, const MMsPoints* points,
                   vm::Entry vm::Descriptor::*entry, vm::MaterialLayout vm::Entry::*material,
                   Use use) {
  if (!context || !handle || !points) return 0;
  return api::guarded(context->messages, [&] {
    api::Evaluation evaluation(*context, *points);
    if (!evaluation.of_this_program(handle->owner) || !evaluation.bind()) return false;
    const vm::Entry& e = handle->descriptor->*entry;
    std::vector<float> params;
    return evaluation.run(e.function, [&](std::size_t first, int lanes) {
      for (int i = 0; i < lanes; ++i) {
        evaluation.gather(e.*material, i, params);
        use(params.data(), first + static_cast<std::size_t>(i));
      }
    });
  });
}

/// Calls `use(bsdf, wo, choice, point)`: the material, light's direction, and what is along it.
template <class Use>
int for_each_bsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                  const float* wo, Use use) {
  using Bsdf = materials::Bsdf<float>;
  return for_each_point(context, surface, points, &vm::Descriptor::shade, &vm::Entry::material,
                        [&](const float* params, std::size_t i) {
                          if (!context->choice) context->choice = std::make_unique<Bsdf::Choice>();
                          const Bsdf bsdf(surface->bsdf, params);
                          const Vec3f along = load(wo, points->count, i);
                          bsdf.choose(along, *context->choice);
                          use(bsdf, along, *context->choice, i);
                        });
}

template <class Use>
int for_each_phase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points, Use use) {
  return for_each_point(context, volume, points, &vm::Descriptor::shade, &vm::Entry::material,
                        [&](const float* params, std::size_t i) {
                          use(materials::Phase<float>(volume->phase, params), i);
                        });
}

/// What both kinds of sample have in common; nothing where there is none.
template <class Sample>
void store(const std::optional<Sample>& s, std::size_t n, std::size_t i, float* wi, float* f,
           float* pdf) {
  store(s ? s->wi : Vec3f(), wi, n, i);
  store(s ? s->f : Spectrumf(), f, n, i);
  store(s ? s->pdf : Spectrumf(), pdf, n, i);
}

}  // namespace

static_assert(MMS_WAVELENGTHS == kWavelengths);

int mmsEvalBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                const float* wo, const float* wi, float* f) {
  if (!wo || !wi || !f) return 0;
  const auto eval = [&](const auto& bsdf, Vec3f along, const auto& choice, std::size_t i) {
    const std::size_t n = points->count;
    store(bsdf.evaluate(along, load(wi, n, i), kMode, choice).f, f, n, i);
  };
  return for_each_bsdf(context, surface, points, wo, eval);
}

int mmsPdfBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
               const float* wo, const float* wi, float* pdf) {
  if (!wo || !wi || !pdf) return 0;
  const auto density = [&](const auto& bsdf, Vec3f along, const auto& choice, std::size_t i) {
    const std::size_t n = points->count;
    store(bsdf.pdf(along, load(wi, n, i), kMode, choice), pdf, n, i);
  };
  return for_each_bsdf(context, surface, points, wo, density);
}

int mmsSampleBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                  const float* wo, const float* u, float* wi, float* f, float* pdf,
                  unsigned char* flags) {
  if (!wo || !u || !wi || !f || !pdf || !flags) return 0;
  const auto sample = [&](const auto& bsdf, Vec3f along, const auto& choice, std::size_t i) {
    const std::size_t n = points->count;
    const auto s = bsdf.sample(along, u[i], u[n + i], u[2 * n + i], kMode, choice);
    store(s, n, i, wi, f, pdf);
    const int bits = !s ? 0
                        : MMS_SAMPLED | (s->specular ? MMS_SPECULAR : 0) |
                              (s->transmitted ? MMS_TRANSMITTED : 0);
    flags[i] = static_cast<unsigned char>(bits);
  };
  return for_each_bsdf(context, surface, points, wo, sample);
}

int mmsEvalPhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                 const float* wo, const float* wi, float* f) {
  if (!wo || !wi || !f) return 0;
  return for_each_phase(context, volume, points, [&](const auto& phase, std::size_t i) {
    const std::size_t n = points->count;
    store(phase.eval(load(wo, n, i), load(wi, n, i)), f, n, i);
  });
}

int mmsPdfPhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                const float* wo, const float* wi, float* pdf) {
  if (!wo || !wi || !pdf) return 0;
  return for_each_phase(context, volume, points, [&](const auto& phase, std::size_t i) {
    const std::size_t n = points->count;
    store(phase.pdf(load(wo, n, i), load(wi, n, i)), pdf, n, i);
  });
}

int mmsSamplePhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                   const float* wo, const float* u, float* wi, float* f, float* pdf,
                   unsigned char* flags) {
  if (!wo || !u || !wi || !f || !pdf || !flags) return 0;
  return for_each_phase(context, volume, points, [&](const auto& phase, std::size_t i) {
    const std::size_t n = points->count;
    const auto s = phase.sample(load(wo, n, i), u[i], u[n + i], u[2 * n + i]);
    store(s, n, i, wi, f, pdf);
    flags[i] = s ? MMS_SAMPLED : 0;
  });
}

int mmsEvalSurfaceEmission(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                           const float* w, float* shape) {
  if (!w || !shape) return 0;
  return for_each_point(context, surface, points, &vm::Descriptor::emit,
                        &vm::Entry::emission_material, [&](const float* params, std::size_t i) {
                          const std::size_t n = points->count;
                          store(materials::emission_shape(surface->emission, params, load(w, n, i)),
                                shape, n, i);
                        });
}

int mmsEvalVolumeEmission(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                          const float* w, float* shape) {
  if (!w || !shape) return 0;
  return for_each_point(
      context, volume, points, &vm::Descriptor::emit, &vm::Entry::emission_material,
      [&](const float* params, std::size_t i) {
        const std::size_t n = points->count;
        store(materials::volume_emission_shape(volume->emission, params, load(w, n, i)), shape, n,
              i);
      });
}
