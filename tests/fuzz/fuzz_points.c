/* Fuzz target of points with normals in PLY: accepted files have as many as are said, and give a volume or a
   reason. */
#include "app/scene/import/import.h"
#include "sim/points/scattered.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static void check_volume(const PointsFile *points)
{
    const ScatteredPoints scattered = {points->count, (const float(*)[3])points->place,
                                       (const float(*)[3])points->normal};
    VolumeData volume;
    float *values;
    Error error = {""};
    if (!scattered_volume(&scattered, &volume, &values, &error)) {
        must(!values && error.message[0]);
        return;
    }
    size_t count = 1;
    for (int k = 0; k < 3; k++)
        count *= (size_t)volume.size[k];
    for (size_t i = 0; i < count; i++)
        must(values[i] >= 0 && values[i] <= 1);
    free(values);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    PointsFile points;
    Error error = {""};
    if (!points_parse("fuzz.ply", (const char *)data, size, &points, &error)) {
        must(!points.place && strncmp(error.message, "fuzz.ply:", strlen("fuzz.ply:")) == 0);
        return 0;
    }
    must(points.count <= size);
    if (points.count < 8) /* a volume takes some milliseconds */
        check_volume(&points);
    points_free(&points);
    return 0;
}
