/* Readings of the scene's probes, over the last seconds. */
#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A probe's plot, whose lines may have different units. */
typedef struct ProbePlot {
    const PanelData *data;
    int first; /* index of its first number in a sample */
    ProbeColumn column[PROBE_SHOWN];
} ProbePlot;

static double time_of(const PanelPlot *plot, int at)
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
                      .time = time_of,
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
    for (int k = 0; k < list->count; k++)
        first += draw_probe(ui, data, &list->probe[k], first);
    return true;
}
