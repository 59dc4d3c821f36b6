#include "app/lab/view_benchmark.h"

#include "app/base/file.h"
#include "app/base/output.h"
#include "app/bench/gnuplot.h"
#include "app/scene/keys.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char HEAD[] = "key,view,settings,clock,ms_a_picture,rms,structure\n";
static const char OURS[] = "key,view,";

static bool copy_text(char *text, size_t size, const char *cell)
{
    return cell && *cell && (size_t)snprintf(text, size, "%s", cell) < size;
}

static bool read_number(const char *cell, double *number)
{
    char *end = NULL;
    *number = cell ? strtod(cell, &end) : 0;
    return end && end != cell && !*end;
}

static bool parse_row(char *line, ViewRow *row)
{
    char *at = line, *cells[7], *end;
    line[strcspn(line, "\n")] = '\0';
    for (int c = 0; c < 7; c++)
        cells[c] = strsep(&at, ",");
    *row = (ViewRow){0};
    if (at || !cells[0])
        return false;
    row->key = strtoull(cells[0], &end, 16);
    return end == cells[0] + 16 && !*end && copy_text(row->view, sizeof row->view, cells[1]) &&
           copy_text(row->settings, sizeof row->settings, cells[2]) &&
           copy_text(row->clock, sizeof row->clock, cells[3]) && read_number(cells[4], &row->ms) &&
           read_number(cells[5], &row->error) && read_number(cells[6], &row->structure) && row->ms > 0 &&
           row->error >= 0 && row->structure >= 0;
}

bool view_rows_read(ViewRows *rows, const char *path, FILE *warnings, Error *error)
{
    char *line = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    rows->count = 0;
    if (!file)
        return errno == ENOENT ||
               error_set(error, "%s: cannot be read: %s; it is not replaced", path, strerror(errno));
    const bool empty = getline(&line, &size, file) <= 0;
    const bool ours = empty || strncmp(line, OURS, sizeof OURS - 1) == 0;
    const bool same = !empty && strcmp(line, HEAD) == 0;
    for (int number = 2; same && rows->count < VIEW_ROWS_MAX && getline(&line, &size, file) > 0; number++)
        if (parse_row(line, &rows->row[rows->count]))
            rows->count++;
        else if (warnings)
            fprintf(warnings,
                    "%s:%d: this row is none that a chart of views writes; it is left out, its picture drawn "
                    "again\n",
                    path, number);
    free(line);
    fclose(file);
    return ours || error_set(error,
                             "%s: is there already, and no chart of views wrote it; give the chart another "
                             "name, or move that file",
                             path);
}

void view_rows_add(ViewRows *rows, const ViewRow *row)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == row->key) {
            rows->row[i] = *row;
            return;
        }
    if (rows->count == VIEW_ROWS_MAX)
        memmove(&rows->row[0], &rows->row[1], (size_t)--rows->count * sizeof *rows->row);
    rows->row[rows->count++] = *row;
}

bool view_rows_write(const ViewRows *rows, const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        fputs(HEAD, file);
        for (int i = 0; i < rows->count; i++) {
            const ViewRow *row = &rows->row[i];
            if (isfinite(row->ms))
                fprintf(file, "%016" PRIx64 ",%s,%s,%s,%.17g,%.17g,%.17g\n", row->key, row->view,
                        row->settings, row->clock, row->ms, row->error, row->structure);
        }
        const bool whole = !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}

const ViewRow *view_rows_find(const ViewRows *rows, uint64_t key)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == key)
            return &rows->row[i];
    return NULL;
}

bool view_on_front(const ViewRows *rows, int row)
{
    const ViewRow *mine = &rows->row[row];
    if (!isfinite(mine->ms) || !isfinite(mine->error))
        return false;
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *other = &rows->row[i];
        if (strcmp(other->view, mine->view) == 0 && other->ms <= mine->ms &&
            other->error <= VIEW_EQUAL * mine->error && (other->ms < mine->ms || other->error < mine->error))
            return false;
    }
    return true;
}

static const char KIND[] = "view.kind=";

static bool add_setting(SceneSettings *settings, const char *said, const char *set, Error *error)
{
    if (settings->count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    settings->said[settings->count] = said;
    settings->set[settings->count++] = set;
    return true;
}

static bool load(const ViewPlan *plan, const ViewJob *job, Scene *scene, Notes *notes, Error *error)
{
    SceneSettings settings = *plan->settings;
    char kind[NAME_SIZE + sizeof KIND];
    snprintf(kind, sizeof kind, "%s%s", KIND, job->kind->name);
    bool ok = add_setting(&settings, NULL, kind, error) &&
              add_setting(&settings, NULL, "view.legend=false", error) &&
              add_setting(&settings, NULL, "view.box=false", error);
    for (int i = 0; ok && i < job->set_count; i++)
        ok = add_setting(&settings, job->set[i], job->set[i] + strlen("--set "), error);
    return ok && scene_load(plan->scene, &settings, scene, notes, error);
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
    const char *last = strrchr(path, '.') + 1;
    if (job->set_count == VIEW_SETS)
        return false;
    snprintf(job->set[job->set_count++], VIEW_SET_NAME, "--set %.40s=%.30s", path, value);
    if (named)
        snprintf(job->name, sizeof job->name, "%.40s=%.30s", last, value);
    return true;
}

static bool add_job(ViewPlan *plan, const ViewJob *job, Error *error)
{
    if (plan->count == VIEW_JOBS_MAX)
        return error_set(error, "more than %d pictures; name one view by --set view.kind=...", VIEW_JOBS_MAX);
    plan->jobs[plan->count++] = *job;
    return true;
}

/* True if the plan has a job of the view with the same settings. */
static bool have_job(const ViewPlan *plan, const ViewJob *job)
{
    for (int i = 0; i < plan->count; i++) {
        const ViewJob *other = &plan->jobs[i];
        bool same = other->kind == job->kind && !other->reference && other->set_count == job->set_count;
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
    static Scene scene;
    ViewJob job = {.kind = kind, .name = "as it is"}, reference = {.kind = kind, .reference = true};
    ViewJob coarse = {.kind = kind, .name = "all coarsest"}, fine = {.kind = kind, .name = "all finest"};
    if (!view_job_scene(plan, &job, &scene, error))
        return false;
    all_at(&reference, &scene, true);
    bool ok = add_job(plan, &reference, error) && add_job(plan, &job, error);
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
    static Scene scene;
    static Notes notes;
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
    static Notes common;
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

void view_rows_print(const ViewRows *rows, const ViewWords *words, FILE *file)
{
    fprintf(file, "%s\n%s\n%-10s %-28s %12s %10s %10s  %s\n", words->renderer, words->note, "view",
            "settings", "ms a picture", "rms", "structure", "clock");
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        if (isfinite(row->ms))
            fprintf(file, "%-10s %-28s %12.4g %8.3g %% %8.3g %%  %s%s\n", row->view, row->settings, row->ms,
                    100 * row->error, 100 * row->structure, row->clock,
                    view_on_front(rows, i) ? "  best for its time" : "");
        else
            fprintf(file, "%-10s %-28s %12s\n", row->view, row->settings, "not drawn");
    }
}

static json_t *row_json(const ViewRows *rows, int i)
{
    const ViewRow *row = &rows->row[i];
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:s?, s:b}", "view", row->view, "settings", row->settings,
                     "ms", number_json(row->ms), "error", number_json(row->error), "structure",
                     number_json(row->structure), "clock", *row->clock ? row->clock : NULL, "front",
                     view_on_front(rows, i));
}

bool view_rows_write_json(const ViewRows *rows, const ViewFacts *facts, const char *failure, const char *path,
                          Error *error)
{
    json_t *runs = json_array();
    bool ok = runs != NULL;
    for (int i = 0; ok && i < rows->count; i++)
        ok = json_array_append_new(runs, row_json(rows, i)) == 0;
    json_t *all =
        ok ? json_pack("{s:s, s:s, s:[i, i], s:i, s:f, s:O, s:s*}", "views", facts->scene, "renderer",
                       facts->renderer, "size", facts->width, facts->height, "supersampled", facts->factor,
                       "time", facts->time, "runs", runs, "error", failure)
           : NULL;
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    json_decref(runs);
    return written;
}

/* The chart of `slosh chart --views`. */

/* px */
enum { WIDTH = 860, HEIGHT = 560, LEFT = 84, TOP = 76, RIGHT = 700, BOTTOM = 500, VIEWS_MAX = 16 };

static const double LABEL_FONT = 8, LABEL_HEIGHT = 11;

/* Logarithms to base 10 of the drawn values: ms, error. */
typedef struct ChartFrame {
    double low[2], high[2];
    LabelField field;
} ChartFrame;

static bool drawn(const ViewRow *row)
{
    return row->ms > 0 && isfinite(row->ms) && row->error > 0 && isfinite(row->error);
}

static void chart_frame_make(const ViewRows *rows, ChartFrame *frame)
{
    *frame = (ChartFrame){.low = {(double)INFINITY, (double)INFINITY},
                          .high = {-(double)INFINITY, -(double)INFINITY},
                          .field = {.frame = {LEFT, TOP, RIGHT, BOTTOM}}};
    for (int i = 0; i < rows->count; i++)
        for (int k = 0; k < 2 && drawn(&rows->row[i]); k++) {
            const double value = log10(k ? rows->row[i].error : rows->row[i].ms);
            frame->low[k] = fmin(frame->low[k], value);
            frame->high[k] = fmax(frame->high[k], value);
        }
    for (int k = 0; k < 2; k++) {
        const double margin = 0.1 + 0.1 * (frame->high[k] - frame->low[k]);
        frame->low[k] -= margin;
        frame->high[k] += margin;
    }
}

static double x_of(const ChartFrame *frame, const ViewRow *row)
{
    return LEFT + (RIGHT - LEFT) * (log10(row->ms) - frame->low[0]) / (frame->high[0] - frame->low[0]);
}

static double y_of(const ChartFrame *frame, const ViewRow *row)
{
    return TOP + (BOTTOM - TOP) * (frame->high[1] - log10(row->error)) / (frame->high[1] - frame->low[1]);
}

/* Numbers at 1, 2 and 5 of each power of ten. */
static void put_axis(const char *name, double low, double high, FILE *gnuplot)
{
    static const double few[] = {1, 2, 5};
    int tics = 0;
    fprintf(gnuplot, "set %srange [%.9g:%.9g]\nset %stics (", name, pow(10, low), pow(10, high), name);
    for (int power = (int)floor(low); power <= (int)ceil(high); power++)
        for (int k = 0; k < 3; k++)
            fprintf(gnuplot, "%s%.9g", tics++ ? ", " : "", few[k] * pow(10, power));
    fputs(")\n", gnuplot);
}

static void put_words(const ViewWords *words, FILE *gnuplot)
{
    const char *const lines[] = {words->title, words->note, words->renderer};
    for (int i = 0; i < 3; i++) {
        fprintf(gnuplot, "set label %d ", 97 + i);
        gnuplot_quote(gnuplot, lines[i]);
        fprintf(gnuplot, " at screen 0.5,%g center noenhanced font ',%d' textcolor '%s'\n",
                1 - (i ? 22.0 + 15 * i : 18.0) / HEIGHT, i ? 8 : 11, i ? "#5a6672" : "#2a3440");
    }
}

/* Labels the front where there is room; a distant label gets a line to its point. */
static void put_labels(const ViewRows *rows, ChartFrame *frame, FILE *gnuplot)
{
    for (int i = 0; i < rows->count; i++)
        if (drawn(&rows->row[i]))
            label_field_point(&frame->field, x_of(frame, &rows->row[i]), y_of(frame, &rows->row[i]));
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        LabelBox place;
        if (!drawn(row) || !view_on_front(rows, i) ||
            !label_place(&frame->field, x_of(frame, row), y_of(frame, row),
                         label_width(row->settings, LABEL_FONT), LABEL_HEIGHT, &place))
            continue;
        const double x = x_of(frame, row), y = y_of(frame, row);
        const double to_x = fmin(fmax(x, place.left), place.right),
                     to_y = fmin(fmax(y, place.top), place.bottom);
        fprintf(gnuplot, "set label %d ", 100 + i);
        gnuplot_quote(gnuplot, row->settings);
        fprintf(gnuplot, " at screen %.5f,%.5f center noenhanced font ',%g'\n",
                0.5 * (place.left + place.right) / WIDTH, 1 - 0.5 * (place.top + place.bottom) / HEIGHT,
                LABEL_FONT);
        if (hypot(to_x - x, to_y - y) > 2 * LABEL_HEIGHT)
            fprintf(gnuplot,
                    "set arrow %d from screen %.5f,%.5f to screen %.5f,%.5f nohead lw 0.5 lc '#8795a3'\n",
                    100 + i, x / WIDTH, 1 - y / HEIGHT, to_x / WIDTH, 1 - to_y / HEIGHT);
    }
}

/* Collects the views in the order of their rows; returns their count. */
static int views_of(const ViewRows *rows, const char *views[VIEWS_MAX])
{
    int count = 0;
    for (int i = 0; i < rows->count; i++) {
        int v = 0;
        while (v < count && strcmp(views[v], rows->row[i].view) != 0)
            v++;
        if (v == count && count < VIEWS_MAX && drawn(&rows->row[i]))
            views[count++] = rows->row[i].view;
    }
    return count;
}

/* Two blocks per view: all pictures, and the front in the order of time. */
static void put_data(const ViewRows *rows, const char *view, int number, FILE *gnuplot)
{
    const ViewRow *front[VIEW_ROWS_MAX];
    int count = 0;
    fprintf(gnuplot, "$view%d << EOD\n", number);
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        if (!drawn(row) || strcmp(row->view, view) != 0)
            continue;
        fprintf(gnuplot, "%.9g %.9g\n", row->ms, row->error);
        if (!view_on_front(rows, i))
            continue;
        int at = count++;
        for (; at > 0 && front[at - 1]->ms > row->ms; at--)
            front[at] = front[at - 1];
        front[at] = row;
    }
    fprintf(gnuplot, "EOD\n$front%d << EOD\n", number);
    for (int i = 0; i < count; i++)
        fprintf(gnuplot, "%.9g %.9g\n", front[i]->ms, front[i]->error);
    fputs("EOD\n", gnuplot);
}

static void plot(const ViewRows *rows, FILE *gnuplot)
{
    static ChartFrame frame;
    const char *views[VIEWS_MAX];
    const int count = views_of(rows, views);
    if (count == 0) {
        fputs("unset logscale\nset label 1 'no error more than 0' at graph 0.1,0.5\nplot [0:1] 0 notitle\n",
              gnuplot);
        return;
    }
    chart_frame_make(rows, &frame);
    put_axis("x", frame.low[0], frame.high[0], gnuplot);
    put_axis("y", frame.low[1], frame.high[1], gnuplot);
    put_labels(rows, &frame, gnuplot);
    for (int v = 0; v < count; v++)
        put_data(rows, views[v], v, gnuplot);
    fputs("plot ", gnuplot);
    for (int v = 0; v < count; v++) {
        fprintf(
            gnuplot,
            "%s$view%d using 1:2 with points pt 7 ps 0.9 lt %d title '%s', $front%d using 1:2 with lines lw "
            "1.5 dt 2 lt %d title 'its best'",
            v ? ", " : "", v, v + 1, views[v], v, v + 1);
    }
    fputc('\n', gnuplot);
}

bool view_rows_draw(const ViewRows *rows, const ViewWords *words, const char *path, Error *error)
{
    Gnuplot chart = {.gnuplot = NULL};
    if (!gnuplot_begin(&chart, path, WIDTH, HEIGHT, error))
        return false;
    FILE *gnuplot = chart.gnuplot;
    fprintf(
        gnuplot,
        "set logscale xy\nset format xy '%%g'\nset xlabel 'time a picture, ms'\nset ylabel 'error, rms of linear "
        "light over white'\nset lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen "
        "%.5f\nset bmargin at screen %.5f\nset key at screen %.5f,%.5f left top Left reverse noenhanced\n",
        (double)LEFT / WIDTH, (double)RIGHT / WIDTH, 1 - (double)TOP / HEIGHT, 1 - (double)BOTTOM / HEIGHT,
        (RIGHT + 12.0) / WIDTH, 1 - (double)TOP / HEIGHT);
    put_words(words, gnuplot);
    plot(rows, gnuplot);
    return gnuplot_end(&chart, error);
}
