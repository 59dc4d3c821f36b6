/* The uniform blocks of shaders/sim/constants.glsl. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>
#include <string.h>

/* std140: all members are multiples of 16 bytes. */
typedef struct ConstantBlock {
    float kernel[4], scales[4];
    int32_t cell_first[4], cell_size[4], rows[4];
    float half_size[4];
    int32_t wall_nodes[4];
    float wall_steps[4];
    int32_t wall_offset[4];
    float fluids[FLUIDS_MAX][4];
    float cell_origin[4], cell_inverse[4], box_low[4], box_whole[4];
} ConstantBlock;

typedef struct Step {
    float rotation[3][4], omega0[4], omega1[4], shift[4], velocity_change[4];
    float gravity[4];
    float felt[3][4]; /* origin, alpha, omega */
} Step;

static void set4(float out[4], float x, float y, float z, float w)
{
    out[0] = x, out[1] = y, out[2] = z, out[3] = w;
}

static void walls_constants(const Walls *walls, ConstantBlock *c)
{
    set4(c->half_size, walls->half_size[0], walls->half_size[1], walls->half_size[2], walls->range);
    for (int t = 0; t < walls->dimensions; t++) {
        c->wall_nodes[t] = walls->table[t].nodes;
        c->wall_steps[t] = walls->table[t].inverse_step;
        c->wall_offset[t] = (int32_t)walls_entries(walls, t);
    }
}

static void set_fluids(const Constants *s, float fluids[FLUIDS_MAX][4])
{
    for (int f = 0; f < s->fluid_count; f++)
        set4(fluids[f], s->mass[f], s->density[f], s->stiffness[f], s->viscosity[f]);
}

void compute_constants(Compute *compute)
{
    const Constants *s = compute->constants;
    ConstantBlock c = {0};
    set4(c.kernel, s->support_radius, 1 / s->support_radius, s->rest_number_density, s->spacing);
    set4(c.scales, s->kernel_scale, s->pressure_scale, s->viscosity_scale, s->compression);
    for (int k = 0; k < 3; k++) {
        c.cell_first[k] = s->cells.first[k];
        c.cell_size[k] = s->cells.size[k];
        c.cell_origin[k] = s->cells.origin[k];
        c.cell_inverse[k] = s->cells.inverse[k];
        c.box_low[k] = s->periodic.low[k];
        c.box_whole[k] = s->periodic.size[k];
    }
    c.cell_first[3] = (int32_t)compute->count;
    c.cell_size[3] = (int32_t)s->cells.count;
    c.rows[0] = s->first_row;
    c.rows[1] = s->last_row;
    if (s->periodic.any) { /* single cells: a row may go on across a side */
        c.rows[2] = 3 * s->first_row;
        c.rows[3] = 3 * s->last_row;
    }
    walls_constants(&s->walls, &c);
    set_fluids(s, c.fluids);
    if (!compute->constant_block) {
        glCreateBuffers(1, &compute->constant_block);
        glNamedBufferStorage(compute->constant_block, sizeof c, NULL, GL_DYNAMIC_STORAGE_BIT);
        glCreateBuffers(1, &compute->step);
        glNamedBufferStorage(compute->step, sizeof(Step), NULL, GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(compute->constant_block, 0, sizeof c, &c);
    compute_term_constants(compute);
}

void compute_vary(void *state)
{
    const Compute *compute = state;
    float fluids[FLUIDS_MAX][4] = {0};
    set_fluids(compute->constants, fluids);
    glNamedBufferSubData(compute->constant_block, offsetof(ConstantBlock, fluids), sizeof fluids, fluids);
}

void compute_set_count(Compute *compute, size_t count)
{
    const int32_t number = (int32_t)count;
    compute->count = count;
    glNamedBufferSubData(compute->constant_block, offsetof(ConstantBlock, cell_first) + 3 * sizeof number,
                         sizeof number, &number);
}

static void set3(float out[4], const float v[3], float w)
{
    set4(out, v[0], v[1], v[2], w);
}

void compute_set_drift(Compute *compute, const FrameStep *step)
{
    Step block = {0};
    for (int k = 0; k < 3; k++)
        set3(block.rotation[k], step->rotation[k], k == 0 ? step->dt : k == 1 ? (float)step->still : 0);
    set3(block.omega0, step->omega0, 0);
    set3(block.omega1, step->omega1, 0);
    set3(block.shift, step->shift, 0);
    set3(block.velocity_change, step->velocity_change, 0);
    glNamedBufferSubData(compute->step, 0, offsetof(Step, gravity), &block);
}

void compute_set_kick(Compute *compute, const float gravity[3], float dt)
{
    const float values[4] = {gravity[0], gravity[1], gravity[2], dt};
    glNamedBufferSubData(compute->step, offsetof(Step, gravity), sizeof values, values);
}

void compute_set_force(Compute *compute, const ApparentGravity *gravity)
{
    float felt[3][4];
    set3(felt[0], gravity->origin, 0);
    set3(felt[1], gravity->alpha, 0);
    set3(felt[2], gravity->omega, 0);
    glNamedBufferSubData(compute->step, offsetof(Step, felt), sizeof felt, felt);
}
