// SPDX-License-Identifier: Apache-2.0
#include "vm/verify.h"

#include <algorithm>

#include "vm/call_graph.h"
#include "vm/limits.h"
#include "vm/signature.h"
#include "vm/verify_code.h"

namespace mms::vm {
namespace {

using Fault = std::optional<VerifyFault>;

Fault fault(const std::string& where, const char* what) {
  return VerifyFault{where, 0, what, false};
}
Fault too_large(const std::string& where, const char* what) {
  return VerifyFault{where, 0, what, true};
}

bool valid(const Program& program, SourceLine line) {
  return line.line == 0 || line.source < program.sources.size();
}

Fault verify_constants(const Program& program) {
  if (program.constants.size() > std::size_t(limits::kNodes))
    return fault("", "too many constants");
  for (const Constant& c : program.constants) {
    if (!valid(c.type) || c.type == SlotType::Spectrum)
      return fault("", "a constant has no constant's type");
    if (c.type == SlotType::Logic && c.integer != 0 && c.integer != 1)
      return fault("", "a logic constant is neither 0 nor 1");
  }
  for (const std::vector<SlotType>& types : program.block_types)
    if (!blocks_of(types)) return fault("", "a block type is no list of types or too long");
  return std::nullopt;
}

Fault verify_builtins(const Program& program) {
  const std::size_t n = program.builtins.size();
  if (program.builtin_params.size() != n || program.builtin_results.size() != n)
    return fault("", "not every builtin has a signature");
  for (std::size_t k = 0; k < n; ++k) {
    if (!program.builtins[k]) return fault("", "a builtin is missing");
    if (!blocks_of(program.builtin_params[k]) || !blocks_of(program.builtin_results[k]))
      return fault("", "a builtin's signature is no list of types or too long");
    const auto signature = read_signature(program.builtins[k]->signature);
    if (!signature || signature->params != program.builtin_params[k] ||
        signature->results != program.builtin_results[k])
      return fault("", "a builtin's signature is not that of its row");
  }
  return std::nullopt;
}

Fault verify_signature(const Program& program, const Function& f) {
  if (!blocks_of(f.results))
    return too_large(f.name, "the results are no list of types or too many");
  if (!blocks_of(f.locals)) return too_large(f.name, "the locals are no list of types or too many");
  if (f.params.size() > f.locals.size() ||
      !std::equal(f.params.begin(), f.params.end(), f.locals.begin()))
    return fault(f.name, "the parameters are not the first locals");
  if (f.lines.size() != f.code.size())
    return fault(f.name, "not every instruction has a source line");
  for (const SourceLine line : f.lines)
    if (!valid(program, line)) return fault(f.name, "a source line names no source");
  return std::nullopt;
}

/// Values that an instruction of `f` moves by what its operand or `f` says, operands unchecked.
std::size_t moves(const Program& program, const Function& f, const Instruction& i) {
  const auto size = [&](const auto& lists) { return i.a < lists.size() ? lists[i.a].size() : 0; };
  switch (i.op) {
    case Op::Call:
      return i.a < program.functions.size()
                 ? program.functions[i.a].params.size() + program.functions[i.a].results.size()
                 : 0;
    case Op::CallBuiltin:
    case Op::CallSpectral:
      return size(program.builtin_params) + size(program.builtin_results);
    case Op::If:  // twice taken, once joined
      return 3 * size(program.block_types);
    case Op::TailCall:
      return f.params.size();
    case Op::Return:
      return f.results.size();
    default:
      return 1;
  }
}

Fault verify_moves(const Program& program) {
  std::size_t left = limits::kMoves;
  for (const Function& f : program.functions)
    for (const Instruction& i : f.code) {
      const std::size_t n = moves(program, f, i) + 1;
      if (n > left) return too_large(f.name, "its instructions move too many values");
      left -= n;
    }
  return std::nullopt;
}

Fault verify_functions(const Program& program) {
  for (const Function& f : program.functions)
    if (Fault found = verify_signature(program, f)) return found;
  if (Fault found = verify_moves(program)) return found;
  for (const Function& f : program.functions)
    if (Fault found = verify_code(program, f)) return found;
  // The machine does not count calls of functions that are not recursive.
  const CallGraph graph = call_graph(program);
  for (std::size_t f = 0; f < program.functions.size(); ++f)
    if (graph.expansion[f] > std::uint64_t(limits::kNodes))
      return too_large(program.functions[f].name, "it makes too many calls");
  return std::nullopt;
}

/// The values and materials of one entry.
class EntryVerifier {
 public:
  EntryVerifier(const Program& program, const Entry& entry) : program_(program) {
    if (!entry.function) return;
    if (*entry.function >= program.functions.size())
      what_ = "an entry's function is out of range";
    else if (!program.functions[*entry.function].params.empty())
      what_ = "an entry's function has parameters";
    else
      results_ = program.functions[*entry.function].results;
  }

  void value(const ValueSource& v) {
    if (!vm::valid(v.type)) return fail("a value has no type");
    if (v.constant) {
      if (v.index >= program_.constants.size()) return fail("a value's constant is out of range");
      const SlotType found = program_.constants[v.index].type;
      const bool splat = v.type == SlotType::Spectrum && found == SlotType::Real;
      if (found != v.type && !splat) fail("a value's constant has the wrong type");
    } else {
      if (v.index >= results_.size()) return fail("a value's result is out of range");
      if (results_[v.index] != v.type) fail("a value's result has the wrong type");
    }
  }
  /// A value of that type. One that the entry does not compute may be left as it is made.
  void value(const ValueSource& v, SlotType type, bool computed) {
    if (!computed && v == ValueSource{}) return;
    if (v.type != type) return fail("a value has the wrong type");
    value(v);
  }

  void layout(const MaterialLayout& layout) {
    if (layout.nodes.size() > std::size_t(limits::kLobes))
      return fail("a material has too many lobes");
    std::vector<bool> used(layout.nodes.size());
    for (std::size_t k = 0; k < layout.nodes.size(); ++k) {
      if (layout.nodes[k].lobe < 0) fail("a lobe is out of range");
      for (const ValueSource& v : layout.nodes[k].params) value(v);
      for (const std::uint32_t child : layout.nodes[k].children) {
        if (child >= k) return fail("a lobe's child does not precede it");
        if (used[child]) return fail("a lobe has two parents");
        used[child] = true;
      }
    }
  }

  const char* what() const { return what_; }

 private:
  void fail(const char* what) {
    if (!what_) what_ = what;
  }
  const Program& program_;
  std::vector<SlotType> results_;
  const char* what_ = nullptr;
};

/// Which values an entry computes.
struct Computed {
  bool transmission, emission, height, gradient, bound;
};

const char* verify_entry(const Program& program, const Entry& entry, Computed computed) {
  EntryVerifier v(program, entry);
  v.value(entry.scattering, SlotType::Spectrum, computed.transmission);
  v.value(entry.absorption, SlotType::Spectrum, computed.transmission);
  v.value(entry.emission, SlotType::Spectrum, computed.emission);
  v.value(entry.height, SlotType::Real, computed.height);
  for (const ValueSource& g : entry.gradient) v.value(g, SlotType::Real, computed.gradient);
  v.value(entry.bound, SlotType::Real, computed.bound);
  v.layout(entry.material);
  v.layout(entry.emission_material);
  return v.what();
}

Fault verify_descriptor(const Program& program, const Descriptor& d) {
  if (d.form != DescriptorForm::Surface && d.form != DescriptorForm::Volume)
    return fault(d.name, "a descriptor is neither surface nor volume");
  if (!valid(program, d.line)) return fault(d.name, "a source line names no source");
  for (const OutputInfo& o : d.outputs)
    if (o.variables >> static_cast<int>(Variable::Count))
      return fault(d.name, "an output reads a variable that is not there");
  const bool surface = d.form == DescriptorForm::Surface;
  const struct {
    const Entry& entry;
    Computed computed;
  } entries[] = {
      {d.shade, {true, true, false, surface, false}},
      {d.pass, {true, false, false, false, false}},
      {d.emit, {false, true, false, false, false}},
      {d.displace, {false, false, surface, false, true}},
  };
  for (const auto& e : entries)
    if (const char* what = verify_entry(program, e.entry, e.computed)) return fault(d.name, what);
  return std::nullopt;
}

Fault verify_export(const Program& program, const Export& e) {
  if (e.function >= program.functions.size())
    return fault(e.name, "an export's function is out of range");
  if (!program.functions[e.function].params.empty())
    return fault(e.name, "an export's function has parameters");
  return std::nullopt;
}

}  // namespace

std::optional<VerifyFault> verify(const Program& program) {
  if (Fault found = verify_constants(program)) return found;
  if (Fault found = verify_builtins(program)) return found;
  if (Fault found = verify_functions(program)) return found;
  for (const Descriptor& d : program.descriptors)
    if (Fault found = verify_descriptor(program, d)) return found;
  for (const Export& e : program.exports)
    if (Fault found = verify_export(program, e)) return found;
  return std::nullopt;
}

}  // namespace mms::vm
