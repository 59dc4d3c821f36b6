#include "app/run/playback/playback.h"

#include "app/files/snapshot_hdf5.h"
#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/base.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- settings of the command line ---- */

/* True for settings such as "view.radius=1", "views=[{}, {kind: slice}]" and "views[1].radius=1". */
static bool is_of_view(const char *setting)
{
    return strncmp(setting, "view.", strlen("view.")) == 0 ||
           strncmp(setting, "views=", strlen("views=")) == 0 ||
           strncmp(setting, "views[", strlen("views[")) == 0;
}

/* Keys for values missing in foreign files. */
static const struct {
    const char *path;
    int count; /* numbers, in brackets if more than one */
    size_t offset;
} assumed[] = {
    {"particles.spacing=", 1, offsetof(SnapshotAssumptions, spacing)},
    {"particles.support=", 1, offsetof(SnapshotAssumptions, support)},
    {"fluids[0].density=", 1, offsetof(SnapshotAssumptions, density)},
    {"box.size=", 3, offsetof(SnapshotAssumptions, box_size)},
    {"solver.step.dt=", 1, offsetof(SnapshotAssumptions, interval)},
    {"gravity=", 3, offsetof(SnapshotAssumptions, gravity)},
};
enum { ASSUMED = sizeof assumed / sizeof *assumed };

/* Number of the row of a setting; ASSUMED: none. */
static int assumed_row(const char *setting)
{
    int row = 0;
    while (row < ASSUMED && strncmp(setting, assumed[row].path, strlen(assumed[row].path)) != 0)
        row++;
    return row;
}

bool recorded_assumptions(const char *path, const SceneSettings *settings, SnapshotAssumptions *out,
                          Error *error)
{
    *out = (SnapshotAssumptions){.spacing = 0};
    for (int i = 0; settings && i < settings->count; i++) {
        const int row = assumed_row(settings->set[i]);
        if (row == ASSUMED)
            continue;
        const char *at = settings->set[i] + strlen(assumed[row].path);
        double *to = (double *)((char *)out + assumed[row].offset);
        char *end;
        int count = 0;
        for (at += strspn(at, " ["); count < assumed[row].count; count++, at = end + strspn(end, " ,")) {
            to[count] = strtod(at, &end);
            if (end == at || !isfinite(to[count]) || (to[count] <= 0 && to != out->gravity))
                break;
        }
        if (count < assumed[row].count - (assumed[row].count > 1) || at[strspn(at, " ]")])
            return error_set(error, "%.200s: --set %.100s is no such number; write one such as --set %s%s",
                             path, settings->set[i], assumed[row].path,
                             assumed[row].count > 1 ? "[1,1,1]" : "0.01");
    }
    return true;
}

static bool check_settings(const char *path, bool foreign, const SceneSettings *settings, Error *error)
{
    if (settings->particles > 0)
        return error_set(error, "--particles %zu makes no sense for %s: it has the particles that it has",
                         settings->particles, path);
    for (int i = 0; i < settings->count; i++) {
        const char *said = settings->said[i];
        if (!is_of_view(settings->set[i]) && !(foreign && assumed_row(settings->set[i]) < ASSUMED))
            return error_set(
                error,
                "%s%s makes no sense for %s: nothing is simulated; of a file's keys those of the view "
                "can be set, --set view.radius=1 and so on%s",
                said ? said : "--set ", said ? "" : settings->set[i], path,
                foreign
                    ? ", and particles.spacing, particles.support, fluids[0].density, box.size, solver.step.dt, gravity"
                    : "");
    }
    return true;
}

/* ---- settings of the file ---- */

/* Settings of the file that could not be used. */
typedef struct UnknownSettings {
    int count;
    char first[64]; /* a key */
} UnknownSettings;

static void add_strange(UnknownSettings *strange, const char *key)
{
    if (strange->count++ == 0)
        snprintf(strange->first, sizeof strange->first, "%.60s", key);
}

/* Prints a setting as YAML: text in quotes, as it may contain anything; other values unchanged, without
   unit. */
static bool print_setting(const Key *key, const char *path, const char *value, char *setting, size_t size)
{
    const size_t length = strlen(value), unit = strlen(key->unit);
    const bool has_unit = unit > 0 && length > unit + 1 && strcmp(value + length - unit, key->unit) == 0;
    FILE *file = fmemopen(setting, size, "w");
    if (!file)
        return false;
    fprintf(file, "%s=", path);
    if (key->type == KEY_TEXT) {
        fputc('"', file);
        for (const char *at = value; *at; at++)
            fprintf(file, "%s%c", *at == '"' || *at == '\\' ? "\\" : "", *at);
        fputc('"', file);
    } else {
        fprintf(file, "%.*s", (int)(has_unit ? length - unit - 1 : length), value);
    }
    return fclose(file) == 0 && strlen(setting) + 1 < size;
}

/* True for a default colour: colours are written with three digits, and defaults may have more. */
static bool is_default_color(const Key *key, const char *value)
{
    Scene scene;
    char own[128];
    if (key->type != KEY_COLOR || strstr(key->path, "[]"))
        return false;
    scene_default(&scene);
    key_value_text(key, &scene, own, sizeof own);
    return strcmp(own, value) == 0;
}

/* Adds one line, "key = value unit". */
static void add_line(YamlTree *tree, char *line, UnknownSettings *strange)
{
    enum { SETTING_SIZE = 4096 };
    char *equals = strstr(line, " = "), setting[SETTING_SIZE];
    Error none = {{0}};
    if (!equals)
        return;
    *equals = 0;
    const Key *key = scene_key_find(line);
    if (key && is_default_color(key, equals + strlen(" = ")))
        return;
    if (!key || !print_setting(key, line, equals + strlen(" = "), setting, sizeof setting) ||
        !tree_set(tree, setting, "", &none))
        add_strange(strange, line);
}

static void add_lines(YamlTree *tree, char *settings, UnknownSettings *strange)
{
    char *rest = settings;
    for (char *line = strtok_r(settings, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
        add_line(tree, line, strange);
}

/* ---- attributes of the file ---- */

__attribute__((format(printf, 3, 4))) static bool set(YamlTree *tree, Error *error, const char *format, ...)
{
    char setting[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(setting, sizeof setting, format, arguments);
    va_end(arguments);
    return tree_set(tree, setting, "", error);
}

/* Adds the numbers required by every scene; a box of two numbers makes a two-dimensional scene. */
static bool add_numbers(YamlTree *tree, const SnapshotScene *numbers, Error *error)
{
    const double *box = numbers->box_size;
    bool ok = numbers->dimensions == 2
                  ? set(tree, error, "box.size=[%.17g, %.17g]", box[0], box[1])
                  : set(tree, error, "box.size=[%.17g, %.17g, %.17g]", box[0], box[1], box[2]);
    ok = ok && set(tree, error, "particles.spacing=%.17g", numbers->spacing) &&
         set(tree, error, "particles.support=%.17g", numbers->support_radius / numbers->spacing);
    for (size_t i = 0; ok && i < numbers->fluid_count; i++)
        ok = set(tree, error, "fluids[%zu].density=%.17g", i, numbers->density[i]);
    return ok;
}

/* Adds a fill per fluid, required by every scene, if the file has no settings. */
static bool add_fills(YamlTree *tree, const SnapshotScene *numbers, Error *error)
{
    const double *box = numbers->box_size;
    bool ok = true;
    for (size_t i = 0; ok && i < numbers->fluid_count; i++)
        ok = set(tree, error, "fluids[%zu].fill=[{block: {min: [%.17g, 0, 0], max: [%.17g, %.17g, %.17g]}}]",
                 i, -box[0] / 2, box[0] / 2, box[1], numbers->dimensions == 3 ? box[2] / 2 : 0);
    return ok;
}

/* Returns the YAML of a scene, from the file's settings, or from its attributes without settings. The
   caller frees the text. Returns NULL with the reason. */
static char *print_yaml(const char *path, char *settings, const SnapshotScene *numbers,
                        UnknownSettings *strange, Error *error)
{
    static const char empty[] = "box:\n";
    YamlTree tree;
    char *text = NULL;
    size_t size = 0;
    bool ok = tree_read(&tree, path, empty, strlen(empty), error);
    if (ok && settings)
        add_lines(&tree, settings, strange);
    ok = ok && (settings || add_fills(&tree, numbers, error)) && add_numbers(&tree, numbers, error);
    FILE *file = ok ? open_memstream(&text, &size) : NULL;
    if (file) {
        tree_print(&tree, file);
        ok = fclose(file) == 0;
    }
    tree_free(&tree);
    if (ok && file)
        return text;
    free(text);
    return NULL;
}

/* Copies numbers with all bits. */
static void take_numbers(const SnapshotReader *reader, const SnapshotScene *numbers, Scene *scene)
{
    WorldDef *def = &scene->world;
    double colors[FLUIDS_MAX][3];
    const size_t colored = snapshot_read_colors(reader, colors);
    def->spacing = numbers->spacing;
    def->support = numbers->support_radius / numbers->spacing;
    memcpy(def->box_size, numbers->box_size, sizeof def->box_size);
    for (size_t i = 0; i < colored && i < (size_t)def->fluid_count; i++)
        for (int k = 0; k < 3; k++)
            def->fluids[i].color[k] = (float)srgb_to_linear(colors[i][k]);
}

/* Reads the scene, with the file's settings if `with_settings`. Returns false also if the settings are no
   valid scene. */
static bool read_scene(const SnapshotReader *reader, const char *path, bool with_settings,
                       const SceneSettings *settings, const SnapshotScene *numbers, Scene *scene,
                       Notes *notes, UnknownSettings *strange, Error *error)
{
    SceneSettings applied = settings ? *settings : (SceneSettings){.count = 0};
    char *text = with_settings ? snapshot_root_text(reader, SNAPSHOT_SETTINGS) : NULL;
    char *folder = snapshot_root_text(reader, SNAPSHOT_FOLDER);
    applied.recorded = true;
    applied.folder = folder;
    *strange = (UnknownSettings){.count = 0};
    char *yaml = with_settings && !text ? NULL : print_yaml(path, text, numbers, strange, error);
    const bool ok = yaml && scene_parse(path, yaml, strlen(yaml), &applied, scene, notes, error);
    free(yaml);
    free(text);
    free(folder);
    return ok;
}

static void tell_strange(const char *path, const UnknownSettings *strange, Notes *notes)
{
    if (strange->count > 0)
        notes_add(notes, "%.200s: %d of its settings %s not known to this slosh, such as '%s'; left out",
                  path, strange->count, strange->count == 1 ? "is" : "are", strange->first);
}

/* On failure, retries without the command line's settings, to find out if the command line or the file is
   wrong. */
static bool build(const SnapshotReader *reader, const char *path, bool foreign, const SceneSettings *settings,
                  const SnapshotScene *numbers, Scene *scene, Notes *notes, Error *error)
{
    UnknownSettings strange;
    Error why = {{0}};
    if (read_scene(reader, path, true, settings, numbers, scene, notes, &strange, error)) {
        tell_strange(path, &strange, notes);
        return true;
    }
    if (read_scene(reader, path, true, NULL, numbers, scene, NULL, &strange, &why) ||
        !read_scene(reader, path, false, settings, numbers, scene, notes, &strange, error))
        return false;
    if (foreign) /* no settings are expected */
        return true;
    notes_add(notes, "%.120s: %s%.160s; shown without solids, and with the view's defaults", path,
              *why.message ? "its settings are no scene of this slosh: " : "says nothing of its settings",
              why.message);
    return true;
}

bool recorded_scene(const SnapshotReader *reader, const char *path, bool foreign,
                    const SceneSettings *settings, SnapshotScene *numbers, Scene *scene, Notes *notes,
                    Error *error)
{
    SceneSettings views = {.count = 0};
    if ((settings && !check_settings(path, foreign, settings, error)) ||
        !snapshot_read_scene(reader, numbers, error))
        return false;
    if (foreign && settings) { /* assumptions are in the numbers */
        views = *settings;
        views.count = 0;
        for (int i = 0; i < settings->count; i++)
            if (assumed_row(settings->set[i]) == ASSUMED) {
                views.set[views.count] = settings->set[i];
                views.said[views.count++] = settings->said[i];
            }
    }
    if (!build(reader, path, foreign, foreign ? &views : settings, numbers, scene, notes, error))
        return false;
    take_numbers(reader, numbers, scene);
    return true;
}
