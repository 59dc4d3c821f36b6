/* The time line: the bar gives the time under a held mouse, the buttons give actions, and no text is cut
   off. */
#include "tests/render/ui_fixture.h"

#include "app/input/actions.h"
#include "app/window/panel/panel.h"

typedef struct Line {
    TimelineData data;
    float left;
    TimelineEvents last;      /* of the last frame that was built */
    const UserAction *action; /* the last */
    int wishes;
} Line;

static void draw_line(void *user, Desk *desk)
{
    Line *line = user;
    timeline_draw(desk->ui, desk->target.width, desk->target.height, line->left, &line->data, &line->last);
    line->wishes += line->last.wants_time;
    if (line->last.action)
        line->action = line->last.action;
}

static Desk *open_line(Line *line, int width, float pixels)
{
    Desk *desk = calloc(1, sizeof *desk);
    assert_non_null(desk);
    desk_open(desk, width, 300, pixels);
    *line = (Line){.data = {.from = 2, .to = 12, .now = 4.5, .grows = true}};
    desk->draw = draw_line;
    desk->user = line;
    desk_frames(desk, 10);
    return desk;
}

static void close_line(Desk *desk)
{
    desk_close(desk);
    free(desk);
}

/* A new window needs frames for layout; drawing the requested frames completes the layout. */
static void it_asks_for_frames_until_it_is_in_place(void **state)
{
    (void)state;
    Line line = {.data = {.from = 2, .to = 12, .now = 4.5}};
    Desk *desk = calloc(1, sizeof *desk);
    assert_non_null(desk);
    desk_open(desk, 800, 300, 13);
    desk->draw = draw_line;
    desk->user = &line;
    int frames = 0;
    do
        desk_frames(desk, 1);
    while (ui_needs_redraw(desk->ui) && ++frames < 10);
    assert_in_range(frames, 1, 9);
    const Seen *bar = desk_find(desk, "time");
    assert_non_null(bar);
    const Seen before = *bar;
    desk->input.changed = true;
    desk_frames(desk, 5);
    assert_memory_equal(desk_find(desk, "time")->rect, before.rect, sizeof before.rect);
    close_line(desk);
}

static void the_bar_gives_the_time_under_the_mouse(void **state)
{
    (void)state;
    Line line;
    Desk *desk = open_line(&line, 800, 13);
    Seen bar = {.needed = 0};
    if (desk_find(desk, "time"))
        bar = *desk_find(desk, "time");
    const float y = (bar.rect[1] + bar.rect[3]) / 2, wide = bar.rect[2] - bar.rect[0];
    assert_true(wide > 300);
    desk_move(desk, bar.rect[0] + 0.25F * wide, y); /* whole pixels count */
    assert_int_equal(line.wishes, 0);               /* resting there asks for nothing */
    desk_press(desk, true);
    assert_true(line.last.wants_time);
    assert_true(fabs(line.last.time - 4.5) < 10 / wide);
    desk_move(desk, bar.rect[0] + 0.75F * wide, y - 200); /* held, though far above */
    assert_true(line.last.wants_time && fabs(line.last.time - 9.5) < 10 / wide);
    desk_move(desk, 0, y);
    assert_true(line.last.wants_time && line.last.time == 2);
    desk_move(desk, 5000, y);
    assert_true(line.last.wants_time && line.last.time == 12);
    desk_press(desk, false);
    assert_false(line.last.wants_time);
    const int wishes = line.wishes;
    desk_move(desk, bar.rect[0] + 0.5F * wide, y);
    assert_int_equal(line.wishes, wishes);
    assert_null(line.action);
    close_line(desk);
}

static void buttons_give_their_actions(void **state)
{
    (void)state;
    static const UserAction *const actions[] = {&action_pause, &action_step_back, &action_step,
                                                &action_newest};
    Line line;
    Desk *desk = open_line(&line, 800, 13);
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++) {
        desk_click_at(desk, actions[i]->name, 0.5F);
        assert_ptr_equal(line.action, actions[i]);
    }
    assert_int_equal(line.wishes, 0);
    close_line(desk);
}

/* From the narrowest window with a bar to a wide window, also beside a panel. */
static void all_stands_in_the_window(void **state)
{
    (void)state;
    static const int widths[] = {300, 500, 1280, 3000};
    for (int i = 0; i < 8; i++) {
        Line line;
        const int width = widths[i / 2];
        Desk *desk = open_line(&line, width, i % 2 ? 26 : 13);
        line.left = i % 2 && width > 1000 ? 400 : 0;
        line.data = (TimelineData){.from = 1234.56, .to = 2345.67, .now = 5000};
        desk->input.changed = true;
        desk_frames(desk, 5);
        for (int k = 0; k < desk->seen_count; k++) {
            const Seen *seen = &desk->seen[k];
            if (seen->rect[0] < line.left || seen->rect[3] > 300 || seen->rect[1] < 300 - 4 * 26 ||
                seen->needed > seen->rect[2] - seen->rect[0] + 1)
                fail_msg("%s is cut off in %d pixels", seen->id, width);
        }
        assert_non_null(desk_find(desk, "time"));
        close_line(desk);
    }
}

/* A single state: the bar is complete, and gives the state's time. */
static void a_stretch_without_length_works(void **state)
{
    (void)state;
    Line line;
    Desk *desk = open_line(&line, 800, 13);
    line.data.from = line.data.to = line.data.now = 3;
    desk_click_at(desk, "time", 0.3F);
    assert_true(line.wishes > 0 && line.last.time == 3);
    close_line(desk);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(it_asks_for_frames_until_it_is_in_place, no_gl_errors),
        cmocka_unit_test_teardown(the_bar_gives_the_time_under_the_mouse, no_gl_errors),
        cmocka_unit_test_teardown(buttons_give_their_actions, no_gl_errors),
        cmocka_unit_test_teardown(all_stands_in_the_window, no_gl_errors),
        cmocka_unit_test_teardown(a_stretch_without_length_works, no_gl_errors)};
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
