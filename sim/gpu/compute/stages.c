/* Stages of a step. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/excess_part.h"
#include "shaders/sim/solve_block.h"
#include "sim/gpu/gl.h"
#include "sim/step/substep.h"

#include <epoxy/gl.h>
#include <math.h>

/* Counting sort by places of the cell fold; for reproducible worlds by id within a cell, the order of
   sim/cpu/grid.c. */
void compute_grid(void *state)
{
    Compute *c = state;
    unsigned order = c->order;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(c->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    BIND(c, [POSITIONS_BUFFER] = c->now.position, [CELLS_BUFFER] = c->cell, [RANKS_BUFFER] = c->rank,
         [STARTS_BUFFER] = c->start);
    compute_run(c, COMPUTE_BIN, c->count);
    compute_scan(c, c->start, c->fold.count + 1);
    BIND(c, [CELLS_BUFFER] = c->cell, [RANKS_BUFFER] = c->rank, [STARTS_BUFFER] = c->start,
         [ORDERS_BUFFER] = c->order);
    compute_run(c, COMPUTE_PLACE, c->count);
    if (c->constants->reproducible) {
        BIND(c, [NAMES_BUFFER] = c->now.name, [CELLS_BUFFER] = c->cell, [STARTS_BUFFER] = c->start,
             [ORDERS_BUFFER] = c->order, [SORTED_BUFFER] = c->rank);
        compute_run(c, COMPUTE_SORT, c->count);
        order = c->rank; /* free at this point */
    }
    BIND(c, [ORDERS_BUFFER] = order, [OLD_POSITIONS_BUFFER] = c->now.position,
         [OLD_VELOCITIES_BUFFER] = c->now.velocity, [OLD_NAMES_BUFFER] = c->now.name,
         [POSITIONS_BUFFER] = c->spare.position, [VELOCITIES_BUFFER] = c->spare.velocity,
         [NAMES_BUFFER] = c->spare.name, [LISTS_BUFFER] = c->lists);
    compute_run(c, COMPUTE_MOVE, c->count);
    compute_own_move(c, order);
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
    if ((pass->stage == STAGE_FORCE || pass->stage == STAGE_INTEGRATE) && input->apparent)
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

/* The loop of an iterating solver, decided on the GPU. Passes of an iteration take their work groups from a
   buffer, and after each iteration a small pass sets the number to 0 once the residual is small enough. A
   batch has slightly more iterations than the last step needed. So a step usually waits once per solver,
   not once per iteration. */

enum { MORE = 2 }; /* iterations beyond those of the last step */

/* Summed columns: the residual, its scale, and requested columns. */
enum { RESIDUAL_PARTS, SCALE_PARTS = EXCESS_OF_SCALE, ASKED_PARTS, PARTS = ASKED_PARTS + ITERATION_ASKED };

/* A group for each 1024 particles: of the capacity, so that no other number changes the sums. */
static size_t excess_groups(const Compute *c)
{
    const size_t groups = c->capacity / 1024;
    return groups < COMPUTE_GROUP                ? COMPUTE_GROUP
           : groups < COMPUTE_EXCESS_GROUPS_MOST ? groups
                                                 : COMPUTE_EXCESS_GROUPS_MOST;
}

bool compute_iterate_fit(Compute *c)
{
    if (c->parts.buffer || !compute_iterates(c->constants))
        return true;
    return mailbox_create(&c->parts, "parts of residuals", PARTS * excess_groups(c) * sizeof(ExcessPart)) &&
           mailbox_create(&c->solve, "solver", sizeof(SolveBlock));
}

static void begin(const Compute *c, const Iteration *iteration)
{
    const size_t groups = (c->count + COMPUTE_GROUP - 1) / COMPUTE_GROUP;
    const SolveBlock block = {.groups_along = (uint)(groups > COMPUTE_ALONG ? COMPUTE_ALONG : groups),
                              .groups_rows = (uint)((groups + COMPUTE_ALONG - 1) / COMPUTE_ALONG),
                              .groups_deep = 1,
                              .sums_along = (uint)excess_groups(c),
                              .sums_rows = 1,
                              .sums_deep = 1,
                              .decisions_along = 1,
                              .decisions_rows = 1,
                              .decisions_deep = 1,
                              .iterations = iteration->begun ? UINT32_MAX : 0, /* the first measure adds 1 */
                              .tolerance = (float)iteration->tolerance,
                              .worst = (float)iteration->worst,
                              .iterations_few = (uint)iteration->few,
                              .iterations_most = (uint)iteration->most,
                              .scaled = iteration->scale != NULL};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glNamedBufferSubData(c->solve.buffer, 0, sizeof block, &block);
}

static GLuint place_of(const Compute *c, const ColumnDef *column)
{
    return column ? (GLuint)compute_scratch_place(c, column) : EXCESS_NO_COLUMN;
}

/* Sums a column into part `which`; for a residual also the sums of conjugate gradients. */
static void sum_up(Compute *c, const ColumnDef *column, int which, const ColumnDef *power,
                   const ColumnDef *curvature)
{
    glProgramUniform4ui(c->program[COMPUTE_EXCESS], COLUMN_AT, place_of(c, column),
                        (GLuint)which * (GLuint)excess_groups(c), place_of(c, power), place_of(c, curvature));
    BIND(c, [SCRATCH_BUFFER] = c->scratch, [PARTS_BUFFER] = c->parts.buffer);
    compute_run(c, COMPUTE_EXCESS, excess_groups(c) * COMPUTE_GROUP);
}

static Excess excess_of(const Compute *c, int which)
{
    const size_t groups = excess_groups(c);
    const ExcessPart *part = (const ExcessPart *)c->parts.mapped + (size_t)which * groups;
    Excess excess = {0};
    for (size_t k = 0; k < groups; k++) {
        excess.mean += (double)part[k].above;
        excess.greatest = part[k].greatest > excess.greatest ? part[k].greatest : excess.greatest;
    }
    excess.mean /= c->count > 0 ? (double)c->count : 1;
    return excess;
}

/* Sends the requested sums before the solver's result, which is waited for. */
static void ask(Compute *c, const Iteration *iteration)
{
    for (int k = 0; k < ITERATION_ASKED && iteration->asked[k].column; k++)
        sum_up(c, iteration->asked[k].column, ASKED_PARTS + k, NULL, NULL);
    if (iteration->asked[0].column)
        mailbox_send(&c->parts);
}

static void answer(const Compute *c, const Iteration *iteration)
{
    for (int k = 0; k < ITERATION_ASKED && iteration->asked[k].column; k++)
        *iteration->asked[k].to = excess_of(c, ASKED_PARTS + k);
}

static void decide(Compute *c, const Iteration *iteration)
{
    sum_up(c, iteration->residual, RESIDUAL_PARTS, iteration->power, iteration->curvature);
    BIND(c, [PARTS_BUFFER] = c->parts.buffer, [SOLVE_BUFFER] = c->solve.buffer);
    compute_run(c, COMPUTE_DECIDE, COMPUTE_GROUP);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

static void iterate_once(Compute *c, const Iteration *iteration, const PassInput *input)
{
    c->decided = true;
    for (int k = 0; iteration->passes[k]; k++)
        compute_pass(c, iteration->passes[k], input);
    decide(c, iteration);
    c->decided = false;
}

void compute_iterate(void *state, const Iteration *iteration, const PassInput *input, StepSolve *solve)
{
    Compute *c = state;
    /* without execution, as in a test of texts, the number set by `begin` comes back */
    const int at_once = (int)fmin(solve->iterations, iteration->most) + MORE;
    const SolveBlock *found;
    int asked = 0;
    begin(c, iteration);
    if (iteration->scale)
        sum_up(c, iteration->scale, SCALE_PARTS, NULL, NULL);
    if (iteration->begun)
        decide(c, iteration);
    do {
        for (int k = 0; k < at_once && asked < iteration->most; k++, asked++)
            iterate_once(c, iteration, input);
        ask(c, iteration);
        mailbox_send(&c->solve);
        found = mailbox_wait(&c->solve);
    } while (found && !found->ended && asked < iteration->most);
    answer(c, iteration);
    *solve = (StepSolve){.tolerance = iteration->tolerance};
    if (found)
        *solve = (StepSolve){.iterations = found->ended ? (double)found->iterations
                                                        : asked, /* a GPU may have done nothing */
                             .mean = (double)found->left_mean,
                             .most = (double)found->left_most,
                             .tolerance = iteration->tolerance};
}

/* All copies go off before a single wait, for the last. */
void compute_finish(void *state, bool forces, size_t *flowed)
{
    Compute *c = state;
    if (!forces && c->flow.calls == 0)
        return;
    compute_watch_send(c);
    const bool flows = compute_flow_send(c), sums = forces && compute_forces_send(c);
    const void *found = mailbox_wait(sums ? &c->forces.sums : &c->flow.counts);
    c->watch_here = true;
    if (sums)
        compute_forces_take(c, found);
    if (flows)
        compute_flow_take(c, sums ? mailbox_look(&c->flow.counts) : found, flowed);
}
