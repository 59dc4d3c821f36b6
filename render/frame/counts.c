#include "render/frame/counts.h"

#include <epoxy/gl.h>

void counts_begin(ViewCounts *counts)
{
    if (!counts)
        return;
    glCreateQueries(GL_SAMPLES_PASSED, 1, &counts->query);
    glBeginQuery(GL_SAMPLES_PASSED, counts->query);
}

void counts_end(ViewCounts *counts, Stage stage)
{
    GLuint64 samples = 0;
    if (!counts)
        return;
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectui64v(counts->query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &counts->query);
    counts->fragments[stage] += (double)samples;
}

void counts_finish(ViewCounts *counts, uint64_t covered, uint64_t pixels)
{
    counts->counted = true;
    counts->coverage = (double)covered / (double)pixels;
    for (int stage = 0; stage < STAGE_COUNT; stage++)
        counts->fragments[stage] /= covered > 0 ? (double)covered : 1;
}
