/* Periodic sides: neighbours against all pairs with the nearest image, flow through a side, momentum, the
   vortices that fill such a box, what is refused. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/box/box.h"
#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/start/start.h"
#include "sim/state.h"

/* Scattered particles in a box that is periodic along the axes given; the others have walls. */
typedef struct Cloud {
    WorldDef def;
    InitialState initial;
    float *x, *v;
} Cloud;

static const double wide[3] = {1.3, 1.1, 0.9};

static void cloud_make_in(const double size[3], Cloud *out, int dimensions, const char *axes,
                          const char *method, const double shift[3])
{
    Cloud c = {.def = fixture_def(size[0], size[1], size[2])};
    const double area = size[0] * size[1];
    const size_t n = (size_t)(dimensions == 2 ? 105 * area : 930 * area * size[2]);
    uint32_t seed = 7;
    c.def.dimensions = dimensions;
    c.def.support = 2.6;
    memset(c.def.gravity, 0, sizeof c.def.gravity);
    snprintf(c.def.method, sizeof c.def.method, "%s", method);
    c.def.negative_pressure = true;
    c.def.fluids[0].viscosity = 1;
    c.x = malloc(3 * n * sizeof *c.x);
    c.v = malloc(3 * n * sizeof *c.v);
    for (int k = 0; k < 3; k++)
        c.def.periodic[k] = strchr(axes, "xyz"[k]) != NULL;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const double low = k == 1 ? 0 : -0.5 * size[k];
            double at = fixture_random(&seed);
            at += c.def.periodic[k] ? shift[k] / size[k] : 0;
            c.x[3 * i + (size_t)k] = k < dimensions ? (float)(low + size[k] * (at - floor(at))) : 0;
            c.v[3 * i + (size_t)k] = k < dimensions ? (float)(fixture_random(&seed) - 0.5) : 0;
        }
    c.initial = (InitialState){.count = n, .position = c.x, .velocity = c.v};
    *out = c;
    out->def.initial = &out->initial;
}

static void cloud_make(Cloud *out, int dimensions, const char *axes, const char *method,
                       const double shift[3])
{
    cloud_make_in(wide, out, dimensions, axes, method, shift);
}

static void cloud_free(Cloud *c)
{
    free(c->x);
    free(c->v);
}

static const double nowhere[3] = {0};

/* Others within the support radius of each, by all pairs. */
static double brute_neighbours(const Cloud *c)
{
    const double h = c->def.support * c->def.spacing;
    size_t pairs = 0;
    for (size_t i = 0; i < c->initial.count; i++)
        for (size_t j = 0; j < c->initial.count; j++) {
            double r2 = 0;
            for (size_t k = 0; k < 3; k++) {
                double d = (double)c->x[3 * i + k] - (double)c->x[3 * j + k];
                if (c->def.periodic[k])
                    d -= c->def.box_size[k] * rint(d / c->def.box_size[k]);
                r2 += d * d;
            }
            pairs += i != j && r2 < h * h;
        }
    return (double)pairs / (double)c->initial.count;
}

static const char *const sides[] = {"x", "y", "xy", "z", "xz", "xyz"};

/* A row of cells each: wide, three cells along each axis, two and as few as may be. */
static const double boxes[][3] = {{1.3, 1.1, 0.9}, {0.8, 0.78, 0.9}, {0.55, 0.6, 0.53}, {0.52, 0.52, 0.52}};
enum { BOXES = sizeof boxes / sizeof *boxes };

static void neighbours_are_those_of_all_pairs(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int box = 0; box < BOXES; box++)
        for (int dimensions = 2; dimensions <= 3; dimensions++)
            for (int k = 0; k < (dimensions == 2 ? 3 : 6); k++) {
                Cloud c;
                cloud_make_in(boxes[box], &c, dimensions, sides[k], "mueller", nowhere);
                World *world = fixture_world(&c.def);
                WorldSums sums;
                world_sums(world, &sums);
                const double pair = 1.01 / (double)c.initial.count; /* at the very edge of the radius */
                const double right = brute_neighbours(&c);
                if (!(fabs(sums.neighbours_mean - right) <= 2 * pair))
                    fail_msg("box %d, %dD, periodic in %s: %g neighbours, not %g", box, dimensions, sides[k],
                             sums.neighbours_mean, right);
                world_destroy(world);
                cloud_free(&c);
            }
}

/* 2D and all sides, so that no wall adds. */
static void check_densities(const Cloud *c)
{
    const double h = c->def.support * c->def.spacing, *size = c->def.box_size;
    World *world = fixture_world(&c->def);
    State s = fixture_read(world);
    double lattice = 0;
    for (int i = -3; i <= 3; i++)
        for (int j = -3; j <= 3; j++)
            lattice += pow(fmax(1 - c->def.spacing * hypot(i, j) / h, 0), 3);
    for (size_t i = 0; i < s.count; i++) {
        double sum = 0;
        for (size_t j = 0; j < s.count; j++) {
            double dx = (double)c->x[3 * i] - (double)c->x[3 * j],
                   dy = (double)c->x[3 * i + 1] - (double)c->x[3 * j + 1];
            dx -= size[0] * rint(dx / size[0]);
            dy -= size[1] * rint(dy / size[1]);
            sum += pow(fmax(1 - hypot(dx, dy) / h, 0), 3);
        }
        assert_float_equal((double)s.position[4 * i + 3] * sum / lattice, c->def.spacing * c->def.spacing,
                           2e-6 * c->def.spacing * c->def.spacing);
    }
    fixture_free(&s);
    world_destroy(world);
}

/* Densities against the sum over all pairs. */
static void densities_are_sums_over_the_nearest_images(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int box = 0; box < BOXES; box++) {
        Cloud c;
        cloud_make_in(boxes[box], &c, 2, "xy", "mueller", nowhere);
        check_densities(&c);
        cloud_free(&c);
    }
}

typedef enum Terms { ONE_FLUID, TWO_FLUIDS, IMPLICIT, TERMS } Terms;

/* What pairs ask of each other beside places and velocities. `fluid`: of each particle. */
static void add_terms(Cloud *c, Terms terms, const uint8_t *fluid)
{
    WorldDef *def = &c->def;
    const bool continuity = strcmp(def->method, "wcsph") == 0;
    def->dt = 1e-4;
    wcsph_def(def)->delta_sph = continuity ? 0.1 : 0;
    wcsph_def(def)->shifting = continuity ? 0.1 : 0;
    wcsph_def(def)->corrected_gradient = terms == TWO_FLUIDS;
    def->tension_model = TENSION_COHESION;
    def->fluids[0].surface_tension = 1;
    if (terms == ONE_FLUID)
        return;
    def->viscosity_solver = terms == IMPLICIT ? VISCOSITY_IMPLICIT : VISCOSITY_EXPLICIT;
    def->fluids[1] = (FluidDef){.name = "oil", .density = 1200, .viscosity = 20, .surface_tension = 2};
    def->fluid_count = 2;
    c->initial.fluid = fluid;
}

/* The greatest difference of two states, over the greatest of their changes. */
static double difference(const State *s, const State *t, const Cloud *begin)
{
    double most = 0, worst = 0, dense = 0;
    for (size_t i = 0; i < s->count; i++) {
        dense = fmax(dense, fabs((double)(s->density[i] / t->density[i]) - 1));
        for (size_t k = 0; k < 3; k++) {
            const double change = (double)s->velocity[4 * i + k] - (double)begin->v[3 * i + k];
            most = fmax(most, fabs(change));
            worst = fmax(worst, fabs((double)s->velocity[4 * i + k] - (double)t->velocity[4 * i + k]));
        }
    }
    return fmax(worst / most, dense);
}

/* All forces, of a cloud and of the same one moved through its sides. */
static void check_shifted(const double size[3], int dimensions, const char *method, Terms terms)
{
    const double shift[3] = {0.41, 0.63, 0.77};
    const char *axes = dimensions == 2 ? "x" : "xz";
    uint8_t fluid[2000];
    Cloud a, b;
    for (int i = 0; i < 2000; i++)
        fluid[i] = i % 2;
    cloud_make_in(size, &a, dimensions, axes, method, nowhere);
    cloud_make_in(size, &b, dimensions, axes, method, shift);
    assert_true(a.initial.count <= sizeof fluid);
    add_terms(&a, terms, fluid);
    add_terms(&b, terms, fluid);
    World *one = fixture_world(&a.def), *other = fixture_world(&b.def);
    fixture_step(one, 3);
    fixture_step(other, 3);
    State s = fixture_read(one), t = fixture_read(other);
    const double differ = difference(&s, &t, &a);
    if (!(differ < 1e-3))
        fail_msg("%s, %dD, %g m wide, terms %d: states differ by %g of their change", method, dimensions,
                 size[0], terms, differ);
    fixture_free(&s);
    fixture_free(&t);
    world_destroy(one);
    world_destroy(other);
    cloud_free(&a);
    cloud_free(&b);
}

/* Where the box's frame begins is no matter along a periodic axis: all forces, of all methods. */
static void a_shifted_cloud_moves_the_same_way(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int box = 0; box < BOXES; box += BOXES - 1)
            for (int m = 0; m < fixture_methods(); m++)
                for (Terms terms = 0; terms < TERMS; terms++)
                    check_shifted(boxes[box], dimensions, fixture_method_names[m], terms);
}

static float wrapped(const Periodic *periodic, float at)
{
    float x[3] = {at, at, at};
    periodic_wrap(periodic, x, NULL);
    for (int k = 0; k < 2; k++) {
        const float from = x[k] - periodic->low[k], rounding = 1e-7F * periodic->size[k];
        assert_true(from >= -rounding && from <= periodic->size[k] + rounding);
    }
    assert_true(x[2] == at); /* has walls */
    return x[0];
}

/* At the very sides, next to them, and many boxes away; twice is once. */
static void places_are_wrapped_into_the_box(void **state)
{
    (void)state;
    const float sizes[] = {1, 0.4F, 1.3F, 1.0F / 3, 24};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const float size = sizes[k], half = 0.5F * size;
        const Periodic p = {true, {true, true, false}, {-half, 0, -half}, {size, size, size}};
        assert_true(wrapped(&p, half) == -half && wrapped(&p, -half) == -half);
        const float beside[] = {nextafterf(half, 0), nextafterf(-half, -1e9F), nextafterf(half, 1e9F),
                                -1e-30F, nextafterf(size, 1e9F)};
        for (int i = 0; i < 5; i++) {
            const float x = wrapped(&p, beside[i]), off = x - beside[i];
            assert_float_equal(off, size * roundf(off / size), 2e-7F * size);
            const float again = wrapped(&p, x) - x;
            assert_float_equal(again, size * roundf(again / size), 2e-7F * size);
        }
        for (int boxes_away = -40; boxes_away <= 40; boxes_away++) {
            const float x = wrapped(&p, 0.3F * half + (float)boxes_away * size);
            assert_float_equal(x, 0.3F * half, 1e-5F * size);
            assert_true(wrapped(&p, x) == x);
        }
    }
}

/* A lattice that flows through the sides stays one, to the rounding of places. */
static void a_lattice_flows_through_the_sides(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int m = 0; m < fixture_methods(); m++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            WorldDef def = fixture_def(1, 0.8, 0.7);
            def.dimensions = dimensions;
            def.dt = 0.004;
            snprintf(def.method, sizeof def.method, "%s", fixture_method_names[m]);
            memset(def.gravity, 0, sizeof def.gravity);
            def.periodic[0] = def.periodic[1] = true;
            def.periodic[2] = dimensions == 3;
            def.fluids[0].velocity[0] = 3;
            def.fluids[0].velocity[1] = -2;
            fixture_block(&def, 0, -0.5, 0, -0.35, 0.5, 0.8, 0.35);
            World *world = fixture_world(&def);
            State before = fixture_read(world);
            assert_int_equal(before.count, dimensions == 2 ? 80 : 560);
            fixture_step(world, 125); /* 0.5 s: 1.5 and 1.25 boxes */
            State after = fixture_read(world);
            for (size_t i = 0; i < after.count; i++) {
                for (size_t k = 0; k < 3; k++) {
                    const double size = def.box_size[k], way = 0.5 * def.fluids[0].velocity[k];
                    double off = (double)after.position[4 * i + k] - (double)before.position[4 * i + k] - way;
                    off -= size * rint(off / size);
                    assert_float_equal(off, 0, 2e-5);
                    assert_true(fabs((double)after.position[4 * i + k] - (k == 1 ? 0.4 : 0)) <=
                                0.5 * size + 1e-6);
                }
                assert_float_equal(after.density[i], 1000, 0.05);
            }
            fixture_free(&before);
            fixture_free(&after);
            world_destroy(world);
        }
}

static void momentum_is_conserved(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int m = 0; m < fixture_methods(); m++) {
        Cloud c;
        cloud_make(&c, 2, "xy", fixture_method_names[m], nowhere);
        c.def.dt = 2e-4;
        wcsph_def(&c.def)->shifting = m == 1 ? 0.1 : 0;
        wcsph_def(&c.def)->delta_sph = m == 1 ? 0.1 : 0;
        World *world = fixture_world(&c.def);
        WorldSums before, after;
        world_sums(world, &before);
        fixture_step(world, 100);
        world_sums(world, &after);
        for (int k = 0; k < 2; k++)
            assert_float_equal((after.momentum[k] - before.momentum[k]) / after.momentum_scale, 0, 2e-6);
        assert_true(fabs(after.kinetic_energy / before.kinetic_energy - 1) > 0.01); /* progress */
        world_destroy(world);
        cloud_free(&c);
    }
}

/* In a box without walls the fluid goes its own way: seen from the box, against it. */
static void a_box_that_shakes_passes_the_fluid(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    WorldDef def = fixture_def(1, 0.8, 0.7);
    def.dimensions = 2;
    memset(def.gravity, 0, sizeof def.gravity);
    def.periodic[0] = true;
    fixture_block(&def, 0, -0.5, 0, 0, 0.5, 0.8, 0);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.7, .frequency = 1});
    def.fluids[0].velocity[0] = -0.7 * 2 * M_PI; /* at rest in the world */
    World *world = fixture_world(&def);
    State before = fixture_read(world);
    fixture_step(world, 125); /* a quarter of a second: amplitude */
    State after = fixture_read(world);
    for (size_t i = 0; i < after.count; i++) {
        double off = (double)after.position[4 * i] - (double)before.position[4 * i] + 0.7;
        assert_float_equal(off - rint(off), 0, 2e-4);
        assert_float_equal(after.velocity[4 * i], 0, 2e-3);
    }
    fixture_free(&before);
    fixture_free(&after);
    world_destroy(world);
}

static void a_hand_moves_it_and_does_not_turn_it(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    Cloud c;
    cloud_make(&c, 2, "x", "mueller", nowhere);
    World *world = fixture_world(&c.def);
    const BoxTarget target = {.position = {0.3, 0, 0}, .orientation = {0, 0, sin(0.2), cos(0.2)}};
    WorldInfo info;
    world_carry_box(world, &target);
    world_info(world, &info);
    assert_float_equal(info.box.position[0], 0.3, 1e-12);
    assert_float_equal(info.box.orientation[2], 0, 1e-12);
    world_destroy(world);
    cloud_free(&c);
}

/* At the end of a step nobody stands outside a periodic side. */
static void check_places(World *world, const WorldDef *def)
{
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++)
        for (size_t k = 0; k < 3; k++)
            if (def->periodic[k])
                assert_true(fabs((double)s.position[4 * i + k]) <= 0.5 * def->box_size[k] + 1e-6);
    fixture_free(&s);
}

/* Also where somebody goes through a side at once: all fly along x, some mm a step. */
static void check_saved(const char *method)
{
    Cloud c;
    cloud_make(&c, 3, "xz", method, nowhere);
    c.def.dt = 1e-3;
    for (size_t i = 0; i < c.initial.count; i++)
        c.v[3 * i] += 6;
    if (strcmp(method, "wcsph") == 0)
        wcsph_def(&c.def)->shifting = wcsph_def(&c.def)->delta_sph = 0.1;
    c.def.reproducible = true; /* a GPU else sorts as it comes */
    World *one = fixture_world(&c.def), *other = fixture_world(&c.def);
    WorldState saved = {.count = 0};
    Error error;
    for (int k = 0; k < 4; k++) {
        fixture_step(one, 2);
        check_places(one, &c.def);
        assert_true(world_save(one, &saved, &error));
        assert_true(world_load(other, &saved, &error));
        fixture_step(one, 1);
        fixture_step(other, 1);
        if (world_hash(one) != world_hash(other))
            fail_msg("%s: a state that was loaded goes on otherwise", method);
    }
    world_state_free(&saved);
    world_destroy(one);
    world_destroy(other);
    cloud_free(&c);
}

static void a_saved_state_goes_on_to_the_bit(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    for (int m = 0; m < fixture_methods(); m++)
        check_saved(fixture_method_names[m]);
}

/* A jet through a side comes in on the other, and the next layers find room. */
static void a_jet_goes_through_a_side(void **state)
{
    (void)state;
    fixture_needs("emitters");
    WorldDef def = fixture_def(1, 0.8, 0.7);
    def.dimensions = 2;
    memset(def.gravity, 0, sizeof def.gravity);
    def.periodic[0] = true;
    def.most = 400;
    add_emit(&def.fluids[0],
             (Emit){.centre = {0.45, 0.4, 0}, .direction = {1, 0, 0}, .radius = 0.1, .speed = 2});
    World *world = fixture_world(&def);
    fixture_step(world, 150); /* 0.3 s: 0.6 m */
    State s = fixture_read(world);
    size_t beyond = 0;
    for (size_t i = 0; i < s.count; i++)
        beyond += s.position[4 * i] < 0.2F;
    assert_int_equal(s.count, 12); /* six layers of two */
    assert_true(beyond > 9);
    fixture_free(&s);
    world_destroy(world);
}

/* A particle near an emitter across a periodic side blocks a place like any particle. */
static void nothing_comes_where_something_is(void **state)
{
    (void)state;
    fixture_needs("emitters");
    for (int n = 0; n < 8; n++) {
        const int axis = n / 2 % 2 ? 0 : 2, out = n / 4 ? 1 : -1, near = n % 2;
        float x[3] = {0, 0.4F, 0};
        WorldDef def = fixture_def(1, 0.8, 1);
        memset(def.gravity, 0, sizeof def.gravity);
        def.periodic[axis] = true;
        def.most = 10;
        x[axis] = (float)(-0.48 * out + (near ? 0 : 0.2 * out));
        def.initial = &(InitialState){.count = 1, .position = x};
        add_emit(&def.fluids[0],
                 (Emit){.centre = {0, 0.4, 0}, .direction = {0, 1, 0}, .radius = 0.04, .speed = 1})
            ->centre[axis] = 0.49 * out;
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        State s = fixture_read(world);
        assert_int_equal(s.count, near ? 1 : 2);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* 1.04 m hold ten particles: 0.104 m apart, across the side as well. */
static void the_lattice_has_no_seam(void **state)
{
    (void)state;
    fixture_needs("periodic sides");
    WorldDef def = fixture_def(1.04, 0.8, 0.96);
    def.periodic[0] = def.periodic[2] = true;
    fixture_block(&def, 0, -0.52, 0, -0.48, 0.52, 0.8, 0.48);
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    assert_int_equal(s.count, 10 * 8 * 10);
    const double step[3] = {0.104, 0.1, 0.096};
    for (size_t i = 1; i < s.count; i++)
        for (size_t k = 0; k < 3; k++) {
            const double steps = ((double)s.position[4 * i + k] - (double)s.position[k]) / step[k];
            assert_float_equal(steps, rint(steps), 1e-4);
        }
    fixture_free(&s);
    world_destroy(world);
}

/* Steady without friction: rho (v . grad) v = -grad p, div v = 0, the same at both sides; the start's
   density matches the pressure. */
static void vortices_hold_each_other(void **state)
{
    (void)state;
    fixture_needs("method wcsph");
    WorldDef def = fixture_def(1.3, 0.8, 1);
    const double e = 1e-3, c2 = 20.0 * 20.0;
    def.dimensions = 2;
    def.sound_speed = 20;
    def.negative_pressure = true;
    def.periodic[0] = def.periodic[1] = true;
    def.fluids[0].taylor_green = 1.5;
    memset(def.gravity, 0, sizeof def.gravity);
    snprintf(def.method, sizeof def.method, "wcsph");
    for (int i = 0; i < 40; i++) {
        const double at[2] = {0.031 * i - 0.6, 0.019 * i};
        double p[5], v[5][3];
        for (int n = 0; n < 5; n++) { /* here, right, left, above, below */
            const float x[3] = {(float)(at[0] + (n == 1   ? e
                                                 : n == 2 ? -e
                                                          : 0)),
                                (float)(at[1] + (n == 3   ? e
                                                 : n == 4 ? -e
                                                          : 0)),
                                0};
            float flow[3] = {0};
            p[n] = vortices_add(&def, &def.fluids[0], x, flow);
            for (int k = 0; k < 3; k++)
                v[n][k] = (double)flow[k];
        }
        const double ux = (v[1][0] - v[2][0]) / (2 * e), uy = (v[3][0] - v[4][0]) / (2 * e),
                     vx = (v[1][1] - v[2][1]) / (2 * e), vy = (v[3][1] - v[4][1]) / (2 * e);
        assert_float_equal(ux + vy, 0, 0.01);
        assert_float_equal(1000 * (v[0][0] * ux + v[0][1] * uy) + (p[1] - p[2]) / (2 * e), 0, 40);
        assert_float_equal(1000 * (v[0][0] * vx + v[0][1] * vy) + (p[3] - p[4]) / (2 * e), 0, 40);
    }
    fixture_block(&def, 0, -0.65, 0, 0, 0.65, 0.8, 0);
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    double most = 0;
    for (size_t i = 0; i < s.count; i++) {
        float flow[3] = {0};
        const double p = vortices_add(&def, &def.fluids[0], s.position + 4 * i, flow);
        most = fmax(most, fabs(p));
        assert_float_equal(s.density[i], 1000 + p / c2, 1e-3);
        assert_float_equal(s.velocity[4 * i], flow[0], 1e-5);
        assert_float_equal(s.velocity[4 * i + 1], flow[1], 1e-5);
    }
    assert_true(most > 500); /* rho U^2 / 4 is 560 */
    fixture_free(&s);
    world_destroy(world);
}

static void refused(WorldDef *def, const char *phrase)
{
    Error error = {0};
    World *world = world_create(def, &error);
    if (world || !strstr(error.message, phrase))
        fail_msg("expected '%s', got '%s'", phrase, world ? "a world" : error.message);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    def.periodic[0] = true;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.5, 0.5);
    WorldDef bad = def;
    bad.box_size[0] = 0.4;
    refused(&bad, "two support radii wide");
    bad = def;
    bad.dimensions = 2;
    bad.periodic[2] = true;
    refused(&bad, "no sides in z");
    bad = def;
    add_motion(&bad, (Motion){.kind = MOTION_SPIN, .axis = {0, 1, 0}, .rate = 1});
    refused(&bad, "does not turn");
    bad = def;
    bad.solids[bad.solid_count++] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0.4, 0.5, 0}, .radius = 0.2};
    refused(&bad, "over a periodic side");
    bad = def;
    snprintf(bad.backend, sizeof bad.backend, "fragment");
    if (fixture_on_fragment())
        refused(&bad, "has no periodic sides");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_are_those_of_all_pairs),
        cmocka_unit_test(densities_are_sums_over_the_nearest_images),
        cmocka_unit_test(a_shifted_cloud_moves_the_same_way),
        cmocka_unit_test(places_are_wrapped_into_the_box),
        cmocka_unit_test(a_lattice_flows_through_the_sides),
        cmocka_unit_test(momentum_is_conserved),
        cmocka_unit_test(a_box_that_shakes_passes_the_fluid),
        cmocka_unit_test(a_hand_moves_it_and_does_not_turn_it),
        cmocka_unit_test(a_saved_state_goes_on_to_the_bit),
        cmocka_unit_test(a_jet_goes_through_a_side),
        cmocka_unit_test(nothing_comes_where_something_is),
        cmocka_unit_test(the_lattice_has_no_seam),
        cmocka_unit_test(vortices_hold_each_other),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
