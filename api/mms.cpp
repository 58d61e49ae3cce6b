// SPDX-License-Identifier: Apache-2.0
// Graphs and programs: the half of mms.h that parses and links.
#include "api/mms.h"

#include <algorithm>

#include <fmt/format.h>

#include "api/handles.h"
#include "api/library.h"
#include "lang/parser.h"

using namespace mms;

namespace mms::api {

void Messages::add(const Error& error) {
  add(MMS_ERROR, fmt::format("error: {}{}{}\n{}{}{}", error.where, error.where.empty() ? "" : ": ",
                             error.what, error.hint.empty() ? "" : "  = help: ", error.hint,
                             error.hint.empty() ? "" : "\n"));
}

LinkedProgram::LinkedProgram(lang::Linked l) : linked(std::move(l)), executable(linked.program) {
  for (const vm::Descriptor& d : linked.program.descriptors) {
    materials::Layout material(d.shade.material), emission(d.emit.emission_material);
    if (d.form == vm::DescriptorForm::Surface)
      surfaces.push_back({this, &d, std::move(material), std::move(emission)});
    else
      volumes.push_back({this, &d, std::move(material), std::move(emission)});
  }
}

}  // namespace mms::api

namespace {

void report(api::Messages& messages, const lang::Diagnostics& diagnostics) {
  const char* separator = "";
  for (const lang::Diagnostic& d : diagnostics.all()) {
    messages.text += separator;
    messages.add(d.severity == lang::Severity::Error ? MMS_ERROR : MMS_WARNING, lang::render(d));
    separator = "\n";
  }
}

bool parse(MMsGraph& graph, const lang::SourcePtr& source) {
  lang::Diagnostics diagnostics;
  lang::Graph parsed = lang::parse(source, diagnostics);
  report(graph.messages, diagnostics);
  if (diagnostics.has_errors()) return false;
  graph.graph = std::move(parsed);
  return true;
}

/// The host's own storage as the linker asks for it.
lang::Resolver resolver(const MMsProgram& p) {
  if (!p.resolve) return {};
  return [&p](const std::string& importer,
              const std::string& written) -> std::optional<lang::Imported> {
    const char* name = written.c_str();
    const char* text = p.resolve(p.resolve_user, importer.c_str(), written.c_str(), &name);
    if (!text) return std::nullopt;
    return lang::Imported{name ? name : written, text};
  };
}

bool link(MMsProgram& p, int level) {
  p.linked.reset();
  if (level < 0 || level > 2) {
    p.messages.add(
        {"mmsLinkProgram", fmt::format("there is no level {}", level), "levels are 0, 1 and 2"});
    return false;
  }
  p.options.level = static_cast<lang::Level>(level);
  p.options.resolve = resolver(p);
  p.options.images = &p.images;
  lang::Diagnostics diagnostics;
  auto linked = lang::link(p.graphs, api::standard_library(), p.options, diagnostics);
  report(p.messages, diagnostics);
  if (!linked) return false;
  p.linked = std::make_shared<const api::LinkedProgram>(std::move(*linked));
  return true;
}

/// The handles are the host's to pass back, but nothing here changes what they stand for.
template <class T>
T* find(const std::deque<T>& all, const char* name) {
  for (const T& one : all)
    if (one.descriptor->name == name) return const_cast<T*>(&one);
  return nullptr;
}

}  // namespace

MMsGraph* mmsMkGraph(void) { return api::make<MMsGraph>(); }
void mmsDeleteGraph(MMsGraph* graph) { delete graph; }

void mmsSetGraphLog(MMsGraph* graph, MMsLog log, void* user) {
  if (!graph) return;
  graph->messages.log = log;
  graph->messages.user = user;
}

int mmsParseString(MMsGraph* graph, const char* script) {
  return graph && script ? mmsParseNamed(graph, "<string>", script) : 0;
}

int mmsParseNamed(MMsGraph* graph, const char* name, const char* script) {
  if (!graph || !name || !script) return 0;
  return api::guarded(graph->messages, [&] {
    graph->graph.reset();
    return parse(*graph, lang::make_source(name, script));
  });
}

int mmsParseFile(MMsGraph* graph, const char* path) {
  if (!graph || !path) return 0;
  return api::guarded(graph->messages, [&] {
    graph->graph.reset();
    const Result<lang::SourcePtr> source = api::read_source(path);
    if (source) return parse(*graph, *source);
    graph->messages.add(source.error());
    return false;
  });
}

const char* mmsGetGraphLog(const MMsGraph* graph) {
  return graph ? graph->messages.text.c_str() : "";
}

MMsProgram* mmsMkProgram(void) { return api::make<MMsProgram>(); }
void mmsDeleteProgram(MMsProgram* program) { delete program; }

void mmsSetProgramLog(MMsProgram* program, MMsLog log, void* user) {
  if (!program) return;
  program->messages.log = log;
  program->messages.user = user;
}

void mmsSetResolver(MMsProgram* program, MMsResolve resolve, void* user) {
  if (!program) return;
  program->resolve = resolve;
  program->resolve_user = user;
}

int mmsAddGraph(MMsProgram* program, const MMsGraph* graph) {
  if (!program || !graph) return 0;
  return api::guarded(program->messages, [&] {
    if (graph->graph) {
      program->graphs.push_back(*graph->graph);
      return true;
    }
    program->messages.add(
        {"mmsAddGraph", "the graph holds no script that parsed", "mmsGetGraphLog says why"});
    return false;
  });
}

int mmsSetImages(MMsProgram* program, double megabytes, int missing_is_magenta) {
  if (!program) return 0;
  return api::guarded(program->messages, [&] {
    if (!(megabytes >= 1 && megabytes <= api::kMostImageMegabytes)) {
      program->messages.add(
          {"mmsSetImages",
           fmt::format("{} is not a number from 1 to {}", megabytes, api::kMostImageMegabytes),
           "give megabytes, as 4096"});
      return false;
    }
    program->images = api::ImageLibrary(megabytes);
    program->options.missing_images =
        missing_is_magenta ? lang::MissingImages::Magenta : lang::MissingImages::Refuse;
    return true;
  });
}

int mmsAddImportPath(MMsProgram* program, const char* folder) {
  if (!program || !folder) return 0;
  return api::guarded(program->messages, [&] {
    program->options.import_path.emplace_back(folder);
    return true;
  });
}

int mmsSetParam(MMsProgram* program, const char* name, const char* expression) {
  if (!program || !name || !expression) return 0;
  return api::guarded(program->messages, [&] {
    auto& params = program->options.params;
    const auto old = std::find_if(params.begin(), params.end(),
                                  [&](const auto& setting) { return setting.first == name; });
    if (old != params.end())
      old->second = expression;
    else
      params.emplace_back(name, expression);
    return true;
  });
}

int mmsLinkProgram(MMsProgram* program, int level) {
  if (!program) return 0;
  return api::guarded(program->messages, [&] { return link(*program, level); });
}

const char* mmsGetProgramLog(const MMsProgram* program) {
  return program ? program->messages.text.c_str() : "";
}

MMsSurface* mmsGetSurface(MMsProgram* program, const char* name) {
  return program && program->linked && name ? find(program->linked->surfaces, name) : nullptr;
}

MMsVolume* mmsGetVolume(MMsProgram* program, const char* name) {
  return program && program->linked && name ? find(program->linked->volumes, name) : nullptr;
}
