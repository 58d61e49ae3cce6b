// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What an expression is while the linker works on it: machine values, and everything that is
/// gone afterwards (arrays, structures, functions, materials, strings).

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/ast.h"
#include "lang/ir.h"
#include "lang/types.h"

namespace mms::lang {

struct Scope;
struct Value;

/// A function of a script or of a module of the library, with the scope it was defined in.
struct FunctionDecl {
  const Graph* graph = nullptr;
  FunctionHandle handle;
  Scope* scope = nullptr;
  bool library = false;
  bool recursive = false;  ///< it was seen to call itself under a condition known only at run time
  bool checked = false;    ///< its body was seen whole, with arguments that nobody knew
  const Function& function() const { return (*graph)[handle]; }
};

/// A lambda, `#name`, or `#op`.
struct FunctionValue {
  const Graph* graph = nullptr;  ///< of `lambda`
  ExprHandle lambda;
  Scope* scope = nullptr;  ///< of `lambda`, or where `path` is looked up
  Path path;               ///< `#path`
  std::optional<Operator> op;
  Span span;
  bool opaque = false;  ///< stands for a function nobody knows: only its type is checked
};

/// A material expression: one scattering model or combiner, its numbers and its parts.
struct MaterialTree {
  const vm::Builtin* row = nullptr;
  std::vector<Ref> params;
  std::vector<vm::SlotType> types;  ///< of `params`
  std::vector<std::shared_ptr<const MaterialTree>> children;
  int size() const {
    int n = 1;
    for (const auto& c : children) n += c->size();
    return n;
  }
};
using MaterialPtr = std::shared_ptr<const MaterialTree>;

struct Value {
  TypeId type = kPoison;
  ShortList<Ref, 2> refs;    ///< scalars: one; complex: real part, imaginary part
  std::vector<Value> parts;  ///< arrays and structures
  MaterialPtr material;
  std::shared_ptr<const FunctionValue> function;
  std::string text;

  bool poison() const { return type == kPoison; }
};

/// What a name stands for.
struct Binding {
  enum class Form : std::uint8_t { Value, Functions, Constant, Type, Namespace };
  Form form = Form::Value;
  Span span;
  bool library = false;

  Value value;                                 // Value
  std::vector<FunctionDecl*> functions;        // Functions
  std::vector<const vm::Builtin*> rows;        // Functions of the library
  TypeId type = kPoison;                       // Type, once it is resolved
  const TypeDefinition* definition = nullptr;  // Type, until it is resolved
  Scope* scope = nullptr;                      // Namespace; Constant, Type: where it is evaluated
  const Graph* graph = nullptr;                // Constant, Type
  const Graph* stated_in = nullptr;            // Constant: the graph of `stated`
  TypeHandle stated;                           // Constant
  ExprHandle expr;                             // Constant
  bool busy = false;                           // Constant, Type: being evaluated
  bool circular = false;                       // Constant: asks for itself, which was said
  std::map<FunctionId, Value> cache;           // Constant: by function it was evaluated in
};

/// A surface or a volume and the name it goes by, its own or an alias.
struct NamedDescriptor {
  std::string name;
  const Graph* graph = nullptr;
  const Descriptor* syntax = nullptr;
  Scope* scope = nullptr;
};

/// The names of a scope. Those of the library are made when they are first looked for: a link then
/// costs what the scripts reach, not what there is.
class Names : public std::map<std::string, Binding, std::less<>> {
 public:
  /// Makes the binding of one name, if there is one; of all names where there is no argument.
  using Maker = std::function<void(std::optional<std::string_view>)>;
  void made_by(Maker maker) { maker_ = std::move(maker); }

  iterator find(std::string_view name) {
    const iterator it = map::find(name);
    if (it != end() || !maker_) return it;
    maker_(name);
    return map::find(name);
  }
  iterator begin() {
    if (const Maker all = maker_) {
      all(std::nullopt);
      maker_ = nullptr;
    }
    return map::begin();
  }

 private:
  Maker maker_;
};

struct Scope {
  Scope* parent = nullptr;
  bool library = false;
  bool file = false;            ///< the top level of a script
  bool missing = false;         ///< stands for an import that was not found
  std::vector<Scope*> imports;  ///< of files whose names are read here without a prefix
  Names names;
  std::vector<NamedDescriptor> descriptors;  ///< of a file
};

}  // namespace mms::lang
