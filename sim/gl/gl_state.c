#include "sim/gl/gl_state.h"

#include <epoxy/gl.h>

static const GLenum capabilities[GL_STATE_CAPABILITIES] = {
    GL_DEPTH_TEST,         GL_STENCIL_TEST, GL_BLEND,          GL_SCISSOR_TEST,    GL_CULL_FACE,
    GL_PROGRAM_POINT_SIZE, GL_DEPTH_CLAMP,  GL_COLOR_LOGIC_OP, GL_SAMPLE_COVERAGE, GL_RASTERIZER_DISCARD};

static const GLenum stencil_names[7] = {GL_STENCIL_FUNC,
                                        GL_STENCIL_REF,
                                        GL_STENCIL_VALUE_MASK,
                                        GL_STENCIL_FAIL,
                                        GL_STENCIL_PASS_DEPTH_FAIL,
                                        GL_STENCIL_PASS_DEPTH_PASS,
                                        GL_STENCIL_WRITEMASK};

static void keep(GlState *s)
{
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->framebuffer);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    glGetIntegerv(GL_VIEWPORT, s->viewport);
    glGetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
    glGetIntegerv(GL_DEPTH_FUNC, &s->depth_function);
    glGetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    for (int i = 0; i < 7; i++)
        glGetIntegerv(stencil_names[i], &s->stencil[i]);
    glGetFloatv(GL_DEPTH_RANGE, s->depth_range);
    glGetFloatv(GL_POINT_SIZE, &s->point_size);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    glGetBooleanv(GL_COLOR_WRITEMASK, s->color_mask);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        s->enabled[i] = glIsEnabled(capabilities[i]);
}

void gl_state_keep(GlState *kept)
{
    if (kept->depth++ == 0)
        keep(kept);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        glDisable(capabilities[i]);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0, 1);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilMask(0xff);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPointSize(1);
}

void gl_state_restore(GlState *kept)
{
    if (--kept->depth > 0)
        return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)kept->framebuffer);
    glBindVertexArray((GLuint)kept->vertex_array);
    glViewport(kept->viewport[0], kept->viewport[1], kept->viewport[2], kept->viewport[3]);
    glClipControl((GLenum)kept->clip_origin, (GLenum)kept->clip_depth);
    glDepthFunc((GLenum)kept->depth_function);
    glPolygonMode(GL_FRONT_AND_BACK, (GLenum)kept->polygon_mode[0]);
    glStencilFunc((GLenum)kept->stencil[0], kept->stencil[1], (GLuint)kept->stencil[2]);
    glStencilOp((GLenum)kept->stencil[3], (GLenum)kept->stencil[4], (GLenum)kept->stencil[5]);
    glStencilMask((GLuint)kept->stencil[6]);
    glDepthRange((GLdouble)kept->depth_range[0], (GLdouble)kept->depth_range[1]);
    glPointSize(kept->point_size);
    glDepthMask(kept->depth_mask);
    glColorMask(kept->color_mask[0], kept->color_mask[1], kept->color_mask[2], kept->color_mask[3]);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        (kept->enabled[i] ? glEnable : glDisable)(capabilities[i]);
}
