#include "app/fit/fit_scene.h"

#include "app/base/output.h"
#include "app/fit/fit_seal.h"
#include "app/lab/bench.h"
#include "app/scene/keys.h"
#include "app/scene/scene.h"
#include "app/scene/scene_files.h"
#include "app/scene/yaml/yaml.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    static Notes notes;
    notes.count = 0;
    scene_advise_key(scene, path, &notes);
    return notes.count == 0;
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
static bool apply(const FitPlan *plan, const ChartSettings *chosen, const ChartJob *job, YamlTree *tree,
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
        text = fit_seal(head, body);
    free(head);
    free(body);
    return text;
}

static bool write_text(const FitPlan *plan, const char *text, Error *error)
{
    Output output = {.path = ""};
    if (!output_begin(&output, plan->output, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        fputs(text, file);
        const bool whole = !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", plan->output, strerror(errno));
    output_discard(&output);
    return false;
}

static bool write_chosen(const FitPlan *plan, YamlTree *tree, Error *error)
{
    static Scene scene;
    static ChartRow row;
    FitJob job;
    ChartSettings settings;
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
    const bool ok = text ? write_text(plan, text, error) : error_set(error, "no memory for the scene");
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
