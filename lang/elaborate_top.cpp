// SPDX-License-Identifier: Apache-2.0
/// \file
/// Sources, imports, params and descriptors of the elaborator.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "lang/conservation.h"
#include "lang/elaborator.h"
#include "lang/lint.h"
#include "lang/parser.h"
#include "vm/limits.h"
#include "vm/outputs.h"

namespace mms::lang {
namespace {

using vm::Output;
using vm::SlotType;

using vm::OutputRow;

constexpr vm::DescriptorForm form_of(Descriptor::Form form) {
  return form == Descriptor::Form::Surface ? vm::DescriptorForm::Surface
                                           : vm::DescriptorForm::Volume;
}

std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

Elaborator::Mark Elaborator::mark() {
  carried_.clear();
  return {scopes_.size(), kept_};
}

/// The scopes made since, if nothing refers to them any more.
bool Elaborator::forget_scopes(Mark since) {
  if (kept_ != since.kept) return false;
  for (Binding* b : carried_) b->cache.erase(function_);
  scopes_.erase(scopes_.begin() + std::ptrdiff_t(since.scopes), scopes_.end());
  return true;
}

/// The current function, which is the last, and its scopes, if nothing refers to them any more.
void Elaborator::forget_function(Mark since) {
  if (forget_scopes(since)) module.functions.pop_back();
}

FunctionId Elaborator::new_function(std::string name) {
  ++kept_;
  module.functions.push_back({std::move(name), {}, {}, {}, false});
  return static_cast<FunctionId>(module.functions.size() - 1);
}

std::uint32_t Elaborator::source_index(const Source* s) {
  auto [it, is_new] = source_index_.try_emplace(s, static_cast<std::uint32_t>(sources.size()));
  if (is_new) sources.push_back(s->name);
  return it->second;
}

vm::SourceLine Elaborator::line_of(Span s) {
  if (!s.source) return line_;
  const std::uint32_t line = line_at(*s.source, s.begin);
  return {source_index(s.source), line, byte_column(*s.source, s.begin, line)};
}

void Elaborator::declare_items(const Graph& graph, Scope* scope) {
  const Context c{&graph, scope};
  for (const Constant& k : graph.constants) declare_constant(c, k);
  for (const TypeDefinition& t : graph.type_definitions) declare_type(c, t);
  for (FunctionHandle h : graph.top_functions) declare_function(c, h);
}

/// What makes two imports one: a file may be written in many ways.
std::string Elaborator::import_key(const std::string& name) const {
  return options_.resolve ? name : std::filesystem::weakly_canonical(name).string();
}

void Elaborator::import(const Graph& from, const Import& i, Scope* scope) {
  auto name_it = [&](Scope* space) {
    if (!i.as) return;
    Binding b;
    b.form = Binding::Form::Namespace;
    b.scope = space;
    declare(scope, *i.as, std::move(b));
  };
  auto join = [&](Scope* space) {
    if (!i.as && space != scope) scope->imports.push_back(space);
    name_it(space);
  };
  auto taken = [&](const std::string& key) {
    auto known_file = imported_.find(key);
    closes_circle(key, i);  // its names are there all the same: one message is enough
    if (known_file == imported_.end()) return false;
    join(known_file->second);
    return true;
  };
  auto take = [&](const std::string& key, const std::string& name, std::string text) {
    graphs_.push_back(parse(make_source(name, std::move(text)), diagnostics_));
    if (!i.as && !from.descriptors.empty() && !uses(from, graphs_.back()))
      diagnostics_.add(Diag::UnusedImport, i.span, i.file);
    Scope* space = new_scope(library_scope_);
    imported_[key] = space;
    add_graph(graphs_.back(), space);
    join(space);
  };
  if (options_.resolve) {
    if (auto found = options_.resolve(from.source->name, i.file)) {
      if (taken(found->name)) return;
      dependencies.push_back(found->name);
      return take(found->name, found->name, std::move(found->text));
    }
  } else {
    namespace fs = std::filesystem;
    std::vector<fs::path> places{fs::path(from.source->name).parent_path() / i.file};
    for (const std::string& dir : options_.import_path) places.push_back(fs::path(dir) / i.file);
    for (const fs::path& place : places) {
      const std::string key = import_key(place.string());
      if (taken(key)) return;
      if (options_.looked_for) options_.looked_for(place.string());
      if (std::optional<std::string> text = read_file(place)) {
        dependencies.push_back(place.string());
        return take(key, place.string(), std::move(*text));
      }
    }
  }
  auto library_module = modules_.find(i.file);
  if (library_module != modules_.end()) return name_it(library_module->second);
  if (const Library::Script* script = library_.script(i.file)) {
    const std::string name = fmt::format("<{}>", script->name);
    if (!taken(name)) take(name, name, std::string(script->text));
    return;
  }
  Scope* nothing = new_scope(nullptr);
  nothing->missing = true;  // nothing more is said of its names
  name_it(nothing);
  Diagnostic& d = diagnostics_.add(Diag::ImportNotFound, i.span, i.file);
  std::vector<std::string> modules;
  for (const auto& [name, unused] : modules_) modules.push_back(name);
  for (const Library::Script& s : library_.scripts) modules.emplace_back(s.name);
  const std::string near = nearest(i.file, modules);
  d.help(near.empty() ? "files are looked for beside the script, then in each `-I` folder"
                      : fmt::format("did you mean the library's `{}`?", near));
}

/// Whether the file is one of those that led here; says so.
bool Elaborator::closes_circle(const std::string& key, const Import& i) {
  auto first = std::find_if(open_files_.begin(), open_files_.end(),
                            [&](const OpenFile& f) { return f.key == key; });
  if (first == open_files_.end()) return false;
  std::string chain;
  for (auto f = first; f != open_files_.end(); ++f) chain += f->name + " -> ";
  diagnostics_.add(Diag::ImportCycle, i.span, chain + first->name)
      .help("move what both files need into a third, which both import");
  return true;
}

void Elaborator::add_graph(const Graph& graph, Scope* scope) {
  open_files_.push_back({import_key(graph.source->name),
                         std::filesystem::path(graph.source->name).filename().string()});
  scope->file = true;
  for (const Import& i : graph.imports) import(graph, i, scope);
  add_params(graph, scope);
  declare_items(graph, scope);
  for (const Descriptor& d : graph.descriptors)
    scope->descriptors.push_back({d.name.text, &graph, &d, scope});
  add_aliases(graph, scope);
  open_files_.pop_back();
}

/// A param is a constant whose value the command line may replace.
void Elaborator::add_params(const Graph& graph, Scope* scope) {
  for (const Param& p : graph.params) {
    Binding b;
    b.form = Binding::Form::Constant;
    b.graph = &graph;
    b.scope = scope;
    b.expr = p.value;
    b.stated = p.type;
    b.stated_in = &graph;  // a replaced value is in another one
    for (const auto& [name, text] : options_.params) {
      if (name != p.name.text) continue;
      graphs_.push_back(parse_expression(make_source("--set " + name, text), diagnostics_));
      if (graphs_.back().exprs.empty()) continue;
      b.graph = &graphs_.back();
      b.expr = {static_cast<std::uint32_t>(graphs_.back().exprs.size() - 1)};
    }
    declare(scope, p.name, std::move(b));
    declared_params_.push_back({&graph, &p, scope});
  }
}

void Elaborator::describe_param(const Graph& graph, const Param& p, Scope* scope) {
  const Context c{&graph, scope};
  Binding* b = find(scope, p.name.text);
  const Span value_span = (*b->graph)[b->expr].span;
  const Value v = evaluate_constant(*b);
  ParamInfo info{p.name.text, types_.spell(v.type), p.doc, {}, {}, {}, {}, {}};
  std::vector<Ref> refs;
  flatten(v, refs);
  for (Ref r : refs) {
    const vm::Constant* k = known(r);
    if (!k && slot_type(r) != SlotType::Spectrum)
      diagnostics_.add(Diag::NeedsConstant, value_span, fmt::format("the param `{}`", p.name.text));
    if (k) info.value.push_back(k->type == SlotType::Real ? k->f64 : k->integer);
  }
  auto number = [&](ExprHandle h) -> std::optional<double> {
    const Value n = convert(expr(c, h), kReal, graph[h].span);
    const vm::Constant* k = n.poison() ? nullptr : known(n.refs[0]);
    if (!n.poison() && !k)
      diagnostics_.add(Diag::NeedsConstant, graph[h].span, "the range of a param");
    return k ? std::optional<double>(k->f64) : std::nullopt;
  };
  if (p.lower && p.upper) {
    const auto lo = number(p.lower), hi = number(p.upper);
    if (lo && hi) info.range = {*lo, *hi};
    for (double x : info.value)
      if (lo && hi && !(*lo <= x && x <= *hi))
        diagnostics_.add(Diag::ParamRange, value_span, p.name.text, std::isnan(x) ? std::abs(x) : x,
                         *lo, *hi);  // its sign says nothing
  }
  for (const Param::Meta& m : p.meta) {
    const Value text = expr(c, m.value);
    std::string* slot = m.key.text == "label"  ? &info.label
                        : m.key.text == "unit" ? &info.unit
                        : m.key.text == "page" ? &info.page
                                               : nullptr;
    if (!slot) {
      diagnostics_.add(Diag::UnknownMeta, m.key.span, m.key.text)
          .help("there are `label`, `unit` and `page`");
      continue;
    }
    *slot = convert(text, kString, graph[m.value].span).text;
  }
  params.push_back(std::move(info));
}

/// The surfaces and volumes that go by that name there.
std::vector<NamedDescriptor> Elaborator::find_descriptors(Context c, const Path& path) {
  Scope* scope = c.scope;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const std::vector<Binding*> found = bindings_in(scope, path[i].text);
    if (found.empty() || found[0]->form != Binding::Form::Namespace) return {};
    scope = found[0]->scope;
  }
  std::vector<NamedDescriptor> all;
  std::vector<Scope*> places{scope};
  places.insert(places.end(), scope->imports.begin(), scope->imports.end());
  for (const Scope* s : places)
    for (const NamedDescriptor& d : s->descriptors)
      if (d.name == path.back().text) all.push_back(d);
  return all;
}

void Elaborator::add_aliases(const Graph& graph, Scope* scope) {
  for (const Alias& a : graph.aliases) {
    std::vector<NamedDescriptor> same = find_descriptors({&graph, scope}, a.inside);
    for (NamedDescriptor& d : same) {
      d.name = a.outside.text;
      scope->descriptors.push_back(d);
    }
    if (Binding* b = find({&graph, scope}, a.inside)) {
      Binding copy = *b;
      declare(scope, a.outside, std::move(copy));
    } else if (same.empty()) {
      unknown_name({&graph, scope}, a.inside, Diag::UnknownName);
    }
  }
}

/// What an alias names is seen from outside like what it stands for.
void Elaborator::export_alias(const Alias& a) {
  Binding* b = find(program_scope_, a.outside.text);
  if (!b) return;
  function_ = new_function("alias " + a.outside.text);
  if (b->form == Binding::Form::Constant)
    return export_value(a.outside.text, evaluate_constant(*b));
  for (FunctionDecl* d : b->functions)
    if (d->function().formals.empty() && !d->library) {
      std::vector<BoundArgument> none;
      return export_value(a.outside.text, call_script(d, {}, none, a.span));
    }
}

void Elaborator::check_constant(const Graph& graph, const Constant& k, Scope* scope) {
  function_ = new_function("const " + k.name.text);
  Binding* b = find(scope, k.name.text);
  if (b && b->form == Binding::Form::Constant && b->graph == &graph)
    export_value(k.name.text, evaluate_constant(*b));
}

/// Makes the current function, whose value is `v`, visible from outside.
void Elaborator::export_value(const std::string& name, const Value& v) {
  ++kept_;
  if (v.poison() || !types_.is_numeric(v.type)) return;
  std::vector<Ref> refs;
  flatten(v, refs);
  for (Ref& r : refs) r = localise(r);
  module.functions[function_].results = refs;
  exports.push_back({name, types_.spell(v.type), function_});
}

void Elaborator::descriptor(const NamedDescriptor& named) {
  const Descriptor& d = *named.syntax;
  const auto [first, is_new] = descriptor_names_.try_emplace({d.form, named.name}, d.name.span);
  if (!is_new)
    diagnostics_.add(Diag::Redefined, d.name.span, named.name)
        .note(first->second, "first defined here");
  function_ =
      new_function((d.form == Descriptor::Form::Surface ? "surface " : "volume ") + named.name);
  // About what its own text asks for; what it calls comes on top.
  module.functions[function_].nodes.reserve((d.span.end - d.span.begin) / 6);
  ElaboratedDescriptor e;
  e.syntax = &d;
  e.graph = named.graph;
  e.name = named.name;
  e.function = function_;
  line_ = line_of(d.name.span);
  const Mark before = mark();
  Scope* inner = new_scope(named.scope);
  body({named.graph, inner}, d.body);
  outputs(e, inner);
  forget_scopes(before);
  descriptors.push_back(std::move(e));
}

void Elaborator::outputs(ElaboratedDescriptor& e, Scope* scope) {
  const Descriptor& d = *e.syntax;
  const bool surface = d.form == Descriptor::Form::Surface;
  auto assignment = [&](std::string_view name) -> const Assignment* {
    for (const Assignment& a : d.body.assignments)
      if (a.name.text == name) return &a;
    return nullptr;
  };
  auto default_value = [&](Output o) -> Value {
    switch (vm::kOutputs[static_cast<std::size_t>(o)].shape) {
      case OutputRow::Shape::Material:
        return call_library(surface ? "matte" : "isotropic", {}, d.name.span);
      case OutputRow::Shape::Spectrum:
        return widen(scalar(kReal, real(surface && o == Output::Scattering ? 1 : 0)), kSpectrum);
      case OutputRow::Shape::Real:
        return scalar(kReal, real(0));
      case OutputRow::Shape::Real2:
        break;
    }
    Value zero;
    zero.type = types_.array(kReal, 2);
    zero.parts = {scalar(kReal, real(0)), scalar(kReal, real(0))};
    return zero;
  };
  for (std::size_t o = 0; o < vm::kOutputCount; ++o) {
    const std::string_view name = vm::output_name(form_of(d.form), static_cast<Output>(o));
    const Assignment* a = name.empty() ? nullptr : assignment(name);
    e.outputs[o] = default_value(static_cast<Output>(o));
    if (!a) continue;
    const TypeId type = e.outputs[o].type;
    e.stated[o] = true;
    const Value v = convert(scope->names[std::string(name)].value, type, (*e.graph)[a->value].span);
    if (v.poison()) continue;
    e.outputs[o] = v;
    if (v.material && v.material->size() > vm::limits::kLobes)
      diagnostics_.add(Diag::TooManyLobes, a->name.span, v.material->size(), vm::limits::kLobes);
    if (static_cast<Output>(o) != Output::Material || !v.material) continue;
    constexpr double kRounding = 1e-6;  // of a sum of weights that was meant to be 1
    if (const double w = stated_weight(module, *v.material); w > 1 + kRounding)
      diagnostics_.add(Diag::NonConserving, a->name.span, w);
    if (const auto index = inverted_coat_index(module, *v.material))
      diagnostics_.add(Diag::CoatIndex, a->name.span, *index);
  }
  const std::size_t height = static_cast<std::size_t>(Output::Height),
                    gradient = static_cast<std::size_t>(Output::Gradient);
  if (e.stated[height] && !e.stated[gradient] && !diagnostics_.has_errors()) {
    e.outputs[gradient] = derive_gradient(
        e.outputs[height],
        {assignment("height")->name.span, "state the `gradient` output beside `height`"});
    e.stated[gradient] = true;
  }
}

void Elaborator::run(std::span<const Graph> graphs) {
  load_library();
  if (options_.stage_done) options_.stage_done("library");
  program_scope_ = new_scope(library_scope_);
  function_ = new_function("params");
  for (const Graph& g : graphs)  // an import of one of these is no other file
    imported_[import_key(g.source->name)] = program_scope_;
  for (const Graph& g : graphs) add_graph(g, program_scope_);
  for (const DeclaredParam& p : declared_params_) describe_param(*p.graph, *p.param, p.scope);
  for (const auto& setting : options_.params) {
    const std::string& name = setting.first;
    const bool there = std::any_of(params.begin(), params.end(),
                                   [&](const ParamInfo& p) { return p.name == name; });
    if (there) continue;
    if (options_.unknown_params == UnknownParams::Report) {
      unknown_params.push_back(name);
      continue;
    }
    std::vector<std::string> names;
    for (const ParamInfo& p : params) names.push_back(p.name);
    Diagnostic& d = diagnostics_.add(Diag::UnknownParam, Span{}, name);
    const std::string near = nearest(name, names);
    if (!near.empty()) d.help(fmt::format("did you mean `{}`?", near));
  }
  for (const Graph& g : graphs) {
    for (const Constant& k : g.constants) check_constant(g, k, program_scope_);
    for (const Alias& a : g.aliases) export_alias(a);
  }
  for (const NamedDescriptor& d : program_scope_->descriptors) descriptor(d);
  check_definitions();
  // Functions without formals are exported, in order. Of the others the last are checked first: a
  // check inlines what it calls, and that needs no check of its own then.
  const std::size_t count = decls_.size();  // checking may add nested ones
  auto check = [&](FunctionDecl& d, bool formals) {
    if (!d.scope->file || d.function().formals.empty() == formals) return;
    if (!formals || !d.checked) check_function(&d);
  };
  for (std::size_t i = 0; i < count; ++i) check(decls_[i], false);
  for (std::size_t i = count; i-- > 0;) check(decls_[i], true);
  report_images();
}

}  // namespace mms::lang
