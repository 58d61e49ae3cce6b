// SPDX-License-Identifier: Apache-2.0
// A C++ program that evaluates a marble on two threads; CMakeLists.txt says how it is built.
// It ends with 0 if the values are those that are stated.
#include <mms.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "marble.h"

struct Delete {
  void operator()(MMsGraph* graph) const { mmsDeleteGraph(graph); }
  void operator()(MMsProgram* program) const { mmsDeleteProgram(program); }
  void operator()(MMsContext* context) const { mmsDeleteContext(context); }
};
using Graph = std::unique_ptr<MMsGraph, Delete>;
using Program = std::unique_ptr<MMsProgram, Delete>;
using Context = std::unique_ptr<MMsContext, Delete>;

/// Heights at the whole numbers 0, 1, ... along x, by a context of this thread's own.
static std::vector<float> heights(const MMsProgram& program, const MMsSurface& marble,
                                  std::size_t count) {
  std::vector<float> position(3 * count), height(count);
  for (std::size_t i = 0; i < count; ++i) position[i] = static_cast<float>(i);
  const MMsInput input{"object_position", position.data()};
  const MMsPoints points{count, &input, 1};
  const Context context(mmsMkContext(program));
  if (!mmsEvalSurface(context.get(), &marble, "height", &points, height.data()))
    std::fputs(mmsGetContextLog(context.get()), stderr);
  return height;
}

int main() {
  const Graph graph(mmsMkGraph()), palette(mmsMkGraph());
  const Program program(mmsMkProgram());
  // A script that was parsed under that name is what an import of it finds.
  if (!mmsParseNamed(palette.get(), "palette", kPalette) || !mmsParseString(*graph, kMarble) ||
      !mmsAddGraph(*program, *palette) || !mmsAddGraph(*program, *graph) ||
      !mmsLinkProgram(*program, mms::O2)) {
    std::fprintf(stderr, "%s%s", mmsGetGraphLog(*graph), mmsGetProgramLog(*program));
    return 1;
  }
  const Surface* marble = mmsGetSurface(*program, "marble");
  if (!marble) return 1;

  std::vector<float> one, two;
  std::thread other([&] { two = heights(*program, *marble, 1000); });
  one = heights(*program, *marble, 500);
  other.join();

  // The noise is 0 at whole numbers: 0.01 (1 + 1/2 + 1/4) / 2; a few roundings of a float.
  int wrong = 0;
  for (const auto* all : {&one, &two})
    for (const float h : *all) wrong += !(std::abs(h - 0.00875) <= 5e-9);
  std::printf("%zu heights, %d of them wrong; mms %s\n", one.size() + two.size(), wrong,
              mmsGetVersion());
  return wrong ? 1 : 0;
}
