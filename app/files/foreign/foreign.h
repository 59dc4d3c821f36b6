/* Particles in foreign files: parsers of formats, the meanings of column names, series of files.

   A parser is a pure function of bytes, with a fuzz target. A parser fills a table of the columns with a
   known meaning. All numbers are as in the file; app/files/snapshot_foreign.c makes states of slosh from
   tables. */
#ifndef APP_FILES_FOREIGN_FOREIGN_H
#define APP_FILES_FOREIGN_FOREIGN_H

#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- meanings of columns ---- */

/* X(ENUM, words for the user, names in files). Names in files are without case, spaces, signs and units:
   "Pos.x [m]" is posx. A vector has three components, or a column each, with x, y, z or 0, 1, 2 behind the
   name. The first name of the list in a file is taken. */
#define FOREIGN_ROLE_LIST(X)                                                                                 \
    X(PLACE, "place", " points position positions coordinates coords coord pos ")                            \
    X(VELOCITY, "velocity", " velocity velocities vel v u velo ")                                            \
    X(ACCELERATION, "acceleration", " acceleration accelerations accel acc ace ")                            \
    X(DENSITY, "density", " density densities rho rhop dens massdensity ")                                   \
    X(PRESSURE, "pressure", " pressure pressures press p prs ")                                              \
    X(FLUID, "fluid", " fluid fluidid phase material materialid mat species type mk tag ")                   \
    X(ID, "id", " id ids idp particleid particleids pid gid index globalid originalid pointid ")             \
    X(MASS, "mass", " mass masses massp m ")                                                                 \
    X(LENGTH, "smoothing length", " h hsml smoothinglength smoothinglengths ")                               \
    X(SUPPORT, "support radius", " support supportradius kernelradius ")                                     \
    X(TIME, "time", " time timevalue timestep t ")

typedef enum ForeignRole {
#define X(NAME, words, names) FOREIGN_##NAME,
    FOREIGN_ROLE_LIST(X)
#undef X
        FOREIGN_ROLES
} ForeignRole;

/* Other columns of a number: role FOREIGN_ROLES + k for number k in the file, as FILE_SCALAR_LIST has room.
 */
enum { FOREIGN_OTHERS = SCALAR_BORN - SCALAR_COLUMN_1, FOREIGN_OTHERS_END = FOREIGN_ROLES + FOREIGN_OTHERS };

enum { FOREIGN_NAME_SIZE = 64, FOREIGN_COLUMNS_MAX = 256, FOREIGN_ALL = (1 << FOREIGN_OTHERS_END) - 1 };

const char *foreign_role_words(ForeignRole role);

/* Whether a role is a vector. */
bool foreign_role_is_vector(ForeignRole role);

/* A column of a file. */
typedef struct ForeignColumn {
    char name[FOREIGN_NAME_SIZE];
    int components; /* 1, 2 or 3, or more */
    int role, axis; /* ForeignRole or another column, and component for the first value; role -1: not shown */
    int rank;       /* place of the name among the role's names, from 0: the best */
    double *value;  /* [components * i + c]; NULL: not kept */
} ForeignColumn;

/* The particles of a step. */
typedef struct ForeignTable {
    size_t count;
    double time; /* s, NAN: the file has no time */
    int column_count;
    ForeignColumn column[FOREIGN_COLUMNS_MAX];
    int others;     /* count of other columns with a role */
    unsigned roles; /* bit k: columns of role k are kept; set before parsing */
    bool head_only; /* set before parsing: only the time is asked for, and count and columns may be missing */
} ForeignTable;

void foreign_table_free(ForeignTable *table); /* a zeroed table is allowed */

/* Adds a column of table->count values, kept if the table wants the role. Returns NULL with the reason if
   memory is short. A column beyond FOREIGN_COLUMNS_MAX is dropped: *dropped. */
ForeignColumn *foreign_column_add(ForeignTable *table, const char *path, const char *name, int components,
                                  Error *error);

/* Where component `axis` of a role or of another column lies; false: the table lacks it. */
typedef struct ForeignPlace {
    const double *value; /* value[stride * i] */
    size_t stride;
    const char *name;
} ForeignPlace;

bool foreign_find(const ForeignTable *table, int role, int axis, ForeignPlace *place);

/* ---- formats ---- */

/* Bytes of a file, or of a fuzzer. */
typedef struct ForeignBytes {
    const char *path;
    const char *bytes;
    size_t size;
} ForeignBytes;

/* Steps in files. */
typedef struct ForeignStep {
    char *path;
    size_t inner; /* of an HDF5 file: number of its group */
    double time;  /* s; NAN: unknown */
} ForeignStep;

typedef struct ForeignSeries {
    size_t count, capacity;
    ForeignStep *step;
} ForeignSeries;

bool foreign_series_add(ForeignSeries *series, const char *path, size_t inner, double time);
void foreign_series_free(ForeignSeries *series); /* a zeroed series is allowed */

/* A format; a format has `parse`, or `list`, or `list` and `read`. */
typedef struct ForeignFormat {
    const char *name;
    const char *const *endings; /* ".csv", ..., NULL */
    /* Bytes of a step; pure. */
    bool (*parse)(const ForeignBytes *file, ForeignTable *table, Error *error);
    /* The steps in a file, or of an index. */
    bool (*list)(const char *path, ForeignSeries *series, Error *error);
    bool (*read)(const char *path, size_t inner, ForeignTable *table, Error *error);
} ForeignFormat;

extern const ForeignFormat foreign_csv, foreign_ply, foreign_vtk_xml, foreign_vtk_legacy, foreign_pvd,
    foreign_hdf5;

/* Ends with NULL. */
extern const ForeignFormat *const foreign_formats[];

/* The format by the ending of a name; NULL: unknown. */
const ForeignFormat *foreign_format(const char *path);

/* All endings, with commas: for messages. */
void foreign_endings(char words[256]);

/* Parses the index of a series of VTK; pure. */
bool foreign_pvd_parse(const ForeignBytes *file, ForeignSeries *series, Error *error);

/* ---- series ---- */

/* A name with '*': matching files, in the order of numbers. */
bool foreign_is_pattern(const char *path);

/* The steps of a file, an index or a pattern. Returns false with the reason. */
bool foreign_list(const char *path, ForeignSeries *series, Error *error);

/* Reads a step; `roles` and `head_only` as in ForeignTable. Returns false with the reason, and nothing to
   free. */
bool foreign_read(const ForeignStep *step, unsigned roles, bool head_only, ForeignTable *table, Error *error);

/* Count of files beside `path` with another number in the name, and the pattern for all of them; 0: none. */
size_t foreign_siblings(const char *path, char pattern[1024]);

/* ---- parts of parsers ---- */

/* Reads a number at *at, without leading spaces, and moves *at behind the number. Correctly rounded. `nan`
   and `inf` are numbers. Returns false, and *at stays, at something else. */
bool foreign_number(const char **at, const char *end, double *value);

/* Numbers of files. */
typedef enum ForeignType {
    FOREIGN_I8,
    FOREIGN_U8,
    FOREIGN_I16,
    FOREIGN_U16,
    FOREIGN_I32,
    FOREIGN_U32,
    FOREIGN_I64,
    FOREIGN_U64,
    FOREIGN_F32,
    FOREIGN_F64,
    FOREIGN_TYPES
} ForeignType;

size_t foreign_type_bytes(ForeignType type);

/* Converts numbers in memory. `swapped`: of the other byte order. */
void foreign_convert(const void *from, ForeignType type, bool swapped, size_t count, double *to);

/* Refuses counts of particles without room in the file: at most 1032 times compressed. */
bool foreign_count_fits(const ForeignBytes *file, double count, Error *error);

#endif
