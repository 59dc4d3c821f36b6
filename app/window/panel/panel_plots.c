/* Plots of numbers over time. */
#include "app/window/panel/panel_private.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint32_t INK = 0xe4e9eeff, FAINT = 0x8e9ba8ff, GROUND = 0x1e252cff;
static const uint32_t colors[PANEL_LINES_MAX] = {0x4aa3c7ff, 0xd99a4eff, 0xe4e9eeff};

/* Formats 0.00123 kg as "1.23 g": at most four digits and a prefix. */
static void panel_si_text(double value, const char *unit, char out[48])
{
    static const char *const prefixes[] = {"n", "µ", "m", "", "k", "M", "G", "T"};
    const double size = fabs(value);
    int p = 3;
    if (size < 1e-9) {
        snprintf(out, 48, "0 %s", unit);
        return;
    }
    if (!isfinite(size) || size >= 1e15) {
        snprintf(out, 48, "%.3g %s", value, unit);
        return;
    }
    p += (int)floor(log10(size * (1 + 1e-4)) / 3);
    p = p < 0 ? 0 : p > 7 ? 7 : p;
    snprintf(out, 48, "%.3g %s%s", value * pow(10, -3 * (p - 3)), prefixes[p], unit);
}

static void range_of(const PanelPlot *plot, double range[2])
{
    range[0] = plot->least;
    range[1] = -INFINITY;
    for (int i = 0; i < plot->count; i++)
        for (int l = 0; l < plot->lines; l++) {
            const double value = plot->value(plot, i, l);
            range[0] = fmin(range[0], value); /* fmin skips NaN */
            range[1] = fmax(range[1], value);
        }
    if (!isfinite(range[0]))
        range[0] = 0;
    if (!(range[1] > range[0]) || !isfinite(range[1] - range[0]))
        range[1] = range[0] + 1;
}

/* Writes a head such as "0 to 1.2 %, last 6.0 s". */
static void draw_head(Ui *ui, const PanelPlot *plot, const double range[2])
{
    char low[48], high[48], text[160] = "no values yet";
    plot->text(plot, -1, 0, range[0], low);
    plot->text(plot, -1, 0, range[1], high);
    if (plot->count > 0)
        snprintf(text, sizeof text, "%s to %s, last %.3g s", low, high,
                 plot->time(plot, plot->count - 1) - plot->time(plot, 0));
    ui_row(ui, plot->name, text);
}

/* Writes names and values in the colours of their lines, several per row if they fit; returns the count of
   rows. */
static int draw_values(Ui *ui, const PanelPlot *plot, int sample, const float *rect, float width)
{
    const float em = ui_pixels(ui);
    float x = 0;
    int rows = 1;
    for (int l = 0; l < PANEL_LINES_MAX && l < plot->lines; l++) {
        char value[48], text[96];
        plot->text(plot, sample, l, plot->value(plot, sample, l), value);
        snprintf(text, sizeof text, "%s%s%s", plot->line[l], *plot->line[l] ? " " : "", value);
        const float wide = ui_words_width(ui, text);
        if (x > 0 && x + wide > width) {
            x = 0;
            rows++;
        }
        if (rect)
            ui_words(ui, rect[0] + x, rect[1] + 1.3F * em * (float)(rows - 1), colors[l], text);
        x += wide + em;
    }
    return rows;
}

/* Draws one step per sample, newest at the right. */
static void draw_line(Ui *ui, const PanelPlot *plot, int line, const float rect[4], const double range[2])
{
    const float thick = fmaxf(floorf(ui_pixels(ui) / 9), 1), width = rect[2] - rect[0],
                height = rect[3] - rect[1] - thick;
    float before = -1;
    for (int i = 0; i < plot->count; i++) {
        const double share = (plot->value(plot, i, line) - range[0]) / (range[1] - range[0]);
        if (!isfinite(share))
            continue;
        const float y = rect[3] - thick - floorf((float)share * height);
        const float x0 = floorf(rect[0] + width * (float)i / (float)plot->count),
                    x1 = floorf(rect[0] + width * (float)(i + 1) / (float)plot->count);
        if (before >= 0 && before != y)
            ui_fill(ui, x0, fminf(before, y), fminf(x0 + thick, x1), fmaxf(before, y) + thick, colors[line]);
        ui_fill(ui, x0, y, x1, y + thick, colors[line]);
        before = y;
    }
}

/* Draws a hair line and the time of the sample under the mouse; returns its index, or the newest sample
   without mouse. */
static int draw_pointed(Ui *ui, const PanelPlot *plot, const float rect[4])
{
    float x;
    char text[48];
    if (!ui_mouse_in(ui, rect, &x))
        return plot->count - 1;
    const int at = (int)((x - rect[0]) / (rect[2] - rect[0]) * (float)plot->count);
    const int sample = at < plot->count ? at : plot->count - 1;
    snprintf(text, sizeof text, "at %.4g s", plot->time(plot, sample));
    ui_fill(ui, floorf(x), rect[1], floorf(x) + 1, rect[3], FAINT);
    const float wide = ui_words_width(ui, text), em = ui_pixels(ui);
    ui_words(ui, x + 0.4F * em + wide < rect[2] ? x + 0.4F * em : x - 0.4F * em - wide, rect[1], INK, text);
    return sample;
}

static void panel_plot(Ui *ui, const PanelPlot *plot)
{
    static const float LINE_EM = 1.3F, HIGH_EM = 3.2F;
    float rect[4], values[4];
    double range[2];
    range_of(plot, range);
    draw_head(ui, plot, range);
    if (plot->count == 0)
        return;
    const bool shown = ui_area(ui, HIGH_EM, rect);
    int sample = plot->count - 1;
    if (shown) {
        ui_fill(ui, rect[0], rect[1], rect[2], rect[3], GROUND);
        for (int l = 0; l < plot->lines; l++)
            draw_line(ui, plot, l, rect, range);
        sample = draw_pointed(ui, plot, rect);
    }
    const int rows = draw_values(ui, plot, sample, NULL, rect[2] - rect[0]);
    if (ui_area(ui, LINE_EM * (float)rows, values))
        draw_values(ui, plot, sample, values, values[2] - values[0]);
}

enum { STAGE_INK = (int)0xe4e9eeffU, STAGE_FAINT = (int)0x8e9ba8ffU, TRACK = 0x252d36ff };

static const float LINE_EM = 1.4F;

static uint32_t color_of(StagePart part)
{
    switch (part) {
    case PART_SIM:
        return PANEL_SIM_COLOR;
    case PART_UPLOAD:
        return PANEL_UPLOAD_COLOR;
    case PART_RENDER:
        break;
    }
    return PANEL_RENDER_COLOR;
}

/* A line: a bar whose length is relative to the longest. */
typedef struct StageLine {
    const char *name;
    double ms, share; /* of the total */
    StagePart part;
} StageLine;

/* Collects the stages that ran; simulation or rendering get a single line if their stages are unknown. */
static int gather(const PanelData *data, StageLine lines[STAGE_COUNT + 1], double *all)
{
    int count = 0;
    *all = 0;
    for (int i = 0; i < STAGE_COUNT; i++) {
        const StagePart part = stage_part(i);
        if (data->stage_ran[i] && (part != PART_RENDER || data->render_stages_known))
            lines[count++] = (StageLine){.name = stage_name(i), .ms = data->stage_ms[i], .part = part};
    }
    if (count == 0 && data->sim_ms > 0)
        lines[count++] = (StageLine){.name = "all simulation", .ms = data->sim_ms, .part = PART_SIM};
    if (!data->render_stages_known)
        lines[count++] = (StageLine){.name = "all rendering", .ms = data->render_ms, .part = PART_RENDER};
    for (int i = 0; i < count; i++)
        *all += lines[i].ms;
    return count;
}

/* Draws one bar, divided between simulation and rendering. */
static void draw_balance(Ui *ui, const PanelData *data)
{
    const double all = data->sim_ms + data->render_ms, share = all > 0 ? data->sim_ms / all : 0.5;
    char sim[48], render[48];
    float rect[4];
    snprintf(sim, sizeof sim, "simulation %.1f ms", data->sim_ms);
    snprintf(render, sizeof render, "rendering %.1f ms", data->render_ms);
    if (!ui_area(ui, 2, rect))
        return;
    const float middle = floorf(rect[0] + (float)share * (rect[2] - rect[0]));
    const float bottom = rect[3] - 0.25F * ui_pixels(ui), top = bottom - floorf(0.4F * ui_pixels(ui));
    ui_fill(ui, rect[0], top, middle, bottom, PANEL_SIM_COLOR);
    ui_fill(ui, middle, top, rect[2], bottom, PANEL_RENDER_COLOR);
    ui_words(ui, rect[0], rect[1], PANEL_SIM_COLOR, sim);
    ui_words(ui, rect[2] - ui_words_width(ui, render), rect[1], PANEL_RENDER_COLOR, render);
}

static void draw_stage(Ui *ui, const StageLine *line, double longest, double all, const float rect[4],
                       float y)
{
    const float em = ui_pixels(ui), left = rect[0] + 7.5F * em, right = rect[2] - 8.2F * em;
    const float top = floorf(y + 0.25F * em), bottom = floorf(y + 0.8F * em);
    char ms[24], share[16];
    snprintf(ms, sizeof ms, "%.2f ms", line->ms);
    snprintf(share, sizeof share, "%.0f %%", all > 0 ? 100 * line->ms / all : 0);
    const float length = longest > 0 ? (float)(line->ms / longest) * (right - left) : 0;
    ui_words(ui, rect[0], y, (uint32_t)STAGE_INK, line->name);
    ui_fill(ui, left, top, right, bottom, TRACK);
    ui_fill(ui, left, top, left + fmaxf(length, 1), bottom, color_of(line->part));
    ui_words(ui, rect[2] - 3.2F * em - ui_words_width(ui, ms), y, (uint32_t)STAGE_INK, ms);
    ui_words(ui, rect[2] - ui_words_width(ui, share), y, (uint32_t)STAGE_FAINT, share);
}

/* The driver's calls, named as in bench's JSON. */
typedef struct CallsLine {
    const char *name;
    const GlCalls *of;
} CallsLine;

static void draw_calls_line(Ui *ui, const CallsLine *line, const float rect[4], float y)
{
    static const char *const names[] = {"calls", "dispatches", "waits", "readbacks"};
    const uint64_t counts[] = {line->of ? line->of->calls : 0, line->of ? line->of->dispatches : 0,
                               line->of ? line->of->waits : 0, line->of ? line->of->readbacks : 0};
    const float em = ui_pixels(ui), left = rect[0] + 5 * em;
    ui_words(ui, rect[0], y, (uint32_t)STAGE_INK, line->name);
    for (int k = 0; k < 4; k++) {
        char words[24];
        snprintf(words, sizeof words, "%" PRIu64, counts[k]);
        const char *shown = line->of ? words : names[k];
        const float right = left + (rect[2] - left) * (float)(k + 1) / 4;
        ui_words(ui, right - ui_words_width(ui, shown), y, (uint32_t)(line->of ? STAGE_INK : STAGE_FAINT),
                 shown);
    }
}

static void draw_calls(Ui *ui, const PanelData *data)
{
    CallsLine lines[3] = {{"GPU", NULL}};
    int count = 1;
    float rect[4];
    if (data->substep_calls.calls > 0)
        lines[count++] = (CallsLine){"substep", &data->substep_calls};
    if (data->picture_calls.calls > 0)
        lines[count++] = (CallsLine){"picture", &data->picture_calls};
    if (count == 1 || !ui_area(ui, LINE_EM * (float)count, rect))
        return;
    for (int i = 0; i < count; i++)
        draw_calls_line(ui, &lines[i], rect, rect[1] + LINE_EM * ui_pixels(ui) * (float)i);
}

void panel_stages(Ui *ui, const PanelData *data)
{
    StageLine lines[STAGE_COUNT + 1];
    double all, longest = 0;
    float rect[4];
    if (!ui_section(ui, "Stages", false))
        return;
    draw_balance(ui, data);
    const int count = gather(data, lines, &all);
    for (int i = 0; i < count; i++)
        longest = fmax(longest, lines[i].ms);
    if (ui_area(ui, LINE_EM * (float)count, rect))
        for (int i = 0; i < count; i++)
            draw_stage(ui, &lines[i], longest, all, rect, rect[1] + LINE_EM * ui_pixels(ui) * (float)i);
    draw_calls(ui, data);
}

/* Values of a plot, and the line across. */
typedef struct Plot {
    const char *name;
    const float *ms;
    int count;
    double mark_ms;
    const char *mark; /* meaning of the line */
    uint32_t color;
} Plot;

/* Draws one column per value, newest at the right. */
static void draw_columns(Ui *ui, const Plot *plot, const float rect[4], double top_ms)
{
    const float width = rect[2] - rect[0], height = rect[3] - rect[1];
    for (int i = 0; i < plot->count; i++) {
        const float share = (float)fmin(plot->ms[i] / top_ms, 1);
        const float x0 = floorf(rect[0] + width * (float)i / (float)plot->count);
        const float x1 = floorf(rect[0] + width * (float)(i + 1) / (float)plot->count);
        ui_fill(ui, x0, rect[3] - fmaxf(floorf(share * height), 1), x1, rect[3],
                (plot->color & ~0xffU) | 0xa0);
    }
}

static void draw_mark(Ui *ui, const Plot *plot, const float rect[4], double top_ms)
{
    const float em = ui_pixels(ui);
    const float y = floorf(rect[3] - (float)(plot->mark_ms / top_ms) * (rect[3] - rect[1]));
    char text[64];
    snprintf(text, sizeof text, "%.4g ms: %s", plot->mark_ms, plot->mark);
    if (ui_words_width(ui, text) > rect[2] - rect[0] - 0.3F * em)
        snprintf(text, sizeof text, "%.4g ms", plot->mark_ms);
    ui_fill(ui, rect[0], y, rect[2], y + fmaxf(floorf(em / 13), 1), 0xe4e9ee80);
    ui_words(ui, rect[0] + 0.3F * em, y - 1.15F * em > rect[1] ? y - 1.15F * em : y + 0.1F * em, 0xe4e9eec0,
             text);
}

static void draw_plot(Ui *ui, const Plot *plot)
{
    float low = INFINITY, high = 0, rect[4];
    char text[96] = "no values yet";
    for (int i = 0; i < plot->count; i++) {
        low = fminf(low, plot->ms[i]);
        high = fmaxf(high, plot->ms[i]);
    }
    if (plot->count > 0)
        snprintf(text, sizeof text, "%.1f ms, %.1f to %.1f", (double)plot->ms[plot->count - 1], (double)low,
                 (double)high);
    ui_row(ui, plot->name, text);
    if (!ui_area(ui, 3.6F, rect))
        return;
    const double top_ms = fmax(high, 1.6 * plot->mark_ms);
    ui_fill(ui, rect[0], rect[1], rect[2], rect[3], 0x1e252cff);
    draw_columns(ui, plot, rect, top_ms);
    draw_mark(ui, plot, rect, top_ms);
}

void panel_history(Ui *ui, const PanelData *data)
{
    const Plot pictures = {.name = "picture to picture",
                           .ms = data->frame_history,
                           .count = data->frame_count,
                           .mark_ms = 1000.0 / 60,
                           .mark = "60 a second",
                           .color = PANEL_RENDER_COLOR};
    const Plot frames = {.name = "solver's frame",
                         .ms = data->step_history,
                         .count = data->step_count,
                         .mark_ms = 1000 * data->scene->world.dt / fmax(data->speed, 1e-6),
                         .mark = "what the pace allows",
                         .color = PANEL_SIM_COLOR};
    if (!ui_section(ui, "History", false))
        return;
    draw_plot(ui, &pictures);
    draw_plot(ui, &frames);
}

/* Accuracy of the running simulation, as plots over the last seconds. */

static const GaugeSample *sample_of(const PanelPlot *plot, int at)
{
    const PanelData *data = plot->of;
    return &data->gauges[at];
}

static double time_of(const PanelPlot *plot, int at)
{
    return sample_of(plot, at)->gauge.time;
}

static double density_value(const PanelPlot *plot, int at, int line)
{
    const GaugeSample *sample = sample_of(plot, at);
    return line == 0 ? sample->gauge.density_error_mean : sample->gauge.density_error_max;
}

static void density_text(const PanelPlot *plot, int at, int line, double value, char out[48])
{
    (void)plot, (void)at, (void)line;
    snprintf(out, 48, "%.3g %%", 100 * value);
}

static double energy_value(const PanelPlot *plot, int at, int line)
{
    const GaugeSample *sample = sample_of(plot, at);
    const WorldGauge *g = &sample->gauge;
    return line == 0   ? g->kinetic_energy
           : line == 1 ? g->potential_energy
                       : g->kinetic_energy + g->potential_energy + g->compression_energy;
}

static void energy_text(const PanelPlot *plot, int at, int line, double value, char out[48])
{
    (void)plot, (void)at, (void)line;
    panel_si_text(value, "J", out);
}

static double courant_value(const PanelPlot *plot, int at, int line)
{
    const GaugeSample *sample = sample_of(plot, at);
    (void)line;
    return sample->courant;
}

static void courant_text(const PanelPlot *plot, int at, int line, double value, char out[48])
{
    const GaugeSample *sample = at >= 0 ? sample_of(plot, at) : NULL;
    (void)line;
    if (sample)
        snprintf(out, 48, "%.3g, bounded by %s", value,
                 sample->limit == STEP_LIMIT_DT ? "the fixed dt" : step_limit_name(sample->limit));
    else
        snprintf(out, 48, "%.3g", value);
}

static PanelPlot gauges_of(const PanelData *data, const char *name)
{
    return (PanelPlot){.name = name, .of = data, .count = data->gauge_count, .time = time_of};
}

bool panel_gauges(Ui *ui, const PanelData *data)
{
    if (!ui_section(ui, "Accuracy", false))
        return false;
    const bool total = data->gauge_count > 0 && data->gauges[data->gauge_count - 1].gauge.total_known;
    PanelPlot density = gauges_of(data, "density error"), energy = gauges_of(data, "energy"),
              courant = gauges_of(data, "Courant number");
    density.lines = 2;
    density.line[0] = "mean";
    density.line[1] = "max";
    density.value = density_value;
    density.text = density_text;
    energy.lines = total ? 3 : 2;
    energy.line[0] = "kinetic";
    energy.line[1] = "potential";
    energy.line[2] = "total";
    energy.value = energy_value;
    energy.text = energy_text;
    courant.lines = 1;
    courant.line[0] = "";
    courant.value = courant_value;
    courant.text = courant_text;
    panel_plot(ui, &density);
    panel_plot(ui, &energy);
    panel_plot(ui, &courant);
    return true;
}

/* Readings of the scene's probes, over the last seconds. */

/* A probe's plot, whose lines may have different units. */
typedef struct ProbePlot {
    const PanelData *data;
    int first; /* index of its first number in a sample */
    ProbeColumn column[PROBE_SHOWN];
} ProbePlot;

static double probe_time(const PanelPlot *plot, int at)
{
    const ProbePlot *own = plot->of;
    return own->data->probes[at].time;
}

static double value_of(const PanelPlot *plot, int at, int line)
{
    const ProbePlot *own = plot->of;
    return (double)own->data->probes[at].value[own->first + line];
}

static void text_of(const PanelPlot *plot, int at, int line, double value, char out[48])
{
    const ProbePlot *own = plot->of;
    (void)at;
    const char *unit = own->column[line].unit;
    assert(unit);
    if (isnan(value))
        snprintf(out, 48, "%s", *unit == 'N' ? "not known" : "dry");
    else if (strcmp(unit, "kg/m3") == 0)
        snprintf(out, 48, "%.5g kg/m3", value);
    else
        panel_si_text(value, unit, out);
}

/* Draws a probe's plot; only the columns with the first column's unit, as a plot has one range. Returns
   the count of the probe's numbers in a sample. */
static int draw_probe(Ui *ui, const PanelData *data, const ProbeDef *def, int first)
{
    ProbePlot own = {.data = data, .first = first};
    int index[PROBE_SHOWN];
    const int shown = probe_shown(def, index);
    PanelPlot plot = {.name = def->name,
                      .count = data->probe_count,
                      .least = INFINITY,
                      .of = &own,
                      .time = probe_time,
                      .value = value_of,
                      .text = text_of};
    for (int k = 0; k < shown; k++) {
        probe_column(def, index[k], &own.column[k]);
        plot.line[k] = own.column[k].name + strlen(def->name) + 1;
        plot.lines += plot.lines == k && strcmp(own.column[k].unit, own.column[0].unit) == 0;
    }
    panel_plot(ui, &plot);
    return shown;
}

bool panel_probes(Ui *ui, const PanelData *data)
{
    const ProbeList *list = &data->scene->probes;
    int first = 0;
    if (list->count == 0 || !ui_section(ui, "Probes", true))
        return false;
    for (int k = 0; k < list->count && k < PROBES_PLOTTED; k++)
        first += draw_probe(ui, data, &list->probe[k], first);
    if (list->count > PROBES_PLOTTED) {
        char more[64];
        snprintf(more, sizeof more, "and %d more: slosh run --probes", list->count - PROBES_PLOTTED);
        ui_text(ui, more);
    }
    return true;
}

/* The motion devices: present values, their effects, and gains. */

static const float BAR_LETTERS = 1.35F, BAR_LEFT = 0.34F, BAR_RIGHT = 0.66F; /* of the width */

/* A value as a bar from the middle, between its name and its effect. */
typedef struct Bar {
    const char *name, *does;
    double value; /* -1 .. 1 */
    double dead;  /* width of the dead zone around the middle */
} Bar;

static void draw_bar(Ui *ui, const Bar *bar)
{
    float rect[4];
    if (!ui_area(ui, BAR_LETTERS, rect))
        return;
    const float em = ui_pixels(ui), width = rect[2] - rect[0];
    const float gap = floorf(0.5F * em), does = ceilf(ui_words_width(ui, bar->does)) + gap;
    const float left =
        fmaxf(floorf(rect[0] + BAR_LEFT * width), rect[0] + ceilf(ui_words_width(ui, bar->name)) + gap);
    const float right = fmaxf(fminf(floorf(rect[0] + BAR_RIGHT * width), rect[2] - does), left + 1);
    const float middle = floorf((left + right) / 2), half = (right - left) / 2;
    const float top = rect[1] + floorf(0.15F * em), bottom = rect[3] - floorf(0.15F * em);
    const float end = middle + floorf(half * (float)fmax(fmin(bar->value, 1), -1));
    const float dead = floorf(half * (float)bar->dead);
    const bool alive = fabs(bar->value) > bar->dead;
    ui_words(ui, rect[0], rect[1], 0xe4e9eeff, bar->name);
    ui_fill(ui, left, top, right, bottom, 0x1e252cff);
    ui_fill(ui, middle - dead, top, middle + dead, bottom, 0x2b343dff);
    ui_fill(ui, fminf(middle, end), top, fmaxf(middle + 1, end), bottom,
            alive ? PANEL_SIM_COLOR : 0x6b7782ffU);
    ui_words(ui, right + gap, rect[1], 0xe4e9eec0, bar->does);
}

/* Turns "left_x" into "left x", after an arrow or nothing. */
static void plain_words(const char *before, const char *name, char text[32])
{
    snprintf(text, 32, "%s%s", before, name);
    for (char *c = text; *c; c++)
        if (*c == '_')
            *c = ' ';
}

static void draw_axes(Ui *ui, const BoxControlDevice *device)
{
    for (int i = 0; i < MAPPING_AXES; i++) {
        const AxisMap *row = &device->map.axes[i];
        char name[32], does[32] = "";
        plain_words("", mapping_axis_name(device->family, i), name);
        if (row->to != MAP_NOTHING)
            plain_words(row->invert ? "→ - " : "→ ", mapping_to_name(row->to), does);
        draw_bar(ui, &(Bar){name, does, device->axes[i], device->map.dead_zone});
    }
}

/* Shows the turn since the neutral pose as a rotation vector; a quarter turn fills a bar. */
static void draw_pose(Ui *ui, const BoxControlDevice *device)
{
    const double *q = device->turned;
    const double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), side = q[3] < 0 ? -1 : 1;
    const double angle = 2 * atan2(sine, side * q[3]);
    for (int k = 0; k < 3 && device->has_pose; k++) {
        const double part = sine > 0 ? side * angle * q[k] / sine : 0;
        char name[32];
        snprintf(name, sizeof name, "turned, %c", "xyz"[k]);
        draw_bar(ui, &(Bar){name, device->map.pose ? "→ box" : "", part / (M_PI / 2), 0});
    }
}

/* Shows the tilt from gravity alone, independent of the neutral pose. */
static void draw_tilt(Ui *ui, const BoxControlDevice *device)
{
    char text[64];
    const double tilt = acos(fmax(fmin(-device->down[1], 1), -1)) * 180 / M_PI;
    snprintf(text, sizeof text, "%.0f° from level%s", tilt, device->resting ? ", at rest" : "");
    if (device->has_pose)
        ui_row(ui, "tilt", text);
}

static void draw_sliders(Ui *ui, const BoxControlDevice *device, PanelEvents *events)
{
    static const UiScale gains = {.low = 0, .high = 3, .least = 0, .most = 10, .unit = ""};
    static const UiScale zones = {.low = 0, .high = 0.5, .least = 0, .most = 0.9, .unit = ""};
    double gain = device->map.gain, zone = device->map.dead_zone;
    char id[2][32];
    snprintf(id[0], sizeof id[0], "device %d gain", device->number);
    snprintf(id[1], sizeof id[1], "device %d dead zone", device->number);
    const UiField gain_field = {id[0], "gain", "of all its axes and its pose\nCtrl + click to type a number"};
    const UiField zone_field = {id[1], "dead zone",
                                "so much of an axis's way does nothing\nCtrl + click to type a number"};
    const bool changed = ui_sliders(ui, &gain_field, &gain, 1, &gains);
    if (ui_sliders(ui, &zone_field, &zone, 1, &zones) || changed) {
        events->tuned = device->number;
        events->gain = gain;
        events->dead_zone = zone;
    }
}

static void draw_device(Ui *ui, const BoxControlDevice *device, PanelEvents *events)
{
    char text[sizeof device->name + sizeof device->problem + 4];
    if (device->problem[0]) {
        snprintf(text, sizeof text, "%s: %s", device->name, device->problem);
        ui_warning(ui, text);
        return;
    }
    ui_text(ui, device->name);
    draw_axes(ui, device);
    draw_pose(ui, device);
    draw_tilt(ui, device);
    draw_sliders(ui, device, events);
}

void panel_devices(Ui *ui, const PanelData *data, PanelEvents *events)
{
    if (data->device_count == 0 || !ui_section(ui, "Motion device", true))
        return;
    for (int i = 0; i < data->device_count; i++)
        draw_device(ui, &data->devices[i], events);
}
