/* Probes: positions and columns, height gauges, means over time, tables continued after a resume. */
#include "tests/probe/cloud.h"

#include "app/run/measure/measure.h"

#include <unistd.h>

static ProbeDef probe_of(const char *name, ProbeKind kind, ProbeField field)
{
    ProbeDef probe = {.kind = (int)kind, .count = 5, .field_count = 1, .fields = {(int)field}};
    snprintf(probe.name, sizeof probe.name, "%s", name);
    return probe;
}

static void columns_have_names(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.05);
    ProbeDef probe[] = {probe_of("a", PROBE_POINT, PROBE_VELOCITY), probe_of("b", PROBE_HEIGHT, PROBE_SPEED),
                        probe_of("c", PROBE_LINE, PROBE_DENSITY), probe_of("d", PROBE_PLANE, PROBE_PRESSURE),
                        probe_of("e", PROBE_FORCE, PROBE_PRESSURE)};
    const ProbeList list = {5, probe};
    int shown[PROBE_SHOWN];
    snprintf(probe[4].on, PROBE_ON_SIZE, "box");
    probe[2].to[1] = 0.4;
    probe[2].count = 2;
    probe[3].along[0] = probe[3].across[2] = 0.2;
    static const char *const names[] = {"a.velocity_x", "a.velocity_y", "a.velocity_z", "b.height",
                                        "c_0.density",  "c_1.density",  "d.pressure",   "e.force_x",
                                        "e.force_y",    "e.force_z",    "e.torque_x",   "e.torque_y",
                                        "e.torque_z"};
    Probes *probes = probes_create(&list, &def);
    assert_int_equal(probes_columns(probes), 13);
    for (int k = 0; k < 13; k++)
        assert_string_equal(probes_column(probes, k)->name, names[k]);
    assert_string_equal(probes_column(probes, 3)->unit, "m");
    assert_string_equal(probes_column(probes, 6)->unit, "Pa");
    assert_string_equal(probes_column(probes, 9)->unit, "N");
    assert_string_equal(probes_column(probes, 10)->unit, "N m");
    assert_int_equal(probe_shown(&probe[4], shown), 3);
    assert_true(shown[0] == 0 && shown[1] == 1 && shown[2] == 2);
    assert_true(!probe_list_has_forces(&(ProbeList){4, probe}) && probe_list_has_forces(&list));
    probes_destroy(probes);
}

static void places_are_read(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.05);
    const Cloud cloud = cloud_at_rest(&def, 0.6);
    ProbeDef probe[] = {probe_of("line", PROBE_LINE, PROBE_PRESSURE),
                        probe_of("wall", PROBE_PLANE, PROBE_PRESSURE),
                        probe_of("over", PROBE_PLANE, PROBE_PRESSURE)};
    const ProbeList list = {3, probe};
    float out[8];
    probe[0].to[1] = 0.4;
    memcpy(probe[1].at, (double[]){0.5, 0.2, 0}, sizeof probe[1].at);
    probe[1].along[1] = 0.2;
    probe[1].across[2] = 0.6;
    probe[2] = probe[1];
    probe[2].at[1] = 0.5; /* the upper half of it is dry */
    probe[2].along[1] = 0.8;
    probe[2].count = 40;
    Probes *probes = probes_create(&list, &def);
    assert_int_equal(probes_columns(probes), 7);
    probes_read(probes, &cloud, NULL, out);
    for (int k = 0; k < 5; k++)
        near((double)out[k], 9810 * (0.6 - 0.1 * k), 20);
    near((double)out[5], 9810 * 0.4, 10);
    near((double)out[6], 9810 * 0.5 * 0.5 * 0.625, 120); /* from 0.1 to 0.6 m, of 0.8 m */
    probes_destroy(probes);
}

/* Of the box and of a solid; the last ones stay where no step was. */
static void forces_are_passed_on(void **state)
{
    (void)state;
    WorldDef def = cloud_box(3, 0.05);
    const Cloud none = cloud_of(&def);
    ProbeDef probe[] = {probe_of("a", PROBE_FORCE, PROBE_PRESSURE),
                        probe_of("b", PROBE_FORCE, PROBE_PRESSURE)};
    const ProbeList list = {2, probe};
    Forces forces = {.seconds = 0.1, .box = {{1, 2, 3}, {4, 5, 6}}};
    float out[12];
    forces.solid[1] = (Push){{7, 8, 9}, {10, 11, 12}};
    def.solid_count = 2;
    snprintf(probe[0].on, PROBE_ON_SIZE, "box");
    snprintf(probe[1].on, PROBE_ON_SIZE, "solid_1");
    Probes *probes = probes_create(&list, &def);
    probes_read(probes, &none, &(Forces){0}, out);
    for (int k = 0; k < 12; k++)
        assert_true(isnan(out[k]));
    probes_read(probes, &none, &forces, out);
    for (int repeat = 0; repeat < 2; repeat++) {
        for (int k = 0; k < 12; k++)
            assert_true(out[k] == (float)(k + 1));
        probes_read(probes, &none, &(Forces){0}, out);
    }
    probes_destroy(probes);
    static const struct {
        const char *on;
        int is;
    } names[] = {{"box", -1},      {"solid_0", 0},   {"solid_1", 1}, {"solid_2", -2},
                 {"solid_-1", -2}, {"solid_1x", -2}, {"floor", -2}};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        snprintf(probe[0].on, PROBE_ON_SIZE, "%s", names[k].on);
        assert_int_equal(probe_on(&probe[0], 2), names[k].is);
    }
}

/* Over the middle, in a corner, in the plane; a foot off the floor; drops do not count, nor what is below the
   foot; full to the ceiling. */
static void heights_are_those_of_the_surface(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const WorldDef def = cloud_box(dimensions, 0.04);
        ProbeDef probe[] = {probe_of("a", PROBE_HEIGHT, PROBE_SPEED),
                            probe_of("b", PROBE_HEIGHT, PROBE_SPEED),
                            probe_of("c", PROBE_HEIGHT, PROBE_SPEED)};
        const ProbeList list = {3, probe};
        const double feet[3][3] = {{0.013, 0, 0}, {0.5, 0, 0}, {0.2, 0.25, 0}};
        float out[3];
        for (int k = 0; k < 3; k++)
            memcpy(probe[k].at, feet[k], sizeof feet[k]);
        if (dimensions == 3)
            probe[1].at[2] = -0.5;
        Probes *probes = probes_create(&list, &def);
        for (int layers = 1; layers <= 25; layers += 6) {
            const double high = 0.04 * layers;
            Cloud cloud = cloud_at_rest(&def, high);
            if (layers < 20)
                cloud_add(&cloud, 0.013, high + 0.17, 0, 0);
            probes_read(probes, &cloud, NULL, out);
            near((double)out[0], high, layers == 1 ? 0.006 : 0.003);
            near((double)out[1], high, layers == 1 ? 0.006 : 0.003);
            near((double)out[2], fmax(high - 0.25, 0), 0.003);
        }
        Cloud none = cloud_of(&def);
        probes_read(probes, &none, NULL, out);
        assert_true(out[0] == 0 && out[2] == 0);
        probes_destroy(probes);
    }
}

/* Rows at uneven times; a number that is none counts nowhere. */
static void means_go_back_so_far(void **state)
{
    (void)state;
    ProbeWindow window = {.columns = 2, .longest = 1};
    double sum = 0;
    for (int k = 0; k <= 1000; k++) {
        const double time = 0.01 * k + (k % 2 ? 0.002 : 0);
        assert_true(probe_window_add(&window, time, (float[]){(float)k, k % 3 ? (float)k : NAN}));
    }
    for (int k = 901; k <= 1000; k++)
        sum += (k % 2 ? 0.012 : 0.008) * k;
    near(probe_window_mean(&window, 0, 1), sum / 1.0, 1e-6);
    near(probe_window_mean(&window, 0, 1e-3), 1000, 1e-9);
    near(probe_window_mean(&window, 1, 0.025), (0.008 * 1000 + 0.005 * 998) / 0.013, 1e-6);
    assert_true(window.count < 120);
    probe_window_free(&window);
    assert_true(probe_window_add(&window, 0, (float[]){7, NAN}));
    near(probe_window_mean(&window, 0, 1), 7, 0);
    assert_true(isnan(probe_window_mean(&window, 1, 1)));
    probe_window_free(&window);
}

static void row(int k, float value[2])
{
    value[0] = (float)(sin(0.1 * k) / 3);
    value[1] = k % 7 ? (float)(1e5 * cos(k)) : NAN;
}

/* Rows [from, to), ten a frame; a frame taken back stands before row 70. */
static void write_rows(ProbeTable *table, int from, int to)
{
    Error error = {{0}};
    for (int k = from; k < to; k++) {
        float value[2];
        if (k == 70) {
            assert_true(probe_table_add(table, 99, (float[]){9, 9}));
            probe_table_drop(table);
        }
        row(k, value);
        assert_true(probe_table_add(table, k / 3.0, value));
        if (k % 10 == 9)
            assert_true(probe_table_write(table, &error));
    }
}

static void read_text(const char *path, char text[1 << 16])
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, (1 << 16) - 1, file)] = 0;
    fclose(file);
}

/* Cut anywhere behind row 60, and gone on with behind it, a table has the same bytes. */
static void a_table_goes_on_to_the_same_bytes(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.05);
    ProbeDef probe[] = {probe_of("a", PROBE_HEIGHT, PROBE_SPEED), probe_of("b", PROBE_POINT, PROBE_DENSITY)};
    const ProbeList list = {2, probe};
    probe[0].average = 4;
    probe[1].average = 9;
    Probes *probes = probes_create(&list, &def);
    Error error = {{0}};
    ProbeTable table;
    static char whole[1 << 16], again[1 << 16];
    assert_true(probe_table_open(&table, "probes_whole.csv", probes, -1, &error));
    write_rows(&table, 0, 100);
    assert_true(probe_table_close(&table, &error));
    const double sum = table.figures[0].sum;
    probe_table_free(&table);
    read_text("probes_whole.csv", whole);
    assert_memory_equal(
        whole, "time [s],a.height [m],a.height_mean [m],b.density [kg/m3],b.density_mean [kg/m3]\n", 80);
    int lines = 0;
    for (const char *at = whole; *at; at++)
        lines += *at == '\n';
    assert_int_equal(lines, 101);
    char *begin = whole;
    for (int k = 0; k < 62; k++)
        begin = strchr(begin, '\n') + 1;
    for (size_t size = (size_t)(begin - whole); size < strlen(whole); size += 37) {
        FILE *file = fopen("probes_cut.csv", "w");
        fwrite(whole, 1, size, file);
        fclose(file);
        if (!probe_table_open(&table, "probes_cut.csv", probes, 60 / 3.0, &error))
            fail_msg("%s", error.message);
        near(table.last, 20, 1e-9);
        write_rows(&table, 61, 100);
        assert_true(probe_table_close(&table, &error));
        assert_true(table.figures[0].sum == sum);
        probe_table_free(&table);
        read_text("probes_cut.csv", again);
        assert_string_equal(whole, again);
    }
    unlink("probes_whole.csv");
    unlink("probes_cut.csv");
    probes_destroy(probes);
}

static void another_table_stays(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.05);
    const ProbeDef probe[] = {probe_of("a", PROBE_POINT, PROBE_SPEED)};
    const ProbeList list = {1, probe};
    Probes *probes = probes_create(&list, &def);
    Error error = {{0}};
    ProbeTable table, other = {.file = NULL};
    char text[1 << 16];
    FILE *file = fopen("probes_other.csv", "w");
    fputs("time,force\n0,1\n", file);
    fclose(file);
    assert_false(probe_table_open(&table, "probes_other.csv", probes, 0, &error));
    assert_non_null(strstr(error.message, "is no table of this scene's probes"));
    read_text("probes_other.csv", text);
    assert_string_equal(text, "time,force\n0,1\n");
    assert_false(probe_table_open(&table, "probes_other.csv", probes, -1, &error));
    assert_non_null(strstr(error.message, "is there already, and no probes wrote it"));
    assert_false(probe_table_check("probes_other.csv", &error));
    read_text("probes_other.csv", text);
    assert_string_equal(text, "time,force\n0,1\n");
    unlink("probes_other.csv");
    assert_true(probe_table_check("probes_other.csv", &error));
    assert_true(probe_table_open(&table, "probes_other.csv", probes, -1, &error));
    assert_true(probe_table_check("probes_other.csv", &error));
    assert_false(probe_table_open(&other, "probes_other.csv", probes, -1, &error));
    assert_non_null(strstr(error.message, "is being written by another slosh"));
    assert_true(probe_table_close(&table, &error));
    probe_table_free(&table);
    unlink("probes_other.csv");
    assert_false(probe_table_open(&table, "no/such.csv", probes, -1, &error));
    probes_destroy(probes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_have_names),   cmocka_unit_test(places_are_read),
        cmocka_unit_test(forces_are_passed_on), cmocka_unit_test(heights_are_those_of_the_surface),
        cmocka_unit_test(means_go_back_so_far), cmocka_unit_test(a_table_goes_on_to_the_same_bytes),
        cmocka_unit_test(another_table_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
