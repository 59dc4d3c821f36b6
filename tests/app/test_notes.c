/* Notes about a scene without errors. */
#include "app/scene/scene.h"

#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "app/window/model.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"
#include "tests/scene/scene_text.h"

static void a_line_is_said_once(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    for (int i = 0; i < 3; i++)
        notes_add(&notes, "the spacing is %d", 7);
    notes_add(&notes, "the spacing is %d", 8);
    notes_add(NULL, "nobody listens");
    assert_int_equal(notes.count, 2);
    assert_string_equal(notes.line[1], "the spacing is 8");
}

static void too_many_are_said_to_be_more(void **state)
{
    (void)state;
    Notes notes = {.count = 0};
    for (int i = 0; i < NOTES_MAX + 5; i++)
        notes_add(&notes, "line %d", i);
    assert_int_equal(notes.count, NOTES_MAX);
    assert_string_equal(notes.line[0], "line 0");
    assert_non_null(strstr(notes.line[NOTES_MAX - 1], "more"));
}

/* The place in the file where the key stands; the command line's words; the key's path alone. */
static void a_line_has_its_place(void **state)
{
    (void)state;
    static const char text[] = "solver:\n  sound_speed: 3\n";
    Notes notes = {.count = 0};
    Error error = {{0}};
    YamlTree tree;
    assert_true(tree_read(&tree, "s.yaml", text, strlen(text), &error));
    assert_true(tree_set(&tree, "gravity=[0, -1, 0]", NULL, &error));
    advise(&tree, "solver.sound_speed", &notes, "%d is low", 3);
    advise(&tree, "gravity", &notes, "weak");
    advise(&tree, "solver.step.dt", &notes, "long");
    advise(NULL, "solver.step.dt", &notes, "long");
    tree_free(&tree);
    assert_string_equal(notes.line[0], "s.yaml:2:3: 3 is low");
    assert_string_equal(notes.line[1], "--set gravity=[0, -1, 0]: weak");
    assert_string_equal(notes.line[2], "s.yaml: solver.step.dt: long");
    assert_string_equal(notes.line[3], "solver.step.dt: long");
}

/* A falling column, with a non-default setting for each owner of keys. */
static const char column[] = "box: {size: [1, 1]}\n"
                             "particles: {spacing: 0.1}\n"
                             "fluids: [{fill: [{block: {min: [-0.5, 0], max: [0, 0.8]}}]}]\n"
                             "solver: {negative_pressure: false}\n";

/* Keys with an owner: a value, the setting that brings the owner into use, and the message's words. */
static const struct {
    const char *setting, *owner, *need;
    bool bits; /* the solver on cpu reads it */
} owned[] = {
    {"solver.density_kernel=poly6", "solver.method=mueller", "solver.method: mueller", true},
    {"solver.numerical_viscosity=0.3", "solver.method=mueller", "solver.method: mueller", true},
    {"solver.kernel=wendland_c2", "solver.method=wcsph", "solver.method: wcsph", true},
    {"solver.artificial_viscosity=0.3", "solver.method=wcsph", "solver.method: wcsph", true},
    {"solver.viscosity_form=radial", "solver.method=wcsph", "solver.method: wcsph", false},
    {"solver.delta_sph=0.05", "solver.method=wcsph", "solver.method: wcsph", true},
    {"solver.shifting=0.2", "solver.method=wcsph", "solver.method: wcsph", true},
    {"solver.corrected_gradient=true", "solver.method=wcsph", "solver.method: wcsph", true},
    {"solver.tolerance=1e-8", "solver.method=dfsph", "solver.method: dfsph", true},
    {"solver.divergence_tolerance=1e-8", "solver.method=dfsph", "solver.method: dfsph", true},
    {"solver.coarse=true", "solver.method=dfsph", "solver.method: dfsph", false},
    {"solver.surface_lack=1", "solver.method=dfsph", "solver.method: dfsph", false},
    {"solver.rest_viscosity=0.3", "solver.method=dfsph", "solver.method: dfsph", true},
    {"solver.iterations=50", "solver.method=dfsph", "solver.method: dfsph", false},
    {"solver.compression=1e-6", "solver.method=pbf", "solver.method: pbf", true},
    {"solver.corrections=1", "solver.method=pbf", "solver.method: pbf", false},
    {"solver.viscosity_tolerance=0.1", "solver.viscosity=implicit", "solver.viscosity: implicit", false},
    {"solver.viscosity_iterations=9", "solver.viscosity=implicit", "solver.viscosity: implicit", false},
    {"solver.grid_layers=3", "solver.backend=fragment", "solver.backend: fragment", false},
    {"solver.lost_limit=3", "solver.backend=fragment", "solver.backend: fragment", false},
    {"solver.threads=3", "solver.backend=cpu", "solver.backend: cpu", false},
    {"solver.simd=baseline", "solver.backend=cpu", "solver.backend: cpu", false},
    {"solver.step.dt=0.001", "solver.step.mode=fixed", "solver.step.mode: fixed", true},
    {"solver.step.substeps=3", "solver.step.mode=fixed", "solver.step.mode: fixed", true},
    {"solver.step.number=0.1", "solver.step.mode=cfl", "solver.step.mode: cfl", true},
    {"solver.step.max_dt=0.0001", "solver.step.mode=cfl", "solver.step.mode: cfl", true},
    {"fluids[0].surface_tension=1", "solver.surface_tension=cohesion", "a model (solver.surface_tension)",
     true},
    {"fluids[0].contact_angle=60", "solver.surface_tension=curvature", "solver.surface_tension: curvature",
     false},
    {"view.opacity.range=[0, 1]", "view.opacity.by=speed", "a scalar (view.opacity.by)", false},
    {"view.opacity.curve=ends", "view.opacity.by=speed", "a scalar (view.opacity.by)", false},
    {"view.size.range=[0, 1]", "view.size.by=speed", "a scalar (view.size.by)", false},
    {"view.size.curve=ends", "view.size.by=speed", "a scalar (view.size.by)", false},
    {"view.splat.ior=2", "view.kind=splat", "view.kind: splat", false},
    {"view.volume.look=water", "view.kind=volume", "view.kind: volume", false},
    {"view.volume.surface=mesh", "view.kind=volume", "view.kind: volume", false},
    {"view.volume.opacity=0.5", "view={kind: volume, volume: {look: translucent}}", "view.kind: volume",
     false},
    {"view.volume.skin=0.2", "view={kind: volume, volume: {look: translucent}}", "view.kind: volume", false},
    {"view.volume.ramp_from=0.1", "view={kind: volume, volume: {look: translucent}}", "view.kind: volume",
     false},
    {"view.volume.ramp_to=0.9", "view={kind: volume, volume: {look: translucent}}", "view.kind: volume",
     false},
    {"view.volume.curve=fog", "view={kind: volume, volume: {look: translucent}}", "view.kind: volume", false},
    {"view.volume.ior=2", "view={kind: volume, volume: {look: water}}", "view.kind: volume", false},
    {"view.volume.attenuation=3", "view={kind: volume, volume: {look: water}}", "view.kind: volume", false},
    {"view.slice.cut=0.5", "view.kind=slice", "view.kind: slice", false},
    {"view.pbsr.repeat=5", "view.kind=pbsr", "view.kind: pbsr", false},
    {"view.glyphs.stride=2", "view.glyphs.show=true", "view.glyphs.show: true", false},
    {"view.streamlines.width=2", "view.streamlines.show=true", "view.streamlines.show: true", false},
    {"view.trails.length=2", "view.trails.show=true", "view.trails.show: true", false},
};
enum { OWNED = sizeof owned / sizeof *owned };

/* What is not the owner in question. */
static const char *rival(const char *owner)
{
    static const char *const rivals[][2] = {
        {"solver.method=mueller", "solver.method=wcsph"}, {"solver.method=wcsph", "solver.method=mueller"},
        {"solver.method=dfsph", "solver.method=mueller"}, {"solver.method=pbf", "solver.method=mueller"},
        {"solver.backend=cpu", "solver.backend=compute"}, {"solver.step.mode=fixed", "solver.step.mode=cfl"}};
    for (size_t i = 0; i < sizeof rivals / sizeof *rivals; i++)
        if (strcmp(owner, rivals[i][0]) == 0)
            return rivals[i][1];
    return "title=none";
}

static Notes notes_of(const char *text, const char *a, const char *b, ScenePurpose purpose, Scene *scene)
{
    Notes notes;
    Error error;
    SceneSettings settings = {.count = (a != NULL) + (b != NULL), .set = {a, b}, .purpose = purpose};
    if (!scene_parse("scene.yaml", text, strlen(text), &settings, scene, &notes, &error))
        fail_msg("%s", error.message);
    return notes;
}

static void a_key_without_its_owner_is_said(void **state)
{
    (void)state;
    static Scene scene;
    for (size_t i = 0; i < OWNED; i++) {
        char line[NOTE_SIZE];
        const char *set = owned[i].setting;
        snprintf(line, sizeof line, "--set %s: %.*s has no effect; it needs %s", set, (int)strcspn(set, "="),
                 set, owned[i].need);
        Notes notes = notes_of(column, rival(owned[i].owner), set, SCENE_FOR_ONE, &scene);
        if (!notes_have(&notes, line) || notes.lasting != 1)
            fail_msg("%s is not said: %s", line, notes.count ? notes.line[0] : "nothing");
        notes = notes_of(column, owned[i].owner, set, SCENE_FOR_ONE, &scene);
        if (notes.lasting > 0)
            fail_msg("%s with %s: %s", set, owned[i].owner, notes.line[0]);
    }
}

/* The outer owner is said first, then the inner one. In the window a live key may bring an owner into use. */
static void owners_are_within_owners(void **state)
{
    (void)state;
    static Scene scene;
    const Notes notes =
        notes_of(column, "view.kind=volume", "view.volume.opacity=0.5", SCENE_FOR_ONE, &scene);
    assert_int_equal(notes.count, 1);
    assert_string_equal(notes.line[0], "--set view.volume.opacity=0.5: view.volume.opacity has no effect; it "
                                       "needs view.volume.look: translucent");
    assert_false(scene_key_works(&scene, "view.volume.opacity"));
    assert_true(scene_key_works(&scene, "view.volume.look"));
    assert_int_equal(
        notes_of(column, "view.kind=volume", "view.volume.opacity=0.5", SCENE_FOR_WINDOW, &scene).count, 0);
    assert_false(scene_key_works(&scene, "view.volume.opacity")); /* at present */
}

/* A view without particles or without a translucent field has no use for curves. */
static void a_view_without_curves_is_said(void **state)
{
    (void)state;
    static Scene scene;
    const Notes slice = notes_of(column, "view.kind=slice", "view.size.by=speed", SCENE_FOR_ONE, &scene);
    assert_int_equal(slice.count, 1);
    assert_string_equal(
        slice.line[0],
        "--set view.size.by=speed: view.size.by has no effect; it needs view.kind: spheres or splat");
    assert_int_equal(notes_of(column, "view.kind=spheres", "view.size.by=speed", SCENE_FOR_ONE, &scene).count,
                     0);
    assert_int_equal(
        notes_of(column, "view.kind=splat", "view.opacity.by=speed", SCENE_FOR_ONE, &scene).count, 1);
    const Notes opaque = notes_of(column, "view.kind=volume", "view.opacity.by=speed", SCENE_FOR_ONE, &scene);
    assert_non_null(
        strstr(opaque.line[0], "view.opacity.by has no effect; it needs view.volume.look: translucent"));
}

/* Every row with an owner is in the list. */
static void every_owner_is_tried(void **state)
{
    (void)state;
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        bool tried = !keys[i].owner || strcmp(keys[i].path, "metrics") == 0;
        for (size_t k = 0; k < OWNED && !tried; k++) {
            char path[128];
            snprintf(path, sizeof path, "%.*s", (int)strcspn(owned[k].setting, "="), owned[k].setting);
            const Key *key = scene_key_find(path);
            tried = key == &keys[i] || (keys[i].type == KEY_MAPPING && key_owner(key) == keys[i].owner);
        }
        if (!tried)
            fail_msg("%s", keys[i].path);
    }
}

static uint64_t hash_with(const char *a, const char *b)
{
    static Scene scene;
    Error error;
    notes_of(column, a, b, SCENE_FOR_ONE, &scene);
    snprintf(scene.world.backend, sizeof scene.world.backend, "cpu");
    World *world = world_create(&scene.world, &error);
    assert_non_null(world);
    for (int i = 0; i < 4; i++)
        if (!world_substep(world, NULL, &error))
            fail_msg("%s %s: %s", a, b, error.message);
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    return hash;
}

/* The solver confirms the owners: keys change bits only with the owner in use. */
static void only_the_owner_reads_its_keys(void **state)
{
    (void)state;
    for (size_t i = 0; i < OWNED; i++) {
        const char *without = rival(owned[i].owner);
        if (strstr(owned[i].setting, "view.") || strstr(owned[i].setting, "threads"))
            continue;
        if (hash_with(without, NULL) != hash_with(without, owned[i].setting))
            fail_msg("%s is read with %s", owned[i].setting, without);
        if (owned[i].bits && hash_with(owned[i].owner, NULL) == hash_with(owned[i].owner, owned[i].setting))
            fail_msg("%s is not read with %s", owned[i].setting, owned[i].owner);
    }
}

/* A file serves many commands and views; the command line is for a single run. */
static void files_may_say_how_other_views_shall_be(void **state)
{
    (void)state;
    static Scene scene;
    char text[1024];
    snprintf(text, sizeof text, "%sview: {kind: spheres, splat: {ior: 2}}\nmetrics: [front]\n", column);
    assert_int_equal(notes_of(text, NULL, NULL, SCENE_FOR_ONE, &scene).count, 0);
    assert_int_equal(notes_of(text, NULL, NULL, SCENE_FOR_WINDOW, &scene).count, 0);
    assert_int_equal(notes_of(text, "metrics=[front]", NULL, SCENE_FOR_CHART, &scene).count, 0);
    assert_int_equal(
        notes_of(text, "view.volume.ior=2", "solver.grid_layers=1", SCENE_FOR_WINDOW, &scene).count, 0);
    const Notes run = notes_of(text, "metrics=[front]", NULL, SCENE_FOR_ONE, &scene);
    assert_int_equal(run.count, 1);
    assert_string_equal(
        run.line[0],
        "--set metrics=[front]: metrics has no effect; it needs slosh chart, which alone reads it");
    snprintf(text, sizeof text, "%.*sshifting: 0.2}\n", (int)(strstr(column, "negative") - column), column);
    const Notes file = notes_of(text, NULL, NULL, SCENE_FOR_WINDOW, &scene);
    assert_string_equal(file.line[0],
                        "scene.yaml:4:10: solver.shifting has no effect; it needs solver.method: wcsph");
    const Notes window = notes_of(column, "metrics=[front]", NULL, SCENE_FOR_WINDOW, &scene);
    assert_int_equal(window.count, 1);
}

/* In the window the lines stay while different keys change; an ineffective change in the window is noted
   too. */
static void the_panel_keeps_the_lines(void **state)
{
    (void)state;
    static PlayScene open;
    Notes fresh = {.count = 0};
    open.notes = notes_of(column, "solver.shifting=0.2", NULL, SCENE_FOR_WINDOW, &open.scene);
    for (int i = 0; i < 2; i++)
        play_scene_advise(&open, "solver.step.max_dt", &fresh);
    play_scene_advise(&open, "gravity", &fresh);
    assert_int_equal(open.notes.lasting, 2);
    assert_true(strncmp(open.notes.line[0], "--set solver.shifting=0.2: ", 27) == 0);
    assert_string_equal(open.notes.line[1],
                        "solver.step.max_dt has no effect; it needs solver.step.mode: cfl");
    assert_int_equal(fresh.count, 1);
}

static bool is_told(const Notes *notes, const char *part)
{
    for (int i = 0; i < notes->count; i++)
        if (strstr(notes->line[i], part))
            return true;
    return false;
}

/* A block not divisible by the spacing, a block of two layers, a ball. */
static void what_fills_became_is_told(void **state)
{
    (void)state;
    static Scene scene;
    Notes notes;
    Error error;
    static const char text[] = "box: {size: [1, 1, 1]}\n"
                               "particles:\n"
                               "  spacing: 0.06\n"
                               "fluids:\n"
                               "  - fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.5, 0.5]}}]\n"
                               "  - name: drop\n"
                               "    fill: [{ball: {centre: [0, 0.8, 0], radius: 0.15}}]\n"
                               "  - fill: [{block: {min: [-0.5, 0.6, -0.5], max: [-0.3, 0.72, -0.3]}}]\n";
    assert_true(scene_parse("s.yaml", text, strlen(text), NULL, &scene, &notes, &error));
    assert_true(is_told(&notes, "s.yaml:3:3: 0.06 m does not divide the fills into whole layers; 0.0"));
    assert_true(is_told(&notes, "s.yaml:7:5: 'drop' has "));
    assert_true(is_told(&notes, "s.yaml:8:13: the block is "));
    assert_false(is_told(&notes, "s.yaml:5:5: 'fluid 1' has")); /* correct mass */
    SceneSettings fits = {.count = 1, .set = {"particles.spacing=0.02"}};
    assert_true(scene_parse("s.yaml", text, strlen(text), &fits, &scene, &notes, &error));
    assert_false(is_told(&notes, "whole layers"));
    assert_false(is_told(&notes, "the block is "));
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_is_said_once),
        cmocka_unit_test(too_many_are_said_to_be_more),
        cmocka_unit_test(a_line_has_its_place),
        cmocka_unit_test(a_key_without_its_owner_is_said),
        cmocka_unit_test(every_owner_is_tried),
        cmocka_unit_test(owners_are_within_owners),
        cmocka_unit_test(a_view_without_curves_is_said),
        cmocka_unit_test(only_the_owner_reads_its_keys),
        cmocka_unit_test(files_may_say_how_other_views_shall_be),
        cmocka_unit_test(the_panel_keeps_the_lines),
        cmocka_unit_test(what_fills_became_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
