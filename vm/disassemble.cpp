// SPDX-License-Identifier: Apache-2.0
// Takes programs that have not been verified too: whatever is out of range is shown as a number.

#include <algorithm>
#include <charconv>

#include "vm/verify.h"
#include "vm/verify_code.h"

namespace mms::vm {
namespace {

constexpr std::size_t kOperandColumn = 22, kLineColumn = 58;

template <class N>
std::string text(N n) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, n).ptr;
  return {buffer, end};
}

std::string cat(std::initializer_list<std::string_view> parts) {
  std::string s;
  for (const std::string_view part : parts) s.append(part);
  return s;
}

/// Something that the program names but does not have.
template <class N>
std::string unknown(const char* what, N n) {
  return cat({what, " ", text(n), "?"});
}

void pad(std::string& s, std::size_t from, std::size_t column) {
  s.append(s.size() - from < column ? column - (s.size() - from) : 1, ' ');
}

std::string type_name(SlotType t) {
  constexpr const char* names[] = {"real", "integer", "logic", "spectrum"};
  return valid(t) ? names[static_cast<int>(t)] : unknown("type", static_cast<int>(t));
}

std::string type_list(const std::vector<SlotType>& types) {
  std::string s = "(";
  for (const SlotType t : types) s += cat({s.size() > 1 ? ", " : "", type_name(t)});
  return s + ")";
}

std::string constant_text(const Program& program, std::uint32_t k) {
  if (k >= program.constants.size()) return unknown("constant", k);
  const Constant& c = program.constants[k];
  if (c.type == SlotType::Integer) return text(c.integer);
  if (c.type == SlotType::Logic) return c.integer ? "true" : "false";
  std::string s = text(c.f64);
  const bool both_nan = c.f32 != c.f32 && c.f64 != c.f64;
  if (c.f32 != float(c.f64) && !both_nan) s += cat({" (float ", text(c.f32), ")"});
  return s;
}

std::string input_text(std::uint32_t k) {
  if (k >= std::uint32_t(input_count())) return unknown("input", k);
  const VariableInfo& v = info(input_variable(int(k)));
  std::string s = cat({"$", v.name});
  if (v.components() > 1) s += cat({"[", text(int(k) - input_index(v.variable)), "]"});
  return s;
}

std::string builtin_text(const Program& program, std::uint32_t k) {
  if (k >= program.builtins.size() || !program.builtins[k]) return unknown("builtin", k);
  return std::string(program.builtins[k]->signature);
}

std::string spectra_text(std::uint32_t bits) {
  std::string s;
  for (int k = 0; k < 32; ++k)
    if (bits >> k & 1) s += cat({s.empty() ? " spectra " : ", ", text(k)});
  return s;
}

std::string operand_text(const Program& program, const Instruction& i) {
  switch (info(i.op).operand) {
    case OperandForm::None:
      return "";
    case OperandForm::Constant:
      return constant_text(program, i.a);
    case OperandForm::Input:
      return input_text(i.a);
    case OperandForm::Local:
      return cat({"local ", text(i.a)});
    case OperandForm::BlockType:
      return i.a < program.block_types.size() ? type_list(program.block_types[i.a])
                                              : unknown("block type", i.a);
    case OperandForm::Function:
      return i.a < program.functions.size() ? program.functions[i.a].name
                                            : unknown("function", i.a);
    case OperandForm::Wavelength:
      return cat({"wavelength ", text(i.a)});
    case OperandForm::Builtin:
      return cat({builtin_text(program, i.a), i.op == Op::CallSpectral ? spectra_text(i.b) : ""});
  }
  return "";
}

std::string line_text(const Program& program, SourceLine l) {
  if (l.line == 0) return "";
  const bool known = l.source < program.sources.size();
  return cat({known ? program.sources[l.source] : unknown("source", l.source), ":", text(l.line)});
}

/// Appends one instruction; `depth` is the nesting of arms it stands in.
void instruction(std::string& out, const Program& program, const Function& f, std::size_t pc,
                 std::size_t depth) {
  const std::size_t start = out.size();
  const Instruction& i = f.code[pc];
  const std::string number = text(pc);
  out.append(number.size() < 5 ? 5 - number.size() : 0, ' ').append(number).append("  ");
  out.append(2 * std::min<std::size_t>(depth, 16), ' ');
  if (static_cast<std::size_t>(i.op) < kOpCount) {
    out += info(i.op).name;
    const std::string operand = operand_text(program, i);
    if (!operand.empty()) pad(out, start, kOperandColumn);
    out += operand;
  } else {
    out += unknown("instruction", static_cast<int>(i.op));
  }
  const std::string line = pc < f.lines.size() ? line_text(program, f.lines[pc]) : "";
  if (!line.empty()) pad(out, start, kLineColumn);
  out += line + "\n";
}

void function(std::string& out, const Program& program, std::size_t k) {
  const Function& f = program.functions[k];
  out += cat(
      {"function ", text(k), " ", f.name, type_list(f.params), " -> ", type_list(f.results), "\n"});
  for (std::size_t l = f.params.size(); l < f.locals.size(); ++l)
    out += cat({"  local ", text(l), " ", type_name(f.locals[l]), "\n"});
  std::size_t depth = 0;
  for (std::size_t pc = 0; pc < f.code.size(); ++pc) {
    const Op op = f.code[pc].op;
    if ((op == Op::Else || op == Op::End) && depth > 0) --depth;
    instruction(out, program, f, pc, depth);
    if (op == Op::If || op == Op::Else) ++depth;
  }
  out += "\n";
}

std::string value_text(const Program& program, const ValueSource& v) {
  return cat({type_name(v.type), v.constant ? " " : " result ",
              v.constant ? constant_text(program, v.index) : text(v.index)});
}

void layout(std::string& out, const Program& program, const char* name, const MaterialLayout& m) {
  for (std::size_t k = 0; k < m.nodes.size(); ++k) {
    const LayoutNode& node = m.nodes[k];
    out += cat({"    ", name, " node ", text(k), ": lobe ", text(node.lobe), "("});
    for (std::size_t p = 0; p < node.params.size(); ++p)
      out += cat({p ? ", " : "", value_text(program, node.params[p])});
    out += ")";
    for (const std::uint32_t c : node.children) out += cat({" node ", text(c)});
    out += "\n";
  }
}

void entry(std::string& out, const Program& program, const char* name, const Entry& e) {
  out += cat({"  ", name, ": ",
              e.function ? operand_text(program, {Op::Call, *e.function}) : "constant", "\n"});
  const struct {
    const char* name;
    const ValueSource& value;
  } values[] = {{"scattering", e.scattering},
                {"absorption", e.absorption},
                {"emission", e.emission},
                {"height", e.height},
                {"gradient[0]", e.gradient[0]},
                {"gradient[1]", e.gradient[1]},
                {"bound", e.bound}};
  for (const auto& v : values)
    if (v.value != ValueSource{})
      out += cat({"    ", v.name, ": ", value_text(program, v.value), "\n"});
  layout(out, program, "material", e.material);
  layout(out, program, "emission", e.emission_material);
}

void descriptor(std::string& out, const Program& program, const Descriptor& d) {
  out += d.form == DescriptorForm::Surface  ? "surface "
         : d.form == DescriptorForm::Volume ? "volume "
                                            : "descriptor? ";
  out += cat({d.name, "  ", line_text(program, d.line), "\n"});
  entry(out, program, "shade", d.shade);
  entry(out, program, "pass", d.pass);
  entry(out, program, "emit", d.emit);
  entry(out, program, "displace", d.displace);
  out += "\n";
}

}  // namespace

std::string disassemble(const Program& program) {
  std::string out;
  for (std::size_t k = 0; k < program.functions.size(); ++k) function(out, program, k);
  for (const Descriptor& d : program.descriptors) descriptor(out, program, d);
  for (const Export& e : program.exports)
    out += cat({"export ", e.name, ": ", e.type, " = ",
                operand_text(program, {Op::Call, e.function}), "\n"});
  return out;
}

}  // namespace mms::vm
