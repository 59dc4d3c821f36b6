/* Stages of a step. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>

/* Counting sort by places of the cell fold; for reproducible worlds by id within a cell, the order of
   sim/cpu/grid.c. */
void compute_grid(void *state)
{
    Compute *c = state;
    unsigned order = c->order;
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    compute_clear(c, c->start, 4 * (c->fold.count + 1));
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
         [NAMES_BUFFER] = c->spare.name, [LISTS_BUFFER] = c->lists[0], [MORE_LISTS_BUFFER] = c->lists[1],
         c->lists[2], c->lists[3]);
    compute_run(c, COMPUTE_MOVE, c->count);
    compute_own_move(c, order);
    if (c->decided == DECIDED_RENEWAL) /* possibly nothing has moved */
        compute_particles_copy(c, c->spare, c->now);
    else
        compute_swap(c);
    compute_flow_gridded(c);
    compute_boundary_grid(c);
}

void compute_drift(void *state, const BoxStep *step)
{
    Compute *c = state;
    compute_set_drift(c, step);
    if (step->solids)
        compute_boundary_move(c, step->solids);
    compute_sweep(c, COMPUTE_DRIFT, c->count);
}

void compute_pass(void *state, const Pass *pass, const PassInput *input)
{
    Compute *c = state;
    const ComputePass at = compute_method_pass(c, pass);
    compute_boundary_grid(c); /* a drift may have moved the solids */
    if (c->takes_dt[at])
        glProgramUniform1f(c->program[at], PASS_DT_AT, input->dt);
    /* the begin of a world has no force before its rates, whose dt is 0 */
    if ((pass->stage == STAGE_FORCE || pass->stage == STAGE_INTEGRATE || input->dt == 0) && input->apparent)
        compute_set_force(c, input);
    if (pass->mirrors && c->constants->solid_count > 0)
        compute_boundary_fill(c);
    compute_sweep(c, at, c->count);
    if (pass->acts_on_solids)
        compute_add_solid_forces(c, pass, input->dt);
}

void compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    compute_set_kick(c, gravity, dt);
    compute_sweep(c, COMPUTE_KICK, c->count);
    compute_watch_note(c, dt);
    c->forces.seconds += (double)dt;
}

void compute_touch(void *state, const FingerStep *finger)
{
    Compute *c = state;
    const GLuint program = c->program[COMPUTE_TOUCH];
    const float *at = finger->at, *v = finger->velocity;
    glProgramUniform4f(program, FINGER_AT, at[0], at[1], at[2], finger->inverse_radius2);
    glProgramUniform4f(program, FINGER_VELOCITY_AT, v[0], v[1], v[2], finger->grip);
    glProgramUniform1f(program, FINGER_KICK_AT, finger->kick);
    compute_sweep(c, COMPUTE_TOUCH, c->count);
}
