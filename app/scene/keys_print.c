/* Prints the table of keys and a scene's settings for people. */
#include "app/scene/scene.h"

#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/base.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 128 };

static bool is_container(KeyType type)
{
    return type == KEY_MAPPING || type == KEY_VARIANT || type == KEY_LIST;
}

/* Sources of the default column: an empty scene and, for list members, an initial element. */
typedef union Defaults {
    Scene scene;
    char element[sizeof(Scene)];
} Defaults;

/* The innermost list around the key; NULL: none. */
static const Key *list_around(const Key *key)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s", key->path);
    char *end = NULL;
    for (char *at = path; (at = strstr(at, "[]")); at += strlen("[]"))
        end = at;
    if (end)
        *end = '\0';
    return end ? scene_key_find(path) : NULL;
}

static void defaults_of(const Key *key, Defaults *defaults)
{
    const Key *list = list_around(key);
    memset(defaults, 0, sizeof *defaults);
    if (!list)
        scene_default(&defaults->scene);
    else if (list->init)
        list->init(defaults->element, 0);
}

static void print_default(const Key *key, FILE *file)
{
    Defaults defaults;
    char value[128] = "";
    if (key->flags & KEY_REQUIRED)
        snprintf(value, sizeof value, "required");
    else if (key->fallback)
        snprintf(value, sizeof value, "%s", key->fallback);
    else if (!is_container(key->type)) {
        defaults_of(key, &defaults);
        key_value_text(key, &defaults, value, sizeof value);
        if (key->zero && strcmp(value, "0") == 0)
            snprintf(value, sizeof value, "%s", key->zero);
    }
    fprintf(file, " %s |", value);
}

void scene_keys_print(FILE *file)
{
    static const char *const types[] = {
        [KEY_MAPPING] = "mapping",
        [KEY_VARIANT] = "mapping",
        [KEY_LIST] = "list",
        [KEY_NUMBER] = "number",
        [KEY_CURVE] = "number or table",
        [KEY_INTEGER] = "whole number",
        [KEY_BOOLEAN] = "boolean",
        [KEY_TEXT] = "text",
        [KEY_CHOICE] = "name",
        [KEY_VEC3] = "[x, y, z]",
        [KEY_AXES] = "list of axes",
        [KEY_NAMES] = "list of names",
        [KEY_COLOR] = "[r, g, b]",
        [KEY_RANGE] = "[low, high]",
        [KEY_POINTS] = "name or points",
        [KEY_SETTINGS] = "mapping of settings",
    };
    int count;
    const Key *keys = scene_keys(&count);
    fprintf(file, "| key | type | unit | range | default | live | meaning |\n");
    fprintf(file, "| --- | --- | --- | --- | --- | --- | --- |\n");
    for (int i = 0; i < count; i++) {
        char range[1024], help[512];
        key_help_text(&keys[i], help, sizeof help);
        key_range_text(&keys[i], range, sizeof range);
        fprintf(file, "| `%s` | %s%s | %s | %s%s |", keys[i].path, types[keys[i].type],
                keys[i].flags & KEY_WORDS ? " or list" : "", keys[i].unit, range,
                keys[i].type == KEY_LIST                                   ? " entries"
                : keys[i].type == KEY_TEXT || keys[i].type == KEY_SETTINGS ? " bytes"
                                                                           : "");
        print_default(&keys[i], file);
        fprintf(file, " %s | %s |\n", keys[i].flags & KEY_LIVE ? "yes" : "", help);
    }
}

/* Position of a printing walk: the row's parent, the parent with indices, and the base of offsets. */
typedef struct PrintWalk {
    char parent[PATH_SIZE], shown[PATH_SIZE];
    const char *base;
    const char
        *like; /* base of the mapping that the element copies: only differences are printed; NULL: all */
} PrintWalk;

static void print_children(const PrintWalk *walk, FILE *file);

/* Prints the elements as {}, so that elements without differences appear too. */
static void print_elements(const char *shown, int count, FILE *file)
{
    fprintf(file, "%s = [", shown);
    for (int e = 0; e < count; e++)
        fputs(e > 0 ? ", {}" : "{}", file);
    fputs("]\n", file);
}

static void print_list(const Key *key, const PrintWalk *walk, const char *shown, FILE *file)
{
    const int elements = *(const int *)(walk->base + key->aux);
    const KeyListMapping *like = key_list_mapping(key);
    if (like && elements > 0)
        print_elements(shown, elements, file);
    for (int e = 0; e < elements; e++) {
        PrintWalk inner = {.base = key_element(key, walk->base, e), .like = like ? walk->base : NULL};
        snprintf(inner.parent, PATH_SIZE, "%.120s%s", like ? like->mapping : key->path, like ? "" : "[]");
        snprintf(inner.shown, PATH_SIZE, "%.110s[%d]", shown, e);
        print_children(&inner, file);
    }
}

static bool is_absent(const Key *key, const char *base)
{
    if (key->type == KEY_VARIANT)
        return *(const int *)(base + key->aux) != key->variant;
    return key->type == KEY_MAPPING && key->aux != KEY_NOWHERE && *(const bool *)(base + key->aux);
}

static void print_key(const Key *key, const PrintWalk *walk, const char *shown, FILE *file)
{
    char value[FILE_NAME_SIZE], like[sizeof value]; /* longer than a curve */
    PrintWalk inner = {.base = walk->base, .like = walk->like};
    switch (key->type) {
    case KEY_MAPPING:
    case KEY_VARIANT:
        if (is_absent(key, walk->base))
            return;
        snprintf(inner.parent, PATH_SIZE, "%s", key->path);
        snprintf(inner.shown, PATH_SIZE, "%s", shown);
        print_children(&inner, file);
        break;
    case KEY_LIST:
        print_list(key, walk, shown, file);
        break;
    default:
        key_value_text(key, walk->base, value, sizeof value);
        if (walk->like)
            key_value_text(key, walk->like, like, sizeof like);
        if (!*value && (key->type == KEY_SETTINGS || key->type == KEY_TEXT)) /* no value to set */
            return;
        if (!walk->like || strcmp(value, like) != 0)
            fprintf(file, "%s = %s%s%s\n", shown, value, *key->unit ? " " : "", key->unit);
    }
}

static void print_children(const PrintWalk *walk, FILE *file)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], walk->parent);
        char shown[PATH_SIZE];
        if (!name)
            continue;
        snprintf(shown, sizeof shown, "%.80s%s%.40s", walk->shown, *walk->shown ? "." : "", name);
        print_key(&keys[i], walk, shown, file);
    }
}

void scene_print(const Scene *scene, FILE *file)
{
    const PrintWalk walk = {.base = (const char *)scene};
    print_children(&walk, file);
}

char *scene_print_text(const Scene *scene)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    scene_print(scene, file);
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

_Static_assert(KEY_EXACT_SIZE >= TIME_TABLE_ROWS * 48, "a curve has no room");

static int exact_number(double value, char *text, size_t size)
{
    char digits[40];
    snprintf(digits, sizeof digits, "%.9g", value);
    if (strtod(digits, NULL) != value)
        snprintf(digits, sizeof digits, "%.17g", value);
    return snprintf(text, size, "%s", digits);
}

static void exact_numbers(const double *values, int count, char *text, size_t size)
{
    int used = snprintf(text, size, "[");
    for (int k = 0; k < count; k++) {
        used += exact_number(values[k], text + used, size - (size_t)used);
        used += snprintf(text + used, size - (size_t)used, k + 1 < count ? ", " : "]");
    }
}

static void exact_color(const Key *key, const void *field, char *text, size_t size)
{
    double color[3];
    for (int k = 0; k < 3; k++)
        color[k] =
            linear_to_srgb(key->flags & KEY_SINGLE ? ((const float *)field)[k] : ((const double *)field)[k]);
    snprintf(text, size, "[%.9g, %.9g, %.9g]", color[0], color[1], color[2]);
}

static void quoted(const char *words, char *text, size_t size)
{
    const YamlNode node = {.kind = NODE_SCALAR, .text = words};
    FILE *file = fmemopen(text, size, "w");
    *text = 0;
    if (!file)
        return;
    node_print(&node, file);
    fclose(file);
}

/* The box of a two-dimensional scene has no depth of its own. */
void key_exact_text(const Key *key, const void *base, int dimensions, char *text, size_t size)
{
    const void *field = (const char *)base + key->offset;
    const bool plane = dimensions == 2 && strcmp(key->path, "box.size") == 0;
    key_value_text(key, base, text, size);
    if (key->offset == KEY_NOWHERE)
        return;
    if (key->type == KEY_NUMBER || (key->type == KEY_CURVE && *text != '['))
        exact_number(*(const double *)field, text, size);
    else if (key->type == KEY_VEC3 || (key->type == KEY_RANGE && *text == '['))
        exact_numbers(field, key->type == KEY_RANGE || plane ? 2 : 3, text, size);
    else if (key->type == KEY_COLOR)
        exact_color(key, field, text, size);
    else if (key->type == KEY_TEXT && *text)
        quoted(key_text(key, field), text, size);
}

/* ---- lists ---- */

/* Position of a walk through an element. */
typedef struct ElementPrint {
    const char *base, *like; /* the element; a default element */
    int dimensions;
    FILE *file;
    int said; /* count of keys written in the present mapping */
} ElementPrint;

static void say_children(ElementPrint *within, const char *parent);

static void say_name(ElementPrint *within, const char *name)
{
    fprintf(within->file, "%s%s: ", within->said++ > 0 ? ", " : "", name);
}

static void say_mapping(ElementPrint *within, const Key *key, const char *name)
{
    char *words = NULL;
    size_t size = 0;
    ElementPrint inner = *within;
    inner.said = 0;
    inner.file = open_memstream(&words, &size);
    if (!inner.file)
        return;
    say_children(&inner, key->path);
    if (fclose(inner.file) == 0 && (inner.said > 0 || key->type == KEY_VARIANT)) {
        say_name(within, name);
        fprintf(within->file, "{%s}", words);
    }
    free(words);
}

static void say_value(ElementPrint *within, const Key *key, const char *name)
{
    char text[KEY_EXACT_SIZE], usual[KEY_EXACT_SIZE];
    key_exact_text(key, within->base, within->dimensions, text, sizeof text);
    key_exact_text(key, within->like, within->dimensions, usual, sizeof usual);
    if (!*text || (!(key->flags & KEY_REQUIRED) && strcmp(text, usual) == 0))
        return;
    say_name(within, name);
    fputs(text, within->file);
}

bool key_is_present(const Key *key, const char *base)
{
    if (key->type == KEY_VARIANT)
        return *(const int *)(const void *)(base + key->aux) == key->variant;
    return key->aux == KEY_NOWHERE || !*(const bool *)(base + key->aux);
}

static void say_children(ElementPrint *within, const char *parent)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const Key *key = &keys[i];
        const char *name = key_name_in(key, parent);
        if (!name)
            continue;
        if (key->type == KEY_LIST) {
            if (*(const int *)(const void *)(within->base + key->aux) == 0)
                continue;
            say_name(within, name);
            key_exact_list(key, within->base, within->dimensions, within->file);
        } else if (key->type != KEY_MAPPING && key->type != KEY_VARIANT) {
            say_value(within, key, name);
        } else if (key_is_present(key, within->base)) {
            say_mapping(within, key, name);
        }
    }
}

void key_exact_list(const Key *list, const void *base, int dimensions, FILE *file)
{
    const int count = *(const int *)(const void *)((const char *)base + list->aux);
    char parent[128];
    snprintf(parent, sizeof parent, "%.120s[]", list->path);
    fputc('[', file);
    for (int e = 0; e < count; e++) {
        char *usual = calloc(1, list->size);
        ElementPrint within = {
            .base = key_element(list, base, e), .like = usual, .dimensions = dimensions, .file = file};
        if (usual && list->init)
            list->init(usual, e);
        fputs(e > 0 ? ", {" : "{", file);
        if (usual)
            say_children(&within, parent);
        fputc('}', file);
        free(usual);
    }
    fputc(']', file);
}

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
