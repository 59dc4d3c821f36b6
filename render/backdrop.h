/* The backdrop: sky and floor wherever the target's depth says that nothing has been drawn. Reads the floor's
   shadow map; writes colour only. */
#ifndef SLOSH_BACKDROP_H
#define SLOSH_BACKDROP_H

#include "render/frame.h"
#include "render/shadow.h"
#include "sim/error.h"

typedef struct Backdrop {
    unsigned program, vertex_array;
} Backdrop;

bool backdrop_create(Backdrop *backdrop, Error *error);
void backdrop_destroy(Backdrop *backdrop);
void backdrop_draw(const Backdrop *backdrop, const Frame *frame, const Shadow *shadow);

#endif
