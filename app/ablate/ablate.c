#include "app/ablate/ablate.h"

#include "app/base/program.h"
#include "app/lab/chart_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNTED_MOST = 5000 }; /* particles under valgrind; fractions hardly depend on the count */

static const double JITTER = 1e-6; /* spacings */

/* State of the runs. */
typedef struct Work {
    const AblateSetup *setup;
    ChartSubject subject;
    Scene scene;
    int count;
    SceneTerm terms[TERMS_MAX];
    char settings[TERMS_MAX][2 * TERM_SIZE]; /* "--sweep path=off" */
    ChartRows whole;                         /* the rows of the whole scene */
    Progress progress;
    int done, all; /* runs */
} Work;

static ChartJob job_of(const Work *work, int row, int round)
{
    ChartJob job = {.role = CHART_POINT,
                    .method = work->scene.world.method,
                    .backend = work->scene.world.backend,
                    .coarsening = 1};
    if (row > 0)
        job.set[job.set_count++] = work->settings[row - 1];
    else
        job.jitter = JITTER * round;
    return job;
}

static bool run_one(Work *work, int row, int round, ChartRow *run, Error *error)
{
    static Scene scene;
    const ChartJob job = job_of(work, row, round);
    return chart_prepare(&work->subject, &job, &scene, run, NULL, error) &&
           chart_run(&work->subject, &job, run, &work->progress, (double)work->done / work->all,
                     1.0 / work->all, error);
}

/* Records the times of a finished run. */
static void take(const Work *work, const ChartRow *run, AblateRow *row)
{
    if (row->runs == 0)
        row->outcome = run->outcome;
    if (!isfinite(run->seconds) || run->steps == 0 || row->runs == ABLATE_RUNS)
        return;
    row->steps = (double)run->steps / work->setup->time;
    row->seconds[row->runs] = run->seconds;
    row->ms_step[row->runs++] = 1000 * run->seconds / row->steps;
}

/* Returns false to end all runs. */
static bool run_whole(Work *work, Ablation *ablation, int round, Error *error)
{
    ChartRow *run = &work->whole.row[work->whole.count];
    if (!run_one(work, 0, round, run, error))
        return false;
    work->done++;
    take(work, run, &ablation->row[0]);
    ablation->particles = run->particles;
    run->role = round > 0 ? CHART_FLOOR : CHART_REFERENCE;
    work->whole.count++;
    return isfinite(run->seconds) || round > 0 ||
           error_set(error, "%.200s breaks as it is, so that nothing can be compared: %.200s",
                     work->setup->scene, run->outcome.words);
}

/* If the scene cannot run without a setting, the outcome says so. */
static bool run_without(Work *work, Ablation *ablation, int term)
{
    static ChartRow run;
    AblateRow *row = &ablation->row[term + 1];
    Error why = {{0}};
    work->done++;
    if (row->outcome.kind != OUTCOME_NONE && row->runs == 0)
        return true; /* broke in the round before */
    if (!run_one(work, term + 1, 0, &run, &why)) {
        if (!interrupted())
            outcome_not_run(why.message, &row->outcome);
        return !interrupted();
    }
    take(work, &run, row);
    row->change =
        isfinite(run.seconds) ? chart_distance(&work->whole, &run, &work->whole.row[0]) : (double)NAN;
    return true;
}

static bool run_all(Work *work, Ablation *ablation, Error *error)
{
    bool ok = run_whole(work, ablation, 0, error);
    for (int round = 1; ok && round <= ABLATE_ROUNDS; round++) {
        for (int t = 0; ok && t < work->count; t++)
            ok = run_without(work, ablation, t);
        ok = ok && run_whole(work, ablation, round, error);
        ablation->floor = chart_rows_compare(&work->whole);
    }
    return ok || interrupted();
}

static void count_all(Work *work, Ablation *ablation)
{
    Error why = {{0}};
    const bool on_cpu = !world_on_gpu(&work->scene.world), few = ablation->particles <= COUNTED_MOST;
    ablation->counted_particles = few ? ablation->particles : COUNTED_MOST;
    if (!on_cpu || !instructions_can())
        snprintf(ablation->not_counted, sizeof ablation->not_counted, "%s",
                 on_cpu ? "valgrind is not installed: apt-get install valgrind"
                        : "valgrind counts those of the backend cpu alone");
    for (int i = 0; i < ablation->count && !*ablation->not_counted && !interrupted(); i++) {
        AblateRow *row = &ablation->row[i];
        const char *more = i > 0 ? work->settings[i - 1] + strlen("--sweep ") : NULL;
        progress_update(&work->progress, (double)(work->done + i) / work->all);
        if (row->runs == 0 || instructions_count(work->setup->scene, work->setup->settings, more,
                                                 few ? 0 : COUNTED_MOST, &row->instructions, &why))
            continue;
        row->instructions = (double)NAN;
        if (i == 0)
            snprintf(ablation->not_counted, sizeof ablation->not_counted, "%.200s", why.message);
    }
}

/* Loads the scene and finds its terms. */
static bool begin(Work *work, Ablation *ablation, Error *error)
{
    static Notes notes;
    SceneSettings settings = *work->setup->settings;
    if (!scene_load(work->setup->scene, &settings, &work->scene, &notes, error) ||
        !world_can(&work->scene.world, error))
        return false;
    notes_print(&notes, stderr);
    work->count = scene_terms(&work->scene, work->terms);
    work->whole.metric_count = work->scene.metric_count;
    memcpy(work->whole.metrics, work->scene.metrics, sizeof work->whole.metrics);
    work->whole.probe_count = work->scene.probes.count;
    snprintf(ablation->method, sizeof ablation->method, "%s", work->scene.world.method);
    snprintf(ablation->backend, sizeof ablation->backend, "%s", work->scene.world.backend);
    ablation->count = work->count + 1;
    for (int i = 0; i < ablation->count; i++)
        ablation->row[i] = (AblateRow){.instructions = (double)NAN, .change = i > 0 ? (double)NAN : 0};
    for (int t = 0; t < work->count; t++) {
        AblateRow *row = &ablation->row[t + 1];
        const SceneTerm *term = &work->terms[t];
        memcpy(row->term, term->path, sizeof row->term);
        memcpy(row->value, term->value, sizeof row->value);
        row->off = term->key->off;
        snprintf(work->settings[t], sizeof work->settings[t], "--sweep %s=%s", row->term, row->off);
    }
    return true;
}

bool ablate(const AblateSetup *setup, Ablation *ablation, Error *error)
{
    static Work work;
    work = (Work){.setup = setup,
                  .subject = {.scene = setup->scene, .time = setup->time, .settings = setup->settings}};
    *ablation = (Ablation){.scene = setup->scene, .time = setup->time, .floor = (double)NAN};
    if (!begin(&work, ablation, error))
        return false;
    if (work.count == 0)
        return true;
    work.all = ABLATE_RUNS + ABLATE_ROUNDS * work.count + ablation->count;
    progress_begin(&work.progress, stderr, "ablate", setup->quiet);
    const bool ok = run_all(&work, ablation, error);
    if (ok && !interrupted())
        count_all(&work, ablation);
    progress_end(&work.progress);
    return ok;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double values[], int count)
{
    double sorted[ABLATE_RUNS];
    if (count == 0)
        return (double)NAN;
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, ascending);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

double ablate_ms_step(const AblateRow *row)
{
    return median(row->ms_step, row->runs);
}

double ablate_seconds(const AblateRow *row)
{
    return median(row->seconds, row->runs);
}

/* Fills in, for each round, the term's fraction of the whole scene's time; the whole scene ran directly
   before and after. Returns the count of rounds. */
static int shares(const Ablation *ablation, int row, double share[ABLATE_RUNS])
{
    const AblateRow *whole = &ablation->row[0], *without = &ablation->row[row];
    int count = 0;
    for (; count < without->runs && count < whole->runs; count++) {
        const int behind = count + 1 < whole->runs ? count + 1 : count;
        share[count] = 1 - 2 * without->seconds[count] / (whole->seconds[count] + whole->seconds[behind]);
    }
    return count;
}

double ablate_saved(const Ablation *ablation, int row)
{
    double share[ABLATE_RUNS];
    return median(share, shares(ablation, row, share));
}

double ablate_noise(const Ablation *ablation, int row)
{
    double share[ABLATE_RUNS];
    const int count = shares(ablation, row, share);
    qsort(share, (size_t)count, sizeof *share, ascending);
    return count > 1 ? share[count - 1] - share[0] : (double)NAN;
}

double ablate_counted(const Ablation *ablation, int row)
{
    return 1 - ablation->row[row].instructions / ablation->row[0].instructions;
}

AblateAdvice ablate_advice(const Ablation *ablation, int row)
{
    const AblateRow *without = &ablation->row[row];
    if (without->outcome.kind > ablation->row[0].outcome.kind ||
        (without->outcome.kind == OUTCOME_NONE && *without->outcome.words))
        return ABLATE_NEEDED;
    const double saved = ablate_saved(ablation, row), noise = ablate_noise(ablation, row);
    if (isnan(saved) || isnan(noise) || isnan(without->change) || isnan(ablation->floor))
        return ABLATE_UNKNOWN;
    const bool costs = saved > noise || ablate_counted(ablation, row) > ABLATE_COUNTED;
    const bool changes = without->change > fmax(ablation->floor, ABLATE_LEAST);
    if (costs)
        return changes ? ABLATE_WEIGH : ABLATE_DROP;
    return changes ? ABLATE_KEEP : ABLATE_IDLE;
}

static const struct {
    const char *word, *help;
} advices[] = {
#define X(NAME, word, help) {word, help},
    ABLATE_ADVICE(X)
#undef X
};

const char *ablate_advice_word(AblateAdvice advice)
{
    return advices[advice].word;
}

const char *ablate_advice_help(AblateAdvice advice)
{
    return advices[advice].help;
}
