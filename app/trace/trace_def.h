/* Choice of trails for a file: keys with the names of the overlay trails, in one line of text. */
#ifndef SLOSH_TRACE_DEF_H
#define SLOSH_TRACE_DEF_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

enum { TRACE_IDS_MAX = 256, TRACE_IDS_SIZE = 2048 };

typedef struct TraceDef {
    int stride;                             /* one of `stride` ids has a trail */
    double length;                          /* s, back from the end; 0: from the file's first step */
    double every;                           /* least time between points, s; 0: each step */
    double region_min[3], region_max[3];    /* m, box's frame: only particles first seen inside; equal: all */
    double plane_point[3], plane_normal[3]; /* only particles crossing the plane; normal 0: all */
    char ids[TRACE_IDS_SIZE];               /* "3 17 250": only these ids; "all": by stride */
    int64_t id[TRACE_IDS_MAX];              /* of `ids`, ascending */
    int id_count;                           /* 0: all */
} TraceDef;

/* Reads "{stride: 20, length: 2}"; all keys are optional. Returns false with advice. */
bool trace_def_read(TraceDef *def, const char *text, Error *error);

/* True if a particle with the id may have a trail. */
bool trace_def_takes(const TraceDef *def, int64_t id);

/* True if trails are limited to a plane's crossings, or to a region. */
bool trace_def_has_plane(const TraceDef *def);
bool trace_def_has_region(const TraceDef *def);

#endif
