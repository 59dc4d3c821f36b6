/* Plan of `slosh stability`: methods x backends, each over a grid of one or two keys of the scene. */
#ifndef SLOSH_STABLE_PLAN_H
#define SLOSH_STABLE_PLAN_H

#include "app/session/args.h"
#include "app/stability/stable_axis.h"

enum { STABLE_SERIES = 16 };

typedef struct StableSeries {
    char method[NAME_SIZE], backend[NAME_SIZE];
    bool effect[STABLE_AXES]; /* true if the method reads the axis; if false, one cell is enough */
} StableSeries;

typedef struct StablePlan {
    const Args *args;
    const char *scene_name;
    Scene scene; /* as set by the command line */
    Notes notes; /* of the scene */
    char csv[1024];
    double time; /* simulated time of a trial, s */
    int threads; /* total of all processes */
    int axis_count;
    StableAxis axis[STABLE_AXES];
    int series_count;
    StableSeries series[STABLE_SERIES];
} StablePlan;

/* One cell of the grid of a series. */
typedef struct StableCell {
    int series, at[STABLE_AXES];
} StableCell;

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. Methods and
   backends: those of the command line, else the scene's own. An axis not read by a method is reported on
   standard error. Errors: an axis not read by any method; --particles with the spacing as an axis. */
bool stable_plan_make(const Args *args, StablePlan *plan, Error *error);

/* Returns the count of cells along an axis; 1 if the axis does not exist. */
int stable_points(const StablePlan *plan, int axis);

/* Count of cells of all series together. Cell numbers: the last axis varies fastest. */
int stable_cells(const StablePlan *plan);
StableCell stable_cell(const StablePlan *plan, int number);

/* Returns the number of the cell searched in place of cell `number`: the first cell along each axis
   without effect on the method. */
int stable_searched(const StablePlan *plan, int number);

/* Loads the cell's scene with the scene's own step (`rung` NULL), or with the step of a rung. Mode fixed,
   one step per frame so that energy is checked often, sentinel on, one thread. */
bool stable_scene(const StablePlan *plan, StableCell cell, const int *rung, Scene *scene, Error *error);

/* Returns the first and the highest rung of the cell's search. */
void stable_range(const StablePlan *plan, const Scene *scene, int *first, int *most);

/* Fills in the cell's settings, such as "solver.sound_speed=14 fluids[0].viscosity=2". */
void stable_at(const StablePlan *plan, StableCell cell, char *text, size_t size);

#endif
