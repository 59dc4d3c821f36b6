/* After: "Object files (.obj)", Wavefront Technologies, Advanced Visualizer manual, appendix B1; colours
   follow a vertex's position as in MeshLab, Blender and ParaView. */
#include "app/export/obj.h"

ObjFile obj_begin(FILE *file, double time, const char *frame, const PointColors *colors)
{
    fprintf(file, "# slosh, time %.17g s, frame of the %s; places in m, y up\n", time, frame);
    point_colors_print(file, "# ", colors);
    return (ObjFile){.file = file};
}

static void print_name(FILE *file, const char *kind, const char *name)
{
    fprintf(file, "%s ", kind);
    for (; *name; name++)
        fputc((unsigned char)*name <= ' ' ? '_' : *name, file);
    fputc('\n', file);
}

static void print_vertex(FILE *file, const SnapshotStep *step, size_t i, const PointPainter *painter)
{
    fprintf(file, "v %.9g %.9g %.9g", step->position[0][i], step->position[1][i], step->position[2][i]);
    if (point_colored(painter->colors)) {
        uint8_t rgb[3];
        point_paint(painter, step, i, rgb);
        fprintf(file, " %.4g %.4g %.4g", rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    }
    fputc('\n', file);
}

void obj_add(ObjFile *obj, const char *name, const Surface *mesh, const PointColors *colors)
{
    const PointPainter painter = point_painter(colors);
    const size_t count = mesh->vertices.count, first = obj->vertices + 1;
    FILE *file = obj->file;
    print_name(file, "o", name);
    print_name(file, "g", name);
    for (size_t i = 0; i < count; i++)
        print_vertex(file, &mesh->vertices, i, &painter);
    for (size_t i = 0; i < count; i++)
        fprintf(file, "vn %.5g %.5g %.5g\n", mesh->normal[0][i], mesh->normal[1][i], mesh->normal[2][i]);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *at = mesh->triangle[i];
        const size_t a = at[0] + first, b = at[1] + first, c = at[2] + first;
        fprintf(file, "f %zu//%zu %zu//%zu %zu//%zu\n", a, a, b, b, c, c);
    }
    obj->vertices += count;
}

bool obj_end(const ObjFile *obj)
{
    return !ferror(obj->file);
}
