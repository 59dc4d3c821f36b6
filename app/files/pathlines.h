/* Pathlines of particles from a file of snapshots, for `slosh export --trails`. */
#ifndef APP_FILES_PATHLINES_H
#define APP_FILES_PATHLINES_H

#include "app/files/snapshot.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Choice of trails for a file: keys with the names of the overlay trails, in one line of text. */

enum { PATHLINES_IDS_MAX = 256, PATHLINES_IDS_SIZE = 2048 };

typedef struct PathlinesDef {
    int stride;                             /* one of `stride` ids has a trail */
    double length;                          /* s, back from the end; 0: from the file's first step */
    double every;                           /* least time between points, s; 0: each step */
    double region_min[3], region_max[3];    /* m, box's frame: only particles first seen inside; equal: all */
    double plane_point[3], plane_normal[3]; /* only particles crossing the plane; normal 0: all */
    char ids[PATHLINES_IDS_SIZE];           /* "3 17 250": only these ids; "all": by stride */
    int64_t id[PATHLINES_IDS_MAX];          /* of `ids`, ascending */
    int id_count;                           /* 0: all */
} PathlinesDef;

/* Reads "{stride: 20, length: 2}"; all keys are optional. Returns false with advice. */
bool pathlines_def_read(PathlinesDef *def, const char *text, Error *error);

/* True if trails are limited to a plane's crossings, or to a region. */
bool pathlines_def_has_plane(const PathlinesDef *def);
bool pathlines_def_has_region(const PathlinesDef *def);

/* Rows in a growing memory map of an unnamed file beside the output, as they may exceed the memory. */

/* Zero-initialise, then set `row`. */
typedef struct PathlineRows {
    void *data; /* `count` rows; moves when rows are added */
    size_t row; /* bytes */
    size_t count;
    size_t room; /* bytes */
    int file;    /* file descriptor, if `data` is not NULL */
} PathlineRows;

void pathline_rows_free(PathlineRows *rows);

/* Paths of particles through the steps of a file, with one step in memory at a time: the lines of the
   overlay trails as numbers. The choice of particles, and the start and end of lines, follow the overlay
   (docs/views). */

/* State of a particle in its last step. */
typedef struct PathlineEnd {
    int64_t id;
    uint32_t line; /* current line, if `on_line` */
    bool used, shown, on_line;
    uint64_t step;   /* of the file, counted from 1 */
    uint64_t column; /* last time with points, counted from 1; 0: none */
    float at[3];     /* box's frame, m: in step `step` */
    float point[3];  /* in column `column` */
    float place[3];  /* `point` in the requested frame */
    float value;
    double time; /* s */
} PathlineEnd;

/* Zero-initialise, then call pathlines_begin. */
typedef struct Pathlines {
    const PathlinesDef *def;
    SnapshotScene scene;
    SnapshotFrame frame; /* frame of `place`; the scalar is in the box's frame */
    Scalar scalar;
    const char *beside;      /* see pathline_rows_add */
    SnapshotBuffers buffers; /* for derived scalars: needs a current OpenGL 4.5 core context */
    float *values;           /* of the present step */
    size_t values_room;      /* capacity, particles */
    PathlineEnd *ends;       /* hash table by id */
    size_t ends_room, ends_count;
    uint64_t steps, columns; /* so far */
    double time;             /* of the last column, s */
    PathlineRows place;      /* per point: float[3] */
    PathlineRows when;       /* per point: double, s */
    PathlineRows value;      /* per point: float */
    PathlineRows line;       /* per point: uint32, index of the line */
    PathlineRows id;         /* per line: int64 */
} Pathlines;

/* Begins a trace. `beside` is not copied. */
void pathlines_begin(Pathlines *trace, const PathlinesDef *def, const SnapshotScene *scene,
                     SnapshotFrame frame, Scalar scalar, const char *beside);
void pathlines_free(Pathlines *trace);

/* True if a step at `time` adds points: at least `every` after the last points. */
bool pathlines_step_has_points(const Pathlines *trace, double time);

/* Adds the file's next step; with `column` its positions become points. Returns false if memory or disk is
   short. */
bool pathlines_step(Pathlines *trace, const SnapshotStep *step, bool column, Error *error);

/* Sorts the points by line. `order` gets the index of each point, line by line; `offset` gets each line's
   end in `order`; both int32. Returns false if the disk is full or there are too many points. */
bool pathlines_sort(const Pathlines *trace, PathlineRows *order, PathlineRows *offset, Error *error);

#endif
