#include "render/clear/foam.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/clear/foam_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

/* m/s, at ViewDef.foam 1: speeds where foam starts and is complete. Turbulence of about a metre per second
   breaks a water surface against weight and tension: Brocchini and Peregrine, The dynamics of strong
   turbulence at free surfaces, 2001. */
static const double AIR_FROM = 0.15, AIR_TO = 0.55, SPEED_FROM = 0.2, SPEED_TO = 0.8;

bool foam_create(Foam *foam, Error *error)
{
    static const char *const list[] = {"clear/foam_list.comp", NULL};
    static const char *const draw[] = {"clear/foam.vert", "clear/foam.frag", NULL};
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

static void follow(Foam *foam, const Frame *frame)
{
    if (foam->target_number != frame->target->number)
        delete_copies(foam);
    foam->target_number = frame->target->number;
}

void foam_begin(Foam *foam, const Frame *frame)
{
    follow(foam, frame);
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
    follow(foam, frame);
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
