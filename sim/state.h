/* The saved state of a world: all data read by the next step, so that save, load, step equals step to the
   bit, on any backend (world_save, world_load below). The file begins with what the state holds: births,
   floating solids, energy sums, live settings, and the particles' columns. */
#ifndef SIM_STATE_H
#define SIM_STATE_H

#include "sim/def.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Birth times without a number per particle. Ids are given in the order of birth, so the first id and the
   time of each emission suffice. */

/* Read by shaders in this layout (shaders/derived/derived_read.glsl). */
typedef struct Birth {
    ParticleId first_id;
    float time; /* s; NaN: unknown */
    uint32_t nothing;
} Birth;

/* Sorted by id; particles before the first entry were born at time 0. Zero-initialise. */
typedef struct Births {
    Birth *of;
    size_t count, capacity;
} Births;

/* Makes room for `more` entries; false if memory is short. */
bool births_reserve(Births *births, size_t more);

/* Sets birth `time` from `first_id` on; `first_id` must exceed all earlier first ids. Call births_reserve
   first. */
void births_add(Births *births, ParticleId first_id, float time);

/* Removes entries of ids from `end` on, which are not born yet. */
void births_cut(Births *births, uint64_t end);

/* Removes entries without a particle among the `count` ids, except the last entry; does nothing if memory
   is short. */
void births_keep(Births *births, const ParticleId *id, size_t count);

/* Returns false, with `to` unchanged, if memory is short. */
bool births_copy(const Births *from, Births *to);

/* Gathers births from `count` particles in any order, with ids and times. Returns false if memory is
   short. */
bool births_gather(Births *births, const ParticleId *id, const float *time, size_t count);

/* s; NaN: unknown. */
float births_time(const Births *births, ParticleId id);

void births_free(Births *births); /* a zeroed struct is allowed */

/* State of solids moved by the fluid: doubles only, since files keep the state as part of WorldNumbers. */

typedef struct BodyState {
    BoxState pose;   /* of the solid's frame, in the box's frame */
    double push[3];  /* acceleration of the centre of mass by fluid in the last step, m/s2, */
    double twist[3]; /* and angular acceleration, rad/s2: in the box's axes. On a hinge only twist[0], about
                        the axis */
    Push left;       /* by guards after the last kick, for the next: N s, N m s about the pose's position */
} BodyState;

/* Indexed as the def's solids; all 0 for fixed solids. */
typedef struct BodyStates {
    BodyState of[SOLIDS_MAX];
} BodyStates;

/* Sums over matter for the energy watch (sim/step/world.h), in the box's frame. Inflow, outflow and
   floating solids add their own sums. */

/* The last fields are needed only in a box that turns. */
typedef struct EnergySums {
    double own;         /* energy of motion and of compression, J */
    double mass;        /* kg */
    double momentum[3]; /* kg m/s */
    double first[3];    /* sum m x, kg m */
    double bare; /* upper bound on the surface of fluid with surface tension, m2: sides between cells of h
                    with fluid and empty cells; from backends that know their cells */
    double second[6]; /* sum m x x: xx, yy, zz, xy, yz, zx, kg m2 */
    double turn[3];   /* sum m x cross v, kg m2/s */
} EnergySums;

/* Adds a mass m (kg) at x (m) with velocity v (m/s). */
static inline void energy_sums_add(EnergySums *sums, double m, const double x[3], const double v[3])
{
    sums->own += 0.5 * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    sums->mass += m;
    for (int k = 0; k < 3; k++) {
        sums->momentum[k] += m * v[k];
        sums->first[k] += m * x[k];
    }
}

/* Adds the mass's sums for a box that turns. */
static inline void energy_sums_add_turning(EnergySums *sums, double m, const double x[3], const double v[3])
{
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        sums->second[k] += m * x[k] * x[k];
        sums->second[3 + k] += m * x[k] * x[next];
        sums->turn[k] += m * (x[next] * v[last] - x[last] * v[next]);
    }
}

/* Settings that may change while a world lives: rows of a def's keys with KEY_LIVE that a solver reads. The
   backend is not live: see world_move. */

/* Numbers of the saved state, in the order of the rows: 14 of the world, and per fluid the viscosity and
   its table. A new live row needs a new number, which older files lack; a test checks the count. */
enum { LIVE_NUMBERS = 14 + FLUIDS_MAX * (1 + sizeof(TimeTable) / sizeof(double)) };

/* Of lists, only the def's elements are saved or loaded; the rest stays. */
void live_save(const WorldDef *def, double numbers[LIVE_NUMBERS]);
void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def);

/* Copies live settings between defs with the same fluids. Includes live keys of methods, which the saved
   state has no room for. */
void live_copy(const WorldDef *from, WorldDef *to);

/* For tests: number of values of the rows, which LIVE_NUMBERS has as a constant. */
int live_count(void);

/* Columns of the particles. A table gives name, contents and treatment of each column; allocation, sorting,
   saving and files are loops over the rows. A method adds rows (sim/step/method.h). */

struct Constants; /* sim/step/constants.h */
struct WorldDef;  /* sim/def.h */

enum { COLUMNS_TERM = 36, COLUMNS_MAX = 48 };
enum { COLUMNS_KEPT = 34, COLUMNS_LEFT = 40, COLUMNS_SHOWN = 43 }; /* indices in ParticleColumns.own */

/* All possible data of a particle, a column each; NULL if not needed. */
typedef struct ParticleColumns {
    float *x, *y, *z;    /* box's frame, m */
    float *vx, *vy, *vz; /* box's frame, m/s */
    ParticleId *id;
    uint8_t *fluid;          /* index into WorldDef.fluids */
    float *compression;      /* rho / rho0 - 1, if particles carry density: rho in single precision would lose
                                the changes per step of a slow flow */
    float *volume;           /* 1 / n, over Constants.unit_volume */
    float *pressure;         /* Pa */
    float *pressure_term;    /* p V^2, Pa */
    float *ax, *ay, *az;     /* m/s2; forces in N until the pass ends */
    float *viscosity;        /* of the particle's fluid, Pa s */
    float *tension;          /* of the particle's fluid, N/m; scaled for cohesion */
    float *kind;             /* fluid number: equal for pairs within a fluid */
    float *own[COLUMNS_OWN]; /* columns of the method, by its rows. From COLUMNS_KEPT on kept columns of
                                terms. From COLUMNS_LEFT on columns_left (unknown: 0). From COLUMNS_SHOWN
                                on columns never read by a step (unknown: NaN) */
    float *term[COLUMNS_TERM]; /* of the shared terms (sim/step/method.h), likewise */
} ParticleColumns;

typedef enum ColumnType { COLUMN_FLOAT, COLUMN_INDEX, COLUMN_BYTE } ColumnType;

/* Treatment of a column; scratch, computed in each step, has no flag. */
enum {
    COLUMN_SAVED = 1,   /* in the saved state */
    COLUMN_SORTED = 2,  /* moved with the particle by the grid */
    COLUMN_FLUIDS = 4,  /* 0 for boundary particles */
    COLUMN_SHADERS = 8, /* scratch of a method or term, also present in its shaders */
};

typedef struct ColumnDef {
    const char *name, *unit;
    size_t at;      /* offset of the first component in ParticleColumns; further components follow */
    int components; /* 1 or 3 */
    ColumnType type;
    unsigned flags;
    bool (*needed)(const struct Constants *constants); /* NULL: always */
} ColumnDef;

/* Offset of the method's column k. */
#define COLUMN_OWN(k) (offsetof(ParticleColumns, own) + (size_t)(k) * sizeof(float *))

/* Offset of column k of the shared terms. */
#define COLUMN_TERM(k) (offsetof(ParticleColumns, term) + (size_t)(k) * sizeof(float *))

/* Offset of column k of a shared term that is kept between steps. */
#define COLUMN_KEPT(k) COLUMN_OWN(COLUMNS_KEPT + (k))

/* Index in `own` of a column's first component; -1: the column is not in `own`. */
int column_own(const ColumnDef *column);

/* True if a method's rows (NULL: none) include a column in `own` saved by every world. */
bool columns_save_own(const ColumnDef *own);

/* Columns of every method; remainders of rounded positions in wide boxes (sim/box/box.h). Both lists end
   with a NULL name. */
extern const ColumnDef columns_common[], columns_left[];

/* True if worlds of the def need columns_left: the box is more than COLUMNS_WIDE spacings wide along an
   axis. From there on the last digit of a position is 8e-6 spacings. Smaller boxes save 24 bytes per
   particle. */
enum { COLUMNS_WIDE = 128 };
bool columns_wide(const struct WorldDef *def);

/* A selection of table rows. */
typedef struct ColumnRows {
    int count;
    const ColumnDef *row[COLUMNS_MAX];
} ColumnRows;

/* Rows with all of `flags`: common rows and the method's rows `own` (ended by a NULL name; NULL: none).
   With constants, only needed rows. */
ColumnRows column_rows(const ColumnDef *own, unsigned flags, const struct Constants *constants);

/* Index in `own` of a scalar of OWN_SCALAR_LIST, among these rows; -1: not present. */
int columns_place(const ColumnRows *rows, Scalar scalar);

/* Bits of the scalars that a state of the def's worlds has. */
uint32_t columns_scalars(const struct WorldDef *def);

/* The array of a component; free, save and copy use this function. */
void **column_array(ParticleColumns *columns, const ColumnDef *column, int component);

size_t column_size(const ColumnDef *column); /* bytes per entry: float, particle id or byte */

/* Allocates missing arrays for `count` particles: zeroed, aligned to a cache line, readable for COLUMN_PAST
   entries past the end. Adds to *bytes (may be NULL). Returns false if memory is short. */
enum { COLUMN_PAST = 7 };
bool columns_create(ParticleColumns *columns, const ColumnRows *rows, size_t count, size_t *bytes);
void columns_destroy(ParticleColumns *columns);

/* Copies to entries [begin, end) of `to` the same entries of `from`, or entries place[k]. Columns missing
   on either side are skipped. */
void columns_copy(const ColumnRows *rows, const ParticleColumns *from, const ParticleColumns *to,
                  const uint32_t *place, size_t begin, size_t end);

/* Swaps the arrays of these rows. */
void columns_swap(const ColumnRows *rows, ParticleColumns *a, ParticleColumns *b);

/* columns_move copies particle `from` over particle `to`; columns_clear sets all these rows of particle i
   to 0. */
void columns_move(const ColumnRows *rows, const ParticleColumns *columns, size_t from, size_t to);
void columns_clear(const ColumnRows *rows, const ParticleColumns *columns, size_t i);

/* The single saved state of a world (DESIGN 2): all data read by the next step. Used alone by snapshots,
   resume, going back after trouble and a change of backend: save, load, step equals step, to the bit. */

struct Method; /* sim/step/method.h */

/* Reference of sim/step/world.h; zero: none yet. */
typedef struct EnergyMark {
    double least;          /* energy of motion and compression minus work since the first look, J */
    double until;          /* step after which a new reference is taken */
    double next;           /* step of the next look; earlier if particles are much faster than */
    double speed;          /* the greatest speed at the last look, m/s */
    double work;           /* work of gravity and of the box's motion since the first look, J */
    double absolute_work;  /* absolute work since `least`, J */
    double surface;        /* surface energy that might come free, at `least`, J */
    double most;           /* allowed gain over `least` at the last look, J */
    double velocity_jumps; /* not 0: the box's velocity jumps in the current step */
    double turning;        /* not 0: the sums include those for a turning box */
    double gauged;         /* not 0: the sums are from a GPU's gauge */
    double time;           /* of the last look, s; sums and box at that time: */
    EnergySums sums;
    BoxState box;
} EnergyMark;

/* The state besides the particles. Doubles only: also an array of WORLD_NUMBERS doubles, stored as such in
   files. */
typedef struct WorldNumbers {
    double version;            /* WORLD_STATE_VERSION */
    double step, since_step;   /* substeps; first step with the present dt */
    double since_time;         /* time of since_step, s */
    double guarded;            /* as WorldInfo.guarded */
    double emitted, drained;   /* as in WorldInfo */
    StepState stepping;        /* step sizes */
    BoxTarget target;          /* of the hand */
    BoxFilter filter;          /* the hand's part of the pose */
    BoxState box;              /* the pose, in the world's frame */
    double live[LIVE_NUMBERS]; /* live settings of the def */
    EnergyMark energy;         /* last members from here on: files may end before them */
    FingerState finger;
    double closed;     /* shut gates of emitters and drains, bits as an integer: sim/flow/flow.h */
    double pours;      /* s: begin of the finger's pouring */
    BodyStates bodies; /* floating solids */
} WorldNumbers;

enum {
    WORLD_STATE_VERSION = 4,
    WORLD_NUMBERS = sizeof(WorldNumbers) / sizeof(double),
    WORLD_NUMBERS_LEAST = offsetof(WorldNumbers, energy) / sizeof(double)
};

/* Zero-initialise; owns its columns. Particles are in any order, identified by `id`. */
typedef struct WorldState {
    WorldNumbers numbers;
    size_t count, capacity;      /* particles; capacity of the columns */
    const struct Method *method; /* owner of the columns, together with terms named by its def */
    ParticleColumns particles;   /* saved columns */
    Births births;               /* empty although particles were emitted: unknown */
} WorldState;

/* Bytes copied by world_save besides the particles. */
size_t world_births_bytes(const World *world);

/* Makes room for `count` particles of a def; old contents are lost. Returns false if memory is short, with
   an empty state. */
bool world_state_reserve(WorldState *state, const WorldDef *def, size_t count);
void world_state_free(WorldState *state); /* a zeroed state is allowed */

/* Saves the numbers alone, for callers with particles from world_read. */
void world_save_numbers(World *world, WorldNumbers *numbers);

/* Copies the world's state. Returns false with the reason: memory is short, or the state is unsound
   (world_is_valid). */
bool world_save(World *world, WorldState *state, Error *error);

/* A world_save without waiting for a GPU: the particles come later, a part at each call. Keeps the device's
   memory for the next save. Zero-initialise. */
typedef struct WorldSaving {
    WorldState *to; /* NULL: nothing is under way */
    const struct BackendCopy *by;
    void *copy;
} WorldSaving;

/* Saves the present state: the numbers now, the particles by calls of world_save_go_on, without the world.
   With nothing under way after the begin the state is whole. An earlier save under way is lost.
   world_save_go_on: reads a part, or `waits` for all; false without an answer of the GPU: the state is lost.
   world_save_end: frees the memory. */
bool world_save_begin(World *world, WorldState *state, WorldSaving *saving, Error *error);
bool world_save_go_on(WorldSaving *saving, bool waits);
void world_save_end(WorldSaving *saving);

/* Loads a state into a world made from the same def, except for live settings. Returns false with the
   reason: a different version, different particles or non-finite numbers; the world is unchanged. */
bool world_load(World *world, const WorldState *state, Error *error);

/* Moves the world to a different backend, which continues from the same state; replaces *world. A context
   must be current as for world_on_gpu, for either backend. Returns false with the reason, with nothing
   changed. */
bool world_move(World **world, const char *backend, Error *error);

/* True if the box can be resized to that of `def` in place. Same solids, with resting solids wholly inside
   before and after, and the new box inside the existing cells. Otherwise rebuild the world. */
bool world_resizes(const World *world, const WorldDef *def);

/* From the next step on, takes box size and solids from `def`, with the hand's poses. Works in place if
   only those differ or if world_resizes; otherwise like world_rebuild. Particles outside of a smaller box
   move to its walls. */
bool world_set_shapes(World **world, const WorldDef *def, Error *error);

/* Loads a state saved with the box and solids of `def`. Replaces *world if its box or solids differ; the
   present state may be unsound. Returns false with the reason, with nothing changed. */
bool world_load_shapes(World **world, const WorldDef *def, const WorldState *state, Error *error);

#endif
