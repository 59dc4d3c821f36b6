#include "app/export/export_index.h"

#include "sim/base/error.h"

#include <errno.h>
#include <jansson.h>
#include <string.h>

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void export_index_name(const char *folder, size_t index, size_t of, const char *extension, char *name,
                       size_t size)
{
    snprintf(name, size, "%s-%0*zu%s", last_part(folder), number_digits(of, 4), index, extension);
}

/* Prints a text within the quotes of an attribute. */
static void print_escaped(FILE *file, const char *text)
{
    for (; *text; text++)
        if (strchr("&<>\"", *text))
            fprintf(file, "&#%d;", *text);
        else
            fputc(*text, file);
}

void export_part_name(const char *name, const char *suffix, char *own, size_t size)
{
    const char *dot = strrchr(name, '.');
    const int length = dot ? (int)(dot - name) : (int)strlen(name);
    snprintf(own, size, "%.*s%s%s", length, name, suffix, dot ? dot : "");
}

/* Prints one file's entry; without parts, part 0 without a name. */
static void print_part(FILE *file, const ExportIndex *index, size_t number, size_t part)
{
    const IndexPart *own = index->part_count > 0 ? &index->parts[part] : NULL;
    char name[1088], part_name[1120];
    export_index_name(index->folder, number, index->of, index->extension, name, sizeof name);
    export_part_name(name, own ? own->suffix : "", part_name, sizeof part_name);
    fprintf(file, "<DataSet timestep=\"%.17g\" group=\"\" part=\"%zu\"", index->times[number], part);
    if (own) {
        fputs(" name=\"", file);
        print_escaped(file, own->name);
        fputc('"', file);
    }
    fputs(" file=\"", file);
    print_escaped(file, last_part(index->folder));
    fputc('/', file);
    print_escaped(file, part_name);
    fputs("\"/>\n", file);
}

bool export_index_pvd(FILE *file, const ExportIndex *index)
{
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
          file);
    for (size_t i = 0; i < index->count; i++)
        for (size_t part = 0; part < (index->part_count > 0 ? index->part_count : 1); part++)
            print_part(file, index, i, part);
    fputs("</Collection>\n</VTKFile>\n", file);
    return !ferror(file);
}

bool export_index_series(FILE *file, const ExportIndex *index)
{
    char name[1088];
    json_t *files = json_array();
    for (size_t i = 0; i < index->count; i++) {
        export_index_name(index->folder, i, index->of, index->extension, name, sizeof name);
        json_array_append_new(files, json_pack("{s:o, s:f}", "name",
                                               json_sprintf("%s/%s", last_part(index->folder), name), "time",
                                               index->times[i]));
    }
    json_t *all = json_pack("{s:s, s:o}", "file-series-version", "1.0", "files", files);
    const bool whole = all && json_array_size(files) == index->count;
    if (!whole)
        errno = EILSEQ; /* json_pack failed: the name is not UTF-8 */
    const bool written =
        whole && json_dumpf(all, file, JSON_INDENT(1) | JSON_PRESERVE_ORDER) == 0 && fputc('\n', file) != EOF;
    json_decref(all);
    return written && !ferror(file);
}
