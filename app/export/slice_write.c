/* After: VTK file formats, "XML file formats", https://docs.vtk.org: ImageData, raw appended data with 64-bit
   sizes. */
#include "app/export/slice_table.h"

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

/* A sample is a point of VTK's image; its axes are the columns of Direction. */
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
    fprintf(file,
            "<Piece Extent=\"0 %d 0 %d 0 0\">\n<PointData Scalars=\"%s\">\n"
            "<DataArray type=\"Float32\" Name=\"%s\" format=\"appended\" offset=\"0\"/>\n"
            "<DataArray type=\"Float32\" Name=\"field\" format=\"appended\" offset=\"%zu\"/>\n",
            samples[0] - 1, samples[1] - 1, scalar->name, scalar->name,
            sizeof(uint64_t) + count_of(table) * sizeof(float));
    return fprintf(file, "</PointData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_") > 0;
}

static bool write_numbers(FILE *file, const float *numbers, size_t count)
{
    const uint64_t bytes = count * sizeof *numbers;
    return fwrite(&bytes, sizeof bytes, 1, file) == 1 &&
           fwrite(numbers, sizeof *numbers, count, file) == count;
}

bool slice_table_vti(FILE *file, const SliceTable *table)
{
    return write_head(file, table) && write_numbers(file, table->value, count_of(table)) &&
           write_numbers(file, table->field, count_of(table)) &&
           fprintf(file, "\n</AppendedData>\n</VTKFile>\n") > 0 && fflush(file) == 0;
}
