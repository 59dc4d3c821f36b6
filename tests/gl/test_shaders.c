/* Shader sources: required by every compiler, and without ambiguity between compilers. */
#include "tests/gl/compare.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>

/* Text in the parentheses that begin at `open`, closed on the same line. */
static size_t within(const char *open)
{
    size_t length = 0;
    int depth = 0;
    do
        depth += (open[length] == '(') - (open[length] == ')');
    while (depth > 0 && open[++length] && open[length] != '\n');
    return length;
}

static bool compares(const char *text, size_t length)
{
    const char *call = strstr(text, "Than");
    return call && call < text + length;
}

/* !(x > 0) holds for NaN, or not: that is the compiler's choice. common/nan.glsl asks the bits. */
static void no_comparison_is_negated(void **state)
{
    (void)state;
    int found = 0;
    for (const EmbeddedShader *shader = embedded_shaders; shader->path; shader++)
        for (const char *at = strstr(shader->text, "!("); at; at = strstr(at + 1, "!(")) {
            const size_t length = within(at + 1);
            if (!memchr(at, '<', length) && !memchr(at, '>', length) && !compares(at, length))
                continue;
            printf("%s: %.*s\n", shader->path, (int)length + 2, at);
            found++;
        }
    assert_int_equal(found, 0);
}

static unsigned program_of(const char *text)
{
    const unsigned shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram();
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glDeleteShader(shader);
    return program;
}

static const char *shader_text(const char *path)
{
    const EmbeddedShader *shader = embedded_shaders;
    while (shader->path && strcmp(shader->path, path) != 0)
        shader++;
    assert_non_null(shader->path);
    return shader->text;
}

static void nan_is_known_by_its_bits(void **state)
{
    (void)state;
    static const uint32_t bits[] = {0x7fc00000, 0xffc00000, 0x7f800001, 0xff800001, 0x7fffffff, 0xffffffff,
                                    0x7f800000, 0xff800000, 0x7f7fffff, 0xff7fffff, 0x00000001, 0x80000000};
    enum { COUNT = sizeof bits / sizeof *bits, NANS = 6 };
    char text[4096];
    uint32_t found[COUNT];
    unsigned buffers[2];
    snprintf(text, sizeof text,
             "#version 450 core\n%s\nlayout(local_size_x = 1) in;\n"
             "layout(std430, binding = 0) readonly buffer In { float x[]; };\n"
             "layout(std430, binding = 1) writeonly buffer Out { uint y[]; };\n"
             "void main() { uint i = gl_GlobalInvocationID.x;\n"
             "y[i] = uint(is_nan(x[i])) + 2u * uint(is_nan(vec4(1.0, 2.0, x[i], 3.0))); }\n",
             shader_text("common/nan.glsl"));
    const unsigned program = program_of(text);
    glCreateBuffers(2, buffers);
    for (int k = 0; k < 2; k++)
        glNamedBufferStorage(buffers[k], sizeof bits, bits, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffers);
    glUseProgram(program);
    glDispatchCompute(COUNT, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffers[1], 0, sizeof found, found);
    for (int i = 0; i < COUNT; i++)
        if (found[i] != (i < NANS ? 3U : 0U))
            fail_msg("%08x gives %u", bits[i], found[i]);
    glDeleteBuffers(2, buffers);
    glDeleteProgram(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(no_comparison_is_negated, no_gl_errors),
        cmocka_unit_test_teardown(nan_is_known_by_its_bits, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.shaders", tests, compare_setup, context_teardown);
}
