#include "app/lab/ablate.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/lab/error_chart.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FRAMES = 1, ARGUMENTS_MAX = 2 * SCENE_SETTINGS_MAX + 32, TEXT_SIZE = 4200 };

/* Returns true if valgrind is installed. */
static bool instructions_can(void)
{
    return system("command -v valgrind >/dev/null 2>&1") == 0;
}

/* A command line under construction. */
typedef struct CallgrindLine {
    int count;
    const char *word[ARGUMENTS_MAX];
} CallgrindLine;

static void add(CallgrindLine *line, const char *word)
{
    if (line->count < ARGUMENTS_MAX - 1)
        line->word[line->count++] = word;
}

static void add_two(CallgrindLine *line, const char *option, const char *value)
{
    add(line, option);
    add(line, value);
}

/* Replaces the child process by the program of the line. The program dies with `parent`, whatever the
   cause. */
_Noreturn static void become(const CallgrindLine *line, pid_t parent)
{
    const int nowhere = open("/dev/null", O_WRONLY);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    if (getppid() == parent)
        execvp(line->word[0], (char *const *)line->word);
    _exit(127);
}

/* Runs the program to its end, or until a signal; its output is discarded. */
static bool run(const CallgrindLine *line, Error *error)
{
    enum { LOOK_MS = 20 };
    int status = -1;
    fflush(NULL);
    const pid_t parent = getpid(), process = fork();
    if (process < 0)
        return error_set(error, "valgrind cannot be started: %s", strerror(errno));
    if (process == 0)
        become(line, parent);
    while (waitpid(process, &status, WNOHANG) == 0) {
        if (interrupted())
            kill(process, SIGKILL);
        poll(NULL, 0, LOOK_MS);
    }
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           error_set(error, interrupted() ? "stopped" : "the run under valgrind failed");
}

/* Reads the number after `what` in a callgrind profile or in the bench's JSON; `what` occurs once in each. */
static bool read_after(const char *path, const char *what, double *number)
{
    char *line = NULL;
    size_t size = 0;
    bool found = false;
    FILE *file = fopen(path, "r");
    while (file && !found && getline(&line, &size, file) > 0) {
        const char *at = strstr(line, what);
        if (at)
            *number = strtod(at + strlen(what), NULL);
        found = at != NULL;
    }
    free(line);
    if (file)
        fclose(file);
    return found;
}

static bool read_count(const char *profile, const char *json, double *per_step, Error *error)
{
    enum { WARM_UP_FRAMES = 3 };
    double all, substeps;
    if (!read_after(profile, "totals: ", &all) || !read_after(json, "\"substeps\": ", &substeps) ||
        !(all > 0) || !(substeps > 0))
        return error_set(error, "valgrind found no step in the profile");
    *per_step = all / (substeps * (FRAMES + WARM_UP_FRAMES));
    return true;
}

/* Counts the instructions of the scene's first steps, mean per step, on one thread; with one more setting
   (NULL: none) and `particles` particles (0: as set). Runs the program again under valgrind, about fifty
   times slower; a signal ends the count. Returns false with the reason. */
static bool instructions_count(const char *scene, const SceneSettings *settings, const char *more,
                               size_t particles, double *per_step, Error *error)
{
    char self[TEXT_SIZE] = "", folder[] = "/tmp/slosh-count-XXXXXX", out[TEXT_SIZE], profile[64], json[64],
         few[32];
    CallgrindLine line = {0};
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0 || !mkdtemp(folder))
        return error_set(error, "no place for valgrind's profile: %s", strerror(errno));
    snprintf(profile, sizeof profile, "%s/counts", folder);
    snprintf(json, sizeof json, "%s/bench.json", folder);
    snprintf(out, sizeof out, "--callgrind-out-file=%s", profile);
    output_pending_add(folder); /* a second signal removes the folder, too */
    snprintf(few, sizeof few, "%zu", particles > 0 ? particles : settings->particles);
    setenv("OMP_WAIT_POLICY", "passive", 0); /* avoids a restart of the program */
    add_two(&line, "valgrind", "--tool=callgrind");
    add_two(&line, "--toggle-collect=world_substep", out);
    add(&line, "--vgdb=no"); /* vgdb pipes would stay after a kill */
    add_two(&line, self, "bench");
    add_two(&line, scene, "--quiet");
    add_two(&line, "--json", json);
    add_two(&line, "--frames", "1");
    for (int i = 0; i < settings->count; i++)
        add_two(&line, "--set", settings->set[i]);
    if (more)
        add_two(&line, "--set", more);
    if (particles > 0 || settings->particles > 0)
        add_two(&line, "--particles", few);
    add_two(&line, "--set", "solver.threads=1");
    add_two(&line, "--set", "view.kind=none");
    const bool ok = run(&line, error) && read_count(profile, json, per_step, error);
    output_remove_folder(folder);
    output_pending_remove(folder);
    return ok;
}

enum { COUNTED_MOST = 5000 }; /* particles under valgrind; fractions hardly depend on the count */

static const double JITTER = 1e-6; /* spacings */

/* State of the runs. */
typedef struct AblateWork {
    const AblateSetup *setup;
    ChartSubject subject;
    Scene scene;
    int count;
    SceneTerm terms[TERMS_MAX];
    char settings[TERMS_MAX][2 * TERM_SIZE]; /* "--sweep path=off" */
    Trials runs;                             /* of the whole scene, */
    ChartRows whole;                         /* and its metrics */
    Progress progress;
    int done, all; /* runs */
} AblateWork;

static ChartJob job_of(const AblateWork *work, int row, int round)
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

static bool run_one(AblateWork *work, int row, int round, ChartRow *run, Error *error)
{
    Scene scene;
    const ChartJob job = job_of(work, row, round);
    const ProgressPart part = {&work->progress, (double)work->done / work->all, 1.0 / work->all};
    return chart_prepare(&work->subject, &job, &scene, run, NULL, error) &&
           chart_run(&work->subject, &job, run, &part, error);
}

/* Records the times of a finished run. */
static void take(const AblateWork *work, const ChartRow *run, AblateRow *row)
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
static bool run_whole(AblateWork *work, Ablation *ablation, int round, Error *error)
{
    ChartRow run;
    if (!run_one(work, 0, round, &run, error))
        return false;
    work->done++;
    take(work, &run, &ablation->row[0]);
    ablation->particles = run.particles;
    run.role = round > 0 ? CHART_FLOOR : CHART_REFERENCE;
    if (!trials_append(&work->runs, &run))
        return error_set(error, "no memory for the runs");
    return isfinite(run.seconds) || round > 0 ||
           error_set(error, "%.200s breaks as it is, so that nothing can be compared: %.200s",
                     work->setup->scene, run.outcome.words);
}

/* If the scene cannot run without a setting, the outcome says so. */
static bool run_without(AblateWork *work, Ablation *ablation, int term)
{
    ChartRow run;
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
        isfinite(run.seconds) ? chart_distance(&work->whole, &run, chart_row(&work->whole, 0)) : (double)NAN;
    return true;
}

static bool run_all(AblateWork *work, Ablation *ablation, Error *error)
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

static void count_all(AblateWork *work, Ablation *ablation)
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
static bool begin(AblateWork *work, Ablation *ablation, Error *error)
{
    Notes notes;
    SceneSettings settings = *work->setup->settings;
    if (!scene_load(work->setup->scene, &settings, &work->scene, &notes, error) ||
        !world_can(&work->scene.world, error))
        return false;
    notes_print(&notes, stderr);
    work->count = scene_terms(&work->scene, work->terms);
    work->whole = chart_rows_of(&work->runs, &work->scene);
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
    AblateWork work = {.setup = setup,
                       .runs = {.table = &chart_table},
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
    trials_free(&work.runs);
    return ok;
}

static double median(const double values[], int count)
{
    double sorted[ABLATE_RUNS];
    if (count == 0)
        return (double)NAN;
    memcpy(sorted, values, (size_t)count * sizeof *values);
    qsort(sorted, (size_t)count, sizeof *sorted, compare_numbers);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

double ablate_ms_step(const AblateRow *row)
{
    return median(row->ms_step, row->runs);
}

static double ablate_seconds(const AblateRow *row)
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
    qsort(share, (size_t)count, sizeof *share, compare_numbers);
    return count > 1 ? share[count - 1] - share[0] : (double)NAN;
}

/* Returns a term's fraction of the whole scene's instructions per step; NaN: not counted. */
static double ablate_counted(const Ablation *ablation, int row)
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

static const char *ablate_advice_word(AblateAdvice advice)
{
    return advices[advice].word;
}

static const char *ablate_advice_help(AblateAdvice advice)
{
    return advices[advice].help;
}

/* Formats "12.3 %", or "-" if unknown. */
static const char *percent(double part, char text[32])
{
    if (isfinite(part))
        snprintf(text, 32, "%.3g %%", 100 * part);
    else
        snprintf(text, 32, "-");
    return text;
}

static const char *number(double value, char text[32])
{
    if (isfinite(value))
        snprintf(text, 32, "%.4g", value);
    else
        snprintf(text, 32, "-");
    return text;
}

static void print_row(const Ablation *ablation, int i, FILE *file)
{
    const AblateRow *row = &ablation->row[i];
    const AblateAdvice advice = ablate_advice(ablation, i);
    char name[2 * TERM_SIZE], ms[32], seconds[32], saved[32], noise[32], instructions[32], change[32];
    if (i == 0)
        snprintf(name, sizeof name, "the whole scene");
    else
        snprintf(name, sizeof name, "%.44s %.16s", row->term, row->value);
    fprintf(file, "%-34s %10s %10s", name, number(ablate_ms_step(row), ms),
            number(ablate_seconds(row), seconds));
    if (i == 0) {
        fputc('\n', file);
        return;
    }
    fprintf(file, " %9s %9s %9s %9s  %s\n", percent(ablate_saved(ablation, i), saved),
            percent(ablate_noise(ablation, i), noise), percent(ablate_counted(ablation, i), instructions),
            percent(row->change, change), ablate_advice_word(advice));
    if (row->outcome.kind != ablation->row[0].outcome.kind) {
        char text[OUTCOME_TEXT];
        fprintf(file, "  without it: %s\n",
                row->outcome.kind == OUTCOME_NONE && !*row->outcome.words
                    ? "not run"
                    : outcome_text(&row->outcome, text));
    }
}

static void print_help(const Ablation *ablation, FILE *file)
{
    bool said[ABLATE_ADVICE_COUNT] = {false};
    for (int i = 1; i < ablation->count; i++) {
        const AblateAdvice advice = ablate_advice(ablation, i);
        if (!said[advice])
            fprintf(file, "%s: %s\n", ablate_advice_word(advice), ablate_advice_help(advice));
        said[advice] = true;
    }
}

void ablate_print(const Ablation *ablation, FILE *file)
{
    fprintf(file, "%s  %s  %s  %zu particles at the start  %g s each\n", ablation->scene, ablation->backend,
            ablation->method, ablation->particles, ablation->time);
    if (ablation->count <= 1) {
        fprintf(file, "the scene has no term that it could do without\n\n");
        return;
    }
    fprintf(file, "%-34s %10s %10s %9s %9s %9s %9s\n", "without", "ms a step", "s a sim. s", "saves", "+-",
            "instr.", "changes");
    for (int i = 0; i < ablation->count; i++)
        print_row(ablation, i, file);
    if (isfinite(ablation->floor))
        fprintf(file, "repeats of the whole scene, moved by 1e-6 of a spacing, change by %.3g %%\n",
                100 * ablation->floor);
    if (*ablation->not_counted)
        fprintf(file, "no instructions: %s\n", ablation->not_counted);
    else if (isfinite(ablation->row[0].instructions))
        fprintf(file, "instructions: %.4g a step at %zu particles, in the first steps, on one thread\n",
                ablation->row[0].instructions, ablation->counted_particles);
    print_help(ablation, file);
    fputc('\n', file);
}

static json_t *row_json(const Ablation *ablation, int i)
{
    const AblateRow *row = &ablation->row[i];
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s*, s:I, s:f, s:s?, s:i, s:o, s:o, s:o, s:o}", "scene", ablation->scene, "method",
        ablation->method, "backend", ablation->backend, "renderer",
        *ablation->renderer ? ablation->renderer : NULL, "particles", (json_int_t)ablation->particles, "time",
        ablation->time, "term", i > 0 ? row->term : NULL, "runs", row->runs, "ms_step",
        number_json(ablate_ms_step(row)), "seconds_per_second", number_json(ablate_seconds(row)),
        "steps_per_second", number_json(row->runs > 0 ? row->steps : (double)NAN), "instructions_step",
        number_json(row->instructions));
    outcome_json(json, &row->outcome);
    if (json && i == 0) {
        json_object_set_new(json, "floor", number_json(ablation->floor));
        json_object_set_new(json, "terms", json_integer(ablation->count - 1));
        if (*ablation->not_counted)
            json_object_set_new(json, "no_instructions", json_string(ablation->not_counted));
    } else if (json) {
        json_object_set_new(json, "value", json_string(row->value));
        json_object_set_new(json, "off", json_string(row->off));
        json_object_set_new(json, "saves", number_json(ablate_saved(ablation, i)));
        json_object_set_new(json, "noise", number_json(ablate_noise(ablation, i)));
        json_object_set_new(json, "saves_instructions", number_json(ablate_counted(ablation, i)));
        json_object_set_new(json, "changes", number_json(row->change));
        json_object_set_new(json, "advice", json_string(ablate_advice_word(ablate_advice(ablation, i))));
    }
    return json;
}

bool ablate_write_json(const Ablation *ablations, size_t count, const char *path, Error *error)
{
    json_t *rows = json_array();
    bool ok = rows != NULL;
    for (size_t a = 0; a < count; a++)
        for (int i = 0; ok && i < ablations[a].count; i++)
            ok = json_array_append_new(rows, row_json(&ablations[a], i)) == 0;
    const bool written = json_file_write(ok ? rows : NULL, path, error);
    json_decref(rows);
    return written;
}
