/* Emitters, guides and drains between steps, as in sim/cpu/forces.c. Only the GPU knows the number of
   particles until the end of the step: ConstantBlock.particle_total. Passes run over `count`, an upper bound,
   and the numbers of layers and drains come with compute_finish. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/flow_block.h"
#include "shaders/sim/flow_counts_block.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

_Static_assert(DRAINS_MOST == DRAINS_MAX && GUIDES_MOST == GUIDES_MAX && FLOWS_MOST == FLOWS_MAX,
               "shaders know all of a scene");

static void put(const Compute *c, size_t offset, size_t bytes, const void *data)
{
    glNamedBufferSubData(c->flow.block, (GLintptr)offset, (GLsizeiptr)bytes, data);
}

bool compute_flow_create(Compute *c)
{
    if (!c->constants->emits && !c->constants->drains)
        return true;
    c->flow.block = compute_buffer(c, "flow", sizeof(FlowBlock));
    if (c->constants->emits) {
        c->flow.layer = compute_buffer(c, "emitted layer", (size_t)12 * COMPUTE_LAYER);
        c->flow.marks = compute_buffer(c, "emitted layer's marks", (size_t)4 * (COMPUTE_LAYER + 1));
    }
    return mailbox_create(&c->flow.counts, "particles that come and leave", sizeof(FlowCounts));
}

void compute_flow_destroy(Compute *c)
{
    const GLuint buffers[] = {c->flow.block, c->flow.layer, c->flow.marks};
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
    mailbox_destroy(&c->flow.counts);
}

static void bind_block(const Compute *c)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, FLOW_BLOCK, c->flow.block);
}

void compute_flow_gridded(Compute *c)
{
    if (c->constants->emits)
        compute_copy_count(c, c->flow.block, offsetof(FlowBlock, gridded), true);
}

/* Counts the last layer or drain, by prefix sums of `size` marks with their total behind. */
static void count_flow(Compute *c, unsigned marks, size_t size, bool drains)
{
    const GLuint program = c->program[COMPUTE_FLOW_COUNT];
    glProgramUniform3ui(program, FLOW_AT, (GLuint)(c->flow.calls - 1), (GLuint)size, drains);
    BIND([FLOW_COUNTS_BUFFER] = c->flow.counts.buffer, [MARKS_BUFFER] = marks);
    compute_run(c, COMPUTE_FLOW_COUNT, 1);
    compute_copy_count(c, c->flow.counts.buffer, offsetof(FlowCounts, there), false);
}

bool compute_flow_send(Compute *c)
{
    if (c->flow.calls == 0)
        return false;
    mailbox_send(&c->flow.counts);
    static const FlowCounts nothing;
    glNamedBufferSubData(c->flow.counts.buffer, 0, sizeof nothing, &nothing);
    return true;
}

/* Limited to `most` for any driver result. */
static size_t limited(uint32_t number, size_t most)
{
    return number < most ? number : most;
}

void compute_flow_take(Compute *c, const void *counts, size_t *flowed)
{
    const FlowCounts *found = counts;
    for (int k = 0; k < c->flow.calls; k++)
        flowed[k] = found ? limited(found->flowed[k], c->capacity) : 0;
    c->count = found ? limited(found->there, c->count) : c->count;
    c->flow.calls = 0;
}

static void layer_set(const Compute *c, const EmitLayer *layer)
{
    enum { FIRST = offsetof(FlowBlock, candidate_total) };
    const FlowBlock block = {
        .candidate_total = (uint)layer->count,
        .layer_fluid = (uint)layer->fluid,
        .particle_most = (uint)c->capacity,
        .layer_velocity = {layer->velocity[0], layer->velocity[1], layer->velocity[2]},
    };
    put(c, FIRST, offsetof(FlowBlock, drains) - FIRST, &block.candidate_total);
    glNamedBufferSubData(c->flow.layer, 0, (GLsizeiptr)(12 * layer->count), layer->position);
}

static void emit_part(Compute *c, const EmitLayer *layer)
{
    layer_set(c, layer);
    bind_block(c);
    compute_boundary_bind(c);
    BIND([POSITIONS_BUFFER] = c->now.position, [LAYER_BUFFER] = c->flow.layer, [STARTS_BUFFER] = c->start,
         [MARKS_BUFFER] = c->flow.marks);
    compute_run(c, COMPUTE_EMIT_MARK, layer->count + 1);
    compute_scan(c, c->flow.marks, layer->count + 1);
    BIND([POSITIONS_BUFFER] = c->now.position, [LAYER_BUFFER] = c->flow.layer,
         [VELOCITIES_BUFFER] = c->now.velocity, [MARKS_BUFFER] = c->flow.marks, [NAMES_BUFFER] = c->now.name,
         [FLOW_COUNTS_BUFFER] = c->flow.counts.buffer, [OWN_BUFFER] = c->now.own);
    compute_run(c, COMPUTE_EMIT_ADD, layer->count);
    count_flow(c, c->flow.marks, layer->count, false);
    c->count = limited((uint32_t)(c->count + layer->count), c->capacity);
}

size_t compute_emit(void *state, const EmitLayer *layer, size_t most)
{
    Compute *c = state;
    const uint32_t born = (uint32_t)layer->first_id;
    (void)most; /* the GPU knows */
    if (layer->count == 0)
        return 0;
    if (c->flow.calls == 0)
        glNamedBufferSubData(c->flow.counts.buffer, offsetof(FlowCounts, born), sizeof born, &born);
    c->flow.calls++;
    for (size_t done = 0; done < layer->count; done += COMPUTE_LAYER) {
        EmitLayer part = *layer;
        part.count = layer->count - done < COMPUTE_LAYER ? layer->count - done : COMPUTE_LAYER;
        part.position += 3 * done;
        emit_part(c, &part);
    }
    return FLOW_LATER;
}

double compute_guide(void *state, const Guide *guides, int count)
{
    Compute *c = state;
    FlowBlock block = {.guide_total = count};
    for (int k = 0; k < count; k++) {
        Course *course = &block.guides[k];
        memcpy(course->centre, guides[k].centre, sizeof guides[k].centre);
        memcpy(course->direction, guides[k].direction, sizeof guides[k].direction);
        memcpy(course->velocity, guides[k].velocity, sizeof guides[k].velocity);
        course->radius = guides[k].radius;
        course->depth = guides[k].depth;
        course->fluid = guides[k].fluid;
    }
    put(c, 0, offsetof(FlowBlock, gridded), &block);
    put(c, offsetof(FlowBlock, guides), (size_t)count * sizeof block.guides[0], block.guides);
    bind_block(c);
    compute_sweep(c, COMPUTE_GUIDE, c->count);
    return 0;
}

/* The least float not below `bound`: a float is below the result exactly if it is below `bound`. */
static float not_below(double bound)
{
    const float near = (float)fmax(-3e38, fmin(bound, 3e38));
    return (double)near < bound ? nextafterf(near, INFINITY) : near;
}

static void drains_set(const Compute *c, const Fill *regions, int count)
{
    FlowBlock block = {.drain_total = count};
    const bool plane = c->constants->dimensions == 2;
    for (int k = 0; k < count; k++) {
        Region *region = &block.drains[k];
        const bool ball = regions[k].kind == FILL_BALL;
        for (int a = 0; a < 3; a++) {
            const bool out = a == 2 && plane;
            region->low[a] =
                ball ? (out ? 0 : (float)regions[k].centre[a]) : not_below(out ? -3e38 : regions[k].min[a]);
            region->high[a] = not_below(out ? 3e38 : regions[k].max[a]);
        }
        region->ball = ball;
        region->radius2 = (float)(regions[k].radius * regions[k].radius);
    }
    put(c, 0, offsetof(FlowBlock, gridded), &block);
    put(c, offsetof(FlowBlock, drains), (size_t)count * sizeof block.drains[0], block.drains);
}

size_t compute_drain(void *state, const Fill *regions, int count)
{
    Compute *c = state;
    if (c->count == 0)
        return 0;
    drains_set(c, regions, count);
    c->flow.calls++;
    bind_block(c);
    BIND([POSITIONS_BUFFER] = c->now.position, [MARKS_BUFFER] = c->order); /* `order` is free until the
                                                                                 next grid */
    compute_run(c, COMPUTE_DRAIN_MARK, c->count + 1);
    compute_scan(c, c->order, c->count + 1);
    BIND([MARKS_BUFFER] = c->order, [OLD_POSITIONS_BUFFER] = c->now.position,
         [OLD_VELOCITIES_BUFFER] = c->now.velocity, [OLD_NAMES_BUFFER] = c->now.name,
         [POSITIONS_BUFFER] = c->spare.position, [VELOCITIES_BUFFER] = c->spare.velocity,
         [NAMES_BUFFER] = c->spare.name);
    compute_run(c, COMPUTE_DRAIN_GATHER, c->count);
    compute_own_gather(c, c->order);
    count_flow(c, c->order, c->count, true);
    compute_swap(c);
    return FLOW_LATER;
}
