/* Emitters, guides and drains between steps, as in sim/cpu/forces.c. Per layer and per drain a single number
   comes back: the number of particles. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/flow_block.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

_Static_assert(DRAINS_MOST == DRAINS_MAX && GUIDES_MOST == GUIDES_MAX, "shaders know all of a scene");

static void put(const Compute *c, size_t offset, size_t bytes, const void *data)
{
    glNamedBufferSubData(c->flow.block, (GLintptr)offset, (GLsizeiptr)bytes, data);
}

void compute_flow_create(Compute *c)
{
    if (c->constants->emits || c->constants->drains)
        c->flow.block = compute_buffer(c, "flow", sizeof(FlowBlock));
    if (c->constants->emits) {
        c->flow.layer = compute_buffer(c, "emitted layer", (size_t)12 * COMPUTE_LAYER);
        c->flow.marks = compute_buffer(c, "emitted layer's marks", (size_t)4 * (COMPUTE_LAYER + 1));
    }
}

void compute_flow_destroy(Compute *c)
{
    const GLuint buffers[] = {c->flow.block, c->flow.layer, c->flow.marks};
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
}

static void bind_block(const Compute *c)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, FLOW_BLOCK, c->flow.block);
}

/* The total of the prefix sums of `count` marks: the number of set marks, limited to `count` for any driver
   result. */
static size_t sum_of(unsigned buffer, size_t count)
{
    uint32_t sum = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, (GLintptr)(count * sizeof sum), sizeof sum, &sum);
    return sum < count ? sum : count;
}

static void layer_set(const Compute *c, const EmitLayer *layer, size_t most)
{
    const FlowBlock block = {
        .candidate_total = (uint)layer->count,
        .gridded = (uint)c->gridded,
        .layer_fluid = (uint)layer->fluid,
        .first_id = (uint)layer->first_id,
        .layer_most = (uint)most,
        .layer_velocity = {layer->velocity[0], layer->velocity[1], layer->velocity[2]},
    };
    put(c, 0, offsetof(FlowBlock, drains), &block);
    glNamedBufferSubData(c->flow.layer, 0, (GLsizeiptr)(12 * layer->count), layer->position);
}

static size_t emit_part(Compute *c, const EmitLayer *layer, size_t most)
{
    layer_set(c, layer, most);
    bind_block(c);
    compute_boundary_bind(c);
    BIND(c, [POSITIONS_BUFFER] = c->now.position, [LAYER_BUFFER] = c->flow.layer, [STARTS_BUFFER] = c->start,
         [MARKS_BUFFER] = c->flow.marks);
    compute_run(c, COMPUTE_EMIT_MARK, layer->count + 1);
    compute_scan(c, c->flow.marks, layer->count + 1);
    BIND(c, [POSITIONS_BUFFER] = c->now.position, [LAYER_BUFFER] = c->flow.layer,
         [VELOCITIES_BUFFER] = c->now.velocity, [MARKS_BUFFER] = c->flow.marks, [NAMES_BUFFER] = c->now.name);
    compute_run(c, COMPUTE_EMIT_ADD, layer->count);
    const size_t fit = sum_of(c->flow.marks, layer->count), number = fit < most ? fit : most;
    compute_own_clear(c, c->count, number);
    compute_set_count(c, c->count + number);
    return number;
}

size_t compute_emit(void *state, const EmitLayer *layer, size_t most)
{
    Compute *c = state;
    size_t number = 0;
    for (size_t done = 0; done < layer->count && number < most; done += COMPUTE_LAYER) {
        EmitLayer part = *layer;
        part.count = layer->count - done < COMPUTE_LAYER ? layer->count - done : COMPUTE_LAYER;
        part.position += 3 * done;
        part.first_id += number;
        number += emit_part(c, &part, most - number);
    }
    return number;
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
    put(c, 0, offsetof(FlowBlock, candidate_total), &block);
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
    put(c, 0, offsetof(FlowBlock, candidate_total), &block);
    put(c, offsetof(FlowBlock, drains), (size_t)count * sizeof block.drains[0], block.drains);
}

size_t compute_drain(void *state, const Fill *regions, int count)
{
    Compute *c = state;
    if (c->count == 0)
        return 0;
    drains_set(c, regions, count);
    bind_block(c);
    BIND(c, [POSITIONS_BUFFER] = c->now.position, [MARKS_BUFFER] = c->order); /* `order` is free until the
                                                                                 next grid */
    compute_run(c, COMPUTE_DRAIN_MARK, c->count + 1);
    compute_scan(c, c->order, c->count + 1);
    const size_t stay = sum_of(c->order, c->count), gone = c->count - stay;
    if (gone == 0)
        return 0;
    BIND(c, [MARKS_BUFFER] = c->order, [OLD_POSITIONS_BUFFER] = c->now.position,
         [OLD_VELOCITIES_BUFFER] = c->now.velocity, [OLD_NAMES_BUFFER] = c->now.name,
         [POSITIONS_BUFFER] = c->spare.position, [VELOCITIES_BUFFER] = c->spare.velocity,
         [NAMES_BUFFER] = c->spare.name);
    compute_run(c, COMPUTE_DRAIN_GATHER, c->count);
    compute_own_gather(c, c->order);
    compute_swap(c);
    compute_set_count(c, stay);
    return gone;
}
