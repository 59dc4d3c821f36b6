/* Internals of the panel: its sections. Keys, switches and sizes are in
   panel_keys.c, plots and figures in panel_plots.c. */
#ifndef APP_WINDOW_PANEL_PANEL_PRIVATE_H
#define APP_WINDOW_PANEL_PANEL_PRIVATE_H

#include "app/window/panel/panel.h"

enum { PANEL_SIM_COLOR = 0x4aa3c7ff, PANEL_UPLOAD_COLOR = 0x8f86c9ff };
#define PANEL_RENDER_COLOR 0xd99a4effU

/* Simulation compared with rendering, and each stage's share. */
void panel_stages(Ui *ui, const PanelData *data);

/* The last times between pictures, and of the solver's frames. */
void panel_history(Ui *ui, const PanelData *data);

/* Several values of each of `count` samples, over the last seconds. */
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

/* Readings of the scene's probes, one plot each; returns true if shown. */
bool panel_probes(Ui *ui, const PanelData *data);

/* Density error, energy and Courant number over time; returns true if shown. */
bool panel_gauges(Ui *ui, const PanelData *data);

/* Motion devices, if there are any. */
void panel_devices(Ui *ui, const PanelData *data, PanelEvents *events);

/* The size of the box; a switch for each emitter and each drain. */
void panel_box(Ui *ui, const PanelData *data, PanelEvents *events);
void panel_flow(Ui *ui, const PanelData *data, PanelEvents *events);

/* What one plays with: gravity, viscosities, the number of particles, and presets; fluid presets apply to
   fluid *fluid. */
void panel_play(Ui *ui, const PanelData *data, const Scene *start, int *fluid, PanelEvents *events);

/* Keys of the shown view; meaning of colours; remaining live keys, grouped by the first part of
   their path. `start` is the scene when opened: sliders reach from a tenth to ten times the start value. */
void panel_view(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_colors(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_scene(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);

/* A switch for each term of the scene's model at the start (app/scene/scene.h). */
void panel_terms(Ui *ui, const Scene *scene, const Scene *start, PanelEvents *events);

/* The widget of a live key, and its events. `base` and `start`: base addresses of the key's offset;
   `path`: with indices; `label`: text before the widget. */
typedef struct PanelKey {
    const struct Key *key;
    int element; /* of the list around the key, or 0 */
    const void *base, *start;
    const char *path, *label;
    const double *range_now; /* for a range: its present values while automatic */
} PanelKey;

#endif
