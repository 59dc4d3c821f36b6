/* The index of a series of files, and how they are called. Names in the file of an index are relative to it.

   .pvd is ParaView's collection in XML; .ply.series, which ParaView opens too, is JSON:
   {"file-series-version": "1.0", "files": [{"name": "a/a-0000.ply", "time": 0.0}, ...]}. */
#ifndef SLOSH_EXPORT_INDEX_H
#define SLOSH_EXPORT_INDEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* NAME-0000EXTENSION: the last part of the folder's path, the number in four digits or as many as it needs,
   and ".vtp" or ".ply". */
void export_index_name(const char *folder, size_t index, const char *extension, char *name, size_t size);

/* For each of the `count` files its time (s) and its name; the files lie in `folder`, beside the index. False
   when the stream fails (errno tells why). */
bool export_index_pvd(FILE *file, const char *folder, const char *extension, size_t count,
                      const double times[]);
bool export_index_series(FILE *file, const char *folder, const char *extension, size_t count,
                         const double times[]);

#endif
