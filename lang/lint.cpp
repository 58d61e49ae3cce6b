// SPDX-License-Identifier: Apache-2.0
#include "lang/lint.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "vm/outputs.h"

namespace mms::lang {
namespace {

std::vector<std::string> output_names(vm::DescriptorForm form) {
  std::vector<std::string> names;
  for (std::size_t o = 0; o < vm::kOutputCount; ++o)
    if (const auto name = vm::output_name(form, vm::Output(o)); !name.empty())
      names.emplace_back(name);
  return names;
}

/// Where each name is read.
class Reads {
 public:
  explicit Reads(const Graph& g) {
    for (const Expr& e : g.exprs)
      if (e.form == Expr::Form::Name || e.form == Expr::Form::FunctionValue) add(e.path);
    for (const TypeExpr& t : g.types) {
      if (t.form == TypeExpr::Form::Named) add(t.path);
      for (const TypeExpr::Dim& d : t.dims) add(d.path);
    }
    for (const Alias& a : g.aliases) add(a.inside);
    for (auto& [name, places] : places_) std::sort(places.begin(), places.end());
  }

  bool anywhere(std::string_view name) const { return places_.contains(name); }
  bool in(std::string_view name, Span where) const {
    const auto it = places_.find(name);
    if (it == places_.end()) return false;
    const auto first = std::lower_bound(it->second.begin(), it->second.end(), where.begin);
    return first != it->second.end() && *first < where.end;
  }

 private:
  void add(const Path& path) {
    if (!path.empty()) places_[path[0].text].push_back(path[0].span.begin);
  }
  std::map<std::string, std::vector<std::uint32_t>, std::less<>> places_;
};

class Lint {
 public:
  Lint(const Graph& g, Diagnostics& d) : g_(g), diagnostics_(d), reads_(g) {}

  void run() {
    for (const Function& f : g_.functions) {
      for (const Assignment& a : f.body.assignments) local(a.name, f.span);
      definitions(f.body, f.span);
    }
    for (const Descriptor& d : g_.descriptors) descriptor(d);
    if (g_.descriptors.empty()) return;  // a part of other scripts
    for (const Param& p : g_.params)
      if (!reads_.anywhere(p.name.text))
        diagnostics_.add(Diag::UnusedParam, p.name.span, p.name.text);
    for (const Import& i : g_.imports)
      if (i.as && !reads_.anywhere(i.as->text))
        diagnostics_.add(Diag::UnusedImport, i.as->span, i.as->text);
  }

 private:
  void local(const Name& name, Span where) {
    if (!reads_.in(name.text, where)) diagnostics_.add(Diag::Unused, name.span, name.text);
  }

  void definitions(const Body& b, Span where) {
    for (const Constant& k : b.constants) local(k.name, where);
    for (const TypeDefinition& t : b.types) local(t.name, where);
    for (const FunctionHandle f : b.functions) local(g_[f].name, where);
  }

  void descriptor(const Descriptor& d) {
    const bool surface = d.form == Descriptor::Form::Surface;
    const std::vector<std::string> outputs =
        output_names(surface ? vm::DescriptorForm::Surface : vm::DescriptorForm::Volume);
    definitions(d.body, d.span);
    for (const Assignment& a : d.body.assignments) {
      if (std::find(outputs.begin(), outputs.end(), a.name.text) != outputs.end()) continue;
      const std::string near = nearest(a.name.text, outputs);
      if (near.empty() || reads_.in(a.name.text, d.span)) {
        local(a.name, d.span);
      } else {
        diagnostics_
            .add(Diag::SuspiciousOutput, a.name.span, a.name.text, surface ? "surface" : "volume")
            .help("did you mean `" + near + "`?");
      }
    }
  }

  const Graph& g_;
  Diagnostics& diagnostics_;
  const Reads reads_;
};

}  // namespace

void lint(const Graph& g, Diagnostics& diagnostics) { Lint(g, diagnostics).run(); }

bool uses(const Graph& g, const Graph& part) {
  const Reads reads(g);
  const auto read = [&](const Name& n) { return reads.anywhere(n.text); };
  for (const Param& p : part.params)
    if (read(p.name)) return true;
  for (const Constant& k : part.constants)
    if (read(k.name)) return true;
  for (const TypeDefinition& t : part.type_definitions)
    if (read(t.name)) return true;
  for (const FunctionHandle f : part.top_functions)
    if (read(part[f].name)) return true;
  // What it imports and renames may be what is meant.
  return !part.imports.empty() || !part.aliases.empty();
}

}  // namespace mms::lang
