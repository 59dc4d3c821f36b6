/* The uniform blocks of shaders/sim/constants.glsl. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/constant_block.h"
#include "shaders/sim/step_block.h"
#include "sim/box/box.h"

#include <epoxy/gl.h>
#include <string.h>

_Static_assert(FLUIDS_MOST == FLUIDS_MAX, "shaders know all fluids of a scene");

static void fluid_constants(const Constants *s, Fluid fluids[FLUIDS_MAX])
{
    for (int f = 0; f < s->fluid_count; f++)
        fluids[f] = (Fluid){s->mass[f], s->density[f], s->stiffness[f], s->viscosity[f]};
}

static void grid_constants(const Constants *s, const CellFold *fold, ConstantBlock *c)
{
    for (int k = 0; k < 3; k++) {
        c->first_cell[k] = s->cells.first[k];
        c->grid_size[k] = s->cells.size[k];
        c->cell_origin[k] = s->cells.origin[k];
        c->cell_inverse[k] = s->cells.inverse[k];
        c->box_low[k] = s->periodic.low[k];
        c->box_whole[k] = s->periodic.size[k];
    }
    c->cell_total = (int)fold->count;
    c->cell_fold[0] = (int)fold->y;
    c->cell_fold[1] = (int)fold->z;
    c->cell_fold[2] = (int)fold->mask;
    c->first_row = s->first_row;
    c->last_row = s->last_row;
    if (s->periodic.any) { /* single cells: a row may continue across a side */
        c->first_single_row = 3 * s->first_row;
        c->last_single_row = 3 * s->last_row;
    }
}

static void blocks_create(Compute *compute)
{
    if (compute->constant_block)
        return;
    glCreateBuffers(1, &compute->constant_block);
    glNamedBufferStorage(compute->constant_block, sizeof(ConstantBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    glCreateBuffers(1, &compute->step);
    glNamedBufferStorage(compute->step, sizeof(StepBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
}

void compute_constants(Compute *compute)
{
    const Constants *s = compute->constants;
    ConstantBlock c = {.support = s->support_radius,
                       .inverse_support = 1 / s->support_radius,
                       .rest_number_density = s->rest_number_density,
                       .spacing = s->spacing,
                       .kernel_scale = s->kernel_scale,
                       .pressure_scale = s->pressure_scale,
                       .viscosity_scale = s->viscosity_scale,
                       .stiffness_scale = s->stiffness_scale,
                       .inverse_unit = (float)(1 / s->unit),
                       .unit_volume = (float)s->unit_volume,
                       .inverse_unit_volume = (float)(1 / s->unit_volume),
                       .wall_lift = s->lift.scale,
                       .particle_total = (int)compute->count,
                       .dimensions = s->dimensions};
    grid_constants(s, &compute->fold, &c);
    memcpy(c.half_size, s->walls.half_size, sizeof s->walls.half_size);
    fluid_constants(s, c.fluids);
    blocks_create(compute);
    glNamedBufferSubData(compute->constant_block, 0, sizeof c, &c);
    compute_term_constants(compute);
}

void compute_vary(void *state)
{
    const Compute *compute = state;
    Fluid fluids[FLUIDS_MAX] = {0};
    fluid_constants(compute->constants, fluids);
    glNamedBufferSubData(compute->constant_block, offsetof(ConstantBlock, fluids), sizeof fluids, fluids);
}

void compute_set_count(Compute *compute, size_t count)
{
    const int number = (int)count;
    compute->count = count;
    glNamedBufferSubData(compute->constant_block, offsetof(ConstantBlock, particle_total), sizeof number,
                         &number);
}

void compute_copy_count(const Compute *compute, unsigned buffer, size_t offset, bool out)
{
    const GLintptr own = offsetof(ConstantBlock, particle_total), other = (GLintptr)offset;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(out ? compute->constant_block : buffer, out ? buffer : compute->constant_block,
                             out ? own : other, out ? other : own, sizeof(int));
}

static void copy3(const float from[3], float to[3])
{
    memcpy(to, from, 3 * sizeof *to);
}

/* Uploads the members of StepBlock from `begin` to before `end`. */
static void put_step(const Compute *compute, const StepBlock *block, size_t begin, size_t end)
{
    glNamedBufferSubData(compute->step, (GLintptr)begin, (GLsizeiptr)(end - begin),
                         (const char *)block + begin);
}

void compute_set_drift(Compute *compute, const BoxStep *step)
{
    StepBlock block = {.drift_dt = step->dt, .still = step->still};
    for (int k = 0; k < 3; k++)
        copy3(step->rotation[k], block.rotation[k]);
    copy3(step->omega0, block.omega0);
    copy3(step->omega1, block.omega1);
    copy3(step->shift, block.shift);
    copy3(step->velocity_change, block.velocity_change);
    put_step(compute, &block, 0, offsetof(StepBlock, gravity));
}

void compute_set_kick(Compute *compute, const float gravity[3], float dt)
{
    StepBlock block = {.kick_dt = dt};
    copy3(gravity, block.gravity);
    put_step(compute, &block, offsetof(StepBlock, gravity), offsetof(StepBlock, apparent_origin));
}

void compute_set_force(Compute *compute, const PassInput *input)
{
    StepBlock block = {0};
    copy3(input->apparent->origin, block.apparent_origin);
    copy3(input->apparent->alpha, block.apparent_alpha);
    copy3(input->apparent->omega, block.apparent_omega);
    copy3(input->gravity, block.kick_gravity);
    put_step(compute, &block, offsetof(StepBlock, apparent_origin), sizeof block);
}
