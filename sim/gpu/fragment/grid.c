/* Buckets: each particle is a point, drawn to its cell's texel with its id as depth. In the k-th pass the
   colour mask opens the k-th place. The depth test passes ids greater than the last id there. Among these,
   drawn in rising order, the stencil passes only the first and counts the particles added. So each pass
   adds the next particle of every cell: Harada, Koshizuka and Kawaguchi 2007, with several layers.
   Transform feedback lists the particles left over by a layer, and only those are drawn to the next layer. */
#include "sim/gpu/fragment/fragment.h"

#include <epoxy/gl.h>

/* Draws the candidates for the layer: all particles for the first layer. */
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

/* Lists the particles left over by the layer below. */
static void list_waiting(const Fragment *f, int layer)
{
    const GLuint program = f->program[FRAGMENT_WAITING];
    glUseProgram(program);
    glProgramUniform1i(program, fragment_uniform(f, FRAGMENT_WAITING, FRAGMENT_layer), layer - 1);
    glTextureBarrier(); /* the buckets were a target until now */
    glEnable(GL_RASTERIZER_DISCARD);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f->feedback[layer % 2]);
    glBeginTransformFeedback(GL_POINTS);
    draw_listed(f, layer - 1);
    glEndTransformFeedback();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glDisable(GL_RASTERIZER_DISCARD);
}

/* If no cell filled a layer, the next layer stays empty. */
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
    gl_state_keep(&f->caller_state);
    if (f->flush) /* zink of Mesa 22.3 draws hardly any particle after a view's indexed indirect draw */
        glFlush();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, f->bucket_framebuffer[0]);
    glViewport(0, 0, f->bucket_width, f->bucket_height);
    glClearBufferfi(GL_DEPTH_STENCIL, 0, 0, 0);
    /* Clears all layers regardless of the conditions below: NVIDIA's driver (580) skipped a layer's
       conditional glClearBuffer and drew to the layer. */
    glClearTexImage(f->buckets, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, NULL);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_STENCIL_TEST);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_BUCKETS, f->buckets);
    fill_layers(f);
    gl_state_restore(&f->caller_state);
}

/* Assignment of particles to texels. From time to time the particles are sorted by cell, so that a pass
   reads neighbours from nearby texels. Buckets fill by id for any texel order, so the time of sorting
   changes no bit of a step. Call only after a good frame: the buckets then hold each particle once. */

void fragment_number(Fragment *f)
{
    gl_state_keep(&f->caller_state);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_target(f, &f->held[1], 1, f->width, f->height);
    glUseProgram(f->program[FRAGMENT_NUMBER]);
    glDrawArrays(GL_POINTS, 0, (GLsizei)f->count);
    gl_state_restore(&f->caller_state);
    fragment_pack(f->held[1], GL_RED_INTEGER, f->listed[0], 0, 4 * (size_t)f->width * (size_t)f->height);
}

static void draw_points(const Fragment *f, bool placeless, size_t count)
{
    const GLint at = fragment_uniform(f, FRAGMENT_ORDER, FRAGMENT_placeless);
    glProgramUniform1i(f->program[FRAGMENT_ORDER], at, placeless);
    glDrawArrays(GL_POINTS, 0, (GLsizei)count);
}

/* Lists in listed[1] the particles in the buckets, cell by cell, then particles without a place. Returns
   their number. */
static size_t list_by_cell(Fragment *f)
{
    GLuint written = 0;
    fragment_target(f, &f->held[1], 1, f->width, f->height); /* a texture not read here */
    glUseProgram(f->program[FRAGMENT_ORDER]);
    glEnable(GL_RASTERIZER_DISCARD);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f->feedback[0]);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, f->written);
    glBeginTransformFeedback(GL_POINTS);
    draw_points(f, false, f->constants->cells.count * (size_t)f->layers);
    draw_points(f, true, f->count);
    glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glDisable(GL_RASTERIZER_DISCARD);
    glGetQueryObjectuiv(f->written, GL_QUERY_RESULT, &written);
    return written;
}

static bool order(Fragment *f)
{
    bool all;
    gl_state_keep(&f->caller_state);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held[0]);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_sample(FRAGMENT_SAMPLE_BUCKETS, f->buckets);
    fragment_sample(FRAGMENT_SAMPLE_BY_CELL, f->by_cell);
    all = list_by_cell(f) == f->count;
    if (all)
        fragment_draw(f, FRAGMENT_REORDER, (const unsigned[]){f->position[1], f->velocity[1], f->held[1]}, 3,
                      f->width, f->height);
    gl_state_restore(&f->caller_state);
    return all;
}

void fragment_order(Fragment *f)
{
    if (f->order_every == 0 || ++f->marks < f->order_every)
        return;
    f->marks = 0;
    if (!order(f))
        return;
    fragment_swap(f->position);
    fragment_swap(f->velocity);
    fragment_swap(f->held);
    fragment_number(f);
}
