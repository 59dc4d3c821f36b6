/* Inside the panel: its sections, one file each. */
#ifndef SLOSH_PANEL_PARTS_H
#define SLOSH_PANEL_PARTS_H

#include "app/panel/panel.h"

enum { PANEL_SIM_COLOR = 0x4aa3c7ff, PANEL_UPLOAD_COLOR = 0x8f86c9ff };
#define PANEL_RENDER_COLOR 0xd99a4effU

/* stages.c: simulation against rendering, and each stage's share. */
void panel_stages(Ui *ui, const PanelData *data);

/* history.c: the last times from picture to picture, and of the solver's frames. */
void panel_history(Ui *ui, const PanelData *data);

/* plot.c: some numbers of each of `count` samples, over the last seconds. */
enum { PANEL_LINES_MAX = 3 };
typedef struct PanelPlot {
    const char *name;
    int count, lines;
    const char *line[PANEL_LINES_MAX]; /* what stands before its value */
    double least;                      /* that the range reaches from, at most */
    const void *of;                    /* for these, with the sample's place; -1 of a bound of the range */
    double (*time)(const struct PanelPlot *plot, int at);
    double (*value)(const struct PanelPlot *plot, int at, int line); /* NaN: none */
    void (*text)(const struct PanelPlot *plot, int at, int line, double value, char out[48]);
} PanelPlot;
void panel_plot(Ui *ui, const PanelPlot *plot);

/* 0.00123 kg as "1.23 g" would have it: at most four digits and a prefix. */
void panel_si_text(double value, const char *unit, char out[48]);

/* probes.c: what the scene's probes read, a plot each; whether they are shown. */
bool panel_probes(Ui *ui, const PanelData *data);

/* gauges.c: error of density, energy and Courant number over time; whether they are shown. */
bool panel_gauges(Ui *ui, const PanelData *data);

/* device.c: motion devices, while there are any. */
void panel_devices(Ui *ui, const PanelData *data, PanelEvents *events);

/* flow.c: a switch for each emitter and each drain. */
void panel_box(Ui *ui, const PanelData *data, PanelEvents *events);
void panel_flow(Ui *ui, const PanelData *data, PanelEvents *events);

/* again.c: the number of particles, and presets, of which those of fluids are for the one at *fluid. */
void panel_again(Ui *ui, const PanelData *data, int *fluid, PanelEvents *events);

/* scene.c: what the shown view reads; what colours mean; every other live key, by the first part of its path.
   `start` is the scene as it was opened: a slider reaches from a tenth to ten times the value there. */
void panel_view(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_colors(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);
void panel_scene(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events);

/* terms.c: a switch for each term of the model that the scene had at its start (app/term/term.h). */
void panel_terms(Ui *ui, const Scene *scene, const Scene *start, PanelEvents *events);

/* key.c: the widget of a live key, and what it asks for. `base` and `start` are what the key's offset
   counts from; `path` is its path with indices, `label` what stands before it. */
typedef struct PanelKey {
    const struct Key *key;
    const void *base, *start;
    const char *path, *label;
    const double *range_now; /* for a range: what it is while automatic */
} PanelKey;
void panel_key(Ui *ui, const PanelKey *row, PanelEvents *events);

#endif
