/* After: Greg Turk, "The PLY polygon file format", 1994. */
#include "app/ply.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

bool ply_check(const SnapshotStep *step, Error *error)
{
    for (size_t i = 0; i < step->count; i++)
        if (step->id[i] < 0 || step->id[i] > UINT32_MAX)
            return error_set(error, "the id %" PRId64 " does not fit into a .ply; write a .vtp", step->id[i]);
    return true;
}

static void print_head(FILE *file, const SnapshotStep *step, const char *frame, bool colored)
{
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\ncomment slosh, time %.17g s, frame of the %s, SI units\n"
            "element vertex %zu\n",
            step->time, frame, step->count);
    static const char *const floats[] = {"x", "y", "z", "vx", "vy", "vz", "density", "pressure"};
    for (size_t i = 0; i < sizeof floats / sizeof *floats; i++)
        fprintf(file, "property float %s\n", floats[i]);
    fputs("property int fluid\nproperty uint id\n", file);
    if (colored)
        fputs("property uchar red\nproperty uchar green\nproperty uchar blue\n", file);
    fputs("end_header\n", file);
}

/* The bytes of the fluid's colour. */
static void color_bytes(const PlyColors *colors, int32_t fluid, uint8_t rgb[3])
{
    static const double grey[3] = {0.5, 0.5, 0.5};
    const double *color = fluid >= 0 && (size_t)fluid < colors->count ? colors->color[fluid] : grey;
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)lround(255 * fmin(fmax(color[k], 0), 1));
}

bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PlyColors *colors)
{
    print_head(file, step, frame, colors->count > 0);
    for (size_t i = 0; i < step->count; i++) {
        const float numbers[8] = {step->position[0][i], step->position[1][i], step->position[2][i],
                                  step->velocity[0][i], step->velocity[1][i], step->velocity[2][i],
                                  step->density[i],     step->pressure[i]};
        const uint32_t id = (uint32_t)step->id[i];
        uint8_t row[43];
        memcpy(row, numbers, 32);
        memcpy(row + 32, &step->fluid[i], 4);
        memcpy(row + 36, &id, 4);
        color_bytes(colors, step->fluid[i], row + 40);
        fwrite(row, colors->count > 0 ? 43 : 40, 1, file);
    }
    return !ferror(file);
}
