#include "app/files/export.h"
#include "app/scene/yaml/yaml.h"
#include "render/particles/particles.h"
#include "sim/base/key_rows.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- request ---- */

/* clang-format off */
static const Key keys[] = {
    VEC3("point", 0, "m", -1e6, 1e6, offsetof(SliceTableDef, point), ""),
    VEC3("normal", 0, "", -1e6, 1e6, offsetof(SliceTableDef, normal), ""),
    KEYS_END,
};
/* clang-format on */

static bool read_key(SliceTableDef *wanted, const YamlTree *tree, const YamlNode *node, Error *error)
{
    for (const Key *key = keys; key->path; key++)
        if (strcmp(key->path, node->key) == 0)
            return value_read(tree, key, node, key->path, (char *)wanted, error);
    return tree_error_key(tree, node, error, "unknown key \"%.60s\"; point and normal are known", node->key);
}

static bool read_keys(SliceTableDef *wanted, const YamlTree *tree, const YamlNode *root, Error *error)
{
    if (!root || root->kind != NODE_MAPPING)
        return error_set(error, "--slice must be {point: [x, y, z], normal: [x, y, z]}");
    for (const YamlNode *node = root->first; node; node = node->next)
        if (!read_key(wanted, tree, node, error))
            return false;
    const double *normal = wanted->normal;
    return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0 ||
           error_set(error, "--slice: a normal of length 0 is across no plane; [0, 0, 1] looks along z");
}

bool slice_table_def_read(SliceTableDef *wanted, const char *text, Error *error)
{
    YamlTree tree = {.path = "--slice"};
    YamlNode *root = NULL;
    const bool read = yaml_read(&tree, "--slice", text, strlen(text), &root, error) &&
                      read_keys(wanted, &tree, root, error);
    tree_free(&tree);
    return read;
}

/* ---- sums ---- */

void slice_maker_destroy(SliceMaker *maker)
{
    plane_sum_destroy(&maker->sum);
    snapshot_buffers_destroy(&maker->buffers);
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
    const SliceTableDef *wanted = &table->wanted;
    const PlaneJob job = {.plane = table->plane,
                          .samples = {wanted->samples[0], wanted->samples[1]},
                          .kernel = wanted->kernel,
                          .dimensions = scene->dimensions,
                          .support = scene->support_radius,
                          .scalar = wanted->scalar};
    ParticleBuffers particles;
    float *sums = NULL;
    const bool made = allocate(table, &sums, error) &&
                      snapshot_buffers_make(&maker->buffers, scene, step, SNAPSHOT_MASS_DENSITY,
                                            wanted->scalar, &particles, error) &&
                      plane_sum_run(&maker->sum, &job, &particles, error);
    if (made) {
        plane_sum_read(&maker->sum, sums);
        fill_table(table, sums);
    }
    free(sums);
    return made;
}

bool slice_table_make(SliceMaker *maker, const SliceTableDef *wanted, const SnapshotScene *scene,
                      const SnapshotStep *step, SliceTable *table, Error *error)
{
    *table = (SliceTable){.wanted = *wanted, .time = step->time};
    if (snapshot_scalar_attributes(wanted->scalar) & ~snapshot_attributes(step))
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

/* After: VTK file formats, "XML file formats", https://docs.vtk.org: ImageData, numbers as base64 with
   64-bit sizes (for the reason see app/files/export_formats.c). */

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

static size_t count_of(const SliceTable *table)
{
    return (size_t)table->wanted.samples[0] * (size_t)table->wanted.samples[1];
}

static bool csv_file(FILE *file, const ExportContent *content)
{
    const SliceTable *table = content->slice;
    const int *samples = table->wanted.samples;
    bool written = fputs("x,y,z,value\n", file) >= 0;
    for (int row = 0; row < samples[1]; row++)
        for (int column = 0; column < samples[0] && written; column++) {
            const size_t i = (size_t)row * (size_t)samples[0] + (size_t)column;
            double at[3];
            plane_sample(&table->plane, samples, column, row, at);
            written = fprintf(file, "%.9g,%.9g,%.9g,", at[0], at[1], at[2]) > 0 &&
                      (table->field[i] > 0 ? fprintf(file, "%.9g\n", (double)table->value[i])
                                           : fprintf(file, "\n")) > 0;
        }
    return written && fflush(file) == 0;
}

/* A sample is a point of VTK's image; the axes are the columns of Direction. */
static bool write_head(FILE *file, const SliceTable *table)
{
    const Plane *plane = &table->plane;
    const ScalarRow *scalar = &scalar_list[table->wanted.scalar];
    const int *samples = table->wanted.samples;
    double corner[3];
    plane_sample(plane, samples, 0, 0, corner);
    fprintf(
        file,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n");
    fprintf(file, "<ImageData WholeExtent=\"0 %d 0 %d 0 0\" Origin=\"%.17g %.17g %.17g\"", samples[0] - 1,
            samples[1] - 1, corner[0], corner[1], corner[2]);
    fprintf(file, " Spacing=\"%.17g %.17g 1\" Direction=\"", plane->size[0] / samples[0],
            plane->size[1] / samples[1]);
    for (int k = 0; k < 3; k++)
        fprintf(file, "%.17g %.17g %.17g%s", plane->along[k], plane->up[k], plane->normal[k],
                k < 2 ? " " : "\">\n");
    fprintf(file,
            "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">%.17g</DataArray></FieldData>\n",
            table->time);
    return fprintf(file, "<Piece Extent=\"0 %d 0 %d 0 0\">\n<PointData Scalars=\"%s\">\n", samples[0] - 1,
                   samples[1] - 1, scalar->name) > 0;
}

static bool write_array(FILE *file, const char *name, const float *numbers, size_t count)
{
    const uint64_t bytes = count * sizeof *numbers;
    Base64 text = {.file = file};
    fprintf(file, "<DataArray type=\"Float32\" Name=\"%s\" format=\"binary\">\n", name);
    base64_add(&text, &bytes, sizeof bytes);
    base64_add(&text, numbers, bytes);
    base64_end(&text);
    return fputs("\n</DataArray>\n", file) >= 0 && !ferror(file);
}

static bool vti_file(FILE *file, const ExportContent *content)
{
    const SliceTable *table = content->slice;
    return write_head(file, table) &&
           write_array(file, scalar_list[table->wanted.scalar].name, table->value, count_of(table)) &&
           write_array(file, "field", table->field, count_of(table)) &&
           fputs("</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n", file) >= 0 && fflush(file) == 0;
}

const ExportFormat slice_csv = {.extension = "csv",
                                .help = "a slice of one snapshot as numbers",
                                .holds = EXPORT_SLICE,
                                .write = csv_file};

const ExportFormat slice_vti = {.extension = "vti",
                                .help = "a slice of one snapshot as an image for ParaView",
                                .holds = EXPORT_SLICE,
                                .write = vti_file};

const ExportFormat slice_pvd = {.extension = "pvd",
                                .help =
                                    "a slice of all snapshots: an index, and a folder with a .vti for each",
                                .holds = EXPORT_SLICE,
                                .each = &slice_vti,
                                .index = export_index_pvd};
