#include "app/export/export_index.h"

#include <errno.h>
#include <jansson.h>
#include <string.h>

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void export_index_name(const char *folder, size_t index, const char *extension, char *name, size_t size)
{
    snprintf(name, size, "%s-%04zu%s", last_part(folder), index, extension);
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

bool export_index_pvd(FILE *file, const char *folder, const char *extension, size_t count,
                      const double times[])
{
    char name[1088];
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
          file);
    for (size_t i = 0; i < count; i++) {
        export_index_name(folder, i, extension, name, sizeof name);
        fprintf(file, "<DataSet timestep=\"%.17g\" group=\"\" part=\"0\" file=\"", times[i]);
        print_escaped(file, last_part(folder));
        fputc('/', file);
        print_escaped(file, name);
        fputs("\"/>\n", file);
    }
    fputs("</Collection>\n</VTKFile>\n", file);
    return !ferror(file);
}

bool export_index_series(FILE *file, const char *folder, const char *extension, size_t count,
                         const double times[])
{
    char name[1088];
    json_t *files = json_array();
    for (size_t i = 0; i < count; i++) {
        export_index_name(folder, i, extension, name, sizeof name);
        json_array_append_new(files,
                              json_pack("{s:o, s:f}", "name", json_sprintf("%s/%s", last_part(folder), name),
                                        "time", times[i]));
    }
    json_t *index = json_pack("{s:s, s:o}", "file-series-version", "1.0", "files", files);
    const bool whole = index && json_array_size(files) == count;
    if (!whole)
        errno = EILSEQ; /* all that json_pack refuses: a name that is not UTF-8 */
    const bool written = whole && json_dumpf(index, file, JSON_INDENT(1) | JSON_PRESERVE_ORDER) == 0 &&
                         fputc('\n', file) != EOF;
    json_decref(index);
    return written && !ferror(file);
}
