/* Reads of the state: copies and sums. */
#include "sim/gl/compute/compute.h"
#include "sim/world/cell_rows.h"
#include "sim/world/particles.h"

#include <epoxy/gl.h>
#include <stdlib.h>

bool compute_read(void *state, const ParticleArrays *out)
{
    const Compute *c = state;
    ParticleColumns copy;
    if (!compute_download(c, &copy))
        return false;
    particles_read(&copy, c->constants, NULL, 0, c->count, out);
    columns_destroy(&copy);
    return true;
}

/* Number of neighbours of particle i with r < h, in the last grid: in particle i's cell of `place` and the
   cells around. */
static size_t neighbours_of(const Compute *c, const ParticleColumns *p, const uint32_t *start, size_t place,
                            size_t i)
{
    const Constants *s = c->constants;
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    const uint32_t cell = c->fold.shared ? cell_near(s, &c->fold, place, x) : (uint32_t)place;
    const float h2 = s->support_radius * s->support_radius;
    size_t count = 0;
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(s, &c->fold, start, cell, rows);
    for (int row = 0; row < row_count; row++) {
        if (cell_row_again(s, &rows[row]))
            continue;
        for (size_t j = rows[row].begin; j < rows[row].end; j++) {
            float d[3] = {p->x[i] - p->x[j], p->y[i] - p->y[j], p->z[i] - p->z[j]};
            periodic_nearest(&s->periodic, d); /* for particles that crossed a side since */
            count += j != i && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < h2;
        }
    }
    return count;
}

/* Particles are ordered by their cells at the last `grid`: the cell starts give each particle's cell,
   wherever it is now. */
static double neighbours_mean(const Compute *c, const ParticleColumns *p)
{
    const size_t places = c->fold.count;
    uint32_t *start = malloc((places + 1) * sizeof *start);
    size_t sum = 0;
    if (!start)
        return 0;
    glGetNamedBufferSubData(c->start, 0, (GLsizeiptr)((places + 1) * sizeof *start), start);
    for (size_t place = 0; place < places; place++)
        for (size_t i = start[place]; i < start[place + 1]; i++)
            sum += neighbours_of(c, p, start, place, i);
    free(start);
    return c->count > 0 ? (double)sum / (double)c->count : 0;
}

void compute_sums(void *state, WorldSums *sums)
{
    const Compute *c = state;
    ParticleColumns copy;
    *sums = (WorldSums){0};
    if (!compute_download(c, &copy))
        return;
    particles_sums(&copy, c->constants, c->count, sums);
    sums->neighbours_mean = neighbours_mean(c, &copy);
    columns_destroy(&copy);
}

void compute_info(const void *state, WorldInfo *info)
{
    const Compute *c = state;
    info->threads = 0;
    info->state_bytes = c->bytes;
    info->unlisted = c->unlisted;
    info->guarded = c->guarded_before + c->guarded;
}
