/* Index of a series of files, and names of the files. Names inside an index are relative to the index.

   .pvd is ParaView's collection in XML, with one file or several parts per time. .ply.series, also
   readable by ParaView, is JSON: {"file-series-version": "1.0", "files": [{"name": "a/a-0000.ply", "time":
   0.0}, ...]}. */
#ifndef SLOSH_EXPORT_INDEX_H
#define SLOSH_EXPORT_INDEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Makes NAME-0000EXTENSION: NAME is the last part of the folder's path, the number has at least four digits,
   and as many as the greatest of `of` numbers needs, so that names sort as numbers do; the extension is
   ".vtp" or
   ".ply". */
void export_index_name(const char *folder, size_t index, size_t of, const char *extension, char *name,
                       size_t size);

/* One of the files of a time: a mesh. */
typedef struct IndexPart {
    char name[40];   /* as listed by ParaView */
    char suffix[24]; /* of the file name, "-solid0"; "": none */
} IndexPart;

/* Turns NAME-0000EXTENSION into NAME-0000SUFFIXEXTENSION. */
void export_part_name(const char *name, const char *suffix, char *own, size_t size);

typedef struct ExportIndex {
    const char *folder, *extension;
    size_t count;           /* count of times */
    size_t of;              /* numbers that names have room for */
    const double *times;    /* of each, s */
    size_t part_count;      /* 0: one file per time, without a name in the index */
    const IndexPart *parts; /* not owned */
} ExportIndex;

/* Writes an index; the files are in `folder`, beside the index. Parts are for .pvd only. Returns false if
   the stream fails (see errno). */
bool export_index_pvd(FILE *file, const ExportIndex *index);
bool export_index_series(FILE *file, const ExportIndex *index);

#endif
