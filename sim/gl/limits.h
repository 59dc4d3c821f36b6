/* What shaders need of a driver beyond what OpenGL 4.5 promises, and whether it has that: asked at start, so
   that nobody learns it from an empty picture. */
#ifndef SLOSH_LIMITS_H
#define SLOSH_LIMITS_H

#include "sim/base/error.h"

#include <stdint.h>

/* A driver's, or 0 where OpenGL promises no more. */
typedef struct GlLimits {
    int compute_blocks; /* storage blocks in a compute shader */
    int vertex_blocks;  /* the same in a vertex shader */
    int bindings;       /* of storage buffers */
    int64_t block_bytes;
} GlLimits;

typedef struct GlNeeds {
    const char *who,
        *instead;   /* "backend compute"; what would be right where blocks or bindings are missing */
    GlLimits least; /* 0: none */
} GlNeeds;

/* Needs a current context. */
GlLimits gl_limits(void);

/* Bytes of the GPU's memory where it tells, else of the machine's. Needs a current context. */
double gl_memory(void);

/* Whether there is what is needed; if not, the error says what the driver has. */
bool gl_limits_allow(const GlLimits *have, const GlNeeds *needs, Error *error);

#endif
