#include "app/export/slice_table.h"

#include "app/yaml/value.h"
#include "app/yaml/yaml.h"
#include "render/plane/plane_kernel.h"
#include "sim/base/key_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- request ---- */

/* clang-format off */
static const Key keys[] = {
    VEC3("point", 0, "m", -1e6, 1e6, offsetof(SliceWanted, point), ""),
    VEC3("normal", 0, "", -1e6, 1e6, offsetof(SliceWanted, normal), ""),
    KEYS_END,
};
/* clang-format on */

static bool read_key(SliceWanted *wanted, const Tree *tree, const Node *node, Error *error)
{
    for (const Key *key = keys; key->path; key++)
        if (strcmp(key->path, node->key) == 0)
            return value_read(tree, key, node, key->path, (char *)wanted, error);
    return tree_error_key(tree, node, error, "unknown key \"%.60s\"; point and normal are known", node->key);
}

static bool read_keys(SliceWanted *wanted, const Tree *tree, const Node *root, Error *error)
{
    if (!root || root->kind != NODE_MAPPING)
        return error_set(error, "--slice must be {point: [x, y, z], normal: [x, y, z]}");
    for (const Node *node = root->first; node; node = node->next)
        if (!read_key(wanted, tree, node, error))
            return false;
    const double *normal = wanted->normal;
    return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0 ||
           error_set(error, "--slice: a normal of length 0 is across no plane; [0, 0, 1] looks along z");
}

bool slice_wanted_read(SliceWanted *wanted, const char *text, Error *error)
{
    Tree tree = {.path = "--slice"};
    Node *root = NULL;
    const bool read = yaml_read(&tree, "--slice", text, strlen(text), &root, error) &&
                      read_keys(wanted, &tree, root, error);
    tree_free(&tree);
    return read;
}

/* ---- sums ---- */

void slice_maker_destroy(SliceMaker *maker)
{
    plane_sum_destroy(&maker->sum);
    step_buffers_destroy(&maker->buffers);
    *maker = (SliceMaker){0};
}

static bool allocate(SliceTable *table, float **sums, Error *error)
{
    const size_t count = (size_t)table->wanted.samples[0] * (size_t)table->wanted.samples[1];
    *sums = malloc(count * sizeof(float[4]));
    table->value = malloc(count * sizeof(float));
    table->field = malloc(count * sizeof(float));
    return (*sums && table->value && table->field) ||
           error_set(error, "out of memory for a slice of %d x %d samples", table->wanted.samples[0],
                     table->wanted.samples[1]);
}

static void fill_table(SliceTable *table, const float *sums)
{
    const size_t count = (size_t)table->wanted.samples[0] * (size_t)table->wanted.samples[1];
    for (size_t i = 0; i < count; i++) {
        const bool empty = plane_empty(&sums[4 * i]);
        table->empty += empty;
        table->value[i] = empty ? NAN : (float)plane_value(&sums[4 * i], table->wanted.raw);
        table->field[i] = sums[4 * i + 1] + sums[4 * i + 2];
    }
}

static bool make(SliceMaker *maker, SliceTable *table, const SnapshotScene *scene, const SnapshotStep *step,
                 Error *error)
{
    const SliceWanted *wanted = &table->wanted;
    const PlaneJob job = {.plane = table->plane,
                          .samples = {wanted->samples[0], wanted->samples[1]},
                          .kernel = wanted->kernel,
                          .dimensions = scene->dimensions,
                          .support = scene->support_radius,
                          .scalar = wanted->scalar};
    ParticleBuffers particles;
    float *sums = NULL;
    const bool made = allocate(table, &sums, error) &&
                      step_buffers_make(&maker->buffers, scene, step, SNAPSHOT_MASS_DENSITY, wanted->scalar,
                                        &particles, error) &&
                      plane_sum_run(&maker->sum, &job, &particles, error);
    if (made) {
        plane_sum_read(&maker->sum, sums);
        fill_table(table, sums);
    }
    free(sums);
    return made;
}

bool slice_table_make(SliceMaker *maker, const SliceWanted *wanted, const SnapshotScene *scene,
                      const SnapshotStep *step, SliceTable *table, Error *error)
{
    *table = (SliceTable){.wanted = *wanted, .time = step->time};
    if (step_attributes(wanted->scalar) & ~snapshot_attributes(step))
        return error_set(error, "the snapshot at %.9g s has no %s", step->time, scalar_name(wanted->scalar));
    if (!plane_make(scene->box_size, wanted->point, wanted->normal, &table->plane))
        return error_set(error,
                         "--slice: the plane misses the box, which is x %.4g .. %.4g, y 0 .. %.4g, z %.4g .. "
                         "%.4g m",
                         -scene->box_size[0] / 2, scene->box_size[0] / 2, scene->box_size[1],
                         -scene->box_size[2] / 2, scene->box_size[2] / 2);
    if (make(maker, table, scene, step, error))
        return true;
    slice_table_free(table);
    return false;
}

void slice_table_free(SliceTable *table)
{
    free(table->value);
    free(table->field);
    *table = (SliceTable){0};
}
