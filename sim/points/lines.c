#include "sim/base/base.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_LINES = 4096, MOST_LINES = 1 << 21, SOME_LINES = 1024, A_RANGE = 64, NINTHS = 6 };

static const size_t enough = (size_t)1 << 21; /* crossings: more than any number of walkers */
static const double pieces_most = 1e5;        /* along an axis: a thousand lines take a second or two */

/* Results of the lines of a range. */
typedef struct LineExtremes {
    size_t count, capacity, flat; /* flat: crossings without a gradient */
    float (*place)[3];
    double least, most; /* of the field */
    bool no_memory, no_number;
    float bad[3]; /* a position where the field is not finite */
} LineExtremes;

typedef struct LineSearchJob {
    const LineSearch *search;
    double shift[4], face[3]; /* m2: face across each axis */
    size_t first;             /* line of the first range */
    LineExtremes *found;
} LineSearchJob;

typedef struct SearchLine {
    double from[3], along[3], length; /* m; unit */
} SearchLine;

static double part(double a)
{
    return a - floor(a);
}

/* The i-th line: enters the box at a uniform point on its faces, at an angle by the cosine law. */
static SearchLine line_of(const LineSearchJob *lines, size_t i)
{
    const LineSearch *search = lines->search;
    static const double ratio = 1.1673039782614187; /* ratio^5 = ratio + 1 */
    double u[4], power = 1;
    for (int k = 0; k < 4; k++) {
        power /= ratio;
        u[k] = part(lines->shift[k] + (double)(i + 1) * power);
    }
    double left = 2 * u[0] * (lines->face[0] + lines->face[1] + lines->face[2]);
    int axis = 0, side = 0;
    while (left >= lines->face[axis] && (axis < 2 || side == 0)) {
        left -= lines->face[axis];
        axis += side;
        side = !side;
    }
    const int v = (axis + 1) % 3, w = (axis + 2) % 3;
    const double *low = search->low, *high = search->high, tilt = sqrt(u[2]);
    SearchLine line = {.length = HUGE_VAL};
    f8 sine, cosine;
    f8_sincos(f8_splat((float)u[3]), &sine,
              &cosine); /* the C library's functions differ between processors */
    line.from[axis] = side ? high[axis] : low[axis];
    line.from[v] = low[v] + (high[v] - low[v]) * fmin(left / lines->face[axis], 1);
    line.from[w] = low[w] + (high[w] - low[w]) * u[1];
    line.along[axis] = (side ? -1 : 1) * sqrt(1 - u[2]);
    line.along[v] = tilt * (double)cosine[0];
    line.along[w] = tilt * (double)sine[0];
    for (int k = 0; k < 3; k++)
        if (line.along[k] != 0)
            line.length =
                fmin(line.length, ((line.along[k] > 0 ? high[k] : low[k]) - line.from[k]) / line.along[k]);
    return line;
}

/* Samples eight positions of a line, `apart` from each other. */
static void look(const LineSearch *search, const SearchLine *line, double from, double apart, LanePlace *p,
                 LaneSample *s)
{
    for (int lane = 0; lane < LANES; lane++) {
        const double t = fmin(from + lane * apart, line->length);
        p->x[lane] = (float)(line->from[0] + t * line->along[0]);
        p->y[lane] = (float)(line->from[1] + t * line->along[1]);
        p->z[lane] = (float)(line->from[2] + t * line->along[2]);
    }
    level_lanes(search->field, p, s);
}

static void add(LineExtremes *found, const LanePlace *p, int lane)
{
    if (found->count == found->capacity) {
        const size_t capacity = found->capacity ? 2 * found->capacity : 2 * A_RANGE;
        void *larger = realloc(found->place, capacity * sizeof *found->place);
        found->no_memory |= !larger;
        if (!larger)
            return;
        found->place = larger;
        found->capacity = capacity;
    }
    float *place = found->place[found->count++];
    place[0] = p->x[lane];
    place[1] = p->y[lane];
    place[2] = p->z[lane];
}

/* Refines a crossing between `from` and `from` + apart: by a factor of nine per round. */
static void refine(const LineSearch *search, const SearchLine *line, double from, double apart, bool inside,
                   LineExtremes *found)
{
    const float level = (float)search->level;
    LanePlace p;
    LaneSample s;
    int lane = 0;
    for (int round = 0; round < NINTHS; round++) {
        apart /= LANES + 1;
        look(search, line, from + apart, apart, &p, &s);
        for (lane = 0; lane < LANES && (s.value[lane] >= level) == inside; lane++)
            from += apart;
    }
    lane -= lane == LANES;
    if (s.x[lane] * s.x[lane] + s.y[lane] * s.y[lane] + s.z[lane] * s.z[lane] > 0)
        add(found, &p, lane);
    else
        found->flat++;
}

static bool note_value(LineExtremes *found, const LanePlace *p, const LaneSample *s, int lane)
{
    if (!isfinite(s->value[lane])) {
        if (!found->no_number)
            memcpy(found->bad, (float[]){p->x[lane], p->y[lane], p->z[lane]}, sizeof found->bad);
        found->no_number = true;
        return false;
    }
    found->least = fmin(found->least, s->value[lane]);
    found->most = fmax(found->most, s->value[lane]);
    return true;
}

/* The last sample of a line. */
typedef struct FieldSample {
    bool inside;
    double value, slope; /* value's unit per m, along the line */
} FieldSample;

static FieldSample seen(const LineSearch *search, const SearchLine *line, const LaneSample *s, int lane)
{
    return (FieldSample){s->value[lane] >= (float)search->level, (double)s->value[lane],
                         (double)s->x[lane] * line->along[0] + (double)s->y[lane] * line->along[1] +
                             (double)s->z[lane] * line->along[2]};
}

/* True if the line may have crossed the level and come back: extrapolated by their slopes, both ends reach
   the level. */
static bool may_graze(const LineSearch *search, const FieldSample *a, const FieldSample *b, double apart)
{
    const double side = a->inside ? -1 : 1, level = side * search->level;
    return side * a->slope > 0 && side * b->slope < 0 && side * (a->value + apart * a->slope) > level &&
           side * (b->value - apart * b->slope) > level;
}

static void look_closer(const LineSearch *search, const SearchLine *line, double from, double apart,
                        bool inside, LineExtremes *found)
{
    LanePlace p;
    LaneSample s;
    const double ninth = apart / (LANES + 1);
    look(search, line, from + ninth, ninth, &p, &s);
    bool last = inside;
    for (int lane = 0; lane <= LANES; lane++) {
        const bool here = lane < LANES ? s.value[lane] >= (float)search->level : inside;
        if (here != last)
            refine(search, line, from + lane * ninth, ninth, last, found);
        last = here;
    }
}

/* Length of a line in steps of the field, with each axis's own step. */
static double steps_along(const LineSearch *search, const SearchLine *line)
{
    double square = 0;
    for (int k = 0; k < 3; k++)
        square += pow(line->along[k] / search->field->march[k], 2);
    return line->length * sqrt(square);
}

static void follow(const LineSearch *search, const SearchLine *line, LineExtremes *found)
{
    const int pieces = (int)ceil(steps_along(search, line)) + 1;
    const double apart = line->length / pieces;
    FieldSample last = {0};
    for (int i = 0; i <= pieces; i += LANES) {
        LanePlace p;
        LaneSample s;
        look(search, line, i * apart, apart, &p, &s);
        for (int lane = 0; lane < LANES && i + lane <= pieces; lane++) {
            const FieldSample here = seen(search, line, &s, lane);
            const double from = (i + lane - 1) * apart;
            if (!note_value(found, &p, &s, lane))
                return;
            if (i + lane > 0 && here.inside != last.inside)
                refine(search, line, from, apart, last.inside, found);
            else if (i + lane > 0 && may_graze(search, &last, &here, apart))
                look_closer(search, line, from, apart, last.inside, found);
            last = here;
        }
    }
}

static void follow_range(void *context, size_t begin, size_t end)
{
    const LineSearchJob *lines = context;
    LineExtremes *found = &lines->found[begin / A_RANGE];
    found->least = HUGE_VAL;
    found->most = -HUGE_VAL;
    for (size_t i = begin; i < end && !found->no_number && !found->no_memory; i++) {
        const SearchLine line = line_of(lines, lines->first + i);
        if (line.length > 0)
            follow(lines->search, &line, found);
    }
}

/* Appends the results of the ranges, in order, and sums up the figures. */
static bool gather(const LineExtremes *found, size_t ranges, Crossings *crossings, LineExtremes *all,
                   Error *error)
{
    size_t count = crossings->count;
    for (size_t r = 0; r < ranges; r++) {
        if (found[r].no_number && !all->no_number)
            memcpy(all->bad, found[r].bad, sizeof all->bad);
        all->no_number |= found[r].no_number;
        all->no_memory |= found[r].no_memory;
        all->flat += found[r].flat;
        all->least = fmin(all->least, found[r].least);
        all->most = fmax(all->most, found[r].most);
        count += found[r].count;
    }
    if (all->no_number)
        return error_set(error, "the field is no number at (%.4g, %.4g, %.4g) m", (double)all->bad[0],
                         (double)all->bad[1], (double)all->bad[2]);
    void *larger = all->no_memory ? NULL : realloc(crossings->place, (count + 1) * sizeof *crossings->place);
    if (!larger)
        return error_set(error, "no memory for %zu places on a surface", count);
    crossings->place = larger;
    for (size_t r = 0; r < ranges; r++) {
        if (found[r].count > 0)
            memcpy(crossings->place + crossings->count, found[r].place,
                   found[r].count * sizeof *found[r].place);
        crossings->count += found[r].count;
    }
    return true;
}

static bool more_lines(LineSearchJob *lines, size_t count, Crossings *crossings, LineExtremes *all,
                       Error *error)
{
    const size_t ranges = (count + A_RANGE - 1) / A_RANGE;
    lines->first = crossings->lines;
    lines->found = calloc(ranges + 1, sizeof *lines->found);
    if (!lines->found)
        return error_set(error, "no memory to follow %zu lines", count);
    parallel_ranges(lines->search->threads, count, A_RANGE, follow_range, lines);
    const bool ok = gather(lines->found, ranges, crossings, all, error);
    for (size_t r = 0; r < ranges; r++)
        free(lines->found[r].place);
    free(lines->found);
    crossings->lines += count;
    return ok;
}

/* The reason for an empty result. */
static bool none(const LineSearch *search, const LineExtremes *all, size_t lines, Error *error)
{
    const double level = search->level, slack = 1e-3 * (all->most - all->least);
    if (all->flat > 0)
        return error_set(
            error, "the field jumps at level %.6g: its gradient is zero there, so no surface has a normal",
            level);
    if (all->most <= all->least)
        return error_set(error, "the field is %.6g everywhere: it has no levels", all->least);
    if (level < all->least - slack || level > all->most + slack)
        return error_set(error, "level %.6g is out of range: the field goes from %.6g to %.6g", level,
                         all->least, all->most);
    if (level < all->least + slack || level > all->most - slack)
        return error_set(
            error,
            "level %.6g is the end of the field's range, %.6g to %.6g: it is touched, if at all, and not "
            "crossed; take a level between",
            level, all->least, all->most);
    return error_set(error, "level %.6g is empty: none of %zu lines through the field crosses it", level,
                     lines);
}

static void measure(const LineSearchJob *lines, Crossings *crossings)
{
    const double faces = 2 * (lines->face[0] + lines->face[1] + lines->face[2]);
    crossings->area = 0.5 * faces * (double)crossings->count / (double)crossings->lines;
    for (int k = 0; k < 3; k++) {
        crossings->low[k] = HUGE_VAL;
        crossings->high[k] = -HUGE_VAL;
        for (size_t i = 0; i < crossings->count; i++) {
            crossings->low[k] = fmin(crossings->low[k], crossings->place[i][k]);
            crossings->high[k] = fmax(crossings->high[k], crossings->place[i][k]);
        }
    }
}

static LineSearchJob lines_of(const LineSearch *search)
{
    LineSearchJob lines = {.search = search};
    uint32_t word[4] = {0, 0, 0, PHILOX_LINES};
    philox(search->key, word);
    for (int k = 0; k < 4; k++)
        lines.shift[k] = (double)philox_uniform(word[k]);
    for (int k = 0; k < 3; k++) {
        const int v = (k + 1) % 3, w = (k + 2) % 3;
        lines.face[k] = (search->high[v] - search->low[v]) * (search->high[w] - search->low[w]);
    }
    return lines;
}

/* Rejects fields whose lines would have too many positions; a march of 0 is rejected too. */
static bool can_be_followed(const LineSearch *search, Error *error)
{
    for (int k = 0; k < 3; k++) {
        const double side = search->high[k] - search->low[k], march = search->field->march[k];
        if (!(side <= pieces_most * march))
            return error_set(error,
                             "lines look for the surface each %.3g m, and its bounds are %.3g m wide along "
                             "%c: more than %g places; take a coarser field or smaller bounds",
                             march, side, "xyz"[k], pieces_most);
    }
    return true;
}

/* In batches: a finely folded surface has enough crossings after a few lines. */
static bool first_lines(LineSearchJob *lines, Crossings *crossings, LineExtremes *all, Error *error)
{
    bool ok = true;
    while (ok && crossings->lines < FIRST_LINES && crossings->count < enough)
        ok = more_lines(lines, SOME_LINES, crossings, all, error);
    return ok;
}

bool lines_cross(const LineSearch *search, Crossings *crossings, Error *error)
{
    LineSearchJob lines = lines_of(search);
    LineExtremes all = {.least = HUGE_VAL, .most = -HUGE_VAL};
    *crossings = (Crossings){0};
    if (!can_be_followed(search, error))
        return false;
    bool ok = first_lines(&lines, crossings, &all, error);
    if (ok && crossings->count == 0 && all.flat == 0) /* a small surface in a large box */
        ok = more_lines(&lines, 15 * FIRST_LINES, crossings, &all, error);
    if (ok && crossings->count > all.flat) {
        measure(&lines, crossings);
        return true;
    }
    if (ok)
        none(search, &all, crossings->lines, error);
    crossings_free(crossings);
    return false;
}

bool lines_more(const LineSearch *search, size_t wanted, Crossings *crossings, Error *error)
{
    LineSearchJob lines = lines_of(search);
    LineExtremes all = {.least = HUGE_VAL, .most = -HUGE_VAL};
    if (crossings->count >= wanted)
        return true;
    const double found = (double)crossings->count, more = 1.02 * ((double)wanted - found) / found;
    const double count =
        fmin(more * (double)crossings->lines + A_RANGE, MOST_LINES - (double)crossings->lines);
    if (count >= 1 && !more_lines(&lines, (size_t)count, crossings, &all, error))
        return false;
    measure(&lines, crossings);
    return true;
}

void crossings_free(Crossings *crossings)
{
    free(crossings->place);
    *crossings = (Crossings){0};
}
