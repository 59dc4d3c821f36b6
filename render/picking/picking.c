#include "render/picking/picking.h"

#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/probe_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PART = 4096 }; /* particles per read */

/* The best particles so far. */
typedef struct NearestParticle {
    double radius, depth, beside; /* m: ball radius; distance along the ray to the first ball; distance of
                                     the nearest centre from the ray */
    size_t first, nearest;        /* particle numbers; SIZE_MAX: none */
} NearestParticle;

static void look_at_particle(NearestParticle *found, const SightRay *ray, const float at[3], size_t number)
{
    double from[3], along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = (double)at[k] - ray->from[k];
        along += from[k] * ray->along[k];
        square += from[k] * from[k];
    }
    const double beside = sqrt(fmax(square - along * along, 0)), inside = found->radius - beside;
    if (!(along > 0 && beside < 3 * found->radius)) /* also rejects NaN */
        return;
    const double depth = along - sqrt(fmax(inside * (found->radius + beside), 0));
    if (inside >= 0 && depth < found->depth) {
        found->depth = depth;
        found->first = number;
    }
    if (beside < found->beside) {
        found->beside = beside;
        found->nearest = number;
    }
}

static void read_part(const ParticleAttribute *from, size_t first, size_t count, void *to)
{
    glGetNamedBufferSubData(from->buffer, (GLintptr)(from->offset + first * from->stride),
                            (GLsizeiptr)(count * from->stride), to);
}

/* Returns the particle's number, or SIZE_MAX. */
static size_t number_under(const ParticleBuffers *particles, const SightRay *ray, double radius)
{
    float places[4 * PART];
    NearestParticle found = {radius, INFINITY, INFINITY, SIZE_MAX, SIZE_MAX};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (size_t first = 0; first < particles->count; first += PART) {
        const size_t count = particles->count - first < PART ? particles->count - first : PART;
        read_part(&particles->position, first, count, places);
        for (size_t i = 0; i < count; i++)
            look_at_particle(&found, ray, places + 4 * i, first + i);
    }
    return found.first != SIZE_MAX ? found.first : found.nearest;
}

bool pick_particle(const ParticleBuffers *particles, const SightRay *ray, double radius, uint32_t *id)
{
    const size_t best = particles->id.buffer ? number_under(particles, ray, radius) : SIZE_MAX;
    if (best != SIZE_MAX)
        glGetNamedBufferSubData(particles->id.buffer,
                                (GLintptr)(particles->id.offset + best * particles->id.stride), sizeof *id,
                                id);
    return best != SIZE_MAX;
}

bool pick_position(const ParticleBuffers *particles, const SightRay *ray, double radius, double at[3])
{
    float place[4];
    const size_t best = number_under(particles, ray, radius);
    if (best == SIZE_MAX)
        return false;
    read_part(&particles->position, best, 1, place);
    for (int k = 0; k < 3; k++)
        at[k] = (double)place[k];
    return true;
}

_Static_assert((int)VIEW_PROBES_MAX == (int)PROBES_MAX, "all that may be asked has room");
_Static_assert(sizeof(ProbeAnswer) == 64, "as std430 has it");

enum { PART_BYTES = 5 * 4, GROUP = 64 * PROBE_LANE };

/* Tolerance of a position on a ball's surface, for rounding, in radii. */
static const double ROUNDING = 1e-3;

/* ---- programs and buffers ---- */

static bool make_programs(unsigned *program, const char *file, const char *defines)
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
    return make_programs(&probe->sum[radii], "render/probe_sum.comp", defines);
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

static bool prepare_probe(ParticleProbe *probe, const ProbedPicture *picture, size_t parts)
{
    return make_programs(&probe->place, "render/probe_place.comp", NULL) && make_sum(probe, picture) &&
           make_programs(&probe->find, "render/probe_find.comp", NULL) && make_buffers(probe, parts);
}

static void particle_probe_destroy(ParticleProbe *probe)
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

static int count_of(const ViewProbeRequest *asks)
{
    return asks->count + asks->mouse;
}

/* Rows of a target count from below. */
static void find_places(const ParticleProbe *probe, const ProbedPicture *picture,
                        const ViewProbeRequest *asks)
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
static void bind_particles(const ParticleProbe *probe, unsigned program, const ProbedPicture *picture)
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
    bind_particles(probe, program, picture);
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
    bind_particles(probe, probe->find, picture);
    glUniform1ui(PROBE_GROUPS_AT, (GLuint)groups);
    glUniform1ui(PROBE_ID_STRIDE_AT,
                 particle_bind_one(PROBE_IDS_STORAGE, &particles->id, particles->count, probe->nothing[2]));
    work_dispatch((size_t)count);
}

static void send_request(ParticleProbe *probe, const ProbedPicture *picture, const ViewProbeRequest *asks)
{
    const size_t groups = (picture->particles.count + GROUP - 1) / GROUP;
    const int count = count_of(asks);
    probe->failed = !prepare_probe(probe, picture, groups * (size_t)count);
    if (probe->failed)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, FRAME_BLOCK, picture->uniforms);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PROBE_PARTS_STORAGE, probe->parts);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PROBE_ANSWERS_STORAGE, probe->mailbox.buffer);
    find_places(probe, picture, asks);
    sum_up(probe, picture, groups, count);
    find(probe, picture, groups, count);
    mailbox_send(&probe->mailbox);
    probe->sent = (ProbeRequest){
        *asks,         picture->number, picture->how, picture->by_fluid, picture->particles.id.buffer != 0,
        picture->name, picture->unit};
}

/* ---- answers ---- */

static void take_answers(ParticleProbe *probe)
{
    const void *came = mailbox_look(&probe->mailbox);
    if (!came)
        return;
    memcpy(probe->answers, came, sizeof probe->answers);
    probe->known = probe->sent;
}

/* For a ball, the particle's own value; else the mean, for fluids the nearest particle's fluid. */
static void write_answer(const ProbeRequest *asked, const ProbeAnswer *answer, const WorldDef *world,
                         ViewProbe *out)
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
static void place(const ProbeRequest *asked, int index, const ProbeAnswer *answer, double at[3])
{
    const bool mouse = index == asked->asks.count;
    const float *found = asked->how.by == VIEW_PROBE_BALL ? answer->own : answer->place;
    for (int k = 0; k < 3; k++)
        at[k] = mouse ? (double)found[k] : asked->asks.at[index][k];
}

static bool same_asks(const ViewProbeRequest *a, const ViewProbeRequest *b)
{
    bool same = a->count == b->count && a->mouse == b->mouse;
    for (int i = 0; same && i < a->count; i++)
        for (int k = 0; k < 3; k++)
            same &= a->at[i][k] == b->at[i][k];
    return same && (!a->mouse || (a->pixel[0] == b->pixel[0] && a->pixel[1] == b->pixel[1]));
}

static bool is_of(const ProbeRequest *asked, const ProbedPicture *picture, const ViewProbeRequest *asks)
{
    return asked->number == picture->number && same_asks(&asked->asks, asks);
}

static void write_answers(const ParticleProbe *probe, const ProbedPicture *picture, ViewProbeAnswers *out)
{
    const ProbeRequest *asked = &probe->known;
    for (int i = 0; i < count_of(&asked->asks); i++) {
        const ProbeAnswer *answer = &probe->answers[i];
        ViewProbe *answered = &out->probe[out->count];
        *answered = (ViewProbe){.now = out->now, .name = asked->name, .unit = asked->unit, .id = VIEW_NO_ID};
        write_answer(asked, answer, picture->world, answered);
        place(asked, i, answer, answered->at);
        answered->seen = sight_pixel(&picture->sight, answered->at, answered->pixel);
        if (i == asked->asks.count && answered->what == VIEW_PROBE_EMPTY)
            continue; /* no fluid under the mouse */
        out->count++;
        out->mouse |= i == asked->asks.count;
    }
}

/* Sends the request, unless already sent, and takes an answer that has arrived. Returns false if nothing
   is known yet. */
static bool particle_probe_request(ParticleProbe *probe, const ProbedPicture *picture,
                                   const ViewProbeRequest *asks, ViewProbeAnswers *out)
{
    *out = (ViewProbeAnswers){.count = 0};
    if (probe->failed || count_of(asks) == 0 || picture->particles.count == 0) {
        out->now = out->asked = true; /* nothing more will be known */
        return true;
    }
    take_answers(probe);
    if (!probe->mailbox.fence && !is_of(&probe->known, picture, asks)) {
        send_request(probe, picture, asks);
        take_answers(probe);
    }
    out->now = is_of(&probe->known, picture, asks);
    if (!probe->known.name)
        return false;
    write_answers(probe, picture, out);
    out->asked = same_asks(&probe->known.asks, asks);
    out->placed = out->asked && out->mouse;
    if (out->placed)
        memcpy(out->place, out->probe[out->count - 1].at, sizeof out->place);
    return true;
}

static bool same_state(const ParticleBuffers *a, const ParticleBuffers *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count &&
           a->position.buffer == b->position.buffer && a->position.offset == b->position.offset;
}

static bool same_camera(const Camera *a, const Camera *b)
{
    bool same = a->near_plane == b->near_plane;
    for (int k = 0; k < 3; k++)
        same &= a->eye[k] == b->eye[k];
    for (int k = 0; k < 16; k++)
        same &= a->view[k] == b->view[k];
    for (int k = 0; k < 2; k++)
        same &= a->tangent[k] == b->tangent[k] && a->centre[k] == b->centre[k];
    return same;
}

static bool same_picture(const ProbedPicture *a, const ProbedPicture *b)
{
    return same_state(&a->particles, &b->particles) && a->target.number == b->target.number &&
           a->scalar == b->scalar && a->name == b->name && a->by_fluid == b->by_fluid &&
           same_camera(&a->sight.camera, &b->sight.camera);
}

void picture_probe_set(PictureProbe *probe, const ParticleBuffers *particles, const Frame *frame,
                       unsigned uniforms)
{
    const ProbedPicture now = {.particles = *particles,
                               .target = *frame->target,
                               .uniforms = uniforms,
                               .scalar = view_color_by(frame->def),
                               .by_fluid = frame->colors.by_fluid,
                               .kernel = plane_kernel_of(0, frame->world),
                               .sight = {frame->camera, particles->box, frame->width, frame->height, 0},
                               .name =
                                   frame->colors.by_fluid ? scalar_name(SCALAR_FLUID) : frame->colors.name,
                               .unit = frame->colors.by_fluid ? "" : frame->colors.unit,
                               .world = frame->world};
    const uint64_t number = probe->picture.number;
    const bool same = probe->drawn && same_picture(&probe->picture, &now);
    probe->picture = now;
    probe->picture.number = same ? number : number + 1;
    probe->drawn = true;
}

void picture_probe_clear(PictureProbe *probe)
{
    probe->drawn = false;
}

void picture_probe_destroy(PictureProbe *probe)
{
    particle_probe_destroy(&probe->particles);
    *probe = (PictureProbe){.drawn = false};
}

bool picture_probe_can(const PictureProbe *probe, const View *view, const ViewDef *def, const double pixel[2])
{
    double at[3];
    if (!probe->drawn)
        return false;
    return view_kind(view)->probe ? view_pick(view, pixel, at)
                                  : view_probing(view, def).by != VIEW_PROBE_NOTHING;
}

static bool is_at(const ViewProbe *probe, const double at[3])
{
    return probe->at[0] == at[0] && probe->at[1] == at[1] && probe->at[2] == at[2];
}

/* For the mouse, asks for the position that the view shows at the pixel. */
static bool ask_view(View *view, const ViewProbeRequest *asks, ViewProbeAnswers *out)
{
    double at[VIEW_PROBES_MAX][3];
    int count = asks->count;
    memcpy(at, asks->at, sizeof at);
    out->asked = true;
    out->placed = out->mouse = asks->mouse && view_pick(view, asks->pixel, at[count]);
    if (out->placed)
        memcpy(out->place, at[count], sizeof out->place);
    count += out->mouse;
    const int known = count ? view_probe(view, (const double(*)[3])at, count, out->probe) : 0;
    if (known < 0)
        return false;
    out->count = known;
    out->mouse &= known == count;
    out->now = known == count;
    for (int i = 0; i < known; i++)
        out->now &= out->probe[i].now && is_at(&out->probe[i], at[i]);
    return true;
}

bool picture_probe_request(PictureProbe *probe, View *view, const ViewDef *def, const ViewProbeRequest *asks,
                           ViewProbeAnswers *out)
{
    *out = (ViewProbeAnswers){.count = 0};
    if (!probe->drawn)
        return false;
    if (view_kind(view)->probe)
        return ask_view(view, asks, out);
    probe->picture.how = view_probing(view, def);
    if (probe->picture.how.by == VIEW_PROBE_NOTHING)
        return false;
    particle_probe_request(&probe->particles, &probe->picture, asks, out);
    return true;
}
