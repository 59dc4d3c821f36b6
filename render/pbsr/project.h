/* Projects sets on the GPU: triangles, cells and points of the layers are uploaded;
   shaders/pbsr/project.comp makes and projects points, with an invocation per piece and set and 32-bit
   atomics. As exact as the CPU (render/pbsr/layer.h), with other random numbers. Needs a current OpenGL
   4.5 core context. */
#ifndef SLOSH_PROJECT_H
#define SLOSH_PROJECT_H

#include "render/pbsr/average.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/solid_layers.h"

/* GPU data of a layer: buffers of points, corners, shares, and kept points. */
typedef struct ProjectLayer {
    unsigned buffers[4];
    unsigned parts; /* invocations per piece, which share the piece's points */
} ProjectLayer;

/* Zero-initialise. */
typedef struct Project {
    unsigned program;    /* 0: the CPU projects */
    int64_t block_bytes; /* bytes of a buffer that a shader can see; a test may set fewer */
    ProjectLayer layers[PBSR_LAYERS_MAX];
    uint64_t still[PBSR_LAYERS_MAX]; /* StillLayer.made of the uploaded kept points */
    unsigned solids[SOLIDS_MAX];     /* buffers of the solids' points, and the uploaded versions */
    uint64_t solid_made[SOLIDS_MAX];
} Project;

bool project_create(Project *project, Error *error);
void project_destroy(Project *project); /* a zeroed struct is allowed */

/* Uploads the present data of a layer and its kept points. Returns false, with the reason, if the driver
   has no memory, or a shader cannot see so many corners at once. */
bool project_take(Project *project, int index, const Layer *layer, const StillLayer *still, Error *error);

/* Uploads the points of a solid. */
bool project_take_solid(Project *project, int index, const StillLayer *still, Error *error);

/* The sets to project, and the layers. */
typedef struct ProjectSets {
    const Layer *layers;
    const StillLayer *still;
    const SolidLayers *solids;
    int layer_count;
    int seed;
    int first, count; /* numbers of the sets; the sets go to the buffer's first places */
} ProjectSets;

void project_run(Project *project, const Average *average, const ProjectSets *sets);

#endif
