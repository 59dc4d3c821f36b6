/* Formats by name, and the steps in a file, an index or a pattern. */
#include "app/files/foreign/foreign.h"

#include "app/base/file.h"
#include "app/base/program.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static const size_t BYTES_MAX = (size_t)64 << 30;

static bool pvd_list(const char *path, ForeignSeries *series, Error *error);

static const char *const pvd_endings[] = {".pvd", NULL};

const ForeignFormat foreign_pvd = {.name = "an index of VTK", .endings = pvd_endings, .list = pvd_list};

const ForeignFormat *const foreign_formats[] = {
    &foreign_hdf5, &foreign_vtk_xml, &foreign_vtk_legacy, &foreign_pvd, &foreign_csv, &foreign_ply, NULL,
};

static bool ends_with(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length > end && strcasecmp(path + length - end, ending) == 0;
}

const ForeignFormat *foreign_format(const char *path)
{
    for (int k = 0; foreign_formats[k]; k++)
        for (int e = 0; foreign_formats[k]->endings[e]; e++)
            if (ends_with(path, foreign_formats[k]->endings[e]))
                return foreign_formats[k];
    return NULL;
}

void foreign_endings(char words[256])
{
    size_t used = 0;
    words[0] = '\0';
    for (int k = 0; foreign_formats[k]; k++)
        for (int e = 0; foreign_formats[k]->endings[e] && used < 240; e++)
            used += (size_t)snprintf(words + used, 256 - used, "%s%s", used > 0 ? ", " : "",
                                     foreign_formats[k]->endings[e]);
}

/* ---- bytes of a file ---- */

/* Maps a file: pages are loaded on demand. */
static bool map_file(const char *path, ForeignBytes *out, Error *error)
{
    struct stat is;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    *out = (ForeignBytes){.path = path};
    if (file < 0 || fstat(file, &is) != 0) {
        error_set(error, "%.300s: cannot be read: %s", path, strerror(errno));
        if (file >= 0)
            close(file);
        return false;
    }
    const char *why = S_ISDIR(is.st_mode)
                          ? "is a folder; name a file in it, or a pattern such as 'part_*.csv'"
                      : !S_ISREG(is.st_mode)           ? "is no file"
                      : is.st_size == 0                ? "is empty"
                      : (size_t)is.st_size > BYTES_MAX ? "has more than 64 GiB"
                                                       : NULL;
    void *bytes = why ? MAP_FAILED : mmap(NULL, (size_t)is.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    close(file);
    if (bytes == MAP_FAILED)
        return error_set(error, "%.300s: %s", path, why ? why : strerror(errno));
    out->bytes = bytes;
    out->size = (size_t)is.st_size;
    return true;
}

static void unmap_file(const ForeignBytes *file)
{
    munmap((void *)file->bytes, file->size);
}

static bool pvd_list(const char *path, ForeignSeries *series, Error *error)
{
    ForeignBytes file;
    if (!map_file(path, &file, error))
        return false;
    const bool ok = foreign_pvd_parse(&file, series, error);
    unmap_file(&file);
    return ok;
}

bool foreign_read(const ForeignStep *step, unsigned roles, bool head_only, ForeignTable *table, Error *error)
{
    const ForeignFormat *format = foreign_format(step->path);
    ForeignBytes file;
    Error why = {{0}};
    *table = (ForeignTable){.roles = roles, .head_only = head_only, .time = NAN};
    if (!format || (!format->read && !format->parse))
        return error_set(error, "%.300s: is of no kind that slosh reads", step->path);
    bool ok = format->read || map_file(step->path, &file, &why);
    if (ok && format->read)
        ok = format->read(step->path, step->inner, table, &why);
    else if (ok) {
        ok = format->parse(&file, table, &why);
        unmap_file(&file);
    }
    if (ok)
        return true;
    foreign_table_free(table);
    return error_set(error, "%s", why.message);
}

/* ---- series ---- */

bool foreign_is_pattern(const char *path)
{
    return strchr(path, '*') != NULL;
}

/* Orders names by the numbers in names: part_9 before part_10. */
static int by_numbers(const void *a, const void *b)
{
    const char *one = *(char *const *)a, *other = *(char *const *)b;
    while (*one && *other) {
        if (isdigit((unsigned char)*one) && isdigit((unsigned char)*other)) {
            char *one_end, *other_end;
            const unsigned long long first = strtoull(one, &one_end, 10),
                                     second = strtoull(other, &other_end, 10);
            if (first != second)
                return first < second ? -1 : 1;
            one = one_end;
            other = other_end;
        } else if (*one != *other)
            break;
        else
            one++, other++;
    }
    return (*one > *other) - (*one < *other);
}

static bool list_pattern(const char *path, ForeignSeries *series, Error *error)
{
    glob_t found = {0};
    bool ok = glob(path, GLOB_NOSORT, NULL, &found) == 0 && found.gl_pathc > 0;
    if (!ok)
        error_set(error, "%.300s: no file matches", path);
    if (ok)
        qsort(found.gl_pathv, found.gl_pathc, sizeof *found.gl_pathv, by_numbers);
    for (size_t i = 0; ok && i < found.gl_pathc; i++) {
        const ForeignFormat *format = foreign_format(found.gl_pathv[i]);
        if (!format || !format->parse)
            ok = format && format->list
                     ? format->list(found.gl_pathv[i], series, error)
                     : error_set(error, "%.300s: is of no kind that slosh reads", found.gl_pathv[i]);
        else if (!foreign_series_add(series, found.gl_pathv[i], 0, NAN))
            ok = error_set(error, "%.300s: no memory for its files", path);
    }
    globfree(&found);
    return ok;
}

bool foreign_list(const char *path, ForeignSeries *series, Error *error)
{
    *series = (ForeignSeries){0};
    char endings[256];
    const ForeignFormat *format = foreign_format(path);
    foreign_endings(endings);
    bool ok;
    if (foreign_is_pattern(path))
        ok = list_pattern(path, series, error);
    else if (!format)
        ok = error_set(error, "%.300s: is of no kind that slosh reads: %s", path, endings);
    else if (format->list)
        ok = format->list(path, series, error);
    else
        ok = foreign_series_add(series, path, 0, NAN) || error_set(error, "no memory");
    if (!ok)
        foreign_series_free(series);
    return ok;
}

size_t foreign_siblings(const char *path, char pattern[1024])
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    const char *end = dot ? dot : name + strlen(name), *digits;
    while (end > name && !(end[-1] >= '0' && end[-1] <= '9'))
        end--;
    for (digits = end; digits > name && digits[-1] >= '0' && digits[-1] <= '9';)
        digits--;
    glob_t found = {0};
    size_t count = 0;
    if (digits == end || strpbrk(path, "*?[") ||
        snprintf(pattern, 1024, "%.*s*%s", (int)(digits - path), path, end) >= 1024)
        return 0;
    if (glob(pattern, GLOB_NOSORT, NULL, &found) == 0)
        count = found.gl_pathc - 1;
    globfree(&found);
    return count;
}
