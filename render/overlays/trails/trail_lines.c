#include "render/overlays/trails/trails_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/trails/trails_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
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
    return lines->show && trail_canvas_create(&lines->sheet, error);
}

void trail_lines_destroy(TrailLines *lines)
{
    glDeleteProgram(lines->lines);
    glDeleteProgram(lines->head);
    glDeleteProgram(lines->show);
    glDeleteVertexArrays(1, &lines->screen);
    glDeleteFramebuffers(1, &lines->framebuffer);
    color_table_destroy(&lines->colors);
    glDeleteTextures(1, &lines->fixed);
    quad_indices_destroy(&lines->quads);
    trail_canvas_destroy(&lines->sheet);
    free(lines->pieces);
    *lines = (TrailLines){0};
}

static TrailSight sight_of(const TrailStore *store, const Frame *frame)
{
    TrailSight sight;
    matrix_multiply(frame->camera.view, frame->box_to_world, sight.box_to_eye);
    memcpy(sight.tangent, frame->camera.tangent, sizeof sight.tangent);
    memcpy(sight.centre, frame->camera.centre, sizeof sight.centre);
    sight.near_plane = frame->camera.near_plane;
    sight.half_width = (float)(trails_def(frame->def)->width / 2) * frame->fineness;
    for (int k = 0; k < 3; k++)
        sight.wrap[k] = frame->world->periodic[k] ? (float)store->box_size[k] / 2 : INFINITY;
    return sight;
}

static TrailLook look_of(const TrailStore *store, const Frame *frame)
{
    return (TrailLook){.sight = sight_of(store, frame),
                       .by_cpu = store->mapped_places && store->mapped_owners &&
                                 trails_def(frame->def)->by == TRAILS_AUTO,
                       .width = frame->width,
                       .height = frame->height,
                       .scalar = view_color_by(frame->def),
                       .drops = store->ring.drops,
                       .made = store->made};
}

static bool same_numbers(const float *a, const float *b, int count)
{
    bool same = true;
    for (int i = 0; i < count; i++)
        same &= a[i] == b[i];
    return same;
}

static bool same_sight(const TrailSight *a, const TrailSight *b)
{
    return same_numbers(a->box_to_eye, b->box_to_eye, 16) && same_numbers(a->tangent, b->tangent, 2) &&
           same_numbers(a->centre, b->centre, 2) && same_numbers(a->wrap, b->wrap, 3) &&
           a->near_plane == b->near_plane && a->half_width == b->half_width;
}

static bool same_look(const TrailLook *a, const TrailLook *b)
{
    return same_sight(&a->sight, &b->sight) && a->by_cpu == b->by_cpu && a->width == b->width &&
           a->height == b->height && a->scalar == b->scalar && a->drops == b->drops && a->made == b->made;
}

static void follow_size(TrailLines *lines, const TrailLook *look)
{
    if (lines->fixed && !lines->look.by_cpu && look->width == lines->look.width &&
        look->height == lines->look.height)
        return;
    glDeleteTextures(1, &lines->fixed);
    glCreateTextures(GL_TEXTURE_2D, 1, &lines->fixed);
    glObjectLabel(GL_TEXTURE, lines->fixed, -1, "trails");
    glTextureStorage2D(lines->fixed, 1, GL_RGBA32F, look->width, look->height);
    glNamedFramebufferTexture(lines->framebuffer, GL_COLOR_ATTACHMENT0, lines->fixed, 0);
}

static void set_lines(const TrailLook *look, GLuint program)
{
    glUseProgram(program);
    glUniform1f(HALF_WIDTH_AT, look->sight.half_width);
    glUniform3fv(TRAIL_WRAP_AT, 1, look->sight.wrap);
}

static void set_color(const TrailStore *store, const Frame *frame, GLuint program, float strength)
{
    glUseProgram(program);
    glUniform1f(TRAIL_TIME_AT, (float)store->ring.now);
    glUniform2f(TRAIL_FADE_AT, (float)(1 / store->ring.length), strength);
    glUniform1ui(TRAIL_IS_FLUID_AT, view_color_by(frame->def) == SCALAR_FLUID);
}

/* Draws the pieces from column number - 1 to column `number`, with the program in use. */
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

/* Draws all columns for a new look, else the new columns. */
static void keep_by_gpu(TrailLines *lines, const TrailStore *store, const TrailLook *look)
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

/* ---- by the CPU ---- */

static TrailPoints points_of(const TrailStore *store, uint64_t number)
{
    const size_t begin = trail_store_column(store, number);
    return (TrailPoints){store->mapped_places + 4 * begin, store->mapped_owners + begin};
}

/* True if lines lead from column `from` to the later column `to`. */
static bool leads(const TrailRing *ring, uint64_t from, uint64_t to)
{
    bool joins = true;
    for (uint64_t k = from; k != to; k++)
        joins &= trail_ring_joins(ring, k + 1);
    return joins;
}

/* Pieces from numbers[1] to numbers[2]; `earlier` is numbers[0] if lines lead from there. */
static TrailPieces pieces_of(const TrailStore *store, const uint64_t numbers[3], Scalar scalar)
{
    const TrailRing *ring = &store->ring;
    const TrailColumn *from = trail_ring_at(ring, numbers[1]), *to = trail_ring_at(ring, numbers[2]);
    TrailPieces pieces = {.from = points_of(store, numbers[1]),
                          .to = points_of(store, numbers[2]),
                          .times = {(float)from->time, (float)to->time},
                          .known = from->scalar == scalar && to->scalar == scalar};
    if (leads(ring, numbers[0], numbers[1]))
        pieces.earlier = points_of(store, numbers[0]);
    return pieces;
}

/* The end column of the pieces that start at `from`: a multiple of the step, so that old pieces stay the
   same, or the last fixed column. After that the present column. */
static uint64_t next_column(const TrailLines *lines, const TrailRing *ring, uint64_t from)
{
    const uint64_t next = (from / lines->step + 1) * lines->step;
    return from + 1 < ring->end && next >= ring->end ? ring->end - 1 : from + 1 < ring->end ? next : from + 1;
}

static bool reserve(TrailLines *lines, size_t count)
{
    if (count > lines->pieces_capacity) {
        free(lines->pieces);
        lines->pieces = malloc(count * sizeof *lines->pieces);
        lines->pieces_capacity = lines->pieces ? count : 0;
    }
    return count <= lines->pieces_capacity;
}

/* Draws the columns from `first` on, and the present state. */
static bool draw_columns(TrailLines *lines, const TrailStore *store, uint64_t first)
{
    const TrailRing *ring = &store->ring;
    size_t count = 0, fixed = 0;
    if (!reserve(lines, ring->head + 1 - first))
        return false;
    uint64_t numbers[3] = {first - 2, first - 1, first};
    while (numbers[2] <= ring->head) {
        if (leads(ring, numbers[1], numbers[2]))
            lines->pieces[count++] = pieces_of(store, numbers, lines->look.scalar);
        fixed = numbers[2] < ring->end ? count : fixed;
        numbers[0] = numbers[1];
        numbers[1] = numbers[2];
        numbers[2] = next_column(lines, ring, numbers[1]);
    }
    return trail_canvas_draw(&lines->sheet, &lines->look.sight, lines->pieces, fixed, count,
                             (size_t)store->slots);
}

/* The step for a complete redraw: 1, or while the look changes so large that the def's limit of pieces
   holds. With periodic sides always 1: a long piece across a side could be taken for a short one. */
static uint64_t step_of(const TrailLines *lines, const TrailStore *store, const Frame *frame, bool changed)
{
    const double columns = (double)(store->ring.end - store->ring.begin),
                 most = trails_def(frame->def)->moving;
    const bool *periodic = frame->world->periodic, any = periodic[0] || periodic[1] || periodic[2];
    if (!changed || !frame->more || any || most == 0 || lines->look.width == 0)
        return 1;
    return (uint64_t)fmax(1, ceil(columns * store->slots / most));
}

/* Returns false if memory is short. */
static bool keep_by_cpu(TrailLines *lines, TrailStore *store, const TrailLook *look, const Frame *frame)
{
    const TrailRing *ring = &store->ring;
    const bool changed = !same_look(look, &lines->look), coarse = lines->step > 1 && !lines->twice;
    bool anew;
    trail_store_wait(store);
    if (!trail_canvas_update(&lines->sheet, look->width, look->height, &anew))
        return false;
    if (anew || changed || coarse) {
        lines->step = step_of(lines, store, frame, changed);
        lines->look = *look;
        lines->drawn = ring->begin;
        trail_canvas_clear(&lines->sheet);
    }
    const bool drawn = draw_columns(lines, store, lines->drawn > ring->begin ? lines->drawn : ring->begin);
    lines->drawn = ring->end;
    return drawn;
}

/* ---- over the view ---- */

static void show(TrailLines *lines, const TrailStore *store, const Frame *frame, GLenum test, float strength)
{
    const bool by_cpu = lines->look.by_cpu;
    glDepthFunc(test);
    set_color(store, frame, by_cpu ? lines->sheet.program : lines->show, strength);
    if (by_cpu) {
        trail_canvas_show(&lines->sheet);
        return;
    }
    glBindVertexArray(lines->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (store->ring.head < store->ring.end)
        return; /* the newest state is already in the kept picture */
    set_lines(&lines->look, lines->head);
    set_color(store, frame, lines->head, strength);
    draw_column(lines, store, store->ring.head, view_color_by(frame->def));
}

static void show_all(TrailLines *lines, const TrailStore *store, const Frame *frame)
{
    const float through = (float)trails_def(frame->def)->through;
    const bool all = frame->slab > 0; /* two dimensions: particles do not hide trails */
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(frame->depths);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glBindTextureUnit(TRAIL_LINES_UNIT, lines->fixed);
    color_table_update(&lines->colors, view_colormap(frame->def), &frame->def->color_curve);
    frame_set_scissor(frame);
    show(lines, store, frame, all ? GL_ALWAYS : GL_GEQUAL, 1);
    if (through > 0 && !all && !frame->depths)
        show(lines, store, frame, GL_LESS, through);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

static void keep(TrailLines *lines, TrailStore *store, const TrailLook *look, const Frame *frame)
{
    TrailLook by_gpu = *look;
    if (look->by_cpu && keep_by_cpu(lines, store, look, frame))
        return;
    by_gpu.by_cpu = false;
    lines->step = 1;
    follow_size(lines, &by_gpu);
    trail_store_bind(store);
    keep_by_gpu(lines, store, &by_gpu);
}

void trail_lines_draw(TrailLines *lines, TrailStore *store, const Frame *frame)
{
    if (store->slots == 0 || store->ring.end == store->ring.begin)
        return;
    const TrailLook look = look_of(store, frame);
    keep(lines, store, &look, frame);
    lines->twice = frame->depths;
    show_all(lines, store, frame);
}

bool trail_lines_unfinished(const TrailLines *lines)
{
    return lines->step > 1;
}
