/* The plane of the view slice: playback range, and settings by drags and keys. */
#include "tests/render/fixture.h"

#include "render/views/slice/slice_private.h"

static const double BOX[3] = {2, 1, 0.5};

static ParticleBuffers state_at(double time)
{
    ParticleBuffers state = {.count = 1, .spacing = 0.05, .support_radius = 0.1, .time = time};
    memcpy(state.box_size, BOX, sizeof state.box_size);
    state.box.orientation[3] = 1;
    return state;
}

static ViewDef view_of(const double point[3], const double normal[3])
{
    ViewDef view = view_def_default();
    text_set(view.kind, "slice");
    memcpy(slice_def(&view)->point, point, sizeof(double[3]));
    memcpy(slice_def(&view)->normal, normal, sizeof(double[3]));
    return view;
}

static void assert_point(const double found[3], double x, double y, double z)
{
    const double off = fabs(found[0] - x) + fabs(found[1] - y) + fabs(found[2] - z);
    if (!(off < 1e-5))
        fail_msg("%g %g %g, wanted %g %g %g", found[0], found[1], found[2], x, y, z);
}

static void it_plays_to_and_fro_through_the_box(void **state)
{
    (void)state;
    ViewDef view = view_of((double[3]){0.5, 0.2, 0.1}, (double[3]){3, 0, 0});
    SliceDef *def = slice_def(&view);
    double point[3];
    def->play = 0.2;
    slice_point(def, BOX, 0, point);
    assert_point(point, 0.5, 0.2, 0.1);
    slice_point(def, BOX, 1, point);
    assert_point(point, 0.7, 0.2, 0.1);
    slice_point(def, BOX, 2.5, point);
    assert_point(point, 1, 0.2, 0.1);
    slice_point(def, BOX, 5, point);
    assert_point(point, 0.5, 0.2, 0.1); /* on the way back */
    slice_point(def, BOX, 12.5, point);
    assert_point(point, -1, 0.2, 0.1);
    slice_point(def, BOX, 20 * 1001, point); /* whole rounds of 4 m */
    assert_point(point, 0.5, 0.2, 0.1);
    def->play = -0.2;
    slice_point(def, BOX, 1, point);
    assert_point(point, 0.3, 0.2, 0.1);
    def->play = 0;
    slice_point(def, BOX, 1, point);
    assert_point(point, 0.5, 0.2, 0.1);
    def->play = 0.2;
    def->point[0] = 7; /* beside the box: from its face on */
    slice_point(def, BOX, 1, point);
    assert_point(point, 0.8, 0.2, 0.1);
}

static void handles_are_on_the_plane_in_the_box(void **state)
{
    (void)state;
    ViewDef view = view_of((double[3]){5, 0.3, 0}, (double[3]){0, 0, 2});
    ParticleBuffers particles = state_at(0);
    Handle handles[HANDLES_MAX];
    assert_int_equal(slice_handles(&view, &particles, handles), 3);
    assert_point(handles[0].at, 1, 0.3, 0); /* the nearest place in the box */
    assert_point(handles[0].axis, 0, 0, 1);
    assert_true(handles[2].at[2] > 0.1 && handles[2].at[0] == 1);
    slice_def(&view)->show = SLICE_FLAT;
    assert_int_equal(slice_handles(&view, &particles, handles), 0);
    slice_def(&view)->show = SLICE_PLANE;
    slice_def(&view)->point[2] = 1; /* beside the box */
    assert_int_equal(slice_handles(&view, &particles, handles), 0);
}

/* Reads "path=[x, y, z]". */
static void assert_setting(const ViewSetting *setting, const char *path, double x, double y, double z)
{
    double v[3];
    char name[64];
    if (sscanf(setting->text, "%63[^=]=[%lf, %lf, %lf]", name, &v[0], &v[1], &v[2]) != 4)
        fail_msg("%s", setting->text);
    assert_string_equal(name, path);
    assert_point(v, x, y, z);
}

static void drags_become_settings(void **state)
{
    (void)state;
    ViewDef view = view_of((double[3]){0.1, 0.3, 0}, (double[3]){0, 1, 0});
    ParticleBuffers particles = state_at(1);
    Handle handles[HANDLES_MAX];
    ViewSetting settings[VIEW_SETTINGS_MAX];
    slice_handles(&view, &particles, handles);
    assert_int_equal(slice_drag(&view, &particles, 0, &handles[0], (double[3]){0.1, 0.7, 0}, settings), 1);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.7, 0);
    assert_int_equal(slice_drag(&view, &particles, 0, &handles[0], (double[3]){0.1, 9, 0}, settings), 1);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.999, 0); /* it stays in the box */
    double at[3] = {handles[1].at[0] + 0.2, 0.3, handles[1].at[2]};
    assert_int_equal(slice_drag(&view, &particles, 1, &handles[1], at, settings), 1);
    assert_setting(&settings[0], "view.slice.point", 0.3, 0.3, 0);
    slice_def(&view)->play = 0.1; /* stationary at the grab */
    slice_handles(&view, &particles, handles);
    assert_point(handles[0].at, 0.1, 0.4, 0);
    for (int k = 0; k < 3; k++)
        at[k] = handles[2].from[k] + (const double[3]){0.3, 0, 0.4}[k];
    assert_int_equal(slice_drag(&view, &particles, 2, &handles[2], at, settings), 3);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.4, 0);
    assert_string_equal(settings[1].text, "view.slice.play=0");
    assert_setting(&settings[2], "view.slice.normal", 0.6, 0, 0.8);
}

static void keys_become_settings(void **state)
{
    (void)state;
    ViewDef view = view_of((double[3]){0.1, 0.3, 0}, (double[3]){0, 0, 1});
    ParticleBuffers particles = state_at(0);
    ViewSetting settings[VIEW_SETTINGS_MAX];
    const double c = cos(M_PI / 36), s = sin(M_PI / 36);
    static const struct {
        ViewStep step;
        double x, y, z;
    } turns[] = {{VIEW_STEP_LEFT, -1, 0, 0},
                 {VIEW_STEP_RIGHT, 1, 0, 0},
                 {VIEW_STEP_UP, 0, 1, 0},
                 {VIEW_STEP_DOWN, 0, -1, 0}};
    assert_int_equal(slice_step(&view, &particles, VIEW_STEP_FORWARD, settings), 1);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.3, 0.01);
    assert_int_equal(slice_step(&view, &particles, VIEW_STEP_BACK, settings), 1);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.3, -0.01);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(slice_step(&view, &particles, turns[i].step, settings), 2);
        assert_setting(&settings[1], "view.slice.normal", s * turns[i].x, s * turns[i].y, c);
    }
    /* across an axis through the middle of the fluid, or of the box without any */
    const float at[3][4] = {{-0.7F, 0.1F, 0.1F}, {NAN, 0.1F, 0}, {-0.3F, 0.3F, 0.2F}};
    for (int axis = 0; axis < 3; axis++) {
        particles.position = (ParticleAttribute){0};
        slice_step(&view, &particles, (ViewStep)(VIEW_STEP_X + axis), settings);
        assert_setting(&settings[0], "view.slice.point", 0, 0.5, 0);
        particles.count = 3;
        particles.position.stride = sizeof at[0];
        glCreateBuffers(1, &particles.position.buffer);
        glNamedBufferStorage(particles.position.buffer, sizeof at, at, 0);
        assert_int_equal(slice_step(&view, &particles, (ViewStep)(VIEW_STEP_X + axis), settings), 2);
        assert_setting(&settings[0], "view.slice.point", -0.5, 0.2, 0.15);
        glDeleteBuffers(1, &particles.position.buffer);
        assert_setting(&settings[1], "view.slice.normal", axis == 0, axis == 1, axis == 2);
    }
    slice_def(&view)->point[2] = 3; /* beside the box: a step brings it back */
    slice_step(&view, &particles, VIEW_STEP_FORWARD, settings);
    assert_setting(&settings[0], "view.slice.point", 0.1, 0.3, 0.2495);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_plays_to_and_fro_through_the_box),
        cmocka_unit_test(handles_are_on_the_plane_in_the_box),
        cmocka_unit_test(drags_become_settings),
        cmocka_unit_test(keys_become_settings),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
