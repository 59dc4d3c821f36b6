/* The stage clock's times: with a test clock, and a GPU that finishes only on a wait. */
#define _GNU_SOURCE /* syscall */
#include "tests/render/fixture.h"
#include "tests/scratch.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static _Thread_local double turned_ms; /* by hand, in this thread; 0: the real clock */
static double asked_ms;                /* time of the requested work */
static int done;                       /* draws that were waited for */
static PFNGLFINISHPROC finish;

/* In the C library's place. */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    if (clock != CLOCK_MONOTONIC || turned_ms == 0)
        return (int)syscall(SYS_clock_gettime, clock, now);
    now->tv_sec = (time_t)(turned_ms / 1000);
    now->tv_nsec = (long)(1e6 * (turned_ms - 1e3 * (double)now->tv_sec));
    return 0;
}

/* A draw takes a millisecond, further requests a separate time. */
static void APIENTRY finish_asked(void)
{
    finish();
    turned_ms += asked_ms + draw_check_draws - done;
    done = draw_check_draws;
    asked_ms = 0;
}

static void clock_turn(void)
{
    finish = epoxy_glFinish;
    epoxy_glFinish = finish_asked;
    turned_ms = floor(wall_ms());
    done = draw_check_draws;
    asked_ms = 0;
}

static void clock_let_go(void)
{
    epoxy_glFinish = finish;
    turned_ms = 0;
}

typedef struct Load {
    unsigned program, framebuffer, texture, vertex_array;
} Load;

/* A fragment shader that loops `rounds` times in each of 256 x 256 pixels. */
static Load load_create(void)
{
    Load load;
    Error error = {0};
    char folder[SCRATCH_SIZE], path[SCRATCH_PATH];
    scratch_folder(folder);
    static const char *const text[2] = {
        "void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }\n",
        "layout(location = 0) uniform int rounds;\nlayout(location = 0) out float sum;\n"
        "void main() { sum = gl_FragCoord.x; for (int i = 0; i < rounds; i++) sum = sin(sum + gl_FragCoord.y); }\n"};
    static const char *const name[2] = {"load.vert", "load.frag"};
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, name[i]);
        FILE *file = fopen(path, "w");
        fputs(text[i], file);
        fclose(file);
    }
    program_set_directory(folder);
    load.program = program_create_pair("load", name[0], name[1], &error);
    program_set_directory(NULL);
    if (!load.program)
        fail_msg("%s", error.message);
    glCreateTextures(GL_TEXTURE_2D, 1, &load.texture);
    glTextureStorage2D(load.texture, 1, GL_R32F, 256, 256);
    glCreateFramebuffers(1, &load.framebuffer);
    glNamedFramebufferTexture(load.framebuffer, GL_COLOR_ATTACHMENT0, load.texture, 0);
    glCreateVertexArrays(1, &load.vertex_array);
    return load;
}

static void load_destroy(Load *load)
{
    glDeleteProgram(load->program);
    glDeleteTextures(1, &load->texture);
    glDeleteFramebuffers(1, &load->framebuffer);
    glDeleteVertexArrays(1, &load->vertex_array);
}

static void load_run(const Load *load, int rounds)
{
    glBindFramebuffer(GL_FRAMEBUFFER, load->framebuffer);
    glViewport(0, 0, 256, 256);
    glUseProgram(load->program);
    glProgramUniform1i(load->program, 0, rounds);
    glBindVertexArray(load->vertex_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    asked_ms += rounds;
}

/* Work that hides a stage's own cost: hardware is a thousand times faster. */
static void run_frame(const Load *load, GlTimer *timer)
{
    const int least = gl_renderer_is_software() ? 5 : 2000;
    GL_STAGE(timer, STAGE_SHADOW)
    load_run(load, least);
    GL_STAGE(timer, STAGE_SHADE)
    load_run(load, 100 * least);
}

/* Each stage has the time of the stage's work, without earlier work. */
static void test_finish(void **state)
{
    (void)state;
    Load load = load_create();
    GlTimer *timer = gl_timer_create(GL_CLOCK_FINISH);
    assert_string_equal(gl_timer_clock_name(timer), "finish");
    const int least = gl_renderer_is_software() ? 5 : 2000;
    clock_turn();
    StageTimes times = {0};
    load_run(&load, 7); /* of no stage */
    run_frame(&load, timer);
    clock_let_go();
    assert_true(gl_timer_frame(timer, &times));
    assert_true(fabs(times.ms[STAGE_SHADOW] - (least + 1)) < 1e-3);
    assert_true(fabs(times.ms[STAGE_SHADE] - (100 * least + 1)) < 1e-3);
    assert_false(times.ran[STAGE_GRID]);
    gl_timer_destroy(timer);
    load_destroy(&load);
}

/* Where queries tell the truth they do so within the same bounds. */
static void test_query_order(void **state)
{
    (void)state;
    enum { FRAMES = 11 };
    Load load = load_create();
    GlTimer *timer = gl_timer_create(GL_CLOCK_QUERY);
    assert_string_equal(gl_timer_clock_name(timer), "gl");
    int known = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        StageTimes times = {0};
        for (int i = 0; i < 3 * frame; i++) /* more and more stages: the ring grows */
            GL_STAGE(timer, STAGE_OVERLAY)
        load_run(&load, 1);
        run_frame(&load, timer);
        if (gl_timer_frame(timer, &times)) {
            assert_true(frame >= 2); /* read two frames later at the earliest */
            assert_int_equal(times.ran[STAGE_OVERLAY], known > 0);
            assert_true(times.ran[STAGE_SHADE] && times.ms[STAGE_SHADE] >= 0);
            if (!gl_renderer_is_software())
                assert_true(times.ms[STAGE_SHADE] > times.ms[STAGE_SHADOW]);
            known++;
        }
    }
    StageTimes times = {0};
    while (gl_timer_drain(timer, &times))
        known++;
    assert_int_equal(known, FRAMES);
    gl_timer_destroy(timer);
    load_destroy(&load);
}

/* Of a picture of that view with a solid. */
static bool has_stage(const char *view, Stage stage)
{
    static const struct {
        const char *view;
        Stage stage;
    } of_one_view[] = {{"spheres", STAGE_VISIBILITY}, {"splat", STAGE_VISIBILITY}, {"splat", STAGE_BLEND},
                       {"splat", STAGE_THICKNESS},    {"splat", STAGE_FILTER},     {"splat", STAGE_ANTIALIAS},
                       {"splat", STAGE_FOAM},         {"spheres", STAGE_SHADE},    {"splat", STAGE_SHADE},
                       {"volume", STAGE_VOXELIZE},    {"volume", STAGE_RAYCAST}};
    bool named = false, own = false;
    for (size_t i = 0; i < sizeof of_one_view / sizeof *of_one_view; i++) {
        named |= of_one_view[i].stage == stage;
        own |= of_one_view[i].stage == stage && strcmp(of_one_view[i].view, view) == 0;
    }
    return stage_part(stage) == PART_RENDER && (own || !named);
}

/* A whole picture: every pass has a stage, and no time is lost between stages. */
static void picture_stages(const char *view)
{
    Error error = {0};
    ParticleBuffers buffers;
    ViewDef def = view_def_default();
    WorldDef world = {0};
    text_set(def.kind, view);
    def.color_by = SCALAR_SPEED;            /* with an automatic range */
    splat_def(&def)->shading = SPLAT_WATER; /* has all stages */
    splat_def(&def)->filter = SPLAT_NARROW_RANGE;
    world.solid_count = 1; /* what only some scenes have */
    world.solids[0] = (SolidDef){.radius = 0.2, .centre = {0, 0.7, 0}};
    Particles *particles = particles_wave(0.08);
    ParticleBuffers box = box_state(particles->count, 0.08);
    Upload *upload = upload_particles(particles, &box, &buffers);
    Renderer *renderer = renderer_create(&def, &world, 640, 480, &error);
    GlTimer *timer = gl_timer_create(GL_CLOCK_FINISH);
    assert_non_null(renderer);
    for (int frame = 0; frame < 3; frame++) { /* the first one makes things */
        StageTimes times = {0};
        clock_turn();
        double sum = 0, began = wall_ms();
        renderer_draw(renderer, &buffers, timer);
        glFinish();
        double whole = wall_ms() - began;
        clock_let_go();
        assert_true(gl_timer_frame(timer, &times));
        for (int stage = 0; stage < STAGE_COUNT; stage++) {
            assert_int_equal(times.ran[stage], has_stage(view, (Stage)stage));
            sum += times.ms[stage];
        }
        print_message("%s: %g draws, in stages %g\n", view, whole, sum);
        assert_true(whole > 2 && fabs(whole - sum) < 1e-3);
    }
    gl_timer_destroy(timer);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
}

static void test_picture_stages(void **state)
{
    (void)state;
    picture_stages("spheres");
    picture_stages("splat");
    picture_stages("volume");
}

static void count(void *user)
{
    (*(int *)user)++;
}

static void test_auto_and_off(void **state)
{
    (void)state;
    StageTimes times = {0};
    GlTimer *timer = gl_timer_create(GL_CLOCK_AUTO);
    assert_string_equal(gl_timer_clock_name(timer), gl_renderer_is_software() ? "finish" : "gl");
    gl_timer_destroy(timer);
    timer = gl_timer_create(GL_CLOCK_OFF);
    int stages = 0;
    gl_timer_between(timer, count, &stages);
    GL_STAGE(timer, STAGE_SHADE)
    glFlush();
    assert_int_equal(stages, 1);
    assert_false(gl_timer_frame(timer, &times));
    assert_false(times.ran[STAGE_SHADE]);
    assert_string_equal(gl_timer_clock_name(timer), "off");
    gl_timer_destroy(timer);
    GL_STAGE(NULL, STAGE_SHADE)
    glFlush();
    assert_false(gl_timer_frame(NULL, &times));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_finish, no_gl_errors),
        cmocka_unit_test_teardown(test_query_order, no_gl_errors),
        cmocka_unit_test_teardown(test_picture_stages, no_gl_errors),
        cmocka_unit_test_teardown(test_auto_and_off, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
