/* Counting sort by places of the cell fold; for reproducible worlds by id within a cell, the order of
   sim/cpu/grid.c. */
#include "sim/gl/compute/compute.h"

#include "shaders/shared/scan.h"
#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>

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
