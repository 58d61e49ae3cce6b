// SPDX-License-Identifier: Apache-2.0
// Handles on several threads: parsing in parallel, one program shared, two programs interleaved.
#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "linked.h"

namespace {

using mms::api::Linked;

constexpr std::size_t kCount = 700;  // more than a batch, and no multiple of one

std::string script(int k) {
  return "const k = " + std::to_string(k) +
         ";\n"
         "real f(real x, integer n) = select x, if n <= 0; f(sin(x) + k, n - 1) otherwise end;\n"
         "surface s\n  bsdf = matte(fract(f($position[0], k)));\n"
         "  height = f($position[1], integer(4 * $uv[0])) + perlin(k * $position);\nend\n";
}

/// Height and albedo of `s` at kCount points, as one array.
std::vector<float> values(MMsContext* context, const MMsSurface* s) {
  std::vector<float> position(3 * kCount), uv(2 * kCount), out(2 * kCount), f(8 * kCount),
      up(3 * kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    position[i] = 0.01f * static_cast<float>(i);
    position[kCount + i] = std::sin(static_cast<float>(i));
    uv[i] = static_cast<float>(i % 7) / 7;
    up[2 * kCount + i] = 1;
  }
  const MMsInput inputs[] = {{"position", position.data()}, {"uv", uv.data()}};
  const MMsPoints points{kCount, inputs, 2};
  if (!mmsEvalSurface(context, s, "height", &points, out.data()) ||
      !mmsEvalBsdf(context, s, &points, up.data(), up.data(), f.data()))
    return {};
  std::copy_n(f.begin(), kCount, out.begin() + kCount);
  return out;
}

template <class Work>
void on_threads(int count, Work work) {
  std::vector<std::thread> threads;
  for (int t = 0; t < count; ++t) threads.emplace_back(work, t);
  for (std::thread& t : threads) t.join();
}

}  // namespace

TEST_CASE("scripts are parsed, linked and run in parallel as they are alone") {
  constexpr int kThreads = 4;
  std::vector<std::vector<float>> alone, together(kThreads);
  for (int t = 0; t < kThreads; ++t) {
    const Linked linked(script(t));
    REQUIRE_MESSAGE(linked.context, linked.log);
    alone.push_back(values(linked.context, mmsGetSurface(linked.program, "s")));
    REQUIRE(alone.back().size() == 2 * kCount);
  }
  CHECK(alone[0] != alone[1]);
  on_threads(kThreads, [&](int t) {
    for (int again = 0; again < 5; ++again) {
      const Linked linked(script(t));
      if (linked.context)
        together[static_cast<std::size_t>(t)] =
            values(linked.context, mmsGetSurface(linked.program, "s"));
    }
  });
  CHECK(together == alone);
}

TEST_CASE("one program is shared, with a context for each thread") {
  const Linked linked(script(3));
  REQUIRE_MESSAGE(linked.context, linked.log);
  const MMsSurface* s = mmsGetSurface(linked.program, "s");
  const std::vector<float> alone = values(linked.context, s);
  std::vector<std::vector<float>> all(4);
  on_threads(4, [&](int t) {
    MMsContext* context = mmsMkContext(static_cast<const MMsProgram*>(linked.program));
    for (int again = 0; again < 5; ++again) all[static_cast<std::size_t>(t)] = values(context, s);
    mmsDeleteContext(context);
  });
  for (const auto& one : all) CHECK(one == alone);
}

TEST_CASE("two programs on two threads, interleaved, are each as it is alone") {
  std::vector<std::vector<float>> alone;
  for (int k : {1, 2}) {
    const Linked linked(script(k));
    REQUIRE_MESSAGE(linked.context, linked.log);
    alone.push_back(values(linked.context, mmsGetSurface(linked.program, "s")));
  }
  const Linked one(script(1)), two(script(2));
  const Linked* both[] = {&one, &two};
  int wrong[2] = {};
  on_threads(2, [&](int t) {
    MMsContext* contexts[] = {mmsMkContext(one.program), mmsMkContext(two.program)};
    for (int step = 0; step < 10; ++step) {
      const auto k = static_cast<std::size_t>((step + t) % 2);  // the other one each time
      wrong[t] += values(contexts[k], mmsGetSurface(both[k]->program, "s")) != alone[k];
      const Linked again(script(static_cast<int>(2 - k)));  // another is linked meanwhile
      wrong[t] += !again.context;
    }
    mmsDeleteContext(contexts[0]);
    mmsDeleteContext(contexts[1]);
  });
  CHECK(wrong[0] == 0);
  CHECK(wrong[1] == 0);
}

TEST_CASE("a context stays with the link it was made for") {
  const Linked linked(script(1));
  REQUIRE_MESSAGE(linked.context, linked.log);
  const std::vector<float> before = values(linked.context, mmsGetSurface(linked.program, "s"));
  REQUIRE(mmsLinkProgram(linked.program, 0));
  const MMsSurface* s = mmsGetSurface(linked.program, "s");
  CHECK(values(linked.context, s).empty());
  CHECK(std::string(mmsGetContextLog(linked.context)).find("another link") != std::string::npos);
  MMsContext* context = mmsMkContext(linked.program);
  CHECK(values(context, s) == before);
  mmsDeleteContext(context);
  const Linked other(script(2));
  CHECK(values(linked.context, mmsGetSurface(other.program, "s")).empty());
}
