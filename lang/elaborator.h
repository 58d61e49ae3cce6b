// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Graphs to IR by partial evaluation: one walk over the syntax resolves names, checks types,
/// chooses overloads, instantiates generics, and runs whatever is known at link time. Functions
/// are inlined; only those that call themselves under a condition known at run time become
/// functions of the machine. Closures, aggregates, strings and materials do not survive it.
///
/// The class is one; its members are implemented by theme: elaborate_names.cpp (scopes, types),
/// elaborate_values.cpp (nodes, conversions, operators), elaborate_expr.cpp (expressions),
/// elaborate_call.cpp (overloads), elaborate_recursion.cpp (inlining), elaborate_top.cpp (items,
/// descriptors), library.cpp (names of the library), derive.cpp and derive_rules.cpp (derivatives),
/// elaborate_images.cpp (images).

#include <climits>
#include <deque>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lang/link.h"
#include "lang/value.h"

namespace mms::lang {

/// Where an expression is read: its source and the names it sees.
struct Context {
  const Graph* graph = nullptr;
  Scope* scope = nullptr;
};

/// An evaluated argument of a call.
struct BoundArgument {
  std::optional<Name> name;
  Value value;
  Span span;
};

/// A descriptor with its outputs as values of one IR function.
struct ElaboratedDescriptor {
  const Descriptor* syntax = nullptr;
  const Graph* graph = nullptr;
  std::string name;  ///< its own or an alias
  FunctionId function = 0;
  Value outputs[static_cast<std::size_t>(vm::Output::Count)];
  bool stated[static_cast<std::size_t>(vm::Output::Count)] = {};
};

/// A function without formals, or a constant, seen from outside.
struct ElaboratedExport {
  std::string name;
  std::string type;
  FunctionId function = 0;
};

class Elaborator {
 public:
  Elaborator(const Library& library, const LinkOptions& options, Diagnostics& diagnostics);
  ~Elaborator();

  /// Elaborates everything the graphs define. What was understood is in the members below.
  void run(std::span<const Graph> graphs);

  Module module;
  std::vector<ElaboratedDescriptor> descriptors;
  std::vector<ElaboratedExport> exports;
  std::vector<ParamInfo> params;
  std::vector<std::string> unknown_params;
  std::vector<std::string> dependencies;
  std::vector<std::string> sources;

 private:
  struct Generics {
    std::map<std::string, TypeId> types;
    std::map<std::string, int> dims;
    std::set<std::string> names;  ///< of every `generic T` in the formals, bound yet or not
  };
  struct Match {
    int cost = -1;              ///< -1: does not fit
    std::vector<int> argument;  ///< for each formal the argument's index, or -1: the default
    Generics generics;
    std::string why;  ///< where it does not fit
  };
  struct Candidate {
    FunctionDecl* decl = nullptr;
    const vm::Builtin* row = nullptr;
  };
  /// The header of a builtin row, parsed by the language's own parser.
  struct Signature {
    Graph graph;
    std::vector<vm::SlotType> params, results;
    TypeId result = kPoison;
    bool all_real = true;  ///< then a spectrum may stand for any argument
    const Function& function() const { return graph.functions[0]; }
  };
  struct CallSite {
    FunctionId function;
    std::uint32_t node;
  };
  struct Instance {
    FunctionId function = 0;
    std::vector<Ref> captures;
    std::vector<CallSite> sites;
    std::size_t own_params = 0;
    TypeId result = kPoison;
    bool complete = false;
  };
  struct Frame {
    FunctionDecl* decl;
    int dynamic;              ///< `dynamic_` when the frame was entered
    bool instance;            ///< its body is being compiled as a function of the machine
    std::size_t inlined = 0;  ///< `inlined_` when the frame was entered
  };
  struct Deeper {  ///< counts `depth_` while it lives
    explicit Deeper(int& d) : depth(d) { ++depth; }
    ~Deeper() { --depth; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    int& depth;
  };
  struct Recursion {  ///< thrown to turn the frame at `depth` into a function of the machine
    std::size_t depth;
  };

  /// How far the lists that only grow had come. What was made since may be forgotten where nothing
  /// that lasts refers to it: where `kept_` is what it was.
  struct Mark {
    std::size_t scopes;
    std::uint64_t kept;
  };
  Mark mark();
  bool forget_scopes(Mark since);
  void forget_function(Mark since);

  // --- names and types (elaborate_names.cpp) ---
  /// Whether it is the scope of one call, one lambda or one descriptor.
  static bool passes(const Scope* scope) { return scope->parent && !scope->file; }
  Scope* new_scope(Scope* parent, bool library = false);
  Binding* declare(Scope* scope, const Name& name, Binding binding);
  void declare_function(Context c, FunctionHandle h);
  TypeId type_of(Binding& b);
  TypeId define(Context c, const TypeDefinition& t);
  void check_ambiguity(Scope* scope, const Name& name);
  void declare_type(Context c, const TypeDefinition& t);
  void declare_constant(Context c, const Constant& k);
  static constexpr int kUnknownSize = INT_MIN;  ///< of a dimension that is no number at link
  Binding* find(Scope* scope, std::string_view name);
  /// What the scope itself, and what it imports, calls by that name.
  std::vector<Binding*> bindings_in(Scope* scope, std::string_view name);
  Binding* find(Context c, const Path& path);
  std::vector<std::string> visible_names(Scope* scope);
  void unknown_name(Context c, const Path& path, Diag id,
                    const std::vector<std::string>& inside = {});
  TypeId resolve_type(Context c, TypeHandle h, const Generics* generics);
  int known_size(int size);
  int resolve_dim(Context c, const TypeExpr::Dim& d, const Generics* generics);
  bool unify(Context c, TypeHandle pattern, TypeId actual, Generics& g, int& cost);
  void collect_generics(Context c, TypeHandle h, Generics& g);
  bool unify_dim(Context c, const TypeExpr::Dim& d, int size, Generics& g);

  // --- nodes and values (elaborate_values.cpp) ---
  Ref node(vm::Op op, Refs args, std::uint32_t a = 0, std::uint32_t b = 0, SlotTypes results = {});
  Ref constant(vm::Constant c);
  Ref real(double v);
  Ref integer(std::int64_t v);
  Ref logic(bool v);
  Ref zero(vm::SlotType t);
  Ref input(int index);
  Ref localise(Ref r);
  const vm::Constant* known(Ref r) const;
  std::optional<std::int64_t> known_integer(const Value& v) const;
  std::optional<bool> known_logic(const Value& v) const;
  vm::SlotType slot_type(Ref r) const { return module.functions[r.function].type(r); }
  Value scalar(TypeId type, Ref r) const { return {type, {r}, {}, {}, {}, {}}; }
  Value unflatten(TypeId type, const std::vector<Ref>& refs, std::size_t& next);
  void flatten(const Value& v, std::vector<Ref>& refs) const;
  void slot_types(TypeId type, std::vector<vm::SlotType>& types) const;
  Value convert(const Value& v, TypeId to, Span span, Span why = {});
  Value widen(const Value& v, TypeId to);
  Value choose(Ref condition, const Value& a, const Value& b, Span span);
  Value choose_refs(Ref condition, const Value& a, const Value& b);
  MaterialPtr choose_material(Ref condition, const MaterialPtr& a, const MaterialPtr& b);
  Value binary(Operator op, const Value& a, const Value& b, Span span);
  Value arithmetic(Operator op, const Value& a, const Value& b, Span span);
  Value complex_arithmetic(Operator op, const Value& a, const Value& b, Span span);
  Value power(const Value& a, const Value& b, Span span);
  Value repeated_square(const Value& a, std::int64_t n, Span span);
  Value compare(Operator op, const Value& a, const Value& b, Span span);
  Value equal(const Value& a, const Value& b);
  Value logical(Operator op, const Value& a, const Value& b);
  Value negate(const Value& a, Span span);
  Value fused(const Value& a, const Value& b, const Value& c, Span span);
  bool can_fuse(const Value& a, const Value& b, const Value& c) const;
  Value bad_operands(Operator op, const Value& a, const Value& b, Span span);
  std::string spell(const Value& v) const { return types_.spell(v.type); }

  // --- expressions (elaborate_expr.cpp) ---
  Value expr(Context c, ExprHandle h);
  bool too_deep(Span span);
  bool too_large(TypeId type, Span span);
  Value expr_name(Context c, const Expr& e);
  Value expr_variable(Context c, const Expr& e);
  Value expr_binary(Context c, const Expr& e);
  Value expr_lazy(Context c, const Expr& e);
  Value expr_chain(Context c, const Expr& e);
  Value expr_index(Context c, const Expr& e);
  Value index(const Value& array, const Value& i, Span span);
  Value expr_field(Context c, const Expr& e);
  Value expr_select(Context c, const Expr& e, std::size_t arm);
  Value join_arms(Context c, const Expr& e, ExprHandle value, const Value& v, TypeId other);
  Value expr_array(Context c, const Expr& e);
  Value array_of(std::vector<Value> parts, const std::vector<Span>& spans);
  Value expr_convert(Context c, const Expr& e);
  Value expr_call(Context c, const Expr& e);
  Value evaluate_constant(Binding& b);
  /// `v`, of any function, in this one; nothing where a part of it is not known.
  std::optional<Value> carried(Value v);
  void report_circle(Binding& b);

  // --- calls (elaborate_call.cpp) ---
  const Signature& signature(const vm::Builtin* row);
  std::vector<BoundArgument> arguments(Context c, const Expr& e);
  Value call_named(Context c, const Path& path, std::vector<BoundArgument> args, Span span);
  bool hides_library_function(const Path& path) const;
  Value call_library(std::string_view name, std::vector<Value> args, Span span);
  Value call_candidates(const std::vector<std::vector<Candidate>>& levels, std::string_view name,
                        std::vector<BoundArgument>& args, Span span);
  std::vector<std::vector<Candidate>> candidates(Context c, const Path& path, const Binding& b);
  Match match(const Candidate& k, const std::vector<BoundArgument>& args);
  static bool bind_formals(const std::vector<Formal>& formals,
                           const std::vector<BoundArgument>& args, std::vector<int>& argument,
                           std::string& why);
  Value call_builtin(const vm::Builtin* row, const Match& m, std::vector<BoundArgument>& args,
                     Span span);
  Value call_spectral(const vm::Builtin* row, const std::vector<Value>& values, Span span);
  void check_factor(const Function& f, const std::vector<Value>& values, Span span);
  Value make_material(const vm::Builtin* row, const std::vector<Value>& values);
  Value call_script(FunctionDecl* d, const Match& m, std::vector<BoundArgument>& args, Span span);
  TypeId formal_type(Context c, TypeHandle h, TypeId actual, const Generics& g);
  bool ready(Context c, TypeHandle h, const Generics& g);
  bool mentions_generic(Context c, TypeHandle h, const Generics& g);
  TypeId result_of(const Value& f, const std::vector<TypeId>& types, Span span);
  bool infer_results(Context c, const Function& f, const std::vector<Value>& formals,
                     const std::vector<Span>& spans, Generics& g);
  std::vector<Value> with_defaults(FunctionDecl* d, const Match& m,
                                   std::vector<BoundArgument>& args);
  Value call_function_value(const Value& f, std::vector<BoundArgument> args, Span span);
  Value call_lambda(const FunctionValue& f, std::vector<BoundArgument>& args, Span span);
  Value construct(TypeId type, std::vector<BoundArgument>& args, Span span);
  Value invoke(FunctionDecl* d, const std::vector<Value>& formals, const Generics& g, TypeId result,
               Span span);
  void declare_generics(Scope* scope, const Function& f, const Generics& g);
  Value inline_body(FunctionDecl* d, const std::vector<Value>& formals, const Generics& g,
                    TypeId result);
  Value call_instance(FunctionDecl* d, const std::vector<Value>& formals, const Generics& g,
                      TypeId result, Span span);
  Ref call_site(Instance& instance, const std::vector<Ref>& args);
  std::string instance_key(const FunctionDecl* d, const std::vector<Value>& formals) const;
  std::string describe(const Candidate& k);
  bool any_known(const std::vector<Value>& values) const;
  std::optional<std::size_t> repeated_call() const;
  void body(Context c, const Body& b);

  // --- what only the library may call (elaborate_intrinsics.cpp) ---
  Value call_intrinsic(std::string_view name, const std::vector<BoundArgument>& args);
  Value tabulate(const Value& count, const Value& f);
  Value gradient_of(const Value& f, const Value& point);
  Value values_of(const Value& spectrum);
  Value at_each_wavelength(const Value& f, const Value& spectrum);
  std::optional<Ref> widened(std::uint32_t first, Ref x, Ref s, Ref root);
  Ref component(Ref spectrum, std::uint32_t k);
  Ref stand_in();
  std::optional<Ref> call_for_real(const Value& f, Value x);
  std::vector<Ref> substitute(std::uint32_t first, const std::vector<Ref>& from,
                              const std::vector<Ref>& to, std::vector<Ref> roots);

  // --- images (elaborate_images.cpp) ---
  struct MissingImage {
    std::string folder;  ///< of the script
    vm::ImageUse use;    ///< as written
    Error error;
    std::vector<Span> places;  ///< that name it
  };
  bool check_words(const vm::ImageUse& use);
  Result<std::shared_ptr<const vm::Image>> open_image(vm::ImageUse& use);
  std::optional<std::uint32_t> image_number(vm::ImageUse use);
  Value image_handle(const std::vector<BoundArgument>& args);
  Value curve_handle(const std::vector<BoundArgument>& args);
  Value handle_of(const vm::ImageUse& use);
  Value image_fact(const std::vector<BoundArgument>& args);
  void report_images();

  // --- the differentiation pass (derive.cpp) ---
  using Tangents = std::map<Ref, Ref>;  ///< derivative of a real value; not there: zero
  /// How a node that reads the hit changes: along `$tangent`, along `$bitangent`, or not at all.
  static constexpr int kAlongTangent = 0, kAlongBitangent = 1, kAlongNothing = -1;
  struct Deriving {
    Span span;         ///< what is differentiated
    std::string help;  ///< where that fails
  };
  std::optional<Ref> derive(Tangents& t, Ref root, std::uint32_t first, int direction);
  std::optional<Ref> tangent(const Tangents& t, Ref r) const;
  void derive_node(std::uint32_t index, int direction, Tangents& t);
  Ref derived_op(vm::Op op, vm::Op spectral, std::vector<Ref> args);
  int derivative_order(FunctionId function) const;
  bool can_derive(FunctionId function);
  FunctionId derive_function(FunctionId function, int direction);
  Ref sum(std::optional<Ref> a, std::optional<Ref> b);
  Value derive_gradient(const Value& height, const Deriving& what);
  Value slope_of(const Value& height);
  std::vector<Value> footprint_columns(const Value& value);
  Value across_footprint(const Value& value);
  Value along_footprint(const Value& value, const Value& column);

  // --- types without values (elaborate_peek.cpp): kPoison where the text alone does not say ---
  TypeId peek(Context c, ExprHandle h);
  TypeId peek_name(Context c, const Path& path);
  TypeId peek_call(Context c, const Expr& e);
  TypeId peek_call(Context c, const Path& path, const std::vector<BoundArgument>& args);
  TypeId peek_call(const Value& f, const std::vector<BoundArgument>& args);
  TypeId peek_candidates(const std::vector<std::vector<Candidate>>& levels,
                         const std::vector<BoundArgument>& args);
  TypeId peek_joined(Context c, const std::vector<ExprHandle>& values);
  TypeId arithmetic_type(Operator op, TypeId a, TypeId b);
  TypeId operator_type(Operator op, TypeId a, TypeId b);

  // --- checking what nobody calls (elaborate_check.cpp) ---
  Value unknown_value(TypeId type);
  Ref unknown_slot(vm::SlotType type);
  void check_function(FunctionDecl* d);
  void check_body(FunctionDecl* d);
  void check_definitions();
  bool is_generic(Context c, const Function& f);
  // --- rules of the library's rows (derive_rules.cpp) ---
  void derive_builtin(const Node& n, Ref r, int direction, Tangents& t);
  Value rule_value(const vm::Builtin& row, std::string_view rule, Scope* scope);
  std::vector<Ref> partials_of(const Value& rule, TypeId formal, TypeId result);
  void add_partial(Tangents& t, Ref r, Ref partial, Ref dx);
  void derive_twin(const Value& twin, std::uint32_t first, const std::vector<Ref>& results,
                   int direction, Tangents& t);

  // --- items and descriptors (elaborate_top.cpp) ---
  // --- the library (library.cpp) ---
  /// A definition of a module; `item` is null where nobody has listed them.
  struct Listed {
    std::string_view name;
    const Library::Module* module;
    const Library::Item* item;
  };
  /// One row, or one definition of a module.
  struct LibraryName {
    std::string_view name;
    std::string_view module;
    const vm::Builtin* row = nullptr;
    const Listed* listed = nullptr;
  };
  void load_library();
  void list_module(const Library::Module& m);
  void chain_library_names();
  std::uint32_t library_size() const;
  LibraryName library_name(std::uint32_t k) const;
  std::uint32_t& library_chain(std::string_view name);
  std::vector<LibraryName> library_names(std::string_view name);
  void make_library_name(std::string_view name);
  void make_module_name(const std::string& module, std::string_view name);
  void define(const Listed& n);

  // --- items and descriptors (elaborate_top.cpp) ---
  void add_graph(const Graph& graph, Scope* scope);
  std::string import_key(const std::string& name) const;
  void import(const Graph& from, const Import& i, Scope* scope);
  void add_params(const Graph& graph, Scope* scope);
  bool closes_circle(const std::string& key, const Import& i);
  std::vector<NamedDescriptor> find_descriptors(Context c, const Path& path);
  void export_alias(const Alias& a);
  void add_aliases(const Graph& graph, Scope* scope);
  void describe_param(const Graph& graph, const Param& p, Scope* scope);
  void check_constant(const Graph& graph, const Constant& k, Scope* scope);
  void descriptor(const NamedDescriptor& d);
  void outputs(ElaboratedDescriptor& e, Scope* scope);
  void declare_items(const Graph& graph, Scope* scope);
  void export_value(const std::string& name, const Value& v);
  FunctionId new_function(std::string name);
  std::uint32_t source_index(const Source* s);
  vm::SourceLine line_of(Span s);

  const Library& library_;
  const LinkOptions& options_;
  Diagnostics& diagnostics_;
  TypeTable types_;
  std::deque<Scope> scopes_;
  std::deque<FunctionDecl> decls_;
  std::deque<Graph> graphs_;  ///< library modules and imports
  std::map<std::string, Scope*> imported_;
  struct OpenFile {
    std::string key, name;
  };
  std::vector<OpenFile> open_files_;  ///< each imported by the one before
  struct DeclaredParam {
    const Graph* graph;
    const Param* param;
    Scope* scope;
  };
  std::vector<DeclaredParam> declared_params_;
  std::map<std::string, Scope*, std::less<>> modules_;
  std::vector<Listed> listed_;
  std::vector<std::uint32_t> library_first_, library_next_;  ///< chains of names, by their hash
  std::set<std::string_view> made_library_names_;
  std::map<const Library::Module*, SourcePtr> module_sources_;
  std::map<const vm::Builtin*, std::unique_ptr<Signature>> signatures_;
  std::map<std::string, Instance> instances_;
  std::map<FunctionId, Instance*> instance_of_;
  std::map<const Source*, std::uint32_t> source_index_;
  /// Images of the program by the folder of the script and what it writes.
  std::map<std::pair<std::string, std::string>, std::vector<std::uint32_t>> image_numbers_;
  std::vector<MissingImage> missing_images_;
  std::map<FunctionId, int> derivative_orders_;               ///< of derived functions
  std::map<std::pair<FunctionId, int>, FunctionId> derived_;  ///< by function and direction
  Deriving deriving_;
  std::uint64_t kept_ = 0;         ///< how often something was made that refers to a function or a
                                   ///< scope and may be asked for when those are done
  std::vector<Binding*> carried_;  ///< constants that this function took from another's cache
  std::map<Ref, Ref>
      stands_for_;  ///< the value whose place an argument holds that nobody knows yet
  Span user_span_;  ///< where a script called the function of the library that is being inlined
  std::map<std::pair<Descriptor::Form, std::string>, Span> descriptor_names_;
  Scope* library_scope_ = nullptr;
  Scope* program_scope_ = nullptr;

  // Where elaboration stands.
  FunctionId function_ = 0;
  int dynamic_ = 0;  ///< selects entered whose condition is known only at run time
  std::vector<Frame> frames_;
  std::size_t inlined_ = 0;
  vm::SourceLine line_;
  bool unknown_arguments_ = false;  ///< a function is checked for arguments nobody knows: what must
                                    ///< be known at link may still be so in every call of it
  std::vector<Binding*> evaluating_;  ///< constants, each asked for by the one before
  int peeking_ = 0;    ///< constants and lambdas that are being looked into for a type
  int depth_ = 0;      ///< expressions begun and not ended, through all the calls that are inlined
  bool full_ = false;  ///< a limit was hit and reported: stop making nodes
};

}  // namespace mms::lang
