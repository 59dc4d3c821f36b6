#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 4 }; /* frames in flight: results arrive two frames later, on a slow driver three */

/* A frame's queries, in pairs of begin and end. */
typedef struct QueryFrame {
    GLuint *query; /* 2 * capacity */
    Stage *stage;  /* capacity */
    int count, capacity;
} QueryFrame;

struct GlTimer {
    GlClock clock;
    void (*between)(void *user); /* NULL: none */
    void *user;
    double began_ms;
    StageTimes finished; /* for `finish`: times of the current frame */
    QueryFrame frames[FRAMES];
    unsigned written, read; /* frames ended, frames read; `written` is the current frame */
};

bool gl_renderer_is_software(void)
{
    const char *name = (const char *)glGetString(GL_RENDERER);
    return name && (strstr(name, "llvmpipe") || strstr(name, "softpipe") || strstr(name, "swrast") ||
                    strstr(name, "Microsoft Basic Render"));
}

GlTimer *gl_timer_create(GlClock clock)
{
    GlTimer *timer = calloc(1, sizeof *timer);
    if (!timer)
        return NULL;
    if (clock == GL_CLOCK_AUTO)
        clock = gl_renderer_is_software() ? GL_CLOCK_FINISH : GL_CLOCK_QUERY;
    timer->clock = clock;
    return timer;
}

void gl_timer_destroy(GlTimer *timer)
{
    if (!timer)
        return;
    for (int i = 0; i < FRAMES; i++) {
        QueryFrame *frame = &timer->frames[i];
        if (frame->capacity)
            glDeleteQueries(2 * frame->capacity, frame->query);
        free(frame->query);
        free(frame->stage);
    }
    free(timer);
}

void gl_timer_warm_up(const GlTimer *timer)
{
    enum { BYTES = 64 << 20, WORK_MS = 300, CLEARS = 50 };
    GLuint buffer;
    if (!timer || gl_renderer_is_software())
        return;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, BYTES, NULL, 0);
    for (const double began = wall_ms(); wall_ms() - began < WORK_MS; glFinish())
        for (int k = 0; k < CLEARS; k++)
            glClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glDeleteBuffers(1, &buffer);
}

const char *gl_timer_clock_name(const GlTimer *timer)
{
    if (!timer || timer->clock == GL_CLOCK_OFF)
        return "off";
    return timer->clock == GL_CLOCK_FINISH ? "finish" : "gl";
}

/* Grows in the first frames, then stays. */
static bool query_reserve(QueryFrame *frame)
{
    if (frame->count < frame->capacity)
        return true;
    int capacity = frame->capacity ? 2 * frame->capacity : 16;
    GLuint *query = realloc(frame->query, (size_t)(2 * capacity) * sizeof *query);
    if (query)
        frame->query = query;
    Stage *stage = realloc(frame->stage, (size_t)capacity * sizeof *stage);
    if (stage)
        frame->stage = stage;
    if (!query || !stage)
        return false;
    glCreateQueries(GL_TIMESTAMP, 2 * (capacity - frame->capacity), query + 2 * frame->capacity);
    frame->capacity = capacity;
    return true;
}

static QueryFrame *current(GlTimer *timer)
{
    return &timer->frames[timer->written % FRAMES];
}

void gl_timer_between(GlTimer *timer, void (*between)(void *user), void *user)
{
    if (!timer)
        return;
    timer->between = between;
    timer->user = user;
}

void gl_timer_begin(GlTimer *timer)
{
    if (!timer)
        return;
    if (timer->clock == GL_CLOCK_FINISH) {
        glFinish();
        timer->began_ms = wall_ms();
    } else if (timer->clock == GL_CLOCK_QUERY && query_reserve(current(timer))) {
        glQueryCounter(current(timer)->query[2 * current(timer)->count], GL_TIMESTAMP);
    }
}

void gl_timer_end(GlTimer *timer, Stage stage)
{
    if (!timer)
        return;
    if (timer->clock == GL_CLOCK_FINISH) {
        glFinish();
        timer->finished.ms[stage] += wall_ms() - timer->began_ms;
        timer->finished.ran[stage] = true;
    } else if (timer->clock == GL_CLOCK_QUERY && current(timer)->count < current(timer)->capacity) {
        QueryFrame *frame = current(timer);
        glQueryCounter(frame->query[2 * frame->count + 1], GL_TIMESTAMP);
        frame->stage[frame->count++] = stage;
    }
    if (timer->between)
        timer->between(timer->user);
}

static void copy_ran(const StageTimes *from, StageTimes *to)
{
    for (int stage = 0; stage < STAGE_COUNT; stage++)
        if (from->ran[stage]) {
            to->ms[stage] = from->ms[stage];
            to->ran[stage] = true;
        }
}

static bool results_ready(const QueryFrame *frame)
{
    GLint ready = GL_TRUE;
    if (frame->count)
        glGetQueryObjectiv(frame->query[2 * frame->count - 1], GL_QUERY_RESULT_AVAILABLE, &ready);
    return ready;
}

/* Waits if results are missing. */
static void read_oldest(GlTimer *timer, StageTimes *times)
{
    QueryFrame *frame = &timer->frames[timer->read++ % FRAMES];
    StageTimes sum = {0};
    for (int i = 0; i < frame->count; i++) {
        GLuint64 begin = 0, end = 0;
        glGetQueryObjectui64v(frame->query[2 * i], GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(frame->query[2 * i + 1], GL_QUERY_RESULT, &end);
        sum.ms[frame->stage[i]] += (double)(end - begin) * 1e-6;
        sum.ran[frame->stage[i]] = true;
    }
    frame->count = 0;
    copy_ran(&sum, times);
}

bool gl_timer_frame(GlTimer *timer, StageTimes *times)
{
    if (!timer || timer->clock == GL_CLOCK_OFF)
        return false;
    if (timer->clock == GL_CLOCK_FINISH) {
        copy_ran(&timer->finished, times);
        timer->finished = (StageTimes){0};
        return true;
    }
    timer->written++;
    unsigned owed = timer->written - timer->read;
    if (owed < 3)
        return false;
    if (owed < FRAMES && !results_ready(&timer->frames[timer->read % FRAMES]))
        return false;
    read_oldest(timer, times); /* the next frame reuses the slot */
    return true;
}

bool gl_timer_drain(GlTimer *timer, StageTimes *times)
{
    if (!timer || timer->read == timer->written)
        return false;
    read_oldest(timer, times);
    return true;
}

static void stage_began(void *timer)
{
    gl_timer_begin(timer);
}

static void stage_ended(void *timer, Stage stage)
{
    gl_timer_end(timer, stage);
}

StageClock gl_timer_stage_clock(GlTimer *timer)
{
    return (StageClock){.gpu = timer, .gpu_begin = stage_began, .gpu_end = stage_ended};
}
