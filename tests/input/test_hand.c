/* The hand: from device input to the target pose of the box. */
#include "tests/tolerance.h"

#include "app/input/input.h"

#include <string.h>

static const double size[3] = {0.4, 0.3, 0.2}; /* longest side 0.4 m */
enum { X, Y, Z };

/* Seen from +z, level: right is x, up is y, away is -z. */
static HandInput level(void)
{
    return (HandInput){.dt = 0.02, .right = {1, 0, 0}, .up = {0, 1, 0}, .away = {0, 0, -1}};
}

static void check_told(Hand *hand, const HandInput *input, BoxTarget *target)
{
    assert_true(hand_update(hand, input, size, target));
}

/* Where the turn takes a point of the box. */
static void check_turned(const BoxTarget *target, const double point[3], double x, double y, double z)
{
    double turned[3];
    quat_rotate(target->orientation, point, turned);
    check_vector(turned, x, y, z, 1e-12, "the point");
}

static void nothing_said_nothing_changes(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    const HandInput input = level();
    assert_false(hand_update(&hand, &input, size, &target));
    check_vector(target.position, 0, 0, 0, 0, "position");
    check_vector(target.orientation, 0, 0, 0, 0, "orientation");
    assert_true(target.orientation[3] == 1);
}

static void a_drag_moves_in_the_plane_of_the_picture(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.move_drag[0] = 0.05, input.move_drag[1] = -0.02;
    check_told(&hand, &input, &target);
    check_vector(target.position, 0.05, -0.02, 0, 1e-15, "position");

    /* From 30 degrees above: up in the picture goes away as well. */
    input.up[Y] = sqrt(0.75), input.up[Z] = -0.5;
    input.move_drag[0] = 0, input.move_drag[1] = 0.1;
    check_told(&hand, &input, &target);
    check_vector(target.position, 0.05, -0.02 + 0.1 * sqrt(0.75), -0.05, 1e-15, "position");
    assert_false(hand_update(&hand, &(HandInput){.dt = 0.02}, size, &target)); /* and stays */
    check_vector(target.position, 0.05, -0.02 + 0.1 * sqrt(0.75), -0.05, 1e-15, "position");
}

static void keys_move_by_sides_a_second(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.up[Y] = 0, input.up[Z] = -1; /* from above: up and down stay the world's */
    input.dt = 0.1;
    for (int k = 0; k < 3; k++)
        input.move_rate[k] = k == 0 ? 1 : -1;
    check_told(&hand, &input, &target);
    const double way = 0.1 * HAND_SPEED * 0.4; /* 0.1 s in a box of 0.4 m */
    check_vector(target.position, way, -way, way, 1e-15, "position");

    input.dt = 1000; /* the program was stopped */
    input.move_rate[1] = input.move_rate[2] = 0, input.move_rate[0] = 5;
    check_told(&hand, &input, &target);
    check_vector(target.position, way + HAND_SPEED * 0.4 * HAND_DT_MOST, -way, way, 1e-15, "position");
    input.dt = -1;
    assert_false(hand_update(&hand, &input, size, &target));
}

/* Dragged to the right by a quarter turn, the near face becomes the right face, and the right face the
   far face. */
static void a_turn_drag_takes_the_near_face_along(void **state)
{
    (void)state;
    static const double near[3] = {0, 0, 1}, corner[3] = {1, 1, 1};
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.turn_drag[0] = M_PI / 2;
    check_told(&hand, &input, &target);
    check_turned(&target, near, 1, 0, 0);
    check_turned(&target, corner, 1, 1, -1);

    /* Then up: about the picture's axis, not the box's, so that the near face now goes up. */
    input.turn_drag[0] = 0, input.turn_drag[1] = M_PI / 2;
    check_told(&hand, &input, &target);
    check_turned(&target, near, 1, 0, 0); /* it lies on the axis now */
    check_turned(&target, corner, 1, -1, -1);
    check_turned(&target, (double[3]){-1, 0, 0}, 0, 1, 0); /* came to the front by the first drag */
}

/* From the right (seen from +x, right is -z) a drag to the right turns the +x face to where -z was. */
static void a_turn_drag_goes_by_the_picture(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = {.dt = 0.02, .right = {0, 0, -1}, .up = {0, 1, 0}, .away = {-1, 0, 0}};
    input.turn_drag[0] = M_PI / 2;
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){1, 0, 0}, 0, 0, -1);
    hand_home(&hand);
    input.turn_drag[0] = 0, input.turn_drag[1] = M_PI / 2;
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){1, 0, 0}, 0, 1, 0);
}

static void tilt_keys_lean_the_top(void **state)
{
    (void)state;
    static const double top[3] = {0, 1, 0};
    const double angle = 0.1 * HAND_TURN_SPEED * M_PI / 180, c = cos(angle), s = sin(angle); /* 0.1 s */
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.dt = 0.1;
    input.tilt_rate[0] = 1;
    check_told(&hand, &input, &target);
    check_turned(&target, top, s, c, 0);

    hand_home(&hand);
    input.tilt_rate[0] = 0, input.tilt_rate[1] = 1;
    check_told(&hand, &input, &target);
    check_turned(&target, top, 0, c, -s);
}

static void a_stick_springs_back(void **state)
{
    (void)state;
    const double half = sqrt(0.5);
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level(), still = level();
    input.move_drag[0] = 0.1;
    check_told(&hand, &input, &target);

    input = level();
    input.move_offset[0] = 1, input.move_offset[2] = -0.5, input.tilt_offset[0] = 1;
    for (int i = 0; i < 100; i++) { /* held: it does not add up */
        const bool sent = hand_update(&hand, &input, size, &target);
        assert_int_equal(sent, i == 0);
        check_vector(target.position, 0.1 + 0.2, 0, 0.1, 1e-15, "position");
        check_turned(&target, (double[3]){0, 1, 0}, half, half, 0);
    }
    check_told(&hand, &still, &target);
    check_vector(target.position, 0.1, 0, 0, 0, "position");
    check_vector(target.orientation, 0, 0, 0, 0, "orientation");
    assert_false(hand_update(&hand, &still, size, &target));
}

/* The stick leans the box in the world, whichever way the box was turned before. */
static void a_stick_leans_a_turned_box(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.turn_drag[0] = M_PI / 2;
    input.tilt_offset[1] = 1; /* away */
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){0, 1, 0}, 0, sqrt(0.5), -sqrt(0.5));
}

static void let_go_stops_where_the_box_is(void **state)
{
    (void)state;
    const BoxTarget now = {.position = {0.03, 0.01, -0.02}, .orientation = {0, 0.6, 0, 0.8}};
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level(), still = level();
    input.move_drag[0] = 0.3, input.move_offset[1] = 1;
    check_told(&hand, &input, &target);
    hand_release(&hand, &now, NULL, size);
    check_told(&hand, &still, &target);
    assert_memory_equal(&target, &now, sizeof now);
    assert_false(hand_update(&hand, &still, size, &target));

    BoxTarget broken = now;
    broken.orientation[2] = NAN;
    hand_release(&hand, &broken, NULL, size);
    assert_false(hand_update(&hand, &still, size, &target));
    assert_memory_equal(&target, &now, sizeof now);
}

/* The user's frame, for any camera: a device turned about the user's right turns the box about the
   picture's right. */
static void the_box_turns_as_the_device_does(void **state)
{
    (void)state;
    static const double c = 0.8660254037844386;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level(), still = level();
    memcpy(input.turned, (double[]){0, 0, -0.5, c}, sizeof input.turned); /* to the right, by 60 degrees */
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){0, 1, 0}, c, 0.5, 0);
    assert_false(hand_update(&hand, &input, size, &target));                 /* it does not add up */
    memcpy(input.turned, (double[]){-5, 0, 0, 10 * c}, sizeof input.turned); /* of any length: away */
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){0, 1, 0}, 0, 0.5, -c);

    /* Seen from +x right is -z and away is -x. */
    input = (HandInput){.dt = 0.02, .right = {0, 0, -1}, .up = {0, 1, 0}, .away = {-1, 0, 0}};
    memcpy(input.turned, (double[]){0, 0, 0.5, c}, sizeof input.turned); /* to the left */
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){0, 1, 0}, 0, 0.5, c);
    memcpy(input.turned, (double[]){0, 0.5, 0, c}, sizeof input.turned); /* its near side to the right */
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){1, 0, 0}, 0.5, 0, -c);

    /* On top of the turn by hand; after removal the turn by hand is left. */
    still.turn_drag[0] = M_PI / 2;
    check_told(&hand, &still, &target);
    check_turned(&target, (double[3]){0, 0, 1}, 1, 0, 0);
}

static void what_spins_takes_the_near_face_to_the_right(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.dt = 0.1, input.spin_rate = 1;
    check_told(&hand, &input, &target);
    const double angle = 0.1 * HAND_TURN_SPEED * M_PI / 180;
    check_turned(&target, (double[3]){0, 0, 1}, sin(angle), 0, cos(angle));
    hand_home(&hand);
    input.spin_rate = 0, input.spin_offset = 1;
    check_told(&hand, &input, &target);
    check_turned(&target, (double[3]){0, 0, 1}, sqrt(0.5), 0, sqrt(0.5));
}

/* One of two devices is unplugged: input of the second continues, and the box stays in place. */
static void let_go_of_one_of_two(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget before, target;
    HandInput input = level();
    input.move_drag[0] = 0.1, input.turn_drag[1] = 0.7;
    input.move_offset[2] = 0.5, input.tilt_offset[0] = 0.3, input.spin_offset = -0.4;
    memcpy(input.turned, (double[]){0.1, 0.2, 0.3, 0.9}, sizeof input.turned);
    check_told(&hand, &input, &before);
    HandInput still = level();
    still.tilt_offset[0] = 0.3;
    memcpy(still.turned, (double[]){0.3, -0.1, 0.1, 0.9}, sizeof still.turned);
    hand_release(&hand, &before, &still, size);
    hand_update(&hand, &still, size, &target);
    check_vector(target.position, before.position[0], before.position[1], before.position[2], 1e-9,
                 "position");
    for (int k = 0; k < 4; k++)
        check_near(target.orientation[k], before.orientation[k], 1e-5, "orientation");
}

static void home_is_upright(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level(), still = level();
    input.move_drag[1] = 0.1, input.turn_drag[1] = 1;
    check_told(&hand, &input, &target);
    hand_home(&hand);
    check_told(&hand, &still, &target);
    const BoxTarget home = {.orientation = {0, 0, 0, 1}};
    assert_memory_equal(&target, &home, sizeof home);
}

static void the_box_is_never_lost(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    input.move_drag[0] = 1e300;
    check_told(&hand, &input, &target);
    check_vector(target.position, HAND_REACH * 0.4, 0, 0, 1e-12, "position");
    assert_false(hand_update(&hand, &input, size, &target)); /* at the end: nothing new */
    input.move_drag[0] = 0, input.move_offset[0] = 1;
    assert_false(hand_update(&hand, &input, size, &target));
    input.move_offset[0] = 0, input.move_drag[0] = -0.2; /* comes back at once */
    check_told(&hand, &input, &target);
    check_vector(target.position, HAND_REACH * 0.4 - 0.2, 0, 0, 1e-12, "position");
}

/* Each number of the input in turn. */
static void what_is_not_finite_is_ignored(void **state)
{
    (void)state;
    enum { NUMBERS = sizeof(HandInput) / sizeof(double) };
    Hand hand = hand_at_rest();
    BoxTarget target, before;
    HandInput input = level();
    input.move_drag[0] = 0.1, input.turn_drag[1] = 0.5;
    check_told(&hand, &input, &before);
    input = level();
    input.move_rate[0] = 1;
    for (int i = 0; i < NUMBERS; i++) {
        double numbers[NUMBERS];
        HandInput broken;
        memcpy(numbers, &input, sizeof numbers);
        numbers[i] = NAN;
        memcpy(&broken, numbers, sizeof broken);
        if (hand_update(&hand, &broken, size, &target))
            fail_msg("number %d of the input was NaN and taken", i);
        assert_memory_equal(&target, &before, sizeof target);
        assert_memory_equal(&hand.held, &before, sizeof before);
    }
    check_told(&hand, &input, &target);
}

static double random_number(void) /* -1 .. 1 */
{
    static uint64_t seed = 88172645463325252U; /* after: Marsaglia, Xorshift RNGs, 2003 */
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return (double)(seed >> 11) * 0x1p-52 - 1;
}

static void random_input(HandInput *input)
{
    const double yaw = M_PI * random_number(), pitch = 1.5 * random_number(),
                 reach = pow(10, 3 * random_number());
    *input = (HandInput){.dt = 0.2 * random_number() + 0.15, .right = {cos(yaw), 0, -sin(yaw)}};
    input->up[X] = -sin(pitch) * sin(yaw), input->up[Y] = cos(pitch), input->up[Z] = -sin(pitch) * cos(yaw);
    input->away[X] = -sin(yaw), input->away[Z] = -cos(yaw);
    for (int k = 0; k < 2; k++) {
        input->move_drag[k] = reach * random_number();
        input->turn_drag[k] = reach * random_number();
        input->tilt_rate[k] = 2 * random_number();
        input->tilt_offset[k] = 2 * random_number();
    }
    for (int k = 0; k < 3; k++) {
        input->move_rate[k] = 2 * random_number();
        input->move_offset[k] = 2 * random_number();
    }
    input->spin_rate = 2 * random_number();
    input->spin_offset = 2 * random_number();
    for (int k = 0; k < 4; k++)
        input->turned[k] = reach * random_number();
}

static void any_input_gives_a_pose(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    for (int i = 0; i < 10000; i++) {
        HandInput input;
        BoxTarget target;
        random_input(&input);
        hand_update(&hand, &input, size, &target);
        double way = 0, norm = 0;
        for (int k = 0; k < 3; k++)
            way += target.position[k] * target.position[k];
        for (int k = 0; k < 4; k++)
            norm += target.orientation[k] * target.orientation[k];
        check_near(norm, 1, 1e-14, "the quaternion's length");
        assert_true(sqrt(way) <= HAND_REACH * 0.4 * (1 + 1e-12));
    }
}

/* A pixel of a slow drag may be less than the sending threshold: no movement is lost. */
static void small_drags_add_up(void **state)
{
    (void)state;
    Hand hand = hand_at_rest();
    BoxTarget target;
    HandInput input = level();
    int sent = 0;
    input.move_drag[0] = 1e-7;
    for (int i = 0; i < 1000; i++)
        sent += hand_update(&hand, &input, size, &target);
    assert_in_range(sent, 100, 334);
    check_near(target.position[0], 1e-4, 0.5e-6, "position");
}

static void sticks_have_a_dead_zone_and_a_curve(void **state)
{
    (void)state;
    double out[2];
    static const double middle = 0.4 * 0.5 + 0.6 * 0.125; /* half the way between dead zone and rim */
    hand_stick((double[2]){0.1, -0.11}, out);
    assert_true(out[0] == 0 && out[1] == 0); /* 0.149 from the middle */
    hand_stick((double[2]){0.575, 0}, out);
    check_near(out[0], middle, 1e-12, "half way");
    hand_stick((double[2]){-0.6 * 0.575, 0.8 * 0.575}, out);
    check_near(out[0], -0.6 * middle, 1e-12, "half way aslant");
    check_near(out[1], 0.8 * middle, 1e-12, "half way aslant");
    hand_stick((double[2]){1, 1}, out); /* a square rim counts as the round one */
    check_near(out[0], sqrt(0.5), 1e-12, "the corner");
    hand_stick((double[2]){0, -1}, out);
    check_near(out[1], -1, 1e-12, "the rim");
    double before = -1;
    for (int i = 0; i <= 100; i++) { /* no steps, never back */
        hand_stick((double[2]){i / 100.0, 0}, out);
        assert_true(out[0] >= before && out[0] - fmax(before, 0) < 0.03);
        before = out[0];
    }
    hand_stick((double[2]){NAN, 1}, out);
    assert_true(out[0] == 0 && out[1] == 0);
    hand_stick((double[2]){INFINITY, 1}, out);
    assert_true(out[0] == 0 && out[1] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_said_nothing_changes),
        cmocka_unit_test(a_drag_moves_in_the_plane_of_the_picture),
        cmocka_unit_test(keys_move_by_sides_a_second),
        cmocka_unit_test(a_turn_drag_takes_the_near_face_along),
        cmocka_unit_test(a_turn_drag_goes_by_the_picture),
        cmocka_unit_test(tilt_keys_lean_the_top),
        cmocka_unit_test(a_stick_springs_back),
        cmocka_unit_test(a_stick_leans_a_turned_box),
        cmocka_unit_test(let_go_stops_where_the_box_is),
        cmocka_unit_test(the_box_turns_as_the_device_does),
        cmocka_unit_test(what_spins_takes_the_near_face_to_the_right),
        cmocka_unit_test(let_go_of_one_of_two),
        cmocka_unit_test(home_is_upright),
        cmocka_unit_test(the_box_is_never_lost),
        cmocka_unit_test(what_is_not_finite_is_ignored),
        cmocka_unit_test(any_input_gives_a_pose),
        cmocka_unit_test(small_drags_add_up),
        cmocka_unit_test(sticks_have_a_dead_zone_and_a_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
