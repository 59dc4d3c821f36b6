/* The backend `fragment` against `cpu`, from the same states; its buckets against brute force. */
#include "tests/gl/parity.h"
#include "tests/lists.h"

#include "sim/cpu/cpu.h"
#include "sim/gpu/fragment/fragment.h"
#include "sim/gpu/gl.h"
#include "sim/methods/mueller/mueller.h"

#include <epoxy/gl.h>

/* As parity.h has it, with fewer particles. */
static WorldDef coarse_def(int dimensions)
{
    WorldDef def = stirred_def(dimensions);
    def.spacing = dimensions == 2 ? 0.03 : 0.09;
    return def;
}

/* A fluid without viscosity, with the second kernel and tensile pressure: too violent for a run. */
static void other_terms(WorldDef *def)
{
    def->fluid_count = 1;
    def->fluids[0].viscosity = 0;
    def->negative_pressure = true;
    snprintf(mueller_def(def)->density_kernel, sizeof mueller_def(def)->density_kernel, "poly6");
}

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        WorldDef def = coarse_def(2 + k % 2);
        if (k == 0)
            for_layers(&def);
        if (k >= 2)
            other_terms(&def);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "fragment");
        fixture_step(cpu, 100);
        copy_state(cpu, gpu);
        compare_step(k < 2 ? "two viscous fluids" : "inviscid, poly6, negative pressure", cpu, gpu);
        WorldSums a, b;
        world_sums(cpu, &a);
        world_sums(gpu, &b);
        assert_true(a.neighbours_mean > 8 && fabs(a.neighbours_mean - b.neighbours_mean) < 0.01);
        if (k < 2)
            compare_run(&def, "two viscous fluids", cpu, gpu, 200);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* What a kick finds, and how often the guard holds. */
static void the_watch_sees_what_the_cpu_sees(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    *world_threads(&def) = 1;
    const float position[] = {0, 0.001F, 0, 0.3F, 0.3F, 0.4999F, 0.2F, 0.5F, 0},
                velocity[] = {0, -1, 0, 0, 0, -7, 20, 0, 0};
    const InitialState initial = {.count = 3, .position = position, .velocity = velocity};
    def.initial = &initial;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "fragment");
    for (int i = 0; i < 60; i++) {
        WorldInfo a, b;
        fixture_step(cpu, 1);
        fixture_step(gpu, 1);
        assert_true(world_is_valid(gpu));
        world_info(cpu, &a);
        world_info(gpu, &b);
        assert_true(fabs(cpu->stepping.max_speed / gpu->stepping.max_speed - 1) < 1e-5);
        assert_true(fabs(cpu->stepping.max_acceleration / gpu->stepping.max_acceleration - 1) < 1e-3);
        assert_in_range(b.guarded, a.guarded - 1, a.guarded); /* the last half drift is seen a step later */
        assert_int_equal(b.lost, 0);
    }
    world_destroy(cpu);
    world_destroy(gpu);
}

/* Fails unless the cell holds the given particles, ordered by index, up to the cell's capacity. */
static void require_cell(const Fragment *f, const uint32_t *places, size_t cell, const uint32_t *members,
                         int count)
{
    for (int place = 0; place < 4 * f->layers; place++) {
        const uint32_t is = fragment_bucket_at(f, places, cell, place);
        const uint32_t wanted = place < count ? members[place] + 1 : 0;
        if (is != wanted)
            fail_msg("place %d of cell %zu, of %d particles: %u, not %u", place, cell, count, is, wanted);
    }
}

/* The number of the world's particles without a place; fails unless every place holds the expected
   particle. */
static size_t check_buckets(World *gpu)
{
    enum { MEMBERS = 400 };
    const Constants *s = &gpu->constants;
    const Fragment *f = gpu->state;
    State at = fixture_read(gpu);
    uint32_t *places = fragment_buckets_read(f), *members = calloc(s->cells.count, sizeof *members * MEMBERS);
    int *count = calloc(s->cells.count, sizeof *count);
    size_t lost = 0;
    for (size_t i = 0; i < at.count; i++) {
        const uint32_t cell = cpu_cell_of(s, at.position + 4 * i);
        assert_true(count[cell] < MEMBERS);
        members[MEMBERS * cell + (size_t)count[cell]++] = (uint32_t)i;
    }
    for (size_t cell = 0; cell < s->cells.count; cell++) {
        require_cell(f, places, cell, members + MEMBERS * cell, count[cell]);
        lost += count[cell] > 4 * f->layers ? (size_t)(count[cell] - 4 * f->layers) : 0;
    }
    fixture_free(&at);
    free(places);
    free(members);
    free(count);
    return lost;
}

static void buckets_hold_every_particle(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const WorldDef def = coarse_def(dimensions);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "fragment");
        fixture_step(cpu, 100);
        copy_state(cpu, gpu);
        assert_int_equal(check_buckets(gpu), 0);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* x y z, id of each texel. */
static float *texels_of(const Fragment *f)
{
    const size_t bytes = 16 * (size_t)f->width * (size_t)f->height;
    float *texels = malloc(bytes);
    glGetTextureImage(f->position[0], 0, GL_RGBA, GL_FLOAT, (GLsizei)bytes, texels);
    return texels;
}

/* How many are not where they began. */
static size_t displaced(const Fragment *f)
{
    float *texels = texels_of(f);
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++)
        count += texels[4 * i + 3] != (float)i;
    free(texels);
    return count;
}

/* By cell, and in a cell by id. */
static void an_order_is_that_of_the_cells(void **state)
{
    (void)state;
    World *cpu = world_on(coarse_def(3), "cpu"), *gpu = world_on(coarse_def(3), "fragment");
    Fragment *f = gpu->state;
    Error error;
    fixture_step(cpu, 100);
    copy_state(cpu, gpu);
    f->order_every = 1;
    assert_int_equal(displaced(f), 0);
    assert_true(fragment_mark(f, &error));
    assert_true(displaced(f) > f->count / 2);
    float *texels = texels_of(f);
    for (size_t i = 1; i < f->count; i++) {
        const uint32_t before = cpu_cell_of(&gpu->constants, texels + 4 * i - 4),
                       cell = cpu_cell_of(&gpu->constants, texels + 4 * i);
        assert_true(before < cell || (before == cell && texels[4 * i - 1] < texels[4 * i + 3]));
    }
    free(texels);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* Views read a particle's values by id. */
static void require_shared(World *world)
{
    ParticleBuffers shared;
    State at = fixture_read(world);
    float *x = malloc(16 * at.count);
    uint32_t *id = malloc(4 * at.count), *fluid = malloc(4 * at.count);
    world_share(world, PARTICLE_ID | PARTICLE_FLUID, &shared);
    glGetNamedBufferSubData(shared.position.buffer, 0, (GLsizeiptr)(16 * at.count), x);
    glGetNamedBufferSubData(shared.id.buffer, 0, (GLsizeiptr)(4 * at.count), id);
    glGetNamedBufferSubData(shared.fluid.buffer, 0, (GLsizeiptr)(4 * at.count), fluid);
    for (size_t i = 0; i < at.count; i++) {
        assert_in_range(id[i], 0, at.count - 1);
        assert_memory_equal(x + 4 * i, at.position + (size_t)4 * id[i], 16);
        assert_int_equal(fluid[i], at.fluid[id[i]]);
    }
    free(x);
    free(id);
    free(fluid);
    fixture_free(&at);
}

/* Also of particles without a place, which are listed apart. */
static void no_bit_depends_on_the_order(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        WorldDef def = coarse_def(2 + k % 2);
        uint64_t hash[3];
        def.retries = 3;
        fragment_def(&def)->grid_layers = k < 2 ? 0 : 1;
        fragment_def(&def)->lost_limit = 1000000;
        for (int every = 0; every < 3; every++) {
            World *world = world_on(def, "fragment");
            Fragment *f = world->state;
            f->order_every = every;
            fixture_step(world, 40);
            hash[every] = world_hash(world);
            assert_true((displaced(f) > f->count / 10) == (every > 0));
            assert_true(k < 2 || info_of(world).lost > 0);
            require_shared(world);
            world_destroy(world);
        }
        assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
    }
}

enum { CROWD = 700 };

/* Weightless particles at rest: most spread out, 300 in a single cell. */
static WorldDef crowd_def(float position[3 * CROWD], InitialState *initial, int layers, int limit)
{
    WorldDef def = fixture_def(1, 1, 1);
    uint32_t seed = 7;
    for (int i = 0; i < CROWD; i++)
        for (int k = 0; k < 3; k++) {
            const double at = fixture_random(&seed) - (k == 1 ? 0 : 0.5);
            position[3 * i + k] = (float)(i % 7 < 3 ? 0.3 + 0.1 * at : at);
        }
    *initial = (InitialState){.count = CROWD, .position = position};
    def.initial = initial;
    def.gravity[1] = 0;
    def.sound_speed = 0.01;
    *fragment_def(&def) = (FragmentDef){layers, limit};
    return def;
}

/* As many layers of four as a lattice needs, unless the def says otherwise. */
static void layers_follow_the_support(void **state)
{
    (void)state;
    static const struct {
        int dimensions, given, layers;
        double support;
    } cases[] = {{3, 0, 7, 2.1}, {3, 0, 2, 2},   {2, 0, 3, 2.1},
                 {2, 0, 4, 3.1}, {3, 1, 1, 2.1}, {2, 9, 9, 2.1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        WorldDef def = {.dimensions = cases[i].dimensions, .support = cases[i].support};
        fragment_def(&def)->grid_layers = cases[i].given;
        assert_int_equal(fragment_layers(&def), cases[i].layers);
    }
}

/* The scalar `lost` is 1 of the particles that are in no place of the buckets, and 0 of the others. Returns
 * how many. */
static size_t lost_shown(World *world)
{
    const Fragment *f = world->state;
    ParticleBuffers shared;
    uint32_t *places = fragment_buckets_read(f);
    bool *placed = calloc(CROWD, sizeof *placed);
    float *lost = calloc(CROWD, sizeof *lost);
    size_t count = 0;
    for (size_t cell = 0; cell < world->constants.cells.count; cell++)
        for (int place = 0; place < 4 * f->layers; place++) {
            const uint32_t entry = fragment_bucket_at(f, places, cell, place);
            assert_true(entry <= CROWD);
            if (entry > 0)
                placed[entry - 1] = true;
        }
    world_share(world, PARTICLE_SCALAR(SCALAR_LOST), &shared);
    glGetNamedBufferSubData(shared.scalar[SCALAR_LOST].buffer, 0, (GLsizeiptr)(sizeof *lost * CROWD), lost);
    for (int i = 0; i < CROWD; i++) {
        if (lost[i] != (placed[i] ? 0.0F : 1.0F))
            fail_msg("particle %d %s a place, but lost is %g", i, placed[i] ? "has" : "has not",
                     (double)lost[i]);
        count += lost[i] > 0;
    }
    free(places);
    free(placed);
    free(lost);
    return count;
}

/* The paper's four places a cell, and as many as there may be. */
static void what_finds_no_place_is_counted(void **state)
{
    (void)state;
    static const int layers[] = {1, 2, 7, 63};
    static float position[3 * CROWD];
    InitialState initial;
    for (int k = 0; k < 4; k++) {
        const WorldDef def = crowd_def(position, &initial, layers[k], CROWD);
        World *world = world_on(def, "fragment");
        const size_t lost = check_buckets(world);
        fixture_step(world, 1);
        assert_true(world_is_valid(world));
        assert_int_equal(info_of(world).lost, lost);
        assert_int_equal(lost_shown(world), lost);
        printf("%d layers: %zu of %d particles lost\n", layers[k], lost, CROWD);
        assert_true(k == 3 ? lost > 0 : lost > 100);
        world_destroy(world);
    }
}

static void more_lost_than_the_limit_ends_the_run(void **state)
{
    (void)state;
    static float position[3 * CROWD];
    InitialState initial;
    WorldDef def = crowd_def(position, &initial, 1, CROWD);
    World *world = world_on(def, "fragment");
    const size_t lost = check_buckets(world);
    world_destroy(world);
    for (int more = 0; more < 2; more++) {
        Error error = {0};
        char message[160];
        def = crowd_def(position, &initial, 1, (int)lost - more);
        def.retries = more * 3;
        world = world_on(def, "fragment");
        assert_true(world_step(world, NULL, &error));
        assert_true(world_step(world, NULL, &error) == !more);
        snprintf(message, sizeof message,
                 "%zu particles found no place in the grid of backend fragment; raise solver.grid_layers (1) "
                 "or solver.lost_limit (%zu)",
                 lost, lost - 1);
        assert_string_equal(error.message, more ? message : "");
        world_destroy(world);
    }
}

static void a_run_is_the_same_each_time(void **state)
{
    (void)state;
    check_same_each_time(coarse_def(3), "fragment", 40);
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    check_save_load_step(coarse_def(2), "fragment", 30);
}

/* The sentinel's way back. */
static void marked_particles_come_back(void **state)
{
    (void)state;
    Error error;
    World *world = world_on(coarse_def(2), "fragment");
    fixture_step(world, 20);
    const uint64_t before = world_hash(world);
    assert_true(backend_fragment.mark(world->state, &error));
    fixture_step(world, 5);
    assert_true(world_hash(world) != before);
    backend_fragment.back(world->state, world->count, 0);
    assert_true(world_hash(world) == before);
    world_destroy(world);
}

/* Terms may come and go while a world lives. */
static void changes_are_taken(void **state)
{
    (void)state;
    WorldDef def = coarse_def(2);
    Error error = {0};
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "fragment");
    fixture_step(cpu, 100);
    copy_state(cpu, gpu);
    def.fluids[0].viscosity = def.fluids[1].viscosity = 0;
    def.negative_pressure = true;
    def.sound_speed = 12;
    if (!world_change(cpu, &def, &error) || !world_change(gpu, &def, &error))
        fail_msg("%s", error.message);
    compare_step("after a change", cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* A viscosity by a table is a number each step: no program is made anew. */
static void a_table_is_taken(void **state)
{
    (void)state;
    WorldDef def = coarse_def(2);
    def.fluids[0].viscosity_table = (TimeTable){3, {0, 40 * def.dt, 150 * def.dt}, {4, 4, 0}};
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "fragment");
    const Fragment *fragment = gpu->state;
    const unsigned force = fragment->program[FRAGMENT_FORCE];
    fixture_step(cpu, 100);
    assert_true(cpu->constants.viscosity[0] > 1 && cpu->constants.viscosity[0] < 3);
    copy_state(cpu, gpu);
    compare_step("a viscosity by a table", cpu, gpu);
    fixture_step(gpu, 10);
    assert_true(fragment->program[FRAGMENT_FORCE] == force &&
                gpu->constants.viscosity[0] < cpu->constants.viscosity[0]);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* A step leaves what the views have set. */
static void the_context_is_left_as_it_was(void **state)
{
    (void)state;
    static const GLenum flags[] = {GL_DEPTH_TEST,   GL_SCISSOR_TEST, GL_BLEND,
                                   GL_STENCIL_TEST, GL_CULL_FACE,    GL_PROGRAM_POINT_SIZE};
    World *world = world_on(coarse_def(2), "fragment");
    GLuint framebuffer, vertex_array;
    GLint value[4];
    GLboolean mask[4];
    glCreateFramebuffers(1, &framebuffer);
    glCreateVertexArrays(1, &vertex_array);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glBindVertexArray(vertex_array);
    glViewport(1, 2, 30, 40);
    glScissor(0, 0, 1, 1);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_LEQUAL);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    for (size_t i = 0; i < 6; i++)
        glEnable(flags[i]);
    const uint64_t before = world_hash(world);
    fixture_step(world, 1);
    assert_true(world_hash(world) != before);
    for (size_t i = 0; i < 6; i++) {
        assert_true(glIsEnabled(flags[i]));
        glDisable(flags[i]);
    }
    glGetIntegerv(GL_VIEWPORT, value);
    assert_true(value[0] == 1 && value[1] == 2 && value[2] == 30 && value[3] == 40);
    glGetBooleanv(GL_COLOR_WRITEMASK, mask);
    assert_true(mask[0] && !mask[1] && mask[2] && !mask[3]);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, value);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, value + 1);
    glGetIntegerv(GL_DEPTH_FUNC, value + 2);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, value + 3);
    assert_true(value[0] == (GLint)framebuffer && value[1] == (GLint)vertex_array && value[2] == GL_LEQUAL &&
                value[3] == GL_NEGATIVE_ONE_TO_ONE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteVertexArrays(1, &vertex_array);
    world_destroy(world);
}

/* Missing inputs stay out if named later: wall friction comes with the first viscosity. */
static void what_comes_later_is_refused_too(void **state)
{
    (void)state;
    WorldDef def = stirred_def(2);
    Error error = {0};
    for (int f = 0; f < def.fluid_count; f++)
        def.fluids[f].viscosity = 0;
    def.wall_slip = SLIP_NONE;
    World *world = world_on(def, "fragment");
    def.fluids[0].viscosity = 1;
    assert_false(world_change(world, &def, &error));
    assert_non_null(strstr(error.message, "backend fragment has no no-slip walls"));
    fixture_step(world, 2);
    world_destroy(world);
}

static void refused(const WorldDef *def, const char *message)
{
    WorldDef on = *def;
    Error error = {0};
    snprintf(on.backend, sizeof on.backend, "fragment");
    assert_null(world_create(&on, &error));
    assert_string_equal(error.message, message);
}

static void what_it_cannot_do_is_said(void **state)
{
    (void)state;
    WorldDef def = coarse_def(3);
    snprintf(def.method, sizeof def.method, "wcsph");
    refused(&def, "backend fragment has no method wcsph; use backend compute or cpu");
    def = coarse_def(3);
    def.solid_count = 1;
    def.solids[0] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.8, 0}, .radius = 0.1};
    refused(&def, "backend fragment has no solids; use backend compute or cpu");
    def = coarse_def(3);
    add_drain(&def, (Fill){.kind = FILL_BALL, .centre = {0, 0.8, 0}, .radius = 0.1});
    refused(&def, "backend fragment has no drains; use backend compute or cpu");
    def = coarse_def(3);
    add_emit(&def.fluids[0],
             (Emit){.centre = {0, 0.9, 0}, .direction = {0, -1, 0}, .radius = 0.1, .speed = 1});
    refused(&def, "backend fragment has no emitters; use backend compute or cpu");
    def = coarse_def(3);
    def.wall_slip = SLIP_NONE;
    refused(&def, "backend fragment has no no-slip walls; use backend compute or cpu");
    def = coarse_def(3);
    def.tension_model = TENSION_COHESION;
    def.fluids[0].surface_tension = 1;
    refused(&def, "backend fragment has no surface tension; use backend compute or cpu");
    def = coarse_def(3);
    fragment_def(&def)->grid_layers = 64;
    refused(&def, "backend fragment has up to 63 layers; solver.grid_layers is 64");
    def = stirred_def(2);
    def.box_size[0] = def.box_size[1] = 1000;
    snprintf(def.backend, sizeof def.backend, "fragment");
    Error error = {0};
    assert_null(world_create(&def, &error));
    GLint side = 0;
    char wanted[80];
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    snprintf(wanted, sizeof wanted, "need textures larger than the %d x %d texels", side, side);
    assert_non_null(strstr(error.message, wanted));
}

/* The compiler then proves that no more is needed. */
static void shaders_are_of_glsl_3_30(void **state)
{
    (void)state;
    static const char version[] = "#version 330 core\n";
    int seen = 0;
    for (const EmbeddedShader *shader = embedded_shaders; shader->path; shader++) {
        ShaderSource source;
        Error error;
        const char *ending = strrchr(shader->path, '.');
        if (strncmp(shader->path, "sim/", 4) != 0 || strcmp(ending, ".glsl") == 0 ||
            strcmp(ending, ".comp") == 0 || strcmp(ending, ".h") == 0)
            continue;
        assert_true(shader_source_load(&source, shader->path, NULL, &error));
        assert_memory_equal(source.text, version, sizeof version - 1);
        shader_source_free(&source);
        seen++;
    }
    assert_true(seen > 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(buckets_hold_every_particle, no_gl_errors),
        cmocka_unit_test_teardown(an_order_is_that_of_the_cells, no_gl_errors),
        cmocka_unit_test_teardown(no_bit_depends_on_the_order, no_gl_errors),
        cmocka_unit_test(layers_follow_the_support),
        cmocka_unit_test_teardown(what_finds_no_place_is_counted, no_gl_errors),
        cmocka_unit_test_teardown(more_lost_than_the_limit_ends_the_run, no_gl_errors),
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(the_watch_sees_what_the_cpu_sees, no_gl_errors),
        cmocka_unit_test_teardown(a_run_is_the_same_each_time, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(marked_particles_come_back, no_gl_errors),
        cmocka_unit_test_teardown(changes_are_taken, no_gl_errors),
        cmocka_unit_test_teardown(a_table_is_taken, no_gl_errors),
        cmocka_unit_test_teardown(the_context_is_left_as_it_was, no_gl_errors),
        cmocka_unit_test_teardown(what_it_cannot_do_is_said, no_gl_errors),
        cmocka_unit_test_teardown(what_comes_later_is_refused_too, no_gl_errors),
        cmocka_unit_test(shaders_are_of_glsl_3_30),
    };
    return cmocka_run_group_tests_name("gl.fragment", tests, compare_setup, context_teardown);
}
