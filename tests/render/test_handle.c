/* Handles (render/frame/frame.h): pixels and rays, which one is under the mouse, where drags take them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/frame/frame.h"
#include "render/renderer.h"

#include <math.h>
#include <string.h>

enum { WIDE = 400, HIGH = 300 };

/* A moved and turned box, seen by a fixed camera. */
static Sight sight_from(double x, double y, double z)
{
    static const double size[3] = {1, 1, 1};
    Sight sight = {.box = {.position = {0.3, -0.2, 0.1}, .orientation = {0, 0, 0, 1}},
                   .width = WIDE,
                   .height = HIGH,
                   .reach = 10};
    ViewDef def = view_def_default();
    quat_turn((double[3]){0.2, 0.5, -0.1}, sight.box.orientation);
    def.camera_auto = false;
    memcpy(def.camera.from, (double[3]){x, y, z}, sizeof def.camera.from);
    memcpy(def.camera.to, sight.box.position, sizeof def.camera.to);
    def.camera.fov_deg = 45;
    camera_make(&def, size, &sight.box, (double)WIDE / HIGH, (CoveredParts){0}, &sight.camera);
    return sight;
}

static double distance(const double a[3], const double b[3])
{
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

static void assert_near(const double found[3], const double wanted[3], double bound)
{
    if (!(distance(found, wanted) < bound))
        fail_msg("%g %g %g, wanted %g %g %g", found[0], found[1], found[2], wanted[0], wanted[1], wanted[2]);
}

static void a_ray_goes_through_what_its_pixel_shows(void **state)
{
    (void)state;
    Sight sight = sight_from(1.5, 1, 2);
    const double places[][3] = {{0, 0, 0}, {0.4, 0.7, -0.3}, {-0.5, 0.2, 0.5}};
    for (int i = 0; i < 6; i++) { /* the last three off the picture's middle */
        const double *place = places[i % 3];
        memcpy(sight.camera.centre, (float[]){i < 3 ? 0 : 0.3F, i < 3 ? 0 : -0.2F},
               sizeof sight.camera.centre);
        double pixel[2], hit[3];
        SightRay ray;
        assert_true(sight_pixel(&sight, place, pixel));
        sight_ray(&sight, pixel, &ray);
        assert_true(sight_ray_plane(&ray, place, ray.along, hit));
        assert_near(hit, place, 1e-5); /* cameras are floats */
    }
}

/* The camera's target is in the middle of the free area, as large as without covered parts. */
static void what_is_looked_at_is_in_the_middle_of_what_is_free(void **state)
{
    (void)state;
    const double size[3] = {1, 1, 1}, aspect = (double)WIDE / HIGH;
    const BoxState box = {.orientation = {0, 0, 0, 1}};
    ViewDef def = view_def_default();
    def.camera_auto = false;
    def.camera = (CameraDef){{1.5, 1, 2}, {0.1, 0.4, 0}, 45};
    for (int i = 0; i < 2; i++) {
        const double left = i * 0.4;
        double at[2], up[2], depth;
        Camera camera;
        camera_make(&def, size, &box, aspect, (CoveredParts){left, 0.2, 1}, &camera);
        assert_true(camera_project(&camera, def.camera.to, WIDE, HIGH, at, &depth));
        assert_true(camera_project(&camera, (double[]){0.1, 0.6, 0}, WIDE, HIGH, up, &depth));
        if (fabs(at[0] - WIDE * (1 + left) / 2) > 1e-3 || fabs(at[1] - HIGH / 2.0) > 1e-3)
            fail_msg("it is at %g %g", at[0], at[1]);
        static double first;
        first = i == 0 ? at[1] - up[1] : first;
        assert_true(fabs(at[1] - up[1] - first) < 1e-3);
    }
}

static void what_is_behind_the_eye_has_no_pixel(void **state)
{
    (void)state;
    const Sight sight = sight_from(0.3, -0.2, 0.2);
    double pixel[2], behind[3];
    SightRay ray;
    sight_ray(&sight, (double[2]){WIDE / 2.0, HIGH / 2.0}, &ray);
    for (int k = 0; k < 3; k++)
        behind[k] = ray.from[k] - ray.along[k];
    assert_false(sight_pixel(&sight, behind, pixel));
    assert_false(sight_ray_plane(&ray, behind, ray.along, behind));
}

static Handle handle_of(HandleLook look, HandleMotion way)
{
    Handle handle = {
        .look = look, .way = way, .at = {0.1, 0.4, 0.2}, .from = {0.1, 0.4, 0}, .axis = {0.6, 0.8, 0}};
    return handle;
}

static void the_nearest_handle_is_found(void **state)
{
    (void)state;
    const Sight sight = sight_from(1.5, 1, 2);
    Handle handles[] = {handle_of(HANDLE_DOT, HANDLE_ALONG), handle_of(HANDLE_RING, HANDLE_WITHIN)};
    double pixel[2], corner[3], ring[2];
    memcpy(handles[0].at, handles[0].from, sizeof handles[0].at);
    assert_true(sight_pixel(&sight, handles[0].at, pixel));
    assert_int_equal(handle_at_pixel(&sight, handles, 2, pixel), 0);
    pixel[0] += sight.reach + 1;
    assert_int_equal(handle_at_pixel(&sight, handles, 1, pixel), -1);
    for (int part = 0; part < HANDLE_RING_PARTS; part += 7) {
        handle_ring(&handles[1], part, corner);
        assert_true(fabs(distance(corner, handles[1].from) - 0.2) < 1e-9);
        assert_true(sight_pixel(&sight, corner, ring));
        assert_int_equal(handle_at_pixel(&sight, handles, 2, ring), 1);
    }
    Handle two[] = {handles[0], handles[0]}; /* two within reach */
    two[1].at[0] += 0.01;
    for (int i = 0; i < 2; i++) {
        assert_true(sight_pixel(&sight, two[i].at, pixel) && sight_pixel(&sight, two[1 - i].at, ring));
        assert_true(hypot(pixel[0] - ring[0], pixel[1] - ring[1]) < sight.reach);
        assert_int_equal(handle_at_pixel(&sight, two, 2, pixel), i);
    }
}

/* The mouse goes from the pixel of `from` to the pixel of `to`. */
static bool drag(const Sight *sight, const Handle *handle, const double from[3], const double to[3],
                 double at[3])
{
    double pixel[2];
    SightRay first, now;
    assert_true(sight_pixel(sight, from, pixel));
    sight_ray(sight, pixel, &first);
    assert_true(sight_pixel(sight, to, pixel));
    sight_ray(sight, pixel, &now);
    return handle_drag(handle, &first, &now, at);
}

static void a_handle_stays_under_the_mouse(void **state)
{
    (void)state;
    const Sight sight = sight_from(1.5, 1, 2);
    const Handle along = handle_of(HANDLE_DOT, HANDLE_ALONG), within = handle_of(HANDLE_DOT, HANDLE_WITHIN),
                 around = handle_of(HANDLE_ARROW, HANDLE_AROUND);
    const double line[3] = {0.1 + 0.3 * 0.6, 0.4 + 0.3 * 0.8, 0.2}, plane[3] = {0.1 - 0.08, 0.4 + 0.06, 0.5},
                 sphere[3] = {0.1 + 0.2 * 0.36, 0.4 + 0.2 * 0.48, 0.2 * 0.8};
    double at[3];
    assert_true(drag(&sight, &along, along.at, line, at));
    assert_near(at, line, 1e-4);
    assert_true(drag(&sight, &within, within.at, plane, at));
    assert_near(at, plane, 1e-4);
    assert_true(drag(&sight, &around, around.at, sphere, at));
    assert_near(at, sphere, 1e-3);
}

/* Grabbed beside the middle, the handle does not jump. */
static void a_handle_does_not_jump(void **state)
{
    (void)state;
    const Sight sight = sight_from(1.5, 1, 2);
    static const HandleMotion ways[] = {HANDLE_ALONG, HANDLE_WITHIN, HANDLE_AROUND};
    for (int i = 0; i < 3; i++) {
        const Handle handle = handle_of(HANDLE_DOT, ways[i]);
        const double beside[3] = {handle.at[0] + 0.02, handle.at[1] - 0.01, handle.at[2] + 0.01};
        double at[3];
        assert_true(drag(&sight, &handle, beside, beside, at));
        assert_near(at, handle.at, 1e-9);
    }
}

static void looking_along_the_line_up_is_forward(void **state)
{
    (void)state;
    Sight sight = sight_from(0.3, -0.2, 3);
    const Handle handle = {.way = HANDLE_ALONG, .axis = {0, 0, 1}};
    const double raised[3] = {0, 0.2, 0};
    double at[3];
    sight.box = (BoxState){.position = {0.3, -0.2, 0.1}, .orientation = {0, 0, 0, 1}};
    assert_true(drag(&sight, &handle, handle.at, raised, at));
    assert_near(at, (double[3]){0, 0, 0.2}, 1e-3);
}

static void a_plane_on_edge_cannot_be_dragged_within(void **state)
{
    (void)state;
    Sight sight = sight_from(0.3, -0.2, 3);
    const Handle handle = {.way = HANDLE_WITHIN, .axis = {0, 1, 0}};
    double at[3];
    sight.box = (BoxState){.position = {0.3, -0.2, 0.1}, .orientation = {0, 0, 0, 1}};
    assert_false(drag(&sight, &handle, handle.at, (double[3]){0, 0.1, 0}, at));
}

/* Beside the sphere the handle is at its rim. */
static void a_turn_beyond_the_rim_stays_on_the_sphere(void **state)
{
    (void)state;
    const Sight sight = sight_from(1.5, 1, 2);
    const Handle handle = handle_of(HANDLE_ARROW, HANDLE_AROUND);
    double at[3];
    assert_true(drag(&sight, &handle, handle.at, (double[3]){0.1, 0.9, 0}, at));
    assert_true(fabs(distance(at, handle.from) - 0.2) < 1e-9);
    assert_true(at[1] > 0.55);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_goes_through_what_its_pixel_shows),
        cmocka_unit_test(what_is_looked_at_is_in_the_middle_of_what_is_free),
        cmocka_unit_test(what_is_behind_the_eye_has_no_pixel),
        cmocka_unit_test(the_nearest_handle_is_found),
        cmocka_unit_test(a_handle_stays_under_the_mouse),
        cmocka_unit_test(a_handle_does_not_jump),
        cmocka_unit_test(looking_along_the_line_up_is_forward),
        cmocka_unit_test(a_plane_on_edge_cannot_be_dragged_within),
        cmocka_unit_test(a_turn_beyond_the_rim_stays_on_the_sphere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
