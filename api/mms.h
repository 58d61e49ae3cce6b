/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MMS_H
#define MMS_H

/**
 * \file
 * mms for other programs: parse scripts, link them, and evaluate surfaces and volumes over arrays
 * of points. C and C++; the names are those of the thesis (Algorithm 6.2). docs/embedding.md shows
 * how to build with it.
 *
 * Handles are opaque, and each is deleted by its own function; surfaces and volumes belong to
 * their program. Functions that can fail return 1, or 0 and leave the reason in the log of the
 * handle; those that make something return NULL when there is no memory. No exception leaves this
 * interface. A null handle fails quietly.
 *
 * Threads: different handles may be used at the same time, so graphs are parsed in parallel. A
 * linked program is immutable and may be shared; every thread needs a context of its own. Programs
 * know nothing of each other.
 *
 * Strings that are given are copied; those that are returned belong to the handle and live until
 * the next call that changes it.
 *
 * Arrays are the host's, and hold component after component: value `c` of point `i` is at
 * `[c * count + i]`.
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

/** The version of the library that runs, as "0.1.0". */
const char* mmsGetVersion(void);

/** Is told each message, as text for people, when it arises; on the thread of the call. It must not
 *  use the handle. */
enum { MMS_ERROR = 0, MMS_WARNING = 1 };
typedef void (*MMsLog)(void* user, int severity, const char* message);

/* ---- Scripts ---- */

MMsGraph* mmsMkGraph(void);
void mmsDeleteGraph(MMsGraph* graph);

/** Parses a script in place of what the graph held. Checks syntax only. Messages call a string
 *  `<string>`, or by the name that is given; imports are relative to the folder of that name. */
int mmsParseString(MMsGraph* graph, const char* script);
int mmsParseNamed(MMsGraph* graph, const char* name, const char* script);
int mmsParseFile(MMsGraph* graph, const char* path);

/** Messages of the last parse, as text for people; empty if there were none. The string lives
 *  until the next call with this graph. */
const char* mmsGetGraphLog(const MMsGraph* graph);

/** Tells `log` every message of parsing from now on; NULL tells nobody. */
void mmsSetGraphLog(MMsGraph* graph, MMsLog log, void* user);

/* ---- Programs ---- */

MMsProgram* mmsMkProgram(void);
void mmsDeleteProgram(MMsProgram* program);

/** Adds a copy of the graph, which may be deleted after. Fails if it did not parse. */
int mmsAddGraph(MMsProgram* program, const MMsGraph* graph);

/** Finds `written`, which the script called `importer` imports: returns its text, or NULL where
 * there is no such thing (modules of the library are then looked for). `*name`, which is `written`
 * before, may be set to what the text is to be called in messages and as an importer itself; texts
 * of one name are imported once. Both strings must live until the next call, or until the link
 * returns. */
typedef const char* (*MMsResolve)(void* user, const char* importer, const char* written,
                                  const char** name);

/** Takes imports from the host's own storage: no file is read any more. NULL: from files again. */
void mmsSetResolver(MMsProgram* program, MMsResolve resolve, void* user);

/** A folder to look for imports in, after the script's own. */
int mmsAddImportPath(MMsProgram* program, const char* folder);

/** How images are read from the next link on: all of them together keep at most so many megabytes
 *  of decoded pieces in memory, from 1 to 2^30 (1024 at first); one that cannot be read fails the
 *  link, or, where `missing_is_magenta`, is a warning and magenta. Images are looked for where
 *  imports are, always as files; what reads them is `mms_images.so`, which is loaded when the first
 *  one is named. */
int mmsSetImages(MMsProgram* program, double megabytes, int missing_is_magenta);

/** The value of a `param` from the next link on, an expression in the language. */
int mmsSetParam(MMsProgram* program, const char* name, const char* expression);

/** Links all that was added, at level 0, 1 or 2 (which never change a value). After this nothing
 *  about names or types can fail. Linking again, with other params say, deletes the surfaces and
 *  volumes of before; contexts of before take no new ones. */
int mmsLinkProgram(MMsProgram* program, int level);

/** Messages of the last link, warnings too. */
const char* mmsGetProgramLog(const MMsProgram* program);

/** Tells `log` every message of linking from now on; NULL tells nobody. */
void mmsSetProgramLog(MMsProgram* program, MMsLog log, void* user);

/** The descriptor of that name, or NULL. */
MMsSurface* mmsGetSurface(MMsProgram* program, const char* name);
MMsVolume* mmsGetVolume(MMsProgram* program, const char* name);

/* ---- What a linked program knows about itself ----
 * Lists are walked by index until the function returns 0 or NULL. */

typedef struct MMsParamInfo {
  const char* name;
  const char* type;  /* in the language's syntax */
  const char* label; /* this, unit, page and doc are empty where the script says nothing */
  const char* unit;
  const char* page;
  const char* doc;
  size_t value_count; /* numbers of the value, 3 for a real[3] */
  const double* values;
  int has_range;
  double lower, upper;
} MMsParamInfo;

int mmsGetParam(const MMsProgram* program, size_t index, MMsParamInfo* info);

const char* mmsGetSurfaceName(const MMsProgram* program, size_t index);
const char* mmsGetVolumeName(const MMsProgram* program, size_t index);

/** Names of everything that was imported, the library's modules aside. */
const char* mmsGetImport(const MMsProgram* program, size_t index);

typedef struct MMsOutputInfo {
  int stated;             /* the author wrote it (or it was derived: `gradient` from `height`) */
  int constant;           /* the same at every point */
  int spectral;           /* depends on the wavelength */
  unsigned int variables; /* bit k: it reads mmsGetVariableName(k) */
} MMsOutputInfo;

/** Fails if there is no output of that name. */
int mmsGetSurfaceOutput(const MMsSurface* surface, const char* output, MMsOutputInfo* info);
int mmsGetVolumeOutput(const MMsVolume* volume, const char* output, MMsOutputInfo* info);

const char* mmsGetVariableName(size_t index);

/** A constant of the script, or a function without arguments. */
typedef struct MMsValueInfo {
  const char* name;
  const char* type; /* in the language's syntax */
  size_t size;      /* numbers for each point: 3 for a real[3], 8 for a spectrum, 2 for a complex */
} MMsValueInfo;

int mmsGetValue(const MMsProgram* program, size_t index, MMsValueInfo* info);

/** Numbers for each point of a variable, which is named without the `$`: 0 if there is none. */
size_t mmsGetVariableSize(const char* name);

/** Numbers for each point of an output: 1 for `height` and `bound`, 2 for `gradient`, 8 for
 *  `scattering`, `absorption` and `emission`; 0 for materials and unknown names. */
size_t mmsGetOutputSize(const char* output);

/* ---- Evaluation ---- */

/** A `$variable` at each point: `{"position", lanes}`. Values are in SI units, wavelengths too. */
typedef struct MMsInput {
  const char* name;    /* without the `$` */
  const float* values; /* mmsGetVariableSize(name) * count numbers */
} MMsInput;

/** Points, and what is known of them. Variables that are not given have the values of the north
 *  pole of the unit sphere seen from above, and wavelengths 400, 450, ... 750 nm. A `gradient` that
 *  is derived from `height` also wants to know how variables change for a unit step along the
 *  tangents: `object_tangent`, `object_bitangent`, `normal_tangent`, `normal_bitangent` (3 numbers
 *  each), `uv_tangent`, `uv_bitangent` (2 each). */
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

/** Evaluates an output that is made of numbers; `values` takes size * count of them. */
int mmsEvalSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                   const MMsPoints* points, float* values);
int mmsEvalVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                  const MMsPoints* points, float* values);

/** Evaluates a constant of the script or a function without arguments; `values` takes size * count
 *  numbers (MMsValueInfo), `logic` as 0 and 1. */
int mmsEvalValue(MMsContext* context, const char* name, const MMsPoints* points, float* values);

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

/* The `phase` of a volume, as above, but: directions are in world space and point away from the
 * point, there is no cosine (a sample contributes f / pdf[0]), and nothing is specular. */

int mmsEvalPhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                 const float* wo, const float* wi, float* f);
int mmsPdfPhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                const float* wo, const float* wi, float* pdf);
int mmsSamplePhase(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                   const float* wo, const float* u, float* wi, float* f, float* pdf,
                   unsigned char* flags);

/* The `emission_function`: what the `emission` is multiplied by towards `w`, a unit vector in the
 * local frame (of a volume: in world space). 1 everywhere for an even emitter, on its front only if
 * it is a surface. `shape` takes 8 * count numbers. */

int mmsEvalSurfaceEmission(MMsContext* context, const MMsSurface* surface, const MMsPoints* points,
                           const float* w, float* shape);
int mmsEvalVolumeEmission(MMsContext* context, const MMsVolume* volume, const MMsPoints* points,
                          const float* w, float* shape);

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
