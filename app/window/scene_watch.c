#include "app/scene/scene.h"
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "sim/world.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double LOOK_MS = 50, REST_MS = 120, GRACE_MS = 2000;

static FileStamp mark_of(const char *path)
{
    struct stat is;
    if (stat(path, &is) != 0)
        return (FileStamp){.there = false};
    return (FileStamp){is.st_mtim.tv_sec, is.st_mtim.tv_nsec, is.st_size, is.st_ino, true};
}

static bool same(const FileStamp *a, const FileStamp *b)
{
    return a->there == b->there && a->seconds == b->seconds && a->nanoseconds == b->nanoseconds &&
           a->size == b->size && a->inode == b->inode;
}

/* Adds a file in its present state, unless already present; returns false if the list is full or the path too
   long. The first file is the main file, the rest belong to the main file. */
static bool file_watch_add(FileWatch *watch, const char *path)
{
    for (int i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return true;
    if (watch->count == FILE_WATCH_MAX || strlen(path) >= FILE_WATCH_PATH_SIZE)
        return false;
    snprintf(watch->files[watch->count].path, FILE_WATCH_PATH_SIZE, "%s", path);
    watch->files[watch->count].mark = mark_of(path);
    watch->count++;
    return true;
}

/* Takes over the state of files that `before` also watches: writes since then count as changes. */
static void file_watch_keep(FileWatch *watch, const FileWatch *before)
{
    for (int i = 0; i < watch->count; i++)
        for (int k = 0; k < before->count; k++)
            if (strcmp(watch->files[i].path, before->files[k].path) == 0)
                watch->files[i].mark = before->files[k].mark;
}

/* Call once per picture or more often with the wall time: returns true once after a change, when the files
   have been stable for a moment. Waits up to two seconds for a missing or empty first file. */
static bool file_watch_changed(FileWatch *watch, double now_ms)
{
    if (watch->count == 0 || now_ms < watch->looked_ms + LOOK_MS)
        return false;
    watch->looked_ms = now_ms;
    for (int i = 0; i < watch->count; i++) {
        const FileStamp now = mark_of(watch->files[i].path);
        if (same(&now, &watch->files[i].mark))
            continue;
        watch->files[i].mark = now;
        watch->others = (watch->pending && watch->others) || i > 0;
        watch->pending = true;
        watch->changed_ms = now_ms;
    }
    const FileStamp *first = &watch->files[0].mark;
    const double wait = first->there && first->size > 0 ? REST_MS : GRACE_MS;
    if (!watch->pending || now_ms < watch->changed_ms + wait)
        return false;
    watch->pending = false;
    return true;
}

static void add_watched_file(void *watch, const char *what, const char *path)
{
    (void)what;
    file_watch_add(watch, path);
}

/* Watches the scene's file, and the files named by the scene. */
static void watch_scene_files(SceneWatch *scene_watch, const PlayModel *model)
{
    const PlayScene *open = &model->open;
    size_t size;
    const char *text = scene_edits_text(open, &size);
    const FileWatch before = scene_watch->watch;
    *scene_watch = (SceneWatch){.opened = model->scenes_opened};
    if (!open->source->simulates || open->session || picture_text_name(open->scene.path))
        return;
    file_watch_add(&scene_watch->watch, open->scene.path);
    scene_find_tables(open->scene.path, text, size, &open->recording.settings, add_watched_file,
                      &scene_watch->watch);
    file_watch_keep(&scene_watch->watch, &before);
}

static void tell_broken(Play *play, const Error *error)
{
    SceneWatch *scene_watch = &play->scene_watch;
    const SimulatorStatus *status = &play->model.status; /* model_read_status has already reported saves */
    if (strcmp(scene_watch->broken.message, error->message) != 0 &&
        strcmp(status->saved ? "" : status->save_message, error->message) != 0)
        notice_error(&play->notice, error->message);
    scene_watch->broken = *error;
    play->picture.dirty = true;
}

static void tell_reload(Play *play, ReloadResult result, const char *words)
{
    const char *path = play->model.open.scene.path;
    const bool mended = *play->scene_watch.broken.message;
    *play->scene_watch.broken.message = 0;
    play->picture.dirty |= mended;
    if (result == RELOAD_RESTARTED)
        notice_tell(&play->notice, "%.200s was saved: begins anew with %s", path, words);
    else if (result != RELOAD_SAME)
        notice_tell(&play->notice, "%.200s was saved: %s", path, words);
    else if (mended)
        notice_tell(&play->notice, "%.200s is right again", path);
}

void scene_watch_poll(Play *play)
{
    SceneWatch *scene_watch = &play->scene_watch;
    PlayModel *model = &play->model;
    char words[320];
    Error error = {{0}};
    if (scene_watch->opened != model->scenes_opened)
        watch_scene_files(scene_watch, model);
    if (!file_watch_changed(&scene_watch->watch, wall_ms()))
        return;
    const bool others = scene_watch->watch.others;
    const ReloadResult result = scene_reload(model, others, words, &error);
    if (result == RELOAD_LATER) {
        scene_watch->watch.pending = true;
        return;
    }
    if (result == RELOAD_FAILED) {
        tell_broken(play, &error);
        return;
    }
    requests_scene_changed(play, result == RELOAD_RESTARTED, result == RELOAD_VIEW);
    tell_reload(play, result, words);
    watch_scene_files(scene_watch, model); /* the scene may name different files now */
}
