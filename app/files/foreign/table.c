#include "app/base/program.h"
#include "app/files/foreign/foreign.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- meanings of names ---- */

static const struct {
    const char *words, *names;
} roles[] = {
#define X(NAME, words, names) {words, names},
    FOREIGN_ROLE_LIST(X)
#undef X
};

const char *foreign_role_words(ForeignRole role)
{
    return roles[role].words;
}

bool foreign_role_is_vector(ForeignRole role)
{
    return role <= FOREIGN_ACCELERATION;
}

/* Small letters and digits alone, without a unit in parentheses or brackets. */
static size_t normalise(const char *name, char plain[FOREIGN_NAME_SIZE])
{
    size_t length = 0;
    for (; *name && *name != '(' && *name != '['; name++)
        if (isalnum((unsigned char)*name))
            plain[length++] = (char)tolower((unsigned char)*name);
    plain[length] = '\0';
    return length;
}

/* Place of the name in a list of words between spaces; -1: none. */
static int rank_of(const char *names, const char *name, size_t length)
{
    int rank = 0;
    for (const char *at = names + 1; *at && length > 0; rank++) {
        const char *end = strchr(at, ' ');
        if ((size_t)(end - at) == length && memcmp(at, name, length) == 0)
            return rank;
        at = end + 1;
    }
    return -1;
}

static int axis_of(char letter)
{
    return letter >= 'x' && letter <= 'z' ? letter - 'x' : letter >= '0' && letter <= '2' ? letter - '0' : -1;
}

/* A column with a component of a vector: velx, vel0; x alone is a place, u, v, w alone are a velocity. */
static bool is_component(ForeignColumn *column, const char *plain, size_t length)
{
    const int axis = length > 0 ? axis_of(plain[length - 1]) : -1;
    if (length == 1 && isalpha((unsigned char)*plain) && *plain >= 'u') {
        column->role = axis >= 0 ? FOREIGN_PLACE : FOREIGN_VELOCITY;
        column->axis = axis >= 0 ? axis : *plain - 'u';
        column->rank = axis >= 0 ? 0 : 100; /* u, v, w: where there is no better name */
        return true;
    }
    if (axis < 0)
        return false;
    for (int role = FOREIGN_PLACE; role <= FOREIGN_ACCELERATION; role++)
        if ((column->rank = rank_of(roles[role].names, plain, length - 1)) >= 0) {
            column->role = role;
            column->axis = axis;
            return true;
        }
    if (length == 2 && *plain == 'a') {
        column->role = FOREIGN_ACCELERATION;
        column->axis = axis;
        return true;
    }
    return false;
}

static void find_role(ForeignColumn *column)
{
    char plain[FOREIGN_NAME_SIZE];
    const size_t length = normalise(column->name, plain);
    column->role = -1;
    if (column->components == 1 && is_component(column, plain, length))
        return;
    column->axis = 0;
    for (int role = 0; role < FOREIGN_ROLES; role++) {
        const bool fits = foreign_role_is_vector((ForeignRole)role)
                              ? column->components == 2 || column->components == 3
                              : column->components == 1;
        const int rank = fits ? rank_of(roles[role].names, plain, length) : -1;
        if (rank >= 0) {
            column->role = role;
            column->rank = rank;
            return;
        }
    }
}

/* ---- tables ---- */

void foreign_table_free(ForeignTable *table)
{
    for (int k = 0; k < table->column_count; k++)
        free(table->column[k].value);
    *table = (ForeignTable){0};
}

ForeignColumn *foreign_column_add(ForeignTable *table, const char *path, const char *name, int components,
                                  Error *error)
{
    if (table->column_count == FOREIGN_COLUMNS_MAX) {
        error_set(error, "%.300s: has more than %d columns; write those that are to be seen", path,
                  FOREIGN_COLUMNS_MAX);
        return NULL;
    }
    ForeignColumn *column = &table->column[table->column_count];
    *column = (ForeignColumn){.components = components};
    for (size_t k = 0; k + 1 < sizeof column->name && name[k]; k++)
        column->name[k] = name[k];
    find_role(column);
    if (column->role < 0 && components == 1 && *column->name && table->others < FOREIGN_OTHERS)
        column->role = FOREIGN_ROLES + table->others++;
    const double bytes = (double)table->count * components * sizeof(double);
    if (column->role >= 0 && table->roles >> column->role & 1) {
        column->value =
            bytes < memory_bytes() ? calloc(table->count * (size_t)components + 1, sizeof(double)) : NULL;
        if (!column->value) {
            error_set(error, "%.300s: no memory for %zu particles", path, table->count);
            return NULL;
        }
    }
    table->column_count++;
    return column;
}

bool foreign_find(const ForeignTable *table, int role, int axis, ForeignPlace *place)
{
    const ForeignColumn *best = NULL;
    for (int k = 0; k < table->column_count; k++) {
        const ForeignColumn *column = &table->column[k];
        if (column->role == role && axis >= column->axis && axis < column->axis + column->components &&
            (!best || column->rank < best->rank))
            best = column;
    }
    if (!best)
        return false;
    *place = (ForeignPlace){.value = best->value ? best->value + axis - best->axis : NULL,
                            .stride = (size_t)best->components,
                            .name = best->name};
    return true;
}

/* ---- lists of steps ---- */

bool foreign_series_add(ForeignSeries *series, const char *path, size_t inner, double time)
{
    if (series->count == series->capacity) {
        const size_t capacity = series->capacity ? 2 * series->capacity : 64;
        ForeignStep *step = realloc(series->step, capacity * sizeof *step);
        if (!step)
            return false;
        series->step = step;
        series->capacity = capacity;
    }
    char *own = strdup(path);
    if (own)
        series->step[series->count++] = (ForeignStep){.path = own, .inner = inner, .time = time};
    return own != NULL;
}

void foreign_series_free(ForeignSeries *series)
{
    for (size_t i = 0; i < series->count; i++)
        free(series->step[i].path);
    free(series->step);
    *series = (ForeignSeries){0};
}

/* ---- numbers ---- */

/* Slow and exact, with words: nan, inf. */
static bool number_by_library(const char **at, const char *end, double *value)
{
    char word[64], *stop;
    size_t length = 0;
    while (*at + length < end && length < sizeof word - 1 &&
           (isalnum((unsigned char)(*at)[length]) || ((*at)[length] && strchr("+-.", (*at)[length]))))
        length++;
    memcpy(word, *at, length);
    word[length] = '\0';
    *value = strtod(word, &stop);
    *at += stop - word;
    return stop > word;
}

/* After: W. Clinger, "How to read floating point numbers accurately", 1990: digits below 2^53 and a power of
   ten up to 22 are exact, so one operation rounds correctly. */
bool foreign_number(const char **at, const char *end, double *value)
{
    static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const char *c = *at;
    const bool minus = c < end && *c == '-';
    uint64_t digits = 0;
    int scale = 0, exponent = 0, count = 0;
    c += c < end && (*c == '-' || *c == '+');
    for (; c < end && *c >= '0' && *c <= '9' && count < 18; c++, count++)
        digits = 10 * digits + (uint64_t)(*c - '0');
    if (c < end && *c == '.')
        for (c++; c < end && *c >= '0' && *c <= '9' && count < 18; c++, count++, scale--)
            digits = 10 * digits + (uint64_t)(*c - '0');
    if (count == 0 || (c < end && *c >= '0' && *c <= '9'))
        return number_by_library(at, end, value);
    if (c < end && (*c == 'e' || *c == 'E')) {
        const char *e = c + 1;
        const bool less = e < end && *e == '-';
        e += e < end && (*e == '-' || *e == '+');
        if (e == end || *e < '0' || *e > '9')
            return number_by_library(at, end, value);
        for (; e < end && *e >= '0' && *e <= '9' && exponent < 10000; e++)
            exponent = 10 * exponent + (*e - '0');
        scale += less ? -exponent : exponent;
        c = e;
    }
    if (digits >> 53 || scale < -22 || scale > 22 || (c < end && (isalpha((unsigned char)*c) || *c == '.')))
        return number_by_library(at, end, value);
    const double number = scale < 0 ? (double)digits / power[-scale] : (double)digits * power[scale];
    *value = minus ? -number : number;
    *at = c;
    return true;
}

size_t foreign_type_bytes(ForeignType type)
{
    static const size_t bytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return bytes[type];
}

static void swap(unsigned char *number, size_t bytes)
{
    for (size_t k = 0; k < bytes / 2; k++) {
        const unsigned char one = number[k];
        number[k] = number[bytes - 1 - k];
        number[bytes - 1 - k] = one;
    }
}

void foreign_convert(const void *from, ForeignType type, bool swapped, size_t count, double *to)
{
    const size_t bytes = foreign_type_bytes(type);
    for (size_t i = 0; i < count; i++) {
        union {
            unsigned char byte[8];
            int8_t i8;
            uint8_t u8;
            int16_t i16;
            uint16_t u16;
            int32_t i32;
            uint32_t u32;
            int64_t i64;
            uint64_t u64;
            float f32;
            double f64;
        } n;
        memcpy(n.byte, (const unsigned char *)from + i * bytes, bytes);
        if (swapped)
            swap(n.byte, bytes);
        switch (type) {
        case FOREIGN_I8:
            to[i] = n.i8;
            break;
        case FOREIGN_U8:
            to[i] = n.u8;
            break;
        case FOREIGN_I16:
            to[i] = n.i16;
            break;
        case FOREIGN_U16:
            to[i] = n.u16;
            break;
        case FOREIGN_I32:
            to[i] = n.i32;
            break;
        case FOREIGN_U32:
            to[i] = n.u32;
            break;
        case FOREIGN_I64:
            to[i] = (double)n.i64;
            break;
        case FOREIGN_U64:
            to[i] = (double)n.u64;
            break;
        case FOREIGN_F32:
            to[i] = (double)n.f32;
            break;
        default:
            to[i] = n.f64;
            break;
        }
    }
}

bool foreign_count_fits(const ForeignBytes *file, double count, Error *error)
{
    enum { MOST_COMPRESSED = 1032 }; /* zlib's greatest ratio */
    return (count >= 0 && count <= (double)file->size * MOST_COMPRESSED) ||
           error_set(error, "%.300s: claims %.0f particles, which its %zu bytes cannot hold; it is damaged",
                     file->path, count, file->size);
}
