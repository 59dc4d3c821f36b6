#include "app/bench/bench.h"

#include "app/bench/cases/case.h"
#include "app/bench/plot.h"
#include "render/frame/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BIT(stage) (1U << (stage))

/* Bits of all solver stages. */
#define X(NAME, name, part) | ((part) == PART_SIM ? BIT(STAGE_##NAME) : 0U)
enum { SIM = 0U STAGE_LIST(X) };
#undef X

static const BenchTable tables[] = {
    {.name = "paper001",
     .help =
         "points a second: sampling of surfaces, and rendering by the view pbsr (Tanaka et al. 2012, section "
         "5); give it --size 1024x1024; --particles N: so many points of each field",
     .scene = "scenes/papers/surfaces.yaml",
     .settings = {"view.pbsr.moving=8", "view.pbsr.repeat=64"},
     .reference = "scenes/reference/paper001-points.csv",
     .view = "pbsr",
     .points = true},
    {.name = "paper003-spheres",
     .help = "simulation and rendering by spheres, CPU and GPU (SIBGRAPI 2010, Table II and Figure 5)",
     .scene = "scenes/dam_break.yaml",
     .settings = {"solver.step.dt=0.0012", "solver.step.substeps=1"},
     .particles = {"1024", "2048", "4096", "8192"},
     .reference = "scenes/reference/paper003-spheres.csv",
     .shares = true,
     .columns = {{"simulation", SIM}, {"rendering", 0}}},
    {.name = "paper003-substeps",
     .help = "one step of 0.01 s a picture against ten of 0.001 s (SIBGRAPI 2010, Figure 6)",
     .scene = "scenes/substeps.yaml",
     .settings = {"solver.step.dt=0.01"},
     .particles = {"8192"},
     .substeps = {"1", "10"},
     .reference = "scenes/reference/paper003-substeps.csv",
     .ratios = true,
     .columns = {{"simulation", SIM}, {"rendering", 0}}},
    {.name = "paper002-passes",
     .help =
         "the passes of splatting, frames and particles a second over its animations, while the camera turns "
         "(Adams et al. 2006, Table 1); give it --size 640x480; --particles N: smaller ones",
     .scenes = {"scenes/papers/melting.yaml", "scenes/papers/goop_on_bust.yaml", "scenes/papers/mixing.yaml",
                "scenes/papers/mixing.yaml"},
     .seconds = 1.5,
     .settings = {"view.radius=1", "view.splat.drops=false"}, /* no neighbours there */
     .particles = {"110000", "18000", "59000", "63000"},
     .asked = {NULL, "20000", "118000", "126000"},
     .reference = "scenes/reference/paper002-passes.csv",
     .view = "splat",
     .percent = true,
     .columns = {{"visibility", BIT(STAGE_VISIBILITY)},
                 {"blend", BIT(STAGE_BLEND)},
                 {"shade", BIT(STAGE_SHADE)}}},
    {.name = "paper003-raycast",
     .help =
         "simulation, volume and raycasting (SIBGRAPI 2010, Table I and Figure 5), by the paper's geometry "
         "shader; 128 x 128 x 128 cells in a cube, as its CPU has; with --set view.volume.cells=512 as fine as its "
         "GPU's 128 x 512 x 512",
     .scene = "scenes/papers/cube.yaml",
     .settings = {"solver.step.dt=0.0012", "solver.step.substeps=1", "view.volume.method=geometry"},
     .particles = {"1024", "2048", "4096", "8192"},
     .reference = "scenes/reference/paper003-raycast.csv",
     .view = "volume",
     .backends = true,
     .shares = true,
     .columns = {{"simulation", SIM},
                 {"voxelize", BIT(STAGE_VOXELIZE)},
                 {"raycast", BIT(STAGE_RAYCAST)},
                 {"rendering", 0}}},
    {.name = "paper003-voxelize",
     .help =
         "ways to the volume, that paper's `geometry`, its rival `iwasaki`; `direct`: where the slice is drawn",
     .scene = "scenes/dam_break.yaml",
     .settings = {"view.volume.show=slice"},
     .particles = {"1024", "8192"},
     .view = "volume",
     .sweep = "view.volume.method",
     .values = {"geometry", "layers", "planes", "iwasaki", "scatter", "gather", "slabs", "direct"},
     .columns = {{"voxelize", BIT(STAGE_VOXELIZE)}, {"slice", BIT(STAGE_SHADE)}}},
};

const char *bench_table_choice(int index)
{
    return index < (int)(sizeof tables / sizeof *tables) ? tables[index].name : NULL;
}

const BenchTable *bench_table_find(const char *name, Error *error)
{
    char all[sizeof error->message] = "";
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        if (strcmp(tables[i].name, name) == 0)
            return &tables[i];
        snprintf(all + strlen(all), sizeof all - strlen(all), "\n  %-18s %s", tables[i].name, tables[i].help);
    }
    error_set(error, "there is no table '%.60s'; these are there:%s", name, all);
    return NULL;
}

size_t bench_table_scenes(const BenchTable *table, const char *const **scenes)
{
    size_t count = 0;
    *scenes = table->scene ? &table->scene : table->scenes;
    while (!table->scene && table->scenes[count])
        count++;
    return table->scene ? 1 : count;
}

static void add(Sweep *sweep, const char *value)
{
    if (sweep->count < ARGS_SWEEP_VALUES_MAX)
        sweep->values[sweep->count++] = value;
}

int bench_table_sweeps(const BenchTable *table, Sweep sweeps[BENCH_TABLE_SWEEPS + 1])
{
    int count = 0;
    Sweep *views = &sweeps[count++];
    *views = (Sweep){.key = "view.kind"};
    for (int i = 0; view_at(i); i++)
        if (!table->view || strcmp(table->view, view_at(i)->name) == 0)
            add(views, view_at(i)->name);
    if (table->points)
        return count;
    if (table->scene) {
        Sweep *particles = &sweeps[count++];
        *particles = (Sweep){.key = "particles"};
        for (int i = 0; table->particles[i]; i++)
            add(particles, table->particles[i]);
    }
    if (table->substeps[0]) {
        Sweep *substeps = &sweeps[count++];
        *substeps = (Sweep){.key = "solver.step.substeps"};
        for (int i = 0; table->substeps[i]; i++)
            add(substeps, table->substeps[i]);
    }
    if (table->sweep) {
        Sweep *values = &sweeps[count++];
        *values = (Sweep){.key = table->sweep};
        for (int i = 0; table->values[i]; i++)
            add(values, table->values[i]);
    }
    if (table->view && !table->backends)
        return count;
    Sweep *backends = &sweeps[count++];
    *backends = (Sweep){.key = "solver.backend"};
    for (const Named *backend = world_backends(); backend->name; backend++)
        add(backends, backend->name);
    return count;
}

/* Returns the time of a column in the median frame, ms. */
static double bench_table_value(const BenchTable *table, const BenchResult *result, int column)
{
    unsigned named = 0;
    double sum = 0;
    for (int c = 0; table->columns[c].title; c++)
        named |= table->columns[c].stages;
    const unsigned wanted = table->columns[column].stages ? table->columns[column].stages : ~named;
    for (unsigned s = 0; s < STAGE_COUNT; s++)
        sum += wanted & BIT(s) ? result->stages[s].median_ms : 0;
    return sum;
}

/* Returns a row's name beside its view: the value of the table's sweep, or the backend. */
static const char *bench_table_row_name(const BenchTable *table, const BenchResult *result)
{
    const char *value = table->sweep ? strrchr(result->swept, '=') : NULL;
    return value ? value + 1 : result->backend;
}

/* Prints values in ms with their shares. `times` false: published shares only, without times. */
static void print_values(const double *values, int columns, bool times, FILE *file)
{
    double all = 0;
    for (int c = 0; c < columns; c++)
        all += values[c];
    for (int c = 0; c < columns; c++) {
        if (times)
            fprintf(file, " %9.3f", values[c]);
        else
            fprintf(file, " %9s", "");
        fprintf(file, " %5.1f %%", all > 0 ? 100 * values[c] / all : 0);
    }
    if (times)
        fprintf(file, " %9.3f", all);
    else
        fprintf(file, " %9s", "");
}

static int column_count(const BenchTable *table)
{
    int columns = 0;
    while (table->columns[columns].title)
        columns++;
    return columns;
}

/* Prints coverage, and fragments per covered pixel of each column with a single counted stage. */
static void print_counts(const BenchTable *table, const BenchResult *r, FILE *file)
{
    fprintf(file, " %8.1f %%", 100 * r->counts.coverage);
    for (int c = 0; table->columns[c].title; c++)
        for (unsigned s = 0; s < STAGE_COUNT; s++)
            if (table->columns[c].stages == BIT(s) && r->counts.fragments[s] > 0)
                fprintf(file, " %6.1f", r->counts.fragments[s]);
}

/* Prints frames per second, and millions of particles per second. */
static void print_rate(double rate, size_t particles, FILE *file)
{
    fprintf(file, " %9.1f %9.2f", rate, 1e-6 * rate * (double)particles);
}

static double total_of(const BenchTable *table, const BenchResult *r)
{
    double sum = 0;
    for (int c = 0; table->columns[c].title; c++)
        sum += bench_table_value(table, r, c);
    return sum;
}

/* Prints the total over that of the same view and backend with the first number of substeps. */
static void print_ratio(const BenchTable *table, const BenchResult *results, const BenchResult *r, FILE *file)
{
    const int first = atoi(table->substeps[0]);
    for (const BenchResult *one = results; one <= r; one++)
        if (one->substeps == first && one->particles == r->particles && !*one->failure.message &&
            strcmp(one->view, r->view) == 0 && strcmp(one->backend, r->backend) == 0) {
            fprintf(file, " %9.2f", total_of(table, r) / total_of(table, one));
            return;
        }
    fprintf(file, " %9s", "-");
}

/* `results`: all, up to `r` at least. */
static void print_result(const BenchTable *table, const BenchResult *results, const BenchResult *r,
                         FILE *file)
{
    double values[BENCH_TABLE_COLUMNS];
    char text[OUTCOME_TEXT];
    const int columns = column_count(table);
    if (*r->failure.message) {
        fprintf(file, "%9zu %8s  %-9s %-22s %s\n", r->particles, "-", r->view, bench_table_row_name(table, r),
                outcome_text(&r->outcome, text));
        return;
    }
    for (int c = 0; c < columns; c++)
        values[c] = bench_table_value(table, r, c);
    fprintf(file, "%9zu %8d  %-9s %-22s", r->particles, r->substeps, r->view, bench_table_row_name(table, r));
    print_values(values, columns, true, file);
    if (table->percent)
        print_rate(r->render_ms > 0 ? 1e3 / r->render_ms : 0, r->particles, file);
    if (table->ratios)
        print_ratio(table, results, r, file);
    if (r->counts.counted)
        print_counts(table, r, file);
    fputc('\n', file);
}

/* Prints the published rows with the same particle count. The paper has one step per frame. */
static void print_published(const BenchTable *table, const Reference *reference, size_t particles, FILE *file)
{
    double values[BENCH_TABLE_COLUMNS];
    const int columns = column_count(table);
    for (int row = 0; row < reference->rows; row++) {
        if ((size_t)reference_number(reference, row, "particles") != particles)
            continue;
        for (int c = 0; c < columns; c++)
            values[c] =
                (table->percent ? 1 : 1e3) * reference_number(reference, row, table->columns[c].title);
        char label[64];
        snprintf(label, sizeof label, "%s, published", reference_text(reference, row, "engine"));
        fprintf(file, "%9zu %8s  %-9s %-22s", particles, table->percent ? "" : "1",
                table->view ? table->view : view_at(0)->name, label);
        print_values(values, columns, !table->percent, file);
        if (table->percent)
            print_rate(reference_number(reference, row, "rate"), particles, file);
        fputc('\n', file);
    }
}

/* Prints the published ratios, of a picture by raycasting. */
static void print_published_ratios(const BenchTable *table, const Reference *reference, FILE *file)
{
    for (int row = 0; row < reference->rows; row++) {
        char label[64];
        snprintf(label, sizeof label, "%s, published", reference_text(reference, row, "engine"));
        fprintf(file, "%9s %8s  %-9s %-22s", reference_text(reference, row, "particles"),
                reference_text(reference, row, "substeps"), "volume", label);
        for (int c = 0; table->columns[c].title; c++)
            fprintf(file, " %17s", "");
        fprintf(file, " %9s %9s\n", "", reference_text(reference, row, "ratio"));
    }
}

size_t bench_table_particles(const BenchTable *table, size_t scene)
{
    const char *asked = table->asked[scene] ? table->asked[scene] : table->particles[scene];
    return strtoul(asked, NULL, 10);
}

static size_t asked_for(const BenchTable *table, int group)
{
    return strtoul(table->particles[group], NULL, 10);
}

/* Returns the first result with figures, else the first result. */
static const BenchResult *any_measured(const BenchResult *results, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!*results[i].failure.message)
            return &results[i];
    return results;
}

bool bench_table_print(const BenchTable *table, const BenchResult *results, size_t count, FILE *file,
                       Error *error)
{
    Reference reference = {.rows = 0};
    const BenchResult *any = any_measured(results, count);
    if (table->reference && !reference_load(table->reference, &reference, error))
        return false;
    fprintf(file, "%s: %s\n", table->name, table->help);
    if (table->reference)
        fprintf(file, "published: %s\n", reference.notes);
    if (count > 0)
        fprintf(file, "here: %s; %s with %d thread%s; %d x %d; medians of %d frame%s, ms\n\n", any->renderer,
                bench_processor(), any->threads, plural((size_t)any->threads), any->width, any->height,
                any->frames, plural((size_t)any->frames));
    fprintf(file, "%9s %8s  %-9s %-22s", "particles", "substeps", "view",
            table->sweep ? strrchr(table->sweep, '.') + 1 : "backend");
    for (int c = 0; table->columns[c].title; c++)
        fprintf(file, " %17s", table->columns[c].title);
    fprintf(file, " %9s%s%s\n", "total",
            table->percent  ? "  frames/s  M part./s"
            : table->ratios ? "  of 1 step"
                            : "",
            count > 0 && any->counts.counted ? "   coverage  fragments a covered pixel" : "");
    size_t last = 0;
    int group = 0;
    if (table->ratios)
        print_published_ratios(table, &reference, file);
    for (size_t i = 0; i < count; i++) {
        if (table->reference && !table->ratios && (!table->scene || results[i].particles != last) &&
            table->particles[group] &&
            strcmp(results[i].view, table->view ? table->view : view_at(0)->name) == 0)
            print_published(table, &reference, asked_for(table, group++), file);
        last = results[i].particles;
        print_result(table, results, &results[i], file);
    }
    fputc('\n', file);
    return true;
}

/* The charts of published tables. */

enum { WIDTH = 820, HEIGHT = 380, LINES_MAX = 32, NAME = 96 }; /* px: the picture, its panel */

/* True if an earlier result has the same view and backend. */
static bool seen_before(const BenchResult *results, size_t at)
{
    for (size_t i = 0; i < at; i++)
        if (strcmp(results[i].view, results[at].view) == 0 &&
            strcmp(results[i].backend, results[at].backend) == 0)
            return true;
    return false;
}

static double share(const BenchTable *table, const BenchResult *r)
{
    const double all = total_of(table, r);
    return all > 0 ? 100 * bench_table_value(table, r, 0) / all : 0;
}

/* Draws the published shares of an engine. */
static void draw_published(const BenchTable *table, const Reference *reference, const char *engine, int point,
                           Plot *plot)
{
    char title[32];
    snprintf(title, sizeof title, "%s, published", engine);
    plot_series(plot, title, "with linespoints lw 2 dt 2 lc '#8795a3' pt %d", point);
    for (int row = 0; row < reference->rows; row++) {
        double all = 0;
        if (strcmp(reference_text(reference, row, "engine"), engine) != 0)
            continue;
        for (int c = 0; table->columns[c].title; c++)
            all += reference_number(reference, row, table->columns[c].title);
        plot_point(plot, reference_number(reference, row, "particles"),
                   100 * reference_number(reference, row, table->columns[0].title) / all);
    }
}

static void line_title(const BenchResult *result, char title[NAME])
{
    snprintf(title, NAME, "%s, %s", result->backend, result->view);
}

/* Draws a line for each view and backend. */
static void draw_shares(const BenchTable *table, const BenchResult *results, size_t count,
                        const Reference *reference, Plot *plot)
{
    fputs("set logscale x 2\nset yrange [0:100]\n", plot_commands(plot));
    plot_set(plot, "xlabel", "particles", "");
    plot_set(plot, "ylabel", "share of the frame that is simulation, %", "");
    draw_published(table, reference, "CPU", 4, plot);
    draw_published(table, reference, "GPU", 6, plot);
    for (size_t i = 0, line = 0; i < count && line < LINES_MAX; i++) {
        char title[NAME];
        if (seen_before(results, i))
            continue;
        line_title(&results[i], title);
        plot_series(plot, title, "with linespoints lw 2 lt %zu pt 7", ++line);
        for (size_t k = i; k < count; k++)
            if (!*results[k].failure.message && strcmp(results[k].view, results[i].view) == 0 &&
                strcmp(results[k].backend, results[i].backend) == 0)
                plot_point(plot, (double)results[k].particles, share(table, &results[k]));
    }
}

/* Fills in a bar's name: the differences between rows of the table. */
static void bar_name(const BenchTable *table, const BenchResult *r, char name[NAME])
{
    if (table->sweep)
        snprintf(name, NAME, "%s\\n%zu", bench_table_row_name(table, r), r->particles);
    else
        snprintf(name, NAME, "%s\\n%s\\n%d x %g s", r->backend, r->view, r->substeps, r->dt_substep);
}

/* Draws stacked bars, one per result. */
static void draw_times(const BenchTable *table, const BenchResult *results, size_t count, size_t bars,
                       Plot *plot)
{
    const char *titles[BENCH_TABLE_COLUMNS + 1] = {NULL};
    const int columns = column_count(table);
    for (int c = 0; c < columns; c++)
        titles[c] = table->columns[c].title;
    plot_set(plot, "ylabel", "time of a frame, ms", "");
    plot_bars(plot, titles, NULL, bars);
    for (size_t i = 0; i < count; i++) {
        const BenchResult *r = &results[i];
        double values[BENCH_TABLE_COLUMNS];
        char name[NAME];
        if (*r->failure.message)
            continue;
        for (int c = 0; c < columns; c++)
            values[c] = bench_table_value(table, r, c);
        bar_name(table, r, name);
        plot_bar(plot, values, name);
    }
}

/* Fills in the page of the chart: a legend of lines, or of columns beside bars with room for names. Returns
   the count of bars. */
static size_t make_page(const BenchTable *table, const BenchResult *results, size_t count, PlotPage *page)
{
    size_t bars = 0;
    double bar = 0;
    *page = (PlotPage){.width = WIDTH,
                       .height = HEIGHT,
                       .legend = table->shares ? plot_legend_width("GPU, published") : 0,
                       .lines = table->shares ? 2 : 3};
    for (int c = 0; c < column_count(table) && !table->shares; c++)
        page->legend = fmax(page->legend, plot_legend_width(table->columns[c].title));
    for (size_t i = 0; i < count; i++) {
        char name[NAME];
        line_title(&results[i], name);
        if (table->shares)
            page->legend = fmax(page->legend, plot_legend_width(name));
        bar_name(table, &results[i], name);
        bar = fmax(bar, plot_bar_width(name));
        bars += !*results[i].failure.message;
    }
    const int wide = (int)(bar * (double)(bars + 1) + page->legend) + 100;
    page->width = !table->shares && wide > WIDTH ? wide : WIDTH;
    return bars;
}

bool bench_table_draw(const BenchTable *table, const BenchResult *results, size_t count, const char *path,
                      Error *error)
{
    Reference reference = {.rows = 0};
    Plot plot = {.gnuplot = NULL};
    PlotPage page;
    const char *const titles[] = {table->help, count > 0 ? results[0].renderer : ""};
    const size_t bars = make_page(table, results, count, &page);
    if ((table->reference && !reference_load(table->reference, &reference, error)) ||
        !plot_begin_page(&plot, path, titles, 2, &page, error))
        return false;
    if (table->shares)
        draw_shares(table, results, count, &reference, &plot);
    else
        draw_times(table, results, count, bars, &plot);
    plot_draw(&plot, NULL);
    return plot_end(&plot, error);
}
