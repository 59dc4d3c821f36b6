/* Mappings of devices: built in, from a file, and each axis with sign. */
#include "tests/scratch.h"
#include "tests/tolerance.h"

#include "app/input/device/device.h"
#include "app/input/input.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool parse(const char *text, Mapping *mapping, Error *error)
{
    error->message[0] = 0;
    return mapping_parse("m.yaml", text, strlen(text), mapping, error);
}

static void check_taken(const char *text, Mapping *mapping)
{
    Error error;
    if (!parse(text, mapping, &error))
        fail_msg("%s\nof\n%s", error.message, text);
}

/* By field: structs have padding. */
static void check_same_map(const DeviceMap *a, const DeviceMap *b)
{
    assert_true(a->family == b->family && a->gain == b->gain && a->dead_zone == b->dead_zone);
    assert_true(a->curve == b->curve && a->pose == b->pose && a->pose_gain == b->pose_gain);
    for (int i = 0; i < MAPPING_AXES; i++) {
        const AxisMap *p = &a->axes[i], *q = &b->axes[i];
        assert_true(p->to == q->to && p->as == q->as && p->gain == q->gain && p->invert == q->invert);
    }
    assert_int_equal(a->button_count, b->button_count);
    for (int i = 0; i < a->button_count; i++) {
        assert_string_equal(a->buttons[i].name, b->buttons[i].name);
        assert_ptr_equal(a->buttons[i].action, b->buttons[i].action);
    }
}

static void check_same_maps(const Mapping *a, const Mapping *b)
{
    for (int d = 0; d < DEVICE_FAMILY_COUNT; d++)
        check_same_map(&a->family[d], &b->family[d]);
    assert_int_equal(a->own_count, b->own_count);
    for (int d = 0; d < a->own_count; d++) {
        assert_true(a->own[d].vendor == b->own[d].vendor && a->own[d].product == b->own[d].product);
        check_same_map(&a->own[d].map, &b->own[d].map);
    }
}

/* With a message beginning so, with valid alternatives, and no change. */
static void check_refused(const char *text, const char *message)
{
    Mapping mapping, before;
    Error error;
    mapping_default(&mapping);
    mapping.family[0].gain = 7;
    before = mapping;
    if (parse(text, &mapping, &error))
        fail_msg("taken, instead of '%s':\n%s", message, text);
    if (strncmp(error.message, message, strlen(message)) != 0)
        fail_msg("expected '%s'\n     got '%s'", message, error.message);
    assert_true(strchr(error.message, ';') || strstr(error.message, " must "));
    check_same_maps(&mapping, &before);
}

static char *written(const Mapping *mapping, void (*write)(const Mapping *, FILE *))
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    write(mapping, file);
    assert_int_equal(fclose(file), 0);
    return text;
}

static void check_same(const Mapping *a, const Mapping *b)
{
    char *first = written(a, mapping_write), *second = written(b, mapping_write);
    assert_string_equal(first, second);
    check_same_maps(a, b);
    free(first);
    free(second);
}

static void what_is_built_in_comes_back_from_its_file(void **state)
{
    (void)state;
    Mapping mapping, back;
    mapping_default(&mapping);
    char *text = written(&mapping, mapping_write);
    check_taken(text, &back);
    check_same(&mapping, &back);
    free(text);
}

/* Each value differs from the default: no value is missing in the file or read into a wrong place. */
static void what_was_changed_comes_back(void **state)
{
    (void)state;
    Mapping mapping, back;
    mapping_default(&mapping);
    mapping.own_count = 2;
    mapping.own[0] = (struct OwnMap){0x256f, 0xc635, mapping.family[DEVICE_SPACEMOUSE]};
    mapping.own[1] = (struct OwnMap){0x054c, 0x0df2, mapping.family[DEVICE_DUALSENSE]};
    for (int d = 0; d < DEVICE_FAMILY_COUNT + 2; d++) {
        DeviceMap *map =
            d < DEVICE_FAMILY_COUNT ? &mapping.family[d] : &mapping.own[d - DEVICE_FAMILY_COUNT].map;
        map->gain = 1.5 + d, map->dead_zone = 0.0625 * (d + 1), map->curve = 1.25 + d / 2.0;
        map->pose_gain = 2 + 0.125 * d, map->pose = mapping_has_pose(map->family) && d % 2;
        if (!mapping_has_pose(map->family))
            map->pose_gain = 1;
        for (int i = 0; i < MAPPING_AXES; i++)
            map->axes[i] = (AxisMap){(i + d) % (MAP_ZOOM + 1), (i + d) % 2, 0.5 * i + d, i % 2};
        for (int i = 0; i < map->button_count; i++) {
            const int place = (i + d) % 50; /* all of the list's begin are presses; 0: nothing */
            map->buttons[i].action = place > 0 ? user_actions[place - 1] : NULL;
        }
    }
    char *text = written(&mapping, mapping_write);
    check_taken(text, &back);
    check_same(&mapping, &back);
    free(text);
}

static void what_is_left_out_stays(void **state)
{
    (void)state;
    Mapping mapping, should;
    mapping_default(&should);
    check_taken("# nothing yet\ndualsense: {}\n", &mapping);
    check_same(&mapping, &should);
    check_taken("dualsense:\n  gain: 2\n  axes: {left_y: {to: turn_x, invert: true}}\n"
                "  buttons: {circle: neutral, cross: nothing}\n"
                "054c:0df2: {gain: 3}\n",
                &mapping);
    DeviceMap *sense = &should.family[DEVICE_DUALSENSE];
    sense->gain = 2;
    sense->axes[1].to = MAP_TURN_X;
    sense->axes[1].invert = true;
    for (int i = 0; i < sense->button_count; i++) {
        if (strcmp(sense->buttons[i].name, "circle") == 0)
            sense->buttons[i].action = &action_neutral;
        if (strcmp(sense->buttons[i].name, "cross") == 0)
            sense->buttons[i].action = NULL;
    }
    should.own_count = 1; /* begins with the family's */
    should.own[0] = (struct OwnMap){0x054c, 0x0df2, *sense};
    should.own[0].map.gain = 3;
    check_same(&mapping, &should);
    assert_ptr_equal(mapping_of(&mapping, DEVICE_DUALSENSE, 0x054c, 0x0df2), &mapping.own[0].map);
    assert_ptr_equal(mapping_of(&mapping, DEVICE_DUALSENSE, 0x054c, 0x0ce6),
                     &mapping.family[DEVICE_DUALSENSE]);
}

static void mistakes_are_told_with_their_place(void **state)
{
    (void)state;
    check_refused("", "m.yaml:1:1: the mapping is empty; write `dualsense:`");
    check_refused("# only words\n", "m.yaml:1:1: the mapping is empty");
    check_refused("- a\n", "m.yaml:1:1: no mapping; write");
    check_refused("a: [\n", "m.yaml:2:1: not valid YAML");
    check_refused("dualsence: {}\n", "m.yaml:1:1: unknown key 'dualsence'; did you mean 'dualsense'?");
    check_refused("joystick: {}\n", "m.yaml:1:1: unknown key 'joystick'; known here: spacemouse, dualshock4, "
                                    "dualsense, or a product such as 256f:c635");
    check_refused("dualsense: 3\n", "m.yaml:1:12: dualsense must be a mapping");
    check_refused("dualsense:\n  gian: 3\n", "m.yaml:2:3: unknown key 'gian'; did you mean 'gain'?");
    check_refused("spacemouse:\n  pose: {}\n", "m.yaml:2:3: unknown key 'pose'; known here: gain, dead_zone");
    check_refused("dualsense:\n  gain: 11\n", "m.yaml:2:9: dualsense.gain must be 0 to 10, not 11");
    check_refused("dualsense:\n  gain: .nan\n", "m.yaml:2:9: dualsense.gain must be a finite number");
    check_refused("dualsense:\n  dead_zone: 1\n", "m.yaml:2:14: dualsense.dead_zone must be 0 to 0.9");
    check_refused("dualsense:\n  curve: 0.5\n", "m.yaml:2:10: dualsense.curve must be 1 to 5");
    check_refused("dualsense:\n  axes: {x: {}}\n",
                  "m.yaml:2:10: unknown key 'x'; known here: left_x, left_y, right_x");
    check_refused("dualsense:\n  axes: {left_x: move_x}\n",
                  "m.yaml:2:18: dualsense.axes.left_x must be a mapping such as {to: move_x");
    check_refused("spacemouse:\n  axes: {x: {to: mvoe_x}}\n",
                  "m.yaml:2:18: spacemouse.axes.x.to cannot be 'mvoe_x'; did you mean 'move_x'?");
    check_refused("spacemouse:\n  axes: {x: {as: speed}}\n",
                  "m.yaml:2:18: spacemouse.axes.x.as cannot be 'speed'; it must be one of: rate, offset");
    check_refused("spacemouse:\n  axes: {x: {invert: 1}}\n",
                  "m.yaml:2:22: spacemouse.axes.x.invert must be true or false, not '1'");
    check_refused("spacemouse:\n  axes: {x: {deadzone: 1}}\n", "m.yaml:2:14: unknown key 'deadzone'");
    check_refused("dualsense:\n  pose: {to: camera}\n", "m.yaml:2:14: dualsense.pose.to cannot be 'camera'");
    check_refused("dualsense:\n  buttons: {cros: pause}\n",
                  "m.yaml:2:13: unknown key 'cros'; did you mean 'cross'?");
    check_refused("dualsense:\n  buttons: {cross: puase}\n",
                  "m.yaml:2:20: dualsense.buttons.cross cannot be 'puase'; did you mean 'pause'?");
    check_refused("dualsense:\n  buttons: {cross: orbit}\n", /* no press */
                  "m.yaml:2:20: dualsense.buttons.cross cannot be 'orbit'");
    check_refused("dualsense:\n  buttons: {cross: [pause]}\n",
                  "m.yaml:2:20: dualsense.buttons.cross must be a command");
    check_refused("1234:5678: {}\n", "m.yaml:1:1: slosh knows no device 1234:5678; `slosh devices`");
    check_refused("256f:c635: {}\n256F:C635: {}\n",
                  "m.yaml:2:1: 256F:C635 stands here twice; keep one of the two");
    check_refused("dualsense: {buttons: {circle: [a]}}\n",
                  "m.yaml:1:31: dualsense.buttons.circle must be a command of the window such as box-home");
    check_refused("256f:c6351: {}\n", "m.yaml:1:1: unknown key '256f:c6351'; known here");
    check_refused("046d:c603: {}\n046d:c605: {}\n046d:c606: {}\n046d:c621: {}\n046d:c623: {}\n046d:c625: {}\n"
                  "046d:c626: {}\n046d:c627: {}\n046d:c628: {}\n",
                  "m.yaml:9:1: more than 8 products; write what they share under spacemouse");
}

/* The state of a device with one axis at a value. */
static DeviceState with_axis(DeviceFamily family, int axis, double value)
{
    DeviceState state = {0};
    if (family == DEVICE_SPACEMOUSE)
        state.cap[axis] = value;
    else
        (axis < 2 ? state.left : axis < 4 ? state.right : state.triggers)[axis % 2] = value;
    return state;
}

/* The motion of the box's middle, or the turn, for a user looking along -z; over 0.1 s. */
static void box_after(const DeviceMap *map, const DeviceState *state, BoxTarget *target)
{
    static const double size[3] = {1, 1, 1};
    double camera[3] = {0};
    Hand hand = hand_at_rest();
    HandInput input = {.dt = 0.1, .right = {1, 0, 0}, .up = {0, 1, 0}, .away = {0, 0, -1}};
    mapping_add(map, state, &input, camera);
    hand_update(&hand, &input, size, target);
    check_vector(camera, 0, 0, 0, 0, "the camera");
}

/* Of a SpaceMouse, built in: the box goes where the cap is pushed, and turns as it is turned. */
static void the_box_follows_the_cap(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    const DeviceMap *map = mapping_of(&mapping, DEVICE_SPACEMOUSE, 0x256f, 0xc635);
    for (int as = MAP_RATE; as <= MAP_OFFSET; as++)
        for (int axis = 0; axis < 6; axis++)
            for (int sign = -1; sign <= 1; sign += 2) {
                const double way = as == MAP_RATE ? 0.1 * HAND_SPEED : HAND_SWAY;
                const double angle = (as == MAP_RATE ? 0.1 * HAND_TURN_SPEED : HAND_LEAN) * M_PI / 180;
                const DeviceState pushed = with_axis(DEVICE_SPACEMOUSE, axis, sign);
                double moved[3] = {0}, turned[3] = {0};
                BoxTarget target;
                for (int i = 0; i < MAPPING_AXES; i++)
                    mapping.family[DEVICE_SPACEMOUSE].axes[i].as = as;
                (axis < 3 ? moved : turned)[axis % 3] = sign * (axis < 3 ? way : sin(angle / 2));
                box_after(map, &pushed, &target);
                check_vector(target.position, moved[0], moved[1], moved[2], 1e-12, "position");
                check_vector(target.orientation, turned[0], turned[1], turned[2], 1e-12, "orientation");
            }
}

/* Of the pads: right is right, and a stick that is pulled towards the user (+y) pulls the box. */
static void the_box_follows_the_left_stick(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    for (int f = DEVICE_DUALSHOCK4; f <= DEVICE_DUALSENSE; f++) {
        BoxTarget target;
        const DeviceState right = with_axis((DeviceFamily)f, 0, 1), near = with_axis((DeviceFamily)f, 1, 1);
        box_after(&mapping.family[f], &right, &target);
        check_vector(target.position, HAND_SWAY, 0, 0, 1e-12, "position");
        box_after(&mapping.family[f], &near, &target);
        check_vector(target.position, 0, 0, HAND_SWAY, 1e-12, "position");
    }
}

/* The right stick takes the scene along: down is down, though y counts downwards; triggers zoom. */
static void the_camera_follows_the_right_stick(void **state)
{
    (void)state;
    static const struct {
        int axis;
        double camera[3];
    } should[] = {{2, {1, 0, 0}}, {3, {0, -1, 0}}, {4, {0, 0, -1}}, {5, {0, 0, 1}}};
    Mapping mapping;
    mapping_default(&mapping);
    for (int f = DEVICE_DUALSHOCK4; f <= DEVICE_DUALSENSE; f++)
        for (int i = 0; i < 4; i++) {
            HandInput input = {.dt = 0};
            double camera[3] = {0};
            const DeviceState pushed = with_axis((DeviceFamily)f, should[i].axis, 1);
            mapping_add(&mapping.family[f], &pushed, &input, camera);
            check_vector(camera, should[i].camera[0], should[i].camera[1], should[i].camera[2], 1e-12,
                         "the camera");
            assert_memory_equal(&input, &(HandInput){.dt = 0}, sizeof input);
        }
}

/* Each target, by rate and by offset, with its gain and inverted. */
static void an_axis_can_do_anything(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    DeviceMap *map = &mapping.family[DEVICE_SPACEMOUSE];
    const DeviceState pushed = with_axis(DEVICE_SPACEMOUSE, 4, 1);
    for (int to = MAP_NOTHING; mapping_to_name(to); to++)
        for (int invert = 0; invert < 2; invert++) {
            HandInput input = {.dt = 0};
            double camera[3] = {0}, sum = 0;
            map->axes[4] = (AxisMap){to, invert, 0.5, invert};
            mapping_add(map, &pushed, &input, camera);
            for (int k = 0; k < 3; k++)
                sum += input.move_rate[k] + input.move_offset[k] + camera[k];
            for (int k = 0; k < 2; k++)
                sum += input.tilt_rate[k] + input.tilt_offset[k];
            sum += input.spin_rate + input.spin_offset;
            const bool other = to == MAP_MOVE_Z || to == MAP_TURN_X || to == MAP_TURN_Z;
            check_near(sum, to == MAP_NOTHING ? 0 : (other != invert ? -0.5 : 0.5), 1e-12,
                       mapping_to_name(to));
        }
}

static void the_shape_of_an_axis(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    DeviceMap *map = &mapping.family[DEVICE_SPACEMOUSE];
    map->dead_zone = 0.2, map->curve = 2, map->gain = 3;
    map->axes[0].gain = 0.5;
    check_near(mapping_shape(map, 0, 0.2), 0, 0, "at the rim of the dead zone");
    check_near(mapping_shape(map, 0, -0.1999), 0, 0, "in the dead zone");
    check_near(mapping_shape(map, 0, 0.6), 1.5 * 0.25, 1e-12, "half way");
    check_near(mapping_shape(map, 0, -0.6), -1.5 * 0.25, 1e-12, "half way back");
    check_near(mapping_shape(map, 0, 1), 1.5, 1e-12, "the end");
    check_near(mapping_shape(map, 0, 1.4), 1.5, 1e-12, "beyond");
    map->axes[0].invert = true;
    check_near(mapping_shape(map, 0, -0.6), 1.5 * 0.25, 1e-12, "inverted");
    check_near(mapping_shape(map, 0, NAN), 0, 0, "no number");
    check_near(mapping_shape(map, 0, INFINITY), 0, 0, "no number");
    map->dead_zone = 0, map->curve = 1;
    check_near(mapping_shape(map, 0, 0), 0, 0, "the middle");
}

static void a_pose_with_gain(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    DeviceMap *map = &mapping.family[DEVICE_DUALSENSE];
    const double turned[4] = {0.6 * sin(0.3), -0.8 * sin(0.3), 0, cos(0.3)};
    double out[4];
    mapping_pose(map, turned, out);
    check_vector(out, turned[0], turned[1], 0, 1e-12, "the same");
    map->gain = 0.5;
    mapping_pose(map, turned, out);
    check_vector(out, 0.6 * sin(0.15), -0.8 * sin(0.15), 0, 1e-12, "half of it");
    mapping_pose(map, (double[]){-turned[0], -turned[1], 0, -turned[3]}, out); /* the same turn */
    check_vector(out, 0.6 * sin(0.15), -0.8 * sin(0.15), 0, 1e-12, "half of it");
    mapping_pose(map, (double[]){0, 0, 0, 1}, out);
    check_vector(out, 0, 0, 0, 0, "none");
    check_near(out[3], 1, 0, "none");
}

static const UserAction *action_of(Mapping *mapping, uint16_t product, const char *button)
{
    const DeviceRow *row = device_row(product > 0xc000 ? 0x256f : 0x054c, product);
    assert_non_null(row);
    const DeviceMap *map = mapping_of(mapping, row->family, row->vendor, row->product);
    for (int bit = 0; bit < DEVICE_BUTTONS_MAX; bit++)
        if (row->buttons[bit] && strcmp(row->buttons[bit], button) == 0)
            return mapping_button(map, row->vendor, row->product, bit);
    return NULL;
}

static void buttons_by_name_whatever_their_bit(void **state)
{
    (void)state;
    Mapping mapping;
    mapping_default(&mapping);
    assert_ptr_equal(action_of(&mapping, 0x0ce6, "triangle"), &action_neutral);
    assert_ptr_equal(action_of(&mapping, 0x05c4, "triangle"), &action_neutral);
    assert_ptr_equal(action_of(&mapping, 0x05c4, "cross"), &action_box_home);
    assert_ptr_equal(action_of(&mapping, 0x0df2, "options"), &action_pause);
    assert_ptr_equal(action_of(&mapping, 0xc635, "left"), &action_box_home);
    assert_ptr_equal(action_of(&mapping, 0xc635, "right"), &action_pause);
    assert_ptr_equal(action_of(&mapping, 0xc631, "menu"), &action_pause);
    assert_null(mapping_button(&mapping.family[0], 0x256f, 0xc635, 31));
    assert_null(mapping_button(&mapping.family[0], 0x256f, 0xc635, 32));
    assert_null(mapping_button(&mapping.family[0], 1, 2, 0));

    /* No button of a product is without a place. */
    for (const DeviceRow *row = device_rows; row->name; row++)
        for (int bit = 0; bit < DEVICE_BUTTONS_MAX; bit++) {
            DeviceMap *map = &mapping.family[row->family];
            for (int i = 0; i < map->button_count; i++)
                map->buttons[i].action = &action_help;
            assert_ptr_equal(mapping_button(map, row->vendor, row->product, bit),
                             row->buttons[bit] ? &action_help : NULL);
        }
}

static void files(void **state)
{
    (void)state;
    char folder[SCRATCH_SIZE], path[SCRATCH_PATH], own[1024];
    Mapping mapping, back;
    Error error;
    scratch_folder(folder);
    setenv("XDG_CONFIG_HOME", folder, 1);
    assert_true(mapping_user_path(own));
    assert_true(mapping_load(NULL, &mapping, &error)); /* without own mappings */

    snprintf(path, sizeof path, "%s/a.yaml", folder);
    assert_false(mapping_load(path, &mapping, &error));
    assert_non_null(strstr(error.message, "a.yaml: cannot be opened"));
    mapping.family[1].gain = 4;
    assert_true(mapping_write_new(&mapping, path, &error));
    assert_false(mapping_write_new(&mapping, path, &error));
    assert_non_null(strstr(error.message, "stays as it is"));
    assert_true(mapping_load(path, &back, &error));
    check_same(&mapping, &back);
    assert_false(mapping_load(folder, &back, &error));

    snprintf(path, sizeof path, "%s/slosh", folder);
    assert_int_equal(mkdir(path, 0700), 0);
    mapping.family[1].gain = 5;
    assert_true(mapping_write_new(&mapping, own, &error));
    assert_true(mapping_load(NULL, &back, &error));
    check_same(&mapping, &back);
    assert_int_equal(remove(own), 0);
    assert_int_equal(rmdir(path), 0);

    assert_false(mapping_write_new(&mapping, own, &error)); /* no such folder */
    assert_non_null(strstr(error.message, "cannot be written"));
    setenv("XDG_CONFIG_HOME", "not/absolute", 1);
    setenv("HOME", "/home/somebody", 1);
    assert_true(mapping_user_path(own));
    assert_string_equal(own, "/home/somebody/.config/slosh/mapping.yaml");
    unsetenv("HOME");
    assert_false(mapping_user_path(own));
    assert_true(mapping_load(NULL, &back, &error));
}

static void the_example_in_the_docs(void **state)
{
    (void)state;
    char text[1 << 16];
    Mapping mapping;
    FILE *file = fopen(SLOSH_SOURCE_DIR "/docs/manual/devices.md", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    char *example = strstr(text, "```yaml\ndualsense:");
    assert_non_null(example);
    example += strlen("```yaml\n");
    *strstr(example, "```") = 0;
    check_taken(example, &mapping);
    BoxTarget target;
    const DeviceState right = with_axis(DEVICE_DUALSENSE, 0, 1);
    box_after(&mapping.family[DEVICE_DUALSENSE], &right, &target);
    assert_true(target.orientation[2] < -0.1); /* to the right, as it says */
    assert_ptr_equal(action_of(&mapping, 0x0ce6, "circle"), &action_neutral);
    assert_int_equal(mapping.own_count, 1);
}

/* A byte changed, or the text cut off: accepted or refused, without further effects. */
static void damaged_files(void **state)
{
    (void)state;
    Mapping mapping;
    Error error;
    mapping_default(&mapping);
    char *text = written(&mapping, mapping_write);
    const size_t size = strlen(text);
    unsigned seed = 1;
    int refused = 0;
    for (int i = 0; i < 400; i++) {
        seed = seed * 1664525 + 1013904223;
        const size_t at = (seed >> 8) % size;
        const char was = text[at];
        text[at] = (char)(seed >> 24);
        refused += !mapping_parse("m.yaml", text, i % 4 ? size : at, &mapping, &error);
        text[at] = was;
    }
    assert_in_range(refused, 50, 399);
    free(text);
}

static void in_words(void **state)
{
    (void)state;
    Mapping mapping;
    check_taken("dualsense: {gain: 0.5, axes: {left_x: {gain: 2, invert: true, as: rate}}}\n"
                "256f:c635: {axes: {x: {to: nothing}}}\n",
                &mapping);
    char *text = written(&mapping, mapping_explain);
    static const char *const words[] = {
        "3Dconnexion SpaceMouse: gain 1, dead zone 0.05, curve 2\n",
        "  x              moves the box to the right, as a speed\n",
        "Sony DualSense: gain 0.5",
        "  pose           turns the box as the device is turned, 1-fold\n",
        "  left_x         moves the box to the right, as a speed, 2-fold, the other way round\n",
        "  left_y         moves the box towards you, for as long as it is held\n",
        "  right_trigger  brings the camera nearer, as a speed\n",
        "  triangle       take the present pose of the motion device as level\n",
        "SpaceMouse Compact: gain 1",
        "  x              does nothing\n",
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strstr(text, words[i]))
            fail_msg("no '%s' in\n%s", words[i], text);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_built_in_comes_back_from_its_file),
        cmocka_unit_test(what_was_changed_comes_back),
        cmocka_unit_test(what_is_left_out_stays),
        cmocka_unit_test(mistakes_are_told_with_their_place),
        cmocka_unit_test(the_box_follows_the_cap),
        cmocka_unit_test(the_box_follows_the_left_stick),
        cmocka_unit_test(the_camera_follows_the_right_stick),
        cmocka_unit_test(an_axis_can_do_anything),
        cmocka_unit_test(the_shape_of_an_axis),
        cmocka_unit_test(a_pose_with_gain),
        cmocka_unit_test(buttons_by_name_whatever_their_bit),
        cmocka_unit_test(files),
        cmocka_unit_test(the_example_in_the_docs),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(in_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
