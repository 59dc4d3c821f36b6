/* Rays through known fields, and meshes of known fields: intersections with a ball, optical depth, triangles,
   occlusion by and of solids. */
#include "tests/render/raycast_fixture.h"

/* In a box of 1 m: 64 cells along a side, whose first corner is the box's. */
static const VolumeGrid whole = {{64, 64, 64}, {-0.5, 0, -0.5}, 1.0 / 64};

typedef struct Ball {
    double centre[3], radius, rim; /* m; the field falls from 1 to 0 within a rim */
} Ball;

static const Ball ball = {{0.05, 0.48, -0.03}, 0.3, 0.125};

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static double ball_at(const double at[3], const void *context)
{
    const Ball *own = context;
    const double x = fmax(0, fmin(0.5 + (own->radius - distance(at, own->centre)) / own->rim, 1));
    return x * x * (3 - 2 * x); /* without kinks, of which cells would cut the corners */
}

static RayScene ball_scene(const double from[3], const double to[3], double fov_deg)
{
    RayScene scene = ray_scene(from, to, fov_deg);
    ray_volume(&scene, &whole, ball_at, &ball);
    return scene;
}

static void scene_end(RayScene *scene)
{
    glDeleteTextures(1, &scene->volume.field);
}

/* The ball's field as a texture has it: linear between the middles of cells. */
static double sampled_at(const double at[3])
{
    double share[3], corner[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        const double cells = (at[k] - whole.corner[k]) / whole.cell - 0.5;
        corner[k] = floor(cells);
        share[k] = cells - corner[k];
    }
    for (int n = 0; n < 8; n++) {
        double weight = 1, place[3];
        for (int k = 0; k < 3; k++) {
            const int up = n >> k & 1;
            weight *= up ? share[k] : 1 - share[k];
            place[k] = whole.corner[k] + (corner[k] + up + 0.5) * whole.cell;
        }
        sum += weight * ball_at(place, &ball);
    }
    return sum;
}

/* Along a ray, m, by many steps: of the field; or of a sampled curve of the field, 0 outside the fluid. */
static double integral_of(const double from[3], const double to[3], double end, const ControlPoints *curve)
{
    const int steps = curve ? 2000 : 4000;
    double sum = 0, slant = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    for (int i = 0; i < steps; i++) {
        const double t = (i + 0.5) * end / steps;
        const double at[3] = {from[0] + t * to[0], from[1] + t * to[1], from[2] + t * to[2]};
        const double field = curve ? sampled_at(at) : ball_at(at, &ball);
        sum += !curve ? field : field > 0 ? control_points_at(curve, field) : 0;
    }
    return sum * slant * end / steps;
}

/* Hardware weighs texels by 8 bits. */
static double weights(void)
{
    return gl_renderer_is_software() ? 1 : 3;
}

/* The surface is the ball's, with the ball's normal. Straight cells on a round ball lose 1.3 % of a
   cell's width, and flat triangles 5 %; a facet's normal is off by a cell's diagonal. Returns the number of
   compared pixels. */
static int compare_sphere(RayScene *scene, bool normals)
{
    static const double depths[] = {0.03, 0.06, 0.06}, slopes[] = {0.02, 0.02, 0.08};
    const VolumeSurface surface = volume_def(&scene->def)->surface;
    int compared = 0;
    volume_def(&scene->def)->show = normals ? VOLUME_NORMALS : VOLUME_SHADED;
    RayPixel *pixels = ray_drawn(scene, true);
    for (int i = 0; i < scene->width * scene->height; i++) {
        double from[3], to[3], t[2], cosine = 0;
        ray_of(scene, i % scene->width, i / scene->width, from, to);
        const bool meets = ray_meets_sphere(from, to, ball.centre, ball.radius, t, &cosine);
        if (cosine > 0 && cosine < 0.2)
            continue;
        if (meets && t[0] > 0 ? !(pixels[i].depth > 0) : pixels[i].depth > 0)
            fail_msg("pixel %d %d: depth %g, but the sphere is at %g", i % scene->width, i / scene->width,
                     pixels[i].depth, meets ? t[0] : -1);
        if (!meets || t[0] <= 0)
            continue;
        const double found = scene->frame.camera.near_plane / pixels[i].depth;
        if (fabs(found - t[0]) > weights() * depths[surface] * whole.cell / cosine)
            fail_msg("pixel %d %d: %g m, the sphere is at %g m", i % scene->width, i / scene->width, found,
                     t[0]);
        float outward[3], in_eye[3], to_eye[16];
        matrix_multiply(scene->frame.camera.view, scene->frame.box_to_world, to_eye);
        for (int k = 0; k < 3; k++)
            outward[k] = (float)((from[k] + t[0] * to[k] - ball.centre[k]) / ball.radius);
        for (int k = 0; k < 3; k++)
            in_eye[k] = to_eye[k] * outward[0] + to_eye[4 + k] * outward[1] + to_eye[8 + k] * outward[2];
        for (int k = 0; normals && k < 3; k++)
            if (fabsf(2 * pixels[i].color[k] - 1 - in_eye[k]) > (float)(weights() * slopes[surface]))
                fail_msg("pixel %d %d, axis %d: normal %g, the sphere's is %g", i % scene->width,
                         i / scene->width, k, 2 * pixels[i].color[k] - 1, in_eye[k]);
        compared++;
    }
    free(pixels);
    return compared;
}

static void the_surface_of_a_ball(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, (double[]){0.05, 0.48, 0}, 30);
    for (int skip = 0; skip < 2; skip++)
        for (int big = 0; big < 2; big++) {
            volume_def(&scene.def)->raycast.skip = skip, volume_def(&scene.def)->raycast.step = big ? 2 : 0.5;
            assert_true(compare_sphere(&scene, false) > 2000);
        }
    assert_true(compare_sphere(&scene, true) > 2000);
    scene_end(&scene);
}

/* The volume goes with the box. */
static void the_surface_in_a_tilted_box(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){1.5, 1.1, 1.4}, (double[]){0.3, 0.6, 0}, 40);
    scene.state.box = (BoxState){.position = {0.3, 0.1, -0.1}, .orientation = {0.1, 0.3, -0.2, sqrt(0.86)}};
    assert_true(compare_sphere(&scene, false) > 1000);
    assert_true(compare_sphere(&scene, true) > 1000);
    scene_end(&scene);
}

/* Rays along the volume's axes, including an exact axis: no division by zero. */
static void a_camera_square_to_each_face(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) {
            double from[3] = {ball.centre[0], ball.centre[1], ball.centre[2]};
            from[axis] += 2.0 * side + (axis == 1 ? 1e-6 : 0);
            RayScene scene = ball_scene(from, ball.centre, 25);
            scene.width = scene.height = 61;
            assert_true(compare_sphere(&scene, false) > 500);
            scene_end(&scene);
        }
}

static void a_camera_in_the_volume(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){-0.4, 0.9, 0.42}, ball.centre, 70); /* beside the ball */
    assert_true(compare_sphere(&scene, false) > 1000);
    scene_end(&scene);
    scene = ball_scene(ball.centre, (double[]){1, 1, 1}, 60); /* inside the ball: only fluid in view */
    RayPixel *pixels = ray_drawn(&scene, true);
    for (int i = 0; i < scene.width * scene.height; i++)
        assert_true(pixels[i].depth > 0.99F && pixels[i].depth <= 1);
    free(pixels);
    scene_end(&scene);
}

/* Triangles from every side, from within, and in a tilted box. */
static void the_mesh_of_a_ball(void **state)
{
    (void)state;
    for (int surface = VOLUME_MESH; surface <= VOLUME_FACETS; surface++) {
        RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, (double[]){0.05, 0.48, 0}, 30);
        volume_def(&scene.def)->surface = (VolumeSurface)surface;
        assert_true(compare_sphere(&scene, false) > 2000);
        assert_true(compare_sphere(&scene, true) > 2000);
        scene.def.camera.from[0] = -1.3, scene.def.camera.from[1] = -0.3;
        scene.state.box =
            (BoxState){.position = {0.3, 0.1, -0.1}, .orientation = {0.1, 0.3, -0.2, sqrt(0.86)}};
        assert_true(compare_sphere(&scene, false) > 1000);
        scene_end(&scene);
        scene = ball_scene((double[]){-0.4, 0.9, 0.42}, ball.centre, 70); /* in the volume, beside the ball */
        volume_def(&scene.def)->surface = (VolumeSurface)surface;
        assert_true(compare_sphere(&scene, false) > 1000);
        scene_end(&scene);
        scene = ball_scene(ball.centre, (double[]){1, 1, 1}, 60); /* in the ball */
        volume_def(&scene.def)->surface = (VolumeSurface)surface;
        RayPixel *pixels = ray_drawn(&scene, true);
        for (int i = 0; i < scene.width * scene.height; i++)
            assert_true(pixels[i].depth > 0.99F && pixels[i].depth <= 1);
        free(pixels);
        scene_end(&scene);
    }
}

/* Noise: every case of a cube. 0 at the outermost voxels, where a mesh on the CPU ends by rule. */
static double noise_at(const double at[3], const void *context)
{
    (void)context;
    uint32_t bits = 0;
    for (int k = 0; k < 3; k++) {
        const int cell = (int)floor((at[k] - whole.corner[k]) / whole.cell);
        if (cell == 0 || cell == whole.size[k] - 1)
            return 0;
        bits = (bits ^ (uint32_t)cell) * 2654435761U;
        bits ^= bits >> 15;
    }
    return (bits >> 8) / (double)(1 << 24);
}

/* Of a known field the GPU lists as many triangles as the mesh has that `slosh export` writes. */
static void as_many_triangles_as_the_exported_mesh(void **state)
{
    (void)state;
    const size_t cells = volume_grid_cells(&whole);
    float *values = calloc(cells, sizeof *values);
    assert_non_null(values);
    for (int field = 0; field < 2; field++) {
        RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
        if (field == 1)
            ray_volume(&scene, &whole, noise_at, NULL);
        volume_def(&scene.def)->surface = VOLUME_MESH;
        free(ray_drawn(&scene, true));
        Error error;
        IsoMesh mesh;
        glGetTextureImage(scene.volume.field, 0, GL_RED, GL_FLOAT, (GLsizei)(cells * sizeof *values), values);
        assert_true(isosurface(whole.size, values, 0.5F, &mesh, &error));
        const size_t found =
            surface_mesh_triangles(raycast_mesh(ray_caster(&(Subject){&scene.def, &scene.world})));
        printf("%zu triangles\n", found);
        if (found != mesh.triangle_count || found < 1000)
            fail_msg("%zu triangles, %zu in the exported mesh", found, mesh.triangle_count);
        isosurface_free(&mesh);
        scene_end(&scene);
    }
    free(values);
}

static double pool_at(const double at[3], const void *context)
{
    (void)context;
    return fmax(0, fmin(0.5 + (0.413 - at[1]) / 0.125, 1));
}

/* A pool between walls that lie anywhere between voxels is a block with sharp edges. */
static void the_mesh_ends_at_walls(void **state)
{
    (void)state;
    static const double low[3] = {-0.5, 0, -0.5}, high[3] = {0.5, 0.413, 0.5};
    const VolumeGrid wide = {{72, 72, 72}, {-0.5 - 3.3 / 64, -3.7 / 64, -0.5 - 4.1 / 64}, 1.0 / 64};
    RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, (double[]){0, 0.2, 0}, 45);
    int compared = 0;
    ray_volume(&scene, &wide, pool_at, NULL);
    for (int k = 0; k < 3; k++)
        scene.volume.walled[k] = true;
    volume_def(&scene.def)->surface = VOLUME_MESH;
    RayPixel *pixels = ray_drawn(&scene, true);
    for (int i = 0; i < scene.width * scene.height; i++) {
        double from[3], to[3], begin = 0, end = INFINITY;
        ray_of(&scene, i % scene.width, i / scene.width, from, to);
        for (int k = 0; k < 3; k++) {
            const double a = (low[k] - from[k]) / to[k], b = (high[k] - from[k]) / to[k];
            begin = fmax(begin, fmin(a, b)), end = fmin(end, fmax(a, b));
        }
        if (fabs(end - begin) < 0.4 * wide.cell)
            continue; /* at an edge: rays leave out a tenth of a spacing at glass */
        const double found = pixels[i].depth > 0 ? scene.frame.camera.near_plane / pixels[i].depth : 0;
        if (fabs(found - (end > begin ? begin : 0)) > 0.03 * wide.cell * weights())
            fail_msg("pixel %d %d: %g m, the block is at %g", i % scene.width, i / scene.width, found,
                     end > begin ? begin : 0);
        compared += end > begin;
    }
    assert_true(compared > 2000);
    free(pixels);
    scene_end(&scene);
}

/* Facets have dark edges, a smooth mesh has none. */
static void edges_of_facets(void **state)
{
    (void)state;
    int dark[3] = {0};
    for (int surface = VOLUME_RAYS; surface <= VOLUME_FACETS; surface++) {
        RayScene scene = ball_scene((double[]){0.05, 0.48, 1.2}, ball.centre, 3);
        volume_def(&scene.def)->surface = (VolumeSurface)surface;
        RayPixel *pixels = ray_drawn(&scene, true);
        float most = 0;
        for (int i = 0; i < scene.width * scene.height; i++)
            most = fmaxf(most, pixels[i].color[1]);
        for (int i = 0; i < scene.width * scene.height; i++)
            dark[surface] += pixels[i].color[1] < 0.5F * most;
        free(pixels);
        scene_end(&scene);
    }
    if (dark[0] > 0 || dark[1] > 0 || dark[2] < 300 || dark[2] > 160 * 120 / 3)
        fail_msg("%d, %d and %d dark pixels", dark[0], dark[1], dark[2]);
}

static void expect_nothing(RayScene *scene)
{
    RayPixel *pixels = ray_drawn(scene, true);
    for (int i = 0; i < scene->width * scene->height; i++)
        if (pixels[i].depth > 0 || pixels[i].color[3] > 0)
            fail_msg("pixel %d %d: depth %g, opacity %g where nothing is", i % scene->width, i / scene->width,
                     pixels[i].depth, pixels[i].color[3]);
    free(pixels);
}

static void a_camera_that_looks_away(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, (double[]){2.6, 1.7, 2.8}, 60);
    expect_nothing(&scene);
    scene_end(&scene);
}

static double nothing_at(const double at[3], const void *context)
{
    (void)at, (void)context;
    return 0;
}

static double nan_at(const double at[3], const void *context)
{
    (void)at, (void)context;
    return NAN;
}

/* NaN in a corner far from the ball. */
static double ball_and_nan_at(const double at[3], const void *context)
{
    return at[0] < -0.45 && at[1] < 0.05 && at[2] < -0.45 ? NAN : ball_at(at, context);
}

static void nothing_and_what_is_no_number(void **state)
{
    (void)state;
    for (int look = RAYCAST_OPAQUE; look <= RAYCAST_TRANSLUCENT; look += RAYCAST_TRANSLUCENT) {
        RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
        volume_def(&scene.def)->raycast.look = (RaycastLook)look;
        ray_volume(&scene, &whole, nothing_at, NULL);
        expect_nothing(&scene);
        volume_def(&scene.def)->raycast.skip = false;
        expect_nothing(&scene);
        ray_volume(&scene, &whole, nan_at, NULL);
        free(ray_drawn(&scene, true)); /* the end */
        scene_end(&scene);
    }
    RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    ray_volume(&scene, &whole, ball_and_nan_at, &ball);
    assert_true(compare_sphere(&scene, false) > 2000);
    scene_end(&scene);
}

static double one_at(const double at[3], const void *context)
{
    (void)at, (void)context;
    return 1;
}

/* Fluid up to the volume's sides: cuts are closed, to the cell with the field's end at the middle. */
static void a_volume_full_of_fluid_has_no_holes(void **state)
{
    (void)state;
    RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, (double[]){0, 0.5, 0}, 45);
    ray_volume(&scene, &whole, one_at, NULL);
    RayPixel *pixels = ray_drawn(&scene, true);
    int covered = 0;
    for (int i = 0; i < scene.width * scene.height; i++) {
        double from[3], to[3], begin = 0, end = INFINITY;
        ray_of(&scene, i % scene.width, i / scene.width, from, to);
        for (int k = 0; k < 3; k++) {
            const double low = (whole.corner[k] - from[k]) / to[k],
                         high = (whole.corner[k] + 1 - from[k]) / to[k];
            begin = fmax(begin, fmin(low, high)), end = fmin(end, fmax(low, high));
        }
        if (fabs(end - begin) > 0.05 && (end > begin) != (pixels[i].depth > 0))
            fail_msg("pixel %d %d: depth %g of a ray that is in the volume from %g to %g", i % scene.width,
                     i / scene.width, pixels[i].depth, begin, end);
        if (end - begin > 0.05)
            assert_true(fabs(scene.frame.camera.near_plane / pixels[i].depth - begin) < 2 * whole.cell);
        covered += pixels[i].depth > 0;
    }
    assert_true(covered > 2000);
    free(pixels);
    scene_end(&scene);
}

static RaycastDef translucent(double opacity)
{
    RaycastDef def = volume_usual.raycast;
    def.look = RAYCAST_TRANSLUCENT;
    def.ramp[0] = 0, def.ramp[1] = 1; /* extinction is as the field */
    def.skin = 0;
    def.opacity = opacity;
    def.threshold = 1;
    return def;
}

/* Optical depth from opacity, against the field's integral; the chord through the middle. */
static void compare_lengths(RayScene *scene, double opacity)
{
    const double per_m = -log(1 - opacity) / scene->state.spacing;
    double longest = 0;
    RayPixel *pixels = ray_drawn(scene, true);
    for (int i = 0; i < scene->width * scene->height; i += 7) {
        double from[3], to[3], t[2], cosine = 0;
        ray_of(scene, i % scene->width, i / scene->width, from, to);
        if (!ray_meets_sphere(from, to, ball.centre, ball.radius, t, &cosine) || cosine < 0.3)
            continue;
        const double length = integral_of(from, to, t[1] + 0.3, NULL),
                     found = -log(1.0 - pixels[i].color[3]) / per_m;
        if (fabs(found - length) > 0.01 * length)
            fail_msg("pixel %d %d, step %g: %g m of fluid, not %g", i % scene->width, i / scene->width,
                     volume_def(&scene->def)->raycast.step, found, length);
        longest = fmax(longest, found);
    }
    assert_true(fabs(longest - 2 * ball.radius) < 0.02 * ball.radius);
    free(pixels);
}

static void the_chord_of_a_ball_at_any_step(void **state)
{
    (void)state;
    static const double steps[] = {0.25, 0.7, 1, 2};
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    for (int i = 0; i < 4; i++)
        for (int way = 0; way < 4; way++) {
            volume_def(&scene.def)->raycast = translucent(0.08);
            volume_def(&scene.def)->raycast.step = steps[i];
            volume_def(&scene.def)->raycast.jitter = way & 1, volume_def(&scene.def)->raycast.skip = way & 2;
            compare_lengths(&scene, 0.08);
        }
    scene_end(&scene);
}

/* Each surface crossed hides `skin` of what is behind: two do (1 - skin)^2. */
static void the_skin_at_any_step(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    static const double steps[] = {0.25, 0.5, 1, 2};
    for (int i = 0; i < 4; i++) {
        volume_def(&scene.def)->raycast = translucent(0);
        volume_def(&scene.def)->raycast.skin = 0.4, volume_def(&scene.def)->raycast.step = steps[i];
        RayPixel *pixels = ray_drawn(&scene, true);
        const float found = pixels[60 * scene.width + 80].color[3];
        if (fabs(found - (1 - 0.6 * 0.6)) > 0.002)
            fail_msg("step %g: opacity %g", steps[i], found);
        free(pixels);
    }
    scene_end(&scene);
}

/* The greatest relative error of optical depth through a curve. */
static double worst_of_curve(RayScene *scene, const ControlPoints *curve, double step)
{
    double worst = 0;
    volume_def(&scene->def)->raycast = translucent(0.08);
    volume_def(&scene->def)->raycast.curve = *curve;
    volume_def(&scene->def)->raycast.step = step;
    RayPixel *pixels = ray_drawn(scene, true);
    for (int i = 0; i < scene->width * scene->height; i += 97) {
        double from[3], to[3], t[2], cosine = 0;
        ray_of(scene, i % scene->width, i / scene->width, from, to);
        if (!ray_meets_sphere(from, to, ball.centre, ball.radius, t, &cosine) || cosine < 0.3)
            continue;
        const double found = log(1.0 - pixels[i].color[3]) / log(1 - 0.08) * scene->state.spacing;
        worst = fmax(worst, fabs(found / integral_of(from, to, t[1] + 0.3, curve) - 1));
    }
    free(pixels);
    return worst;
}

/* For any curve between two samples; the last curve begins at once. The remaining error is the field's
   deviation from a straight line between samples. */
static void the_curve_at_any_step(void **state)
{
    (void)state;
    static const ControlPoints even = {1, {0}, {0.5}};
    static const double steps[] = {0.25, 1, 2};
    static const double bounds[][3] = {
        {0.0005, 0.0005, 0.003}, {0.0005, 0.003, 0.01}, {0.002, 0.025, 0.09}, {0.015, 0.045, 0.11}};
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    for (int preset = 1; preset < 5; preset++)
        for (int i = 0; i < 3; i++) {
            const ControlPoints *curve = preset < 4 ? &volume_presets[preset].points : &even;
            const double worst = worst_of_curve(&scene, curve, steps[i]);
            printf("curve %d, steps of %g cells: off by %.4f\n", preset, steps[i], worst);
            assert_true(worst < weights() * bounds[preset - 1][i]);
        }
    scene_end(&scene);
}

/* A shell has a skin on either side: a ray crosses four. */
static void the_skins_of_a_shell(void **state)
{
    (void)state;
    static const double steps[] = {0.25, 1, 2};
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    for (int i = 0; i < 3; i++) {
        volume_def(&scene.def)->raycast = translucent(0);
        volume_def(&scene.def)->raycast.curve = volume_presets[3].points;
        volume_def(&scene.def)->raycast.skin = 0.2, volume_def(&scene.def)->raycast.step = steps[i];
        RayPixel *pixels = ray_drawn(&scene, true);
        const double found = pixels[60 * scene.width + 80].color[3];
        if (fabs(found - (1 - pow(0.8, 4))) > 0.004)
            fail_msg("step %g: opacity %g", steps[i], found);
        free(pixels);
    }
    scene_end(&scene);
}

/* Opacity by a scalar of its own: 7 everywhere, of 0 to 10, through a curve. */
static void opacity_by_another_scalar(void **state)
{
    (void)state;
    const ControlPoints points = {3, {0, 0.5, 1}, {0, 1, 0}};
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    float *field = calloc(64 * 64 * 64, sizeof *field);
    assert_non_null(field);
    volume_def(&scene.def)->raycast = translucent(0.08);
    RayPixel *plain = ray_drawn(&scene, true);
    glGetTextureImage(scene.volume.field, 0, GL_RED, GL_FLOAT, 64 * 64 * 64 * 4, field);
    for (int i = 0; i < 64 * 64 * 64; i++)
        field[i] *= 7;
    scene.volume.opacity[0] = scene.volume.field;
    scene.volume.opacity[1] = ray_texture(&whole, field);
    scene.def.opacity = (ScalarCurve){.by = 1 + SCALAR_PRESSURE, .range = {0, 10}, .curve = points};
    scene.state.scalar[SCALAR_PRESSURE].buffer = 1; /* present, unread */
    RayPixel *by = ray_drawn(&scene, true);
    scene.state.scalar[SCALAR_PRESSURE].buffer = 0;
    RayPixel *lacking = ray_drawn(&scene, true);
    double worst = 0;
    for (int i = 0; i < scene.width * scene.height; i++) {
        const double depth = -log(1 - fmin(plain[i].color[3], 0.999)),
                     found = -log(1 - fmin(by[i].color[3], 0.999));
        worst = fmax(worst, fabs(found - 0.6 * depth));
        assert_true(plain[i].color[3] == lacking[i].color[3]);
    }
    printf("optical depths by a scalar are off by %.1e\n", worst);
    assert_true(worst < 2e-4); /* a texture is read in steps of 1 / 256 of a texel */
    free(plain);
    free(by);
    free(lacking);
    free(field);
    glDeleteTextures(1, &scene.volume.opacity[1]);
    scene_end(&scene);
}

/* Neighbouring pixels sample at different places, so that missed detail is noise without bands. */
static void jitter_moves_samples(void **state)
{
    (void)state;
    int unlike[2] = {0};
    for (int jitter = 0; jitter < 2; jitter++) {
        RayScene scene = ball_scene((double[]){0.05, 0.48, 2}, ball.centre, 20);
        volume_def(&scene.def)->raycast = translucent(0.2);
        volume_def(&scene.def)->raycast.step = 6, volume_def(&scene.def)->raycast.jitter = jitter;
        RayPixel *pixels = ray_drawn(&scene, true);
        for (int x = 70; x < 90; x++) { /* the ball is nearly flat there */
            const RayPixel *pixel = &pixels[60 * scene.width + x];
            unlike[jitter] += fabsf(pixel[0].color[3] - pixel[1].color[3]) > 1e-3F;
        }
        free(pixels);
        scene_end(&scene);
    }
    if (!(unlike[0] == 0 && unlike[1] > 5))
        fail_msg("%d neighbours differ without jitter, %d with", unlike[0], unlike[1]);
}

/* A ray with early termination lacks at most the remaining transmittance, and takes fewer steps. */
static void early_termination(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){1.3, 1.1, 1.4}, ball.centre, 30);
    static const double thresholds[] = {0.8, 0.95};
    for (int t = 0; t < 2; t++) {
        const double threshold = thresholds[t];
        volume_def(&scene.def)->raycast = translucent(0.3);
        RayPixel *full = ray_drawn(&scene, true);
        volume_def(&scene.def)->raycast.threshold = threshold;
        RayPixel *early = ray_drawn(&scene, true);
        double most = 0;
        for (int i = 0; i < scene.width * scene.height; i++)
            for (int k = 0; k < 4; k++) {
                const double lacks = fabsf(full[i].color[k] - early[i].color[k]);
                if (lacks > 1 - threshold)
                    fail_msg("pixel %d, threshold %g: %g instead of %g", i, threshold, early[i].color[k],
                             full[i].color[k]);
                most = fmax(most, lacks);
            }
        assert_true(most > 0.1 * (1 - threshold)); /* it ended early at all */
        free(full);
        free(early);
    }
    scene_end(&scene);
}

/* Flat, as far from the eye as the middle of the ball, or nearer than all of it, or behind. */
static void solids_hide_and_are_hidden(void **state)
{
    (void)state;
    RayScene scene = ball_scene((double[]){0.05, 0.48, 2}, ball.centre, 20);
    scene.world.solid_count = 1;
    const int middle = 60 * scene.width + 80;
    free(ray_drawn(&scene, true)); /* for the near plane */
    const float near = scene.frame.camera.near_plane, depths[] = {1.5F, 2.03F, 2.5F};
    for (int place = 0; place < 3; place++) {
        scene.solid_depth = near / depths[place];
        volume_def(&scene.def)->raycast = volume_usual.raycast;
        RayPixel *pixels = ray_drawn(&scene, true);
        const float wanted = place == 0 ? scene.solid_depth : near / 1.73F;
        if (fabsf(pixels[middle].depth / wanted - 1) > 1e-3F || (pixels[middle].color[3] > 0) != (place > 0))
            fail_msg("solid at %g m: depth %g, not %g", depths[place], near / pixels[middle].depth,
                     near / wanted);
        free(pixels);
        volume_def(&scene.def)->raycast = translucent(0.02);
        pixels = ray_drawn(&scene, true);
        const double length = -log(1.0 - pixels[middle].color[3]) / -log(0.98) * scene.state.spacing;
        if (fabs(length - 0.3 * place) > 0.006)
            fail_msg("solid at %g m: %g m of fluid before it", depths[place], length);
        assert_true(pixels[middle].depth == scene.solid_depth); /* less than half of it is hidden */
        free(pixels);
    }
    scene_end(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_surface_of_a_ball, no_gl_errors),
        cmocka_unit_test_teardown(the_surface_in_a_tilted_box, no_gl_errors),
        cmocka_unit_test_teardown(a_camera_square_to_each_face, no_gl_errors),
        cmocka_unit_test_teardown(a_camera_in_the_volume, no_gl_errors),
        cmocka_unit_test_teardown(the_mesh_of_a_ball, no_gl_errors),
        cmocka_unit_test_teardown(as_many_triangles_as_the_exported_mesh, no_gl_errors),
        cmocka_unit_test_teardown(the_mesh_ends_at_walls, no_gl_errors),
        cmocka_unit_test_teardown(edges_of_facets, no_gl_errors),
        cmocka_unit_test_teardown(a_camera_that_looks_away, no_gl_errors),
        cmocka_unit_test_teardown(nothing_and_what_is_no_number, no_gl_errors),
        cmocka_unit_test_teardown(a_volume_full_of_fluid_has_no_holes, no_gl_errors),
        cmocka_unit_test_teardown(the_chord_of_a_ball_at_any_step, no_gl_errors),
        cmocka_unit_test_teardown(the_skin_at_any_step, no_gl_errors),
        cmocka_unit_test_teardown(the_curve_at_any_step, no_gl_errors),
        cmocka_unit_test_teardown(the_skins_of_a_shell, no_gl_errors),
        cmocka_unit_test_teardown(opacity_by_another_scalar, no_gl_errors),
        cmocka_unit_test_teardown(jitter_moves_samples, no_gl_errors),
        cmocka_unit_test_teardown(early_termination, no_gl_errors),
        cmocka_unit_test_teardown(solids_hide_and_are_hidden, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
