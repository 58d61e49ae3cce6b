// SPDX-License-Identifier: Apache-2.0
/// \file
/// Inlining, and the recursion that is left for the machine.
///
/// A call of a script's function is inlined. When, inside, the same function is called again, the
/// conditions passed on the way decide: if all were known at link time the recursion is unrolled;
/// if one is known only at run time (or the unrolling grows past a limit), everything back to the
/// outermost of these calls is dropped and that call becomes a call of a machine function.

#include <algorithm>

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

/// Calls that one unrolled recursion may inline before it is left for the machine.
constexpr std::size_t kUnrolledCalls = 2048;

/// Open calls of a function that tell its recursion from an argument that calls the function too,
/// as in array(4, function(i) -> array(4, f)).
constexpr std::size_t kOpenCalls = 4;

}  // namespace

bool Elaborator::any_known(const std::vector<Value>& values) const {
  std::vector<Ref> refs;
  for (const Value& v : values) flatten(v, refs);
  return std::any_of(refs.begin(), refs.end(), [&](Ref r) { return known(r) != nullptr; });
}

/// The outermost open call, since the last machine function was begun, of a function that has
/// called itself.
std::optional<std::size_t> Elaborator::repeated_call() const {
  std::size_t begin = frames_.size();
  while (begin > 0 && !frames_[begin - 1].instance) --begin;
  std::map<const FunctionDecl*, std::size_t> seen;
  std::size_t outermost = frames_.size();
  for (std::size_t i = begin; i < frames_.size(); ++i) {
    const auto [it, is_new] = seen.try_emplace(frames_[i].decl, i);
    if (!is_new && frames_[i].decl) outermost = std::min(outermost, it->second);
  }
  return outermost < frames_.size() ? std::optional(outermost) : std::nullopt;
}

Value Elaborator::invoke(FunctionDecl* d, const std::vector<Value>& formals, const Generics& g,
                         TypeId result, Span span) {
  // The outermost open call of this function since the last machine function was begun.
  std::size_t first = frames_.size(), open = 0;
  bool compiling = false;
  for (std::size_t i = frames_.size(); i-- > 0;) {
    const Frame& frame = frames_[i];
    if (frame.decl == d && frame.instance) compiling = true;
    if (frame.decl == d && !frame.instance) first = i, ++open;
    if (frame.instance) break;
  }
  const bool again = first < frames_.size();
  if (compiling || (d->recursive && !again && !any_known(formals)))
    return call_instance(d, formals, g, result, span);
  const bool too_much = frames_.size() >= static_cast<std::size_t>(vm::limits::kInlineDepth) ||
                        (open >= kOpenCalls && inlined_ - frames_[first].inlined > kUnrolledCalls);
  // What the machine cannot compute is unrolled as long as it may end.
  const bool dynamic_choice =
      again && dynamic_ > frames_[first].dynamic && types_.is_numeric(result);
  if (dynamic_choice || (again && too_much)) throw Recursion{first};
  if (too_much) {
    if (const auto outermost = repeated_call()) throw Recursion{*outermost};
    diagnostics_.add(Diag::TooDeep, span, vm::limits::kInlineDepth);
    return {};
  }
  const std::size_t depth = frames_.size();
  const int dynamic = dynamic_;
  const vm::SourceLine line = line_;
  frames_.push_back({d, dynamic_, false, inlined_++});
  const std::size_t open_calls = diagnostics_.open_calls();
  if (span != d->function().header)  // else it is checked without a call
    diagnostics_.enter_call(span, d->function().name.text);
  Value v;
  try {
    v = inline_body(d, formals, g, result);
    diagnostics_.leave_calls(open_calls);
  } catch (const Recursion& r) {
    if (r.depth != depth) throw;
    frames_.resize(depth);
    diagnostics_.leave_calls(open_calls);
    dynamic_ = dynamic;
    line_ = line;
    d->recursive = true;
    return call_instance(d, formals, g, result, span);
  }
  frames_.resize(depth);
  if (!v.poison() && !any_known(formals)) d->checked = true;
  return v;
}

/// What the formals of `f` bring besides themselves: types, and sizes of arrays.
void Elaborator::declare_generics(Scope* scope, const Function& f, const Generics& g) {
  for (const auto& [name, type] : g.types) {
    Binding b;
    b.form = Binding::Form::Type;
    b.type = type;
    declare(scope, {name, f.name.span}, std::move(b));
  }
  for (const auto& [name, size] : g.dims) {
    Binding b;
    b.value = scalar(kInteger, integer(size));
    declare(scope, {name, f.name.span}, std::move(b));
  }
}

Value Elaborator::inline_body(FunctionDecl* d, const std::vector<Value>& formals, const Generics& g,
                              TypeId result) {
  const Function& f = d->function();
  Scope* scope = new_scope(d->scope, d->library);
  const Context c{d->graph, scope};
  declare_generics(scope, f, g);
  for (std::size_t i = 0; i < formals.size(); ++i) {
    Binding b;
    b.value = formals[i];
    declare(scope, f.formals[i].name, std::move(b));
  }
  body(c, f.body);
  const Value v = expr(c, f.value);
  return convert(v, result, (*d->graph)[f.value].span, (*d->graph)[f.result].span);
}

void Elaborator::body(Context c, const Body& b) {
  for (std::size_t i = 0; i < b.items.size(); ++i) {
    const Item item = b.items[i];
    switch (item.form) {
      case Item::Form::Assignment: {
        const Assignment& a = b.assignments[item.index];
        Binding binding;
        binding.value = expr(c, a.value);
        if (a.type)
          binding.value = convert(binding.value, resolve_type(c, a.type, nullptr),
                                  (*c.graph)[a.value].span, (*c.graph)[a.type].span);
        declare(c.scope, a.name, std::move(binding));
        break;
      }
      case Item::Form::Constant:
        declare_constant(c, b.constants[item.index]);
        break;
      case Item::Form::Type:
        declare_type(c, b.types[item.index]);
        if (Binding* t = find(c.scope, b.types[item.index].name.text)) type_of(*t);
        break;
      case Item::Form::Function:
        declare_function(c, b.functions[item.index]);
        break;
    }
  }
}

std::string Elaborator::instance_key(const FunctionDecl* d,
                                     const std::vector<Value>& formals) const {
  std::string key = fmt::format("{}", static_cast<const void*>(d));
  for (const Value& v : formals) {
    key += fmt::format("|{}", v.type);
    if (v.function) key += fmt::format("@{}", static_cast<const void*>(v.function.get()));
    key += v.text;
  }
  return key;
}

/// A node that calls `instance` with `args` and, now or later, its captures.
Ref Elaborator::call_site(Instance& instance, const std::vector<Ref>& args) {
  std::vector<SlotType> results;
  slot_types(instance.result, results);
  const Ref r = node(Op::Call, args, instance.function, 0, std::move(results));
  for (std::size_t k = 0; k < instance.captures.size(); ++k) {
    const Ref arg = localise(instance.captures[k]);
    module.functions[function_].nodes[r.node].args.push_back(arg);
  }
  ++kept_;
  instance.sites.push_back({function_, r.node});
  return r;
}

Value Elaborator::call_instance(FunctionDecl* d, const std::vector<Value>& formals,
                                const Generics& g, TypeId result, Span span) {
  const std::string& name = d->function().name.text;
  if (!types_.is_numeric(result)) {
    if (unknown_arguments_) return {};
    diagnostics_.add(Diag::UnboundedRecursion, span, name, types_.spell(result))
        .note(d->function().header, "it calls itself under a condition known only at run time")
        .help(
            "let the recursion end by numbers that are known at link time (constants and params)");
    return {};
  }
  auto [it, is_new] = instances_.try_emplace(instance_key(d, formals));
  Instance& instance = it->second;
  if (is_new) {
    if (instances_.size() > static_cast<std::size_t>(vm::limits::kInstances)) {
      diagnostics_.add(Diag::TooManyInstances, span, name, vm::limits::kInstances);
      return {};
    }
    std::size_t nested = 0;
    for (const Frame& f : frames_) nested += f.instance && f.decl == d;
    constexpr std::size_t kNestedInstances = 16;
    if (nested >= kNestedInstances) {
      diagnostics_.add(Diag::PolymorphicRecursion, span, name)
          .note(d->function().header, "every call asks for another instance of it")
          .help("let it call itself with arguments of the types (and functions) it was given");
      return {};
    }
    const FunctionId caller = function_;
    const int dynamic = dynamic_;
    const std::size_t depth = frames_.size();
    const vm::SourceLine line = line_;
    instance.result = result;
    instance.function = new_function(name);
    function_ = instance.function;
    module.functions[function_].recursive = true;
    instance_of_[function_] = &instance;
    dynamic_ = 0;
    frames_.push_back({d, 0, true, inlined_});
    std::vector<Value> inside;
    for (const Value& v : formals) {
      if (!types_.is_numeric(v.type)) {
        if (v.material && !unknown_arguments_)
          diagnostics_.add(Diag::UnboundedRecursion, span, name, "material");
        inside.push_back(v);
        continue;
      }
      std::vector<SlotType> slots;
      slot_types(v.type, slots);
      std::vector<Ref> refs;
      for (SlotType s : slots) {
        std::vector<SlotType>& locals = module.functions[function_].params;
        locals.push_back(s);
        refs.push_back(
            node(Op::LoadLocal, {}, static_cast<std::uint32_t>(locals.size() - 1), 0, {s}));
      }
      std::size_t next = 0;
      inside.push_back(unflatten(v.type, refs, next));
    }
    instance.own_params = module.functions[function_].params.size();
    diagnostics_.enter_call(span, name);
    const Value v = inline_body(d, inside, g, result);
    diagnostics_.leave_call();
    if (!v.poison()) {
      std::vector<Ref> refs;
      flatten(v, refs);
      for (Ref& r : refs) r = localise(r);
      module.functions[function_].results = std::move(refs);
    }
    instance.complete = true;
    frames_.resize(depth);
    function_ = caller;
    dynamic_ = dynamic;
    line_ = line;
  }
  std::vector<Ref> args;
  for (const Value& v : formals)
    if (types_.is_numeric(v.type)) flatten(v, args);
  const Ref r = call_site(instance, args);
  std::vector<Ref> results;
  for (std::size_t k = 0; k < module.functions[function_].nodes[r.node].results.size(); ++k)
    results.push_back({r.node, static_cast<std::uint16_t>(k), r.function});
  std::size_t next = 0;
  return unflatten(result, results, next);
}

}  // namespace mms::lang
