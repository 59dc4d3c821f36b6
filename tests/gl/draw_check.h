/* Inputs of a draw or dispatch must be bound: with missing bindings software drivers read zeros, or a
   different block. draw_check_set checks before each call; complaints are printed and counted. */
#ifndef SLOSH_DRAW_CHECK_H
#define SLOSH_DRAW_CHECK_H

#include <epoxy/gl.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static inline bool draw_check_is_image(GLint type)
{
    return type == GL_IMAGE_3D || type == GL_UNSIGNED_INT_IMAGE_3D || type == GL_IMAGE_2D;
}

/* A sampler or an image. */
static inline bool draw_check_reads(GLint type)
{
    return draw_check_is_image(type) || draw_check_sampled(type);
}

/* What a program reads: looked up once, since asking the driver takes longer than a small dispatch. */
typedef struct DrawCheckInput {
    GLenum kind; /* GL_UNIFORM_BLOCK, GL_SHADER_STORAGE_BLOCK or GL_UNIFORM: a sampler or an image */
    GLint type;  /* of a uniform */
    GLint place; /* binding of a block, location of a uniform */
    char name[64];
} DrawCheckInput;

typedef struct DrawCheckProgram {
    bool known;
    int count;
    DrawCheckInput *inputs;
} DrawCheckProgram;

static DrawCheckProgram *draw_check_programs; /* by the program's name */
static GLuint draw_check_room;

static inline void draw_check_forget(DrawCheckProgram *program)
{
    free(program->inputs);
    *program = (DrawCheckProgram){0};
}

static inline void draw_check_list(GLuint program, GLenum kind, DrawCheckProgram *known)
{
    static const GLenum block[] = {GL_BUFFER_BINDING}, uniform[] = {GL_LOCATION, GL_TYPE};
    const int asked = kind == GL_UNIFORM ? 2 : 1;
    GLint count = 0;
    glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        GLint is[2] = {0};
        glGetProgramResourceiv(program, kind, (GLuint)i, asked, asked == 2 ? uniform : block, asked, NULL,
                               is);
        if (kind == GL_UNIFORM && (is[0] < 0 || !draw_check_reads(is[1])))
            continue;
        known->inputs = realloc(known->inputs, (size_t)(known->count + 1) * sizeof *known->inputs);
        if (!known->inputs)
            abort();
        DrawCheckInput *input = &known->inputs[known->count++];
        *input = (DrawCheckInput){.kind = kind, .place = is[0], .type = is[1]};
        glGetProgramResourceName(program, kind, (GLuint)i, sizeof input->name, NULL, input->name);
    }
}

static inline const DrawCheckProgram *draw_check_inputs(GLuint program)
{
    if (program >= draw_check_room) {
        const GLuint room = 2 * program + 64;
        draw_check_programs = realloc(draw_check_programs, room * sizeof *draw_check_programs);
        if (!draw_check_programs)
            abort();
        memset(draw_check_programs + draw_check_room, 0,
               (room - draw_check_room) * sizeof *draw_check_programs);
        draw_check_room = room;
    }
    DrawCheckProgram *known = &draw_check_programs[program];
    if (!known->known) {
        draw_check_list(program, GL_UNIFORM_BLOCK, known);
        draw_check_list(program, GL_SHADER_STORAGE_BLOCK, known);
        draw_check_list(program, GL_UNIFORM, known);
        known->known = true;
    }
    return known;
}

static inline void draw_check_block(GLuint program, const DrawCheckInput *block)
{
    GLint buffer = 0;
    glGetIntegeri_v(block->kind == GL_UNIFORM_BLOCK ? GL_UNIFORM_BUFFER_BINDING
                                                    : GL_SHADER_STORAGE_BUFFER_BINDING,
                    (GLuint)block->place, &buffer);
    if (buffer == 0)
        draw_check_complain(program, "no buffer is bound to the block", block->name);
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

/* The texture at the unit of a sampler or image of the type. */
static inline GLint draw_check_texture(GLint type, GLint unit)
{
    GLint texture = 0, unit_was = 0;
    if (draw_check_is_image(type)) {
        glGetIntegeri_v(GL_IMAGE_BINDING_NAME, (GLuint)unit, &texture);
    } else {
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

static inline void draw_check_uniform(GLuint program, const DrawCheckInput *uniform, bool draws)
{
    GLint unit = 0;
    glGetUniformiv(program, uniform->place, &unit);
    const GLint texture = draw_check_texture(uniform->type, unit);
    if (texture == 0)
        draw_check_complain(program, "no texture is bound to", uniform->name);
    else if (draw_check_filters_depth(uniform->type, (GLuint)texture))
        draw_check_complain(program, "filters the depths of", uniform->name);
    else if (draw_check_fed_back(texture, draws))
        draw_check_complain(program, "reads and draws into the texture of", uniform->name);
}

static inline void draw_check(bool draws)
{
    GLint program = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    if (program == 0)
        return;
    const DrawCheckProgram *known = draw_check_inputs((GLuint)program);
    for (int i = 0; i < known->count; i++)
        if (known->inputs[i].kind == GL_UNIFORM)
            draw_check_uniform((GLuint)program, &known->inputs[i], draws);
        else
            draw_check_block((GLuint)program, &known->inputs[i]);
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

/* The driver gives the name of a deleted program again. */
static PFNGLCREATEPROGRAMPROC draw_check_glCreateProgram;
static GLuint APIENTRY draw_checked_glCreateProgram(void)
{
    const GLuint program = draw_check_glCreateProgram();
    if (program < draw_check_room)
        draw_check_forget(&draw_check_programs[program]);
    return program;
}

/* The program's calls go through libepoxy's pointers. Without checks the calls are the program's own. */
static inline void draw_check_set(bool checks)
{
#define PUT(name)                                                                                            \
    if (!draw_check_##name)                                                                                  \
        draw_check_##name = epoxy_##name;                                                                    \
    epoxy_##name = checks ? draw_checked_##name : draw_check_##name
    PUT(glDispatchCompute);
    PUT(glDrawArrays);
    PUT(glDrawArraysInstanced);
    PUT(glDrawArraysIndirect);
    PUT(glDrawElements);
    PUT(glDrawElementsIndirect);
    PUT(glDrawTransformFeedback);
    PUT(glTextureBarrier);
    PUT(glCreateProgram);
#undef PUT
}

#endif
