/* Snapshots: a file of states in the H5Part layout, that ParaView opens as a time series.

   Group Step#k (k = 0, 1, ... without a gap) is one state: the attribute TimeValue (s), one-dimensional
   datasets of one value a particle, and as attributes the pose and rates of the box, gravity, the step
   number, `restart` (the WorldNumbers of sim/world/world_state.h, from which with the particles a run goes
   on) and `complete`, which is written last. All in SI units and in the box's frame; pose and rates of the
   box in the world's. Attributes of the root say what scene it was, `settings` each key as slosh info prints
   it, `units` the unit of each dataset. */
#ifndef SLOSH_SNAPSHOT_H
#define SLOSH_SNAPSHOT_H

#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/world/world_state.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* X(dataset, type in memory, field of SnapshotStep): the datasets of a step */
#define SNAPSHOT_FIELDS(X)                                                                                   \
    X("x", float, position[0])                                                                               \
    X("y", float, position[1])                                                                               \
    X("z", float, position[2])                                                                               \
    X("velocity_0", float, velocity[0])                                                                      \
    X("velocity_1", float, velocity[1])                                                                      \
    X("velocity_2", float, velocity[2])                                                                      \
    X("density", float, density)                                                                             \
    X("pressure", float, pressure)                                                                           \
    X("compression", float, compression)                                                                     \
    X("fluid", int32_t, fluid)                                                                               \
    X("id", int64_t, id)

/* One state as the file has it. */
typedef struct SnapshotStep {
    double time;          /* s */
    uint64_t step;        /* substeps since the start */
    BoxState box;         /* in the world's frame */
    double gravity[3];    /* in the box's frame, m/s2 */
    WorldNumbers restart; /* version 0: a file that has none */
    size_t count;         /* particles; each array below has as many */
    float *position[3];   /* box frame, m */
    float *velocity[3];   /* box frame, m/s */
    float *density;       /* kg/m3 */
    float *pressure;      /* Pa */
    float *compression; /* density over that at rest, less 1: a method that carries density goes on from it */
    int32_t *fluid;     /* index into the root's fluid_names */
    int64_t *id;
    float *born; /* s; NULL: nothing is emitted, or the file does not say (shown: snapshot_step_own_scalar) */
    int own_count; /* columns not every method has that a run goes on from: snapshot_step_own */
    struct {
        char name[32]; /* of the dataset */
        int place;     /* in ParticleColumns.own */
        float *values;
    } own[COLUMNS_OWN];
    int shown_count; /* and those of them that views can show: of snapshot_read_shown alone */
    struct {
        Scalar scalar;
        float *values;
    } shown[SCALAR_STATE_COUNT - SCALAR_OWN];
    unsigned lacks; /* bit k: the file has no k-th field of SNAPSHOT_FIELDS; only of snapshot_read_shown */
} SnapshotStep;

/* Where the solids that float are in it, by number. */
void snapshot_floating(const SnapshotStep *step, BoxState floating[SOLIDS_MAX]);

/* Arrays for `count` particles, not initialised; false, and nothing to free, when memory is short. */
bool snapshot_step_allocate(SnapshotStep *step, size_t count);
/* The same for what is no method's of a saved state's columns (columns_saved). */
bool snapshot_step_own(SnapshotStep *step, const ColumnRows *saved);
/* The same for the births. */
bool snapshot_step_born(SnapshotStep *step);
/* The same for one such scalar that is shown: its array; NULL when memory is short. */
float *snapshot_step_show(SnapshotStep *step, Scalar scalar);
void snapshot_step_free(SnapshotStep *step); /* a zeroed one is allowed */

/* ---- writing ---- */

typedef struct Snapshot Snapshot;

/* A new file. Until its first step is whole it has a temporary name and an older file stays as it is. NULL
   with the reason: see output_begin; or another program is writing a file of that name. */
Snapshot *snapshot_create(const char *path, const Scene *scene, Error *error);

/* Notes in a new file what moves the box beside the scene: a mark such as hand_replay_mark's; "": nothing. */
bool snapshot_note_hand(Snapshot *snapshot, const char *mark, Error *error);

/* Adds a state and brings it to the disk: a program that is killed afterwards leaves it whole. Room for all
   of it is reserved first, so that a full disk leaves the file with its whole steps. After a failure the file
   takes no more steps. */
bool snapshot_append(Snapshot *snapshot, World *world, Error *error);
bool snapshot_append_step(Snapshot *snapshot, const SnapshotStep *step, Error *error);

/* Steps that are whole; the time of the last one that was written here, s (-1: none). */
size_t snapshot_steps(const Snapshot *snapshot);
double snapshot_time(const Snapshot *snapshot);

/* NULL is allowed. A file without a whole step leaves nothing behind. */
void snapshot_close(Snapshot *snapshot);

/* A file to go on with behind its last whole step; `state` becomes that step's. What a killed program left
   behind it is dropped. NULL with the reason: no such file, not HDF5, no whole step, a scene with other
   settings (but for title, views and threads), steps with a gap, a file too old to go on from, another `hand`
   than was noted; or, and then *busy is true, another program is writing it. */
Snapshot *snapshot_resume(const char *path, const Scene *scene, const char *hand, WorldState *state,
                          bool *busy, Error *error);

/* The particles that a run began with, to make a world of before it is loaded with a later state: where what
   they were made from may be gone. */
typedef struct SnapshotFirst {
    float *position;
    uint8_t *fluid;
    InitialState initial; /* of these */
} SnapshotFirst;

/* False with the reason, and nothing to free. */
bool snapshot_first(const char *path, SnapshotFirst *first, Error *error);
void snapshot_first_free(SnapshotFirst *first); /* a zeroed one is allowed */

/* ---- reading ---- */

typedef struct SnapshotReader SnapshotReader;

/* NULL with the reason: no such file, not HDF5. */
SnapshotReader *snapshot_open(const char *path, Error *error);

/* The same for who shows a file and does not go on with it: steps are counted by their names, which takes
   milliseconds for thousands of them; one that is not whole is found at the end of the file, or when it is
   read. */
SnapshotReader *snapshot_open_shown(const char *path, Error *error);

/* For a reader of snapshot_open_shown: opens the file again where it has changed, since it may have grown.
   False with the reason: it is gone or another one now, or this is a moment between two writes; then no step
   can be read until a later call succeeds. */
bool snapshot_follow(SnapshotReader *reader, Error *error);

/* Whole steps; what a killed program left half-written at the end does not count. */
size_t snapshot_count_steps(const SnapshotReader *reader);

/* Whether steps stand behind the first that is missing or not whole, where nothing reads them: in words. */
bool snapshot_gap(const SnapshotReader *reader, char words[256]);

/* The time of step `index`, s; cheaper than the step. */
bool snapshot_read_time(SnapshotReader *reader, size_t index, double *time, Error *error);

/* The colours of the fluids as in the scene file, sRGB 0 to 1. Returns how many fluids have one: 0 where the
   file knows none. */
size_t snapshot_read_colors(const SnapshotReader *reader, double colors[FLUIDS_MAX][3]);

/* What the file says of its scene. */
typedef struct SnapshotScene {
    int dimensions;
    double spacing, support_radius; /* m */
    double box_size[3];             /* m */
    bool periodic[3];               /* the sides across this axis are one */
    size_t fluid_count;
    double density[FLUIDS_MAX]; /* of each fluid at rest, kg/m3 */
    double stiffness_scale;     /* relative change of density over that of number density */
} SnapshotScene;

/* False with what is missing or cannot be: afterwards lengths and densities are more than 0. */
bool snapshot_read_scene(const SnapshotReader *reader, SnapshotScene *scene, Error *error);

/* The name of the kernel that its method sums with, as its settings say; false where they do not. */
bool snapshot_kernel(const SnapshotReader *reader, char name[NAME_SIZE]);

/* The volume of particle i, 1 / number density, m3 (of two dimensions m2): what the views have of it
   (ParticleArrays.position). At most 20 spacings^3; not finite where the density is not or the fluid is
   unknown. */
double snapshot_volume(const SnapshotScene *scene, const SnapshotStep *step, size_t i);

/* Reads step `index` into new arrays, that the caller frees. */
bool snapshot_read_step(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error);

/* The same for who shows it: the file may lack velocities, density, pressure, compression, fluid and id,
   which step->lacks says; these are 0 then. It has the scalars of OWN_SCALAR_LIST and the births that the
   file has. */
bool snapshot_read_shown(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error);

/* Of a step of snapshot_read_shown: its values of a scalar of OWN_SCALAR_LIST or the birth; NULL: the file
 * has none. */
const float *snapshot_step_own_scalar(const SnapshotStep *step, Scalar scalar);

/* Whether it lacks that field. */
bool snapshot_step_lacks(const SnapshotStep *step, const char *name);

/* Reads into that step the columns of snapshot_step_own, and the births that the file has. False, and the
   step is empty, where the file lacks one. */
bool snapshot_read_own(SnapshotReader *reader, size_t index, const ColumnRows *saved, SnapshotStep *step,
                       Error *error);

/* Whether the first step of a file has a scalar of OWN_SCALAR_LIST or the birth. */
bool snapshot_file_has(const char *path, Scalar scalar);

void snapshot_reader_close(SnapshotReader *reader); /* NULL is allowed */

#endif
