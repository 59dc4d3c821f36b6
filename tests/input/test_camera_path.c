/* Automatic cameras: at a keyframe the camera has the key's pose, in between the path is smooth. */
#include "render/frame/frame.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static ViewDef flying(void)
{
    ViewDef def = view_def_shared();
    static const CameraKey path[] = {
        {1, {{1, 2, 3}, {0, 0, 0}, 30}}, {2, {{2, 2, 0.1}, {0, 1, 0}, 50}}, {5, {{2, 0, -3}, {0, 1, 1}, 40}}};
    def.camera_path_count = 3;
    def.camera_path = path;
    return def;
}

static void test_keyframes(void **state)
{
    (void)state;
    const ViewDef def = flying();
    for (int i = 0; i < 3; i++) {
        const ViewDef at = camera_at(&def, def.camera_path[i].time);
        assert_false(at.camera_auto);
        assert_memory_equal(&at.camera, &def.camera_path[i].at, sizeof at.camera);
    }
    const ViewDef before = camera_at(&def, 0), after = camera_at(&def, 99);
    assert_memory_equal(&before.camera, &def.camera_path[0].at, sizeof before.camera);
    assert_memory_equal(&after.camera, &def.camera_path[2].at, sizeof after.camera);
}

static double x_at(const ViewDef *def, double time)
{
    return camera_at(def, time).camera.from[2];
}

/* Velocities from both sides agree, and equal the manual's. */
static void test_no_corner(void **state)
{
    (void)state;
    static const double E = 1e-6;
    const ViewDef def = flying();
    const double wanted[] = {0, (-3 - 3.) / 4, 0};
    for (int i = 0; i < 3; i++) {
        const double t = def.camera_path[i].time, x = x_at(&def, t);
        assert_true(fabs((x - x_at(&def, t - E)) / E - wanted[i]) < 1e-4);
        assert_true(fabs((x_at(&def, t + E) - x) / E - wanted[i]) < 1e-4);
    }
}

static void test_turn(void **state)
{
    (void)state;
    ViewDef def = view_def_shared();
    def.camera_auto = false;
    def.camera = (CameraDef){{3, 1, 0}, {1, 0, 0}, 32};
    def.camera_turn = 45;
    const ViewDef at = camera_at(&def, 2); /* a quarter */
    assert_true(fabs(at.camera.from[0] - 1) < 1e-12 && at.camera.from[1] == 1 &&
                fabs(at.camera.from[2] + 2) < 1e-12);
    camera_stop(&def);
    assert_true(def.camera_turn == 0 && def.camera_path_count == 0);
    assert_memory_equal(camera_at(&def, 2).camera.from, def.camera.from, sizeof def.camera.from);
}

/* An automatic camera goes round the box at constant distance, with all of the box in view. */
static void test_turn_about_the_box(void **state)
{
    (void)state;
    ViewDef def = view_def_shared();
    const double size[3] = {2, 0.5, 0.7};
    const BoxState box = {.orientation = {0, 0, 0, 1}};
    float first = 0;
    def.camera_turn = 10;
    for (int second = 0; second < 36; second += 3) {
        Camera camera;
        const ViewDef at = camera_at(&def, second);
        camera_make(&at, size, &box, 1.5, (CoveredParts){0}, &camera);
        const float away = hypotf(camera.eye[0], camera.eye[2]);
        first = second == 0 ? away : first;
        assert_true(fabsf(away - first) < 1e-4F * first);
        for (int corner = 0; corner < 8; corner++) {
            double depth, pixel[2], point[3];
            for (int k = 0; k < 3; k++)
                point[k] = ((corner >> k & 1) - (k == 1 ? 0 : 0.5)) * size[k];
            assert_true(camera_project(&camera, point, 150, 100, pixel, &depth));
            assert_true(pixel[0] > 0 && pixel[0] < 150 && pixel[1] > 0 && pixel[1] < 100);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_keyframes), cmocka_unit_test(test_no_corner),
                                       cmocka_unit_test(test_turn),
                                       cmocka_unit_test(test_turn_about_the_box)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
