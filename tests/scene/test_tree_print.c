/* A tree as YAML again is the same scene. */
#include "tests/sim/fixture.h"

#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"
#include "sim/gpu/gl.h"

#include <stdlib.h>
#include <string.h>

static Error error;

/* The tree of a text with a setting added (NULL: none), printed; freed by the caller. */
static char *printed(const char *path, const char *bytes, size_t size, const char *setting, const char *said)
{
    YamlTree tree;
    char *text = NULL;
    size_t length = 0;
    if (!tree_read(&tree, path, bytes, size, &error) || (setting && !tree_set(&tree, setting, said, &error)))
        fail_msg("%s", error.message);
    FILE *file = open_memstream(&text, &length);
    assert_non_null(file);
    tree_print(&tree, file);
    assert_int_equal(fclose(file), 0);
    tree_free(&tree);
    return text;
}

static char *resolved(const char *path, const char *bytes, size_t size)
{
    static Scene scene;
    if (!scene_parse(path, bytes, size, NULL, &scene, NULL, &error))
        fail_msg("%s\n%.*s", error.message, (int)size, bytes);
    return scene_print_text(&scene);
}

static void every_scene_is_the_same(void **state)
{
    (void)state;
    SceneNames names;
    scene_path_names(&names);
    assert_true(names.count > 15);
    for (int i = 0; i < names.count; i++) {
        char path[SCENE_PATH_SIZE];
        size_t size;
        assert_true(scene_path_find(names.name[i], path, &error));
        char *bytes = scene_file_read(path, &size, &error);
        char *again = printed(path, bytes, size, NULL, NULL);
        char *before = resolved(path, bytes, size), *after = resolved(path, again, strlen(again));
        assert_string_equal(before, after);
        free(bytes);
        free(again);
        free(before);
        free(after);
    }
}

static void check(const char *text, const char *setting, const char *said, const char *expected)
{
    char *found = printed("x.yaml", text, strlen(text), setting, said);
    assert_string_equal(found, expected);
    free(found);
}

static void values_that_need_quotes_have_them(void **state)
{
    (void)state;
    check("title: 'a: \"b\" # \\ c'\nbox: {size: [1, 2]}\n", NULL, NULL,
          "title: \"a: \\\"b\\\" # \\\\ c\"\nbox:\n  size: [1, 2]\n");
    check("title: \"- no list\"\n", NULL, NULL, "title: \"- no list\"\n");
    check("title: ' a '\nbox:\n", NULL, NULL, "title: \" a \"\nbox:\n");
    check("title: \"tab\\tline\\nend\"\n", NULL, NULL, "title: \"tab\\tline\\nend\"\n");
    check("title: ''\nmotion: []\nview: {}\n", NULL, NULL, "title: \"\"\nmotion: []\nview: {}\n");
    check("title: '7'\n", NULL, NULL, "title: \"7\"\n"); /* a text, and no number */
}

static void what_was_said_is_a_comment(void **state)
{
    (void)state;
    check("solver: {step: {dt: 1, substeps: 2}, method: pbf}\n", "solver.step.dt=0.5", "was 1\nor so",
          "solver:\n  step:\n    dt: 0.5  # was 1\n    substeps: 2\n  method: pbf\n");
    check("gravity: [0, 1, 0]\n", "gravity=[0, -5, 0]", NULL,
          "gravity: [0, -5, 0]  # --set gravity=[0, -5, 0]\n");
    check(
        "fluids:\n- {name: a, fill: [{block: {min: [0, 0], max: [1, 1]}}]}\n", "fluids[0].density=900",
        "heavy",
        "fluids:\n  - name: a\n    fill: [{block: {min: [0, 0], max: [1, 1]}}]\n    density: 900  # heavy\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scene_is_the_same),
        cmocka_unit_test(values_that_need_quotes_have_them),
        cmocka_unit_test(what_was_said_is_a_comment),
    };
    backends_add();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
