#include "app/lab/view_benchmark.h"

#include "app/base/file.h"
#include "app/bench/plot.h"
#include "app/scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const TrialColumn columns[] = {
    {"view", CELL_TEXT, CELL(ViewRow, view)},
    {"settings", CELL_TEXT, CELL(ViewRow, settings)},
    {"clock", CELL_TEXT, CELL(ViewRow, clock)},
    {"ms_a_picture", CELL_NUMBER, CELL(ViewRow, ms), .flags = CELL_OPEN, .digits = 17},
    {"rms", CELL_NUMBER, CELL(ViewRow, error), .digits = 17},
    {"structure", CELL_NUMBER, CELL(ViewRow, structure), .digits = 17},
    {NULL},
};

/* A picture that could not be drawn is tried again. */
static bool is_drawn(const void *row)
{
    return isfinite(((const ViewRow *)row)->ms);
}

const TrialTable view_table = {
    .who = "a chart of views",
    .result = "chart",
    .trial = "picture",
    .head = "key,view,settings,clock,ms_a_picture,rms,structure\n",
    .opening = "key,view,",
    .row_size = sizeof(ViewRow),
    .most = VIEW_ROWS_MAX,
    .columns = columns,
    .possible = is_drawn,
};

bool view_on_front(const Trials *rows, int row)
{
    const ViewRow *mine = view_row(rows, row);
    if (!isfinite(mine->ms) || !isfinite(mine->error))
        return false;
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *other = view_row(rows, i);
        if (strcmp(other->view, mine->view) == 0 && other->ms <= mine->ms &&
            other->error <= VIEW_EQUAL * mine->error && (other->ms < mine->ms || other->error < mine->error))
            return false;
    }
    return true;
}

static const char KIND[] = "view.kind=";

static bool load(const ViewPlan *plan, const ViewJob *job, Scene *scene, Notes *notes, Error *error)
{
    RunSettings settings = {.all = *plan->settings};
    bool ok = run_settings_add(&settings, error, "%s%s", KIND, job->kind->name) &&
              run_settings_add(&settings, error, "view.legend=false") &&
              run_settings_add(&settings, error, "view.box=false");
    for (int i = 0; ok && i < job->set_count; i++)
        ok = run_settings_add(&settings, error, "%s", job->set[i]);
    return ok && scene_load(plan->scene, &settings.all, scene, notes, error);
}

bool view_job_scene(const ViewPlan *plan, const ViewJob *job, Scene *scene, Error *error)
{
    return load(plan, job, scene, NULL, error);
}

static void value_of(const Scene *scene, const char *path, char value[VIEW_SET_NAME])
{
    key_value_text(scene_key_find(path), scene, value, VIEW_SET_NAME);
}

static bool in_effect(const ViewGrade *grade, const Scene *scene)
{
    char value[VIEW_SET_NAME];
    if (!grade->where)
        return true;
    value_of(scene, grade->where, value);
    return strcmp(value, grade->value) == 0;
}

static bool number_of(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end;
}

/* Returns the coarsest or finest value of a grade; the scene's own value if beyond the grade or not
   comparable. */
static const char *end_of(const ViewGrade *grade, const char *now, bool finest)
{
    int count = 0, at = -1;
    double own, first, last;
    for (; grade->values[count]; count++)
        at = strcmp(grade->values[count], now) == 0 ? count : at;
    if (count == 0)
        return now;
    const char *low = grade->values[0], *high = grade->values[count - 1];
    if (!number_of(now, &own) || !number_of(low, &first) || !number_of(high, &last))
        return at < 0 ? now : finest ? high : low;
    const double beyond = finest ? (own - last) * (last - first) : (first - own) * (last - first);
    return beyond > 0 ? now : finest ? high : low;
}

/* Adds a setting to the job; if `named`, job->name gets the last part of the key's path. */
static bool job_set(ViewJob *job, const char *path, const char *value, bool named)
{
    if (job->set_count == VIEW_SETS)
        return false;
    snprintf(job->set[job->set_count++], VIEW_SET_NAME, "--set %.40s=%.30s", path, value);
    if (named)
        snprintf(job->name, sizeof job->name, "%.40s=%.30s", key_last_part(path), value);
    return true;
}

/* Adds a job of the last reference. */
static bool add_job(ViewPlan *plan, const ViewJob *job, Error *error)
{
    if (plan->count == VIEW_JOBS_MAX)
        return error_set(error, "more than %d pictures; name one view by --set view.kind=...", VIEW_JOBS_MAX);
    plan->jobs[plan->count] = *job;
    plan->jobs[plan->count++].reference = plan->reference_count - 1;
    return true;
}

/* True if the plan has a job of the view with the same settings. */
static bool have_job(const ViewPlan *plan, const ViewJob *job)
{
    for (int i = 0; i < plan->count; i++) {
        const ViewJob *other = &plan->jobs[i];
        bool same = other->kind == job->kind && other->set_count == job->set_count;
        for (int k = 0; same && k < job->set_count; k++)
            same = strcmp(other->set[k], job->set[k]) == 0;
        if (same)
            return true;
    }
    return false;
}

/* Sets all keys to one end; returns true if any differs from the scene. */
static bool all_at(ViewJob *job, const Scene *scene, bool finest)
{
    bool other = false;
    for (const ViewGrade *grade = job->kind->grades; grade && grade->path; grade++) {
        char now[VIEW_SET_NAME];
        value_of(scene, grade->path, now);
        const char *value = grade->alike ? now : end_of(grade, now, finest);
        if (!in_effect(grade, scene) || strcmp(value, now) == 0)
            continue;
        other |= job_set(job, grade->path, value, false);
    }
    return other;
}

static bool plan_grade(ViewPlan *plan, const ViewKind *kind, const ViewGrade *grade, const Scene *scene,
                       Error *error)
{
    char now[VIEW_SET_NAME];
    bool ok = true;
    value_of(scene, grade->path, now);
    for (int v = 0; ok && grade->values[v] && in_effect(grade, scene); v++) {
        ViewJob job = {.kind = kind};
        if (strcmp(grade->values[v], now) == 0)
            continue;
        job_set(&job, grade->path, grade->values[v], true);
        ok = add_job(plan, &job, error);
    }
    return ok;
}

static bool plan_view(ViewPlan *plan, const ViewKind *kind, Error *error)
{
    Scene scene;
    ViewJob job = {.kind = kind, .name = "as it is"}, *reference = &plan->references[plan->reference_count];
    ViewJob coarse = {.kind = kind, .name = "all coarsest"}, fine = {.kind = kind, .name = "all finest"};
    if (plan->reference_count == VIEW_REFERENCES || !view_job_scene(plan, &job, &scene, error))
        return false;
    plan->reference_count++;
    *reference = (ViewJob){.kind = kind};
    all_at(reference, &scene, true);
    bool ok = add_job(plan, &job, error);
    for (const ViewGrade *grade = kind->grades; ok && grade && grade->path; grade++)
        ok = plan_grade(plan, kind, grade, &scene, error);
    if (ok && all_at(&coarse, &scene, false) && !have_job(plan, &coarse)) /* may equal a single grade */
        ok = add_job(plan, &coarse, error);
    if (ok && all_at(&fine, &scene, true) && !have_job(plan, &fine))
        ok = add_job(plan, &fine, error);
    return ok;
}

/* Keeps the notes common to all views: a key read by one view has an effect. */
static bool keep_common(const ViewPlan *plan, const ViewKind *kind, bool first, Notes *common, Error *error)
{
    Scene scene;
    Notes notes;
    const ViewJob job = {.kind = kind};
    int kept = 0;
    if (!load(plan, &job, &scene, &notes, error))
        return false;
    if (first) {
        *common = notes;
        return true;
    }
    for (int i = 0; i < common->count; i++)
        if (notes_have(&notes, common->line[i]))
            memmove(common->line[kept++], common->line[i], NOTE_SIZE);
    common->count = kept;
    return true;
}

/* Returns the view named on the command line, or NULL. */
static const char *named_view(const SceneSettings *settings)
{
    const char *name = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], KIND, strlen(KIND)) == 0)
            name = settings->set[i] + strlen(KIND);
    return name;
}

bool view_plan_make(const Args *args, ViewPlan *plan, Error *error)
{
    *plan = (ViewPlan){.scene = args->scenes[0], .settings = &args->settings};
    const char *name = named_view(&args->settings);
    Notes common;
    int views = 0;
    bool ok = true;
    for (int i = 0; ok && view_at(i); i++)
        if (!name || strcmp(view_at(i)->name, name) == 0)
            ok = keep_common(plan, view_at(i), views++ == 0, &common, error) &&
                 plan_view(plan, view_at(i), error);
    if (ok && views > 0)
        notes_print(&common, stderr);
    return ok && (plan->count > 0 ||
                  error_set(error, "slosh chart: the view %s draws no fluid; name another, or none", name));
}

/* Reports of `slosh chart --views`: a table, JSON. */

void view_rows_print(const Trials *rows, const ViewWords *words, FILE *file)
{
    fprintf(file, "%s\n%s\n%-10s %-28s %12s %10s %10s  %s\n", words->renderer, words->note, "view",
            "settings", "ms a picture", "rms", "structure", "clock");
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = view_row(rows, i);
        if (isfinite(row->ms))
            fprintf(file, "%-10s %-28s %12.4g %8.3g %% %8.3g %%  %s%s\n", row->view, row->settings, row->ms,
                    100 * row->error, 100 * row->structure, row->clock,
                    view_on_front(rows, i) ? "  best for its time" : "");
        else
            fprintf(file, "%-10s %-28s %12s\n", row->view, row->settings, "not drawn");
    }
}

json_t *view_row_json(const Trials *rows, int i)
{
    const ViewRow *row = view_row(rows, i);
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:s?, s:b}", "view", row->view, "settings", row->settings,
                     "ms", number_json(row->ms), "error", number_json(row->error), "structure",
                     number_json(row->structure), "clock", *row->clock ? row->clock : NULL, "front",
                     view_on_front(rows, i));
}

/* The chart of `slosh chart --views`. */

/* px */
enum { WIDTH = 880, PANEL_HEIGHT = 430 };

static bool drawn(const ViewRow *row)
{
    return row->ms > 0 && isfinite(row->ms) && row->error > 0 && isfinite(row->error);
}

/* True if the row is the first drawn one of its view. */
static bool opens_view(const Trials *rows, int i)
{
    for (int k = 0; k < i; k++)
        if (drawn(view_row(rows, k)) && strcmp(view_row(rows, k)->view, view_row(rows, i)->view) == 0)
            return false;
    return drawn(view_row(rows, i));
}

/* Sets the axes with a margin around the drawn pictures. */
static void put_axes(Plot *plot, const Trials *rows)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    for (int i = 0; i < rows->count; i++)
        for (int k = 0; k < 2 && drawn(view_row(rows, i)); k++) {
            const double value = k ? 100 * view_row(rows, i)->error : view_row(rows, i)->ms;
            low[k] = fmin(low[k], value);
            high[k] = fmax(high[k], value);
        }
    for (int k = 0; k < 2 && high[0] > 0; k++) {
        const double margin = pow(10, 0.1) * pow(high[k] / low[k], 0.1);
        plot_axis(plot, k ? "y" : "x", low[k] / margin, high[k] * margin, true);
    }
}

static int by_time(const void *a, const void *b)
{
    const ViewRow *x = *(const ViewRow *const *)a, *y = *(const ViewRow *const *)b;
    return (x->ms > y->ms) - (x->ms < y->ms);
}

/* Draws the pictures of the view that opens with row `first`. */
static void plot_pictures(Plot *plot, const Trials *rows, int first, int colour)
{
    const char *view = view_row(rows, first)->view;
    plot_series(plot, view, "with points pt 7 ps 0.9 lt %d", colour);
    for (int i = first; i < rows->count; i++)
        if (drawn(view_row(rows, i)) && strcmp(view_row(rows, i)->view, view) == 0)
            plot_point(plot, view_row(rows, i)->ms, 100 * view_row(rows, i)->error);
}

/* Labels other pictures if there is room beside the point. */
static void label_others(Plot *plot, const Trials *rows)
{
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = view_row(rows, i);
        if (drawn(row) && !view_on_front(rows, i))
            plot_label(plot, row->ms, 100 * row->error, row->settings, PLOT_LABEL_NEAR);
    }
}

/* Draws and labels the front of that view, where there is room. */
static void plot_front(Plot *plot, const Trials *rows, int first, int colour)
{
    const ViewRow *front[VIEW_ROWS_MAX];
    int count = 0;
    for (int i = first; i < rows->count; i++)
        if (drawn(view_row(rows, i)) && strcmp(view_row(rows, i)->view, view_row(rows, first)->view) == 0 &&
            view_on_front(rows, i))
            front[count++] = view_row(rows, i);
    qsort(front, (size_t)count, sizeof *front, by_time);
    for (int i = 0; i < count; i++)
        plot_label(plot, front[i]->ms, 100 * front[i]->error, front[i]->settings, PLOT_LABEL_FAR);
    plot_series(plot, NULL, "with lines lw 1.5 dt 2 lt %d", colour);
    for (int i = 0; i < count; i++)
        plot_point(plot, front[i]->ms, 100 * front[i]->error);
}

bool view_rows_draw(const Trials *rows, const ViewWords *words, const char *path, Error *error)
{
    const char *const titles[] = {words->title, words->note, words->renderer};
    Plot plot = {.gnuplot = NULL};
    static const char front[] = "best for its time";
    const PlotPage page = {
        .width = WIDTH, .height = PANEL_HEIGHT, .legend = plot_legend_width(front), .lines = 2};
    if (!plot_begin_page(&plot, path, titles, 3, &page, error))
        return false;
    plot_set(&plot, "xlabel", "time a picture, ms", "");
    plot_set(&plot, "ylabel", "error: rms of linear light, % of white", "");
    put_axes(&plot, rows);
    for (int fronts = 0; fronts < 2; fronts++) /* labels keep off the points of all views */
        for (int i = 0, colour = 0; i < rows->count; i++)
            if (opens_view(rows, i))
                (fronts ? plot_front : plot_pictures)(&plot, rows, i, ++colour);
    label_others(&plot, rows);
    plot_function(&plot, front, "NaN with lines lw 1.5 dt 2 lc '#2a3440'");
    plot_draw(&plot, "no error more than 0");
    return plot_end(&plot, error);
}
