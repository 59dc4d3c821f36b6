#include "render/frame/edges.h"

#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>

enum { EDGE_COUNT = 12 };

static GLuint create_indices(void)
{
    static const uint16_t corners[6] = {0, 1, 2, 2, 1, 3};
    uint16_t index[6 * EDGE_COUNT];
    GLuint buffer;
    for (int i = 0; i < 6 * EDGE_COUNT; i++)
        index[i] = (uint16_t)(4 * (i / 6) + corners[i % 6]);
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, "edge indices");
    glNamedBufferStorage(buffer, sizeof index, index, 0);
    return buffer;
}

bool edges_create(Edges *edges, Error *error)
{
    glCreateVertexArrays(1, &edges->vertex_array);
    edges->indices = create_indices();
    glVertexArrayElementBuffer(edges->vertex_array, edges->indices);
    edges->program = program_create_pair("edges", "render/edges.vert", "render/edges.frag", error);
    return edges->program != 0;
}

void edges_destroy(Edges *edges)
{
    glDeleteProgram(edges->program);
    glDeleteVertexArrays(1, &edges->vertex_array);
    glDeleteBuffers(1, &edges->indices);
    *edges = (Edges){0};
}

static void draw(const Edges *edges, GLuint program, const Frame *frame, bool behind)
{
    const float part = (float)frame->height / 720; /* 1 for a picture 720 pixels high */
    const float width = frame->glass ? fmaxf(2, 3 * part) : fmaxf(1.5F, 1.5F * part);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, behind ? GL_ONE : GL_ZERO,
                        behind ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    glUseProgram(program);
    glProgramUniform1f(program, HALF_WIDTH_AT, width / 2);
    glProgramUniform1ui(program, EDGES_BEHIND_AT, behind);
    glBindVertexArray(edges->vertex_array);
    glDrawElements(GL_TRIANGLES, 6 * EDGE_COUNT, GL_UNSIGNED_SHORT, NULL);
    glDisable(GL_BLEND);
}

static void begin(const Frame *frame, GLuint framebuffer)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(frame->depths);
}

void edges_draw(const Edges *edges, const Frame *frame)
{
    begin(frame, frame->target->framebuffer);
    draw(edges, edges->program, frame, false);
}

void edges_draw_behind(const Edges *edges, const Frame *frame, unsigned framebuffer)
{
    begin(frame, framebuffer);
    draw(edges, edges->program, frame, true);
}

void edges_draw_enlarged(const Edges *edges, unsigned program, const Frame *frame, unsigned depth)
{
    glBindTextureUnit(COARSE_DEPTH_UNIT, depth);
    glDisable(GL_DEPTH_TEST);
    draw(edges, program, frame, false);
}
