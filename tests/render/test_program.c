/* Shaders that do not compile say where. */
#include "tests/render/fixture.h"
#include "tests/scratch.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[SCRATCH_SIZE];

static void write_shader(const char *name, const char *text)
{
    char path[SCRATCH_PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int folder_setup(void **state)
{
    scratch_folder(folder);
    write_shader("good.vert", "void main() { gl_Position = vec4(0); }\n");
    write_shader("good.glsl", "float one() { return 1.0; }\n");
    program_set_directory(folder);
    return context_setup(state);
}

static int folder_teardown(void **state)
{
    program_set_directory(NULL);
    return context_teardown(state);
}

static void assert_fails_at(const char *place, const char *word)
{
    Error error = {0};
    assert_int_equal(program_create_pair("broken", "good.vert", "bad.frag", &error), 0);
    if (strncmp(error.message, place, strlen(place)) != 0 || !strstr(error.message, word))
        fail_msg("\"%s\" does not begin with %s and name %s", error.message, place, word);
}

static void test_error_in_the_file(void **state)
{
    (void)state;
    write_shader("bad.frag",
                 "#include \"good.glsl\"\nout vec4 color;\nvoid main()\n{\n    color = wrong;\n}\n");
    assert_fails_at("bad.frag:5:", "wrong");
}

static void test_error_in_an_include(void **state)
{
    (void)state;
    write_shader("bad.glsl", "// one\n// two\nfloat two() { return missing; }\n");
    write_shader("bad.frag",
                 "out vec4 color;\n#include \"good.glsl\"\n#include \"bad.glsl\"\nvoid main() {}\n");
    assert_fails_at("bad.glsl:3:", "missing");
}

static void test_missing_include(void **state)
{
    (void)state;
    write_shader("bad.frag", "out vec4 color;\n#include \"nowhere.glsl\"\nvoid main() {}\n");
    assert_fails_at("bad.frag:2:", "nowhere.glsl");
}

static void test_does_not_link(void **state)
{
    (void)state;
    Error error = {0};
    write_shader("bad.frag",
                 "in vec4 never_written;\nout vec4 color;\nvoid main() { color = never_written; }\n");
    assert_int_equal(program_create_pair("lonely", "good.vert", "bad.frag", &error), 0);
    assert_non_null(strstr(error.message, "lonely"));
    assert_non_null(strstr(error.message, "never_written"));
}

static void test_unknown_kind_of_file(void **state)
{
    (void)state;
    Error error = {0};
    assert_int_equal(program_create_pair("odd", "good.vert", "good.glsl", &error), 0);
    assert_non_null(strstr(error.message, "good.glsl"));
}

/* Defines come first, an include is pasted once, the program carries its label. */
static void test_good_program(void **state)
{
    (void)state;
    char label[32] = "";
    Error error = {0};
    write_shader("good.frag", "#include \"good.glsl\"\n#include \"good.glsl\"\nout vec4 color;\n"
                              "void main() { color = vec4(one() * LIGHT); }\n");
    const char *stages[] = {"good.vert", "good.frag", NULL};
    unsigned program = program_create("shiny", stages, "#define LIGHT 0.5\n", &error);
    if (!program)
        fail_msg("%s", error.message);
    glGetObjectLabel(GL_PROGRAM, program, sizeof label, NULL, label);
    assert_string_equal(label, "shiny");
    glDeleteProgram(program);
}

/* A file may be included by a name declared before the shader; an undeclared name pastes no text. */
static void test_include_by_a_name(void **state)
{
    (void)state;
    Error error = {0};
    write_shader("good.frag",
                 "#include PART\n#ifdef OTHER_PART\n#include OTHER_PART\n#endif\nout vec4 color;\n"
                 "void main() { color = vec4(one()); }\n");
    const char *stages[] = {"good.vert", "good.frag", NULL};
    const unsigned program = program_create("by name", stages, "#define PART good.glsl\n", &error);
    if (!program)
        fail_msg("%s", error.message);
    glDeleteProgram(program);
    assert_int_equal(program_create("by name", stages, "#define PART none.glsl\n", &error), 0);
    assert_non_null(strstr(error.message, "good.frag:1: there is no shader \"none.glsl\""));
}

static void test_errors_are_counted(void **state)
{
    (void)state;
    gl_context_begin();
    assert_int_equal(gl_debug_errors(), 0);
    glBindBuffer(GL_ARRAY_BUFFER, 0xdead);
    assert_int_equal(gl_debug_errors(), 1);
    gl_context_begin();
    assert_int_equal(gl_debug_errors(), 0);
}

/* By a driver that sends no messages. */
static void test_who_asks_for_memory_drops_no_other_error(void **state)
{
    (void)state;
    gl_context_begin();
    glDisable(GL_DEBUG_OUTPUT);
    glBindBuffer(GL_ARRAY_BUFFER, 0xdead);
    assert_int_equal(gl_errors_take(GL_OUT_OF_MEMORY), 0);
    assert_int_equal(gl_debug_errors(), 1);
    gl_context_begin();
}

static int asked;

static GLenum APIENTRY lost(void)
{
    asked++;
    return GL_CONTEXT_LOST;
}

/* As a driver may whose GPU was reset. */
static void test_errors_without_end_are_not_waited_for(void **state)
{
    (void)state;
    GLenum(APIENTRY * before)(void) = epoxy_glGetError;
    epoxy_glGetError = lost;
    asked = 0;
    const int found = gl_errors_take(0), short_of_memory = gl_errors_take(GL_OUT_OF_MEMORY);
    epoxy_glGetError = before;
    assert_in_range(asked, 2, 1000);
    assert_true(found > 0 && short_of_memory == 0);
    gl_context_begin(); /* counted */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_error_in_the_file, no_gl_errors),
        cmocka_unit_test_teardown(test_error_in_an_include, no_gl_errors),
        cmocka_unit_test_teardown(test_missing_include, no_gl_errors),
        cmocka_unit_test_teardown(test_include_by_a_name, no_gl_errors),
        cmocka_unit_test_teardown(test_does_not_link, no_gl_errors),
        cmocka_unit_test_teardown(test_unknown_kind_of_file, no_gl_errors),
        cmocka_unit_test_teardown(test_good_program, no_gl_errors),
        cmocka_unit_test_teardown(test_errors_are_counted, no_gl_errors),
        cmocka_unit_test_teardown(test_who_asks_for_memory_drops_no_other_error, no_gl_errors),
        cmocka_unit_test_teardown(test_errors_without_end_are_not_waited_for, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, folder_setup, folder_teardown);
}
