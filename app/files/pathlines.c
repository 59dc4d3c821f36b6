#define _GNU_SOURCE /* mremap */
#include "app/base/program.h"
#include "app/files/export.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/key_rows.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define AT(field) offsetof(PathlinesDef, field)

/* clang-format off */
static const Key keys[] = {
    INTEGER("stride", 0, 1, 1000000000, AT(stride), ""),
    TEXT("ids", KEY_WORDS, PATHLINES_IDS_SIZE, AT(ids), NULL, ""),
    NUMBER("length", O, "s", 0, 1e6, AT(length), ""),
    NUMBER("every", 0, "s", 0, 1e6, AT(every), ""),
    VEC3("region_min", 0, "m", -1e6, 1e6, AT(region_min), ""),
    VEC3("region_max", 0, "m", -1e6, 1e6, AT(region_max), ""),
    VEC3("plane_point", 0, "m", -1e6, 1e6, AT(plane_point), ""),
    VEC3("plane_normal", 0, "", -1e6, 1e6, AT(plane_normal), ""),
    KEYS_END,
};
/* clang-format on */

static bool unknown_key(const YamlTree *tree, const YamlNode *node, Error *error)
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

static bool read_key(PathlinesDef *def, const YamlTree *tree, const YamlNode *node, Error *error)
{
    for (const Key *key = keys; key->path; key++)
        if (strcmp(key->path, node->key) == 0)
            return value_read(tree, key, node, key->path, (char *)def, error);
    return unknown_key(tree, node, error);
}

static bool read_keys(PathlinesDef *def, const YamlTree *tree, const YamlNode *root, Error *error)
{
    if (!root || root->kind != NODE_MAPPING)
        return error_set(error, "--trails must be {key: value, ...} as {stride: 20, length: 2}, or {} for "
                                "every 20th particle");
    for (const YamlNode *node = root->first; node; node = node->next)
        if (!read_key(def, tree, node, error))
            return false;
    return true;
}

static int by_value(const void *a, const void *b)
{
    const int64_t one = *(const int64_t *)a, other = *(const int64_t *)b;
    return (one > other) - (one < other);
}

static bool read_ids(PathlinesDef *def, Error *error)
{
    const char *at = def->ids + strspn(def->ids, " ,");
    if (strcmp(def->ids, "all") == 0)
        return true;
    while (*at && def->id_count < PATHLINES_IDS_MAX) {
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
                     def->ids, PATHLINES_IDS_MAX);
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool check(const PathlinesDef *def, Error *error)
{
    static const double none[3] = {0};
    const double *least = def->region_min, *greatest = def->region_max;
    if (!same3(def->plane_point, none) && !pathlines_def_has_plane(def))
        return error_set(error, "--trails: plane_point is of a plane; add plane_normal: [0, 0, 1]");
    for (int k = 0; k < 3 && pathlines_def_has_region(def); k++)
        if (!(least[k] < greatest[k]))
            return error_set(error,
                             "--trails: nothing is between region_min %.6g and region_max %.6g along %c; the "
                             "first must be less",
                             least[k], greatest[k], "xyz"[k]);
    return true;
}

bool pathlines_def_read(PathlinesDef *def, const char *text, Error *error)
{
    YamlTree tree = {.path = "--trails"};
    YamlNode *root = NULL;
    *def = (PathlinesDef){.stride = 20, .ids = "all"}; /* defaults of the overlay */
    const bool read = yaml_read(&tree, "--trails", text, strlen(text), &root, error) &&
                      read_keys(def, &tree, root, error) && read_ids(def, error) && check(def, error);
    tree_free(&tree);
    return read;
}

/* True if a particle with the id may have a trail. */
static bool pathlines_def_selects(const PathlinesDef *def, int64_t id)
{
    if (def->id_count > 0)
        return bsearch(&id, def->id, (size_t)def->id_count, sizeof id, by_value) != NULL;
    return id % def->stride == 0;
}

bool pathlines_def_has_plane(const PathlinesDef *def)
{
    static const double none[3] = {0};
    return !same3(def->plane_normal, none);
}

bool pathlines_def_has_region(const PathlinesDef *def)
{
    return !same3(def->region_min, def->region_max);
}

enum { ROOM_LEAST = 1 << 16 };

static bool make_file(PathlineRows *rows, const char *beside)
{
    char name[1100];
    snprintf(name, sizeof name, "%s.XXXXXX", beside);
    rows->file = mkostemp(name, O_CLOEXEC);
    return rows->file >= 0 && unlink(name) == 0;
}

/* Allocates the whole file first: a write into a hole on a full disk would kill the program. */
static bool map_file(PathlineRows *rows, size_t capacity)
{
    errno = posix_fallocate(rows->file, 0, (off_t)capacity);
    if (errno != 0)
        return false;
    void *data = rows->data ? mremap(rows->data, rows->capacity, capacity, MREMAP_MAYMOVE)
                            : mmap(NULL, capacity, PROT_READ | PROT_WRITE, MAP_SHARED, rows->file, 0);
    if (data == MAP_FAILED)
        return false;
    rows->data = data;
    rows->capacity = capacity;
    return true;
}

static bool grow(PathlineRows *rows, size_t bytes, const char *beside)
{
    const bool first = !rows->data;
    size_t capacity = first ? ROOM_LEAST : rows->capacity;
    while (capacity < bytes)
        capacity *= 2;
    if (first && !make_file(rows, beside))
        return false;
    const bool mapped = map_file(rows, capacity);
    if (first && !mapped) {
        const int reason = errno;
        close(rows->file);
        errno = reason;
    }
    return mapped;
}

/* Adds `count` rows from `rows` (NULL: zeros). Returns false with the reason, and all rows unchanged, if
   the disk is full or address space is short. The file is made as `beside`.XXXXXX and unlinked at once. */
static bool pathline_rows_add(PathlineRows *to, const void *rows, size_t count, const char *beside,
                              Error *error)
{
    const size_t used = to->count * to->row, bytes = count * to->row;
    if (!bytes)
        return true;
    if (used + bytes > to->capacity && !grow(to, used + bytes, beside))
        return error_set(error,
                         "%s: cannot be written: %s; trails are gathered in files beside it: take a larger "
                         "stride or every",
                         beside, strerror(errno));
    if (rows)
        memcpy((char *)to->data + used, rows, bytes);
    else
        memset((char *)to->data + used, 0, bytes);
    to->count += count;
    return true;
}

void pathline_rows_free(PathlineRows *rows)
{
    if (rows->data) {
        munmap(rows->data, rows->capacity);
        close(rows->file);
    }
    *rows = (PathlineRows){.row = rows->row};
}

enum { ENDS_LEAST = 1024 };

void pathlines_begin(Pathlines *trace, const PathlinesDef *def, const SnapshotScene *scene,
                     SnapshotFrame frame, Scalar scalar, const char *beside)
{
    *trace = (Pathlines){
        .def = def, .scene = *scene, .frame = frame, .scalar = scalar, .beside = beside, .time = -INFINITY};
    trace->place.row = sizeof(float[3]);
    trace->when.row = sizeof(double);
    trace->value.row = sizeof(float);
    trace->line.row = sizeof(uint32_t);
    trace->id.row = sizeof(int64_t);
}

void pathlines_free(Pathlines *trace)
{
    free(trace->values);
    free(trace->ends);
    pathline_rows_free(&trace->place);
    pathline_rows_free(&trace->when);
    pathline_rows_free(&trace->value);
    pathline_rows_free(&trace->line);
    pathline_rows_free(&trace->id);
    snapshot_buffers_destroy(&trace->buffers);
}

bool pathlines_step_has_points(const Pathlines *trace, double time)
{
    return time - trace->time >= 0.999 * trace->def->every;
}

/* ---- hash table of particles ---- */

/* Returns the entry of an id, or a free entry for the id. After: Steele, Lea and Flood, Fast splittable
   pseudorandom number generators, 2014 (its mixing of 64 bits). */
static PathlineEnd *place_of(PathlineEnd *ends, size_t capacity, int64_t id)
{
    uint64_t x = (uint64_t)id;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
    x = (x ^ x >> 27) * 0x94d049bb133111ebU;
    for (size_t at = (size_t)(x ^ x >> 31);; at++) {
        PathlineEnd *end = &ends[at & (capacity - 1)];
        if (!end->used || end->id == id)
            return end;
    }
}

/* Grows the table to keep half of the entries free. */
static bool make_room(Pathlines *trace, Error *error)
{
    const size_t capacity = trace->ends_capacity > 0 ? 2 * trace->ends_capacity : ENDS_LEAST;
    if (2 * (trace->ends_count + 1) <= trace->ends_capacity)
        return true;
    PathlineEnd *ends = calloc(capacity, sizeof *ends);
    if (!ends)
        return error_set(error, "out of memory for %zu trails; take a larger stride", trace->ends_count);
    for (size_t i = 0; i < trace->ends_capacity; i++)
        if (trace->ends[i].used)
            *place_of(ends, capacity, trace->ends[i].id) = trace->ends[i];
    free(trace->ends);
    trace->ends = ends;
    trace->ends_capacity = capacity;
    return true;
}

/* ---- the scalar ---- */

static bool fill_values(Pathlines *trace, const SnapshotStep *step, Error *error)
{
    if (step->count > trace->values_capacity) {
        free(trace->values);
        trace->values = malloc(step->count * sizeof *trace->values);
        trace->values_capacity = trace->values ? step->count : 0;
        if (!trace->values)
            return error_set(error, "out of memory for the particles");
    }
    if (step->count == 0)
        return true;
    return snapshot_buffers_scalar(&trace->buffers, &trace->scene, step, trace->scalar, trace->values, error);
}

/* ---- lines ---- */

static bool is_in_region(const PathlinesDef *def, const float at[3])
{
    bool inside = true;
    for (int k = 0; k < 3; k++)
        inside &= at[k] >= def->region_min[k] && at[k] <= def->region_max[k];
    return inside || !pathlines_def_has_region(def);
}

static bool is_behind(const PathlinesDef *def, const float at[3])
{
    double side = 0;
    for (int k = 0; k < 3; k++)
        side += def->plane_normal[k] * (at[k] - def->plane_point[k]);
    return side < 0;
}

/* True if the particle crossed the plane since the last step, where its position was end->at. */
static bool crosses(const Pathlines *trace, const PathlineEnd *end, const float at[3])
{
    return pathlines_def_has_plane(trace->def) && end->step + 1 == trace->steps &&
           is_behind(trace->def, end->at) != is_behind(trace->def, at);
}

/* True if the line continues from the last column, without crossing a periodic side. */
static bool joins(const Pathlines *trace, const PathlineEnd *end, const float at[3])
{
    bool near = end->shown && end->column > 0 && end->column + 1 == trace->columns;
    for (int k = 0; k < 3; k++)
        near &=
            !trace->scene.periodic[k] || fabs((double)at[k] - end->point[k]) <= trace->scene.box_size[k] / 2;
    return near;
}

static bool add_point(Pathlines *trace, const PathlineEnd *end, Error *error)
{
    return pathline_rows_add(&trace->place, end->place, 1, trace->beside, error) &&
           pathline_rows_add(&trace->when, &end->time, 1, trace->beside, error) &&
           pathline_rows_add(&trace->value, &end->value, 1, trace->beside, error) &&
           pathline_rows_add(&trace->line, &end->line, 1, trace->beside, error);
}

/* Begins a line with the previous point. */
static bool begin_line(Pathlines *trace, PathlineEnd *end, Error *error)
{
    end->line = (uint32_t)trace->id.count;
    end->on_line = true;
    return pathline_rows_add(&trace->id, &end->id, 1, trace->beside, error) && add_point(trace, end, error);
}

static void set_place(const Pathlines *trace, const SnapshotStep *step, const float at[3], float place[3])
{
    const double x[3] = {at[0], at[1], at[2]};
    double moved[3];
    memcpy(place, at, sizeof(float[3]));
    if (trace->frame != FRAME_WORLD)
        return;
    box_to_world(&step->box, x, NULL, moved, NULL);
    for (int k = 0; k < 3; k++)
        place[k] = (float)moved[k];
}

static bool take_point(Pathlines *trace, PathlineEnd *end, const SnapshotStep *step, size_t i,
                       const float at[3], Error *error)
{
    const bool on = joins(trace, end, at);
    if (on && !end->on_line && !begin_line(trace, end, error))
        return false;
    end->on_line = on;
    end->column = trace->columns;
    end->time = step->time;
    end->value = trace->values[i];
    memcpy(end->point, at, sizeof end->point);
    set_place(trace, step, at, end->place);
    return !on || add_point(trace, end, error);
}

static bool take_particle(Pathlines *trace, const SnapshotStep *step, size_t i, bool column, Error *error)
{
    const float at[3] = {step->position[0][i], step->position[1][i], step->position[2][i]};
    if (!pathlines_def_selects(trace->def, step->id[i]))
        return true;
    if (!make_room(trace, error))
        return false;
    PathlineEnd *end = place_of(trace->ends, trace->ends_capacity, step->id[i]);
    if (end->used && end->step == trace->steps)
        return true; /* duplicate id: only the first particle has the trail */
    if (!end->used) {
        *end = (PathlineEnd){.id = step->id[i],
                             .used = true,
                             .shown = !pathlines_def_has_plane(trace->def) && is_in_region(trace->def, at)};
        trace->ends_count++;
    } else if (crosses(trace, end, at))
        end->shown = true;
    end->step = trace->steps;
    memcpy(end->at, at, sizeof end->at);
    return !column || take_point(trace, end, step, i, at, error);
}

bool pathlines_step(Pathlines *trace, const SnapshotStep *step, bool column, Error *error)
{
    trace->steps++;
    if (column) {
        trace->columns++;
        trace->time = step->time;
        if (!fill_values(trace, step, error))
            return false;
    }
    for (size_t i = 0; i < step->count; i++)
        if (!take_particle(trace, step, i, column, error))
            return false;
    return true;
}

/* Counting sort by line: `offset` first counts the points per line, then holds the next free index of each
   line. */
bool pathlines_sort(const Pathlines *trace, PathlineRows *order, PathlineRows *offset, Error *error)
{
    const size_t points = trace->line.count, lines = trace->id.count;
    *order = *offset = (PathlineRows){.row = sizeof(int32_t)};
    if (points > INT32_MAX)
        return error_set(error,
                         "%zu points of trails are more than a .vtp of them holds; take a larger "
                         "stride or every",
                         points);
    if (!pathline_rows_add(order, NULL, points, trace->beside, error) ||
        !pathline_rows_add(offset, NULL, lines, trace->beside, error))
        return false;
    int32_t *number = order->data, *next = offset->data, begin = 0;
    const uint32_t *line = trace->line.data;
    for (size_t i = 0; i < points; i++)
        next[line[i]]++;
    for (size_t k = 0; k < lines; k++) {
        const int32_t count = next[k];
        next[k] = begin;
        begin += count;
    }
    for (size_t i = 0; i < points; i++)
        number[next[line[i]]++] = (int32_t)i;
    return true;
}
