// SPDX-License-Identifier: Apache-2.0
#include "vm/stored_names.h"

#include <algorithm>
#include <cassert>

#include "vm/signature.h"

namespace mms::vm {
namespace {

/// Calls `f(node)` for each lobe and combiner of the program, and `g(output)` for each output.
template <class F, class G>
void each_output(Program& program, F f, G g) {
  for (Descriptor& d : program.descriptors) {
    for (Entry* e : {&d.shade, &d.pass, &d.emit, &d.displace})
      for (MaterialLayout* m : {&e->material, &e->emission_material})
        for (LayoutNode& n : m->nodes) f(n);
    for (OutputInfo& o : d.outputs) g(o);
  }
}

std::string variable_key(const VariableInfo& v) {
  return std::string(v.type) + " $" + std::string(v.name);
}

/// Names in the order of their first use.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}
  /// The place of `name`.
  std::uint32_t operator()(const std::string& name) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    const auto place = std::uint32_t(at - names_.begin());
    if (at == names_.end()) names_.push_back(name);
    return place;
  }

 private:
  std::vector<std::string>& names_;
};

/// Variable and component of machine input `index`.
struct InputName {
  Variable variable;
  std::uint32_t component;
};
InputName input_name(std::uint32_t index) {
  const Variable v = input_variable(int(index));
  return {v, index - std::uint32_t(input_index(v))};
}

}  // namespace

StoredForm name_all(Package package, std::span<const Builtin> library) {
  StoredForm form;
  Program& program = package.program;
  Names instruction(form.instructions), variable(form.variables), material(form.materials);
  for (Function& f : program.functions)
    for (Instruction& i : f.code) {
      const OpInfo& row = info(i.op);
      if (row.operand == OperandForm::Input) {
        const InputName input = input_name(i.a);
        i.a = variable(variable_key(info(input.variable)));
        i.b = input.component;
      }
      i.op = static_cast<Op>(instruction(std::string(row.name)));
    }
  for (const Builtin* row : program.builtins)
    form.builtins.push_back(read_signature(row->signature)->key);
  each_output(
      program,
      [&](LayoutNode& n) {
        const auto row = std::find_if(library.begin(), library.end(),
                                      [&](const Builtin& b) { return b.lobe == n.lobe; });
        assert(row != library.end());
        n.lobe = int(material(read_signature(row->signature)->key));
      },
      [&](OutputInfo& o) {
        std::uint32_t bits = 0;
        for (const VariableInfo& v : kVariables)
          if (o.variables >> static_cast<unsigned>(v.variable) & 1u)
            bits |= 1u << variable(variable_key(v));
        o.variables = bits;
      });
  form.package = std::move(package);
  return form;
}

namespace {

/// A row of the library, and what its signature says.
struct Row {
  const Builtin* builtin = nullptr;
  Signature signature;
};

class Numbering {
 public:
  Numbering(StoredForm& form, std::span<const Builtin> library)
      : form_(form), program_(form.package.program), library_(library) {}

  std::optional<Error> run() {
    find_instructions();
    find_variables();
    std::vector<Row> builtins = find_rows(form_.builtins, false);
    materials_ = find_rows(form_.materials, true);
    if (error_) return error_;
    for (Function& f : program_.functions)
      for (Instruction& i : f.code) number(i);
    for (Row& row : builtins) {
      program_.builtins.push_back(row.builtin);
      program_.builtin_params.push_back(std::move(row.signature.params));
      program_.builtin_results.push_back(std::move(row.signature.results));
    }
    each_output(
        program_, [&](LayoutNode& n) { number(n); }, [&](OutputInfo& o) { number(o); });
    return error_;
  }

 private:
  static constexpr const char* kOtherBuild =
      "it was compiled by another version of mms: compile the script with this one";

  void fail(std::string what, const char* hint) {
    if (!error_) error_ = Error{"", std::move(what), hint};
  }
  void missing(const char* what, const std::string& name) {
    fail("there is no " + std::string(what) + " `" + name + "` here", kOtherBuild);
  }
  void damaged(const char* what) { fail(what, "compile the script again"); }

  void find_instructions() {
    for (const std::string& name : form_.instructions) {
      const auto* row = std::find_if(std::begin(kOps), std::end(kOps),
                                     [&](const OpInfo& o) { return o.name == name; });
      if (row == std::end(kOps)) return missing("instruction", name);
      ops_.push_back(static_cast<Op>(row - kOps));
    }
  }
  void find_variables() {
    if (form_.variables.size() > kVariables.size()) return damaged("too many variables");
    for (const std::string& name : form_.variables) {
      const auto row = std::find_if(kVariables.begin(), kVariables.end(),
                                    [&](const VariableInfo& v) { return variable_key(v) == name; });
      if (row == kVariables.end()) return missing("variable", name);
      variables_.push_back(row->variable);
    }
  }
  std::vector<Row> find_rows(const std::vector<std::string>& keys, bool materials) {
    std::vector<Row> rows;
    for (const std::string& key : keys) {
      Row found;
      for (const Builtin& b : library_) {
        if (found.builtin || (b.lobe >= 0) != materials) continue;
        std::optional<Signature> s = read_signature(b.signature);
        if (s && s->key == key) found = {&b, std::move(*s)};
      }
      if (!found.builtin) {
        missing(materials ? "material" : "function", key);
        return {};
      }
      rows.push_back(std::move(found));
    }
    return rows;
  }

  void number(Instruction& i) {
    const auto place = static_cast<std::size_t>(i.op);
    if (place >= ops_.size()) return damaged("an instruction is out of range");
    i.op = ops_[place];
    if (info(i.op).operand != OperandForm::Input) return;
    if (i.a >= variables_.size()) return damaged("a variable is out of range");
    const VariableInfo& row = info(variables_[i.a]);
    if (i.b >= std::uint32_t(row.components())) return damaged("a component is out of range");
    i.a = std::uint32_t(input_index(row.variable, int(i.b)));
    i.b = 0;
  }

  void number(LayoutNode& n) {
    if (n.lobe < 0 || std::size_t(n.lobe) >= materials_.size())
      return damaged("a material is out of range");
    const Row& row = materials_[std::size_t(n.lobe)];
    const std::vector<SlotType>& types = row.signature.params;
    const bool same =
        std::equal(n.params.begin(), n.params.end(), types.begin(), types.end(),
                   [](const ValueSource& v, SlotType type) { return v.type == type; });
    if (!same || n.children.size() != std::size_t(row.signature.materials))
      return damaged("a material has other arguments than its row");
    n.lobe = row.builtin->lobe;
  }

  void number(OutputInfo& o) {
    if (std::uint64_t(o.variables) >> variables_.size())
      return damaged("an output reads a variable that is out of range");
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < variables_.size(); ++k)
      if (o.variables >> k & 1u) bits |= 1u << static_cast<unsigned>(variables_[k]);
    o.variables = bits;
  }

  StoredForm& form_;
  Program& program_;
  std::span<const Builtin> library_;
  std::vector<Op> ops_;
  std::vector<Variable> variables_;
  std::vector<Row> materials_;
  std::optional<Error> error_;
};

}  // namespace

std::optional<Error> number_all(StoredForm& form, std::span<const Builtin> library) {
  return Numbering(form, library).run();
}

}  // namespace mms::vm
