/* Scenes with periodic sides and a lid: how they are written, and what is refused where. */
#include "sim/start/start.h"
#include "tests/scene/scene_text.h"

#include <math.h>

/* What a test appends starts in line 7. */
#define FLAT                                                                                                 \
    "box: {size: [2, 1], periodic: [x], slip: none, lid: [1, 0]}\n"                                          \
    "particles: {spacing: 0.05}\n"                                                                           \
    "gravity: [0, 0]\n"                                                                                      \
    "fluids:\n"                                                                                              \
    "  - viscosity: 1\n"                                                                                     \
    "    fill: [{block: {min: [-1, 0], max: [1, 1]}}]\n"

static Scene scene;
static Error error;

static void axes_and_lid_are_read(void **state)
{
    (void)state;
    if (!parse_text(FLAT, NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_true(scene.world.periodic[0] && !scene.world.periodic[1] && !scene.world.periodic[2]);
    assert_true(scene.world.lid[0] == 1 && scene.world.lid[1] == 0);
    assert_true(parse_set(LEAST, "box.periodic=[z, x]", &scene, &error));
    assert_true(scene.world.periodic[0] && !scene.world.periodic[1] && scene.world.periodic[2]);
    assert_true(parse_set(LEAST, "box.periodic=[]", &scene, &error));
    assert_false(scene.world.periodic[0] || scene.world.periodic[1] || scene.world.periodic[2]);
}

static void what_is_no_axis_is_refused(void **state)
{
    (void)state;
    assert_set_refused("box.periodic=x",
                       "box.periodic must be a list of axes, such as [x] or [x, z], not 'x'");
    assert_set_refused("box.periodic=[w]",
                       "box.periodic must be a list of axes, such as [x] or [x, z], not 'w'");
    assert_set_refused("box.periodic=[1]", "box.periodic must be a list of axes");
}

static void refused_flat(const char *setting, const char *reason)
{
    if (parse_set(FLAT, setting, &scene, &error))
        fail_msg("%s was taken", setting);
    if (!strstr(error.message, reason))
        fail_msg("%s: expected '%s' in '%s'", setting, reason, error.message);
}

static void what_cannot_be_is_refused_at_its_line(void **state)
{
    (void)state;
    refused_flat("box.periodic=[x, z]", "a 2D scene has no sides in z");
    refused_flat("box.size=[0.2, 1]", "outside the box");
    refused_flat("particles.spacing=0.49", "less than two support radii");
    refused_flat("box.slip=free", "the lid drags no fluid that glides along it");
    refused_flat("box.lid=[1, 1]", "the lid moves in its plane");
    refused_flat("box.periodic=[y]", "a box that is periodic in y has no lid");
    assert_refused(FLAT "motion: [{spin: {axis: [0, 0, 1], rate: 1}}]\n",
                   "scene.yaml:7:10: a box with periodic sides does not turn");
    assert_refused(FLAT "solids: [{sphere: {centre: [0.9, 0.5], radius: 0.2}}]\n",
                   "scene.yaml:7:10: the solid reaches over a periodic side in x");
    assert_refused(FLAT
                   "solids: [{sphere: {centre: [0.7, 0.5], radius: 0.2}, motion: [{shake: {axis: [1, 0], "
                   "amplitude: 0.2, frequency: 1}}]}]\n",
                   "scene.yaml:7:10: the solid reaches over a periodic side in x");
    if (!parse_text(FLAT "motion: [{shake: {axis: [1, 0], amplitude: 0.2, frequency: 1}}]\n"
                         "solids: [{box: {centre: [0, 0.5], size: [2, 0.1]}}]\n",
                    NULL, &scene, &error))
        fail_msg("%s", error.message);
}

/* The lattice goes on across the sides, whatever the spacing. */
static void a_lattice_fits_its_sides(void **state)
{
    (void)state;
    for (size_t particles = 700; particles < 1000; particles += 37) {
        SceneSettings settings = {.particles = particles};
        assert_true(parse_text(FLAT, &settings, &scene, &error));
        const double s = scene.world.spacing, across = round(2 / s);
        const size_t count = seed_count(&scene.world, s);
        assert_int_equal(count % (size_t)across, 0);
        assert_float_equal((double)count * s * s, 2, 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_and_lid_are_read),
        cmocka_unit_test(what_is_no_axis_is_refused),
        cmocka_unit_test(what_cannot_be_is_refused_at_its_line),
        cmocka_unit_test(a_lattice_fits_its_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
