#include "render/splat/silhouette.h"

#include "render/splat/splat_def.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <stdio.h>

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

static void delete_maps(Silhouette *silhouette)
{
    glDeleteFramebuffers(2, (GLuint[]){silhouette->edges_framebuffer, silhouette->target_framebuffer});
    glDeleteTextures(
        4, (GLuint[]){silhouette->edges, silhouette->picture, silhouette->target, silhouette->near});
}

void silhouette_destroy(Silhouette *silhouette)
{
    delete_maps(silhouette);
    for (int i = 0; i < SILHOUETTE_PASSES; i++)
        glDeleteProgram(silhouette->programs[i]);
    *silhouette = (Silhouette){0};
}

static void follow(Silhouette *silhouette, const Target *target)
{
    if (silhouette->target_number == target->number)
        return;
    delete_maps(silhouette);
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

static void fill(const FluidTiles *tiles, GLuint framebuffer, GLuint program, float step)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glUseProgram(program);
    glUniform1f(LEAST_STEP_AT, step);
    fluid_tiles_draw(tiles);
}

/* The first pass writes depths where the later passes must look: a software driver skips pixels only by
   the depth test. */
static void run(const Silhouette *silhouette, const FluidTiles *tiles, float step)
{
    const unsigned *programs = silhouette->programs;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    fill(tiles, silhouette->edges_framebuffer, programs[0], step);
    glDepthFunc(GL_EQUAL);
    glDepthMask(GL_FALSE);
    fill(tiles, silhouette->edges_framebuffer, programs[1], step);
    fill(tiles, silhouette->target_framebuffer, programs[2], step);
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
    follow(silhouette, target);
    take_picture(silhouette, frame);
    glBindTextures(NEAREST_UNIT, 7,
                   (GLuint[]){nearest, target->depth, silhouette->picture, silhouette->edges, blended->color,
                              blended->normal, blended->weight});
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    run(silhouette, tiles, step);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
}
