/* The text of a shader: embedded in the program, or read from a folder, with its includes pasted in.

   A line `#include "common/frame.glsl"` pastes that file, once a shader; paths count from the folder
   shaders/. Headers that C includes too are named as C names them, "shaders/shared/frame_block.h". A
   line `#include NAME` pastes the file that a line `#define NAME common/frame.glsl` before the shader says,
   and nothing where there is none. The compiler is told by #line which file and line it reads, and
   shader_source_log turns its numbers back into names. The language is GLSL 4.50; of .vert, .geom and .frag
   below sim/ GLSL 3.30. */
#ifndef SLOSH_SHADER_SOURCE_H
#define SLOSH_SHADER_SOURCE_H

#include "sim/base/error.h"

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
    char file[SHADER_FILES_MAX][SHADER_PATH_MAX]; /* by the number that #line names */
} ShaderSource;

/* Shaders are read from `directory` from now on; NULL: the embedded ones. For all threads; set it before use.
 */
void shader_source_set_directory(const char *directory);

/* A number that changes with the files in that directory (by the times of their last change); 0 without a
   directory. */
uint64_t shader_source_stamp(void);

/* `defines` are lines ("#define A 1\n") that stand before the file, or NULL. False when a file is missing:
   `error` says which, and where it is included. */
bool shader_source_load(ShaderSource *source, const char *path, const char *defines, Error *error);
void shader_source_free(ShaderSource *source);

/* Whether it is there, in the program or the directory. */
bool shader_source_has(const char *path);

/* Copies the compiler's log with "file:line:" in place of its numbers. Returns whether there was such a
   place: some logs have none for what is missing at a text's end. */
bool shader_source_log(const ShaderSource *source, const char *log, char *out, size_t out_size);

#endif
