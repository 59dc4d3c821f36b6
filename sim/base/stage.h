/* Stages: names, and the clock for stages on the CPU. A stage belongs to a part of the program; times are
   summed over a frame, since a frame runs a stage once per substep. sim/gl/timer.h times GL stages, under
   the same names.

   The names are for people, in tables and JSON. Methods and views share the names, and a new method or view
   uses fitting names or adds rows here. */
#ifndef SLOSH_STAGE_H
#define SLOSH_STAGE_H

#include <stdbool.h>

/* X(ENUM, name, part): in the order of a frame */
#define STAGE_LIST(X)                                                                                        \
    X(GRID, "grid", PART_SIM)                                                                                \
    X(DENSITY, "density", PART_SIM)                                                                          \
    X(FORCE, "force", PART_SIM)                                                                              \
    X(SOLVE, "solve", PART_SIM)                                                                              \
    X(INTEGRATE, "integrate", PART_SIM)                                                                      \
    X(UPLOAD, "upload", PART_UPLOAD)                                                                         \
    X(SCALARS, "scalars", PART_RENDER)                                                                       \
    X(SHADOW, "shadow", PART_RENDER)                                                                         \
    X(SOLIDS, "solids", PART_RENDER)                                                                         \
    X(VOXELIZE, "voxelize", PART_RENDER)                                                                     \
    X(RAYCAST, "raycast", PART_RENDER)                                                                       \
    X(VISIBILITY, "visibility", PART_RENDER)                                                                 \
    X(BLEND, "blend", PART_RENDER)                                                                           \
    X(THICKNESS, "thickness", PART_RENDER)                                                                   \
    X(FILTER, "filter", PART_RENDER)                                                                         \
    X(SHADE, "shade", PART_RENDER)                                                                           \
    X(ANTIALIAS, "antialias", PART_RENDER)                                                                   \
    X(FOAM, "foam", PART_RENDER)                                                                             \
    X(BACKDROP, "backdrop", PART_RENDER)                                                                     \
    X(OVERLAY, "overlay", PART_RENDER)

typedef enum Part { PART_SIM, PART_UPLOAD, PART_RENDER } Part;

typedef enum Stage {
#define X(NAME, name, part) STAGE_##NAME,
    STAGE_LIST(X)
#undef X
        STAGE_COUNT
} Stage;

const char *stage_name(Stage stage);
Part stage_part(Stage stage);
const char *part_name(Part part);

/* Milliseconds of each stage in a frame; `ran` separates a stage with zero time from a stage not in the
   frame. */
typedef struct StageTimes {
    double ms[STAGE_COUNT];
    bool ran[STAGE_COUNT];
} StageTimes;

/* The CPU clock; zero-initialise. A NULL clock measures nothing and costs nothing. */
typedef struct StageClock {
    StageTimes frame; /* of the current frame; the owner clears it between frames */
    double began_ms;  /* begin of the running stage; stages do not nest */
    void *gpu;        /* the clock of a GPU; if not NULL, gpu_begin and gpu_end are called instead:
                         sim/gl/timer.h */
    void (*gpu_begin)(void *gpu);
    void (*gpu_end)(void *gpu, Stage stage);
} StageClock;

void stage_begin(StageClock *clock);
void stage_end(StageClock *clock, Stage stage);

/* STAGE(clock, STAGE_GRID) statement; */
#define STAGE(clock, stage)                                                                                  \
    for (int stage_once = (stage_begin(clock), 1); stage_once; stage_once = (stage_end(clock, stage), 0))

/* Monotonic wall time in milliseconds. */
double wall_ms(void);

#endif
