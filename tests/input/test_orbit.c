/* The camera by hand: starts at the present picture, and drags follow the picture. */
#include "tests/tolerance.h"

#include "app/input/input.h"
#include "render/frame/frame.h"

#include <string.h>

static const double size[3] = {0.4, 0.3, 0.2};
static const BoxState home = {.orientation = {0, 0, 0, 1}};
enum { WIDTH = 1280, HEIGHT = 720 };
static const double aspect = (double)WIDTH / HEIGHT;

static ViewDef automatic(void)
{
    return (ViewDef){.camera_auto = true};
}

static ViewDef explicit_at(double x, double y, double z)
{
    return (ViewDef){.camera = {.from = {x, y, z}, .to = {0, 0.1, 0}, .fov_deg = 50}};
}

/* 2 m before its target, level, without a shift. */
static Orbit level(void)
{
    const ViewDef def = {.camera = {.from = {0, 0.15, 2}, .to = {0, 0.15, 0}, .fov_deg = 90}};
    return orbit_begin(&def, size, &home, aspect, (CoveredParts){0});
}

static Camera camera_of(const Orbit *orbit)
{
    Camera camera;
    ViewDef def = automatic();
    orbit_apply(orbit, &def);
    assert_false(def.camera_auto);
    camera_make(&def, size, &home, aspect, (CoveredParts){0}, &camera);
    return camera;
}

static void pixel_of(const Orbit *orbit, const double world[3], double pixel[2])
{
    const Camera camera = camera_of(orbit);
    double depth;
    assert_true(camera_project(&camera, world, WIDTH, HEIGHT, pixel, &depth));
}

static void check_same_picture(const ViewDef *def, const BoxState *box, CoveredParts covered)
{
    Camera before, after;
    ViewDef own = *def;
    camera_make(def, size, box, aspect, covered, &before);
    const Orbit orbit = orbit_begin(def, size, box, aspect, covered);
    orbit_apply(&orbit, &own);
    camera_make(&own, size, box, aspect, covered, &after);
    for (int i = 0; i < 16; i++)
        check_near(after.view[i], before.view[i], 1e-5, "the matrix");
    for (int k = 0; k < 3; k++)
        check_near(after.eye[k], before.eye[k], 1e-5, "the eye");
    for (int k = 0; k < 2; k++)
        check_near(after.tangent[k], before.tangent[k], 1e-6, "the tangent");
}

static void it_begins_with_the_automatic_picture(void **state)
{
    (void)state;
    const ViewDef def = automatic();
    BoxState moved = {.position = {0.5, 0.1, -0.7}, .orientation = {0, 0.6, 0, 0.8}};
    static const CoveredParts covered[] = {
        {0}, {0, 0.15, 1}, {0, 0.4, 1}, {0.3, 0.15, 1}}; /* the camera goes off the centre for the legend */
    for (int i = 0; i < (int)(sizeof covered / sizeof *covered); i++) {
        check_same_picture(&def, &home, covered[i]);
        check_same_picture(&def, &moved, covered[i]);
    }
    const Orbit orbit = orbit_begin(&def, size, &home, aspect, (CoveredParts){0, 0.4, 1});
    assert_true(fabs(orbit.shift[0]) > 0.01); /* otherwise the loop is not tested */
}

static void it_begins_with_the_scenes_own_picture(void **state)
{
    (void)state;
    static const double from[][3] = {{0, 0.1, 1}, {1, 1, 1},    {-1, 0.5, -2},   {0, 3, 0},
                                     {0, -3, 0},  {0.5, -2, 0}, {300, 200, 100}, {0.01, 0.11, 0}};
    for (size_t i = 0; i < sizeof from / sizeof from[0]; i++) {
        const ViewDef def = explicit_at(from[i][0], from[i][1], from[i][2]);
        check_same_picture(&def, &home, (CoveredParts){0, 0.2, 1});
    }
}

static void a_drag_turns_the_scene(void **state)
{
    (void)state;
    Orbit orbit = level();
    orbit_turn(&orbit, M_PI / 2, 0); /* to the right: what was on the left comes to the front */
    const Camera left = camera_of(&orbit);
    check_vector((double[3]){left.eye[0], left.eye[1], left.eye[2]}, -2, 0.15, 0, 1e-6, "the eye");

    orbit = level();
    orbit_turn(&orbit, 0, -M_PI / 6); /* down: the top comes to the front */
    const Camera above = camera_of(&orbit);
    check_vector((double[3]){above.eye[0], above.eye[1], above.eye[2]}, 0, 1.15, sqrt(3), 1e-6, "the eye");

    /* A small drag takes what is near along: to the right and up. */
    static const double near_side[3] = {0, 0.15, 0.1};
    double before[2], after[2];
    orbit = level();
    pixel_of(&orbit, near_side, before);
    orbit_turn(&orbit, 0.1, 0.1);
    pixel_of(&orbit, near_side, after);
    assert_true(after[0] > before[0] + 1 && after[1] < before[1] - 1); /* pixels count from the top */
}

static void the_poles_are_not_reached(void **state)
{
    (void)state;
    Orbit orbit = level();
    for (int i = 0; i < 100; i++) {
        orbit_turn(&orbit, 0.3, i < 50 ? -1 : 1);
        assert_true(fabs(orbit.pitch) <= 89 * M_PI / 180 && fabs(orbit.yaw) <= M_PI);
        /* The picture's axes equal the given axes: no second up direction is used. */
        const Camera camera = camera_of(&orbit);
        double right[3], up[3], away[3];
        orbit_axes(&orbit, right, up, away);
        for (int k = 0; k < 3; k++) {
            check_near(camera.view[4 * k], right[k], 1e-5, "right");
            check_near(camera.view[4 * k + 1], up[k], 1e-5, "up");
        }
    }
}

/* Past a pole too; a drag beginning beyond a pole begins at once. */
static void a_drag_there_and_back_ends_where_it_began(void **state)
{
    (void)state;
    Orbit orbit = level();
    const Camera before = camera_of(&orbit);
    for (int i = 0; i < 40; i++)
        orbit_turn(&orbit, i < 20 ? 0.2 : -0.2, i < 20 ? -0.15 : 0.15);
    const Camera after = camera_of(&orbit);
    for (int i = 0; i < 16; i++)
        check_near(after.view[i], before.view[i], 1e-6, "the matrix");
    orbit_turn(&orbit, 0, -3);
    orbit_begin_drag(&orbit);
    orbit_turn(&orbit, 0, 29 * M_PI / 180);
    check_near(camera_of(&orbit).eye[1], 0.15 + sqrt(3), 1e-5, "the eye"); /* 60 degrees above */
}

static void the_box_stays_in_its_place_of_the_picture(void **state)
{
    (void)state;
    static const double centre[3] = {0, 0.15, 0};
    const ViewDef def = automatic();
    Orbit orbit = orbit_begin(&def, size, &home, aspect, (CoveredParts){0, 0.4, 1});
    double before[2], after[2];
    pixel_of(&orbit, centre, before);
    assert_true(before[0] < 0.49 * WIDTH); /* beside the legend */
    orbit_turn(&orbit, 1, -0.3);
    orbit_zoom(&orbit, 3);
    pixel_of(&orbit, centre, after);
    for (int k = 0; k < 2; k++)
        check_near(after[k], before[k], 0.01, "the centre's pixel");
}

static void a_pan_takes_the_point_along(void **state)
{
    (void)state;
    const ViewDef def = automatic();
    Orbit orbit = orbit_begin(&def, size, &home, aspect, (CoveredParts){0, 0.3, 1});
    orbit_turn(&orbit, 0.7, 0.2);
    double right[3], up[3], away[3], point[3], before[2], after[2];
    orbit_axes(&orbit, right, up, away);
    for (int k = 0; k < 3; k++)
        point[k] = orbit.pivot[k] + 0.05 * right[k] - 0.08 * up[k]; /* any in the plane */
    pixel_of(&orbit, point, before);
    orbit_pan(&orbit, 100.0 / HEIGHT, 30.0 / HEIGHT);
    pixel_of(&orbit, point, after);
    check_near(after[0], before[0] + 100, 0.01, "the pixel");
    check_near(after[1], before[1] - 30, 0.01, "the pixel");
}

static void the_wheel_goes_by_tenths_within_bounds(void **state)
{
    (void)state;
    const double diagonal = sqrt(0.16 + 0.09 + 0.04);
    Orbit orbit = level();
    orbit_zoom(&orbit, 2);
    check_near(orbit.distance, 2 / 1.21, 1e-6, "the distance");
    orbit_zoom(&orbit, -2);
    check_near(orbit.distance, 2, 1e-6, "the distance");
    orbit_zoom(&orbit, 1e6);
    check_near(orbit.distance, 0.05 * diagonal, 1e-12, "the least distance");
    orbit_zoom(&orbit, -1e6);
    check_near(orbit.distance, 50 * diagonal, 1e-12, "the greatest distance");

    /* A scene's own camera beyond the bounds may stay there. */
    const ViewDef far = explicit_at(300, 200, 100);
    orbit = orbit_begin(&far, size, &home, aspect, (CoveredParts){0});
    const double distance = orbit.distance;
    orbit_zoom(&orbit, 0);
    assert_true(orbit.distance == distance);
}

static void axes_are_those_of_the_picture(void **state)
{
    (void)state;
    Orbit orbit = level();
    double right[3], up[3], away[3];
    orbit_turn(&orbit, -M_PI / 2, -M_PI / 6); /* from +x, 30 degrees above */
    orbit_axes(&orbit, right, up, away);
    check_vector(right, 0, 0, -1, 1e-6, "right");
    check_vector(up, -0.5, sqrt(0.75), 0, 1e-6, "up");
    check_vector(away, -1, 0, 0, 1e-6, "away");
}

/* A drag of the box by pixels takes its centre along by as many. */
static void metres_per_pixel(void **state)
{
    (void)state;
    Orbit orbit = level(); /* 90 degrees: as high as twice the distance */
    check_near(orbit_metres_per_pixel(&orbit, size, &home, HEIGHT), 4.0 / HEIGHT, 1e-8, "a pixel");
    const BoxState nearer = {.position = {0, 0, 1}, .orientation = {0, 0, 0, 1}};
    check_near(orbit_metres_per_pixel(&orbit, size, &nearer, HEIGHT), 2.0 / HEIGHT, 1e-8, "a pixel, nearer");
    const BoxState behind = {.position = {0, 0, 5}, .orientation = {0, 0, 0, 1}};
    assert_true(orbit_metres_per_pixel(&orbit, size, &behind, HEIGHT) > 0);
    assert_true(isfinite(orbit_metres_per_pixel(&orbit, size, &home, 0)));

    static const double centre[3] = {0, 0.15, 0};
    const ViewDef def = automatic();
    double before[2], after[2], right[3], up[3], away[3], moved[3];
    orbit = orbit_begin(&def, size, &home, aspect, (CoveredParts){0, 0.3, 1});
    orbit_axes(&orbit, right, up, away);
    pixel_of(&orbit, centre, before);
    for (int k = 0; k < 3; k++)
        moved[k] = centre[k] + 50 * orbit_metres_per_pixel(&orbit, size, &home, HEIGHT) * right[k];
    pixel_of(&orbit, moved, after);
    check_near(after[0], before[0] + 50, 0.01, "the pixel");
    check_near(after[1], before[1], 0.01, "the pixel");
}

static void what_is_not_finite_is_ignored(void **state)
{
    (void)state;
    Orbit orbit = level();
    const Orbit before = orbit;
    orbit_turn(&orbit, NAN, 0);
    orbit_turn(&orbit, 0, INFINITY);
    orbit_pan(&orbit, NAN, 0);
    orbit_pan(&orbit, 0, -INFINITY);
    orbit_zoom(&orbit, NAN);
    orbit_zoom(&orbit, INFINITY);
    assert_memory_equal(&orbit, &before, sizeof orbit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_begins_with_the_automatic_picture),
        cmocka_unit_test(it_begins_with_the_scenes_own_picture),
        cmocka_unit_test(a_drag_turns_the_scene),
        cmocka_unit_test(the_poles_are_not_reached),
        cmocka_unit_test(a_drag_there_and_back_ends_where_it_began),
        cmocka_unit_test(the_box_stays_in_its_place_of_the_picture),
        cmocka_unit_test(a_pan_takes_the_point_along),
        cmocka_unit_test(the_wheel_goes_by_tenths_within_bounds),
        cmocka_unit_test(axes_are_those_of_the_picture),
        cmocka_unit_test(metres_per_pixel),
        cmocka_unit_test(what_is_not_finite_is_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
