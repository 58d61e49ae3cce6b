// SPDX-License-Identifier: Apache-2.0
// Stored programs: the form byte by byte, round trips, and files that are damaged or hostile.
#include "vm/serialise.h"

#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include "generator.h"
#include "harness.h"

namespace mms::vm::test {
namespace {

/// The toys, and two rows of materials.
constexpr std::array kLibrary = [] {
  std::array<Builtin, std::size(kToys) + 2> rows{};
  std::copy(std::begin(kToys), std::end(kToys), rows.begin());
  rows[std::size(kToys)] = {.signature = "material plain(spectrum colour = 1)", .lobe = 7};
  rows[std::size(kToys) + 1] = {.signature = "material both(material a, b, real t)", .lobe = 3};
  return rows;
}();

/// With the rows of `kLibrary`, which are those of the toys.
Program in_library(Program p) {
  for (std::size_t k = 0; k < p.builtins.size(); ++k) p.builtins[k] = &kLibrary[k];
  return p;
}

/// A program with something of everything, all of it different.
Package everything() {
  Assembler a;
  a.program.sources = {"one.mms", "two.mms"};
  a.function("shade", {}, {S, R, R}, {S});
  a.input(Variable::Position, 2).real(0.1).op(Op::AddR).op(Op::Splat).store(0).load(0);
  a.input(Variable::Position, 0).integer(-7).op(Op::RealOfInt).op(Op::LtR).begin({R});
  a.real(1).other().real(2).end();
  a.input(Variable::Position, 1).op(Op::CallBuiltin, kSumAndDifference).op(Op::Return);
  Program& p = a.program;
  p.functions[0].lines[3] = {1, 99};

  Descriptor d;
  d.form = DescriptorForm::Volume;
  d.name = "fog";
  d.line = {1, 12};
  p.constants.push_back({R, 0.25f, 0.25, 0});
  const auto quarter = std::uint32_t(p.constants.size() - 1);
  const ValueSource constant{S, true, quarter}, zeroth{S, false, 0}, second{R, false, 2};
  for (Entry* e : {&d.shade, &d.pass, &d.emit, &d.displace})
    e->scattering = e->absorption = e->emission = constant;
  d.shade.function = 0;
  d.shade.scattering = zeroth;
  d.shade.material.nodes = {{7, {zeroth}, {}}, {7, {constant}, {}}, {3, {second}, {0, 1}}};
  d.emit.emission_material.nodes = {{7, {constant}, {}}};
  d.outputs[0] = {true, false, false, 1u << static_cast<int>(Variable::Position)};
  d.outputs[5] = {false, true, true, 1u << static_cast<int>(Variable::Wavelength)};
  p.descriptors.push_back(d);
  p.exports.push_back({"all", "spectrum", 0});
  p.images.push_back({{"wood.tx", "smart", "repeat", "auto", "R", "raw"}, nullptr});
  return {in_library(p),
          {{"a", "real", "doc", "label", "m", "page", {1, 2.5}, {{0, 3}}},
           {"b", "integer", "", "", "", "", {4}, std::nullopt}},
          {"parts/wood.mms"}};
}

std::vector<std::byte> saved(const Package& p) { return save(p, kLibrary); }

/// What is said of a file that is refused; empty if it is not.
std::string refusal(std::span<const std::byte> file) {
  const auto loaded = load(file, kLibrary);
  return loaded ? "" : loaded.error().what;
}

TEST_CASE("the checksum is CRC-32C") {
  // The check value of the algorithm's published parameters (Castagnoli; RFC 3720 B.4).
  std::vector<std::byte> file(kHeaderBytes);
  for (const char c : std::string_view("123456789")) file.push_back(std::byte(c));
  CHECK(checksum(file) == 0xe3069283u);
}

TEST_CASE("the form is what docs/bytecode.md says, byte by byte") {
  Package p;
  p.program.sources = {"ab"};
  p.program.constants = {{L, 0, -2, 1}};
  const std::vector<std::byte> file = saved(p);
  // Sections in order: instructions, variables, builtins, materials, sources, dependencies, params,
  // constants, block types, functions, descriptors, exports, images.
  const unsigned char contents[] = {
      0, 0, 0, 0, 0,   0, 0, 0, 0,   0,   0, 0, 0, 0, 0, 0,        // names
      1, 0, 0, 0, 2,   0, 0, 0, 'a', 'b',                          // sources
      0, 0, 0, 0, 0,   0, 0, 0,                                    // dependencies, params
      1, 0, 0, 0, 'l', 0, 0, 0, 0,   0,   0, 0, 0, 0, 0, 0, 0xc0,  // a constant: -2.0 in f64
      1, 0, 0, 0,                                                  // and its integer
      0, 0, 0, 0, 0,   0, 0, 0, 0,   0,   0, 0, 0, 0, 0, 0,        // the rest
      0, 0, 0, 0};
  REQUIRE(file.size() == 24 + sizeof contents);
  CHECK(std::memcmp(file.data() + 24, contents, sizeof contents) == 0);
  const unsigned char header[] = {0x89, 'm', 'm', 's', '\r', '\n', 0x1a, '\n', 2, 0, 0, 0};
  CHECK(std::memcmp(file.data(), header, sizeof header) == 0);
  const unsigned char length[] = {24 + sizeof contents, 0, 0, 0, 0, 0, 0, 0};
  CHECK(std::memcmp(file.data() + 16, length, sizeof length) == 0);
}

TEST_CASE("every part of a program comes back") {
  const Package p = everything();
  REQUIRE(fault_text(p.program) == "");
  const std::vector<std::byte> file = saved(p);
  const auto loaded = load(file, kLibrary);
  REQUIRE(loaded);
  CHECK(*loaded == p);
  CHECK(saved(*loaded) == file);
}

TEST_CASE("numbers come back as bits") {
  Package p;
  const std::uint32_t nan32 = 0xffc12345;
  const std::uint64_t nan64 = 0x7ff812345678abcd;
  p.program.constants = {{R, std::bit_cast<float>(nan32), std::bit_cast<double>(nan64), 0},
                         {R, -0.0f, 5e-324, 0},
                         {I, 0, 0, std::numeric_limits<std::int32_t>::min()}};
  const auto loaded = load(saved(p), kLibrary);
  REQUIRE(loaded);
  const std::vector<Constant>& c = loaded->program.constants;
  CHECK(std::bit_cast<std::uint32_t>(c[0].f32) == nan32);
  CHECK(std::bit_cast<std::uint64_t>(c[0].f64) == nan64);
  CHECK(std::signbit(c[1].f32));
  CHECK(c[1].f64 == 5e-324);
  CHECK(c[2].integer == std::numeric_limits<std::int32_t>::min());
}

TEST_CASE("random programs come back, and run as they did") {
  std::set<Op> seen;
  Interpreter<float> machine(16);
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const Program p = in_library(Generator(seed).program(seed % 2));
    for (const Function& f : p.functions)
      for (const Instruction& i : f.code) seen.insert(i.op);
    const std::vector<std::byte> file = saved({p, {}, {}});
    const auto loaded = load(file, kLibrary);
    REQUIRE(loaded);
    CHECK(loaded->program == p);
    CHECK(saved(*loaded) == file);
    const std::vector<Point<float>> points(3, zero_point<float>());
    CHECK(run(machine, Executable(loaded->program), loaded->program, 0, points) ==
          run(machine, Executable(p), p, 0, points));
  }
  CHECK(seen.size() == std::size_t(kOpCount));
}

TEST_CASE("a file that is cut off anywhere, or goes on, is refused") {
  std::vector<std::byte> file = saved(everything());
  for (std::size_t n = 0; n < file.size(); ++n) {
    CAPTURE(n);
    CHECK(refusal(std::span(file).first(n)) != "");
  }
  file.push_back({});
  CHECK(refusal(file) != "");
}

TEST_CASE("a file with any byte changed is refused, where it says") {
  const std::vector<std::byte> file = saved(everything());
  for (std::size_t at = 0; at < file.size(); ++at)
    for (const unsigned flip : {0x01u, 0x10u, 0x80u, 0xffu}) {
      CAPTURE(at);
      std::vector<std::byte> damaged = file;
      damaged[at] ^= std::byte(flip);
      const auto loaded = load(damaged, kLibrary);
      REQUIRE(!loaded);
      CHECK(loaded.error().where.starts_with("byte "));
      CHECK(loaded.error().hint != "");
      if (at >= 12 && (at < 16 || at >= kHeaderBytes))
        CHECK(loaded.error().what == "is damaged: its checksum is another");
    }
}

/// Runs every function without parameters.
void run_all(const Program& p, Interpreter<float>& f32, Interpreter<double>& f64) {
  constexpr RunOptions kOptions{.back_edges = 20};
  const Executable exe(p);
  const InputBatch<float> in32(3);
  const InputBatch<double> in64(3);
  for (std::uint32_t k = 0; k < p.functions.size(); ++k) {
    if (!p.functions[k].params.empty()) continue;
    f32.run(exe, k, in32, 3, kOptions);
    f64.run(exe, k, in64, 3, kOptions);
  }
}

TEST_CASE("a changed file with a right checksum is refused, or sound") {
  const std::vector<std::byte> file = saved(everything());
  Interpreter<float> f32(16);
  Interpreter<double> f64(16);
  int refused = 0, sound = 0;
  for (std::size_t at = kHeaderBytes; at < file.size(); ++at)
    for (const unsigned flip : {0x01u, 0x02u, 0x04u, 0x08u, 0x10u, 0x20u, 0x40u, 0x80u, 0xffu}) {
      CAPTURE(at);
      std::vector<std::byte> changed = file;
      changed[at] ^= std::byte(flip);
      seal(changed);
      const auto loaded = load(changed, kLibrary);
      if (!loaded) {
        ++refused;
        CHECK(loaded.error().what != "");
        continue;
      }
      ++sound;
      REQUIRE(!verify(loaded->program));
      CHECK(load(saved(*loaded), kLibrary));
      run_all(loaded->program, f32, f64);
    }
  CHECK(refused > 1000);
  CHECK(sound > 1000);
}

TEST_CASE("a file that is cut off and sealed is refused") {
  const std::vector<std::byte> file = saved(everything());
  for (std::size_t n = kHeaderBytes; n < file.size(); ++n) {
    std::vector<std::byte> cut(file.begin(), file.begin() + std::ptrdiff_t(n));
    seal(cut);
    CAPTURE(n);
    CHECK(refusal(cut) != "");
  }
}

/// `file` with the text `from`, which occurs in it, replaced by one as long, and sealed.
std::vector<std::byte> renamed(std::vector<std::byte> file, std::string_view from,
                               std::string_view to) {
  const auto* data = reinterpret_cast<const std::byte*>(from.data());
  const auto at = std::search(file.begin(), file.end(), data, data + from.size());
  REQUIRE(at != file.end());
  std::memcpy(&*at, to.data(), to.size());
  seal(file);
  return file;
}

TEST_CASE("what is not there is named") {
  const std::vector<std::byte> file = saved(everything());
  CHECK(refusal(renamed(file, "AddR", "AddX")) == "there is no instruction `AddX` here");
  CHECK(refusal(renamed(file, "$position", "$positron")) ==
        "there is no variable `real[3] $positron` here");
  CHECK(refusal(renamed(file, "real[3] $p", "real[2] $p")) ==
        "there is no variable `real[2] $position` here");
  CHECK(refusal(renamed(file, "real[2] sum", "real[2] SUM")) ==
        "there is no function `real[2] SUM_and_difference(real, real)` here");
  CHECK(refusal(renamed(file, "both(material", "bath(material")) ==
        "there is no material `material bath(material, material, real)` here");
  // A row of another form is not taken for one of that name.
  CHECK(refusal(renamed(file, "material plain(spectrum)", "real scale_and_shift(rea")) != "");
}

TEST_CASE("rows may move in the library") {
  auto moved = kLibrary;
  std::reverse(moved.begin(), moved.end());
  const Package p = everything();
  const auto loaded = load(saved(p), moved);
  REQUIRE(loaded);
  CHECK(loaded->program.builtins[kSumAndDifference] ==
        &moved[moved.size() - 1 - kSumAndDifference]);
  CHECK(save(*loaded, moved) == saved(p));
}

TEST_CASE("a material with other arguments than its row is refused") {
  Package p = everything();
  std::vector<LayoutNode>& nodes = p.program.descriptors[0].shade.material.nodes;
  const auto broken = [&](auto change) {
    const std::vector<LayoutNode> before = nodes;
    change();
    const std::string what = refusal(saved(p));
    nodes = before;
    return what;
  };
  constexpr const char* kOther = "a material has other arguments than its row";
  CHECK(broken([&] { nodes[0].params.clear(); }) == kOther);
  CHECK(broken([&] { nodes[0].params.push_back(nodes[0].params[0]); }) == kOther);
  CHECK(broken([&] { nodes[2].params = nodes[0].params; }) == kOther);
  CHECK(broken([&] { nodes[2].children.pop_back(); }) == kOther);
  CHECK(broken([] {}) == "");
}

TEST_CASE("another format is refused with both numbers") {
  std::vector<std::byte> file = saved(everything());
  file[8] = std::byte(kFormat + 1);
  CHECK(refusal(file) == "has format 3; this build reads format 2");
}

TEST_CASE("a count is believed only as far as the file goes") {
  for (std::size_t section = 0; section < 13; ++section) {
    CAPTURE(section);
    std::vector<std::byte> file = saved({});
    REQUIRE(file.size() == kHeaderBytes + 13 * 4);
    for (std::size_t k = 0; k < 4; ++k) file[kHeaderBytes + 4 * section + k] = std::byte(0xff);
    seal(file);
    CHECK(refusal(file) == "a count is larger than the file");
  }
}

TEST_CASE("a file that is too large is not read") {
  const std::vector<std::byte> file(kFileBytes + 1);
  CHECK(refusal(file) == "is larger than 67108864 bytes");
}

TEST_CASE("what is no program at all is told so") {
  const std::string text = "surface \"plain\" bsdf = matte(0.5); end";
  CHECK(refusal(std::as_bytes(std::span(text))) == "is no compiled program");
  CHECK(refusal({}) == "is no compiled program");
}

TEST_CASE("a program that does not verify is refused") {
  Package p = everything();
  p.program.functions[0].code.pop_back();
  p.program.functions[0].lines.pop_back();
  CHECK(refusal(saved(p)).starts_with("would not run safely: "));
}

}  // namespace
}  // namespace mms::vm::test
