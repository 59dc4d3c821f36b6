/* Tables of heights and velocities at the start: valid and invalid files. */
#include "tests/scene/scene_text.h"
#include "tests/scratch.h"

#include "app/scene/import/import.h"
#include "sim/start/start.h"

#include <math.h>
#include <stdlib.h>

static FieldTable *parse(const char *text, const FieldFileKind *kind, Error *error)
{
    error->message[0] = '\0';
    return field_file_parse("t.csv", text, strlen(text), kind, error);
}

static FieldTable *parse_good(const char *text, const FieldFileKind *kind)
{
    Error error;
    FieldTable *table = parse(text, kind, &error);
    if (!table)
        fail_msg("%s", error.message);
    return table;
}

static void expect(const FieldTable *table, int column, double x, double y, double z, double value)
{
    const double is = field_table_at(table, column, (double[]){x, y, z});
    if (!(fabs(is - value) < 1e-12))
        fail_msg("%g at %g %g %g, not %g", is, x, y, z, value);
}

/* Linear between places, constant beyond; rows and columns in any order, planes unevenly spaced. */
static void heights_along_x(void **state)
{
    (void)state;
    FieldTable *table = parse_good("\xef\xbb\xbf# Of an experiment, 2026\r\n\r\nheight (m), x (m)\r\n"
                                   "0.3,1\r\n0.2 , 0\r\n 0.7,3\r\n",
                                   &field_file_heights);
    expect(table, 0, 0, 5, -7, 0.2);
    expect(table, 0, 0.25, 0, 0, 0.225);
    expect(table, 0, 2, 0, 0, 0.5);
    expect(table, 0, 3, 0, 0, 0.7);
    expect(table, 0, -1, 0, 0, 0.2);
    expect(table, 0, 9, 0, 0, 0.7);
    field_file_free(table);
}

/* As written by spreadsheets of further languages. */
static void semicolons_and_quotes(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x (m);z (m);height (m)\n0;0;0,25\n1;0;0,75\n0;2;0.25\n1;2;0.75\n",
        "\"x (m)\",\"z (m)\",\"height (m)\"\r\n\"0\",0,\"0.25\"\r\n1, \"0\" ,0.75\r\n0,2,0.25\r\n1,2,0.75\r\n",
        "\"x\";\"z\";\"height\"\n\"0\";\"0\";\"0,25\"\n1;0;0,75\n0;2;0,25\n1;2;0,75\n",
        "x\tz\theight (m)\n0\t0\t0,25\n1\t0\t0.75\n0\t2\t0.25\n1\t2\t0.75\n"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        FieldTable *table = parse_good(texts[k], &field_file_heights);
        expect(table, 0, 0.5, 0, 1, 0.5);
        expect(table, 0, 1, 0, 2, 0.75);
        field_file_free(table);
    }
    Error error = {""};
    assert_null(
        parse("x,height\n0,\"1,234\"\n1,2\n", &field_file_heights, &error)); /* a thousand, or little more */
    assert_non_null(strstr(error.message, ":2: '1,234' is no number; "));
    assert_null(parse("x;height\n0;1\n1,5;2;3\n", &field_file_heights, &error));
    assert_non_null(strstr(error.message, ":3: more than 2 cells; "));
}

/* Fields linear along each axis are interpolated exactly. */
static void velocities_of_a_grid(void **state)
{
    (void)state;
    static const double places[3][3] = {{-1, 0, 0.5}, {0, 0.1, 2}, {-3, -2, 4}};
    char text[4096] = "vz,vx,z,y,x\n";
    for (int n = 0; n < 27; n++) {
        const double x = places[0][n % 3], y = places[1][n / 3 % 3], z = places[2][n / 9];
        snprintf(text + strlen(text), sizeof text - strlen(text), "%.17g,%.17g,%g,%g,%g\n", 2 * x - y + z,
                 x * y * z, z, y, x);
    }
    FieldTable *table = parse_good(text, &field_file_velocities);
    assert_null(table->value[1]);
    expect(table, 2, 0.3, 1.7, 0.9, 2 * 0.3 - 1.7 + 0.9);
    expect(table, 2, -0.25, 0.05, -2.75, -0.5 - 0.05 - 2.75);
    expect(table, 0, -1, 2, 4, -8);
    expect(table, 0, -0.5, 0.1, -2, 0.1); /* on a line of the grid */
    expect(table, 2, 7, -7, 7, 1 + 4);
    field_file_free(table);
}

static const struct Bad {
    const char *text, *message;
} bad[] = {
    {"", "t.csv: has no line; the first one names columns of x, z; height"},
    {"# nothing\n\n", "t.csv: has no line;"},
    {"x,height\n", "t.csv: has no row behind the names of its columns; write one a place"},
    {"x,height\n0,1\n", "t.csv: x is 0 in all rows; two places are needed, or no column x"},
    {"x,height\n0,1\n0,2\n", "t.csv: x is 0 in all rows;"},
    {"0,1\n1,2\n", "t.csv:1: no column '0' is known; the first line names columns of x, z; height"},
    {"x,y,height\n", "t.csv:1: no column 'y' is known;"},
    {"# a\nx,height,x\n", "t.csv:2: two columns 'x'; name each once"},
    {"height\n1\n", "t.csv:1: a coordinate and a quantity are needed; name columns of x, z; height"},
    {"x,z\n1,1\n", "t.csv:1: a coordinate and a quantity are needed;"},
    {"x (mm),height\n", "t.csv:1: 'x' in '(mm)'; its unit is (m)"},
    {"x (m,height\n", "t.csv:1: 'x' in '(m'; its unit is (m)"},
    {"x,height\n0,1\n1\n", "t.csv:3: 1 cell; the first line names 2 columns"},
    {"x,height\n0,1\n1,2,3\n", "t.csv:3: more than 2 cells; the first line names 2 columns"},
    {"x,height\n0,1\n\n1,nan\n", "t.csv:4: 'nan' is no number; write one such as 0.25"},
    {"x,height\n0,1\n1,inf\n", "t.csv:3: 'inf' is no number;"},
    {"x,height\n0,1\n1e999,2\n", "t.csv:3: '1e999' is no number;"},
    {"x,height\n0,1\n1,\n", "t.csv:3: '' is no number;"},
    {"x,height\n0,1\n1,2 m\n", "t.csv:3: '2 m' is no number;"},
    {"x,height\n0,1\n1;2\n", "t.csv:3: '1;2' is no number;"},
    {"x,height\n0,1\n1,2\n0,3\n", "t.csv:4: a second row for x 0, which line 2 has; leave one out"},
    {"x,z,height\n0,0,1\n1,0,2\n0,1,3\n",
     "t.csv: has no row for x 1, z 1; a grid has one for each of its 2 x 1 x 2 places"},
};

static void bad_files_are_told(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        Error error;
        FieldTable *table = parse(bad[k].text, &field_file_heights, &error);
        if (table || strncmp(error.message, bad[k].message, strlen(bad[k].message)) != 0)
            fail_msg("expected '%s'\n     got '%s'", bad[k].message, table ? "a table" : error.message);
    }
}

/* --- of a scene --- */

static char folder[SCRATCH_SIZE];
static char scene_path[SCRATCH_PATH];

static void write_file(const char *name, const char *text)
{
    char path[SCRATCH_PATH];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static Scene scene;
static Notes notes;

static bool load(const char *text, Error *error)
{
    error->message[0] = '\0';
    return scene_parse(scene_path, text, strlen(text), NULL, &scene, &notes, error);
}

#define TANK                                                                                                 \
    "box: {size: [1, 1]}\n"                                                                                  \
    "particles: {spacing: 0.05}\n"                                                                           \
    "fluids:\n"                                                                                              \
    "  - velocity_table: flow.csv\n"                                                                         \
    "    fill: [{block: {min: [-0.5, 0], max: [0.5, 1]}, below: heights.csv}]\n"

/* Found from the scene's folder; no notes with enough places, beyond the table a line each. */
static void tables_of_a_scene(void **state)
{
    (void)state;
    Error error;
    write_file("heights.csv", "x (m),height (m)\n-0.5,0.2\n0.5,0.6\n");
    write_file("flow.csv", "y,vx\n0,0\n1,2\n");
    if (!load(TANK, &error))
        fail_msg("%s", error.message);
    double end = 0;
    assert_true(fill_ends(&scene.world.fluids[0].fills[0], 0.25, 0, &end));
    assert_float_equal(end, 0.5, 1e-9);
    assert_int_equal(notes.count, 0);
    const FieldTable *before = scene.world.fluids[0].flow_table;
    assert_true(load(TANK, &error));
    assert_ptr_equal(before, scene.world.fluids[0].flow_table); /* read once */

    write_file("heights.csv", "x (m),height (m)\n-0.4,0.2\n0.5,0.6\n");
    write_file("flow.csv", "y,vx\n0,0\n0.5,2\n");
    assert_true(load(TANK, &error));
    assert_int_equal(notes.count, 2);
    assert_non_null(strstr(notes.line[0],
                           "the table reaches from -0.4 to 0.5 m in x, and the fluid from -0.5 to "
                           "0.5 m: beyond the table it has what stands at its edge"));
    assert_non_null(strstr(notes.line[1], "in y, and the fluid from 0 to 1 m"));
}

/* sqrt(20^2 + 2 g H) */
static void the_speed_of_a_table_counts(void **state)
{
    (void)state;
    Error error;
    write_file("heights.csv", "x (m),height (m)\n-0.5,0.2\n0.5,0.6\n");
    write_file("flow.csv", "y,vx,vy\n0,0,0\n0.5,12,-16\n1,1,1\n");
    assert_true(load(TANK "solver: {sound_speed: 15, step: {mode: cfl}}\n", &error));
    assert_int_equal(notes.count, 1);
    assert_non_null(strstr(notes.line[0], "15 m/s is little for fluid that may come to 20.5 m/s"));
}

static void expect_refusal(const char *text, const char *words)
{
    Error error;
    if (load(text, &error))
        fail_msg("accepted, but should be refused with '%s'", words);
    if (!strstr(error.message, words))
        fail_msg("expected '%s'\n     got '%s'", words, error.message);
}

static void tables_that_a_scene_cannot_have(void **state)
{
    (void)state;
    write_file("heights.csv", "x,z,height\n0,0,1\n1,0,1\n0,1,1\n1,1,1\n");
    write_file("flow.csv", "y,vx\n0,0\n1,2\n");
    expect_refusal(TANK, "tank.yaml:5:60: a 2D scene has no z; leave its columns out of the table");
    write_file("heights.csv", "x,height\n0,1\n1\n");
    expect_refusal(TANK, "/heights.csv:3: 1 cell; the first line names 2 columns");
    write_file("flow.csv", "y,vz\n0,0\n1,2\n");
    expect_refusal(TANK, "tank.yaml:4:21: a 2D scene has no z; leave its columns out of the table");
    expect_refusal("box: {size: [1, 1]}\nparticles: {spacing: 0.05}\nfluids:\n"
                   "  - fill: [{block: {min: [-0.5, 0], max: [0.5, 1]}, below: none.csv}]\n",
                   "none.csv: No such file or directory: ");
    expect_refusal("box: {size: [1, 1]}\nparticles: {spacing: 0.05}\nfluids:\n"
                   "  - velocity_table: sin(x)\n    fill: [{block: {min: [-0.5, 0], max: [0.5, 1]}}]\n",
                   "'sin(x)' is no table; name a file that ends in .csv");
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
        cmocka_unit_test(heights_along_x),
        cmocka_unit_test(semicolons_and_quotes),
        cmocka_unit_test(velocities_of_a_grid),
        cmocka_unit_test(bad_files_are_told),
        cmocka_unit_test(tables_of_a_scene),
        cmocka_unit_test(the_speed_of_a_table_counts),
        cmocka_unit_test(tables_that_a_scene_cannot_have),
    };
    return cmocka_run_group_tests(tests, make_folder, NULL);
}
