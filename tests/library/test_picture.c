/* Pictures by libslosh.so. Skipped where no context of OpenGL can be had. */
#include "slosh/picture.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 64, BYTES = 3 * WIDTH * HEIGHT };

static slosh_error error;

static slosh_world *make_world(void)
{
    const char *settings[] = {"particles=600"};
    slosh_scene *scene = slosh_scene_load("dam_break", settings, 1, &error);
    slosh_world *world = slosh_world_create(scene, &error);
    slosh_scene_free(scene);
    assert_non_null(world);
    return world;
}

static slosh_picture *make_picture(slosh_world *world, const char *setting)
{
    slosh_picture *picture = slosh_picture_create(world, &setting, 1, WIDTH, HEIGHT, &error);
    if (!picture && strstr(error.message, "context"))
        skip();
    if (!picture)
        fail_msg("%s", error.message);
    return picture;
}

static void draw(slosh_picture *picture, uint8_t *rgb)
{
    if (!slosh_picture_draw(picture, rgb, BYTES, &error))
        fail_msg("%s", error.message);
}

static int differing(const uint8_t *a, const uint8_t *b)
{
    int count = 0;
    for (int i = 0; i < BYTES; i++)
        count += abs(a[i] - b[i]) > 8;
    return count;
}

/* Two pictures at a time, whose contexts take turns. */
static void pictures_show_the_present_state(void **state)
{
    (void)state;
    static uint8_t first[BYTES], again[BYTES], splat[BYTES], later[BYTES];
    slosh_world *world = make_world();
    slosh_picture *spheres = make_picture(world, "view.kind=spheres"),
                  *other = make_picture(world, "view.kind=splat");
    draw(spheres, first);
    draw(other, splat);
    draw(spheres, again);
    assert_memory_equal(first, again, BYTES);
    assert_true(differing(first, splat) > 60);
    assert_true(slosh_world_run(world, 0.3, &error));
    draw(spheres, later);
    assert_true(differing(first, later) > 60);
    assert_true(strlen(slosh_picture_renderer(spheres)) > 0);
    slosh_picture_free(other);
    draw(spheres, again);
    assert_memory_equal(later, again, BYTES);
    slosh_picture_free(spheres);
    slosh_world_destroy(world);
}

static void *draw_alone(void *user)
{
    slosh_world *world = make_world();
    const char *settings[] = {"view.kind=spheres"};
    slosh_picture *picture = slosh_picture_create(world, settings, 1, WIDTH, HEIGHT, NULL);
    slosh_picture_draw(picture, user, BYTES, NULL);
    slosh_picture_free(picture);
    slosh_world_destroy(world);
    return NULL;
}

static void threads_draw_the_same(void **state)
{
    (void)state;
    static uint8_t rgb[3][BYTES];
    pthread_t thread[2];
    slosh_world *world = make_world();
    slosh_picture_free(make_picture(world, "view.kind=spheres"));
    slosh_world_destroy(world);
    draw_alone(rgb[2]);
    for (int k = 0; k < 2; k++)
        pthread_create(&thread[k], NULL, draw_alone, rgb[k]);
    for (int k = 0; k < 2; k++) {
        pthread_join(thread[k], NULL);
        assert_memory_equal(rgb[k], rgb[2], BYTES);
    }
}

static void wrong_pictures_are_errors(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    slosh_world *world = make_world();
    const char *wrong[] = {"view.kind=cubes"}, *dead[] = {"box.size=[1, 1, 1]"};
    assert_null(slosh_picture_create(world, wrong, 1, WIDTH, HEIGHT, &error));
    assert_non_null(strstr(error.message, "spheres"));
    assert_null(slosh_picture_create(world, dead, 1, WIDTH, HEIGHT, &error));
    assert_non_null(strstr(error.message, "box.size"));
    assert_null(slosh_picture_create(world, NULL, 0, 0, HEIGHT, &error));
    assert_non_null(strstr(error.message, "pixels"));
    assert_null(slosh_picture_create(NULL, NULL, 0, WIDTH, HEIGHT, &error));
    assert_false(slosh_picture_draw(NULL, rgb, BYTES, &error));
    slosh_picture_free(NULL);
    slosh_picture *picture = make_picture(world, "view.kind=spheres");
    assert_false(slosh_picture_draw(picture, rgb, BYTES - 1, &error));
    assert_non_null(strstr(error.message, "bytes"));
    slosh_picture_free(picture);
    slosh_world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_show_the_present_state),
        cmocka_unit_test(threads_draw_the_same),
        cmocka_unit_test(wrong_pictures_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
