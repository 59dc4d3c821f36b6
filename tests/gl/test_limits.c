/* Limits of drivers: the sentence for each, and that worlds and views ask. */
#include "tests/gl/compare.h"

#include "render/renderer.h"
#include "sim/gpu/compute/compute.h"
#include "sim/gpu/fragment/fragment.h"
#include "sim/gpu/gl.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/step/world.h"

#include <epoxy/gl.h>
#include <limits.h>

static const GlLimits promised = {
    .compute_blocks = 8, .vertex_blocks = 0, .bindings = 8, .block_bytes = 1 << 27};

static void assert_refused(GlLimits least, const char *sentence)
{
    const GlNeeds needs = {.who = "this", .instead = "use that", .least = least};
    Error error = {0};
    assert_false(gl_limits_allow(&promised, &needs, &error));
    assert_string_equal(error.message, sentence);
}

static void each_limit_has_its_sentence(void **state)
{
    (void)state;
    const GlNeeds none = {.who = "this", .instead = "use that"}, all = {.least = promised};
    Error error = {0};
    assert_true(gl_limits_allow(&promised, &none, &error) && gl_limits_allow(&promised, &all, &error));
    assert_string_equal(error.message, "");
    assert_refused((GlLimits){.compute_blocks = 12},
                   "this needs 12 storage blocks in a compute shader, and this driver has 8; use that");
    assert_refused((GlLimits){.vertex_blocks = 5},
                   "this needs 5 storage blocks in a vertex shader, and this driver has 0; use that");
    assert_refused((GlLimits){.bindings = 16},
                   "this needs 16 bindings of storage buffers, and this driver has 8; use that");
    assert_refused((GlLimits){.block_bytes = (1 << 27) + 16},
                   "this needs a buffer of 134217744 bytes for this scene, and this driver allows shaders "
                   "134217728; use a larger particles.spacing");
}

static GLenum limited;
static GLint allowed;
static PFNGLGETINTEGERVPROC get_integer;
static PFNGLGETINTEGER64VPROC get_integer64;

static void APIENTRY limited_integer(GLenum name, GLint *value)
{
    if (name == limited)
        *value = allowed;
    else
        get_integer(name, value);
}

static void APIENTRY limited_integer64(GLenum name, GLint64 *value)
{
    if (name == limited)
        *value = allowed;
    else
        get_integer64(name, value);
}

/* Limits the size reported by the driver; 0: the driver's value. */
static void limit(GLenum name, GLint value)
{
    get_integer = get_integer ? get_integer : epoxy_glGetIntegerv;
    get_integer64 = get_integer64 ? get_integer64 : epoxy_glGetInteger64v;
    epoxy_glGetIntegerv = limited_integer;
    epoxy_glGetInteger64v = limited_integer64;
    limited = name;
    allowed = value;
}

static void assert_no_world(const WorldDef *def, const char *sentence)
{
    Error error = {0};
    assert_null(world_create(def, &error));
    if (!strstr(error.message, sentence))
        fail_msg("%s", error.message);
    error = (Error){0};
    assert_false(world_fits(def, &error));
    if (!strstr(error.message, sentence))
        fail_msg("%s", error.message);
}

static int dispatched;
static PFNGLDISPATCHCOMPUTEPROC dispatch;

static void APIENTRY counted_dispatch(GLuint x, GLuint y, GLuint z)
{
    dispatched++;
    dispatch(x, y, z);
}

/* `slosh info` asks of every scene, whose particles may be millions on a software driver. */
static void what_fits_is_found_without_computing(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = fixture_def(1, 1.2, 1);
    snprintf(def.backend, sizeof def.backend, "compute");
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    dispatch = epoxy_glDispatchCompute;
    epoxy_glDispatchCompute = counted_dispatch;
    assert_true(world_fits(&def, &error));
    assert_int_equal(dispatched, 0);
    World *world = world_create(&def, &error);
    assert_true(world && dispatched > 0);
    world_destroy(world);
    epoxy_glDispatchCompute = dispatch;
}

/* 1,000 particles of 16 bytes, with shifting of 32. */
static void worlds_ask(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1.2, 1);
    snprintf(def.backend, sizeof def.backend, "compute");
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 7);
    assert_no_world(&def,
                    "backend compute needs 8 storage blocks in a compute shader, and this driver has 7; use");
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 1, 0}, .radius = 0.1, .axis = {0, 1, 0}};
    limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 15);
    assert_no_world(
        &def, "backend compute with solids needs 16 bindings of storage buffers, and this driver has 15");
    limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 11);
    assert_no_world(&def, "with solids needs 13 storage blocks in a compute shader, and this driver has 11");
    def.solid_count = 0;
    snprintf(def.method, sizeof def.method, "wcsph");
    limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 16000);
    world_destroy(fixture_world(&def));
    wcsph_def(&def)->shifting = 0.1;
    assert_no_world(&def,
                    "needs a buffer of 32000 bytes for this scene, and this driver allows shaders 16000");
    limit(0, 0);
    world_destroy(fixture_world(&def));
}

/* A driver that tells how much memory there is. */
static const GLubyte *APIENTRY telling(GLenum name, GLuint index)
{
    (void)name, (void)index;
    return (const GLubyte *)"GL_NVX_gpu_memory_info";
}

/* Lists of 72 neighbours need 292,000 bytes: limited by the size of four shader buffers, and by memory. */
static void lists_that_do_not_fit_are_said(void **state)
{
    (void)state;
    static const struct {
        GLenum name;
        GLint enough, little;
    } limits[] = {{GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 75000, 74000},
                  {GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, 1200, 1000}}; /* kB */
    WorldDef def = fixture_def(1, 1.2, 1);
    snprintf(def.backend, sizeof def.backend, "compute");
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    PFNGLGETSTRINGIPROC before = epoxy_glGetStringi;
    for (int k = 0; k < 4; k++) {
        epoxy_glGetStringi = k > 1 ? telling : before;
        limit(limits[k / 2].name, k % 2 ? limits[k / 2].little : limits[k / 2].enough);
        World *world = fixture_world(&def);
        WorldInfo info;
        world_info(world, &info);
        assert_in_range(info.unlisted, k % 2 ? 280000 : 0, k % 2 ? 300000 : 0);
        assert_true((((const Compute *)world->state)->lists[0] == 0) == (k % 2 == 1));
        world_destroy(world);
    }
    epoxy_glGetStringi = before;
    limit(0, 0);
}

/* Puts 125 particles as near to each other as half of the spacing. */
static void gather(World *world)
{
    WorldState saved = {0};
    Error error;
    assert_true(world_save(world, &saved, &error));
    for (int i = 0; i < 125; i++) {
        saved.particles.x[i] = 0.05F * (float)(i % 5);
        saved.particles.y[i] = 0.4F + 0.05F * (float)(i / 5 % 5);
        saved.particles.z[i] = 0.05F * (float)(i / 25);
    }
    assert_true(world_load(world, &saved, &error));
    world_state_free(&saved);
}

/* Whether some particle has more neighbours than its list holds. */
static bool overfull(const Compute *c)
{
    uint32_t *found = calloc(c->count, sizeof *found);
    size_t more = 0;
    glGetNamedBufferSubData(c->lists[0], 0, (GLsizeiptr)(c->count * sizeof *found), found);
    for (size_t i = 0; i < c->count; i++)
        more += found[i] > c->list_most;
    free(found);
    return more > 0;
}

/* Where a driver has no binding for lists of neighbours each pass walks the cells, and finds the same: in a
   lattice, and where more are near than a list holds. With small blocks lists take several. */
static void lists_change_no_bit(void **state)
{
    (void)state;
    static const struct {
        GLenum limited;
        GLint allowed;
        int blocks;
    } drivers[] = {{0, 0, 1},
                   {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 11, 0},
                   {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 150000, 2},
                   {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 110000, 3},
                   {GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 80000, 4}};
    enum { DRIVERS = sizeof drivers / sizeof *drivers };
    static const char *const methods[] = {"mueller", "wcsph", "dfsph"};
    for (int k = 0; k < 6; k++) {
        WorldDef def = fixture_def(1, 1.2, 1);
        uint64_t hash[DRIVERS];
        def.reproducible = true;
        def.dt = 1e-5;
        snprintf(def.backend, sizeof def.backend, "compute");
        snprintf(def.method, sizeof def.method, "%s", methods[k % 3]);
        fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
        for (int d = 0; d < DRIVERS; d++) {
            limit(drivers[d].limited, drivers[d].allowed);
            World *world = fixture_world(&def);
            if (k > 2)
                gather(world);
            fixture_step(world, 5);
            assert_int_equal(((const Compute *)world->state)->list_blocks, drivers[d].blocks);
            assert_true(d > 0 || overfull(world->state) == (k > 2));
            hash[d] = world_hash(world);
            world_destroy(world);
            if (hash[d] != hash[0])
                fail_msg("%s: other bits with %d blocks", methods[k % 3], drivers[d].blocks);
        }
    }
    limit(0, 0);
}

static int storage_left; /* so many textures and large buffers the driver has memory for */
static GLenum short_of;
static PFNGLNAMEDBUFFERSTORAGEPROC storage;
static PFNGLGETERRORPROC get_error;

static void APIENTRY limited_storage(GLuint buffer, GLsizeiptr size, const void *data, GLbitfield flags)
{
    if (size < 4000 || storage_left-- > 0)
        storage(buffer, size, data, flags);
    else
        short_of = GL_OUT_OF_MEMORY;
}

static PFNGLTEXTURESTORAGE2DPROC texture_storage;

static void APIENTRY limited_texture(GLuint texture, GLsizei levels, GLenum format, GLsizei x, GLsizei y)
{
    texture_storage(texture, levels, format, x, y); /* it is cleared before anybody asks */
    if (storage_left-- <= 0)
        short_of = GL_OUT_OF_MEMORY;
}

static GLenum APIENTRY limited_error(void)
{
    const GLenum code = short_of ? short_of : get_error();
    short_of = GL_NO_ERROR;
    return code;
}

/* From now on the driver has memory for so many textures, and buffers of at least a number a particle. */
static void limit_storage(int buffers)
{
    storage = storage ? storage : epoxy_glNamedBufferStorage;
    texture_storage = texture_storage ? texture_storage : epoxy_glTextureStorage2D;
    get_error = get_error ? get_error : epoxy_glGetError;
    epoxy_glTextureStorage2D = limited_texture;
    epoxy_glNamedBufferStorage = limited_storage;
    epoxy_glGetError = limited_error;
    storage_left = buffers;
}

static WorldDef short_def(void)
{
    WorldDef def = fixture_def(1, 1.2, 1);
    def.dt = 1e-5;
    snprintf(def.backend, sizeof def.backend, "compute");
    def.wall_slip = SLIP_NONE;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    return def;
}

/* What a term or the sentinel needs is asked for again, once there is memory. */
static void memory_that_was_short_may_come(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = short_def();
    World *world = fixture_world(&def);
    def.fluids[0].viscosity = 1; /* friction along the walls is tables */
    limit_storage(0);
    assert_false(world_change(world, &def, &error));
    assert_non_null(strstr(error.message, "no memory"));
    assert_false(world->backend->mark(world->state, &error));
    fixture_step(world, 2);
    limit_storage(INT_MAX);
    assert_true(world_change(world, &def, &error) && world->backend->mark(world->state, &error));
    fixture_step(world, 2);
    world->backend->back(world->state, world->count, 0);
    fixture_step(world, 2);
    world_destroy(world);
}

static void memory_of_textures_may_come(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = short_def();
    def.wall_slip = SLIP_FREE;
    snprintf(def.backend, sizeof def.backend, "fragment");
    World *world = fixture_world(&def);
    const Fragment *f = world->state;
    def.fluids[0].viscosity = 1;
    limit_storage(0);
    assert_false(world_change(world, &def, &error) || world->backend->mark(world->state, &error));
    assert_true(f->moving == 0 && f->marked[0] == 0 && f->marked[1] == 0);
    fixture_step(world, 2);
    limit_storage(INT_MAX);
    assert_true(world_change(world, &def, &error) && world->backend->mark(world->state, &error));
    fixture_step(world, 2);
    world_destroy(world);
}

/* For each buffer of a world: no memory for the buffer. */
static void no_world_is_made_of_too_little(void **state)
{
    (void)state;
    Error error = {0};
    World *world = NULL;
    WorldDef def = short_def();
    def.retries = 3;
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 1, 0}, .radius = 0.1, .axis = {0, 1, 0}};
    int buffers = 0;
    for (; !world; buffers += 3) {
        error = (Error){0};
        limit_storage(buffers);
        world = world_create(&def, &error);
        assert_true(world || strstr(error.message, "no memory"));
    }
    limit_storage(INT_MAX);
    assert_in_range(buffers, 10, 40);
    fixture_step(world, 2);
    world_destroy(world);
}

static void assert_no_view(const ViewDef *def, const char *sentence)
{
    Error error = {0};
    assert_null(renderer_create(def, NULL, 16, 16, &error));
    if (!strstr(error.message, sentence))
        fail_msg("%s", error.message);
}

static void views_ask(void **state)
{
    (void)state;
    ViewDef def = view_def_default();
    const Fill block = {.min = {-0.5, 0, -0.5}, .max = {0.5, 1, 0.5}}; /* 1000 particles */
    const WorldDef world = {.dimensions = 3,
                            .box_size = {1, 1, 1},
                            .spacing = 0.1,
                            .support = 2.1,
                            .fluid_count = 1,
                            .fluids = {{.fill_count = 1, .fills = &block}}};
    Error error = {0};
    limit(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0);
    assert_no_view(&def, "view spheres needs 5 storage blocks in a vertex shader, and this driver has 0");
    limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 8);
    assert_no_view(&def, "bindings of storage buffers, and this driver has 8");
    limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, 40000);
    snprintf(def.kind, sizeof def.kind, "splat");
    splat_def(&def)->shape = SPLAT_PERSPECTIVE;
    Renderer *renderer = renderer_create(&def, &world, 16, 16, &error);
    assert_non_null(renderer);
    splat_def(&def)->shape = SPLAT_ELLIPSOID; /* live */
    assert_false(renderer_set_def(renderer, &def, &world, &error));
    assert_non_null(strstr(error.message, "view splat of ellipsoids needs a buffer of 48000 bytes"));
    renderer_destroy(renderer);
    snprintf(def.kind, sizeof def.kind, "none");
    limit(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0);
    renderer_destroy(renderer_create(&def, &world, 16, 16, &error));
    limit(0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_is_found_without_computing),
        cmocka_unit_test(each_limit_has_its_sentence),
        cmocka_unit_test_teardown(worlds_ask, no_gl_errors),
        cmocka_unit_test_teardown(lists_that_do_not_fit_are_said, no_gl_errors),
        cmocka_unit_test_teardown(lists_change_no_bit, no_gl_errors),
        cmocka_unit_test_teardown(memory_that_was_short_may_come, no_gl_errors),
        cmocka_unit_test_teardown(memory_of_textures_may_come, no_gl_errors),
        cmocka_unit_test_teardown(no_world_is_made_of_too_little, no_gl_errors),
        cmocka_unit_test_teardown(views_ask, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.limits", tests, compare_setup, context_teardown);
}
