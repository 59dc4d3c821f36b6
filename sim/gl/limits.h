/* Driver limits that shaders need beyond the guarantees of OpenGL 4.5, checked at start to avoid silent
   empty pictures. */
#ifndef SLOSH_LIMITS_H
#define SLOSH_LIMITS_H

#include "sim/base/error.h"

#include <stdint.h>

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

#endif
