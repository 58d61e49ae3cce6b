// SPDX-License-Identifier: Apache-2.0
/// \file
/// Checking what nobody calls: a function is elaborated for arguments that nobody knows; of one
/// whose types only a call brings, every name is looked up.

#include <algorithm>

#include "lang/elaborator.h"
#include "lang/resolve.h"

namespace mms::lang {

using vm::SlotType;

/// One slot of which nothing is known at link; right in any function, for a recursion that is
/// checked is one of its own.
Ref Elaborator::unknown_slot(SlotType type) {
  const Ref x = node(vm::Op::PushInput, {}, 0, 0, {SlotType::Real});
  switch (type) {
    case SlotType::Integer:
      return node(vm::Op::IntOfReal, {x}, 0, 0, {type});
    case SlotType::Logic:
      return node(vm::Op::EqR, {x, x}, 0, 0, {type});
    case SlotType::Spectrum:
      return node(vm::Op::Splat, {x}, 0, 0, {type});
    case SlotType::Real:
      break;
  }
  return x;
}

/// Some value of the type, of which nothing is known at link.
Value Elaborator::unknown_value(TypeId type) {
  const Type t = types_[type];
  if (types_.is_numeric(type)) {
    std::vector<SlotType> slots;
    slot_types(type, slots);
    std::vector<Ref> refs;
    for (SlotType s : slots) refs.push_back(unknown_slot(s));
    std::size_t next = 0;
    return unflatten(type, refs, next);
  }
  if (type == kMaterial) return call_library("matte", {}, {});
  Value v;
  v.type = type;
  if (t.form == Type::Form::Array)
    for (int k = 0; k < t.size; ++k) v.parts.push_back(unknown_value(t.parts[0]));
  if (t.form == Type::Form::Struct)
    for (TypeId p : t.parts) v.parts.push_back(unknown_value(p));
  if (types_.is_function(type)) {
    auto f = std::make_shared<FunctionValue>();
    f->opaque = true;
    v.function = std::move(f);
  }
  return v;
}

/// Types of all files and constants of those imported, used or not.
void Elaborator::check_definitions() {
  function_ = new_function("definitions");
  for (std::size_t i = 0; i < scopes_.size(); ++i) {  // evaluation makes more
    if (!scopes_[i].file) continue;
    std::vector<Binding*> all;  // as they are written: each then finds the ones before it made
    for (auto& [name, b] : scopes_[i].names) all.push_back(&b);
    std::sort(all.begin(), all.end(),
              [](const Binding* a, const Binding* b) { return a->span.begin < b->span.begin; });
    for (Binding* b : all) {
      if (b->form == Binding::Form::Type) type_of(*b);
      if (b->form == Binding::Form::Constant && &scopes_[i] != program_scope_)
        evaluate_constant(*b);
    }
  }
}

/// Whether only a call brings the types of the formals, or the size of the result.
bool Elaborator::is_generic(Context c, const Function& f) {
  Generics g;
  for (const Formal& formal : f.formals) collect_generics(c, formal.type, g);
  return std::any_of(f.formals.begin(), f.formals.end(),
                     [&](const Formal& formal) { return !ready(c, formal.type, g); }) ||
         std::any_of(f.formals.begin(), f.formals.end(), [&](const Formal& formal) {
           const auto& dims = (*c.graph)[f.result].dims;
           return std::any_of(dims.begin(), dims.end(), [&](const TypeExpr::Dim& d) {
             return !d.path.empty() && d.path[0].text == formal.name.text;
           });
         });
}

/// What the check made is forgotten, for the next one to be made in the same memory.
void Elaborator::check_function(FunctionDecl* d) {
  function_ = new_function("check " + d->function().name.text);
  const Mark before = mark();
  check_body(d);
  forget_function(before);
}

void Elaborator::check_body(FunctionDecl* d) {
  const Function& f = d->function();
  const Context c{d->graph, d->scope};
  NameCheck(
      *d->graph, [&](const Path& path) { return find(c, path) != nullptr; },
      [&](const Path& path, Diag id, const auto& inside) { unknown_name(c, path, id, inside); })
      .function(f);
  if (is_generic(c, f)) return;
  std::vector<Value> formals;
  for (const Formal& formal : f.formals) {
    const TypeId type = resolve_type(c, formal.type, nullptr);
    if (type == kPoison) return;
    formals.push_back(unknown_value(type));
  }
  const TypeId result = resolve_type(c, f.result, nullptr);
  if (result == kPoison) return;
  unknown_arguments_ = !formals.empty();
  const Value v = invoke(d, formals, {}, result, f.header);
  unknown_arguments_ = false;
  if (f.formals.empty() && !d->library && d->scope == program_scope_) export_value(f.name.text, v);
}

}  // namespace mms::lang
