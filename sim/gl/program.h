/* GL programs from shader files. */
#ifndef SLOSH_PROGRAM_H
#define SLOSH_PROGRAM_H

#include "sim/base/error.h"

/* Compiles and links the files `stages` (paths below shaders/, ended by NULL; .vert .geom .frag or .comp
   gives the stage) after the lines `defines` ("#define A 1\n", or NULL). Returns the GL name, labelled
   `label`; the caller deletes the program with glDeleteProgram. 0 on failure: `error` has "file:line:
   log". */
unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error);

/* program_create in two halves, so that a driver can compile several programs in parallel. program_begin
   does not wait and returns 0 if a file is missing; program_finish is true on success and takes the same
   arguments. */
unsigned program_begin(const char *label, const char *const stages[], const char *defines, Error *error);
bool program_finish(unsigned program, const char *label, const char *const stages[], const char *defines,
                    Error *error);

/* program_create for a vertex and a fragment shader. */
unsigned program_create_pair(const char *label, const char *vertex, const char *fragment, Error *error);

/* From now on shaders are read from this folder; NULL: from the shaders embedded in the program. */
void program_set_directory(const char *directory);

#endif
