// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a stored program consists of, field by field, in order. Written once: `fields` is what the
/// writer, the reader and the document go through. Each takes its type apart whole, so a new member
/// does not compile before it has its place here (and the format its next number). Internal to vm.

#include <string>
#include <vector>

#include "vm/serialise.h"

namespace mms::vm {

/// A package whose numbers mean places in these lists, not in the tables of this build.
struct StoredForm {
  std::vector<std::string> instructions;  ///< names, vm/opcodes.def
  std::vector<std::string> variables;     ///< type and name: `real[3] position`
  std::vector<std::string> builtins;      ///< `Signature::key`
  std::vector<std::string> materials;     ///< `Signature::key`
  Package package;
};

// A visitor is called with a name, a value, and what the value means. `name_of` is for the
// document.

constexpr const char* name_of(const SourceLine&) { return "line"; }
template <class V>
void fields(V& v, SourceLine& l) {
  auto& [source, line, column] = l;
  v("source", source, "place in `sources`");
  v("line", line, "from 1; 0: nowhere");
  v("column", column, "in bytes, from 1; 0: not known");
}

constexpr const char* name_of(const Constant&) { return "constant"; }
template <class V>
void fields(V& v, Constant& c) {
  auto& [type, f32, f64, integer] = c;
  v("type", type, "");
  v("f32", f32, "what the float machine takes");
  v("f64", f64, "what the double machine takes");
  v("integer", integer, "an integer, or a logic as 0 or 1");
}

constexpr const char* name_of(const Instruction&) { return "instruction"; }
template <class V>
void fields(V& v, Instruction& i) {
  auto& [op, a, b] = i;
  v("op", op, "place in `instructions`");
  v("a", a, "operand; of `PushInput`, the place in `variables`");
  v("b", b, "second operand; of `PushInput`, the component");
}

constexpr const char* name_of(const Function&) { return "function"; }
template <class V>
void fields(V& v, Function& f) {
  auto& [name, params, results, locals, code, lines] = f;
  v("name", name, "");
  v("params", params, "");
  v("results", results, "");
  v("locals", locals, "parameters first");
  v("code", code, "");
  v("lines", lines, "one for each instruction");
}

constexpr const char* name_of(const ValueSource&) { return "value"; }
template <class V>
void fields(V& v, ValueSource& s) {
  auto& [type, constant, index] = s;
  v("type", type, "");
  v("constant", constant, "");
  v("index", index, "place in `constants`, or a result of the entry's function");
}

constexpr const char* name_of(const LayoutNode&) { return "node"; }
template <class V>
void fields(V& v, LayoutNode& n) {
  auto& [lobe, params, children] = n;
  v("material", lobe, "place in `materials`");
  v("params", params, "arguments that are no materials, flattened");
  v("children", children, "nodes that are its material arguments, each before this one");
}

constexpr const char* name_of(const MaterialLayout&) { return "material"; }
template <class V>
void fields(V& v, MaterialLayout& l) {
  auto& [nodes] = l;
  v("nodes", nodes, "the root is the last");
}

constexpr const char* name_of(const Entry&) { return "entry"; }
template <class V>
void fields(V& v, Entry& e) {
  auto& [function, scattering, absorption, emission, height, bound, gradient, material,
         emission_material] = e;
  v("function", function, "place in `functions`");
  v("scattering", scattering, "");
  v("absorption", absorption, "");
  v("emission", emission, "");
  v("height", height, "");
  v("bound", bound, "");
  v("gradient", gradient, "");
  v("material", material, "");
  v("emission_material", emission_material, "");
}

constexpr const char* name_of(const OutputInfo&) { return "output"; }
template <class V>
void fields(V& v, OutputInfo& o) {
  auto& [stated, constant, spectral, variables] = o;
  v("stated", stated, "");
  v("constant", constant, "");
  v("spectral", spectral, "");
  v("variables", variables, "bit k: reads number k of `variables`");
}

constexpr const char* name_of(const Descriptor&) { return "descriptor"; }
template <class V>
void fields(V& v, Descriptor& d) {
  auto& [form, name, line, shade, pass, emit, displace, outputs] = d;
  v("form", form, "0 surface, 1 volume");
  v("name", name, "");
  v("line", line, "");
  v("shade", shade, "what a path vertex needs");
  v("pass", pass, "what a shadow ray needs");
  v("emit", emit, "what sampling an emitter needs");
  v("displace", displace, "height and bound");
  v("outputs", outputs,
    "material, scattering, absorption, emission material, emission, height, gradient, bound");
}

constexpr const char* name_of(const Export&) { return "export"; }
template <class V>
void fields(V& v, Export& e) {
  auto& [name, type, function] = e;
  v("name", name, "");
  v("type", type, "in the language's syntax");
  v("function", function, "place in `functions`");
}

constexpr const char* name_of(const ProgramImage&) { return "image"; }
template <class V>
void fields(V& v, ProgramImage& i) {
  auto& [use, image] = i;
  auto& [file, filter, wrap, space, channel, storage] = use;
  (void)image;
  v("file", file, "`<UDIM>` stands for the numbers of tiles");
  v("filter", filter, "between texels");
  v("wrap", wrap, "outside [0, 1]");
  v("space", space, "colour space of the file's numbers");
  v("channel", channel, "of a number; empty: luminance, or the only one");
  v("storage", storage, "in memory");
}

constexpr const char* name_of(const ParamInfo&) { return "param"; }
template <class V>
void fields(V& v, ParamInfo& p) {
  auto& [name, type, doc, label, unit, page, value, range] = p;
  v("name", name, "");
  v("type", type, "in the language's syntax");
  v("doc", doc, "");
  v("label", label, "");
  v("unit", unit, "");
  v("page", page, "");
  v("value", value, "flattened");
  v("range", range, "least and greatest");
}

constexpr const char* name_of(const StoredForm&) { return "program"; }
template <class V>
void fields(V& v, StoredForm& s) {
  auto& [instructions, variables, builtins, materials, package] = s;
  auto& [program, params, dependencies] = package;
  // The rows that `builtins` name have these.
  auto& [sources, constants, block_types, functions, rows, row_params, row_results, descriptors,
         exports, images] = program;
  (void)rows, (void)row_params, (void)row_results;
  v("instructions", instructions, "names of those that occur");
  v("variables", variables, "type and name of those that are read: `real[3] position`");
  v("builtins", builtins, "rows that are called: `real perlin(real[3])`");
  v("materials", materials, "rows of scattering models and combiners");
  v("sources", sources, "names of the files");
  v("dependencies", dependencies, "imported files");
  v("params", params, "");
  v("constants", constants, "");
  v("block_types", block_types, "what the arms of an If leave");
  v("functions", functions, "");
  v("descriptors", descriptors, "");
  v("exports", exports, "");
  v("images", images, "pictures that are looked up, by number");
}

/// A struct that has a row here.
template <class T, class V>
concept HasFields = requires(T& t, V& v) {
  fields(v, t);
};

}  // namespace mms::vm
