// SPDX-License-Identifier: Apache-2.0
/// \file
/// The library's names in the elaborator: which there are is known at once, what they stand for is
/// made when a script first names them.

#include <algorithm>

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

const Library::Script* Library::script(std::string_view written) const {
  if (written.ends_with(".mms")) written.remove_suffix(4);
  const auto found = std::find_if(scripts.begin(), scripts.end(),
                                  [&](const Script& s) { return s.name == written; });
  return found == scripts.end() ? nullptr : &*found;
}

void Elaborator::load_library() {
  library_scope_ = new_scope(nullptr, true);
  library_names_.reserve(library_.builtins.size() + 64);
  for (const vm::Builtin& row : library_.builtins) {
    library_names_.push_back({row_name(row.signature), row.module, &row});
    modules_.try_emplace(std::string(row.module));
  }
  for (const Library::Module& m : library_.modules) load_module(m);
  std::stable_sort(library_names_.begin(), library_names_.end(),
                   [](const LibraryName& a, const LibraryName& b) { return a.name < b.name; });
  library_scope_->names.made_by([this](std::optional<std::string_view> name) {
    if (name) return make_library_name(*name);
    for (const LibraryName& n : library_names_) make_library_name(n.name);
  });
  for (const LibraryName& n : library_names_)  // defined already: overloads of rows, perhaps
    if (n.text && !n.item) make_library_name(n.name);
  for (auto& [module_name, scope] : modules_) {
    scope = new_scope(nullptr, true);
    scope->names.made_by([this, &key = module_name](std::optional<std::string_view> name) {
      if (name) return make_module_name(key, *name);
      for (const LibraryName& n : library_names_) make_module_name(key, n.name);
    });
  }
}

/// Enters the definitions of `m`, which are found by parsing it where nobody has listed them.
void Elaborator::load_module(const Library::Module& m) {
  modules_.try_emplace(std::string(m.name));
  SourcePtr& source = module_sources_[&m];
  for (const Library::Item& i : m.items)
    library_names_.push_back({i.name, m.name, nullptr, &m, &i});
  if (!m.items.empty()) return;
  source = make_source(fmt::format("<{}>", m.name), std::string(m.text));
  graphs_.push_back(parse(source, diagnostics_));
  const Graph& graph = graphs_.back();
  declare_items(graph, library_scope_);
  auto enter = [&](const Name& n) { library_names_.push_back({n.text, m.name, nullptr, &m}); };
  for (FunctionHandle h : graph.top_functions) enter(graph[h].name);
  for (const Constant& k : graph.constants) enter(k.name);
  for (const TypeDefinition& t : graph.type_definitions) enter(t.name);
}

std::span<Elaborator::LibraryName> Elaborator::library_names(std::string_view name) {
  const auto less = [](const auto& a, const auto& b) {
    constexpr auto key = []<class T>(const T& x) -> std::string_view {
      if constexpr (std::is_same_v<T, LibraryName>)
        return x.name;
      else
        return x;
    };
    return key(a) < key(b);
  };
  const auto [from, to] =
      std::equal_range(library_names_.begin(), library_names_.end(), name, less);
  return {from, to};
}

/// Rows first, then definitions: overloads keep the order in which the library states them.
void Elaborator::make_library_name(std::string_view name) {
  const std::span<LibraryName> all = library_names(name);
  if (all.empty() || all[0].made) return;
  all[0].made = true;  // first: `define` looks the name up
  for (const LibraryName& n : all)
    if (n.row)
      library_scope_->names.try_emplace(std::string(name), functions())
          .first->second.rows.push_back(n.row);
  for (const LibraryName& n : all)
    if (n.item) define(n);
}

void Elaborator::define(const LibraryName& n) {
  SourcePtr& source = module_sources_[n.text];
  if (!source) source = make_source(fmt::format("<{}>", n.module), std::string(n.text->text));
  graphs_.push_back(parse(source, diagnostics_, n.item->begin, n.item->end));
  declare_items(graphs_.back(), library_scope_);
}

/// A module's scope has its own rows; of what it defines itself, all that the library has.
void Elaborator::make_module_name(const std::string& key, std::string_view name) {
  Names& names = modules_.find(key)->second->names;
  for (const LibraryName& n : library_names(name)) {
    if (n.module != key || (n.text && names.contains(name))) continue;
    if (n.text)
      names[std::string(name)] = library_scope_->names.find(name)->second;
    else
      names.try_emplace(std::string(name), functions()).first->second.rows.push_back(n.row);
  }
}

}  // namespace mms::lang
