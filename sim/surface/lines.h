/* Crossings of a level by straight lines of all directions. With the motion-invariant measure on lines that
   meet a box, the crossings with a surface inside are uniform in area, and a line has 2 S / (area of the
   box) crossings on average. So crossings give the surface's area, and starts for walks on all parts of the
   surface in proportion. After: L. Santaló, "Integral geometry and geometric probability", 1976, chapter 14
   (Cauchy, Crofton). The lines are a shifted low-discrepancy sequence, so both are more accurate than with
   random lines: M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018. */
#ifndef SLOSH_SURFACE_LINES_H
#define SLOSH_SURFACE_LINES_H

#include "sim/base/error.h"
#include "sim/surface/level_field.h"
#include "sim/surface/philox.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct LineSearch {
    const LevelField *field;
    double level;
    double low[3], high[3]; /* m: the box */
    PhiloxKey key;
    int threads;
} LineSearch;

typedef struct Crossings {
    size_t count;
    float (*place)[3];      /* m; in the lines' order: the first n are as uniform as the whole */
    double low[3], high[3]; /* m: extent of the crossings */
    double area;            /* m2: of the surface */
    size_t lines;
} Crossings;

/* Follows some thousand lines. Returns false with the reason if no line crosses the level, the field is not
   finite somewhere, or its march is too fine for its bounds; then nothing needs freeing. */
bool lines_cross(const LineSearch *search, Crossings *crossings, Error *error);

/* Adds lines until there are about `wanted` crossings, or two million lines. */
bool lines_more(const LineSearch *search, size_t wanted, Crossings *crossings, Error *error);

void crossings_free(Crossings *crossings);

#endif
