/* Counting sort by places of the cell fold; for reproducible worlds by id within a cell, the order of
   sim/cpu/grid.c. */
#include "sim/gpu/compute/compute.h"

#include "shaders/shared/scan.h"
#include "shaders/sim/bindings.h"
#include "sim/gpu/gl_context.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static size_t blocks_of(size_t size)
{
    return (size + COMPUTE_SCAN_BLOCK - 1) / COMPUTE_SCAN_BLOCK;
}

static void run_blocks(const Compute *compute, ComputePass pass, unsigned values, unsigned totals,
                       size_t size)
{
    BIND([SCAN_VALUES_STORAGE] = values, [SCAN_TOTALS_STORAGE] = totals);
    glUseProgram(compute->program[pass]);
    glUniform1ui(SCAN_SIZE_AT, (GLuint)size);
    compute_dispatch(blocks_of(size));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void compute_scan(Compute *compute, unsigned buffer, size_t size)
{
    unsigned values[COMPUTE_SCAN_LEVELS + 1] = {buffer};
    size_t sizes[COMPUTE_SCAN_LEVELS + 1] = {size};
    int levels = 0;
    if (size == 0)
        return;
    do {
        run_blocks(compute, COMPUTE_SCAN, values[levels], compute->totals[levels], sizes[levels]);
        values[levels + 1] = compute->totals[levels];
        sizes[levels + 1] = blocks_of(sizes[levels]);
        levels++;
    } while (sizes[levels] > 1 && levels < COMPUTE_SCAN_LEVELS);
    for (int level = levels - 2; level >= 0; level--)
        run_blocks(compute, COMPUTE_SCAN_ADD, values[level], values[level + 1], sizes[level]);
}

void compute_grid(void *state)
{
    Compute *c = state;
    unsigned order = c->order;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(c->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    BIND([POSITIONS_BUFFER] = c->now.position, [CELLS_BUFFER] = c->cell, [RANKS_BUFFER] = c->rank,
         [STARTS_BUFFER] = c->start);
    compute_run(c, COMPUTE_BIN, c->count);
    compute_scan(c, c->start, c->fold.count + 1);
    BIND([CELLS_BUFFER] = c->cell, [RANKS_BUFFER] = c->rank, [STARTS_BUFFER] = c->start,
         [ORDERS_BUFFER] = c->order);
    compute_run(c, COMPUTE_PLACE, c->count);
    if (c->constants->reproducible) {
        BIND([NAMES_BUFFER] = c->now.name, [CELLS_BUFFER] = c->cell, [STARTS_BUFFER] = c->start,
             [ORDERS_BUFFER] = c->order, [SORTED_BUFFER] = c->rank);
        compute_run(c, COMPUTE_SORT, c->count);
        order = c->rank; /* free at this point */
    }
    BIND([ORDERS_BUFFER] = order, [OLD_POSITIONS_BUFFER] = c->now.position,
         [OLD_VELOCITIES_BUFFER] = c->now.velocity, [OLD_NAMES_BUFFER] = c->now.name,
         [POSITIONS_BUFFER] = c->spare.position, [VELOCITIES_BUFFER] = c->spare.velocity,
         [NAMES_BUFFER] = c->spare.name, [LISTS_BUFFER] = c->lists);
    compute_run(c, COMPUTE_MOVE, c->count);
    compute_own_move(c, order);
    compute_swap(c);
    c->gridded = c->count;
    compute_boundary_grid(c);
}

/* Neighbour lists, made by the first pass of a step for later passes: shaders/sim/lists.glsl. Without a
   free binding or memory, and with periodic sides, each pass walks the cells. Lists take at most a quarter
   of the memory: the views need some, and a driver may promise more memory than there is. */

/* List size: half more than the lattice has within the support, plus 8, since moving fluid is locally
   denser. */
static size_t list_most(const Constants *s)
{
    const double r = (double)s->support_radius / (double)s->spacing, pi = 3.14159265358979;
    const double lattice = s->dimensions == 2 ? pi * r * r : 4.0 / 3.0 * pi * r * r * r;
    return 8 * (size_t)ceil((1.5 * lattice + 8) / 8);
}

/* Rounded up to blocks of 32 particles. */
static size_t stride_of(const Compute *c)
{
    return (c->capacity + 31) / 32 * 32;
}

/* True if the driver has enough bindings and blocks: solids and a method's columns need some beside the
   usual eight. */
static bool bound(const Compute *c, const GlLimits *have)
{
    const int columns = (c->own.count > 0) + (compute_scratch_of(c->constants).total > 0);
    return !c->constants->periodic.any && have->bindings > LISTS_BUFFER &&
           have->compute_blocks >= 8 + columns + (c->constants->solid_count > 0 ? 5 : 0);
}

void compute_lists_create(Compute *c)
{
    const GlLimits have = gl_limits();
    const size_t most = list_most(c->constants), bytes = 4 * (most + 1) * stride_of(c);
    if (c->full || !bound(c, &have))
        return;
    if ((int64_t)bytes <= have.block_bytes && (double)bytes <= 0.25 * gl_memory())
        c->lists = compute_buffer(c, "lists of neighbours", bytes);
    c->list_most = most;
    c->full = false;
    c->unlisted = c->lists ? 0 : bytes;
}

void compute_list_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    if (c->lists)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used,
                 "#define LISTS 1\n#define LIST_MOST %zuu\n#define LIST_STRIDE %zuu\n", c->list_most,
                 stride_of(c));
}
