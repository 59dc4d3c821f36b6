/* The walls: rest density for a lattice that fills the box, images against brute force, no net force at rest,
 * no escape. */
#include "fixture.h"

#include "sim/box/box.h"

static WorldDef full_box(double nx, double ny, double nz, double support)
{
    WorldDef def = fixture_def(nx * 0.1, ny * 0.1, nz * 0.1);
    def.support = support;
    fixture_block(&def, 0, -nx * 0.05, 0, -nz * 0.05, nx * 0.05, ny * 0.1, nz * 0.05);
    return def;
}

/* How many walls a particle of the first layer touches: 0 in the bulk, 1 at a face, 2 at an edge, 3 in a
 * corner. */
static int walls_touched(const float x[3], const double box[3])
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const double centred = k == 1 ? x[1] - box[1] / 2 : x[k];
        count += box[k] / 2 - fabs(centred) < 0.075;
    }
    return count;
}

/* Within 0.5 % in the bulk, at faces, edges and corners; also in a slot narrower than two support radii. */
static void full_box_has_rest_density(void **state)
{
    (void)state;
    static const char *const places[] = {"the bulk", "a face", "an edge", "a corner"};
    const double supports[] = {1.6, 2.1, 2.6, 3.2}, depths[] = {10, 3};
    for (int s = 0; s < 4; s++)
        for (int d = 0; d < 2; d++) {
            const WorldDef def = full_box(10, 9, depths[d], supports[s]);
            World *world = fixture_world(&def);
            State all = fixture_read(world);
            assert_int_equal(all.count, 10 * 9 * depths[d]);
            int seen[4] = {0};
            for (size_t i = 0; i < all.count; i++) {
                const int place = walls_touched(all.position + 4 * i, def.box_size);
                seen[place]++;
                if (fabs(all.density[i] / 1000 - 1) > 0.005)
                    fail_msg("support %g, %g layers deep: density in %s is %.2f, not 1000", supports[s],
                             depths[d], places[place], all.density[i]);
            }
            assert_int_equal(seen[3], 8);
            assert_true(seen[0] > 0 && seen[1] > 0 && seen[2] > 0);
            fixture_free(&all);
            world_destroy(world);
        }
}

/* Without gravity the full lattice stays where it is: nothing pushes, in no corner. */
static void full_box_stays(void **state)
{
    (void)state;
    WorldDef def = full_box(8, 8, 8, 2.1);
    memset(def.gravity, 0, sizeof def.gravity);
    World *world = fixture_world(&def);
    State before = fixture_read(world);
    fixture_step(world, fixture_count(500, 100));
    State after = fixture_read(world);
    for (size_t i = 0; i < 4 * before.count; i++)
        if (i % 4 != 3 && fabsf(before.position[i] - after.position[i]) > 1e-3f * 0.1f)
            fail_msg("particle %zu moved by %g spacings", i / 4,
                     fabsf(before.position[i] - after.position[i]) / 0.1);
    fixture_free(&before);
    fixture_free(&after);
    world_destroy(world);
}

enum { STREWN = 60 };

/* Particles strewn in a box, so many that faces, edges and corners have some. */
typedef struct Strewn {
    float x[STREWN][3], h;
    Walls walls;
    Lattice lattice;
} Strewn;

static void strew(const WorldDef *def, Strewn *s)
{
    const Kernel *kernel = method_kernels(def).density;
    uint32_t seed = 11;
    memset(s, 0, sizeof *s);
    s->h = (float)(def->support * def->spacing);
    lattice_calibrate(def->dimensions, def->spacing, (double)s->h, kernel, kernel, &s->lattice);
    walls_place(&s->walls, def->dimensions, def->box_size, def->periodic, def->spacing);
    for (int i = 0; i < STREWN; i++)
        for (int k = 0; k < def->dimensions; k++)
            s->x[i][k] = (float)((fixture_random(&seed) - (k == 1 ? 0 : 0.5)) * def->box_size[k]);
}

/* n / n0 of particle i by brute force: over all particles and images. */
static double crowd(const Strewn *s, int i)
{
    WallImage image[IMAGES_MAX];
    const int count = wall_images(&s->walls, s->x[i], s->h, image);
    double sum = 0;
    for (int m = 0; m < count; m++)
        for (int j = 0; j < STREWN; j++) {
            const float *x = image[m].x, *y = s->x[j];
            const double d[3] = {(double)x[0] - (double)y[0], (double)x[1] - (double)y[1],
                                 (double)x[2] - (double)y[2]};
            const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            sum += r < (double)s->h ? density_kernel_find("spiky")->value(r, (double)s->h) : 0;
        }
    return sum * s->lattice.density_scale / s->lattice.number_density;
}

/* Of all, over p's slope and n0: the integral of (x - 1) / x^2, x = n / n0. */
static double energy_of(const Strewn *s)
{
    double sum = 0;
    for (int i = 0; i < STREWN; i++) {
        const double x = crowd(s, i);
        sum += log(x) + 1 / x;
    }
    return sum;
}

/* -dE / dx by differences. */
static double slope_at(Strewn *s, int i, int axis)
{
    float *x = &s->x[i][axis];
    const float at = *x;
    *x = at + 1e-4F;
    const double up = energy_of(s), high = (double)*x;
    *x = at - 1e-4F;
    const double down = energy_of(s), low = (double)*x;
    *x = at;
    return (down - up) / (high - low);
}

/* Not where a difference would cross the wall, nor where the image next to the wall is held. */
static bool off_walls(const Strewn *s, const float x[3])
{
    const WallsFar far = walls_far(&s->walls, 2e-4F);
    return !walls_near(&far, x);
}

/* Density includes all images, and accelerations are the energy's slope: at faces, edges and corners, and
   elsewhere. */
static void walls_push_by_their_energy(void **state)
{
    (void)state;
    fixture_needs_mueller("of its energy");
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        static Strewn s;
        WorldDef def = fixture_def(0.6, 0.5, 0.4);
        def.dimensions = dimensions;
        def.negative_pressure = true;
        def.sound_speed = 1;
        def.dt = 1e-4;
        memset(def.gravity, 0, sizeof def.gravity);
        fixture_layers(&def, 10);
        strew(&def, &s);
        def.initial = &(InitialState){.count = STREWN, .position = s.x[0]};
        World *world = fixture_world(&def);
        State before = fixture_read(world);
        fixture_step(world, 1);
        State after = fixture_read(world);
        const double pushes = s.lattice.stiffness_scale * s.lattice.gradient_scale / s.lattice.density_scale;
        double greatest = 0, worst = 0;
        for (int i = 0; i < STREWN; i++) {
            const double rho = 1000 * (1 + s.lattice.stiffness_scale * (crowd(&s, i) - 1));
            if (fabs((double)before.density[i] - rho) > 1e-3 * rho)
                fail_msg("%dD, particle %d: density %g, the images make it %g", dimensions, i,
                         (double)before.density[i], rho);
            for (int k = 0; k < dimensions && off_walls(&s, s.x[i]); k++) {
                const double a = (double)after.velocity[4 * i + k] / def.dt, is = pushes * slope_at(&s, i, k);
                greatest = fmax(greatest, fabs(is));
                worst = fmax(worst, fabs(a - is));
            }
        }
        printf("%dD: accelerations up to %.3g m/s2, off the energy's slope by %.2g\n", dimensions, greatest,
               worst);
        assert_true(greatest > 1 && worst < 0.01 * greatest);
        fixture_free(&before);
        fixture_free(&after);
        world_destroy(world);
    }
}

/* Lift of a wall at distance d, m: the push of all lattice particles behind the wall. */
static double lift_brute(const Lattice *lattice, double spacing, double support_radius, double d)
{
    const double h = support_radius;
    const int reach = (int)ceil(h / spacing), across = lattice->dimensions == 3 ? reach : 0;
    double sum = 0;
    for (int n = 0; n <= reach; n++)
        for (int i = -reach; i <= reach; i++)
            for (int j = -across; j <= across; j++) {
                const double y = (n + 0.5) * spacing, x = d + y;
                const double r = sqrt(x * x + (i * i + j * j) * spacing * spacing);
                if (r < h)
                    sum -= lattice->pressure_kernel->derivative(r, h) / r * x * 2 * y;
            }
    return lattice->gradient_scale * sum / lattice->number_density;
}

/* What walls hold of a layer's weight, in closed form against the lattice behind them. */
static void walls_hold_what_their_lattice_does(void **state)
{
    (void)state;
    fixture_needs_cpu("the same for all backends");
    for (int m = 0; m < 10; m++) {
        const double supports[] = {1.6, 2.1, 2.6, 3, 4}, h = 0.1 * supports[m / 2];
        const Kernel *spiky = density_kernel_find("spiky");
        Lattice lattice;
        Walls walls;
        lattice_calibrate(2 + m % 2, 0.1, h, spiky, spiky, &lattice);
        walls_place(&walls, lattice.dimensions, (double[]){2, 2, 2}, (bool[]){true, false, false}, 0.1);
        const WallLift lift = wall_lift_of(&lattice, 0.1, h);
        for (int layer = 0; layer < 4; layer++) {
            const double d = 0.1 * (layer + 0.5), is = lift_brute(&lattice, 0.1, h, d);
            float low[3], high[3];
            walls_lift(&lift, &walls, (float[]){-1, (float)d, 0}, low);
            walls_lift(&lift, &walls, (float[]){-1, (float)(2 - d), 0}, high);
            assert_true(low[0] == 0 && low[2] == 0 && fabsf(high[1] - low[1]) < 1e-5F);
            if (!(fabs((double)low[1] - is) < (layer == 0 ? 1e-5 : 0.025)))
                fail_msg("support %g, layer %d: %g of a weight, the lattice has %g", 10 * h, layer,
                         (double)low[1], is);
        }
    }
}

/* A column of `layers`, with an extra particle in each corner of the floor, which escapes. */
static void leave_corners(int dimensions, double support, int side, int layers, int steps)
{
    static float x[3 * 200];
    WorldDef def = fixture_def(0.1 * side, 0.1 * layers + 0.5, 0.1 * side);
    const int corners = 1 << (dimensions - 1), deep = dimensions == 3 ? side : 1;
    int count = 0;
    for (; count < corners; count++) {
        x[3 * count] = (float)((count & 1 ? 0.05 : -0.05) * side);
        x[3 * count + 2] = dimensions == 2 ? 0 : (float)((count & 2 ? 0.05 : -0.05) * side);
    }
    for (int i = 0; i < side * layers * deep; i++, count++) {
        x[3 * count] = (float)(0.1 * (i % side) - 0.05 * (side - 1));
        x[3 * count + 1] = (float)(0.1 * (i / side % layers) + 0.05);
        x[3 * count + 2] = (float)(0.1 * (i / (side * layers)) - 0.05 * (deep - 1));
    }
    def.dimensions = dimensions;
    def.support = support;
    def.sound_speed = 10;
    def.fluids[0].viscosity = 5;
    fixture_layers(&def, 5);
    def.initial = &(InitialState){.count = (size_t)count, .position = x};
    World *world = fixture_world(&def);
    fixture_step(world, steps);
    State s = fixture_read(world);
    for (int i = 0; i < corners; i++) {
        const float *at = s.position + (size_t)(4 * i);
        const double way = hypot(hypot(at[0] - x[3 * i], at[1]), at[2] - x[3 * i + 2]);
        if (!(way > 0.02 && s.density[i] < 1220))
            fail_msg("%d dimensions: %g m out of the corner, density %g", dimensions, way, s.density[i]);
    }
    fixture_free(&s);
    world_destroy(world);
}

static void what_is_in_a_corner_comes_out(void **state)
{
    (void)state;
    leave_corners(3, 2.1, 4, 6, 300);
    leave_corners(2, 3, 6, 10, 600);
}

/* A particle past a wall is put on the wall and loses outward velocity; inward velocity stays. */
static void the_last_guard_stops_what_goes_out(void **state)
{
    (void)state;
    fixture_needs_cpu("the same for all backends");
    Walls walls;
    walls_place(&walls, 3, (double[]){1, 2, 1.5}, (bool[]){false, false, false}, 0.1);
    for (int n = 0; n < 12; n++) {
        const int axis = n % 3, out = n / 3 % 2 ? 1 : -1;
        const float wall = (float)out * walls.half_size[axis] + (axis == 1 ? walls.half_size[1] : 0);
        float x[3] = {0.1F, 1.2F, 0.3F}, v[3] = {4, 5, 6}, is[3] = {4, 5, 6};
        x[axis] = wall + 0.01F * (float)out;
        v[axis] = (float)(n < 6 ? out : -out);
        is[axis] = n < 6 ? 0 : v[axis];
        assert_true(walls_guard(&walls, x, v) && x[axis] == wall);
        assert_true(v[0] == is[0] && v[1] == is[1] && v[2] == is[2]);
        assert_false(walls_guard(&walls, x, v));
    }
}

/* Fluid thrown into a corner at twenty times what a fall would give stays inside, and finite. */
static void nothing_leaves(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    def.dt = 0.001;
    def.sound_speed = 60;
    fixture_block(&def, 0, -0.3, 0.2, -0.3, 0.3, 0.8, 0.3);
    for (int k = 0; k < 3; k++)
        def.fluids[0].velocity[k] = k == 1 ? -20 : 20;
    World *world = fixture_world(&def);
    for (int i = 0; i < 40; i++) {
        fixture_step(world, 10);
        State s = fixture_read(world);
        for (size_t p = 0; p < s.count; p++) {
            const float *x = s.position + 4 * p;
            assert_true(fabsf(x[0]) <= 0.5f && fabsf(x[2]) <= 0.5f && x[1] >= 0 && x[1] <= 1);
        }
        fixture_free(&s);
    }
    world_destroy(world);
}

/* A drop on a wall has no pressure behind which the wall's could go on: it falls as if the wall were not
 * there. */
static void a_drop_slides_down_freely(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 4, 1);
    const float x0[3] = {-0.47f, 3, -0.46f};
    def.initial = &(InitialState){.count = 1, .position = x0};
    World *world = fixture_world(&def);
    fixture_step(world, 200);
    WorldInfo info;
    world_info(world, &info);
    State s = fixture_read(world);
    const double fall = 0.5 * 9.81 * info.time * info.time;
    if (fabs(s.position[1] - (3 - fall)) > 1e-3 * fall)
        fail_msg("a drop at the wall fell by %g m, not by %g m", 3 - s.position[1], fall);
    fixture_free(&s);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_box_has_rest_density),
        cmocka_unit_test(full_box_stays),
        cmocka_unit_test(walls_push_by_their_energy),
        cmocka_unit_test(walls_hold_what_their_lattice_does),
        cmocka_unit_test(what_is_in_a_corner_comes_out),
        cmocka_unit_test(nothing_leaves),
        cmocka_unit_test(the_last_guard_stops_what_goes_out),
        cmocka_unit_test(a_drop_slides_down_freely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
