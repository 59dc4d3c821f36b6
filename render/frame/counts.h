/* Coverage and fragments of a picture, counted while drawing a picture that is not timed. */
#ifndef SLOSH_COUNTS_H
#define SLOSH_COUNTS_H

#include "sim/base/stage.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct ViewCounts {
    bool counted;    /* the view has counted; false: all is 0 */
    double coverage; /* fraction of the picture's pixels that the fluid's surface covers, including pixels
                        where a solid is in front */
    double fragments[STAGE_COUNT]; /* fragments that the stage's sprites write, per covered pixel; includes
                                      corners of sprites that the shader or an early driver test lets pass;
                                      0: not counted */
    unsigned query;                /* GL query while a stage is being counted */
} ViewCounts;

/* Call around a stage's draw calls; the counts add up. NULL: does nothing. counts_end waits for the GPU. */
void counts_begin(ViewCounts *counts);
void counts_end(ViewCounts *counts, Stage stage);

/* Call at the end of a picture: `covered` of `pixels` pixels are covered. */
void counts_finish(ViewCounts *counts, uint64_t covered, uint64_t pixels);

#endif
