/* The paths of particles through the steps of a file, one step in memory at a time: what the overlay trails
   draws of them, as numbers. What has a trail, and where lines begin and end, is as it says (docs/views). */
#ifndef SLOSH_TRACE_H
#define SLOSH_TRACE_H

#include "app/output/snapshot_frame.h"
#include "app/output/snapshot_sift.h"
#include "app/output/step_buffers.h"
#include "app/trace/trace_def.h"
#include "app/trace/trace_rows.h"

#include <stdint.h>

/* Where a particle was in the last step that had it. */
typedef struct TraceEnd {
    int64_t id;
    uint32_t line; /* that it is on, where `on_line` */
    bool used, shown, on_line;
    uint64_t step;   /* of the file, counted from 1 */
    uint64_t column; /* the last time for which points were taken, counted from 1; 0: none */
    float at[3];     /* box's frame, m: in that step; */
    float point[3];  /* in the last column: */
    float place[3];  /* in the frame that is wanted */
    float value;
    double time; /* s */
} TraceEnd;

/* Zero-initialise it, then trace_begin. */
typedef struct Trace {
    const TraceDef *def;
    SnapshotScene scene;
    SnapshotFrame frame; /* of `place`; the scalar is that of the box's frame */
    Scalar scalar;
    const char *beside;  /* see trace_rows_add */
    StepBuffers buffers; /* of a scalar that is derived: needs a current OpenGL 4.5 core context */
    float *values;       /* of the step, */
    size_t values_room;  /* and for how many particles there is room */
    TraceEnd *ends;      /* by a hash of the id */
    size_t ends_room, ends_count;
    uint64_t steps, columns; /* so far */
    double time;             /* of the last column, s */
    TraceRows place;         /* of each point: float[3], */
    TraceRows when;          /* double, s, */
    TraceRows value;         /* float, */
    TraceRows line;          /* uint32: on which */
    TraceRows id;            /* of each line: int64 */
} Trace;

/* `beside` stays the caller's. */
void trace_begin(Trace *trace, const TraceDef *def, const SnapshotScene *scene, SnapshotFrame frame,
                 Scalar scalar, const char *beside);
void trace_free(Trace *trace);

/* Whether a step of that time adds points: at least `every` after those before. */
bool trace_is_column(const Trace *trace, double time);

/* The next step of the file; with `column` its places become points. False when memory or disk are short. */
bool trace_step(Trace *trace, const SnapshotStep *step, bool column, Error *error);

/* The points of the lines in their order: `order` has the number of each point, line by line, and `offset`
   for each line where the next begins; both int32. False when the disk is full or there are too many. */
bool trace_lines(const Trace *trace, TraceRows *order, TraceRows *offset, Error *error);

#endif
