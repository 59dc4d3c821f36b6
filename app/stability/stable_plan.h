/* What `slosh stability` searches: methods x backends, each over a grid of one or two keys of the scene. */
#ifndef SLOSH_STABLE_PLAN_H
#define SLOSH_STABLE_PLAN_H

#include "app/session/args.h"
#include "app/stability/stable_axis.h"

enum { STABLE_SERIES = 16 };

typedef struct StableSeries {
    char method[NAME_SIZE], backend[NAME_SIZE];
    bool
        effect[STABLE_AXES]; /* whether the method reads the axis: of one that it does not a cell is enough */
} StableSeries;

typedef struct StablePlan {
    const Args *args;
    const char *scene_name;
    Scene scene; /* as the command line has it */
    Notes notes; /* of the scene */
    char csv[1024];
    double time; /* s, of a trial */
    int threads; /* of them all */
    int axis_count;
    StableAxis axis[STABLE_AXES];
    int series_count;
    StableSeries series[STABLE_SERIES];
} StablePlan;

/* One cell of the grid of one series. */
typedef struct StableCell {
    int series, at[STABLE_AXES];
} StableCell;

/* False with what is wrong with the command line or the scene. Methods and backends are those that the
   command line names, else the scene's own. Of an axis that a method does not read standard error says so;
   that no method reads one is an error, and --particles with the spacing as an axis. */
bool stable_plan_make(const Args *args, StablePlan *plan, Error *error);

/* Cells along an axis; 1 where there is none. */
int stable_points(const StablePlan *plan, int axis);

/* Of all series together, by number: the last axis goes fastest. */
int stable_cells(const StablePlan *plan);
StableCell stable_cell(const StablePlan *plan, int number);

/* The cell that is searched in its place: that at the begin of each axis that the method does not read. */
int stable_searched(const StablePlan *plan, int number);

/* The cell's scene at the scene's own step (`rung` NULL) or at that rung of the ladder: mode fixed, a frame a
   step, so that the watch over energy looks often, and a sentinel; one thread. */
bool stable_scene(const StablePlan *plan, StableCell cell, const int *rung, Scene *scene, Error *error);

/* Where the cell's search begins and ends, of its scene. */
void stable_range(const StablePlan *plan, const Scene *scene, int *first, int *most);

/* "solver.sound_speed=14 fluids[0].viscosity=2" */
void stable_at(const StablePlan *plan, StableCell cell, char *text, size_t size);

#endif
