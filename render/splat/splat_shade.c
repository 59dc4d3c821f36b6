#include "render/splat/splat_shade.h"

#include "render/splat/splat_def.h"
#include "render/splat/splat_sprites.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

static unsigned create_program(const SplatShade *shade, const Subject *subject, const char *more,
                               Error *error)
{
    const SplatDef *def = splat_def(subject->def);
    const bool solids = subject->world->solid_count > 0;
    static const char *const stages[] = {FLUID_TILES_VERTEX, "splat/splat_shade.frag", NULL};
    char defines[192];
    snprintf(defines, sizeof defines, "%s%s%s#define SHOW %d\n#define SHADING %d\n",
             solids ? "#define SOLIDS 1\n" : "#define SETTLED 1\n",
             shade->clear ? "#define FLOOR_SHADOW 1\n#define PANES 1\n" : "", more, (int)def->show,
             (int)def->shading);
    return program_create("splat shade", stages, defines, error);
}

static unsigned create_settle(Error *error)
{
    static const char *const stages[] = {FLUID_TILES_VERTEX, "splat/splat_settle.frag", NULL};
    return program_create("splat settle", stages, NULL, error);
}

bool splat_shade_create(SplatShade *shade, const Subject *subject, Error *error)
{
    const SplatDef *def = splat_def(subject->def);
    const bool discs = silhouette_by_discs(def);
    *shade = (SplatShade){.clear = splat_clear(def)};
    if (shade->clear && !edges_create(&shade->edges, error))
        return false;
    shade->program = create_program(shade, subject, "", error);
    if (shade->program && subject->world->solid_count == 0 && !(shade->settle = create_settle(error)))
        return false;
    if (shade->program && discs)
        shade->mixing = create_program(shade, subject, "#define MIXING 1\n", error);
    return discs ? shade->mixing != 0 : shade->program != 0;
}

void splat_shade_destroy(SplatShade *shade)
{
    glDeleteProgram(shade->program);
    glDeleteProgram(shade->mixing);
    glDeleteProgram(shade->settle);
    behind_destroy(&shade->behind);
    edges_destroy(&shade->edges);
}

/* Sets the extra inputs of a clear fluid's shading. */
static void look_through(SplatShade *shade, unsigned program, const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    behind_take(&shade->behind, &shade->edges, frame);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, (float)def->ior);
    glProgramUniform1f(program, ATTENUATION_AT,
                       def->attenuation > 0 ? (float)def->attenuation : frame->attenuation);
}

/* Blends partly covered pixels with the background. */
static void begin_mixing(const Frame *frame)
{
    glUniform1f(COVER_STEP_AT, (float)splat_def(frame->def)->eps * frame->particle_radius);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

/* Writes depths, so that tiles at depth 0 pass the test only on drawn pixels: a software driver then runs
   the shader only there. */
static void settle(const SplatShade *shade, const FluidTiles *tiles)
{
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glUseProgram(shade->settle);
    fluid_tiles_draw(tiles);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
}

void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, const Thickness *thickness,
                      const FluidTiles *tiles, const Frame *frame)
{
    const bool mixing = shade->mixing && splat_sprites_small(frame);
    const unsigned program = mixing ? shade->mixing : shade->program;
    if (shade->clear)
        look_through(shade, program, frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindTextureUnit(NEAREST_UNIT, maps->nearest);
    glBindTextures(COLOR_SUM_UNIT, 3, (GLuint[]){maps->color, maps->normal, maps->weight});
    glBindTextureUnit(THICKNESS_UNIT, thickness->map);
    glBindTextureUnit(FILLED_UNIT, thickness->filled);
    if (shade->settle)
        settle(shade, tiles);
    glUseProgram(program);
    glUniform1f(NEAREST_DEPTH_AT, fmaxf(frame->nearest, frame->camera.near_plane));
    glUniform1f(FARTHEST_DEPTH_AT, frame->farthest);
    if (mixing)
        begin_mixing(frame);
    fluid_tiles_draw(tiles);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}
