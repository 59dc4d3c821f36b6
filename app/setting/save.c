#define _GNU_SOURCE /* asprintf */
#include "app/setting/save.h"

#include "app/base/output.h"
#include "app/scene/tables.h"
#include "app/setting/differ.h"
#include "app/yaml/patch.h"
#include "app/yaml/yaml.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROUNDS = 4, NAMES_MOST = 10000 };

/* A FileMoved: adds a setting with the full path. */
static void add_file(void *user, Node *node, const char *path, const char *whole)
{
    (void)node;
    setting_list_add_text(user, path, whole);
}

/* Applies the settings to the text one after another; frees the old text. */
static bool put_in(const Save *save, const SettingList *settings, char **text, bool *lost, Error *error)
{
    for (int i = 0; i < settings->count; i++) {
        char *next = yaml_patch(save->path, *text, strlen(*text), settings->set[i], lost, error);
        if (!next)
            return false;
        free(*text);
        *text = next;
    }
    return !settings->lacks || error_set(error, "%s: too many settings differ", save->path);
}

static bool put_files(const Save *save, const char *output, SettingList *files, char **text, bool *lost,
                      Error *error)
{
    Tree tree;
    const bool ok = tree_read(&tree, save->path, *text, strlen(*text), error);
    if (ok)
        scene_move_files(&tree, output, add_file, files);
    tree_free(&tree);
    return ok && put_in(save, files, text, lost, error);
}

static void leave_machine(SettingList *list)
{
    setting_list_remove_under(list, "solver.threads=");
    setting_list_remove_under(list, "solver.simd=");
}

/* Finds the differences left between the text and the scene. */
static bool differs(const Save *save, const char *output, const char *text, Differ *out, Error *error)
{
    Scene *read = calloc(1, sizeof *read);
    SceneSettings none = {.purpose = save->scene->purpose};
    *out = (Differ){.world = false};
    if (!read) {
        error_set(error, "%s: no memory", save->path);
        return false;
    }
    const bool ok = scene_parse(output, text, strlen(text), &none, read, NULL, error);
    if (ok)
        scene_differ(read, save->scene, out);
    leave_machine(&out->settings);
    free(read);
    return ok;
}

static bool make(const Save *save, const char *output, const SettingList *files, char **text, Saved *out,
                 Error *error)
{
    *out->lacks = '\0';
    for (int round = 0;; round++) {
        Differ left;
        bool ok = differs(save, output, *text, &left, error);
        setting_list_remove(&left.settings, files);
        ok = ok &&
             (!left.depth ||
              error_set(error, "%s: has another number of dimensions, which no setting can say", save->path));
        const bool whole = ok && left.settings.count == 0;
        if (ok && round == ROUNDS && !whole)
            snprintf(out->lacks, sizeof out->lacks, "%.*s", (int)strcspn(left.settings.set[0], "="),
                     left.settings.set[0]);
        else if (!whole)
            ok = ok && put_in(save, &left.settings, text, &out->lost, error);
        setting_list_join(&out->changed, &left.settings);
        setting_list_free(&left.settings);
        if (!ok || whole || round == ROUNDS)
            return ok;
    }
}

char *save_text(const Save *save, const char *output, Saved *out, Error *error)
{
    SettingList files = {.count = 0};
    *out = (Saved){.lost = false};
    char *text = strndup(save->text, save->size);
    if (!text) {
        error_set(error, "%s: no memory", save->path);
        return NULL;
    }
    const bool ok = make(save, save->path, &files, &text, out, error) &&
                    put_files(save, output, &files, &text, &out->lost, error) &&
                    make(save, output, &files, &text, out, error);
    setting_list_free(&files);
    if (ok)
        return text;
    free(text);
    return NULL;
}

/* Writes the header; lists changed keys, as comments beside their values may be about older values. */
static void print_head(const Save *save, const SettingList *changed, FILE *file)
{
    const char *slash = strrchr(save->path, '/');
    fprintf(file, "# Written by slosh " SLOSH_VERSION " from %s.", slash ? slash + 1 : save->path);
    for (int i = 0; i < changed->count; i++)
        fprintf(file, "%s%.*s", i > 0 ? ", " : "\n# Comments beside these are older than they are: ",
                (int)strcspn(changed->set[i], "="), changed->set[i]);
    fputs(changed->count > 0 ? ".\n#\n" : "\n#\n", file);
}

static bool write_text(const Save *save, const SettingList *changed, const char *text, const char *temp,
                       const char *path, Error *error)
{
    FILE *file = fopen(temp, "w");
    bool whole = file != NULL;
    if (file) {
        print_head(save, changed, file);
        fputs(text, file);
        whole = !ferror(file);
        whole &= fclose(file) == 0;
    }
    return whole || error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
}

/* Returns false with *there if a file of that name exists. */
static bool write_new(const Save *save, const char *path, Saved *out, bool *there, Error *error)
{
    Output output = {.path = ""};
    char *text = save_text(save, path, out, error);
    *there = false;
    const bool ok = text && output_begin(&output, path, error) &&
                    write_text(save, &out->changed, text, output.temp, path, error) &&
                    output_commit_new(&output, there, error) && !*there;
    output_discard(&output);
    free(text);
    snprintf(out->path, sizeof out->path, "%s", path);
    return ok;
}

/* New name after "scenes/dam_break-2.yaml" with 3: "dam_break-3.yaml"; an existing number is replaced. */
static void new_name(const char *from, int number, char path[256])
{
    const char *slash = strrchr(from, '/'), *name = slash ? slash + 1 : from;
    const char *dot = strrchr(name, '.');
    size_t length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    size_t digits = length;
    while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9')
        digits--;
    if (digits > 1 && digits < length && name[digits - 1] == '-')
        length = digits - 1;
    snprintf(path, 256, "%.*s-%d.yaml", (int)(length < 200 ? length : 200), name, number);
}

bool save_scene(const Save *save, const char *output, Saved *out, Error *error)
{
    bool there;
    *out = (Saved){.lost = false};
    if (output && access(output, F_OK) == 0)
        return error_set(error, "%s: is there already; name another file", output);
    if (output)
        return write_new(save, output, out, &there, error) ||
               (there && error_set(error, "%s: is there already; name another file", output));
    for (int number = 2; number < NAMES_MOST; number++) {
        char path[256];
        new_name(save->path, number, path);
        if (access(path, F_OK) == 0)
            continue;
        setting_list_free(&out->changed);
        if (write_new(save, path, out, &there, error))
            return true;
        if (!there)
            return false;
    }
    return error_set(error, "%s: there are too many of its name here already", save->path);
}

void saved_words(const Saved *saved, char *text, size_t size)
{
    char keys[240];
    differ_words(&saved->changed, keys, sizeof keys);
    snprintf(text, size, "%s: the scene%s%s%s%s%s", saved->path, *keys ? " with " : " as it was", keys,
             saved->lost ? "; a part was written anew, without its comments" : "",
             *saved->lacks ? "; not kept: " : "", saved->lacks);
}
