// SPDX-License-Identifier: Apache-2.0
// Evaluation over arrays of points: the half of mms.h that runs programs.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "api/handles.h"
#include "api/inputs.h"
#include "api/outputs.h"
#include "materials/bsdf.h"

using namespace mms;

namespace {

struct BoundInput {
  vm::Variable variable;
  const float* values;
};

/// One call: its points cut into batches, an entry run over each.
class Evaluation {
 public:
  Evaluation(MMsContext& context, const MMsPoints& points) : context_(context), points_(points) {}

  /// Finds every input by its name; false, and why in the log, if there is none.
  bool bind() {
    for (std::size_t k = 0; k < points_.input_count; ++k) {
      const MMsInput& input = points_.inputs[k];
      if (!input.name || !input.values) return complain("an input without name or values");
      const Result<vm::Variable> variable = api::find_variable(input.name);
      if (!variable)
        return complain(fmt::format("{}: {} ({})", variable.error().where, variable.error().what,
                                    variable.error().hint));
      inputs_.push_back({*variable, input.values});
    }
    return true;
  }

  bool complain(std::string what) {
    context_.log = std::move(what);
    return false;
  }

  /// Calls `use(first, lanes)` for every batch, after `entry` has been run over it.
  template <class Use>
  bool run(const vm::Entry& entry, Use use) {
    api::fill_defaults(context_.in);
    std::size_t faults = 0;
    vm::SourceLine line;
    for (std::size_t first = 0; first < points_.count; first += width()) {
      const int lanes = static_cast<int>(std::min(width(), points_.count - first));
      if (entry.function) {
        for (const BoundInput& input : inputs_)
          api::fill(context_.in, input.variable, input.values + first, points_.count, lanes);
        context_.machine.run(*context_.program->executable, *entry.function, context_.in, lanes);
        if (const auto given_up = context_.machine.faults(); !given_up.empty()) {
          faults += given_up.size();
          line = given_up[0].line;
        }
      }
      use(first, lanes);
    }
    if (faults > 0) report(faults, line);
    return true;
  }

  /// Component `c` of a value in lane `i` of the batch that was run last.
  float value(const vm::ValueSource& source, int c, int i) const {
    if (source.constant) {
      const vm::Constant& constant = context_.program->linked->program.constants[source.index];
      return constant.type == vm::SlotType::Real ? constant.f32
                                                 : static_cast<float>(constant.integer);
    }
    const int k = static_cast<int>(source.index);
    if (source.type == vm::SlotType::Real) return context_.machine.result(k)[i];
    if (source.type == vm::SlotType::Spectrum) return context_.machine.result(k, c)[i];
    return static_cast<float>(context_.machine.integer_result(k)[i]);
  }

 private:
  std::size_t width() const { return static_cast<std::size_t>(context_.in.width()); }

  void report(std::size_t faults, vm::SourceLine line) {
    const auto& sources = context_.program->linked->program.sources;
    context_.log =
        fmt::format("{} points ran out of their budget; {}:{}", faults,
                    line.source < sources.size() ? sources[line.source] : "?", line.line);
  }

  MMsContext& context_;
  const MMsPoints& points_;
  std::vector<BoundInput> inputs_;
};

bool eval_output(MMsContext& context, const vm::Descriptor& descriptor, const char* name,
                 const MMsPoints& points, float* values) {
  Evaluation evaluation(context, points);
  const auto output = api::find_output(descriptor.form, name);
  if (!output) return evaluation.complain(fmt::format("no output is called `{}`", name));
  const auto numbers = api::number_sources(descriptor, *output);
  if (!numbers) return evaluation.complain(fmt::format("`{}` is a material, not numbers", name));
  if (!evaluation.bind()) return false;
  const int size = static_cast<int>(mmsGetOutputSize(name));
  return evaluation.run(*numbers->entry, [&](std::size_t first, int lanes) {
    for (int c = 0; c < size; ++c) {
      const bool array = numbers->sources.size() > 1;
      const vm::ValueSource& source = numbers->sources[array ? static_cast<std::size_t>(c) : 0];
      for (int i = 0; i < lanes; ++i)
        values[static_cast<std::size_t>(c) * points.count + first + static_cast<std::size_t>(i)] =
            evaluation.value(source, c, i);
    }
  });
}

/// The numbers of a layout for lane `i`, in the order that materials/layout.h states.
void gather(const Evaluation& evaluation, const vm::MaterialLayout& material, int i,
            std::vector<float>& params) {
  params.clear();
  for (const vm::LayoutNode& node : material.nodes) {
    const materials::Formals& formals = materials::formals(static_cast<materials::Lobe>(node.lobe));
    std::size_t next = 0;
    for (int k = 0; k < formals.count; ++k) {
      if (formals.kinds[k] == 'm') continue;
      const vm::ValueSource& source = node.params[next++];
      const int count = formals.kinds[k] == 's' ? kWavelengths : 1;
      for (int c = 0; c < count; ++c) params.push_back(evaluation.value(source, c, i));
    }
  }
}

/// Calls `use(bsdf, point)` for every point.
template <class Use>
int for_each_bsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                  Use use) {
  if (!context || !surface || !points) return 0;
  return api::guarded(context->log, [&] {
    Evaluation evaluation(*context, *points);
    if (!evaluation.bind()) return false;
    const vm::Entry& entry = surface->descriptor->shade;
    std::vector<float> params;
    return evaluation.run(entry, [&](std::size_t first, int lanes) {
      for (int i = 0; i < lanes; ++i) {
        gather(evaluation, entry.material, i, params);
        use(materials::Bsdf<float>(surface->bsdf, params.data()),
            first + static_cast<std::size_t>(i));
      }
    });
  });
}

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

constexpr materials::Mode kMode = materials::Mode::Radiance;

}  // namespace

static_assert(MMS_WAVELENGTHS == kWavelengths);

MMsContext* mmsMkContext(const MMsProgram* program) {
  return program && program->executable ? api::make<MMsContext>(*program) : nullptr;
}

void mmsDeleteContext(MMsContext* context) { delete context; }

const char* mmsGetContextLog(const MMsContext* context) {
  return context ? context->log.c_str() : "";
}

size_t mmsGetOutputSize(const char* output) {
  if (!output) return 0;
  const auto found = api::find_output(vm::DescriptorForm::Surface, output);
  if (!found) return 0;
  switch (*found) {
    case vm::Output::Height:
    case vm::Output::Bound:
      return 1;
    case vm::Output::Gradient:
      return 2;
    case vm::Output::Scattering:
    case vm::Output::Absorption:
    case vm::Output::Emission:
      return kWavelengths;
    default:
      return 0;
  }
}

int mmsEvalSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                   const MMsPoints* points, float* values) {
  if (!context || !surface || !output || !points || !values) return 0;
  return api::guarded(context->log, [&] {
    return eval_output(*context, *surface->descriptor, output, *points, values);
  });
}

int mmsEvalVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                  const MMsPoints* points, float* values) {
  if (!context || !volume || !output || !points || !values) return 0;
  return api::guarded(context->log, [&] {
    return eval_output(*context, *volume->descriptor, output, *points, values);
  });
}

int mmsEvalBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                const float* wo, const float* wi, float* f) {
  if (!wo || !wi || !f) return 0;
  return for_each_bsdf(context, surface, points,
                       [&](const materials::Bsdf<float>& bsdf, std::size_t i) {
                         const std::size_t n = points->count;
                         store(bsdf.eval(load(wo, n, i), load(wi, n, i), kMode), f, n, i);
                       });
}

int mmsPdfBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
               const float* wo, const float* wi, float* pdf) {
  if (!wo || !wi || !pdf) return 0;
  return for_each_bsdf(context, surface, points,
                       [&](const materials::Bsdf<float>& bsdf, std::size_t i) {
                         const std::size_t n = points->count;
                         store(bsdf.pdf(load(wo, n, i), load(wi, n, i), kMode), pdf, n, i);
                       });
}

int mmsSampleBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                  const float* wo, const float* u, float* wi, float* f, float* pdf,
                  unsigned char* flags) {
  if (!wo || !u || !wi || !f || !pdf || !flags) return 0;
  return for_each_bsdf(
      context, surface, points, [&](const materials::Bsdf<float>& bsdf, std::size_t i) {
        const std::size_t n = points->count;
        const auto sample = bsdf.sample(load(wo, n, i), u[i], u[n + i], u[2 * n + i], kMode);
        store(sample ? sample->wi : Vec3f(), wi, n, i);
        store(sample ? sample->f : Spectrumf(), f, n, i);
        store(sample ? sample->pdf : Spectrumf(), pdf, n, i);
        flags[i] =
            !sample
                ? 0
                : static_cast<unsigned char>(MMS_SAMPLED | (sample->specular ? MMS_SPECULAR : 0) |
                                             (sample->transmitted ? MMS_TRANSMITTED : 0));
      });
}
