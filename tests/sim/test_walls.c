/* The walls: rest density for a lattice that fills the box, tables against sums, no net force at rest, no
 * escape. */
#include "fixture.h"

#include "sim/box/wall.h"

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

typedef struct Table {
    Lattice lattice;
    Walls walls;
} Table;

static Table make_walls(void)
{
    Table t;
    lattice_calibrate(3, 0.1, 0.21, &density_kernels[0], &density_kernels[0], &t.lattice);
    assert_true(walls_create(&t.walls, (double[3]){2, 2, 2}, (bool[3]){false}, 0.1, 0.21, &density_kernels[0],
                             &t.lattice));
    return t;
}

/* Where the product of two different axes stands: xy yz zx after the squares. */
static int pair_index(int a, int b)
{
    return 3 + (a + b == 1 ? 0 : a + b == 3 ? 1 : 2);
}

/* A table's value against sums over the lattice at the same place, averaged over the lattice's position along
   the wall: within 2 % of the largest value; push and moment by component, with the signs of the far walls.
   Not near two walls at once, where tables push more: the next test. */
static void tables_equal_sums(void **state)
{
    (void)state;
    fixture_needs_cpu("the tables are the same for all backends");
    Table t = make_walls();
    uint32_t seed = 5;
    double scale = 0;
    for (int n = 0; n < 300; n++) {
        const int faces = 1 + n % 3;
        float slope[3] = {0};
        double d[3], u[3] = {0}, density = 0, push[3] = {0}, moment[6] = {0};
        float x[3] = {0, 1, 0};
        for (int k = 0; k < faces; k++) {
            d[k] = k == n % 2 ? fixture_random(&seed) * 0.2 : 0.04 + fixture_random(&seed) * 0.16;
            u[k] = wall_distance((float)d[k], 0.1f, &slope[k]);
            x[k] = (float)((k == 1 ? 0 : -1) + d[k]);
        }
        /* union = all that is behind some face: count each combination with its sign */
        for (int set = 1; set < 1 << faces; set++) {
            double sub[3];
            int used = 0, axis[3];
            for (int k = 0; k < faces; k++)
                if (set >> k & 1) {
                    sub[used] = u[k];
                    axis[used++] = k;
                }
            for (int k = 0, next = used; k < 3; k++)
                if (k >= faces || !(set >> k & 1))
                    axis[next++] = k;
            const double sign = used == 2 ? -1 : 1;
            const int samples = used == 3 ? 1 : 400;
            for (int m = 0; m < samples; m++) {
                double offset[3] = {0}, w, p[3], q[6];
                for (int k = used; k < 3; k++)
                    offset[k] = fixture_random(&seed) - 0.5;
                wall_sums_brute(used, sub, offset, 0.1, 0.21, &density_kernels[0], &t.lattice, &w, p, q);
                density += sign * w / samples;
                for (int k = 0; k < 3; k++)
                    push[axis[k]] += sign * slope[axis[k]] * p[k] / samples;
                for (int k = 0; k < 3; k++) {
                    moment[axis[k]] += sign * q[k] / samples;
                    moment[pair_index(axis[k], axis[(k + 1) % 3])] += sign * q[3 + k] / samples;
                }
            }
        }
        scale = fmax(scale, density);
        for (int mirror = 0; mirror < 2; mirror++) {
            float at[3] = {x[0], x[1], x[2]};
            if (mirror) /* the opposite walls */
                for (int k = 0; k < 3; k++)
                    at[k] = k == 1 ? 2 - x[k] : -x[k];
            WallSums sums;
            walls_at(&t.walls, at, &sums);
            const double n0 = t.lattice.number_density;
            if (fabs(sums.number_density - density) > 0.01 * (n0 + density))
                fail_msg("%d faces at %g %g %g: number density %g, the sum is %g", faces, d[0], d[1], d[2],
                         sums.number_density / n0, density / n0);
            assert_true(fabsf(walls_number_density(&t.walls, at) - sums.number_density) <= 1e-5f * (float)n0);
            const double push_scale = n0 / 0.21, moment_scale = n0;
            for (int k = 0; k < 3; k++) {
                const double p = mirror ? -sums.push[k] : sums.push[k];
                if (fabs(p - push[k]) > 0.04 * (push_scale + fabs(push[k])))
                    fail_msg("%d faces: push %d is %g, the sum is %g", faces, k, p / push_scale,
                             push[k] / push_scale);
            }
            for (int k = 0; k < 6; k++)
                if (fabs(sums.moment[k] - moment[k]) > 0.04 * (moment_scale + fabs(moment[k])))
                    fail_msg("%d faces: moment %d is %g, the sum is %g", faces, k,
                             sums.moment[k] / moment_scale, moment[k] / moment_scale);
        }
    }
    assert_true(scale > 0.3 * t.lattice.number_density);
    walls_destroy(&t.walls);
}

/* The push of an edge or a corner does not fall off towards it, at any support, and is the gradient of the
 * density. */
static void edges_and_corners_push(void **state)
{
    (void)state;
    fixture_needs_cpu("the tables are the same for all backends");
    const double supports[] = {2.1, 2.6, 3};
    for (int m = 0; m < 12; m++) {
        const int dimensions = 2 + m % 2, faces = m / 6 == 0 ? 2 : dimensions;
        const double h = 0.1 * supports[m / 2 % 3];
        Lattice lattice;
        Walls walls;
        lattice_calibrate(dimensions, 0.1, h, &density_kernels[0], &density_kernels[0], &lattice);
        assert_true(walls_create(&walls, (double[3]){2, 2, 2}, (bool[3]){false}, 0.1, h, &density_kernels[0],
                                 &lattice));
        double rest = 0;
        for (int n = 50; n >= 0; n--) {
            const float d = 0.001F * (float)n, aside = 1e-4F, z = faces == 3 ? d : 1;
            WallSums sums;
            walls_at(&walls, (float[3]){d - 1, d, z - 1}, &sums);
            if (n == 50)
                rest = sums.push[0];
            if (!(sums.push[0] > 0.5 * rest))
                fail_msg("%d faces, %g deep: the push is %g of that at rest", faces, 0.1 - d,
                         sums.push[0] / rest);
            const double slope = (walls_number_density(&walls, (float[3]){d + aside - 1, d, z - 1}) -
                                  walls_number_density(&walls, (float[3]){d - 1, d, z - 1})) /
                                 aside * lattice.gradient_scale / lattice.density_scale;
            if (n < 50 && fabs(slope + sums.push[0]) > 0.1 * (rest + sums.push[0]))
                fail_msg("%d faces, %g deep: the push is %g, the density's slope %g", faces, 0.1 - d,
                         sums.push[0], slope);
        }
        walls_destroy(&walls);
    }
}

/* A column of `layers`, and besides a particle in each corner of its floor: it finds its way out. */
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
        cmocka_unit_test(tables_equal_sums),
        cmocka_unit_test(edges_and_corners_push),
        cmocka_unit_test(what_is_in_a_corner_comes_out),
        cmocka_unit_test(nothing_leaves),
        cmocka_unit_test(a_drop_slides_down_freely),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
