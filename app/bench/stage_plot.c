/* The chart of `slosh bench`: a bar per case, of the stages of a frame. */
#include "app/bench/bench.h"
#include "app/bench/plot.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 820, HEIGHT = 400, COLOURS = 10, NAME = 640 }; /* px: the picture, its panel; bytes */
static const double LEAST = 0.02; /* share of a frame from which a stage has a colour of its own */

typedef struct StageColumns {
    int count;            /* with the column of small stages, the last */
    Stage stage[COLOURS]; /* of the others */
    const char *title[COLOURS + 1];
} StageColumns;

static double greatest_share(const BenchResult *results, size_t count, Stage stage)
{
    double share = 0;
    for (size_t i = 0; i < count; i++)
        if (!*results[i].failure.message && results[i].stages[stage].ran)
            share = fmax(share, results[i].stages[stage].share);
    return share;
}

/* Takes the longest stages of any case, in the order of the frame. */
static StageColumns find_columns(const BenchResult *results, size_t count)
{
    StageColumns columns = {.count = 0};
    for (int s = 0; s < STAGE_COUNT; s++) {
        const double share = greatest_share(results, count, (Stage)s);
        int longer = 0;
        for (int other = 0; other < STAGE_COUNT; other++)
            longer += greatest_share(results, count, (Stage)other) > share;
        if (share < LEAST || longer + 1 >= COLOURS || columns.count + 1 >= COLOURS)
            continue;
        columns.stage[columns.count] = (Stage)s;
        columns.title[columns.count++] = stage_name((Stage)s);
    }
    columns.title[columns.count++] = "all other stages";
    return columns;
}

static double value_of(const StageColumns *columns, const BenchResult *result, int column)
{
    double rest = 0;
    if (column + 1 < columns->count)
        return result->stages[columns->stage[column]].median_ms;
    for (int s = 0; s < STAGE_COUNT; s++) {
        bool named = false;
        for (int c = 0; c + 1 < columns->count; c++)
            named |= columns->stage[c] == (Stage)s;
        rest += named || !result->stages[s].ran ? 0 : result->stages[s].median_ms;
    }
    return rest;
}

/* Fills in a bar's name: scene, method, view, swept values and count of particles on lines. Returns the count
   of lines. */
static int bar_name(const BenchResult *r, char name[NAME])
{
    const char *slash = strrchr(r->scene, '/'), *scene = slash ? slash + 1 : r->scene;
    char swept[sizeof r->swept], *rest = NULL;
    int lines = 3;
    snprintf(swept, sizeof swept, "%s", r->swept);
    size_t used =
        (size_t)snprintf(name, NAME, "%.*s\\n%s, %s", (int)strcspn(scene, "."), scene, r->method, r->backend);
    if (!strstr(swept, "view=") && ++lines)
        used += (size_t)snprintf(name + used, NAME - used, "\\n%s%s", r->view,
                                 strcmp(r->view, "none") == 0 ? " drawn" : "");
    for (char *part = strtok_r(swept, ",", &rest); part; part = strtok_r(NULL, ",", &rest), lines++)
        used += (size_t)snprintf(name + used, NAME - used, "\\n%s", part + strspn(part, " "));
    snprintf(name + used, NAME - used, "\\n%zu particles", r->particles);
    for (char *c = name; *c; c++)
        *c = *c == '"' ? '\'' : *c; /* the end of a name for gnuplot */
    return lines;
}

/* The page, with room for the names of bars. Returns the count of bars. */
static size_t make_page(const BenchResult *results, size_t count, const StageColumns *columns, PlotPage *page)
{
    size_t bars = 0;
    double bar = 0;
    *page = (PlotPage){.width = WIDTH, .height = HEIGHT};
    for (int c = 0; c < columns->count; c++)
        page->legend = fmax(page->legend, plot_legend_width(columns->title[c]));
    for (size_t i = 0; i < count; i++) {
        char name[NAME];
        if (*results[i].failure.message)
            continue;
        const int lines = bar_name(&results[i], name);
        page->lines = lines > page->lines ? lines : page->lines;
        bar = fmax(bar, plot_bar_width(name));
        bars++;
    }
    const int wide = (int)(bar * (double)(bars + 1) + page->legend) + 100;
    page->width = wide > WIDTH ? wide : WIDTH;
    return bars;
}

bool bench_stages_draw(const BenchResult *results, size_t count, const char *path, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    PlotPage page;
    char machine[384];
    const StageColumns columns = find_columns(results, count);
    const size_t bars = make_page(results, count, &columns, &page);
    const char *const titles[] = {"what a frame is made of: its substeps and a picture, medians", machine};
    snprintf(machine, sizeof machine, "%s%s%s", bench_processor(),
             *bench_processor() && *results[0].renderer ? "; " : "", results[0].renderer);
    if (!plot_begin_page(&plot, path, titles, 2, &page, error))
        return false;
    plot_set(&plot, "ylabel", "time of a frame, ms", "");
    plot_bars(&plot, columns.title, NULL, bars);
    for (size_t i = 0; i < count; i++) {
        double values[COLOURS];
        char name[NAME];
        if (*results[i].failure.message)
            continue;
        for (int c = 0; c < columns.count; c++)
            values[c] = value_of(&columns, &results[i], c);
        bar_name(&results[i], name);
        plot_bar(&plot, values, name);
    }
    plot_draw(&plot, NULL);
    return plot_end(&plot, error);
}
