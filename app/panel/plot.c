/* Plots of numbers over time. */
#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>

static const uint32_t INK = 0xe4e9eeff, FAINT = 0x8e9ba8ff, GROUND = 0x1e252cff;
static const uint32_t colors[PANEL_LINES_MAX] = {0x4aa3c7ff, 0xd99a4eff, 0xe4e9eeff};

/* Formats 0.00123 kg as "1.23 g": at most four digits and a prefix. */
void panel_si_text(double value, const char *unit, char out[48])
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

void panel_plot(Ui *ui, const PanelPlot *plot)
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
