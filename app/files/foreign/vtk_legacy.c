/* The points of VTK's old files .vtk, as text or binary. After: "VTK legacy file formats",
   https://docs.vtk.org. */
#include "app/files/foreign/foreign.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { LINE_SIZE = 256 };

typedef struct Legacy {
    const ForeignBytes *file;
    const char *at, *end;
    bool binary;
    ForeignTable *table;
    bool has_points, of_points; /* the points were read; the present data are of points */
    size_t count;               /* values of the present data */
    Error *error;
} Legacy;

static bool fail(const Legacy *legacy, const char *what, const char *word)
{
    int line = 1;
    if (legacy->binary)
        return error_set(legacy->error, "%.300s: %s%.40s", legacy->file->path, what, word);
    for (const char *c = legacy->file->bytes; c < legacy->at; c++)
        line += *c == '\n';
    return error_set(legacy->error, "%.300s:%d: %s%.40s", legacy->file->path, line, what, word);
}

/* The next line with words; false at the end. */
static bool take_line(Legacy *legacy, char line[LINE_SIZE])
{
    while (legacy->at < legacy->end) {
        const char *newline = memchr(legacy->at, '\n', (size_t)(legacy->end - legacy->at));
        const char *end = newline ? newline : legacy->end, *begin = legacy->at;
        size_t length = (size_t)(end - begin) < LINE_SIZE - 1 ? (size_t)(end - begin) : LINE_SIZE - 1;
        legacy->at = newline ? newline + 1 : legacy->end;
        memcpy(line, begin, length);
        line[length] = '\0';
        while (length > 0 && (line[length - 1] == ' ' || line[length - 1] == '\r'))
            line[--length] = '\0';
        if (length > 0)
            return true;
    }
    return false;
}

static int type_of(const char *name)
{
    static const struct {
        const char *name;
        ForeignType type;
    } types[] = {
        {"char", FOREIGN_I8},          {"unsigned_char", FOREIGN_U8},
        {"short", FOREIGN_I16},        {"unsigned_short", FOREIGN_U16},
        {"int", FOREIGN_I32},          {"unsigned_int", FOREIGN_U32},
        {"long", FOREIGN_I64},         {"unsigned_long", FOREIGN_U64},
        {"vtktypeint64", FOREIGN_I64}, {"vtktypeuint64", FOREIGN_U64},
        {"vtkIdType", FOREIGN_I32},    {"float", FOREIGN_F32},
        {"double", FOREIGN_F64},
    };
    for (size_t k = 0; k < sizeof types / sizeof *types; k++)
        if (strcasecmp(name, types[k].name) == 0)
            return types[k].type;
    return -1;
}

/* Reads `count` numbers; `to` NULL: over them. */
static bool take_numbers(Legacy *legacy, const char *type_name, double count, double *to)
{
    const int type = type_of(type_name);
    if (type < 0)
        return fail(legacy, "has numbers of an unknown type: ", type_name);
    const size_t bytes = foreign_type_bytes((ForeignType)type);
    if (!(count >= 0 && count <= (double)(legacy->end - legacy->at) / (legacy->binary ? (double)bytes : 1)))
        return fail(legacy, "ends before its numbers do", "");
    if (legacy->binary) {
        if (to)
            foreign_convert(legacy->at, (ForeignType)type, true, (size_t)count, to);
        legacy->at += (size_t)count * bytes;
        return true;
    }
    for (size_t i = 0; i < (size_t)count; i++) {
        double number;
        while (legacy->at < legacy->end && strchr(" \n\t\r", *legacy->at) && *legacy->at)
            legacy->at++;
        if (!foreign_number(&legacy->at, legacy->end, &number))
            return fail(legacy, "a number is missing here", "");
        if (to)
            to[i] = number;
    }
    return true;
}

/* An array of the present data; a column if the data are of points. */
static bool take_array(Legacy *legacy, const char *name, double components, const char *type)
{
    double *to = NULL;
    if (!(components >= 1 && components <= 1e9))
        return fail(legacy, "an array without components: ", name);
    if (legacy->of_points && components <= 9) {
        const ForeignColumn *column =
            foreign_column_add(legacy->table, legacy->file->path, name, (int)components, legacy->error);
        if (!column)
            return false;
        to = column->value;
    }
    return take_numbers(legacy, type, components * (double)legacy->count, to);
}

static bool take_points(Legacy *legacy, const char *line)
{
    char type[32];
    double count;
    if (sscanf(line, "%*s %lf %31s", &count, type) != 2 || legacy->has_points)
        return fail(legacy, "points are said once, as 'POINTS NUMBER TYPE', not as ", line);
    if (!(count >= 0 && count <= (double)(legacy->end - legacy->at)))
        return fail(legacy, "ends before its points do", "");
    legacy->has_points = true;
    legacy->table->count = legacy->count = (size_t)count;
    legacy->of_points = true;
    const bool taken = take_array(legacy, "Points", 3, type);
    legacy->of_points = false;
    return taken;
}

/* "VERTICES n size", and lists like it; since version 5.1 two arrays. */
static bool take_cells(Legacy *legacy, const char *line)
{
    double count, size;
    char next[LINE_SIZE], type[32];
    if (sscanf(line, "%*s %lf %lf", &count, &size) != 2)
        return fail(legacy, "cells are 'KIND NUMBER SIZE', not ", line);
    const char *before = legacy->at;
    if (take_line(legacy, next) && sscanf(next, "OFFSETS %31s", type) == 1)
        return take_numbers(legacy, type, count, NULL) && take_line(legacy, next) &&
               sscanf(next, "CONNECTIVITY %31s", type) == 1 && take_numbers(legacy, type, size, NULL);
    legacy->at = before;
    return take_numbers(legacy, "int", size, NULL);
}

static bool take_field(Legacy *legacy, const char *line)
{
    char next[LINE_SIZE], name[128], type[32];
    long arrays;
    double components, tuples;
    if (sscanf(line, "%*s %*s %ld", &arrays) != 1)
        return fail(legacy, "a field is 'FIELD NAME ARRAYS', not ", line);
    while (arrays > 0) {
        if (!take_line(legacy, next) ||
            sscanf(next, "%127s %lf %lf %31s", name, &components, &tuples, type) != 4) {
            if (strcmp(next, "METADATA") != 0)
                return fail(legacy, "an array is 'NAME COMPONENTS TUPLES TYPE', not ", next);
            while (legacy->at < legacy->end && *legacy->at != '\n' && take_line(legacy, next))
                ;
            continue;
        }
        arrays--;
        double time = NAN;
        if (legacy->of_points && tuples == (double)legacy->count) {
            if (!take_array(legacy, name, components, type))
                return false;
        } else if (!take_numbers(legacy, type, components * tuples, components * tuples == 1 ? &time : NULL))
            return false;
        if (isfinite(time) && (strncasecmp(name, "time", 4) == 0))
            legacy->table->time = time;
    }
    return true;
}

static bool take_scalars(Legacy *legacy, const char *line)
{
    char name[128], type[32], next[LINE_SIZE];
    double components = 1;
    if (sscanf(line, "%*s %127s %31s %lf", name, type, &components) < 2)
        return fail(legacy, "scalars are 'SCALARS NAME TYPE', not ", line);
    const char *before = legacy->at;
    if (!take_line(legacy, next) || strncasecmp(next, "LOOKUP_TABLE", 12) != 0)
        legacy->at = before;
    return take_array(legacy, name, components, type);
}

static bool take_named(Legacy *legacy, const char *line, double components)
{
    char name[128], type[32];
    return sscanf(line, "%*s %127s %31s", name, type) == 2
               ? take_array(legacy, name, components, type)
               : fail(legacy, "a name and a type are missing: ", line);
}

static bool begin_data(Legacy *legacy, const char *line, bool of_points)
{
    double count;
    if (sscanf(line, "%*s %lf", &count) != 1 || !(count >= 0 && count < 1e15))
        return fail(legacy, "data are 'POINT_DATA NUMBER', not ", line);
    legacy->count = (size_t)count;
    legacy->of_points = of_points;
    return !of_points || legacy->count == legacy->table->count ||
           fail(legacy, "has another count of data than of points: ", line);
}

static bool over_colors(Legacy *legacy, const char *line, bool table)
{
    double count;
    if (sscanf(line, "%*s %*s %lf", &count) != 1)
        return fail(legacy, "a count is missing: ", line);
    return take_numbers(legacy, legacy->binary ? "unsigned_char" : "float",
                        count * (table ? 4 : (double)legacy->count), NULL);
}

static bool take_part(Legacy *legacy, const char *line)
{
    static const char *const cells[] = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS", NULL};
    char word[64] = "", next[LINE_SIZE];
    double count;
    (void)sscanf(line, "%63s", word);
    for (int k = 0; cells[k]; k++)
        if (strcasecmp(word, cells[k]) == 0)
            return take_cells(legacy, line);
    if (strcasecmp(word, "POINTS") == 0)
        return take_points(legacy, line);
    if (strcasecmp(word, "FIELD") == 0)
        return take_field(legacy, line);
    if (strcasecmp(word, "POINT_DATA") == 0 || strcasecmp(word, "CELL_DATA") == 0)
        return begin_data(legacy, line, strcasecmp(word, "POINT_DATA") == 0);
    if (strcasecmp(word, "SCALARS") == 0)
        return take_scalars(legacy, line);
    if (strcasecmp(word, "VECTORS") == 0 || strcasecmp(word, "NORMALS") == 0)
        return take_named(legacy, line, 3);
    if (strcasecmp(word, "GLOBAL_IDS") == 0 || strcasecmp(word, "PEDIGREE_IDS") == 0)
        return take_named(legacy, line, 1);
    if (strcasecmp(word, "TENSORS") == 0)
        return take_named(legacy, line, 9);
    if (strcasecmp(word, "COLOR_SCALARS") == 0 || strcasecmp(word, "LOOKUP_TABLE") == 0)
        return over_colors(legacy, line, strcasecmp(word, "LOOKUP_TABLE") == 0);
    if (strcasecmp(word, "CELL_TYPES") == 0)
        return sscanf(line, "%*s %lf", &count) == 1 && take_numbers(legacy, "int", count, NULL);
    if (strcasecmp(word, "METADATA") == 0) {
        while (legacy->at < legacy->end && *legacy->at != '\n' && take_line(legacy, next))
            ;
        return true;
    }
    return fail(legacy, "a part of an unknown kind: ", line);
}

static bool take_head(Legacy *legacy)
{
    char line[LINE_SIZE], word[64] = "";
    if (!take_line(legacy, line) || strncasecmp(line, "# vtk DataFile", 14) != 0)
        return fail(legacy, "is no file of VTK; the first line of one is '# vtk DataFile Version 3.0'", "");
    const char *newline =
        memchr(legacy->at, '\n', (size_t)(legacy->end - legacy->at)); /* the title may be empty */
    legacy->at = newline ? newline + 1 : legacy->end;
    if (!take_line(legacy, line) || (strcasecmp(line, "ASCII") != 0 && strcasecmp(line, "BINARY") != 0))
        return fail(legacy, "the third line must be ASCII or BINARY", "");
    const bool binary = strcasecmp(line, "BINARY") == 0;
    if (!take_line(legacy, line) || sscanf(line, "DATASET %63s", word) != 1 ||
        (strcasecmp(word, "POLYDATA") != 0 && strcasecmp(word, "UNSTRUCTURED_GRID") != 0))
        return fail(legacy, "has no points of particles; the DATASET must be POLYDATA or UNSTRUCTURED_GRID",
                    "");
    legacy->binary = binary;
    return true;
}

static bool parse(const ForeignBytes *file, ForeignTable *table, Error *error)
{
    Legacy legacy = {
        .file = file, .at = file->bytes, .end = file->bytes + file->size, .table = table, .error = error};
    char line[LINE_SIZE];
    table->time = NAN;
    if (!take_head(&legacy))
        return false;
    while (!(table->head_only && legacy.has_points) && take_line(&legacy, line))
        if (!take_part(&legacy, line))
            return error && error->message[0] ? false : fail(&legacy, "is damaged at the line ", line);
    return legacy.has_points || fail(&legacy, "has no POINTS", "");
}

static const char *const endings[] = {".vtk", NULL};

const ForeignFormat foreign_vtk_legacy = {.name = "VTK (old)", .endings = endings, .parse = parse};
