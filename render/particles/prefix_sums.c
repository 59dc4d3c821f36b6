#include "render/particles/prefix_sums.h"

#include "render/particles/work.h"
#include "shaders/shared/scan.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

enum { BLOCK = 1024 };

static GLuint compile(const char *file, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, NULL, error);
}

bool prefix_sums_create(PrefixSums *sums, Error *error)
{
    sums->scan = compile("sim/compute/scan.comp", error);
    sums->add = sums->scan ? compile("sim/compute/scan_add.comp", error) : 0;
    return sums->add != 0;
}

void prefix_sums_destroy(PrefixSums *sums)
{
    glDeleteProgram(sums->scan);
    glDeleteProgram(sums->add);
    glDeleteBuffers(PREFIX_SUM_LEVELS, sums->totals);
    *sums = (PrefixSums){0};
}

static size_t blocks_of(size_t size)
{
    return (size + BLOCK - 1) / BLOCK;
}

static void reserve(PrefixSums *sums, size_t size)
{
    if (size <= sums->capacity)
        return;
    sums->capacity = size;
    for (int level = 0; level < PREFIX_SUM_LEVELS; level++)
        work_buffer_remake(&sums->totals[level], (size = blocks_of(size)) * sizeof(GLuint), "prefix sums");
}

static void run(GLuint program, GLuint values, GLuint totals, size_t size)
{
    glUseProgram(program);
    glUniform1ui(SCAN_SIZE_AT, (GLuint)size);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, SCAN_VALUES_STORAGE, 2, (GLuint[]){values, totals});
    work_dispatch(blocks_of(size));
}

void prefix_sums_run(PrefixSums *sums, unsigned buffer, size_t size)
{
    GLuint values[PREFIX_SUM_LEVELS + 1] = {buffer};
    size_t sizes[PREFIX_SUM_LEVELS + 1] = {size};
    int level = 0;
    reserve(sums, size);
    do {
        run(sums->scan, values[level], sums->totals[level], sizes[level]);
        values[level + 1] = sums->totals[level];
        sizes[level + 1] = blocks_of(sizes[level]);
        level++;
    } while (sizes[level] > 1 && level < PREFIX_SUM_LEVELS);
    for (level -= 2; level >= 0; level--)
        run(sums->add, values[level], values[level + 1], sizes[level]);
}
