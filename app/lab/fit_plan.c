#include "app/base/file.h"
#include "app/bench/bench.h"
#include "app/lab/fit.h"
#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const FitOptions *own(const Args *args)
{
    return args->own;
}

static bool take_goal(const Args *args, FitPlan *plan, Error *error)
{
    if ((own(args)->error > 0) == (own(args)->frame_ms > 0))
        return error_set(error, own(args)->error > 0
                                    ? "slosh fit: --error and --frame-ms exclude each other; name one of them"
                                    : "slosh fit: say what is asked for, --error PERCENT or --frame-ms MS");
    /* slower than real time never keeps up, so a cost above 1 is not allowed */
    plan->goal = own(args)->error > 0
                     ? (FitGoal){.error = own(args)->error / 100, .cost = INFINITY}
                     : (FitGoal){.error = INFINITY, .cost = fmin(own(args)->frame_ms / 1000 / FIT_FRAME, 1)};
    if (own(args)->frame_ms / 1000 > FIT_FRAME * 1.001)
        notes_add(&plan->notes,
                  "--frame-ms %g is longer than a frame of 1/30 s: real time allows %.3g ms, which are taken",
                  own(args)->frame_ms, 1000 * FIT_FRAME);
    return true;
}

void fit_default_output(const char *scene, char output[1024])
{
    const char *slash = strrchr(scene, '/'), *name = slash ? slash + 1 : scene, *dot = strrchr(name, '.');
    snprintf(output, 1024, "%.*s_fit.yaml", dot && dot > name ? (int)(dot - name) : (int)strlen(name), name);
}

bool fit_name_files(const Args *args, char output[1024], char csv[1024], Error *error)
{
    if (args->output && strlen(args->output) >= 1024)
        return error_set(error, "the name of the scene has more than %d bytes; name a shorter one", 1023);
    if (args->output)
        snprintf(output, 1024, "%s", args->output);
    else
        fit_default_output(args->scenes[0], output);
    snprintf(csv, 1024, "%s", output);
    char *dot = strrchr(csv, '.');
    if (!dot || strcasecmp(dot, ".yaml") != 0)
        return error_set(error, "'%s' is no name for a scene; name a FILE.yaml", output);
    memcpy(dot, ".csv", sizeof ".csv");
    return true;
}

static void note_command(const Args *args, FitPlan *plan)
{
    char *text = plan->command;
    const size_t size = sizeof plan->command;
    size_t used = (size_t)snprintf(text, size, "slosh fit %.300s %s %g", args->scenes[0],
                                   own(args)->error > 0 ? "--error" : "--frame-ms",
                                   own(args)->error > 0 ? own(args)->error : own(args)->frame_ms);
    if (args_given(args, "--time"))
        used += (size_t)snprintf(text + used, size - used, " --time %g", args->time);
    if (args->settings.particles > 0)
        used += (size_t)snprintf(text + used, size - used, " --particles %zu", args->settings.particles);
    for (int i = 0; i < args->settings.count && used < size - 128; i++)
        used += (size_t)snprintf(text + used, size - used, " --set %.*s", 100, args->settings.set[i]);
}

bool fit_plan_make(const Args *args, const char *output, FitPlan *plan, Error *error)
{
    *plan = (FitPlan){.args = args, .output = output};
    if (!chart_subject_find(args, &plan->subject, &plan->scene, &plan->notes, error) ||
        !take_goal(args, plan, error))
        return false;
    note_command(args, plan);
    chart_error_name(&plan->subject, &plan->scene, plan->error_of);
    fit_axes_make(&plan->subject, &plan->scene, &plan->axes, &plan->notes);
    return plan->axes.axis[FIT_METHOD].values > 0 || error_set(error, "slosh fit: no method can run it here");
}

const ChartRow *fit_plan_row(const FitPlan *plan, int i)
{
    return chart_row(&plan->runs.used, plan->ladder.tries[i].figures.row);
}

const FitTry *fit_plan_own(const FitPlan *plan)
{
    const FitTry *first = plan->ladder.tries;
    return plan->ladder.count > 0 && first->fate != FIT_PRUNED ? first : NULL;
}

void fit_goal_text(const FitPlan *plan, char *text, size_t size)
{
    if (isinf(plan->goal.cost))
        snprintf(text, size, "within %g %%", 100 * plan->goal.error);
    else
        snprintf(text, size, "within %.3g s of computing a simulated second", plan->goal.cost);
}

static const char SUM[] = "# slosh fit may replace this file as long as its sum is ";
enum { DIGITS = 16 };

static void sum_of(const char *head, const char *body, char digits[DIGITS + 1])
{
    snprintf(digits, DIGITS + 1, "%016" PRIx64, run_key_text(run_key_text(RUN_KEY, head), body));
}

/* Joins the head (comments, with the final line end), the line of the hash, and the body. The caller frees
   the text. Returns NULL if memory is short. */
static char *fit_add_seal(const char *head, const char *body)
{
    char digits[DIGITS + 1];
    const size_t size = strlen(head) + strlen(SUM) + DIGITS + 1 + strlen(body) + 1;
    char *text = malloc(size);
    sum_of(head, body, digits);
    if (text)
        snprintf(text, size, "%s%s%s\n%s", head, SUM, digits, body);
    return text;
}

/* True if a text of `size` bytes, with a final 0, has the right hash. Cuts the text at the hash. */
static bool fit_is_sealed(char *text, size_t size)
{
    char digits[DIGITS + 1];
    char *sum = strlen(text) == size ? strstr(text, SUM) : NULL;
    if (!sum)
        return false;
    const char *has = sum + strlen(SUM);
    if (strspn(has, "0123456789abcdef") != DIGITS || has[DIGITS] != '\n')
        return false;
    *sum = '\0';
    sum_of(text, has + DIGITS + 1, digits);
    return strncmp(has, digits, DIGITS) == 0;
}

/* First words of a file from slosh fit. */
static const char OURS[] = "# Written by slosh fit";

/* Reads a whole file of at most SCENE_BYTES_MAX; "" if the file does not exist. Returns NULL with the
   reason on failure. The caller frees the text. */
static char *read_text(const char *path, size_t *size, Error *error)
{
    char *text = calloc(1, SCENE_BYTES_MAX + 1);
    FILE *file = fopen(path, "r");
    bool read = file || errno == ENOENT;
    *size = text && file ? fread(text, 1, SCENE_BYTES_MAX, file) : 0;
    if (!read || (file && ferror(file)))
        read = error_set(error, "%s: is there, but cannot be read (%s); name another with -o", path,
                         strerror(errno));
    else if (!text)
        error_set(error, "%s: no memory to read it", path);
    if (file)
        fclose(file);
    if (read)
        return text;
    free(text);
    return NULL;
}

bool fit_scene_check(const char *path, Error *error)
{
    size_t size;
    char *text = read_text(path, &size, error);
    bool ok = text != NULL;
    if (ok && size > 0 && strncmp(text, OURS, strlen(OURS)) != 0)
        ok = error_set(
            error,
            "%s: is there already, and slosh fit did not write it; name another with -o, or move that file",
            path);
    else if (ok && size > 0 && !fit_is_sealed(text, size))
        ok = error_set(
            error,
            "%s: was changed since slosh fit wrote it; name another with -o, or move that file to keep "
            "the changes",
            path);
    free(text);
    return ok && output_check(path, error);
}

/* ---- the tree ---- */

static bool has_effect(const Scene *scene, const char *path)
{
    char why[NOTE_SIZE];
    return key_has_effect(scene, path, why);
}

/* Returns the scene's old value for the key of "path=value", as a comment. NULL if the value is unchanged
   and nothing must be set. Another preset may fill in a different value where the scene names none, so the
   key is set then. */
static const char *was(YamlTree *tree, const FitPlan *plan, bool other_preset, const char *setting)
{
    char path[128], now[128];
    const char *value = strchr(setting, '=') + 1;
    snprintf(path, sizeof path, "%.*s", (int)(value - 1 - setting), setting);
    const YamlNode *node = tree_at(tree, path);
    const Key *key = scene_key_find(path);
    if (key)
        key_value_text(key, &plan->scene, now, sizeof now);
    const char *before = node && node->text ? node->text : key ? now : "";
    if (strcmp(before, value) == 0)
        return node || !other_preset ? NULL : "as it was";
    if (!node && !has_effect(&plan->scene, path))
        return "had no effect before";
    const char *from = node                                       ? ""
                       : solver_preset_filled(&plan->scene, path) ? ", from the preset"
                                                                  : ", by default";
    const size_t size = sizeof "was " + strlen(before) + strlen(from);
    char *text = tree_alloc(tree, size);
    if (text)
        snprintf(text, size, "was %s%s", before, from);
    return text;
}

/* True if a later setting overrides the key. */
static bool comes_again(const SceneSettings *settings, int i)
{
    const size_t length = strcspn(settings->set[i], "=") + 1;
    for (int later = i + 1; later < settings->count; later++)
        if (strncmp(settings->set[i], settings->set[later], length) == 0)
            return true;
    return false;
}

/* Applies the settings of the case, then of the command line, then the chosen settings. */
static bool apply(const FitPlan *plan, const RunSettings *chosen, const ChartJob *job, YamlTree *tree,
                  Error *error)
{
    const Case *of = plan->subject.of;
    const CaseMethod *with = of ? case_method(of, job->method) : NULL;
    const SceneSettings *given = plan->subject.settings;
    const bool other_preset = plan->ladder.tries[plan->ladder.best].point.at[FIT_PRESET] > 0;
    bool ok = !of || !of->setting || tree_set(tree, of->setting, "of the case", error);
    for (int i = 0; ok && with && i < CASE_SETTINGS && with->set[i]; i++)
        ok = tree_set(tree, with->set[i], "of the case", error);
    for (int i = 0; ok && i < given->count; i++)
        ok = tree_set(tree, given->set[i], given->said[i], error);
    for (int i = given->count; ok && i < chosen->all.count; i++) {
        if (comes_again(&chosen->all, i))
            continue;
        const char *comment = was(tree, plan, other_preset, chosen->all.set[i]);
        ok = !comment || tree_set(tree, chosen->all.set[i], comment, error);
    }
    return ok;
}

/* Removes keys of the mapping with an effect in `own` but none in `chosen`. */
static void drop_unused(YamlNode *mapping, const char *above, const Scene *own, const Scene *chosen)
{
    YamlNode **at = &mapping->first;
    while (mapping->kind == NODE_MAPPING && *at) {
        char path[128];
        snprintf(path, sizeof path, "%.60s.%.60s", above, (*at)->key);
        drop_unused(*at, path, own, chosen);
        if ((*at)->kind == NODE_SCALAR && has_effect(own, path) && !has_effect(chosen, path))
            *at = (*at)->next;
        else
            at = &(*at)->next;
    }
}

/* A SceneFileMoved callback: replaces the node's file name. */
static void name_whole(void *user, YamlNode *node, const char *path, const char *whole)
{
    (void)path;
    const size_t size = strlen(whole) + 1;
    char *own = tree_alloc(user, size);
    if (!own)
        return;
    snprintf(own, size, "%s", whole);
    node->text = own;
}

/* ---- head of the file, as comments ---- */

static void print_best(const FitPlan *plan, FILE *file)
{
    const FitTry *best = &plan->ladder.tries[plan->ladder.best], *own = fit_plan_own(plan);
    fprintf(file,
            "# Error: %.3g %% (%s), of repeats that differ by a millionth of a spacing up to %.3g %%.\n",
            100 * best->figures.error, plan->error_of, 100 * best->worst);
    if (isfinite(best->finer))
        fprintf(file, "# At the next finer spacing it is %.3g %%.\n", 100 * best->finer);
    const double time = plan->subject.of ? plan->subject.of->time : plan->subject.time;
    if (plan->subject.of)
        fprintf(file, "# It is of %g s", time);
    else
        fprintf(file,
                "# It is against the finest run of the scene, half its spacing and half its step, over %g s",
                time);
    fprintf(file, "; %g s, three times as long, hold too.\n", CHART_LONGER * time);
    fprintf(file, "# Cost: %.3g s of computing a simulated second, without pictures, on %s, %d thread%s.\n",
            best->figures.cost, bench_processor(), fit_threads(&plan->scene),
            fit_threads(&plan->scene) == 1 ? "" : "s");
    if (own && own != best && isfinite(own->figures.cost))
        fprintf(file, "# The scene as it was: %.3g %% at %.3g s, %.3g times as much.\n",
                100 * own->figures.error, own->figures.cost, own->figures.cost / best->figures.cost);
    else if (own == best)
        fprintf(file, "# It is the scene as it was: none of those that were tried is better.\n");
}

/* Prints the second best setting within the bound. */
static void print_rival(const FitPlan *plan, FILE *file)
{
    const FitLadder *ladder = &plan->ladder;
    const bool cheap = isinf(plan->goal.cost);
    int rival = -1, ran = 0;
    for (int i = 0; i < ladder->count; i++) {
        const FitFigures *figures = &ladder->tries[i].figures;
        ran += ladder->tries[i].fate != FIT_PRUNED;
        if (ladder->tries[i].fate == FIT_WITHIN &&
            (rival < 0 || (cheap ? figures->cost < ladder->tries[rival].figures.cost
                                 : figures->error < ladder->tries[rival].figures.error)))
            rival = i;
    }
    fprintf(file, "# Tried: %d settings; %d more were predicted to be too dear.\n", ran, ladder->count - ran);
    if (rival < 0)
        return;
    const ChartRow *row = fit_plan_row(plan, rival);
    fprintf(file, "# The next best of them: %s, %s, spacing %.4g m%s%s: %.3g %% at %.3g s.\n", row->method,
            row->step, row->spacing, *row->swept ? ", " : "", row->swept, 100 * row->error, row->seconds);
}

static void print_head(const FitPlan *plan, FILE *file)
{
    char goal[96];
    fit_goal_text(plan, goal, sizeof goal);
    fprintf(file, "%s, by\n#   %s\n# The %s that was found %s.\n", OURS, plan->command,
            isinf(plan->goal.cost) ? "cheapest" : "most accurate", goal);
    print_best(plan, file);
    print_rival(plan, file);
    if (plan->subject.of && plan->subject.of->start)
        fprintf(file, "# The case %s changes the start of this scene in a way that no scene can say.\n",
                plan->subject.of->name);
}

/* ---- the file ---- */

static char *print_body(const YamlTree *tree)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    if (file)
        tree_print(tree, file);
    const bool whole = file && !ferror(file);
    if (file && fclose(file) == 0 && whole)
        return text;
    free(text);
    return NULL;
}

static char *print_text(const FitPlan *plan, const YamlTree *tree)
{
    char *head = NULL, *body = print_body(tree), *text = NULL;
    size_t size;
    FILE *file = open_memstream(&head, &size);
    if (file)
        print_head(plan, file);
    if (file && fclose(file) == 0 && head && body)
        text = fit_add_seal(head, body);
    free(head);
    free(body);
    return text;
}

static bool put_text(const void *text, FILE *file)
{
    return fputs(text, file) >= 0;
}

static bool write_chosen(const FitPlan *plan, YamlTree *tree, Error *error)
{
    Scene scene;
    ChartRow row;
    FitJob job;
    RunSettings settings;
    fit_axes_job(&plan->axes, &plan->ladder.tries[plan->ladder.best].point, &job);
    if (!chart_settings(&plan->subject, &job.job, &settings, &scene, &row, error) ||
        !apply(plan, &settings, &job.job, tree, error) ||
        !chart_prepare(&plan->subject, &job.job, &scene, &row, NULL, error))
        return false;
    YamlNode *solver = (YamlNode *)tree_at(tree, "solver");
    if (solver)
        drop_unused(solver, "solver", &plan->scene, &scene);
    scene_move_files(tree, plan->output, name_whole, tree);
    char *text = print_text(plan, tree);
    const bool ok = text ? output_print(plan->output, put_text, text, error)
                         : error_set(error, "no memory for the scene");
    free(text);
    return ok;
}

bool fit_scene_write(const FitPlan *plan, Error *error)
{
    char path[SCENE_PATH_SIZE];
    size_t size;
    YamlTree tree;
    const char *name = plan->subject.of ? plan->subject.of->scene : plan->subject.scene;
    char *bytes = scene_path_find(name, path, error) ? scene_file_read(path, &size, error) : NULL;
    if (!bytes)
        return false;
    const bool ok = tree_read(&tree, path, bytes, size, error) && write_chosen(plan, &tree, error);
    tree_free(&tree);
    free(bytes);
    return ok;
}

static const char *const fates[] = {
    [FIT_BEST] = "best", [FIT_WITHIN] = "within", [FIT_BEYOND] = "beyond", [FIT_BROKE] = "broke",
    [FIT_LUCK] = "luck", [FIT_REPEAT] = "repeat", [FIT_PRUNED] = "pruned"};

/* Prints why a try was chosen or rejected. */
static void print_why(const FitPlan *plan, const FitTry *try, FILE *file)
{
    const bool cheap = isinf(plan->goal.cost);
    if (try->fate == FIT_BEST && isfinite(try->finer))
        fprintf(file, "chosen; repeats up to %.3g %%, the next finer spacing %.3g %%", 100 * try->worst,
                100 * try->finer);
    else if (try->fate == FIT_BEST)
        fprintf(file, "chosen; repeats up to %.3g %%", 100 * try->worst);
    else if (try->fate == FIT_WITHIN)
        fputs(cheap ? "left: dearer" : "left: less accurate", file);
    else if (try->fate == FIT_BEYOND)
        fputs(cheap ? "left: too far off" : "left: too dear", file);
    else if (try->fate == FIT_LUCK)
        fprintf(file, "left: luck, the next finer spacing has %.3g %%", 100 * try->finer);
    else if (try->fate == FIT_REPEAT)
        fprintf(file,
                try->figures.holds
                    ? "left: a repeat has %.3g %%"
                    : "left: repeats have up to %.3g %%, and one of them, or a run three times as long, "
                      "does not hold",
                100 * try->worst);
    else
        fputs("left: does not hold", file);
}

static void print_try(const FitPlan *plan, int i, FILE *file)
{
    const FitTry *try = &plan->ladder.tries[i];
    const ChartRow *row = fit_plan_row(plan, i);
    char text[OUTCOME_TEXT];
    fprintf(file, "%-8s %-12s %10.4g %9zu %14.4g %7.3g %%  %s%s", row->method, row->step, row->spacing,
            row->particles, row->seconds, 100 * row->error, row->swept, *row->swept ? "  " : "");
    print_why(plan, try, file);
    fprintf(file, "%s\n", try == fit_plan_own(plan) ? "; the scene as it is" : "");
    if (row->outcome.kind != OUTCOME_HOLDS)
        fprintf(file, "  %s\n", outcome_text(&row->outcome, text));
    else if (row->backs > 0)
        fprintf(file, "  the sentinel went back %u time%s\n", row->backs, row->backs == 1 ? "" : "s");
}

static bool same_line(const FitPoint *a, const FitPoint *b)
{
    return a->at[FIT_METHOD] == b->at[FIT_METHOD] && a->at[FIT_PRESET] == b->at[FIT_PRESET];
}

/* Prints the pruned tries of one line: count and least predicted cost. Does nothing if `first` is not the
   first of its line. */
static void print_pruned_line(const FitPlan *plan, int first, FILE *file)
{
    const FitTry *tries = plan->ladder.tries;
    int count = 0;
    double least = INFINITY;
    for (int i = 0; i < plan->ladder.count; i++) {
        if (tries[i].fate != FIT_PRUNED || !same_line(&tries[i].point, &tries[first].point))
            continue;
        if (i < first)
            return;
        count++;
        least = fmin(least, tries[i].predicted);
    }
    const char *preset = plan->axes.preset[tries[first].point.at[FIT_PRESET]];
    fprintf(file, "not run, predicted too dear: %d of %s%s%s, from %.3g s a simulated s on\n", count,
            plan->axes.method[tries[first].point.at[FIT_METHOD]], preset ? " with preset " : "",
            preset ? preset : "", least);
}

void fit_print(const FitPlan *plan, FILE *file)
{
    const FitLadder *ladder = &plan->ladder;
    fprintf(file, "%-8s %-12s %10s %9s %14s %9s\n", "method", "step", "spacing, m", "particles",
            "s a simulated s", "error");
    for (int i = 0; i < ladder->count; i++)
        if (ladder->tries[i].fate != FIT_PRUNED)
            print_try(plan, i, file);
    for (int i = 0; i < ladder->count; i++)
        if (ladder->tries[i].fate == FIT_PRUNED)
            print_pruned_line(plan, i, file);
    if (plan->runs.warned > 0)
        fprintf(file, "not run, slosh would warn of them: %d, as of: %s\n", plan->runs.warned,
                plan->runs.warning);
    if (ladder->full)
        fprintf(file, "not all that could be tried was: there is room for %d settings\n", FIT_TRIES);
    if (isfinite(plan->runs.floor))
        fprintf(file, "three runs of the scene that differ by 1e-6 of a spacing: %.3g %% apart\n",
                100 * plan->runs.floor);
}

/* ---- JSON ---- */

static json_t *swept_json(const ChartJob *job)
{
    json_t *set = json_array();
    for (int i = 0; i < job->set_count; i++)
        json_array_append_new(set, json_string(job->set[i] + strlen("--sweep ")));
    return set;
}

static json_t *try_json(const FitPlan *plan, int i)
{
    const FitTry *try = &plan->ladder.tries[i];
    const bool ran = try->fate != FIT_PRUNED;
    FitJob job;
    fit_axes_job(&plan->axes, &try->point, &job);
    json_t *json = json_pack("{s:s, s:s, s:f, s:o, s:o}", "method", job.job.method, "fate", fates[try->fate],
                             "coarsening", job.job.coarsening, "set", swept_json(&job.job), "predicted",
                             number_json(try->predicted));
    if (!ran || !json)
        return json;
    const ChartRow *row = fit_plan_row(plan, i);
    json_t *more = json_pack("{s:s, s:s, s:f, s:I, s:I, s:o, s:o, s:o, s:b}", "backend", row->backend, "step",
                             row->step, "spacing", row->spacing, "particles", (json_int_t)row->particles,
                             "backs", (json_int_t)row->backs, "seconds_per_second", number_json(row->seconds),
                             "error", number_json(row->error), "worst", number_json(try->worst), "own",
                             try == fit_plan_own(plan));
    outcome_json(more, &row->outcome);
    json_object_update(json, more);
    json_decref(more);
    return json;
}

static json_t *goal_json(const FitPlan *plan)
{
    const Args *args = plan->args;
    return isinf(plan->goal.cost)
               ? json_pack("{s:f}", "error", plan->goal.error)
               : json_pack("{s:f, s:f}", "frame_ms", own(args)->frame_ms, "cost", plan->goal.cost);
}

json_t *fit_json(const FitPlan *plan, const char *failure)
{
    json_t *runs = json_array(), *pruned = json_array(), *best = NULL;
    for (int i = 0; runs && pruned && i < plan->ladder.count; i++) {
        const FitFate fate = plan->ladder.tries[i].fate;
        if (fate == FIT_BEST)
            best = json_integer((json_int_t)json_array_size(runs));
        json_array_append_new(fate == FIT_PRUNED ? pruned : runs, try_json(plan, i));
    }
    return json_pack("{s:s, s:s, s:o, s:o, s:s, s:i, s:o, s:s, s:o, s:o, s:s*}", "fit", plan->args->scenes[0],
                     "error_of", plan->error_of, "goal", goal_json(plan), "floor",
                     number_json(plan->runs.floor), "processor", bench_processor(), "threads",
                     fit_threads(&plan->scene), "best", best ? best : json_null(), "output", plan->output,
                     "runs", runs, "pruned", pruned, "error", failure);
}
