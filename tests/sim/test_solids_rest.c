/* A tank with solids comes to rest: thousands of steps, each of which gl.compute_solids and sim.solids look
 * at. */
#include "solids.h"

#include "sim/methods/wcsph/wcsph.h"

static WorldDef tank_with_solids(const char *method)
{
    WorldDef def = fixture_def(2, 1.8, 1.6);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.sound_speed = 50;
    def.dt = 0.001;
    def.fluids[0].viscosity = 800;
    fixture_block(&def, 0, -1, 0, -0.8, 1, 1.6, 0.8);
    def.solids[def.solid_count++] = (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.4, 1, 0.1}, .radius = 0.4};
    def.solids[def.solid_count++] = (SolidDef){.kind = SOLID_BOX,
                                               .centre = {0.5, 0.6, -0.4},
                                               .size = {0.5, 1.2, 0.5},
                                               .axis = {0, 1, 0},
                                               .angle_deg = 30};
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_CYLINDER, .centre = {0.5, 0.7, 0.5}, .radius = 0.25, .height = 0.6, .axis = {1, 0, 1}};
    return def;
}

/* (p - rho0 g depth) over rho0 g H of a tank at rest. */
typedef struct RestError {
    double rms, near_solids; /* of all; mean of those that a solid's boundary particles touch */
    double fastest;          /* m/s */
} RestError;

static RestError rest_error(const WorldDef *def, int steps)
{
    World *world = fixture_world(def);
    RestError error = {0};
    fixture_step(world, steps);
    WorldSums sums;
    world_sums(world, &sums);
    State s = fixture_read(world);
    double mean = 0, top = 0;
    int touched = 0;
    for (size_t i = 0; i < s.count; i++) {
        mean += (s.pressure[i] + 9810 * s.position[4 * i + 1]) / (double)s.count;
        top = fmax(top, s.position[4 * i + 1]);
    }
    for (size_t i = 0; i < s.count; i++) {
        const double off = (s.pressure[i] + 9810 * s.position[4 * i + 1] - mean) / (9810 * top);
        bool touches = false;
        for (int k = 0; k < def->solid_count; k++)
            touches |= clearance(&def->solids[k], 3, 0, s.position + 4 * i) < 0.1;
        error.rms += off * off / (double)s.count;
        error.near_solids += touches ? off : 0;
        touched += touches;
    }
    assert_true(least_clearance(world, def) > 0 && touched > 200);
    fixture_free(&s);
    world_destroy(world);
    return (RestError){sqrt(error.rms), error.near_solids / touched, sums.max_speed};
}

static void a_tank_with_solids_comes_to_rest(void **state)
{
    (void)state;
    /* wcsph: the start's gaps next to round solids stay in the densities until diffusion has levelled them */
    static const int steps[] = {1000, 2700};
    for (int m = 0; m < 2; m++) {
        WorldDef def = tank_with_solids(fixture_method_names[m]);
        wcsph_def(&def)->delta_sph = 0.1;
        def.dt *= m ? 2 : 1;
        const RestError error = rest_error(&def, steps[m]);
        printf(
            "%s: tank with three solids: pressure off by %.2f %% of rho0 g H (rms), by %.2f %% next to them "
            "(mean), fastest %.3f m/s\n",
            fixture_method_names[m], 100 * error.rms, 100 * error.near_solids, error.fastest);
        assert_true(error.rms < 0.06 && fabs(error.near_solids) < 0.05 && error.fastest < 0.2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tank_with_solids_comes_to_rest),
    };
    return cmocka_run_group_tests_name("sim.solids_rest", tests, NULL, NULL);
}
