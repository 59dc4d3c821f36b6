/* PNG files: a round trip is exact, and a failed write is reported. */
#include "tests/render/fixture.h"
#include "tests/scratch.h"

#include "app/files/pictures.h"

#include <unistd.h>

static Image noise(int width, int height)
{
    Image image;
    uint32_t x = 1;
    assert_true(image_create(&image, width, height));
    for (int i = 0; i < 3 * width * height; i++) {
        x = x * 1664525 + 1013904223;
        image.rgb[i] = (uint8_t)(x >> 24);
    }
    return image;
}

static void test_round_trip(void **state)
{
    (void)state;
    Error error = {0};
    char path[SCRATCH_SIZE];
    scratch_file(path, "");
    Image written = noise(37, 21), read;
    assert_true(image_write(&written, NULL, path, &error));
    assert_true(image_read(path, &read, &error));
    assert_int_equal(read.width, 37);
    assert_int_equal(read.height, 21);
    assert_memory_equal(read.rgb, written.rgb, 3 * 37 * 21);
    image_destroy(&written);
    image_destroy(&read);
}

static void test_full_disk(void **state)
{
    (void)state;
    Error error = {0};
    Image small = noise(4, 4), large = noise(200, 200); /* within the stream's buffer, and beyond it */
    for (int i = 0; i < 2; i++) {
        FILE *full = fopen("/dev/full", "wb");
        assert_non_null(full);
        assert_false(image_write_stream(i ? &large : &small, NULL, full, "movie.png", &error));
        assert_non_null(strstr(error.message, "movie.png"));
        assert_non_null(strstr(error.message, "No space left"));
        fclose(full);
    }
    image_destroy(&small);
    image_destroy(&large);
}

static void test_nowhere_to_write(void **state)
{
    (void)state;
    Error error = {0};
    Image image = noise(4, 4);
    assert_false(image_write(&image, NULL, "/nowhere/at/all.png", &error));
    assert_non_null(strstr(error.message, "/nowhere/at/all.png"));
    image_destroy(&image);
}

static void test_no_png(void **state)
{
    (void)state;
    Error error = {0};
    Image image = {0};
    assert_false(image_read("/nowhere/at/all.png", &image, &error));
    assert_non_null(strstr(error.message, "/nowhere/at/all.png"));
    assert_false(image_read(SLOSH_SOURCE_DIR "/CMakeLists.txt", &image, &error));
    assert_null(image.rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_nowhere_to_write),
        cmocka_unit_test(test_no_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
