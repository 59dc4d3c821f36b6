/* Points with normals from a PLY file: G. Turk, "The PLY polygon file format", 1994. Of the element vertex
   the properties x, y, z, nx, ny, nz are read, in ASCII or binary; elements behind it are left out. */
#include "app/scene/import/import.h"

#include "app/base/file.h"
#include "sim/points/scattered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WANTED = 6, PLY_MIB_MAX = 1024 };

/* The columns of x, y, z, nx, ny, nz. */
static bool find_columns(const Ply *ply, int column[WANTED])
{
    static const char *const names[WANTED] = {"x", "y", "z", "nx", "ny", "nz"};
    for (int w = 0; w < WANTED; w++) {
        column[w] = -1;
        for (int k = 0; k < ply->properties; k++)
            if (strcmp(ply->name[k], names[w]) == 0)
                column[w] = k;
        if (column[w] < 0)
            return ply_fail(ply, "points with normals have the properties x, y, z, nx, ny and nz");
    }
    return true;
}

bool points_parse(const char *path, const char *bytes, size_t size, PointsFile *out, Error *error)
{
    Ply ply;
    int column[WANTED] = {0};
    double value[PLY_PROPERTIES_MAX];
    *out = (PointsFile){0};
    if (!ply_begin(&ply, path, bytes, size, error) || !find_columns(&ply, column))
        return false;
    out->place = calloc(ply.count + 1, sizeof *out->place);
    out->normal = calloc(ply.count + 1, sizeof *out->normal);
    bool ok = out->place && out->normal;
    if (!ok)
        error_set(error, "%s: no memory for %zu points", path, ply.count);
    for (size_t i = 0; ok && i < ply.count; i++) {
        ok = ply_row(&ply, value);
        for (int w = 0; ok && w < WANTED; w++)
            (w < 3 ? out->place : out->normal)[i][w % 3] = (float)value[column[w]];
    }
    out->count = ply.count;
    if (!ok)
        points_free(out);
    return ok;
}

void points_free(PointsFile *points)
{
    free(points->place);
    free(points->normal);
    *points = (PointsFile){0};
}

bool points_file_is(const char *path)
{
    const size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".ply") == 0;
}

bool points_file_load(const char *path, VolumeData *volume, float **values, Error *error)
{
    size_t size;
    PointsFile points = {0};
    Error why;
    *values = NULL;
    char *bytes = read_file(path, (size_t)PLY_MIB_MAX << 20, "PLY file of points", &size, error);
    const bool parsed = bytes && points_parse(path, bytes, size, &points, error);
    free(bytes);
    if (!parsed)
        return false;
    const ScatteredPoints scattered = {points.count, (const float(*)[3])points.place,
                                       (const float(*)[3])points.normal};
    const bool made = scattered_volume(&scattered, volume, values, &why);
    points_free(&points);
    return made || error_set(error, "%.300s: %s", path, why.message);
}
