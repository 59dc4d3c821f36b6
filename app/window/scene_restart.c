#include "app/files/pictures.h"
#include "app/scene/scene.h"
#include "app/window/model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *scene_edits_text(const PlayScene *open, size_t *size)
{
    *size = open->reloaded ? open->reloaded_size : open->recording.size;
    return open->reloaded ? open->reloaded : open->recording.text;
}

/* Moves the shown views into `views`, and sets `view`, which the window uses for the chosen view, back to the
   file's view. */
static void restore_views(const Scene *filed, Scene *now)
{
    if (now->view_count == 0 && filed->view_count == 1) {
        now->view_count = 1;
        now->views[0] = now->view;
    }
    if (now->view_count > 0)
        now->view = filed->view;
}

static bool parse(const PlayModel *model, const char *text, size_t size, SceneSettings *settings, Scene *out,
                  Error *error)
{
    settings->purpose = SCENE_FOR_WINDOW;
    return scene_parse(model->open.recording.path, text, size, settings, out, NULL, error);
}

static bool scene_edits_find(const PlayModel *model, SceneEdits *out, Error *error)
{
    SceneSettings settings = model->open.recording.settings;
    size_t size;
    const char *text = scene_edits_text(&model->open, &size);
    out->changes = (SceneDifference){.world = false};
    if (!parse(model, text, size, &settings, &out->filed, error))
        return false;
    out->now = model->open.scene;
    if (!world_def_apply_moves(&out->now.world, model->closed_gates, error))
        return false;
    restore_views(&out->filed, &out->now);
    scene_difference(&out->filed, &out->now, &out->changes);
    return true;
}

/* Saves the user's session before a restart; a failed save prevents the restart. */
static bool keep_session(PlayModel *model, Error *error)
{
    char path[1024];
    if (model->record)
        return model_save_before_leaving(model, error);
    if (!model->status.unsaved)
        return true;
    dated_file_name(path, "recording");
    return model_save_now(model, path, error);
}

/* Checks that the scene may restart: a replayed session keeps the recorded settings. */
static bool may_restart(const PlayModel *model, Error *error)
{
    if (!model->open.source->simulates)
        return error_set(error, "a recorded run stays as it was simulated");
    return !model->open.session ||
           error_set(error, "a recorded session is done as it was; open its scene to change this");
}

static bool open_with(PlayModel *model, const SettingList *settings, size_t particles, Error *error)
{
    SceneSettings given;
    char path[SCENE_PATH_SIZE];
    snprintf(path, sizeof path, "%s", model->open.scene.path);
    if (!setting_list_settings(settings, &given, error))
        return false;
    given.particles = particles;
    const bool ok = keep_session(model, error) && model_open(model, path, &given, error);
    model->kept = false; /* if opening fails, the session may continue */
    return ok;
}

/* Drops spacings: a count of particles sets the spacing, and a scene accepts only one of both. */
static void leave_spacing(SettingList *list)
{
    setting_list_remove_under(list, "particles.spacing=");
}

/* Drops earlier settings that a newly chosen preset replaces. */
static void drop_replaced(SettingList *list, const SettingList *more)
{
    static const char PRESET[] = "preset=";
    SettingList gone = {.count = 0};
    for (int i = 0; i < more->count; i++)
        for (int k = 0; k < list->count && strncmp(more->set[i], PRESET, strlen(PRESET)) == 0; k++)
            if (preset_sets(more->set[i] + strlen(PRESET), list->set[k]))
                setting_list_add(&gone, list->set[k]);
    setting_list_remove(list, &gone);
    setting_list_free(&gone);
}

bool scene_restart(PlayModel *model, const SettingList *more, size_t particles, Error *error)
{
    SceneEdits *edits = calloc(1, sizeof *edits);
    SettingList all = {.count = 0};
    if (!edits) {
        error_set(error, "no memory to begin again");
        return false;
    }
    bool ok = may_restart(model, error) && scene_edits_find(model, edits, error);
    if (ok) {
        const SceneSettings *said = &model->open.recording.settings;
        setting_list_join_scene(&all, said);
        setting_list_join(&all, &edits->changes.settings);
        drop_replaced(&all, more);
        setting_list_join(&all, more);
        if (particles > 0)
            leave_spacing(&all);
        ok = open_with(model, &all, particles > 0 ? particles : said->particles, error);
    }
    setting_list_free(&all);
    setting_list_free(&edits->changes.settings);
    free(edits);
    return ok;
}

static bool save(PlayModel *model, SceneEdits *edits, Error *error)
{
    char words[512];
    size_t size;
    const char *text = scene_edits_text(&model->open, &size);
    if (!scene_edits_find(model, edits, error))
        return false;
    SceneSaved saved = {.lost = false};
    const SceneSource what = {
        .scene = &edits->now, .path = model->open.recording.path, .text = text, .size = size};
    const bool ok = scene_save(&what, NULL, &saved, error);
    scene_saved_words(&saved, words, sizeof words);
    if (ok)
        notice_tell(model->notice, "%s", words);
    setting_list_free(&saved.changed);
    return ok;
}

void scene_edits_save(PlayModel *model)
{
    Error error = {{0}};
    SceneEdits *edits = calloc(1, sizeof *edits);
    if (!edits || !save(model, edits, &error))
        notice_error(model->notice, edits ? error.message : "no memory to save the scene");
    if (edits)
        setting_list_free(&edits->changes.settings);
    free(edits);
}

bool scene_edits_embed(const PlayModel *model, EmbeddedScene *out, Error *error)
{
    size_t size;
    const char *text = scene_edits_text(&model->open, &size);
    SceneEdits *edits = calloc(1, sizeof *edits);
    if (!edits) {
        error_set(error, "no memory for the scene of the picture");
        return false;
    }
    bool ok = scene_edits_find(model, edits, error);
    const SceneSource what = {
        .scene = &edits->now, .path = model->open.recording.path, .text = text, .size = size};
    ok = ok && embedded_scene_make(&what, out, error);
    setting_list_free(&edits->changes.settings);
    free(edits);
    return ok;
}

/* ---- a written file ---- */

/* A written file to merge into the running scene. */
typedef struct SceneReload {
    SceneEdits edits;
    char *text;
    size_t size;
    Scene fresh;             /* the present file with the command line */
    SceneDifference changed; /* changes of the file */
    Scene wanted;            /* with the window's changes on top */
    SceneDifference due;     /* changes from the running scene to `wanted` */
    SettingList settings;
    Error dropped; /* the reason for dropping the window's changes; "": kept */
} SceneReload;

static void scene_reload_free(SceneReload *reload)
{
    setting_list_free(&reload->edits.changes.settings);
    setting_list_free(&reload->changed.settings);
    setting_list_free(&reload->due.settings);
    setting_list_free(&reload->settings);
    free(reload->text);
    free(reload);
}

/* Keeps the window's changes except where the file changed; drops all of them if the file cannot be combined
   with the rest. */
static bool find_wanted(const PlayModel *model, SceneReload *reload, Error *error)
{
    const Recording *recording = &model->open.recording;
    SceneSettings settings;
    setting_list_join_scene(&reload->settings, &recording->settings);
    setting_list_remove_within(&reload->edits.changes.settings, &reload->changed.settings);
    setting_list_join(&reload->settings, &reload->edits.changes.settings);
    setting_list_remove(&reload->settings, &reload->changed.settings);
    setting_list_remove_around(&reload->settings, &reload->changed.settings);
    if (!setting_list_settings(&reload->settings, &settings, error))
        return false;
    settings.particles = recording->settings.particles;
    if (parse(model, reload->text, reload->size, &settings, &reload->wanted, &reload->dropped)) {
        *reload->dropped.message = 0;
        return true;
    }
    setting_list_free(&reload->settings);
    setting_list_join_scene(&reload->settings, &recording->settings);
    reload->wanted = reload->fresh;
    return true;
}

static bool read_reloaded(const PlayModel *model, SceneReload *reload, Error *error)
{
    const Recording *recording = &model->open.recording;
    SceneSettings settings = recording->settings;
    if (!scene_edits_find(model, &reload->edits, error))
        return false;
    reload->text = scene_file_read(recording->path, &reload->size, error);
    if (!reload->text || !parse(model, reload->text, reload->size, &settings, &reload->fresh, error))
        return false;
    scene_difference(&reload->edits.filed, &reload->fresh, &reload->changed);
    if (!find_wanted(model, reload, error))
        return false;
    scene_difference(&reload->edits.now, &reload->wanted, &reload->due);
    return true;
}

static bool is_of_view(const char *setting)
{
    return strncmp(setting, "view", strlen("view")) == 0;
}

static bool shows_others(const Scene *scene)
{
    for (int i = 0; i < scene->view_count; i++)
        if (!scene_shows(scene, &scene->views[i]) || scene->views[i].time >= 0)
            return true;
    return false;
}

/* True for keys without effect on the running simulation, kept only as values of the window's scene. */
static bool is_of_scene(const char *setting)
{
    return strncmp(setting, "metrics", strlen("metrics")) == 0 || strncmp(setting, "solver.preset=", 14) == 0;
}

static const Key *key_of(const char *setting)
{
    char path[DIFFERENCE_PATH_SIZE];
    snprintf(path, sizeof path, "%.*s", (int)strcspn(setting, "="), setting);
    return scene_key_find(path);
}

/* True if the window can apply the setting live: a command has limited room. */
static bool can_set_live(const char *setting)
{
    const Key *key = key_of(setting);
    return is_of_view(setting) || is_of_scene(setting) ||
           (key && key->flags & KEY_LIVE && strlen(setting) < SIM_SETTING_SIZE);
}

/* True if the running scene can take all changes. Runs beside the scene start together with the scene, so
   changed views would need a restart. */
static bool is_live(const SceneReload *reload)
{
    const SettingList *due = &reload->due.settings;
    bool views = false;
    for (int i = 0; i < due->count; i++) {
        views |= is_of_view(due->set[i]);
        if (!can_set_live(due->set[i]))
            return false;
    }
    return !reload->due.dead && !due->lacks &&
           !(views && (shows_others(&reload->edits.now) || shows_others(&reload->wanted)));
}

/* Sets a live key; copies the values of keys without effect on the simulation, such as metrics. */
static void set(PlayModel *model, const Scene *wanted, const char *setting)
{
    const Key *key = key_of(setting);
    if (key && key->flags & KEY_LIVE)
        model_set(model, setting);
    Scene *scene = &model->open.scene;
    memcpy(scene->preset, wanted->preset, sizeof scene->preset);
    scene->preset_filled = wanted->preset_filled;
    scene->metric_count = wanted->metric_count;
    memcpy(scene->metrics, wanted->metrics, sizeof scene->metrics);
}

/* Makes the file's new text the base for later comparisons. */
static ReloadResult keep_text(PlayModel *model, SceneReload *reload)
{
    free(model->open.reloaded);
    model->open.reloaded = reload->text;
    model->open.reloaded_size = reload->size;
    reload->text = NULL;
    return RELOAD_SAME;
}

/* Applies the changes; returns true if the picture changes. */
static bool apply_live(PlayModel *model, SceneReload *reload)
{
    PlayScene *open = &model->open;
    const SettingList *due = &reload->due.settings;
    bool views = false;
    for (int i = 0; i < due->count; i++) {
        views |= is_of_view(due->set[i]);
        if (!is_of_view(due->set[i]))
            set(model, &reload->wanted, due->set[i]);
    }
    if (views) {
        open->scene.view = reload->wanted.view;
        open->scene.view_count = reload->wanted.view_count;
        memcpy(open->scene.views, reload->wanted.views, sizeof open->scene.views);
    }
    model->file_scene = reload->fresh;
    keep_text(model, reload);
    return views;
}

static ReloadResult restart(PlayModel *model, SceneReload *reload, Error *error)
{
    return open_with(model, &reload->settings, model->open.recording.settings.particles, error)
               ? RELOAD_RESTARTED
               : RELOAD_FAILED;
}

static bool sets_solids(const SettingList *settings)
{
    bool says = false;
    for (int i = 0; i < settings->count; i++)
        says |= strncmp(settings->set[i], "solids=", strlen("solids=")) == 0;
    return says;
}

static void describe_changes(const SceneReload *reload, bool others, char words[320])
{
    const SceneDifference *changed = &reload->changed;
    char of[190] = "";
    setting_list_words(&changed->settings, of, sizeof of);
    snprintf(words, 320, "%s", of);
    if (!*words && others)
        snprintf(words, 320, "a file that it names");
    const size_t used = strlen(words);
    if (*reload->dropped.message)
        snprintf(words + used, 320 - used, "; what was changed in the window is gone: %.160s",
                 reload->dropped.message);
    else if (sets_solids(&reload->edits.changes.settings) && !sets_solids(&reload->settings))
        snprintf(words + used, 320 - used, "; solids of the hand are gone");
}

ReloadResult scene_reload(PlayModel *model, bool others, char words[320], Error *error)
{
    SceneReload *reload = calloc(1, sizeof *reload);
    ReloadResult result = RELOAD_FAILED;
    *words = 0;
    if (!reload) {
        error_set(error, "no memory to read the scene again");
        return RELOAD_FAILED;
    }
    if (!model_end_previous(model, 0)) { /* the previous scene is still ending */
        result = RELOAD_LATER;
    } else if (read_reloaded(model, reload, error)) {
        describe_changes(reload, others, words);
        const SceneDifference *changed = &reload->changed;
        if (!others && changed->settings.count == 0) /* ignores changes by hand */
            result = keep_text(model, reload);
        else if (others || !is_live(reload))
            result = restart(model, reload, error);
        else if (apply_live(model, reload))
            result = RELOAD_VIEW;
        else
            result = *words ? RELOAD_LIVE : RELOAD_SAME;
    }
    scene_reload_free(reload);
    return result;
}
