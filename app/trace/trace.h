/* Paths of particles through the steps of a file, with one step in memory at a time: the lines of the
   overlay trails as numbers. The choice of particles, and the start and end of lines, follow the overlay
   (docs/views). */
#ifndef SLOSH_TRACE_H
#define SLOSH_TRACE_H

#include "app/output/snapshot_frame.h"
#include "app/output/snapshot_sift.h"
#include "app/output/step_buffers.h"
#include "app/trace/trace_def.h"
#include "app/trace/trace_rows.h"

#include <stdint.h>

/* State of a particle in its last step. */
typedef struct TraceEnd {
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
} TraceEnd;

/* Zero-initialise, then call trace_begin. */
typedef struct Trace {
    const TraceDef *def;
    SnapshotScene scene;
    SnapshotFrame frame; /* frame of `place`; the scalar is in the box's frame */
    Scalar scalar;
    const char *beside;  /* see trace_rows_add */
    StepBuffers buffers; /* for derived scalars: needs a current OpenGL 4.5 core context */
    float *values;       /* of the present step */
    size_t values_room;  /* capacity, particles */
    TraceEnd *ends;      /* hash table by id */
    size_t ends_room, ends_count;
    uint64_t steps, columns; /* so far */
    double time;             /* of the last column, s */
    TraceRows place;         /* per point: float[3] */
    TraceRows when;          /* per point: double, s */
    TraceRows value;         /* per point: float */
    TraceRows line;          /* per point: uint32, index of the line */
    TraceRows id;            /* per line: int64 */
} Trace;

/* Begins a trace. `beside` is not copied. */
void trace_begin(Trace *trace, const TraceDef *def, const SnapshotScene *scene, SnapshotFrame frame,
                 Scalar scalar, const char *beside);
void trace_free(Trace *trace);

/* True if a step at `time` adds points: at least `every` after the last points. */
bool trace_is_column(const Trace *trace, double time);

/* Adds the file's next step; with `column` its positions become points. Returns false if memory or disk is
   short. */
bool trace_step(Trace *trace, const SnapshotStep *step, bool column, Error *error);

/* Sorts the points by line. `order` gets the index of each point, line by line; `offset` gets each line's
   end in `order`; both int32. Returns false if the disk is full or there are too many points. */
bool trace_lines(const Trace *trace, TraceRows *order, TraceRows *offset, Error *error);

#endif
