#include "render/particles/particles.h"

#include "sim/base/base.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Samples are summed LANES at a time. Rows are longer by LANES, and samples outside of the disc get 0. */
enum {
    BAND = 16,     /* rows: 16 rows of 1024 samples fit into a core's cache */
    PIECE = 256,   /* samples of a disc along a row at a time */
    READ = 1 << 16 /* particles at a time: fit into a core's cache */
};

/* The section of the plane with a particle's ball, as in shaders/render/plane_sum.vert. */
struct PlaneDisc {
    int cell[2];     /* the sample of the centre */
    float within[2]; /* position in the sample, 0 .. 1 */
    float away;      /* (distance / h)^2 */
    float most;      /* V times the kernel's peak */
    float value;     /* 0 if NaN: */
    bool known;
};

/* Inlined into a function per instruction set; samples are independent, so the bits are the same. */
#define INLINE static inline __attribute__((always_inline))

INLINE float positive(float a)
{
    return a > 0 ? a : 0;
}

/* ---- particles that reach the rectangle ---- */

/* Scales of a job, in doubles: samples per m and support radii per m. */
typedef struct PlaneMeasure {
    double along[3], up[3], normal[3], side[2], reach[2]; /* reach: h in samples */
    float peak;
} PlaneMeasure;

static PlaneMeasure measure_of(const PlaneJob *job)
{
    const Plane *plane = &job->plane;
    PlaneMeasure measure = {.peak = (float)(plane_kernels[job->kernel].norm[job->dimensions - 2] /
                                            pow(job->support, job->dimensions))};
    for (int k = 0; k < 2; k++) {
        measure.side[k] = plane->size[k] / job->samples[k];
        measure.reach[k] = job->support / measure.side[k];
    }
    for (int k = 0; k < 3; k++) {
        measure.along[k] = plane->along[k] / measure.side[0];
        measure.up[k] = plane->up[k] / measure.side[1];
        measure.normal[k] = plane->normal[k] / job->support;
    }
    return measure;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Returns false if the particle reaches no sample, or has no valid position or volume. */
static bool make_disc(const PlaneJob *job, const PlaneMeasure *measure, const float p[4], float value,
                      PlaneDisc *disc)
{
    const double *corner = job->plane.corner,
                 from[3] = {p[0] - corner[0], p[1] - corner[1], p[2] - corner[2]};
    const double away = dot(from, measure->normal), left = 1 - away * away;
    if (!(left > 0 && p[3] > 0 && p[3] <= 1e30F))
        return false;
    const double at[2] = {dot(from, measure->along), dot(from, measure->up)}, root = sqrt(left);
    for (int k = 0; k < 2; k++) {
        const double half = root * measure->reach[k];
        if (!(at[k] + half > 0.5 && at[k] - half < job->samples[k] - 0.5))
            return false;
    }
    const double cell[2] = {floor(at[0]), floor(at[1])};
    *disc = (PlaneDisc){.cell = {(int)cell[0], (int)cell[1]},
                        .within = {(float)(at[0] - cell[0]), (float)(at[1] - cell[1])},
                        .away = (float)away * (float)away,
                        .most = p[3] * measure->peak,
                        .known = fabsf(value) < 1e30F};
    disc->value = disc->known ? value : 0;
    return true;
}

/* Reads into rows of `words` floats. */
static void read_part(const ParticleAttribute *from, size_t first, size_t count, size_t words, float *to)
{
    const size_t stride = from->stride / sizeof(float);
    glGetNamedBufferSubData(from->buffer, (GLintptr)(from->offset + first * from->stride),
                            (GLsizeiptr)(count * from->stride), to);
    for (size_t i = 0; i < count && stride > words; i++)
        memmove(to + words * i, to + stride * i, words * sizeof(float));
}

static bool list_part(PlaneRows *rows, const PlaneJob *job, const PlaneMeasure *measure,
                      const float *position, const float *value, size_t count)
{
    if (rows->count + count > rows->discs_capacity &&
        !array_grow((void **)&rows->discs, &rows->discs_capacity, 2 * (rows->count + count),
                    sizeof *rows->discs))
        return false;
    for (size_t i = 0; i < count; i++)
        rows->count +=
            make_disc(job, measure, position + 4 * i, value ? value[i] : 0, &rows->discs[rows->count]);
    return true;
}

static bool list_discs(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles)
{
    const PlaneMeasure measure = measure_of(job);
    const ParticleAttribute *position = &particles->position, *scalar = &particles->scalar[job->scalar];
    float *values = rows->read + READ * (position->stride / sizeof(float));
    rows->count = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* a GPU backend may have written the buffers */
    for (size_t first = 0; first < particles->count; first += READ) {
        const size_t count = particles->count - first < READ ? particles->count - first : READ;
        read_part(position, first, count, 4, rows->read);
        if (scalar->buffer)
            read_part(scalar, first, count, 1, values);
        if (!list_part(rows, job, &measure, rows->read, scalar->buffer ? values : NULL, count))
            return false;
    }
    return true;
}

/* ---- discs per band ---- */

static int whole_of(double x, int most)
{
    return x > 0 ? x < most ? (int)x : most : 0;
}

/* The samples along an axis with centres nearer to the disc's centre than `half`; none if first >= end. */
static void reached(const PlaneDisc *disc, int axis, double half, int samples, int *first, int *end)
{
    const double at = disc->cell[axis] + (double)disc->within[axis] - 0.5;
    *first = whole_of(ceil(at - half), samples);
    *end = whole_of(floor(at + half) + 1, samples);
}

typedef struct PlaneRowsJob {
    PlaneRows *rows;
    const PlaneJob *job;
} PlaneRowsJob;

static BinSpan reached_bands(const void *context, size_t i)
{
    const PlaneRowsJob *work = context;
    const PlaneJob *job = work->job;
    const PlaneDisc *disc = &work->rows->discs[i];
    const double reach = job->support * job->samples[1] / job->plane.size[1];
    int row, row_end;
    reached(disc, 1, (double)sqrtf(positive(1 - disc->away)) * reach, job->samples[1], &row, &row_end);
    const size_t first = (size_t)row / BAND;
    return (BinSpan){first, row < row_end ? (size_t)(row_end - 1) / BAND + 1 : first};
}

static size_t bands_of(const PlaneJob *job)
{
    return ((size_t)job->samples[1] + BAND - 1) / BAND;
}

/* ---- the sums of a band ---- */

INLINE float power3(float a)
{
    return a * a * a;
}

INLINE float power5(float a)
{
    return a * a * a * a * a;
}

/* The kernel's shape at q <= 1, where all kernels end at 0; as in render/particles/plane.c, splines as
   sums. */
INLINE float shape(int kernel, float q)
{
    const float t = 1 - q;
    switch (kernel) {
    case 1:
        return 2 * power3(t) - power3(positive(1 - 2 * q));
    case 2:
        return t * t * t * t * (1 + 4 * q);
    case 3:
        return 243 * power5(t) - 6 * power5(positive(2 - 3 * q)) + 15 * power5(positive(1 - 3 * q));
    case 4:
        return power3(1 - q * q);
    case 5:
        return power3(t);
    default:
        return t * t;
    }
}

/* The row of a band that a disc adds to. */
typedef struct RowSums {
    float *weighted, *weight; /* sums of V W s; of V W */
} RowSums;

/* `squares`: squared distances along the row, in h2; `above`: squared distance across the row. */
INLINE void add_piece(int kernel, const RowSums *to, const float *restrict squares, int count, float above,
                      const PlaneDisc *disc)
{
    float *restrict weighted = to->weighted, *restrict weight = to->weight;
    const float most = disc->most, value = disc->value;
    for (int i = 0; i < count / LANES * LANES; i++) {
        const float square = squares[i] + above, w = most * shape(kernel, sqrtf(square < 1 ? square : 1));
        weight[i] += w;
        weighted[i] += w * value;
    }
}

INLINE void add_by_kernel(int kernel, const RowSums *to, const float *squares, int count, float above,
                          const PlaneDisc *disc)
{
    switch (kernel) {
    case 1:
        add_piece(1, to, squares, count, above, disc);
        break;
    case 2:
        add_piece(2, to, squares, count, above, disc);
        break;
    case 3:
        add_piece(3, to, squares, count, above, disc);
        break;
    case 4:
        add_piece(4, to, squares, count, above, disc);
        break;
    case 5:
        add_piece(5, to, squares, count, above, disc);
        break;
    default:
        add_piece(6, to, squares, count, above, disc);
    }
}

#if defined(__x86_64__)
static __attribute__((target("avx2"))) void add_wide(int kernel, const RowSums *to, const float *squares,
                                                     int count, float above, const PlaneDisc *disc)
{
    add_by_kernel(kernel, to, squares, count, above, disc);
}
#endif

static void add(int kernel, const RowSums *to, const float *squares, int count, float above,
                const PlaneDisc *disc)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        add_wide(kernel, to, squares, count, above, disc);
        return;
    }
#endif
    add_by_kernel(kernel, to, squares, count, above, disc);
}

/* The band being summed. */
typedef struct PlaneBand {
    const PlaneRows *rows;
    const PlaneJob *job;
    int first, end;  /* rows */
    float side[2];   /* size of a sample, in h */
    double reach[2]; /* h in samples */
} PlaneBand;

/* Distance from a disc's centre to a sample, along the axis, in h. */
static float offset(const PlaneBand *band, const PlaneDisc *disc, int axis, int sample)
{
    return ((float)(sample - disc->cell[axis]) + (0.5F - disc->within[axis])) * band->side[axis];
}

/* Adds a disc to the samples of a row in the piece from `at` on; `squares` are for this piece. */
static void add_row(const PlaneBand *band, const PlaneDisc *disc, int row, int at, const float *squares)
{
    const PlaneRows *rows = band->rows;
    const float d = offset(band, disc, 1, row), above = disc->away + d * d;
    int from, end;
    if (!(above < 1))
        return;
    reached(disc, 0, sqrt(1 - (double)above) * band->reach[0], band->job->samples[0], &from, &end);
    from = from > at ? at + (from - at) / LANES * LANES : at; /* keeps whole lanes */
    end = end < at + PIECE ? end : at + PIECE;
    const size_t first = rows->stride * (size_t)row + (size_t)from;
    const RowSums to = {rows->sums[0] + first, rows->sums[disc->known ? 1 : 2] + first};
    if (from < end)
        add(band->job->kernel, &to, squares + (from - at), (end - from + LANES - 1) / LANES * LANES, above,
            disc);
}

static void add_disc(const PlaneBand *band, const PlaneDisc *disc)
{
    float squares[PIECE + LANES];
    const double root = (double)sqrtf(positive(1 - disc->away));
    int row, row_end, from, end;
    reached(disc, 0, root * band->reach[0], band->job->samples[0], &from, &end);
    reached(disc, 1, root * band->reach[1], band->end, &row, &row_end);
    row = row > band->first ? row : band->first;
    for (; from < end; from += PIECE) {
        const int count = (end - from < PIECE ? end - from : PIECE) + LANES;
        for (int i = 0; i < count; i++) {
            const float d = offset(band, disc, 0, from + i);
            squares[i] = d * d;
        }
        for (int k = row; k < row_end; k++)
            add_row(band, disc, k, from, squares);
    }
}

/* Interleaves the channels, as a texture needs. */
static void interleave(const PlaneRows *rows, int row, int samples)
{
    const float *a = rows->sums[0] + rows->stride * (size_t)row,
                *b = rows->sums[1] + rows->stride * (size_t)row,
                *c = rows->sums[2] + rows->stride * (size_t)row;
    float *out = rows->out + 4 * (size_t)samples * (size_t)row;
    for (int i = 0; i < samples; i++) {
        const float sample[4] = {a[i], b[i], c[i], 0};
        memcpy(out + 4 * (size_t)i, sample, sizeof sample);
    }
}

static void sum_band(const PlaneRowsJob *work, size_t number)
{
    PlaneRows *rows = work->rows;
    const PlaneJob *job = work->job;
    const int first = BAND * (int)number,
              end = first + BAND < job->samples[1] ? first + BAND : job->samples[1];
    PlaneBand band = {rows, job, first, end, {0}, {0}};
    for (int k = 0; k < 2; k++) {
        band.side[k] = (float)(job->plane.size[k] / job->samples[k]) / (float)job->support;
        band.reach[k] = job->support * job->samples[k] / job->plane.size[k];
    }
    for (int k = 0; k < 3; k++)
        memset(rows->sums[k] + rows->stride * (size_t)first, 0,
               rows->stride * (size_t)(end - first) * sizeof(float));
    for (size_t m = rows->bands.begin[number]; m < rows->bands.begin[number + 1]; m++)
        add_disc(&band, &rows->discs[rows->bands.member[m]]);
    for (int row = first; row < end; row++)
        interleave(rows, row, job->samples[0]);
}

static void sum_bands(void *context, size_t begin, size_t end)
{
    for (; begin < end; begin++)
        sum_band(context, begin);
}

/* ---- all bands ---- */

static bool reserve(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles)
{
    const size_t words = (particles->position.stride + particles->scalar[job->scalar].stride) / sizeof(float);
    const size_t samples = (size_t)job->samples[0] * (size_t)job->samples[1];
    rows->stride = (size_t)job->samples[0] + LANES;
    bool capacity = array_grow((void **)&rows->read, &rows->read_capacity, READ * words, sizeof(float)) &&
                    array_grow((void **)&rows->out, &rows->out_capacity, 4 * samples, sizeof(float));
    for (int k = 0; k < 3; k++)
        capacity = capacity && array_grow((void **)&rows->sums[k], &rows->sums_capacity[k],
                                          rows->stride * (size_t)job->samples[1], sizeof(float));
    return capacity;
}

bool plane_rows_run(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles, Error *error)
{
    PlaneRowsJob work = {rows, job};
    if (!reserve(rows, job, particles) || !list_discs(rows, job, particles) ||
        !bins_fill(&rows->bands, bands_of(job), rows->count, reached_bands, &work))
        return error_set(error, "no memory for a slice of %d x %d samples through %zu particles",
                         job->samples[0], job->samples[1], particles->count);
    parallel_ranges(parallel_processors(), bands_of(job), 1, sum_bands, &work);
    return true;
}

void plane_rows_free(PlaneRows *rows)
{
    free(rows->read);
    free(rows->discs);
    bins_free(&rows->bands);
    free(rows->out);
    for (int k = 0; k < 3; k++)
        free(rows->sums[k]);
    *rows = (PlaneRows){0};
}
