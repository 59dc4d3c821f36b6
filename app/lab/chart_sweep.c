#include "app/lab/chart_sweep.h"

#include "app/scene/scene.h"

#include <stdlib.h>
#include <string.h>

static const char SPACING[] = "particles.spacing";

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

int sweep_names(const Args *args, const char *key, const char *names[SWEEP_NAMES_MAX])
{
    int count = 0;
    const char *one = chart_set_value(&args->settings, key);
    for (int s = 0; s < args->sweep_count; s++)
        for (int v = 0; strcmp(args->sweeps[s].key, key) == 0 && v < args->sweeps[s].count; v++)
            if (count < SWEEP_NAMES_MAX)
                names[count++] = args->sweeps[s].values[v];
    if (count == 0 && one)
        names[count++] = one;
    return count;
}

/* True if the plan sweeps the key as methods, backends or spacings. */
static bool has_own_place(const char *key)
{
    return strcmp(key, "solver.method") == 0 || strcmp(key, "solver.backend") == 0 ||
           strcmp(key, SPACING) == 0;
}

static bool can_take(const Sweep *sweep, Error *error)
{
    if (strcmp(sweep->key, "particles") == 0)
        return error_set(error, "slosh chart: --sweep particles has no place here; use --sweep %s=A,B,...",
                         SPACING);
    if (begins(sweep->key, "view.") || begins(sweep->key, "hand.") || strcmp(sweep->key, "title") == 0 ||
        strcmp(sweep->key, "metrics") == 0)
        return error_set(error, "slosh chart: --sweep %.60s changes no run; sweep what a simulation reads",
                         sweep->key);
    return true;
}

bool chart_sweeps_take(const Args *args, ChartSweeps *sweeps, Error *error)
{
    *sweeps = (ChartSweeps){.count = 0};
    for (int s = 0; s < args->sweep_count; s++) {
        const Sweep *sweep = &args->sweeps[s];
        if (!can_take(sweep, error))
            return false;
        if (has_own_place(sweep->key))
            continue;
        const int k = sweeps->count++;
        sweeps->key[k] = sweep->key;
        sweeps->values[k] = sweep->count;
        for (int v = 0; v < sweep->count; v++)
            if (snprintf(sweeps->text[k][v], SWEPT_TEXT, "--sweep %s=%s", sweep->key, sweep->values[v]) >=
                SWEPT_TEXT)
                return error_set(error, "slosh chart: a value of --sweep %.60s is too long", sweep->key);
    }
    return true;
}

int chart_sweeps_combinations(const ChartSweeps *sweeps)
{
    int all = 1;
    for (int k = 0; k < sweeps->count && all <= CHART_ROWS_MAX; k++)
        all *= sweeps->values[k];
    return all;
}

bool chart_sweeps_effect(ChartSweeps *sweeps, int key, const Scene *scene, char why[NOTE_SIZE])
{
    static Notes notes;
    notes.count = 0;
    scene_advise_key(scene, sweeps->key[key], &notes);
    snprintf(why, NOTE_SIZE, "%s", notes.count > 0 ? notes.line[0] : "");
    sweeps->effective[key] |= notes.count == 0;
    return notes.count == 0;
}

bool chart_sweeps_set(const ChartSweeps *sweeps, const bool effect[CHART_SWEEPS], int combination,
                      ChartJob *job)
{
    int value[CHART_SWEEPS];
    bool anew = true;
    job->set_count = 0;
    for (int k = sweeps->count - 1; k >= 0; k--) {
        value[k] = combination % sweeps->values[k];
        combination /= sweeps->values[k];
        anew &= effect[k] || value[k] == 0;
    }
    for (int k = 0; k < sweeps->count; k++)
        if (effect[k])
            job->set[job->set_count++] = sweeps->text[k][value[k]];
    return anew;
}

bool chart_sweeps_check(const ChartSweeps *sweeps, Error *error)
{
    for (int k = 0; k < sweeps->count; k++)
        if (!sweeps->effective[k])
            return error_set(error,
                             "slosh chart: --sweep %.60s changes nothing: no method of the chart reads it",
                             sweeps->key[k]);
    return true;
}

static int descending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

int chart_sweeps_spacings(const Args *args, double spacing, double coarsenings[CHART_SPACINGS], Error *error)
{
    int count = 0;
    for (int s = 0; s < args->sweep_count; s++)
        for (int v = 0; strcmp(args->sweeps[s].key, SPACING) == 0 && v < args->sweeps[s].count; v++) {
            const double length = strtod(args->sweeps[s].values[v], NULL);
            if (count == CHART_SPACINGS || !(length > 0)) {
                error_set(error, "slosh chart: --sweep %s takes up to %d lengths above 0, not '%.60s'",
                          SPACING, CHART_SPACINGS, args->sweeps[s].values[v]);
                return -1;
            }
            coarsenings[count++] = length / spacing;
        }
    qsort(coarsenings, (size_t)count, sizeof *coarsenings, descending);
    return count;
}
