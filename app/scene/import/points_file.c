/* Points with normals from a PLY file: G. Turk, "The PLY polygon file format", 1994. Of the element vertex
   the properties x, y, z, nx, ny, nz are read, in ASCII or binary; elements behind it are left out. */
#include "app/scene/import/import.h"

#include "app/base/file.h"
#include "sim/points/scattered.h"

#include <assert.h>
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PROPERTIES = 64, WANTED = 6, PLY_MIB_MAX = 1024 };

typedef enum PlyFormat { PLY_ASCII, PLY_LITTLE, PLY_BIG } PlyFormat;

static const struct {
    const char *name, *other;
    size_t bytes;
    bool whole, negative;
} types[] = {
    {"char", "int8", 1, true, true},      {"uchar", "uint8", 1, true, false},
    {"short", "int16", 2, true, true},    {"ushort", "uint16", 2, true, false},
    {"int", "int32", 4, true, true},      {"uint", "uint32", 4, true, false},
    {"float", "float32", 4, false, true}, {"double", "float64", 8, false, true},
};
enum { TYPES = sizeof types / sizeof *types };

typedef struct Ply {
    const char *path, *at, *end;
    int line;
    PlyFormat format;
    size_t count; /* of vertices */
    int properties, type[PROPERTIES];
    int wanted[PROPERTIES]; /* 0 to 5: x y z nx ny nz; -1: another property */
    Error *error;
} Ply;

static bool fail(const Ply *ply, const char *what)
{
    return error_set(ply->error, "%s:%d: %s", ply->path, ply->line, what);
}

/* Takes a line of the header. */
static bool take_line(Ply *ply, char line[256])
{
    const char *end = memchr(ply->at, '\n', (size_t)(ply->end - ply->at));
    ply->line++;
    if (!end || end - ply->at >= 256)
        return fail(ply, "the header of a PLY file does not end here; it ends with the line end_header");
    const size_t length = (size_t)(end - ply->at);
    memcpy(line, ply->at, length);
    line[length] = '\0';
    for (size_t k = length; k > 0 && isspace((unsigned char)line[k - 1]); k--)
        line[k - 1] = '\0';
    ply->at = end + 1;
    return true;
}

static bool take_property(Ply *ply, const char *line)
{
    static const char *const names[WANTED] = {"x", "y", "z", "nx", "ny", "nz"};
    char type[32], name[64];
    if (sscanf(line, "property %31s %63s", type, name) != 2 || ply->properties == PROPERTIES)
        return fail(ply, "a property of the points is 'property TYPE NAME', and there are at most 64");
    int known = 0;
    while (known < TYPES && strcmp(type, types[known].name) != 0 && strcmp(type, types[known].other) != 0)
        known++;
    if (known == TYPES)
        return fail(
            ply,
            "the type of a point's property must be char, uchar, short, ushort, int, uint, float or double");
    const int at = ply->properties++;
    ply->type[at] = known;
    ply->wanted[at] = -1;
    for (int k = 0; k < WANTED; k++)
        if (strcmp(name, names[k]) == 0)
            ply->wanted[at] = k;
    return true;
}

static bool take_format(Ply *ply, const char *line)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char name[64] = "";
    (void)sscanf(line, "format %63s", name);
    for (int k = 0; k < 3; k++)
        if (strcmp(name, names[k]) == 0) {
            ply->format = (PlyFormat)k;
            return true;
        }
    return fail(ply, "the format must be ascii, binary_little_endian or binary_big_endian");
}

/* True for a line of the header with such a begin. */
static bool begins(const char *line, const char *with)
{
    return strncmp(line, with, strlen(with)) == 0;
}

/* Reads the header up to its end; the points must be the first element. */
static bool take_header(Ply *ply)
{
    char line[256];
    int elements = 0;
    if (!take_line(ply, line) || strcmp(line, "ply") != 0)
        return fail(ply, "this is no PLY file; the first line of one is 'ply'");
    for (;;) {
        if (!take_line(ply, line))
            return false;
        if (strcmp(line, "end_header") == 0)
            break;
        if (begins(line, "format ") && !take_format(ply, line))
            return false;
        if (begins(line, "element ") && elements++ == 0 &&
            sscanf(line, "element vertex %zu", &ply->count) != 1)
            return fail(ply, "the first element must be the points, 'element vertex NUMBER'");
        if (begins(line, "property ") && elements == 1 && !take_property(ply, line))
            return false;
    }
    unsigned have = 0;
    for (int k = 0; k < ply->properties; k++)
        have |= ply->wanted[k] >= 0 ? 1U << ply->wanted[k] : 0;
    return have == 63 || fail(ply, "points with normals have the properties x, y, z, nx, ny and nz");
}

static bool take_word(Ply *ply, double *value)
{
    while (ply->at < ply->end && isspace((unsigned char)*ply->at))
        ply->line += *ply->at++ == '\n';
    char word[64], *end;
    size_t length = 0;
    while (ply->at < ply->end && !isspace((unsigned char)*ply->at) && length < sizeof word - 1)
        word[length++] = *ply->at++;
    word[length] = '\0';
    *value = strtod(word, &end);
    return (length > 0 && *end == '\0') || fail(ply, "a number of a point is missing here");
}

static bool take_bytes(Ply *ply, int type, double *value)
{
    const size_t bytes = types[type].bytes;
    uint64_t bits = 0;
    assert(bytes > 0);
    if ((size_t)(ply->end - ply->at) < bytes)
        return fail(ply, "the file ends before its points do");
    for (size_t k = 0; k < bytes; k++)
        bits |= (uint64_t)(unsigned char)ply->at[k] << 8 * (ply->format == PLY_BIG ? bytes - 1 - k : k);
    ply->at += bytes;
    if (types[type].whole) {
        const bool below = types[type].negative && bits >> (8 * bytes - 1);
        *value = below ? -(double)((bytes == 8 ? 0 : UINT64_C(1) << 8 * bytes) - bits) : (double)bits;
    } else if (bytes == 4) {
        const uint32_t half = (uint32_t)bits;
        float single;
        memcpy(&single, &half, sizeof single);
        *value = (double)single;
    } else
        memcpy(value, &bits, sizeof *value);
    return true;
}

static bool take_point(Ply *ply, float place[3], float normal[3])
{
    for (int k = 0; k < ply->properties; k++) {
        double value = 0;
        if (!(ply->format == PLY_ASCII ? take_word(ply, &value) : take_bytes(ply, ply->type[k], &value)))
            return false;
        if (ply->wanted[k] >= 0)
            (ply->wanted[k] < 3 ? place : normal)[ply->wanted[k] % 3] = (float)value;
    }
    return true;
}

bool points_parse(const char *path, const char *bytes, size_t size, PointsFile *out, Error *error)
{
    Ply ply = {.path = path, .at = bytes, .end = bytes + size, .error = error};
    *out = (PointsFile){0};
    if (!take_header(&ply))
        return false;
    if (ply.count > (size_t)(ply.end - ply.at)) /* a point takes at least a byte */
        return fail(&ply, "the file ends before its points do");
    ply.line += ply.format == PLY_ASCII;
    out->place = calloc(ply.count + 1, sizeof *out->place);
    out->normal = calloc(ply.count + 1, sizeof *out->normal);
    bool ok = out->place && out->normal;
    if (!ok)
        error_set(error, "%s: no memory for %zu points", path, ply.count);
    for (size_t i = 0; ok && i < ply.count; i++)
        ok = take_point(&ply, out->place[i], out->normal[i]);
    out->count = ply.count;
    if (!ok)
        points_free(out);
    return ok;
}

void points_free(PointsFile *points)
{
    free(points->place);
    free(points->normal);
    *points = (PointsFile){0};
}

bool points_file_is(const char *path)
{
    const size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".ply") == 0;
}

bool points_file_load(const char *path, VolumeData *volume, float **values, Error *error)
{
    size_t size;
    PointsFile points = {0};
    Error why;
    *values = NULL;
    char *bytes = read_file(path, (size_t)PLY_MIB_MAX << 20, "PLY file of points", &size, error);
    const bool parsed = bytes && points_parse(path, bytes, size, &points, error);
    free(bytes);
    if (!parsed)
        return false;
    const ScatteredPoints scattered = {points.count, (const float(*)[3])points.place,
                                       (const float(*)[3])points.normal};
    const bool made = scattered_volume(&scattered, volume, values, &why);
    points_free(&points);
    return made || error_set(error, "%.300s: %s", path, why.message);
}
