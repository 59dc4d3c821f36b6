#include "render/splat/panes.h"

#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool panes_create(Panes *panes, Error *error)
{
    *panes =
        (Panes){.program = program_create_pair("splat panes", FLUID_TILES_VERTEX, "splat/panes.frag", error)};
    return panes->program != 0;
}

static void delete_map(Panes *panes)
{
    glDeleteFramebuffers(1, &panes->framebuffer);
    glDeleteTextures(1, &panes->map);
}

void panes_destroy(Panes *panes)
{
    glDeleteProgram(panes->program);
    delete_map(panes);
    *panes = (Panes){0};
}

static void follow(Panes *panes, const Target *target)
{
    if (panes->target_number == target->number)
        return;
    delete_map(panes);
    panes->map = splat_map_create(GL_R32F, target, "splat panes");
    panes->framebuffer = splat_framebuffer_create(&panes->map, 1, "splat panes");
    panes->target_number = target->number;
}

SplatMaps panes_draw(Panes *panes, const SplatMaps *maps, const FluidTiles *tiles, const Frame *frame)
{
    SplatMaps cut = *maps;
    follow(panes, frame->target);
    glClearNamedFramebufferfv(panes->framebuffer, GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    glBindFramebuffer(GL_FRAMEBUFFER, panes->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(NEAREST_UNIT, maps->nearest);
    glUseProgram(panes->program);
    fluid_tiles_draw(tiles);
    cut.nearest = panes->map;
    return cut;
}
