/* The widgets over a picture: drawing, mouse and keys, and conditions for running. */
#include "tests/render/ui_fixture.h"

#include "render/ui/text.h"

/* A window at a place with a widget of each kind. */
typedef struct Form {
    double value, pair[2];
    bool on;
    int chosen, presses;
    float color[3];
    bool section;
    bool changed; /* some widget said so, in any frame */
} Form;

static const UiScale linear = {.low = 0, .high = 100, .least = -5, .most = 1000, .unit = "m"};
static const UiWindow form_window = {
    .id = "form", .place = {40, 30}, .width = 300, .height_most = 500, .label_share = 0.4F};

static const char *const fruit[] = {"apple", "pear", "plum", NULL};

static void draw_form(void *user, Desk *desk)
{
    Form *form = user;
    Ui *ui = desk->ui;
    ui_window_begin(ui, &form_window);
    ui_row(ui, "a line", "of text");
    form->changed |= ui_sliders(ui, &(UiField){"value", "length", "how long"}, &form->value, 1, &linear);
    form->changed |= ui_sliders(ui, &(UiField){"pair", "ends", NULL}, form->pair, 2, &linear);
    form->changed |= ui_checkbox(ui, &(UiField){"on", "switch", NULL}, &form->on);
    form->changed |= ui_choice(ui, &(UiField){"fruit", "kind", NULL}, &form->chosen, fruit);
    form->changed |= ui_color(ui, &(UiField){"color", "colour", NULL}, form->color);
    form->presses += ui_button(ui, &(UiField){"press", "push", NULL}, false);
    form->section = ui_section(ui, "More", false);
    if (form->section)
        ui_text(ui, "below");
    ui_window_end(ui);
}

static Desk *form_open(Form *form)
{
    Desk *desk = calloc(1, sizeof *desk);
    assert_non_null(desk);
    desk_open(desk, 640, 480, 13);
    *form = (Form){.value = 10};
    desk->draw = draw_form;
    desk->user = form;
    desk_frames(desk, 30);
    return desk;
}

static void form_close(Desk *desk)
{
    desk_close(desk);
    free(desk);
}

/* A window with a curve of 0 to 2 alone. */
static void draw_curve_form(void *user, Desk *desk)
{
    ui_window_begin(desk->ui, &form_window);
    ui_curve(desk->ui, &(UiField){"curve", "bend", NULL}, user, 2);
    ui_window_end(desk->ui);
}

/* Where a value stands on the screen, found as a person would: by the ends of the box less the margin. */
static void curve_spot(const Desk *desk, double x, double y, float spot[2])
{
    const float *box = desk_find(desk, "curve")->rect, margin = 0.4F * 13;
    spot[0] = box[0] + margin + (float)x * (box[2] - box[0] - 2 * margin);
    spot[1] = box[3] - margin - (float)(y / 2) * (box[3] - box[1] - 2 * margin);
}

static void drag(Desk *desk, const float from[2], const float to[2])
{
    desk_move(desk, from[0], from[1]);
    desk_press(desk, true);
    desk_move(desk, (from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
    desk_move(desk, to[0], to[1]);
    desk_press(desk, false);
    desk_frames(desk, 30); /* the next press is no second one */
}

static void right_click(Desk *desk, const float spot[2])
{
    desk_move(desk, spot[0], spot[1]);
    desk->input.button[1] = true;
    desk_frames(desk, 2);
    desk->input.button[1] = false;
    desk_frames(desk, 2);
}

static void test_curves_are_edited_by_the_mouse(void **state)
{
    (void)state;
    Desk *desk = calloc(1, sizeof *desk);
    ControlPoints points = {2, {0, 1}, {0, 2}};
    float from[2], to[2];
    assert_non_null(desk);
    desk_open(desk, 640, 480, 13);
    desk->draw = draw_curve_form;
    desk->user = &points;
    desk_frames(desk, 30);
    curve_spot(desk, 0.25, 1.5, from);
    desk_click(desk, from[0], from[1]); /* a click in the empty area has no effect */
    desk_frames(desk, 30);
    assert_int_equal(points.count, 2);
    desk_click(desk, from[0], from[1]);
    desk_click(desk, from[0], from[1]);
    assert_int_equal(points.count, 3);
    assert_true(fabs(points.x[1] - 0.25) < 0.01 && fabs(points.y[1] - 1.5) < 0.04);
    desk_frames(desk, 30);
    curve_spot(desk, 0.75, 0.5, to);
    drag(desk, from, to);
    assert_int_equal(points.count, 3);
    assert_true(fabs(points.x[1] - 0.75) < 0.01 && fabs(points.y[1] - 0.5) < 0.04);
    from[0] = to[0] + 500, from[1] = to[1] - 300; /* beyond its neighbour and the box */
    drag(desk, to, from);
    assert_true(fabs(points.x[1] - (1 - CONTROL_POINTS_GAP)) < 1e-9 && points.y[1] == 2);
    curve_spot(desk, 0.5, 1, to);
    right_click(desk, to); /* in the empty */
    assert_int_equal(points.count, 3);
    curve_spot(desk, points.x[0], points.y[0], to);
    right_click(desk, to);
    assert_int_equal(points.count, 2);
    for (int i = 0; i < 2; i++) {
        curve_spot(desk, points.x[0], points.y[0], to);
        right_click(desk, to);
    }
    assert_int_equal(points.count, 1); /* the last stays */
    form_close(desk);
}

/* An open list has the keys; Escape closes it alone and chooses nothing. */
static void test_escape_closes_an_open_list(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    const float *box = desk_find(desk, "fruit")->rect;
    assert_false(ui_wants_keys(desk->ui));
    desk_click(desk, (box[0] + box[2]) / 2, (box[1] + box[3]) / 2);
    desk_frames(desk, 10);
    assert_true(ui_wants_keys(desk->ui));
    desk->input.keys = UI_KEY_ESCAPE;
    desk_frames(desk, 2);
    desk->input.keys = 0;
    desk_frames(desk, 2);
    assert_false(ui_wants_keys(desk->ui));
    assert_int_equal(form.chosen, 0);
    assert_false(form.changed);
    form_close(desk);
}

static void test_scale_goes_there_and_back(void **state)
{
    (void)state;
    const UiScale log = {
        .low = 0.002, .high = 0.2, .logarithmic = true, .least = 1e-7, .most = 1, .unit = "s"};
    const UiScale whole = {.low = 1, .high = 40, .whole = true, .least = 1, .most = 10000, .unit = ""};
    assert_true(fabs(ui_scale_share(&log, 0.02) - 0.5) < 1e-12);
    assert_true(ui_scale_value(&log, 0.5) == 0.02);
    assert_true(ui_scale_value(&log, 0) == 0.002 && ui_scale_value(&log, 1) == 0.2);
    assert_true(ui_scale_share(&log, 0) == 0 && ui_scale_share(&log, 5) == 1);
    assert_true(ui_scale_value(&linear, 0.123) == 12 && ui_scale_share(&linear, 25) == 0.25);
    assert_true(ui_scale_value(&linear, -3) == 0 && ui_scale_value(&linear, 7) == 100);
    assert_true(ui_scale_value(&whole, 0.5) == floor(ui_scale_value(&whole, 0.5)));
    assert_true(ui_scale_typed(&whole, 3.4) == 3 && ui_scale_typed(&whole, 1e30) == 10000);
    assert_true(ui_scale_typed(&linear, -1e9) == -5 && ui_scale_typed(&linear, INFINITY) == 1000);
}

static void test_scale_has_no_more_digits_than_are_shown(void **state)
{
    (void)state;
    const UiScale log = {
        .low = 0.5, .high = 50, .logarithmic = true, .least = 0, .most = 1e6, .unit = "Pa s"};
    for (int i = 0; i <= 1000; i++) {
        char text[48];
        const double value = ui_scale_value(i % 2 ? &log : &linear, i / 1000.0);
        ui_scale_text(i % 2 ? &log : &linear, value, text, sizeof text);
        assert_true(strtod(text, NULL) == value);
    }
    char text[48];
    const UiScale chosen = {.low = 0, .high = 10, .most = 10, .unit = "m", .zero = "auto"};
    ui_scale_text(&chosen, 0, text, sizeof text);
    assert_string_equal(text, "auto");
    ui_scale_text(&chosen, 0.5, text, sizeof text);
    assert_string_equal(text, "0.5 m");
}

static void test_draws_in_its_window_and_nowhere_else(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    desk_clear(desk);
    desk_frame(desk);
    uint8_t *rgb = desk_read(desk);
    int top = 480, bottom = 0, inside = 0;
    for (int y = 0; y < 480; y++)
        for (int x = 0; x < 640; x++)
            if (!is_cleared(&rgb[3 * (y * 640 + x)])) {
                assert_true(x >= 40 && x < 340);
                top = y < top ? y : top;
                bottom = y > bottom ? y : bottom;
                inside++;
            }
    assert_int_equal(top, 30);
    assert_int_equal(inside, 300 * (bottom - top + 1)); /* opaque */
    assert_in_range(bottom, 30 + 8 * 13, 30 + 14 * 13); /* as high as eight lines need */
    free(rgb);
    form_close(desk);
}

static void test_a_copy_is_the_same_picture(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    while (!desk_frame(desk))
        continue;
    uint8_t *built = desk_read(desk);
    desk_clear(desk);
    assert_false(desk_frame(desk));
    uint8_t *copied = desk_read(desk);
    assert_memory_equal(built, copied, 3 * 640 * 480);
    free(built);
    free(copied);
    form_close(desk);
}

static void test_runs_only_when_it_must(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    desk->built = 0;
    desk_frames(desk, 120); /* two seconds */
    assert_in_range(desk->built, 8, 11);
    for (int i = 0; i < 60; i++) { /* a drag outside */
        desk->input.mouse[0] = 500 + (float)i;
        desk->input.button[0] = true;
        desk_frame(desk);
    }
    assert_in_range(desk->built, 12, 17);
    desk->input.button[0] = false;
    desk_frames(desk, 30);
    for (int i = 0; i < 30; i++) { /* over the widget */
        desk->input.mouse[0] = 60 + (float)i;
        desk->input.mouse[1] = 50;
        assert_true(desk_frame(desk));
    }
    desk_move(desk, 600, 400);
    desk_frames(desk, 30);
    while (desk_frame(desk))
        continue;
    desk->input.changed = true;
    assert_true(desk_frame(desk));
    form_close(desk);
}

static void test_slider_takes_the_place_of_the_mouse(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    desk_click_at(desk, "value", 0.25F);
    assert_true(form.changed && fabs(form.value - 25) < 1);
    const Seen *seen = desk_find(desk, "value");
    const float y = (seen->rect[1] + seen->rect[3]) / 2;
    desk_move(desk, seen->rect[0] + 5, y);
    desk_press(desk, true);
    desk_move(desk, seen->rect[2] + 100, 400); /* beyond its end, and off the window */
    assert_true(ui_wants_mouse(desk->ui));
    assert_true(form.value == 100);
    desk_press(desk, false);
    desk_click_at(desk, "pair", 0.75F);
    assert_true(form.pair[0] == 0 && fabs(form.pair[1] - 50) < 2);
    form_close(desk);
}

static void type_over(Desk *desk, const char *text)
{
    desk->input.keys = UI_KEY_CTRL;
    desk_click_at(desk, "value", 0.5F);
    desk->input.keys = 0;
    desk_frames(desk, 3);
    assert_true(ui_wants_keys(desk->ui));
    desk_type(desk, text);
}

static void test_typed_numbers_count_when_they_are_whole(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    type_over(desk, "0.0625");
    assert_true(form.value == 10 && !form.changed);
    desk_key(desk, UI_KEY_ENTER);
    assert_true(form.value == 0.0625 && form.changed);
    assert_false(ui_wants_keys(desk->ui));
    type_over(desk, "77");
    desk_key(desk, UI_KEY_ESCAPE);
    assert_true(form.value == 0.0625);
    type_over(desk, "1e300");
    desk_key(desk, UI_KEY_ENTER);
    assert_true(form.value == 1000);
    type_over(desk, "12");
    desk_click(desk, 600, 400); /* left by a click elsewhere */
    assert_true(form.value == 12);
    type_over(desk, "");
    form.changed = false;
    desk_key(desk, UI_KEY_ENTER); /* unchanged */
    assert_true(form.value == 12 && !form.changed);
    form_close(desk);
}

static void test_other_widgets(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    desk_click_at(desk, "on", 0.5F);
    assert_true(form.on);
    desk_click_at(desk, "press", 0.5F);
    assert_int_equal(form.presses, 1);
    desk_click_at(desk, "More", 0.2F);
    assert_true(form.section);
    desk_click_at(desk, "fruit", 0.5F);
    const Seen *box = desk_find(desk, "fruit");
    const float line = box->rect[3] - box->rect[1];
    desk_click(desk, box->rect[0] + 10, box->rect[3] + 1.5F * line);
    assert_int_equal(form.chosen, 1);
    desk_click_at(desk, "color", 0.5F);
    box = desk_find(desk, "color");
    desk_click(desk, (box->rect[0] + box->rect[2]) / 2 + 40, box->rect[3] + 40);
    assert_true(form.color[0] + form.color[1] + form.color[2] > 0);
    form_close(desk);
}

static void test_whose_is_the_mouse(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    assert_true(ui_covers(desk->ui, 40, 30) && ui_covers(desk->ui, 339, 60));
    assert_false(ui_covers(desk->ui, 39, 30) || ui_covers(desk->ui, 340, 60) || ui_covers(desk->ui, 100, 29));
    desk_move(desk, 100, 60);
    assert_true(ui_wants_mouse(desk->ui));
    desk_move(desk, 500, 60);
    desk_frames(desk, 4);
    assert_false(ui_wants_mouse(desk->ui));
    desk_press(desk, true); /* a drag of the picture over the window stays the picture's */
    desk_move(desk, 100, 60);
    assert_false(ui_wants_mouse(desk->ui));
    form_close(desk);
}

static int pixels_outside(const Desk *desk)
{
    int count = 0;
    uint8_t *rgb = desk_read(desk);
    for (int y = 0; y < 480; y++)
        for (int x = 0; x < 640; x++)
            count += (x < 40 || x >= 340) && !is_cleared(&rgb[3 * (y * 640 + x)]);
    free(rgb);
    return count;
}

static void test_help_appears_when_the_mouse_rests(void **state)
{
    (void)state;
    Form form;
    Desk *desk = form_open(&form);
    const Seen *seen = desk_find(desk, "value");
    desk_clear(desk);
    desk_move(desk, seen->rect[2] - 5, seen->rect[3] - 4);
    desk_frames(desk, 6);
    assert_int_equal(pixels_outside(desk), 0);
    desk_frames(desk, 60);
    assert_true(pixels_outside(desk) > 200); /* "how long" */
    form_close(desk);
}

/* Each keeps separate letters and state, in any order of use. */
static void test_beside_a_text(void **state)
{
    (void)state;
    Form form;
    Error error = {{0}};
    Desk *desk = form_open(&form);
    Text *text = text_create(20, &error);
    assert_non_null(text);
    assert_true(text_height(text) ==
                20); /* before any words too: the window makes letters anew while it differs */
    int ink = 0;
    desk_clear(desk);
    desk->input.changed = true;
    text_begin(text, 640, 480);
    assert_true(desk_frame(desk));
    text_draw(text, 400, 100, 1, 0xffffffff, TEXT_LEFT, "both");
    desk_frame(desk);
    text_end(text);
    desk_frame(desk);
    uint8_t *rgb = desk_read(desk);
    for (int y = 100; y < 120; y++)
        for (int x = 400; x < 450; x++)
            ink += rgb[3 * (y * 640 + x) + 1] > 100;
    assert_true(ink > 50 && !is_cleared(&rgb[3 * (60 * 640 + 100)]));
    free(rgb);
    text_destroy(text);
    desk_frame(desk);
    desk_click_at(desk, "value", 0.5F);
    assert_true(form.changed);
    form_close(desk);
}

static void test_letters_of_any_size(void **state)
{
    (void)state;
    static const float sizes[] = {26, 19.5F, 39, 13};
    Form form;
    Error error = {{0}};
    Desk *desk = form_open(&form);
    for (int i = 0; i < 4; i++) {
        assert_true(ui_set_pixels(desk->ui, sizes[i], &error));
        assert_true(ui_pixels(desk->ui) == sizes[i]);
        desk_frames(desk, 3);
        const Seen *seen = desk_find(desk, "value");
        assert_true(seen->rect[3] - seen->rect[1] > sizes[i] &&
                    seen->rect[3] - seen->rect[1] < 1.6F * sizes[i]);
    }
    form_close(desk);
}

static void test_no_picture_is_too_small(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {0, 0}, {3, 500}, {640, 480}};
    Form form;
    Desk *desk = form_open(&form);
    desk->input.changed = true;
    for (int i = 0; i < 4; i++) {
        if (ui_begin(desk->ui, sizes[i][0], sizes[i][1], &desk->input)) {
            desk->seen_count = 0;
            draw_form(&form, desk);
        }
        ui_end(desk->ui);
        assert_true(i > 1 || !ui_covers(desk->ui, 50, 50));
    }
    form_close(desk);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_curves_are_edited_by_the_mouse, no_gl_errors),
        cmocka_unit_test_teardown(test_escape_closes_an_open_list, no_gl_errors),
        cmocka_unit_test(test_scale_goes_there_and_back),
        cmocka_unit_test(test_scale_has_no_more_digits_than_are_shown),
        cmocka_unit_test_teardown(test_draws_in_its_window_and_nowhere_else, no_gl_errors),
        cmocka_unit_test_teardown(test_a_copy_is_the_same_picture, no_gl_errors),
        cmocka_unit_test_teardown(test_runs_only_when_it_must, no_gl_errors),
        cmocka_unit_test_teardown(test_slider_takes_the_place_of_the_mouse, no_gl_errors),
        cmocka_unit_test_teardown(test_typed_numbers_count_when_they_are_whole, no_gl_errors),
        cmocka_unit_test_teardown(test_other_widgets, no_gl_errors),
        cmocka_unit_test_teardown(test_whose_is_the_mouse, no_gl_errors),
        cmocka_unit_test_teardown(test_help_appears_when_the_mouse_rests, no_gl_errors),
        cmocka_unit_test_teardown(test_beside_a_text, no_gl_errors),
        cmocka_unit_test_teardown(test_letters_of_any_size, no_gl_errors),
        cmocka_unit_test_teardown(test_no_picture_is_too_small, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
