#include "app/run/measure/measure.h"

#include "app/base/file.h"
#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* X(ENUM, word, help) */
static const char *const kind_words[OUTCOME_COUNT] = {
#define X(NAME, word, help) word,
    OUTCOMES(X)
#undef X
};

const char *outcome_word(OutcomeKind kind)
{
    return kind_words[kind];
}

static const char *outcome_help(OutcomeKind kind)
{
    static const char *const helps[OUTCOME_COUNT] = {
#define X(NAME, word, help) help,
        OUTCOMES(X)
#undef X
    };
    return helps[kind];
}

OutcomeKind outcome_of_word(const char *word)
{
    int kind = 0;
    while (kind < OUTCOME_COUNT && strcmp(kind_words[kind], word) != 0)
        kind++;
    return (OutcomeKind)kind;
}

/* Replaces line ends, as a table row has one line. */
static void put_on_one_line(char text[OUTCOME_WORDS])
{
    for (char *at = text; *at; at++)
        *at = *at == '\n' ? ' ' : *at;
}

static const OutcomeKind of_trouble[STEP_TROUBLE_COUNT] = {
    [STEP_TROUBLE_NONE] = OUTCOME_NONE,      [STEP_TROUBLE_SPEED] = OUTCOME_BLOWN_UP,
    [STEP_TROUBLE_SOLID] = OUTCOME_BLOWN_UP, [STEP_TROUBLE_DENSITY] = OUTCOME_BLOWN_UP,
    [STEP_TROUBLE_ENERGY] = OUTCOME_NOISY,   [STEP_TROUBLE_SOLVE] = OUTCOME_DIVERGES,
    [STEP_TROUBLE_MEMORY] = OUTCOME_NONE,    [STEP_TROUBLE_LOST] = OUTCOME_LEAKS};

/* Sets a worse kind; an equally bad kind at a later time is ignored. */
static void find(Outcome *outcome, OutcomeKind kind, double time)
{
    if (kind > outcome->kind) {
        outcome->kind = kind;
        outcome->time = time;
        outcome->words[0] = '\0';
    }
}

static void judge_energy(const OutcomeHistory *history, Outcome *outcome)
{
    double least = INFINITY;
    for (int i = 0; i < history->count && outcome->kind < OUTCOME_NOISY; i++) {
        const OutcomeSample *look = &history->look[i];
        const double gain = (look->energy - least) / look->scale; /* false for NaN */
        if (gain > OUTCOME_GAIN) {
            find(outcome, OUTCOME_NOISY, look->time);
            snprintf(outcome->words, OUTCOME_WORDS, "%s: %.3g %%", outcome_help(OUTCOME_NOISY), 100 * gain);
        }
        least = fmin(least, look->energy);
    }
}

static void judge_motion(const OutcomeSample *look, Outcome *outcome)
{
    if (look->sound > 0 && look->fastest > look->sound && outcome->kind < OUTCOME_FAST) {
        find(outcome, OUTCOME_FAST, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "a particle moves at %.4g m/s, and sound at %g m/s",
                 look->fastest, look->sound);
    }
    if (look->jump > 1 && look->together < OUTCOME_TOGETHER && outcome->kind < OUTCOME_BOILS) {
        find(outcome, OUTCOME_BOILS, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "%s: %.3g %% of their energy of motion",
                 outcome_help(OUTCOME_BOILS), 100 * (1 - look->together));
    }
}

static double part(size_t some, const OutcomeSample *look)
{
    return look->count > 0 ? (double)some / (double)look->count : 0;
}

static void judge_volume(const OutcomeSample *look, Outcome *outcome)
{
    if (!(look->pressed > OUTCOME_PRESSED) || outcome->kind >= OUTCOME_SQUEEZED)
        return;
    find(outcome, OUTCOME_SQUEEZED, look->time);
    snprintf(outcome->words, OUTCOME_WORDS, "%s: it is pressed by %.3g %% in the mean",
             outcome_help(OUTCOME_SQUEEZED), 100 * look->pressed);
}

/* Close particles at the start, such as emitted fluid or a jittered lattice, are no clumps. */
static void judge_places(const OutcomeHistory *history, int i, Outcome *outcome)
{
    const OutcomeSample *look = &history->look[i], *first = &history->look[0];
    const double close = part(look->close, look), out = part(look->beyond + look->lost, look);
    if (close - part(first->close, first) > OUTCOME_CLOSE && outcome->kind < OUTCOME_CLUMPS) {
        find(outcome, OUTCOME_CLUMPS, look->time);
        snprintf(outcome->words, OUTCOME_WORDS,
                 "%.3g %% of the particles are nearer than %g spacings to another", 100 * close,
                 OUTCOME_NEAR);
    }
    if (out > OUTCOME_OUT && outcome->kind < OUTCOME_LEAKS) {
        find(outcome, OUTCOME_LEAKS, look->time);
        if (look->beyond >= look->lost)
            snprintf(outcome->words, OUTCOME_WORDS, "%zu of %zu particles are beyond a wall", look->beyond,
                     look->count);
        else
            snprintf(outcome->words, OUTCOME_WORDS, "%zu of %zu particles have no place in the grid",
                     look->lost, look->count);
    }
    if (look->stuck && outcome->kind < OUTCOME_DIVERGES) {
        find(outcome, OUTCOME_DIVERGES, look->time);
        snprintf(outcome->words, OUTCOME_WORDS, "%s", step_trouble_words(STEP_TROUBLE_SOLVE));
    }
}

/* The trouble that ended a run decides its kind, whatever was found before. */
static void judge_end(const WorldTrouble *trouble, Outcome *outcome)
{
    char found[160];
    *outcome = (Outcome){.kind = of_trouble[trouble->what], .time = trouble->time};
    world_trouble_words(trouble, found);
    snprintf(outcome->words, OUTCOME_WORDS, "%s", found);
}

void outcome_judge(const OutcomeHistory *history, Outcome *outcome)
{
    *outcome = (Outcome){.kind = OUTCOME_HOLDS, .time = (double)NAN};
    if (history->trouble.ended) {
        judge_end(&history->trouble, outcome);
    } else {
        judge_energy(history, outcome);
        for (int i = 0; i < history->count; i++) {
            judge_motion(&history->look[i], outcome);
            judge_volume(&history->look[i], outcome);
            judge_places(history, i, outcome);
        }
    }
    put_on_one_line(outcome->words);
}

void outcome_not_run(const char *why, Outcome *outcome)
{
    *outcome = (Outcome){.kind = OUTCOME_NONE, .time = (double)NAN};
    snprintf(outcome->words, OUTCOME_WORDS, "%.*s", OUTCOME_WORDS - 1, why);
    put_on_one_line(outcome->words);
}

const char *outcome_text(const Outcome *outcome, char text[OUTCOME_TEXT])
{
    char time[32] = "";
    if (isfinite(outcome->time))
        snprintf(time, sizeof time, " at t = %.4g s", outcome->time);
    snprintf(text, OUTCOME_TEXT, "%s%s%s%s", outcome_word(outcome->kind), time, *outcome->words ? ": " : "",
             outcome->words);
    return text;
}

void outcome_json(json_t *object, const Outcome *outcome)
{
    if (!object)
        return;
    json_object_set_new(object, "outcome", json_string(outcome_word(outcome->kind)));
    if (outcome->kind == OUTCOME_HOLDS)
        return;
    json_object_set_new(object, "outcome_time", number_json(outcome->time));
    json_object_set_new(object, "outcome_words", json_string(outcome->words));
}

/* True if only gravity does work on the fluid, so that the energy is known and never grows: as in
   sim/step/world.h, for a box at rest. */
static bool is_left_alone(const WorldDef *def)
{
    bool alone = def->motion_count == 0 && def->drain_count == 0 &&
                 (method_find(def->method)->energy || method_find(def->method)->incompressible);
    for (int k = 0; k < 3; k++)
        alone &= def->lid[k] == 0 && !(def->periodic[k] && def->gravity[k] != 0);
    for (int i = 0; i < def->solid_count; i++)
        alone &= !solid_moves(&def->solids[i]);
    for (int f = 0; f < def->fluid_count; f++)
        alone &= def->fluids[f].emit_count == 0;
    return alone;
}

/* Reference for growth of energy: kinetic and compression energy, and potential energy down to the lowest
   corner. Adds the energy of 0.01 of compression, for fluid at rest. */
static double scale_of(const WorldDef *def, double mass, const WorldGauge *gauge)
{
    static const double COMPRESSED = 0.01;
    const double *size = def->box_size, *g = def->gravity, c = COMPRESSED * def->sound_speed;
    const double lowest = fmin(0, -g[1] * size[1]) - 0.5 * (fabs(g[0]) * size[0] + fabs(g[2]) * size[2]);
    return gauge->kinetic_energy + gauge->compression_energy + gauge->potential_energy - mass * lowest +
           0.5 * mass * c * c;
}

static void look_at_energy(OutcomeSample *look, const WorldDef *def, double mass, World *world)
{
    WorldGauge gauge;
    bool known = false;
    world_gauge_request(world);
    for (int tries = 0; !known && tries < 1000; tries++) /* a GPU answers after a delay */
        known = world_gauge(world, &gauge);
    if (!known || !gauge.total_known)
        return;
    look->energy = gauge.kinetic_energy + gauge.potential_energy + gauge.compression_energy;
    look->scale = scale_of(def, mass, &gauge);
}

static bool is_beyond(const WorldDef *def, const WorldInfo *info, const SolidPose pose[], const float x[3])
{
    const double most = OUTCOME_BEYOND * def->spacing, *size = info->box_size;
    bool beyond = !(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]));
    for (int k = 0; k < def->dimensions; k++) {
        const double low = k == 1 ? 0 : -0.5 * size[k];
        beyond |= !def->periodic[k] && ((double)x[k] < low - most || (double)x[k] > low + size[k] + most);
    }
    for (int i = 0; i < def->solid_count && !beyond; i++)
        beyond = (double)solid_clearance(&def->solids[i], &pose[i], def->dimensions, x, 0) < -most;
    return beyond;
}

/* Sums over particles: on MPI ranks of the own share first, then of all. */
typedef struct PlaceSums {
    double close, beyond;   /* particles, as of OutcomeSample */
    double pressed;         /* compression above rest density, fractions */
    double mass;            /* kg; in 2D for a depth of 1 m */
    double speed2;          /* m2/s2 */
    double common, kinetic; /* as of metric_common_motion */
    double failed;          /* ranks without memory */
} PlaceSums;

static void sum_over_ranks(OutcomeSum *sum, PlaceSums *places)
{
    if (sum)
        sum((double *)places, sizeof *places / sizeof(double));
}

/* Mean speed of the particles, over the speed for a jump of OUTCOME_JUMP spacings under gravity, or over
   OUTCOME_OF_SOUND. */
static double jump_of(const WorldDef *def, double speed2, size_t count)
{
    const double *g = def->gravity, weight = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const bool sounds = !method_find(def->method)->incompressible;
    const double enough = weight > 0 ? sqrt(2 * weight * OUTCOME_JUMP * def->spacing)
                          : sounds   ? OUTCOME_OF_SOUND * def->sound_speed
                                     : INFINITY;
    return count > 0 ? sqrt(speed2 / (double)count) / enough : 0;
}

/* True if the box moves: thrown fluid moves in all directions, too. */
static bool is_thrown(const BoxState *box)
{
    double speed = 0;
    for (int k = 0; k < 3; k++)
        speed += fabs(box->velocity[k]) + fabs(box->angular_velocity[k]);
    return speed > 0;
}

static void add_places(PlaceSums *sums, const WorldDef *def, const WorldInfo *info, const Cloud *cloud)
{
    SolidPose pose[SOLIDS_MAX];
    for (int i = 0; i < def->solid_count; i++) {
        BoxState at;
        solid_pose_in(&def->solids[i], info->time, &info->floating[i], &at);
        solid_pose_of(&at, &pose[i]);
    }
    for (size_t i = 0; i < cloud->count; i++) {
        const double density = def->fluids[cloud->fluid[i]].density;
        sums->beyond += is_beyond(def, info, pose, cloud->position + 4 * i);
        sums->pressed += fmax((double)cloud->density[i] / density - 1, 0);
        sums->mass += density * pow(def->spacing, def->dimensions);
        for (size_t k = 4 * i; k < 4 * i + 3; k++)
            sums->speed2 += (double)cloud->velocity[k] * (double)cloud->velocity[k];
    }
}

/* Checks every `stride`-th particle for clumps, scaled to all; leaks and compression of all particles.
   `mass`: kg; in 2D for a depth of 1 m. */
static bool look_at_places(OutcomeSample *look, const WorldDef *def, const WorldInfo *info, size_t stride,
                           OutcomeSum *sum, double *mass, World *world)
{
    Cloud cloud = {0};
    PlaceSums places = {0}, motion = {0};
    size_t close = 0;
    if (cloud_read(&cloud, world) && metric_close(&cloud, OUTCOME_NEAR * def->spacing, stride, &close))
        add_places(&places, def, info, &cloud);
    else
        places.failed = 1;
    places.close = (double)close;
    sum_over_ranks(sum, &places);
    close = (size_t)places.close;
    look->close = close * stride < look->count ? close * stride : look->count;
    look->beyond = (size_t)places.beyond;
    look->pressed = look->count > 0 ? places.pressed / (double)look->count : 0;
    look->jump = is_thrown(&info->box) ? 0 : jump_of(def, places.speed2, look->count);
    *mass = places.mass;
    if (places.failed == 0 && look->jump > 1) { /* at lower speeds no boiling is possible */
        motion.failed = !metric_common_motion(&cloud, def->spacing * def->support, 4 * stride, &motion.common,
                                              &motion.kinetic);
        sum_over_ranks(sum, &motion);
        look->together = motion.kinetic > 0 ? motion.common / motion.kinetic : 1;
    }
    cloud_free(&cloud);
    return places.failed == 0 && motion.failed == 0;
}

/* Returns the facts known without reading particles: their number and speeds. */
static OutcomeSample outcome_of_info(const WorldDef *def, const WorldInfo *info)
{
    return (OutcomeSample){.time = info->time,
                           .count = info->count,
                           .together = 1,
                           .fastest = info->fastest,
                           .sound = method_find(def->method)->incompressible ? 0 : def->sound_speed,
                           .energy = (double)NAN,
                           .scale = (double)NAN};
}

static OutcomeSample look_from(const WorldDef *def, const WorldInfo *info)
{
    OutcomeSample look = outcome_of_info(def, info);
    look.lost = info->lost;
    for (int k = 0; k < SOLVES_MAX; k++)
        look.stuck |= info->solves[k].failed;
    return look;
}

static bool look_with(OutcomeSample *look, const WorldDef *def, bool moved, size_t most, OutcomeSum *sum,
                      World *world)
{
    WorldInfo info;
    double mass;
    world_info(world, &info);
    *look = look_from(def, &info);
    if (!look_at_places(look, def, &info, 1 + info.count / most, sum, &mass, world))
        return false;
    if (!moved && is_left_alone(def))
        look_at_energy(look, def, mass, world);
    return true;
}

bool outcome_sample(OutcomeHistory *history, const WorldDef *def, bool moved, World *world)
{
    OutcomeSample look;
    if (!look_with(&look, def, moved, SIZE_MAX, NULL, world))
        return false;
    history->count += history->count < OUTCOME_SAMPLES_MAX;
    history->look[history->count - 1] = look;
    return true;
}

void outcome_end(OutcomeHistory *history, const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    history->trouble = info.trouble;
}

/* Particles form pairs with the cubic kernel, and hardly with other selectable kernels. */
static const char *advice_on_clumps(const WorldDef *def)
{
    const char *kernel = method_kernels(def).slope->name;
    const bool chosen = method_find(def->method)->carries_density && shape_kernel_find(kernel);
    if (!chosen)
        return "; use a particles.support of 2.5 or less, or shorter steps";
    return strcmp(kernel, "cubic") == 0
               ? "; use solver.kernel wendland_c2 with a particles.support of 3 or more, or a support of 2.5 or less"
               : "; use a larger particles.support, or solver.shifting 0.2";
}

static const char *advice(OutcomeKind kind, const WorldDef *def)
{
    const bool solves = method_find(def->method)->incompressible;
    switch (kind) {
    case OUTCOME_BOILS:
        return "; use a greater viscosity, or shorter steps";
    case OUTCOME_NOISY:
        return "; use shorter steps";
    case OUTCOME_FAST:
        return "; use a higher solver.sound_speed";
    case OUTCOME_SQUEEZED:
        return solves ? "; use more solver.iterations or shorter steps" : "; use a higher solver.sound_speed";
    case OUTCOME_CLUMPS:
        return advice_on_clumps(def);
    case OUTCOME_LEAKS:
        return "; use shorter steps, or solids that are thicker than twice the spacing";
    case OUTCOME_DIVERGES:
        return "; use shorter steps, or more of the solver's iterations (solver.iterations, "
               "solver.viscosity_iterations)";
    default:
        return "";
    }
}

/* Close particles at the start, such as emitted fluid or a jittered lattice, are no clumps; nothing else
   counts as normal. */
static void begin(FluidWatch *watch, const OutcomeSample *first)
{
    watch->looked = true;
    watch->start = (OutcomeSample){.time = first->time,
                                   .count = first->count,
                                   .close = watch->resumed ? 0 : first->close,
                                   .energy = (double)NAN,
                                   .scale = (double)NAN};
}

static void judge(const FluidWatch *watch, const OutcomeSample *now, Outcome *outcome)
{
    const OutcomeHistory history = {.count = 2, .look = {watch->start, *now}};
    outcome_judge(&history, outcome);
}

/* Removes reported failures from a look, so that they do not hide other kinds. */
static OutcomeSample untold(const FluidWatch *watch, OutcomeSample look)
{
    if (watch->reported >> OUTCOME_NOISY & 1)
        look.energy = (double)NAN;
    if (watch->reported >> OUTCOME_BOILS & 1)
        look.jump = 0;
    if (watch->reported >> OUTCOME_FAST & 1)
        look.fastest = 0;
    if (watch->reported >> OUTCOME_SQUEEZED & 1)
        look.pressed = 0;
    if (watch->reported >> OUTCOME_CLUMPS & 1)
        look.close = 0;
    if (watch->reported >> OUTCOME_LEAKS & 1)
        look.beyond = look.lost = 0;
    if (watch->reported >> OUTCOME_DIVERGES & 1)
        look.stuck = false;
    return look;
}

/* Number of particles checked for clumps by a watch; leaks are checked for all. A look takes about a third of
   a step's time. */
static const size_t LOOKED_AT = 2000;

bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS])
{
    WorldInfo info;
    OutcomeSample look;
    Outcome now;
    world_info(world, &info);
    const OutcomeSample known = outcome_of_info(def, &info);
    const bool fast =
        known.sound > 0 && known.fastest > known.sound && !(watch->reported >> OUTCOME_FAST & 1);
    if (info.within_frame || (info.step < watch->next && !fast))
        return false;
    watch->next = info.step + (info.step < FLUID_WATCH_STEPS   ? FLUID_WATCH_STEPS
                               : info.step < FLUID_WATCH_LATER ? info.step
                                                               : FLUID_WATCH_LATER);
    if (world_on_gpu(def)) /* without waiting for the GPU */
        look = known;
    else if (!look_with(&look, def, !watch->closed, LOOKED_AT, watch->sum, world))
        return false; /* memory is short: retry at the next look */
    else if (!watch->looked)
        begin(watch, &look);
    judge(watch, &look, &now);
    if (now.kind > watch->worst.kind)
        watch->worst = now;
    watch->start.energy = fmin(watch->start.energy, look.energy); /* fmin skips NaN */
    look = untold(watch, look);
    judge(watch, &look, &now);
    if (now.kind <= OUTCOME_HOLDS)
        return false;
    watch->reported |= 1u << now.kind;
    snprintf(words, FLUID_WATCH_WORDS, "t = %.4g s: %s: %s%s", now.time, outcome_word(now.kind), now.words,
             advice(now.kind, def));
    return true;
}

bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome)
{
    const OutcomeHistory end = {.trouble = *trouble};
    if (trouble->ended)
        outcome_judge(&end, outcome);
    else
        *outcome = watch->worst;
    return trouble->ended || watch->looked || watch->worst.kind > OUTCOME_HOLDS;
}
