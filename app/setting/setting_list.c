#include "app/setting/setting_list.h"

#include "app/yaml/print.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool same_path(const char *a, const char *b)
{
    const size_t length = scene_setting_key(a);
    return length == scene_setting_key(b) && strncmp(a, b, length) == 0;
}

static void take_out(SettingList *list, int at)
{
    free(list->set[at]);
    list->count--;
    memmove(&list->set[at], &list->set[at + 1], (size_t)(list->count - at) * sizeof *list->set);
}

void setting_list_add(SettingList *list, const char *setting)
{
    for (int i = list->count - 1; i >= 0; i--)
        if (same_path(list->set[i], setting))
            take_out(list, i);
    char *own = list->count < SETTING_LIST_MAX ? strdup(setting) : NULL;
    if (own)
        list->set[list->count++] = own;
    else
        list->lacks = true;
}

void setting_list_add_text(SettingList *list, const char *path, const char *text)
{
    const Node node = {.kind = NODE_SCALAR, .text = text};
    char *setting = NULL;
    size_t size;
    FILE *file = open_memstream(&setting, &size);
    if (!file) {
        list->lacks = true;
        return;
    }
    fprintf(file, "%s=", path);
    node_print(&node, file);
    if (fclose(file) == 0 && setting)
        setting_list_add(list, setting);
    else
        list->lacks = true;
    free(setting);
}

void setting_list_join(SettingList *list, const SettingList *more)
{
    for (int i = 0; i < more->count; i++)
        setting_list_add(list, more->set[i]);
    list->lacks |= more->lacks;
}

void setting_list_join_scene(SettingList *list, const SceneSettings *settings)
{
    for (int i = 0; i < settings->count; i++)
        setting_list_add(list, settings->set[i]);
}

void setting_list_remove(SettingList *list, const SettingList *paths)
{
    for (int i = list->count - 1; i >= 0; i--)
        for (int k = 0; k < paths->count; k++)
            if (same_path(list->set[i], paths->set[k])) {
                take_out(list, i);
                break;
            }
}

/* True if `setting` writes a list whole, and `other` changes an element of the list. */
static bool holds(const char *setting, const char *other)
{
    const size_t length = scene_setting_key(setting);
    return strncmp(setting + length, "=[{", 3) == 0 && strncmp(setting, other, length) == 0 &&
           other[length] == '[';
}

/* Removes settings that hold a path of `paths` (`around`), or that a path of `paths` holds. */
static void remove_held(SettingList *list, const SettingList *paths, bool around)
{
    for (int i = list->count - 1; i >= 0; i--) {
        bool found = false;
        for (int k = 0; k < paths->count; k++)
            found |= around ? holds(list->set[i], paths->set[k]) : holds(paths->set[k], list->set[i]);
        if (found)
            take_out(list, i);
    }
}

void setting_list_remove_around(SettingList *list, const SettingList *paths)
{
    remove_held(list, paths, true);
}

void setting_list_remove_within(SettingList *list, const SettingList *paths)
{
    remove_held(list, paths, false);
}

void setting_list_remove_under(SettingList *list, const char *begin)
{
    for (int i = list->count - 1; i >= 0; i--)
        if (strncmp(list->set[i], begin, strlen(begin)) == 0)
            take_out(list, i);
}

bool setting_list_settings(const SettingList *list, SceneSettings *out, Error *error)
{
    if (list->lacks)
        return error_set(error, "no memory for the settings, or more than %d of them", SETTING_LIST_MAX);
    if (list->count > SCENE_SETTINGS_MAX)
        return error_set(error, "%d settings, and a scene takes at most %d", list->count, SCENE_SETTINGS_MAX);
    *out = (SceneSettings){.count = list->count};
    memcpy(out->set, list->set, (size_t)list->count * sizeof *list->set);
    return true;
}

void setting_list_free(SettingList *list)
{
    for (int i = 0; i < list->count; i++)
        free(list->set[i]);
    *list = (SettingList){.count = 0};
}
