/* Scenes, errors, and the preparation of a process. */
#define _GNU_SOURCE
#include "slosh/scene.h"
#include "app/base/program.h"
#include "library/library.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"

#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* Scenes lie in share/slosh below a folder above the library: lib/, lib/x86_64-linux-gnu/. In a build tree
   the library's own folder tells where the sources are. */
static void find_folder(void)
{
    char folder[PATH_MAX], scenes[PATH_MAX + 32], whole[PATH_MAX];
    Dl_info info;
    if (!dladdr(&lock, &info) || !realpath(info.dli_fname, whole))
        snprintf(whole, sizeof whole, "/nowhere");
    *strrchr(whole, '/') = 0;
    snprintf(folder, sizeof folder, "%s", whole);
    for (char *at = strrchr(folder, '/'); at; *at = 0, at = strrchr(folder, '/')) {
        snprintf(scenes, sizeof scenes, "%.*s/share/slosh/scenes", (int)(at - folder), folder);
        if (access(scenes, F_OK) == 0) {
            *strstr(scenes + (at - folder), "/slosh/scenes") = 0;
            program_is_library(scenes);
            return;
        }
    }
    program_is_library(whole);
}

static void prepare(void)
{
    find_folder();
    backends_add();
}

void library_lock(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, prepare);
    pthread_mutex_lock(&lock);
}

void library_unlock(void)
{
    pthread_mutex_unlock(&lock);
}

bool library_fail(slosh_error *to, const Error *from)
{
    if (to)
        snprintf(to->message, sizeof to->message, "%s", from->message);
    return false;
}

bool library_refuse(slosh_error *to, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (to)
        vsnprintf(to->message, sizeof to->message, format, args);
    va_end(args);
    if (to)
        text_tame(to->message);
    return false;
}

const char *slosh_version(void)
{
    return SLOSH_VERSION;
}

/* "particles=N" is no key: the command line has --particles. */
static bool take_setting(SceneSettings *to, const char *setting, Error *error)
{
    static const char particles[] = "particles=";
    char *end;
    if (!setting)
        return error_set(error, "a setting is NULL; it must be a text path=value");
    if (strncmp(setting, particles, sizeof particles - 1) != 0)
        return scene_settings_add(to, NULL, setting, error);
    const double count = strtod(setting + sizeof particles - 1, &end);
    if (*end || !(count >= 1 && count <= 1e9))
        return error_set(error, "%s: must be a number of particles, 1 to 1e9", setting);
    to->particles = (size_t)count;
    return true;
}

static bool take_settings(SceneSettings *to, const char *const settings[], size_t count, Error *error)
{
    if (count > 0 && !settings)
        return error_set(error, "the settings are NULL, and their count is %zu", count);
    for (size_t i = 0; i < count; i++)
        if (!take_setting(to, settings[i], error))
            return false;
    return true;
}

static slosh_scene *finish(slosh_scene *scene, bool ok, const Error *why, slosh_error *error)
{
    if (ok)
        return scene;
    library_fail(error, why);
    free(scene);
    return NULL;
}

slosh_scene *slosh_scene_load(const char *name, const char *const settings[], size_t count,
                              slosh_error *error)
{
    Error why = {"out of memory"};
    SceneSettings all = {.count = 0};
    slosh_scene *scene = calloc(1, sizeof *scene);
    library_lock();
    const bool ok = scene && (name || error_set(&why, "the name of the scene is NULL")) &&
                    take_settings(&all, settings, count, &why) &&
                    scene_load(name, &all, &scene->scene, &scene->notes, &why);
    library_unlock();
    return finish(scene, ok, &why, error);
}

slosh_scene *slosh_scene_parse(const char *name, const char *text, size_t size, const char *const settings[],
                               size_t count, slosh_error *error)
{
    Error why = {"out of memory"};
    SceneSettings all = {.count = 0};
    slosh_scene *scene = calloc(1, sizeof *scene);
    library_lock();
    const bool ok = scene &&
                    ((name && text) || error_set(&why, "the name or the text of the scene is NULL")) &&
                    (size <= SCENE_BYTES_MAX || error_set(&why, "%s: a scene has at most 1 MiB", name)) &&
                    take_settings(&all, settings, count, &why) &&
                    scene_parse(name, text, size, &all, &scene->scene, &scene->notes, &why);
    library_unlock();
    return finish(scene, ok, &why, error);
}

void slosh_scene_free(slosh_scene *scene)
{
    if (scene)
        free(scene->settings);
    free(scene);
}

const char *slosh_scene_title(const slosh_scene *scene)
{
    return scene ? scene->scene.title : NULL;
}

const char *slosh_scene_path(const slosh_scene *scene)
{
    return scene ? scene->scene.path : NULL;
}

size_t slosh_scene_note_count(const slosh_scene *scene)
{
    return scene ? (size_t)scene->notes.count : 0;
}

const char *slosh_scene_note(const slosh_scene *scene, size_t index)
{
    return index < slosh_scene_note_count(scene) ? scene->notes.line[index] : NULL;
}

char *library_settings(const Scene *scene)
{
    library_lock();
    json_t *json = scene_json(scene);
    library_unlock();
    char *text = json ? json_dumps(json, JSON_INDENT(1)) : NULL;
    json_decref(json);
    return text;
}

const char *slosh_scene_settings(slosh_scene *scene)
{
    if (!scene)
        return NULL;
    free(scene->settings);
    return scene->settings = library_settings(&scene->scene);
}

const char *slosh_scene_name(size_t index)
{
    static SceneNames names; /* filled once, under the lock */
    library_lock();
    if (names.count == 0)
        scene_path_names(&names);
    library_unlock();
    return index < (size_t)names.count ? names.name[index] : NULL;
}
