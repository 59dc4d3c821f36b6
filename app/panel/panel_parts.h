/* Internals of the panel: its sections, one file each. */
#ifndef SLOSH_PANEL_PARTS_H
#define SLOSH_PANEL_PARTS_H

#include "app/panel/panel.h"

enum { PANEL_SIM_COLOR = 0x4aa3c7ff, PANEL_UPLOAD_COLOR = 0x8f86c9ff };
#define PANEL_RENDER_COLOR 0xd99a4effU

/* stages.c: simulation compared with rendering, and each stage's share. */
void panel_stages(Ui *ui, const PanelData *data);

/* history.c: the last times between pictures, and of the solver's frames. */
void panel_history(Ui *ui, const PanelData *data);

/* plot.c: several values of each of `count` samples, over the last seconds. */
enum { PANEL_LINES_MAX = 3 };
typedef struct PanelPlot {
    const char *name;
    int count, lines;
    const char *line[PANEL_LINES_MAX]; /* label before the value */
    double least;                      /* upper bound of the range's low end */
    const void *of;                    /* callback argument; `at`: sample index; -1: bound of the range */
    double (*time)(const struct PanelPlot *plot, int at);
    double (*value)(const struct PanelPlot *plot, int at, int line); /* NaN: none */
    void (*text)(const struct PanelPlot *plot, int at, int line, double value, char out[48]);
} PanelPlot;
void panel_plot(Ui *ui, const PanelPlot *plot);

/* Formats 0.00123 kg as "1.23 g": at most four digits and a prefix. */
void panel_si_text(double value, const char *unit, char out[48]);

/* probes.c: readings of the scene's probes, one plot each; returns true if shown. */
bool panel_probes(Ui *ui, const PanelData *data);

/* gauges.c: density error, energy and Courant number over time; returns true if shown. */
bool panel_gauges(Ui *ui, const PanelData *data);

/* device.c: motion devices, if there are any. */
void panel_devices(Ui *ui, const PanelData *data, PanelEvents *events);

/* box.c: the size of the box. flow.c: a switch for each emitter and each drain. */
void panel_box(Ui *ui, const PanelData *data, PanelEvents *events);
void panel_flow(Ui *ui, const PanelData *data, PanelEvents *events);

/* again.c: the number of particles, and presets; fluid presets apply to fluid *fluid. */
void panel_again(Ui *ui, const PanelData *data, int *fluid, PanelEvents *events);

/* scene.c: keys of the shown view; meaning of colours; remaining live keys, grouped by the first part of
   their path. `start` is the scene when opened: sliders reach from a tenth to ten times the start value. */
void panel_view(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_colors(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_scene(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);

/* terms.c: a switch for each term of the scene's model at the start (app/scene/keys.h). */
void panel_terms(Ui *ui, const Scene *scene, const Scene *start, PanelEvents *events);

/* key.c: the widget of a live key, and its events. `base` and `start`: base addresses of the key's offset;
   `path`: with indices; `label`: text before the widget. */
typedef struct PanelKey {
    const struct Key *key;
    const void *base, *start;
    const char *path, *label;
    const double *range_now; /* for a range: its present values while automatic */
} PanelKey;
void panel_key(Ui *ui, const PanelKey *row, PanelEvents *events);

#endif
