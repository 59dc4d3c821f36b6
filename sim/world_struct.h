/* Inside a world: for the files that make one up. */
#ifndef SLOSH_WORLD_STRUCT_H
#define SLOSH_WORLD_STRUCT_H

#include "sim/method.h"

struct World {
    WorldDef def; /* `initial` is not kept */
    Solver solver;
    const Backend *backend;
    const Method *method;
    void *state; /* the backend's */
    size_t count;
    uint64_t step;
    uint64_t since_step; /* when the present dt began, */
    double since_time;   /* at this time, s */
    BoxTarget target;    /* of the hand */
    BoxFilter filter;    /* at the present time */
    BoxState box;        /* at the present time, the hand's part included */
};

/* The def, whose constant part is the world's own, becomes the world's. False with the reason: nothing has
   changed. */
bool world_adopt(World *world, const WorldDef *def, Error *error);

#endif
