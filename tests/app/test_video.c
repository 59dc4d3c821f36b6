/* Videos by ffmpeg, folders of frames, single pictures. */
#include "tests/app/output_fixture.h"

#include "app/files/pictures.h"

#include <signal.h>

/* One colour, different from frame to frame. */
static Image plain_image(int width, int height, int frame)
{
    Image image;
    const uint8_t color[3] = {200, (uint8_t)(40 + 20 * frame), 60};
    assert_true(image_create(&image, width, height));
    for (int i = 0; i < 3 * width * height; i++)
        image.rgb[i] = color[i % 3];
    return image;
}

/* What ffprobe says about the file. */
static void probe(const char *path, char text[256])
{
    char command[512];
    snprintf(command, sizeof command,
             "ffprobe -v error -count_frames -select_streams v -show_entries "
             "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 '%s' 2>&1",
             path);
    FILE *pipe = popen(command, "r"); /* NOLINT(cert-env33-c): a test */
    assert_non_null(pipe);
    text[fread(text, 1, 255, pipe)] = '\0';
    text[strcspn(text, "\n")] = '\0';
    assert_int_equal(pclose(pipe), 0);
}

static void write_pictures(const char *path, int width, int height, int frames)
{
    Error error = {{0}};
    Pictures *pictures = pictures_create(path, width, height, 25, 0, &error);
    if (!pictures)
        fail_msg("%s", error.message);
    for (int k = 0; k < frames; k++) {
        Image image = plain_image(width, height, k);
        if (!pictures_add(pictures, &image, &error))
            fail_msg("%s", error.message);
        image_destroy(&image);
    }
    if (!pictures_finish(pictures, &error))
        fail_msg("%s", error.message);
}

static void a_video_has_all_frames(void **state)
{
    (void)state;
    char text[256];
    write_pictures("a.mp4", 64, 48, 7);
    probe("a.mp4", text);
    assert_string_equal(text, "h264,64,48,yuv420p,25/1,7");
    assert_int_equal(count_files("."), 1);
}

/* Names that ffmpeg would take for a protocol, an option, a pattern or a pipe. */
static void any_name_is_a_files(void **state)
{
    (void)state;
    static const char *const names[] = {"12:30.mp4", "-dash.mp4", "http:x.gif", "pipe:1.mp4", "a:b.gif",
                                        "%03d.mp4",  ".h:x.mp4",  "|cat.mp4",   "file:a.gif", "a#b? c.mp4"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[64], text[256];
        write_pictures(names[k], 16, 16, 2);
        snprintf(path, sizeof path, "./%s", names[k]);
        assert_true(exists(path));
        probe(path, text);
        assert_non_null(strstr(text, "16,16,"));
    }
    assert_int_equal(count_files("."), (int)(sizeof names / sizeof *names));
}

static void odd_sizes_become_even(void **state)
{
    (void)state;
    char text[256];
    write_pictures("odd.mp4", 65, 47, 2);
    probe("odd.mp4", text);
    assert_string_equal(text, "h264,66,48,yuv420p,25/1,2");
    write_pictures("one.mp4", 1, 1, 1);
    probe("one.mp4", text);
    assert_string_equal(text, "h264,2,2,yuv420p,25/1,1");
}

/* Colours survive a round trip, also in the column and row added for odd sizes. */
static void colours_survive(void **state)
{
    (void)state;
    enum { BYTES = 3 * 66 * 48 };
    uint8_t rgb[BYTES + 1];
    const int expected[3] = {200, 40, 60};
    write_pictures("a.mp4", 65, 47, 1);
    FILE *pipe =
        popen("ffmpeg -v error -i a.mp4 -f rawvideo -pix_fmt rgb24 -", "r"); /* NOLINT(cert-env33-c) */
    assert_non_null(pipe);
    assert_int_equal(fread(rgb, 1, BYTES + 1, pipe), BYTES);
    assert_int_equal(pclose(pipe), 0);
    for (int i = 0; i < BYTES; i++)
        assert_in_range(rgb[i], expected[i % 3] - 4, expected[i % 3] + 4);
}

static void an_old_video_stays_until_the_new_one_is_whole(void **state)
{
    (void)state;
    Error error = {{0}};
    Image image = plain_image(16, 16, 0);
    write_text("a.mp4", "old");
    Video *video = video_create("a.mp4", 16, 16, 30, &error);
    assert_non_null(video);
    assert_true(video_add(video, image.rgb, &error));
    video_discard(video);
    assert_text("a.mp4", "old");
    video = video_create("a.mp4", 16, 16, 30, &error);
    assert_false(video_finish(video, &error));
    assert_contains(error.message, "no picture was made");
    assert_text("a.mp4", "old");
    assert_int_equal(count_files("."), 1);
    image_destroy(&image);
}

static void copy_path(char path[4000])
{
    const char *value = getenv("PATH");
    snprintf(path, 4000, "%s", value ? value : "");
}

static void missing_ffmpeg_is_said(void **state)
{
    (void)state;
    Error error = {{0}};
    char path[4000];
    copy_path(path);
    setenv("PATH", "/nowhere", 1);
    Video *video = video_create("a.mp4", 16, 16, 30, &error);
    setenv("PATH", path, 1);
    assert_null(video);
    assert_contains(error.message, "install the package ffmpeg");
    assert_int_equal(count_files("."), 0);
}

/* A stand-in for ffmpeg with a chosen exit; the error of a long video. */
static void fail_with(const char *script, Error *error)
{
    char path[4096], old[4000];
    copy_path(old);
    Image image = plain_image(640, 480, 0);
    write_text("ffmpeg", script);
    chmod("ffmpeg", 0755);
    snprintf(path, sizeof path, ".:%s", old);
    setenv("PATH", path, 1);
    Video *video = video_create("a.mp4", 640, 480, 30, error);
    setenv("PATH", old, 1);
    assert_non_null(video);
    bool added = true;
    for (int k = 0; k < 50 && added; k++)
        added = video_add(video, image.rgb, error);
    assert_false(added && video_finish(video, error));
    if (!added)
        video_discard(video);
    unlink("ffmpeg");
    assert_int_equal(count_files("."), 0);
    image_destroy(&image);
}

static void a_dying_ffmpeg_is_quoted(void **state)
{
    (void)state;
    Error error = {{0}};
    signal(SIGPIPE, SIG_IGN);
    fail_with("#!/bin/sh\nhead -c 100000 > /dev/null; echo first >&2; echo it hurts >&2; exit 3\n", &error);
    assert_string_equal(error.message, "a.mp4: ffmpeg could not write the video: it hurts");
    fail_with("#!/bin/sh\ncat > /dev/null; exit 3\n", &error);
    assert_string_equal(error.message, "a.mp4: ffmpeg ended early, with exit code 3");
    fail_with("#!/bin/sh\nkill -9 $$\n", &error);
    assert_contains(error.message, "ffmpeg was ended by signal 9 (Killed)");
}

static void the_name_says_what_to_write(void **state)
{
    (void)state;
    PicturesKind kind;
    Error error = {{0}};
    assert_true(pictures_kind("a/b.c/x.png", &kind, &error));
    assert_int_equal(kind, PICTURES_PNG);
    assert_true(pictures_kind("X.MP4", &kind, &error));
    assert_int_equal(kind, PICTURES_VIDEO);
    const char *const folders[] = {"frames", "a.b/frames", "a.png/", ".", "..", "./.hidden"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        assert_true(pictures_kind(folders[i], &kind, &error));
        assert_int_equal(kind, PICTURES_FOLDER);
    }
    const char *const wrong[] = {"a.jpg", "a.webm", "a.png.", "", "a.mp4x"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_false(pictures_kind(wrong[i], &kind, &error));
    assert_contains(error.message, "use .png, .mp4, .gif or a folder name");
}

static void a_folder_gets_numbered_frames(void **state)
{
    (void)state;
    Image image;
    Error error = {{0}};
    write_pictures("frames", 8, 6, 3);
    write_pictures("frames/", 8, 6, 2); /* again, into the same */
    assert_int_equal(count_files("frames"), 3);
    assert_true(image_read("frames/frame_00002.png", &image, &error));
    assert_int_equal(image.width, 8);
    assert_int_equal(image.rgb[1], 80);
    image_destroy(&image);
    write_text("file", "");
    assert_null(pictures_create("file", 8, 6, 30, 0, &error));
    assert_contains(error.message, "is a file, not a folder");
    assert_null(pictures_create("missing/frames", 8, 6, 30, 0, &error));
    assert_contains(error.message, "cannot be created: No such file or directory");
    Pictures *none = pictures_create("empty", 8, 6, 30, 0, &error);
    assert_non_null(none);
    pictures_discard(none);
    assert_false(exists("empty"));
    Image one = plain_image(8, 6, 0); /* numbers as wide as the last one's */
    Pictures *many = pictures_create("many", 8, 6, 30, 100001, &error);
    assert_non_null(many);
    assert_true(pictures_add(many, &one, &error) && pictures_finish(many, &error));
    assert_true(exists("many/frame_000000.png"));
    image_destroy(&one);
}

static void a_png_appears_when_whole(void **state)
{
    (void)state;
    Error error = {{0}};
    Image image = plain_image(8, 6, 0);
    Pictures *pictures = pictures_create("a.png", 8, 6, 30, 0, &error);
    assert_true(pictures_add(pictures, &image, &error));
    assert_false(exists("a.png"));
    assert_true(pictures_finish(pictures, &error));
    assert_true(exists("a.png"));
    pictures = pictures_create("b.png", 8, 6, 30, 0, &error);
    assert_true(pictures_add(pictures, &image, &error));
    pictures_discard(pictures);
    assert_int_equal(count_files("."), 1);
    image_destroy(&image);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_video_has_all_frames),
        TEST(any_name_is_a_files),
        TEST(odd_sizes_become_even),
        TEST(colours_survive),
        TEST(an_old_video_stays_until_the_new_one_is_whole),
        TEST(missing_ffmpeg_is_said),
        TEST(a_dying_ffmpeg_is_quoted),
        TEST(the_name_says_what_to_write),
        TEST(a_folder_gets_numbered_frames),
        TEST(a_png_appears_when_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
