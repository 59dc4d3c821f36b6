#define _GNU_SOURCE /* memmem */
#include "app/scene/import/import.h"
#include "app/scene/import/import_private.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
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

enum { WORDS_MOST = 64, DIGITS_MOST = 64 };

typedef struct Word {
    const char *at;
    size_t length;
} Word;

/* ---- lines ---- */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Splits a line into words, WORDS_MOST at most. */
static int words_of(const char *line, const char *end, Word word[WORDS_MOST])
{
    int count = 0;
    while (line < end && count < WORDS_MOST) {
        while (line < end && is_blank(*line))
            line++;
        if (line == end)
            break;
        word[count].at = line;
        while (line < end && !is_blank(*line))
            line++;
        word[count].length = (size_t)(line - word[count].at);
        count++;
    }
    return count;
}

static bool is(const Word *word, const char *text)
{
    return word->length == strlen(text) && memcmp(word->at, text, word->length) == 0;
}

/* Accepts a decimal comma, as assimp does. */
static bool number(const Word *word, double *value)
{
    char digits[DIGITS_MOST] = "", *end;
    if (word->length >= sizeof digits)
        return false;
    memcpy(digits, word->at, word->length);
    for (size_t i = 0; i < word->length; i++)
        if (digits[i] == ',')
            digits[i] = '.';
    *value = strtod(digits, &end);
    return end == digits + word->length && end > digits;
}

static const char *line_end(const char *at, const char *end)
{
    const char *newline = memchr(at, '\n', (size_t)(end - at));
    return newline ? newline : end;
}

/* ---- texts ---- */

/* Word indices of the three coordinates of a position. */
typedef struct PlyColumns {
    int of[3];
    double times; /* factor of the shift */
} PlyColumns;

static bool write_moved(FILE *to, const char *line, const char *end, const Word *word,
                        const PlyColumns *columns, const double by[3])
{
    char moved[3][32];
    for (int k = 0; k < 3; k++) {
        double value;
        if (!number(&word[columns->of[k]], &value))
            return false;
        snprintf(moved[k], sizeof moved[k], "%.9g", value - columns->times * by[k]);
    }
    for (int left = 3; left > 0; left--) {
        int next = -1;
        for (int k = 0; k < 3; k++)
            if (word[columns->of[k]].at >= line && (next < 0 || columns->of[k] < columns->of[next]))
                next = k;
        const Word *old = &word[columns->of[next]];
        fwrite(line, 1, (size_t)(old->at - line), to);
        fputs(moved[next], to);
        line = old->at + old->length;
    }
    fwrite(line, 1, (size_t)(end - line), to);
    return true;
}

/* True if the line is a vertex; sets the columns. A fourth number of an OBJ divides the first three. */
static bool place_in_obj(const char *line, const Word *word, int count, PlyColumns *columns)
{
    double w;
    if (count < 4 || !is(&word[0], "v") || *line != 'v')
        return false;
    *columns = (PlyColumns){{1, 2, 3}, count == 5 && number(&word[4], &w) ? w : 1};
    return true;
}

static bool place_in_stl(const Word *word, int count, PlyColumns *columns)
{
    *columns = (PlyColumns){{1, 2, 3}, 1};
    return count == 4 && is(&word[0], "vertex");
}

static bool move_lines(FILE *to, MeshFormat format, const char *at, const char *end, const double by[3])
{
    Word word[WORDS_MOST];
    PlyColumns columns;
    while (at < end) {
        const char *behind = line_end(at, end);
        const int count = words_of(at, behind, word);
        const bool place = format == MESH_OBJ ? place_in_obj(at, word, count, &columns)
                                              : place_in_stl(word, count, &columns);
        if (!place)
            fwrite(at, 1, (size_t)(behind - at), to);
        else if (!write_moved(to, at, behind, word, &columns, by))
            return false;
        if (behind < end)
            fputc('\n', to);
        at = behind + (behind < end);
    }
    return true;
}

/* ---- PLY ---- */

typedef enum Coding { TEXT, LITTLE, BIG, UNKNOWN } Coding;

/* The first element of a PLY, required to be the vertices. */
typedef struct Vertices {
    Coding coding;
    double count;
    int properties, column[3];
    size_t stride, offset[3];
    bool is_double[3];
    const char *data;
} Vertices;

static size_t size_of(const Word *type)
{
    static const char *const names[] = {"char",  "uchar",   "int8",   "uint8",  "short", "ushort",
                                        "int16", "uint16",  "int",    "uint",   "int32", "uint32",
                                        "float", "float32", "double", "float64"};
    static const size_t sizes[] = {1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 4, 4, 8, 8};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (is(type, names[i]))
            return sizes[i];
    return 0;
}

static bool add_property(const Word *word, int count, Vertices *vertices)
{
    static const char *const axis[] = {"x", "y", "z"};
    const size_t size = count == 3 ? size_of(&word[1]) : 0;
    for (int k = 0; k < 3 && size > 0; k++)
        if (is(&word[2], axis[k])) {
            vertices->column[k] = vertices->properties;
            vertices->offset[k] = vertices->stride;
            vertices->is_double[k] = size == 8;
        }
    vertices->properties++;
    vertices->stride += size;
    return size > 0;
}

static Coding coding_of(const Word *word)
{
    return is(word, "ascii")                  ? TEXT
           : is(word, "binary_little_endian") ? LITTLE
           : is(word, "binary_big_endian")    ? BIG
                                              : UNKNOWN;
}

static bool read_header(const char *at, const char *end, Vertices *vertices)
{
    int elements = 0;
    *vertices = (Vertices){.coding = UNKNOWN, .column = {-1, -1, -1}};
    while (at < end) {
        Word word[WORDS_MOST];
        const char *behind = line_end(at, end);
        const int count = words_of(at, behind, word);
        at = behind + (behind < end);
        if (count == 1 && is(&word[0], "end_header")) {
            vertices->data = at;
            return vertices->coding != UNKNOWN && elements > 0 && vertices->column[0] >= 0 &&
                   vertices->column[1] >= 0 && vertices->column[2] >= 0;
        }
        if (count == 3 && is(&word[0], "format"))
            vertices->coding = coding_of(&word[1]);
        if (count == 3 && is(&word[0], "element") && elements++ == 0 &&
            (!is(&word[1], "vertex") || !number(&word[2], &vertices->count) || !(vertices->count >= 0)))
            return false;
        if (count > 1 && is(&word[0], "property") && elements == 1 && !add_property(word, count, vertices))
            return false;
    }
    return false;
}

static bool move_rows(FILE *to, const Vertices *vertices, const char *at, const char *end, const double by[3])
{
    Word word[WORDS_MOST];
    const PlyColumns columns = {{vertices->column[0], vertices->column[1], vertices->column[2]}, 1};
    double row = 0;
    while (at < end && row < vertices->count) {
        const char *behind = line_end(at, end);
        const int count = words_of(at, behind, word);
        if (count == 0)
            fwrite(at, 1, (size_t)(behind - at), to);
        else if (count < vertices->properties || !write_moved(to, at, behind, word, &columns, by))
            return false;
        row += count > 0;
        if (behind < end)
            fputc('\n', to);
        at = behind + (behind < end);
    }
    fwrite(at, 1, (size_t)(end - at), to);
    return true;
}

static double read_double(const char *bytes, bool big)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++)
        bits |= (uint64_t)(uint8_t)bytes[i] << 8 * (big ? 7 - i : i);
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void write_double(char *bytes, bool big, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++)
        bytes[i] = (char)(bits >> 8 * (big ? 7 - i : i));
}

/* Moves doubles in a copy of the bytes. Returns NULL for numbers of four bytes: the last digits are lost
   already. */
static char *move_doubles(const Vertices *vertices, const char *bytes, size_t size, const double by[3])
{
    const size_t capacity = size - (size_t)(vertices->data - bytes);
    if (!vertices->is_double[0] || !vertices->is_double[1] || !vertices->is_double[2] ||
        vertices->count > (double)capacity / (double)vertices->stride)
        return NULL;
    char *moved = malloc(size + 1);
    if (!moved)
        return NULL;
    memcpy(moved, bytes, size);
    for (size_t i = 0; i < (size_t)vertices->count; i++)
        for (int k = 0; k < 3; k++) {
            char *at = moved + (vertices->data - bytes) + i * vertices->stride + vertices->offset[k];
            write_double(at, vertices->coding == BIG, read_double(at, vertices->coding == BIG) - by[k]);
        }
    return moved;
}

/* ---- all ---- */

static bool move_text(FILE *to, MeshFormat format, const Vertices *vertices, const char *bytes, size_t size,
                      const double by[3])
{
    if (format != MESH_PLY)
        return move_lines(to, format, bytes, bytes + size, by);
    fwrite(bytes, 1, (size_t)(vertices->data - bytes), to);
    return move_rows(to, vertices, vertices->data, bytes + size, by);
}

char *mesh_moved(MeshFormat format, const char *bytes, size_t size, const double by[3], size_t *moved_size)
{
    Vertices vertices = {.coding = TEXT};
    char *moved = NULL;
    if (format == MESH_GLTF || format == MESH_GLB || format == MESH_UNKNOWN ||
        (format == MESH_STL && mesh_is_binary_stl(bytes, size, size)) ||
        (format == MESH_PLY && !read_header(bytes, bytes + size, &vertices)))
        return NULL;
    if (vertices.coding != TEXT) {
        *moved_size = size;
        return move_doubles(&vertices, bytes, size, by);
    }
    FILE *to = open_memstream(&moved, moved_size);
    if (!to)
        return NULL;
    const bool ok = move_text(to, format, &vertices, bytes, size, by);
    if (fclose(to) == 0 && ok)
        return moved;
    free(moved);
    return NULL;
}
