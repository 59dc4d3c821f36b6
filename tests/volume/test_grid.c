/* Grids of volumes: positions, limits; and the field as sampled by shaders. */
#include "tests/render/volume_fixture.h"

#include "render/frame/view.h"
#include "sim/gpu/gl.h"

#include <sys/resource.h>
#include <unistd.h>

static VolumeGrid grid_of(const VolumeDef *def, const ParticleBuffers *state)
{
    VolumeGrid grid;
    Error error = {0};
    if (!volume_grid_for(def, state, &grid, &error))
        fail_msg("%s", error.message);
    return grid;
}

static void a_grid_holds_the_box_and_a_margin(void **state)
{
    (void)state;
    static const struct {
        int cells;
        double cell, wanted;
    } cases[] = {{128, 0, 2.0 / 128}, {37, 0, 2.0 / 37}, {0, 0.5, 0.025}, {128, 0.31, 0.0155}};
    const ParticleBuffers box = box_state(0, 0.05);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const VolumeDef def = {.cells = cases[i].cells, .cell = cases[i].cell};
        const VolumeGrid grid = grid_of(&def, &box);
        assert_true(fabs(grid.cell - cases[i].wanted) < 1e-12);
        for (int k = 0; k < 3; k++) {
            const double low = k == 1 ? 0 : -box.box_size[k] / 2, h = box.support_radius;
            const double before = low - grid.corner[k],
                         after = grid.corner[k] + grid.size[k] * grid.cell - low - box.box_size[k];
            assert_true(before > h - 1e-6 && before < h + grid.cell);
            assert_true(fabs(before - after) < 1e-9);
        }
    }
}

/* A particle must not fall between two samples: h is the widest that a cell gets. */
static void cells_are_no_wider_than_a_particle_reaches(void **state)
{
    (void)state;
    const ParticleBuffers box = box_state(0, 0.05);
    const VolumeDef few = {.cells = 4}, wide = {.cells = 128, .cell = 10};
    assert_true(grid_of(&few, &box).cell == box.support_radius);
    assert_true(grid_of(&wide, &box).cell == box.support_radius);
}

/* Of few large particles `best` has the cells of `good`, of many small ones twice as many each way, between
   them cells of an eighth of a spacing. */
static void the_best_has_no_cells_that_show_nothing(void **state)
{
    (void)state;
    static const struct {
        double spacing, wanted;
    } cases[] = {{0.2, 2.0 / 128}, {0.0875, 0.0875 / 8}, {0.02, 2.0 / 256}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const ParticleBuffers box = box_state(0, cases[i].spacing);
        ViewDef def = view_def_default();
        text_set(def.kind, "volume");
        def.quality = VIEW_BEST;
        const ViewDef best = view_at_quality(&def, false);
        assert_true(fabs(grid_of(volume_def(&best), &box).cell - cases[i].wanted) < 1e-12);
        volume_def(&def)->cells = 256; /* as a scene says it */
        const ViewDef said = view_at_quality(&def, false);
        assert_true(fabs(grid_of(volume_def(&said), &box).cell - 2.0 / 256) < 1e-12);
    }
}

static void a_crop_stays_inside(void **state)
{
    (void)state;
    const ParticleBuffers box = box_state(0, 0.05);
    const VolumeDef def = {.cells = 100};
    const VolumeGrid whole = grid_of(&def, &box);
    static const double lows[][3] = {{-1, 0, -0.5},
                                     {0.2, 0.3, 0.1},
                                     {0.99, 0.99, 0.49},
                                     {-5, -5, -5},
                                     {1, 1, 1}},
                        highs[][3] = {{1, 1, 0.5}, {0.2, 0.3, 0.1}, {1, 1, 0.5}, {5, 5, 5}, {-1, -1, -1}};
    for (int i = 0; i < 5; i++) {
        VolumeGrid part;
        volume_grid_crop(&whole, lows[i], highs[i], box.support_radius, &part);
        for (int k = 0; k < 3; k++) {
            const double end = part.corner[k] + part.size[k] * part.cell,
                         whole_end = whole.corner[k] + whole.size[k] * whole.cell;
            assert_true(part.size[k] >= 1 && part.corner[k] >= whole.corner[k] - 1e-9 &&
                        end <= whole_end + 1e-9);
            assert_true(i == 4 ||
                        (part.corner[k] <= fmax(lows[i][k] - box.support_radius, whole.corner[k]) + 1e-9 &&
                         end >= fmin(highs[i][k] + box.support_radius, whole_end) - 1e-9));
            assert_true(i != 1 || part.size[k] * part.cell < 2 * box.support_radius + 17 * part.cell);
        }
    }
}

static void too_fine_a_grid_is_refused(void **state)
{
    (void)state;
    ParticleBuffers box = box_state(0, 0.05);
    const VolumeDef fine = {.cells = 4096}, huge = {.cells = 3000}, large = {.cells = 1500};
    VolumeGrid grid;
    Error error = {0};
    assert_false(volume_grid_for(&fine, &box, &grid, &error));
    assert_non_null(strstr(error.message, "view.volume.cells"));
    assert_false(volume_grid_for(&huge, &box, &grid, &error));
    assert_non_null(strstr(error.message, "at most 2147483648 of them"));
    assert_non_null(strstr(error.message, "view.volume.cells"));
    const VolumeDef endless = {.cell = 1e-9};
    assert_false(volume_grid_for(&endless, &box, &grid, &error));
    assert_true(
        volume_grid_for(&large, &box, &grid, &error)); /* 3.7e9 bytes: more than llvmpipe's textures */
    Voxelizer *voxelizer = voxelizer_of(VOLUME_AUTO, false);
    if (gl_renderer_is_software()) {
        assert_false(voxelizer_fits(voxelizer, &grid, 0.105, &error));
        assert_non_null(strstr(error.message, "view.volume.cells"));
    }
    const VolumeDef usual = volume_usual;
    assert_true(volume_grid_for(&usual, &box, &grid, &error) &&
                voxelizer_fits(voxelizer, &grid, 0.105, &error));
    voxelizer_destroy(voxelizer);
}

/* Points of the driver have a largest size. */
static void too_wide_a_particle_is_refused(void **state)
{
    (void)state;
    const VolumeGrid grid = {.size = {600, 600, 600}, .cell = 0.001};
    Error error = {0};
    GLfloat range[2];
    glGetFloatv(GL_POINT_SIZE_RANGE, range);
    Voxelizer *points = voxelizer_of(VOLUME_GEOMETRY, false), *slabs = voxelizer_of(VOLUME_SLABS, false);
    assert_false(voxelizer_fits(points, &grid, 0.001 * (double)range[1], &error));
    assert_non_null(strstr(error.message, "pixels"));
    assert_true(voxelizer_fits(points, &grid, 0.0004 * (double)range[1], &error));
    assert_true(voxelizer_fits(slabs, &grid, 0.001 * (double)range[1], &error));
    voxelizer_destroy(points);
    voxelizer_destroy(slabs);
}

/* Nothing has started yet: neither the view nor a change of its def. */
static void a_view_refuses_what_does_not_fit(void **state)
{
    (void)state;
    ViewDef def = bare_view();
    Error error = {0};
    text_set(def.kind, "volume");
    const WorldDef world = {.box_size = {2, 1, 1}, .spacing = 0.05, .support = 2.1};
    const Subject subject = {&def, &world};
    volume_def(&def)->cells = 4096;
    assert_null(view_create(&subject, &error));
    assert_non_null(strstr(error.message, "view.volume.cells"));
    volume_def(&def)->cells = 64;
    Renderer *renderer = renderer_create(&def, &world, 64, 64, &error);
    assert_non_null(renderer);
    volume_def(&def)->cells = 4096;
    assert_false(renderer_set_def(renderer, &def, &world, &error));
    volume_def(&def)->cells = 96;
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    volume_def(&def)->bounds = VOLUME_FLUID; /* whose shader was not wanted before */
    program_set_directory("no/such/folder");
    assert_false(renderer_set_def(renderer, &def, &world, &error));
    assert_non_null(strstr(error.message, "volume_bounds.comp"));
    program_set_directory(NULL);
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    renderer_destroy(renderer);
}

/* Runs shaders/volume/field.glsl at so many places: F there, and the scalar's mean. */
static void sample(const Voxelizer *voxelizer, const float *at, float *values, int count)
{
    static const char body[] = "layout(local_size_x = 1) in;\n"
                               "layout(std430, binding = 12) buffer At { vec4 at[]; };\n"
                               "layout(std430, binding = 13) buffer Values { vec2 values[]; };\n"
                               "void main() { uint i = gl_WorkGroupID.x;\n"
                               "values[i] = vec2(field_at(at[i].xyz), field_scalar_at(at[i].xyz)); }\n";
    ShaderSource source;
    Error error = {0};
    assert_true(shader_source_load(&source, "volume/field.glsl", voxelizer_defines(voxelizer), &error));
    GLuint shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram(), buffers[2];
    glShaderSource(shader, 2, (const GLchar *const[]){source.text, body}, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glDeleteShader(shader);
    shader_source_free(&source);
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], count * 16, at, 0);
    glNamedBufferStorage(buffers[1], count * 8, NULL, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 12, 2, buffers);
    voxelizer_bind(voxelizer);
    glUseProgram(program);
    glDispatchCompute((GLuint)count, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffers[1], 0, count * 8, values);
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteBuffers(2, buffers);
}

/* Direct to rounding, at any place; volumes at the centres of their voxels, and outside nothing. */
static void shaders_sample_the_field(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    static const VolumeMethod all[] = {VOLUME_DIRECT, VOLUME_SLABS, VOLUME_GATHER};
    for (int m = 0; m < 3; m++) {
        VolumeScene scene = volume_scene(0.08, 48);
        float at[4 * COUNT] = {0}, values[2 * COUNT];
        add_fluid(&scene);
        scene.def.bounds = m == 2 ? VOLUME_FLUID : VOLUME_BOX;
        Voxelizer *voxelizer = voxelizer_of(all[m], true);
        Voxels voxels = voxelized(voxelizer, &scene);
        for (int i = 0; i < COUNT; i++) {
            double place[3] = {-0.8 + 0.4 * sin(12.9 * i), 0.2 + 0.4 * sin(78.2 * i),
                               -0.3 + 0.4 * sin(37.7 * i)};
            if (all[m] != VOLUME_DIRECT)
                voxel_centre(&voxels.volume.grid, (size_t)(i * 7919) % voxels.count, place);
            for (int k = 0; k < 3; k++)
                at[4 * i + k] = (float)place[k];
        }
        at[0] = 50, at[5] = -50; /* outside */
        sample(voxelizer, at, values, COUNT);
        for (int i = 0; i < COUNT; i++) {
            double field, scalar;
            brute_field(&scene, (double[3]){(double)at[4 * i], (double)at[4 * i + 1], (double)at[4 * i + 2]},
                        &field, &scalar);
            if (!(fabs((double)values[2 * i] - field) < 2e-5 &&
                  (field < 1e-3 || fabs((double)values[2 * i + 1] - scalar / field) < 1e-3)))
                fail_msg("%s at %g %g %g: %g, %g; not %g, %g", volume_method_names[all[m]], (double)at[4 * i],
                         (double)at[4 * i + 1], (double)at[4 * i + 2], (double)values[2 * i],
                         (double)values[2 * i + 1], field, scalar / field);
        }
        voxels_free(&voxels);
        voxelizer_destroy(voxelizer);
        volume_scene_free(&scene);
    }
}

/* Limits the address space to so many bytes more than there are; false where a sanitizer would end the
 * program. */
static bool leave_memory(rlim_t left, struct rlimit *usual)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
    (void)left, (void)usual;
    return false;
#else
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%lu", &pages), 1);
    fclose(file);
    assert_int_equal(getrlimit(RLIMIT_AS, usual), 0);
    const struct rlimit limit = {pages * (rlim_t)sysconf(_SC_PAGESIZE) + left, usual->rlim_max};
    return gl_renderer_is_software() && setrlimit(RLIMIT_AS, &limit) == 0;
#endif
}

/* Of the texture or of the sums beside it: when the view is made, not with a first picture, which would be
 * empty. */
static void memory_that_is_short_is_said_before_a_picture(void **state)
{
    (void)state;
    int texture = 0, sums = 0;
    View *view = NULL;
    ViewDef def = bare_view();
    text_set(def.kind, "volume");
    const WorldDef world = {.box_size = {2, 1, 1}, .spacing = 0.05, .support = 2.1};
    const Subject subject = {&def, &world};
    volume_def(&def)->cells = 250, volume_def(&def)->method = VOLUME_SLABS,
    def.color_by = SCALAR_FLUID; /* 25 MB */
    for (rlim_t left = 10 << 20; !view && !sums && left < 300 << 20; left += 12 << 20) {
        struct rlimit usual;
        Error error = {0};
        if (!leave_memory(left, &usual))
            skip();
        view = view_create(&subject, &error);
        assert_int_equal(setrlimit(RLIMIT_AS, &usual), 0);
        texture += strstr(error.message, "no memory for a volume of") != NULL;
        sums += strstr(error.message, "no memory for the sums of a volume") != NULL;
    }
    view_destroy(view);
    assert_true(texture > 0 && sums > 0);
    gl_context_begin(); /* forgets the driver's answer */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_grid_holds_the_box_and_a_margin, no_gl_errors),
        cmocka_unit_test_teardown(cells_are_no_wider_than_a_particle_reaches, no_gl_errors),
        cmocka_unit_test(the_best_has_no_cells_that_show_nothing),
        cmocka_unit_test_teardown(a_crop_stays_inside, no_gl_errors),
        cmocka_unit_test_teardown(too_fine_a_grid_is_refused, no_gl_errors),
        cmocka_unit_test_teardown(too_wide_a_particle_is_refused, no_gl_errors),
        cmocka_unit_test_teardown(a_view_refuses_what_does_not_fit, no_gl_errors),
        cmocka_unit_test_teardown(shaders_sample_the_field, no_gl_errors),
        cmocka_unit_test_teardown(memory_that_is_short_is_said_before_a_picture, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
