/* Distances to mesh solids for the shaders: shaders/sim/mesh_distance.glsl. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/exact_shapes_block.h"
#include "shaders/sim/force_part.h"
#include "shaders/sim/mesh_block.h"
#include "shaders/sim/solid_steps_block.h"
#include "sim/mesh/mesh_shape.h"
#include "sim/world.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

static const MeshShape *mesh_shape_of(const Compute *c, int solid)
{
    const SolidDef *def = &c->constants->solids[solid];
    return def->kind == SOLID_MESH ? def->mesh.shape : NULL;
}

static MeshGrid grid_of(const DistanceGrid *from, double scale, size_t first)
{
    MeshGrid grid = {.exact_cell = from->cell,
                     .exact_scale = scale,
                     .cell = (float)from->cell,
                     .scale = (float)scale,
                     .first = (int)first};
    for (int k = 0; k < 3; k++) {
        grid.exact_low[k] = from->low[k];
        grid.exact_inner[k] = from->inner[k];
        grid.low[k] = (float)from->low[k];
        grid.inner[k] = (float)from->inner[k];
        grid.size[k] = from->size[k];
    }
    return grid;
}

/* The first solid with the same mesh, whose values are shared. */
static int same_before(const Compute *c, int solid)
{
    int other = 0;
    while (mesh_shape_of(c, other) != mesh_shape_of(c, solid))
        other++;
    return other;
}

static size_t places(const Compute *c, MeshBlock *block)
{
    size_t count = 0;
    for (int k = 0; k < c->constants->solid_count; k++) {
        const MeshShape *shape = mesh_shape_of(c, k);
        const int same = shape ? same_before(c, k) : k;
        if (!shape)
            continue;
        block->meshes[k] = grid_of(&shape->distance, c->constants->solids[k].mesh.scale, count);
        if (same < k)
            block->meshes[k].first = block->meshes[same].first;
        else
            count += distance_count(&shape->distance);
    }
    return count;
}

bool compute_meshes_create(Compute *c, Error *error)
{
    MeshBlock block = {0};
    GLint most = 0;
    const size_t count = places(c, &block);
    if (count == 0)
        return true;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (count > (size_t)most)
        return error_set(
            error,
            "backend compute: the distances of the meshes are %zu numbers, and a texture of this driver holds "
            "%d; use the backend cpu",
            count, most);
    ComputeMeshes *meshes = &c->meshes;
    float *values = malloc(count * sizeof *values);
    c->full |= !values;
    for (int k = 0; values && k < c->constants->solid_count; k++)
        if (mesh_shape_of(c, k) && same_before(c, k) == k)
            memcpy(values + block.meshes[k].first, mesh_shape_of(c, k)->distance.value,
                   sizeof(float) * distance_count(&mesh_shape_of(c, k)->distance));
    meshes->block = compute_buffer_of(c, "meshes", sizeof block, &block);
    meshes->values = compute_buffer_of(c, "distances from meshes", sizeof(float) * count, values);
    free(values);
    if (!meshes->block || !meshes->values)
        return true; /* compute_buffer_of has set `full` */
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &meshes->texture);
    glObjectLabel(GL_TEXTURE, meshes->texture, -1, "distances from meshes");
    glTextureBuffer(meshes->texture, GL_R32F, meshes->values);
    return true;
}

void compute_meshes_destroy(Compute *c)
{
    const GLuint buffers[] = {c->meshes.block, c->meshes.values};
    glDeleteTextures(1, &c->meshes.texture);
    glDeleteBuffers(2, buffers);
}

/* Solids: poses and boundary particles, sorted in a separate grid, so that the fluids' buffers hold fluid
   only. Passes as in sim/cpu/boundary.c. */

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

static ExactShape exact_shape_of(const Constants *s, const SolidDef *solid)
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
        exact.exact_shapes[k] = exact_shape_of(s, &s->solids[k]);
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
    b->rest = compute_buffer_of(c, "boundary particles at rest", 16 * n, rest);
    b->cell = compute_buffer(c, "boundary cells", 4 * n);
    b->rank = compute_buffer(c, "boundary ranks", 4 * n);
    b->order = compute_buffer(c, "boundary order", 4 * n);
    b->start = compute_buffer(c, "boundary cell starts", 4 * (c->fold.count + 2));
    b->position = compute_buffer(c, "boundary positions", 16 * n);
    b->velocity = compute_buffer(c, "boundary velocities", 16 * n);
    b->state = compute_buffer(c, "boundary pressures", 8 * n);
    b->block = compute_buffer(c, "solids", sizeof(SolidStepsBlock));
    b->exact = compute_buffer(c, "shapes of solids", sizeof(ExactShapesBlock));
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
    compute_clear(c, b->start, 4 * (places + 2));
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

void compute_boundary_fill(Compute *c)
{
    compute_sweep(c, COMPUTE_BOUNDARY_FILL, c->constants->boundary.count);
}

/* Forces on box and solids (sim/world.h): partial sums by passes on the GPU,
   shaders/sim/forces.glsl, read on request. */

static size_t parts(const Compute *c)
{
    return compute_group_parts(c) + c->constants->boundary.count;
}

static size_t bytes(const Compute *c)
{
    return parts(c) * sizeof(ForcePart);
}

static bool prepare(Compute *c)
{
    ComputeForces *forces = &c->forces;
    if (!forces->buffer)
        forces->buffer = compute_buffer(c, "forces on box and solids", bytes(c));
    if (!forces->marked)
        forces->marked = compute_buffer(c, "forces at the mark", bytes(c));
    for (int k = 0; k < 2; k++)
        if (!forces->sums[k].buffer)
            mailbox_create(&forces->sums[k], "sums of forces", (1 + SOLIDS_MAX) * sizeof(ForceSum));
    c->full = false; /* the world can go on without */
    return forces->buffer && forces->marked && forces->sums[0].mapped && forces->sums[1].mapped;
}

static void forces_clear(Compute *c)
{
    ComputeForces *forces = &c->forces;
    compute_clear(c, forces->buffer, bytes(c));
    compute_clear(c, forces->marked, bytes(c));
    forces->seconds = forces->seconds_marked = 0;
}

bool compute_enable_forces(void *state, Forces *to, Error *error)
{
    Compute *c = state;
    Forces *const before = c->forces.to;
    if (to && !prepare(c))
        return error_set(error, "the GPU has no memory to sum forces; use a larger spacing");
    if (to)
        forces_clear(c);
    c->forces.to = to;
    if (compute_programs(c, compute_changes_with_forces, error))
        return true;
    c->forces.to = before;
    return false;
}

void compute_add_solid_forces(Compute *c, const Pass *pass, float dt)
{
    const ComputePass at = (ComputePass)(compute_method_pass(c, pass) - COMPUTE_METHOD + COMPUTE_FORCES);
    if (!c->forces.to || !c->program[at] || dt <= 0)
        return;
    glProgramUniform1f(c->program[at], FORCES_DT_AT, dt);
    compute_sweep(c, at, c->constants->boundary.count);
}

void compute_forces_mark(Compute *c)
{
    ComputeForces *forces = &c->forces;
    if (forces->to)
        compute_copy(c, forces->buffer, forces->marked, 0, bytes(c));
    forces->seconds_marked = forces->seconds;
}

void compute_forces_back(Compute *c)
{
    ComputeForces *forces = &c->forces;
    if (forces->to)
        compute_copy(c, forces->marked, forces->buffer, 0, bytes(c));
    compute_forces_forget(c);
    forces->seconds = forces->seconds_marked;
}

/* Forces are in units of the unit volume. */
static void add_sum(const Compute *c, const ForceSum *sum, Push *to)
{
    const double unit = c->constants->unit_volume;
    Push push;
    for (int k = 0; k < 3; k++) {
        push.force[k] = unit * ((double)sum->force[k] + (double)sum->force_left[k]);
        push.torque[k] = unit * ((double)sum->torque[k] + (double)sum->torque_left[k]);
    }
    push_add(to, 1, &push);
}

void compute_forces_send(void *state)
{
    Compute *c = state;
    ComputeForces *forces = &c->forces;
    if (!forces->to)
        return;
    Mailbox *sums = &forces->sums[forces->sent % 2];
    BIND([FORCES_BUFFER] = forces->buffer, [FORCES_RESTS_BUFFER] = c->boundary.rest,
         [FORCE_SUMS_BUFFER] = sums->buffer);
    compute_run(c, COMPUTE_FORCES_SUM, (size_t)(1 + c->constants->solid_count) * COMPUTE_GROUP);
    mailbox_send(sums);
    forces->sent++;
    forces->to->seconds += forces->seconds;
    forces_clear(c);
}

Mailbox *compute_forces_newest(Compute *c)
{
    ComputeForces *forces = &c->forces;
    return forces->sent == forces->taken ? NULL : &forces->sums[(forces->sent - 1) % 2];
}

void compute_forces_arrive(Compute *c, const void *sums)
{
    c->forces.here[(c->forces.sent - 1) % 2] = sums;
}

bool compute_forces_take(void *state)
{
    Compute *c = state;
    ComputeForces *forces = &c->forces;
    Mailbox *newest = compute_forces_newest(c);
    if (!newest)
        return true;
    if (newest->fence)
        compute_forces_arrive(c, mailbox_wait(newest));
    const unsigned oldest = forces->taken++ % 2;
    if (forces->sums[oldest].fence) /* sent before, hence here */
        forces->here[oldest] = mailbox_look(&forces->sums[oldest]);
    const ForceSum *sum = forces->here[oldest];
    for (int k = 0; sum && forces->to && k <= c->constants->solid_count; k++)
        add_sum(c, &sum[k], k > 0 ? &forces->to->solid[k - 1] : &forces->to->box);
    forces->here[oldest] = NULL;
    return sum != NULL;
}
