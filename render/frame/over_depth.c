#include "render/frame/over_depth.h"

#include "sim/gl/debug.h"

#include <epoxy/gl.h>

static bool follow(OverDepth *over, const Target *target)
{
    if (over->framebuffer && over->width == target->width && over->height == target->height)
        return true;
    over_depth_destroy(over);
    over->width = target->width;
    over->height = target->height;
    glCreateTextures(GL_TEXTURE_2D, 1, &over->depth);
    gl_debug_errors(); /* drops earlier errors: the query below is for this texture */
    gl_debug_asks_for_memory(true);
    glTextureStorage2D(over->depth, 1, GL_DEPTH_COMPONENT32F, over->width, over->height);
    gl_debug_asks_for_memory(false);
    if (gl_errors_take(0) > 0) {
        over_depth_destroy(over);
        return false;
    }
    glTextureParameteri(over->depth, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(over->depth, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, over->depth, -1, "depth over the view");
    glCreateFramebuffers(1, &over->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, over->framebuffer, -1, "depth over the view");
    glNamedFramebufferTexture(over->framebuffer, GL_DEPTH_ATTACHMENT, over->depth, 0);
    glNamedFramebufferDrawBuffer(over->framebuffer, GL_NONE);
    return true;
}

bool over_depth_begin(OverDepth *over, const Target *target, Target *to)
{
    const int width = target->width, height = target->height;
    if (!follow(over, target))
        return false;
    glCopyImageSubData(target->depth, GL_TEXTURE_2D, 0, 0, 0, 0, over->depth, GL_TEXTURE_2D, 0, 0, 0, 0,
                       width, height, 1);
    *to = (Target){.width = width,
                   .height = height,
                   .number = target->number,
                   .framebuffer = over->framebuffer,
                   .depth = over->depth};
    return true;
}

void over_depth_destroy(OverDepth *over)
{
    glDeleteFramebuffers(1, &over->framebuffer);
    glDeleteTextures(1, &over->depth);
    *over = (OverDepth){0};
}
