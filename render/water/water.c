#include "render/water/water.h"

#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "shaders/water/foam_bindings.h"
#include "sim/gpu/program.h"

#include <epoxy/gl.h>
#include <math.h>

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

void caustics_destroy(Caustics *caustics)
{
    for (int i = 0; i < 4; i++)
        glDeleteProgram(caustics->programs[i]);
    glDeleteVertexArrays(1, &caustics->vertex_array);
    glDeleteTextures(CAUSTIC_MAPS, caustics->maps);
    glDeleteFramebuffers(CAUSTIC_MAPS, caustics->framebuffers);
    *caustics = (Caustics){0};
}

bool caustics_wanted(const Frame *frame)
{
    return frame->def->caustics && frame->clear > 0 && frame->floor_radius > 0 && !(frame->slab > 0) &&
           frame->def->drawn_quality != VIEW_DRAFT;
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
        const double reach = SMOOTHED * spacing * CAUSTIC_TEXELS / frame->floor_map_size[k];
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
    const double bottom = particles->box.position[1] - frame->floor_height;
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
    glProgramUniform1f(program, REFRACTION_INDEX_AT, frame->refraction);
    glProgramUniform1f(program, CAUSTIC_HIGHEST_AT, (float)highest_surface(frame, particles));
    glDrawArrays(GL_POINTS, 0, CAUSTIC_TEXELS * CAUSTIC_TEXELS);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame,
                       unsigned shadow_left)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, CAUSTIC_TEXELS, CAUSTIC_TEXELS);
    glBindVertexArray(caustics->vertex_array);
    draw_light_map(caustics, FIND, 0, CAUSTIC_HEIGHT);
    smooth_heights(caustics, frame, particles->spacing);
    gather_light(caustics, frame, particles);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, shadow_left);
    draw_light_map(caustics, COMPOSE, caustics->maps[CAUSTIC_FACTOR], CAUSTIC_LIGHT);
    return caustics->maps[CAUSTIC_LIGHT];
}

/* m/s, at ViewDef.foam 1: speeds where foam starts and is complete. Turbulence of about a metre per second
   breaks a water surface against weight and tension: Brocchini and Peregrine, The dynamics of strong
   turbulence at free surfaces, 2001. */
static const double AIR_FROM = 0.15, AIR_TO = 0.55, SPEED_FROM = 0.2, SPEED_TO = 0.8;

bool foam_create(Foam *foam, Error *error)
{
    static const char *const list[] = {"water/foam_list.comp", NULL};
    static const char *const draw[] = {"water/foam.vert", "water/foam.frag", NULL};
    if (foam->list)
        return foam->draw[1] != 0;
    foam->list = program_create("foam list", list, NULL, error);
    for (int solids = 0; solids < 2; solids++)
        if (!foam->list ||
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

void foam_destroy(Foam *foam)
{
    glDeleteProgram(foam->list);
    glDeleteProgram(foam->draw[0]);
    glDeleteProgram(foam->draw[1]);
    glDeleteVertexArrays(1, &foam->vertex_array);
    glDeleteBuffers(2, (GLuint[]){foam->listed, foam->command});
    delete_copies(foam);
    *foam = (Foam){0};
}

double foam_slowest(const ViewDef *def)
{
    return SPEED_FROM / def->foam;
}

void foam_want(ParticleWants *wants)
{
    wants->attributes |= PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_ID);
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

void foam_begin(Foam *foam, const Frame *frame)
{
    update_copies(foam, frame);
    if (frame->world->solid_count > 0)
        copy_depth(&foam->solid, frame, "foam, solids");
}

/* ---- bubbles ---- */

static void list(Foam *foam, const ParticleBuffers *particles, const Frame *frame)
{
    const double scale = 1 / frame->def->foam;
    if (particles->count > foam->capacity) {
        foam->capacity = work_capacity(foam->capacity, particles->count);
        work_buffer_remake(&foam->listed, foam->capacity * 2 * sizeof(GLuint), "foam list");
    }
    particle_bind(foam->list, particles, SCALAR_TRAPPED_AIR);
    glUseProgram(foam->list);
    glUniform1ui(FOAM_COUNT_AT, (GLuint)particles->count);
    glUniform4f(FOAM_SPEEDS_AT, (float)(scale * AIR_FROM), (float)(scale * AIR_TO),
                (float)(scale * SPEED_FROM), (float)(scale * SPEED_TO));
    glUniform1ui(FOAM_VELOCITY_STRIDE_AT,
                 particle_bind_one(FOAM_VELOCITIES_STORAGE, &particles->velocity, particles->count, 0));
    glUniform1ui(FOAM_MOST_AT, FOAM_MOST);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_LIST_STORAGE, foam->listed);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_COMMAND_STORAGE, foam->command);
    work_dispatch(1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void foam_draw(Foam *foam, const ParticleBuffers *state, const ParticleAttribute *air, const Frame *frame)
{
    ParticleBuffers with = *state;
    const ParticleBuffers *const particles = &with;
    const bool solids = frame->world->solid_count > 0;
    const GLuint program = foam->draw[solids];
    with.scalar[SCALAR_TRAPPED_AIR] = *air;
    if (particles->count == 0 || !air->buffer || !particles->velocity.buffer)
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

enum { VERTICES = 36 };

bool glass_create(Glass *glass, Error *error)
{
    if (glass->program)
        return true;
    if (!glass->vertex_array)
        glCreateVertexArrays(1, &glass->vertex_array);
    glass->program = program_create_pair("glass", "render/glass.vert", "render/glass.frag", error);
    return glass->program != 0;
}

void glass_destroy(Glass *glass)
{
    glDeleteProgram(glass->program);
    glDeleteVertexArrays(1, &glass->vertex_array);
    *glass = (Glass){0};
}

void glass_draw(const Glass *glass, const Frame *frame, bool behind)
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
