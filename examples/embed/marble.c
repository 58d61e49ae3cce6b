/* SPDX-License-Identifier: Apache-2.0 */
/* A C program that evaluates a marble:
 *   cc marble.c $(pkg-config --cflags --libs mms) -o marble -lm
 * It ends with 0 if the values are those that are stated. */
#include <math.h>
#include <mms.h>
#include <stdio.h>
#include <string.h>

#include "marble.h"

static const char* find_import(void* user, const char* importer, const char* written,
                               const char** name) {
  (void)user;
  (void)importer;
  (void)name;
  return strcmp(written, "palette") == 0 ? kPalette : NULL;
}

static void print_message(void* user, int severity, const char* message) {
  fprintf((FILE*)user, "%s from mms: %s", severity == MMS_ERROR ? "error" : "warning", message);
}

static int differs(const char* what, double found, double stated, double tolerance) {
  const int wrong = !(fabs(found - stated) <= tolerance);
  printf("%-8s %.9g, stated %.9g%s\n", what, found, stated, wrong ? "  WRONG" : "");
  return wrong;
}

/* Evaluates two points and compares. The noise is 0 at whole numbers, so t = (1 + 1/2 + 1/4) / 2 =
 * 0.875: the height is 0.00875, the albedo is `dark`, and f is 0.25 / pi. Tolerances: a few
 * roundings of a float, each of 6e-8 of the value. */
static int evaluate(MMsProgram* program) {
  const double pi = 3.14159265358979323846;
  const float position[6] = {0.25f, -1.0f, 0.5f, 2.0f, 0.75f, 0.0f}; /* x, x, y, y, z, z */
  const float up[6] = {0, 0, 0, 0, 1, 1};
  float height[2], f[2 * MMS_WAVELENGTHS];
  const MMsInput input = {"object_position", position};
  const MMsPoints points = {2, &input, 1};
  MMsSurface* marble = mmsGetSurface(program, "marble");
  MMsContext* context = mmsMkContext(program);
  MMsParamInfo param;
  int i, wrong = 0;
  if (!marble || !context) return 1;
  if (!mmsEvalSurface(context, marble, "height", &points, height) ||
      !mmsEvalBsdf(context, marble, &points, up, up, f)) {
    fputs(mmsGetContextLog(context), stderr);
    return 1;
  }
  for (i = 0; i < 2; ++i) wrong += differs("height", height[i], 0.00875, 5e-9);
  for (i = 0; i < 2 * MMS_WAVELENGTHS; ++i) wrong += differs("f", f[i], 0.25 / pi, 1e-7);
  if (!mmsGetParam(program, 0, &param)) return 1;
  wrong += strcmp(param.label, "Scale") != 0;
  wrong += differs(param.name, param.values[0], 4.0, 0) + differs("upper", param.upper, 20.0, 0);
  mmsDeleteContext(context);
  return wrong;
}

int main(void) {
  MMsGraph* graph = mmsMkGraph();
  MMsProgram* program = mmsMkProgram();
  int wrong = 1;
  mmsSetGraphLog(graph, print_message, stderr);
  mmsSetProgramLog(program, print_message, stderr);
  mmsSetResolver(program, find_import, NULL);
  if (mmsParseString(graph, kMarble) && mmsAddGraph(program, graph) && mmsLinkProgram(program, 2))
    wrong = evaluate(program);
  mmsDeleteProgram(program);
  mmsDeleteGraph(graph);
  return wrong ? 1 : 0;
}
