/* After: Greg Turk, "The PLY polygon file format", 1994. */
#include "app/export/ply.h"

#include "render/frame/colormap.h"

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

static void print_head(FILE *file, const SnapshotStep *step, const char *frame, const PlyColors *colors)
{
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\ncomment slosh, time %.17g s, frame of the %s, SI units\n",
            step->time, frame);
    if (colors->mapped)
        fprintf(file, "comment colours: %s, %s from %g to %g %s\n", colormap_list[0],
                scalar_name(colors->scalar), colors->low, colors->high, scalar_unit(colors->scalar));
    fprintf(file, "element vertex %zu\n", step->count);
}

static void print_properties(FILE *file, const char *type, const char *const names[])
{
    for (; *names; names++)
        fprintf(file, "property %s %s\n", type, *names);
}

static const char *const places[] = {"x", "y", "z", NULL}, *const normals[] = {"nx", "ny", "nz", NULL},
                         *const fields[] = {"vx", "vy", "vz", "density", "pressure", NULL},
                         *const fluids[] = {"fluid", NULL}, *const ids[] = {"id", NULL},
                         *const channels[] = {"red", "green", "blue", NULL};

static bool colored(const PlyColors *colors)
{
    return colors->mapped || colors->count > 0;
}

static void fluid_color(const PlyColors *colors, int32_t fluid, uint8_t rgb[3])
{
    static const double grey[3] = {0.5, 0.5, 0.5};
    const double *color = fluid >= 0 && (size_t)fluid < colors->count ? colors->color[fluid] : grey;
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)lround(255 * fmin(fmax(color[k], 0), 1));
}

double ply_scalar(const SnapshotStep *step, size_t i, Scalar scalar)
{
    const double x = step->velocity[0][i], y = step->velocity[1][i], z = step->velocity[2][i];
    if (scalar == SCALAR_SPEED)
        return sqrt(x * x + y * y + z * z);
    return scalar == SCALAR_DENSITY ? step->density[i] : step->pressure[i];
}

/* A row in the making. */
typedef struct Row {
    size_t size;
    uint8_t byte[64];
} Row;

static void put(Row *row, const void *value, size_t size)
{
    memcpy(row->byte + row->size, value, size);
    row->size += size;
}

static void put_vector(Row *row, float *const vector[3], size_t i)
{
    for (int k = 0; k < 3; k++)
        put(row, &vector[k][i], sizeof(float));
}

/* Velocity, density, pressure and fluid. */
static void put_fields(Row *row, const SnapshotStep *step, size_t i)
{
    put_vector(row, step->velocity, i);
    put(row, &step->density[i], sizeof(float));
    put(row, &step->pressure[i], sizeof(float));
    put(row, &step->fluid[i], sizeof(int32_t));
}

/* Colours of points: of their fluids, or of a colormap. */
typedef struct Painter {
    const PlyColors *colors;
    uint8_t map[3 * COLORMAP_SIZE];
} Painter;

static Painter painter_begin(const PlyColors *colors)
{
    Painter painter = {.colors = colors};
    colormap_fill(colormap_list[0], painter.map);
    return painter;
}

static void put_color(Row *row, const Painter *painter, const SnapshotStep *step, size_t i)
{
    const PlyColors *colors = painter->colors;
    uint8_t rgb[3];
    if (!colored(colors))
        return;
    fluid_color(colors, step->fluid[i], rgb);
    if (colors->mapped) {
        const double above = ply_scalar(step, i, colors->scalar) - colors->low;
        const double at = fmin(fmax(above / fmax(colors->high - colors->low, 1e-30), 0), 1);
        memcpy(rgb, painter->map + 3 * lround((COLORMAP_SIZE - 1) * at), sizeof rgb);
    }
    put(row, rgb, sizeof rgb);
}

bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PlyColors *colors)
{
    print_head(file, step, frame, colors);
    print_properties(file, "float", places);
    print_properties(file, "float", fields);
    print_properties(file, "int", fluids);
    print_properties(file, "uint", ids);
    print_properties(file, "uchar", colored(colors) ? channels : channels + 3);
    fputs("end_header\n", file);
    const Painter painter = painter_begin(colors);
    for (size_t i = 0; i < step->count; i++) {
        const uint32_t id = (uint32_t)step->id[i];
        Row row = {.size = 0};
        put_vector(&row, step->position, i);
        put_fields(&row, step, i);
        put(&row, &id, sizeof id);
        put_color(&row, &painter, step, i);
        fwrite(row.byte, row.size, 1, file);
    }
    return !ferror(file);
}

bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PlyColors *colors)
{
    const SnapshotStep *step = &surface->vertices;
    print_head(file, step, frame, colors);
    print_properties(file, "float", places);
    print_properties(file, "float", normals);
    print_properties(file, "float", fields);
    print_properties(file, "int", fluids);
    print_properties(file, "uchar", colored(colors) ? channels : channels + 3);
    fprintf(file, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            surface->triangle_count);
    const Painter painter = painter_begin(colors);
    for (size_t i = 0; i < step->count; i++) {
        Row row = {.size = 0};
        put_vector(&row, step->position, i);
        put_vector(&row, surface->normal, i);
        put_fields(&row, step, i);
        put_color(&row, &painter, step, i);
        fwrite(row.byte, row.size, 1, file);
    }
    for (size_t i = 0; i < surface->triangle_count; i++) {
        Row row = {.size = 1, .byte = {3}};
        put(&row, surface->triangle[i], sizeof surface->triangle[i]);
        fwrite(row.byte, row.size, 1, file);
    }
    return !ferror(file);
}
