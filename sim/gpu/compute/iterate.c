/* The loop of an iterating solver, decided on the GPU. Passes of an iteration take their work groups from a
   buffer, and after each iteration a small pass sets the number to 0 once the residual is small enough.
   Between rounds another pass does the same for new lists. A batch has some more iterations, and as many
   rounds, as the last steps needed. A guess takes a single batch for enough, and compute_finish checks the
   guesses of a step together. A wrong guess costs the step, which is taken again with twice as many. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/excess_part.h"
#include "sim/gpu/gl.h"
#include "sim/step/substep.h"

#include <assert.h>
#include <epoxy/gl.h>
#include <math.h>

enum { MORE = 2 }; /* iterations beyond the expected */

/* Of the expected iterations: the part kept from step to step, and the factor for a batch. */
static const double KEPT = 0.8, TIMES = 1.25;

/* Summed columns: the residual, the scale, the way, and a column of the report. */
enum { RESIDUAL_PARTS, SCALE_PARTS = EXCESS_OF_SCALE, WAY_PARTS = EXCESS_OF_WAY, LEFT_PARTS, PARTS };

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
    return sizeof(SolveBlock) + bytes_of_parts(c, 1);
}

bool compute_iterate_fit(Compute *c)
{
    if (!compute_coarse_fit(c))
        return false;
    if (c->parts || !compute_iterates(c->constants))
        return true;
    c->parts = compute_buffer(c, "parts of residuals", bytes_of_parts(c, PARTS));
    c->solve = compute_buffer(c, "solver", sizeof(SolveBlock));
    return c->parts && c->solve &&
           mailbox_create(&c->solves.found, "results of solvers", SOLVES_MAX * bytes_found(c));
}

static WorkGroups groups_of(size_t groups)
{
    return (WorkGroups){.along = (uint)(groups > COMPUTE_ALONG ? COMPUTE_ALONG : groups),
                        .rows = (uint)((groups + COMPUTE_ALONG - 1) / COMPUTE_ALONG),
                        .deep = 1};
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Enough for each pass of new lists: an invocation per particle or boundary particle, or for four cells. */
static size_t renewal_groups(const Compute *c)
{
    const size_t particles = larger(c->count, c->constants->boundary.count), cells = (c->fold.count + 4) / 4;
    return (larger(particles, cells) + COMPUTE_GROUP - 1) / COMPUTE_GROUP;
}

static void begin(Compute *c, const Iteration *iteration)
{
    const WorkGroups cells = groups_of(iteration->coarse ? compute_coarse_shape(c->constants).cells : 0);
    c->solves.asked = 0;
    SolveBlock block = {.pass_groups = groups_of((c->count + COMPUTE_GROUP - 1) / COMPUTE_GROUP),
                        .sum_groups = groups_of(excess_groups(c)),
                        .decision_groups = groups_of(1),
                        .renewal_groups = groups_of(renewal_groups(c)),
                        .renewal_sum_groups = groups_of(excess_groups(c)),
                        .renewal_decision_groups = groups_of(1),
                        .coarse_groups = {.deep = 1},
                        .coarse_cell_groups = {.rows = cells.rows, .deep = 1},
                        .coarse_solve_groups = {.rows = 1, .deep = 1},
                        .coarse_cell_groups_along = cells.along,
                        .coarse = iteration->coarse != NULL,
                        .iterations = iteration->begun ? UINT32_MAX : 0, /* the first measure adds 1 */
                        .tolerance = (float)iteration->tolerance,
                        .worst = (float)iteration->worst,
                        .iterations_few = (uint)iteration->few,
                        .iterations_most = (uint)iteration->most,
                        .scaled = iteration->scale != NULL,
                        .way_most = (float)iteration->way_most,
                        .rounds_most = (uint)iteration->renewals + 1};
    block.pass_groups_along = block.pass_groups.along;
    block.sum_groups_along = block.sum_groups.along;
    block.renewal_groups_along = block.renewal_groups.along;
    block.coarse_groups.rows = block.pass_groups.rows;
    assert(iteration->renewals < SOLVE_ROUNDS);
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

static void decide_by(Compute *c, ComputePass pass)
{
    BIND([PARTS_BUFFER] = c->parts, [SOLVE_BUFFER] = c->solve);
    compute_run(c, pass, COMPUTE_GROUP);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

static void decide(Compute *c, const Iteration *iteration)
{
    sum_up(c, iteration->residual, RESIDUAL_PARTS, iteration->power, iteration->curvature);
    decide_by(c, COMPUTE_DECIDE);
}

static void iterate_once(Compute *c, const Iteration *iteration, const PassInput *input)
{
    if (iteration->coarse && c->solves.asked++ % COARSE_EVERY == COARSE_AFTER)
        compute_correct(c, iteration->coarse, input);
    c->decided = DECIDED_ITERATION;
    for (int k = 0; iteration->passes[k]; k++)
        compute_pass(c, iteration->passes[k], input);
    decide(c, iteration);
    c->decided = DECIDED_NONE;
}

/* New lists and the first decision of a round, if renew.comp has begun a round. */
static void renew(Compute *c, const Substep *step, const Iteration *iteration)
{
    c->decided = DECIDED_RENEWAL;
    iteration->renew(step);
    decide(c, iteration);
    c->decided = DECIDED_NONE;
}

/* Iterations to ask for in a round. */
static int iterations_of(double expected, const Iteration *iteration)
{
    return (int)fmin(TIMES * (expected - 1) + MORE, iteration->most);
}

/* Twice as many iterations and a further round, `wider` times. */
static ComputeBudget widened(ComputeBudget budget, int wider)
{
    enum { OF_FURTHER_ROUND = 4 };
    for (; wider > 0; wider--) {
        int k = 0;
        for (; k < SOLVE_ROUNDS && budget.rounds[k] >= 1; k++)
            budget.rounds[k] *= 2;
        if (k < SOLVE_ROUNDS)
            budget.rounds[k] = OF_FURTHER_ROUND;
    }
    return budget;
}

/* Asks for all expected rounds; `goes_on`: after such a batch. */
static void ask(Compute *c, const Substep *step, const Iteration *iteration, const PassInput *input,
                const ComputeBudget *budget, bool goes_on)
{
    const int rounds = iteration->way ? SOLVE_ROUNDS : 1;
    for (int k = 0; k < rounds && (k == 0 || budget->rounds[k] >= 1); k++) {
        if (iteration->way && (k > 0 || goes_on))
            renew(c, step, iteration);
        for (int left = iterations_of(fmax(budget->rounds[k], 1), iteration); left > 0; left--)
            iterate_once(c, iteration, input);
        if (iteration->way) {
            sum_up(c, iteration->way, WAY_PARTS, NULL, NULL);
            decide_by(c, COMPUTE_RENEW);
        }
    }
}

/* Copies the results of a solver to the solver's place in the mailbox. */
static void put_found(Compute *c, const Iteration *iteration, int which)
{
    const size_t at = (size_t)which * bytes_found(c);
    const unsigned to = c->solves.found.buffer;
    if (iteration->left)
        sum_up(c, iteration->left, LEFT_PARTS, NULL, NULL);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(c->solve, to, 0, (GLintptr)at, sizeof(SolveBlock));
    if (iteration->left)
        glCopyNamedBufferSubData(c->parts, to, (GLintptr)bytes_of_parts(c, LEFT_PARTS),
                                 (GLintptr)(at + sizeof(SolveBlock)), (GLsizeiptr)bytes_of_parts(c, 1));
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

/* Fades the budget, down to the solver's need. Returns the iterations of all rounds. */
static double learn(const SolveBlock *block, ComputeBudget *budget)
{
    double all = 0;
    for (uint k = 0; k < SOLVE_ROUNDS; k++) {
        const double needed = k < block->rounds    ? (double)block->round_iterations[k]
                              : k == block->rounds ? (double)block->iterations
                                                   : -1;
        budget->rounds[k] = fmax(KEPT * budget->rounds[k], needed + 1);
        all += fmax(needed, 0);
    }
    return all;
}

/* Reads the results of a solver; false if the batch was too small. A GPU may have done nothing. */
static bool take_found(Compute *c, const Iteration *iteration, int which, const void *all,
                       IterationFound *found)
{
    *found = (IterationFound){0};
    if (!all)
        return true;
    const char *at = (const char *)all + (size_t)which * bytes_found(c);
    const SolveBlock *block = (const void *)at;
    if (!block->ended || (iteration->way && block->renewal_groups.along > 0))
        return false;
    found->iterations = learn(block, &c->solves.budgets[which]);
    found->mean = (double)block->left_mean;
    found->most = (double)block->left_most;
    if (iteration->left)
        found->left = excess_of(c, (const void *)(at + sizeof *block), block->particles);
    return true;
}

/* Batches double until the solver has ended: the largest has all iterations in a round. The first batch
   follows the last step, since a further batch costs a wait and no step. */
static void iterate_and_wait(Compute *c, const Substep *step, const Iteration *iteration, int which,
                             const PassInput *input, IterationFound *found)
{
    enum { BATCHES_MOST = 64 };
    ComputeBudget budget = c->solves.budgets[which];
    bool ended = false;
    budget.rounds[0] = fmin(budget.rounds[0], 1 + step->solves[which].iterations);
    for (int batch = 0; !ended && batch < BATCHES_MOST; batch++) {
        ask(c, step, iteration, input, &budget, batch > 0);
        put_found(c, iteration, which);
        mailbox_send(&c->solves.found);
        ended = take_found(c, iteration, which, mailbox_wait(&c->solves.found), found);
        budget = widened(budget, 1);
    }
}

bool compute_iterate(const Substep *step, const Iteration *iteration, int which, const PassInput *input,
                     IterationFound *found)
{
    Compute *c = step->state;
    ComputeSolves *solves = &c->solves;
    begin(c, iteration);
    if (iteration->scale)
        sum_up(c, iteration->scale, SCALE_PARTS, NULL, NULL);
    if (iteration->begun)
        decide(c, iteration);
    if (!solves->may_guess || solves->budgets[which].rounds[0] < 1) {
        iterate_and_wait(c, step, iteration, which, input, found);
        return true;
    }
    const ComputeBudget budget = widened(solves->budgets[which], solves->wider);
    ask(c, step, iteration, input, &budget, false);
    put_found(c, iteration, which);
    solves->guess[solves->guessed].of = *iteration;
    solves->guess[solves->guessed].which = which;
    solves->guess[solves->guessed++].to = &step->solves[which];
    return false;
}

void compute_guess(void *state)
{
    Compute *c = state;
    c->solves.may_guess = true;
}

/* Writes the reports of right guesses; false if a guess was wrong. */
static bool take_guesses(Compute *c, const void *all)
{
    const ComputeSolves *solves = &c->solves;
    bool right = true;
    for (int k = 0; k < solves->guessed && right; k++) {
        const Iteration *iteration = &solves->guess[k].of;
        IterationFound found;
        right = take_found(c, iteration, solves->guess[k].which, all, &found);
        if (right)
            iteration_report(iteration, &found, solves->guess[k].to);
    }
    return right;
}

/* Sends all copies, then waits for the last copy. Returns false if a guess was wrong. */
static bool finish(Compute *c, bool forces, size_t *flowed)
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
    return !guesses || take_guesses(c, last == guesses ? found : mailbox_look(guesses));
}

bool compute_finish(void *state, bool forces, size_t *flowed)
{
    Compute *c = state;
    ComputeSolves *solves = &c->solves;
    const bool good = !(forces || c->flow.calls > 0 || solves->guessed > 0) || finish(c, forces, flowed);
    solves->right += good && solves->guessed > 0;
    solves->wrong += !good;
    solves->wider = good ? 0 : solves->wider + 1;
    solves->guessed = 0;
    solves->may_guess = false;
    return good;
}
