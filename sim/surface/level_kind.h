/* A kind of field: for the samplers, and for adding kinds (README.md). */
#ifndef SLOSH_LEVEL_KIND_H
#define SLOSH_LEVEL_KIND_H

#include "sim/surface/lanes.h"
#include "sim/surface/level_field.h"

#include <stddef.h>

typedef struct LanePlace { /* m, the box's frame */
    Lanes x, y, z;
} LanePlace;

typedef struct LaneSample { /* as LevelSample */
    Lanes value, x, y, z, bend;
} LaneSample;

/* The field at eight positions. Beyond the field's bounds any finite continuation will do. */
typedef void (*LaneField)(const LevelField *field, const LanePlace *place, LaneSample *out);

typedef struct Walk Walk;
typedef void (*WalkLanes)(const Walk *walk, size_t begin, size_t end);

/* Data of a field for shaders/surface/NAME.glsl besides the position. */
typedef struct LevelParts {
    float number[16];
    struct {
        const void *data; /* NULL: none */
        size_t bytes;
    } array[2];
} LevelParts;

/* The field's function, and walk_lanes (walk.h) with the function inlined: for any processor, and in
   LANES_WIDE functions. */
struct LevelKind {
    const char *name;
    LaneField at[2];
    WalkLanes walk[2];
    void (*parts)(const LevelField *field, LevelParts *out); /* NULL: the field's own numbers */
};

static inline void level_lanes(const LevelField *field, const LanePlace *place, LaneSample *out)
{
    field->kind->at[lanes_wide()](field, place, out);
}

void level_parts(const LevelField *field, LevelParts *out);

#endif
