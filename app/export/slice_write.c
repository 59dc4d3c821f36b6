/* After: VTK file formats, "XML file formats", https://docs.vtk.org: ImageData, numbers as base64 with
   64-bit sizes (for the reason see app/export/vtp.c). */
#include "app/export/slice_table.h"

#include "app/export/base64.h"

#include <inttypes.h>
#include <math.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "files are written as numbers lie in memory");

static size_t count_of(const SliceTable *table)
{
    return (size_t)table->wanted.samples[0] * (size_t)table->wanted.samples[1];
}

bool slice_table_csv(FILE *file, const SliceTable *table)
{
    const int *samples = table->wanted.samples;
    bool written = fputs("x,y,z,value\n", file) >= 0;
    for (int row = 0; row < samples[1]; row++)
        for (int column = 0; column < samples[0] && written; column++) {
            const size_t i = (size_t)row * (size_t)samples[0] + (size_t)column;
            double at[3];
            plane_sample(&table->plane, samples, column, row, at);
            written = fprintf(file, "%.9g,%.9g,%.9g,", at[0], at[1], at[2]) > 0 &&
                      (table->field[i] > 0 ? fprintf(file, "%.9g\n", (double)table->value[i])
                                           : fprintf(file, "\n")) > 0;
        }
    return written && fflush(file) == 0;
}

/* A sample is a point of VTK's image; the axes are the columns of Direction. */
static bool write_head(FILE *file, const SliceTable *table)
{
    const Plane *plane = &table->plane;
    const ScalarRow *scalar = &scalar_list[table->wanted.scalar];
    const int *samples = table->wanted.samples;
    double corner[3];
    plane_sample(plane, samples, 0, 0, corner);
    fprintf(
        file,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n");
    fprintf(file, "<ImageData WholeExtent=\"0 %d 0 %d 0 0\" Origin=\"%.17g %.17g %.17g\"", samples[0] - 1,
            samples[1] - 1, corner[0], corner[1], corner[2]);
    fprintf(file, " Spacing=\"%.17g %.17g 1\" Direction=\"", plane->size[0] / samples[0],
            plane->size[1] / samples[1]);
    for (int k = 0; k < 3; k++)
        fprintf(file, "%.17g %.17g %.17g%s", plane->along[k], plane->up[k], plane->normal[k],
                k < 2 ? " " : "\">\n");
    fprintf(file,
            "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">%.17g</DataArray></FieldData>\n",
            table->time);
    return fprintf(file, "<Piece Extent=\"0 %d 0 %d 0 0\">\n<PointData Scalars=\"%s\">\n", samples[0] - 1,
                   samples[1] - 1, scalar->name) > 0;
}

static bool write_array(FILE *file, const char *name, const float *numbers, size_t count)
{
    const uint64_t bytes = count * sizeof *numbers;
    Base64 text = {.file = file};
    fprintf(file, "<DataArray type=\"Float32\" Name=\"%s\" format=\"binary\">\n", name);
    base64_add(&text, &bytes, sizeof bytes);
    base64_add(&text, numbers, bytes);
    base64_end(&text);
    return fputs("\n</DataArray>\n", file) >= 0 && !ferror(file);
}

bool slice_table_vti(FILE *file, const SliceTable *table)
{
    return write_head(file, table) &&
           write_array(file, scalar_list[table->wanted.scalar].name, table->value, count_of(table)) &&
           write_array(file, "field", table->field, count_of(table)) &&
           fputs("</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n", file) >= 0 && fflush(file) == 0;
}
