#include "render/water/foam_private.h"

#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "render/water/water.h"
#include "shaders/shared/bindings.h"
#include "shaders/water/foam_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

typedef struct Foam {
    FoamLife life;
    Selection list;
    unsigned draw[2]; /* programs: without and with solids */
    unsigned vertex_array;
    unsigned listed, command; /* buffers */
    size_t capacity;          /* capacity of `listed`, particles */
    unsigned surface, solid;  /* textures: copies of the target's depth */
    unsigned target_number;   /* number of the target that gave the textures their size */
} Foam;

static bool foam_create(Foam *foam, Error *error)
{
    static const char *const draw[] = {"water/foam.vert", "water/foam.frag", NULL};
    if (foam->list.mark)
        return foam->draw[1] != 0;
    const bool lists = foam_life_create(&foam->life, error) &&
                       selection_create(&foam->list, "foam list", "water/foam_list.comp", error);
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
    foam_life_destroy(&foam->life);
    selection_destroy(&foam->list);
    glDeleteProgram(foam->draw[0]);
    glDeleteProgram(foam->draw[1]);
    glDeleteVertexArrays(1, &foam->vertex_array);
    glDeleteBuffers(2, (GLuint[]){foam->listed, foam->command});
    delete_copies(foam);
}

static const EffectState foam_state = {
    .size = sizeof(Foam), .prepare = foam_prepare, .destroy = foam_destroy};

static void foam_want(const ViewDef *def, ParticleWants *wants)
{
    if (!view_has_foam(def))
        return;
    wants->attributes |= PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_ID);
    wants->foam = true;
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

/* ---- life ---- */

/* m/s, at ViewDef.foam 1: turbulence and speed where foam starts and is complete. Turbulence of about a
   metre per second breaks a water surface against weight and tension: Brocchini and Peregrine, The dynamics
   of strong turbulence at free surfaces, 2001. Turbulence here is of a particle's neighbours alone. In a dam
   that falls it is below the first number. */
static const double TURBULENT_FROM = 0.15, TURBULENT_TO = 0.35, SPEED_FROM = 0.2, SPEED_TO = 0.8;

/* Spacings in a box's diagonal. With fewer, neighbours in smooth flow differ by more speed, by ripples of
   the particles' rows: the bounds of turbulence grow. */
static const double FINE_ENOUGH = 80, MORE_WITH = 1.7 /* power of the spacing */, COARSEST = 3.2;

bool foam_life_create(FoamLife *life, Error *error)
{
    const char *const file[] = {"water/foam_life.comp", NULL};
    life->recall = program_create("old foam", file, "#define RECALL 1\n", error);
    life->update = life->recall ? program_create("foam", file, NULL, error) : 0;
    return life->update != 0;
}

void foam_life_destroy(FoamLife *life)
{
    glDeleteProgram(life->recall);
    glDeleteProgram(life->update);
    glDeleteBuffers(2, (GLuint[]){life->amounts, life->table});
    *life = (FoamLife){0};
}

static void run_life(const FoamLife *life, unsigned program, const ParticleBuffers *particles)
{
    particle_bind(program, particles, SCALAR_TRAPPED_AIR);
    particle_bind_ids(program, particles);
    glUniform1ui(FOAM_PARTICLES_AT, (GLuint)particles->count);
    glUniform1ui(FOAM_SLOTS_AT, (GLuint)life->slots);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_AMOUNTS_STORAGE, life->amounts);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_TABLE_STORAGE, life->table);
    work_run(particles->count);
}

static void clear(unsigned buffer)
{
    glClearNamedBufferData(buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

void foam_life_recall(FoamLife *life, const ParticleBuffers *particles)
{
    const double gone = particles->time - life->time;
    const bool known = life->slots && particles->scalar[SCALAR_ID].buffer && gone >= 0;
    if (particles->count > life->capacity) {
        life->capacity = work_capacity(life->capacity, particles->count);
        work_buffer_remake(&life->amounts, life->capacity * sizeof(GLfloat), "foam");
    }
    if (!known) {
        clear(life->amounts);
        return;
    }
    glUseProgram(life->recall);
    glUniform1f(FOAM_LEFT_AT, (float)exp(-gone / FOAM_LIFE));
    run_life(life, life->recall, particles);
}

static void empty_table(FoamLife *life, size_t count)
{
    size_t slots = 64;
    while (slots < 2 * count)
        slots *= 2;
    if (life->slots != slots)
        work_buffer_remake(&life->table, slots * 2 * sizeof(GLuint), "foam by id");
    life->slots = slots;
    clear(life->table);
}

static double coarse_by(const ParticleBuffers *particles)
{
    const double *size = particles->box_size;
    const double diagonal = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    return fmin(pow(fmax(1, FINE_ENOUGH * particles->spacing / diagonal), MORE_WITH), COARSEST);
}

void foam_life_update(FoamLife *life, const ParticleBuffers *particles, double foam)
{
    const double scale = 1 / foam, least = coarse_by(particles) * scale;
    empty_table(life, particles->count);
    glUseProgram(life->update);
    glUniform4f(FOAM_SPEEDS_AT, (float)(least * TURBULENT_FROM), (float)(least * TURBULENT_TO),
                (float)(scale * SPEED_FROM), (float)(scale * SPEED_TO));
    glUniform1ui(FOAM_VELOCITY_STRIDE_AT,
                 particle_bind_one(FOAM_VELOCITIES_STORAGE, &particles->velocity, particles->count, 0));
    run_life(life, life->update, particles);
    life->time = particles->time;
}

/* ---- bubbles ---- */

static void set_list(unsigned program, const void *user)
{
    const Foam *foam = user;
    (void)program;
    glUniform1ui(FOAM_MOST_AT, FOAM_MOST);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_AMOUNTS_STORAGE, foam->life.amounts);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_LIST_STORAGE, foam->listed);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FOAM_COMMAND_STORAGE, foam->command);
}

static void list(Foam *foam, size_t count)
{
    if (count > foam->capacity) {
        foam->capacity = work_capacity(foam->capacity, count);
        work_buffer_remake(&foam->listed, foam->capacity * 2 * sizeof(GLuint), "foam list");
    }
    selection_run(&foam->list, count, set_list, foam);
}

static void foam_draw(Foam *foam, const ParticleBuffers *particles, const Frame *frame)
{
    const GLuint program = foam->draw[frame->world->solid_count > 0];
    update_copies(foam, frame);
    copy_depth(&foam->surface, frame, "foam, surface");
    list(foam, particles->count);
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

/* Returns false if the state lacks the inputs. */
static bool find_foam(FoamLife *life, const Picture *picture)
{
    const Frame *frame = &picture->frame;
    ParticleBuffers with = *picture->particles;
    DerivedSpace space = {.flat = frame->slab > 0};
    memcpy(space.periodic, frame->world->periodic, sizeof space.periodic);
    foam_life_recall(life, &with);
    with.scalar[SCALAR_TRAPPED_AIR] =
        derived_foam(picture->derived, &space, &with, SPEED_FROM / frame->def->foam, life->amounts);
    if (!with.scalar[SCALAR_TRAPPED_AIR].buffer)
        return false;
    foam_life_update(life, &with, frame->def->foam);
    return true;
}

/* Draws nothing if the state lacks the inputs. */
static void draw_foam(void *state, Picture *picture)
{
    Foam *foam = state;
    bool found = false;
    if (picture->particles->count == 0)
        return;
    GL_STAGE(picture->frame.timer, STAGE_SCALARS)
    {
        found = find_foam(&foam->life, picture);
    }
    GL_STAGE(picture->frame.timer, STAGE_FOAM)
    {
        if (found)
            foam_draw(foam, picture->particles, &picture->frame);
    }
}

const Effect effect_foam = {.name = "foam",
                            .stage = STAGE_COUNT,
                            .state = &foam_state,
                            .want = foam_want,
                            .wanted = foam_wanted,
                            .draw = draw_foam};
