/* Snapshots: a file of states in the H5Part layout, which ParaView opens as a time series.

   Group Step#k (k = 0, 1, ... without a gap) is one state. It has the attribute TimeValue (s) and
   one-dimensional datasets with a value per particle. Further attributes: the pose and rates of the box,
   gravity, the step number, `restart` (the WorldNumbers of sim/world/world_state.h, which with the particles
   restart a run) and `complete`, which is written last. All values are in SI units and in the box's frame;
   pose and rates of the box are in the world's frame. Attributes of the root describe the scene: `settings`
   has each key as printed by slosh info, `units` the unit of each dataset. */
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

/* A state as in the file. */
typedef struct SnapshotStep {
    double time;          /* s */
    uint64_t step;        /* substeps since the start */
    BoxState box;         /* in the world's frame */
    double gravity[3];    /* in the box's frame, m/s2 */
    WorldNumbers restart; /* version 0: missing in the file */
    size_t count;         /* particles, also the length of each array below */
    float *position[3];   /* box frame, m */
    float *velocity[3];   /* box frame, m/s */
    float *density;       /* kg/m3 */
    float *pressure;      /* Pa */
    float *compression; /* density over rest density, minus 1: restart value of methods that carry density */
    int32_t *fluid;     /* index into the root's fluid_names */
    int64_t *id;
    float *born;   /* s; NULL: no emitters, or unknown (for display: snapshot_step_own_scalar) */
    int own_count; /* count of columns of single methods for a restart: snapshot_step_own */
    struct {
        char name[32]; /* of the dataset */
        int place;     /* in ParticleColumns.own */
        float *values;
    } own[COLUMNS_OWN];
    int shown_count; /* count of the columns shown by views: only from snapshot_read_shown */
    struct {
        Scalar scalar;
        float *values;
    } shown[SCALAR_STATE_COUNT - SCALAR_OWN];
    unsigned lacks; /* bit k: field k of SNAPSHOT_FIELDS is missing; only from snapshot_read_shown */
} SnapshotStep;

/* Poses of the floating solids in the step, by number. */
void snapshot_floating(const SnapshotStep *step, BoxState floating[SOLIDS_MAX]);

/* Allocates arrays for `count` particles, uninitialised; returns false, and nothing to free, if memory is
   short. */
bool snapshot_step_allocate(SnapshotStep *step, size_t count);
/* Allocates the method's own columns of a saved state (columns_saved); returns false if memory is short. */
bool snapshot_step_own(SnapshotStep *step, const ColumnRows *saved);
/* Allocates the births; returns false if memory is short. */
bool snapshot_step_born(SnapshotStep *step);
/* Allocates the array of a shown scalar; NULL if memory is short. */
float *snapshot_step_show(SnapshotStep *step, Scalar scalar);
void snapshot_step_free(SnapshotStep *step); /* a zeroed step is allowed */

/* ---- writing ---- */

typedef struct Snapshot Snapshot;

/* Creates a file, under a temporary name until the first step is complete: an older file stays until then.
   Returns NULL with the reason: see output_begin; or another program is writing a file of that name. */
Snapshot *snapshot_create(const char *path, const Scene *scene, Error *error);

/* Notes in a new file the source of the box's motion beside the scene: a mark such as hand_replay_mark's; "":
   none. */
bool snapshot_note_hand(Snapshot *snapshot, const char *mark, Error *error);

/* Adds a state and syncs it to the disk: a program killed later leaves the step complete. Disk space for the
   step is reserved first, so that a full disk leaves a file of complete steps. After a failure the file takes
   no more steps. */
bool snapshot_append(Snapshot *snapshot, World *world, Error *error);
bool snapshot_append_step(Snapshot *snapshot, const SnapshotStep *step, Error *error);

/* Count of complete steps; time of the last step written by this program, s (-1: none). */
size_t snapshot_steps(const Snapshot *snapshot);
double snapshot_time(const Snapshot *snapshot);

/* NULL is allowed. A file without a complete step is removed. */
void snapshot_close(Snapshot *snapshot);

/* Opens a file for continuing after its last complete step; `state` becomes that step's. Partial data left
   after the last step by a killed program are dropped. Returns NULL with the reason: no such file, not HDF5,
   no complete step, steps with a gap, or a file too old to continue. Also NULL for a scene with different
   settings (except title, views and threads), or a `hand` other than noted. If another program is writing the
   file, *busy is true. */
Snapshot *snapshot_resume(const char *path, const Scene *scene, const char *hand, WorldState *state,
                          bool *busy, Error *error);

/* The initial particles of a run, for making the world before loading a later state: the files used at the
   start may be gone. */
typedef struct SnapshotFirst {
    float *position;
    uint8_t *fluid;
    InitialState initial; /* points at the arrays above */
} SnapshotFirst;

/* Returns false with the reason, and nothing to free. */
bool snapshot_first(const char *path, SnapshotFirst *first, Error *error);
void snapshot_first_free(SnapshotFirst *first); /* a zeroed struct is allowed */

/* ---- reading ---- */

typedef struct SnapshotReader SnapshotReader;

/* Returns NULL with the reason: no such file, not HDF5. */
SnapshotReader *snapshot_open(const char *path, Error *error);

/* Opens a file for display only, not for a restart: counts steps by name, which takes milliseconds for
   thousands of steps. An incomplete step is found at the file's end, or on reading. */
SnapshotReader *snapshot_open_shown(const char *path, Error *error);

/* For a reader of snapshot_open_shown: reopens a changed file, which may have grown. Returns false with the
   reason: the file is gone or was replaced, or is between two writes; then no step can be read until a later
   call succeeds. */
bool snapshot_follow(SnapshotReader *reader, Error *error);

/* Count of complete steps, without a partial step left at the end by a killed program. */
size_t snapshot_count_steps(const SnapshotReader *reader);

/* True, with a message, if unreadable steps follow the first missing or incomplete step. */
bool snapshot_gap(const SnapshotReader *reader, char words[256]);

/* The time of step `index`, s; cheaper than reading the step. */
bool snapshot_read_time(SnapshotReader *reader, size_t index, double *time, Error *error);

/* The colours of the fluids as in the scene file, sRGB 0 to 1. Returns the count of fluids with a colour: 0
   if the file has no colours. */
size_t snapshot_read_colors(const SnapshotReader *reader, double colors[FLUIDS_MAX][3]);

/* The scene's figures in the file. */
typedef struct SnapshotScene {
    int dimensions;
    double spacing, support_radius; /* m */
    double box_size[3];             /* m */
    bool periodic[3];               /* periodic axes */
    size_t fluid_count;
    double density[FLUIDS_MAX]; /* of each fluid at rest, kg/m3 */
    double stiffness_scale;     /* relative change of density over relative change of number density */
} SnapshotScene;

/* Returns false and names the missing or impossible value; on success lengths and densities are more than
   0. */
bool snapshot_read_scene(const SnapshotReader *reader, SnapshotScene *scene, Error *error);

/* Name of the kernel for sums of the file's method, from its settings; false if unknown. */
bool snapshot_kernel(const SnapshotReader *reader, char name[NAME_SIZE]);

/* The volume of particle i, 1 / number density, m3 (in two dimensions m2), as used by the views
   (ParticleArrays.position). At most 20 spacings^3; not finite if the density is not finite or the fluid is
   unknown. */
double snapshot_volume(const SnapshotScene *scene, const SnapshotStep *step, size_t i);

/* Reads step `index` into new arrays, which the caller frees. */
bool snapshot_read_step(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error);

/* Reads step `index` for display. The file may lack velocities, density, pressure, compression, fluid and id,
   which are then 0 and marked in step->lacks. Also reads the scalars of OWN_SCALAR_LIST and the births in the
   file. */
bool snapshot_read_shown(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error);

/* For a step of snapshot_read_shown: the values of a scalar of OWN_SCALAR_LIST or of the birth; NULL:
   missing. */
const float *snapshot_step_own_scalar(const SnapshotStep *step, Scalar scalar);

/* True if the step lacks the field. */
bool snapshot_step_lacks(const SnapshotStep *step, const char *name);

/* Reads the columns of snapshot_step_own and the births of the file into the step. Returns false with an
   empty step if the file lacks a column. */
bool snapshot_read_own(SnapshotReader *reader, size_t index, const ColumnRows *saved, SnapshotStep *step,
                       Error *error);

/* True if the first step of the file has the scalar of OWN_SCALAR_LIST or the birth. */
bool snapshot_file_has(const char *path, Scalar scalar);

void snapshot_reader_close(SnapshotReader *reader); /* NULL is allowed */

#endif
