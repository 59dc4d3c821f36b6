/* Data that stays on the GPU: the sentinel's state, and the particles during a frame. */
#include "tests/render/fixture.h"
#include "tests/sim/fixture.h"

#include "app/run/offscreen.h"
#include "render/overlays/glyphs/glyphs.h"
#include "render/views/pbsr/pbsr.h"
#include "sim/gpu/compute/compute.h"
#include "sim/gpu/gl.h"
#include "sim/step/world.h"

#include <epoxy/gl.h>

static int setup(void **state)
{
    if (context_setup(state) != 0)
        return 1;
    backends_add();
    return 0;
}

static WorldDef column_def(const char *backend)
{
    WorldDef def = fixture_def(0.4, 0.6, 0.4);
    def.retries = 3;
    def.spacing = 0.04;
    def.sound_speed = 20;
    def.dt = 0.002;
    def.substeps = 2;
    *world_threads(&def) = 1;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    fixture_block(&def, 0, -0.2, 0, -0.2, 0.2, 0.4, 0.2);
    return def;
}

/* Calls that transfer from the GPU, wait for the GPU, or query progress; the program calls through these
   pointers. Mapped memory is read after a fence, and the wait for the fence counts. */
static int crossings, waits, queries;
static bool drawing;
static PFNGLCLIENTWAITSYNCPROC wait_sync;
static PFNGLFINISHPROC finish;
static PFNGLGETQUERYOBJECTIVPROC query_iv;
static PFNGLGETQUERYOBJECTUIVPROC query_uiv;
static PFNGLGETQUERYOBJECTUI64VPROC query_ui64v;
static PFNGLGETNAMEDBUFFERSUBDATAPROC get_named;
static PFNGLREADPIXELSPROC read_pixels;
static PFNGLGETTEXTUREIMAGEPROC get_texture;
static PFNGLMAPNAMEDBUFFERRANGEPROC map_named;

static void APIENTRY count_get_named(GLuint buffer, GLintptr offset, GLsizeiptr size, void *data)
{
    crossings++;
    get_named(buffer, offset, size, data);
}

/* Into a buffer on the GPU nothing crosses. */
static bool into_memory(void)
{
    GLint buffer = 0;
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
    return buffer == 0;
}

static void APIENTRY count_read_pixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                                       GLenum type, void *data)
{
    crossings += into_memory();
    read_pixels(x, y, width, height, format, type, data);
}

static void APIENTRY count_get_texture(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei size,
                                       void *data)
{
    crossings += into_memory();
    get_texture(texture, level, format, type, size, data);
}

static void *APIENTRY count_map_named(GLuint buffer, GLintptr offset, GLsizeiptr size, GLbitfield access)
{
    crossings++;
    return map_named(buffer, offset, size, access);
}

/* A look at an unreached fence does not wait. */
static GLenum APIENTRY count_wait_sync(GLsync fence, GLbitfield flags, GLuint64 most_ns)
{
    waits += most_ns > 0;
    return wait_sync(fence, flags, most_ns);
}

static void APIENTRY count_finish(void)
{
    waits++;
    finish();
}

static void APIENTRY count_query_iv(GLuint query, GLenum what, GLint *value)
{
    queries++;
    query_iv(query, what, value);
}

/* A look does not wait. The order of `fragment` has a separate query. */
static void APIENTRY count_query_uiv(GLuint query, GLenum what, GLuint *value)
{
    queries += drawing && what != GL_QUERY_RESULT_NO_WAIT;
    query_uiv(query, what, value);
}

static void APIENTRY count_query_ui64v(GLuint query, GLenum what, GLuint64 *value)
{
    queries++;
    query_ui64v(query, what, value);
}

static void counting(bool on)
{
#define COUNT(name, saved, counter)                                                                          \
    if (!saved)                                                                                              \
        saved = epoxy_##name;                                                                                \
    epoxy_##name = on ? (counter) : saved
    COUNT(glGetNamedBufferSubData, get_named, count_get_named);
    COUNT(glReadPixels, read_pixels, count_read_pixels);
    COUNT(glGetTextureImage, get_texture, count_get_texture);
    COUNT(glMapNamedBufferRange, map_named, count_map_named);
    COUNT(glClientWaitSync, wait_sync, count_wait_sync);
    COUNT(glFinish, finish, count_finish);
    COUNT(glGetQueryObjectiv, query_iv, count_query_iv);
    COUNT(glGetQueryObjectuiv, query_uiv, count_query_uiv);
    COUNT(glGetQueryObjectui64v, query_ui64v, count_query_ui64v);
#undef COUNT
}

/* A view with settings, and the allowed reads from the GPU per picture. */
typedef struct Viewed {
    const char *kind;
    VolumeMethod method;
    VolumeBounds bounds;
    VolumeShow show;
    double level;
    bool fluid;  /* as the colour, which has no range */
    bool glyphs; /* arrows as overlay, with automatic length */
    int crossings;
    bool gpu;      /* pbsr by the GPU: a wait for the number of its pieces */
    bool software; /* crossings on a software driver only; on hardware the note is a query */
    int waits;     /* on a software driver, for what the CPU writes next */
} Viewed;

/* Bounds of the fluid make textures of a size known to the CPU. `slabs` sums on the CPU, `slice` too on a
   software driver. `pbsr` by the CPU makes layers from positions and colour values. */
static const Viewed views[] = {
    {.kind = "none"},
    {.kind = "spheres"},
    {.kind = "spheres", .glyphs = true},
    {.kind = "splat", .fluid = true},
    {.kind = "splat", .level = 0.15},
    {.kind = "volume", .method = VOLUME_GEOMETRY},
    {.kind = "volume", .method = VOLUME_GATHER, .show = VOLUME_SLICE, .fluid = true},
    {.kind = "volume",
     .method = VOLUME_GEOMETRY,
     .bounds = VOLUME_FLUID,
     .show = VOLUME_SLICE,
     .crossings = 1},
    {.kind = "volume", .method = VOLUME_SLABS, .crossings = 2},
    {.kind = "slice", .crossings = 2, .software = true},
    {.kind = "slice", .fluid = true, .crossings = 1, .software = true},
    {.kind = "pbsr", .crossings = 2, .waits = 1},
    {.kind = "pbsr", .fluid = true, .crossings = 2, .waits = 1},
    {.kind = "pbsr", .gpu = true},
};

static ViewDef view_of(const Viewed *viewed)
{
    ViewDef view = view_def_default();
    text_set(view.kind, viewed->kind);
    volume_def(&view)->cells = 16;
    volume_def(&view)->method = viewed->method;
    volume_def(&view)->bounds = viewed->bounds;
    volume_def(&view)->show = viewed->show;
    splat_def(&view)->level = viewed->level;
    pbsr_def(&view)->repeat = 1;
    pbsr_def(&view)->method = viewed->gpu ? PBSR_GPU : PBSR_CPU;
    view.color_by = viewed->fluid ? SCALAR_FLUID : SCALAR_SPEED;
    glyphs_def(&view)->show = viewed->glyphs;
    view.range_auto = true;
    return view;
}

/* Steps with the sentinel on, and pictures coloured with a range of the state: three waits a frame. The
   waits are for the sentinel's findings of the frame before, for the energy (falling fluid is watched
   closely), and for the range. `late`: as in the window, without waits for ranges, arrow lengths and
   legend texts. */
static void count_frames(const char *backend, const Viewed *viewed, bool late, Offscreen *offscreen,
                         World *world)
{
    enum { FRAMES = 3 };
    Error error = {0};
    renderer_set_late(offscreen->renderer, late);
    for (int frame = 0; frame < 2 + FRAMES; frame++) {
        if (frame == 2) { /* the first pictures create resources */
            crossings = waits = queries = 0;
            counting(true);
        }
        bool done = world_step(world, NULL, &error);
        drawing = true;
        done = done && offscreen_draw(offscreen, world, NULL, NULL, &error);
        drawing = false;
        if (!done)
            fail_msg("%s, view %td, frame %d: %s", backend, viewed - views, frame, error.message);
    }
    counting(false);
    const bool software = gl_renderer_is_software();
    const int wanted =
        (1 + (!late ? !viewed->fluid + viewed->glyphs + viewed->gpu : 0) + (software ? viewed->waits : 0)) *
        FRAMES;
    const int reads = viewed->software && !software ? 0 : FRAMES * viewed->crossings;
    const int asked = viewed->software && !software && !late ? FRAMES : 0;
    /* On a busy machine what was to come a frame later is waited for: 4 more in 3 frames were seen. */
    if (crossings != reads || waits < wanted || waits > wanted + 2 * FRAMES || queries != asked)
        fail_msg("%s, view %td, %s: %d reads, %d waits, %d queries in %d frames; %d, %d and %d are known",
                 backend, viewed - views, viewed->kind, crossings, waits, queries, FRAMES, reads, wanted,
                 asked);
}

static void no_particle_crosses_in_a_frame(void **state)
{
    (void)state;
    static const char *const backends[] = {"compute", "fragment"};
    WorldDef def;
    World *worlds[2];
    for (int k = 0; k < 2; k++) {
        def = column_def(backends[k]);
        assert_true(def.retries > 0);
        worlds[k] = fixture_world(&def);
    }
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        Error error = {0};
        Offscreen offscreen;
        const ViewDef view = view_of(&views[i]);
        if (!offscreen_open(&offscreen, &view, &def, worlds[0], 64, 64, &error))
            fail_msg("%s", error.message);
        for (int k = 0; k < 3; k++)
            count_frames(backends[k % 2], &views[i], k > 1, &offscreen, worlds[k % 2]);
        offscreen_close(&offscreen);
    }
    for (int k = 0; k < 2; k++) { /* the counters count */
        crossings = 0;
        counting(true);
        State read = fixture_read(worlds[k]);
        counting(false);
        assert_true(crossings > 0);
        fixture_free(&read);
        world_destroy(worlds[k]);
    }
}

/* Views get the same values as world_read. */
static void shared_is_what_is_read(void **state)
{
    const WorldDef def = column_def(*state);
    World *world = fixture_world(&def);
    ParticleBuffers shared;
    fixture_step(world, 20);
    State read = fixture_read(world);
    assert_true(world_shares(world));
    world_share(world,
                PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_SCALAR(SCALAR_DENSITY) | PARTICLE_ID |
                    PARTICLE_FLUID | PARTICLE_VELOCITY,
                &shared);
    assert_int_equal(shared.count, read.count);
    float *x = calloc(4 * read.count, sizeof *x), *density = calloc(read.count, sizeof *density);
    float *speed = calloc(read.count, sizeof *speed);
    uint32_t *id = calloc(read.count, sizeof *id);
    const GLsizeiptr words = (GLsizeiptr)(4 * read.count);
    glGetNamedBufferSubData(shared.position.buffer, 0, 4 * words, x);
    glGetNamedBufferSubData(shared.scalar[SCALAR_DENSITY].buffer, 0, words, density);
    glGetNamedBufferSubData(shared.scalar[SCALAR_SPEED].buffer, 0, words, speed);
    glGetNamedBufferSubData(shared.id.buffer, 0, words, id);
    for (size_t i = 0; i < read.count; i++) {
        const float *v = &read.velocity[(size_t)4 * id[i]];
        assert_memory_equal(&x[4 * i], &read.position[(size_t)4 * id[i]], 3 * sizeof *x);
        assert_true(fabsf(density[i] - read.density[id[i]]) < 1e-3F);
        assert_true(fabsf(speed[i] - sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) < 1e-6F);
    }
    free(x);
    free(density);
    free(speed);
    free(id);
    fixture_free(&read);
    world_destroy(world);
}

/* A speed of sound that no step here stands. */
static void blow_up(World *world, WorldDef def)
{
    Error error;
    def.sound_speed = 1e6;
    assert_true(world_change(world, &def, &error));
}

/* Trouble is found when the next frame begins, which then goes back to the begin of the frame before, to the
   bit; world_is_valid knows sooner. */
static void the_sentinel_goes_back_a_frame_later(void **state)
{
    const WorldDef def = column_def(*state);
    Error error = {0};
    WorldInfo info;
    World *world = fixture_world(&def);
    for (int frame = 0; frame < 5; frame++)
        assert_true(world_step(world, NULL, &error) && world_is_valid(world));
    blow_up(world, def);
    const uint64_t before = world_hash(world);
    world_info(world, &info);
    const double time = info.time;
    assert_true(world_step(world, NULL, &error)); /* not known yet */
    world_info(world, &info);
    assert_int_equal(info.trouble.count, 0);
    assert_false(world_is_valid(world));
    WorldState none = {0};
    assert_false(world_save(world, &none, &error)); /* nor kept as a good state */
    assert_non_null(strstr(error.message, "not sound"));
    const uint64_t step = info.step;
    assert_true(world_substep(world, NULL, &error));
    world_info(world, &info);
    assert_int_equal(info.trouble.count, 1);
    assert_true(info.trouble.what == STEP_TROUBLE_SPEED);
    assert_true(fabs(info.time - time) < 1e-12 && info.step == step + 1);
    assert_true(world_hash(world) == before && world_is_valid(world));
    bool going = true;
    for (int frame = 0; frame < 40 && going; frame++)
        going = world_step(world, NULL, &error);
    assert_false(going);
    assert_non_null(strstr(error.message, "further than the support radius"));
    assert_true(world_hash(world) == before);
    world_destroy(world);
}

/* After a blow-up the rest of the frame is skipped: all fluid would gather in a corner with all particles
   as neighbours. */
static void a_blown_up_frame_costs_nothing(void **state)
{
    WorldDef def = column_def(*state);
    def.substeps = 20;
    def.retries = 0;
    Error error = {0};
    World *world = fixture_world(&def);
    blow_up(world, def);
    assert_true(world_step(world, NULL, &error));
    assert_false(world_is_valid(world));
    const Compute *compute = world->state;
    const size_t cells = compute->fold.count;
    uint32_t *start = calloc(cells + 1, sizeof *start), fullest = 0;
    glGetNamedBufferSubData(compute->start, 0, (GLsizeiptr)((cells + 1) * sizeof *start), start);
    for (size_t c = 0; c < cells; c++)
        fullest = start[c + 1] - start[c] > fullest ? start[c + 1] - start[c] : fullest;
    assert_true(fullest < compute->count / 10);
    free(start);
    world_destroy(world);
}

/* Without retries the end comes a frame later. */
static void without_retries_it_ends(void **state)
{
    WorldDef def = column_def(*state);
    def.retries = 0;
    Error error = {0};
    World *world = fixture_world(&def);
    blow_up(world, def);
    assert_true(world_step(world, NULL, &error));
    assert_false(world_step(world, NULL, &error));
    assert_non_null(strstr(error.message, "blew up"));
    world_destroy(world);
}

/* A saved state contains the findings of the frame before: mode cfl uses the findings. */
static void adaptive_steps_go_on_from_a_saved_state(void **state)
{
    WorldDef def = column_def(*state);
    def.step_mode = STEP_CFL;
    def.cfl_number = 0.4;
    def.max_dt = 0.01;
    Error error = {0};
    WorldState saved = {0};
    World *one = fixture_world(&def), *other = fixture_world(&def);
    for (int step = 0; step < 20; step++)
        assert_true(world_step(one, NULL, &error));
    assert_true(world_save(one, &saved, &error) && world_load(other, &saved, &error));
    for (int step = 0; step < 20; step++)
        assert_true(world_step(one, NULL, &error) && world_step(other, NULL, &error));
    assert_true(world_hash(one) == world_hash(other));
    world_state_free(&saved);
    world_destroy(one);
    world_destroy(other);
}

int main(void)
{
#define ON(test, backend)                                                                                    \
    cmocka_unit_test_prestate_setup_teardown(test, NULL, no_gl_errors, (char[]){backend})
#define ON_EACH(test) ON(test, "compute"), ON(test, "fragment")
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(no_particle_crosses_in_a_frame, no_gl_errors),
        ON_EACH(shared_is_what_is_read),
        ON_EACH(the_sentinel_goes_back_a_frame_later),
        ON_EACH(without_retries_it_ends),
        ON_EACH(adaptive_steps_go_on_from_a_saved_state),
        ON(a_blown_up_frame_costs_nothing, "compute"),
    };
    return cmocka_run_group_tests_name("gl.device", tests, setup, context_teardown);
}
