/* Settings inserted in a text: comments and layout stay, and the result is read correctly. */
#include "app/scene/yaml/yaml.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char TEXT[] = "# head\n"
                           "title: \xc3\xa9t\xc3\xa9  # summer\n"
                           "box: {size: [1, 2], tilt: 3} # m\n"
                           "\n"
                           "fluids:\n"
                           "  # first\n"
                           "  - name: a # its name\n"
                           "    colour: [1,\n"
                           "      0, 0]\n"
                           "  - {name: \"b, c\"}\n"
                           "# before the solver\n"
                           "solver:\n"
                           "  step:\n"
                           "    dt: 0.1   # s\n"
                           "last: [{a: 1}] # end\n";

/* Of TEXT with `setting`: what stands in place of `old`. */
static void check(const char *setting, const char *old, const char *now, bool loses)
{
    Error error = {{0}};
    bool lost = false;
    char wanted[1024];
    const char *at = strstr(TEXT, old);
    assert_non_null(at);
    snprintf(wanted, sizeof wanted, "%.*s%s%s", (int)(at - TEXT), TEXT, now, at + strlen(old));
    char *text = yaml_patch("a.yaml", TEXT, strlen(TEXT), setting, &lost, &error);
    if (!text)
        fail_msg("%s: %s", setting, error.message);
    assert_string_equal(text, wanted);
    assert_int_equal(lost, loses);
    free(text);
}

static void test_in_place(void **state)
{
    (void)state;
    check("title=x", "\xc3\xa9t\xc3\xa9", "x", false);
    check("box.size=[3, 4, 5]", "[1, 2]", "[3, 4, 5]", false);
    check("box.tilt=4", "tilt: 3", "tilt: 4", false);
    check("box.deep.er=4", "{size", "{deep: {er: 4}, size", false);
    check("fluids[0].name=z", "name: a", "name: z", false);
    check("fluids[0].colour=[0, 1, 0]", "[1,\n      0, 0]", "[0, 1, 0]", false);
    check("fluids[0].density=7", "- name: a", "- density: 7\n    name: a", false);
    check("fluids[1].name=\"d: e\"", "\"b, c\"", "\"d: e\"", false);
    check("solver.step.dt=0.2", "0.1", "0.2", false);
    check("solver.step.mode=cfl", "    dt", "    mode: cfl\n    dt", false);
    check("solver.method=pbf", "  step:", "  method: pbf\n  step:", false);
    check("gravity=[0, 1, 0]", "# end\n", "# end\ngravity: [0, 1, 0]\n", false);
    check("view.camera.from=[1, 1, 1]", "# end\n", "# end\nview: {camera: {from: [1, 1, 1]}}\n", false);
}

/* A setting without a fitting place costs only the comments of the block. */
static void test_block(void **state)
{
    (void)state;
    check("last[1].b=2", "last: [{a: 1}] # end\n", "last:\n  - {a: 1}\n  - {b: 2}\n", true);
    check("fluids=[{name: z}]",
          "fluids:\n  # first\n  - name: a # its name\n    colour: [1,\n      0, 0]\n  - {name: \"b, c\"}\n",
          "fluids:\n  - {name: z}\n", true);
    check("solver.step={}", "solver:\n  step:\n    dt: 0.1   # s\n", "solver:\n  step: {}\n", true);
}

static void test_wrong(void **state)
{
    (void)state;
    static const char *const texts[] = {"a: [", "a: 1\na: 2\n", "", "a: 1"};
    static const char *const settings[] = {"a=1", "a=1", "a=1", "a[3]=1"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        Error error = {{0}};
        assert_null(yaml_patch("a.yaml", texts[i], strlen(texts[i]), settings[i], NULL, &error));
        assert_true(*error.message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_in_place), cmocka_unit_test(test_block),
                                       cmocka_unit_test(test_wrong)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
