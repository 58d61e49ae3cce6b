// SPDX-License-Identifier: Apache-2.0
#include "lang/types.h"

#include <algorithm>

namespace mms::lang {

TypeTable::TypeTable() {
  static constexpr const char* kNames[] = {"<error>",  "logic",    "integer", "real",    "complex",
                                           "spectrum", "material", "string",  "function"};
  for (int i = 0; i <= static_cast<int>(Type::Form::Closure); ++i)
    intern({static_cast<Type::Form>(i), 0, {}, kNames[i], {}});
}

TypeId TypeTable::intern(Type type) {
  auto [it, is_new] = ids_.try_emplace(type, static_cast<TypeId>(types_.size()));
  if (is_new) types_.push_back(std::move(type));
  return it->second;
}

TypeId TypeTable::basic(BasicType b) const {
  static constexpr TypeId kIds[] = {kLogic,    kInteger,  kReal,  kComplex,
                                    kSpectrum, kMaterial, kString};
  return kIds[static_cast<int>(b)];
}

TypeId TypeTable::function(std::vector<TypeId> formals, TypeId result) {
  formals.push_back(result);
  return intern({Type::Form::Function, 0, std::move(formals), {}, {}});
}

std::int64_t TypeTable::elements(TypeId id) const {
  const Type& t = types_[id];
  if (t.form == Type::Form::Array) return t.size * elements(t.parts[0]);
  if (t.form != Type::Form::Struct) return 1;
  std::int64_t all = 0;
  for (const TypeId part : t.parts) all += elements(part);
  return all;
}

bool TypeTable::is_numeric(TypeId id) const {
  const Type& t = types_[id];
  switch (t.form) {
    case Type::Form::Logic:
    case Type::Form::Integer:
    case Type::Form::Real:
    case Type::Form::Complex:
    case Type::Form::Spectrum:
    case Type::Form::Enum:
      return true;
    case Type::Form::Struct:
    case Type::Form::Array:
      return std::all_of(t.parts.begin(), t.parts.end(), [&](TypeId p) { return is_numeric(p); });
    default:
      return false;
  }
}

std::string TypeTable::spell(TypeId id) const {
  const Type& t = types_[id];
  if (t.form == Type::Form::Array) {
    std::string dims = std::to_string(t.size);
    TypeId element = t.parts[0];
    if (is_array(element)) {
      dims += "," + std::to_string(types_[element].size);
      element = types_[element].parts[0];
    }
    return spell(element) + "[" + dims + "]";
  }
  if (t.form == Type::Form::Function) {
    std::vector<TypeId> formals(t.parts.begin(), t.parts.end() - 1);
    return "function(" + spell(formals) + ") -> " + spell(t.parts.back());
  }
  return t.name;
}

std::string TypeTable::spell(const std::vector<TypeId>& ids) const {
  std::string s;
  for (TypeId id : ids) s += (s.empty() ? "" : ", ") + spell(id);
  return s;
}

int TypeTable::widening(TypeId from, TypeId to) const {
  if (from == to || from == kPoison || to == kPoison) return 0;
  if (from == kInteger && to == kReal) return 1;
  if (from == kInteger && to == kComplex) return 2;
  if (from == kReal && to == kComplex) return 1;
  if (from == kReal && to == kSpectrum) return 2;
  if (from == kInteger && to == kSpectrum) return 3;
  const Type &f = types_[from], &t = types_[to];
  if (f.form == Type::Form::Array && t.form == Type::Form::Array && f.size == t.size)
    return widening(f.parts[0], t.parts[0]);
  if (from == kClosure && t.form == Type::Form::Function) return 1;
  if (f.form == Type::Form::Function && to == kClosure) return 1;
  return -1;
}

TypeId TypeTable::join(TypeId a, TypeId b) const {
  if (a == kPoison || b == kPoison) return kPoison;
  if (widening(a, b) >= 0) return b;
  if (widening(b, a) >= 0) return a;
  return kPoison;
}

}  // namespace mms::lang
