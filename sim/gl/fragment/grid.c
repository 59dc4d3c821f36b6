/* The buckets: each particle is a point, drawn into its cell's texel as deep as its id. In the k-th pass the
   colour mask opens the k-th place; the depth test lets ids pass that are greater than the last one there,
   and of these, which are drawn in rising order, the stencil lets only the first: it counts what went in. So
   each pass puts every cell's next particle in: Harada, Koshizuka and Kawaguchi 2007, with more layers
   than one. What one layer leaves is listed by transform feedback, and only that is drawn into the next. */
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>

/* Those that may go into the layer: all into the first. */
static void draw_listed(const Fragment *f, int layer)
{
    glBindVertexArray(f->lists[layer == 0 ? 0 : 1 + layer % 2]);
    if (layer == 0)
        glDrawArrays(GL_POINTS, 0, (GLsizei)f->count);
    else
        glDrawTransformFeedback(GL_POINTS, f->feedback[layer % 2]);
}

static void fill_place(const Fragment *f, int place)
{
    const int channel = place % 4;
    glColorMask(channel == 0, channel == 1, channel == 2, channel == 3);
    glStencilFunc(GL_EQUAL, place, 0xff);
    draw_listed(f, place / 4);
}

static void fill_layer(const Fragment *f, int layer)
{
    glUseProgram(f->program[FRAGMENT_BUCKET]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, f->bucket_framebuffer[layer]);
    for (int k = 0; k < 3; k++)
        fill_place(f, 4 * layer + k);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, f->full[layer]);
    fill_place(f, 4 * layer + 3);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
}

/* What the layer below has left. */
static void list_waiting(const Fragment *f, int layer)
{
    const GLuint program = f->program[FRAGMENT_WAITING];
    glUseProgram(program);
    glProgramUniform1i(program, fragment_uniform(f, FRAGMENT_WAITING, FRAGMENT_layer), layer - 1);
    glTextureBarrier(); /* it was drawn into until now */
    glEnable(GL_RASTERIZER_DISCARD);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f->feedback[layer % 2]);
    glBeginTransformFeedback(GL_POINTS);
    draw_listed(f, layer - 1);
    glEndTransformFeedback();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glDisable(GL_RASTERIZER_DISCARD);
}

/* Where no cell filled a layer the next one stays empty. */
static void fill_layers(const Fragment *f)
{
    fill_layer(f, 0);
    for (int layer = 1; layer < f->layers; layer++) {
        glBeginConditionalRender(f->full[layer - 1], GL_QUERY_WAIT);
        list_waiting(f, layer);
        fill_layer(f, layer);
        glEndConditionalRender();
    }
}

void fragment_grid(void *state)
{
    Fragment *f = state;
    gl_state_keep(&f->kept);
    if (f->flush) /* zink of Mesa 22.3 draws hardly a particle behind a view's indexed indirect draw */
        glFlush();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, f->bucket_framebuffer[0]);
    glViewport(0, 0, f->bucket_width, f->bucket_height);
    glClearBufferfi(GL_DEPTH_STENCIL, 0, 0, 0);
    /* All layers, whatever the conditions below say: NVIDIA's driver (580) left out a layer's glClearBuffer
       that stood under one and drew into the layer. */
    glClearTexImage(f->buckets, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, NULL);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_BUCKETS, f->buckets);
    fill_layers(f);
    gl_state_restore(&f->kept);
}
