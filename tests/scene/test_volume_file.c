/* Volume data from a header and a raw file. */
#include "tests/scene/scene_text.h"
#include "tests/scratch.h"
#include "tests/tolerance.h"

#include "app/base/program.h"
#include "app/scene/import/import.h"
#include "render/views/pbsr/pbsr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const char whole[] =
    "file: v.raw\nsize: [2, 3, 2]\ntype: int16\nbyte_order: big\nspacing: [0.1, 0.2, 0.3]\n"
    "corner: [1, 2, 3]\nscale: 0.5\noffset: 10\n";

static void headers_are_read(void **state)
{
    (void)state;
    VolumeHeader header;
    Error error = {{0}};
    if (!volume_header_parse("v.yaml", whole, strlen(whole), &header, &error))
        fail_msg("%s", error.message);
    assert_string_equal(header.file, "v.raw");
    check_vector(header.size, 2, 3, 2, 0, "size");
    check_vector(header.spacing, 0.1, 0.2, 0.3, 0, "spacing");
    check_vector(header.corner, 1, 2, 3, 0, "corner");
    assert_int_equal(header.type, VOLUME_INT16);
    assert_int_equal(volume_header_bytes(&header), 24);
}

/* Values of each type and order. */
static void values_are_floats(void **state)
{
    (void)state;
    static const struct {
        VolumeType type;
        int big;
        unsigned char raw[8];
        double first;
    } rows[] = {
        {VOLUME_UINT8, 0, {200}, 200},
        {VOLUME_INT8, 0, {200}, -56},
        {VOLUME_UINT16, 0, {1, 200}, 51201},
        {VOLUME_UINT16, 1, {1, 200}, 456},
        {VOLUME_INT16, 0, {1, 200}, -14335},
        {VOLUME_INT16, 1, {200, 1}, -14335},
        {VOLUME_FLOAT32, 0, {0, 0, 0xc0, 0x3f}, 1.5},
        {VOLUME_FLOAT32, 1, {0x3f, 0xc0, 0, 0}, 1.5},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const VolumeHeader header = {
            .size = {1, 1, 1}, .type = rows[i].type, .big = rows[i].big, .scale = 2, .offset = 3};
        float value;
        volume_values(&header, rows[i].raw, 1, &value);
        check_near((double)value, 3 + 2 * rows[i].first, 0, "a value");
    }
}

static void check_refused(const char *text, const char *says)
{
    VolumeHeader header;
    Error error = {{0}};
    assert_false(volume_header_parse("v.yaml", text, strlen(text), &header, &error));
    if (!strstr(error.message, says))
        fail_msg("%s\nnot: %s", error.message, says);
}

static void wrong_headers_are_refused(void **state)
{
    (void)state;
    check_refused("size: [2, 2, 2]\ntype: int8\nspacing: [1, 1, 1]\n",
                  "v.yaml: 'file' is missing: the raw file");
    check_refused("file: v\nsize: [2, 2, 2]\ntype: double\nspacing: [1, 1, 1]\n", "v.yaml:3:");
    check_refused("file: v\nsizes: [2, 2, 2]\n", "unknown key 'sizes'; did you mean size");
    check_refused("file: v\nsize: [2, 2.5, 2]\ntype: int8\nspacing: [1, 1, 1]\n",
                  "size must be whole numbers, not 2.5");
    check_refused("file: v\nsize: [2, 1, 2]\ntype: int8\nspacing: [1, 1, 1]\n", "v.yaml:2:");
    check_refused("file: v\nsize: [2, 2, 2]\ntype: int8\nspacing: [1, 0, 1]\n", "v.yaml:4:");
    check_refused("file: v\nsize: [2, 2, 2]\ntype: int8\nspacing: [1, 1e-30, 1]\n", "v.yaml:4:");
    check_refused("", "v.yaml:1:1: no volume's header; it has `file:`");
    check_refused("- 1\n", "v.yaml:1:1: no volume's header");
    check_refused("file: v\nsize: [65536, 65536, 2]\ntype: int8\nspacing: [1, 1, 1]\n",
                  "at most 2^32 are read");
}

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void a_raw_file_of_another_length_is_refused(void **state)
{
    (void)state;
    char folder[SCRATCH_SIZE], header[SCRATCH_PATH], raw[SCRATCH_PATH];
    const unsigned char bytes[25] = {0, 2, [23] = 4};
    VolumeData volume;
    float *values;
    Error error = {{0}};
    scratch_folder(folder);
    snprintf(header, sizeof header, "%s/v.yaml", folder);
    snprintf(raw, sizeof raw, "%s/v.raw", folder);
    write_file(header, whole, strlen(whole));
    assert_false(volume_file_load(header, &volume, &values, &error));
    assert_non_null(strstr(error.message, "v.raw: No such file or directory; "));
    assert_non_null(strstr(error.message, "v.yaml says that its values are there"));
    for (size_t size = 23; size <= 25; size += 2) {
        write_file(raw, bytes, size);
        assert_false(volume_file_load(header, &volume, &values, &error));
        assert_non_null(strstr(error.message, "v.yaml says 2 x 3 x 2 values of int16: 24 bytes"));
        assert_null(values);
    }
    write_file(raw, bytes, 24);
    if (!volume_file_load(header, &volume, &values, &error))
        fail_msg("%s", error.message);
    check_near((double)volume.value[0], 11, 0, "the first value");
    check_near((double)volume.value[11], 12, 0, "the last value");
    assert_int_equal(volume.size[1], 3);
    free(values);
}

/* A raw file of so many bytes, which must be refused. */
static void check_raw_refused(const char *folder, const char *raw_name, const char *size, const char *says)
{
    char header[64], text[256];
    VolumeData volume;
    float *values;
    Error error = {{0}};
    snprintf(header, sizeof header, "%s/r.yaml", folder);
    snprintf(text, sizeof text, "file: %s\nsize: %s\ntype: uint8\nspacing: [1, 1, 1]\n", raw_name, size);
    write_file(header, text, strlen(text));
    assert_false(volume_file_load(header, &volume, &values, &error));
    assert_null(values);
    if (!strstr(error.message, says))
        fail_msg("%s\nnot: %s", error.message, says);
    unlink(header);
}

/* Without length, endless, or larger than memory: refused before reading. */
static void a_raw_file_that_cannot_be_read_whole_is_refused(void **state)
{
    (void)state;
    char folder[SCRATCH_SIZE], pipe[SCRATCH_PATH], large[SCRATCH_PATH];
    scratch_folder(folder);
    snprintf(pipe, sizeof pipe, "%s/pipe", folder);
    snprintf(large, sizeof large, "%s/large", folder);
    assert_int_equal(mkfifo(pipe, 0600), 0);
    check_raw_refused(folder, "/dev/zero", "[2, 2, 2]", "/dev/zero: no regular file; ");
    check_raw_refused(folder, "pipe", "[2, 2, 2]", "pipe: no regular file; ");
    check_raw_refused(folder, ".", "[2, 2, 2]", ".: no regular file; ");
    VolumeHeader header;
    Error error = {{0}};
    assert_false(volume_header_load(pipe, &header, &error));
    assert_non_null(strstr(error.message, "pipe: no regular file; a header is read more than once"));
    write_file(large, "", 0);
    if (memory_bytes() < 0x1p34 && truncate(large, (off_t)1 << 32) == 0) /* of holes */
        check_raw_refused(folder, "large", "[65536, 32768, 2]", "no memory for 4294967296 values, 17.2 GB; ");
}

/* More than are read at a time. */
static void long_raw_files_are_read_to_their_end(void **state)
{
    (void)state;
    enum { LONG = 20000 };
    static const char text[] = "file: l.raw\nsize: [2, 2, 5000]\ntype: uint8\nspacing: [1, 1, 1]\n";
    static unsigned char bytes[LONG];
    char folder[SCRATCH_SIZE], header[SCRATCH_PATH], raw[SCRATCH_PATH];
    VolumeData volume;
    float *values;
    Error error = {{0}};
    scratch_folder(folder);
    snprintf(header, sizeof header, "%s/l.yaml", folder);
    snprintf(raw, sizeof raw, "%s/l.raw", folder);
    for (int i = 0; i < LONG; i++)
        bytes[i] = (unsigned char)(i * 7 % 251);
    write_file(header, text, strlen(text));
    write_file(raw, bytes, sizeof bytes);
    if (!volume_file_load(header, &volume, &values, &error))
        fail_msg("%s", error.message);
    for (int i = 0; i < LONG; i++)
        assert_true(values[i] == (float)bytes[i]);
    free(values);
}

/* With the place of the first one. */
static void what_is_no_number_is_refused(void **state)
{
    (void)state;
    static const char text[] = "file: n.raw\nsize: [2, 2, 2]\ntype: float32\nspacing: [1, 1, 1]\n";
    const float bad[] = {NAN, INFINITY};
    char folder[SCRATCH_SIZE], header[SCRATCH_PATH], raw[SCRATCH_PATH];
    scratch_folder(folder);
    snprintf(header, sizeof header, "%s/n.yaml", folder);
    snprintf(raw, sizeof raw, "%s/n.raw", folder);
    write_file(header, text, strlen(text));
    for (int i = 0; i < 2; i++) {
        const float values[8] = {[5] = bad[i]};
        VolumeData volume;
        float *read;
        Error error = {{0}};
        write_file(raw, values, sizeof values);
        assert_false(volume_file_load(header, &volume, &read, &error));
        assert_null(read);
        assert_non_null(strstr(error.message, i ? "n.raw: value 1 0 1 is inf" : "n.raw: value 1 0 1 is nan"));
    }
}

/* Files of a scene's layers: read once, refused with the place. */
static void layers_have_their_files(void **state)
{
    (void)state;
    char folder[SCRATCH_SIZE], header[SCRATCH_PATH], raw[SCRATCH_PATH], text[1024];
    const unsigned char bytes[24] = {0, 2, [23] = 4};
    static Scene scene;
    Error error = {{0}};
    scratch_folder(folder);
    snprintf(header, sizeof header, "%s/v.yaml", folder);
    snprintf(raw, sizeof raw, "%s/v.raw", folder);
    write_file(header, whole, strlen(whole));
    write_file(raw, bytes, sizeof bytes);
    snprintf(text, sizeof text,
             LEAST "view: {kind: pbsr, pbsr: {layers: [{}, {file: %s}]}}\n"
                   "views: [{}, {pbsr: {layers: [{file: %s, of: slice_x}]}}]\n",
             header, header);
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    const PbsrLayer *layers = pbsr_def(&scene.view)->layers;
    assert_null(layers[0].data);
    assert_non_null(layers[1].data);
    check_near((double)layers[1].data->low, 10, 0, "the least value");
    check_near((double)layers[1].data->high, 12, 0, "the greatest value");
    assert_ptr_equal(layers[1].data, pbsr_def(&scene.views[1])->layers[0].data);
    const RangedVolume *before = layers[1].data;
    const struct timespec moment = {.tv_nsec = 20000000}; /* two writes have two times */
    nanosleep(&moment, NULL);
    write_file(raw, (const unsigned char[24]){0, 4, [23] = 4}, sizeof bytes);
    const RangedVolume *after = volume_file_cached(header, &error);
    assert_ptr_not_equal(after, before);
    check_near((double)after->volume.value[0], 12, 0, "a value that was written anew");
    assert_ptr_equal(volume_file_cached(header, &error), after);
    snprintf(text, sizeof text, LEAST "view:\n  pbsr:\n    layers:\n      - {of: torus, file: %s}\n", header);
    assert_refused(text, "scene.yaml:10:27: of a file a layer is a surface");
    assert_refused(LEAST "view: {pbsr: {layers: [{file: none.yaml}]}}\n",
                   "scene.yaml:7:31: No such file or directory: ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_are_read),
        cmocka_unit_test(values_are_floats),
        cmocka_unit_test(wrong_headers_are_refused),
        cmocka_unit_test(a_raw_file_of_another_length_is_refused),
        cmocka_unit_test(a_raw_file_that_cannot_be_read_whole_is_refused),
        cmocka_unit_test(long_raw_files_are_read_to_their_end),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(layers_have_their_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
