// SPDX-License-Identifier: Apache-2.0
// mms test: the examples in doc comments, run and compared.
#include <cmath>
#include <cstdio>
#include <memory>
#include <regex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/library.h"
#include "tools/commands.h"
#include "tools/doc_comment.h"
#include "tools/evaluate.h"

namespace mms::tools {

namespace {

constexpr const char* kExample = "example_value";
constexpr const char* kExpected = "expected_value";
/// What float may lose on the way, relative to what is expected; about eight roundings.
constexpr double kTolerance = 1e-6;

/// What became of an example: not as expected, with what was found instead, or well.
struct Outcome {
  bool passed = false;
  std::string found;  ///< a value, or why there is none
};

/// Numbers of an expected value, some of which go on: `1.41...` is whatever is less than 0.01 away.
struct Expected {
  std::string text;           ///< an expression
  std::vector<double> slack;  ///< of each number of the text; 0 where it does not go on
};

Expected read_expected(const std::string& text) {
  static const std::regex number(R"(\d+(\.(\d+))?([eE]([-+]?\d+))?(\.\.\.)?)");
  Expected e;
  auto at = text.begin();
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    const std::smatch& m = *i;
    const int decimals = static_cast<int>(m.length(2));
    const int exponent = m[4].matched ? std::stoi(m.str(4)) : 0;
    e.slack.push_back(m[5].matched ? std::pow(10.0, exponent - decimals) : 0);
    e.text.append(at, m[5].matched ? m[5].first : m[0].second);
    at = m[0].second;
  }
  e.text.append(at, text.end());
  return e;
}

bool agree(double found, double expected, double slack) {
  if (std::isnan(expected)) return std::isnan(found);
  if (std::isinf(expected) || std::isinf(found)) return found == expected;
  const double loss = kTolerance * (expected == 0 ? 1 : std::fabs(expected));
  return std::fabs(found - expected) <= loss || std::fabs(found - expected) < slack;
}

bool agree(const Evaluated& found, const Evaluated& expected, const Expected& text) {
  if (found.numbers.size() != expected.numbers.size()) return false;
  const bool exact = found.type.starts_with("integer") || found.type.starts_with("logic");
  const bool one_for_all = text.slack.size() == 1;
  for (std::size_t k = 0; k < found.numbers.size(); ++k) {
    const std::size_t which = one_for_all ? 0 : k;
    const double slack = which < text.slack.size() ? text.slack[which] : 0;
    if (exact ? found.numbers[k] != expected.numbers[k]
              : !agree(found.numbers[k], expected.numbers[k], slack))
      return false;
  }
  return true;
}

/// Links and runs the examples of one script.
class Tester {
 public:
  /// `scripts` are what the examples may use.
  Tester(std::string name, std::vector<lang::SourcePtr> scripts, const ScriptOptions& options)
      : name_(std::move(name)), scripts_(std::move(scripts)), options_(options) {}

  Outcome run(const Example& example) const {
    Outcome outcome;
    const auto found = value(fmt::format("const {} = {};\n", kExample, example.expression),
                             kExample, example, outcome.found);
    if (!found) {
      // A material has no value; that it links is all that can be asked.
      outcome.passed = outcome.found.empty() && example.expected.empty();
      if (outcome.found.empty()) outcome.found = "no value that can be printed";
      return outcome;
    }
    outcome.found = found->text;
    outcome.passed = example.expected.empty() || found->text == example.expected;
    if (outcome.passed) return outcome;
    const Expected text = read_expected(example.expected);
    std::string trouble;
    const auto expected =
        value(fmt::format("const {} {} = {};\n", found->type, kExpected, text.text), kExpected,
              example, trouble);
    outcome.passed = expected && agree(*found, *expected, text);
    if (!trouble.empty()) outcome.found += "\n" + trouble;
    return outcome;
  }

 private:
  /// The value of `name`, which `text` defines; or nothing, and why in `trouble`.
  std::optional<Evaluated> value(const std::string& text, const std::string& name,
                                 const Example& example, std::string& trouble) const {
    const std::string place = fmt::format("{}:{}", name_, example.line);
    lang::Diagnostics diagnostics;
    Exit exit = Exit::Ok;
    std::vector<lang::SourcePtr> sources = scripts_;
    sources.push_back(lang::make_source(place, text));
    const auto compiled = compile(sources, options_, diagnostics, exit);
    if (!compiled) {
      for (const lang::Diagnostic& d : diagnostics.all())
        if (d.severity == lang::Severity::Error) trouble += lang::render(d);
      return std::nullopt;
    }
    auto in = point<float>(*compiled, options_, exit);
    if (!in) return std::nullopt;
    for (const vm::Export& e : compiled->program.exports) {
      if (e.name != name) continue;
      const auto found = evaluate(compiled->program, e, *in);
      if (found) return *found;
      trouble = fmt::format("{}: {}", found.error().where, found.error().what);
    }
    return std::nullopt;
  }

  std::string name_;
  std::vector<lang::SourcePtr> scripts_;
  const ScriptOptions& options_;
};

void report(const std::string& file, const Example& example, const Outcome& outcome,
            const ScriptOptions& options) {
  if (options.json()) {
    const nlohmann::ordered_json json{{"file", file},
                                      {"line", example.line},
                                      {"expression", example.expression},
                                      {"expected", example.expected},
                                      {"found", outcome.found},
                                      {"passed", outcome.passed}};
    fmt::print("{}\n", json.dump());
  } else if (!outcome.passed) {
    print_error({fmt::format("{}:{}", file, example.line),
                 fmt::format("`{}` is not what the comment says", example.expression), ""},
                colours(options));
    fmt::print(stderr, "  expected: {}\n  found:    {}\n", example.expected, outcome.found);
  }
}

/// Runs `examples`, which stand in what is called `name`.
Exit test(const std::string& name, const std::vector<Example>& examples,
          std::vector<lang::SourcePtr> scripts, const ScriptOptions& options) {
  const Tester tester(name, std::move(scripts), options);
  std::size_t failed = 0;
  for (const Example& example : examples) {
    const Outcome outcome = tester.run(example);
    failed += !outcome.passed;
    report(name, example, outcome, options);
  }
  if (!options.json())
    fmt::print("{}: {}, {} failed\n", name, counted(examples.size(), "example"), failed);
  return failed > 0 ? Exit::Script : Exit::Ok;
}

/// Examples of a module of the library: of its functions in the language, which have a place, and
/// of those in C++. Empty where there is no such module.
std::vector<Example> module_examples(const std::string& name) {
  const lang::Library& library = api::standard_library();
  std::vector<Example> all;
  for (const lang::Library::Module& m : library.modules)
    if (m.name == name) all = examples_of(*lang::make_source(name, std::string(m.text)));
  for (const vm::Builtin& row : library.builtins)
    if (row.module == name) all.push_back({0, std::string(row.example), {}});
  return all;
}

Exit test_one(const std::string& file, const ScriptOptions& options) {
  const std::vector<Example> of_module = module_examples(file);
  if (!of_module.empty()) {  // images in them are no one's
    ScriptOptions without_images = options;
    without_images.missing = "magenta";
    return test(file, of_module, {}, without_images);
  }
  Exit exit = Exit::Ok;
  const auto sources = read_sources({file}, options, exit);
  if (!sources || !compile(*sources, options, exit)) return exit;
  const lang::SourcePtr& script = sources->front();
  return test(script->name, examples_of(*script), {script}, options);
}

Exit test_all(const ScriptOptions& options) {
  Exit worst = Exit::Ok;
  for (const std::string& file : options.files) worst = std::max(worst, test_one(file, options));
  return worst;
}

}  // namespace

Verb test_verb() {
  auto options = std::make_shared<ScriptOptions>();
  options->at_points = true;
  Verb verb{
      "test",
      "Run the examples in the doc comments of scripts",
      "An example is a line `/// >>> EXPRESSION`; the lines below it, to an empty one, are its\n"
      "value. Reals may differ by a millionth; `/// 1.41...` by less than one of its last digit.\n"
      "Without a value the expression need only link, which is what can be asked of a material.\n"
      "\nExamples:\n  mms test marble.mms\n  mms test --format=json *.mms\n  mms test noise",
      {},
      [options] { return test_all(*options); }};
  add_files(verb, *options, "Scripts, each a program of its own, or modules of the library");
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
