#include "render/splat/panes.h"

#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool panes_create(Panes *panes, Error *error)
{
    *panes = (Panes){0};
    panes->cut = program_create_pair("splat panes", FLUID_TILES_VERTEX, "splat/clear/panes.frag", error);
    if (panes->cut)
        panes->brim = program_create_pair("splat brim", FLUID_TILES_VERTEX, "splat/clear/brim.frag", error);
    return panes->brim != 0;
}

static void delete_maps(Panes *panes)
{
    glDeleteFramebuffers(2, panes->framebuffer);
    glDeleteTextures(2, panes->map);
}

void panes_destroy(Panes *panes)
{
    glDeleteProgram(panes->cut);
    glDeleteProgram(panes->brim);
    delete_maps(panes);
    *panes = (Panes){0};
}

static void follow(Panes *panes, const Target *target)
{
    if (panes->target_number == target->number)
        return;
    delete_maps(panes);
    for (int i = 0; i < 2; i++) {
        panes->map[i] = splat_map_create(GL_R32F, target, "splat panes");
        panes->framebuffer[i] = splat_framebuffer_create(&panes->map[i], 1, "splat panes");
    }
    panes->target_number = target->number;
}

static void pass(const Panes *panes, int to, unsigned program, unsigned from, const FluidTiles *tiles)
{
    glClearNamedFramebufferfv(panes->framebuffer[to], GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    glBindFramebuffer(GL_FRAMEBUFFER, panes->framebuffer[to]);
    glBindTextureUnit(NEAREST_UNIT, from);
    glUseProgram(program);
    fluid_tiles_draw(tiles);
}

SplatMaps panes_draw(Panes *panes, const SplatMaps *maps, const FluidTiles *tiles, const Frame *frame)
{
    SplatMaps cut = *maps;
    follow(panes, frame->target);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    pass(panes, 0, panes->cut, maps->nearest, tiles);
    glBindTextureUnit(TARGET_DEPTH_UNIT, maps->nearest);
    pass(panes, 1, panes->brim, panes->map[0], tiles);
    cut.nearest = panes->map[1];
    return cut;
}
