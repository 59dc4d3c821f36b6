/* The voxels of every method, against sums by brute force. */
#include "tests/render/volume_fixture.h"

#include "render/views/volume/volume_private.h"

/* Methods that make a texture. */
static const VolumeMethod textured[] = {VOLUME_GEOMETRY, VOLUME_LAYERS, VOLUME_PLANES, VOLUME_SCATTER,
                                        VOLUME_GATHER,   VOLUME_SLABS,  VOLUME_IWASAKI};
enum { TEXTURED = sizeof textured / sizeof *textured };

static void each_voxel_is_the_sum_over_all_particles(void **state)
{
    (void)state;
    VolumeScene scene = volume_scene(0.08, 48);
    Voxels wanted = {0}, first = {0};
    add_fluid(&scene);
    for (int m = 0; m < TEXTURED; m++) {
        const char *name = volume_method_names[textured[m]];
        Voxelizer *voxelizer = voxelizer_of(textured[m], true);
        Voxels voxels = voxelized(voxelizer, &scene);
        if (m == 0) {
            wanted = brute_voxels(&scene, &voxels.volume.grid);
            first = voxels;
        }
        const double off = worst_of(voxels.field, wanted.field, wanted.count),
                     off_scalar = worst_of(voxels.scalar, wanted.scalar, wanted.count),
                     apart = worst_of(voxels.field, first.field, first.count);
        if (!(off < 1e-5 && off_scalar < 1e-5 && apart < 1e-5))
            fail_msg("%s: %g of the range off, the scalar %g; %g from %s", name, off, off_scalar, apart,
                     volume_method_names[textured[0]]);
        if (m > 0)
            voxels_free(&voxels);
        voxelizer_destroy(voxelizer);
    }
    voxels_free(&first);
    voxels_free(&wanted);
    volume_scene_free(&scene);
}

/* Cells much larger and much smaller than the kernel, so that particles cut between a single slice and
   dozens. */
static void coarse_and_fine(void **state)
{
    (void)state;
    static const double cells[] = {1.5, 0.05};
    for (int i = 0; i < 2; i++)
        for (int m = 0; m < TEXTURED; m++) {
            VolumeScene scene = volume_scene(0.2, 0);
            scene.state.box_size[0] = 0.4, scene.state.box_size[1] = 0.5, scene.state.box_size[2] = 0.3;
            scene.def.cell = cells[i];
            add_volume(&scene, -0.13, 0.37, 0.09, 0.008, 1);
            add_volume(&scene, 0.11, 0.21, -0.12, 0.007, 2);
            Voxelizer *voxelizer = voxelizer_of(textured[m], false);
            Voxels voxels = voxelized(voxelizer, &scene), wanted = brute_voxels(&scene, &voxels.volume.grid);
            const double off = worst_of(voxels.field, wanted.field, wanted.count);
            if (!(off < 1e-5))
                fail_msg("%s, cells of %g spacings: %g off", volume_method_names[textured[m]], cells[i], off);
            voxels_free(&voxels);
            voxels_free(&wanted);
            voxelizer_destroy(voxelizer);
            volume_scene_free(&scene);
        }
}

/* A plane: the volumes are areas, and F is 1 in the middle of a lattice. */
static void a_scene_of_two_dimensions(void **state)
{
    (void)state;
    const double d = 0.05, h = 2.1 * d, ratio = 4 / (3.14159265358979 * h * h) / kernel_poly6(0, h);
    VolumeScene scene = volume_scene(d, 64);
    scene.state.box_size[2] = d;
    for (int i = 0; i < 12 * 12; i++)
        add_volume(&scene, -0.5 + d * (i % 12), 0.1 + d * floor(i / 12.0), 0, d * d, 1);
    for (int m = 0; m < TEXTURED; m++) {
        Voxelizer *voxelizer = voxelizer_of(textured[m], false);
        Voxels voxels = voxelized(voxelizer, &scene), wanted = brute_voxels(&scene, &voxels.volume.grid);
        double most = 0;
        for (size_t i = 0; i < voxels.count; i++) {
            wanted.field[i] *= (float)ratio;
            most = fmax(most, (double)voxels.field[i]);
        }
        const double off = worst_of(voxels.field, wanted.field, wanted.count);
        if (!(off < 1e-5 && most > 0.9 && most < 1.05)) /* less where no voxel's centre is in the plane */
            fail_msg("%s: %g off, %g at most", volume_method_names[textured[m]], off, most);
        voxels_free(&voxels);
        voxels_free(&wanted);
        voxelizer_destroy(voxelizer);
    }
    volume_scene_free(&scene);
}

static double integral(const Voxels *voxels)
{
    double sum = 0;
    for (size_t i = 0; i < voxels->count; i++)
        sum += voxels->field[i];
    return sum * pow(voxels->volume.grid.cell, 3);
}

static void the_integral_is_the_volume_of_the_fluid(void **state)
{
    (void)state;
    VolumeScene scene = volume_scene(0.08, 64);
    double volume = 0;
    add_fluid(&scene);
    for (size_t i = 0; i < scene.particles->count; i++)
        volume += scene.particles->position[4 * i + 3];
    for (int m = 0; m < TEXTURED; m++)
        for (int bounds = VOLUME_BOX; bounds <= VOLUME_FLUID; bounds++) {
            scene.def.bounds = (VolumeBounds)bounds;
            Voxelizer *voxelizer = voxelizer_of(textured[m], false);
            Voxels voxels = voxelized(voxelizer, &scene);
            if (!(fabs(integral(&voxels) / volume - 1) < 0.002))
                fail_msg("%s, bounds of the %s: %g m3 of %g", volume_method_names[textured[m]],
                         volume_bounds_names[bounds], integral(&voxels), volume);
            voxels_free(&voxels);
            voxelizer_destroy(voxelizer);
        }
    volume_scene_free(&scene);
}

/* Inside the fluid both have the same voxels; the fluid's volume is smaller. */
static void bounds_of_the_fluid_are_on_the_same_lattice(void **state)
{
    (void)state;
    VolumeScene scene = volume_scene(0.05, 64);
    for (int i = 0; i < 200; i++)
        add_volume(&scene, 0.2 + 0.3 * sin(12.9 * i), 0.5 + 0.2 * sin(78.2 * i), 0.1 * sin(37.7 * i), 1e-4,
                   1);
    Voxelizer *voxelizer = voxelizer_of(VOLUME_AUTO, false);
    Voxels box = voxelized(voxelizer, &scene);
    scene.def.bounds = VOLUME_FLUID;
    Voxels fluid = voxelized(voxelizer, &scene);
    const VolumeGrid *a = &box.volume.grid, *b = &fluid.volume.grid;
    assert_true(2 * fluid.count < box.count && b->cell == a->cell);
    int shift[3];
    for (int k = 0; k < 3; k++) {
        shift[k] = (int)lround((b->corner[k] - a->corner[k]) / a->cell);
        assert_true(fabs(b->corner[k] - a->corner[k] - shift[k] * a->cell) < 1e-9 && shift[k] >= 0 &&
                    shift[k] + b->size[k] <= a->size[k]);
    }
    for (size_t i = 0; i < box.count; i++) {
        const size_t width = (size_t)a->size[0], height = (size_t)a->size[1];
        const int cell[3] = {(int)(i % width) - shift[0], (int)(i / width % height) - shift[1],
                             (int)(i / width / height) - shift[2]};
        bool inside = true;
        for (int k = 0; k < 3; k++)
            inside = inside && cell[k] >= 0 && cell[k] < b->size[k];
        const float here =
            inside
                ? fluid.field[((size_t)cell[2] * (size_t)b->size[1] + (size_t)cell[1]) * (size_t)b->size[0] +
                              (size_t)cell[0]]
                : 0;
        if (!(fabsf(here - box.field[i]) < 1e-5F))
            fail_msg("voxel %zu: %g with the bounds of the box, %g with those of the fluid", i,
                     (double)box.field[i], (double)here);
    }
    voxels_free(&box);
    voxels_free(&fluid);
    voxelizer_destroy(voxelizer);
    volume_scene_free(&scene);
}

static void nothing_then_one_then_elsewhere_then_nothing(void **state)
{
    (void)state;
    for (int m = 0; m < TEXTURED; m++)
        for (int bounds = VOLUME_BOX; bounds <= VOLUME_FLUID; bounds++) {
            Voxelizer *voxelizer = voxelizer_of(textured[m], false);
            VolumeScene scene = volume_scene(0.1, 32);
            scene.def.bounds = (VolumeBounds)bounds;
            for (int turn = 0; turn < 4; turn++) {
                scene.particles->count = 0;
                if (turn % 3 != 0)
                    add_volume(&scene, turn == 1 ? -0.71 : 0.43, turn == 1 ? 0.32 : 0.93, 0.11, 0.001, 1);
                Voxels voxels = voxelized(voxelizer, &scene),
                       wanted = brute_voxels(&scene, &voxels.volume.grid);
                for (size_t i = 0; i < voxels.count; i++)
                    if (!(fabsf(voxels.field[i] - wanted.field[i]) < 1e-5F))
                        fail_msg("%s, bounds of the %s, turn %d: voxel %zu is %g, not %g",
                                 volume_method_names[textured[m]], volume_bounds_names[bounds], turn, i,
                                 (double)voxels.field[i], (double)wanted.field[i]);
                assert_true(turn % 3 == 0 || integral(&voxels) > 0.0009);
                voxels_free(&voxels);
                voxels_free(&wanted);
            }
            voxelizer_destroy(voxelizer);
            volume_scene_free(&scene);
        }
}

static void numbers_that_are_none_count_for_nothing(void **state)
{
    (void)state;
    VolumeScene scene = volume_scene(0.1, 32);
    add_volume(&scene, 0.3, 0.4, 0.1, 0.001, 1);
    add_volume(&scene, -0.3, 0.4, 0.1, 0.001, 1);
    for (int m = 0; m < TEXTURED; m++) {
        Voxelizer *voxelizer = voxelizer_of(textured[m], true);
        scene.particles->count = 2;
        Voxels clean = voxelized(voxelizer, &scene);
        add_volume(&scene, NAN, 0.5, 0, 0.001, 1);
        add_volume(&scene, 0, INFINITY, 0, 0.001, 1);
        add_volume(&scene, 0, 0.5, -INFINITY, 0.001, 1);
        add_volume(&scene, 0, 0.5, 0, NAN, 1);
        add_volume(&scene, 0, 0.5, 0, INFINITY, 1);
        add_volume(&scene, 0, 0.5, 0, -0.001, 1);
        add_volume(&scene, 40, 0.5, 1e30, 0.001, 1);
        for (int bounds = VOLUME_BOX; bounds <= VOLUME_FLUID; bounds++) {
            scene.def.bounds = (VolumeBounds)bounds;
            Voxels voxels = voxelized(voxelizer, &scene);
            if (bounds == VOLUME_BOX)
                assert_true(worst_of(voxels.field, clean.field, clean.count) < 1e-6 &&
                            worst_of(voxels.scalar, clean.scalar, clean.count) < 1e-6);
            if (!(fabs(integral(&voxels) - 0.002) < 2e-5))
                fail_msg("%s: %g m3", volume_method_names[textured[m]], integral(&voxels));
            voxels_free(&voxels);
        }
        scene.def.bounds = VOLUME_BOX;
        voxels_free(&clean);
        voxelizer_destroy(voxelizer);
    }
    volume_scene_free(&scene);
}

/* What drivers without some extensions get. */
static void plain_ways_are_as_good(void **state)
{
    (void)state;
    static const struct {
        const VoxelizeMethod *by;
        void *(*create)(VolumeMethod method, bool scalar, Error *error);
        VolumeMethod method;
    } ways[] = {{&voxelize_points, voxelize_points_plain, VOLUME_LAYERS},
                {&voxelize_compute, voxelize_compute_plain, VOLUME_SCATTER}};
    for (int i = 0; i < 2; i++) {
        Error error = {0};
        VolumeScene scene = volume_scene(0.08, 48);
        add_fluid(&scene);
        Voxelizer *voxelizer = voxelizer_of(VOLUME_SLABS, true);
        Voxels wanted = voxelized(voxelizer, &scene);
        void *plain = ways[i].create(ways[i].method, true, &error);
        assert_non_null(plain);
        ParticleBuffers buffers;
        Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
        const double h = scene.state.support_radius;
        const VoxelizeJob job = {.particles = &buffers,
                                 .carried = SCALAR_SPEED,
                                 .scalar = true,
                                 .radius = h / wanted.volume.grid.cell,
                                 .amplitude = kernel_poly6(0, h),
                                 .volume = &wanted.volume};
        static const GLfloat junk = 7;
        glClearTexImage(wanted.volume.field, 0, GL_RED, GL_FLOAT, &junk);
        glClearTexImage(wanted.volume.scalar, 0, GL_RED, GL_FLOAT, &junk);
        assert_true(ways[i].by->run(plain, &job, &error));
        float *field = read_texture(wanted.volume.field, wanted.count),
              *scalar = read_texture(wanted.volume.scalar, wanted.count);
        assert_true(worst_of(field, wanted.field, wanted.count) < 1e-5);
        assert_true(worst_of(scalar, wanted.scalar, wanted.count) < 1e-5);
        free(field);
        free(scalar);
        ways[i].by->destroy(plain);
        upload_destroy(upload);
        voxels_free(&wanted);
        voxelizer_destroy(voxelizer);
        volume_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(each_voxel_is_the_sum_over_all_particles, no_gl_errors),
        cmocka_unit_test_teardown(coarse_and_fine, no_gl_errors),
        cmocka_unit_test_teardown(a_scene_of_two_dimensions, no_gl_errors),
        cmocka_unit_test_teardown(the_integral_is_the_volume_of_the_fluid, no_gl_errors),
        cmocka_unit_test_teardown(bounds_of_the_fluid_are_on_the_same_lattice, no_gl_errors),
        cmocka_unit_test_teardown(nothing_then_one_then_elsewhere_then_nothing, no_gl_errors),
        cmocka_unit_test_teardown(numbers_that_are_none_count_for_nothing, no_gl_errors),
        cmocka_unit_test_teardown(plain_ways_are_as_good, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
