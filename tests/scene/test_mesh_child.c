/* A mesh reader in a child process: crash, hang, failure, or success. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "app/scene/import/import_private.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool crash(const char *path, Triangles *triangles, Error *error)
{
    (void)path, (void)triangles, (void)error;
    raise(SIGSEGV);
    return true;
}

static bool hang(const char *path, Triangles *triangles, Error *error)
{
    (void)path, (void)triangles, (void)error;
    raise(SIGXCPU);
    return true;
}

/* Without a processor's time. */
static bool sleep_for_ever(const char *path, Triangles *triangles, Error *error)
{
    (void)path, (void)triangles, (void)error;
    while (true)
        pause();
    return true;
}

static bool leave(const char *path, Triangles *triangles, Error *error)
{
    (void)path, (void)triangles, (void)error;
    _exit(0);
}

static bool refuse(const char *path, Triangles *triangles, Error *error)
{
    (void)triangles;
    return error_set(error, "%s: no mesh", path);
}

enum { MANY = 100000 };

static bool make(const char *path, Triangles *triangles, Error *error)
{
    (void)path, (void)error;
    *triangles = (Triangles){MANY, MANY, calloc(MANY, sizeof *triangles->vertex),
                             calloc(MANY, sizeof *triangles->triangle), 3};
    triangles->vertex[MANY - 1][2] = 7;
    triangles->triangle[MANY - 1][1] = 9;
    return true;
}

static void expect_error(MeshRead *read, double seconds, const char *words)
{
    Triangles triangles;
    Error error = {""};
    assert_false(mesh_child_read(read, "a.obj", seconds, &triangles, &error));
    if (!strstr(error.message, words))
        fail_msg("'%s' has no '%s'", error.message, words);
    assert_null(triangles.vertex);
}

static void ends_are_errors(void **state)
{
    (void)state;
    expect_error(crash, 60, "crashed over it (Segmentation fault)");
    expect_error(hang, 60, "took more than 60 s and was stopped; simplify");
    expect_error(sleep_for_ever, 0.05, "took more than 0.05 s and was stopped; simplify");
    expect_error(leave, 60, "ended early");
    expect_error(refuse, 60, "a.obj: no mesh");
}

static void more_than_a_pipe_holds(void **state)
{
    (void)state;
    Triangles triangles;
    Error error;
    assert_true(mesh_child_read(make, "a.obj", 60, &triangles, &error));
    assert_int_equal(triangles.vertex_count, MANY);
    assert_true(triangles.largest == 3);
    assert_true(triangles.vertex[MANY - 1][2] == 7 && triangles.triangle[MANY - 1][1] == 9);
    triangles_free(&triangles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ends_are_errors),
                                       cmocka_unit_test(more_than_a_pipe_holds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
