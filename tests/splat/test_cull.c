/* Culling of hidden particles before the view splat draws: it leaves out many, and changes no pixel. */
#include "tests/splat/splat_fixture.h"

/* A block of fluid, not quite a lattice, with drops above it. */
static SplatScene fluid(double fov_deg)
{
    SplatScene scene = splat_scene((double[]){1.5, 1.6, 2.5}, (double[]){-0.3, 0.3, 0}, fov_deg, 0.05);
    for (int i = 0; i < 20 * 14 * 16; i++) {
        const int x = i % 20, y = i / 20 % 14, z = i / 280;
        particles_add(scene.particles, -0.9 + 0.05 * x + 0.01 * sin(7.1 * i),
                      0.02 + 0.05 * y + 0.01 * sin(3.7 * i), -0.4 + 0.05 * z + 0.01 * sin(5.3 * i),
                      1 + sin(i), (unsigned)i % 2);
    }
    for (int i = 0; i < 40; i++)
        particles_add(scene.particles, 0.9 * sin(12.9 * i), 0.8 + 0.1 * sin(78.2 * i), 0.4 * sin(37.7 * i), 1,
                      1);
    return scene;
}

static bool same(const SplatPixel *a, const SplatPixel *b)
{
    bool equal = a->depth == b->depth && a->weight == b->weight;
    for (int k = 0; k < 3; k++)
        equal = equal && a->color[k] == b->color[k] && a->normal[k] == b->normal[k];
    return equal;
}

static void compare(SplatScene *scene, const char *what)
{
    splat_def(&scene->def)->cull = true;
    SplatPixel *culled = splat_drawn(scene);
    splat_def(&scene->def)->cull = false;
    SplatPixel *all = splat_drawn(scene);
    for (int i = 0; i < scene->width * scene->height; i++)
        if (!same(&culled[i], &all[i]))
            fail_msg("%s: pixel %d %d: depth %.9g, weight %.9g; with all particles %.9g, %.9g", what,
                     i % scene->width, i / scene->width, culled[i].depth, culled[i].weight, all[i].depth,
                     all[i].weight);
    free(culled);
    free(all);
}

static void it_changes_no_pixel(void **state)
{
    (void)state; /* from afar, near, with spheres smaller than a pixel, and through a wide lens */
    static const double fovs[] = {30, 8, 170, 100}, all_eps[] = {0.1, 1.5};
    for (int i = 0; i < 4; i++)
        for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_ELLIPSOID; shape++)
            for (int k = 0; k < 2; k++) {
                SplatScene scene = fluid(fovs[i]);
                char what[64];
                splat_def(&scene.def)->shape = (SplatShape)shape, splat_def(&scene.def)->eps = all_eps[k];
                splat_def(&scene.def)->drops = k == 1;
                snprintf(what, sizeof what, "%g degrees, %s, eps %g", fovs[i], splat_shape_names[shape],
                         all_eps[k]);
                compare(&scene, what);
                free(scene.particles);
            }
}

static void nor_from_within_the_fluid(void **state)
{
    (void)state;
    SplatScene scene = fluid(60);
    memcpy(scene.def.camera.from, (double[]){-0.41, 0.31, 0.02}, sizeof scene.def.camera.from);
    memcpy(scene.def.camera.to, (double[]){-0.2, 0.4, 0.4}, sizeof scene.def.camera.to);
    compare(&scene, "eye in the fluid");
    memcpy(scene.def.camera.from, (double[]){0.2, 0.3, 0.1}, sizeof scene.def.camera.from);
    memcpy(scene.def.camera.to, (double[]){-1, 0.3, 0}, sizeof scene.def.camera.to);
    compare(&scene, "eye in the box, beside the fluid");
    free(scene.particles);
}

/* Thin ellipsoids on edge, with gaps that balls of the same volume would close. */
static void nor_behind_gaps_between_sheets(void **state)
{
    (void)state;
    SplatScene scene = splat_scene((double[]){0, 0.5, 2.5}, (double[]){0, 0.5, 0}, 8, 0.05);
    scene.state.support_radius = 0.055; /* less than from sheet to sheet */
    for (int i = 0; i < 16 * 4 * 9; i++) {
        const int column = i % 16, row = i / 16 % 4, sheet = i / 64;
        particles_add(scene.particles, 0.05 * (column - 7.5) + 0.012 * row, 0.5 + 0.06 * (sheet - 4),
                      0.05 * (row - 1.5), 1, 0);
    }
    for (int i = 0; i < 150; i++)
        particles_add(scene.particles, 0.3 * sin(12.9 * i), 0.5 + 0.25 * sin(78.2 * i),
                      -0.45 + 0.1 * sin(37.7 * i), 1, 1);
    splat_def(&scene.def)->shape = SPLAT_ELLIPSOID, splat_def(&scene.def)->eps = 0.1;
    compare(&scene, "sheets");
    free(scene.particles);
}

/* What it leaves out lies farther than eps behind the surface everywhere, and is behind more than a third of
   the picture of the fluid. */
static void it_leaves_out_what_is_hidden(void **state)
{
    (void)state;
    SplatScene scene = fluid(30);
    scene.width = 320, scene.height = 240;
    SplatPixel *seen = splat_drawn(&scene);
    splat_def(&scene.def)->show = SPLAT_CULLED;
    SplatPixel *hidden = splat_drawn(&scene);
    const double eps = splat_def(&scene.def)->eps * scene.frame.radii.drawn;
    int covered = 0, over = 0;
    for (int i = 0; i < scene.width * scene.height; i++) {
        covered += seen[i].depth < 1e29;
        over += hidden[i].depth < 1e29;
        if (hidden[i].depth < 1e29 && !(hidden[i].depth > seen[i].depth + eps))
            fail_msg("pixel %d %d: %g m is hidden by %g m", i % scene.width, i / scene.width, hidden[i].depth,
                     seen[i].depth);
    }
    if (3 * over < covered)
        fail_msg("hidden particles behind %d of %d pixels", over, covered);
    free(seen);
    free(hidden);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(it_changes_no_pixel, no_gl_errors),
        cmocka_unit_test_teardown(nor_from_within_the_fluid, no_gl_errors),
        cmocka_unit_test_teardown(nor_behind_gaps_between_sheets, no_gl_errors),
        cmocka_unit_test_teardown(it_leaves_out_what_is_hidden, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
