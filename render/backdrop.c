#include "render/backdrop.h"

#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool backdrop_create(Backdrop *backdrop, Error *error)
{
    glCreateVertexArrays(1, &backdrop->vertex_array);
    backdrop->program =
        program_create_pair("backdrop", "render/backdrop.vert", "render/backdrop.frag", error);
    return backdrop->program != 0;
}

void backdrop_destroy(Backdrop *backdrop)
{
    glDeleteProgram(backdrop->program);
    glDeleteVertexArrays(1, &backdrop->vertex_array);
    *backdrop = (Backdrop){0};
}

void backdrop_draw(const Backdrop *backdrop, const Frame *frame, const Shadow *shadow)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_EQUAL); /* the triangle lies at infinity, where the depth was cleared to */
    glDepthMask(GL_FALSE);
    glDisable(GL_BLEND);
    glBindTextureUnit(0, shadow->floor_map);
    glUseProgram(backdrop->program);
    glBindVertexArray(backdrop->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}
