/* Which trails are wanted of a file: the keys of the overlay trails by the same names, in one line of text.
 */
#ifndef SLOSH_TRACE_DEF_H
#define SLOSH_TRACE_DEF_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stdint.h>

enum { TRACE_IDS_MAX = 256, TRACE_IDS_SIZE = 2048 };

typedef struct TraceDef {
    int stride;                             /* every so many ids has a trail */
    double length;                          /* s, back from the end; 0: from the file's first step on */
    double every;                           /* s between two points, at least; 0: each step */
    double region_min[3], region_max[3];    /* m, box's frame: only what is seen first in there; equal: all */
    double plane_point[3], plane_normal[3]; /* only from where it crosses that plane; a normal of 0: all */
    char ids[TRACE_IDS_SIZE];               /* "3 17 250": only these; "all": by stride */
    int64_t id[TRACE_IDS_MAX];              /* of `ids`, ascending */
    int id_count;                           /* 0: all */
} TraceDef;

/* Reads "{stride: 20, length: 2}", each key of which may be left out; false with what would be right. */
bool trace_def_read(TraceDef *def, const char *text, Error *error);

/* Whether a particle of that id may have a trail. */
bool trace_def_takes(const TraceDef *def, int64_t id);

/* Whether only what crosses a plane, or is in a region, has a trail. */
bool trace_def_has_plane(const TraceDef *def);
bool trace_def_has_region(const TraceDef *def);

#endif
