// SPDX-License-Identifier: Apache-2.0
/// \file
/// The library's names in the elaborator: which there are is known at once, what they stand for is
/// made when a script first names them.

#include <bit>
#include <utility>

#include "lang/elaborator.h"
#include "lang/parser.h"

namespace mms::lang {
namespace {

std::string_view row_name(std::string_view signature) {
  const std::size_t end = signature.find('(');
  const std::size_t space = signature.rfind(' ', end);
  return signature.substr(space + 1, end - space - 1);
}

Binding functions() {
  Binding b;
  b.form = Binding::Form::Functions;
  b.library = true;
  return b;
}

}  // namespace

void Elaborator::load_library() {
  library_scope_ = new_scope(nullptr, true);
  std::string_view last;
  for (const vm::Builtin& row : library_.builtins)
    if (row.module != std::exchange(last, row.module)) modules_.try_emplace(std::string(last));
  std::size_t listed = 0;
  for (const Library::Module& m : library_.modules) listed += m.items.size();
  listed_.reserve(listed);
  for (const Library::Module& m : library_.modules) list_module(m);
  chain_library_names();
  library_scope_->names.made_by([this](std::optional<std::string_view> name) {
    if (name) return make_library_name(*name);
    for (std::uint32_t k = 0; k < library_size(); ++k) make_library_name(library_name(k).name);
  });
  for (const Listed& n : listed_)  // defined already: overloads of rows, perhaps
    if (!n.item) make_library_name(n.name);
  for (auto& [module_name, scope] : modules_) {
    scope = new_scope(nullptr, true);
    scope->names.made_by([this, &key = module_name](std::optional<std::string_view> name) {
      if (name) return make_module_name(key, *name);
      for (std::uint32_t k = 0; k < library_size(); ++k)
        make_module_name(key, library_name(k).name);
    });
  }
}

/// Lists the definitions of `m`, which are found by parsing it where nobody has listed them.
void Elaborator::list_module(const Library::Module& m) {
  modules_.try_emplace(std::string(m.name));
  SourcePtr& source = module_sources_[&m];
  for (const Library::Item& i : m.items) listed_.push_back({i.name, &m, &i});
  if (!m.items.empty()) return;
  source = borrow_source(fmt::format("<{}>", m.name), m.text);
  graphs_.push_back(parse(source, diagnostics_));
  const Graph& graph = graphs_.back();
  declare_items(graph, library_scope_);
  auto enter = [&](const Name& n) { listed_.push_back({n.text, &m, nullptr}); };
  for (FunctionHandle h : graph.top_functions) enter(graph[h].name);
  for (const Constant& k : graph.constants) enter(k.name);
  for (const TypeDefinition& t : graph.type_definitions) enter(t.name);
}

std::uint32_t Elaborator::library_size() const {
  return std::uint32_t(library_.builtins.size() + listed_.size());
}

/// Rows first, then definitions.
Elaborator::LibraryName Elaborator::library_name(std::uint32_t k) const {
  if (k < library_.builtins.size()) {
    const vm::Builtin& row = library_.builtins[k];
    return {row_name(row.signature), row.module, &row};
  }
  const Listed& n = listed_[k - library_.builtins.size()];
  return {n.name, n.module->name, nullptr, &n};
}

/// Names of one chain keep their order, so the last one is entered first.
void Elaborator::chain_library_names() {
  library_first_.assign(std::bit_ceil(2 * library_size()), UINT32_MAX);
  library_next_.resize(library_size());
  for (std::uint32_t k = library_size(); k-- > 0;)
    library_next_[k] = std::exchange(library_chain(library_name(k).name), k);
}

/// The head of the chain that `name` is in; others may be in it too.
std::uint32_t& Elaborator::library_chain(std::string_view name) {
  return library_first_[std::hash<std::string_view>()(name) & (library_first_.size() - 1)];
}

std::vector<Elaborator::LibraryName> Elaborator::library_names(std::string_view name) {
  std::vector<LibraryName> found;
  for (std::uint32_t k = library_chain(name); k != UINT32_MAX; k = library_next_[k])
    if (const LibraryName n = library_name(k); n.name == name) found.push_back(n);
  return found;
}

/// Overloads keep the order in which the library states them.
void Elaborator::make_library_name(std::string_view name) {
  const std::vector<LibraryName> all = library_names(name);
  // Entered first: `define` looks the name up.
  if (all.empty() || !made_library_names_.insert(all[0].name).second) return;
  for (const LibraryName& n : all)
    if (n.row)
      library_scope_->names.try_emplace(std::string(name), functions())
          .first->second.rows.push_back(n.row);
  for (const LibraryName& n : all)
    if (n.listed && n.listed->item) define(*n.listed);
}

void Elaborator::define(const Listed& n) {
  SourcePtr& source = module_sources_[n.module];
  if (!source) source = borrow_source(fmt::format("<{}>", n.module->name), n.module->text);
  graphs_.push_back(parse(source, diagnostics_, n.item->begin, n.item->end));
  declare_items(graphs_.back(), library_scope_);
}

/// A module's scope has its own rows; of what it defines itself, all that the library has.
void Elaborator::make_module_name(const std::string& key, std::string_view name) {
  Names& names = modules_.find(key)->second->names;
  for (const LibraryName& n : library_names(name)) {
    if (n.module != key || (n.listed && names.contains(name))) continue;
    if (n.listed)
      names[std::string(name)] = library_scope_->names.find(name)->second;
    else
      names.try_emplace(std::string(name), functions()).first->second.rows.push_back(n.row);
  }
}

}  // namespace mms::lang
