#define _GNU_SOURCE /* memmem */
#include "app/mesh_file/mesh_count.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

MeshFormat mesh_format(const char *path)
{
    static const char *const ending[] = {[MESH_OBJ] = ".obj",
                                         [MESH_PLY] = ".ply",
                                         [MESH_STL] = ".stl",
                                         [MESH_GLTF] = ".gltf",
                                         [MESH_GLB] = ".glb"};
    const char *dot = strrchr(path, '.');
    int format = MESH_OBJ;
    while (dot && format < MESH_UNKNOWN && strcasecmp(dot, ending[format]) != 0)
        format++;
    return dot ? (MeshFormat)format : MESH_UNKNOWN;
}

/* Next line, without the line end; NULL after the last line. */
static const char *next_line(const char **at, const char *end, size_t *length)
{
    const char *line = *at;
    if (line >= end)
        return NULL;
    const char *newline = memchr(line, '\n', (size_t)(end - line));
    *length = (size_t)((newline ? newline : end) - line);
    *at = newline ? newline + 1 : end;
    return line;
}

static size_t blanks(const char *line, size_t length)
{
    size_t n = 0;
    while (n < length && (line[n] == ' ' || line[n] == '\t' || line[n] == '\r'))
        n++;
    return n;
}

static int words(const char *line, size_t length)
{
    int count = 0;
    for (size_t at = blanks(line, length); at < length; at += blanks(line + at, length - at)) {
        while (at < length && line[at] != ' ' && line[at] != '\t' && line[at] != '\r')
            at++;
        count++;
    }
    return count;
}

/* "f 1 2 3 4": two triangles. */
static double count_obj(const char *bytes, size_t size)
{
    const char *at = bytes, *line;
    size_t length;
    double count = 0;
    while ((line = next_line(&at, bytes + size, &length)))
        if (length > 1 && line[0] == 'f' && (line[1] == ' ' || line[1] == '\t')) {
            const int corners = words(line, length) - 1;
            count += corners > 2 ? corners - 2 : 0;
        }
    return count;
}

/* "element face 12" */
static double count_ply(const char *bytes, size_t size)
{
    static const char face[] = "element face ", end[] = "end_header";
    const char *at = bytes, *line;
    size_t length;
    while ((line = next_line(&at, bytes + size, &length))) {
        char number[32] = "";
        if (length >= sizeof end - 1 && memcmp(line, end, sizeof end - 1) == 0)
            break;
        if (length <= sizeof face || memcmp(line, face, sizeof face - 1) != 0)
            continue;
        length -= sizeof face - 1;
        memcpy(number, line + sizeof face - 1, length < sizeof number ? length : sizeof number - 1);
        const double count = strtod(number, NULL);
        return count > 0 && count < 1e18 ? count : 0;
    }
    return 0;
}

static uint32_t stl_says(const char *bytes)
{
    uint32_t said = 0;
    for (int k = 3; k >= 0; k--)
        said = said << 8 | (uint8_t)bytes[80 + k];
    return said;
}

/* 80 bytes, the count, 50 bytes for each triangle. */
bool mesh_is_binary_stl(const char *bytes, size_t size, size_t whole)
{
    return size >= 84 && whole == 84 + 50 * (size_t)stl_says(bytes);
}

/* A text has a line "facet normal ..." for each triangle. */
static double count_stl(const char *bytes, size_t size, size_t whole)
{
    const char *at = bytes, *line;
    size_t length;
    double count = 0;
    if (mesh_is_binary_stl(bytes, size, whole))
        return stl_says(bytes);
    while ((line = next_line(&at, bytes + size, &length))) {
        const size_t skip = blanks(line, length);
        count += length - skip > 6 && memcmp(line + skip, "facet ", 6) == 0;
    }
    return count;
}

double mesh_count(MeshFormat format, const char *bytes, size_t size, size_t whole)
{
    switch (format) {
    case MESH_OBJ:
        return count_obj(bytes, size);
    case MESH_PLY:
        return count_ply(bytes, size);
    case MESH_STL:
        return count_stl(bytes, size, whole);
    default:
        return 0;
    }
}

bool mesh_has_head(MeshFormat format, const char *bytes, size_t size)
{
    static const char line[] = "end_header";
    const size_t length = sizeof line - 1;
    const char *end = bytes + size, *at = bytes;
    if (format != MESH_PLY)
        return true;
    while ((at = memmem(at, (size_t)(end - at), line, length))) {
        const char *behind = at + length;
        if (at > bytes && (at[-1] == '\n' || at[-1] == '\r') && behind < end &&
            (*behind == '\n' || *behind == '\r'))
            return true;
        at = behind;
    }
    return false;
}
