#define _GNU_SOURCE /* asprintf */
#include "app/scene/scene.h"

#include "app/base/file.h"
#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/base.h"
#include "sim/flow/flow.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Converts the quaternion to an axis and an angle of at most half a turn. */
static void axis_of(const double q[4], double axis[3], double *angle_deg)
{
    const double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), sign = q[3] < 0 ? -1 : 1;
    *angle_deg = 2 * atan2(sine, sign * q[3]) * (180 / M_PI);
    for (int k = 0; k < 3 && sine > 0; k++)
        axis[k] = sign * q[k] / sine;
}

/* Applies the turn on top of the solid's own turn. */
static void turn(SolidDef *solid, const double by[4])
{
    double rest[4];
    if (solid->kind == SOLID_CYLINDER || solid->kind == SOLID_BOWL) {
        quat_rotate(by, solid->axis, solid->axis);
    } else if (solid->kind != SOLID_SPHERE) {
        solid_turn(solid->axis, solid->angle_deg, rest);
        quat_multiply(by, rest, rest);
        axis_of(rest, solid->axis, &solid->angle_deg);
    }
}

/* Turns the axes of the rotations; translations stay. Returns false if memory is short. */
static bool turn_motions(SolidDef *solid, const double by[4])
{
    const size_t size = (size_t)solid->motion_count * sizeof *solid->motions;
    Motion *motions = bytes_copy(solid->motions, size);
    for (int i = 0; motions && i < solid->motion_count; i++)
        if (!motion_translates(&motions[i]))
            quat_rotate(by, motions[i].axis, motions[i].axis);
    solid->motions = bytes_give(motions, size);
    return solid->motions || size == 0;
}

static bool settle(SolidDef *solid)
{
    const SolidHand hand = solid->hand;
    for (int k = 0; k < 3; k++)
        solid->centre[k] += hand.at[k];
    solid->hand = (SolidHand){.moved = false};
    if (hand.turn[0] == 0 && hand.turn[1] == 0 && hand.turn[2] == 0)
        return true;
    turn(solid, hand.turn);
    return turn_motions(solid, hand.turn);
}

static bool close_emitters(FluidDef *fluid, int f, uint64_t closed_gates)
{
    const size_t size = (size_t)fluid->emit_count * sizeof *fluid->emits;
    Emit *emits = bytes_copy(fluid->emits, size);
    for (int i = 0; emits && i < fluid->emit_count; i++)
        emits[i].closed = gate_is_closed(closed_gates, gate_of_emitter(f, i));
    fluid->emits = bytes_give(emits, size);
    return fluid->emits || size == 0;
}

static bool close_drains(WorldDef *def, uint64_t closed_gates)
{
    const size_t size = (size_t)def->drain_count * sizeof *def->drains;
    Fill *drains = bytes_copy(def->drains, size);
    for (int k = 0; drains && k < def->drain_count; k++)
        drains[k].closed = gate_is_closed(closed_gates, gate_of_drain(k));
    def->drains = bytes_give(drains, size);
    return def->drains || size == 0;
}

bool world_def_apply_moves(WorldDef *def, uint64_t closed_gates, Error *error)
{
    bool enough = close_drains(def, closed_gates);
    for (int i = 0; i < def->solid_count; i++)
        if (def->solids[i].hand.moved)
            enough &= settle(&def->solids[i]);
    for (int f = 0; f < def->fluid_count; f++)
        enough &= close_emitters(&def->fluids[f], f, closed_gates);
    return enough || error_set(error, "no memory for the lists of a scene");
}

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
    const YamlNode node = {.kind = NODE_SCALAR, .text = text};
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

enum { PATH = DIFFERENCE_PATH_SIZE };

/* Position of a walk through two scenes, like the walk of scene_print. */
typedef struct DifferenceWalk {
    char parent[PATH], shown[PATH];
    const char *before; /* NULL: absent before; all is written */
    const char *now;
    SceneDifference *out;
} DifferenceWalk;

static void walk_children(const DifferenceWalk *walk, int dimensions);

static void add(const DifferenceWalk *walk, const Key *key, const char *shown, const char *value)
{
    static const char *const of_machine[] = {"solver.threads", "solver.simd"};
    char *setting = NULL;
    if (asprintf(&setting, "%s=%s", shown, value) < 0)
        setting = NULL;
    if (setting)
        setting_list_add(&walk->out->settings, setting);
    walk->out->settings.lacks |= !setting;
    free(setting);
    const bool idle = key->flags & KEY_IDLE;
    bool machine = false;
    for (size_t i = 0; i < sizeof of_machine / sizeof *of_machine; i++)
        machine |= strcmp(key->path, of_machine[i]) == 0;
    walk->out->world |= !idle && !machine;
    walk->out->dead |= !(key->flags & KEY_LIVE) && (!idle || machine);
}

static void walk_element(const Key *list, const DifferenceWalk *walk, const char *shown, int e, int before,
                         int dimensions)
{
    const KeyListMapping *like = key_list_mapping(list);
    DifferenceWalk inner = {.now = key_element(list, walk->now, e), .out = walk->out, .before = walk->before};
    if (e < before)
        inner.before = key_element(list, walk->before, e);
    snprintf(inner.parent, PATH, "%.120s%s", like ? like->mapping : list->path, like ? "" : "[]");
    snprintf(inner.shown, PATH, "%.110s[%d]", shown, e);
    walk_children(&inner, dimensions);
}

static bool is_absent(const Key *key, const char *base)
{
    return !base || !key_is_present(key, base);
}

/* True if the elements in both scenes have the same kinds. */
static bool same_kinds(const Key *list, const DifferenceWalk *walk, int elements)
{
    char parent[PATH];
    int count;
    const Key *keys = scene_keys(&count);
    bool same = true;
    snprintf(parent, sizeof parent, "%.120s[]", list->path);
    for (int i = 0; i < count; i++)
        for (int e = 0; e < elements && keys[i].type == KEY_VARIANT && key_name_in(&keys[i], parent); e++)
            same &= is_absent(&keys[i], key_element(list, walk->before, e)) ==
                    is_absent(&keys[i], key_element(list, walk->now, e));
    return same;
}

static void add_whole(const DifferenceWalk *walk, const Key *list, const char *shown, int dimensions)
{
    char *value = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&value, &size);
    if (file)
        key_exact_list(list, walk->now, dimensions, file);
    if (file && fclose(file) == 0 && value)
        add(walk, list, shown, value);
    else
        walk->out->settings.lacks = true;
    free(value);
}

static void walk_list(const Key *list, const DifferenceWalk *walk, const char *shown, int dimensions)
{
    const KeyListMapping *like = key_list_mapping(list);
    const int now = *(const int *)(walk->now + list->aux);
    int before = walk->before ? *(const int *)(walk->before + list->aux) : 0;
    if (now == 0 && before > 0 && list->min == 0) {
        add(walk, list, shown, "[]");
        return;
    }
    if (!like && (now != before || !same_kinds(list, walk, now))) {
        add_whole(walk, list, shown, dimensions);
        return;
    }
    if (now < before) { /* fewer views than before: all are written again */
        add(walk, list, shown, "[]");
        before = 0;
    }
    for (int e = 0; e < now; e++) {
        const int said = walk->out->settings.count;
        walk_element(list, walk, shown, e, before, dimensions);
        char whole[PATH];
        snprintf(whole, sizeof whole, "%.110s[%d]", shown, e);
        if (e >= before && walk->out->settings.count == said) /* an element without differences */
            add(walk, list, whole, "{}");
    }
}

static void walk_mapping(const Key *key, const DifferenceWalk *walk, const char *shown, int dimensions)
{
    const bool was = !is_absent(key, walk->before), is = !is_absent(key, walk->now);
    DifferenceWalk inner = {.before = was ? walk->before : NULL, .now = walk->now, .out = walk->out};
    if (was && !is)
        add(walk, key, shown, "");
    snprintf(inner.parent, PATH, "%s", key->path);
    snprintf(inner.shown, PATH, "%s", shown);
    if (is)
        walk_children(&inner, dimensions);
}

static void walk_key(const Key *key, const DifferenceWalk *walk, const char *shown, int dimensions)
{
    char now[KEY_EXACT_SIZE], before[KEY_EXACT_SIZE];
    if (key->type == KEY_LIST) {
        walk_list(key, walk, shown, dimensions);
    } else if (key->type == KEY_MAPPING || key->type == KEY_VARIANT) {
        walk_mapping(key, walk, shown, dimensions);
    } else {
        key_exact_text(key, walk->now, dimensions, now, sizeof now);
        if (walk->before)
            key_exact_text(key, walk->before, dimensions, before, sizeof before);
        if ((!walk->before || strcmp(now, before) != 0) && (*now || walk->before))
            add(walk, key, shown, now);
    }
}

static void walk_children(const DifferenceWalk *walk, int dimensions)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], walk->parent);
        char shown[PATH];
        if (!name)
            continue;
        snprintf(shown, sizeof shown, "%.80s%s%.40s", walk->shown, *walk->shown ? "." : "", name);
        walk_key(&keys[i], walk, shown, dimensions);
    }
}

void scene_difference(const Scene *before, const Scene *now, SceneDifference *out)
{
    const bool depth = before->world.dimensions != now->world.dimensions;
    *out = (SceneDifference){.depth = depth, .world = depth, .dead = depth};
    const DifferenceWalk walk = {.before = (const char *)before, .now = (const char *)now, .out = out};
    walk_children(&walk, now->world.dimensions);
}

void setting_list_words(const SettingList *settings, char *text, size_t size)
{
    enum { SAID = 4 };
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < settings->count && i < SAID && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.*s",
                                 i == 0                     ? ""
                                 : i + 1 == settings->count ? " and "
                                                            : ", ",
                                 (int)strcspn(settings->set[i], "="), settings->set[i]);
    if (settings->count > SAID && used < size)
        snprintf(text + used, size - used, " and %d more", settings->count - SAID);
}

enum { ROUNDS = 4, NAMES_MOST = 10000 };

/* A SceneFileMoved: adds a setting with the full path. */
static void add_file(void *user, YamlNode *node, const char *path, const char *whole)
{
    (void)node;
    setting_list_add_text(user, path, whole);
}

/* Applies the settings to the text one after another; frees the old text. */
static bool put_in(const SceneSource *save, const SettingList *settings, char **text, bool *lost,
                   Error *error)
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

static bool put_files(const SceneSource *save, const char *output, SettingList *files, char **text,
                      bool *lost, Error *error)
{
    YamlTree tree;
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
static bool differs(const SceneSource *save, const char *output, const char *text, SceneDifference *out,
                    Error *error)
{
    Scene *read = calloc(1, sizeof *read);
    SceneSettings none = {.purpose = save->scene->purpose};
    *out = (SceneDifference){.world = false};
    if (!read) {
        error_set(error, "%s: no memory", save->path);
        return false;
    }
    const bool ok = scene_parse(output, text, strlen(text), &none, read, NULL, error);
    if (ok)
        scene_difference(read, save->scene, out);
    leave_machine(&out->settings);
    free(read);
    return ok;
}

static bool make(const SceneSource *save, const char *output, const SettingList *files, char **text,
                 SceneSaved *out, Error *error)
{
    *out->lacks = '\0';
    for (int round = 0;; round++) {
        SceneDifference left;
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

char *scene_save_text(const SceneSource *save, const char *output, SceneSaved *out, Error *error)
{
    SettingList files = {.count = 0};
    *out = (SceneSaved){.lost = false};
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
static void print_head(const SceneSource *save, const SettingList *changed, FILE *file)
{
    const char *slash = strrchr(save->path, '/');
    fprintf(file, "# Written by slosh " SLOSH_VERSION " from %s.", slash ? slash + 1 : save->path);
    for (int i = 0; i < changed->count; i++)
        fprintf(file, "%s%.*s", i > 0 ? ", " : "\n# Comments beside these are older than they are: ",
                (int)strcspn(changed->set[i], "="), changed->set[i]);
    fputs(changed->count > 0 ? ".\n#\n" : "\n#\n", file);
}

static bool write_text(const SceneSource *save, const SettingList *changed, const char *text,
                       const char *temp, const char *path, Error *error)
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
static bool write_new(const SceneSource *save, const char *path, SceneSaved *out, bool *there, Error *error)
{
    Output output = {.path = ""};
    char *text = scene_save_text(save, path, out, error);
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

bool scene_save(const SceneSource *save, const char *output, SceneSaved *out, Error *error)
{
    bool there;
    *out = (SceneSaved){.lost = false};
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

void scene_saved_words(const SceneSaved *saved, char *text, size_t size)
{
    char keys[240];
    setting_list_words(&saved->changed, keys, sizeof keys);
    snprintf(text, size, "%s: the scene%s%s%s%s%s", saved->path, *keys ? " with " : " as it was", keys,
             saved->lost ? "; a part was written anew, without its comments" : "",
             *saved->lacks ? "; not kept: " : "", saved->lacks);
}
