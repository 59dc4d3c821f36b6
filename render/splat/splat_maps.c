#include "render/splat/splat_maps.h"

#include "sim/gl/timer.h"

#include <epoxy/gl.h>
#include <stdlib.h>

void splat_maps_delete(SplatMaps *maps)
{
    glDeleteFramebuffers(2, (GLuint[]){maps->nearest_framebuffer, maps->blend_framebuffer});
    glDeleteTextures(5, (GLuint[]){maps->nearest, maps->color, maps->normal, maps->weight, maps->limit});
    *maps = (SplatMaps){0};
}

unsigned splat_map_create(unsigned format, const Target *target, const char *label)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glObjectLabel(GL_TEXTURE, map, -1, label);
    glTextureStorage2D(map, 1, format, target->width, target->height);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return map;
}

unsigned splat_framebuffer_create(const unsigned *maps, int count, const char *label)
{
    static const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    GLuint framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, label);
    for (int i = 0; i < count; i++)
        glNamedFramebufferTexture(framebuffer, buffers[i], maps[i], 0);
    glNamedFramebufferDrawBuffers(framebuffer, count, buffers);
    return framebuffer;
}

void splat_maps_follow(SplatMaps *maps, const Target *target, bool covers)
{
    if (maps->target_number == target->number)
        return;
    splat_maps_delete(maps);
    static const GLfloat none = 0;
    const GLenum sums = gl_renderer_is_software() ? GL_RGBA32F : GL_RGBA16F; /* software drivers compute no
                                                                                halves */
    maps->nearest = splat_map_create(GL_R32F, target, "splat nearest");
    maps->color = splat_map_create(sums, target, "splat color");
    maps->normal = splat_map_create(sums, target, "splat normal");
    maps->weight = splat_map_create(covers ? GL_RG32F : GL_R32F, target, "splat weight");
    maps->nearest_framebuffer = splat_framebuffer_create(&maps->nearest, 1, "splat nearest");
    maps->blend_framebuffer =
        splat_framebuffer_create((GLuint[]){maps->color, maps->normal, maps->weight}, 3, "splat blend");
    maps->limit = splat_map_create(GL_DEPTH_COMPONENT32F, target, "splat limit");
    glClearTexImage(maps->limit, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &none); /* no pass sets the limit outside
                                                                             the box */
    glNamedFramebufferTexture(maps->blend_framebuffer, GL_DEPTH_ATTACHMENT, maps->limit, 0);
    maps->target_number = target->number;
}

uint64_t splat_maps_covered(const SplatMaps *maps, const Target *target)
{
    const size_t pixels = (size_t)target->width * (size_t)target->height;
    uint64_t covered = 0;
    const GLsizei size = (GLsizei)(pixels * sizeof(float));
    float *weight = malloc(2 * (size_t)size);
    if (!weight)
        return 0;
    glGetTextureImage(maps->weight, 0, GL_RED, GL_FLOAT, size, weight);
    glGetTextureImage(maps->nearest, 0, GL_RED, GL_FLOAT, size, weight + pixels);
    for (size_t i = 0; i < pixels; i++)
        covered += weight[i] > 0 && weight[pixels + i] < SPLAT_NOTHING;
    free(weight);
    return covered;
}
