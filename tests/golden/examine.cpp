// SPDX-License-Identifier: Apache-2.0
// Checking a golden script against its expectations.
#include <algorithm>

#include "materials/table.h"
#include "tests/golden/expectations.h"
#include "tests/golden/reload.h"
#include "tests/sanitized.h"

namespace mms::golden {
namespace {

using lang::Level;

/// One entry's materials and numbers, by the name of an output.
struct Found {
  const vm::Entry* entry = nullptr;
  std::vector<vm::ValueSource> sources;
  const vm::MaterialLayout* material = nullptr;
  vm::Output output = vm::Output::Count;
};

Found find_output(const vm::Descriptor& d, const std::string& name) {
  const vm::Entry &s = d.shade, &p = d.pass, &e = d.emit, &h = d.displace;
  if (name == "bsdf" || name == "phase") return {&s, {}, &s.material, vm::Output::Material};
  if (name == "scattering") return {&p, {p.scattering}, nullptr, vm::Output::Scattering};
  if (name == "absorption") return {&p, {p.absorption}, nullptr, vm::Output::Absorption};
  if (name == "emission_function")
    return {&e, {}, &e.emission_material, vm::Output::EmissionMaterial};
  if (name == "emission") return {&e, {e.emission}, nullptr, vm::Output::Emission};
  if (name == "height") return {&h, {h.height}, nullptr, vm::Output::Height};
  if (name == "gradient")
    return {&s, {s.gradient[0], s.gradient[1]}, nullptr, vm::Output::Gradient};
  if (name == "bound") return {&h, {h.bound}, nullptr, vm::Output::Bound};
  return {};
}

bool close(double found, double expected, double tolerance) {
  if (std::isnan(expected)) return std::isnan(found);
  if (std::isinf(expected)) return found == expected;
  return std::fabs(found - expected) <= tolerance * std::max(std::fabs(expected), 1e-3);
}

/// `found` are the slots, `types` their types; one number may stand for a spectrum.
std::string compare(const std::vector<double>& found, const std::vector<vm::ValueSource>& types,
                    const std::string& text, double tolerance) {
  std::vector<double> expected = numbers_of(text);
  if (expected.size() == types.size() && expected.size() != found.size()) {
    std::vector<double> all;
    for (std::size_t k = 0; k < types.size(); ++k)
      all.insert(all.end(), static_cast<std::size_t>(vm::block_count(types[k].type)), expected[k]);
    expected = std::move(all);
  }
  bool good = expected.size() == found.size();
  for (std::size_t k = 0; good && k < found.size(); ++k)
    good = close(found[k], expected[k], tolerance);
  return good ? "" : fmt::format("expected {}, found {}", text, fmt::join(found, ", "));
}

/// A material as its tree, with a `#` for each number; the numbers on the side.
class TreeText {
 public:
  TreeText(const vm::Program& p, const vm::MaterialLayout& m, std::optional<std::uint32_t> function,
           const Run& r)
      : p_(p), m_(m), function_(function), r_(r) {
    if (!m.nodes.empty()) node(m.nodes.size() - 1);
  }
  std::string text;
  std::vector<double> numbers;

 private:
  void node(std::size_t k) {
    const vm::LayoutNode& n = m_.nodes[k];
    const std::string_view signature =
        materials::rows()[static_cast<std::size_t>(n.lobe)].signature;
    const materials::Formals& f = materials::formals(static_cast<materials::Lobe>(n.lobe));
    const std::size_t name = signature.find(' ') + 1;
    text += std::string(signature.substr(name, signature.find('(') - name)) + "(";
    std::size_t child = 0, param = 0;
    for (int i = 0; i < f.count; ++i) {
      if (i) text += ",";
      if (f.kinds[i] == 'm')
        node(n.children[child++]);
      else
        number(n.params[param++]);
    }
    text += ")";
  }
  void number(const vm::ValueSource& s) {
    const auto slots = values_of<float>(p_, s, function_, r_, 1);
    const bool even =
        std::all_of(slots.begin(), slots.end(), [&](const auto& v) { return v[0] == slots[0][0]; });
    if (!even) text += "[";
    for (std::size_t k = 0; k < (even ? 1 : slots.size()); ++k) {
      text += k ? ",#" : "#";
      numbers.push_back(slots[k][0]);
    }
    if (!even) text += "]";
  }
  const vm::Program& p_;
  const vm::MaterialLayout& m_;
  std::optional<std::uint32_t> function_;
  const Run& r_;
};

/// The same form of an expected tree.
std::string with_marks(const std::string& tree, std::vector<double>& numbers) {
  std::string out;
  for (std::size_t i = 0; i < tree.size();) {
    const bool number = std::isdigit(static_cast<unsigned char>(tree[i])) || tree[i] == '-';
    const bool inside =
        !out.empty() && (std::isalnum(static_cast<unsigned char>(out.back())) || out.back() == '_');
    if (number && !inside) {
      char* end = nullptr;
      numbers.push_back(std::strtod(tree.c_str() + i, &end));
      i = static_cast<std::size_t>(end - tree.c_str());
      out += '#';
    } else {
      if (tree[i] != ' ') out += tree[i];
      ++i;
    }
  }
  return out;
}

class Examination {
 public:
  Examination(const lang::SourcePtr& source, Outcome& outcome)
      : e_(read_expectations(*source)), out_(outcome) {
    options_.params = e_.params;
    out_.known_issue = e_.known_issue;
    out_.failures = e_.malformed;
    compiled_ = compile(source, options_);
  }

  void messages() {
    std::vector<bool> given(e_.messages.size(), false);
    for (const lang::Diagnostic& d : compiled_.diagnostics.all()) {
      bool expected = false;
      for (std::size_t k = 0; k < given.size() && !expected; ++k) {
        if (given[k] || !is(d, e_.messages[k])) continue;
        given[k] = expected = true;
        out_.codes.insert(e_.messages[k].code);
      }
      if (!expected) out_.failures.push_back("not expected: " + lang::render(d));
    }
    for (std::size_t k = 0; k < given.size(); ++k)
      if (!given[k])
        out_.failures.push_back(fmt::format(
            "line {}: {} was expected at column {}, {} wide, but not given", e_.messages[k].line,
            e_.messages[k].code, e_.messages[k].column, e_.messages[k].length));
  }

  void values() {
    if (!compiled_.linked) {
      if (!e_.values.empty() || !e_.outputs.empty()) out_.failures.push_back("it does not link");
      return;
    }
    if (vm::verify(program()))
      return out_.failures.push_back("the program does not verify: " + vm::verify(program())->what);
    executable_.emplace(program());
    for (const ExpectedValue& v : e_.values) value(v);
    for (const ExpectedFault& f : e_.faults) fault(f);
    for (const ExpectedOutput& o : e_.outputs) output(o);
    for (const ExpectedOutput& o : e_.infos) info(o);
    for (const ExpectedOutput& o : e_.gradients) gradient(o);
    check_agreement(compiled_.source, options_, e_.near, out_.failures);
  }

 private:
  const vm::Program& program() const { return compiled_.linked->program; }

  bool is(const lang::Diagnostic& d, const ExpectedMessage& m) const {
    if (lang::info(d.id).code != m.code) return false;
    if (!m.text.empty()) {
      std::string all = d.text + "\n" + d.label;
      for (const std::string& h : d.helps) all += "\n" + h;
      for (const lang::Note& n : d.notes) all += "\n" + n.text;
      if (all.find(m.text) == all.npos) return false;
    }
    const bool nowhere = d.span.source != compiled_.source.get() || d.span.end == 0;
    if (nowhere || m.line == 0) return nowhere && m.line == 0;
    const lang::Position begin = lang::position_at(*d.span.source, d.span.begin);
    const std::uint32_t line_end =
        d.span.source->line_starts[begin.line - 1] +
        static_cast<std::uint32_t>(lang::line_text(*d.span.source, begin.line).size());
    const std::uint32_t last = std::max(d.span.begin, std::min(d.span.end, line_end));
    const std::uint32_t width =
        std::max(1u, lang::position_at(*d.span.source, last).column - begin.column);
    return begin.line == m.line && begin.column == m.column && width == m.length;
  }

  /// The export whose definition covers a line.
  const vm::Export* export_at(std::uint32_t line) const {
    const lang::Graph& g = compiled_.graphs[0];
    std::string name;
    auto covers = [&](lang::Span s) {
      return lang::position_at(*s.source, s.begin).line <= line &&
             line <= lang::position_at(*s.source, s.end).line;
    };
    for (lang::FunctionHandle h : g.top_functions)
      if (covers(g[h].span)) name = g[h].name.text;
    for (const lang::Constant& k : g.constants)
      if (covers(k.span)) name = k.name.text;
    for (const vm::Export& e : program().exports)
      if (e.name == name) return &e;
    return nullptr;
  }

  Point point_of(const vm::Export& e) const {
    for (const Point& p : points_of(program()))
      if (p.function == e.function && p.name == e.name) return p;
    return {};
  }

  void value(const ExpectedValue& v) {
    const vm::Export* e = export_at(v.line);
    if (!e)
      return out_.failures.push_back(fmt::format("line {}: nothing here has a value", v.line));
    auto in = points<float>(vm::kLaneMultiple);
    const Point p = point_of(*e);
    const Run r = evaluate(program(), *executable_, p, in, 1);
    if (!r.faults.empty()) return out_.failures.push_back(fmt::format("line {}: a fault", v.line));
    std::vector<double> found;
    for (const auto& slot : r.values) found.push_back(slot[0]);
    const std::string wrong = compare(found, p.sources, v.value, v.tolerance);
    if (!wrong.empty()) out_.failures.push_back(fmt::format("line {}: {}", v.line, wrong));
  }

  void fault(const ExpectedFault& f) {
    const vm::Export* e = export_at(f.line);
    if (!e)
      return out_.failures.push_back(fmt::format("line {}: nothing here has a value", f.line));
    auto in = points<float>(vm::kLaneMultiple);
    const Run r = evaluate(program(), *executable_, point_of(*e), in, 3);
    if (r.faults.empty()) return out_.failures.push_back(fmt::format("line {}: no fault", f.line));
    for (const vm::Fault& found : r.faults) {
      const std::string cause =
          found.cause == vm::Fault::Cause::BackEdges ? "BackEdges" : "CallDepth";
      if (cause != f.cause || found.line.line != f.at)
        out_.failures.push_back(
            fmt::format("line {}: a fault {} at line {}", f.line, cause, found.line.line));
    }
  }

  const vm::Descriptor* descriptor(const ExpectedOutput& o) {
    const auto form = o.form == "volume" ? vm::DescriptorForm::Volume : vm::DescriptorForm::Surface;
    const vm::Descriptor* d = program().find(form, o.name);
    if (!d) out_.failures.push_back(fmt::format("there is no {} {}", o.form, o.name));
    return d;
  }

  void output(const ExpectedOutput& o) {
    const vm::Descriptor* d = descriptor(o);
    if (!d) return;
    const Found f = find_output(*d, o.output);
    if (!f.entry) return out_.failures.push_back("there is no output " + o.output);
    auto in = points<float>(vm::kLaneMultiple);
    for (const auto& [name, numbers] : o.at) {
      const auto variable = api::find_variable(name);
      if (!variable) return out_.failures.push_back("there is no variable " + name);
      const std::vector<float> values(numbers.begin(), numbers.end());
      if (values.size() != static_cast<std::size_t>(components(*variable)))
        return out_.failures.push_back(
            fmt::format("${} has {} numbers", name, components(*variable)));
      api::fill_all<float>(in, *variable, values);
    }
    Run r;
    if (f.entry->function) r = run(program(), *executable_, *f.entry->function, in, 1);
    std::string wrong;
    std::vector<double> found;
    if (f.material) {
      const TreeText tree(program(), *f.material, f.entry->function, r);
      std::vector<double> expected;
      bool good =
          with_marks(o.value, expected) == tree.text && expected.size() == tree.numbers.size();
      for (std::size_t k = 0; good && k < expected.size(); ++k)
        good = close(tree.numbers[k], expected[k], 1e-6);
      if (!good)
        wrong = fmt::format("expected {}, found {} with {}", o.value, tree.text,
                            fmt::join(tree.numbers, ", "));
    } else {
      for (const vm::ValueSource& s : f.sources)
        for (const auto& slot : values_of<float>(program(), s, f.entry->function, r, 1))
          found.push_back(slot[0]);
      wrong = compare(found, f.sources, o.value, 1e-6);
    }
    if (!wrong.empty())
      out_.failures.push_back(fmt::format("{} {} {}: {}", o.form, o.name, o.output, wrong));
  }

  void info(const ExpectedOutput& o) {
    const vm::Descriptor* d = descriptor(o);
    if (!d) return;
    const Found f = find_output(*d, o.output);
    if (f.output == vm::Output::Count)
      return out_.failures.push_back("there is no output " + o.output);
    const vm::OutputInfo& i = d->output(f.output);
    std::string text = i.constant ? "constant" : "varying";
    if (i.spectral) text += " spectral";
    if (i.variables) text += " reads";
    for (const vm::VariableInfo& v : vm::kVariables)
      if (i.variables >> static_cast<int>(v.variable) & 1) text += fmt::format(" ${}", v.name);
    if (text != o.value)
      out_.failures.push_back(
          fmt::format("{} {}: expected `{}`, found `{}`", o.name, o.output, o.value, text));
  }

  /// Both derivatives at random points, where the differences of two steps agree; see rows_test.cpp
  /// for the tolerance.
  void gradient(const ExpectedOutput& o) {
    constexpr int kLanes = 64;
    constexpr double kTolerance = 1e-5, kStep = 1.0 / (1 << 14);
    const vm::Descriptor* d = descriptor(o);
    if (!d) return;
    auto in = points<double>(kLanes, 3);
    const Run exact =
        d->shade.function ? run(program(), *executable_, *d->shade.function, in, kLanes) : Run{};
    for (int direction = 0; direction < 2; ++direction) {
      auto height = [&](double step) {
        auto moved = in;
        for (const vm::VariableInfo& v : vm::kVariables)
          for (const vm::VariableInfo& along : vm::kVariables)
            if (along.name == (direction ? v.along_bitangent : v.along_tangent))
              for (int c = 0; c < v.components(); ++c)
                for (int i = 0; i < kLanes; ++i)
                  moved.lanes(v.variable, c)[i] += step * in.lanes(along.variable, c)[i];
        const Run r = d->displace.function
                          ? run(program(), *executable_, *d->displace.function, moved, kLanes)
                          : Run{};
        return values_of<double>(program(), d->displace.height, d->displace.function, r, kLanes)[0];
      };
      const auto here = height(0), up = height(kStep), down = height(-kStep),
                 up2 = height(kStep / 2), down2 = height(-kStep / 2);
      const auto found = values_of<double>(program(), d->shade.gradient[direction],
                                           d->shade.function, exact, kLanes)[0];
      int compared = 0;
      for (std::size_t i = 1; i < kLanes; ++i) {  // lane 0 is no random point: it may be on a kink
        const double coarse = (up[i] - down[i]) / (2 * kStep), fine = (up2[i] - down2[i]) / kStep;
        const double unit = std::fabs(here[i]) + std::fabs(fine) + 1e-12;
        if (!(std::fabs(coarse - fine) <= 0.5 * kTolerance * unit)) continue;
        ++compared;
        if (!(std::fabs(found[i] - fine) <= kTolerance * unit))
          return out_.failures.push_back(fmt::format(
              "gradient[{}] of {} is {}, differences give {}", direction, o.name, found[i], fine));
      }
      if (compared < kLanes / 2)
        out_.failures.push_back(fmt::format(
            "gradient[{}] of {} could be compared at {} points only", direction, o.name, compared));
    }
  }

  Expectations e_;
  Outcome& out_;
  lang::LinkOptions options_;
  Compiled compiled_;
  std::optional<vm::Executable> executable_;
};

/// How a difference between two runs is reported; empty if there is none.
std::string difference(const Run& a, const Run& b, int first_lane, int lanes) {
  if (a.values.size() != b.values.size()) return "another number of results";
  for (std::size_t k = 0; k < a.values.size(); ++k)
    for (int i = 0; i < lanes; ++i) {
      const double x = a.values[k][static_cast<std::size_t>(first_lane + i)],
                   y = b.values[k][static_cast<std::size_t>(i)];
      if (!same_bits(x, y))
        return fmt::format("slot {} of lane {}: {} or {}", k, first_lane + i, x, y);
    }
  return "";
}

}  // namespace

/// Lanes of the largest batch that is compared; scripts that recurse for ever run in each of them.
constexpr int kMostLanes = kSanitized ? 16 : 256;

namespace {

/// The program of a script in another shape; its values are those of O2.
struct Variant {
  std::string how;
  vm::Program program;
  bool always = true;  ///< also where a run takes a million steps in each lane
};

/// Empty if one of them does not link, which is added to `failures`.
std::vector<Variant> variants_of(const lang::SourcePtr& source, const lang::LinkOptions& options,
                                 std::vector<std::string>& failures) {
  std::vector<Variant> all;
  for (Level level : {Level::O2, Level::O1, Level::O0}) {
    lang::LinkOptions o = options;
    o.level = level;
    Compiled c = compile(source, o);
    if (!c.linked) {
      failures.push_back("it links at some levels only");
      return {};
    }
    if (const auto fault = vm::verify(c.linked->program)) {
      failures.push_back("a level does not verify: " + fault->what + " in " + fault->function);
      return {};
    }
    const std::string name = fmt::format("O2 and O{}", static_cast<int>(level));
    vm::Program stored = reloaded(*c.linked, failures);
    all.push_back({name, std::move(c.linked->program), level != Level::O1});
    all.push_back({name + ", stored and loaded", std::move(stored), false});
  }
  return all;
}

}  // namespace

void check_agreement(const lang::SourcePtr& source, const lang::LinkOptions& options, double near,
                     std::vector<std::string>& failures) {
  const std::vector<Variant> variants = variants_of(source, options, failures);
  if (variants.empty()) return;
  const vm::Program& best = variants[0].program;
  struct Ready {
    vm::Executable executable;
    std::vector<Point> points;
  };
  std::vector<Ready> ready;
  for (const Variant& v : variants)
    ready.push_back({vm::Executable(v.program), points_of(v.program)});
  const vm::Executable& executable = ready[0].executable;
  const std::vector<Point>& all = ready[0].points;
  const int width = std::min(executable.width(), kMostLanes);
  auto in = points<float>(width);
  auto in64 = points<double>(width);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Run whole = evaluate(best, executable, all[k], in, width);
    auto report = [&](const std::string& what, const std::string& how) {
      if (!what.empty()) failures.push_back(fmt::format("{}: {} ({})", all[k].name, what, how));
    };
    const bool slow = !whole.faults.empty();  // a million steps in each lane
    for (std::size_t v = 1; v < variants.size(); ++v) {
      const vm::Program& p = variants[v].program;
      if (slow && !variants[v].always) continue;
      const Run other = evaluate(p, ready[v].executable, ready[v].points[k], in, width);
      report(difference(whole, other, 0, width), variants[v].how);
      if (other.faults.size() != whole.faults.size()) report("other faults", variants[v].how);
    }
    if (!slow)
      report(difference(whole, evaluate(best, executable, all[k], in, width, vm::Isa::Baseline), 0,
                        width),
             "both builds of the machine");
    report(difference(whole, evaluate(best, executable, all[k], in, 13), 0, 13), "13 lanes");
    for (int lane : {0, 1, 2, width - 1}) {
      auto one = alone(in, lane);
      report(difference(whole, evaluate(best, executable, all[k], one, 1), lane, 1), "one lane");
      if (slow) break;
    }
    if (slow || std::isinf(near)) continue;
    const Run exact = evaluate(best, executable, all[k], in64, width);
    for (std::size_t s = 0; s < whole.values.size(); ++s)
      for (std::size_t i = 0; i < whole.values[s].size(); ++i) {
        const double f = whole.values[s][i], d = exact.values[s][i];
        if (same_bits(f, d) || std::fabs(f - d) <= near * std::max(1.0, std::fabs(d))) continue;
        report(fmt::format("slot {} of lane {}: float {}, double {}", s, i, f, d),
               "the two machines");
        i = whole.values[s].size() - 1;
      }
  }
}

Outcome examine(const lang::SourcePtr& source) {
  Outcome outcome;
  Examination e(source, outcome);
  e.messages();
  e.values();
  return outcome;
}

}  // namespace mms::golden
