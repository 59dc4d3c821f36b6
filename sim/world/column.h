/* The columns of the particles: one table says of each what it is called, what it holds, and what becomes of
   it. Allocation, sorting, saving and files are loops over the rows. A method adds rows of its own
   (sim/world/method.h). */
#ifndef SLOSH_COLUMN_H
#define SLOSH_COLUMN_H

#include "sim/base/particle_id.h"
#include "sim/base/scalar.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct Constants; /* sim/world/constants.h */
struct WorldDef;  /* sim/matter/world_def.h */

enum { COLUMNS_OWN = 37, COLUMNS_TERM = 36, COLUMNS_MAX = 48 };
enum { COLUMNS_KEPT = 25, COLUMNS_LEFT = 31, COLUMNS_SHOWN = 34 }; /* of ParticleColumns.own */

/* All that there may be of a particle, a column each; NULL where it is not needed. */
typedef struct ParticleColumns {
    float *x, *y, *z;    /* box's frame, m */
    float *vx, *vy, *vz; /* box's frame, m/s */
    ParticleId *id;
    uint8_t *fluid;       /* index into WorldDef.fluids */
    float *compression;   /* rho / rho0 - 1, of a method whose particles carry their density: rho itself, in
                             single precision, would lose what a slow flow adds in a step */
    float *volume;        /* 1 / n, over Constants.unit_volume */
    float *pressure;      /* Pa */
    float *pressure_term; /* p V^2, Pa */
    float *ax, *ay, *az;  /* m/s2; forces until their pass ends, N */
    float *viscosity;     /* of the particle's fluid, Pa s */
    float *tension;       /* the same, N/m; of cohesion scaled */
    float *kind;          /* its fluid as a number: pairs of one fluid have the same */
    float *own[COLUMNS_OWN];   /* of the method: as its rows say; from COLUMNS_KEPT on what terms keep; from
                                  COLUMNS_LEFT on columns_left, where 0 is what is not known; from
                                  COLUMNS_SHOWN on what no step reads, where that is NaN */
    float *term[COLUMNS_TERM]; /* of terms that methods share (sim/world/method.h): the same */
} ParticleColumns;

typedef enum ColumnType { COLUMN_FLOAT, COLUMN_INDEX, COLUMN_BYTE } ColumnType;

/* What becomes of a column; scratch, which each step makes anew, has none of these. */
enum {
    COLUMN_SAVED = 1,   /* a part of the saved state */
    COLUMN_SORTED = 2,  /* goes with its particle when the grid sorts them */
    COLUMN_FLUIDS = 4,  /* 0 for the particles of solids */
    COLUMN_SHADERS = 8, /* scratch of a method's own or of a term that their shaders have too */
};

typedef struct ColumnDef {
    const char *name, *unit;
    size_t at;      /* of its first component in ParticleColumns; the others stand next to it */
    int components; /* 1 or 3 */
    ColumnType type;
    unsigned flags;
    bool (*needed)(const struct Constants *constants); /* NULL: always */
} ColumnDef;

/* Where the method's own column k stands. */
#define COLUMN_OWN(k) (offsetof(ParticleColumns, own) + (size_t)(k) * sizeof(float *))

/* Where column k of the shared terms stands. */
#define COLUMN_TERM(k) (offsetof(ParticleColumns, term) + (size_t)(k) * sizeof(float *))

/* Where a shared term's column k stands that goes on from step to step. */
#define COLUMN_KEPT(k) COLUMN_OWN(COLUMNS_KEPT + (k))

/* Which of the method's own a column's first component is; -1: none of them. */
int column_own(const ColumnDef *column);

/* Whether a method, by its rows (NULL: none), saves some of its own. */
bool columns_save_own(const ColumnDef *own);

/* Those of every method; what rounding leaves of places in wide boxes (sim/box/place.h). Each is ended by a
   NULL name. */
extern const ColumnDef columns_common[], columns_left[];

/* Whether the def's worlds have the latter: the box is more than COLUMNS_WIDE spacings wide along an axis,
   from where on the last digit of a place is 8e-6 spacings. Others do without 24 bytes a particle. */
enum { COLUMNS_WIDE = 128 };
bool columns_wide(const struct WorldDef *def);

/* Some rows of the table. */
typedef struct ColumnRows {
    int count;
    const ColumnDef *row[COLUMNS_MAX];
} ColumnRows;

/* Rows with all these flags, of those that every method has and of the method's `own` (ended by a NULL name;
   NULL: none). With constants only those that are needed. */
ColumnRows column_rows(const ColumnDef *own, unsigned flags, const struct Constants *constants);

/* The scalar that a component of one of the methods' own is: NAME, or of three NAME_x, NAME_y, NAME_z. */
enum { COLUMN_NAME_SIZE = 32 };
void column_scalar_name(const ColumnDef *column, int component, char name[COLUMN_NAME_SIZE]);

/* Which of the methods' own a scalar of OWN_SCALAR_LIST is, of these rows; -1: none of them has it. */
int columns_place(const ColumnRows *rows, Scalar scalar);

/* PARTICLE_SCALAR by PARTICLE_SCALAR, what a state of the def's worlds has of its own. */
uint32_t columns_scalars(const struct WorldDef *def);

/* The array of a component; free, save and copy go through it. */
void **column_array(ParticleColumns *columns, const ColumnDef *column, int component);

size_t column_size(const ColumnDef *column); /* of an entry, bytes; of an index that of an id */

/* Arrays for `count` particles where there are none: zeroed, aligned to a cache line, readable for
   COLUMN_PAST entries past the end. Adds to *bytes (may be NULL). False when memory is short. */
enum { COLUMN_PAST = 7 };
bool columns_create(ParticleColumns *columns, const ColumnRows *rows, size_t count, size_t *bytes);
void columns_destroy(ParticleColumns *columns);

/* Entries [begin, end) of `to` out of `from`: the same, or those at place[k]. What either lacks is left
   out. */
void columns_copy(const ColumnRows *rows, const ParticleColumns *from, const ParticleColumns *to,
                  const uint32_t *place, size_t begin, size_t end);

/* The two change places, of these rows. */
void columns_swap(const ColumnRows *rows, ParticleColumns *a, ParticleColumns *b);

/* Particle `from` takes the place `to`; particle i has 0 in all of these rows. */
void columns_move(const ColumnRows *rows, const ParticleColumns *columns, size_t from, size_t to);
void columns_clear(const ColumnRows *rows, const ParticleColumns *columns, size_t i);

#endif
