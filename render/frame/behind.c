#include "render/frame/behind.h"

#include "shaders/shared/bindings.h"

#include <epoxy/gl.h>

static GLuint create_copy(GLenum format, const Target *target, GLint filter, const char *label)
{
    GLuint copy;
    glCreateTextures(GL_TEXTURE_2D, 1, &copy);
    glObjectLabel(GL_TEXTURE, copy, -1, label);
    glTextureStorage2D(copy, 1, format, target->width, target->height);
    glTextureParameteri(copy, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(copy, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(copy, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(copy, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return copy;
}

void behind_destroy(Behind *behind)
{
    glDeleteTextures(2, (GLuint[]){behind->color, behind->depth});
    glDeleteFramebuffers(1, &behind->framebuffer);
    *behind = (Behind){0};
}

static void follow(Behind *behind, const Frame *frame)
{
    const bool solids = frame->world->solid_count > 0;
    if (behind->target_number == frame->target->number && solids == (behind->depth != 0))
        return;
    behind_destroy(behind);
    behind->color = create_copy(GL_SRGB8_ALPHA8, frame->target, GL_LINEAR, "behind");
    if (solids)
        behind->depth = create_copy(GL_DEPTH_COMPONENT32F, frame->target, GL_NEAREST, "behind, depth");
    glCreateFramebuffers(1, &behind->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, behind->framebuffer, -1, "behind");
    glNamedFramebufferTexture(behind->framebuffer, GL_COLOR_ATTACHMENT0, behind->color, 0);
    glNamedFramebufferTexture(behind->framebuffer, GL_DEPTH_ATTACHMENT, frame->target->depth, 0);
    behind->target_number = frame->target->number;
}

static void copy(GLuint from, GLuint to, const Frame *frame)
{
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, frame->width,
                       frame->height, 1);
}

static void draw_edges(const Behind *behind, const Edges *edges, const Frame *frame)
{
    if (!edges || !frame->def->box || frame->flat)
        return;
    glViewport(0, 0, frame->width, frame->height);
    edges_draw_behind(edges, frame, behind->framebuffer);
}

void behind_take_edges(Behind *behind, const Edges *edges, const Frame *frame)
{
    static const float nothing[4] = {0};
    follow(behind, frame);
    glClearNamedFramebufferfv(behind->framebuffer, GL_COLOR, 0, nothing);
    draw_edges(behind, edges, frame);
    glBindTextureUnit(BEHIND_COLOR_UNIT, behind->color);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor_light);
}

void behind_take(Behind *behind, const Edges *edges, const Frame *frame)
{
    follow(behind, frame);
    copy(frame->target->color, behind->color, frame);
    if (behind->depth)
        copy(frame->target->depth, behind->depth, frame);
    draw_edges(behind, edges, frame);
    glBindTextureUnit(BEHIND_COLOR_UNIT, behind->color);
    glBindTextureUnit(BEHIND_DEPTH_UNIT, behind->depth);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor_light);
}
