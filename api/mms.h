/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MMS_H
#define MMS_H

/**
 * \file
 * mms for other programs: parse scripts, link them, and evaluate surfaces and volumes over arrays
 * of points. C and C++; the names are those of the thesis (Algorithm 6.2).
 *
 * Handles are opaque, and each is deleted by its own function; surfaces and volumes belong to
 * their program. Functions that can fail return 1, or 0 and leave the reason in the log of the
 * handle; those that make something return NULL when there is no memory. No exception leaves this
 * interface. A null handle fails quietly.
 *
 * Threads: different graphs may be parsed at the same time. A linked program is immutable and may
 * be shared; every thread needs a context of its own.
 *
 * Arrays hold component after component: value `c` of point `i` is at `[c * count + i]`.
 */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct MMsGraph MMsGraph;     /* the syntax of one script */
typedef struct MMsProgram MMsProgram; /* scripts linked together */
typedef struct MMsSurface MMsSurface; /* a `surface` of a program, which owns it */
typedef struct MMsVolume MMsVolume;   /* a `volume` of a program, which owns it */
typedef struct MMsContext MMsContext; /* one thread's scratch for evaluation */

/** Wavelengths of a spectrum. */
#define MMS_WAVELENGTHS 8

/* ---- Scripts ---- */

MMsGraph* mmsMkGraph(void);
void mmsDeleteGraph(MMsGraph* graph);

/** Parses a script in place of what the graph held. Checks syntax only. */
int mmsParseString(MMsGraph* graph, const char* script);
int mmsParseFile(MMsGraph* graph, const char* path);

/** Messages of the last parse, as text for people; empty if there were none. The string lives
 *  until the next call with this graph. */
const char* mmsGetGraphLog(const MMsGraph* graph);

/* ---- Programs ---- */

MMsProgram* mmsMkProgram(void);
void mmsDeleteProgram(MMsProgram* program);

/** Adds a copy of the graph, which may be deleted after. Fails if it did not parse. */
int mmsAddGraph(MMsProgram* program, const MMsGraph* graph);

/** A folder to look for imports in, and the value of a `param`, an expression in the language. */
int mmsAddImportPath(MMsProgram* program, const char* folder);
int mmsSetParam(MMsProgram* program, const char* name, const char* expression);

/** Links all that was added, at level 0, 1 or 2 (which never change a value). After this nothing
 *  about names or types can fail. Linking again deletes the surfaces and volumes of before, and
 *  contexts of before must not be used any more. */
int mmsLinkProgram(MMsProgram* program, int level);

/** Messages of the last link, warnings too. */
const char* mmsGetProgramLog(const MMsProgram* program);

/** The descriptor of that name, or NULL. */
MMsSurface* mmsGetSurface(MMsProgram* program, const char* name);
MMsVolume* mmsGetVolume(MMsProgram* program, const char* name);

/* ---- Evaluation ---- */

/** A `$variable` at each point: `{"position", lanes}`. Values are in SI units, wavelengths too. */
typedef struct MMsInput {
  const char* name;    /* without the `$` */
  const float* values; /* 3 * count numbers for a real[3], 8 * count for `wavelength` */
} MMsInput;

/** Points, and what is known of them. Variables that are not given have the values of the north
 *  pole of the unit sphere seen from above, and wavelengths 400, 450, ... 750 nm. */
typedef struct MMsPoints {
  size_t count;
  const MMsInput* inputs;
  size_t input_count;
} MMsPoints;

/** Scratch for a linked program, which must outlive it; NULL if it is not linked. */
MMsContext* mmsMkContext(const MMsProgram* program);
void mmsDeleteContext(MMsContext* context);

/** Why the last evaluation failed; or, if points ran out of their budget of steps (their values
 *  are 0 then), how many, and at which line. Else empty. */
const char* mmsGetContextLog(const MMsContext* context);

/** Numbers for each point of an output: 1 for `height` and `bound`, 2 for `gradient`, 8 for
 *  `scattering`, `absorption` and `emission`; 0 for materials and unknown names. */
size_t mmsGetOutputSize(const char* output);

/** Evaluates an output that is made of numbers; `values` takes size * count of them. */
int mmsEvalSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                   const MMsPoints* points, float* values);
int mmsEvalVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                  const MMsPoints* points, float* values);

/* The `bsdf` of a surface. Directions are unit vectors in the local frame (z is the normal) that
 * point away from the surface: 3 * count numbers. `f` is per steradian, without the cosine; `pdf`
 * is per steradian, for each wavelength as the one that the direction was drawn for. Both take
 * 8 * count numbers. Ideal specular parts are seen by mmsSampleBsdf alone. */

int mmsEvalBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                const float* wo, const float* wi, float* f);
int mmsPdfBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
               const float* wo, const float* wi, float* pdf);

enum {
  MMS_SAMPLED = 1,    /* there is a direction; else nothing scatters and f, pdf, wi are 0 */
  MMS_SPECULAR = 2,   /* of an ideal specular part: f and pdf share one delta */
  MMS_TRANSMITTED = 4 /* to the other side */
};

/** Draws `wi` from three numbers in [0, 1) for each point (`u`, 3 * count). The contribution is
 *  f |wi.z| / pdf[0]. `flags` takes `count` values of the enumeration above. */
int mmsSampleBsdf(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                  const float* wo, const float* u, float* wi, float* f, float* pdf,
                  unsigned char* flags);

/* ---- Guaranteed bounds ---- */

/** All points at which a `$variable` lies between `lo` and `hi`: 3 numbers each for a real[3], one
 *  for `wavelength` (metres). */
typedef struct MMsInterval {
  const char* name; /* without the `$` */
  const float *lo, *hi;
} MMsInterval;

/** Encloses an output that is made of numbers over a box: no point in it has a value outside
 *  [lo, hi], in float or in double. Variables that are not given have the values of the unit sphere
 *  and the box around it; wavelengths are 360 to 830 nm. One pair for `height`, `bound` and spectra
 *  (all wavelengths), two for `gradient`; infinite ends, or all of it where a value may be NaN,
 *  say that nothing is known. `grid`: parts that positions are cut into along each axis, for
 *  tighter bounds; 1 is the box itself. */
int mmsBoundSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                    const MMsInterval* box, size_t box_count, int grid, float* lo, float* hi);
int mmsBoundVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                   const MMsInterval* box, size_t box_count, int grid, float* lo, float* hi);

#ifdef __cplusplus
} /* extern "C" */

#include <string>

namespace mms {

enum { O0, O1, O2 };

using Surface = ::MMsSurface;
using Volume = ::MMsVolume;

}  // namespace mms

using mms::Surface;
using mms::Volume;

inline bool mmsParseString(MMsGraph& graph, const char* script) {
  return mmsParseString(&graph, script) != 0;
}
inline bool mmsParseString(MMsGraph& graph, const std::string& script) {
  return mmsParseString(&graph, script.c_str()) != 0;
}
inline bool mmsParseFile(MMsGraph& graph, const char* path) {
  return mmsParseFile(&graph, path) != 0;
}
inline bool mmsParseFile(MMsGraph& graph, const std::string& path) {
  return mmsParseFile(&graph, path.c_str()) != 0;
}
inline const char* mmsGetGraphLog(const MMsGraph& graph) { return mmsGetGraphLog(&graph); }

inline bool mmsAddGraph(MMsProgram& program, const MMsGraph& graph) {
  return mmsAddGraph(&program, &graph) != 0;
}
inline bool mmsLinkProgram(MMsProgram& program, int level) {
  return mmsLinkProgram(&program, level) != 0;
}
inline const char* mmsGetProgramLog(const MMsProgram& program) {
  return mmsGetProgramLog(&program);
}
inline Surface* mmsGetSurface(MMsProgram& program, const char* name) {
  return mmsGetSurface(&program, name);
}
inline Volume* mmsGetVolume(MMsProgram& program, const char* name) {
  return mmsGetVolume(&program, name);
}
inline MMsContext* mmsMkContext(const MMsProgram& program) { return mmsMkContext(&program); }

#endif

#endif
