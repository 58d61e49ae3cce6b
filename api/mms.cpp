// SPDX-License-Identifier: Apache-2.0
// Graphs and programs: the half of mms.h that parses and links.
#include "api/mms.h"

#include <fmt/format.h>

#include "api/handles.h"
#include "api/library.h"
#include "lang/parser.h"

using namespace mms;

namespace {

std::string text_of(const Error& error) {
  return fmt::format("error: {}{}{}\n{}{}{}", error.where, error.where.empty() ? "" : ": ",
                     error.what, error.hint.empty() ? "" : "  = help: ", error.hint,
                     error.hint.empty() ? "" : "\n");
}

bool parse(MMsGraph& graph, const lang::SourcePtr& source) {
  lang::Diagnostics diagnostics;
  lang::Graph parsed = lang::parse(source, diagnostics);
  graph.log = lang::render(diagnostics);
  if (diagnostics.has_errors()) return false;
  graph.graph = std::move(parsed);
  return true;
}

bool link(MMsProgram& p, int level) {
  p.surfaces.clear();
  p.volumes.clear();
  p.executable.reset();
  p.linked.reset();
  if (level < 0 || level > 2) {
    p.log = text_of(
        {"mmsLinkProgram", fmt::format("there is no level {}", level), "levels are 0, 1 and 2"});
    return false;
  }
  p.options.level = static_cast<lang::Level>(level);
  lang::Diagnostics diagnostics;
  p.linked = lang::link(p.graphs, api::standard_library(), p.options, diagnostics);
  p.log = lang::render(diagnostics);
  if (!p.linked) return false;
  p.executable.emplace(p.linked->program);
  for (const vm::Descriptor& d : p.linked->program.descriptors) {
    if (d.form == vm::DescriptorForm::Surface)
      p.surfaces.push_back({&d, materials::Layout(d.shade.material)});
    else
      p.volumes.push_back({&d});
  }
  return true;
}

template <class T>
T* find(std::deque<T>& all, const char* name) {
  for (T& one : all)
    if (one.descriptor->name == name) return &one;
  return nullptr;
}

}  // namespace

MMsGraph* mmsMkGraph(void) { return api::make<MMsGraph>(); }
void mmsDeleteGraph(MMsGraph* graph) { delete graph; }

int mmsParseString(MMsGraph* graph, const char* script) {
  if (!graph || !script) return 0;
  return api::guarded(graph->log, [&] {
    graph->graph.reset();
    return parse(*graph, lang::make_source("<string>", script));
  });
}

int mmsParseFile(MMsGraph* graph, const char* path) {
  if (!graph || !path) return 0;
  return api::guarded(graph->log, [&] {
    graph->graph.reset();
    const Result<lang::SourcePtr> source = api::read_source(path);
    if (source) return parse(*graph, *source);
    graph->log = text_of(source.error());
    return false;
  });
}

const char* mmsGetGraphLog(const MMsGraph* graph) { return graph ? graph->log.c_str() : ""; }

MMsProgram* mmsMkProgram(void) { return api::make<MMsProgram>(); }
void mmsDeleteProgram(MMsProgram* program) { delete program; }

int mmsAddGraph(MMsProgram* program, const MMsGraph* graph) {
  if (!program || !graph) return 0;
  return api::guarded(program->log, [&] {
    if (graph->graph) {
      program->graphs.push_back(*graph->graph);
      return true;
    }
    program->log = text_of(
        {"mmsAddGraph", "the graph holds no script that parsed", "mmsGetGraphLog says why"});
    return false;
  });
}

int mmsAddImportPath(MMsProgram* program, const char* folder) {
  if (!program || !folder) return 0;
  return api::guarded(program->log, [&] {
    program->options.import_path.emplace_back(folder);
    return true;
  });
}

int mmsSetParam(MMsProgram* program, const char* name, const char* expression) {
  if (!program || !name || !expression) return 0;
  return api::guarded(program->log, [&] {
    program->options.params.emplace_back(name, expression);
    return true;
  });
}

int mmsLinkProgram(MMsProgram* program, int level) {
  if (!program) return 0;
  return api::guarded(program->log, [&] { return link(*program, level); });
}

const char* mmsGetProgramLog(const MMsProgram* program) {
  return program ? program->log.c_str() : "";
}

MMsSurface* mmsGetSurface(MMsProgram* program, const char* name) {
  return program && name ? find(program->surfaces, name) : nullptr;
}

MMsVolume* mmsGetVolume(MMsProgram* program, const char* name) {
  return program && name ? find(program->volumes, name) : nullptr;
}
