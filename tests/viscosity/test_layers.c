/* Two layers, ten times as thick below or above, between a no-slip floor and a moving lid (Couette). The
   shear stress is constant, so that the speed has a kink at the interface, at 10 / 11 of the lid's speed.
   And a layer without viscosity is not dragged along. */
#include "tests/sim/fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/methods/wcsph/wcsph.h"

enum { ROWS = 20, HALF = ROWS / 2, COLUMNS = 8 };
static const double SPACING = 0.05, LID = 0.1;

typedef struct Tried {
    const char *method;
    int form, solver; /* ViscosityForm, ViscositySolver */
} Tried;

static const Tried all[] = {
    {"mueller", VISCOSITY_MORRIS, VISCOSITY_EXPLICIT}, {"wcsph", VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},
    {"wcsph", VISCOSITY_RADIAL, VISCOSITY_EXPLICIT},   {"dfsph", VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},
    {"pbf", VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},     {"wcsph", VISCOSITY_RADIAL, VISCOSITY_IMPLICIT},
};
enum { TRIED = sizeof all / sizeof *all };

/* The lower layer has the viscosity `low`, the upper one `high`; speeds are those of theory. */
static WorldDef layers(const Tried *tried, double low, double high)
{
    static float x[3 * ROWS * COLUMNS], v[3 * ROWS * COLUMNS];
    static uint8_t fluid[ROWS * COLUMNS];
    static InitialState initial;
    WorldDef def = fixture_def(SPACING * COLUMNS, SPACING * ROWS, 0);
    snprintf(def.method, sizeof def.method, "%s", tried->method);
    memset(def.gravity, 0, sizeof def.gravity);
    def.dimensions = 2;
    def.spacing = SPACING;
    def.support = 3;
    def.sound_speed = 5;
    def.periodic[0] = true;
    def.wall_slip = SLIP_NONE;
    def.lid[0] = LID;
    def.fluid_count = 2;
    def.fluids[1] = def.fluids[0];
    def.fluids[0].viscosity = low;
    def.fluids[1].viscosity = high;
    def.viscosity_solver = tried->solver;
    wcsph_def(&def)->viscosity_form = tried->form;
    const double kink = LID * high / (low + high);
    for (size_t i = 0; i < ROWS * COLUMNS; i++) {
        const double y = ((double)(i / COLUMNS) + 0.5) / HALF; /* 1 at the interface */
        x[3 * i] = (float)(SPACING * ((double)(i % COLUMNS) + 0.5 - 0.5 * COLUMNS));
        x[3 * i + 1] = (float)(SPACING * HALF * y);
        v[3 * i] = (float)(y < 1 ? kink * y : kink + (LID - kink) * (y - 1));
        fluid[i] = y > 1;
    }
    initial = (InitialState){.count = ROWS * COLUMNS, .position = x, .velocity = v, .fluid = fluid};
    def.initial = &initial;
    return def;
}

/* Mean speeds of rows. */
static void rows_of(const WorldDef *def, double time, double speed[ROWS])
{
    World *world = fixture_world(def);
    fixture_step(world, (int)(time / def->dt));
    State s = fixture_read(world);
    memset(speed, 0, ROWS * sizeof *speed);
    for (size_t i = 0; i < s.count; i++)
        speed[(int)((double)s.position[4 * i + 1] / SPACING)] += (double)s.velocity[4 * i] / COLUMNS;
    fixture_free(&s);
    world_destroy(world);
}

/* Where the line through rows a and b has y = HALF. */
static double where_they_meet(const double speed[ROWS], int a, int b)
{
    return speed[a] + (speed[b] - speed[a]) / (b - a) * (HALF - 0.5 - a);
}

static void the_kink_lies_between_them(void **state)
{
    (void)state;
    for (int k = 0; k < TRIED; k++) {
        double speed[ROWS];
        WorldDef def = layers(&all[k], 20, 200);
        def.dt = all[k].solver == VISCOSITY_IMPLICIT ? 0.004 : 0.0016;
        rows_of(&def, 2, speed);
        const double below = where_they_meet(speed, 1, HALF - 4) / LID,
                     above = where_they_meet(speed, HALF + 3, ROWS - 2) / LID;
        printf("%s, form %d, solver %d: %.4f from below, %.4f from above, right %.4f\n", all[k].method,
               all[k].form, all[k].solver, below, above, 10.0 / 11);
        assert_float_equal(below, 10.0 / 11, 0.01);
        assert_float_equal(above, 10.0 / 11, 0.01);
    }
}

/* An inviscid layer is not dragged along by one that is. */
static void along_nothing_all_slips(void **state)
{
    (void)state;
    for (int k = 0; k < TRIED; k++) {
        double speed[ROWS];
        WorldDef def = layers(&all[k], 0, 200);
        def.dt = 0.0008;
        wcsph_def(&def)->artificial_viscosity = mueller_def(&def)->numerical_viscosity = 0;
        float *v = (float *)def.initial->velocity;
        for (size_t i = 0; i < ROWS * COLUMNS; i++)
            v[3 * i] = i / COLUMNS < HALF ? 0 : (float)LID;
        rows_of(&def, 0.2, speed);
        printf("%s, form %d, solver %d: %.2e below, %.4f above\n", all[k].method, all[k].form, all[k].solver,
               speed[HALF - 1], speed[HALF]);
        assert_float_equal(speed[HALF - 1], 0, 1e-3 * LID);
        assert_float_equal(speed[HALF], LID, 1e-3 * LID);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_kink_lies_between_them),
        cmocka_unit_test(along_nothing_all_slips),
    };
    return cmocka_run_group_tests_name("viscosity.layers", tests, NULL, NULL);
}
