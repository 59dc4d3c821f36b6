#include "render/frame/target.h"

#include <epoxy/gl.h>
#include <string.h>

static GLuint create_texture(GLenum format, int width, int height, const char *label)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, texture, -1, label);
    return texture;
}

bool target_create(Target *target, int width, int height, Error *error)
{
    static unsigned targets;
    GLint limit = 0;
    *target = (Target){.width = width, .height = height, .number = ++targets};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        return error_set(error, "a picture of %d x %d pixels cannot be drawn; 1 to %d a side can", width,
                         height, limit);
    target->color = create_texture(GL_SRGB8_ALPHA8, width, height, "target color");
    target->depth = create_texture(GL_DEPTH_COMPONENT32F, width, height, "target depth");
    glCreateFramebuffers(1, &target->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, target->framebuffer, -1, "target");
    glNamedFramebufferTexture(target->framebuffer, GL_COLOR_ATTACHMENT0, target->color, 0);
    glNamedFramebufferTexture(target->framebuffer, GL_DEPTH_ATTACHMENT, target->depth, 0);
    if (glCheckNamedFramebufferStatus(target->framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return true;
    target_destroy(target);
    return error_set(error, "the driver does not take a framebuffer of %d x %d pixels; try a smaller one",
                     width, height);
}

void target_destroy(Target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteTextures(1, &target->color);
    glDeleteTextures(1, &target->depth);
    *target = (Target){0};
}

void target_begin(const Target *target)
{
    static const float far_depth = 0;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glViewport(0, 0, target->width, target->height);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(target->framebuffer, GL_DEPTH, 0, &far_depth);
}

static void flip_rows(uint8_t *rgb, size_t row, size_t height)
{
    for (size_t y = 0; y < height / 2; y++) {
        uint8_t *top = rgb + y * row, *bottom = rgb + (height - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            uint8_t keep = top[i];
            top[i] = bottom[i];
            bottom[i] = keep;
        }
    }
}

void target_read(const Target *target, uint8_t *rgb)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, target->width, target->height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    flip_rows(rgb, 3 * (size_t)target->width, (size_t)target->height);
}

void target_present(const Target *target, int x, int y)
{
    glDisable(GL_FRAMEBUFFER_SRGB); /* colours are encoded already */
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(target->framebuffer, 0, 0, 0, target->width, target->height, x, y,
                           x + target->width, y + target->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(x, y, target->width, target->height);
}

void target_read_depth(const Target *target, float *depth)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadPixels(0, 0, target->width, target->height, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
}
