#include "render/particles/particles.h"
#include "render/views/splat/splat_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

bool ellipsoids_create(Ellipsoids *ellipsoids, const SplatDef *def, Error *error)
{
    const bool stretched = ellipsoids_stretched(def);
    const char *const shapes[] = {stretched ? "splat/ellipsoids.comp" : "splat/drops.comp", NULL};
    const char *const sizes[] = {"render/particle_curve.comp", NULL};
    *ellipsoids = (Ellipsoids){.def = *def};
    if (def->sized) {
        ellipsoids->scale = program_create("splat sizes", sizes,
                                           stretched                 ? "#define ELLIPSOID 1\n"
                                           : ellipsoids_crowded(def) ? ELLIPSOIDS_LEAST "#define SCALED 1\n"
                                                                     : ELLIPSOIDS_LEAST,
                                           error);
        if (!ellipsoids->scale)
            return false;
    }
    if (!ellipsoids_crowded(def))
        return true;
    ellipsoids->program = program_create("splat shapes", shapes, NULL, error);
    return ellipsoids->program != 0;
}

void ellipsoids_destroy(Ellipsoids *ellipsoids)
{
    glDeleteProgram(ellipsoids->program);
    glDeleteProgram(ellipsoids->scale);
    glDeleteBuffers(1, &ellipsoids->shapes);
    *ellipsoids = (Ellipsoids){0};
}

static void reserve_shapes(Ellipsoids *ellipsoids, size_t count)
{
    const size_t floats = ellipsoids_stretched(&ellipsoids->def) ? 12 : 1;
    if (count <= ellipsoids->capacity)
        return;
    ellipsoids->capacity = work_capacity(ellipsoids->capacity, count);
    work_buffer_remake(&ellipsoids->shapes, ellipsoids->capacity * floats * sizeof(GLfloat), "splat shapes");
}

/* A particle with at least this sum of weights belongs to the fluid: a quarter of the sum in a lattice,
   less than at a lattice corner or in a sheet one particle thick. The integral of 1 - q^3 over the ball,
   minus the particle itself. */
static double full_sum(const ParticleBuffers *particles, bool flat)
{
    static const double pi = 3.14159265358979323846;
    const double q = particles->support_radius / particles->spacing;
    return 0.25 * fmax(flat ? 0.6 * pi * q * q - 1 : 2 * pi / 3 * q * q * q - 1, 1);
}

/* Radius of a one-particle drop; of a disc in two dimensions. */
static double drop_radius(const ParticleBuffers *particles, bool flat)
{
    return particles->spacing * (flat ? 0.5641896 : 0.6203505); /* pi r^2 = 1; 4/3 pi r^3 = 1 */
}

double ellipsoids_size_factor(const ViewDef *def, const ParticleBuffers *particles)
{
    return splat_def_resolved(def).sized ? fmax(particle_curves_reach(def, particles), 0.01) : 1;
}

static void make_crowded(Ellipsoids *ellipsoids, const ParticleBuffers *particles, const Frame *frame,
                         double unit)
{
    const bool flat = frame->slab > 0;
    const float radius = frame->radii.drawn;
    neighbourhood_build(frame->neighbourhood, particles);
    const float drop =
        ellipsoids->def.drops ? fminf((float)(unit * drop_radius(particles, flat)), radius) : radius;
    glProgramUniform1f(ellipsoids->program, SUPPORT_RADIUS_AT, (float)particles->support_radius);
    glProgramUniform1f(ellipsoids->program, FULL_SUM_AT, (float)full_sum(particles, flat));
    glProgramUniform1f(ellipsoids->program, CROWD_RADIUS_AT, radius);
    glProgramUniform1f(ellipsoids->program, DROP_RADIUS_AT, drop);
    if (ellipsoids_stretched(&ellipsoids->def))
        glProgramUniform1ui(ellipsoids->program, SLAB_AT, flat);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, ellipsoids->shapes);
    neighbourhood_run(frame->neighbourhood, ellipsoids->program);
}

void ellipsoids_make(Ellipsoids *ellipsoids, const ParticleBuffers *particles, const Frame *frame)
{
    const double unit = ellipsoids_size_factor(frame->def, particles);
    reserve_shapes(ellipsoids, particles->count);
    if (ellipsoids_crowded(&ellipsoids->def))
        make_crowded(ellipsoids, particles, frame, unit);
    if (!ellipsoids->scale || particles->count == 0)
        return;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, ellipsoids->shapes);
    particle_curve_run(ellipsoids->scale, &frame->def->size, frame->curves.size, unit, particles);
}

void ellipsoids_bind(const Ellipsoids *ellipsoids)
{
    if (ellipsoids_wanted(&ellipsoids->def))
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, ellipsoids->shapes);
}

bool splat_spray_create(SplatSpray *spray, const SplatSprites *sprites, const Subject *subject, Error *error)
{
    char defines[96];
    *spray = (SplatSpray){0};
    snprintf(defines, sizeof defines, "#define BLEND 1\n#define ALONE 1\n#define SHADING %d\n%s",
             (int)sprites->def.shading, subject->world->solid_count > 0 ? "#define SOLIDS 1\n" : "");
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        if (!splat_sprites_can_use(sprites, (SplatSprite)sprite))
            continue;
        spray->program[sprite] = splat_sprites_program(sprites, (SplatSprite)sprite, true,
                                                       "splat/clear/spray.frag", defines, error);
        if (!spray->program[sprite])
            return false;
    }
    work_buffer_remake(&spray->command, 8 * sizeof(GLuint), "spray command");
    return selection_create(&spray->find, "spray list", "splat/clear/spray_list.comp", error);
}

void splat_spray_destroy(SplatSpray *spray)
{
    selection_destroy(&spray->find);
    glDeleteBuffers(2, (GLuint[]){spray->list, spray->command});
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++)
        glDeleteProgram(spray->program[sprite]);
}

typedef struct SprayInput {
    const SplatSpray *spray;
    GLuint vertices; /* per particle */
} SprayInput;

static void set_list(unsigned program, const void *user)
{
    const SprayInput *in = user;
    (void)program;
    glUniform1ui(VERTICES_AT, in->vertices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, NEAREST_LIST_STORAGE, in->spray->list);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_COMMANDS_STORAGE, in->spray->command);
}

void splat_spray_find(SplatSpray *spray, SplatSprite sprite, const ParticleBuffers *particles)
{
    if (particles->count > spray->capacity) {
        spray->capacity = work_capacity(spray->capacity, particles->count);
        work_buffer_remake(&spray->list, spray->capacity * sizeof(GLuint), "spray list");
    }
    if (particles->count == 0)
        return;
    selection_run(&spray->find, particles->count, set_list,
                  &(SprayInput){spray, sprite == SPLAT_POINT ? 1 : 6});
}

void splat_spray_draw(const SplatSpray *spray, SplatSprayPart part, unsigned nearest,
                      BackgroundCopy *background, const BoxEdges *edges, SplatSprites *sprites,
                      SplatSprite sprite, const ParticleBuffers *particles, const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    const GLuint program = spray->program[sprite];
    background_copy_make(background, edges, frame);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, (float)def->ior);
    glProgramUniform1f(program, ATTENUATION_AT,
                       def->attenuation > 0 ? (float)def->attenuation : frame->fluid.attenuation);
    glProgramUniform1ui(program, SPRAY_BEHIND_AT, part == SPRAY_BEHIND);
    glBindTextureUnit(NEAREST_UNIT, nearest);
    splat_sprites_begin(frame->target->framebuffer, frame, GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(part == SPRAY_BEFORE);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LISTED_STORAGE, spray->list);
    splat_sprites_draw_listed(sprites, sprite, program, particles, frame, spray->command);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}
