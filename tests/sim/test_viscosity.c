/* The forms of wcsph's laminar viscosity: on lattices against the continuum, on free bodies against the
   work of a fluid. */
#include "fixture.h"

#include "sim/def/fluids.h"
#include "sim/kernel/kernel.h"
#include "sim/methods/wcsph/wcsph.h"

enum { KERNELS = 6 };

static const struct {
    const char *kernel;
    int dimensions;
    double support;
} lattices[] = {{"cubic", 2, 2.1},       {"cubic", 2, 2.6},       {"wendland_c2", 2, 3.5},
                {"wendland_c2", 3, 2.6}, {"wendland_c2", 2, 2.6}, {"quintic", 3, 3}};

/* What the lattice makes of a velocity that is quadratic: sum V 2 R F (v_ji . x_ij) x_ij, over mu; along x.
 */
static double force_of(const Lattice *lattice, double h, double velocity(const double x[3], int k))
{
    const int reach = (int)ceil(h), deep = lattice->dimensions == 3 ? reach : 0;
    double sum = 0;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double x[3] = {i, j, k}, r = sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                const double f = -lattice->gradient_scale * lattice->pressure_kernel->derivative(r, h) / r;
                double along = 0;
                for (int a = 0; a < 3; a++)
                    along += velocity(x, a) * x[a];
                sum += 2 * lattice->radial_scale * f * along * x[0] / lattice->number_density;
            }
    return sum;
}

static double shear(const double x[3], int k)
{
    return k == 0 ? 0.5 * x[1] * x[1] : 0;
}

/* No rotation: the Laplacian of grad (x^3 / 6 - x y^2 / 2) is 0. */
static double strain(const double x[3], int k)
{
    return k == 0 ? 0.5 * (x[0] * x[0] - x[1] * x[1]) : k == 1 ? -x[0] * x[1] : 0;
}

static double compression(const double x[3], int k)
{
    return k == 0 ? 0.5 * x[0] * x[0] : 0;
}

/* mu (laplacian v + 2 grad div v): 1, 0 and 3. */
static void lattices_feel_shear_and_strain_alike(void **state)
{
    (void)state;
    for (int n = 0; n < KERNELS; n++) {
        const Kernel *kernel = shape_kernel_find(lattices[n].kernel);
        Lattice lattice;
        lattice_calibrate(lattices[n].dimensions, 1, lattices[n].support, kernel, kernel, &lattice);
        const double h = lattices[n].support, sheared = force_of(&lattice, h, shear),
                     strained = force_of(&lattice, h, strain), pressed = force_of(&lattice, h, compression);
        printf("%s %dD %g: shear %.4f, strain %.4f, compression %.4f\n", kernel->name, lattice.dimensions, h,
               sheared, strained, pressed);
        assert_true(fabs(sheared - 1) < 0.025 && fabs(pressed - 3) < 0.08 && fabs(strained) < 0.1);
    }
}

enum { SIDE = 24 };

/* The power of friction, W, of a free square of SIDE x SIDE particles with v = (a x + b y, -b x - a y) about
   its centre: of the next step's velocities, without pressure. */
static double power(ViscosityForm form, double a, double b)
{
    static float x[3 * SIDE * SIDE], v[3 * SIDE * SIDE];
    WorldDef def = fixture_def(6, 6, 1);
    def.dimensions = 2;
    memset(def.gravity, 0, sizeof def.gravity);
    snprintf(def.method, sizeof def.method, "wcsph");
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    def.support = 3;
    def.sound_speed = 0.01;
    wcsph_def(&def)->viscosity_form = (int)form;
    def.fluids[0].viscosity = 100;
    def.dt = 1e-3;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const size_t row = i / SIDE;
        const double at[2] = {((double)(i % SIDE) + 0.5 - 0.5 * SIDE) * 0.1,
                              ((double)row + 0.5 - 0.5 * SIDE) * 0.1};
        x[3 * i] = (float)at[0];
        x[3 * i + 1] = (float)(3 + at[1]);
        v[3 * i] = (float)(a * at[0] + b * at[1]);
        v[3 * i + 1] = (float)(-b * at[0] - a * at[1]);
    }
    def.initial = &(InitialState){.count = (size_t)SIDE * SIDE, .position = x, .velocity = v};
    World *world = fixture_world(&def);
    WorldSums before, after;
    world_sums(world, &before);
    fixture_step(world, 1);
    world_sums(world, &after);
    world_destroy(world);
    return (before.kinetic_energy - after.kinetic_energy) / def.dt;
}

/* 2 mu D : D = 4 mu a^2 over the square's area, less the pairs missing at the surface. At a distance y
   from the surface a share is missing that falls from a half to zero within h: some 2 h / 5 of a side's
   length in all. */
static void a_stretch_costs_what_the_fluid_does(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    const double side = 0.1 * SIDE, all = 4 * 100 * side * side, radial = power(VISCOSITY_RADIAL, 1, 0) / all,
                 morris = power(VISCOSITY_MORRIS, 1, 0) / all;
    printf("a stretch costs %.3f (radial) and %.3f (morris) of 2 mu D : D\n", radial, morris);
    assert_true(radial > 0.8 && radial < 1);
    assert_true(morris > 0.4 && morris < 0.5);
}

/* A body that turns as a whole has no friction. */
static void a_rotation_costs_nothing(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    const double side = 0.1 * SIDE, scale = 2 * 100 * side * side;
    const double radial = power(VISCOSITY_RADIAL, 0, 1) / scale,
                 morris = power(VISCOSITY_MORRIS, 0, 1) / scale;
    printf("a rotation costs %.5f (radial) and %.3f (morris) of mu |grad v|^2\n", radial, morris);
    assert_true(fabs(radial) < 0.002);
    assert_true(morris > 0.8 && morris < 1);
}

static void only_its_forms_are_taken(void **state)
{
    (void)state;
    fixture_needs_cpu("worlds are checked alike on all backends");
    WorldDef def = fixture_def(1, 1, 1);
    Error error = {{0}};
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.3, 0.5);
    wcsph_def(&def)->viscosity_form = 2;
    assert_null(world_create(&def, &error));
    assert_non_null(strstr(error.message, "morris or radial"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattices_feel_shear_and_strain_alike),
        cmocka_unit_test(a_stretch_costs_what_the_fluid_does),
        cmocka_unit_test(a_rotation_costs_nothing),
        cmocka_unit_test(only_its_forms_are_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
