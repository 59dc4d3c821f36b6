/* The index of a series of files, and how they are called. Names in the file of an index are relative to it.

   .pvd is ParaView's collection in XML, of one file or of several parts at each time; .ply.series, which
   ParaView opens too, is JSON:
   {"file-series-version": "1.0", "files": [{"name": "a/a-0000.ply", "time": 0.0}, ...]}. */
#ifndef SLOSH_EXPORT_INDEX_H
#define SLOSH_EXPORT_INDEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* NAME-0000EXTENSION: the last part of the folder's path, the number in four digits or as many as it needs,
   and ".vtp" or ".ply". */
void export_index_name(const char *folder, size_t index, const char *extension, char *name, size_t size);

/* The files of one number: meshes that belong to one time. */
typedef struct IndexPart {
    char name[40];   /* as ParaView lists it */
    char suffix[24]; /* of its files' names, "-solid0"; "": none */
} IndexPart;

/* NAME-0000EXTENSION becomes NAME-0000SUFFIXEXTENSION. */
void export_part_name(const char *name, const char *suffix, char *own, size_t size);

typedef struct ExportIndex {
    const char *folder, *extension;
    size_t count;           /* of numbers */
    const double *times;    /* of each, s */
    size_t part_count;      /* 0: one file each, without a name in the index */
    const IndexPart *parts; /* not owned */
} ExportIndex;

/* The files lie in `folder`, beside the index. Parts are for .pvd alone. False when the stream fails (errno
   tells why). */
bool export_index_pvd(FILE *file, const ExportIndex *index);
bool export_index_series(FILE *file, const ExportIndex *index);

#endif
