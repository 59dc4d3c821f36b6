#include "render/splat/splat_sprites.h"

#include "render/splat/ellipsoids.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

bool splat_sprites_create(SplatSprites *sprites, const SplatDef *def, Error *error)
{
    *sprites = (SplatSprites){.def = *def, .point_limit = point_limit()};
    glCreateVertexArrays(1, &sprites->screen);
    quad_indices_create(&sprites->quads);
    char body[96];
    snprintf(body, sizeof body, "%s%s", ellipsoids_defines(def),
             silhouette_by_discs(def) ? "#define DISCS 1\n" : "");
    return fluid_tiles_create(&sprites->tiles, error) &&
           (!splat_culls(def) || cull_create(&sprites->cull, body, error));
}

void splat_sprites_destroy(SplatSprites *sprites)
{
    glDeleteVertexArrays(1, &sprites->screen);
    quad_indices_destroy(&sprites->quads);
    cull_destroy(&sprites->cull);
    fluid_tiles_destroy(&sprites->tiles);
}

bool splat_sprites_may(const SplatSprites *sprites, SplatSprite sprite)
{
    return sprites->def.sprite == sprite ||
           (sprites->def.sprite == SPLAT_AUTO && (sprite == SPLAT_QUAD || sprites->point_limit > 0));
}

/* An upper bound of the largest sphere's diameter in pixels, at the rim of the picture. */
SplatSprite splat_sprites_choose(const SplatSprites *sprites, const Frame *frame, float radius, float height)
{
    const float *tangent = frame->camera.tangent, slant = 1 + camera_slant_square(&frame->camera);
    if (sprites->def.sprite != SPLAT_AUTO)
        return sprites->def.sprite;
    if (sprites->point_limit <= 0 || frame->nearest <= radius)
        return SPLAT_QUAD;
    const float across = radius / frame->nearest * slant / tangent[1] * height + 1;
    return across < sprites->point_limit ? SPLAT_POINT : SPLAT_QUAD;
}

bool splat_sprites_small(const Frame *frame)
{
    const float pixels = 0.5F * (float)frame->height / frame->camera.tangent[1]; /* pixels of 1 m at a
                                                                                    distance of 1 m */
    const double spacings = frame->def->radius > 0 ? frame->def->radius : 1;
    const double drop =
        splat_def(frame->def)->drops ? fmin(0.56 / spacings, 1) : 1; /* a disc; a ball is larger */
    const ScalarCurve *size = &frame->def->size;
    const double most = fmax(control_points_most(&size->curve), 1e-30);
    const double least = size->by != 0 ? control_points_least(&size->curve) / most : 1;
    return least * drop * frame->particle_radius * pixels < 0.8F * frame->farthest;
}

unsigned splat_sprites_program(const SplatSprites *sprites, SplatSprite sprite, bool listed,
                               const char *fragment, const char *defines, Error *error)
{
    const char *const stages[] = {"splat/splat.vert", fragment, NULL};
    char all[256];
    snprintf(all, sizeof all, "%s%s%s%s", ellipsoids_defines(&sprites->def),
             sprite == SPLAT_POINT ? "#define POINT 1\n" : "", listed ? "#define LISTED 1\n" : "", defines);
    return program_create(fragment, stages, all, error);
}

static void bind(unsigned program, const ParticleBuffers *particles, const Frame *frame)
{
    glUseProgram(program);
    particle_bind(program, particles, view_color_by(frame->def));
}

void splat_sprites_draw_points(SplatSprites *sprites, unsigned program, const ParticleBuffers *particles,
                               const Frame *frame, const CullList *list)
{
    const size_t command = list ? cull_use(&sprites->cull, *list) : 0;
    bind(program, particles, frame);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(sprites->screen);
    if (particles->count == 0)
        return;
    if (!list) {
        glDrawArrays(GL_POINTS, 0, (GLsizei)particles->count);
        return;
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, sprites->cull.commands);
    glDrawArraysIndirect(GL_POINTS, (const char *)NULL + command);
}

static void draw_quads(SplatSprites *sprites, unsigned program, const ParticleBuffers *particles,
                       const Frame *frame, const CullList *list)
{
    const size_t command = list ? cull_use(&sprites->cull, *list) : 0;
    bind(program, particles, frame);
    if (list)
        quad_indices_draw_indirect(&sprites->quads, particles->count, sprites->cull.commands, command);
    else
        quad_indices_draw(&sprites->quads, particles->count);
}

void splat_sprites_draw(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                        const ParticleBuffers *particles, const Frame *frame, const CullList *list)
{
    if (sprite == SPLAT_POINT)
        splat_sprites_draw_points(sprites, program, particles, frame, list);
    else
        draw_quads(sprites, program, particles, frame, list);
}

void splat_sprites_draw_listed(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                               const ParticleBuffers *particles, const Frame *frame, unsigned command)
{
    bind(program, particles, frame);
    if (particles->count == 0)
        return;
    if (sprite == SPLAT_QUAD) {
        quad_indices_draw_indirect(&sprites->quads, particles->count, command, 0);
        return;
    }
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(sprites->screen);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command);
    glDrawArraysIndirect(GL_POINTS, NULL);
}

void splat_sprites_begin(unsigned framebuffer, const Frame *frame, unsigned equation)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(equation);
    glBlendFunc(GL_ONE, GL_ONE);
}
