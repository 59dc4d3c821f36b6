/* After: Greg Turk, "The PLY polygon file format", 1994. */
#include "app/export/ply.h"

#include <inttypes.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

bool ply_check(const SnapshotStep *step, Error *error)
{
    for (size_t i = 0; i < step->count; i++)
        if (step->id[i] < 0 || step->id[i] > UINT32_MAX)
            return error_set(error, "the id %" PRId64 " does not fit into a .ply; write a .vtp", step->id[i]);
    return true;
}

static void print_head(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors)
{
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\ncomment slosh, time %.17g s, frame of the %s, SI units\n",
            step->time, frame);
    point_colors_print(file, "comment ", colors);
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

/* A row being built. */
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

/* Adds velocity, density, pressure and fluid. */
static void put_fields(Row *row, const SnapshotStep *step, size_t i)
{
    put_vector(row, step->velocity, i);
    put(row, &step->density[i], sizeof(float));
    put(row, &step->pressure[i], sizeof(float));
    put(row, &step->fluid[i], sizeof(int32_t));
}

static void put_color(Row *row, const PointPainter *painter, const SnapshotStep *step, size_t i)
{
    uint8_t rgb[3];
    if (!point_colored(painter->colors))
        return;
    point_paint(painter, step, i, rgb);
    put(row, rgb, sizeof rgb);
}

bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors)
{
    print_head(file, step, frame, colors);
    print_properties(file, "float", places);
    print_properties(file, "float", fields);
    print_properties(file, "int", fluids);
    print_properties(file, "uint", ids);
    print_properties(file, "uchar", point_colored(colors) ? channels : channels + 3);
    fputs("end_header\n", file);
    const PointPainter painter = point_painter(colors);
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

bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PointColors *colors)
{
    const SnapshotStep *step = &surface->vertices;
    print_head(file, step, frame, colors);
    print_properties(file, "float", places);
    print_properties(file, "float", normals);
    print_properties(file, "float", fields);
    print_properties(file, "int", fluids);
    print_properties(file, "uchar", point_colored(colors) ? channels : channels + 3);
    fprintf(file, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            surface->triangle_count);
    const PointPainter painter = point_painter(colors);
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
