#include "render/clear/glass.h"

#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

enum { VERTICES = 36 };

bool glass_create(Glass *glass, Error *error)
{
    if (glass->program)
        return true;
    if (!glass->vertex_array)
        glCreateVertexArrays(1, &glass->vertex_array);
    glass->program = program_create_pair("glass", "render/glass.vert", "render/glass.frag", error);
    return glass->program != 0;
}

void glass_destroy(Glass *glass)
{
    glDeleteProgram(glass->program);
    glDeleteVertexArrays(1, &glass->vertex_array);
    *glass = (Glass){0};
}

void glass_draw(const Glass *glass, const Frame *frame, bool behind)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glUseProgram(glass->program);
    glProgramUniform1ui(glass->program, EDGES_BEHIND_AT, behind);
    glBindVertexArray(glass->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, VERTICES);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}
