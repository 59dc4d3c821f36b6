/* Friction next to slip walls: a wall's images act like mirrored fluid. */
#include "tests/sim/fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/pbf/pbf.h"
#include "sim/methods/wcsph/wcsph.h"

enum { SIDE = 6, MOST = SIDE * SIDE * SIDE, COPIES = 8 };
static const double CELL = 0.12; /* m: wider than the lattice, so that pbf moves nothing apart */

typedef struct Tried {
    const char *method;
    int dimensions, form, solver; /* ViscosityForm, ViscositySolver */
} Tried;

static const Tried all[] = {
    {"wcsph", 2, VISCOSITY_RADIAL, VISCOSITY_EXPLICIT}, {"wcsph", 3, VISCOSITY_RADIAL, VISCOSITY_EXPLICIT},
    {"wcsph", 2, VISCOSITY_MORRIS, VISCOSITY_EXPLICIT}, {"wcsph", 3, VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},
    {"dfsph", 2, VISCOSITY_MORRIS, VISCOSITY_EXPLICIT}, {"dfsph", 3, VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},
    {"pbf", 2, VISCOSITY_MORRIS, VISCOSITY_EXPLICIT},   {"wcsph", 2, VISCOSITY_RADIAL, VISCOSITY_IMPLICIT},
    {"wcsph", 3, VISCOSITY_RADIAL, VISCOSITY_IMPLICIT}, {"dfsph", 2, VISCOSITY_RADIAL, VISCOSITY_IMPLICIT},
};

static WorldDef def_of(const Tried *tried, double size)
{
    WorldDef def = fixture_def(size, size, size);
    memset(def.gravity, 0, sizeof def.gravity);
    def.dimensions = tried->dimensions;
    snprintf(def.method, sizeof def.method, "%s", tried->method);
    def.support = 2.1;
    def.sound_speed = 0.01; /* friction alone */
    /* short, since next to walls wcsph makes densities otherwise; pbf knows places to some 1e-8 m */
    def.dt = strcmp(tried->method, "pbf") == 0 ? 1e-3 : 1e-5;
    def.fluid_count = 2;
    def.fluids[1] = def.fluids[0];
    def.fluids[0].viscosity = 0.1 / def.dt;
    def.fluids[1].viscosity = 0.02 / def.dt;
    def.viscosity_solver = tried->solver;
    def.viscosity_tolerance = 1e-6;
    def.viscosity_iterations = 1000;
    pbf_def(&def)->tolerance = 1; /* no motion */
    wcsph_def(&def)->viscosity_form = tried->form;
    wcsph_def(&def)->artificial_viscosity = 0;
    return def;
}

/* Two disordered fluids, a particle in each cell of a block in the low corner, at least a quarter of a
   spacing off the walls, where Morris's friction is a mirror's. Then copies about `corner`, mirrored
   across all sides in `copy`. */
static size_t fill(const Tried *tried, const double corner[3], int copies, float *x, float *v, uint8_t *fluid)
{
    const int layers = tried->dimensions == 3 ? SIDE : 1;
    const size_t count = (size_t)(SIDE * SIDE * layers);
    for (int copy = 0; copy < copies; copy++) {
        uint32_t seed = 11;
        for (size_t i = 0; i < count; i++) {
            const size_t cell[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE},
                         to = (size_t)copy * count + i;
            for (size_t k = 0; k < 3; k++) {
                const double sign = copy >> k & 1 ? -1 : 1, jitter = 0.56 * (fixture_random(&seed) - 0.5);
                const bool flat = k == 2 && layers == 1;
                x[3 * to + k] =
                    (float)(flat ? 0 : corner[k] + sign * CELL * ((double)cell[k] + 0.5 + jitter));
                v[3 * to + k] = (float)(flat ? 0 : sign * (2 * fixture_random(&seed) - 1));
            }
            fluid[to] = cell[0] > 2;
        }
    }
    return count * (size_t)copies;
}

/* Difference of a step in a box's corner from four or eight such corners in the middle of a large box;
   `changed`: friction's greatest effect. */
static double off_mirror(const Tried *tried, int slip, double *changed)
{
    static float x[3 * MOST * COPIES], v[3 * MOST * COPIES];
    static uint8_t fluid[MOST * COPIES];
    const double small = 1, large = 2;
    const int copies = tried->dimensions == 3 ? 8 : 4;
    double off = 0;
    State after[2];
    for (int whole = 0; whole < 2; whole++) {
        WorldDef def = def_of(tried, whole ? large : small);
        const double corner[3] = {whole ? 0 : -small / 2, whole ? large / 2 : 0, whole ? 0 : -small / 2};
        def.wall_slip = slip;
        def.initial = &(InitialState){.count = fill(tried, corner, whole ? copies : 1, x, v, fluid),
                                      .position = x,
                                      .velocity = v,
                                      .fluid = fluid};
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        after[whole] = fixture_read(world);
        world_destroy(world);
    }
    *changed = 0;
    for (size_t i = 0; i < after[0].count; i++)
        for (size_t k = 0; k < 3; k++) {
            const double now = (double)after[0].velocity[4 * i + k];
            off = fmax(off, fabs(now - (double)after[1].velocity[4 * i + k]));
            *changed = fmax(*changed, fabs(now - (double)v[3 * i + k]));
        }
    fixture_free(&after[0]);
    fixture_free(&after[1]);
    return off;
}

static void a_slipping_wall_is_a_mirror(void **state)
{
    (void)state;
    for (size_t n = 0; n < sizeof all / sizeof *all; n++) {
        double changed;
        const double off = off_mirror(&all[n], SLIP_FREE, &changed);
        printf("%s %dD, %s, %s: a step changes velocities by %.3g m/s, off the mirror by %.1e of that\n",
               all[n].method, all[n].dimensions, viscosity_kinds[all[n].form].name,
               viscosity_solvers[all[n].solver].name, changed, off / changed);
        if (!(changed > 0.01 && off < 1e-4 * changed))
            fail_msg("it is none");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slipping_wall_is_a_mirror),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
