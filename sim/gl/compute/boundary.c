/* Solids: poses and boundary particles, sorted in a separate grid, so that the fluids' buffers hold fluid
   only. Passes as in sim/cpu/boundary.c. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/exact_shapes_block.h"
#include "shaders/sim/solid_steps_block.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(SOLIDS_MOST == SOLIDS_MAX, "shaders know all solids of a scene");

static void copy3(const float from[3], float to[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

static void pose_set(const SolidPose *from, Pose *to)
{
    copy3(from->x, to->x);
    for (int row = 0; row < 3; row++)
        copy3(from->r[row], to->r[row]);
}

static ExactShape shape_of(const Constants *s, const SolidDef *solid)
{
    const double endless = 1e30; /* half the depth of a box in the plane */
    ExactShape shape = {.radius = solid->radius, .thickness = solid->thickness, .reach = solid_reach(solid)};
    for (int k = 0; k < 3; k++)
        shape.half_edges[k] = k < s->dimensions ? 0.5 * solid->size[k] : endless;
    if (solid->kind == SOLID_CYLINDER)
        shape.half_edges[1] = 0.5 * solid->height;
    return shape;
}

static void shape_set(const SolidDef *def, const ExactShape *shape, Solid *out)
{
    out->kind = (int)def->kind;
    out->sticks = def->slip == SLIP_NONE;
    for (int k = 0; k < 3; k++)
        out->half_edges[k] = (float)shape->half_edges[k];
    out->radius = (float)shape->radius;
    out->thickness = (float)shape->thickness;
    out->reach = (float)shape->reach;
}

static void step_set(const SolidStep *step, Solid *out)
{
    pose_set(&step->begin, &out->begin);
    pose_set(&step->end, &out->end);
    copy3(step->end.v, out->velocity);
    copy3(step->end.w, out->spin);
    copy3(step->change, out->change);
    copy3(step->alpha, out->alpha);
}

static void steps_set(Compute *c, const SolidStep *steps)
{
    const Constants *s = c->constants;
    SolidStepsBlock block = {.solid_total = s->solid_count, .boundary_total = (int)s->boundary.count};
    ExactShapesBlock exact = {0};
    for (int k = 0; k < s->solid_count; k++) {
        exact.exact_shapes[k] = shape_of(s, &s->solids[k]);
        shape_set(&s->solids[k], &exact.exact_shapes[k], &block.solids[k]);
        step_set(&steps[k], &block.solids[k]);
    }
    const size_t used = offsetof(SolidStepsBlock, solids) + (size_t)s->solid_count * sizeof(Solid);
    glNamedBufferSubData(c->boundary.block, 0, (GLsizeiptr)used, &block);
    glNamedBufferSubData(c->boundary.exact, 0, (GLsizeiptr)((size_t)s->solid_count * sizeof(ExactShape)),
                         &exact);
}

bool compute_boundary_create(Compute *c)
{
    const Boundary *boundary = &c->constants->boundary;
    ComputeBoundary *b = &c->boundary;
    const size_t n = boundary->count;
    if (c->constants->solid_count == 0)
        return true;
    float *rest = malloc((n + 1) * 4 * sizeof *rest);
    if (!rest)
        return false;
    for (size_t i = 0; i < n; i++) {
        memcpy(rest + 4 * i, boundary->rest + 3 * i, 3 * sizeof *rest);
        rest[4 * i + 3] = boundary->solid[i];
    }
    b->rest = compute_buffer(c, "boundary particles at rest", 16 * n);
    b->cell = compute_buffer(c, "boundary cells", 4 * n);
    b->rank = compute_buffer(c, "boundary ranks", 4 * n);
    b->order = compute_buffer(c, "boundary order", 4 * n);
    b->start = compute_buffer(c, "boundary cell starts", 4 * (c->fold.count + 2));
    b->position = compute_buffer(c, "boundary positions", 16 * n);
    b->velocity = compute_buffer(c, "boundary velocities", 16 * n);
    b->state = compute_buffer(c, "boundary pressures", 8 * n);
    b->block = compute_buffer(c, "solids", sizeof(SolidStepsBlock));
    b->exact = compute_buffer(c, "shapes of solids", sizeof(ExactShapesBlock));
    if (b->rest)
        glNamedBufferSubData(b->rest, 0, (GLsizeiptr)(16 * n), rest);
    free(rest);
    return true;
}

void compute_boundary_destroy(Compute *c)
{
    const ComputeBoundary *b = &c->boundary;
    const GLuint buffers[] = {b->rest,  b->cell,     b->rank,     b->order, b->start,
                              b->state, b->position, b->velocity, b->block, b->exact};
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
}

void compute_boundary_bind(const Compute *c)
{
    const ComputeBoundary *b = &c->boundary;
    if (c->constants->solid_count == 0)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, SOLID_STEPS_BLOCK, b->block);
    glBindBufferBase(GL_UNIFORM_BUFFER, EXACT_SHAPES_BLOCK, b->exact);
    compute_meshes_bind(c);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, BOUNDARY_POSITIONS_BUFFER, 4,
                      (const GLuint[]){b->position, b->velocity, b->state, b->start});
}

void compute_pose(void *state, const SolidPose *pose)
{
    Compute *c = state;
    SolidStep steps[SOLIDS_MAX] = {0};
    for (int k = 0; k < c->constants->solid_count; k++)
        solid_step_stand(&c->constants->solids[k], &pose[k], &steps[k]);
    steps_set(c, steps);
    c->boundary.due = true;
}

void compute_boundary_move(Compute *c, const SolidStep *steps)
{
    bool moves = false;
    for (int k = 0; k < c->constants->solid_count; k++)
        moves |= !steps[k].still;
    if (!moves)
        return;
    steps_set(c, steps);
    c->boundary.due = true;
}

void compute_boundary_grid(Compute *c)
{
    ComputeBoundary *b = &c->boundary;
    const size_t places = c->fold.count, n = c->constants->boundary.count;
    if (!b->due)
        return;
    b->due = false;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(b->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    compute_boundary_bind(c);
    BIND([RESTS_BUFFER] = b->rest, [CELLS_BUFFER] = b->cell, [RANKS_BUFFER] = b->rank,
         [STARTS_BUFFER] = b->start);
    compute_run(c, COMPUTE_BOUNDARY_BIN, n);
    compute_scan(c, b->start, places + 2);
    BIND([CELLS_BUFFER] = b->cell, [RANKS_BUFFER] = b->rank, [STARTS_BUFFER] = b->start,
         [ORDERS_BUFFER] = b->order);
    compute_run(c, COMPUTE_BOUNDARY_PLACE, n);
    BIND([RESTS_BUFFER] = b->rest, [ORDERS_BUFFER] = b->order);
    compute_run(c, COMPUTE_BOUNDARY_SORT, places);
}

void compute_boundary_fill(const Compute *c)
{
    compute_sweep(c, COMPUTE_BOUNDARY_FILL, c->constants->boundary.count);
}
