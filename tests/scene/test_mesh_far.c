/* Meshes far from the file's origin, as in surveys, and transforms of glTF nodes. */
#include "tests/mesh_models.h"
#include "tests/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "app/scene/import/import.h"

#include <string.h>

enum { N = 12 };

static const double far_off[3] = {412345.5, 5651234.25, 120.5}; /* m, of a survey */
static char folder[SCRATCH_SIZE];
static Triangles ball;
static double ball_volume;

static const char *in_folder(const char *name)
{
    static char path[400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static FILE *begin(const char *name)
{
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    return file;
}

static double at(size_t vertex, int k)
{
    return far_off[k] + (double)ball.vertex[vertex][k];
}

static const MeshShape *load(const char *name, MeshState *state)
{
    Error error = {""};
    const MeshShape *shape = mesh_file_load(in_folder(name), state, &error);
    if (!shape)
        fail_msg("%s: %s", name, error.message);
    return shape;
}

static void expect_ball(const char *name)
{
    MeshState state;
    const MeshShape *shape = load(name, &state);
    assert_string_equal(state.coarse, "");
    assert_int_equal(state.triangles.flat, 0);
    assert_int_equal(shape->triangles.vertex_count, ball.vertex_count);
    if (fabs(shape->volume / ball_volume - 1) > 1e-6)
        fail_msg("%s: volume %.9g, not %.9g", name, shape->volume, ball_volume);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(shape->half[k] - 0.5) < 1e-6);
}

typedef enum ObjForm { PLAIN, WITH_W, WITH_COLOUR, WITH_COMMAS, MARKED, OBJ_FORMS } ObjForm;

static void write_obj(const char *name, ObjForm form)
{
    FILE *file = begin(name);
    fputs(form == MARKED ? "\xEF\xBB\xBF" : "", file);
    for (size_t v = 0; v < ball.vertex_count; v++) {
        char line[200];
        const double w = form == WITH_W ? 2 : 1;
        snprintf(line, sizeof line, "%s %.9f %.9f\t%.9f%s", "v", w * at(v, 0), w * at(v, 1), w * at(v, 2),
                 form == WITH_W        ? " 2"
                 : form == WITH_COLOUR ? " 0.5 0.5 0"
                                       : "");
        for (char *c = line; *c && form == WITH_COMMAS; c++)
            *c = *c == '.' ? ',' : *c;
        fprintf(file, "%s\r\n", line);
    }
    for (size_t t = 0; t < ball.triangle_count; t++)
        fprintf(file, "f %u %u %u\n", ball.triangle[t][0] + 1, ball.triangle[t][1] + 1,
                ball.triangle[t][2] + 1);
    fclose(file);
}

static void texts_lose_nothing(void **state)
{
    (void)state;
    for (int form = 0; form < OBJ_FORMS; form++) {
        write_obj("far.obj", (ObjForm)form);
        expect_ball("far.obj");
    }
    FILE *file = begin("far.stl");
    fputs("solid a\n", file);
    for (size_t t = 0; t < ball.triangle_count; t++) {
        fputs("  facet normal 0 0 0\n    outer loop\n", file);
        for (int c = 0; c < 3; c++)
            fprintf(file, "      vertex %.7f %.7f %.7f\n", at(ball.triangle[t][c], 0),
                    at(ball.triangle[t][c], 1), at(ball.triangle[t][c], 2));
        fputs("    endloop\n  endfacet\n", file);
    }
    fputs("endsolid a\n", file);
    fclose(file);
    expect_ball("far.stl");
}

static void put_double(FILE *file, double value, bool big)
{
    unsigned char bytes[8], turned[8];
    memcpy(bytes, &value, 8); /* of this machine: the little end first */
    for (int i = 0; i < 8; i++)
        turned[i] = bytes[7 - i];
    fwrite(big ? turned : bytes, 1, 8, file);
}

static void put_faces(FILE *file, const char *coding)
{
    for (size_t t = 0; t < ball.triangle_count; t++) {
        if (strcmp(coding, "ascii") == 0) {
            fprintf(file, "3 %u %u %u\n", ball.triangle[t][0], ball.triangle[t][1], ball.triangle[t][2]);
            continue;
        }
        fputc(3, file);
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 4; i++)
                fputc((int)(ball.triangle[t][c] >> 8 * (strstr(coding, "big") ? 3 - i : i) & 255), file);
    }
}

/* Not only x, y and z, nor in that order. */
static void write_ply(const char *name, const char *coding, const char *type)
{
    FILE *file = begin(name);
    fprintf(
        file,
        "ply\nformat %s 1.0\ncomment far away\nelement vertex %zu\nproperty uchar red\nproperty %s z\n"
        "property %s x\nproperty %s y\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
        coding, ball.vertex_count, type, type, type, ball.triangle_count);
    for (size_t v = 0; v < ball.vertex_count; v++) {
        const double place[3] = {at(v, 2), at(v, 0), at(v, 1)};
        if (strcmp(coding, "ascii") == 0) {
            fprintf(file, "7 %.9f %.9f %.9f\n", place[0], place[1], place[2]);
            continue;
        }
        fputc(7, file);
        for (int k = 0; k < 3; k++) {
            const float single = (float)place[k];
            if (strcmp(type, "double") == 0)
                put_double(file, place[k], strstr(coding, "big") != NULL);
            else
                fwrite(&single, 1, 4, file);
        }
    }
    put_faces(file, coding);
    fclose(file);
}

static void doubles_lose_nothing(void **state)
{
    (void)state;
    static const char *const coding[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (int k = 0; k < 3; k++) {
        write_ply("far.ply", coding[k], "double");
        expect_ball("far.ply");
    }
    write_ply("far.ply", "ascii", "float"); /* a text's stated size does not round the text */
    expect_ball("far.ply");
}

/* Of what the file has lost already, how much. */
static void floats_say_what_they_lost(void **state)
{
    (void)state;
    MeshState found;
    Error error = {""};
    static const char words[] =
        "it is 5.65e+06 from the origin of its file, whose numbers are 0.5 apart there, and "
        "it is 1 long; move it to the origin in a modeller, or write it as OBJ";
    write_ply("far.ply", "binary_little_endian", "float");
    if (mesh_file_load(in_folder("far.ply"), &found, &error))
        assert_string_equal(found.coarse, words);
    else
        assert_string_equal(error.message, words);
}

/* A glTF with a number of nodes, each with the ball and a transform. */
static void write_gltf(const char *name, const char *nodes, const char *list)
{
    const size_t places = 12 * ball.vertex_count, corners = 12 * ball.triangle_count;
    FILE *more = begin("ball.bin");
    fwrite(ball.vertex, 1, places, more);
    fwrite(ball.triangle, 1, corners, more);
    fclose(more);
    FILE *file = begin(name);
    fprintf(
        file,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],\"nodes\":[%s],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"buffers\":[{\"uri\":\"ball.bin\",\"byteLength\":%zu}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,"
        "\"byteLength\":%zu}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\","
        "\"min\":[-1,-1,-1],\"max\":[1,1,1]},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}]}",
        list, nodes, places + corners, places, places, corners, ball.vertex_count, 3 * ball.triangle_count);
    fclose(file);
}

static void nodes_place_and_mirror(void **state)
{
    (void)state;
    MeshState found;
    write_gltf("far.gltf", "{\"mesh\":0,\"translation\":[412345.5,5651234.25,120.5]}", "0");
    expect_ball("far.gltf");
    write_gltf("mirror.gltf", "{\"mesh\":0,\"scale\":[-1,1,1]}", "0");
    expect_ball("mirror.gltf");
    load("mirror.gltf", &found);
    assert_false(found.triangles.inside_out);
    write_gltf("pair.gltf",
               "{\"mesh\":0},{\"children\":[2],\"translation\":[3,0,0]},{\"mesh\":0,\"scale\":[2,-2,2]}",
               "0,1");
    const MeshShape *pair = load("pair.gltf", &found);
    assert_false(found.triangles.inside_out);
    assert_int_equal(found.triangles.turned, 0);
    assert_true(fabs(pair->volume / (9 * ball_volume) - 1) < 1e-5);
    assert_true(fabs(pair->half[0] - 2.25) < 1e-5);
    write_gltf("far_pair.gltf",
               "{\"mesh\":0,\"translation\":[0,5651234.25,0]},{\"mesh\":0,\"translation\":[3,5651234.25,0]}",
               "0,1");
    load("far_pair.gltf", &found);
    assert_non_null(strstr(found.coarse, "it is 5.65e+06 from the origin of its file"));
}

/* Files of the same places, whose triangles differ, are not the same mesh. */
static void same_places_are_not_the_same_mesh(void **state)
{
    (void)state;
    MeshState found;
    write_gltf("outwards.gltf", "{\"mesh\":0}", "0");
    load("outwards.gltf", &found);
    assert_false(found.triangles.inside_out);
    for (int turns = 0; turns < 2; turns++) {
        for (size_t t = 0; t < ball.triangle_count; t++)
            triangle_turn(&ball, t);
        write_gltf("inwards.gltf", "{\"mesh\":0}", "0");
        load("inwards.gltf", &found);
        assert_int_equal(found.triangles.inside_out, turns == 0);
    }
}

static void marks_are_named(void **state)
{
    (void)state;
    static const struct {
        const char *name, *bytes, *words;
    } files[] = {{"marked.gltf", "\xEF\xBB\xBF{}", "it begins with a byte order mark, which glTF forbids; "},
                 {"wide.obj", "\xFF\xFEv", "it is a text in UTF-16; write it in UTF-8"},
                 {"wide.stl", "\xFE\xFFsolid", "it is a text in UTF-16; write it in UTF-8"}};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        MeshState found;
        Error error = {""};
        FILE *file = begin(files[k].name);
        fputs(files[k].bytes, file);
        fclose(file);
        assert_null(mesh_file_load(in_folder(files[k].name), &found, &error));
        if (!strstr(error.message, files[k].words))
            fail_msg("%s: '%s'", files[k].name, error.message);
    }
}

static int make_folder(void **state)
{
    (void)state;
    scratch_folder(folder);
    ball = model_room(2 * N * N + 2, 4 * N * N);
    model_ball(&ball, 0.5, N);
    ball_volume = triangles_volume(&ball);
    return 0;
}

static int free_ball(void **state)
{
    (void)state;
    triangles_free(&ball);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_lose_nothing),
        cmocka_unit_test(doubles_lose_nothing),
        cmocka_unit_test(floats_say_what_they_lost),
        cmocka_unit_test(nodes_place_and_mirror),
        cmocka_unit_test(same_places_are_not_the_same_mesh),
        cmocka_unit_test(marks_are_named),
    };
    return cmocka_run_group_tests(tests, make_folder, free_ball);
}
