#include "app/scene/yaml/yaml.h"

#include "app/base/program.h"
#include "sim/base/base.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TIME_MOST = 1e6; /* s: same limit as for motions */

/* A value being read. */
typedef struct Value {
    const YamlTree *tree;
    const Key *key;
    const YamlNode *node;
    const char *shown;
    char *field;
    Error *error;
} Value;

static const char *with_unit(const Value *value)
{
    return *value->key->unit ? " " : "";
}

/* Reports "box.size must be WANTED, not GOT". */
static bool wrong(const Value *value, const YamlNode *node, const char *wanted)
{
    const bool filled = node->first != NULL;
    const char *got = node->kind == NODE_MAPPING    ? filled ? "a mapping" : "an empty one"
                      : node->kind == NODE_SEQUENCE ? filled ? "a list" : "an empty one"
                      : node->text                  ? node->text
                                                    : "empty";
    const char *quote = node->kind == NODE_SCALAR && node->text ? "'" : "";
    const Key *key = value->key;
    return tree_error(value->tree, node, value->error, "%s must be %s%s%s, not %s%.60s%s", value->shown,
                      wanted, *key->unit ? " in " : "", key->unit, quote, got, quote);
}

/* Parses numbers as in YAML; strtod alone would accept hexadecimal, "infinity" and trailing text. */
static bool number_parse(const YamlNode *node, double *out)
{
    if (node->kind != NODE_SCALAR || !node->plain || !node->text)
        return false;
    const char *digits = node->text + (*node->text == '-' || *node->text == '+');
    if (strcmp(digits, ".nan") == 0 || strcmp(digits, ".NaN") == 0 || strcmp(digits, ".NAN") == 0 ||
        strcmp(digits, "nan") == 0 || strcmp(digits, "NaN") == 0) {
        *out = (double)NAN;
        return true;
    }
    if (strcmp(digits, ".inf") == 0 || strcmp(digits, ".Inf") == 0 || strcmp(digits, "inf") == 0) {
        *out = *node->text == '-' ? -INFINITY : INFINITY;
        return true;
    }
    if (!*digits || digits[strspn(digits, "0123456789.eE+-")])
        return false;
    char *end;
    *out = strtod(node->text, &end);
    return end != node->text && !*end;
}

bool value_in_range(const Key *key, double number)
{
    return (key->flags & KEY_OPEN_LOW ? number > key->min : number >= key->min) && number <= key->max;
}

/* The same with the key's word for 0: "a number or auto". */
static bool wrong_number(const Value *value, const YamlNode *node, const char *wanted)
{
    const char *zero = value->key->zero;
    char either[64];
    snprintf(either, sizeof either, "%s%s%s", wanted, zero ? " or " : "", zero ? zero : "");
    return wrong(value, node, either);
}

static bool read_number(const Value *value, const YamlNode *node, const char *wanted, double *out)
{
    const Key *key = value->key;
    char range[128];
    if (key->zero && node->kind == NODE_SCALAR && node->text && strcmp(node->text, key->zero) == 0) {
        *out = 0;
        return true;
    }
    if (!number_parse(node, out))
        return wrong_number(value, node, wanted);
    if (!isfinite(*out))
        return tree_error(value->tree, node, value->error, "%s must be a finite number, not %s", value->shown,
                          node->text);
    if (value_in_range(key, *out))
        return true;
    key_bounds_text(key, range, sizeof range);
    return tree_error(value->tree, node, value->error, "%s must be %s%s%s, not %.60s", value->shown, range,
                      with_unit(value), key->unit, node->text);
}

static bool read_integer(const Value *value)
{
    double number = 0;
    if (!read_number(value, value->node, "a whole number", &number))
        return false;
    if (number != floor(number))
        return wrong(value, value->node, "a whole number");
    *(int *)value->field = (int)number;
    return true;
}

static bool read_boolean(const Value *value)
{
    const YamlNode *node = value->node;
    const bool is_scalar = node->kind == NODE_SCALAR && node->plain && node->text;
    const bool yes = is_scalar && strcmp(node->text, "true") == 0;
    if (!yes && !(is_scalar && strcmp(node->text, "false") == 0))
        return wrong(value, node, "true or false");
    *(bool *)value->field = yes;
    return true;
}

/* Reads a list of words, joined by spaces. */
static bool read_words(const Value *value)
{
    size_t used = 0;
    for (const YamlNode *node = value->node->first; node; node = node->next) {
        if (node->kind != NODE_SCALAR || !node->text || !*node->text || strpbrk(node->text, " \n\r\t"))
            return wrong(value, node, "a list of words");
        const size_t length = strlen(node->text);
        if (used + (used > 0) + length >= value->key->size)
            return tree_error(value->tree, node, value->error, "%s is too long; use at most %zu bytes",
                              value->shown, value->key->size - 1);
        if (used > 0)
            value->field[used++] = ' ';
        memcpy(value->field + used, node->text, length + 1);
        used += length;
    }
    return used > 0 || tree_error(value->tree, value->node, value->error,
                                  "%s has no entry; give it at least one", value->shown);
}

/* Stores a text that fits. */
static bool put_text(const Value *value, const char *words)
{
    if (!(value->key->flags & KEY_POINTER)) {
        memcpy(value->field, words, strlen(words) + 1);
        return true;
    }
    const char *text = text_intern(words);
    *(const char **)value->field = text;
    return text || tree_error(value->tree, value->node, value->error, "out of memory for %s", value->shown);
}

static bool read_text(const Value *value)
{
    const YamlNode *node = value->node;
    if (node->kind == NODE_SEQUENCE && (value->key->flags & KEY_WORDS))
        return read_words(value);
    if (node->kind != NODE_SCALAR || !node->text || !*node->text)
        return wrong(value, node, "a text");
    if (strlen(node->text) >= value->key->size)
        return tree_error(value->tree, node, value->error, "%s is too long; use at most %zu bytes",
                          value->shown, value->key->size - 1);
    if (strpbrk(node->text, "\n\r\t"))
        return tree_error(value->tree, node, value->error, "%s has more than one line; use one, without tabs",
                          value->shown);
    return put_text(value, node->text);
}

static bool read_choice(const Value *value)
{
    const YamlNode *node = value->node;
    const Key *key = value->key;
    char names[512];
    key_range_text(key, names, sizeof names);
    if (node->kind != NODE_SCALAR || !node->text)
        return tree_error(value->tree, node, value->error, "%s must be one of: %s", value->shown, names);
    Suggestion near = suggest_for(node->text);
    const char *name;
    for (int i = 0; (name = key_choice(key, i)); i++) {
        suggest_offer(&near, name);
        if (strcmp(name, node->text) != 0)
            continue;
        if (key->flags & KEY_INDEX)
            *(int *)value->field = i;
        else
            snprintf(value->field, NAME_SIZE, "%s", name);
        return true;
    }
    return tree_error(value->tree, node, value->error, "%s cannot be '%.60s'; %s%s%sit must be one of: %s",
                      value->shown, node->text, near.best ? "did you mean '" : "", near.best ? near.best : "",
                      near.best ? "'? " : "", names);
}

/* Returns the index of a node's name in the list; -1 with the reason. */
static int name_of(const Value *value, const YamlNode *node, const char *names)
{
    const char *name, *word = node->kind == NODE_SCALAR && node->text ? node->text : "";
    Suggestion near = suggest_for(word);
    for (int i = 0; (name = key_choice(value->key, i)); i++) {
        suggest_offer(&near, name);
        if (strcmp(name, word) == 0)
            return i;
    }
    tree_error(value->tree, node, value->error, "%s cannot have '%.60s'; %s%s%sits names are: %s",
               value->shown, word, near.best ? "did you mean '" : "", near.best ? near.best : "",
               near.best ? "'? " : "", names);
    return -1;
}

static bool read_names(const Value *value, int *count)
{
    const YamlNode *list = value->node;
    char names[512];
    int *places = (int *)value->field;
    key_range_text(value->key, names, sizeof names);
    if (list->kind != NODE_SEQUENCE)
        return tree_error(value->tree, list, value->error,
                          "%s must be a list, such as [%s]; its names are: %s", value->shown,
                          key_choice(value->key, 0), names);
    const size_t entries = node_count(list);
    if ((double)entries < value->key->min || (double)entries > value->key->max)
        return tree_error(value->tree, list, value->error, "%s has %zu %s; it must have %g to %g",
                          value->shown, entries, entries == 1 ? "entry" : "entries", value->key->min,
                          value->key->max);
    *count = 0;
    for (const YamlNode *node = list->first; node; node = node->next) {
        const int place = name_of(value, node, names);
        if (place < 0)
            return false;
        for (int k = 0; k < *count; k++)
            if (places[k] == place)
                return tree_error(value->tree, node, value->error, "%s has '%s' twice; name it once",
                                  value->shown, node->text);
        places[(*count)++] = place;
    }
    return true;
}

static bool read_numbers(const Value *value, size_t count, const char *wanted, double out[])
{
    if (value->node->kind != NODE_SEQUENCE || node_count(value->node) != count)
        return wrong(value, value->node, wanted);
    const YamlNode *node = value->node->first;
    for (size_t k = 0; k < count; k++, node = node->next)
        if (!read_number(value, node, wanted, &out[k]))
            return false;
    return true;
}

/* Rows [x, y], read into two arrays. */
typedef struct NumberRows {
    const char *wanted, *places, *unit, *what; /* "times", " s", "a table" */
    double x_most;
    int most;
    double *x, *y;
} NumberRows;

static bool read_row(const Value *value, const YamlNode *row, const NumberRows *rows, int k)
{
    double *x = &rows->x[k];
    if (row->kind != NODE_SEQUENCE || node_count(row) != 2)
        return wrong(value, row, rows->wanted);
    if (!number_parse(row->first, x))
        return wrong(value, row->first, rows->wanted);
    if (!(*x >= 0 && *x <= rows->x_most))
        return tree_error(value->tree, row->first, value->error, "%s: %s must be 0 to %g%s, not %.60s",
                          value->shown, rows->places, rows->x_most, rows->unit, row->first->text);
    if (k > 0 && !(*x > rows->x[k - 1]))
        return tree_error(value->tree, row->first, value->error,
                          "%s: %s must ascend; %.60s stands after %.9g", value->shown, rows->places,
                          row->first->text, rows->x[k - 1]);
    return read_number(value, row->first->next, rows->wanted, &rows->y[k]);
}

/* Returns the count of rows; 0 with the reason. */
static int read_rows(const Value *value, const NumberRows *rows)
{
    const YamlNode *node = value->node;
    const size_t count = node_count(node);
    int k = 0;
    if (count < 1 || count > (size_t)rows->most) {
        tree_error(value->tree, node, value->error, "%s has %zu rows; %s must have 1 to %d", value->shown,
                   count, rows->what, rows->most);
        return 0;
    }
    for (const YamlNode *row = node->first; row; row = row->next, k++)
        if (!read_row(value, row, rows, k))
            return 0;
    return k;
}

/* Reads a number, or rows of time and number; the field then gets the value at time 0. */
static bool read_curve(const Value *value, TimeTable *table)
{
    static const char wanted[] = "a number or rows [seconds, number], the numbers";
    const NumberRows rows = {wanted,    "times",         " s",        "a table",
                             TIME_MOST, TIME_TABLE_ROWS, table->time, table->value};
    *table = (TimeTable){0};
    if (value->node->kind != NODE_SEQUENCE)
        return read_number(value, value->node, wanted, (double *)value->field);
    table->rows = read_rows(value, &rows);
    if (table->rows == 0)
        return false;
    *(double *)value->field = time_table_at(table, 0);
    return true;
}

/* Reads the name of a preset, or rows. */
static bool read_points(const Value *value)
{
    ControlPoints *points = (ControlPoints *)value->field;
    const ControlPreset *presets = value->key->names;
    if (value->node->kind == NODE_SCALAR) {
        char names[256];
        key_range_text(value->key, names, sizeof names);
        const int place = name_of(value, value->node, names);
        if (place >= 0)
            *points = presets[place].points;
        return place >= 0;
    }
    const NumberRows rows = {"a name or rows [place in the range 0 to 1, number]",
                             "places in the range",
                             "",
                             "a curve",
                             1,
                             CONTROL_POINTS_MAX,
                             points->x,
                             points->y};
    *points = (ControlPoints){0};
    if (value->node->kind != NODE_SEQUENCE)
        return wrong(value, value->node, rows.wanted);
    points->count = read_rows(value, &rows);
    return points->count > 0;
}

static bool read_vec3(const Value *value)
{
    double *v = (double *)value->field;
    const bool flat = value->tree->dimensions == 2;
    if (flat && value->node->kind == NODE_SEQUENCE && node_count(value->node) == 2) {
        v[2] = 0;
        return read_numbers(value, 2, "two numbers [x, y]", v);
    }
    return read_numbers(value, 3, flat ? "two numbers [x, y], or three" : "three numbers [x, y, z]", v);
}

static bool read_axes(const Value *value)
{
    static const char wanted[] = "a list of axes, such as [x] or [x, z]";
    bool *axes = (bool *)value->field;
    memset(axes, 0, 3 * sizeof *axes);
    if (value->node->kind != NODE_SEQUENCE)
        return wrong(value, value->node, wanted);
    for (const YamlNode *node = value->node->first; node; node = node->next) {
        const bool one = node->kind == NODE_SCALAR && node->text && strlen(node->text) == 1;
        if (!one || *node->text < 'x' || *node->text > 'z')
            return wrong(value, node, wanted);
        axes[*node->text - 'x'] = true;
    }
    return true;
}

static bool read_color(const Value *value)
{
    double color[3] = {0};
    if (!read_numbers(value, 3, "three numbers [red, green, blue]", color))
        return false;
    for (int k = 0; k < 3; k++)
        if (value->key->flags & KEY_SINGLE)
            ((float *)value->field)[k] = (float)srgb_to_linear(color[k]);
        else
            ((double *)value->field)[k] = srgb_to_linear(color[k]);
    return true;
}

static bool read_range(const Value *value, bool automatic[2])
{
    const YamlNode *node = value->node;
    const char *word = node->kind == NODE_SCALAR && node->text ? node->text : "";
    automatic[1] = strcmp(word, "symmetric") == 0;
    automatic[0] = automatic[1] || strcmp(word, "auto") == 0;
    return automatic[0] ||
           read_numbers(value, 2, "auto, symmetric or two numbers [low, high]", (double *)value->field);
}

static bool add_setting(const Value *value, const YamlNode *node, const char *path, FILE *file);

static bool add_settings(const Value *value, const YamlNode *mapping, const char *path, FILE *file)
{
    char inner[128];
    for (const YamlNode *node = mapping->first; node; node = node->next) {
        snprintf(inner, sizeof inner, "%.80s%s%.40s", path, *path ? "." : "", node->key);
        if (!add_setting(value, node, inner, file))
            return false;
    }
    return true;
}

static bool add_setting(const Value *value, const YamlNode *node, const char *path, FILE *file)
{
    if (node->kind == NODE_MAPPING && node->first)
        return add_settings(value, node, path, file);
    if (node->kind == NODE_SCALAR && node->text && strpbrk(node->text, "\n\r\t"))
        return tree_error(value->tree, node, value->error,
                          "%s.%s has more than one line; use one, without tabs", value->shown, path);
    fprintf(file, "%s=", path);
    node_print(node, file);
    fputc('\n', file);
    return true;
}

/* Reads a mapping of settings, one line each. */
static bool read_settings(const Value *value)
{
    const YamlNode *node = value->node;
    char *text = NULL;
    size_t size = 0;
    if (node->kind != NODE_MAPPING || !node->first)
        return wrong(value, node, "a mapping of settings, such as {solver.step.dt: 0.001}");
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return tree_error(value->tree, node, value->error, "no memory for %s", value->shown);
    bool ok = add_settings(value, node, "", file);
    ok &= fclose(file) == 0;
    if (ok && size > value->key->size - 1)
        ok = tree_error(value->tree, node, value->error, "%s is too long; use at most %zu bytes",
                        value->shown, value->key->size - 1);
    if (ok) {
        text[size - 1] = '\0'; /* without the final line end */
        ok = put_text(value, text);
    }
    free(text);
    return ok;
}

bool value_read(const YamlTree *tree, const Key *key, const YamlNode *node, const char *shown, char *base,
                Error *error)
{
    _Alignas(double) char nowhere[NAME_SIZE]; /* for keys without a field */
    const Value value = {tree, key, node, shown, key->offset == KEY_NOWHERE ? nowhere : base + key->offset,
                         error};
    switch (key->type) {
    case KEY_NUMBER:
        return read_number(&value, node, "a number", (double *)value.field);
    case KEY_CURVE:
        return read_curve(&value, (TimeTable *)(base + key->aux));
    case KEY_INTEGER:
        return read_integer(&value);
    case KEY_BOOLEAN:
        return read_boolean(&value);
    case KEY_TEXT:
        return read_text(&value);
    case KEY_CHOICE:
        return read_choice(&value);
    case KEY_VEC3:
        return read_vec3(&value);
    case KEY_AXES:
        return read_axes(&value);
    case KEY_NAMES:
        return read_names(&value, (int *)(base + key->aux));
    case KEY_COLOR:
        return read_color(&value);
    case KEY_RANGE:
        return read_range(&value, (bool *)(base + key->aux));
    case KEY_POINTS:
        return read_points(&value);
    case KEY_SETTINGS:
        return read_settings(&value);
    case KEY_MAPPING:
    case KEY_VARIANT:
    case KEY_LIST:
        break;
    }
    return tree_error(tree, node, error, "%s holds no single value", shown);
}
