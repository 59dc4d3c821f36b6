/* Particles in foreign HDF5 files: a group Step#N a step (H5Part), or PartType0 (GADGET and the like, the
   gas). A dataset is a column, of a number or of two or three numbers a particle. */
#include "app/files/foreign/foreign.h"

#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char gas[] = "PartType0";

static hid_t open_file(const char *path, Error *error)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5Pset_file_locking(access, false, true); /* read only, beside a writer */
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if (file < 0)
        error_set(error, "%.300s: is no whole file of HDF5, or cannot be read", path);
    return file;
}

/* A number of an attribute; false: there is none. */
static bool read_number(hid_t at, const char *name, double *value)
{
    const hid_t attribute = H5Aexists(at, name) > 0 ? H5Aopen(at, name, H5P_DEFAULT) : -1;
    const hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
    const bool read = space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                      H5Aread(attribute, H5T_NATIVE_DOUBLE, value) >= 0 && isfinite(*value);
    if (space >= 0)
        H5Sclose(space);
    if (attribute >= 0)
        H5Aclose(attribute);
    return read;
}

static double time_of(hid_t file, const char *group_name)
{
    static const char *const names[] = {"TimeValue", "Time", "time", "t"};
    const bool is_gas = strcmp(group_name, gas) == 0;
    if (is_gas && H5Lexists(file, "Header", H5P_DEFAULT) <= 0)
        return NAN;
    const hid_t group = H5Gopen2(file, is_gas ? "Header" : group_name, H5P_DEFAULT);
    double time = NAN;
    for (size_t k = 0; group >= 0 && k < sizeof names / sizeof *names; k++)
        if (read_number(group, names[k], &time))
            break;
    if (group >= 0)
        H5Gclose(group);
    return time;
}

static void name_of(size_t inner, char name[32])
{
    if (inner == SIZE_MAX)
        snprintf(name, 32, "%s", gas);
    else
        snprintf(name, 32, "Step#%zu", inner);
}

typedef struct Listing {
    const char *path;
    ForeignSeries *series;
    bool no_memory;
} Listing;

static herr_t look(hid_t file, const char *name, const H5L_info_t *info, void *user)
{
    Listing *listing = user;
    char own[32];
    (void)info;
    if (strncmp(name, "Step#", 5) != 0)
        return 0;
    const size_t inner = strtoul(name + 5, NULL, 10);
    name_of(inner, own);
    if (strcmp(name, own) == 0)
        listing->no_memory |= !foreign_series_add(listing->series, listing->path, inner, time_of(file, name));
    return 0;
}

static int by_number(const void *a, const void *b)
{
    const ForeignStep *one = a, *other = b;
    return (one->inner > other->inner) - (one->inner < other->inner);
}

static bool list(const char *path, ForeignSeries *series, Error *error)
{
    const hid_t file = open_file(path, error);
    Listing listing = {.path = path, .series = series};
    if (file < 0)
        return false;
    H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, look, &listing);
    if (series->count > 0)
        qsort(series->step, series->count, sizeof *series->step, by_number);
    if (series->count == 0 && H5Lexists(file, gas, H5P_DEFAULT) > 0)
        listing.no_memory |= !foreign_series_add(series, path, SIZE_MAX, time_of(file, gas));
    H5Fclose(file);
    if (listing.no_memory)
        return error_set(error, "%.300s: no memory for its steps", path);
    return series->count > 0 ||
           error_set(error,
                     "%.300s: has no particles that slosh finds; they must be in groups Step#0, Step#1, "
                     "... (H5Part), or in the group %s",
                     path, gas);
}

/* ---- a step ---- */

typedef struct Reading {
    const char *path;
    ForeignTable *table;
    bool counted, failed;
    Error *error;
} Reading;

/* A dataset of numbers: particles, and numbers of each. */
static bool shape_of(hid_t set, size_t *count, int *components)
{
    hsize_t size[2] = {0, 1};
    const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    const int dimensions = space >= 0 ? H5Sget_simple_extent_ndims(space) : 0;
    const H5T_class_t kind = type >= 0 ? H5Tget_class(type) : H5T_NO_CLASS;
    bool ok = (dimensions == 1 || dimensions == 2) && (kind == H5T_FLOAT || kind == H5T_INTEGER);
    if (ok)
        H5Sget_simple_extent_dims(space, size, NULL);
    ok = ok && size[1] >= 1 && size[1] <= 9;
    *count = size[0];
    *components = (int)size[1];
    if (space >= 0)
        H5Sclose(space);
    if (type >= 0)
        H5Tclose(type);
    return ok;
}

/* Numbers that are stored, not only claimed. */
static bool is_stored(hid_t set, size_t count)
{
    const hsize_t bytes = H5Dget_storage_size(set);
    return count == 0 || (double)count <= 1e6 || (double)bytes * 2000 >= (double)count;
}

static herr_t read_set(hid_t group, const char *name, const H5L_info_t *info, void *user)
{
    Reading *reading = user;
    ForeignTable *table = reading->table;
    size_t count;
    int components;
    (void)info;
    const hid_t set = H5Oopen(group, name, H5P_DEFAULT);
    if (set < 0 || H5Iget_type(set) != H5I_DATASET || !shape_of(set, &count, &components) ||
        (reading->counted && count != table->count)) {
        if (set >= 0)
            H5Oclose(set);
        return 0;
    }
    reading->counted = true;
    table->count = count;
    if (!is_stored(set, count))
        reading->failed |= !error_set(reading->error, "%.300s: '%s' claims %zu particles that are not in it",
                                      reading->path, name, count);
    else {
        ForeignColumn *column = foreign_column_add(table, reading->path, name, components, reading->error);
        reading->failed |= !column;
        if (column && column->value && count > 0 &&
            H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column->value) < 0)
            reading->failed |= !error_set(reading->error, "%.300s: '%s' cannot be read", reading->path, name);
    }
    H5Oclose(set);
    return reading->failed;
}

/* The length of the places: datasets of a different length are no columns. */
static bool count_particles(hid_t group, Reading *reading)
{
    static const char *const names[] = {"x", "Coordinates", "coordinates", "position", "Position", "pos",
                                        "X"};
    int components;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const hid_t set =
            H5Lexists(group, names[k], H5P_DEFAULT) > 0 ? H5Dopen2(group, names[k], H5P_DEFAULT) : -1;
        reading->counted |= set >= 0 && shape_of(set, &reading->table->count, &components);
        if (set >= 0)
            H5Dclose(set);
        if (reading->counted)
            return true;
    }
    return true;
}

static bool read(const char *path, size_t inner, ForeignTable *table, Error *error)
{
    char name[32];
    Reading reading = {.path = path, .table = table, .error = error};
    const hid_t file = open_file(path, error);
    if (file < 0)
        return false;
    name_of(inner, name);
    table->time = time_of(file, name);
    const hid_t group = H5Gopen2(file, name, H5P_DEFAULT);
    bool ok = group >= 0;
    if (!ok)
        error_set(error, "%.300s: has no group '%s' any more", path, name);
    if (ok && !table->head_only) {
        count_particles(group, &reading);
        ok = H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, read_set, &reading) >= 0 && !reading.failed;
        if (!ok && !reading.failed)
            error_set(error, "%.300s: %s cannot be read", path, name);
    }
    if (group >= 0)
        H5Gclose(group);
    H5Fclose(file);
    return ok;
}

static const char *const endings[] = {".h5part", ".h5", ".hdf5", NULL};

const ForeignFormat foreign_hdf5 = {.name = "HDF5", .endings = endings, .list = list, .read = read};
