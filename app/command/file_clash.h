/* Files read and written by a command line: no output may be an input or another output. */
#ifndef SLOSH_FILE_CLASH_H
#define SLOSH_FILE_CLASH_H

#include "app/session/args.h"

/* Compares the outputs (-o with its companion files, --json, --forces, --probes, --record) with each other
   and with the inputs (scenes and their tables). Compares by file, for any names, and by future path for
   missing files. Creates nothing. Returns false with both names: exit code 2. --write-mapping and `devices
   --record` never replace a file, so these may name an input: the commands themselves report that the file
   exists. */
bool file_clash_check(const Args *args, Error *error);

#endif
