/* Probes in a scene file: parsing, errors with places, notes. */
#include "tests/scene/scene_text.h"

#include "app/scene/scene.h"

#include <stdlib.h>

static Scene scene;
static Error error;

static void are_read(void **state)
{
    (void)state;
    static const char text[] =
        LEAST "probes:\n"
              "  - {name: wall, point: {at: [0.5, 0.1, 0]}, size: 0.5, average: 0.01,\n"
              "     fields: [velocity, pressure]}\n"
              "  - {name: front, height: {at: [0.4, 0, 0]}}\n"
              "  - {name: rake, line: {from: [0, 0, 0], to: [0, 1, 0], count: 21}}\n"
              "  - {name: lid, plane: {at: [0, 1, 0], along: [1, 0, 0], across: [0, 0, 1]}}\n";
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    const ProbeDef *probe = scene.probes.probe;
    assert_int_equal(scene.probes.count, 4);
    assert_string_equal(probe[0].name, "wall");
    assert_int_equal(probe[0].kind, PROBE_POINT);
    assert_int_equal(probe[0].field_count, 2);
    assert_int_equal(probe[0].fields[0], PROBE_VELOCITY);
    assert_true(probe[0].average == 0.01 && probe[0].size == 0.5 && probe[0].at[0] == 0.5);
    assert_int_equal(probe[1].kind, PROBE_HEIGHT);
    assert_int_equal(probe[2].count, 21);
    assert_int_equal(probe[3].count, 9);
    assert_int_equal(probe[3].fields[0], PROBE_PRESSURE);
    assert_true(parse_set(text, "probes[0].average=0.5", &scene, &error));
    assert_true(probe[0].average == 0.01 && scene.probes.probe[0].average == 0.5); /* a new list */
    char *printed = scene_print_text(&scene);
    assert_non_null(strstr(printed, "probes[0].fields = [velocity, pressure]"));
    free(printed);
    assert_true(parse_text(LEAST, NULL, &scene, &error) && scene.probes.count == 0);
}

#define PROBE(words) LEAST "probes:\n  - " words "\n"

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    assert_refused(PROBE("{point: {at: [0, 0, 0]}}"), "scene.yaml:8:5: probes[0].name is missing");
    assert_refused(PROBE("{name: a}"),
                   "scene.yaml:8:5: probes[0] must have exactly one of: point, height, line, plane, force");
    assert_refused(PROBE("{name: a-b, point: {at: [0, 0, 0]}}"),
                   "scene.yaml:8:12: 'a-b' cannot be the name of columns");
    assert_refused(PROBE("{name: a, point: {at: [0, 0, 0]}}\n  - {name: a, height: {at: [0, 0, 0]}}"),
                   "scene.yaml:9:12: probes[0] is called 'a' too");
    assert_refused(PROBE("{name: a, line: {from: [0, 0, 0], to: [0, 1, 0], count: 3}}\n"
                         "  - {name: a_2, point: {at: [0, 0, 0]}}"),
                   "scene.yaml:9:12: 'a_2' has a column a_2.pressure, and so has probes[0], 'a'");
    assert_refused(PROBE("{name: a_0, point: {at: [0, 0, 0]}}\n"
                         "  - {name: a, line: {from: [0, 0, 0], to: [0, 1, 0], count: 3}}"),
                   "scene.yaml:9:12: 'a' has a column a_0.pressure, and so has probes[0], 'a_0'");
    assert_true(parse_text(PROBE("{name: a, line: {from: [0, 0, 0], to: [0, 1, 0], count: 3}}\n"
                                 "  - {name: a_3, point: {at: [0, 0, 0]}}\n"
                                 "  - {name: a_1, height: {at: [0, 0, 0]}}"),
                           NULL, &scene, &error));
    assert_refused(PROBE("{name: a, force: {on: floor}}"),
                   "scene.yaml:8:27: 'floor' feels no force; the scene has no solid: write box");
    assert_refused(
        PROBE("{name: a, force: {on: solid_1}}\nsolids: [{sphere: {centre: [0, 0.6, 0], radius: 0.2}}]"),
        "scene.yaml:8:27: 'solid_1' feels no force; write box, or solid_0 to solid_0");
    assert_true(parse_text(PROBE("{name: a, force: {}}"), NULL, &scene, &error));
    assert_string_equal(scene.probes.probe[0].on, "box");
    assert_refused(PROBE("{name: a, point: {at: [0.6, 0, 0]}}"),
                   "scene.yaml:8:27: [0.6, 0, 0] is outside the box");
    assert_refused(PROBE("{name: a, line: {from: [0, 0, 0], to: [0, 1.1, 0]}}"),
                   "scene.yaml:8:43: [0, 1.1, 0] is outside the box");
    assert_refused(PROBE("{name: a, plane: {at: [0.3, 0, 0], along: [0.5, 0, 0], across: [0, 0, 0.1]}}"),
                   "scene.yaml:8:22: [0.55, 0, -0.05] is outside the box");
    assert_refused(PROBE("{name: a, plane: {at: [0.3, 0, 0], along: [0, 0, 0], across: [0, 0, 0.1]}}"),
                   "scene.yaml:8:47: the side has no length");
    assert_refused(PROBE("{name: a, point: {at: [0, 0, 0]}, fields: [presure]}"),
                   "scene.yaml:8:48: probes[0].fields cannot have 'presure'; did you mean 'pressure'?");
    assert_refused(
        PROBE("{name: a, point: {at: [0, 0.6, 0]}}\nsolids: [{sphere: {centre: [0, 0.6, 0], radius: 0.2}}]"),
        "scene.yaml:8:27: [0, 0.6, 0] is inside a solid");
    assert_refused("box: {size: [1, 1]}\nparticles: {spacing: 0.1}\n"
                   "fluids: [{fill: [{block: {min: [-0.5, 0], max: [0.5, 0.5]}}]}]\n"
                   "probes: [{name: a, point: {at: [0, 0, 0.1]}}]\n",
                   "scene.yaml:4:32: the third number must be 0");
}

static void a_sensor_too_fine_is_told(void **state)
{
    (void)state;
    static const char text[] = PROBE("{name: a, point: {at: [0, 0, 0]}, size: 0.2}");
    Notes notes;
    assert_true(scene_parse("scene.yaml", text, strlen(text), NULL, &scene, &notes, &error));
    assert_true(notes_have(&notes,
                           "scene.yaml:8:39: 0.2 m holds too few particles of this spacing; four spacings, "
                           "0.4 m, are taken"));
    assert_true(probe_size(&scene.probes.probe[0], 0.1, 2.1) == 0.4);
    ProbeDef probe = scene.probes.probe[0];
    probe.size = 0;
    assert_true(probe_size(&probe, 0.1, 2.1) > 0.59);
    assert_true(probe_size(&probe, 0.1, 4) == 0.8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(are_read),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(a_sensor_too_fine_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
