/* Formats of external programs: the bytes of the file, and the world's frame by hand. */
#include "tests/app/output_fixture.h"

#include "app/files/export.h"

#include <jansson.h>
#include <math.h>

static SnapshotStep some_step(size_t count)
{
    SnapshotStep step;
    assert_true(snapshot_step_allocate(&step, count));
    step.time = 0.1;
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            step.position[k][i] = (float)k + 0.001F * (float)i;
            step.velocity[k][i] = -10 - (float)k - 0.003F * (float)i;
        }
        step.density[i] = 1000 + (float)i;
        step.pressure[i] = -5 * (float)i;
        step.fluid[i] = (int32_t)(i % 3);
        step.id[i] = (int64_t)(count - i);
    }
    return step;
}

/* All of a file; the caller frees it. */
static char *read_all(const char *path, size_t *size)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &status), 0);
    char *bytes = calloc(1, (size_t)status.st_size + 1);
    *size = fread(bytes, 1, (size_t)status.st_size, file);
    assert_int_equal(*size, status.st_size);
    fclose(file);
    return bytes;
}

/* A box turned by 90 degrees about z: the box's x axis points along the world's y, the box's y along the
   world's -x. */
static void the_worlds_frame_by_hand(void **state)
{
    (void)state;
    SnapshotStep step = some_step(2);
    step.box = (BoxState){.position = {1, 2, 3},
                          .orientation = {0, 0, sqrt(0.5), sqrt(0.5)},
                          .velocity = {0.5, 0, -1},
                          .angular_velocity = {0, 0, 2}};
    const float position[2][3] = {{1, 0, 0}, {0, 0.5F, -2}}, velocity[2][3] = {{0, 3, 0}, {0, 0, 0}};
    /* first: arm (0, 1, 0), swirl 2 z x arm = (-2, 0, 0), own velocity (-3, 0, 0)
       second, at rest in the box: arm (-0.5, 0, -2), swirl (0, -1, 0) */
    const float x_world[2][3] = {{1, 3, 3}, {0.5F, 2, 1}}, v_world[2][3] = {{-4.5F, 0, -1}, {0.5F, -1, -1}};
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            step.position[k][i] = position[i][k];
            step.velocity[k][i] = velocity[i][k];
        }
    snapshot_step_to_world(&step);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            assert_true(fabsf(step.position[k][i] - x_world[i][k]) < 1e-6F);
            assert_true(fabsf(step.velocity[k][i] - v_world[i][k]) < 1e-6F);
        }
    assert_true(step.density[1] == 1001 && step.id[0] == 2 && step.count == 2);
    snapshot_step_free(&step);
}

static void write_ply(const SnapshotStep *step, const PointColors *colors)
{
    FILE *file = fopen("a.ply", "wb");
    assert_true(ply_write(file, step, "world", colors));
    assert_int_equal(fclose(file), 0);
}

static void assert_ply_row(const SnapshotStep *step, size_t i, const char *row)
{
    float numbers[8];
    int32_t fluid;
    uint32_t id;
    memcpy(numbers, row, 32);
    memcpy(&fluid, row + 32, 4);
    memcpy(&id, row + 36, 4);
    for (int k = 0; k < 3; k++)
        assert_true(numbers[k] == step->position[k][i] && numbers[3 + k] == step->velocity[k][i]);
    assert_true(numbers[6] == step->density[i] && numbers[7] == step->pressure[i]);
    assert_true(fluid == step->fluid[i] && id == step->id[i]);
}

static void a_ply_is_read_back(void **state)
{
    (void)state;
    static const char head[] = "ply\nformat binary_little_endian 1.0\n"
                               "comment slosh, time 0.10000000000000001 s, frame of the world, SI units\n"
                               "element vertex 1000\nproperty float x\nproperty float y\nproperty float z\n"
                               "property float vx\nproperty float vy\nproperty float vz\n"
                               "property float density\nproperty float pressure\nproperty int fluid\n"
                               "property uint id\n";
    static const char color[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    /* the third fluid is unknown; non-finite and out-of-range numbers are harmless */
    static const PointColors colors = {.count = 2, .color = {{0, 0.5, 1}, {-1, 2, NAN}}};
    static const unsigned char bytes[3][3] = {{0, 128, 255}, {0, 255, 0}, {128, 128, 128}};
    SnapshotStep step = some_step(1000);
    for (int colored = 0; colored < 2; colored++) {
        size_t size, at = strlen(head), width = colored ? 43 : 40;
        write_ply(&step, colored ? &colors : &(PointColors){0});
        char *file = read_all("a.ply", &size);
        assert_memory_equal(file, head, at);
        if (colored) {
            assert_memory_equal(file + at, color, strlen(color));
            at += strlen(color);
        }
        assert_memory_equal(file + at, "end_header\n", 11);
        at += 11;
        assert_int_equal(size, at + 1000 * width);
        for (size_t i = 0; i < 1000; i++) {
            assert_ply_row(&step, i, file + at + i * width);
            if (colored)
                assert_memory_equal(file + at + i * width + 40, bytes[i % 3], 3);
        }
        free(file);
    }
    snapshot_step_free(&step);
}

/* Viridis from dark violet to yellow; the end colours beyond the ends and for non-finite values. */
static void a_ply_is_coloured_by_a_scalar(void **state)
{
    (void)state;
    static const unsigned char first[3] = {0x44, 0x01, 0x54}, last[3] = {0xfd, 0xe7, 0x25};
    static const float density[4] = {950, 1000, 1100, NAN};
    const PointColors colors = {.mapped = true, .scalar = SCALAR_DENSITY, .low = 1000, .high = 1100};
    size_t size;
    SnapshotStep step = some_step(4);
    memcpy(step.density, density, sizeof density);
    write_ply(&step, &colors);
    char *file = read_all("a.ply", &size);
    assert_contains(file, "comment colours: viridis, density from 1000 to 1100 kg/m3\n");
    assert_contains(file, "property uchar blue\nend_header\n");
    for (size_t i = 0; i < 4; i++)
        assert_memory_equal(file + size - 43 * (4 - i) + 40, i == 2 ? last : first, 3);
    step.velocity[0][1] = 3;
    step.velocity[1][1] = 0;
    step.velocity[2][1] = -4;
    assert_true(point_scalar(&step, 1, SCALAR_SPEED) == 5);
    assert_true(point_scalar(&step, 2, SCALAR_PRESSURE) == -10 &&
                point_scalar(&step, 1, SCALAR_DENSITY) == 1000);
    free(file);
    snapshot_step_free(&step);
}

static void an_id_that_ply_cannot_hold_is_refused(void **state)
{
    (void)state;
    Error error = {{0}};
    SnapshotStep step = some_step(3);
    step.id[1] = UINT32_MAX;
    assert_true(ply_check(&step, &error));
    step.id[1] = (int64_t)UINT32_MAX + 1;
    assert_false(ply_check(&step, &error));
    assert_contains(error.message, "the id 4294967296 does not fit into a .ply; write a .vtp");
    step.id[1] = -1;
    assert_false(ply_check(&step, &error));
    snapshot_step_free(&step);
}

static int digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* All bytes of the base64 text at `text`; a non-digit follows. */
static size_t decoded(const char *text, char *out, size_t room)
{
    size_t size = 0;
    unsigned bits = 0, count = 0;
    for (; digit(*text) >= 0; text++) {
        bits = bits << 6 | (unsigned)digit(*text);
        count += 6;
        if (count < 8)
            continue;
        count -= 8;
        assert_true(size < room);
        out[size++] = (char)(bits >> count & 255);
    }
    return size;
}

/* The numbers of the array `name`, of `size` bytes: until the test ends. */
static const char *vtp_array(const char *file, const char *name, uint64_t size)
{
    static char arrays[8][8 + 120000];
    static int next;
    char quoted[64], *data = arrays[next++ % 8];
    uint64_t found;
    snprintf(quoted, sizeof quoted, "Name=\"%s\"", name);
    const char *element = strstr(file, quoted);
    assert_non_null(element);
    assert_int_equal(decoded(strchr(element, '>') + 2, data, sizeof arrays[0]), sizeof found + size);
    memcpy(&found, data, sizeof found);
    assert_int_equal(found, size);
    return data + sizeof found;
}

static void assert_vtp_holds(const SnapshotStep *step, const char *file)
{
    const size_t count = step->count;
    const char *points = vtp_array(file, "Points", 12 * count);
    const char *velocity = vtp_array(file, "velocity", 12 * count);
    const char *connectivity = vtp_array(file, "connectivity", 4 * count);
    const char *offsets = vtp_array(file, "offsets", 4 * count);
    assert_memory_equal(vtp_array(file, "density", 4 * count), step->density, 4 * count);
    assert_memory_equal(vtp_array(file, "pressure", 4 * count), step->pressure, 4 * count);
    assert_memory_equal(vtp_array(file, "fluid", 4 * count), step->fluid, 4 * count);
    assert_memory_equal(vtp_array(file, "id", 8 * count), step->id, 8 * count);
    for (size_t i = 0; i < count; i++) {
        const int32_t vertex = (int32_t)i, end = vertex + 1;
        for (size_t k = 0; k < 3; k++) {
            assert_memory_equal(points + 12 * i + 4 * k, &step->position[k][i], 4);
            assert_memory_equal(velocity + 12 * i + 4 * k, &step->velocity[k][i], 4);
        }
        assert_memory_equal(connectivity + 4 * i, &vertex, 4);
        assert_memory_equal(offsets + 4 * i, &end, 4);
    }
}

/* Few, none, and more than goes through its buffer at once. */
static void a_vtp_is_read_back(void **state)
{
    (void)state;
    static const size_t counts[] = {3, 0, 1, 4096, 10000};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        size_t size;
        SnapshotStep step = some_step(counts[k]);
        FILE *out = fopen("a.vtp", "wb");
        assert_true(vtp_write(out, &step));
        assert_int_equal(fclose(out), 0);
        char *file = read_all("a.vtp", &size);
        assert_contains(file,
                        "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.10000000000000001<");
        assert_vtp_holds(&step, file);
        assert_memory_equal(file + size - 23, "</PolyData>\n</VTKFile>\n", 23);
        free(file);
        snapshot_step_free(&step);
    }
}

/* A tetrahedron. */
static Surface some_surface(void)
{
    static const uint32_t corners[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    Surface surface = {.vertices = some_step(4), .triangle_count = 4};
    surface.triangle = malloc(sizeof corners);
    memcpy(surface.triangle, corners, sizeof corners);
    for (int k = 0; k < 3; k++) {
        surface.normal[k] = malloc(4 * sizeof(float));
        for (int i = 0; i < 4; i++)
            surface.normal[k][i] = (float)(k == i % 3);
    }
    return surface;
}

static void a_surface_as_ply_is_read_back(void **state)
{
    (void)state;
    static const char head[] = "ply\nformat binary_little_endian 1.0\n"
                               "comment slosh, time 0.10000000000000001 s, frame of the box, SI units\n"
                               "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property float vx\nproperty float vy\nproperty float vz\n"
                               "property float density\nproperty float pressure\nproperty int fluid\n"
                               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    static const PointColors colors = {.count = 1, .color = {{0, 0.5, 1}}};
    enum { VERTEX = 51, FACE = 13 };
    size_t size;
    Surface surface = some_surface();
    FILE *out = fopen("a.ply", "wb");
    assert_true(ply_write_surface(out, &surface, "box", &colors));
    assert_int_equal(fclose(out), 0);
    char *file = read_all("a.ply", &size);
    const char *row = file + strlen(head);
    assert_int_equal(size, strlen(head) + (size_t)4 * VERTEX + (size_t)4 * FACE);
    assert_memory_equal(file, head, strlen(head));
    for (size_t i = 0; i < 4; i++, row += VERTEX) {
        for (size_t k = 0; k < 3; k++) {
            assert_memory_equal(row + 4 * k, &surface.vertices.position[k][i], 4);
            assert_memory_equal(row + 12 + 4 * k, &surface.normal[k][i], 4);
            assert_memory_equal(row + 24 + 4 * k, &surface.vertices.velocity[k][i], 4);
        }
        assert_memory_equal(row + 36, &surface.vertices.density[i], 4);
        assert_memory_equal(row + 40, &surface.vertices.pressure[i], 4);
        assert_memory_equal(row + 44, &surface.vertices.fluid[i], 4);
        assert_memory_equal(row + 48, i % 3 == 0 ? "\0\200\377" : "\200\200\200", 3);
    }
    for (size_t i = 0; i < 4; i++, row += FACE) {
        assert_int_equal(row[0], 3);
        assert_memory_equal(row + 1, surface.triangle[i], 12);
    }
    free(file);
    surface_free(&surface);
}

static void a_surface_as_vtp_is_read_back(void **state)
{
    (void)state;
    static const int32_t ends[4] = {3, 6, 9, 12};
    size_t size;
    Surface surface = some_surface();
    const SnapshotStep *step = &surface.vertices;
    FILE *out = fopen("a.vtp", "wb");
    assert_true(vtp_write_surface(out, &surface));
    assert_int_equal(fclose(out), 0);
    char *file = read_all("a.vtp", &size);
    assert_contains(file, "NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                          "NumberOfPolys=\"4\"");
    assert_contains(file, "<PointData Vectors=\"velocity\" Scalars=\"density\" Normals=\"Normals\">");
    assert_memory_equal(vtp_array(file, "connectivity", 48), surface.triangle, 48);
    assert_memory_equal(vtp_array(file, "offsets", 16), ends, 16);
    assert_memory_equal(vtp_array(file, "density", 16), step->density, 16);
    assert_memory_equal(vtp_array(file, "pressure", 16), step->pressure, 16);
    assert_memory_equal(vtp_array(file, "fluid", 16), step->fluid, 16);
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 3; k++) {
            assert_memory_equal(vtp_array(file, "Points", 48) + 12 * i + 4 * k, &step->position[k][i], 4);
            assert_memory_equal(vtp_array(file, "velocity", 48) + 12 * i + 4 * k, &step->velocity[k][i], 4);
            assert_memory_equal(vtp_array(file, "Normals", 48) + 12 * i + 4 * k, &surface.normal[k][i], 4);
        }
    assert_memory_equal(file + size - 23, "</PolyData>\n</VTKFile>\n", 23);
    free(file);
    surface_free(&surface);
}

static void a_series_of_ply_has_an_index_in_json(void **state)
{
    (void)state;
    static const double times[] = {0, 0.1};
    char text[1024] = "";
    FILE *file = fopen("a.ply.series", "w+");
    assert_true(export_index_series(file, &(ExportIndex){"x/a \"b\"", ".ply", 2, 2, times, 0, NULL}));
    rewind(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    json_t *index = json_loads(text, 0, NULL);
    assert_non_null(index);
    assert_string_equal(json_string_value(json_object_get(index, "file-series-version")), "1.0");
    const json_t *second = json_array_get(json_object_get(index, "files"), 1);
    assert_string_equal(json_string_value(json_object_get(second, "name")), "a \"b\"/a \"b\"-0001.ply");
    assert_true(json_real_value(json_object_get(second, "time")) == 0.1);
    json_decref(index);
    file = fopen("a.ply.series", "w+");
    assert_false(
        export_index_series(file, &(ExportIndex){"\xff", ".ply", 2, 2, times, 0, NULL})); /* not UTF-8 */
    fclose(file);
    file = fopen("/dev/full", "w");
    setbuf(file, NULL);
    assert_false(export_index_series(file, &(ExportIndex){"a", ".ply", 2, 2, times, 0, NULL}));
    fclose(file);
}

static void the_index_names_its_files(void **state)
{
    (void)state;
    static const double times[] = {0, 0.1};
    char name[64], text[1024] = "";
    export_index_name("some/where/fluid", 7, 10000, ".vtp", name, sizeof name);
    assert_string_equal(name, "fluid-0007.vtp");
    export_index_name("fluid", 7, 10001, ".ply", name, sizeof name);
    assert_string_equal(name, "fluid-00007.ply");
    export_index_name("fluid", 12345, 0, ".ply", name,
                      sizeof name); /* not known: at least as many as it has */
    assert_string_equal(name, "fluid-12345.ply");
    FILE *file = fopen("a.pvd", "w+");
    assert_true(export_index_pvd(file, &(ExportIndex){"x/a&<b>\"", ".vtp", 2, 2, times, 0, NULL}));
    rewind(file);
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    assert_contains(text, "<DataSet timestep=\"0\" group=\"\" part=\"0\" "
                          "file=\"a&#38;&#60;b&#62;&#34;/a&#38;&#60;b&#62;&#34;-0000.vtp\"/>\n"
                          "<DataSet timestep=\"0.10000000000000001\"");
}

static void a_failed_stream_is_told(void **state)
{
    (void)state;
    SnapshotStep step = some_step(10000);
    FILE *file = fopen("/dev/full", "wb");
    assert_false(vtp_write(file, &step));
    fclose(file);
    file = fopen("/dev/full", "wb");
    assert_false(ply_write(file, &step, "box", &(PointColors){0}));
    fclose(file);
    Surface surface = some_surface();
    for (int k = 0; k < 2; k++) {
        file = fopen("/dev/full", "wb");
        setbuf(file, NULL);
        assert_false(k == 0 ? vtp_write_surface(file, &surface)
                            : ply_write_surface(file, &surface, "box", &(PointColors){0}));
        fclose(file);
    }
    surface_free(&surface);
    snapshot_step_free(&step);
}

/* A format is a file or a series of files of another format; its name is told from all others. */
static void formats_are_whole(void **state)
{
    (void)state;
    for (int i = 0; export_format_at(i); i++) {
        const ExportFormat *format = export_format_at(i);
        char name[64];
        snprintf(name, sizeof name, "x.%s", format->extension);
        assert_ptr_equal(export_format_find(name, format->holds, NULL), format);
        assert_true(format->help && !format->write == !!format->each && !format->index == !format->each);
        assert_true(!format->each || format->each->colored == format->colored);
        assert_true(!format->each || (format->holds & ~format->each->holds) == 0);
        for (int j = 0; j < i; j++) /* no two formats for the same */
            assert_true(strcmp(export_format_at(j)->extension, format->extension) != 0 ||
                        (export_format_at(j)->holds & format->holds) == 0);
    }
}

static void the_extension_says_what_is_written(void **state)
{
    (void)state;
    static const char *const others[] = {"a",  "a.h5part", ".ply",   "a.vtp/b",  "",
                                         "a.", "a.plyx",   "b/.vtp", "a.series", ".ply.series"};
    Error error = {{0}};
    static const char *const names[][2] = {
        {"a.b/c.PVD", "pvd"}, {"a.vtp", "vtp"}, {"a.vtp.ply", "ply"}, {"b/a.ply.Series", "ply.series"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_string_equal(export_format_find(names[i][0], EXPORT_SNAPSHOT, &error)->extension, names[i][1]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        assert_null(export_format_find(others[i], EXPORT_SNAPSHOT, &error));
        assert_contains(error.message, "format from");
        assert_contains(error.message, "use .pvd, .vtp, .ply, .ply.series, .obj or .obj.series");
        assert_null(export_format_find(others[i], EXPORT_SLICE, &error));
        assert_contains(error.message, "format of a slice from");
        assert_contains(error.message, "use .vti, .csv or .pvd");
        assert_null(export_format_find(others[i], EXPORT_LINES, &error));
        assert_contains(error.message, "use .vtp");
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_worlds_frame_by_hand),
        TEST(a_ply_is_read_back),
        TEST(a_ply_is_coloured_by_a_scalar),
        TEST(an_id_that_ply_cannot_hold_is_refused),
        TEST(a_vtp_is_read_back),
        TEST(a_surface_as_ply_is_read_back),
        TEST(a_surface_as_vtp_is_read_back),
        TEST(a_series_of_ply_has_an_index_in_json),
        TEST(the_index_names_its_files),
        TEST(a_failed_stream_is_told),
        TEST(formats_are_whole),
        TEST(the_extension_says_what_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
