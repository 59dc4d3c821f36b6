#define _GNU_SOURCE /* memmem */
/* The scene embedded in a picture: a round trip is exact, and damage or forgery is reported. */
#include "app/files/pictures.h"
#include "app/scene/scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static char *written(const ImageText *text, size_t *size)
{
    Image image;
    Error error = {{0}};
    char *bytes = NULL;
    FILE *file = open_memstream(&bytes, size);
    assert_true(image_create(&image, 3, 2));
    assert_true(image_write_stream(&image, text, file, "a.png", &error));
    fclose(file);
    image_destroy(&image);
    return bytes;
}

static void test_there_and_back(void **state)
{
    (void)state;
    static const char SCENE[] = "# \xc3\xa9t\xc3\xa9\nbox: {size: [1, 1, 1]}\n";
    PictureText text;
    Error error = {{0}};
    size_t size;
    char *bytes = written(&(ImageText){SCENE, "a.yaml", 1.25}, &size);
    assert_true(picture_text_parse("a.png", bytes, size, &text, &error));
    assert_string_equal(text.scene, SCENE);
    assert_string_equal(text.name, "a.yaml");
    assert_true(text.time == 1.25 && text.size == strlen(SCENE));
    free(text.scene);
    for (size_t cut = 0; cut < size; cut++) {
        assert_false(picture_text_parse("a.png", bytes, cut, &text, &error));
        assert_true(strncmp(error.message, "a.png: ", 7) == 0 && !text.scene);
    }
    for (size_t at = 0; at < size; at++) { /* a bit that has fallen over */
        bytes[at] ^= 4;
        assert_false(picture_text_parse("a.png", bytes, size, &text, &error));
        bytes[at] ^= 4;
    }
    free(bytes);
}

static void test_two_scenes(void **state)
{
    (void)state;
    PictureText text;
    Error error = {{0}};
    size_t size;
    char *bytes = written(&(ImageText){"a: 1\n", "a.yaml", 0}, &size);
    char *chunk = memmem(bytes, size, "iTXtslosh scene", 15);
    assert_non_null(chunk);
    chunk -= 4; /* the length comes first, the checksum last */
    const size_t length = 12 + (size_t)(unsigned char)chunk[3], before = (size_t)(chunk - bytes);
    char *twice = malloc(size + length);
    memcpy(twice, bytes, before + length);
    memcpy(twice + before + length, chunk, size - before);
    assert_false(picture_text_parse("a.png", twice, size + length, &text, &error));
    assert_non_null(strstr(error.message, "the picture carries more than one scene"));
    free(twice);
    free(bytes);
}

static void fails(const char *file, const char *words)
{
    char path[1024];
    PictureText text;
    Error error = {{0}};
    snprintf(path, sizeof path, SLOSH_SOURCE_DIR "/tests/fuzz/corpus_picture/%s.png", file);
    assert_false(picture_text_read(path, &text, &error));
    if (!strstr(error.message, words))
        fail_msg("%s: %s", file, error.message);
}

static void test_wrong(void **state)
{
    (void)state;
    PictureText text;
    Error error = {{0}};
    size_t size;
    char *bytes = written(NULL, &size);
    assert_false(picture_text_parse("a.png", bytes, size, &text, &error));
    assert_non_null(strstr(error.message, "a.png: the picture carries no scene; "));
    free(bytes);
    fails("none", "carries no scene; ");
    fails("late", "carries no scene; ");
    fails("large", "carries no scene: ");
    fails("packed", "carries no scene: ");
    fails("crc", "a cut or damaged picture: ");
    fails("cut", "a cut or damaged picture: the file ends too early");
    fails("claims", "a cut or damaged picture: ");
    assert_true(picture_text_read(SLOSH_SOURCE_DIR "/tests/fuzz/corpus_picture/plain.png", &text, &error));
    assert_true(isnan(text.time) && !*text.name);
    free(text.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_there_and_back),
                                       cmocka_unit_test(test_two_scenes), cmocka_unit_test(test_wrong)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
