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

/// Where each name is read, in order.
using Reads = std::map<std::string_view, std::vector<std::uint32_t>>;

Reads reads_of(const Graph& g) {
  Reads reads;
  for (const Expr& e : g.exprs)
    if (e.form == Expr::Form::Name || e.form == Expr::Form::FunctionValue)
      if (!e.path.empty()) reads[e.path[0].text].push_back(e.span.begin);
  for (const TypeExpr& t : g.types) {
    if (t.form == TypeExpr::Form::Named) reads[t.path[0].text].push_back(t.span.begin);
    for (const TypeExpr::Dim& d : t.dims)
      if (!d.path.empty()) reads[d.path[0].text].push_back(d.span.begin);
  }
  for (auto& [name, places] : reads) std::sort(places.begin(), places.end());
  return reads;
}

bool read_in(const Reads& reads, std::string_view name, Span where) {
  const auto places = reads.find(name);
  if (places == reads.end()) return false;
  const auto next = std::lower_bound(places->second.begin(), places->second.end(), where.begin);
  return next != places->second.end() && *next < where.end;
}

}  // namespace

void lint(const Graph& g, Diagnostics& diagnostics) {
  const Reads reads = reads_of(g);
  for (const Function& f : g.functions)
    for (const Assignment& a : f.body.assignments)
      if (!read_in(reads, a.name.text, f.span))
        diagnostics.add(Diag::Unused, a.name.span, a.name.text);
  for (const Descriptor& d : g.descriptors) {
    const bool surface = d.form == Descriptor::Form::Surface;
    const std::vector<std::string> outputs =
        output_names(surface ? vm::DescriptorForm::Surface : vm::DescriptorForm::Volume);
    for (const Assignment& a : d.body.assignments) {
      const bool output = std::find(outputs.begin(), outputs.end(), a.name.text) != outputs.end();
      if (output || read_in(reads, a.name.text, d.span)) continue;
      const std::string near = nearest(a.name.text, outputs);
      if (near.empty()) {
        diagnostics.add(Diag::Unused, a.name.span, a.name.text);
      } else {
        diagnostics
            .add(Diag::SuspiciousOutput, a.name.span, a.name.text, surface ? "surface" : "volume")
            .help("did you mean `" + near + "`?");
      }
    }
  }
}

}  // namespace mms::lang
