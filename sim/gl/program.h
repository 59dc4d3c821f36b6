/* GL programs from shader files. */
#ifndef SLOSH_PROGRAM_H
#define SLOSH_PROGRAM_H

#include "sim/base/error.h"

/* Compiles and links the files `stages` (paths below shaders/, ended by NULL; .vert .geom .frag or .comp says
   which stage a file is) after the lines `defines` ("#define A 1\n", or NULL). Returns the GL name, labelled
   `label`; the caller deletes it with glDeleteProgram. 0 on failure: `error` says "file:line: log". */
unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error);

/* The two halves of it, so that a driver may compile several programs side by side: what is asked for, which
   waits for nothing, 0 when a file is missing; and whether all went well, with the same arguments. */
unsigned program_begin(const char *label, const char *const stages[], const char *defines, Error *error);
bool program_finish(unsigned program, const char *label, const char *const stages[], const char *defines,
                    Error *error);

/* The same, for the common pair of a vertex and a fragment shader. */
unsigned program_create_pair(const char *label, const char *vertex, const char *fragment, Error *error);

/* From now on shaders are read from this folder; NULL: those embedded in the program. */
void program_set_directory(const char *directory);

#endif
