/* No-slip walls: tables against sums, unaffected shears, unaffected steps, Stokes' oscillating floor. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/step/constants.h"

#include <complex.h>

typedef struct Tried {
    const char *name, *kernel;
    int dimensions;
    double support;
    ViscosityForm form; /* of wcsph */
} Tried;

static const Tried methods[] = {
    {"mueller", "cubic", 2, 2.6, VISCOSITY_MORRIS},     {"mueller", "cubic", 3, 2.1, VISCOSITY_MORRIS},
    {"mueller", "cubic", 3, 3, VISCOSITY_MORRIS},       {"wcsph", "cubic", 2, 2.6, VISCOSITY_MORRIS},
    {"wcsph", "wendland_c2", 3, 2.6, VISCOSITY_MORRIS}, {"wcsph", "quintic", 2, 3, VISCOSITY_MORRIS},
    {"wcsph", "wendland_c2", 2, 3, VISCOSITY_RADIAL},   {"wcsph", "wendland_c2", 3, 2.6, VISCOSITY_RADIAL},
    {"dfsph", "cubic", 2, 2.6, VISCOSITY_MORRIS},       {"dfsph", "cubic", 3, 2.1, VISCOSITY_MORRIS},
};
enum { METHODS = sizeof methods / sizeof *methods };

/* All on the CPU; on a GPU, with the same tables, a single case in space and both in the plane. */
static bool taken(int m)
{
    return fixture_on_cpu() || m == 0 || m == 1 || m == 3 || m == 6;
}

/* A closed box, full to the height `full`, without gravity; 1 m2/s. */
static WorldDef no_slip_box(const Tried *method, double side, double full)
{
    WorldDef def = fixture_def(side, side, side);
    memset(def.gravity, 0, sizeof def.gravity);
    def.dimensions = method->dimensions;
    def.support = method->support;
    strcpy(def.method, method->name);
    strcpy(wcsph_def(&def)->kernel, method->kernel);
    def.wall_slip = SLIP_NONE;
    wcsph_def(&def)->viscosity_form = (int)method->form;
    def.fluids[0].viscosity = 1000;
    fixture_block(&def, 0, -side / 2, 0, -side / 2, side / 2, full, side / 2);
    return def;
}

/* w(r) of the forms of friction, as sim/box/box.h names the forms. */
static double weight_of(const Lattice *lattice, DragWeight weight, double r, double normal,
                        double support_radius)
{
    if (weight == DRAG_LAPLACIAN)
        return lattice->laplacian_scale * kernel_viscosity_laplacian(r, support_radius);
    const double morris =
        -2 * lattice->gradient_scale * lattice->pressure_kernel->derivative(r, support_radius) / r;
    if (weight == DRAG_MORRIS)
        return morris;
    return morris * lattice->radial_scale * (r * r - normal * normal) / (lattice->dimensions - 1);
}

/* D by adding up all lattice particles behind some face at once, with the greatest factor. */
static double drag_brute(const Constants *s, DragWeight weight, int faces, const double d[3],
                         const double offset[3])
{
    const double h = (double)s->support_radius, spacing = (double)s->spacing;
    double sum = 0;
    for (int n = 0; n < 11 * 11 * 11; n++) { /* h is at most three spacings, and d at most h */
        const int index[3] = {n % 11 - 4, n / 11 % 11 - 4, n / 121 - 4};
        double r2 = 0, factor = 0, normal = 0;
        if (s->lattice.dimensions == 2 && index[2] != 0)
            continue;
        for (int a = 0; a < 3; a++) {
            const double y = (index[a] + 0.5) * spacing; /* of the particle, in front of the face */
            const double along = s->lattice.dimensions == 2 && a == 2 ? 0 : index[a] + offset[a];
            r2 += a < faces ? (d[a] - y) * (d[a] - y) : along * along * spacing * spacing;
            const double own = a < faces && y < 0 ? 1 - y / fmax(d[a], 0.5 * spacing) : 0;
            if (own > factor) {
                factor = own;
                normal = d[a] - y;
            }
        }
        if (r2 < h * h && factor > 0)
            sum += factor * weight_of(&s->lattice, weight, sqrt(r2), normal, h);
    }
    return s->unit_volume * sum;
}

/* In front of faces, edges and corners, low and high: the sum over the particle's own lattice within 0.2
   % at a face. Within 5 % at edges and corners, with coarser nodes (radial: 8 %, with a jump of weights
   where the nearer face changes). The mean over the lattice's places along the walls within 6 %. */
static void tables_equal_sums(void **state)
{
    (void)state;
    fixture_needs_cpu("the tables are the same for all backends");
    uint32_t seed = 3;
    for (int m = 0; m < METHODS; m++) {
        WorldDef def = no_slip_box(&methods[m], 2, 1);
        Constants constants;
        Error error = {0};
        assert_true(constants_create(&constants, &def, &error));
        const DragWeight weight = strcmp(def.method, "mueller") == 0 ? DRAG_LAPLACIAN
                                  : wcsph_def(&def)->viscosity_form  ? DRAG_RADIAL
                                                                     : DRAG_MORRIS;
        const double scale = drag_brute(&constants, weight, 1, (double[3]){0.05}, (double[3]){0});
        assert_true(scale > 0);
        for (int n = 0; n < 120; n++) {
            const int faces = 1 + n % def.dimensions, places = 200;
            double d[3] = {0}, mean = 0;
            float low[3] = {0, 1, 0}, high[3];
            for (int k = 0; k < faces; k++) {
                d[k] = fixture_random(&seed) * def.support * 0.1;
                low[k] = (float)((k == 1 ? 0 : -1) + d[k]);
            }
            for (int k = 0; k < 3; k++)
                high[k] = k == 1 ? 2 - low[k] : -low[k];
            for (int i = 0; i < places; i++)
                mean += drag_brute(&constants, weight, faces, d,
                                   (double[3]){fixture_random(&seed), fixture_random(&seed),
                                               fixture_random(&seed)}) /
                        places;
            const double exact = drag_brute(&constants, weight, faces, d, (double[3]){0});
            const double at_low = (double)wall_drag_at(&constants.drag, low),
                         at_high = (double)wall_drag_at(&constants.drag, high);
            const double off = fmax(fabs(at_low - exact), fabs(at_high - exact));
            const double most = faces == 1 ? 0.002 : weight != DRAG_RADIAL ? 0.05 : faces == 2 ? 0.08 : 0.15;
            if (off > most * (scale + exact))
                fail_msg("%s, %d faces at %g %g %g: %g and %g of a face's, the sum is %g", def.method, faces,
                         d[0], d[1], d[2], at_low / scale, at_high / scale, exact / scale);
            if (fabs(at_low - mean) > fmax(most, 0.06) * (scale + exact))
                fail_msg("%s, %d faces at %g %g %g: %g of a face's, the mean is %g", def.method, faces, d[0],
                         d[1], d[2], at_low / scale, mean / scale);
        }
        constants_destroy(&constants);
    }
}

typedef double Profile(double y, double width);

static double shear(double y, double width)
{
    (void)width;
    return y;
}

static double parabola(double y, double width)
{
    return y * (width - y) / 2;
}

/* Viscous accelerations along x, m/s2, in the first layers of the floor, in the middle of the box. */
static void layers(const Tried *method, Profile *profile, double out[4])
{
    enum { SIDE = 16, ALL = SIDE * SIDE * SIDE };
    static float x[3 * ALL], v[3 * ALL];
    WorldDef def = no_slip_box(method, 0.1 * SIDE, 0);
    InitialState initial = {
        .count = method->dimensions == 3 ? ALL : SIDE * SIDE, .position = x, .velocity = v};
    memset(v, 0, sizeof v);
    for (size_t i = 0; i < initial.count; i++) {
        const size_t index[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        for (int k = 0; k < 3; k++)
            x[3 * i + (size_t)k] = (float)(0.1 * ((double)index[k] + 0.5) - (k == 1 ? 0 : 0.05 * SIDE));
        if (method->dimensions == 2)
            x[3 * i + 2] = 0;
        v[3 * i] = (float)profile((double)x[3 * i + 1], 0.1 * SIDE);
    }
    def.dt = 1e-4;
    wcsph_def(&def)->artificial_viscosity = 0;
    def.sound_speed = 1;
    def.initial = &initial;
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (size_t layer = 0; layer < 4; layer++) {
        const size_t i = ((method->dimensions == 3) * SIDE / 2 * SIDE + layer) * SIDE + SIDE / 2;
        out[layer] = ((double)s.velocity[4 * i] - (double)v[3 * i]) / def.dt;
    }
    fixture_free(&s);
    world_destroy(world);
}

static void a_linear_shear_is_free_of_force(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        if (!taken(m))
            continue;
        double a[4];
        layers(&methods[m], shear, a);
        for (int layer = 0; layer < 4; layer++) /* the drag alone gives some 10 m/s2 */
            if (fabs(a[layer]) > 0.02)
                fail_msg("%s %dD: layer %d of a linear shear is driven by %g m/s2", methods[m].name,
                         methods[m].dimensions, layer, a[layer]);
    }
}

/* Mirrored velocities continue in a straight line. Curvature shows in the layers with a small view of the
   wall: the first layer finds 0.67 to 0.73 of the drag, the second 0.93 to 0.99. */
static void a_parabola_is_slowed_by_its_curvature(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        if (!taken(m))
            continue;
        double a[4];
        layers(&methods[m], parabola, a);
        printf("parabola, %s %dD %g: layers are slowed by %.3f %.3f %.3f %.3f of -nu u''\n", methods[m].name,
               methods[m].dimensions, methods[m].support, -a[0], -a[1], -a[2], -a[3]);
        assert_true(-a[0] > 0.65 && -a[0] < 0.75 && -a[1] > 0.92 && -a[1] < 1);
        const double most = methods[m].form == VISCOSITY_RADIAL ? 0.025 : 0.005;
        assert_true(fabs(-a[2] - 1) < most && fabs(-a[3] - 1) < most);
    }
}

static double speed_of(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sqrt(2 * sums.kinetic_energy / sums.mass);
}

/* A particle on a face, an edge, in a corner, sliding along: never faster than before, at steps far
   beyond the limit. With little pressure, which would push off the walls. */
static void drag_never_overshoots(void **state)
{
    (void)state;
    for (int faces = 1; faces <= 3; faces++)
        for (int m = 0; m < METHODS; m++) {
            if (faces > methods[m].dimensions || !taken(m))
                continue;
            WorldDef def = no_slip_box(&methods[m], 1, 0);
            const float x[3] = {faces > 2 ? -0.4999f : 0, 1e-4f,
                                faces > 1 && def.dimensions == 3 ? -0.4999f : 0},
                        v[3] = {1, 0, 0};
            def.initial = &(InitialState){.count = 1, .position = x, .velocity = v};
            def.dt = 0.1;
            def.sound_speed = 1e-4;
            World *world = fixture_world(&def);
            double before = 1;
            for (int i = 0; i < 5; i++) {
                fixture_step(world, 1);
                const double speed = speed_of(world);
                assert_true(speed > 0 && speed < 0.5 * before);
                before = speed;
            }
            world_destroy(world);
        }
}

/* Steps as long as the viscous limit of mode cfl at the default number, in a full box of fluid in random
   motion, with slip and no-slip walls. */
static void the_viscous_limit_holds(void **state)
{
    (void)state;
    for (int n = 0; n < 2 * METHODS; n++) {
        const int m = n / 2;
        if (!taken(m))
            continue;
        WorldDef def = no_slip_box(&methods[m], 1, 1);
        enum { MOST = 1000 };
        static float x[3 * MOST], v[3 * MOST];
        uint32_t seed = 4;
        def.wall_slip = n % 2 ? SLIP_NONE : SLIP_FREE;
        def.step_mode = STEP_CFL;
        def.fluids[0].viscosity = 1e4;
        def.sound_speed = 2;
        dfsph_def(&def)->divergence_tolerance =
            1e-6; /* it leaves speeds of this, times a length, over the step */
        World *full = fixture_world(&def);
        State s = fixture_read(full);
        for (size_t i = 0; i < s.count; i++)
            for (size_t k = 0; k < 3; k++) {
                x[3 * i + k] = s.position[4 * i + k];
                v[3 * i + k] = (int)k < def.dimensions ? (float)(fixture_random(&seed) - 0.5) : 0;
            }
        def.initial = &(InitialState){.count = s.count, .position = x, .velocity = v};
        World *world = fixture_world(&def);
        const double before = speed_of(world);
        fixture_step(world, 60);
        WorldInfo info;
        world_info(world, &info);
        assert_int_equal(info.limit, STEP_LIMIT_VISCOUS);
        /* slip walls keep momentum */
        if (!(speed_of(world) < (def.wall_slip == SLIP_NONE ? 0.02 : 0.2) * before))
            fail_msg("%s %dD: from %g m/s to %g m/s", def.method, def.dimensions, before, speed_of(world));
        fixture_free(&s);
        world_destroy(full);
        world_destroy(world);
    }
}

/* Stokes' second problem: a layer on a floor that moves as U cos(omega t), in the box's frame. The fluid has
   the velocity U Re(e^(i omega t) cosh((1 + i)(H - y) / delta) / cosh((1 + i) H / delta)) in the world's. */
typedef struct Stokes {
    double u, omega, delta, height;
} Stokes;

static double stokes_at(const Stokes *stokes, double y, double t)
{
    const double complex k = (1 + I) / stokes->delta;
    const double complex f = ccosh(k * (stokes->height - y)) / ccosh(k * stokes->height);
    return stokes->u * (creal(cexp(I * stokes->omega * t) * f) - cos(stokes->omega * t));
}

enum { STOKES_COLUMNS = 60, STOKES_LAYERS = 24 };

/* Lattice and profile at time 0 of a layer between -columns / 2 and columns / 2. */
static void stokes_begin(const Stokes *stokes, double spacing, float *x, float *v)
{
    for (int i = 0; i < STOKES_COLUMNS * STOKES_LAYERS; i++) {
        const double y = (i / STOKES_COLUMNS + 0.5) * spacing;
        x[3 * i] = (float)((i % STOKES_COLUMNS + 0.5 - 0.5 * STOKES_COLUMNS) * spacing);
        x[3 * i + 1] = (float)y;
        v[3 * i] = (float)stokes_at(stokes, y, 0);
    }
}

/* The greatest difference from the reference in the middle of the layer, of U. */
static double stokes_difference(World *world, const Stokes *stokes, double spacing, double t)
{
    State s = fixture_read(world);
    double sum[STOKES_LAYERS] = {0}, worst = 0;
    int count[STOKES_LAYERS] = {0};
    for (size_t i = 0; i < s.count; i++) {
        const int layer = (int)((double)s.position[4 * i + 1] / spacing);
        if (fabsf(s.position[4 * i]) < 0.5f && layer < STOKES_LAYERS) {
            sum[layer] += (double)s.velocity[4 * i];
            count[layer]++;
        }
    }
    for (int layer = 0; layer < STOKES_LAYERS; layer++) {
        const double exact = stokes_at(stokes, (layer + 0.5) * spacing, t);
        assert_true(count[layer] > 0);
        worst = fmax(worst, fabs(sum[layer] / count[layer] - exact) / stokes->u);
    }
    fixture_free(&s);
    return worst;
}

/* Without gravity, without wall contact, and without the start: only the floor moves the fluid. */
static double stokes_error(const char *method, int slip)
{
    static float x[3 * STOKES_COLUMNS * STOKES_LAYERS], v[3 * STOKES_COLUMNS * STOKES_LAYERS];
    const double pi = 3.14159265358979, amplitude = 0.02, spacing = 0.05;
    const Stokes stokes = {2 * pi * amplitude, 2 * pi, 0.3, STOKES_LAYERS * spacing};
    WorldDef def = fixture_def(STOKES_COLUMNS * spacing + 0.5, 1.5, 1);
    def.dimensions = 2;
    def.spacing = spacing;
    def.support = 2.6;
    strcpy(def.method, method);
    memset(def.gravity, 0, sizeof def.gravity);
    def.sound_speed = 10;
    def.dt = 1.0 / 300;
    def.wall_slip = slip;
    def.fluids[0].viscosity = 1000 * stokes.delta * stokes.delta * stokes.omega / 2;
    add_motion(&def,
               (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = amplitude, .frequency = 1});
    def.initial = &(InitialState){.count = STOKES_COLUMNS * STOKES_LAYERS, .position = x, .velocity = v};
    stokes_begin(&stokes, spacing, x, v);
    World *world = fixture_world(&def);
    double worst = 0;
    for (int n = 1; n <= fixture_count(20, 9); n++) {
        fixture_step(world, 15);
        worst = fmax(worst, stokes_difference(world, &stokes, spacing, 0.05 * n));
    }
    world_destroy(world);
    return worst;
}

static void a_floor_drags_fluid_along(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        const double none = stokes_error(fixture_method_names[m], SLIP_NONE),
                     slips = stokes_error(fixture_method_names[m], SLIP_FREE);
        printf("Stokes' second problem, %s: off by %.3f of U; where walls slip by %.3f\n",
               fixture_method_names[m], none, slips);
        assert_true(none < 0.03);
        assert_true(slips > 0.5);
    }
}

/* Only if needed are tables made. */
static void slip_and_inviscid_fluid_have_no_tables(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = no_slip_box(&methods[0], 1, 1);
    for (int with = 0; with < 4; with++) {
        Constants constants;
        def.wall_slip = with & 1 ? SLIP_NONE : SLIP_FREE;
        def.fluids[0].viscosity = with & 2 ? 1 : 0;
        assert_true(constants_create(&constants, &def, &error));
        assert_true(constants.no_slip == (with == 3));
        assert_true((constants.drag.table[0] != NULL) == (with == 3));
        constants_destroy(&constants);
    }
    def.wall_slip = 2;
    Constants constants;
    assert_false(constants_create(&constants, &def, &error));
    constants_destroy(&constants);
}

/* A fluid becoming viscous is held like an always viscous fluid, and released afterwards. */
static void viscosity_may_come_and_go(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = no_slip_box(&methods[0], 1, 0.5), inviscid = def, slippery = def;
    inviscid.fluids[0].viscosity = 0;
    inviscid.fluids[0].velocity[0] = slippery.fluids[0].velocity[0] = def.fluids[0].velocity[0] = 0.2;
    slippery.wall_slip = SLIP_FREE;
    World *made = fixture_world(&def), *changed = fixture_world(&inviscid), *slips = fixture_world(&slippery);
    assert_true(world_change(changed, &def, &error));
    fixture_step(made, 20);
    fixture_step(changed, 20);
    fixture_step(slips, 20);
    assert_true(world_hash(made) == world_hash(changed));
    assert_true(world_hash(made) != world_hash(slips));
    world_destroy(changed);
    world_destroy(slips);

    World *back = fixture_world(&inviscid), *never = fixture_world(&inviscid);
    assert_true(world_change(back, &def, &error) && world_change(back, &inviscid, &error));
    fixture_step(back, 20);
    fixture_step(never, 20);
    assert_true(world_hash(back) == world_hash(never));
    world_destroy(made);
    world_destroy(back);
    world_destroy(never);
}

static void any_threads_give_the_same_bits(void **state)
{
    (void)state;
    fixture_needs_cpu("has no threads");
    for (int m = 0; m < METHODS; m += 3) {
        uint64_t hash[3];
        for (int threads = 1; threads <= 3; threads++) {
            WorldDef def = no_slip_box(&methods[m], 2, 1);
            def.gravity[0] = 5;
            def.gravity[1] = -9;
            *world_threads(&def) = threads;
            def.fluids[0].viscosity = 20;
            World *world = fixture_world(&def);
            fixture_step(world, 100);
            hash[threads - 1] = world_hash(world);
            world_destroy(world);
        }
        assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_equal_sums),
        cmocka_unit_test(a_linear_shear_is_free_of_force),
        cmocka_unit_test(a_parabola_is_slowed_by_its_curvature),
        cmocka_unit_test(drag_never_overshoots),
        cmocka_unit_test(the_viscous_limit_holds),
        cmocka_unit_test(a_floor_drags_fluid_along),
        cmocka_unit_test(slip_and_inviscid_fluid_have_no_tables),
        cmocka_unit_test(viscosity_may_come_and_go),
        cmocka_unit_test(any_threads_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
