/* Calls without effect are left out. After steps and pictures, the known state is that of the driver. */
#include "tests/gl/compare.h"

#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/trails/trails.h"
#include "render/renderer.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"
#include "shaders/sim/bindings.h"
#include "sim/base/base.h"
#include "sim/gpu/gl_known.h"

#include <epoxy/gl.h>
#include <math.h>

static uint64_t calls(void)
{
    return gl_calls().calls;
}

/* The first call may be known from before. */
#define CHECK_SETTING(call, other)                                                                           \
    do {                                                                                                     \
        other;                                                                                               \
        uint64_t before = calls();                                                                           \
        call;                                                                                                \
        assert_int_equal(calls() - before, 1);                                                               \
        call;                                                                                                \
        assert_int_equal(calls() - before, 1);                                                               \
        other;                                                                                               \
        call;                                                                                                \
        assert_int_equal(calls() - before, 3);                                                               \
    } while (0)

static GLuint small_program(const char *label)
{
    static const char *const stages[] = {"sim/compute/copy.comp", NULL};
    Error error = {0};
    const GLuint program = program_create(label, stages, NULL, &error);
    if (!program)
        fail_msg("%s", error.message);
    return program;
}

static void settings_are_made_once(void **state)
{
    (void)state;
    GLuint buffer[2], texture[2], array, framebuffer;
    const GLuint program = small_program("one"), another = small_program("two");
    glCreateBuffers(2, buffer);
    glNamedBufferStorage(buffer[0], 16, NULL, 0);
    glCreateTextures(GL_TEXTURE_2D, 2, texture);
    glCreateVertexArrays(1, &array);
    glCreateFramebuffers(1, &framebuffer);
    draw_check_set(false);
    CHECK_SETTING(glEnable(GL_BLEND), glDisable(GL_BLEND));
    CHECK_SETTING(glEnable(GL_BLEND), glEnablei(GL_BLEND, 1));
    CHECK_SETTING(glEnable(GL_BLEND), (gl_calls_foreign(), glFlush()));
    CHECK_SETTING(glDepthMask(GL_FALSE), glDepthMask(GL_TRUE));
    CHECK_SETTING(glDepthFunc(GL_GREATER), glDepthFunc(GL_ALWAYS));
    CHECK_SETTING(glColorMask(1, 1, 1, 0), glColorMask(1, 1, 1, 1));
    CHECK_SETTING(glBlendFunc(GL_ONE, GL_ZERO), glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ONE));
    CHECK_SETTING(glBlendEquation(GL_MAX), glBlendEquation(GL_FUNC_ADD));
    CHECK_SETTING(glBlendEquation(GL_MAX), glBlendEquationi(1, GL_MAX));
    CHECK_SETTING(glViewport(0, 0, 8, 8), glViewport(0, 1, 8, 8));
    CHECK_SETTING(glScissor(0, 0, 8, 8), glScissor(0, 0, 8, 7));
    CHECK_SETTING(glCullFace(GL_FRONT), glCullFace(GL_BACK));
    CHECK_SETTING(glFrontFace(GL_CW), glFrontFace(GL_CCW));
    CHECK_SETTING(glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE), glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE));
    CHECK_SETTING(glBindVertexArray(array), glBindVertexArray(0));
    CHECK_SETTING(glBindFramebuffer(GL_FRAMEBUFFER, framebuffer), glBindFramebuffer(GL_FRAMEBUFFER, 0));
    CHECK_SETTING(glBindFramebuffer(GL_FRAMEBUFFER, framebuffer), glBindFramebuffer(GL_READ_FRAMEBUFFER, 0));
    CHECK_SETTING(glBindTextureUnit(3, texture[0]), glBindTextureUnit(3, texture[1]));
    CHECK_SETTING(glBindTextures(3, 2, texture), glBindTextureUnit(4, 0));
    CHECK_SETTING(glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer[0]), glBindBuffer(GL_PIXEL_PACK_BUFFER, 0));
    CHECK_SETTING(glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, buffer[0]),
                  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, buffer[1]));
    CHECK_SETTING(glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 3, 2, buffer),
                  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, 0));
    CHECK_SETTING(glBindBufferBase(GL_UNIFORM_BUFFER, 3, buffer[0]),
                  glBindBufferRange(GL_UNIFORM_BUFFER, 3, buffer[0], 0, 16));
    CHECK_SETTING(glUseProgram(program), glUseProgram(another));
    CHECK_SETTING(glUniform3ui(WORDS_AT, 1, 2, 3), glProgramUniform3ui(program, WORDS_AT, 1, 2, 4));
    CHECK_SETTING(glProgramUniform3ui(another, WORDS_AT, 1, 2, 3),
                  glProgramUniform3ui(another, WORDS_AT, 0, 2, 3));
    draw_check_set(true);
    glDeleteProgram(program);
    glDeleteProgram(another);
    glDeleteBuffers(2, buffer);
    glDeleteTextures(2, texture);
    glDeleteVertexArrays(1, &array);
    glDeleteFramebuffers(1, &framebuffer);
    glDisable(GL_BLEND);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

/* A driver may give the names of deleted objects again. */
static void names_of_deleted_objects_are_forgotten(void **state)
{
    (void)state;
    static const GLuint numbers[3] = {7, 8, 9};
    GLuint buffer[2], array, framebuffer, texture;
    const GLuint program = small_program("deleted");
    glCreateBuffers(2, buffer);
    glCreateVertexArrays(1, &array);
    glCreateFramebuffers(1, &framebuffer);
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    draw_check_set(false);
#define CHECK_DELETION(bound, deletion)                                                                      \
    do {                                                                                                     \
        bound;                                                                                               \
        const uint64_t before = calls();                                                                     \
        bound;                                                                                               \
        deletion;                                                                                            \
        bound;                                                                                               \
        assert_int_equal(calls() - before, 2);                                                               \
    } while (0)
    CHECK_DELETION(glBindBufferBase(GL_UNIFORM_BUFFER, 9, buffer[0]), glDeleteBuffers(1, &buffer[1]));
    CHECK_DELETION(glBindTextureUnit(9, 0), glDeleteTextures(1, &texture));
    CHECK_DELETION(glBindVertexArray(0), glDeleteVertexArrays(1, &array));
    CHECK_DELETION(glBindFramebuffer(GL_FRAMEBUFFER, 0), glDeleteFramebuffers(1, &framebuffer));
#undef CHECK_DELETION
    draw_check_set(true);
    glProgramUniform3ui(program, WORDS_AT, 7, 8, 9);
    assert_true(known_uniform(program, WORDS_AT, 3, 1, numbers));
    glDeleteProgram(program);
    assert_false(known_uniform(program, WORDS_AT, 3, 1, numbers));
    unknown_uniforms(program);
    glDeleteBuffers(1, buffer);
}

static void uniforms_are_told_apart(void **state)
{
    (void)state;
    static const float number = 3;
    known_forget(true);
    for (GLuint program = 1; program < 4; program++)
        for (GLint at = 0; at <= KNOWN_UNIFORMS; at++)
            assert_false(known_uniform(program, at, 1, 1, &number));
    assert_true(known_uniform(3, KNOWN_UNIFORMS, 1, 1, &number));
    known_forget(true);
}

static void barriers_come_with_the_next_command(void **state)
{
    (void)state;
    draw_check_set(false);
    glUseProgram(0);
    glFlush();
    const GlCalls before = gl_calls();
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
    glViewport(0, 0, 3, 3);
    glViewport(0, 0, 3, 3);
    GlCalls of = gl_calls_since(&before);
    assert_true(of.barriers == 0 && of.calls == 1);
    glFlush();
    of = gl_calls_since(&before);
    assert_true(of.barriers == 1 && of.calls == 3);
    glFlush();
    of = gl_calls_since(&before);
    assert_true(of.barriers == 1 && of.calls == 4);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    gl_calls_foreign();
    of = gl_calls_since(&before);
    assert_true(of.barriers == 2);
    draw_check_set(true);
}

/* ---- the known state and the driver's ---- */

static int compared;

static void same(int64_t known, int64_t driver, const char *what, int number, const char *behind)
{
    compared++;
    if (known != driver)
        fail_msg("%s: %s %d is %lld, and %lld is known", behind, what, number, (long long)driver,
                 (long long)known);
}

static const struct {
    GLenum name;
    int count;
    bool boolean; /* else an integer or an enum */
} names[KNOWN_STATES] = {
    [KNOWN_PROGRAM] = {GL_CURRENT_PROGRAM, 1, false},
    [KNOWN_VERTEX_ARRAY] = {GL_VERTEX_ARRAY_BINDING, 1, false},
    [KNOWN_VIEWPORT] = {GL_VIEWPORT, 4, false},
    [KNOWN_SCISSOR] = {GL_SCISSOR_BOX, 4, false},
    [KNOWN_CLIP] = {GL_CLIP_ORIGIN, 1, false},
    [KNOWN_DEPTH_FUNCTION] = {GL_DEPTH_FUNC, 1, false},
    [KNOWN_DEPTH_MASK] = {GL_DEPTH_WRITEMASK, 1, true},
    [KNOWN_COLOR_MASK] = {GL_COLOR_WRITEMASK, 4, true},
    [KNOWN_BLEND] = {GL_BLEND_SRC_RGB, 1, false},
    [KNOWN_BLEND_EQUATION] = {GL_BLEND_EQUATION_RGB, 1, false},
    [KNOWN_CULLED] = {GL_CULL_FACE_MODE, 1, false},
    [KNOWN_FRONT] = {GL_FRONT_FACE, 1, false},
    [KNOWN_DRAW_FRAMEBUFFER] = {GL_DRAW_FRAMEBUFFER_BINDING, 1, false},
    [KNOWN_READ_FRAMEBUFFER] = {GL_READ_FRAMEBUFFER_BINDING, 1, false},
};

static void compare_states(const char *behind)
{
    const Known *known = known_all();
    for (int s = 0; s < KNOWN_STATES; s++) {
        GLint is[4] = {0};
        glGetIntegerv(names[s].name, is);
        for (int k = 0; known->set[s] && k < names[s].count; k++)
            same(names[s].boolean ? known->number[s][k] != 0 : known->number[s][k], is[k], "state", s,
                 behind);
    }
    for (int k = 0; k < KNOWN_CAPABILITIES && known->capability[k].name; k++)
        if (known->capability[k].enabled)
            same(known->capability[k].enabled - 1, glIsEnabled(known->capability[k].name), "capability",
                 (int)known->capability[k].name, behind);
}

static void compare_bindings(const char *behind)
{
    static const GLenum textures[] = {GL_TEXTURE_BINDING_2D,       GL_TEXTURE_BINDING_3D,
                                      GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_BUFFER,
                                      GL_TEXTURE_BINDING_1D,       GL_TEXTURE_BINDING_1D_ARRAY,
                                      GL_TEXTURE_BINDING_CUBE_MAP};
    const Known *known = known_all();
    for (int k = 0; k < KNOWN_BINDINGS; k++) {
        GLint is = 0;
        if (known->storage[k] >= 0) {
            glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, (GLuint)k, &is);
            same(known->storage[k], is, "storage buffer", k, behind);
        }
        if (known->uniform_block[k] >= 0) {
            glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, (GLuint)k, &is);
            same(known->uniform_block[k], is, "uniform block", k, behind);
        }
    }
    for (int k = 0; k < KNOWN_UNITS; k++) {
        GLint is = 0;
        for (size_t t = 0; t < sizeof textures / sizeof *textures && known->texture[k] > 0; t++) {
            glGetIntegeri_v(textures[t], (GLuint)k, &is);
            if (is == known->texture[k])
                break;
        }
        if (known->texture[k] > 0)
            same(known->texture[k], is, "texture", k, behind);
    }
}

static const float INACTIVE = -12345; /* the compiler left the uniform out */

static bool equal(uint32_t bits, float driver)
{
    float as_float;
    memcpy(&as_float, &bits, sizeof bits);
    return as_float == driver || (float)bits == driver || (float)(int32_t)bits == driver ||
           (isnan(as_float) && isnan(driver));
}

static void compare_uniforms(const char *behind)
{
    const Known *known = known_all();
    for (int k = 0; k < KNOWN_UNIFORMS; k++) {
        const GLuint program = known->uniform[k].program;
        GLfloat is[16] = {INACTIVE};
        if (known->uniform[k].size == 0 || !glIsProgram(program))
            continue;
        glGetUniformfv(program, known->uniform[k].at, is);
        for (int n = 0; n < known->uniform[k].size && is[0] != INACTIVE; n++)
            if (!equal(known->uniform[k].number[n], is[n]))
                fail_msg("%s: uniform %d of program %u is %g, and known are the bits %x of %d", behind,
                         known->uniform[k].at, program, (double)is[n], known->uniform[k].number[n],
                         known->uniform[k].size);
        compared++;
    }
}

static void compare_all(const char *behind)
{
    draw_check_set(false);
    compare_states(behind);
    compare_bindings(behind);
    compare_uniforms(behind);
    draw_check_set(true);
}

static void steps_leave_what_is_known(void **state)
{
    static const char *const on[][2] = {
        {"compute", "mueller"}, {"compute", "wcsph"},    {"compute", "dfsph"},
        {"compute", "pbf"},     {"fragment", "mueller"},
    };
    (void)state;
    compared = 0;
    for (size_t k = 0; k < sizeof on / sizeof *on; k++) {
        WorldDef def = pool_on(on[k][0], on[k][1]);
        if (strcmp(def.backend, "compute") == 0)
            def.solids[def.solid_count++] =
                (SolidDef){.kind = SOLID_SPHERE, .centre = {0.1, 0.25, 0}, .radius = 0.12, .density = 500};
        World *world = fixture_world(&def);
        for (int step = 0; step < 3; step++) {
            fixture_step(world, 1);
            compare_all(def.method);
        }
        world_destroy(world);
    }
    printf("%d comparisons\n", compared);
    assert_true(compared > 200);
}

static void draw(const ViewDef *view, World *world, const WorldDef *def)
{
    Error error = {0};
    Renderer *renderer = renderer_create(view, def, 96, 64, &error);
    ParticleBuffers particles;
    if (!renderer)
        fail_msg("%s", error.message);
    for (int picture = 0; picture < 3; picture++) {
        world_share(world, renderer_attributes(view), &particles);
        renderer_draw(renderer, &particles, NULL);
        compare_all(view->kind);
    }
    renderer_destroy(renderer);
}

static void pictures_leave_what_is_known(void **state)
{
    (void)state;
    WorldDef def = pool_on("compute", "mueller");
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0.1, 0.25, 0}, .radius = 0.12};
    World *world = fixture_world(&def);
    compared = 0;
    for (const ViewKind *const *kind = view_list; *kind; kind++) {
        ViewDef view = view_def_default();
        text_set(view.kind, (*kind)->name);
        volume_def(&view)->cells = 16;
        draw(&view, world, &def);
        trails_def(&view)->show = true;
        glyphs_def(&view)->show = true;
        splat_def(&view)->shading = SPLAT_WATER;
        volume_def(&view)->raycast.look = RAYCAST_TRANSLUCENT;
        view.resolution = 0.5;
        draw(&view, world, &def);
    }
    world_destroy(world);
    printf("%d comparisons\n", compared);
    assert_true(compared > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(settings_are_made_once, no_gl_errors),
        cmocka_unit_test_teardown(names_of_deleted_objects_are_forgotten, no_gl_errors),
        cmocka_unit_test_teardown(uniforms_are_told_apart, no_gl_errors),
        cmocka_unit_test_teardown(barriers_come_with_the_next_command, no_gl_errors),
        cmocka_unit_test_teardown(steps_leave_what_is_known, no_gl_errors),
        cmocka_unit_test_teardown(pictures_leave_what_is_known, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.known", tests, compare_setup, context_teardown);
}
