/* Points with normals from PLY files: by bytes, in each format, and what is refused. */
#include "tests/scene/scene_text.h"

#include "app/scene/import/import.h"

#include <stdlib.h>

static const char ascii[] =
    "ply\nformat ascii 1.0\ncomment two points\nelement vertex 2\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nproperty float nx\n"
    "property float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\n"
    "end_header\n1 2 3 255 0 0 1\n-0.5 1e-2 4 0 0 -1 0\n3 0 1 1\n";

static void points_are_read(void **state)
{
    (void)state;
    PointsFile points;
    Error error = {{0}};
    assert_true(points_parse("a.ply", ascii, sizeof ascii - 1, &points, &error));
    assert_int_equal(points.count, 2);
    assert_float_equal(points.place[1][0], -0.5, 0);
    assert_float_equal(points.place[1][1], 0.01, 1e-9);
    assert_float_equal(points.normal[0][2], 1, 0);
    assert_float_equal(points.normal[1][1], -1, 0);
    points_free(&points);
}

/* A point of doubles, shorts and bytes, in both orders of bytes. */
static void binary_points_are_read(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        char bytes[512];
        int used =
            snprintf(bytes, sizeof bytes,
                     "ply\r\nformat binary_%s_endian 1.0\r\nelement vertex 1\r\nproperty double x\r\n"
                     "property short y\r\nproperty int8 z\r\nproperty float32 nx\r\nproperty uchar ny\r\n"
                     "property int nz\r\nend_header\r\n",
                     big ? "big" : "little");
        const struct {
            uint64_t bits;
            int bytes;
        } values[] = {{UINT64_C(0x3FF8000000000000), 8},
                      {0xFFFE, 2},
                      {0xFF, 1},
                      {0x3F000000, 4},
                      {200, 1},
                      {0xFFFFFFFD, 4}};
        for (int v = 0; v < 6; v++)
            for (int k = 0; k < values[v].bytes; k++)
                bytes[used++] = (char)(values[v].bits >> 8 * (big ? values[v].bytes - 1 - k : k) & 0xFF);
        PointsFile points;
        Error error = {{0}};
        if (!points_parse("a.ply", bytes, (size_t)used, &points, &error))
            fail_msg("%s", error.message);
        const float found[6] = {points.place[0][0],  points.place[0][1],  points.place[0][2],
                                points.normal[0][0], points.normal[0][1], points.normal[0][2]};
        const double wanted[6] = {1.5, -2, -1, 0.5, 200, -3};
        for (int k = 0; k < 6; k++)
            assert_float_equal(found[k], wanted[k], 0);
        points_free(&points);
        assert_false(points_parse("a.ply", bytes, (size_t)used - 1, &points, &error));
        assert_string_equal(error.message, "a.ply:10: the file ends before its points do");
    }
}

/* `from` replaced by `to` in the text above. */
static void refused(const char *from, const char *to, const char *message)
{
    char text[1024];
    const char *at = strstr(ascii, from);
    PointsFile points;
    Error error = {{0}};
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - ascii), ascii, to, at + strlen(from));
    assert_false(points_parse("a.ply", text, strlen(text), &points, &error));
    assert_string_equal(error.message, message);
    assert_null(points.place);
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    refused("ply", "plx", "a.ply:1: this is no PLY file; the first line of one is 'ply'");
    refused("ascii", "text", "a.ply:2: the format must be ascii, binary_little_endian or binary_big_endian");
    refused("float nx", "float n",
            "a.ply:14: points with normals have the properties x, y, z, nx, ny and nz");
    refused(
        "float nx", "real nx",
        "a.ply:9: the type of a point's property must be char, uchar, short, ushort, int, uint, float or double");
    refused("element vertex", "element line",
            "a.ply:4: the first element must be the points, 'element vertex NUMBER'");
    refused("-0.5", "half", "a.ply:16: a number of a point is missing here");
    refused("vertex 2", "vertex 3000000000", "a.ply:14: the file ends before its points do");
    refused("end_header", "end",
            "a.ply:18: the header of a PLY file does not end here; it ends with the line end_header");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_read),
        cmocka_unit_test(binary_points_are_read),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
