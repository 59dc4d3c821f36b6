/* Which program takes the GPU's time. */
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Run {
    GLuint program, query[2]; /* timestamps before and after */
} Run;

static struct {
    Run *of;
    size_t count, capacity;
    bool on;
} runs;

static Run *run_add(void)
{
    if (runs.count == runs.capacity) {
        const size_t more = 2 * runs.capacity + 256;
        Run *grown = realloc(runs.of, more * sizeof *grown);
        if (!grown)
            return NULL;
        runs.of = grown;
        runs.capacity = more;
    }
    return &runs.of[runs.count++];
}

bool gl_programs_run(void)
{
    GLint program = 0;
    Run *run = runs.on ? run_add() : NULL;
    if (!run)
        return false;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    run->program = (GLuint)program;
    glCreateQueries(GL_TIMESTAMP, 2, run->query);
    glQueryCounter(run->query[0], GL_TIMESTAMP);
    return true;
}

void gl_programs_ran(bool measured)
{
    if (measured)
        glQueryCounter(runs.of[runs.count - 1].query[1], GL_TIMESTAMP);
}

void gl_programs_begin(void)
{
    runs.on = true;
}

/* The row of the program's label; NULL: no room is left. */
static GlProgramTime *row_of(GLuint program, GlProgramTime *times, size_t *count, size_t most)
{
    char name[sizeof times->name] = "";
    size_t k = 0;
    glGetObjectLabel(GL_PROGRAM, program, sizeof name, NULL, name);
    while (k < *count && strcmp(times[k].name, name) != 0)
        k++;
    if (k == most)
        return NULL;
    if (k == *count) {
        times[(*count)++] = (GlProgramTime){0};
        snprintf(times[k].name, sizeof times[k].name, "%s", name);
    }
    return &times[k];
}

static int greater_first(const void *a, const void *b)
{
    const GlProgramTime *one = a, *other = b;
    const double d = other->ms + other->before_ms - one->ms - one->before_ms;
    return (d > 0) - (d < 0);
}

size_t gl_programs_end(GlProgramTime *times, size_t most)
{
    GLuint64 at[2], last = 0;
    size_t count = 0;
    runs.on = false;
    for (size_t i = 0; i < runs.count; i++) {
        const Run *run = &runs.of[i];
        for (int k = 0; k < 2; k++)
            glGetQueryObjectui64v(run->query[k], GL_QUERY_RESULT, &at[k]);
        glDeleteQueries(2, run->query);
        GlProgramTime *row = row_of(run->program, times, &count, most);
        if (row) {
            row->runs++;
            row->ms += 1e-6 * (double)(at[1] - at[0]);
            row->before_ms += last > 0 && at[0] > last ? 1e-6 * (double)(at[0] - last) : 0;
        }
        last = at[1];
    }
    free(runs.of);
    memset(&runs, 0, sizeof runs);
    qsort(times, count, sizeof *times, greater_first);
    return count;
}
