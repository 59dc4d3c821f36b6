#include "render/trails/trail_lines.h"

#include "shaders/shared/bindings.h"
#include "shaders/trails/trails_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

bool trail_lines_create(TrailLines *lines, Error *error)
{
    glCreateVertexArrays(1, &lines->screen);
    glCreateFramebuffers(1, &lines->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, lines->framebuffer, -1, "trails");
    quad_indices_create(&lines->quads);
    lines->lines = program_create_pair("trails", "trails/trails.vert", "trails/trails_lines.frag", error);
    if (lines->lines)
        lines->head =
            program_create_pair("trails' heads", "trails/trails.vert", "trails/trails_head.frag", error);
    if (lines->head)
        lines->show =
            program_create_pair("trails show", "common/screen.vert", "trails/trails_show.frag", error);
    return lines->show != 0;
}

void trail_lines_destroy(TrailLines *lines)
{
    glDeleteProgram(lines->lines);
    glDeleteProgram(lines->head);
    glDeleteProgram(lines->show);
    glDeleteVertexArrays(1, &lines->screen);
    glDeleteFramebuffers(1, &lines->framebuffer);
    color_table_destroy(&lines->colors);
    glDeleteTextures(1, &lines->kept);
    quad_indices_destroy(&lines->quads);
    *lines = (TrailLines){0};
}

static TrailLook look_of(const TrailStore *store, const Frame *frame)
{
    TrailLook look;
    matrix_multiply(frame->camera.view, frame->box_to_world, look.box_to_eye);
    memcpy(look.tangent, frame->camera.tangent, sizeof look.tangent);
    look.near_plane = frame->camera.near_plane;
    look.half_width = (float)(trails_def(frame->def)->width / 2);
    for (int k = 0; k < 3; k++)
        look.wrap[k] = frame->world->periodic[k] ? (float)store->box_size[k] / 2 : INFINITY;
    look.width = frame->width;
    look.height = frame->height;
    look.scalar = frame->def->color_by;
    look.drops = store->ring.drops;
    look.made = store->made;
    return look;
}

static bool same_numbers(const float *a, const float *b, int count)
{
    bool same = true;
    for (int i = 0; i < count; i++)
        same &= a[i] == b[i];
    return same;
}

static bool same_look(const TrailLook *a, const TrailLook *b)
{
    return same_numbers(a->box_to_eye, b->box_to_eye, 16) && same_numbers(a->tangent, b->tangent, 2) &&
           same_numbers(a->wrap, b->wrap, 3) && a->near_plane == b->near_plane &&
           a->half_width == b->half_width && a->width == b->width && a->height == b->height &&
           a->scalar == b->scalar && a->drops == b->drops && a->made == b->made;
}

static void follow_size(TrailLines *lines, const TrailLook *look)
{
    if (lines->kept && look->width == lines->look.width && look->height == lines->look.height)
        return;
    glDeleteTextures(1, &lines->kept);
    glCreateTextures(GL_TEXTURE_2D, 1, &lines->kept);
    glObjectLabel(GL_TEXTURE, lines->kept, -1, "trails");
    glTextureStorage2D(lines->kept, 1, GL_RGBA32F, look->width, look->height);
    glNamedFramebufferTexture(lines->framebuffer, GL_COLOR_ATTACHMENT0, lines->kept, 0);
}

static void set_lines(const TrailLook *look, GLuint program)
{
    glUseProgram(program);
    glUniform1f(HALF_WIDTH_AT, look->half_width);
    glUniform3fv(TRAIL_WRAP_AT, 1, look->wrap);
}

static void set_color(const TrailStore *store, const Frame *frame, GLuint program, float strength)
{
    glUseProgram(program);
    glUniform1f(TRAIL_TIME_AT, (float)store->ring.now);
    glUniform2f(TRAIL_FADE_AT, (float)(1 / store->ring.length), strength);
    glUniform1ui(TRAIL_IS_FLUID_AT, frame->def->color_by == SCALAR_FLUID);
}

/* From the column before to that one, by the program in use. */
static void draw_column(TrailLines *lines, const TrailStore *store, uint64_t number, Scalar scalar)
{
    const TrailRing *ring = &store->ring;
    const TrailColumn *from = trail_ring_at(ring, number - 1), *to = trail_ring_at(ring, number);
    if (!trail_ring_joins(ring, number))
        return;
    const bool earlier = trail_ring_joins(ring, number - 1);
    glUniform1ui(TRAIL_COLUMN_AT, trail_store_column(store, number));
    glUniform1ui(TRAIL_BEFORE_AT, trail_store_column(store, number - 1));
    glUniform1ui(TRAIL_EARLIER_AT, earlier ? trail_store_column(store, number - 2) : TRAIL_NO_COLUMN);
    glUniform2f(TRAIL_TIMES_AT, (float)from->time, (float)to->time);
    glUniform1ui(TRAIL_KNOWN_AT, from->scalar == scalar && to->scalar == scalar);
    quad_indices_draw(&lines->quads, (size_t)store->slots);
}

/* Of all columns, where it is of another look; else those that are new. */
static void keep(TrailLines *lines, const TrailStore *store, const TrailLook *look)
{
    const TrailRing *ring = &store->ring;
    glBindFramebuffer(GL_FRAMEBUFFER, lines->framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, look->width, look->height);
    if (!same_look(look, &lines->look)) {
        lines->look = *look;
        lines->drawn = ring->begin;
        glClearNamedFramebufferfv(lines->framebuffer, GL_COLOR, 0, (float[4]){0});
    }
    set_lines(look, lines->lines);
    for (uint64_t k = lines->drawn > ring->begin ? lines->drawn : ring->begin; k < ring->end; k++)
        draw_column(lines, store, k, look->scalar);
    lines->drawn = ring->end;
}

static void show(TrailLines *lines, const TrailStore *store, const Frame *frame, GLenum test, float strength)
{
    glDepthFunc(test);
    set_color(store, frame, lines->show, strength);
    glBindVertexArray(lines->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (store->ring.head < store->ring.end)
        return; /* the newest state is in the kept picture */
    set_lines(&lines->look, lines->head);
    set_color(store, frame, lines->head, strength);
    draw_column(lines, store, store->ring.head, frame->def->color_by);
}

static void show_all(TrailLines *lines, const TrailStore *store, const Frame *frame)
{
    const float through = (float)trails_def(frame->def)->through;
    const bool all = frame->slab > 0; /* in two dimensions particles do not hide them */
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glBindTextureUnit(TRAIL_LINES_UNIT, lines->kept);
    color_table_follow(&lines->colors, frame->def->colormap, &frame->def->color_curve);
    frame_cut_to_bounds(frame);
    show(lines, store, frame, all ? GL_ALWAYS : GL_GEQUAL, 1);
    if (through > 0 && !all)
        show(lines, store, frame, GL_LESS, through);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

void trail_lines_draw(TrailLines *lines, const TrailStore *store, const Frame *frame)
{
    if (store->slots == 0 || store->ring.end == store->ring.begin)
        return;
    const TrailLook look = look_of(store, frame);
    follow_size(lines, &look);
    trail_store_bind(store);
    keep(lines, store, &look);
    show_all(lines, store, frame);
}
