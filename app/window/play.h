/* The live window of `slosh play`: its report, the window itself, and the browser of scenes. */
#ifndef APP_WINDOW_PLAY_H
#define APP_WINDOW_PLAY_H

#include "app/cli/args/args.h"
#include "app/files/pictures.h"
#include "app/input/input.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "app/window/panel/panel.h"
#include "render/renderer.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

/* Report of a window session, as JSON and for people. */

/* Figures of a finished session. */
typedef struct PlayFigures {
    char scene[1024], renderer[256];
    int views, chosen_view;   /* count of shown views; panel of the view described below */
    char script[16];          /* script_name of a played recorded session */
    bool recorded;            /* no simulation: no figures of a solver */
    double times[PANELS_MAX]; /* of the state shown by each view, s */
    char view[NAME_SIZE], color_by[NAME_SIZE], colormap[NAME_SIZE], backend[NAME_SIZE], method[NAME_SIZE];
    char view_settings[4096]; /* JSON: present values of the view's keys, see scene_json */
    char readout[4096];       /* JSON: values under the mouse and at pins in the last picture */
    int width, height, threads, substeps;
    double dt;                          /* per frame, s; for mode cfl the mean */
    SolveFigures solved;                /* of the last scene, since its start */
    uint64_t limited[STEP_LIMIT_COUNT]; /* its steps, by limiting condition */
    size_t particles, pictures, scenes_opened;
    uint64_t step;              /* of the last state */
    double time;                /* of the last state, s */
    double simulated_s, wall_s; /* since the first picture, over all scenes and resets */
    double real_time_factor, pictures_per_second;
    double first_picture_ms;  /* since process start */
    double frame_ms;          /* mean time between pictures */
    double sim_ms, render_ms; /* means per frame of the solver, and per picture */
    double latency_median_ms, latency_p95_ms;
    size_t latency_events;
    size_t video_pictures; /* of the last video */
    uint64_t device_reports;
    double report_median_ms, report_p99_ms; /* from a motion device's report to its command */
    double panel_ms;                        /* mean CPU time of the panel per picture; 0: never shown */
    double events_ms;                       /* mean CPU time of event handling per picture */
    double cpus_busy;                       /* CPU time over wall time */
    double speed, display_scale;
    bool at_rest;       /* all requests are done and shown; nothing changes without user action */
    bool finer_to_come; /* the same picture will come in more detail */
    bool paused, fullscreen, camera_auto, panel, help, scenes;
    double box_size[3];                         /* of the last picture, m */
    double box_position[3], box_orientation[4]; /* the hand's part of the pose */
    double camera_from[3], camera_to[3];
    int gl_errors;
    Error failure; /* why the session ended early, if so; without renderer: before the window opened */
} PlayFigures;

/* Writes an object, with "error" for a failed session. Returns false with the reason if the file can't be
   written. */
bool play_figures_write_json(const PlayFigures *figures, const char *path, Error *error);

/* Writes an array, like every `bench --json`. */
bool play_figures_write_json_array(const PlayFigures *figures, size_t count, const char *path, Error *error);

/* Prints the figures of `bench --play`, and the limiting part. */
void play_figures_print(const PlayFigures *figures, FILE *file);

/* The live window: simulates a scene on a separate thread, draws the scene, and moves the box by hand. */

enum { PLAY_HISTORY_MIB = 256 }; /* of --past: over a minute of 8,000 particles (docs/labbook/window.md) */

typedef struct PlaySetup {
    const char *scene;
    const SceneSettings *settings; /* of that scene; scenes opened later use their files */
    int width, height;             /* of the window, in screen coordinates */
    const char *record;            /* file for the session at the end; or NULL */
    size_t history_bytes;          /* memory for states to go back to; 0: none */
    const Mapping *mapping;        /* of motion devices; NULL: devices are not used */
    const char *device;            /* --device, or NULL: the plugged in devices */
    double shake_seconds;          /* more than 0: a script shakes the box for that time, then all ends */
    const char *json;              /* file for the figures on SIGUSR1; NULL: standard error, for people */
    bool quiet;
} PlaySetup;

/* Runs until the user, a signal or the script ends the window. Returns the exit code; errors have been
   printed. */
int play(const PlaySetup *setup, PlayFigures *figures);

/* The scenes of a folder for choosing: name, title and idea. */

typedef struct SceneRow {
    char name[64]; /* file name without .yaml */
    char path[SCENE_PATH_SIZE];
    char title[128]; /* key `title`; without title the name */
    char idea[256];  /* first sentence of the file's head comment; "": none */
} SceneRow;

typedef struct SceneList {
    int count;
    SceneRow *rows; /* owned; ordered by name */
} SceneList;

/* The comment at the head of a scene's text, a paragraph a line; cut at `most` bytes, "" without comment. */
void scene_head(const char *text, size_t size, char *head, size_t most);

/* Lists the scenes of a folder; NULL: the scenes that come with slosh. Broken YAML files are listed too:
   opening the file shows the error. Returns false with the reason: no such folder, no memory, no scene. */
bool scene_list_read(const char *folder, SceneList *list, Error *error);
void scene_list_free(SceneList *list); /* a zeroed one is allowed */

/* Thumbnails: small pictures of scenes, for lists. */

enum { THUMBNAIL_WIDTH = 256, THUMBNAIL_HEIGHT = 144 };

/* Simulates the scene briefly with few particles, and draws its own view in the current context. The
   caller owns the image. Returns false with the reason: the scene is wrong, or cannot run here. */
bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error);

/* Makes the path of scene `name` in a folder of thumbnails; returns false if too long. */
bool thumbnail_path(const char *folder, const char *name, char path[1024]);

/* True if the thumbnail exists and is newer than the scene and the program. */
bool thumbnail_is_new(const char *thumbnail, const char *scene);

/* The scenes of the window's list, with pictures. A second process draws the pictures into the user's
   cache while the list is shown, so that the fluid in the window goes on. */

enum { BROWSER_FOLDERS = 2 };

/* Scenes of one folder. */
typedef struct BrowserFolder {
    SceneList list;
    char folder[1024]; /* of the scenes; "": the scenes that come with slosh */
    char cache[1024];  /* folder of their pictures; "": no pictures possible */
    bool made;         /* true once the second process was started */
} BrowserFolder;

/* Zero-initialise before use. */
typedef struct SceneBrowser {
    int count;
    PanelCard *cards; /* owned; cards of all shelves */
    int folder_count;
    BrowserFolder folders[BROWSER_FOLDERS];
    pid_t maker;      /* the second process; 0: none */
    double looked_ms; /* wall time of the last look for new pictures */
} SceneBrowser;

/* Lists the scenes beside the open scene, and the scenes that come with slosh. Returns false with the
   reason if there are no pictures or no list; call scene_browser_close in any case. All three functions need
   a current GL context. */
bool scene_browser_open(SceneBrowser *cards, const char *scene, Error *error);

/* Returns true if pictures have arrived since the last call. */
bool scene_browser_poll(SceneBrowser *cards);

void scene_browser_close(SceneBrowser *cards);

#endif
