/* The head and the values of a PLY file: G. Turk, "The PLY polygon file format", 1994. */
#include "app/scene/import/import.h"

#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *other;
    size_t bytes;
    bool whole, negative;
} types[] = {
    {"char", "int8", 1, true, true},      {"uchar", "uint8", 1, true, false},
    {"short", "int16", 2, true, true},    {"ushort", "uint16", 2, true, false},
    {"int", "int32", 4, true, true},      {"uint", "uint32", 4, true, false},
    {"float", "float32", 4, false, true}, {"double", "float64", 8, false, true},
    {"long", "int64", 8, true, true},     {"ulong", "uint64", 8, true, false}, /* not of Turk; of meshio */
};
enum { TYPES = sizeof types / sizeof *types };

bool ply_fail(const Ply *ply, const char *what)
{
    return error_set(ply->error, "%s:%d: %s", ply->path, ply->line, what);
}

/* Takes a line of the header. */
static bool take_line(Ply *ply, char line[256])
{
    const char *end = memchr(ply->at, '\n', (size_t)(ply->end - ply->at));
    ply->line++;
    if (!end || end - ply->at >= 256)
        return ply_fail(ply, "the header of a PLY file does not end here; it ends with the line end_header");
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
    char type[32], name[64];
    if (sscanf(line, "property %31s %63s", type, name) != 2 || ply->properties == PLY_PROPERTIES_MAX)
        return ply_fail(ply, "a property of the points is 'property TYPE NAME', and there are at most 64");
    int known = 0;
    while (known < TYPES && strcmp(type, types[known].name) != 0 && strcmp(type, types[known].other) != 0)
        known++;
    if (known == TYPES)
        return ply_fail(
            ply,
            "the type of a point's property must be char, uchar, short, ushort, int, uint, float or double");
    ply->type[ply->properties] = known;
    snprintf(ply->name[ply->properties++], sizeof ply->name[0], "%s", name);
    return true;
}

static bool take_format(Ply *ply, const char *line)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char name[64] = "";
    (void)sscanf(line, "format %63s", name);
    for (int k = 0; k < 3; k++)
        if (strcmp(name, names[k]) == 0) {
            ply->format = k;
            return true;
        }
    return ply_fail(ply, "the format must be ascii, binary_little_endian or binary_big_endian");
}

/* True for a line of the header with such a begin. */
static bool begins(const char *line, const char *with)
{
    return strncmp(line, with, strlen(with)) == 0;
}

/* "comment ... time 0.5 s ..." */
static void take_time(Ply *ply, const char *line)
{
    const char *word = strstr(line, " time ");
    double time;
    if (word && sscanf(word, " time %lf", &time) == 1 && isfinite(time))
        ply->time = time;
}

/* Reads the header up to its end; the points must be the first element. */
static bool take_header(Ply *ply)
{
    char line[256];
    int elements = 0;
    if (!take_line(ply, line) || strcmp(line, "ply") != 0)
        return ply_fail(ply, "this is no PLY file; the first line of one is 'ply'");
    for (;;) {
        if (!take_line(ply, line))
            return false;
        if (strcmp(line, "end_header") == 0)
            break;
        if (begins(line, "comment "))
            take_time(ply, line);
        if (begins(line, "format ") && !take_format(ply, line))
            return false;
        if (begins(line, "element ") && elements++ == 0 &&
            sscanf(line, "element vertex %zu", &ply->count) != 1)
            return ply_fail(ply, "the first element must be the points, 'element vertex NUMBER'");
        if (begins(line, "property ") && elements == 1 && !take_property(ply, line))
            return false;
    }
    if (ply->count > (size_t)(ply->end - ply->at)) /* a point takes at least a byte */
        return ply_fail(ply, "the file ends before its points do");
    ply->at -= ply->format == PLY_ASCII; /* the end of this line counts with the first number */
    return true;
}

bool ply_begin(Ply *ply, const char *path, const char *bytes, size_t size, Error *error)
{
    *ply = (Ply){.path = path, .at = bytes, .end = bytes + size, .time = NAN, .error = error};
    return take_header(ply);
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
    return (length > 0 && *end == '\0') || ply_fail(ply, "a number of a point is missing here");
}

static bool take_bytes(Ply *ply, int type, double *value)
{
    const size_t bytes = types[type].bytes;
    uint64_t bits = 0;
    assert(bytes > 0);
    if ((size_t)(ply->end - ply->at) < bytes)
        return ply_fail(ply, "the file ends before its points do");
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

bool ply_row(Ply *ply, double value[PLY_PROPERTIES_MAX])
{
    for (int k = 0; k < ply->properties; k++)
        if (!(ply->format == PLY_ASCII ? take_word(ply, &value[k])
                                       : take_bytes(ply, ply->type[k], &value[k])))
            return false;
    return true;
}
