/* A scene file, read and checked: plain data.

   The file is YAML (DESIGN 8). One table of keys (app/scene/keys.h) says what may stand where, in which unit,
   range and with which default; the loader, `--set`, `info` and the documentation are made from it. */
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

/* What a scene is read for: some of its keys are for some of these only. */
typedef enum ScenePurpose {
    SCENE_FOR_ONE,    /* a command that leaves method, backend and view as they are */
    SCENE_FOR_WINDOW, /* backend and view may change while it runs */
    SCENE_FOR_CHART
} ScenePurpose;

typedef struct Scene {
    char path[1024]; /* as found; what messages name */
    ScenePurpose purpose;
    char title[128];
    WorldDef world;
    ViewDef view;
    char beside[VIEW_SET_SIZE]; /* the `set` of the entry of `views` that this is the scene of; "": of none */
    int view_count;             /* of the pictures beside each other; 0: one, which is `view` */
    ViewDef views[PANELS_MAX];  /* each is `view` but for what its entry says */
    char preset[NAME_SIZE]; /* what filled in the keys that the scene does not name (app/scene/preset.h) */
    unsigned preset_filled; /* which of the preset's settings, a bit each */
    bool
        realtime; /* the window simulates as many frames as the wall clock asks for, else as many as it can */
    int metric_count;
    /* what `slosh chart` compares: places in metric_kinds (app/metric/metric_list.h) */
    int metrics[SCENE_METRICS_MAX];
    ProbeList probes; /* no world knows them */
    TouchDef touch;   /* the same: what the window makes commands of */
} Scene;

enum { SCENE_SETTINGS_MAX = 64 };

/* What the command line adds to the file. */
typedef struct SceneSettings {
    int count;
    const char
        *set[SCENE_SETTINGS_MAX]; /* "path=value", in the order given; also what --backend, --method, --view,
                                     --threads stand for */
    const char
        *said[SCENE_SETTINGS_MAX]; /* what messages call it: "--backend cuda"; NULL: --set and the setting */
    const char *beside;            /* Scene.beside; NULL: "" */
    size_t particles;              /* --particles; 0: the scene's own spacing */
    ScenePurpose purpose;
    bool goes_on;  /* of a run that has begun: the tables of its start may be gone; they are read for
                      `particles` alone */
    bool recorded; /* of a recorded run, which nothing simulates: what it began with is not looked at, and of
                      the settings alone it is said what has no effect */
    const char
        *folder; /* of a recorded run: where the scene's files were, if not beside it; NULL: not known */
} SceneSettings;

/* How much of a setting is the same in another that takes its place: up to its '=', and of a preset all. */
size_t scene_setting_key(const char *setting);

/* Picture number `index` of those beside each other, from 0; how many there are, at least 1. */
const ViewDef *scene_view(const Scene *scene, int index);
int scene_view_count(const Scene *scene);

/* Whether the view shows states of this scene: not a recorded run's, nor those of other settings. */
bool scene_shows(const Scene *scene, const ViewDef *view);

/* Whether it reads accelerations, which a world keeps where WorldDef.acceleration says so. */
bool scene_view_accelerates(const ViewDef *view);

/* Reads, validates and fills `out`. False on failure: `error` says "file:line:column: what is wrong; what
   would be right", and "--set path=value: ..." where the command line is wrong. Creates nothing. `name` is a
   path, or the name of a file beside the sources that the program was built from (scenes/box_slosh.yaml,
   box_slosh). `notes` (may be
   NULL) is emptied, then gets what the user should know of the scene: that --particles scaled dt, and what
   scene_advise has to say. */
bool scene_load(const char *name, SceneSettings *settings, Scene *out, Notes *notes, Error *error);

/* The same from `size` bytes in memory; pure but for the tables that the scene names (app/scene/tables.h),
   for tests and the fuzz target. */
bool scene_parse(const char *path, const char *bytes, size_t size, SceneSettings *settings, Scene *out,
                 Notes *notes, Error *error);

#endif
