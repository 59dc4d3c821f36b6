/* The context without a display, and what is said when there is none. */
#include "tests/render/fixture.h"

#include <epoxy/gl.h>
#include <sys/wait.h>
#include <unistd.h>

static void test_core_context(void **state)
{
    (void)state;
    Error error = {0};
    for (int again = 0; again < 2; again++) {
        Headless *headless = headless_create(HEADLESS_GPU_AUTO, &error);
        if (!headless)
            fail_msg("%s", error.message);
        assert_true(epoxy_gl_version() >= 45);
        assert_string_equal(headless_renderer(headless), (const char *)glGetString(GL_RENDERER));
        headless_destroy(headless);
    }
    headless_destroy(NULL);
}

static void test_first_gpu(void **state)
{
    (void)state;
    Error error = {0};
    Headless *headless = headless_create(0, &error);
    if (headless)
        assert_true(strlen(headless_renderer(headless)) > 0);
    else
        assert_non_null(strstr(error.message, "GPU 0"));
    headless_destroy(headless);
}

static void test_no_such_gpu(void **state)
{
    (void)state;
    Error error = {0};
    assert_null(headless_create(99, &error));
    assert_non_null(strstr(error.message, "99"));
    assert_null(headless_create(-2, &error));
}

/* In a process of its own, since drivers are looked for once. */
static void test_no_driver(void **state)
{
    (void)state;
    pid_t child = fork();
    if (child == 0) {
        Error error = {0};
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
        Headless *headless = headless_create(HEADLESS_GPU_AUTO, &error);
        _exit(headless ? 1 : strstr(error.message, "install") || strstr(error.message, "would do") ? 0 : 2);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_driver), /* first: before this process has loaded a driver */
        cmocka_unit_test(test_core_context),
        cmocka_unit_test(test_first_gpu),
        cmocka_unit_test(test_no_such_gpu),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
