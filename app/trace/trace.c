#include "app/trace/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ENDS_LEAST = 1024 };

void trace_begin(Trace *trace, const TraceDef *def, const SnapshotScene *scene, SnapshotFrame frame,
                 Scalar scalar, const char *beside)
{
    *trace = (Trace){
        .def = def, .scene = *scene, .frame = frame, .scalar = scalar, .beside = beside, .time = -INFINITY};
    trace->place.row = sizeof(float[3]);
    trace->when.row = sizeof(double);
    trace->value.row = sizeof(float);
    trace->line.row = sizeof(uint32_t);
    trace->id.row = sizeof(int64_t);
}

void trace_free(Trace *trace)
{
    free(trace->values);
    free(trace->ends);
    trace_rows_free(&trace->place);
    trace_rows_free(&trace->when);
    trace_rows_free(&trace->value);
    trace_rows_free(&trace->line);
    trace_rows_free(&trace->id);
    step_buffers_destroy(&trace->buffers);
}

bool trace_is_column(const Trace *trace, double time)
{
    return time - trace->time >= 0.999 * trace->def->every;
}

/* ---- hash table of particles ---- */

/* Returns the entry of an id, or a free entry for the id. After: Steele, Lea and Flood, Fast splittable
   pseudorandom number generators, 2014 (its mixing of 64 bits). */
static TraceEnd *place_of(TraceEnd *ends, size_t room, int64_t id)
{
    uint64_t x = (uint64_t)id;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
    x = (x ^ x >> 27) * 0x94d049bb133111ebU;
    for (size_t at = (size_t)(x ^ x >> 31);; at++) {
        TraceEnd *end = &ends[at & (room - 1)];
        if (!end->used || end->id == id)
            return end;
    }
}

/* Grows the table to keep half of the entries free. */
static bool make_room(Trace *trace, Error *error)
{
    const size_t room = trace->ends_room > 0 ? 2 * trace->ends_room : ENDS_LEAST;
    if (2 * (trace->ends_count + 1) <= trace->ends_room)
        return true;
    TraceEnd *ends = calloc(room, sizeof *ends);
    if (!ends)
        return error_set(error, "out of memory for %zu trails; take a larger stride", trace->ends_count);
    for (size_t i = 0; i < trace->ends_room; i++)
        if (trace->ends[i].used)
            *place_of(ends, room, trace->ends[i].id) = trace->ends[i];
    free(trace->ends);
    trace->ends = ends;
    trace->ends_room = room;
    return true;
}

/* ---- the scalar ---- */

static bool fill_values(Trace *trace, const SnapshotStep *step, Error *error)
{
    if (step->count > trace->values_room) {
        free(trace->values);
        trace->values = malloc(step->count * sizeof *trace->values);
        trace->values_room = trace->values ? step->count : 0;
        if (!trace->values)
            return error_set(error, "out of memory for the particles");
    }
    if (step->count == 0)
        return true;
    return step_buffers_scalar(&trace->buffers, &trace->scene, step, trace->scalar, trace->values, error);
}

/* ---- lines ---- */

static bool is_in_region(const TraceDef *def, const float at[3])
{
    bool inside = true;
    for (int k = 0; k < 3; k++)
        inside &= at[k] >= def->region_min[k] && at[k] <= def->region_max[k];
    return inside || !trace_def_has_region(def);
}

static bool is_behind(const TraceDef *def, const float at[3])
{
    double side = 0;
    for (int k = 0; k < 3; k++)
        side += def->plane_normal[k] * (at[k] - def->plane_point[k]);
    return side < 0;
}

/* True if the particle crossed the plane since the last step, where its position was end->at. */
static bool crosses(const Trace *trace, const TraceEnd *end, const float at[3])
{
    return trace_def_has_plane(trace->def) && end->step + 1 == trace->steps &&
           is_behind(trace->def, end->at) != is_behind(trace->def, at);
}

/* True if the line continues from the last column, without crossing a periodic side. */
static bool joins(const Trace *trace, const TraceEnd *end, const float at[3])
{
    bool near = end->shown && end->column > 0 && end->column + 1 == trace->columns;
    for (int k = 0; k < 3; k++)
        near &=
            !trace->scene.periodic[k] || fabs((double)at[k] - end->point[k]) <= trace->scene.box_size[k] / 2;
    return near;
}

static bool add_point(Trace *trace, const TraceEnd *end, Error *error)
{
    return trace_rows_add(&trace->place, end->place, 1, trace->beside, error) &&
           trace_rows_add(&trace->when, &end->time, 1, trace->beside, error) &&
           trace_rows_add(&trace->value, &end->value, 1, trace->beside, error) &&
           trace_rows_add(&trace->line, &end->line, 1, trace->beside, error);
}

/* Begins a line with the previous point. */
static bool begin_line(Trace *trace, TraceEnd *end, Error *error)
{
    end->line = (uint32_t)trace->id.count;
    end->on_line = true;
    return trace_rows_add(&trace->id, &end->id, 1, trace->beside, error) && add_point(trace, end, error);
}

static void set_place(const Trace *trace, const SnapshotStep *step, const float at[3], float place[3])
{
    const double x[3] = {at[0], at[1], at[2]};
    double moved[3];
    memcpy(place, at, sizeof(float[3]));
    if (trace->frame != FRAME_WORLD)
        return;
    box_to_world(&step->box, x, NULL, moved, NULL);
    for (int k = 0; k < 3; k++)
        place[k] = (float)moved[k];
}

static bool take_point(Trace *trace, TraceEnd *end, const SnapshotStep *step, size_t i, const float at[3],
                       Error *error)
{
    const bool on = joins(trace, end, at);
    if (on && !end->on_line && !begin_line(trace, end, error))
        return false;
    end->on_line = on;
    end->column = trace->columns;
    end->time = step->time;
    end->value = trace->values[i];
    memcpy(end->point, at, sizeof end->point);
    set_place(trace, step, at, end->place);
    return !on || add_point(trace, end, error);
}

static bool take_particle(Trace *trace, const SnapshotStep *step, size_t i, bool column, Error *error)
{
    const float at[3] = {step->position[0][i], step->position[1][i], step->position[2][i]};
    if (!trace_def_takes(trace->def, step->id[i]))
        return true;
    if (!make_room(trace, error))
        return false;
    TraceEnd *end = place_of(trace->ends, trace->ends_room, step->id[i]);
    if (end->used && end->step == trace->steps)
        return true; /* duplicate id: only the first particle has the trail */
    if (!end->used) {
        *end = (TraceEnd){.id = step->id[i],
                          .used = true,
                          .shown = !trace_def_has_plane(trace->def) && is_in_region(trace->def, at)};
        trace->ends_count++;
    } else if (crosses(trace, end, at))
        end->shown = true;
    end->step = trace->steps;
    memcpy(end->at, at, sizeof end->at);
    return !column || take_point(trace, end, step, i, at, error);
}

bool trace_step(Trace *trace, const SnapshotStep *step, bool column, Error *error)
{
    trace->steps++;
    if (column) {
        trace->columns++;
        trace->time = step->time;
        if (!fill_values(trace, step, error))
            return false;
    }
    for (size_t i = 0; i < step->count; i++)
        if (!take_particle(trace, step, i, column, error))
            return false;
    return true;
}

/* Counting sort by line: `offset` first counts the points per line, then holds the next free index of each
   line. */
bool trace_lines(const Trace *trace, TraceRows *order, TraceRows *offset, Error *error)
{
    const size_t points = trace->line.count, lines = trace->id.count;
    *order = *offset = (TraceRows){.row = sizeof(int32_t)};
    if (points > INT32_MAX)
        return error_set(error,
                         "%zu points of trails are more than a .vtp of them holds; take a larger "
                         "stride or every",
                         points);
    if (!trace_rows_add(order, NULL, points, trace->beside, error) ||
        !trace_rows_add(offset, NULL, lines, trace->beside, error))
        return false;
    int32_t *number = order->data, *next = offset->data, begin = 0;
    const uint32_t *line = trace->line.data;
    for (size_t i = 0; i < points; i++)
        next[line[i]]++;
    for (size_t k = 0; k < lines; k++) {
        const int32_t count = next[k];
        next[k] = begin;
        begin += count;
    }
    for (size_t i = 0; i < points; i++)
        number[next[line[i]]++] = (int32_t)i;
    return true;
}
