#include "app/setting/carry.h"

#include "app/base/picture_text.h"
#include "app/scene/tables.h"
#include "app/yaml/patch.h"
#include "app/yaml/yaml.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A FileNamed: adds a setting with only the last part of a whole path. */
static void leave_folder(void *user, Node *node, const char *path)
{
    const char *slash = strrchr(node->text, '/');
    if (slash && (*node->text == '/' || *node->text == '~'))
        setting_list_add_text(user, path, slash + 1);
}

/* Shortens the whole paths in the text, which is replaced. Returns false if such a path remains. */
static bool leave_paths(char **text, Error *error)
{
    SettingList names = {.count = 0};
    Tree tree;
    bool ok = tree_read(&tree, "the scene", *text, strlen(*text), error);
    if (ok)
        scene_each_file(&tree, leave_folder, &names);
    for (int i = 0; ok && i < names.count; i++) {
        char *next = yaml_patch("the scene", *text, strlen(*text), names.set[i], NULL, error);
        ok = next != NULL;
        if (ok)
            free(*text);
        *text = ok ? next : *text;
    }
    ok = ok && !names.lacks;
    tree_free(&tree);
    setting_list_free(&names);
    return ok;
}

bool carry_make(const Save *save, Carried *out, Error *error)
{
    char beside[1100];
    Saved saved;
    const char *slash = strrchr(save->path, '/'), *name = slash ? slash + 1 : save->path;
    *out = (Carried){.scene = NULL};
    snprintf(beside, sizeof beside, "%.*spicture.png", (int)(name - save->path), save->path);
    char *text = save_text(save, beside, &saved, error);
    setting_list_free(&saved.changed);
    if (!text || !leave_paths(&text, error) ||
        (strlen(text) > PICTURE_TEXT_MAX && !error_set(error, "%s: more than 1 MiB of text", save->path))) {
        free(text);
        return false;
    }
    out->scene = text;
    snprintf(out->name, sizeof out->name, "%s", name);
    return true;
}

ImageText carry_text(const Carried *carried, double time)
{
    return (ImageText){carried->scene, carried->name, time};
}

void carry_free(Carried *carried)
{
    free(carried->scene);
    *carried = (Carried){.scene = NULL};
}
