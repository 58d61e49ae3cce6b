/* SPDX-License-Identifier: Apache-2.0 */
/* The script of both programs. Ridged noise is 0.5 + 0.25 + ... wherever its lattice is met: at
 * the points below, `scale` times which are whole numbers, the height is known without running it.
 */
#ifndef MARBLE_H
#define MARBLE_H

static const char kMarble[] =
    "import \"palette\";\n"
    "param real scale = 4.0 in [0.1, 20], label = \"Scale\";\n"
    "surface marble\n"
    "  t      = ridged(scale * $object_position, 3) / 2;\n"
    "  bsdf   = matte(mix(bright, dark, smoothstep(0.4, 0.8, t)));\n"
    "  height = 0.01 * t;\n"
    "end\n";

/* What the script imports, from the host's own storage. */
static const char kPalette[] = "const bright = 0.75; const dark = 0.25;\n";

#endif
