#include "app/files/export.h"
#include "sim/world.h"

#include <assert.h>
#include <inttypes.h>
#include <stdbool.h>
#include <string.h>
#include <strings.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/* Encodes three bytes as four digits. */
static void encode(const unsigned char from[3], char to[4])
{
    const unsigned bits = (unsigned)from[0] << 16 | (unsigned)from[1] << 8 | from[2];
    for (int k = 0; k < 4; k++)
        to[k] = digits[bits >> (18 - 6 * k) & 63];
}

void base64_add(Base64 *text, const void *bytes, size_t size)
{
    const unsigned char *from = bytes;
    char out[4096];
    size_t used = 0;
    for (size_t i = 0; i < size; i++) {
        text->rest[text->count++] = from[i];
        if (text->count < 3)
            continue;
        encode(text->rest, out + used);
        text->count = 0;
        used += 4;
        if (used == sizeof out) {
            fwrite(out, 1, used, text->file);
            used = 0;
        }
    }
    fwrite(out, 1, used, text->file);
}

void base64_end(Base64 *text)
{
    char out[4];
    if (text->count == 0)
        return;
    for (size_t k = text->count; k < 3; k++)
        text->rest[k] = 0;
    encode(text->rest, out);
    for (size_t k = text->count + 1; k < 4; k++)
        out[k] = '=';
    fwrite(out, 1, sizeof out, text->file);
    text->count = 0;
}

/* After: VTK file formats, "XML file formats", https://docs.vtk.org: PolyData, each array's numbers inside
   its element as base64 with a 64-bit size. Raw data after the XML would be smaller, but ParaView 5.11
   cannot read raw data with expat since expat's fix of CVE-2023-52425, included in Debian 12. */

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

enum { CHUNK = 4096, BLOCKS_MAX = 10 };

/* Place of a block's array in the XML, in file order. */
typedef enum Section {
    SECTION_POINTS,
    SECTION_VERTS,
    SECTION_LINES,
    SECTION_POLYS,
    SECTION_DATA,
    SECTION_CELLS,
    SECTION_COUNT
} Section;

/* An array: its size in bytes as 64 bits, then its numbers. */
typedef struct VtpBlock {
    Section section;
    const char *name, *type; /* in VTK */
    size_t components, bytes, count;
    const void *numbers;  /* or if NULL: see vector */
    float *const *vector; /* three arrays, or if NULL: see first */
    size_t first, step;   /* first, first + step, ... */
} VtpBlock;

typedef struct Contents {
    double time;
    size_t points, vertices, lines, triangles;
    const char *shown; /* attributes of PointData: roles of the arrays */
    size_t count;
    VtpBlock block[BLOCKS_MAX];
} Contents;

static void add_numbers(Contents *all, Section section, const char *name, const char *type, size_t bytes,
                        size_t count, const void *numbers)
{
    all->block[all->count++] = (VtpBlock){.section = section,
                                          .name = name,
                                          .type = type,
                                          .components = 1,
                                          .bytes = bytes,
                                          .count = count,
                                          .numbers = numbers};
}

static void add_vectors(Contents *all, Section section, const char *name, size_t count,
                        float *const vector[3])
{
    all->block[all->count++] = (VtpBlock){.section = section,
                                          .name = name,
                                          .type = "Float32",
                                          .components = 3,
                                          .bytes = 4,
                                          .count = count,
                                          .vector = vector};
}

static void add_ramp(Contents *all, Section section, const char *name, size_t count, size_t first,
                     size_t step)
{
    all->block[all->count++] = (VtpBlock){.section = section,
                                          .name = name,
                                          .type = "Int32",
                                          .components = 1,
                                          .bytes = 4,
                                          .count = count,
                                          .first = first,
                                          .step = step};
}

static void add_fields(Contents *all, const SnapshotStep *step)
{
    add_vectors(all, SECTION_DATA, "velocity", step->count, step->velocity);
    add_numbers(all, SECTION_DATA, "density", "Float32", 4, step->count, step->density);
    add_numbers(all, SECTION_DATA, "pressure", "Float32", 4, step->count, step->pressure);
    add_numbers(all, SECTION_DATA, "fluid", "Int32", 4, step->count, step->fluid);
}

static uint64_t block_bytes(const VtpBlock *block)
{
    return (uint64_t)block->count * block->components * block->bytes;
}

/* ---- the numbers ---- */

static void write_vectors(Base64 *text, const VtpBlock *block)
{
    float chunk[CHUNK][3];
    for (size_t from = 0; from < block->count; from += CHUNK) {
        const size_t size = block->count - from < CHUNK ? block->count - from : CHUNK;
        for (size_t i = 0; i < size; i++)
            for (int k = 0; k < 3; k++)
                chunk[i][k] = block->vector[k][from + i];
        base64_add(text, chunk, size * sizeof chunk[0]);
    }
}

static void write_ramp(Base64 *text, const VtpBlock *block)
{
    int32_t chunk[CHUNK];
    for (size_t from = 0; from < block->count; from += CHUNK) {
        const size_t size = block->count - from < CHUNK ? block->count - from : CHUNK;
        for (size_t i = 0; i < size; i++)
            chunk[i] = (int32_t)(block->first + block->step * (from + i));
        base64_add(text, chunk, size * sizeof chunk[0]);
    }
}

static void write_numbers(FILE *file, const VtpBlock *block)
{
    const uint64_t bytes = block_bytes(block);
    Base64 text = {.file = file};
    base64_add(&text, &bytes, sizeof bytes);
    if (block->count > 0 && block->numbers)
        base64_add(&text, block->numbers, bytes);
    else if (block->count > 0 && block->vector)
        write_vectors(&text, block);
    else if (block->count > 0)
        write_ramp(&text, block);
    base64_end(&text);
}

/* ---- the XML ---- */

/* Returns an array's unit for VTK's key, kept by ParaView; "": none. */
static const char *unit_of(const char *name)
{
    if (strcmp(name, "Points") == 0)
        return "m";
    if (strcmp(name, "velocity") == 0)
        return "m/s";
    if (strcmp(name, "time") == 0)
        return "s";
    for (int k = 0; scalar_list[k].name; k++)
        if (strcmp(name, scalar_list[k].name) == 0)
            return scalar_list[k].unit;
    return "";
}

/* Numbers come first: VTK expects them directly after the tag. */
static void print_array(FILE *file, const VtpBlock *block)
{
    const char *unit = unit_of(block->name);
    fprintf(file, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"binary\">\n",
            block->type, block->name, block->components);
    write_numbers(file, block);
    if (*unit)
        fprintf(file, "\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">%s</InformationKey>",
                unit);
    fputs("\n</DataArray>\n", file);
}

static void print_section(FILE *file, const Contents *all, Section section)
{
    for (size_t i = 0; i < all->count; i++)
        if (all->block[i].section == section)
            print_array(file, &all->block[i]);
}

static void print_all(FILE *file, const Contents *all)
{
    fprintf(file,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
            "<PolyData>\n<FieldData>\n"
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
            "%.17g</DataArray>\n</FieldData>\n"
            "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" NumberOfLines=\"%zu\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"%zu\">\n",
            all->time, all->points, all->vertices, all->lines, all->triangles);
    fputs("<Points>\n", file);
    print_section(file, all, SECTION_POINTS);
    fputs("</Points>\n<Verts>\n", file);
    print_section(file, all, SECTION_VERTS);
    fputs("</Verts>\n<Lines>\n", file);
    print_section(file, all, SECTION_LINES);
    fputs("</Lines>\n<Polys>\n", file);
    print_section(file, all, SECTION_POLYS);
    fprintf(file, "</Polys>\n<PointData %s>\n", all->shown);
    print_section(file, all, SECTION_DATA);
    fputs("</PointData>\n<CellData>\n", file);
    print_section(file, all, SECTION_CELLS);
    fputs("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n", file);
}

static bool write_all(FILE *file, const Contents *all)
{
    print_all(file, all);
    return !ferror(file);
}

static const char particles_shown[] = "Vectors=\"velocity\" Scalars=\"density\"";

bool vtp_write(FILE *file, const SnapshotStep *step)
{
    Contents all = {
        .time = step->time, .points = step->count, .vertices = step->count, .shown = particles_shown};
    add_vectors(&all, SECTION_POINTS, "Points", step->count, step->position);
    add_ramp(&all, SECTION_VERTS, "connectivity", step->count, 0, 1);
    add_ramp(&all, SECTION_VERTS, "offsets", step->count, 1, 1);
    add_fields(&all, step);
    add_numbers(&all, SECTION_DATA, "id", "Int64", 8, step->count, step->id);
    return write_all(file, &all);
}

/* Starts with the points and triangles of a mesh. */
static Contents begin_mesh(const Surface *mesh, const char *shown)
{
    const SnapshotStep *step = &mesh->vertices;
    Contents all = {
        .time = step->time, .points = step->count, .triangles = mesh->triangle_count, .shown = shown};
    add_vectors(&all, SECTION_POINTS, "Points", step->count, step->position);
    add_numbers(&all, SECTION_POLYS, "connectivity", "UInt32", 4, 3 * mesh->triangle_count, mesh->triangle);
    add_ramp(&all, SECTION_POLYS, "offsets", mesh->triangle_count, 3, 3);
    return all;
}

bool vtp_write_surface(FILE *file, const Surface *surface)
{
    const SnapshotStep *step = &surface->vertices;
    Contents all = begin_mesh(surface, "Vectors=\"velocity\" Scalars=\"density\" Normals=\"Normals\"");
    add_fields(&all, step);
    add_vectors(&all, SECTION_DATA, "Normals", step->count, surface->normal);
    return write_all(file, &all);
}

static bool vtp_write_solid(FILE *file, const Surface *solid)
{
    const SnapshotStep *step = &solid->vertices;
    Contents all = begin_mesh(solid, "Vectors=\"velocity\" Normals=\"Normals\"");
    add_vectors(&all, SECTION_DATA, "velocity", step->count, step->velocity);
    add_vectors(&all, SECTION_DATA, "Normals", step->count, solid->normal);
    return write_all(file, &all);
}

static bool vtp_write_lines(FILE *file, const VtpLines *lines)
{
    char shown[64];
    Contents all = {.time = lines->time, .points = lines->points, .lines = lines->lines, .shown = shown};
    snprintf(shown, sizeof shown, "Scalars=\"%s\"", lines->scalar);
    add_numbers(&all, SECTION_POINTS, "Points", "Float32", 4, lines->points, lines->place);
    all.block[0].components = 3;
    add_numbers(&all, SECTION_LINES, "connectivity", "Int32", 4, lines->points, lines->order);
    add_numbers(&all, SECTION_LINES, "offsets", "Int32", 4, lines->lines, lines->offset);
    add_numbers(&all, SECTION_DATA, "time", "Float64", 8, lines->points, lines->when);
    add_numbers(&all, SECTION_DATA, lines->scalar, "Float32", 4, lines->points, lines->value);
    add_numbers(&all, SECTION_CELLS, "id", "Int64", 8, lines->lines, lines->id);
    return write_all(file, &all);
}

/* After: Greg Turk, "The PLY polygon file format", 1994. */

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
typedef struct PlyRow {
    size_t size;
    uint8_t byte[64];
} PlyRow;

static void put(PlyRow *row, const void *value, size_t size)
{
    memcpy(row->byte + row->size, value, size);
    row->size += size;
}

static void put_vector(PlyRow *row, float *const vector[3], size_t i)
{
    for (int k = 0; k < 3; k++)
        put(row, &vector[k][i], sizeof(float));
}

/* Adds velocity, density, pressure and fluid. */
static void put_fields(PlyRow *row, const SnapshotStep *step, size_t i)
{
    put_vector(row, step->velocity, i);
    put(row, &step->density[i], sizeof(float));
    put(row, &step->pressure[i], sizeof(float));
    put(row, &step->fluid[i], sizeof(int32_t));
}

static void put_color(PlyRow *row, const PointPainter *painter, const SnapshotStep *step, size_t i)
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
        PlyRow row = {.size = 0};
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
        PlyRow row = {.size = 0};
        put_vector(&row, step->position, i);
        put_vector(&row, surface->normal, i);
        put_fields(&row, step, i);
        put_color(&row, &painter, step, i);
        fwrite(row.byte, row.size, 1, file);
    }
    for (size_t i = 0; i < surface->triangle_count; i++) {
        PlyRow row = {.size = 1, .byte = {3}};
        put(&row, surface->triangle[i], sizeof surface->triangle[i]);
        fwrite(row.byte, row.size, 1, file);
    }
    return !ferror(file);
}

/* Meshes as Wavefront OBJ, for Blender, Houdini and further programs: text, any number of named meshes per
   file.

   Each mesh begins with `o NAME` and `g NAME`, as programs read either objects or groups. Vertices are `v
   x y z`, m, followed by red green blue if coloured (sRGB 0 to 1, like in Blender); normals `vn`;
   triangles `f`, counter-clockwise seen from outside. y is up. Numbers have all bits of the snapshot. The
   head has time, frame and units. */

/* After: "Object files (.obj)", Wavefront Technologies, Advanced Visualizer manual, appendix B1; colours
   follow a vertex's position as in MeshLab, Blender and ParaView. */

/* A file being written. */
typedef struct ObjFile {
    FILE *file;
    size_t vertices; /* written so far: faces count from the file's first vertex */
} ObjFile;

/* Writes the head, with time (s), `frame`, and the meaning of a colormap. */
static ObjFile obj_begin(FILE *file, double time, const char *frame, const PointColors *colors)
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

/* Adds a mesh. Blanks and control characters in the name become '_'. */
static void obj_add(ObjFile *obj, const char *name, const Surface *mesh, const PointColors *colors)
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

/* Returns false if the stream failed (see errno). */
static bool obj_end(const ObjFile *obj)
{
    return !ferror(obj->file);
}

/* ---- the formats ---- */

static bool vtp_file(FILE *file, const ExportContent *content)
{
    if (content->lines)
        return vtp_write_lines(file, content->lines);
    if (content->particles)
        return vtp_write(file, content->particles);
    return content->mesh[0].solid ? vtp_write_solid(file, content->mesh[0].mesh)
                                  : vtp_write_surface(file, content->mesh[0].mesh);
}

static bool ply_file(FILE *file, const ExportContent *content)
{
    if (content->particles)
        return ply_write(file, content->particles, content->frame, content->colors);
    return ply_write_surface(file, content->mesh[0].mesh, content->frame, content->mesh[0].colors);
}

static bool obj_file(FILE *file, const ExportContent *content)
{
    ObjFile obj = obj_begin(file, content->time, content->frame, content->colors);
    for (int k = 0; k < content->mesh_count; k++)
        obj_add(&obj, content->mesh[k].name, content->mesh[k].mesh, content->mesh[k].colors);
    return obj_end(&obj);
}

static const ExportFormat vtp = {.extension = "vtp",
                                 .help = "one snapshot for ParaView",
                                 .holds = EXPORT_PARTICLES | EXPORT_MESH | EXPORT_LINES,
                                 .write = vtp_file};

static const ExportFormat pvd = {
    .extension = "pvd",
    .help = "all snapshots for ParaView: an index, and a folder with a .vtp for each",
    .holds = EXPORT_PARTICLES | EXPORT_MESH,
    .each = &vtp,
    .index = export_index_pvd,
    .has_parts = true};

static const ExportFormat ply = {
    .extension = "ply",
    .help = "one snapshot as a point cloud or a mesh: Blender, MeshLab, CloudCompare",
    .holds = EXPORT_PARTICLES | EXPORT_MESH,
    .colored = true,
    .write = ply_file,
    .check = ply_check};

static const ExportFormat ply_series = {.extension = "ply.series",
                                        .help = "all snapshots: an index, and a folder with a .ply for each",
                                        .holds = EXPORT_PARTICLES | EXPORT_MESH,
                                        .colored = true,
                                        .each = &ply,
                                        .index = export_index_series};

static const ExportFormat obj = {.extension = "obj",
                                 .help = "one snapshot's surface as a mesh: Blender, Houdini",
                                 .holds = EXPORT_MESH | EXPORT_MESHES,
                                 .colored = true,
                                 .write = obj_file};

static const ExportFormat obj_series = {
    .extension = "obj.series",
    .help = "all snapshots' surfaces: an index, and a folder with a .obj for each",
    .holds = EXPORT_MESH | EXPORT_MESHES,
    .colored = true,
    .each = &obj,
    .index = export_index_series};

enum { FORMATS_MAX = 16 };

/* clang-format off */

/* In the order of help and messages; ends with NULL. */
static const ExportFormat *formats[FORMATS_MAX + 1] = {
    &pvd,
    &vtp,
    &ply,
    &ply_series,
    &obj,
    &obj_series,
    &slice_vti,
    &slice_csv,
    &slice_pvd,
};

/* clang-format on */

const ExportFormat *export_format_at(int index)
{
    return formats[index];
}

void export_format_add(const ExportFormat *format)
{
    int count = 0;
    while (formats[count])
        count++;
    assert(count < FORMATS_MAX);
    formats[count] = format;
}

/* True if the file is named SOMETHING.EXTENSION. */
static bool has_extension(const char *path, const char *extension)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t length = strlen(name), end = strlen(extension);
    return length > end + 1 && name[length - end - 1] == '.' &&
           strcasecmp(name + length - end, extension) == 0;
}

const ExportFormat *export_format_find(const char *path, unsigned what, Error *error)
{
    char known[256] = "";
    const ExportFormat *last = NULL;
    for (int i = 0; formats[i]; i++) {
        if ((formats[i]->holds & what) == 0)
            continue;
        if (has_extension(path, formats[i]->extension))
            return formats[i];
        last = formats[i];
    }
    for (int i = 0; error && formats[i]; i++)
        if ((formats[i]->holds & what) != 0)
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s.%s",
                     !*known              ? ""
                     : formats[i] == last ? " or "
                                          : ", ",
                     formats[i]->extension);
    error_set(error, "cannot tell the format%s from '%s'; use %s",
              what == EXPORT_SLICE   ? " of a slice"
              : what == EXPORT_LINES ? " of trails"
                                     : "",
              path, known);
    return NULL;
}
