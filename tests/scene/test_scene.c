/* The loader on texts in memory: what a scene becomes, and what is refused with which words at which place.
 */
#include "app/scene/scene.h"
#include "sim/start/start.h"
#include "sim/world.h"
#include "tests/scene/scene_text.h"

#include <stdlib.h>

static void least_scene_gets_the_defaults(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    assert_true(parse_text(LEAST, NULL, &scene, &error));
    const WorldDef plain = world_def_default();
    assert_string_equal(scene.path, "scene.yaml");
    assert_string_equal(scene.title, "scene");
    assert_true(scene.world.gravity[1] == -9.81 && scene.world.support == 2.1);
    assert_true(scene.world.dt == plain.dt && scene.world.substeps == plain.substeps);
    assert_string_equal(scene.world.method, "mueller");
    assert_int_equal(scene.world.fluid_count, 1);
    assert_string_equal(scene.world.fluids[0].name, "fluid 1");
    assert_int_equal(seed_count(&scene.world, scene.world.spacing), 500);
    assert_true(scene.view.camera_auto && scene.view.range_auto);
}

static const char full[] =
    "title: All keys\n"
    "box: {size: [2, 1, 0.5]}\n"
    "gravity: [0.5, -1.62, 0]\n"
    "particles: {spacing: 0.05, support: 2.6}\n"
    "fluids:\n"
    "  - {name: heavy, density: 1200, viscosity: 0.5, velocity: [1, 2, 3], color: [1, 0.5, 0],\n"
    "     fill: [{block: {min: [-1, 0, -0.25], max: [0, 0.5, 0.25]}}]}\n"
    "  - name: drop\n"
    "    fill:\n"
    "      - ball: {centre: [0.5, 0.7, 0.01], radius: 0.2}\n"
    "motion:\n"
    "  - shake: {axis: [0, 0, 2], amplitude: 0.1, frequency: 0.5, start: 1, duration: 4}\n"
    "  - turn: {axis: [0, 1, 0], angle: -30, duration: 2}\n"
    "solver: {sound_speed: 12.5, negative_pressure: true, threads: 2,\n"
    "         step: {mode: fixed, dt: 5e-3, substeps: 4}}\n"
    "view:\n"
    "  kind: none\n"
    "  color_by: pressure\n"
    "  colormap: plasma\n"
    "  range: [-5, 1e3]\n"
    "  radius: 0.7\n"
    "  legend: false\n"
    "  background: [1, 1, 1]\n"
    "  camera: {from: [3, 2, 1], to: [0, 0.5, 0], fov: 40}\n";

static void every_value_reaches_its_field(void **state)
{
    (void)state;
    static Scene s;
    Error error;
    if (!parse_text(full, NULL, &s, &error))
        fail_msg("%s", error.message);
    assert_string_equal(s.title, "All keys");
    assert_true(s.world.box_size[0] == 2 && s.world.box_size[2] == 0.5 && s.world.gravity[1] == -1.62);
    assert_true(s.world.spacing == 0.05 && s.world.support == 2.6);
    const FluidDef *heavy = &s.world.fluids[0], *drop = &s.world.fluids[1];
    assert_true(heavy->density == 1200 && heavy->viscosity == 0.5 && heavy->velocity[2] == 3);
    assert_true(heavy->fills[0].kind == FILL_BLOCK && heavy->fills[0].min[2] == -0.25 &&
                heavy->fills[0].max[1] == 0.5);
    assert_true(drop->fills[0].kind == FILL_BALL && drop->fills[0].centre[1] == 0.7 &&
                drop->fills[0].radius == 0.2);
    assert_true(drop->density == 1000);
    /* sRGB 0.5 is 0.2140 in linear light (IEC 61966-2-1) */
    assert_true(heavy->color[0] == 1 && heavy->color[2] == 0);
    assert_float_equal(heavy->color[1], 0.21404, 1e-4);
    const Motion *shake = &s.world.motions[0], *turn = &s.world.motions[1];
    assert_true(s.world.motion_count == 2 && shake->kind == MOTION_SHAKE && turn->kind == MOTION_TURN);
    assert_true(shake->axis[2] == 2 && shake->amplitude == 0.1 && shake->frequency == 0.5 &&
                shake->start == 1);
    assert_true(shake->duration == 4 && turn->angle_deg == -30 && turn->duration == 2);
    assert_true(s.world.sound_speed == 12.5 && s.world.negative_pressure && *world_threads(&s.world) == 2);
    assert_true(s.world.dt == 5e-3 && s.world.substeps == 4);
    assert_string_equal(s.view.kind, "none");
    assert_string_equal(s.view.colormap, "plasma");
    assert_true(s.view.color_by == SCALAR_PRESSURE && !s.view.range_auto && s.view.range[0] == -5);
    assert_true(s.view.radius == 0.7 && !s.view.legend && s.view.box && s.view.background[1] == 1);
    assert_true(!s.view.camera_auto && s.view.camera.from[0] == 3 && s.view.camera.fov_deg == 40);
}

static void texts_are_unquoted(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    assert_true(parse_text(LEAST "title: \"caf\\u00e9 \\x41\"\n", NULL, &scene, &error));
    assert_string_equal(scene.title, "caf\xc3\xa9 A");
    assert_true(parse_text(LEAST "title: 'it''s'\n", NULL, &scene, &error));
    assert_string_equal(scene.title, "it's");
    assert_refused(LEAST "title: |\n  two\n  lines\n", "scene.yaml:8:1: title has more than one line");
}

static void what_is_no_scene_is_refused(void **state)
{
    (void)state;
    assert_refused("", "scene.yaml:1:1: the scene is empty");
    assert_refused("# only a comment\n", "scene.yaml:1:1: the scene is empty");
    assert_refused("- a\n", "scene.yaml:1:1: a scene is a mapping");
    assert_refused("just words\n", "scene.yaml:1:1: a scene is a mapping");
    assert_refused("a: [1\nb: }", "scene.yaml:2:4: not valid YAML");
    assert_refused("box: {size: [1, 1, 1]}\n  x: 1\n", "scene.yaml:2:3: not valid YAML");
    assert_refused("title: caf\xe9\n", "scene.yaml:1:11: byte 0xe9 is no text");
    assert_refused("title: a\x01z\n", "scene.yaml:1:9: byte 0x01 is no text");
    assert_refused("title: \xc0\xaf\n", "scene.yaml:1:8: byte 0xc0 is no text"); /* overlong '/' */
    assert_refused(LEAST "---\ntitle: x\n", "scene.yaml:7:1: a second document");
}

static void anchors_tags_and_twins_are_refused(void **state)
{
    (void)state;
    assert_refused("box: &a [*a]\n", "scene.yaml:1:10: an alias (*name)");
    assert_refused("a: &a {b: *a}\n", "scene.yaml:1:11: an alias (*name)");
    assert_refused(LEAST "title: !!str x\n", "scene.yaml:7:8: a tag (!name)");
    assert_refused(LEAST "box: {size: [2, 2, 2]}\n",
                   "scene.yaml:7:1: 'box' stands here twice (first in line 1)");
    assert_refused("%YAML 1.2\n---\n" LEAST, "scene.yaml:1:1: a directive (%NAME)");
    assert_refused(LEAST "title: x\n%%%%", "scene.yaml:8:1: a directive (%NAME)");
    assert_set_refused("title=%%%%", "a directive (%NAME)");
    assert_set_refused("title=\x1b", "byte 0x1b is no text");
    assert_refused(LEAST "? [1, 2]\n: 3\n", "scene.yaml:7:3: a key must be a name");
    assert_refused(LEAST "'': 3\n", "scene.yaml:7:1: a key is empty");
}

static void binary_noise_is_refused(void **state)
{
    (void)state;
    static Scene scene;
    Error error;
    char noise[4096];
    unsigned seed = 1;
    for (size_t i = 0; i < sizeof noise; i++)
        noise[i] = (char)((seed = seed * 1664525u + 1013904223u) >> 24);
    assert_false(scene_parse("noise", noise, sizeof noise, NULL, &scene, NULL, &error));
    assert_non_null(strstr(error.message, "no text"));
}

static void what_is_too_much_is_refused_at_once(void **state)
{
    (void)state;
    static Scene scene;
    const size_t size = 3000000;
    char *text = malloc(size);
    Error error;
    memset(text, '{', size);
    assert_false(scene_parse("braces.yaml", text, size, NULL, &scene, NULL, &error));
    assert_string_equal(error.message, "braces.yaml: larger than 1 MiB; a scene file is a page of YAML");
    assert_false(scene_parse("braces.yaml", text, SCENE_BYTES_MAX, NULL, &scene, NULL, &error));
    assert_string_equal(error.message, "braces.yaml:1:2: a key must be a name; write `name: value`");
    memset(text, '[', size);
    assert_false(scene_parse("brackets.yaml", text, SCENE_BYTES_MAX, NULL, &scene, NULL, &error));
    assert_string_equal(error.message,
                        "brackets.yaml:1:34: nested too deeply; nothing needs more than 32 levels");
    size_t used = 0;
    for (int i = 0; used + 32 < SCENE_BYTES_MAX; i++)
        used += (size_t)sprintf(text + used, "k%d: 1\n", i);
    assert_false(scene_parse("keys.yaml", text, used, NULL, &scene, NULL, &error));
    assert_non_null(strstr(error.message, "keys.yaml:257:1: more than 256 keys"));
    free(text);
}

static void unknown_keys_name_the_nearest_known_one(void **state)
{
    (void)state;
    assert_refused(LEAST "    viscocity: 3\n",
                   "scene.yaml:7:5: unknown key 'viscocity'; did you mean 'viscosity'?");
    assert_refused(LEAST "gravitiy: [0, 0, 0]\n",
                   "scene.yaml:7:1: unknown key 'gravitiy'; did you mean 'gravity'?");
    assert_refused(LEAST "spacing: 3\n",
                   "scene.yaml:7:1: unknown key 'spacing' here; did you mean 'particles.spacing'?");
    assert_refused(LEAST "block: {min: [0, 0, 0]}\n",
                   "scene.yaml:7:1: unknown key 'block' here; did you mean 'fluids[].fill[].block'?");
    assert_refused(LEAST "solids: [{axis: [0, 1, 0]}]\n",
                   "scene.yaml:7:11: unknown key 'axis' here; did you mean 'solids[].box.axis'?");
    assert_refused(LEAST "solver: {xyzzy: 3}\n",
                   "scene.yaml:7:10: unknown key 'xyzzy'; known here: method, ");
    assert_refused(LEAST "motion:\n  - wobble: {}\n",
                   "scene.yaml:8:5: unknown key 'wobble'; known here: shake, rock, turn, spin, accelerate");
    assert_refused(LEAST "motion:\n  - spin: {axis: [0, 1, 0], rate: 1, frequency: 2}\n",
                   "scene.yaml:8:38: unknown key 'frequency'");
}

/* A floating solid needs a density, walls around and no further motion. */
static void what_cannot_float_is_refused(void **state)
{
    (void)state;
#define BALL "solids:\n  - sphere: {centre: [0, 0.6, 0], radius: 0.1}\n"
    assert_refused(
        LEAST BALL "    density: 300\n    motion: [{spin: {axis: [0, 1, 0], rate: 1}}]\n",
        "scene.yaml:9:14: fluid moves a solid with a density; leave out its motion, or the density");
    assert_refused(LEAST BALL "    hinge: {at: [0, 0.6, 0], axis: [0, 0, 1]}\n",
                   "scene.yaml:9:12: nothing turns a solid without a density; write `density`, in kg/m3");
    assert_refused(LEAST BALL "    density: 300\n    hinge: {at: [0, 0.6, 0]}\n",
                   "scene.yaml:10:12: the hinge has no direction; write its `axis`, such as [0, 0, 1]");
    assert_refused(LEAST BALL "    density: 300\n    hinge: {}\n",
                   "scene.yaml:10:12: the hinge has no direction; write its `axis`, such as [0, 0, 1]");
    static Scene whole; /* as snapshots have all keys */
    Error error;
    assert_true(parse_text(LEAST BALL "    hinge: {at: [0, 0, 0], axis: [0, 0, 0]}\n", NULL, &whole, &error));
    assert_refused(LEAST BALL "    density: -1\n",
                   "scene.yaml:9:14: solids[0].density must be 0 to 1e+06 kg/m3, not -1");
#undef BALL
}

/* What a fill calls a ball is a sphere among solids. */
static void a_kind_by_another_lists_name_is_found(void **state)
{
    (void)state;
    static const char *const kinds[][2] = {{"ball", "sphere"}, {"disc", "sphere"}, {"block", "box"}};
    for (int i = 0; i < 3; i++) {
        char text[512], message[128];
        snprintf(text, sizeof text, LEAST "solids: [{%s: {radius: 1}}]\n", kinds[i][0]);
        snprintf(message, sizeof message, "scene.yaml:7:11: unknown key '%s'; did you mean '%s'?",
                 kinds[i][0], kinds[i][1]);
        assert_refused(text, message);
    }
    assert_refused(LEAST "drains: [{sphere: {radius: 1}}]\n",
                   "scene.yaml:7:11: unknown key 'sphere'; did you mean 'ball'?");
}

static void wrong_types_are_refused(void **state)
{
    (void)state;
    assert_refused(LEAST "gravity: 9.81\n",
                   "scene.yaml:7:10: gravity must be three numbers [x, y, z] in m/s2, not '9.81'");
    assert_refused(LEAST "gravity: [0, -9.81]\n", "scene.yaml:7:10: gravity must be three numbers");
    assert_refused(LEAST "gravity: [0, down, 0]\n", "scene.yaml:7:14: gravity must be three numbers");
    assert_refused(LEAST "gravity:\n",
                   "scene.yaml:7:1: gravity must be three numbers [x, y, z] in m/s2, not empty");
    assert_refused(LEAST "solver: {sound_speed: '12'}\n",
                   "scene.yaml:7:23: solver.sound_speed must be a number in m/s");
    assert_refused(LEAST "solver: {sound_speed: 0x10}\n",
                   "scene.yaml:7:23: solver.sound_speed must be a number");
    assert_refused(LEAST "solver: {threads: 1.5}\n",
                   "scene.yaml:7:19: solver.threads must be a whole number");
    assert_refused(LEAST "solver: {negative_pressure: yes}\n",
                   "scene.yaml:7:29: solver.negative_pressure must be true or false, not 'yes'");
    assert_refused(LEAST "solver: [1]\n", "scene.yaml:7:9: solver must be a mapping");
    assert_refused(LEAST "view:\n", "scene.yaml:7:1: view must be a mapping");
    assert_refused(LEAST "motion: {}\n", "scene.yaml:7:9: motion must be a list");
    assert_refused(LEAST "motion: [3]\n", "scene.yaml:7:10: motion[0] must be a mapping");
    assert_refused(LEAST "title: [a]\n", "scene.yaml:7:8: title must be a text, not a list");
    assert_refused(
        LEAST "solver: {method: muller}\n",
        "scene.yaml:7:18: solver.method cannot be 'muller'; did you mean 'mueller'? it must be one of: mueller");
    assert_refused(LEAST "view: {range: [1]}\n",
                   "scene.yaml:7:15: view.range must be auto, symmetric or two numbers");
}

static void numbers_must_be_finite_and_in_range(void **state)
{
    (void)state;
    assert_refused(LEAST "gravity: [0, .nan, 0]\n",
                   "scene.yaml:7:14: gravity must be a finite number, not .nan");
    assert_refused(LEAST "gravity: [0, -.inf, 0]\n",
                   "scene.yaml:7:14: gravity must be a finite number, not -.inf");
    assert_refused(LEAST "gravity: [0, 1e999, 0]\n",
                   "scene.yaml:7:14: gravity must be a finite number, not 1e999");
    assert_set_refused("particles.spacing=-0.1", "particles.spacing must be 1e-07 to 10000 m, not -0.1");
    assert_set_refused("particles.spacing=NaN", "particles.spacing must be a finite number");
    assert_set_refused("box.size=[1, -1, 1]", "box.size must be 1e-06 to 1e+06 m, not -1");
}

static void what_is_missing_is_named(void **state)
{
    (void)state;
    assert_refused("title: x\n", "scene.yaml:1:1: box.size is missing");
    assert_refused("box: {}\n", "scene.yaml:1:6: box.size is missing");
    assert_refused("box: {size: [1, 1, 1]}\n", "scene.yaml:1:1: particles.spacing is missing");
    assert_refused("box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\n",
                   "scene.yaml:1:1: fluids is missing");
    assert_refused("box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\nfluids: []\n",
                   "scene.yaml:3:9: fluids has 0 entries; it must have 1 to 8");
    assert_refused("box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\nfluids:\n  - name: x\n",
                   "scene.yaml:4:5: the fluid 'x' is nowhere; give it `fill` or `emit`");
    assert_refused(LEAST "      - block: {min: [0, 0, 0]}\n",
                   "scene.yaml:7:16: fluids[0].fill[1].block.max is missing");
    assert_refused(LEAST "      - {}\n",
                   "scene.yaml:7:9: fluids[0].fill[1] must have exactly one of: block, ball, cylinder");
    assert_refused(LEAST "motion:\n  - turn: {axis: [0, 1, 0], angle: 3}\n",
                   "scene.yaml:8:11: motion[0].turn.duration is missing");
    assert_refused(LEAST "view: {camera: {fov: 30}}\n", "scene.yaml:7:16: view.camera.from is missing");
}

/* A number, or rows of seconds and Pa s in either style of YAML. */
static void a_viscosity_may_be_a_table(void **state)
{
    (void)state;
    static Scene scene;
    const FluidDef *fluid = &scene.world.fluids[0];
    const TimeTable *table = &fluid->viscosity_table;
    Error error;
    assert_true(parse_text(LEAST "    viscosity: [[1, 50], [3, 10]]\n", NULL, &scene, &error));
    assert_true(table->rows == 2 && table->time[1] == 3 && table->value[0] == 50 && table->value[1] == 10);
    assert_true(fluid->viscosity == 50);
    world_def_at(&scene.world, 2);
    assert_true(fluid->viscosity == 30);
    assert_true(parse_text(LEAST "    viscosity:\n      - [0.5, 7]\n", NULL, &scene, &error));
    assert_true(table->rows == 1 && table->time[0] == 0.5 && fluid->viscosity == 7);
    assert_true(
        parse_set(LEAST "    viscosity: [[0, 1], [1, 2]]\n", "fluids[0].viscosity=3", &scene, &error));
    assert_true(table->rows == 0 && fluid->viscosity == 3);
    assert_true(parse_set(LEAST, "fluids[0].viscosity[0]=[0, 4]", &scene, &error));
    assert_true(table->rows == 1 && fluid->viscosity == 4);
}

static void tables_must_make_sense(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"[]", "16: fluids[0].viscosity has 0 rows; a table must have 1 to 16"},
        {"[[0,1],[1,1],[2,1],[3,1],[4,1],[5,1],[6,1],[7,1],[8,1],[9,1],[10,1],[11,1],[12,1],[13,1],[14,1],[15,1],"
         "[16,1]]",
         "16: fluids[0].viscosity has 17 rows; a table must have 1 to 16"},
        {"[1, 2]", "17: fluids[0].viscosity must be a number or rows [seconds, number]"},
        {"[[1]]", "17: fluids[0].viscosity must be a number or rows [seconds, number]"},
        {"[[0, 1], [x, 1]]", "26: fluids[0].viscosity must be a number or rows [seconds, number]"},
        {"[[0, 1], [2, y]]", "29: fluids[0].viscosity must be a number or rows [seconds, number]"},
        {"[[0, 1], [2, -1]]", "29: fluids[0].viscosity must be 0 to 1e+09 Pa s, not -1"},
        {"[[0, 1], [2, .nan]]", "29: fluids[0].viscosity must be a finite number, not .nan"},
        {"[[-1, 1]]", "18: fluids[0].viscosity: times must be 0 to 1e+06 s, not -1"},
        {"[[.nan, 1]]", "18: fluids[0].viscosity: times must be 0 to 1e+06 s, not .nan"},
        {"[[2, 1], [2, 3]]", "26: fluids[0].viscosity: times must ascend; 2 stands after 2"},
        {"{at: 1}", "16: fluids[0].viscosity must be a number or rows [seconds, number]"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512], message[256];
        snprintf(text, sizeof text, LEAST "    viscosity: %s\n", cases[i][0]);
        snprintf(message, sizeof message, "scene.yaml:7:%s", cases[i][1]);
        assert_refused(text, message);
    }
}

static void fluid_must_lie_in_the_box(void **state)
{
    (void)state;
    const char *outside = "the fluid is outside the box: it reaches from";
    char message[256];
    snprintf(message, sizeof message, "scene.yaml:7:44: %s 0 to 1.1 m in y; the box from 0 to 1 m", outside);
    assert_refused(LEAST "      - block: {min: [0, 0, 0], max: [0.1, 1.1, 0.1]}\n", message);
    snprintf(message, sizeof message, "scene.yaml:7:23: %s -0.6 to 0.1 m in x; the box from -0.5 to 0.5 m",
             outside);
    assert_refused(LEAST "      - block: {min: [-0.6, 0, 0], max: [0.1, 0.1, 0.1]}\n", message);
    snprintf(message, sizeof message, "scene.yaml:7:28: %s 0.7 to 1.1 m in y", outside);
    assert_refused(LEAST "      - ball: {centre: [0, 0.9, 0], radius: 0.2}\n", message);
    snprintf(message, sizeof message, "scene.yaml:7:32: %s -0.1 to 0.3 m in y", outside);
    assert_refused(LEAST "      - cylinder: {centre: [0, 0.1, 0], radius: 0.1, height: 0.4}\n", message);
    assert_refused(LEAST
                   "      - cylinder: {centre: [0, 0.5, 0], radius: 0.1, height: 0.4, axis: [0, 0, 0]}\n",
                   "scene.yaml:7:73: the axis has no direction; write one such as [1, 0, 0]");
    assert_refused(LEAST "      - block: {min: [0, 0.5, 0], max: [0.1, 0.5, 0.1]}\n",
                   "scene.yaml:7:46: the block's min is not below its max in y (0.5 and 0.5 m)");
}

#define BELOW(formula)                                                                                       \
    LEAST "      - {block: {min: [0, 0.6, 0], max: [0.5, 0.9, 0.5]}, below: \"" formula "\"}\n"

/* It would leave fluid out. */
static void a_height_without_a_value_is_refused(void **state)
{
    (void)state;
    Error error;
    static Scene scene;
    assert_refused(BELOW("0.8 + 0*log(x - 0.3)"),
                   "scene.yaml:7:66: the height \"0.8 + 0*log(x - 0.3)\" has no value at x 0.05, z 0.05 m");
    assert_true(parse_text(BELOW("0.8 + 0*log(x)"), NULL, &scene, &error));
}

static void control_characters_are_refused(void **state)
{
    (void)state;
    static const char *const titles[] = {"\\e[2J", "\\a", "\\x7f", "a\\x9b", "\\0"};
    static const int codes[] = {27, 7, 127, 155, 0};
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        char text[512], message[160];
        snprintf(text, sizeof text, "title: \"%s\"\n%s", titles[i], LEAST);
        snprintf(
            message, sizeof message,
            "scene.yaml:1:8: a character with the code %d, which a terminal would obey; write the text without it",
            codes[i]);
        assert_refused(text, message);
    }
    Error error = {{0}};
    error_set(&error, "\x1b]0;a\a \xc2\x9b \xc3\xa9\t\n\x7f");
    assert_string_equal(error.message, "?]0;a? ?? \xc3\xa9\t\n?");
}

static void words_ask_for_something_else(void **state)
{
    (void)state;
    assert_refused(LEAST "views: [{views: [{}]}]\n",
                   "scene.yaml:7:10: 'views' cannot stand here; it is a key of the scene itself");
    assert_refused(
        LEAST "views: [{}, {set: {}}]\n",
        "scene.yaml:7:19: views[1].set must be a mapping of settings, such as {solver.step.dt: 0.001}, not an empty one");
}

static void values_must_fit_each_other(void **state)
{
    (void)state;
    static const char twins[] = LEAST "    name: oil\n"
                                      "  - name: oil\n"
                                      "    fill: [{ball: {centre: [0, 0.8, 0], radius: 0.1}}]\n";
    static const char tiny[] = LEAST "  - name: speck\n"
                                     "    fill: [{ball: {centre: [0, 0.8, 0], radius: 0.01}}]\n";
    static const char hidden[] = LEAST "  - name: below\n"
                                       "    fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.2, 0.5]}}]\n";
    assert_refused(twins, "scene.yaml:8:11: two fluids have the name 'oil'");
    assert_refused(tiny, "scene.yaml:8:11: the fluid 'speck' has no particles");
    assert_refused(hidden, "scene.yaml:8:11: the fluid 'below' has no particles");
    assert_refused(LEAST "view: {range: [3, 1]}\n",
                   "scene.yaml:7:15: the range's low (3) is not below its high (1)");
    assert_refused(LEAST "view: {camera: {from: [0, 0, 0], to: [0, 0, 0]}}\n",
                   "scene.yaml:7:16: the camera stands where it looks");
    assert_refused(LEAST "motion:\n  - spin: {axis: [0, 0, 0], rate: 1}\n",
                   "scene.yaml:8:18: the axis has no direction");
    assert_set_refused("particles.spacing=0.6",
                       "the spacing of 0.6 m is too large for the box; use at most 0.5 m");
}

static void solids_must_make_sense(void **state)
{
    (void)state;
    assert_refused(LEAST "solids:\n  - slip: none\n",
                   "scene.yaml:8:5: solids[0] must have exactly one of: sphere, box, cylinder, bowl");
    assert_refused(LEAST "solids:\n  - sphere: {centre: [0, 0.5, 0], radius: 0.1}\n"
                         "    bowl: {centre: [0, 0.5, 0], radius: 0.1}\n",
                   "scene.yaml:8:5: solids[0] must have exactly one of: sphere, box, cylinder, bowl");
    assert_refused(LEAST "solids:\n  - box: {centre: [0, 0.5, 0], size: [0.4, 0.05, 0.4]}\n",
                   "scene.yaml:8:10: the solid is 0.05 m thin, less than the spacing of 0.1 m");
    assert_refused(LEAST "solids:\n  - bowl: {centre: [0, 0.5, 0], radius: 0.3, thickness: 0.02}\n",
                   "scene.yaml:8:11: the solid is 0.02 m thin");
    assert_refused(LEAST
                   "solids:\n  - cylinder: {centre: [0, 0.5, 0], radius: 0.3, height: 1, axis: [0, 0, 0]}\n",
                   "scene.yaml:8:67: the axis has no direction");
    assert_refused(LEAST "solids:\n  - sphere: {centre: [0, 0.5, 0], radius: 0.3}\n    motion:\n"
                         "      - rock: {axis: [0, 0, 0], angle: 1, frequency: 1}\n",
                   "scene.yaml:10:22: the axis has no direction");
    static Scene scene;
    Error error;
    assert_false(parse_set(LEAST "solids:\n  - box: {centre: [0, 0.5, 0], size: [900, 900, 900]}\n",
                           "fluids[0].density=1", &scene, &error));
    assert_non_null(strstr(error.message, "the solids' surfaces need about"));
    assert_set_refused("solids[0].slip=free", "solids[0] must have exactly one of: sphere, box");
}

static void emitters_and_drains_must_make_sense(void **state)
{
    (void)state;
    static const char jet[] =
        LEAST "    emit:\n      - disk: {centre: [0, %s, 0], direction: [0, %s, 0], radius: 0.2}\n"
              "        speed: 1\n%s";
    static const struct {
        const char *height, *up, *more, *message;
    } wrong[] = {
        {"1.5", "1", "", "the fluid is outside the box: it reaches from 1.5 to 1.5 m in y"},
        {"0.5", "0", "", "scene.yaml:8:48: the direction has no length"},
        {"0.5", "1", "solids:\n  - sphere: {centre: [0, 0.5, 0], radius: 0.3}\n",
         "scene.yaml:8:24: the emitter is inside solids[0]; move one of them"},
        {"0.5", "1", "solids:\n  - sphere: {centre: [5, 0.5, 0], radius: 0.3}\n",
         "the solid is outside the box, and does not move"},
        {"0.5", "1", "drains:\n  - ball: {centre: [5, 0.5, 0], radius: 0.3}\n",
         "the drain is outside the box"},
        {"0.5", "1", "        loud: 1\n", "scene.yaml:10:9: unknown key 'loud'"},
        {"0.5", "1", "drains:\n  - block: {min: [0, 0, 0], max: [0, 1, 1]}\n",
         "the block's min is not below its max in x (0 and 0 m)"},
        {"0.5", "1", "drains:\n  - tap: {}\n", "unknown key 'tap'"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[1024];
        snprintf(text, sizeof text, jet, wrong[i].height, wrong[i].up, wrong[i].more);
        static Scene scene;
        Error error = {0};
        assert_false(parse_text(text, NULL, &scene, &error));
        if (!strstr(error.message, wrong[i].message))
            fail_msg("'%s' is not in '%s'", wrong[i].message, error.message);
    }
    char text[1024];
    static Scene scene;
    Error error = {0};
    snprintf(text, sizeof text, jet, "0.5", "1", "");
    assert_false(parse_set(text, "fluids[0].emit[0].disk.radius=0.6", &scene, &error));
    assert_non_null(strstr(error.message, "it reaches from -0.6 to 0.6 m in x"));
    assert_true(parse_text(text, NULL, &scene, &error));
    assert_int_equal(scene.world.fluids[0].emit_count, 1);
    assert_true(scene.world.fluids[0].emits[0].speed == 1 && scene.world.most == 100000);
    assert_false(parse_set(text, "particles.most=10", &scene, &error));
    assert_non_null(strstr(error.message, "more than the 10 that emitters may fill up to; raise it"));
    assert_false(parse_set(text, "particles.most=2000000000", &scene, &error));
    assert_non_null(strstr(error.message, "are more than this machine can hold"));
}

static void what_no_machine_can_hold_is_refused(void **state)
{
    (void)state;
    /* 0.5 m3 at 0.63 mm are two billion particles */
    assert_set_refused("particles.spacing=0.00063",
                       "about 2e+09 particles are more than this machine can hold");
    assert_set_refused("particles.spacing=1e-6", "about 5e+17 particles are more than this machine can hold");
    static Scene scene;
    Error error;
    static const char far_apart[] = "box: {size: [1000, 1000, 1000]}\nparticles: {spacing: 0.01}\nfluids:\n"
                                    "  - fill:\n"
                                    "      - ball: {centre: [-499, 1, -499], radius: 0.05}\n"
                                    "      - ball: {centre: [499, 999, 499], radius: 0.05}\n";
    assert_false(parse_text(far_apart, NULL, &scene, &error));
    assert_non_null(strstr(error.message, "scene.yaml:2:22: the box holds"));
    assert_refused(LEAST "view: {kind: volume, volume: {cells: 4000}}\n",
                   "scene.yaml:7:38: a volume of 5680 cells along x");
    assert_refused(LEAST "view: {kind: volume, volume: {cell: 0.001}}\n",
                   "scene.yaml:7:37: a volume of 14200 cells along x");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(least_scene_gets_the_defaults),
        cmocka_unit_test(every_value_reaches_its_field),
        cmocka_unit_test(texts_are_unquoted),
        cmocka_unit_test(what_is_no_scene_is_refused),
        cmocka_unit_test(anchors_tags_and_twins_are_refused),
        cmocka_unit_test(binary_noise_is_refused),
        cmocka_unit_test(what_is_too_much_is_refused_at_once),
        cmocka_unit_test(unknown_keys_name_the_nearest_known_one),
        cmocka_unit_test(a_kind_by_another_lists_name_is_found),
        cmocka_unit_test(what_cannot_float_is_refused),
        cmocka_unit_test(wrong_types_are_refused),
        cmocka_unit_test(numbers_must_be_finite_and_in_range),
        cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(a_viscosity_may_be_a_table),
        cmocka_unit_test(tables_must_make_sense),
        cmocka_unit_test(fluid_must_lie_in_the_box),
        cmocka_unit_test(a_height_without_a_value_is_refused),
        cmocka_unit_test(control_characters_are_refused),
        cmocka_unit_test(words_ask_for_something_else),
        cmocka_unit_test(values_must_fit_each_other),
        cmocka_unit_test(solids_must_make_sense),
        cmocka_unit_test(emitters_and_drains_must_make_sense),
        cmocka_unit_test(what_no_machine_can_hold_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
