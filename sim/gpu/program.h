/* The text of a shader, embedded in the program or read from a folder, with includes expanded.

   A line `#include "common/frame.glsl"` pastes the file, once per shader; paths start at the folder
   shaders/. Headers shared with C have their C paths, "shaders/shared/frame_block.h". A line `#include
   NAME` pastes the file of an earlier line `#define NAME common/frame.glsl`, and nothing without such a
   line. #line marks give the compiler file and line numbers, and shader_source_log turns these numbers back
   into names. The language is GLSL 4.50; for .vert, .geom and .frag below sim/ GLSL 3.30. */
#ifndef SIM_GPU_PROGRAM_H
#define SIM_GPU_PROGRAM_H

#include "slosh/error.h"

#include <stddef.h>
#include <stdint.h>

typedef struct EmbeddedShader {
    const char *path, *text;
} EmbeddedShader;

extern const EmbeddedShader embedded_shaders[]; /* ended by a NULL path; made at build time */

enum { SHADER_FILES_MAX = 40, SHADER_PATH_MAX = 128 };

typedef struct ShaderSource {
    char *text; /* owned; complete, with #version and the defines */
    size_t size, capacity;
    int file_count;
    char file[SHADER_FILES_MAX][SHADER_PATH_MAX]; /* indexed by the file number in #line */
} ShaderSource;

/* From now on shaders are read from `directory`; NULL: from the embedded shaders. For all threads; set
   before use. */
void shader_source_set_directory(const char *directory);

/* A number that changes with the files in the directory (by modification times); 0 without a directory. */
uint64_t shader_source_stamp(void);

/* `defines`: lines ("#define A 1\n") before the file, or NULL. Returns false if a file is missing: `error`
   has the name and the including line. */
bool shader_source_load(ShaderSource *source, const char *path, const char *defines, Error *error);
void shader_source_free(ShaderSource *source);

/* True if the file exists, in the program or the directory. */
bool shader_source_has(const char *path);

/* GL programs from shader files. */

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
