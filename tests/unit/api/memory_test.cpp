// SPDX-License-Identifier: Apache-2.0
// Whatever allocation fails, a call of mms.h returns, says so in its log, and the handle can be
// deleted. The operators of this executable count, and fail at the one that a test names.
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "api/mms.h"
#include "tests/sanitized.h"

namespace {

thread_local long left = -1;        // allocations until one fails; negative: none does
thread_local bool goes_on = false;  // all after it fail as well
thread_local bool failed = false;

void* allocate(std::size_t size, std::size_t alignment) {
  if (left == 0) {
    failed = true;
    if (!goes_on) left = -1;
    throw std::bad_alloc();
  }
  if (left > 0) --left;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* p = alignment <= alignof(std::max_align_t) ? std::malloc(size ? size : 1)
                                                   : std::aligned_alloc(alignment, rounded);
  if (!p) throw std::bad_alloc();
  return p;
}

void* allocate_or_null(std::size_t size) noexcept {
  try {
    return allocate(size, 1);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate_or_null(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate_or_null(size);
}
void* operator new(std::size_t size) { return allocate(size, 1); }
void* operator new[](std::size_t size) { return allocate(size, 1); }
void* operator new(std::size_t size, std::align_val_t a) { return allocate(size, std::size_t(a)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace {

const char kScript[] =
    "param real k = 1;\n"
    "real f(real x, integer n) = select x, if n <= 0; f(x * 0.5, n - 1) otherwise end;\n"
    "surface s\n"
    "  bsdf = mix(matte(f($uv[0], 2)), mirror(), 0.5);\n"
    "  height = f($position[0], integer($position[1])) * k;\n"
    "end\n";

/// Everything a host does, with one allocation that fails. True if it all went well; each step
/// that did not must have said so.
bool session() {
  const float up[3] = {0, 0, 1};
  float height = 0, f[8], gradient[2];
  const MMsPoints points{1, nullptr, 0};
  bool good = true;
  auto step = [&](int done, const char* log) {
    if (!done) CHECK(std::string_view(log) == "out of memory");
    return good = good && done;
  };
  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();
  MMsContext* context = nullptr;
  good = graph && program;
  if (good && step(mmsParseString(graph, kScript), mmsGetGraphLog(graph)) &&
      step(mmsAddGraph(program, graph), mmsGetProgramLog(program)) &&
      step(mmsSetParam(program, "k", "2"), mmsGetProgramLog(program)) &&
      step(mmsLinkProgram(program, 2), mmsGetProgramLog(program))) {
    context = mmsMkContext(program);
    const MMsSurface* s = mmsGetSurface(program, "s");
    CHECK(s);
    good = context != nullptr;
    if (good &&
        step(mmsEvalSurface(context, s, "height", &points, &height), mmsGetContextLog(context)) &&
        step(mmsEvalSurface(context, s, "gradient", &points, gradient), mmsGetContextLog(context)))
      step(mmsEvalBsdf(context, s, &points, up, up, f), mmsGetContextLog(context));
  }
  mmsDeleteContext(context);
  mmsDeleteProgram(program);
  mmsDeleteGraph(graph);
  return good;
}

/// The number of allocations of one session, and of sessions that were tried.
long try_all(bool all_after) {
  long tried = 0;
  // Every allocation at first, then one in every twentieth of the way.
  for (long k = 0;; k += 1 + k / (mms::kSanitized ? 8 : 20)) {
    left = k;
    goes_on = all_after;
    failed = false;
    const bool good = session();
    left = -1;
    ++tried;
    if (!failed) {
      CHECK(good);
      return tried;
    }
  }
}

}  // namespace

TEST_CASE("an allocation that fails is a 0 and a log, wherever it is") {
  REQUIRE(session());
  CHECK(try_all(false) > 50);
}

TEST_CASE("and when no allocation succeeds any more") { CHECK(try_all(true) > 50); }
