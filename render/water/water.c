#include "render/water/water.h"

#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "shaders/water/foam_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

enum { FIND, SMOOTH, GATHER, COMPOSE };

static const double SMOOTHED = 6; /* half the width in spacings; three standard deviations of the weights */

static void create_light_map(Caustics *caustics, int map, GLenum format, const char *label)
{
    GLuint *texture = &caustics->maps[map], *framebuffer = &caustics->framebuffers[map];
    glCreateTextures(GL_TEXTURE_2D, 1, texture);
    glObjectLabel(GL_TEXTURE, *texture, -1, label);
    glTextureStorage2D(*texture, 1, format, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glTextureParameteri(*texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(*texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(*texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glCreateFramebuffers(1, framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, *framebuffer, -1, label);
    glNamedFramebufferTexture(*framebuffer, GL_COLOR_ATTACHMENT0, *texture, 0);
}

bool caustics_create(Caustics *caustics, Error *error)
{
    static const char *const files[4][2] = {{"common/screen.vert", "water/caustics_height.frag"},
                                            {"common/screen.vert", "water/caustics_smooth.frag"},
                                            {"water/caustics.vert", "water/caustics.frag"},
                                            {"common/screen.vert", "water/caustics_light.frag"}};
    if (caustics->vertex_array)
        return caustics->programs[COMPOSE] != 0;
    glCreateVertexArrays(1, &caustics->vertex_array);
    create_light_map(caustics, CAUSTIC_HEIGHT, GL_RGBA32F, "caustics, height");
    create_light_map(caustics, CAUSTIC_SMOOTH, GL_RGBA32F, "caustics, smooth height");
    create_light_map(caustics, CAUSTIC_FACTOR, GL_R32F, "caustics");
    create_light_map(caustics, CAUSTIC_LIGHT, GL_R32F, "floor light");
    for (int i = 0; i < 4; i++)
        if (!(caustics->programs[i] = program_create_pair("caustics", files[i][0], files[i][1], error)))
            return false;
    return true;
}

void caustics_destroy(void *state)
{
    Caustics *caustics = state;
    for (int i = 0; i < 4; i++)
        glDeleteProgram(caustics->programs[i]);
    glDeleteVertexArrays(1, &caustics->vertex_array);
    glDeleteTextures(CAUSTIC_MAPS, caustics->maps);
    glDeleteFramebuffers(CAUSTIC_MAPS, caustics->framebuffers);
    *caustics = (Caustics){0};
}

static void draw_light_map(const Caustics *caustics, int program, unsigned from, int to)
{
    glBindFramebuffer(GL_FRAMEBUFFER, caustics->framebuffers[to]);
    glBindTextureUnit(CAUSTIC_UNIT, from);
    glUseProgram(caustics->programs[program]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static void smooth_heights(const Caustics *caustics, const Frame *frame, double spacing)
{
    const GLuint program = caustics->programs[SMOOTH];
    for (int k = 0; k < 2; k++) {
        const double reach = SMOOTHED * spacing * CAUSTIC_TEXELS / frame->floor.map_size[k];
        glProgramUniform2i(program, CAUSTIC_STEP_AT, k == 0, k == 1);
        glProgramUniform1f(program, CAUSTIC_WIDTH_AT, (float)fmax(reach, 1));
        draw_light_map(caustics, SMOOTH, caustics->maps[k == 0 ? CAUSTIC_HEIGHT : CAUSTIC_SMOOTH],
                       k == 0 ? CAUSTIC_SMOOTH : CAUSTIC_HEIGHT);
    }
}

/* Twice the height above the floor that the fluid would have at rest, m. */
static double highest_surface(const Frame *frame, const ParticleBuffers *particles)
{
    const double *box = particles->box_size, side = particles->spacing;
    const double bottom = particles->box.position[1] - frame->floor.height;
    return fmax(bottom, 0) + 2 * (double)particles->count * side * side * side / (box[0] * box[2]);
}

/* Adds up the light of all points. */
static void gather_light(const Caustics *caustics, const Frame *frame, const ParticleBuffers *particles)
{
    static const float nothing[4] = {0};
    const GLuint program = caustics->programs[GATHER];
    glClearNamedFramebufferfv(caustics->framebuffers[CAUSTIC_FACTOR], GL_COLOR, 0, nothing);
    glBindFramebuffer(GL_FRAMEBUFFER, caustics->framebuffers[CAUSTIC_FACTOR]);
    glBindTextureUnit(CAUSTIC_UNIT, caustics->maps[CAUSTIC_HEIGHT]);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glUseProgram(program);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, frame->fluid.refraction);
    glProgramUniform1f(program, CAUSTIC_HIGHEST_AT, (float)highest_surface(frame, particles));
    glDrawArrays(GL_POINTS, 0, CAUSTIC_TEXELS * CAUSTIC_TEXELS);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glBindVertexArray(caustics->vertex_array);
    draw_light_map(caustics, FIND, 0, CAUSTIC_HEIGHT);
    smooth_heights(caustics, frame, particles->spacing);
    gather_light(caustics, frame, particles);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
    draw_light_map(caustics, COMPOSE, caustics->maps[CAUSTIC_FACTOR], CAUSTIC_LIGHT);
    return caustics->maps[CAUSTIC_LIGHT];
}

static bool caustics_prepare(void *state, const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    const bool needed =
        def->caustics && view_shows_clear_fluid(def) && def->drawn_quality != VIEW_DRAFT && def->floor;
    return !needed || caustics_create(state, error);
}

static bool caustics_wanted(const Picture *picture)
{
    const Frame *frame = &picture->frame;
    return picture->particles->count > 0 && frame->def->caustics && frame->fluid.clear > 0 &&
           frame->floor.radius > 0 && !(frame->slab > 0) && frame->def->drawn_quality != VIEW_DRAFT;
}

static void draw_caustics(void *state, Picture *picture)
{
    Frame *frame = &picture->frame;
    frame->floor.light = caustics_draw(state, picture->particles, frame);
}

static const EffectState caustics_state = {
    .size = sizeof(Caustics), .prepare = caustics_prepare, .destroy = caustics_destroy};

const Effect effect_caustics = {.name = "caustics",
                                .stage = STAGE_SHADOW,
                                .state = &caustics_state,
                                .wanted = caustics_wanted,
                                .draw = draw_caustics};

/* ---- foam ---- */

typedef struct Foam {
    Selection list;
    unsigned draw[2]; /* programs: without and with solids */
    unsigned vertex_array;
    unsigned listed, command; /* buffers */
    size_t capacity;          /* capacity of `listed`, particles */
    unsigned surface, solid;  /* textures: copies of the target's depth */
    unsigned target_number;   /* number of the target that gave the textures their size */
} Foam;

/* m/s, at ViewDef.foam 1: speeds where foam starts and is complete. Turbulence of about a metre per second
   breaks a water surface against weight and tension: Brocchini and Peregrine, The dynamics of strong
   turbulence at free surfaces, 2001. */
static const double AIR_FROM = 0.15, AIR_TO = 0.55, SPEED_FROM = 0.2, SPEED_TO = 0.8;

/* Spacings in a box's diagonal. With fewer, neighbours in smooth flow, as in a falling dam, differ by more
   speed, by strain and by ripples of the particles' rows: the speeds of trapped air grow. */
static const double FINE_ENOUGH = 80, MORE_WITH = 1.7 /* power of the spacing */, COARSEST = 3.2;

static bool foam_create(Foam *foam, Error *error)
{
    static const char *const draw[] = {"water/foam.vert", "water/foam.frag", NULL};
    if (foam->list.mark)
        return foam->draw[1] != 0;
    const bool lists = selection_create(&foam->list, "foam list", "water/foam_list.comp", error);
    for (int solids = 0; solids < 2; solids++)
        if (!lists ||
            !(foam->draw[solids] = program_create("foam", draw, solids ? "#define SOLIDS 1\n" : NULL, error)))
            return false;
    glCreateVertexArrays(1, &foam->vertex_array);
    glObjectLabel(GL_VERTEX_ARRAY, foam->vertex_array, -1, "foam");
    work_buffer_remake(&foam->command, 5 * sizeof(GLuint), "foam command");
    return true;
}

static void delete_copies(Foam *foam)
{
    glDeleteTextures(2, (GLuint[]){foam->surface, foam->solid});
    foam->surface = foam->solid = foam->target_number = 0;
}

static bool foam_prepare(void *state, const Subject *subject, Error *error)
{
    return !view_has_foam(subject->def) || foam_create(state, error);
}

static void foam_destroy(void *state)
{
    Foam *foam = state;
    selection_destroy(&foam->list);
    glDeleteProgram(foam->draw[0]);
    glDeleteProgram(foam->draw[1]);
    glDeleteVertexArrays(1, &foam->vertex_array);
    glDeleteBuffers(2, (GLuint[]){foam->listed, foam->command});
    delete_copies(foam);
}

static const EffectState foam_state = {
    .size = sizeof(Foam), .prepare = foam_prepare, .destroy = foam_destroy};

/* The trapped air is derived when drawn, since foam needs only that of fast particles. */
static void foam_want(const ViewDef *def, ParticleWants *wants)
{
    if (!view_has_foam(def))
        return;
    wants->attributes |= PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_ID);
    wants->drawn_scalars |= SCALAR_BIT(SCALAR_TRAPPED_AIR);
}

/* A picture without a clear fluid surface (an intermediate stage of the view) has no foam. */
static bool foam_wanted(const Picture *picture)
{
    const Frame *frame = &picture->frame;
    return view_has_foam(frame->def) && frame->fluid.clear > 0 && !(frame->slab > 0);
}

/* ---- depths ---- */

/* A copy: a pass may not read the texture that its depth test uses. */
static void copy_depth(GLuint *copy, const Frame *frame, const char *label)
{
    const Target *target = frame->target;
    if (!*copy) {
        glCreateTextures(GL_TEXTURE_2D, 1, copy);
        glObjectLabel(GL_TEXTURE, *copy, -1, label);
        glTextureStorage2D(*copy, 1, GL_DEPTH_COMPONENT32F, target->width, target->height);
        glTextureParameteri(*copy, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(*copy, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    glCopyImageSubData(target->depth, GL_TEXTURE_2D, 0, 0, 0, 0, *copy, GL_TEXTURE_2D, 0, 0, 0, 0,
                       target->width, target->height, 1);
}

static void update_copies(Foam *foam, const Frame *frame)
{
    if (foam->target_number != frame->target->number)
        delete_copies(foam);
    foam->target_number = frame->target->number;
}

static bool foam_solids_wanted(const Picture *picture)
{
    return foam_wanted(picture) && picture->frame.world->solid_count > 0;
}

static void draw_foam_solids(void *state, Picture *picture)
{
    Foam *foam = state;
    update_copies(foam, &picture->frame);
    copy_depth(&foam->solid, &picture->frame, "foam, solids");
}

const Effect effect_foam_solids = {.name = "foam_solids",
                                   .stage = STAGE_FOAM,
                                   .state = &foam_state,
                                   .wanted = foam_solids_wanted,
                                   .draw = draw_foam_solids};

/* ---- bubbles ---- */

typedef struct FoamInput {
    const Foam *foam;
    const ParticleBuffers *particles;
    double scale;  /* of the speeds */
    double coarse; /* of the speeds of trapped air, too; at least 1 */
} FoamInput;

static double coarse_by(const ParticleBuffers *particles)
{
    const double *size = particles->box_size;
    const double diagonal = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    return fmin(pow(fmax(1, FINE_ENOUGH * particles->spacing / diagonal), MORE_WITH), COARSEST);
}

static void set_list(unsigned program, const void *user)
{
    const FoamInput *in = user;
    particle_bind(program, in->particles, SCALAR_TRAPPED_AIR);
    const double air = in->coarse * in->scale;
    glUniform4f(FOAM_SPEEDS_AT, (float)(air * AIR_FROM), (float)(air * AIR_TO),
                (float)(in->scale * SPEED_FROM), (float)(in->scale * SPEED_TO));
    glUniform1ui(FOAM_VELOCITY_STRIDE_AT, particle_bind_one(FOAM_VELOCITIES_STORAGE, &in->particles->velocity,
                                                            in->particles->count, 0));
    glUniform1ui(FOAM_MOST_AT, FOAM_MOST);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_LIST_STORAGE, in->foam->listed);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_COMMAND_STORAGE, in->foam->command);
}

static void list(Foam *foam, const ParticleBuffers *particles, const Frame *frame)
{
    if (particles->count > foam->capacity) {
        foam->capacity = work_capacity(foam->capacity, particles->count);
        work_buffer_remake(&foam->listed, foam->capacity * 2 * sizeof(GLuint), "foam list");
    }
    selection_run(&foam->list, particles->count, set_list,
                  &(FoamInput){foam, particles, 1 / frame->def->foam, coarse_by(particles)});
}

/* Draws nothing if the state lacks the inputs. `particles` has SCALAR_TRAPPED_AIR of fast particles. */
static void foam_draw(Foam *foam, const ParticleBuffers *particles, const Frame *frame)
{
    const GLuint program = foam->draw[frame->world->solid_count > 0];
    if (particles->count == 0 || !particles->scalar[SCALAR_TRAPPED_AIR].buffer || !particles->velocity.buffer)
        return;
    update_copies(foam, frame);
    copy_depth(&foam->surface, frame, "foam, surface");
    list(foam, particles, frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(foam->vertex_array);
    glUseProgram(program);
    particle_bind(program, particles, SCALAR_TRAPPED_AIR);
    particle_bind_ids(program, particles);
    glBindTextureUnit(FOAM_SURFACE_UNIT, foam->surface);
    glBindTextureUnit(FOAM_SOLID_UNIT, foam->solid);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, foam->command);
    glDrawArraysIndirect(GL_POINTS, NULL);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

static ParticleAttribute find_air(const Picture *picture)
{
    const Frame *frame = &picture->frame;
    DerivedSpace space = {.flat = frame->slab > 0};
    memcpy(space.periodic, frame->world->periodic, sizeof space.periodic);
    return derived_trapped_air(picture->derived, &space, picture->particles, SPEED_FROM / frame->def->foam);
}

static void draw_foam(void *state, Picture *picture)
{
    ParticleBuffers with = *picture->particles;
    GL_STAGE(picture->frame.timer, STAGE_SCALARS)
    {
        with.scalar[SCALAR_TRAPPED_AIR] = find_air(picture);
    }
    GL_STAGE(picture->frame.timer, STAGE_FOAM)
    {
        foam_draw(state, &with, &picture->frame);
    }
}

const Effect effect_foam = {.name = "foam",
                            .stage = STAGE_COUNT,
                            .state = &foam_state,
                            .want = foam_want,
                            .wanted = foam_wanted,
                            .draw = draw_foam};

/* ---- glass ---- */

enum { VERTICES = 36 };

typedef struct Glass {
    unsigned program; /* 0: not created yet */
    unsigned vertex_array;
} Glass;

/* Also for a draft, which may end at any time. */
static bool glass_prepare(void *state, const Subject *subject, Error *error)
{
    Glass *glass = state;
    if (!view_has_glass(subject->def) || glass->program)
        return true;
    if (!glass->vertex_array)
        glCreateVertexArrays(1, &glass->vertex_array);
    glass->program = program_create_pair("glass", "render/glass.vert", "render/glass.frag", error);
    return glass->program != 0;
}

static void glass_destroy(void *state)
{
    const Glass *glass = state;
    glDeleteProgram(glass->program);
    glDeleteVertexArrays(1, &glass->vertex_array);
}

static bool glass_wanted(const Picture *picture)
{
    return frame_glass(&picture->frame) == GLASS_PANES;
}

/* Draws the panes that face away from the eye, or towards the eye. Blends colour; tests depth but writes
   none. */
static void glass_draw(const Glass *glass, const Frame *frame, bool behind)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glUseProgram(glass->program);
    glProgramUniform1ui(glass->program, EDGES_BEHIND_AT, behind);
    glBindVertexArray(glass->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, VERTICES);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static void draw_behind(void *state, Picture *picture)
{
    glass_draw(state, &picture->frame, true);
}

static void draw_before(void *state, Picture *picture)
{
    glass_draw(state, &picture->frame, false);
}

static const EffectState glass_state = {
    .size = sizeof(Glass), .prepare = glass_prepare, .destroy = glass_destroy};

const Effect effect_glass_behind = {.name = "glass_behind",
                                    .stage = STAGE_OVERLAY,
                                    .state = &glass_state,
                                    .wanted = glass_wanted,
                                    .draw = draw_behind};

const Effect effect_glass = {.name = "glass",
                             .stage = STAGE_OVERLAY,
                             .state = &glass_state,
                             .wanted = glass_wanted,
                             .draw = draw_before};
