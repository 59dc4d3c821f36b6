#include "render/splat_shade.h"

#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

/* A fifth of the longest side where the scene names no distance. */
static float attenuation_distance(const Frame *frame, const double box_size[3])
{
    const double named = frame->def->splat.attenuation;
    return (float)(named > 0 ? named : fmax(box_size[0], fmax(box_size[1], box_size[2])) / 5);
}

bool splat_shade_wants_thickness(const SplatDef *def)
{
    return def->show == SPLAT_THICKNESS || (def->show == SPLAT_SHADED && def->shading != SPLAT_PHONG);
}

bool splat_shade_create(SplatShade *shade, const ViewDef *def, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "render/splat_shade.frag", NULL};
    char defines[128];
    *shade = (SplatShade){.clear = def->splat.show == SPLAT_SHADED && def->splat.shading != SPLAT_PHONG};
    glCreateVertexArrays(1, &shade->screen);
    snprintf(defines, sizeof defines, "%s%s#define SHOW %d\n#define SHADING %d\n",
             def->solid_count > 0 ? "#define SOLIDS 1\n" : "", shade->clear ? "#define FLOOR_SHADOW 1\n" : "",
             (int)def->splat.show, (int)def->splat.shading);
    shade->program = program_create("splat shade", stages, defines, error);
    return shade->program != 0;
}

void splat_shade_destroy(SplatShade *shade)
{
    glDeleteProgram(shade->program);
    glDeleteVertexArrays(1, &shade->screen);
    behind_destroy(&shade->behind);
}

/* What a clear fluid's shading reads besides. */
static void look_through(SplatShade *shade, const Frame *frame, const double box_size[3])
{
    behind_take(&shade->behind, frame);
    glProgramUniform2f(shade->program, 2, (float)frame->def->splat.ior,
                       attenuation_distance(frame, box_size));
}

void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, unsigned thickness, const Frame *frame,
                      const double box_size[3])
{
    if (shade->clear)
        look_through(shade, frame, box_size);
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glBindTextureUnit(1, maps->nearest);
    glBindTextures(5, 3, (GLuint[]){maps->color, maps->normal, maps->weight});
    glBindTextureUnit(10, thickness);
    glUseProgram(shade->program);
    glUniform2f(1, fmaxf(frame->nearest, frame->camera.near_plane), frame->farthest);
    glBindVertexArray(shade->screen);
    frame_cut_to_bounds(frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}
