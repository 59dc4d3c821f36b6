/* Meshes of a scene: valid files, repairable files, and impossible files. */
#include "tests/mesh_models.h"
#include "tests/scene/scene_text.h"
#include "tests/scratch.h"

#include "app/scene/import/import.h"

#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[SCRATCH_SIZE], scene_path[SCRATCH_PATH];
static Scene scene;
static Notes notes;

static const char *in_folder(const char *name)
{
    static char path[1400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void write_text(const char *name, const char *text)
{
    write_bytes(name, text, strlen(text));
}

static const int corner[12][3] = {{1, 3, 4}, {1, 2, 3}, {5, 7, 6}, {5, 8, 7}, {1, 6, 2}, {1, 5, 6},
                                  {2, 7, 3}, {2, 6, 7}, {3, 8, 4}, {3, 7, 8}, {4, 5, 1}, {4, 8, 5}};

/* A unit box; `faces` of its 12 triangles, turned inwards if so. */
static void write_box(const char *name, int faces, bool inwards)
{
    char text[2000] = "";
    for (int k = 0; k < 8; k++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %d %d %d\n", k % 4 == 1 || k % 4 == 2,
                 k % 4 > 1, k < 4);
    for (int f = 0; f < faces; f++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "f %d %d %d\n", corner[f][0],
                 corner[f][inwards ? 2 : 1], corner[f][inwards ? 1 : 2]);
    write_text(name, text);
}

static void append(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "a");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* Two unit boxes, adjacent along x. */
static void write_beside(const char *name, double apart, bool inwards)
{
    char line[80];
    write_box(name, 12, false);
    for (int k = 0; k < 8; k++) {
        snprintf(line, sizeof line, "v %g %d %d\n", apart + (k % 4 == 1 || k % 4 == 2), k % 4 > 1, k < 4);
        append(name, line);
    }
    for (int f = 0; f < 12; f++) {
        snprintf(line, sizeof line, "f %d %d %d\n", 8 + corner[f][0], 8 + corner[f][inwards ? 2 : 1],
                 8 + corner[f][inwards ? 1 : 2]);
        append(name, line);
    }
}

#define TANK                                                                                                 \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles: {spacing: 0.05}\n"                                                                           \
    "fluids:\n"                                                                                              \
    "  - fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.2, 0.5]}}]\n"

static bool load(const char *text, Error *error)
{
    SceneSettings settings = {0};
    return scene_parse(scene_path, text, strlen(text), &settings, &scene, &notes, error);
}

static bool load_solid(const char *file, Error *error)
{
    char text[1000];
    snprintf(text, sizeof text, TANK "solids:\n  - mesh: {file: %s, scale: 0.3, centre: [0, 0.5, 0]}\n",
             file);
    return load(text, error);
}

static void expect_refusal(const char *file, const char *words)
{
    Error error = {""};
    if (load_solid(file, &error))
        fail_msg("%s is accepted, but should be refused with '%s'", file, words);
    if (!strstr(error.message, words) || !strstr(error.message, "/tank.yaml:6:18: "))
        fail_msg("expected '%s'\n     got '%s'", words, error.message);
}

static void a_mesh_is_found_from_the_scene(void **state)
{
    (void)state;
    Error error = {""};
    write_box("box.obj", 12, false);
    if (!load_solid("box.obj", &error))
        fail_msg("%s", error.message);
    const MeshShape *shape = scene.world.solids[0].mesh.shape;
    assert_int_equal(notes.count, 0);
    assert_float_equal(shape->volume, 1, 1e-6);
    assert_true(load_solid("box.obj", &error));
    assert_ptr_equal(scene.world.solids[0].mesh.shape, shape); /* read once */
    assert_true(load(TANK
                     "  - name: more\n    fill: [{mesh: {file: box.obj, scale: 0.3, centre: [0, 0.5, 0]}}]\n",
                     &error));
    assert_ptr_equal(scene.world.fluids[1].fills[0].mesh.shape, shape);
}

static void expect_note(const char *file, const char *words)
{
    Error error = {""};
    if (!load_solid(file, &error))
        fail_msg("%s", error.message);
    assert_int_equal(notes.count, 1);
    if (!strstr(notes.line[0], words))
        fail_msg("expected '%s'\n     got '%s'", words, notes.line[0]);
}

static void what_is_mended_is_said_once(void **state)
{
    (void)state;
    write_box("inside.obj", 12, true);
    expect_note("inside.obj", "tank.yaml:6:12: inside.obj: the mesh is inside out; its faces are turned");
    write_box("flat.obj", 12, false);
    append("flat.obj", "f 1 1 2\nf 5 8 8\n");
    expect_note("flat.obj", "flat.obj: 2 of its triangles have no area and are left out");
    write_box("two.obj", 12, false);
    append(
        "two.obj",
        "v 0.5 0.4 -1\nv 0.7 0.4 -1\nv 0.6 0.7 -1\nv 0.6 0.5 2\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n");
    expect_note("two.obj", "two.obj: the mesh cuts itself, at ");
    write_box("twice.obj", 12, false);
    append("twice.obj", "f 1 3 4\nf 1 2 3\n");
    expect_note("twice.obj",
                "twice.obj: 2 of its triangles lie on another one with the same corners and are left out");
    write_beside("parts_of.obj", 0.5, false);
    expect_note("parts_of.obj",
                "parts_of.obj: its parts overlap; what any part encloses is solid, and 25 % of "
                "it, which several enclose, weighs once");
    assert_float_equal(scene.world.solids[0].mesh.shape->volume, 1.5, 1e-6);
    write_beside("turned.obj", 3, true);
    expect_note("turned.obj", "turned.obj: 1 of its parts is inside out; its faces are turned");
    assert_float_equal(scene.world.solids[0].mesh.shape->volume, 2, 1e-6);
}

/* Found beside what a scene is a link to; else where was looked is said. A long path is read. */
static void files_beside_links_and_far_down(void **state)
{
    (void)state;
    static char deep[900], named[1000], text[2000];
    Error error = {""};
    char link_path[SCRATCH_PATH + 32];
    mkdir(in_folder("links"), 0700);
    snprintf(link_path, sizeof link_path, "%s/links/here.yaml", folder);
    write_text("tank.yaml", "");
    assert_int_equal(symlink("../tank.yaml", link_path), 0);
    write_box("box.obj", 12, false);
    snprintf(text, sizeof text, TANK "solids:\n  - mesh: {file: box.obj, scale: 0.3, centre: [0, 0.5, 0]}\n");
    SceneSettings settings = {0};
    if (!scene_parse(link_path, text, strlen(text), &settings, &scene, &notes, &error))
        fail_msg("%s", error.message);
    snprintf(text, sizeof text, TANK "solids:\n  - mesh: {file: no.obj, scale: 0.3, centre: [0, 0.5, 0]}\n");
    assert_false(scene_parse(link_path, text, strlen(text), &settings, &scene, &notes, &error));
    assert_non_null(strstr(error.message, "no.obj: No such file or directory: "));
    assert_non_null(strstr(error.message, "/links/no.obj, nor "));
    assert_non_null(strstr(error.message, "/no.obj; name a file that is there, from the scene's folder"));

    assert_false(load_solid("no.obj", &error));
    assert_null(strstr(error.message, ", nor ")); /* of no link */

    for (int k = 0; k < 4; k++) {
        memset(deep + strlen(deep), 'a' + k, 200);
        mkdir(in_folder(deep), 0700);
        strcat(deep, "/");
    }
    snprintf(named, sizeof named, "%sbox.obj", deep);
    write_box("box.obj", 12, false);
    char from[SCRATCH_PATH + 32], to[1400];
    snprintf(from, sizeof from, "%s/box.obj", folder);
    snprintf(to, sizeof to, "%s/%s", folder, named);
    assert_int_equal(rename(from, to), 0);
    snprintf(text, sizeof text, TANK "solids:\n  - mesh: {file: %s, scale: 0.3, centre: [0, 0.5, 0]}\n",
             named);
    if (!load(text, &error))
        fail_msg("%s", error.message);
    assert_string_equal(scene.world.solids[0].mesh.file, named);
}

/* Each part of a file has its own corners. */
static void parts_are_one_mesh(void **state)
{
    (void)state;
    Error error = {{0}};
    Triangles both;
    char text[2000] = "mtllib parts.mtl\n";
    for (int part = 0; part < 2; part++) { /* tetrahedra of 1/6 and 8/6 m3 */
        const int size = 1 + part, from = 3 * part, first = 4 * part;
        const size_t used = strlen(text);
        snprintf(
            text + used, sizeof text - used,
            "usemtl m%d\nv %d 0 0\nv %d 0 0\nv %d %d 0\nv %d 0 %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\n",
            part, from, from + size, from, size, from, size, first + 1, first + 3, first + 2, first + 1,
            first + 2, first + 4, first + 1, first + 4, first + 3, first + 2, first + 3, first + 4);
    }
    write_text("parts.mtl", "newmtl m0\nKd 1 0 0\nnewmtl m1\nKd 0 1 0\n");
    write_text("parts.obj", text);
    if (!mesh_file_read(in_folder("parts.obj"), &both, &error))
        fail_msg("%s", error.message);
    assert_true(fabs(triangles_volume(&both) - 1.5) < 1e-6);
    triangles_free(&both);
}

static void what_cannot_be_had_is_refused(void **state)
{
    (void)state;
    expect_refusal("none.obj", "none.obj: No such file or directory: ");
    write_text("box.xyz", "v 0 0 0\n");
    expect_refusal(
        "box.xyz",
        "box.xyz: its ending is of no format that is read; name a file .obj, .ply, .stl, .gltf or .glb");
    mkdir(in_folder("folder.obj"), 0700);
    expect_refusal("folder.obj", "folder.obj: it is no file; name a file that has a mesh");
    write_box("open.obj", 11, false);
    expect_refusal("open.obj", "open.obj: the mesh is open: 3 edges lack a triangle; ");
    write_text("text.ply", "no mesh\nend_header\n");
    expect_refusal("text.ply", "text.ply: it cannot be read: ");
    write_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expect_refusal("points.obj", "points.obj: it ");
    write_text("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    expect_refusal("nan.obj", " is no finite number; mend the file");
    assert_false(load("box: {size: [1, 1]}\nparticles: {spacing: 0.05}\nfluids:\n"
                      "  - fill: [{mesh: {file: box.obj, centre: [0, 0.5]}}]\n",
                      &(Error){""}));
}

/* In a wrong unit, a mesh is far larger than the box, or vanishes. */
static void a_scale_is_asked_about(void **state)
{
    (void)state;
    static const struct {
        const char *list, *text, *words;
    } scenes[] = {
        {TANK "solids:\n  - mesh: {file: box.obj, scale: 3, centre: [0, 0.5, 0]}\n", ":4:11: ",
         "its fills lie within solids[0]; move one of them. box.obj is 3 m long at its scale of 3; is the scale "
         "right (0.001 where its file counts millimetres)?"},
        {TANK "solids:\n  - mesh: {file: box.obj, scale: 30000, centre: [0, 0.5, 0]}\n",
         ":6:3: ", " smaller solids. box.obj is 3e+04 m long at its scale of 30000; is the scale right"},
        {TANK "solids:\n  - mesh: {file: box.obj, scale: 0.001, centre: [0, 0.5, 0]}\n",
         ":6:11: ", " a smaller spacing. box.obj is 0.001 m long at its scale of 0.001; is the scale right"},
        {TANK "  - name: more\n    fill: [{mesh: {file: box.obj, scale: 300, centre: [0, 0.5, 0]}}]\n",
         ":6:", "the box from -0.5 to 0.5 m. box.obj is 300 m long at its scale of 300; is the scale right"},
        {TANK "  - name: more\n    fill: [{mesh: {file: box.obj, scale: 0.001, centre: [0, 0.51, 0]}}]\n",
         ":6:11: ", " larger fills. box.obj is 0.001 m long at its scale of 0.001; is the scale right"}};
    write_box("box.obj", 12, false);
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        Error error = {""};
        if (load(scenes[k].list, &error))
            fail_msg("scene %zu is accepted", k);
        if (!strstr(error.message, scenes[k].text) || !strstr(error.message, scenes[k].words))
            fail_msg("expected '%s%s'\n     got '%s'", scenes[k].text, scenes[k].words, error.message);
    }
    Error error = {""};
    if (!load(TANK "solids:\n  - mesh: {file: box.obj, scale: 2.5, centre: [0, 1.5, 0]}\n", &error))
        fail_msg("%s", error.message);
    assert_non_null(strstr(notes.line[0],
                           "tank.yaml:6:12: box.obj is 2.5 m long at its scale of 2.5, more than the "
                           "box of 1.73 m from corner to corner; is the scale right"));
    assert_false(load(TANK "solids:\n  - box: {size: [3, 3, 3], centre: [0, 0.5, 0]}\n", &error));
    assert_non_null(strstr(error.message, "its fills lie within solids[0]; move one of them"));
    assert_null(strstr(error.message, "scale"));
}

/* Ten million triangles: sparse files of the full size. */
static void what_is_too_large_is_refused_unread(void **state)
{
    (void)state;
    const uint32_t count = 10000000;
    unsigned char head[84] = {0};
    for (int k = 0; k < 4; k++)
        head[80 + k] = (unsigned char)(count >> 8 * k);
    write_bytes("huge.stl", head, sizeof head);
    assert_int_equal(truncate(in_folder("huge.stl"), 84 + 50 * (off_t)count), 0);
    expect_refusal("huge.stl", "huge.stl: 10,000,000 triangles, more than the 2,000,000 that there may be; ");
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 5\nelement face 10000000\nend_header\n";
    write_bytes("huge.ply", ply, sizeof ply - 1);
    expect_refusal("huge.ply", "huge.ply: 10,000,000 triangles, more than the 2,000,000 that there may be; ");
    write_text("huge.obj", "v 0 0 0\n");
    assert_int_equal(truncate(in_folder("huge.obj"), 600 << 20), 0);
    expect_refusal("huge.obj", "huge.obj: 600 MiB, more than the 256 that there may be; ");
}

static void counts_before_reading(void **state)
{
    (void)state;
    static const char obj[] = "v 0 0 0\nf 1 2 3\nf 1/1 2/2 3/3 4/4\nfoo\nf 1 2",
                      stl[] = "solid a\n facet normal 0\n facet x\n";
    assert_true(mesh_count(MESH_OBJ, obj, sizeof obj - 1, sizeof obj - 1) == 3);
    assert_true(mesh_count(MESH_STL, stl, sizeof stl - 1, sizeof stl - 1) == 2);
    assert_true(mesh_count(MESH_PLY, "element face x\n", 15, 15) == 0);
    assert_true(mesh_count(MESH_GLB, "glTF", 4, 4) == 0);
    assert_int_equal(mesh_format("a/b.c.StL"), MESH_STL);
    assert_int_equal(mesh_format("a/b"), MESH_UNKNOWN);
}

/* assimp would look for the rest for ever. */
static void a_cut_head_is_refused(void **state)
{
    (void)state;
    static const char head[] =
        "ply\nformat ascii 1.0\ncomment end_header\nelement vertex 3\nproperty float x\n"
        "property list uchar int vertex_indices\nend_header";
    for (size_t size = 1; size < sizeof head; size++) {
        write_bytes("cut.ply", head, size);
        expect_refusal("cut.ply", "cut.ply: it has no line end_header and was cut");
        assert_false(mesh_has_head(MESH_PLY, head, size));
    }
    assert_true(mesh_has_head(MESH_PLY, "ply\r\nend_header\r\n", 17));
    assert_true(mesh_has_head(MESH_PLY, "ply\rend_header\r", 15));
    assert_true(mesh_has_head(MESH_OBJ, "", 0));
}

static void a_pipe_is_no_file(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(in_folder("pipe.obj"), 0600), 0);
    expect_refusal("pipe.obj", "pipe.obj: it is no file");
}

/* The same ball in each format. */
static void formats_agree(void **state)
{
    (void)state;
    char names[4][32] = {"ball.stl", "ball.ply", "ball.gltf", "ball.obj"};
    enum { N = 8 };
    Triangles ball = model_room(2 * N * N + 2, 4 * N * N);
    model_ball(&ball, 1, N);
    for (int k = 0; k < 4; k++) {
        FILE *file = fopen(in_folder(names[k]), "wb");
        if (k == 0) {
            const uint32_t count = (uint32_t)ball.triangle_count;
            fwrite((char[80]){"made by a test"}, 80, 1, file);
            fwrite(&count, 4, 1, file);
            for (size_t t = 0; t < count; t++) {
                fwrite((float[3]){0}, 12, 1, file);
                for (int c = 0; c < 3; c++)
                    fwrite(ball.vertex[ball.triangle[t][c]], 12, 1, file);
                fwrite((char[2]){0}, 2, 1, file);
            }
        } else if (k == 1) {
            fprintf(
                file,
                "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
                "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
                ball.vertex_count, ball.triangle_count);
            for (size_t v = 0; v < ball.vertex_count; v++)
                fprintf(file, "%.9g %.9g %.9g\n", ball.vertex[v][0], ball.vertex[v][1], ball.vertex[v][2]);
            for (size_t t = 0; t < ball.triangle_count; t++)
                fprintf(file, "3 %u %u %u\n", ball.triangle[t][0], ball.triangle[t][1], ball.triangle[t][2]);
        } else if (k == 2) {
            const size_t places = 12 * ball.vertex_count, corners = 12 * ball.triangle_count;
            FILE *more = fopen(in_folder("ball.bin"), "wb");
            fwrite(ball.vertex, 1, places, more);
            fwrite(ball.triangle, 1, corners, more);
            fclose(more);
            fprintf(
                file,
                "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
                "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
                "\"buffers\":[{\"uri\":\"ball.bin\",\"byteLength\":%zu}],"
                "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,"
                "\"byteLength\":%zu}],"
                "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\",\"min\":[-1,-1,-1],"
                "\"max\":[1,1,1]},{\"bufferView\":1,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}]}",
                places + corners, places, places, corners, ball.vertex_count, 3 * ball.triangle_count);
        } else {
            for (size_t v = 0; v < ball.vertex_count; v++)
                fprintf(file, "v %.9g %.9g %.9g\n", ball.vertex[v][0], ball.vertex[v][1], ball.vertex[v][2]);
            for (size_t t = 0; t < ball.triangle_count; t++)
                fprintf(file, "f %u %u %u\n", ball.triangle[t][0] + 1, ball.triangle[t][1] + 1,
                        ball.triangle[t][2] + 1);
        }
        fclose(file);
        Error error = {""};
        if (!load_solid(names[k], &error))
            fail_msg("%s: %s", names[k], error.message);
        const MeshShape *shape = scene.world.solids[0].mesh.shape;
        assert_int_equal(shape->triangles.triangle_count, ball.triangle_count);
        assert_int_equal(shape->triangles.vertex_count, ball.vertex_count);
        assert_true(fabs(shape->volume / triangles_volume(&ball) - 1) < 1e-5);
        assert_int_equal(notes.count, 0);
    }
    triangles_free(&ball);
}

static int make_folder(void **state)
{
    (void)state;
    snprintf(scene_path, sizeof scene_path, "%s/tank.yaml", scratch_folder(folder));
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mesh_is_found_from_the_scene),
        cmocka_unit_test(what_is_mended_is_said_once),
        cmocka_unit_test(files_beside_links_and_far_down),
        cmocka_unit_test(parts_are_one_mesh),
        cmocka_unit_test(what_cannot_be_had_is_refused),
        cmocka_unit_test(a_scale_is_asked_about),
        cmocka_unit_test(what_is_too_large_is_refused_unread),
        cmocka_unit_test(counts_before_reading),
        cmocka_unit_test(a_cut_head_is_refused),
        cmocka_unit_test(a_pipe_is_no_file),
        cmocka_unit_test(formats_agree),
    };
    return cmocka_run_group_tests(tests, make_folder, NULL);
}
