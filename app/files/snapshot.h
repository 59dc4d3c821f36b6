/* Snapshots: files of states, written during a run, read for display, for export, and to go on with the
   run. */
#ifndef APP_FILES_SNAPSHOT_H
#define APP_FILES_SNAPSHOT_H

#include "app/scene/scene.h"
#include "render/particles/particles.h"
#include "sim/error.h"
#include "sim/state.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Snapshots: a file of states in the H5Part layout, which ParaView opens as a time series.

   Group Step#k (k = 0, 1, ... without a gap) is one state. It has the attribute TimeValue (s) and
   one-dimensional datasets with a value per particle. Further attributes are the pose and rates of the box,
   gravity, the step number and `restart`: the WorldNumbers of
   sim/state.h, which with the particles restart a run. The last attribute written is `complete`.
   All values are in SI units and in the box's frame; pose and rates of the box are in the world's frame.
   Attributes of the root describe the scene: `settings` has each key as printed by slosh info, `units` the
   unit of each dataset. */

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
    float *born;   /* s; NULL: no emitters, or unknown (for display: snapshot_step_scalar) */
    int own_count; /* count of columns of single methods for a restart: snapshot_step_allocate_method_columns
                    */
    struct {
        char name[32]; /* of the dataset */
        int place;     /* in ParticleColumns.own */
        float *values;
    } own[COLUMNS_OWN];
    int shown_count; /* count of the columns shown by views: only from snapshot_read_for_display */
    struct {
        Scalar scalar;
        float *values;
    } shown[SCALAR_STATE_COUNT - SCALAR_OWN];
    unsigned lacks; /* bit k: field k of SNAPSHOT_FIELDS is missing; only from snapshot_read_for_display */
} SnapshotStep;

/* Poses of the floating solids in the step, by number. */
void snapshot_floating(const SnapshotStep *step, BoxState floating[SOLIDS_MAX]);

/* Allocates arrays for `count` particles, uninitialised; returns false, and nothing to free, if memory is
   short. */
bool snapshot_step_allocate(SnapshotStep *step, size_t count);
void snapshot_step_free(SnapshotStep *step); /* a zeroed step is allowed */

/* ---- writing ---- */

typedef struct SnapshotWriter SnapshotWriter;

/* Creates a file, under a temporary name until the first step is complete: an older file stays until then.
   Returns NULL with the reason: see output_begin; or another program is writing a file of that name. */
SnapshotWriter *snapshot_create(const char *path, const Scene *scene, Error *error);

/* Notes in a new file the source of the box's motion beside the scene: a mark such as device_replay_mark's;
   "": none. */
bool snapshot_note_motion_source(SnapshotWriter *snapshot, const char *mark, Error *error);

/* Adds a state and syncs it to the disk: a program killed later leaves the step complete. Disk space for the
   step is reserved first, so that a full disk leaves a file of complete steps. After a failure the file takes
   no more steps. */
bool snapshot_append(SnapshotWriter *snapshot, World *world, Error *error);
bool snapshot_append_step(SnapshotWriter *snapshot, const SnapshotStep *step, Error *error);

/* Count of complete steps; time of the last step written by this program, s (-1: none). */
size_t snapshot_steps(const SnapshotWriter *snapshot);
double snapshot_time(const SnapshotWriter *snapshot);

/* NULL is allowed. A file without a complete step is removed. */
void snapshot_close(SnapshotWriter *snapshot);

/* Opens a file for continuing after its last complete step; `state` becomes that step's. Partial data left
   after the last step by a killed program are dropped. Returns NULL with the reason: no such file, not HDF5,
   no complete step, steps with a gap, or a file too old to continue. Also NULL for a scene with different
   settings (except title, views and threads), or a `hand` other than noted. If another program is writing the
   file, *busy is true. */
SnapshotWriter *snapshot_resume(const char *path, const Scene *scene, const char *hand, WorldState *state,
                                bool *busy, Error *error);

/* Reads the last state of a file without opening the file for more steps; otherwise like snapshot_resume. */
bool snapshot_load(const char *path, const Scene *scene, WorldState *state, Error *error);

/* Like snapshot_create and snapshot_resume, for several processes that write a common file. `share`
   (app/files/snapshot_hdf5.h) must outlive the result; NULL: a single process. These functions fail on all
   processes or on none, like snapshot_append then. Only the first process gets the particles of `state`. */
struct SnapshotParallel;
SnapshotWriter *snapshot_create_parallel(const char *path, const Scene *scene,
                                         const struct SnapshotParallel *share, Error *error);
SnapshotWriter *snapshot_resume_parallel(const char *path, const Scene *scene, const char *hand,
                                         const struct SnapshotParallel *share, WorldState *state, bool *busy,
                                         Error *error);

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
SnapshotReader *snapshot_open_for_display(const char *path, Error *error);

/* Particles in foreign files: app/files/foreign. Such files lack the marks of slosh: by the ending of the
   name or a pattern with '*'; of HDF5 by the contents. */
bool snapshot_is_foreign(const char *path);

/* Values missing in foreign files; 0: from the particles, or a default. */
typedef struct SnapshotAssumptions {
    double spacing;     /* m */
    double support;     /* spacings */
    double density;     /* of fluid at rest, kg/m3 */
    double box_size[3]; /* m; given: particles are not moved, and in the box's frame */
    double interval;    /* s from step to step, in place of the files' times */
    double gravity[3];  /* in the file's axes: up is against it */
} SnapshotAssumptions;

/* Opens a foreign file, an index or a pattern. Notes name the columns taken, and each assumption.
   `assume` and `notes` may be NULL. The other functions for display work on the result. Returns NULL with the
   reason. */
SnapshotReader *snapshot_open_foreign(const char *path, const SnapshotAssumptions *assume, Notes *notes,
                                      Error *error);

/* For a reader of snapshot_open_for_display: reopens a changed file, which may have grown. Returns false with
   the reason: the file is gone or was replaced, or is between two writes; then no step can be read until a
   later call succeeds. */
bool snapshot_refresh(SnapshotReader *reader, Error *error);

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
bool snapshot_read_for_display(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error);

/* True if the step lacks the field. */
bool snapshot_step_misses(const SnapshotStep *step, const char *name);

/* True if the first step of the file has the scalar of OWN_SCALAR_LIST or the birth. */
bool snapshot_file_has(const char *path, Scalar scalar);

void snapshot_reader_close(SnapshotReader *reader); /* NULL is allowed */

/* The frame of reference of a step: the box's, as in snapshots, or the world's. */

/* X(NAME, name) */
#define SNAPSHOT_FRAMES(X)                                                                                   \
    X(BOX, "box")                                                                                            \
    X(WORLD, "world")

typedef enum SnapshotFrame {
#define X(NAME, name) FRAME_##NAME,
    SNAPSHOT_FRAMES(X)
#undef X
} SnapshotFrame;

const char *snapshot_frame_name(SnapshotFrame frame);

/* Transforms positions and velocities of a step from the file to the world's frame, with the step's pose and
   rates: a particle at rest in a turning box then moves. Gravity and pose stay unchanged. */
void snapshot_step_to_world(SnapshotStep *step);

/* Finds flaws in a snapshot that no simulation writes: damaged files, files of other programs. */

typedef enum SnapshotFlaw {
    SNAPSHOT_FLAW_POSITION, /* not finite, or SNAPSHOT_FARTHEST_BOXES boxes away: always left out */
    SNAPSHOT_FLAW_FLUID,    /* not among the file's fluids */
    SNAPSHOT_FLAW_DENSITY,  /* not more than 0, or not finite */
    SNAPSHOT_FLAW_NUMBER,   /* velocity or pressure not finite */
    SNAPSHOT_FLAW_ID,       /* repeated id: the particle stays */
    SNAPSHOT_FLAW_COUNT
} SnapshotFlaw;

enum { SNAPSHOT_FARTHEST_BOXES = 100 };

/* Flaws found in the snapshots so far. */
typedef struct SnapshotFlaws {
    double farthest; /* from the box's origin along an axis, m; infinite if the file has no box */
    size_t fluids;
    bool strict; /* particles with the middle three flaws are left out too */
    bool summed; /* given: exported as sums, where particles of unknown mass or density add nothing */
    bool dense;  /* the last snapshot has densities */
    bool shown;  /* for display: ids are not compared, which would be the slowest check */
    struct {
        size_t particles, snapshots, first; /* the first snapshot with such particles */
    } of[SNAPSHOT_FLAW_COUNT];
} SnapshotFlaws;

SnapshotFlaws snapshot_flaws(const SnapshotReader *reader, bool strict);

/* Counts the flaws of step `index`, and removes particles to leave out. Returns false if memory is short. */
bool snapshot_validate(SnapshotFlaws *flaws, size_t index, SnapshotStep *step);

/* Count of particles left out. */
size_t snapshot_flaws_left_out(const SnapshotFlaws *flaws);

/* Prints a warning for each kind of flaw found. */
void snapshot_flaws_print(const SnapshotFlaws *flaws, const char *path, FILE *file);

/* Converts a step of a file to the arrays of views. */

/* Definition of a particle's volume. */
typedef enum SnapshotVolume {
    SNAPSHOT_VOLUME,      /* 1 / number density, as in a world (snapshot_volume) */
    SNAPSHOT_MASS_DENSITY /* mass / density; different only if density is not proportional to number density
                           */
} SnapshotVolume;

/* X(field of a step, PARTICLE_* attributes with this field as their only source) */
#define SNAPSHOT_SOURCES(X)                                                                                  \
    X("velocity_0", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_1", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("velocity_2", PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED))                                       \
    X("density", PARTICLE_SCALAR(SCALAR_DENSITY))                                                            \
    X("pressure", PARTICLE_SCALAR(SCALAR_PRESSURE))                                                          \
    X("compression", PARTICLE_SCALAR(SCALAR_COMPRESSION))                                                    \
    X("fluid", PARTICLE_FLUID | PARTICLE_SCALAR(SCALAR_FLUID))                                               \
    X("id", PARTICLE_ID | PARTICLE_SCALAR(SCALAR_ID))

/* The PARTICLE_* attributes available from the step. */
unsigned snapshot_attributes(const SnapshotStep *step);

/* Fills the arrays of `to` that are not NULL, with room for step->count particles each. Without densities a
   particle has the volume of fluid at rest; with a density not more than 0, or an unknown fluid, the volume
   is 0. */
void snapshot_arrays(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                     const ParticleArrays *to);

/* A step of a file in GL buffers, with a scalar derived from the step, for exports of numbers.

   Needs a current OpenGL 4.5 core context, except for scalars stored in the step. */

/* Programs and buffers reused for each step. Zero-initialise before use. */
typedef struct SnapshotBuffers {
    Derived derived;
    Upload *upload;
    size_t capacity; /* particles of `upload` */
} SnapshotBuffers;

void snapshot_buffers_destroy(SnapshotBuffers *buffers); /* a zeroed struct needs no context */

/* The PARTICLE_* attributes that the scalar needs besides positions. */
unsigned snapshot_scalar_attributes(Scalar scalar);

/* Makes buffers of the step with positions, inputs of the scalar, and the scalar; valid until the next call.
   Returns false if memory is short. */
bool snapshot_buffers_make(SnapshotBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                           SnapshotVolume volume, Scalar scalar, ParticleBuffers *out, Error *error);

/* Writes the scalar of each particle, as in the views; scalars stored in the step need no context. */
bool snapshot_buffers_scalar(SnapshotBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                             Scalar scalar, float *values, Error *error);

#endif
