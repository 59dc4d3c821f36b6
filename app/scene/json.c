#include "app/scene/json.h"

#include "app/scene/keys.h"

#include <stdlib.h>
#include <string.h>

/* Finds the key of "fluids[0].viscosity", which is "fluids[].viscosity" in the table. */
static const Key *find_key(const char *path)
{
    char name[128];
    size_t used = 0;
    for (const char *at = path; *at && used + 1 < sizeof name; at++) {
        name[used++] = *at;
        if (*at == '[')
            at += strspn(at + 1, "0123456789");
    }
    name[used] = '\0';
    return scene_key_find(name);
}

/* Converts "[x, z]". */
static json_t *names_json(char *text)
{
    json_t *names = json_array();
    for (char *name = strtok(text, "[], "); name; name = strtok(NULL, "[], "))
        json_array_append_new(names, json_string(name));
    return names;
}

static json_t *value_json(const Key *key, char *text)
{
    json_t *value = NULL;
    if (key->type == KEY_AXES || key->type == KEY_NAMES)
        return names_json(text);
    if (key->type != KEY_TEXT && key->type != KEY_CHOICE)
        value = json_loads(text, JSON_DECODE_ANY, NULL);
    return value ? value : json_string(text);
}

/* Adds a line "path = value unit". */
static void add_line(json_t *settings, char *line)
{
    char *equals = strstr(line, " = ");
    if (!equals)
        return;
    *equals = '\0';
    char *text = equals + strlen(" = ");
    const Key *key = find_key(line);
    if (!key)
        return;
    const size_t length = strlen(text), unit = *key->unit ? strlen(key->unit) + 1 : 0;
    text[length > unit ? length - unit : length] = '\0';
    json_t *setting = json_pack("{s:o}", "value", value_json(key, text));
    if (unit > 0)
        json_object_set_new(setting, "unit", json_string(key->unit));
    json_object_set_new(settings, line, setting);
}

json_t *scene_json(const Scene *scene)
{
    char *text = scene_print_text(scene);
    json_t *settings = text ? json_object() : NULL;
    for (char *at = text, *line; at && (line = strsep(&at, "\n"));)
        add_line(settings, line);
    free(text);
    return settings;
}
