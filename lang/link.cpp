// SPDX-License-Identifier: Apache-2.0
#include "lang/link.h"

#include <set>
#include <stdexcept>

#include "lang/elaborator.h"
#include "lang/emit.h"
#include "lang/lint.h"
#include "lang/optimise.h"
#include "vm/verify.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::Output;
using vm::SlotType;

/// The outputs of one descriptor as a run of results of its IR function.
struct Outputs {
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  Range ranges[static_cast<std::size_t>(Output::Count)];
  MaterialPtr materials[static_cast<std::size_t>(Output::Count)];
  Range of(Output o) const { return ranges[static_cast<std::size_t>(o)]; }
};

void material_params(const MaterialTree& m, std::vector<Ref>& refs) {
  for (const auto& c : m.children) material_params(*c, refs);
  refs.insert(refs.end(), m.params.begin(), m.params.end());
}

void value_refs(const Value& v, std::vector<Ref>& refs) {
  refs.insert(refs.end(), v.refs.begin(), v.refs.end());
  for (const Value& p : v.parts) value_refs(p, refs);
  if (v.material) material_params(*v.material, refs);
}

/// Builds one entry: collects the results it needs and says where each value is found.
class EntryBuilder {
 public:
  EntryBuilder(Emitter& emitter, const IrFunction& f) : emitter_(emitter), f_(f) {}

  vm::ValueSource source(Ref r) {
    const Node* n = &f_.nodes[r.node];
    const SlotType type = f_.type(r);
    if (n->op == Op::Splat && f_.nodes[n->args[0].node].known >= 0) n = &f_.nodes[n->args[0].node];
    if (n->known >= 0) return {type, true, emitter_.constant(static_cast<std::uint32_t>(n->known))};
    for (std::size_t k = 0; k < results_.size(); ++k)
      if (results_[k] == r) return {type, false, static_cast<std::uint32_t>(k)};
    results_.push_back(r);
    return {type, false, static_cast<std::uint32_t>(results_.size() - 1)};
  }

  vm::MaterialLayout layout(const MaterialTree& m, std::size_t& next) {
    vm::MaterialLayout l;
    add(m, next, l);
    return l;
  }

  const std::vector<Ref>& results() const { return results_; }

 private:
  std::uint32_t add(const MaterialTree& m, std::size_t& next, vm::MaterialLayout& l) {
    vm::LayoutNode n;
    n.lobe = m.row->lobe;
    for (const auto& c : m.children) n.children.push_back(add(*c, next, l));
    for (std::size_t k = 0; k < m.params.size(); ++k)
      n.params.push_back(source(f_.results[next++]));
    l.nodes.push_back(std::move(n));
    return static_cast<std::uint32_t>(l.nodes.size() - 1);
  }

  Emitter& emitter_;
  const IrFunction& f_;
  std::vector<Ref> results_;
};

/// What a value depends on.
class Dependencies {
 public:
  explicit Dependencies(const Module& m) : m_(m) {}

  std::uint32_t of(FunctionId function, std::span<const Ref> roots) {
    std::uint32_t mask = 0;
    const IrFunction& f = m_.functions[function];
    const std::vector<bool> seen =
        reached(f, roots, [&](Ref r) { return f.nodes[r.node].known < 0; });
    for (std::size_t i = 0; i < f.nodes.size(); ++i) {
      const Node& n = f.nodes[i];
      if (!seen[i]) continue;
      if (n.op == Op::PushInput)
        mask |= 1u << static_cast<int>(vm::input_variable(static_cast<int>(n.a)));
      if (n.op == Op::Call && called_.insert(n.a).second)
        mask |= of(n.a, m_.functions[n.a].results);
    }
    return mask;
  }
  void reset() { called_.clear(); }

 private:
  const Module& m_;
  std::set<FunctionId> called_;
};

constexpr std::uint32_t bit(vm::Variable v) { return 1u << static_cast<int>(v); }
constexpr std::uint32_t kSpectral =
    bit(vm::Variable::Wavelength) | bit(vm::Variable::RgbRed) | bit(vm::Variable::RgbGreen);

class ProgramBuilder {
 public:
  ProgramBuilder(Elaborator& e, Diagnostics& d)
      : e_(e), diagnostics_(d), emitter_(e.module, program_) {}

  vm::Program build(const LinkOptions& options, std::string& dump) {
    std::vector<Outputs> outputs;
    for (ElaboratedDescriptor& d : e_.descriptors) outputs.push_back(gather(d));
    dump = optimise(e_.module, options);
    for (std::size_t i = 0; i < e_.descriptors.size(); ++i)
      descriptor(e_.descriptors[i], outputs[i]);
    for (const ElaboratedExport& x : e_.exports) {
      const std::vector<Ref>& results = e_.module.functions[x.function].results;
      program_.exports.push_back({x.name, x.type, emitter_.emit(x.function, results, x.name)});
    }
    program_.images = e_.module.images;
    program_.sources = e_.sources;
    program_.builtins = e_.module.builtins;
    program_.builtin_params = e_.module.builtin_params;
    program_.builtin_results = e_.module.builtin_results;
    return std::move(program_);
  }

 private:
  /// Makes every output a result of the descriptor's function, so that the passes carry it along.
  Outputs gather(ElaboratedDescriptor& d) {
    Outputs o;
    std::vector<Ref> refs;
    for (std::size_t k = 0; k < static_cast<std::size_t>(Output::Count); ++k) {
      o.ranges[k].begin = refs.size();
      value_refs(d.outputs[k], refs);
      o.ranges[k].end = refs.size();
      o.materials[k] = d.outputs[k].material;
    }
    e_.module.functions[d.function].results = std::move(refs);
    return o;
  }

  vm::Entry entry(const ElaboratedDescriptor& d, const Outputs& o,
                  std::initializer_list<Output> wanted, const char* what) {
    const IrFunction& f = e_.module.functions[d.function];
    EntryBuilder b(emitter_, f);
    vm::Entry e;
    for (Output out : wanted) {
      std::size_t next = o.of(out).begin;
      auto value = [&] { return b.source(f.results[next++]); };
      switch (out) {
        case Output::Material:
          e.material = b.layout(*o.materials[static_cast<int>(out)], next);
          break;
        case Output::EmissionMaterial:
          e.emission_material = b.layout(*o.materials[static_cast<int>(out)], next);
          break;
        case Output::Scattering:
          e.scattering = value();
          break;
        case Output::Absorption:
          e.absorption = value();
          break;
        case Output::Emission:
          e.emission = value();
          break;
        case Output::Height:
          e.height = value();
          break;
        case Output::Bound:
          e.bound = value();
          break;
        case Output::Gradient:
          e.gradient[0] = value();
          e.gradient[1] = value();
          break;
        case Output::Count:
          break;
      }
    }
    if (!b.results().empty())
      e.function = emitter_.emit(d.function, b.results(), d.name + "." + what);
    return e;
  }

  void descriptor(const ElaboratedDescriptor& d, const Outputs& o) {
    vm::Descriptor out;
    const bool surface = d.syntax->form == Descriptor::Form::Surface;
    out.form = surface ? vm::DescriptorForm::Surface : vm::DescriptorForm::Volume;
    out.name = d.name;
    out.shade = entry(d, o,
                      {Output::Scattering, Output::Absorption, Output::Emission, Output::Material,
                       Output::EmissionMaterial, Output::Gradient},
                      "shade");
    out.pass = entry(d, o, {Output::Scattering, Output::Absorption}, "pass");
    out.emit = entry(d, o, {Output::Emission, Output::EmissionMaterial}, "emit");
    out.displace = entry(d, o, {Output::Height, Output::Bound}, "displace");
    const IrFunction& f = e_.module.functions[d.function];
    Dependencies depends(e_.module);
    for (std::size_t k = 0; k < static_cast<std::size_t>(Output::Count); ++k) {
      const Outputs::Range r = o.ranges[k];
      vm::OutputInfo& info = out.outputs[k];
      depends.reset();
      info.stated = d.stated[k];
      info.variables =
          depends.of(d.function, std::span(f.results).subspan(r.begin, r.end - r.begin));
      info.spectral = (info.variables & kSpectral) != 0;
      info.constant = info.variables == 0;
    }
    const vm::OutputInfo& material = out.output(Output::Material);
    if (surface && (material.variables & bit(vm::Variable::View)))
      diagnostics_.add(Diag::ViewDependent, d.syntax->name.span, "bsdf", out.name);
    out.line = {0, position_at(*d.graph->source, d.syntax->name.span.begin).line};
    for (std::size_t s = 0; s < e_.sources.size(); ++s)
      if (e_.sources[s] == d.graph->source->name) out.line.source = static_cast<std::uint32_t>(s);
    program_.descriptors.push_back(std::move(out));
  }

  Elaborator& e_;
  Diagnostics& diagnostics_;
  vm::Program program_;
  Emitter emitter_;
};

}  // namespace

namespace {

/// Where a function of the machine is defined: an entry is named after its descriptor.
Span place_of(std::span<const Graph> graphs, std::string_view function) {
  const std::string_view descriptor = function.substr(0, function.find('.'));
  for (const Graph& g : graphs) {
    for (const Descriptor& d : g.descriptors)
      if (d.name.text == descriptor) return d.name.span;
    for (const FunctionHandle f : g.top_functions)
      if (g[f].name.text == function) return g[f].name.span;
    for (const Constant& k : g.constants)
      if (k.name.text == function) return k.name.span;
  }
  return {};
}

}  // namespace

std::optional<Linked> link(std::span<const Graph> graphs, const Library& library,
                           const LinkOptions& options, Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) return std::nullopt;
  auto done = [&](std::string_view stage) {
    if (options.stage_done) options.stage_done(stage);
  };
  for (const Graph& g : graphs) {
    const bool empty = g.descriptors.empty() && g.top_functions.empty() && g.constants.empty() &&
                       g.type_definitions.empty() && g.params.empty() && g.imports.empty() &&
                       g.aliases.empty();
    if (empty)
      diagnostics.add(Diag::NothingToLink, Span{g.source.get(), 0, 0})
          .help("begin with `surface grey bsdf = matte(0.5); end`");
    lint(g, diagnostics);
  }
  done("lint");
  Elaborator elaborator(library, options, diagnostics);
  elaborator.run(graphs);
  if (diagnostics.has_errors()) return std::nullopt;
  done("elaborate");
  Linked linked;
  linked.program = ProgramBuilder(elaborator, diagnostics).build(options, linked.dump);
  linked.params = std::move(elaborator.params);
  linked.dependencies = std::move(elaborator.dependencies);
  linked.unknown_params = std::move(elaborator.unknown_params);
  done("emit");
  const auto fault = vm::verify(linked.program);
  done("verify");
  if (fault && fault->limit) {
    diagnostics.add(Diag::TooLarge, place_of(graphs, fault->function), fault->function,
                    fault->what);
    return std::nullopt;
  }
  if (fault)
    throw std::logic_error("emitted code does not verify: " + fault->function + ": " + fault->what);
  return linked;
}

}  // namespace mms::lang
