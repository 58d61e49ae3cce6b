// SPDX-License-Identifier: Apache-2.0
#include "vm/listing.h"

#include <array>
#include <charconv>
#include <initializer_list>
#include <string_view>

#include "vm/fuse.h"

namespace mms::vm {

namespace {

std::string cat(std::initializer_list<std::string_view> parts) {
  std::string s;
  for (const std::string_view part : parts) s.append(part);
  return s;
}

template <class N>
std::string text(N n) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, n).ptr};
}

std::string padded(std::string s, std::size_t width, bool right = false) {
  if (s.size() < width) s.insert(right ? 0 : s.size(), width - s.size(), ' ');
  return s;
}

/// The builtin that a call site runs, or null.
const Builtin* row_of(const Program& program, const CallSite& site) {
  for (const Builtin* row : program.builtins)
    if (row->f32 == site.f32 && row->f64 == site.f64) return row;
  return nullptr;
}

/// The input whose blocks hold block `index`, with its component.
std::string input_text(int index) {
  for (const VariableInfo& v : kVariables) {
    const int first = input_block(input_index(v.variable));
    const int count = v.components() * block_count(v.slot_type());
    if (index < first || index >= first + count) continue;
    return cat({"$", v.name, count > 1 ? cat({"[", text(index - first), "]"}) : ""});
  }
  return cat({"input ", text(index)});
}

std::string operand(const LoweredCode& code, Operand o) {
  std::string s;
  switch (o.base()) {
    case Operand::Constant: {
      if (o.index() >= code.constants.size()) return "?";
      const Constant& c = code.constants[o.index()];
      s = c.type == SlotType::Real ? text(c.f64) : text(c.integer);
      break;
    }
    case Operand::Input:
      s = input_text(static_cast<int>(o.index()));
      break;
    case Operand::Slot:
      s = cat({"s", text(o.index())});
      break;
    default:
      s = cat({"m", text(o.index())});
  }
  return o.splat() ? cat({s, "*"}) : s;
}

std::string pool(const LoweredCode& code, std::uint32_t first, std::uint32_t count) {
  std::string s;
  for (std::uint32_t k = 0; k < count; ++k)
    s += cat({k ? ", " : "", operand(code, code.operands[first + k])});
  return s;
}

bool has_site(LoweredOp op) { return op == LoweredOp::Call || op == LoweredOp::CallBuiltin; }

std::string instruction(const Program& program, const LoweredCode& code, std::uint32_t pc) {
  const LoweredInstruction& i = code.instructions[pc];
  if (has_site(i.op)) {
    const CallSite& site = code.sites[i.target];
    const Builtin* row = i.op == LoweredOp::CallBuiltin ? row_of(program, site) : nullptr;
    const std::string callee = row ? std::string(row->signature)
                               : i.op == LoweredOp::Call && site.function < program.functions.size()
                                   ? program.functions[site.function].name
                                   : "?";
    std::string s = cat({pool(code, site.first_result, site.results), " <- ", callee, " of ",
                         pool(code, site.first_arg, site.args)});
    if (site.repeats > 1) s += cat({", ", text(site.repeats), " runs"});
    return s;
  }
  const bool jumps = i.op == LoweredOp::If || i.op == LoweredOp::SkipIfNone;
  if (i.op == LoweredOp::Return) return "";
  std::string s;
  if (i.op != LoweredOp::SkipIfNone && i.op != LoweredOp::TailCall)
    s = cat({operand(code, i.dst), " <- "});
  const Operand operands[] = {i.a, i.b, i.c, i.d, i.e};
  const int count = i.op == LoweredOp::If ? 3 : operand_count(i.op);
  for (int k = 0; k < count; ++k) s += cat({k ? ", " : "", operand(code, operands[k])});
  return jumps ? cat({s, ", none: ", text(i.target)}) : s;
}

}  // namespace

int cost_of(const Program& program, const LoweredCode& code, std::uint32_t instruction) {
  const LoweredInstruction& i = code.instructions[instruction];
  if (i.op == LoweredOp::CallBuiltin) {
    const CallSite& site = code.sites[i.target];
    const Builtin* row = row_of(program, site);
    return row ? row->cost * static_cast<int>(site.repeats) : kOps[int(Op::CallBuiltin)].cost;
  }
  return cost_of(i.op);
}

std::string disassemble(const Program& program, const LoweredCode& code,
                        const std::function<std::string(SourceLine)>& text_of) {
  std::string out;
  for (std::size_t f = 0; f < code.functions.size(); ++f) {
    const LoweredFunction& function = code.functions[f];
    out += cat({"lowered ", text(f), " ", program.functions[f].name, ": ", text(function.blocks),
                " slots, ", text(function.masks), " masks\n"});
    SourceLine last;
    for (std::uint32_t pc = function.begin; pc < function.end; ++pc) {
      const SourceLine at = code.lines[pc];
      if (at.line != 0 && (at.source != last.source || at.line != last.line)) {
        const bool known = at.source < program.sources.size();
        out += cat({"  ; ", known ? program.sources[at.source] : "?", ":", text(at.line), "  ",
                    text_of(at), "\n"});
        last = at;
      }
      std::string line =
          cat({padded(text(pc), 5, true), padded(text(cost_of(program, code, pc)), 6, true), "  ",
               padded(std::string(name(code.instructions[pc].op)), 12), " ",
               instruction(program, code, pc)});
      out += cat({line.substr(0, line.find_last_not_of(' ') + 1), "\n"});
    }
    out += "\n";
  }
  return out;
}

}  // namespace mms::vm
