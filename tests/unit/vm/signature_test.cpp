// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "vm/signature.h"

namespace mms::vm {
namespace {

constexpr SlotType R = SlotType::Real, I = SlotType::Integer, L = SlotType::Logic,
                   S = SlotType::Spectrum;
using Types = std::vector<SlotType>;

TEST_CASE("a signature says which slots go in and come out") {
  const auto s = read_signature("real[2] f(real a, b, integer n = 3, complex z, logic l)");
  REQUIRE(s);
  CHECK(s->key == "real[2] f(real, real, integer, complex, logic)");
  CHECK(s->params == Types{R, R, I, R, R, L});
  CHECK(s->results == Types{R, R});
  CHECK(s->materials == 0);
}

TEST_CASE("commas in sizes and in defaults part no formals") {
  const auto s = read_signature("real f(real[2,2] m, real[3] up = [0, g(1, 2), 0], spectrum c)");
  REQUIRE(s);
  CHECK(s->key == "real f(real[2,2], real[3], spectrum)");
  CHECK(s->params == Types{R, R, R, R, R, R, R, S});
}

TEST_CASE("materials are counted and have no slots") {
  const auto s = read_signature("material mix(material a, b, spectrum t)");
  REQUIRE(s);
  CHECK(s->key == "material mix(material, material, spectrum)");
  CHECK(s->params == Types{S});
  CHECK(s->results.empty());
  CHECK(s->materials == 2);
  CHECK(read_signature("material isotropic()")->params.empty());
}

TEST_CASE("a name that starts as a type does is a name") {
  const auto s = read_signature("real f(real real_part, integers)");
  REQUIRE(s);
  CHECK(s->key == "real f(real, real)");
}

TEST_CASE("what has no slots or no such form is no signature") {
  for (const char* text :
       {"", "f", "real", "real f", "real f(", "f(real x)", "real f(x)", "real f(real)",
        "real f(string s)", "real f(real[] x)", "real f(real[0] x)", "real f(real[-1] x)",
        "real f(real[3 x)", "real[3 f(real x)", "real f(real[4097] x)", "real f(real[4096,4096] x)",
        "real f(real[99999999999] x)", "real f(real x,, real y)"}) {
    CAPTURE(text);
    CHECK(!read_signature(text));
  }
}

}  // namespace
}  // namespace mms::vm
