/* Accuracy of the running simulation, as plots over the last seconds. */
#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>

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
