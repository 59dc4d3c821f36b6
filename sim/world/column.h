/* Columns of the particles. A table gives name, contents and treatment of each column; allocation, sorting,
   saving and files are loops over the rows. A method adds rows (sim/world/method.h). */
#ifndef SLOSH_COLUMN_H
#define SLOSH_COLUMN_H

#include "sim/base/particle_id.h"
#include "sim/base/scalar.h"
#include "sim/world/step_types.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct Constants; /* sim/world/constants.h */
struct WorldDef;  /* sim/matter/world_def.h */

enum { COLUMNS_TERM = 36, COLUMNS_MAX = 48 };
enum { COLUMNS_KEPT = 32, COLUMNS_LEFT = 38, COLUMNS_SHOWN = 41 }; /* indices in ParticleColumns.own */

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
    float *own[COLUMNS_OWN]; /* columns of the method, by its rows; from COLUMNS_KEPT on kept columns of
                                terms; from COLUMNS_LEFT on columns_left (unknown: 0); from COLUMNS_SHOWN
                                on columns never read by a step (unknown: NaN) */
    float *term[COLUMNS_TERM]; /* of the shared terms (sim/world/method.h), likewise */
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

/* True if a method's rows (NULL: none) include a saved column in `own`. */
bool columns_save_own(const ColumnDef *own);

/* Columns of every method; remainders of rounded positions in wide boxes (sim/box/place.h). Both lists end
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

/* Name of the scalar for a component of a method's column: NAME, or NAME_x, NAME_y, NAME_z for three
   components. */
enum { COLUMN_NAME_SIZE = 32 };
void column_scalar_name(const ColumnDef *column, int component, char name[COLUMN_NAME_SIZE]);

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

#endif
