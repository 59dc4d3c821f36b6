/* What passes do to a picture, counted while one is drawn that nobody times. */
#ifndef SLOSH_COUNTS_H
#define SLOSH_COUNTS_H

#include "sim/base/stage.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct ViewCounts {
    bool counted;    /* by the view; else all is 0 */
    double coverage; /* share of the picture's pixels that the fluid's surface covers, also where a solid
                        stands before it */
    double fragments[STAGE_COUNT]; /* a covered pixel, that the stage's sprites give its map; corners of
                                      sprites are among them where its shader, or the driver before it, lets
                                      them pass; 0: the stage is not counted */
    unsigned query;                /* GL query while a stage is counted */
} ViewCounts;

/* Around draw calls of a stage, which add up. NULL: nothing is counted, nothing done. counts_end waits for
   the GPU. */
void counts_begin(ViewCounts *counts);
void counts_end(ViewCounts *counts, Stage stage);

/* At the end of a picture: `covered` of so many pixels. */
void counts_finish(ViewCounts *counts, uint64_t covered, uint64_t pixels);

#endif
