#include "render/views/splat/splat.h"

#include "render/views/splat/splat_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

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
    snprintf(defines, sizeof defines, "%s%s%s%s#define SHOW %d\n#define SHADING %d\n",
             solids ? "#define SOLIDS 1\n" : "#define SETTLED 1\n",
             shade->clear ? "#define FLOOR_SHADOW 1\n" : "", splat_has_panes(def) ? "#define PANES 1\n" : "",
             more, (int)def->show, (int)def->shading);
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
    *shade = (SplatShade){.clear = splat_is_clear(def)};
    if (shade->clear && !box_edges_create(&shade->edges, error))
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
    background_copy_destroy(&shade->background);
    box_edges_destroy(&shade->edges);
}

/* Sets the extra inputs of a clear fluid's shading. */
static void look_through(SplatShade *shade, unsigned program, const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    background_copy_make(&shade->background, &shade->edges, frame);
    glProgramUniform1f(program, REFRACTION_INDEX_AT, (float)def->ior);
    glProgramUniform1f(program, ATTENUATION_AT,
                       def->attenuation > 0 ? (float)def->attenuation : frame->fluid.attenuation);
}

/* Blends partly covered pixels with the background. */
static void begin_mixing(const Frame *frame)
{
    glUniform1f(COVER_STEP_AT, (float)splat_def(frame->def)->eps * frame->radii.drawn);
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

void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, const SplatThickness *thickness,
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
    glUniform1f(NEAREST_DEPTH_AT, fmaxf(frame->extent.nearest, frame->camera.near_plane));
    glUniform1f(FARTHEST_DEPTH_AT, frame->extent.farthest);
    if (mixing)
        begin_mixing(frame);
    fluid_tiles_draw(tiles);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

bool silhouette_create(Silhouette *silhouette, const Subject *subject, Error *error)
{
    static const char *const files[] = {"splat/silhouette_near.frag", "splat/silhouette_edges.frag",
                                        "splat/silhouette_blend.frag"};
    const bool solids = subject->world->solid_count > 0, discs = silhouette_by_discs(splat_def(subject->def));
    char defines[96];
    *silhouette = (Silhouette){0};
    snprintf(defines, sizeof defines, "%s%s%s", solids ? "#define SOLIDS 1\n" : "",
             discs ? "#define DISCS 1\n" : "", solids || !discs ? "#define ROWS 1\n" : "");
    for (int i = 0; i < SILHOUETTE_PASSES; i++) {
        const char *const stages[] = {FLUID_TILES_VERTEX, files[i], NULL};
        silhouette->programs[i] = program_create(files[i], stages, defines, error);
        if (!silhouette->programs[i])
            return false;
    }
    return true;
}

static void delete_edge_maps(Silhouette *silhouette)
{
    glDeleteFramebuffers(2, (GLuint[]){silhouette->edges_framebuffer, silhouette->target_framebuffer});
    glDeleteTextures(
        4, (GLuint[]){silhouette->edges, silhouette->picture, silhouette->target, silhouette->near});
}

void silhouette_destroy(Silhouette *silhouette)
{
    delete_edge_maps(silhouette);
    for (int i = 0; i < SILHOUETTE_PASSES; i++)
        glDeleteProgram(silhouette->programs[i]);
    *silhouette = (Silhouette){0};
}

static void update_edge_maps(Silhouette *silhouette, const Target *target)
{
    if (silhouette->target_number == target->number)
        return;
    delete_edge_maps(silhouette);
    silhouette->edges = splat_map_create(GL_RGBA8, target, "silhouette edges");
    silhouette->picture = splat_map_create(GL_SRGB8_ALPHA8, target, "silhouette picture");
    silhouette->edges_framebuffer = splat_framebuffer_create(&silhouette->edges, 1, "silhouette edges");
    glGenTextures(1, &silhouette->target);
    glTextureView(silhouette->target, GL_TEXTURE_2D, target->color, GL_RGBA8, 0, 1, 0, 1);
    silhouette->target_framebuffer = splat_framebuffer_create(&silhouette->target, 1, "silhouette target");
    silhouette->near = splat_map_create(GL_DEPTH_COMPONENT16, target, "silhouette near");
    glNamedFramebufferTexture(silhouette->edges_framebuffer, GL_DEPTH_ATTACHMENT, silhouette->near, 0);
    glNamedFramebufferTexture(silhouette->target_framebuffer, GL_DEPTH_ATTACHMENT, silhouette->near, 0);
    silhouette->target_number = target->number;
}

static void fill_pixels(const FluidTiles *tiles, GLuint framebuffer, GLuint program, float step)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glUseProgram(program);
    glUniform1f(LEAST_STEP_AT, step);
    fluid_tiles_draw(tiles);
}

/* The first pass writes depths where the later passes must look: a software driver skips pixels only by
   the depth test. */
static void run_pass(const Silhouette *silhouette, const FluidTiles *tiles, float step)
{
    const unsigned *programs = silhouette->programs;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    fill_pixels(tiles, silhouette->edges_framebuffer, programs[0], step);
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    fill_pixels(tiles, silhouette->edges_framebuffer, programs[1], step);
    fill_pixels(tiles, silhouette->target_framebuffer, programs[2], step);
    glDepthMask(GL_TRUE);
}

static int clamp_to(int value, int end)
{
    return value < 0 ? 0 : value < end ? value : end;
}

/* Copies the box's bounds and a margin, which mixing reads. */
static void take_picture(const Silhouette *silhouette, const Frame *frame)
{
    int part[4];
    frame_bounds(frame, part);
    const int x = clamp_to(part[0] - TILE_MARGIN, frame->width),
              y = clamp_to(part[1] - TILE_MARGIN, frame->height);
    glCopyImageSubData(frame->target->color, GL_TEXTURE_2D, 0, x, y, 0, silhouette->picture, GL_TEXTURE_2D, 0,
                       x, y, 0, clamp_to(part[2] + TILE_MARGIN, frame->width) - x,
                       clamp_to(part[3] + TILE_MARGIN, frame->height) - y, 1);
}

void silhouette_draw(Silhouette *silhouette, const SplatMaps *blended, unsigned nearest, float step,
                     const FluidTiles *tiles, const Frame *frame)
{
    const Target *target = frame->target;
    update_edge_maps(silhouette, target);
    take_picture(silhouette, frame);
    glBindTextures(NEAREST_UNIT, 7,
                   (GLuint[]){nearest, target->depth, silhouette->picture, silhouette->edges, blended->color,
                              blended->normal, blended->weight});
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    run_pass(silhouette, tiles, step);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
}
