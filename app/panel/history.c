#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>

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
