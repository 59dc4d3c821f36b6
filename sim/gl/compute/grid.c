/* Counting sort by cell; for who asks to have the same bits each time by id within a cell, the order that
   sim/cpu/grid.c makes. */
#include "sim/gl/compute/compute.h"

#include "shaders/shared/scan.h"

#include <epoxy/gl.h>

static size_t blocks_of(size_t size)
{
    return (size + COMPUTE_SCAN_BLOCK - 1) / COMPUTE_SCAN_BLOCK;
}

static void run_blocks(const Compute *compute, ComputePass pass, unsigned values, unsigned totals,
                       size_t size)
{
    compute_bind((const unsigned[]){values, totals}, 2);
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

void compute_swap(Compute *c)
{
    const ComputeParticles other = c->spare;
    c->spare = c->now;
    c->now = other;
}

void compute_grid(void *state)
{
    Compute *c = state;
    const size_t cells = c->constants->cells.count;
    unsigned order = c->order;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(c->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    compute_bind((const unsigned[]){c->now.position, c->cell, c->rank, c->start}, 4);
    compute_run(c, COMPUTE_BIN, c->count);
    compute_scan(c, c->start, cells + 1);
    compute_bind((const unsigned[]){c->cell, c->rank, c->start, c->order}, 4);
    compute_run(c, COMPUTE_PLACE, c->count);
    if (c->constants->reproducible) {
        compute_bind((const unsigned[]){c->now.name, c->cell, c->start, c->order, c->rank}, 5);
        compute_run(c, COMPUTE_SORT, c->count);
        order = c->rank; /* which is free now */
    }
    compute_bind((const unsigned[]){order, c->now.position, c->now.velocity, c->now.name, c->spare.position,
                                    c->spare.velocity, c->spare.name},
                 7);
    compute_run(c, COMPUTE_MOVE, c->count);
    compute_swap(c);
    c->gridded = c->count;
    compute_boundary_grid(c);
    c->slopes_due = true;
}
