/* A scene file, read and checked: plain data; its changes at run time; and notes for the user. */
#ifndef APP_SCENE_SCENE_H
#define APP_SCENE_SCENE_H

#include "app/run/measure/probe_def.h"
#include "render/frame/picture_def.h"
#include "render/panels.h"
#include "sim/flow/finger.h"
#include "slosh/def.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Notes for the user of a scene, which are not errors: settings without effect, changed settings, settings
   that will not hold. One line each, without repeats. */

enum { NOTES_MAX = 24, NOTE_SIZE = 400 };

typedef struct Notes {
    int count;
    int lasting;                     /* count of notes, at the front, that hold for any change at run time */
    char line[NOTES_MAX][NOTE_SIZE]; /* without a newline */
} Notes;

/* Adds a line; repeated lines are skipped, and beyond NOTES_MAX the last line reports that there are more.
   `notes` may be NULL: nothing happens. */
void notes_add(Notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool notes_have(const Notes *notes, const char *line);
void notes_print(const Notes *notes, FILE *file);

/* A scene file, read and checked: plain data.

   The file is YAML (DESIGN 8). One table of keys (app/scene/keys.h) has the place, unit, range and default of
   each key; the loader, `--set`, `info` and the documentation use this table. */

enum { SCENE_METRICS_MAX = 8 };

/* Purpose of reading a scene: some keys apply to some purposes only. */
typedef enum ScenePurpose {
    SCENE_FOR_ONE,    /* a command that does not change method, backend and view */
    SCENE_FOR_WINDOW, /* the window, where backend and view may change */
    SCENE_FOR_CHART
} ScenePurpose;

typedef struct Scene {
    char path[1024]; /* as found; used in messages */
    ScenePurpose purpose;
    char title[128];
    WorldDef world;
    ViewDef view;
    char beside[VIEW_SET_SIZE]; /* the `set` of the entry of `views` that this scene belongs to; "": none */
    int view_count;             /* count of pictures side by side; 0: one, `view` */
    ViewDef views[PANELS_MAX];  /* each is `view` with the changes of its entry */
    char preset[NAME_SIZE];     /* filled in the missing keys (app/scene/keys.h) */
    unsigned preset_filled;     /* bit k: the preset's setting k was filled in */
    bool realtime; /* the window follows the wall clock; otherwise it simulates as fast as possible */
    int metric_count;
    /* for `slosh chart`: indices into metric_kinds (app/run/measure/metric.h) */
    int metrics[SCENE_METRICS_MAX];
    ProbeList probes; /* unknown to the world */
    TouchDef touch;   /* unknown to the world; the window makes commands of touches */
} Scene;

enum { SCENE_SETTINGS_MAX = 64 };

/* Settings of the command line, applied on top of the file. */
typedef struct SceneSettings {
    int count;
    const char *set[SCENE_SETTINGS_MAX]; /* "path=value", in the given order; also from --backend, --method,
                                            --view, --threads */
    const char
        *said[SCENE_SETTINGS_MAX]; /* name in messages: "--backend cuda"; NULL: --set and the setting */
    const char *beside;            /* Scene.beside; NULL: "" */
    size_t particles;              /* --particles; 0: the scene's own spacing */
    ScenePurpose purpose;
    bool goes_on;  /* a resumed run: the tables of its start may be gone, and are read only for `particles` */
    bool recorded; /* a recorded run, not simulated: its start is unchecked, and only unused settings are
                      reported */
    const char
        *folder; /* of a recorded run: folder of the scene's files if not beside the scene; NULL: unknown */
} SceneSettings;

/* Length of the key of a setting, for replacement by a later setting: up to its '='; of a preset the whole
   text. */
size_t scene_setting_key(const char *setting);

/* Picture number `index` of the pictures side by side, from 0, and their count, at least 1. */
const ViewDef *scene_view(const Scene *scene, int index);
int scene_view_count(const Scene *scene);

/* True if the view shows states of this scene, not of a recorded run or of different settings. */
bool scene_shows(const Scene *scene, const ViewDef *view);

/* True if the view reads accelerations, which a world keeps if WorldDef.acceleration. */
bool scene_view_reads_acceleration(const ViewDef *view);

/* Reads, validates and fills `out`. Returns false on failure: `error` has "file:line:column: the fault; the
   remedy", or "--set path=value: ..." for a wrong command line. Creates nothing. `name` is a path, or the
   name of a file beside the sources of the program (scenes/box_slosh.yaml, box_slosh). `notes` (may be NULL)
   is emptied, then gets lines for the user: that --particles scaled dt, and the lines of scene_advise. */
bool scene_load(const char *name, SceneSettings *settings, Scene *out, Notes *notes, Error *error);

/* Loads the scene from `size` bytes in memory; pure except for the scene's tables (app/scene/scene_files.h);
   for tests and the fuzz target. */
bool scene_parse(const char *path, const char *bytes, size_t size, SceneSettings *settings, Scene *out,
                 Notes *notes, Error *error);

/* Changes a scene while the simulation runs: settings from the panel and from recorded commands. */

/* Sets a key that may change while the simulation runs (KEY_LIVE in app/scene/keys.h), in a scene that was
   read and checked: "gravity=[0, -3, 0]", "view.range=auto", "fluids[1].viscosity=0.2". Types, ranges, cross
   checks and messages ("--set path=value: ...") are those of `--set`. The camera's keys need a scene with a
   fixed camera. `concerns_world` (may be NULL) is set to true if a solver reads the key: then call
   world_change. Returns false with the reason: scene and *concerns_world are unchanged. */
bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error);

/* True if this machine can hold so many particles. */
bool scene_fits_memory(double particles);

/* Advice for the user: valid settings of a scene that have no effect or will not hold. */

struct YamlTree; /* app/scene/yaml/yaml.h */

/* Adds a line to `notes` for each such setting of a checked scene. `tree` is the source of the scene, for
   lines that begin with "file:line:column: ". A NULL tree, for keys changed at run time, gives lines that
   begin with the key's path. */
void scene_advise(const struct YamlTree *tree, const Scene *scene, Notes *notes);

/* Adds a line if a key set at run time has no effect. */
void scene_advise_key(const Scene *scene, const char *path, Notes *notes);

#endif
