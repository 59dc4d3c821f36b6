/* Writes the attributes and datasets of a file of snapshots. */
#include "app/output/snapshot_parts.h"

#include "app/scene/keys.h"
#include "sim/base/color.h"

#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK_VALUES = 1 << 16 };

static bool write_attribute(hid_t at, const char *name, hid_t type, hid_t space, const void *value)
{
    hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool written = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    return (attribute < 0 || H5Aclose(attribute) >= 0) && written;
}

bool snapshot_write_values(hid_t at, const char *name, hid_t type, size_t count, const void *values)
{
    hsize_t size = count;
    hid_t space = count == SNAPSHOT_SCALAR ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    bool written = space >= 0 && write_attribute(at, name, type, space, values);
    if (space >= 0)
        H5Sclose(space);
    return written;
}

static bool write_doubles(hid_t at, const char *name, size_t count, const double *values)
{
    return snapshot_write_values(at, name, H5T_IEEE_F64LE, count, values);
}

bool snapshot_write_texts(hid_t at, const char *name, size_t count, size_t stride, const char *texts)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    bool written = type >= 0 && H5Tset_size(type, stride) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0 &&
                   snapshot_write_values(at, name, type, count, texts);
    if (type >= 0)
        H5Tclose(type);
    return written;
}

static bool write_settings(hid_t file, const Scene *scene)
{
    char *text = scene_print_text(scene);
    const bool written =
        text && snapshot_write_texts(file, SNAPSHOT_SETTINGS, SNAPSHOT_SCALAR, strlen(text) + 1, text);
    free(text);
    return written;
}

/* Writes the folder of the scene file; none if the scene was never in a file, or the folder is gone. */
static bool write_folder(hid_t file, const Scene *scene)
{
    char copy[sizeof scene->path];
    snprintf(copy, sizeof copy, "%s", scene->path);
    char *folder = realpath(dirname(copy), NULL);
    const bool written =
        !folder || snapshot_write_texts(file, SNAPSHOT_FOLDER, SNAPSHOT_SCALAR, strlen(folder) + 1, folder);
    free(folder);
    return written;
}

/* Datasets not listed have no unit: numbers and fractions. */
static const char units[] = "TimeValue = s\nx = m\ny = m\nz = m\nvelocity_0 = m/s\nvelocity_1 = m/s\n"
                            "velocity_2 = m/s\ndensity = kg/m3\npressure = Pa\n";

bool snapshot_write_root(hid_t file, const Scene *scene)
{
    const WorldDef *def = &scene->world;
    char names[FLUIDS_MAX][NAME_SIZE] = {{0}};
    double densities[FLUIDS_MAX] = {0}, colors[FLUIDS_MAX][3];
    double support_radius = def->support * def->spacing;
    size_t count = (size_t)def->fluid_count;
    for (size_t i = 0; i < count; i++) {
        snprintf(names[i], NAME_SIZE, "%s", def->fluids[i].name);
        densities[i] = def->fluids[i].density;
        for (int k = 0; k < 3; k++)
            colors[i][k] = linear_to_srgb(def->fluids[i].color[k]);
    }
    return snapshot_write_texts(file, "title", SNAPSHOT_SCALAR, sizeof scene->title, scene->title) &&
           write_settings(file, scene) && write_folder(file, scene) &&
           snapshot_write_texts(file, SNAPSHOT_UNITS, SNAPSHOT_SCALAR, sizeof units, units) &&
           snapshot_write_texts(file, "slosh_version", SNAPSHOT_SCALAR, sizeof SLOSH_VERSION,
                                SLOSH_VERSION) &&
           snapshot_write_texts(file, "method", SNAPSHOT_SCALAR, NAME_SIZE, def->method) &&
           write_doubles(file, "spacing", SNAPSHOT_SCALAR, &def->spacing) &&
           write_doubles(file, "support_radius", SNAPSHOT_SCALAR, &support_radius) &&
           write_doubles(file, "box_size", 3, def->box_size) &&
           snapshot_write_texts(file, "fluid_names", count, NAME_SIZE, names[0]) &&
           write_doubles(file, "fluid_densities", count, densities) &&
           write_doubles(file, SNAPSHOT_COLORS, 3 * count, colors[0]);
}

/* Shuffled bytes and fastest gzip; a field without particles cannot be chunked. */
static hid_t field_layout(size_t count)
{
    hsize_t chunk = count < CHUNK_VALUES ? count : CHUNK_VALUES;
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    if (layout >= 0 && count > 0) {
        H5Pset_chunk(layout, 1, &chunk);
        H5Pset_shuffle(layout);
        H5Pset_deflate(layout, 1);
    }
    return layout;
}

/* Selects the process' own part of a dataset. */
static bool choose(hid_t space, hid_t memory, const Extent *extent)
{
    const hsize_t begin = extent->begin, own = extent->own;
    return own == 0 ? H5Sselect_none(space) >= 0 && H5Sselect_none(memory) >= 0
                    : H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, NULL, &own, NULL) >= 0;
}

static bool write_field(hid_t group, const char *name, hid_t type, const Extent *extent, const void *values)
{
    const hsize_t all = extent->all, own = extent->own;
    hid_t space = H5Screate_simple(1, &all, NULL), memory = H5Screate_simple(1, &own, NULL);
    hid_t layout = field_layout(extent->all);
    hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    bool written = set >= 0 && choose(space, memory, extent) &&
                   (extent->all == 0 || H5Dwrite(set, type, memory, space, extent->transfer, values) >= 0);
    written = (set < 0 || H5Dclose(set) >= 0) && written;
    H5Pclose(layout);
    H5Sclose(memory);
    H5Sclose(space);
    return written;
}

static bool write_fields(hid_t group, const SnapshotStep *step, const Extent *extent)
{
    bool written = true;
#define X(name, count, values)                                                                               \
    written = written && write_doubles(group, name, count == 1 ? SNAPSHOT_SCALAR : count, values);
    SNAPSHOT_ATTRIBUTES(X)
#undef X
#define X(name, type, field)                                                                                 \
    written = written && write_field(group, name, SNAPSHOT_TYPE(step->field), extent, step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    for (int k = 0; k < step->own_count; k++)
        written =
            written && write_field(group, step->own[k].name, H5T_IEEE_F32LE, extent, step->own[k].values);
    if (step->born)
        written = written && write_field(group, scalar_name(SCALAR_BORN), H5T_IEEE_F32LE, extent, step->born);
    written =
        written && write_doubles(group, SNAPSHOT_RESTART, WORLD_NUMBERS, (const double *)&step->restart);
    return written &&
           snapshot_write_values(group, SNAPSHOT_STEP_NUMBER, H5T_STD_U64LE, SNAPSHOT_SCALAR, &step->step);
}

/* A program may be killed between any two writes to the disk. So the step is built as an unlinked group,
   synced to the disk, marked as complete, and only then named. The directory has room for the name without
   growing, so that the last flush overwrites a few bytes in place. Only when the directory must grow, once in
   128 steps, four writes remain during which a kill makes the file unreadable. */
bool snapshot_write_step(hid_t file, size_t number, const SnapshotStep *step, const Extent *extent)
{
    const int32_t complete = 1;
    char name[32];
    snapshot_group_name(number, name);
    hid_t group = H5Gcreate_anon(file, H5P_DEFAULT, H5P_DEFAULT);
    bool written =
        group >= 0 && write_fields(group, step, extent) && H5Fflush(file, H5F_SCOPE_LOCAL) >= 0 &&
        snapshot_write_values(group, SNAPSHOT_COMPLETE, H5T_STD_I32LE, SNAPSHOT_SCALAR, &complete) &&
        H5Fflush(file, H5F_SCOPE_LOCAL) >= 0 && H5Olink(group, file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0;
    written = (group < 0 || H5Gclose(group) >= 0) && written;
    return written && H5Fflush(file, H5F_SCOPE_LOCAL) >= 0;
}
