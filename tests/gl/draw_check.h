/* Inputs of a draw or dispatch must be bound: with missing bindings software drivers read zeros, or a
   different block. draw_check_install checks before each call; complaints are printed and counted. */
#ifndef SLOSH_DRAW_CHECK_H
#define SLOSH_DRAW_CHECK_H

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdbool.h>
#include <stdio.h>

static int draw_check_complaints;
static bool draw_check_barrier;                      /* a texture barrier since the last draw */
static __attribute__((unused)) int draw_check_draws; /* draws and dispatches so far */

static inline void draw_check_complain(GLuint program, const char *what, const char *name)
{
    char label[64] = "";
    glGetObjectLabel(GL_PROGRAM, program, sizeof label, NULL, label);
    fprintf(stderr, "program '%s': %s '%s'\n", label, what, name);
    draw_check_complaints++;
}

/* `kind`: GL_UNIFORM_BLOCK or GL_SHADER_STORAGE_BLOCK. */
static inline void draw_check_blocks(GLuint program, GLenum kind, GLenum bound)
{
    static const GLenum wanted = GL_BUFFER_BINDING;
    GLint count = 0;
    glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        char name[64] = "";
        GLint binding = 0, buffer = 0;
        glGetProgramResourceiv(program, kind, (GLuint)i, 1, &wanted, 1, NULL, &binding);
        glGetIntegeri_v(bound, (GLuint)binding, &buffer);
        glGetProgramResourceName(program, kind, (GLuint)i, sizeof name, NULL, name);
        if (buffer == 0)
            draw_check_complain(program, "no buffer is bound to the block", name);
    }
}

/* The texture's binding point where the type is a sampler's; 0 where it is none. */
static inline GLenum draw_check_sampled(GLint type)
{
    switch (type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_2D_SHADOW:
    case GL_UNSIGNED_INT_SAMPLER_2D:
        return GL_TEXTURE_BINDING_2D;
    case GL_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
        return GL_TEXTURE_BINDING_2D_ARRAY;
    case GL_SAMPLER_3D:
        return GL_TEXTURE_BINDING_3D;
    case GL_SAMPLER_BUFFER:
    case GL_UNSIGNED_INT_SAMPLER_BUFFER:
        return GL_TEXTURE_BINDING_BUFFER;
    default:
        return 0;
    }
}

static inline bool draw_check_attached(GLint texture, GLenum attachment)
{
    GLint framebuffer = 0, type = GL_NONE, name = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    if (framebuffer == 0)
        return false;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                          GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type == GL_TEXTURE)
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment,
                                              GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    return type == GL_TEXTURE && name == texture;
}

/* True if the program may write the texture being sampled, or samples the texture being drawn. After a
   texture barrier a pass over the screen may read the written texels. */
static inline bool draw_check_fed_back(GLint texture, bool draws)
{
    GLboolean depth = GL_FALSE;
    for (GLenum i = 0; i < 4; i++)
        if (draw_check_attached(texture, GL_COLOR_ATTACHMENT0 + i))
            return !draws || !draw_check_barrier;
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth);
    return draw_check_attached(texture, GL_DEPTH_ATTACHMENT) &&
           (!draws || (depth && glIsEnabled(GL_DEPTH_TEST) && !draw_check_barrier));
}

/* The texture at the unit of a sampler or image of the type; -1: neither kind. */
static inline GLint draw_check_texture(GLint type, GLint unit)
{
    GLint texture = -1, unit_was = 0;
    if (type == GL_IMAGE_3D || type == GL_UNSIGNED_INT_IMAGE_3D || type == GL_IMAGE_2D) {
        glGetIntegeri_v(GL_IMAGE_BINDING_NAME, (GLuint)unit, &texture);
    } else if (draw_check_sampled(type)) {
        glGetIntegerv(GL_ACTIVE_TEXTURE, &unit_was);
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        glGetIntegerv(draw_check_sampled(type), &texture);
        glActiveTexture((GLenum)unit_was);
    }
    return texture;
}

/* Depths read as values, without comparison, between texels: few formats are filtered on all hardware. */
static inline bool draw_check_filters_depth(GLint type, GLuint texture)
{
    GLint bits = 0, compare = GL_NONE, filter = GL_NEAREST;
    if (type != GL_SAMPLER_2D)
        return false;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    glGetTextureParameteriv(texture, GL_TEXTURE_COMPARE_MODE, &compare);
    glGetTextureParameteriv(texture, GL_TEXTURE_MAG_FILTER, &filter);
    return bits > 0 && compare == GL_NONE && filter == GL_LINEAR;
}

static inline void draw_check_textures(GLuint program, bool draws)
{
    static const GLenum wanted[] = {GL_TYPE, GL_LOCATION};
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        char name[64] = "";
        GLint is[2] = {0}, value[16] = {0}; /* room for a matrix; of a sampler its unit */
        glGetProgramResourceiv(program, GL_UNIFORM, (GLuint)i, 2, wanted, 2, NULL, is);
        glGetProgramResourceName(program, GL_UNIFORM, (GLuint)i, sizeof name, NULL, name);
        if (is[1] >= 0)
            glGetUniformiv(program, is[1], value);
        const GLint texture = draw_check_texture(is[0], value[0]);
        if (texture == 0)
            draw_check_complain(program, "no texture is bound to", name);
        else if (texture > 0 && draw_check_filters_depth(is[0], (GLuint)texture))
            draw_check_complain(program, "filters the depths of", name);
        else if (texture > 0 && draw_check_fed_back(texture, draws))
            draw_check_complain(program, "reads and draws into the texture of", name);
    }
}

static inline void draw_check(bool draws)
{
    GLint program = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    if (program == 0)
        return;
    draw_check_blocks((GLuint)program, GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER_BINDING);
    draw_check_blocks((GLuint)program, GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER_BINDING);
    draw_check_textures((GLuint)program, draws);
    draw_check_barrier = draw_check_barrier && !draws;
}

/* `all`: whether anything is to be done, where the call says so. */
#define DRAW_CHECK_WRAP(draws, all, name, type, parameters, arguments)                                       \
    static type draw_check_##name;                                                                           \
    static void APIENTRY draw_checked_##name parameters                                                      \
    {                                                                                                        \
        draw_check_draws++;                                                                                  \
        if (all)                                                                                             \
            draw_check(draws);                                                                               \
        draw_check_##name arguments;                                                                         \
    }

DRAW_CHECK_WRAP(false, x > 0 && y > 0 && z > 0, glDispatchCompute, PFNGLDISPATCHCOMPUTEPROC,
                (GLuint x, GLuint y, GLuint z), (x, y, z))
DRAW_CHECK_WRAP(true, count > 0, glDrawArrays, PFNGLDRAWARRAYSPROC, (GLenum mode, GLint first, GLsizei count),
                (mode, first, count))
DRAW_CHECK_WRAP(true, count > 0, glDrawArraysInstanced, PFNGLDRAWARRAYSINSTANCEDPROC,
                (GLenum mode, GLint first, GLsizei count, GLsizei instances), (mode, first, count, instances))
DRAW_CHECK_WRAP(true, true, glDrawArraysIndirect, PFNGLDRAWARRAYSINDIRECTPROC, (GLenum mode, const void *at),
                (mode, at))
DRAW_CHECK_WRAP(true, count > 0, glDrawElements, PFNGLDRAWELEMENTSPROC,
                (GLenum mode, GLsizei count, GLenum type, const void *indices), (mode, count, type, indices))
DRAW_CHECK_WRAP(true, true, glDrawElementsIndirect, PFNGLDRAWELEMENTSINDIRECTPROC,
                (GLenum mode, GLenum type, const void *at), (mode, type, at))
DRAW_CHECK_WRAP(true, true, glDrawTransformFeedback, PFNGLDRAWTRANSFORMFEEDBACKPROC, (GLenum mode, GLuint id),
                (mode, id))

static PFNGLTEXTUREBARRIERPROC draw_check_glTextureBarrier;
static void APIENTRY draw_checked_glTextureBarrier(void)
{
    draw_check_barrier = true;
    draw_check_glTextureBarrier();
}

/* The program's calls go through libepoxy's pointers; before the first call a pointer is not the
   driver's. */
static inline void draw_check_install(void)
{
#define PUT(name)                                                                                            \
    draw_check_##name = (__typeof__(draw_check_##name))eglGetProcAddress(#name);                             \
    epoxy_##name = draw_checked_##name
    PUT(glDispatchCompute);
    PUT(glDrawArrays);
    PUT(glDrawArraysInstanced);
    PUT(glDrawArraysIndirect);
    PUT(glDrawElements);
    PUT(glDrawElementsIndirect);
    PUT(glDrawTransformFeedback);
    PUT(glTextureBarrier);
#undef PUT
}

#endif
