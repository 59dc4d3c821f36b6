/* The program's shaders and the toy method's among them, as a folder of links. */
#ifndef SLOSH_TESTS_TOY_SHADERS_H
#define SLOSH_TESTS_TOY_SHADERS_H

#include "tests/scratch.h"

#include "sim/gpu/gl.h"

#include <stdio.h>
#include <stdlib.h>

static char toy_folder[SCRATCH_SIZE];

static inline void toy_shell(const char *command)
{
    char line[1000];
    snprintf(line, sizeof line, command, toy_folder, toy_folder);
    assert_int_equal(system(line), 0);
}

static inline void toy_shaders_add(void)
{
    scratch_folder(toy_folder);
    toy_shell("cp -rs '" SLOSH_SOURCE_DIR "/shaders/.' '%s' && cp -rs '" SLOSH_SOURCE_DIR
              "/tests/sim/toy' '%s/sim/'");
    shader_source_set_directory(toy_folder);
}

static inline void toy_shaders_remove(void)
{
    shader_source_set_directory(NULL);
    scratch_remove(toy_folder);
}

#endif
