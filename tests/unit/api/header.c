/* SPDX-License-Identifier: Apache-2.0 */
/* The header as C, from the outside: makes, links and evaluates a surface without C++. */
#include "api/mms.h"

/* The height of `surface "bump" height = $position[0]; end` at x = 0.25 and 0.5, or 0 and 0. */
int heights_from_c(float* heights);

int heights_from_c(float* heights) {
  static const char script[] = "surface \"bump\" height = $position[0]; end";
  const float position[6] = {0.25f, 0.5f, 0.0f, 0.0f, 1.0f, 1.0f};
  const MMsInput input = {"position", position};
  MMsPoints points;
  int ok = 0;
  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();
  points.count = 2;
  points.inputs = &input;
  points.input_count = 1;
  heights[0] = heights[1] = 0.0f;
  if (mmsParseString(graph, script) && mmsAddGraph(program, graph) && mmsLinkProgram(program, 2)) {
    MMsContext* context = mmsMkContext(program);
    ok = mmsEvalSurface(context, mmsGetSurface(program, "bump"), "height", &points, heights);
    mmsDeleteContext(context);
  }
  mmsDeleteProgram(program);
  mmsDeleteGraph(graph);
  return ok;
}
