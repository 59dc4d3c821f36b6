/* Sets projected on the GPU: the layers' triangles, cells and points go there, points are made and projected
   by shaders/pbsr/project.comp, an invocation a piece and set, with 32-bit atomics. As exact as the CPU's way
   (render/pbsr/layer.h), with other random numbers. Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PROJECT_H
#define SLOSH_PROJECT_H

#include "render/pbsr/average.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/solid_layers.h"

/* A layer on the GPU: buffers of points, corners and shares, and of points that stay. */
typedef struct ProjectLayer {
    unsigned buffers[4];
    unsigned parts; /* invocations that share the points of a piece */
} ProjectLayer;

/* Zero-initialise it. */
typedef struct Project {
    unsigned program;    /* 0: the CPU projects */
    int64_t block_bytes; /* as many a shader may see of a buffer; a test may say fewer */
    ProjectLayer layers[PBSR_LAYERS_MAX];
    uint64_t still[PBSR_LAYERS_MAX]; /* which of the points that stay are there: StillLayer.made */
    unsigned solids[SOLIDS_MAX];     /* buffers of the points of solids, and which are there */
    uint64_t solid_made[SOLIDS_MAX];
} Project;

bool project_create(Project *project, Error *error);
void project_destroy(Project *project); /* a zeroed one is allowed */

/* Takes a layer, and the one of points that stay, as they are now. False with the reason where the driver has
   no memory for them, or a shader does not see so many corners at once. */
bool project_take(Project *project, int index, const Layer *layer, const StillLayer *still, Error *error);

/* And the points of a solid. */
bool project_take_solid(Project *project, int index, const StillLayer *still, Error *error);

/* Which sets, and of what. */
typedef struct ProjectSets {
    const Layer *layers;
    const StillLayer *still;
    const SolidLayers *solids;
    int layer_count;
    int seed;
    int first, count; /* numbers of the sets, which go to the buffer's first places */
} ProjectSets;

void project_run(Project *project, const Average *average, const ProjectSets *sets);

#endif
