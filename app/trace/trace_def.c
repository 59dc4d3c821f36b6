#include "app/trace/trace_def.h"

#include "app/base/suggest.h"
#include "app/yaml/value.h"
#include "app/yaml/yaml.h"
#include "sim/base/key_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AT(field) offsetof(TraceDef, field)

/* clang-format off */
static const Key keys[] = {
    INTEGER("stride", 0, 1, 1000000000, AT(stride), ""),
    TEXT("ids", KEY_WORDS, TRACE_IDS_SIZE, AT(ids), NULL, ""),
    NUMBER("length", O, "s", 0, 1e6, AT(length), ""),
    NUMBER("every", 0, "s", 0, 1e6, AT(every), ""),
    VEC3("region_min", 0, "m", -1e6, 1e6, AT(region_min), ""),
    VEC3("region_max", 0, "m", -1e6, 1e6, AT(region_max), ""),
    VEC3("plane_point", 0, "m", -1e6, 1e6, AT(plane_point), ""),
    VEC3("plane_normal", 0, "", -1e6, 1e6, AT(plane_normal), ""),
    KEYS_END,
};
/* clang-format on */

static bool unknown_key(const Tree *tree, const Node *node, Error *error)
{
    char list[256] = "";
    Suggestion near = suggest_for(node->key);
    for (const Key *key = keys; key->path; key++) {
        suggest_offer(&near, key->path);
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", key == keys ? "" : ", ", key->path);
    }
    return tree_error_key(tree, node, error, "unknown key \"%.60s\"%s%s; known are %s", node->key,
                          near.best ? "; did you mean " : "", near.best ? near.best : "", list);
}

static bool read_key(TraceDef *def, const Tree *tree, const Node *node, Error *error)
{
    for (const Key *key = keys; key->path; key++)
        if (strcmp(key->path, node->key) == 0)
            return value_read(tree, key, node, key->path, (char *)def, error);
    return unknown_key(tree, node, error);
}

static bool read_keys(TraceDef *def, const Tree *tree, const Node *root, Error *error)
{
    if (!root || root->kind != NODE_MAPPING)
        return error_set(error, "--trails must be {key: value, ...} as {stride: 20, length: 2}, or {} for "
                                "every 20th particle");
    for (const Node *node = root->first; node; node = node->next)
        if (!read_key(def, tree, node, error))
            return false;
    return true;
}

static int by_value(const void *a, const void *b)
{
    const int64_t one = *(const int64_t *)a, other = *(const int64_t *)b;
    return (one > other) - (one < other);
}

static bool read_ids(TraceDef *def, Error *error)
{
    const char *at = def->ids + strspn(def->ids, " ,");
    if (strcmp(def->ids, "all") == 0)
        return true;
    while (*at && def->id_count < TRACE_IDS_MAX) {
        char *end = NULL;
        def->id[def->id_count++] = strtoll(at, &end, 10);
        if (end == at || *at == '-' || *at == '+' || !strchr(" ,", *end))
            break;
        at = end + strspn(end, " ,");
    }
    qsort(def->id, (size_t)def->id_count, sizeof *def->id, by_value);
    return (!*at && def->id_count > 0) ||
           error_set(error,
                     "--trails: ids \"%.60s\" is no list of at most %d ids; [3, 17, 250] is one, and all is "
                     "by stride",
                     def->ids, TRACE_IDS_MAX);
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool check(const TraceDef *def, Error *error)
{
    static const double none[3] = {0};
    const double *least = def->region_min, *greatest = def->region_max;
    if (!same3(def->plane_point, none) && !trace_def_has_plane(def))
        return error_set(error, "--trails: plane_point is of a plane; add plane_normal: [0, 0, 1]");
    for (int k = 0; k < 3 && trace_def_has_region(def); k++)
        if (!(least[k] < greatest[k]))
            return error_set(error,
                             "--trails: nothing is between region_min %.6g and region_max %.6g along %c; the "
                             "first must be less",
                             least[k], greatest[k], "xyz"[k]);
    return true;
}

bool trace_def_read(TraceDef *def, const char *text, Error *error)
{
    Tree tree = {.path = "--trails"};
    Node *root = NULL;
    *def = (TraceDef){.stride = 20, .ids = "all"}; /* defaults of the overlay */
    const bool read = yaml_read(&tree, "--trails", text, strlen(text), &root, error) &&
                      read_keys(def, &tree, root, error) && read_ids(def, error) && check(def, error);
    tree_free(&tree);
    return read;
}

bool trace_def_takes(const TraceDef *def, int64_t id)
{
    if (def->id_count > 0)
        return bsearch(&id, def->id, (size_t)def->id_count, sizeof id, by_value) != NULL;
    return id % def->stride == 0;
}

bool trace_def_has_plane(const TraceDef *def)
{
    static const double none[3] = {0};
    return !same3(def->plane_normal, none);
}

bool trace_def_has_region(const TraceDef *def)
{
    return !same3(def->region_min, def->region_max);
}
