/* Solids: where they are, and their boundary particles, sorted in a grid of their own, so that the fluids'
   buffers hold fluid alone. The passes are those of sim/cpu/boundary.c. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

typedef struct Pose {
    float x[4], r[3][4];
} Pose;

/* One solid of shaders/sim/solids.glsl; std140: all members are multiples of 16 bytes. */
typedef struct Solid {
    Pose begin, end;
    float velocity[4], spin[4], change[4], alpha[4];
    float size[4], wall[4];
    double exact_size[4], exact_wall[4]; /* the same, for who asks for the CPU's bits */
} Solid;

typedef struct SolidsBlock {
    int32_t counts[8]; /* solids stand at a multiple of 32 bytes */
    Solid solids[SOLIDS_MAX];
} SolidsBlock;

static void copy3(const float from[3], float to[4])
{
    memcpy(to, from, 3 * sizeof *to);
}

static void pose_set(const SolidPose *from, Pose *to)
{
    copy3(from->x, to->x);
    for (int row = 0; row < 3; row++)
        copy3(from->r[row], to->r[row]);
}

static void shape_set(const Constants *s, const SolidDef *solid, Solid *out)
{
    const double endless = 1e30; /* half the depth of a box in the plane */
    out->velocity[3] = solid->slip == SLIP_NONE;
    out->spin[3] = (float)solid->kind;
    out->exact_size[3] = solid->radius;
    out->exact_wall[0] = solid->thickness;
    out->exact_wall[1] = solid_reach(solid);
    for (int k = 0; k < 3; k++)
        out->exact_size[k] = k < s->dimensions ? 0.5 * solid->size[k] : endless;
    if (solid->kind == SOLID_CYLINDER)
        out->exact_size[1] = 0.5 * solid->height;
    for (int k = 0; k < 4; k++) {
        out->size[k] = (float)out->exact_size[k];
        out->wall[k] = (float)out->exact_wall[k];
    }
}

static void steps_set(Compute *c, const SolidStep *steps)
{
    const Constants *s = c->constants;
    SolidsBlock block = {.counts = {s->solid_count, (int32_t)s->boundary.count}};
    for (int k = 0; k < s->solid_count; k++) {
        Solid *solid = &block.solids[k];
        pose_set(&steps[k].begin, &solid->begin);
        pose_set(&steps[k].end, &solid->end);
        copy3(steps[k].end.v, solid->velocity);
        copy3(steps[k].end.w, solid->spin);
        copy3(steps[k].change, solid->change);
        copy3(steps[k].alpha, solid->alpha);
        shape_set(s, &s->solids[k], solid);
    }
    const size_t used = offsetof(SolidsBlock, solids) + (size_t)s->solid_count * sizeof(Solid);
    glNamedBufferSubData(c->boundary.block, 0, (GLsizeiptr)used, &block);
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
    b->start = compute_buffer(c, "boundary cell starts", 4 * (c->constants->cells.count + 2));
    b->position = compute_buffer(c, "boundary positions", 16 * n);
    b->velocity = compute_buffer(c, "boundary velocities", 16 * n);
    b->state = compute_buffer(c, "boundary pressures", 8 * n);
    b->block = compute_buffer(c, "solids", sizeof(SolidsBlock));
    glNamedBufferSubData(b->rest, 0, (GLsizeiptr)(16 * n), rest);
    free(rest);
    return true;
}

void compute_boundary_destroy(Compute *c)
{
    const ComputeBoundary *b = &c->boundary;
    const GLuint buffers[] = {b->rest,  b->cell,     b->rank,     b->order, b->start,
                              b->state, b->position, b->velocity, b->block};
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
}

void compute_boundary_bind(const Compute *c)
{
    enum { FIRST = 12, BLOCK = 6 };
    const ComputeBoundary *b = &c->boundary;
    if (c->constants->solid_count == 0)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, BLOCK, b->block);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, FIRST, 4,
                      (const GLuint[]){b->position, b->velocity, b->state, b->start});
}

void compute_pose(void *state, const SolidPose *pose)
{
    Compute *c = state;
    SolidStep steps[SOLIDS_MAX] = {0};
    for (int k = 0; k < c->constants->solid_count; k++)
        steps[k] = (SolidStep){.begin = pose[k], .end = pose[k], .still = true};
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
    const size_t cells = c->constants->cells.count, n = c->constants->boundary.count;
    if (!b->due)
        return;
    b->due = false;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(b->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    compute_boundary_bind(c);
    compute_bind((const unsigned[]){b->rest, b->cell, 0, b->rank, b->start}, 5);
    compute_run(c, COMPUTE_BOUNDARY_BIN, n);
    compute_scan(c, b->start, cells + 2);
    compute_bind((const unsigned[]){b->cell, b->rank, b->start, b->order}, 4);
    compute_run(c, COMPUTE_BOUNDARY_PLACE, n);
    compute_bind((const unsigned[]){b->rest, 0, 0, b->order}, 4);
    compute_run(c, COMPUTE_BOUNDARY_SORT, cells);
}

void compute_boundary_fill(const Compute *c)
{
    const ComputeBoundary *b = &c->boundary;
    compute_boundary_bind(c);
    compute_bind(
        (const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, c->now.velocity, b->rest}, 6);
    compute_run(c, COMPUTE_BOUNDARY_FILL, c->constants->boundary.count);
}
