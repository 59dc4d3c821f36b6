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

/* The loop of an iterating solver, decided on the GPU. Passes of an iteration take their work groups from a
   buffer, and after each iteration a small pass sets the number to 0 once the residual is small enough. A
   batch has some more iterations than the last step needed. A guess takes a single batch for enough, and
   compute_finish checks all guesses of a step together. A wrong guess costs the step: guesses begin after
   steps with right predictions, and after more steps for each wrong guess. */

enum { MORE = 2, NEEDED_MOST = 64 }; /* iterations beyond those of the last step; ComputeSolves.needed */

/* Summed columns: the residual, the scale, and columns of the report. */
enum { RESIDUAL_PARTS, SCALE_PARTS = EXCESS_OF_SCALE, REPORT_PARTS, PARTS = REPORT_PARTS + 2 };

/* A group for each 1024 particles: of the capacity, so that no other number changes the sums. */
static size_t excess_groups(const Compute *c)
{
    const size_t groups = c->capacity / 1024;
    return groups < COMPUTE_GROUP                ? COMPUTE_GROUP
           : groups < COMPUTE_EXCESS_GROUPS_MOST ? groups
                                                 : COMPUTE_EXCESS_GROUPS_MOST;
}

static size_t bytes_of_parts(const Compute *c, int columns)
{
    return (size_t)columns * excess_groups(c) * sizeof(ExcessPart);
}

/* A solver's share of the mailbox. */
static size_t bytes_found(const Compute *c)
{
    return sizeof(SolveBlock) + bytes_of_parts(c, PARTS - REPORT_PARTS);
}

bool compute_iterate_fit(Compute *c)
{
    if (c->parts || !compute_iterates(c->constants))
        return true;
    c->parts = compute_buffer(c, "parts of residuals", bytes_of_parts(c, PARTS));
    c->solve = compute_buffer(c, "solver", sizeof(SolveBlock));
    return c->parts && c->solve &&
           mailbox_create(&c->solves.found, "results of solvers", SOLVES_MAX * bytes_found(c));
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
    glNamedBufferSubData(c->solve, 0, sizeof block, &block);
}

static GLuint place_of(const Compute *c, const ColumnDef *column)
{
    return column ? (GLuint)compute_scratch_place(c, column) : EXCESS_NO_COLUMN;
}

/* Sums a column into part `which`; for a residual also the sums of conjugate gradients. */
static void sum_up(Compute *c, const ColumnDef *column, int which, const ColumnDef *power,
                   const ColumnDef *curvature)
{
    const size_t groups = excess_groups(c);
    glProgramUniform4ui(c->program[COMPUTE_EXCESS], COLUMN_AT, place_of(c, column),
                        (GLuint)((size_t)which * groups), place_of(c, power), place_of(c, curvature));
    BIND([SCRATCH_BUFFER] = c->scratch, [PARTS_BUFFER] = c->parts);
    compute_run(c, COMPUTE_EXCESS, groups * COMPUTE_GROUP);
}

static void decide(Compute *c, const Iteration *iteration)
{
    sum_up(c, iteration->residual, RESIDUAL_PARTS, iteration->power, iteration->curvature);
    BIND([PARTS_BUFFER] = c->parts, [SOLVE_BUFFER] = c->solve);
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

/* Copies the results of a solver to the solver's place in the mailbox. */
static void put_found(Compute *c, const Iteration *iteration, int which)
{
    const size_t parts = bytes_of_parts(c, PARTS - REPORT_PARTS), at = (size_t)which * bytes_found(c);
    const unsigned to = c->solves.found.buffer;
    if (iteration->way)
        sum_up(c, iteration->way, REPORT_PARTS, NULL, NULL);
    if (iteration->left)
        sum_up(c, iteration->left, REPORT_PARTS + 1, NULL, NULL);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(c->solve, to, 0, (GLintptr)at, sizeof(SolveBlock));
    if (iteration->way || iteration->left)
        glCopyNamedBufferSubData(c->parts, to, (GLintptr)bytes_of_parts(c, REPORT_PARTS),
                                 (GLintptr)(at + sizeof(SolveBlock)), (GLsizeiptr)parts);
}

static Excess excess_of(const Compute *c, const ExcessPart *part, double count)
{
    Excess excess = {0};
    for (size_t k = 0; k < excess_groups(c); k++) {
        excess.mean += (double)part[k].above;
        excess.greatest = part[k].greatest > excess.greatest ? part[k].greatest : excess.greatest;
    }
    excess.mean /= fmax(count, 1);
    return excess;
}

/* Reads the results of a solver; false if more iterations were needed than the `asked`. A GPU may have done
   nothing. */
static bool take_found(const Compute *c, const Iteration *iteration, int which, const void *all, int asked,
                       IterationFound *found)
{
    if (!all) {
        *found = (IterationFound){0};
        return true;
    }
    const char *at = (const char *)all + (size_t)which * bytes_found(c);
    const SolveBlock *block = (const void *)at;
    const ExcessPart *part = (const void *)(at + sizeof *block);
    *found = (IterationFound){.iterations = block->ended ? (double)block->iterations : asked,
                              .mean = (double)block->left_mean,
                              .most = (double)block->left_most};
    if (iteration->way)
        found->way = excess_of(c, part, block->particles);
    if (iteration->left)
        found->left = excess_of(c, part + excess_groups(c), block->particles);
    return block->ended;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

bool compute_iterate(void *state, const Iteration *iteration, const PassInput *input, StepSolve *solve,
                     IterationFound *found)
{
    Compute *c = state;
    ComputeSolves *solves = &c->solves;
    const int last = (int)fmin(solve->iterations, iteration->most), at_once = last + MORE + last / 4;
    int asked = 0, batches = 0;
    bool ended;
    begin(c, iteration);
    if (iteration->scale)
        sum_up(c, iteration->scale, SCALE_PARTS, NULL, NULL);
    if (iteration->begun)
        decide(c, iteration);
    do {
        for (const int end = least(asked + at_once, iteration->most); asked < end; asked++)
            iterate_once(c, iteration, input);
        put_found(c, iteration, solves->guessed);
        if (solves->may_guess) {
            solves->guess[solves->guessed].of = *iteration;
            solves->guess[solves->guessed++].to = solve;
            return false;
        }
        mailbox_send(&solves->found);
        ended = take_found(c, iteration, solves->guessed, mailbox_wait(&solves->found), asked, found);
        batches++;
    } while (!ended && asked < iteration->most);
    solves->missed |= batches > 1 || iteration_strays(iteration, found);
    return true;
}

void compute_guess(void *state)
{
    Compute *c = state;
    c->solves.may_guess = c->solves.right >= COMPUTE_GUESS_AFTER + c->solves.needed;
}

/* Writes the reports of right guesses. */
static void take_guesses(Compute *c, const void *all)
{
    ComputeSolves *solves = &c->solves;
    for (int k = 0; k < solves->guessed; k++) {
        const Iteration *iteration = &solves->guess[k].of;
        IterationFound found;
        const bool ended = take_found(c, iteration, k, all, 0, &found);
        if (ended && !iteration_strays(iteration, &found))
            iteration_report(iteration, &found, solves->guess[k].to);
        else
            solves->missed = true;
    }
}

/* Sends all copies, then waits for the last copy. */
static void finish(Compute *c, bool forces, size_t *flowed)
{
    Mailbox *const guesses = c->solves.guessed > 0 ? &c->solves.found : NULL;
    compute_watch_send(c);
    if (guesses)
        mailbox_send(guesses);
    const bool flows = compute_flow_send(c);
    if (forces)
        compute_forces_send(c);
    Mailbox *const sums = forces ? compute_forces_newest(c) : NULL, *const last = sums    ? sums
                                                                                  : flows ? &c->flow.counts
                                                                                          : guesses;
    const void *found = last ? mailbox_wait(last) : NULL;
    c->watch_here = found;
    if (sums) {
        compute_forces_arrive(c, found);
        compute_forces_take(c);
    }
    if (flows)
        compute_flow_take(c, last == &c->flow.counts ? found : mailbox_look(&c->flow.counts), flowed);
    if (guesses)
        take_guesses(c, last == guesses ? found : mailbox_look(guesses));
}

bool compute_finish(void *state, bool forces, size_t *flowed)
{
    Compute *c = state;
    ComputeSolves *solves = &c->solves;
    if (forces || c->flow.calls > 0 || solves->guessed > 0)
        finish(c, forces, flowed);
    const bool good = solves->guessed == 0 || !solves->missed;
    solves->right = solves->missed ? 0 : solves->right + 1;
    solves->needed = good ? solves->needed - (solves->guessed > 0 && solves->needed > 0)
                          : least(2 * solves->needed + COMPUTE_GUESS_AFTER, NEEDED_MOST);
    solves->guessed = 0;
    solves->may_guess = solves->missed = false;
    return good;
}
