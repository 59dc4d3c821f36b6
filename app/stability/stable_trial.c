#include "app/stability/stable_trial.h"

#include "app/base/program.h"
#include "app/run/measure/outcome.h"

typedef struct Trial {
    const Scene *scene;
    World *world;
    WorldInfo info;
    OutcomeHistory history;
    double next; /* time of the next look, s */
    bool whole;
} Trial;

/* Looks at a sound state, if a look is due or `now`. Returns false if memory is short. */
static bool look(Trial *trial, double until, bool now, Error *error)
{
    if ((!now && trial->info.time < trial->next) || !world_sound(trial->world))
        return true;
    trial->next = trial->info.time + 0.999 * until / STABLE_LOOKS;
    return outcome_sample(&trial->history, &trial->scene->world, false, trial->world) ||
           error_set(error, "no memory to read the particles; use a larger spacing");
}

/* True at the sentinel's first trouble; the sentinel's reaction does not matter. */
static bool in_trouble(Trial *trial)
{
    const bool found = trial->info.trouble.count > 0 || trial->info.trouble.ended;
    outcome_end(&trial->history, trial->world);
    trial->history.trouble.ended = found;
    return found;
}

/* True if a look has found trouble that ends the trial. */
static bool seen_enough(const Trial *trial)
{
    Outcome outcome;
    outcome_judge(&trial->history, &outcome);
    return !trial->whole && outcome.kind > OUTCOME_HOLDS;
}

static bool run(Trial *trial, double until, Error *error)
{
    Error failure = {{0}};
    bool stepped = true, ok = look(trial, until, true, error);
    while (ok && stepped && !in_trouble(trial) && !seen_enough(trial) && trial->info.time < until - 1e-9) {
        stepped = world_step(trial->world, NULL, &failure);
        world_info(trial->world, &trial->info);
        ok = !stepped || trial->info.trouble.count > 0 ||
             look(trial, until, trial->info.time >= until - 1e-9, error);
        if (ok && interrupted())
            ok = error_set(error, "stopped");
    }
    if (ok && !stepped && !in_trouble(trial))
        ok = error_set(error, "%s", failure.message);
    return ok;
}

bool stable_trial(const Scene *scene, double until, bool whole, StableRow *row, Error *error)
{
    Trial trial = {.scene = scene, .whole = whole, .world = world_create(&scene->world, error)};
    if (!trial.world)
        return false;
    world_info(trial.world, &trial.info);
    bool ok = run(&trial, until, error);
    row->steps = trial.info.step;
    outcome_judge(&trial.history, &row->outcome);
    row->finder = row->outcome.kind == OUTCOME_HOLDS ? FOUND_BY_NOBODY
                  : trial.history.trouble.ended      ? FOUND_BY_SENTINEL
                  : whole                            ? FOUND_BY_LOOKS
                                                     : FOUND_BY_LOOK;
    world_destroy(trial.world);
    if (ok && row->outcome.kind == OUTCOME_NONE) /* memory was short */
        ok = error_set(error, "%s", row->outcome.words);
    return ok;
}
