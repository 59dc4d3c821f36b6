#include "render/probe/particle_probe.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/probe_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)VIEW_PROBES_MAX == (int)PROBES_MAX, "all that may be asked has room");
_Static_assert(sizeof(ProbeAnswer) == 64, "as std430 has it");

enum { PART_BYTES = 5 * 4, GROUP = 64 * PROBE_LANE };

/* Tolerance of a position on a ball's surface, for rounding, in radii. */
static const double ROUNDING = 1e-3;

/* ---- programs and buffers ---- */

static bool make(unsigned *program, const char *file, const char *defines)
{
    Error error = {{0}};
    if (!*program && !(*program = program_create(file, (const char *const[]){file, NULL}, defines, &error)))
        fprintf(stderr, "no values under the mouse and at pins: %s\n", error.message);
    return *program != 0;
}

static bool make_sum(ParticleProbe *probe, const ProbedPicture *picture)
{
    const bool radii = picture->how.radii != 0;
    char defines[64];
    if (picture->kernel != probe->kernel)
        for (int i = 0; i < 2; i++) {
            glDeleteProgram(probe->sum[i]);
            probe->sum[i] = 0;
        }
    probe->kernel = picture->kernel;
    snprintf(defines, sizeof defines, "#define KERNEL %d\n%s", picture->kernel,
             radii ? "#define DROPS 1\n" : "");
    return make(&probe->sum[radii], "render/probe_sum.comp", defines);
}

static bool make_buffers(ParticleProbe *probe, size_t parts)
{
    if (!probe->mailbox.buffer) {
        for (int i = 0; i < PROBE_STAND_INS; i++)
            work_buffer_remake(&probe->nothing[i], 16, "nothing to probe");
        if (!mailbox_create(&probe->mailbox, "probe answers", sizeof probe->answers))
            return false;
    }
    if (parts > probe->capacity) {
        probe->capacity = work_capacity(probe->capacity, parts);
        work_buffer_remake(&probe->parts, probe->capacity * PART_BYTES, "probe parts");
    }
    return true;
}

static bool prepare(ParticleProbe *probe, const ProbedPicture *picture, size_t parts)
{
    return make(&probe->place, "render/probe_place.comp", NULL) && make_sum(probe, picture) &&
           make(&probe->find, "render/probe_find.comp", NULL) && make_buffers(probe, parts);
}

void particle_probe_destroy(ParticleProbe *probe)
{
    glDeleteProgram(probe->place);
    glDeleteProgram(probe->sum[0]);
    glDeleteProgram(probe->sum[1]);
    glDeleteProgram(probe->find);
    glDeleteBuffers(1, &probe->parts);
    glDeleteBuffers(PROBE_STAND_INS, probe->nothing);
    mailbox_destroy(&probe->mailbox);
    *probe = (ParticleProbe){0};
}

/* ---- passes ---- */

static int count_of(const ViewAsks *asks)
{
    return asks->count + asks->mouse;
}

/* Rows of a target count from below. */
static void find_places(const ParticleProbe *probe, const ProbedPicture *picture, const ViewAsks *asks)
{
    GLfloat asked[PROBES_MAX][4] = {{0}};
    for (int i = 0; i < asks->count; i++)
        for (int k = 0; k < 3; k++)
            asked[i][k] = (GLfloat)asks->at[i][k];
    if (asks->mouse) {
        GLfloat *pixel = asked[asks->count];
        pixel[0] = (GLfloat)floor(asks->pixel[0]);
        pixel[1] = (GLfloat)(picture->target.height - 1 - floor(asks->pixel[1]));
        pixel[3] = 1;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0); /* unbinds the depth texture that is read */
    glUseProgram(probe->place);
    glUniform1ui(PROBE_COUNT_AT, (GLuint)count_of(asks));
    glUniform4fv(PROBE_ASKED_AT, PROBES_MAX, asked[0]);
    glBindTextureUnit(PROBE_DEPTH_UNIT, picture->target.depth);
    work_dispatch(1);
}

/* No buffer may be bound to two blocks. */
static void bind(const ParticleProbe *probe, unsigned program, const ProbedPicture *picture)
{
    const ParticleBuffers *particles = &picture->particles;
    const size_t count = particles->count;
    particle_bind(program, particles, picture->scalar);
    glUniform1ui(SCALAR_STRIDE_AT, particle_bind_one(SCALARS_STORAGE, &particles->scalar[picture->scalar],
                                                     count, probe->nothing[0]));
    glUniform1ui(FLUID_STRIDE_AT,
                 particle_bind_one(FLUIDS_STORAGE, &particles->fluid, count, probe->nothing[1]));
}

static void sum_up(const ParticleProbe *probe, const ProbedPicture *picture, size_t groups, int count)
{
    const ParticleBuffers *particles = &picture->particles;
    const unsigned program = probe->sum[picture->how.radii != 0];
    glUseProgram(program);
    bind(probe, program, picture);
    if (picture->how.radii)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, picture->how.radii);
    glUniform1ui(PROBE_PARTICLES_AT, (GLuint)particles->count);
    glUniform1f(PROBE_REACH_AT, (GLfloat)particles->support_radius);
    glDispatchCompute((GLuint)groups, (GLuint)count, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

static void find(const ParticleProbe *probe, const ProbedPicture *picture, size_t groups, int count)
{
    const ParticleBuffers *particles = &picture->particles;
    glUseProgram(probe->find);
    bind(probe, probe->find, picture);
    glUniform1ui(PROBE_GROUPS_AT, (GLuint)groups);
    glUniform1ui(PROBE_ID_STRIDE_AT,
                 particle_bind_one(PROBE_IDS_STORAGE, &particles->id, particles->count, probe->nothing[2]));
    work_dispatch((size_t)count);
}

static void send(ParticleProbe *probe, const ProbedPicture *picture, const ViewAsks *asks)
{
    const size_t groups = (picture->particles.count + GROUP - 1) / GROUP;
    const int count = count_of(asks);
    probe->failed = !prepare(probe, picture, groups * (size_t)count);
    if (probe->failed)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, FRAME_BLOCK, picture->uniforms);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PROBE_PARTS_STORAGE, probe->parts);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PROBE_ANSWERS_STORAGE, probe->mailbox.buffer);
    find_places(probe, picture, asks);
    sum_up(probe, picture, groups, count);
    find(probe, picture, groups, count);
    mailbox_send(&probe->mailbox);
    probe->sent = (ProbeAsked){
        *asks,         picture->number, picture->how, picture->by_fluid, picture->particles.id.buffer != 0,
        picture->name, picture->unit};
}

/* ---- answers ---- */

static void take(ParticleProbe *probe)
{
    const void *came = mailbox_look(&probe->mailbox);
    if (!came)
        return;
    memcpy(probe->answers, came, sizeof probe->answers);
    probe->known = probe->sent;
}

/* For a ball, the particle's own value; else the mean, for fluids the nearest particle's fluid. */
static void tell(const ProbeAsked *asked, const ProbeAnswer *answer, const WorldDef *world, ViewProbe *out)
{
    const bool ball = asked->how.by == VIEW_PROBE_BALL, mean = !ball && !asked->by_fluid;
    const bool there = ball ? answer->ratio <= 1 + ROUNDING : answer->field + answer->lost > 0;
    out->what = there ? VIEW_PROBE_VALUE : VIEW_PROBE_EMPTY;
    if (!there || answer->who == UINT32_MAX)
        return;
    out->value = mean ? (double)answer->carried / answer->field : answer->own[3];
    if (asked->by_fluid) {
        out->value = answer->fluid;
        out->words = answer->fluid < (uint32_t)world->fluid_count ? world->fluids[answer->fluid].name : NULL;
    }
    if (isnan(out->value) || (mean && answer->lost > answer->field))
        out->what = VIEW_PROBE_NAN;
    if (ball && asked->has_id)
        out->id = answer->id;
}

/* Under the mouse, the position of a ball's value is the particle's position. */
static void place(const ProbeAsked *asked, int index, const ProbeAnswer *answer, double at[3])
{
    const bool mouse = index == asked->asks.count;
    const float *found = asked->how.by == VIEW_PROBE_BALL ? answer->own : answer->place;
    for (int k = 0; k < 3; k++)
        at[k] = mouse ? (double)found[k] : asked->asks.at[index][k];
}

static bool same_asks(const ViewAsks *a, const ViewAsks *b)
{
    bool same = a->count == b->count && a->mouse == b->mouse;
    for (int i = 0; same && i < a->count; i++)
        for (int k = 0; k < 3; k++)
            same &= a->at[i][k] == b->at[i][k];
    return same && (!a->mouse || (a->pixel[0] == b->pixel[0] && a->pixel[1] == b->pixel[1]));
}

static bool is_of(const ProbeAsked *asked, const ProbedPicture *picture, const ViewAsks *asks)
{
    return asked->number == picture->number && same_asks(&asked->asks, asks);
}

static void tell_all(const ParticleProbe *probe, const ProbedPicture *picture, ViewProbes *out)
{
    const ProbeAsked *asked = &probe->known;
    for (int i = 0; i < count_of(&asked->asks); i++) {
        const ProbeAnswer *answer = &probe->answers[i];
        ViewProbe *told = &out->probe[out->count];
        *told = (ViewProbe){.now = out->now, .name = asked->name, .unit = asked->unit, .id = VIEW_NO_ID};
        tell(asked, answer, picture->world, told);
        place(asked, i, answer, told->at);
        told->seen = sight_pixel(&picture->sight, told->at, told->pixel);
        if (i == asked->asks.count && told->what == VIEW_PROBE_EMPTY)
            continue; /* no fluid under the mouse */
        out->count++;
        out->mouse |= i == asked->asks.count;
    }
}

bool particle_probe_ask(ParticleProbe *probe, const ProbedPicture *picture, const ViewAsks *asks,
                        ViewProbes *out)
{
    *out = (ViewProbes){.count = 0};
    if (probe->failed || count_of(asks) == 0 || picture->particles.count == 0) {
        out->now = out->asked = true; /* nothing more will be known */
        return true;
    }
    take(probe);
    if (!probe->mailbox.fence && !is_of(&probe->known, picture, asks)) {
        send(probe, picture, asks);
        take(probe);
    }
    out->now = is_of(&probe->known, picture, asks);
    if (!probe->known.name)
        return false;
    tell_all(probe, picture, out);
    out->asked = same_asks(&probe->known.asks, asks);
    out->placed = out->asked && out->mouse;
    if (out->placed)
        memcpy(out->place, out->probe[out->count - 1].at, sizeof out->place);
    return true;
}
