/* Forces on box and solids (sim/matter/forces.h): partial sums by passes on the GPU, shaders/sim/felt.glsl,
   read on request. */
#include "sim/matter/forces.h"
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/felt_part.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Parts of work groups over all particles: per group, for the box and each solid. */
static size_t group_parts(const Compute *c)
{
    return (c->capacity + COMPUTE_GROUP - 1) / COMPUTE_GROUP * (size_t)(1 + c->constants->solid_count);
}

static size_t parts(const Compute *c)
{
    return group_parts(c) + c->constants->boundary.count;
}

static size_t bytes(const Compute *c)
{
    return parts(c) * sizeof(FeltPart);
}

bool compute_feels(ComputePass pass)
{
    return pass == COMPUTE_KICK || pass == COMPUTE_DRIFT || pass >= COMPUTE_FELT;
}

void compute_felt_defines(const Compute *c, ComputePass pass, char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    if (c->felt.to)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used,
                 "#define FELT%s 1\n#define FELT_OF_GROUP %du\n#define FELT_BOUNDARY %zuu\n",
                 pass < COMPUTE_FELT ? "" : "_SOLIDS", 1 + c->constants->solid_count, group_parts(c));
}

static void clear(unsigned buffer)
{
    glClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

static bool prepare(Compute *c)
{
    ComputeFelt *felt = &c->felt;
    if (!felt->buffer)
        felt->buffer = compute_buffer(c, "what box and solids feel", bytes(c));
    if (!felt->marked)
        felt->marked = compute_buffer(c, "what they felt at the mark", bytes(c));
    c->full = false; /* the world can go on without */
    return felt->buffer && felt->marked;
}

static void forget(ComputeFelt *felt)
{
    clear(felt->buffer);
    clear(felt->marked);
    felt->seconds = felt->seconds_marked = 0;
}

bool compute_feel(void *state, Forces *to, Error *error)
{
    Compute *c = state;
    Forces *const before = c->felt.to;
    if (to && !prepare(c))
        return error_set(error, "the GPU has no memory to sum forces; use a larger spacing");
    if (to)
        forget(&c->felt);
    c->felt.to = to;
    if (compute_programs(c, compute_feels, error))
        return true;
    c->felt.to = before;
    return false;
}

void compute_feel_solids(Compute *c, const Pass *pass, float dt)
{
    const ComputePass at = (ComputePass)(compute_method_pass(c, pass) - COMPUTE_METHOD + COMPUTE_FELT);
    if (!c->felt.to || !c->program[at] || dt <= 0)
        return;
    glProgramUniform1f(c->program[at], FELT_DT_AT, dt);
    compute_sweep(c, at, c->constants->boundary.count);
}

void compute_felt_mark(Compute *c)
{
    ComputeFelt *felt = &c->felt;
    if (felt->to)
        glCopyNamedBufferSubData(felt->buffer, felt->marked, 0, 0, (GLsizeiptr)bytes(c));
    felt->seconds_marked = felt->seconds;
}

void compute_felt_back(Compute *c)
{
    ComputeFelt *felt = &c->felt;
    if (felt->to)
        glCopyNamedBufferSubData(felt->marked, felt->buffer, 0, 0, (GLsizeiptr)bytes(c));
    felt->seconds = felt->seconds_marked;
}

/* Forces are in units of the unit volume. */
static Push push_of(const Compute *c, const float force[3], const float torque[3])
{
    const double unit = c->constants->unit_volume;
    Push push;
    for (int k = 0; k < 3; k++) {
        push.force[k] = unit * (double)force[k];
        push.torque[k] = unit * (double)torque[k];
    }
    return push;
}

/* Adds all parts. A force on a boundary particle is taken off the box. */
static void add_up(const Compute *c, const FeltPart *part, Forces *to)
{
    const size_t groups = group_parts(c), of_group = 1 + (size_t)c->constants->solid_count;
    for (size_t k = 0; k < parts(c); k++, part++) {
        const Push push = push_of(c, part->force, part->torque), about = push_of(c, part->force, part->about);
        const size_t which = k < groups ? k % of_group : 1 + (size_t)c->constants->boundary.solid[k - groups];
        push_add(which > 0 ? &to->solid[which - 1] : &to->box, 1, &push);
        if (k >= groups)
            push_add(&to->box, -1, &about);
    }
}

bool compute_felt(void *state)
{
    Compute *c = state;
    FeltPart *all = c->felt.to ? malloc(bytes(c)) : NULL;
    if (!all)
        return !c->felt.to;
    glGetNamedBufferSubData(c->felt.buffer, 0, (GLsizeiptr)bytes(c), all);
    add_up(c, all, c->felt.to);
    c->felt.to->seconds += c->felt.seconds;
    free(all);
    forget(&c->felt);
    return true;
}
