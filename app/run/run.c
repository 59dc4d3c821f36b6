#include "app/run/run.h"
#include "app/base/program.h"
#include "app/files/snapshot_hdf5.h"
#include "sim/flow/flow.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what is said of a state ---- */

static const char *lost_text(const WorldInfo *info, char words[256])
{
    snprintf(words, 256,
             "t = %.4g s: %zu of %zu particles %s no place in the grid, and no neighbour sees %s; "
             "solver.grid_layers 0 has room for a fluid at rest",
             info->time, info->lost, info->count, info->lost == 1 ? "finds" : "find",
             info->lost == 1 ? "it" : "them");
    return words;
}

static const char *full_text(const WorldInfo *info, char words[256])
{
    snprintf(
        words, 256,
        "t = %.4g s: there %s %zu particle%s, as many as particles.most allows: no more come until some drain",
        info->time, info->count == 1 ? "is" : "are", info->count, plural(info->count));
    return words;
}

static const char *blocked_text(const WorldInfo *info, uint64_t *reported, char words[256])
{
    char names[160] = "", name[GATE_NAME_SIZE];
    for (int k = 0; k < EMITTERS_MAX; k++)
        if (info->blocked & ~*reported & 1ULL << k) {
            gate_name(k, name);
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "", name);
        }
    snprintf(
        words, 256,
        "t = %.4g s: %s: no particle of the last %d layers found room; something stands in the way, or the "
        "place is full",
        info->time, names, BLOCKED_LAYERS);
    *reported |= info->blocked;
    return words;
}

static bool trouble_is_new(RunReports *reported, const WorldTrouble *trouble)
{
    unsigned *halvings = &reported->halvings[trouble->what];
    const unsigned bit = 1u << trouble->tries;
    const bool is_new = trouble->count != reported->count && !(*halvings & bit);
    if (trouble->count != reported->count)
        *halvings |= bit;
    reported->count = trouble->count;
    return is_new;
}

static const char *trouble_text(const WorldTrouble *trouble, char words[256])
{
    char what[160];
    world_trouble_words(trouble, what);
    snprintf(words, 256, "t = %.4g s: %s; back to %.4g s with 1/%d of the step (%d of %d)", trouble->time,
             what, trouble->back_to, 1 << trouble->tries, trouble->tries, trouble->retries);
    return words;
}

static const char *unlisted_text(const WorldInfo *info, char words[256])
{
    snprintf(words, 256,
             "lists of neighbours would take %.3g GB, more than the driver or its memory allows: each pass "
             "searches anew, and steps take up to twice as long; fewer particles or a smaller "
             "particles.support need less",
             1e-9 * (double)info->unlisted);
    return words;
}

/* The sentinel's trouble comes last: the window shows the last message. */
static void tell_news(Run *run, RunTell *tell, void *user)
{
    char words[256];
    RunReports *reported = &run->reported;
    const WorldInfo *info = &run->info;
    if (info->full && !reported->full)
        tell(user, full_text(info, words));
    reported->full |= info->full;
    if (info->blocked & ~reported->blocked)
        tell(user, blocked_text(info, &reported->blocked, words));
    if (info->lost && !reported->lost)
        tell(user, lost_text(info, words));
    reported->lost |= info->lost > 0;
    if (info->unlisted && !reported->unlisted)
        tell(user, unlisted_text(info, words));
    reported->unlisted |= info->unlisted > 0;
    if (trouble_is_new(reported, &info->trouble))
        tell(user, trouble_text(&info->trouble, words));
}

/* ---- steps ---- */

bool run_begin(Run *run, const WorldDef *def, Error *error)
{
    const FluidWatch *before = &run->watch;
    run->reported = (RunReports){0};
    run->watch = (FluidWatch){.closed = before->closed, .resumed = before->resumed, .sum = before->sum};
    world_destroy(run->world);
    run->world = world_create(def, error);
    if (run->world)
        world_info(run->world, &run->info);
    return run->world != NULL;
}

void run_look(Run *run, RunTell *tell, void *user)
{
    char words[FLUID_WATCH_WORDS];
    if (fluid_watch(&run->watch, &run->scene.world, run->world, words))
        tell(user, words);
}

bool run_substep(Run *run, StageClock *clock, RunTell *tell, void *user, Error *error)
{
    const bool stepped = world_substep(run->world, clock, error);
    world_info(run->world, &run->info);
    tell_news(run, tell, user);
    if (stepped)
        run_look(run, tell, user);
    return stepped;
}

bool run_substep_again(Run *run, Error *error)
{
    const bool stepped = world_substep(run->world, NULL, error);
    world_info(run->world, &run->info);
    return stepped;
}

bool run_apply(Run *run, const SimCommand *command, Error *error)
{
    const bool applied = sim_command_apply(command, &run->world, &run->scene, error);
    world_info(run->world, &run->info);
    return applied;
}

/* ---- probes ---- */

bool run_open_probes(Run *run)
{
    RunProbes *own = &run->probes;
    run_close_probes(run);
    own->wants_forces = probe_list_has_forces(&run->scene.probes);
    own->probes = probes_create(&run->scene.probes, &run->scene.world);
    if (own->probes)
        own->value = malloc(((size_t)probes_columns(own->probes) + 1) * sizeof *own->value);
    if (own->value)
        return true;
    run_close_probes(run);
    return false;
}

bool run_read_probes(Run *run, Forces *mean)
{
    RunProbes *own = &run->probes;
    const Cloud *cloud = &own->cloud;
    *mean = (Forces){0};
    if (run->ranks)
        cloud = run->ranks->gather(run->ranks->user, own->probes, run->world);
    else if (!cloud_read(&own->cloud, run->world))
        return false;
    if (own->wants_forces)
        world_forces(run->world, mean);
    if (cloud)
        probes_read(own->probes, cloud, mean, own->value);
    return true;
}

void run_close_probes(Run *run)
{
    probes_destroy(run->probes.probes);
    cloud_free(&run->probes.cloud);
    free(run->probes.value);
    run->probes = (RunProbes){.probes = NULL};
}

/* ---- ranks ---- */

bool run_is_first(const Run *run)
{
    return !run->ranks || run->ranks->file->first;
}

bool run_agree(const Run *run, bool ok, Error *error)
{
    return run->ranks ? run->ranks->file->agree(ok, error) : ok;
}
