#include "render/splat_shade.h"

#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

bool splat_shade_create(SplatShade *shade, const ViewDef *def, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "render/splat_shade.frag", NULL};
    char defines[128];
    *shade = (SplatShade){0};
    glCreateVertexArrays(1, &shade->screen);
    snprintf(defines, sizeof defines, "%s#define SHOW %d\n", def->solid_count > 0 ? "#define SOLIDS 1\n" : "",
             (int)def->splat.show);
    shade->program = program_create("splat shade", stages, defines, error);
    return shade->program != 0;
}

void splat_shade_destroy(SplatShade *shade)
{
    glDeleteProgram(shade->program);
    glDeleteVertexArrays(1, &shade->screen);
}

void splat_shade_draw(const SplatShade *shade, const SplatMaps *maps, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindTextureUnit(1, maps->nearest);
    glBindTextures(5, 3, (GLuint[]){maps->color, maps->normal, maps->weight});
    glUseProgram(shade->program);
    glUniform2f(1, fmaxf(frame->nearest, frame->camera.near_plane), frame->farthest);
    glBindVertexArray(shade->screen);
    frame_cut_to_bounds(frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}
