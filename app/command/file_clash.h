/* What a command reads and writes by its command line: no output may be another one or an input. */
#ifndef SLOSH_FILE_CLASH_H
#define SLOSH_FILE_CLASH_H

#include "app/session/args.h"

/* Compares the outputs (-o with what comes with it, --json, --forces, --probes, --record) with each other and
   with what is read (scenes and the tables that they name among it): by file, whatever its name, and by the
   place where a file that is not there yet would be. Creates nothing. False names both: exit code 2.
   --write-mapping and `devices --record`, which never replace a file, may name one that is read: they say
   themselves that it is there. */
bool file_clash_check(const Args *args, Error *error);

#endif
