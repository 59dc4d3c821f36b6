/* Assignment of particles to texels. From time to time the particles are sorted by cell, so that a pass
   reads neighbours from nearby texels. Buckets fill by id for any texel order, so the time of sorting
   changes no bit of a step. Call only after a good frame: the buckets then hold each particle once. */
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>

void fragment_number(Fragment *f)
{
    gl_state_keep(&f->kept);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_target(f, &f->held[1], 1, f->width, f->height);
    glUseProgram(f->program[FRAGMENT_NUMBER]);
    glDrawArrays(GL_POINTS, 0, (GLsizei)f->count);
    gl_state_restore(&f->kept);
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
static size_t list_by_cell(const Fragment *f)
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
    gl_state_keep(&f->kept);
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
    gl_state_restore(&f->kept);
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
