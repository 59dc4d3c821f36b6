/* A scene file, read and checked: plain data.

   The file is YAML (DESIGN 8). One table of keys (app/scene/keys.h) has the place, unit, range and default of
   each key; the loader, `--set`, `info` and the documentation use this table. */
#ifndef SLOSH_SCENE_H
#define SLOSH_SCENE_H

#include "app/base/notes.h"
#include "app/probe/probe_def.h"
#include "render/frame/view_def.h"
#include "render/panels.h"
#include "sim/base/error.h"
#include "sim/matter/world_def.h"
#include "sim/touch/touch_def.h"

#include <stdbool.h>
#include <stddef.h>

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
    char preset[NAME_SIZE];     /* filled in the missing keys (app/scene/preset.h) */
    unsigned preset_filled;     /* bit k: the preset's setting k was filled in */
    bool realtime; /* the window follows the wall clock; otherwise it simulates as fast as possible */
    int metric_count;
    /* for `slosh chart`: indices into metric_kinds (app/metric/metric_list.h) */
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
bool scene_view_accelerates(const ViewDef *view);

/* Reads, validates and fills `out`. Returns false on failure: `error` has "file:line:column: the fault; the
   remedy", or "--set path=value: ..." for a wrong command line. Creates nothing. `name` is a path, or the
   name of a file beside the sources of the program (scenes/box_slosh.yaml, box_slosh). `notes` (may be NULL)
   is emptied, then gets lines for the user: that --particles scaled dt, and the lines of scene_advise. */
bool scene_load(const char *name, SceneSettings *settings, Scene *out, Notes *notes, Error *error);

/* Loads the scene from `size` bytes in memory; pure except for the scene's tables (app/scene/tables.h); for
   tests and the fuzz target. */
bool scene_parse(const char *path, const char *bytes, size_t size, SceneSettings *settings, Scene *out,
                 Notes *notes, Error *error);

#endif
