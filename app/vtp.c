/* After: VTK file formats, "XML file formats", https://docs.vtk.org: PolyData and Collection, raw appended
   data with 64-bit sizes. */
#include "app/vtp.h"

#include <inttypes.h>
#include <stdbool.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

enum { CHUNK = 4096 };

/* The appended blocks in their order; each is its size in bytes as 64 bits and then its numbers. */
typedef enum Block {
    BLOCK_POINTS,
    BLOCK_CONNECTIVITY,
    BLOCK_OFFSETS,
    BLOCK_VELOCITY,
    BLOCK_DENSITY,
    BLOCK_PRESSURE,
    BLOCK_FLUID,
    BLOCK_ID,
    BLOCK_COUNT
} Block;

static const struct {
    const char *name, *type;  /* VTK's */
    size_t components, bytes; /* of a particle; of a component */
} blocks[BLOCK_COUNT] = {
    [BLOCK_POINTS] = {"Points", "Float32", 3, 4},   [BLOCK_CONNECTIVITY] = {"connectivity", "Int32", 1, 4},
    [BLOCK_OFFSETS] = {"offsets", "Int32", 1, 4},   [BLOCK_VELOCITY] = {"velocity", "Float32", 3, 4},
    [BLOCK_DENSITY] = {"density", "Float32", 1, 4}, [BLOCK_PRESSURE] = {"pressure", "Float32", 1, 4},
    [BLOCK_FLUID] = {"fluid", "Int32", 1, 4},       [BLOCK_ID] = {"id", "Int64", 1, 8},
};

static uint64_t block_bytes(Block block, size_t count)
{
    return (uint64_t)count * blocks[block].components * blocks[block].bytes;
}

/* ---- the XML ---- */

static void print_array(FILE *file, Block block, size_t count)
{
    uint64_t offset = 0;
    for (int before = 0; before < (int)block; before++)
        offset += sizeof(uint64_t) + block_bytes((Block)before, count);
    fprintf(file,
            "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"appended\" "
            "offset=\"%" PRIu64 "\"/>\n",
            blocks[block].type, blocks[block].name, blocks[block].components, offset);
}

static void print_head(FILE *file, const SnapshotStep *step)
{
    fprintf(file,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
            "<PolyData>\n<FieldData>\n"
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
            "%.17g</DataArray>\n</FieldData>\n"
            "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"0\">\n",
            step->time, step->count, step->count);
    fputs("<Points>\n", file);
    print_array(file, BLOCK_POINTS, step->count);
    fputs("</Points>\n<Verts>\n", file);
    print_array(file, BLOCK_CONNECTIVITY, step->count);
    print_array(file, BLOCK_OFFSETS, step->count);
    fputs("</Verts>\n<PointData Vectors=\"velocity\" Scalars=\"density\">\n", file);
    for (int block = BLOCK_VELOCITY; block < BLOCK_COUNT; block++)
        print_array(file, (Block)block, step->count);
    fputs("</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_", file);
}

/* ---- the numbers ---- */

static void begin_block(FILE *file, Block block, size_t count)
{
    const uint64_t bytes = block_bytes(block, count);
    fwrite(&bytes, sizeof bytes, 1, file);
}

static void write_numbers(FILE *file, Block block, size_t count, const void *numbers)
{
    begin_block(file, block, count);
    fwrite(numbers, blocks[block].bytes, count, file);
}

static void write_vectors(FILE *file, Block block, size_t count, float *const vector[3])
{
    float chunk[CHUNK][3];
    begin_block(file, block, count);
    for (size_t from = 0; from < count; from += CHUNK) {
        const size_t size = count - from < CHUNK ? count - from : CHUNK;
        for (size_t i = 0; i < size; i++)
            for (int k = 0; k < 3; k++)
                chunk[i][k] = vector[k][from + i];
        fwrite(chunk, sizeof chunk[0], size, file);
    }
}

/* first, first + 1, ...: which point a vertex is, or where the next one's list begins. */
static void write_ramp(FILE *file, Block block, size_t count, size_t first)
{
    int32_t chunk[CHUNK];
    begin_block(file, block, count);
    for (size_t from = 0; from < count; from += CHUNK) {
        const size_t size = count - from < CHUNK ? count - from : CHUNK;
        for (size_t i = 0; i < size; i++)
            chunk[i] = (int32_t)(first + from + i);
        fwrite(chunk, sizeof chunk[0], size, file);
    }
}

bool vtp_write(FILE *file, const SnapshotStep *step)
{
    print_head(file, step);
    write_vectors(file, BLOCK_POINTS, step->count, step->position);
    write_ramp(file, BLOCK_CONNECTIVITY, step->count, 0);
    write_ramp(file, BLOCK_OFFSETS, step->count, 1);
    write_vectors(file, BLOCK_VELOCITY, step->count, step->velocity);
    write_numbers(file, BLOCK_DENSITY, step->count, step->density);
    write_numbers(file, BLOCK_PRESSURE, step->count, step->pressure);
    write_numbers(file, BLOCK_FLUID, step->count, step->fluid);
    write_numbers(file, BLOCK_ID, step->count, step->id);
    fputs("\n</AppendedData>\n</VTKFile>\n", file);
    return !ferror(file);
}

/* ---- the index ---- */

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void vtp_series_name(const char *folder, size_t index, char *name, size_t size)
{
    snprintf(name, size, "%s-%04zu.vtp", last_part(folder), index);
}

/* Within the quotes of an attribute. */
static void print_escaped(FILE *file, const char *text)
{
    for (; *text; text++)
        if (strchr("&<>\"", *text))
            fprintf(file, "&#%d;", *text);
        else
            fputc(*text, file);
}

bool vtp_write_index(FILE *file, const char *folder, size_t count, const double times[])
{
    char name[1088];
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
          file);
    for (size_t i = 0; i < count; i++) {
        vtp_series_name(folder, i, name, sizeof name);
        fprintf(file, "<DataSet timestep=\"%.17g\" group=\"\" part=\"0\" file=\"", times[i]);
        print_escaped(file, last_part(folder));
        fputc('/', file);
        print_escaped(file, name);
        fputs("\"/>\n", file);
    }
    fputs("</Collection>\n</VTKFile>\n", file);
    return !ferror(file);
}
