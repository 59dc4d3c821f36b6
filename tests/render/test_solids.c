/* Solids: depth against rays in double, and occlusion. */
#include "tests/lists.h"
#include "tests/render/solids_fixture.h"

#include "render/frame/passes.h"

/* How much farther or nearer a ray beside a pixel's goes, m. */
static double slope_at(const SolidsScene *scene, const Camera *camera, const double place[2], double wanted)
{
    double most = 0;
    for (int k = 0; snaps() && k < SNAP_PLACES; k++) {
        double by[2], eye[3], ray[3];
        snap_place(k, by);
        const double beside[2] = {place[0] + 2 * by[0] / WIDTH, place[1] + 2 * by[1] / HEIGHT};
        make_ray(scene, camera, beside, eye, ray);
        most = fmax(most, fabs(trace(scene, eye, ray) - wanted));
    }
    return most;
}

/* Every pixel but those at outlines and steep places: hit or miss, and the distance within `tolerance` (m).
   Returns the number of pixels hit. */
static int compare(SolidsScene *scene, double tolerance)
{
    static float depth[PIXELS];
    Camera camera;
    int hits = 0;
    make_camera(scene, &camera);
    draw_depth(scene, depth);
    for (int i = 0; i < PIXELS; i++) {
        double place[2], eye[3], ray[3];
        pixel_place(i, place);
        make_ray(scene, &camera, place, eye, ray);
        const double wanted = trace(scene, eye, ray), seen = depth[i] > 0 ? camera.near_plane / depth[i] : 0;
        hits += seen > 0;
        if (!is_rough(scene, &camera, place, wanted) &&
            fabs(seen - wanted) > tolerance + slope_at(scene, &camera, place, wanted))
            fail_msg("pixel %d %d: distance %.6f, by tracing %.6f", i % WIDTH, i / WIDTH, seen, wanted);
    }
    free(scene->particles);
    return hits;
}

static void test_every_kind_is_where_it_is(void **state)
{
    (void)state; /* chords leave arcs by 3e-4 m, lengthened by slanting rays */
    for (int kind = 0; kind < SOLID_KIND_COUNT; kind++) {
        SolidsScene scene = scene_create();
        SolidDef *solid = scene_add(&scene, (SolidKind)kind, 0.2, 0.6, -0.1);
        solid->axis[0] = 0.5, solid->axis[2] = 0.6;
        solid->angle_deg = 50;
        scene.state.box =
            (BoxState){.position = {-0.2, 0.1, 0.1}, .orientation = {0.2, 0.1, -0.1, sqrt(0.94)}};
        assert_true(compare(&scene, kind == SOLID_BOX ? 2e-5 : 2.5e-3) > 600);
    }
}

/* At a corner of the box, most of the solid is outside: the rest ends at the box's sides, seen from above,
   from behind and from below. Floating solids and meshes stay whole. */
static void test_what_sticks_out_is_cut_off(void **state)
{
    (void)state;
    static const double eyes[][3] = {{2.2, 1.2, 3}, {-2, 1.6, -2.4}, {1.6, -1.2, 2.6}};
    for (int i = 0; i < SOLID_KIND_COUNT * 3; i++) {
        const SolidKind kind = (SolidKind)(i / 3);
        SolidsScene scene = scene_create();
        SolidDef *solid = scene_add(&scene, kind, 0.95, 0.07, 0.43);
        solid->axis[0] = 0.5, solid->axis[2] = 0.6;
        solid->angle_deg = 50;
        solid->thickness = 0.12;
        solid->density = kind == SOLID_SPHERE && i % 3 == 2 ? 500 : 0;
        scene.cut = !solid_floats(solid) && kind != SOLID_MESH;
        scene.def.camera = (CameraDef){{eyes[i % 3][0], eyes[i % 3][1], eyes[i % 3][2]}, {0.9, 0.1, 0.4}, 20};
        scene.state.box =
            (BoxState){.position = {-0.1, 0.1, 0.1}, .orientation = {0.1, 0.1, -0.1, sqrt(0.97)}};
        assert_true(compare(&scene, kind == SOLID_BOX ? 1e-4 : 4e-3) > 200);
    }
}

/* Against the formula: a ball's depth at every pixel away from the rim. Chords leave the arc by 3e-4 m
   along and across the circles. */
static void test_sphere_by_formula(void **state)
{
    (void)state;
    static float depth[PIXELS];
    SolidsScene scene = scene_create();
    const SolidDef *solid = scene_add(&scene, SOLID_SPHERE, 0, 0.5, 0);
    Camera camera;
    int hits = 0;
    make_camera(&scene, &camera);
    draw_depth(&scene, depth);
    for (int i = 0; i < PIXELS; i++) {
        double place[2], c[3], ray[3], dd = 0, dc = 0, cc = 0;
        pixel_place(i, place);
        make_ray(&scene, &camera, place, c, ray);
        for (int k = 0; k < 3; k++)
            dd += ray[k] * ray[k], dc -= ray[k] * c[k], cc += c[k] * c[k];
        const double root = dc * dc - dd * (cc - solid->radius * solid->radius);
        if (fabs(root) < 0.01 * dd * solid->radius * solid->radius)
            continue;
        const double wanted = root > 0 ? (dc - sqrt(root)) / dd : 0,
                     seen = depth[i] > 0 ? camera.near_plane / depth[i] : 0;
        hits += wanted > 0;
        const double facing = sqrt(fabs(root) / dd) / solid->radius; /* cosine between ray and normal */
        if (fabs(wanted - seen) > 7e-4 / facing)
            fail_msg("pixel %d %d: distance %.6f, formula %.6f", i % WIDTH, i / WIDTH, seen, wanted);
    }
    assert_true(hits > 500);
    free(scene.particles);
}

static void test_moves_with_time(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        SolidsScene scene = scene_create();
        SolidDef *solid = scene_add(&scene, SOLID_BOX, -0.3, 0.5, 0);
        add_solid_motion(solid,
                         (Motion){MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.5, .frequency = 0.2});
        add_solid_motion(solid, (Motion){MOTION_SPIN, .axis = {0.2, 0.3, 1}, .rate = 1});
        scene.state.time = 0.6 * i;
        assert_true(compare(&scene, 2e-5) > 300);
    }
}

static void shift(SolidsScene *scene, double z)
{
    scene->particles->count = 0;
    particles_add(scene->particles, 0, 0.5, z, 2, 0);
}

/* The middle pixel: whether it is as red as the solids. */
static bool solid_in_the_middle(SolidsScene *scene)
{
    static uint8_t rgb[3 * PIXELS];
    draw_rgb(scene, true, rgb);
    const uint8_t *at = rgb + 3 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
    return at[0] > 200 && at[1] < 120 && at[2] < 120;
}

/* Looked at along z: a particle before, beyond and half in a block. The near eye has not the whole box in
   view, for which quads are drawn; where all is, points on a software driver. */
static void test_the_nearer_is_seen(void **state)
{
    (void)state;
    static const double distances[] = {0.9, 6};
    for (int i = 0; i < 2; i++) {
        SolidsScene scene = scene_create();
        SolidDef *solid = scene_add(&scene, SOLID_BOX, 0, 0.5, 0);
        solid->size[2] = 0.1;
        scene.def.camera = (CameraDef){{0, 0.5, distances[i]}, {0, 0.5, 0}, 40};
        scene.def.radius = 0.5; /* 0.05 m */
        shift(&scene, 0.2);
        assert_false(solid_in_the_middle(&scene));
        shift(&scene, -0.2);
        assert_true(solid_in_the_middle(&scene));
        shift(&scene, 0.02); /* that much out of the face */
        assert_false(solid_in_the_middle(&scene));
        shift(&scene, -0.02);
        assert_true(solid_in_the_middle(&scene));
        free(scene.particles);
    }
}

/* Of two solids the nearer, whichever comes first in the list. */
static void test_the_nearer_solid_is_seen(void **state)
{
    (void)state;
    for (int first = 0; first < 2; first++) {
        SolidsScene scene = scene_create();
        scene.def.camera = (CameraDef){{0, 0.5, 3}, {0, 0.5, 0}, 40};
        scene_add(&scene, SOLID_BOX, 0, 0.5, 0.3);
        scene_add(&scene, SOLID_SPHERE, 0, 0.5, -0.3);
        memcpy(scene.world.solids[1].color, (float[]){0, 1, 0}, sizeof(float[3]));
        if (first == 1) {
            scene.world.solids[2] = scene.world.solids[0];
            memmove(scene.world.solids, scene.world.solids + 1, 2 * sizeof(SolidDef));
        }
        assert_true(solid_in_the_middle(&scene));
        free(scene.particles);
    }
}

/* Both ways to draw particles leave a solid unchanged where no particle is in front. */
static void test_hidden_particles_leave_no_trace(void **state)
{
    (void)state;
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    static const double distances[] = {0.9, 6};
    for (int i = 0; i < 2; i++) {
        SolidsScene scene = scene_create();
        memcpy(scene_add(&scene, SOLID_BOX, 0, 0.5, 0)->size, (double[]){1, 0.7, 0.1}, sizeof(double[3]));
        scene.def.camera = (CameraDef){{0, 0.5, distances[i]}, {0, 0.5, 0}, 40};
        draw_rgb(&scene, false, without);
        for (int k = 0; k < 9; k++)
            particles_add(scene.particles, 0.3 * sin(k), 0.5 + 0.2 * cos(3 * k), -0.2, 1, 0);
        draw_rgb(&scene, false, with);
        assert_memory_equal(with, without, sizeof with);
        assert_true(solid_in_the_middle(&scene));
        free(scene.particles);
    }
}

/* Inside and outside are visible, and the contents. */
static void test_bowl_from_inside(void **state)
{
    (void)state;
    static float depth[PIXELS];
    SolidsScene scene = scene_create();
    Camera camera;
    scene_add(&scene, SOLID_BOWL, 0, 0.5, 0);
    scene.def.camera = (CameraDef){{0, 3, 0.01}, {0, 0.5, 0}, 20};
    make_camera(&scene, &camera);
    draw_depth(&scene, depth);
    const int middle = HEIGHT / 2 * WIDTH + WIDTH / 2;
    assert_true(fabs(camera.near_plane / depth[middle] - 2.75) < 0.01); /* the bottom of its inside */
    particles_add(scene.particles, 0, 0.3, 0, 1, 0);
    draw_depth(&scene, depth);
    assert_true(fabs(camera.near_plane / depth[middle] - 2.65) < 0.01); /* the particle inside */
    scene.def.camera = (CameraDef){{0, -2, 0.01}, {0, 0.5, 0}, 20};
    draw_depth(&scene, depth);
    assert_true(fabs(camera.near_plane / depth[middle] - 2.2) < 0.01); /* the bottom of its outside */
    free(scene.particles);
}

/* In a flat box all solids are as deep as the box: the face towards the eye is the box's face. */
static void test_flat_box(void **state)
{
    (void)state;
    static float depth[PIXELS];
    static const SolidKind kinds[] = {SOLID_SPHERE, SOLID_BOX, SOLID_BOWL};
    for (int i = 0; i < 3; i++) {
        SolidsScene scene = scene_create();
        SolidDef *solid = scene_add(&scene, kinds[i], 0, 0.5, 0);
        solid->axis[0] = kinds[i] == SOLID_BOWL ? 1 : 0, solid->axis[1] = 0;
        solid->axis[2] = kinds[i] == SOLID_BOWL ? 0 : 1;
        solid->angle_deg = 30;
        scene.state.box_size[2] = scene.state.spacing;
        scene.def.camera = (CameraDef){{0, 0.5, 4}, {0, 0.5, 0}, 30};
        Camera camera;
        make_camera(&scene, &camera);
        draw_depth(&scene, depth);
        for (int k = 0; k < PIXELS; k++) {
            double place[2], x[3];
            pixel_place(k, place);
            const double at[3] = {place[0] * camera.tangent[0] * 3.95,
                                  0.5 + place[1] * camera.tangent[1] * 3.95, 0};
            into_solid(&scene, at, true, x);
            const double distance = solid_distance(solid, 2, x);
            if (distance < -5e-3 && fabs(camera.near_plane / depth[k] - 3.95) > 1e-4)
                fail_msg("kind %d, pixel %d %d: distance %g", i, k % WIDTH, k / WIDTH,
                         camera.near_plane / depth[k]);
            if (distance > 0.03 && depth[k] > 0) /* more than the side walls that perspective shows */
                fail_msg("kind %d, pixel %d %d is hit", i, k % WIDTH, k / WIDTH);
        }
        free(scene.particles);
    }
}

/* Triangles face along the normals, and the sum of areas is zero: culling of back faces leaves no hole. */
static void assert_closed(const SolidMesh *mesh)
{
    double area[3] = {0}, volume = 0;
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        const SolidVertex *v[3];
        double e[2][3], n[3], facing = 0;
        for (int k = 0; k < 3; k++)
            v[k] = &mesh->vertices[mesh->indices[i + (size_t)k]];
        for (int k = 0; k < 3; k++) {
            e[0][k] = v[1]->position[k] - v[0]->position[k];
            e[1][k] = v[2]->position[k] - v[0]->position[k];
        }
        cross_product(e[0], e[1], n);
        for (int k = 0; k < 3; k++) {
            facing += n[k] * (v[0]->normal[k] + v[1]->normal[k] + v[2]->normal[k]);
            area[k] += n[k];
            volume += n[k] * v[0]->position[k] / 6;
        }
        assert_true(facing >= -1e-9);
    }
    for (int k = 0; k < 3; k++)
        assert_true(fabs(area[k]) < 1e-5);
    assert_true(volume > 1e-3);
}

static void test_meshes_are_closed(void **state)
{
    (void)state;
    for (int kind = 0; kind < SOLID_KIND_COUNT; kind++)
        for (int flat = 0; flat < 2; flat++) {
            SolidsScene scene = scene_create();
            SolidMesh mesh = {0};
            assert_true(
                solid_mesh_add(&mesh, scene_add(&scene, (SolidKind)kind, 0, 0, 0), flat ? 0.1 : 0, 3));
            assert_closed(&mesh);
            assert_int_equal(mesh.vertices[mesh.vertex_count - 1].solid, 3);
            solid_mesh_destroy(&mesh);
            free(scene.particles);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_every_kind_is_where_it_is, no_gl_errors),
        cmocka_unit_test_teardown(test_what_sticks_out_is_cut_off, no_gl_errors),
        cmocka_unit_test_teardown(test_sphere_by_formula, no_gl_errors),
        cmocka_unit_test_teardown(test_moves_with_time, no_gl_errors),
        cmocka_unit_test_teardown(test_the_nearer_is_seen, no_gl_errors),
        cmocka_unit_test_teardown(test_the_nearer_solid_is_seen, no_gl_errors),
        cmocka_unit_test_teardown(test_hidden_particles_leave_no_trace, no_gl_errors),
        cmocka_unit_test_teardown(test_bowl_from_inside, no_gl_errors),
        cmocka_unit_test_teardown(test_flat_box, no_gl_errors),
        cmocka_unit_test(test_meshes_are_closed),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
