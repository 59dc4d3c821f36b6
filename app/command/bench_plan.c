#include "app/command/bench_plan.h"

#include "app/lab/chart.h"
#include "app/session/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const default_scenes[] = {"scenes/dam_break.yaml", "scenes/box_slosh.yaml"};

_Static_assert(TABLE_SWEEPS + 1 <= ARGS_SWEEPS_MAX, "a table's sweeps have room");

/* Narrows the table's sweep of that setting to the single value. */
static bool narrow(Plan *plan, const char *setting, const char *said)
{
    for (int i = 0; i < plan->sweep_count; i++) {
        Sweep *sweep = &plan->sweeps[i];
        const size_t key = strlen(sweep->key);
        if (strncmp(setting, sweep->key, key) == 0 && setting[key] == '=') {
            sweep->count = 1;
            sweep->values[0] = setting + key + 1;
            plan->narrowed[i] = said;
            return true;
        }
    }
    return false;
}

/* Puts the table's own settings first, so that the command line overrides them. */
static bool plan_table(Plan *plan, Error *error)
{
    const Args *args = plan->args;
    int count = 0;
    plan->table = table_find(args->table, error);
    if (!plan->table)
        return false;
    if (args->scene_count || args->sweep_count || args->play)
        return error_set(error,
                         "slosh bench: --table brings its own scenes and sweeps; leave the others out");
    if (args->output && !chart_name(args->output, error))
        return false;
    plan->scene_count = table_scenes(plan->table, &plan->scenes);
    plan->sweep_count = table_sweeps(plan->table, plan->sweeps);
    memset(plan->settings.said, 0, sizeof plan->settings.said);
    for (int i = 0; i < TABLE_SETTINGS && plan->table->settings[i]; i++)
        plan->settings.set[count++] = plan->table->settings[i];
    for (int i = 0; i < args->settings.count; i++) {
        if (count == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; write them into the scene file",
                             SCENE_SETTINGS_MAX);
        if (narrow(plan, args->settings.set[i], args->settings.said[i]))
            continue;
        plan->settings.said[count] = args->settings.said[i];
        plan->settings.set[count++] = args->settings.set[i];
    }
    plan->settings.count = count;
    return true;
}

/* Measures single passes at several counts. */
static bool plan_micro(Plan *plan, Error *error)
{
    static const Sweep counts = {
        .key = "particles", .count = 5, .values = {"10000", "30000", "100000", "1000000", "4000000"}};
    const Args *args = plan->args;
    bool chosen = args->settings.particles > 0;
    if (args->table || args->play || args->device)
        return error_set(error, "slosh bench: --micro stands alone; leave --table, --play and --device out");
    for (int i = 0; i < plan->sweep_count; i++)
        chosen |= strcmp(plan->sweeps[i].key, counts.key) == 0;
    if (chosen)
        return true;
    if (plan->sweep_count == ARGS_SWEEPS_MAX)
        return error_set(error, "slosh bench: too many sweeps beside that of particles; use --particles N");
    plan->sweeps[plan->sweep_count++] = counts;
    return true;
}

bool plan_make(const Args *args, Plan *plan, Error *error)
{
    *plan = (Plan){.args = args,
                   .scenes = args->scenes,
                   .scene_count = (size_t)args->scene_count,
                   .settings = args->settings,
                   .sweep_count = args->sweep_count};
    memcpy(plan->sweeps, args->sweeps, sizeof plan->sweeps);
    if (args->table && !plan_table(plan, error))
        return false;
    if (args->output && !args->table)
        return error_set(error, "slosh bench: -o is the chart of a --table; name one, or leave it out");
    if (plan->scene_count == 0) {
        plan->scenes = default_scenes;
        plan->scene_count = args->micro ? 1 : sizeof default_scenes / sizeof *default_scenes;
    }
    if (args->micro && !plan_micro(plan, error))
        return false;
    for (int i = 0; i < plan->sweep_count; i++)
        if (plan->sweeps[i].count < 1)
            return error_set(error, "the sweep of %s has no values", plan->sweeps[i].key);
    plan->combinations = sweeps_combinations(plan->sweeps, plan->sweep_count);
    return true;
}

/* Names for messages of the swept settings of a case, with the settings themselves. */
typedef char SweptTexts[ARGS_SWEEPS_MAX][SWEEP_SAID];

static bool case_settings(const Plan *plan, size_t combination, SweptTexts texts, SceneSettings *settings,
                          Error *error)
{
    *settings = plan->settings;
    for (int i = plan->sweep_count - 1; i >= 0; i--) {
        const int before = settings->count;
        if (!sweep_set(plan->sweeps[i].key, sweeps_value(plan->sweeps, plan->sweep_count, i, combination),
                       "--sweep", texts[i], settings, error))
            return false;
        if (plan->table && settings->count > before)
            settings->said[before] = plan->narrowed[i];
    }
    return true;
}

size_t plan_cases(const Plan *plan)
{
    return plan->scene_count * plan->combinations;
}

void plan_case_name(const Plan *plan, size_t index, char *name, size_t size)
{
    sweeps_name(plan->sweeps, plan->sweep_count, index % plan->combinations, "=", name, size);
}

bool plan_case_load(const Plan *plan, size_t index, bool tell, Scene *scene, Error *error)
{
    SweptTexts texts;
    Notes notes;
    SceneSettings settings;
    const size_t number = index / plan->combinations;
    if (!case_settings(plan, index % plan->combinations, texts, &settings, error))
        return false;
    if (plan->table && !plan->table->scene && settings.particles == 0)
        settings.particles = table_particles(plan->table, number);
    if (!scene_load(plan->scenes[number], &settings, scene, &notes, error))
        return false;
    if (tell)
        notes_print(&notes, stderr);
    return true;
}
