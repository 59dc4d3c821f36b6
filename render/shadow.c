#include "render/shadow.h"

#include "sim/gl/program.h"

#include <epoxy/gl.h>

/* Both maps reach farther than any shadow, so that their rims say what is beyond. */
static GLuint create_map(GLenum format, int texels, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, format, texels, texels);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return map;
}

static GLuint create_framebuffer(GLenum attachment, GLuint map, const char *label)
{
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, label);
    glNamedFramebufferTexture(framebuffer, attachment, map, 0);
    if (attachment == GL_DEPTH_ATTACHMENT)
        glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
    return framebuffer;
}

bool shadow_create(Shadow *shadow, Error *error)
{
    *shadow = (Shadow){0};
    shadow->map = create_map(GL_DEPTH_COMPONENT32F, SHADOW_MAP_TEXELS, "shadow map");
    shadow->framebuffer = create_framebuffer(GL_DEPTH_ATTACHMENT, shadow->map, "shadow");
    shadow->floor_map = create_map(GL_R32F, FLOOR_MAP_TEXELS, "floor shadow map");
    shadow->floor_framebuffer = create_framebuffer(GL_COLOR_ATTACHMENT0, shadow->floor_map, "floor shadow");
    glCreateVertexArrays(1, &shadow->vertex_array);
    shadow->floor_program =
        program_create_pair("floor shadow", "common/screen.vert", "render/floor_shadow.frag", error);
    if (!shadow->floor_program) {
        shadow_destroy(shadow);
        return false;
    }
    glProgramUniform1f(shadow->floor_program, 0, 1.0F / FLOOR_MAP_TEXELS);
    return true;
}

void shadow_destroy(Shadow *shadow)
{
    glDeleteFramebuffers(1, &shadow->framebuffer);
    glDeleteFramebuffers(1, &shadow->floor_framebuffer);
    glDeleteTextures(1, &shadow->map);
    glDeleteTextures(1, &shadow->floor_map);
    glDeleteVertexArrays(1, &shadow->vertex_array);
    glDeleteProgram(shadow->floor_program);
    *shadow = (Shadow){0};
}

void shadow_begin(const Shadow *shadow)
{
    static const float nothing = 0;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, shadow->framebuffer);
    glViewport(0, 0, SHADOW_MAP_TEXELS, SHADOW_MAP_TEXELS);
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(shadow->framebuffer, GL_DEPTH, 0, &nothing);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
}

void shadow_end(const Shadow *shadow, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(0, shadow->map);
    if (frame->floor_radius <= 0)
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, shadow->floor_framebuffer);
    glViewport(0, 0, FLOOR_MAP_TEXELS, FLOOR_MAP_TEXELS);
    glUseProgram(shadow->floor_program);
    glBindVertexArray(shadow->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}
