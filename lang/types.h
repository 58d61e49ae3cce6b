// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Types of the language, interned: equal types have equal ids.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/ast.h"

namespace mms::lang {

using TypeId = std::uint32_t;

struct Type {
  enum class Form : std::uint8_t {
    Poison,  ///< of an expression that was reported already; fits everywhere
    Logic,
    Integer,
    Real,
    Complex,
    Spectrum,
    Material,
    String,
    Closure,   ///< a lambda or `#name` whose signature is known only where it is called
    Enum,      ///< name, members
    Struct,    ///< name, members, parts
    Array,     ///< size, parts[0]; a matrix is an array of rows
    Function,  ///< parts: formals, then the result
  };
  Form form = Form::Poison;
  int size = 0;
  std::vector<TypeId> parts;
  std::string name;
  std::vector<std::string> members;
  friend auto operator<=>(const Type&, const Type&) = default;
};

/// The basic types have fixed ids, in the order of Type::Form.
inline constexpr TypeId kPoison = 0, kLogic = 1, kInteger = 2, kReal = 3, kComplex = 4,
                        kSpectrum = 5, kMaterial = 6, kString = 7, kClosure = 8;

/// Owns every type of one link.
class TypeTable {
 public:
  TypeTable();
  const Type& operator[](TypeId id) const { return types_[id]; }
  TypeId basic(BasicType b) const;
  TypeId array(TypeId element, int size) {
    return intern({Type::Form::Array, size, {element}, {}, {}});
  }
  TypeId function(std::vector<TypeId> formals, TypeId result);
  TypeId intern(Type type);

  bool is_array(TypeId id) const { return types_[id].form == Type::Form::Array; }
  bool is_struct(TypeId id) const { return types_[id].form == Type::Form::Struct; }
  bool is_function(TypeId id) const {
    return types_[id].form == Type::Form::Function || id == kClosure;
  }
  /// Depth of array nesting; 0 for what is no array.
  int rank(TypeId id) const { return is_array(id) ? 1 + rank(types_[id].parts[0]) : 0; }
  /// The innermost element of nested arrays.
  TypeId scalar(TypeId id) const { return is_array(id) ? scalar(types_[id].parts[0]) : id; }
  /// Scalars in arrays and structures, all levels counted; 1 for any other type.
  std::int64_t elements(TypeId id) const;
  /// True where a value can live in machine slots: no material, string or function inside.
  bool is_numeric(TypeId id) const;
  /// Scalars that arithmetic is defined on: integer, real, complex, spectrum.
  static bool is_number(TypeId id) { return id >= kInteger && id <= kSpectrum; }

  /// As an author writes it: `real[3]`, `function(real) -> spectrum`.
  std::string spell(TypeId id) const;
  std::string spell(const std::vector<TypeId>& ids) const;

  /// The smaller type both widen to, or kPoison if there is none. A scalar joins an array
  /// element-wise only where `broadcast`.
  TypeId join(TypeId a, TypeId b) const;
  /// Steps of widening from `from` to `to`; 0 for equal, -1 where `from` does not widen to `to`.
  int widening(TypeId from, TypeId to) const;

 private:
  std::vector<Type> types_;
  std::map<Type, TypeId> ids_;
};

}  // namespace mms::lang
