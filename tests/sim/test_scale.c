/* A scene and a scaled scene move the same. Lengths times 4^k and times times 2^k leave gravity
   unchanged. With all else scaled to match, each number of a step is the same up to a power of two,
   without rounding: the motion has the same bits on the CPU. Overflow of floats, or comparison with a
   fixed length, speed or mass, shows as a difference. */
#include "tests/lists.h"
#include "tests/sim/fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/methods/pbf/pbf.h"
#include "sim/methods/wcsph/wcsph.h"

/* Spacings of 1e-6, 1e-3, 1 (with which the others are compared) and 260 m. */
static const int exponents[] = {0, -10, -5, 4};
enum { SCALES = sizeof exponents / sizeof *exponents };

/* Units of a scale. */
typedef struct Units {
    double length, time, speed, viscosity, tension;
} Units;

static Units units_of(int exponent)
{
    const double t = ldexp(1, exponent), l = t * t, v = t;
    return (Units){l, t, v, l * v, l * l};
}

typedef enum Form { THREE, PLANE, FORMS } Form;

typedef struct Case {
    const char *name, *method;
    int tension;      /* a TensionModel */
    double viscosity; /* in units of the scale */
    bool implicit, no_slip, two, solid, moves, periodic, emits, floats, lies, cfl, negative, hydrostatic;
    const char *kernel; /* wcsph, and mueller's of density */
    double delta, shifting;
    bool radial, corrected;
} Case;

static const Case cases[] = {
    {"plain", "mueller", .cfl = false},
    {"poly6", "mueller", .kernel = "poly6", .viscosity = 1},
    {"quintic, two, solid", "mueller", .kernel = "quintic", .viscosity = 1, .two = true, .solid = true},
    {"pulls", "mueller", .viscosity = 1, .negative = true},
    {"colour field, two", "mueller", .tension = TENSION_COLOUR_FIELD, .viscosity = 1, .two = true},
    {"cohesion", "mueller", .tension = TENSION_COHESION, .viscosity = 0.1},
    {"no slip, solid", "mueller", .viscosity = 1, .no_slip = true, .solid = true},
    {"moves, cfl", "mueller", .viscosity = 0.5, .moves = true, .cfl = true},
    {"implicit", "mueller", .viscosity = 200, .implicit = true, .no_slip = true},
    {"emits, periodic", "mueller", .viscosity = 0.5, .emits = true, .periodic = true},
    {"plain", "wcsph", .cfl = false},
    {"cfl, hydrostatic", "wcsph", .cfl = true, .hydrostatic = true},
    {"diffusion, shifting", "wcsph", .kernel = "wendland_c2", .delta = 0.1, .shifting = 0.2, .moves = true},
    {"corrected, shifting", "wcsph", .kernel = "quintic", .delta = 0.1, .shifting = 0.2, .corrected = true,
     .radial = true, .viscosity = 1},
    {"curvature", "wcsph", .tension = TENSION_CURVATURE, .kernel = "wendland_c2", .shifting = 0.2},
    {"colour field, solid", "wcsph", .tension = TENSION_COLOUR_FIELD, .solid = true},
    {"cohesion, two", "wcsph", .tension = TENSION_COHESION, .viscosity = 1, .two = true},
    {"no slip, pulls", "wcsph", .viscosity = 1, .no_slip = true, .negative = true},
    {"implicit, solid", "wcsph", .viscosity = 200, .implicit = true, .solid = true},
    {"floats", "wcsph", .floats = true},
    {"lies on the floor", "wcsph", .floats = true, .lies = true},
    {"plain", "dfsph", .cfl = false},
    {"no slip, two", "dfsph", .viscosity = 1, .no_slip = true, .two = true},
    {"cohesion, solid", "dfsph", .tension = TENSION_COHESION, .viscosity = 1, .solid = true},
    {"colour field, cfl", "dfsph", .tension = TENSION_COLOUR_FIELD, .viscosity = 1, .cfl = true},
    {"implicit, moves", "dfsph", .viscosity = 200, .implicit = true, .moves = true},
    {"floats, hydrostatic", "dfsph", .floats = true, .hydrostatic = true},
    {"plain", "pbf", .cfl = false},
    {"viscous, solid", "pbf", .viscosity = 1, .solid = true},
    {"cohesion, two", "pbf", .tension = TENSION_COHESION, .viscosity = 1, .two = true},
    {"colour field", "pbf", .tension = TENSION_COLOUR_FIELD, .viscosity = 1},
    {"implicit, emits", "pbf", .viscosity = 200, .implicit = true, .emits = true},
};

static void method_settings(const Case *c, WorldDef *def)
{
    WcsphDef *own = wcsph_def(def);
    snprintf(def->method, sizeof def->method, "%s", c->method);
    if (c->kernel && strcmp(c->method, "mueller") == 0)
        snprintf(mueller_def(def)->density_kernel, NAME_SIZE, "%s", c->kernel);
    else if (c->kernel)
        snprintf(own->kernel, NAME_SIZE, "%s", c->kernel);
    own->delta_sph = c->delta;
    own->shifting = c->shifting;
    own->corrected_gradient = c->corrected;
    own->viscosity_form = c->radial ? VISCOSITY_RADIAL : VISCOSITY_MORRIS;
}

static void solids_of(const Case *c, const Units *u, WorldDef *def)
{
    if (!c->solid && !c->floats)
        return;
    def->solids[def->solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE,
                   .centre = {0.3 * u->length, (c->lies ? 1.91 : 2.6) * u->length, 0},
                   .radius = 1.9 * u->length,
                   .slip = c->viscosity > 0 ? SLIP_NONE : SLIP_FREE,
                   .density = c->lies     ? 3000
                              : c->floats ? 500
                                          : 0};
}

static void motions_of(const Case *c, const Units *u, WorldDef *def)
{
    if (!c->moves)
        return;
    add_motion(def, (Motion){.kind = MOTION_SHAKE,
                             .axis = {1, 0, 0},
                             .amplitude = 0.4 * u->length,
                             .frequency = 0.5 / u->time});
    add_motion(def, (Motion){.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 0.5 / u->time});
}

static void flow_of(const Case *c, const Units *u, WorldDef *def)
{
    FluidDef *fluid = &def->fluids[0];
    if (!c->emits)
        return;
    add_emit(fluid, (Emit){.centre = {0, 6.5 * u->length, 0},
                           .direction = {0, -1, 0},
                           .radius = 1.2 * u->length,
                           .speed = 4 * u->speed});
    def->most = 1000;
}

/* A block of fluid between two walls of a box of eight spacings. */
static WorldDef def_of(const Case *c, Form form, int exponent)
{
    const Units u = units_of(exponent);
    const double l = u.length, depth = form == PLANE ? 1 : 8;
    WorldDef def = fixture_def(8 * l, 8 * l, depth * l);
    def.dimensions = form == PLANE ? 2 : 3;
    def.spacing = l;
    def.support = 2.1;
    def.sound_speed = 60 * u.speed;
    def.dt = 0.01 * u.time;
    def.max_dt = 0.01 * u.time;
    def.step_mode = c->cfl ? STEP_CFL : STEP_FIXED;
    def.retries = strcmp(c->method, "pbf") == 0 ? 0 : 3;
    def.jitter = 0.2;
    def.negative_pressure = c->negative;
    def.tension_model = c->tension;
    def.viscosity_solver = c->implicit ? VISCOSITY_IMPLICIT : VISCOSITY_EXPLICIT;
    def.wall_slip = c->no_slip ? SLIP_NONE : SLIP_FREE;
    def.lid[0] = c->no_slip ? 2 * u.speed : 0;
    def.periodic[0] = c->periodic;
    def.fluid_count = c->two ? 2 : 1;
    for (int f = 0; f < def.fluid_count; f++)
        def.fluids[f] = (FluidDef){.density = f ? 500 : 1000,
                                   .viscosity = 1000 * c->viscosity * u.viscosity * (f ? 0.5 : 1),
                                   .surface_tension = c->tension ? 1000 * u.tension : 0,
                                   .contact_angle = 60,
                                   .start = c->hydrostatic ? START_HYDROSTATIC : START_REST,
                                   .velocity = {u.speed, -0.5 * u.speed, 0}};
    fixture_block(&def, 0, -4 * l, 0, -4 * l, l, 4 * l, 4 * l);
    if (c->two)
        fixture_block(&def, 1, -4 * l, 4 * l, -4 * l, l, 6 * l, 4 * l);
    method_settings(c, &def);
    solids_of(c, &u, &def);
    motions_of(c, &u, &def);
    flow_of(c, &u, &def);
    return def;
}

/* Results after some steps, in scaled units. */
typedef struct Seen {
    State state;
    WorldSums sums;
    WorldGauge gauge;
    Forces forces;
    double time;
} Seen;

static void in_units(Seen *seen, const Units *u, int dimensions)
{
    State *s = &seen->state;
    const double volume = pow(u->length, dimensions), energy = volume * u->speed * u->speed;
    for (size_t i = 0; i < s->count; i++) {
        for (int k = 0; k < 3; k++) {
            s->position[4 * i + (size_t)k] /= (float)u->length;
            s->velocity[4 * i + (size_t)k] /= (float)u->speed;
        }
        s->position[4 * i + 3] /= (float)volume;
        s->pressure[i] /= (float)(u->speed * u->speed);
    }
    seen->sums.mass /= volume;
    seen->sums.kinetic_energy /= energy;
    seen->gauge.kinetic_energy /= energy;
    seen->gauge.compression_energy /= energy;
    seen->forces.box.force[1] /= energy / u->length;
    seen->forces.solid[0].force[1] /= energy / u->length;
    seen->time /= u->time;
}

static Seen seen_of(const Case *c, Form form, int exponent)
{
    const Units u = units_of(exponent);
    const WorldDef def = def_of(c, form, exponent);
    const char *what = c->name;
    Error error = {{0}};
    WorldInfo info;
    Seen seen = {.time = 0};
    World *world = world_create(&def, &error);
    if (!world || (!fixture_on_fragment() && !world_enable_forces(world, &error)))
        fail_msg("%s %s at 4^%d: %s", c->method, what, exponent, error.message);
    for (int i = 0; i < fixture_count(12, 6); i++)
        if (!world_step(world, NULL, &error))
            fail_msg("%s %s at 4^%d: %s", c->method, what, exponent, error.message);
    if (!world_is_valid(world))
        fail_msg("%s %s at 4^%d is in trouble", c->method, what, exponent);
    world_info(world, &info);
    seen.time = info.time;
    seen.state = fixture_read(world);
    world_sums(world, &seen.sums);
    world_gauge_request(world);
    while (!world_gauge(world, &seen.gauge))
        ;
    if (!fixture_on_fragment())
        world_forces(world, &seen.forces);
    world_destroy(world);
    in_units(&seen, &u, def.dimensions);
    return seen;
}

/* On a GPU a driver may divide in other ways. */
static bool same(double a, double b, double scale)
{
    return fixture_on_cpu() ? a == b : fabs(a - b) <= 1e-4 * scale;
}

#define CHECK(value, scale)                                                                                  \
    do {                                                                                                     \
        if (!same((double)one->value, (double)other->value, (double)(scale)))                                \
            fail_msg("%s, %s, %d dimensions, 4^%d: " #value " of %zu is %.9g, not %.9g", c->method, c->name, \
                     form == PLANE ? 2 : 3, exponent, i, (double)other->value, (double)one->value);          \
    } while (0)

/* Exact sums are rounded by way of bins that are no powers of four apart. */
static void check_force(const Case *c, const Push *one, const Push *other)
{
    const double a = one->force[1], b = other->force[1];
    if (!(fabs(a - b) <= (fixture_on_cpu() ? 1e-14 : 1e-4) * fabs(a)))
        fail_msg("%s, %s: a force is %.17g, not %.17g", c->method, c->name, b, a);
}

static void compare(const Case *c, Form form, int exponent, const Seen *one, const Seen *other)
{
    const double c2 = 1000 * 3600;
    size_t i = 0;
    assert_true(one->state.count == other->state.count);
    for (; i < one->state.count; i++) {
        for (size_t k = 0; k < 3; k++) {
            CHECK(state.position[4 * i + k], 8);
            CHECK(state.velocity[4 * i + k], 8);
        }
        CHECK(state.position[4 * i + 3], 1);
        CHECK(state.density[i], 1000);
        CHECK(state.pressure[i], c2);
    }
    CHECK(time, 1);
    CHECK(sums.mass, one->sums.mass);
    CHECK(sums.kinetic_energy, one->sums.kinetic_energy);
    CHECK(gauge.kinetic_energy, one->gauge.kinetic_energy);
    CHECK(gauge.compression_energy, one->gauge.kinetic_energy);
    check_force(c, &one->forces.box, &other->forces.box);
    check_force(c, &one->forces.solid[0], &other->forces.solid[0]);
}

/* On a GPU each case is of one number of dimensions; fragment has few. */
static bool there(const Case *c, bool first)
{
    const bool many = c->tension || c->no_slip || c->solid || c->floats || c->periodic || c->emits ||
                      c->implicit || strcmp(c->method, "mueller") != 0;
    return fixture_on_cpu() || (first && !(fixture_on_fragment() && many));
}

static void scales_move_the_same(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (Form form = THREE; form < FORMS; form++) {
            const Case *c = &cases[k];
            if (!there(c, k % FORMS == (size_t)form))
                continue;
            Seen one = seen_of(c, form, exponents[0]);
            assert_true(one.sums.kinetic_energy > 0 && isfinite(one.sums.kinetic_energy));
            for (int s = 1; s < SCALES; s++) {
                Seen other = seen_of(c, form, exponents[s]);
                compare(c, form, exponents[s], &one, &other);
                fixture_free(&other.state);
            }
            fixture_free(&one.state);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scales_move_the_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
