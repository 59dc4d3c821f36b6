/* Where straight lines of all directions cross a level. Of lines that meet a box with the measure that no
   motion changes, the crossings with a surface in it are uniform in its area, and a line has 2 S / (area of
   the box) of them on average: places to begin walks at, on all parts of the surface in their proportion, and
   its area. After: L. Santaló, "Integral geometry and geometric probability", 1976, chapter 14 (Cauchy,
   Crofton). The lines are a shifted sequence of low discrepancy, so that both are better than chance: M.
   Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018. */
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
    float (*place)[3];      /* m; in the lines' order: the first n are as uniform as all */
    double low[3], high[3]; /* m: their extent */
    double area;            /* m2: of the surface */
    size_t lines;
} Crossings;

/* Of some thousand lines. False where none crosses the level, with the reason, where the field is no number,
   or is so fine for its bounds that no line could be followed; then nothing needs to be freed. */
bool lines_cross(const LineSearch *search, Crossings *crossings, Error *error);

/* More lines until there are about as many crossings as wanted, or two million lines. */
bool lines_more(const LineSearch *search, size_t wanted, Crossings *crossings, Error *error);

void crossings_free(Crossings *crossings);

#endif
