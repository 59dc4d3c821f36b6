/* Errors of the GL driver: counted and printed, so that tests can require zero errors. Messages of the
   shader compiler do not count: program_create returns them to its caller. */
#ifndef SIM_GPU_GL_CONTEXT_H
#define SIM_GPU_GL_CONTEXT_H

#include "sim/base/memory.h"
#include "slosh/def.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stdint.h>

/* Listens to the current context from now on. */
void gl_debug_install(void);

/* Takes pending glGetError codes. Returns the number of codes equal to `code`, or of all codes if `code` is
   0, for the caller to handle. The rest count as errors. */
int gl_errors_take(unsigned code);

/* While `asks` is true, out-of-memory is no error: callers that allocate buffers check glGetError. */
void gl_debug_asks_for_memory(bool asks);

/* Errors of all contexts since gl_debug_install, with pending glGetError codes of the current context. */
int gl_debug_errors(void);

/* Errors of all contexts since program start; needs no context. */
int gl_debug_total(void);

/* Driver limits that shaders need beyond the guarantees of OpenGL 4.5, checked at start to avoid silent
   empty pictures. */

/* Limits of a driver, or required limits; 0: the guarantee of OpenGL. */
typedef struct GlLimits {
    int compute_blocks; /* storage blocks in a compute shader */
    int vertex_blocks;  /* storage blocks in a vertex shader */
    int bindings;       /* of storage buffers */
    int64_t block_bytes;
} GlLimits;

typedef struct GlNeeds {
    const char *who, *instead; /* "backend compute"; advice if blocks or bindings are missing */
    GlLimits least;            /* 0: no requirement */
} GlNeeds;

/* Needs a current context. */
GlLimits gl_limits(void);

/* Bytes of GPU memory if reported by the driver, otherwise of the machine's memory. Needs a current
   context. */
double gl_memory(void);

/* True if all needs are met; otherwise the error names the driver's limit. */
bool gl_limits_allow(const GlLimits *have, const GlNeeds *needs, Error *error);

/* GL context state changed by a solver's draw passes: saved before and restored after, since the views draw
   in the same context. Texture units and programs are not included: every pass binds its own. */

enum { GL_STATE_CAPABILITIES = 10 };

/* Zero-initialise. */
typedef struct GlState {
    int depth; /* nesting depth of gl_state_keep */
    int framebuffer, vertex_array, viewport[4];
    int clip_origin, clip_depth, depth_function, polygon_mode[2];
    int stencil[7]; /* function, reference, mask, three operations, write mask; of front faces */
    float depth_range[2], point_size;
    unsigned char depth_mask, color_mask[4];
    unsigned char enabled[GL_STATE_CAPABILITIES];
} GlState;

/* Saves the context's state and sets a plain state: tests, blending, culling and similar features off, all
   masks open, depths from 0 to 1, points of a pixel. Nested calls do not query the state again, since
   asynchronous drivers stall on queries. The outermost gl_state_restore restores the state. */
void gl_state_keep(GlState *kept);
void gl_state_restore(GlState *kept);

/* Backends that need GL. */

struct Backend; /* sim/step/backend.h */

extern const struct Backend backend_compute, backend_fragment;

/* Settings of fragment's grid, whose layers hold four particles per cell. */
typedef struct MAY_ALIAS FragmentDef {
    int grid_layers; /* 0: as many as a lattice needs */
    int lost_limit;  /* most particles without a place in the grid, per step */
} FragmentDef;

/* Layers of fragment's grid for a world of the def. */
int fragment_layers(const WorldDef *def);

/* The settings of backend fragment in a def. */
FragmentDef *fragment_def(const WorldDef *def);

/* Adds the GL backends to the list of sim/step/backend.h; call before any scene is read. */
void backends_add(void);

#endif
