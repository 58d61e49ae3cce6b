// SPDX-License-Identifier: Apache-2.0
#include "lang/lint.h"

#include <algorithm>
#include <compare>
#include <limits>
#include <string>
#include <vector>

#include "base/hash.h"
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
    std::ranges::sort(reads_);
  }

  bool anywhere(std::string_view name) const {
    return in(name, {nullptr, 0, std::numeric_limits<std::uint32_t>::max()});
  }
  bool in(std::string_view name, Span where) const {
    const std::uint64_t hash = hash_bytes(name);
    const auto it = std::ranges::lower_bound(reads_, Read{hash, where.begin});
    return it != reads_.end() && it->hash == hash && it->place < where.end;
  }

 private:
  void add(const Path& path) {
    if (!path.empty()) reads_.push_back({hash_bytes(path[0].text), path[0].span.begin});
  }
  /// A name stands for itself by its hash: that two are alike costs one warning, if ever.
  struct Read {
    std::uint64_t hash;
    std::uint32_t place;
    friend auto operator<=>(const Read&, const Read&) = default;
  };
  std::vector<Read> reads_;
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
      if (reads_.in(a.name.text, d.span) ||
          std::ranges::find(outputs, a.name.text) != outputs.end())
        continue;
      const std::string near = nearest(a.name.text, outputs);
      if (near.empty())
        diagnostics_.add(Diag::Unused, a.name.span, a.name.text);
      else
        diagnostics_
            .add(Diag::SuspiciousOutput, a.name.span, a.name.text, surface ? "surface" : "volume")
            .help("did you mean `" + near + "`?");
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
