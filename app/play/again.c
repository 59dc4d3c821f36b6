#include "app/play/again.h"

#include "app/files/pictures.h"
#include "app/scene/keys.h"
#include "app/scene/save.h"
#include "app/scene/scene_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *again_text(const PlayScene *open, size_t *size)
{
    *size = open->renewed ? open->renewed_size : open->recording.size;
    return open->renewed ? open->renewed : open->recording.text;
}

/* Moves the shown views into `views`, and sets `view`, which the window uses for the chosen view, back to the
   file's view. */
static void settle_views(const Scene *filed, Scene *now)
{
    if (now->view_count == 0 && filed->view_count == 1) {
        now->view_count = 1;
        now->views[0] = now->view;
    }
    if (now->view_count > 0)
        now->view = filed->view;
}

static bool parse(const Model *model, const char *text, size_t size, SceneSettings *settings, Scene *out,
                  Error *error)
{
    settings->purpose = SCENE_FOR_WINDOW;
    return scene_parse(model->open.recording.path, text, size, settings, out, NULL, error);
}

bool again_look(const Model *model, Again *out, Error *error)
{
    SceneSettings settings = model->open.recording.settings;
    size_t size;
    const char *text = again_text(&model->open, &size);
    out->mine = (SceneDifference){.world = false};
    if (!parse(model, text, size, &settings, &out->filed, error))
        return false;
    out->now = model->open.scene;
    world_def_apply_moves(&out->now.world, model->shut);
    settle_views(&out->filed, &out->now);
    scene_difference(&out->filed, &out->now, &out->mine);
    return true;
}

/* Saves the user's session before a restart; a failed save prevents the restart. */
static bool keep_session(Model *model, Error *error)
{
    char path[1024];
    if (model->record)
        return model_keep_session(model, error);
    if (!model->status.unsaved)
        return true;
    dated_file_name(path, "recording");
    return model_save_now(model, path, error);
}

/* Checks that the scene may restart: a replayed session keeps the recorded settings. */
static bool may_begin(const Model *model, Error *error)
{
    if (!model->open.source->simulates)
        return error_set(error, "a recorded run stays as it was simulated");
    return !model->open.session ||
           error_set(error, "a recorded session is done as it was; open its scene to change this");
}

static bool open_with(Model *model, const SettingList *settings, size_t particles, Error *error)
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
static void give_way(SettingList *list, const SettingList *more)
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

bool again_open(Model *model, const SettingList *more, size_t particles, Error *error)
{
    Again *again = calloc(1, sizeof *again);
    SettingList all = {.count = 0};
    if (!again) {
        error_set(error, "no memory to begin again");
        return false;
    }
    bool ok = may_begin(model, error) && again_look(model, again, error);
    if (ok) {
        const SceneSettings *said = &model->open.recording.settings;
        setting_list_join_scene(&all, said);
        setting_list_join(&all, &again->mine.settings);
        give_way(&all, more);
        setting_list_join(&all, more);
        if (particles > 0)
            leave_spacing(&all);
        ok = open_with(model, &all, particles > 0 ? particles : said->particles, error);
    }
    setting_list_free(&all);
    setting_list_free(&again->mine.settings);
    free(again);
    return ok;
}

static bool save(Model *model, Again *again, Error *error)
{
    char words[512];
    size_t size;
    const char *text = again_text(&model->open, &size);
    if (!again_look(model, again, error))
        return false;
    SceneSaved saved = {.lost = false};
    const SceneSource what = {
        .scene = &again->now, .path = model->open.recording.path, .text = text, .size = size};
    const bool ok = scene_save(&what, NULL, &saved, error);
    scene_saved_words(&saved, words, sizeof words);
    if (ok)
        notice_tell(model->notice, "%s", words);
    setting_list_free(&saved.changed);
    return ok;
}

void again_save(Model *model)
{
    Error error = {{0}};
    Again *again = calloc(1, sizeof *again);
    if (!again || !save(model, again, &error))
        notice_error(model->notice, again ? error.message : "no memory to save the scene");
    if (again)
        setting_list_free(&again->mine.settings);
    free(again);
}

bool again_carry(const Model *model, EmbeddedScene *out, Error *error)
{
    size_t size;
    const char *text = again_text(&model->open, &size);
    Again *again = calloc(1, sizeof *again);
    if (!again) {
        error_set(error, "no memory for the scene of the picture");
        return false;
    }
    bool ok = again_look(model, again, error);
    const SceneSource what = {
        .scene = &again->now, .path = model->open.recording.path, .text = text, .size = size};
    ok = ok && embedded_scene_make(&what, out, error);
    setting_list_free(&again->mine.settings);
    free(again);
    return ok;
}

/* ---- a written file ---- */

/* A written file to merge into the running scene. */
typedef struct Renewal {
    Again again;
    char *text;
    size_t size;
    Scene fresh;             /* the present file with the command line */
    SceneDifference changed; /* changes of the file */
    Scene wanted;            /* with the window's changes on top */
    SceneDifference due;     /* changes from the running scene to `wanted` */
    SettingList settings;
    Error dropped; /* the reason for dropping the window's changes; "": kept */
} Renewal;

static void renewal_free(Renewal *renewal)
{
    setting_list_free(&renewal->again.mine.settings);
    setting_list_free(&renewal->changed.settings);
    setting_list_free(&renewal->due.settings);
    setting_list_free(&renewal->settings);
    free(renewal->text);
    free(renewal);
}

/* Keeps the window's changes except where the file changed; drops all of them if the file cannot be combined
   with the rest. */
static bool find_wanted(const Model *model, Renewal *renewal, Error *error)
{
    const Recording *recording = &model->open.recording;
    SceneSettings settings;
    setting_list_join_scene(&renewal->settings, &recording->settings);
    setting_list_remove_within(&renewal->again.mine.settings, &renewal->changed.settings);
    setting_list_join(&renewal->settings, &renewal->again.mine.settings);
    setting_list_remove(&renewal->settings, &renewal->changed.settings);
    setting_list_remove_around(&renewal->settings, &renewal->changed.settings);
    if (!setting_list_settings(&renewal->settings, &settings, error))
        return false;
    settings.particles = recording->settings.particles;
    if (parse(model, renewal->text, renewal->size, &settings, &renewal->wanted, &renewal->dropped)) {
        *renewal->dropped.message = 0;
        return true;
    }
    setting_list_free(&renewal->settings);
    setting_list_join_scene(&renewal->settings, &recording->settings);
    renewal->wanted = renewal->fresh;
    return true;
}

static bool read_file(const Model *model, Renewal *renewal, Error *error)
{
    const Recording *recording = &model->open.recording;
    SceneSettings settings = recording->settings;
    if (!again_look(model, &renewal->again, error))
        return false;
    renewal->text = scene_file_read(recording->path, &renewal->size, error);
    if (!renewal->text || !parse(model, renewal->text, renewal->size, &settings, &renewal->fresh, error))
        return false;
    scene_difference(&renewal->again.filed, &renewal->fresh, &renewal->changed);
    if (!find_wanted(model, renewal, error))
        return false;
    scene_difference(&renewal->again.now, &renewal->wanted, &renewal->due);
    return true;
}

static bool is_of_view(const char *setting)
{
    return strncmp(setting, "view", strlen("view")) == 0;
}

static bool shows_others(const Scene *scene)
{
    for (int i = 0; i < scene->view_count; i++)
        if (!scene_shows(scene, &scene->views[i]))
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
static bool takes(const char *setting)
{
    const Key *key = key_of(setting);
    return is_of_view(setting) || is_of_scene(setting) ||
           (key && key->flags & KEY_LIVE && strlen(setting) < SIM_SETTING_SIZE);
}

/* True if the running scene can take all changes. Runs beside the scene start together with the scene, so
   changed views would need a restart. */
static bool is_live(const Renewal *renewal)
{
    const SettingList *due = &renewal->due.settings;
    bool views = false;
    for (int i = 0; i < due->count; i++) {
        views |= is_of_view(due->set[i]);
        if (!takes(due->set[i]))
            return false;
    }
    return !renewal->due.dead && !due->lacks &&
           !(views && (shows_others(&renewal->again.now) || shows_others(&renewal->wanted)));
}

/* Sets a live key; copies the values of keys without effect on the simulation, such as metrics. */
static void set(Model *model, const Scene *wanted, const char *setting)
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
static AgainResult keep_text(Model *model, Renewal *renewal)
{
    free(model->open.renewed);
    model->open.renewed = renewal->text;
    model->open.renewed_size = renewal->size;
    renewal->text = NULL;
    return AGAIN_SAME;
}

/* Applies the changes; returns true if the picture changes. */
static bool renew(Model *model, Renewal *renewal)
{
    PlayScene *open = &model->open;
    const SettingList *due = &renewal->due.settings;
    bool views = false;
    for (int i = 0; i < due->count; i++) {
        views |= is_of_view(due->set[i]);
        if (!is_of_view(due->set[i]))
            set(model, &renewal->wanted, due->set[i]);
    }
    if (views) {
        open->scene.view = renewal->wanted.view;
        open->scene.view_count = renewal->wanted.view_count;
        memcpy(open->scene.views, renewal->wanted.views, sizeof open->scene.views);
    }
    model->file_scene = renewal->fresh;
    keep_text(model, renewal);
    return views;
}

static AgainResult begin(Model *model, Renewal *renewal, Error *error)
{
    return open_with(model, &renewal->settings, model->open.recording.settings.particles, error)
               ? AGAIN_BEGUN
               : AGAIN_FAILED;
}

static bool says_solids(const SettingList *settings)
{
    bool says = false;
    for (int i = 0; i < settings->count; i++)
        says |= strncmp(settings->set[i], "solids=", strlen("solids=")) == 0;
    return says;
}

static void tell(const Renewal *renewal, bool others, char words[320])
{
    const SceneDifference *changed = &renewal->changed;
    char of[190] = "";
    setting_list_words(&changed->settings, of, sizeof of);
    snprintf(words, 320, "%s", of);
    if (!*words && others)
        snprintf(words, 320, "a file that it names");
    const size_t used = strlen(words);
    if (*renewal->dropped.message)
        snprintf(words + used, 320 - used, "; what was changed in the window is gone: %.160s",
                 renewal->dropped.message);
    else if (says_solids(&renewal->again.mine.settings) && !says_solids(&renewal->settings))
        snprintf(words + used, 320 - used, "; solids of the hand are gone");
}

AgainResult again_read(Model *model, bool others, char words[320], Error *error)
{
    Renewal *renewal = calloc(1, sizeof *renewal);
    AgainResult result = AGAIN_FAILED;
    *words = 0;
    if (!renewal) {
        error_set(error, "no memory to read the scene again");
        return AGAIN_FAILED;
    }
    if (!model_leave(model, 0)) { /* the previous scene is still ending */
        result = AGAIN_LATER;
    } else if (read_file(model, renewal, error)) {
        tell(renewal, others, words);
        const SceneDifference *changed = &renewal->changed;
        if (!others && changed->settings.count == 0) /* ignores changes by hand */
            result = keep_text(model, renewal);
        else if (others || !is_live(renewal))
            result = begin(model, renewal, error);
        else if (renew(model, renewal))
            result = AGAIN_VIEW;
        else
            result = *words ? AGAIN_LIVE : AGAIN_SAME;
    }
    renewal_free(renewal);
    return result;
}
