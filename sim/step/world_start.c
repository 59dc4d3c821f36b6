/* Start of a world: particles from fills or from a given initial state. */
#include "sim/base/key_rows.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"
#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/step/world.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The arrays behind an InitialState made from fills. */
typedef struct Seeds {
    float *position, *velocity;
    uint8_t *fluid;
    float *density;  /* NULL: at rest */
    float *pressure; /* NULL: none */
} Seeds;

static void seeds_free(Seeds *seeds)
{
    free(seeds->position);
    free(seeds->velocity);
    free(seeds->fluid);
    free(seeds->density);
    free(seeds->pressure);
}

/* Keeps moved points within the walls and wraps them over periodic sides. */
static void hold(const Constants *constants, const Seeds *seeds, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        float *x = seeds->position + 3 * i, v[3] = {0};
        walls_guard(&constants->walls, x, v);
        periodic_wrap(&constants->periodic, x, NULL);
    }
}

/* Height of a fluid's surface by formula. */
static bool height_of(const void *context, int fluid, double x, double z, double *y)
{
    const FluidDef *def = &((const WorldDef *)context)->fluids[fluid];
    for (int i = 0; i < def->fill_count; i++)
        if (fill_ends(&def->fills[i], x, z, y))
            return true;
    return false;
}

static bool any_height(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            if (formula_given(def->fluids[f].fills[i].below))
                return true;
    return false;
}

/* Moves seeds to surfaces given by formulas. */
static bool raise_seeds(const Constants *constants, const WorldDef *def, const Seeds *seeds, size_t count)
{
    Balance balance;
    bool all[FLUIDS_MAX];
    memset(all, true, sizeof all);
    const bool ok =
        balance_create(&balance, def, &constants->periodic, count, seeds->position, seeds->fluid, all) &&
        balance_raise(&balance, &(BalanceSurface){height_of, def}, seeds->position);
    balance_destroy(&balance);
    hold(constants, seeds, count);
    return ok;
}

/* Packs seeds around solids without gaps; for methods that carry density, settles the seeds into an
   arrangement that stays. */
static bool fit_seeds(const Constants *constants, const WorldDef *def, const bool take[FLUIDS_MAX],
                      const Seeds *seeds, size_t count)
{
    Balance balance;
    bool ok = balance_create(&balance, def, &constants->periodic, count, seeds->position, seeds->fluid, take);
    if (ok)
        balance_fit(&balance, seeds->position);
    balance_destroy(&balance);
    hold(constants, seeds, count);
    if (ok && constants->method->carries_density)
        ok = packing_settle(&(Packing){def, &constants->lattice, &constants->boundary, take}, count,
                            seeds->fluid, seeds->position);
    hold(constants, seeds, count);
    return ok;
}

/* Adds a component of a fluid's velocity; false if the formula has no value at some particle. */
static bool add_component(const Seeds *seeds, size_t count, int fluid, int axis, const char *text,
                          Error *error)
{
    Formula formula;
    if (!formula_read(text, "xyz", &formula, error))
        return false;
    for (size_t i = 0; i < count; i++) {
        const float *x = seeds->position + 3 * i;
        const double at[3] = {(double)x[0], (double)x[1], (double)x[2]};
        if (seeds->fluid[i] != fluid)
            continue;
        const double value = formula_value(&formula, at);
        if (!isfinite(value))
            return error_set(error, "the velocity \"%s\" has no value at %g %g %g", text, at[0], at[1],
                             at[2]);
        seeds->velocity[3 * i + (size_t)axis] += (float)value;
    }
    return true;
}

/* Adds a component from a velocity table. */
static void add_table(const Seeds *seeds, size_t count, int fluid, int axis, const FieldTable *table)
{
    for (size_t i = 0; i < count; i++) {
        const float *x = seeds->position + 3 * i;
        if (seeds->fluid[i] == fluid)
            seeds->velocity[3 * i + (size_t)axis] +=
                (float)field_table_at(table, axis, (double[]){(double)x[0], (double)x[1], (double)x[2]});
    }
}

/* Formulas and tables must keep the range of the key `velocity` as well. */
static bool check_flow(const WorldDef *def, const Seeds *seeds, size_t count, Error *error)
{
    static const float FASTEST = 1000;
    for (size_t i = 0; i < 3 * count; i++) {
        const float *x = seeds->position + i / 3 * 3;
        if (!(fabsf(seeds->velocity[i]) <= FASTEST))
            return error_set(error,
                             "the fluid '%s' begins with %g m/s at %g %g %g; at most %g along an axis can be",
                             def->fluids[seeds->fluid[i / 3]].name, (double)seeds->velocity[i], (double)x[0],
                             (double)x[1], (double)x[2], (double)FASTEST);
    }
    return true;
}

/* Adds velocities by formula and by table. */
static bool add_flow(const WorldDef *def, const Seeds *seeds, size_t count, Error *error)
{
    bool ok = true;
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        for (int k = 0; ok && k < def->dimensions; k++) {
            if (formula_given(fluid->flow[k]))
                ok = add_component(seeds, count, f, k, fluid->flow[k], error);
            if (fluid->flow_table && fluid->flow_table->value[k])
                add_table(seeds, count, f, k, fluid->flow_table);
        }
    }
    return ok && check_flow(def, seeds, count, error);
}

/* Adds vortices, and for methods that carry density the balancing pressure: p = c^2 (rho - rho0). */
static void add_vortices(const WorldDef *def, const Seeds *seeds, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const FluidDef *fluid = &def->fluids[seeds->fluid[i]];
        const double p = vortices_add(def, fluid, seeds->position + 3 * i, seeds->velocity + 3 * i);
        if (seeds->density && (p > 0 || def->negative_pressure))
            seeds->density[i] += (float)(p / (def->sound_speed * def->sound_speed));
    }
}

/* rho / rho0 - 1 at the given pressure of the method: Newton steps with a slope by differences. */
static double compression_of(const Constants *constants, int fluid, double pressure)
{
    const double c = (double)constants->sound_speed, rest = (double)constants->density[fluid];
    double x = pressure / (rest * c * c);
    for (int i = 0; i < 4; i++) {
        const double by = 1e-3 + 0.01 * fabs(x),
                     at = (double)constants->method->pressure(constants, fluid, (float)x),
                     more = (double)constants->method->pressure(constants, fluid, (float)(x + by));
        x -= (at - pressure) * by / (more - at);
    }
    return x;
}

/* Finds the fluids that start in balance; false if none, too many particles, or no gravity. */
static bool balances(const WorldDef *def, size_t count, bool take[FLUIDS_MAX])
{
    const double *g = def->gravity;
    bool any = false;
    if (count > BALANCE_MOST)
        return false;
    for (int f = 0; f < def->fluid_count; f++) {
        take[f] = def->fluids[f].start == START_HYDROSTATIC;
        any |= take[f];
    }
    return any && (g[0] != 0 || g[1] != 0 || g[2] != 0);
}

/* Sets densities by the method's equation of state and moves positions to match. */
static bool press_seeds(const Constants *constants, Balance *balance, const double gravity[3],
                        const Seeds *seeds, size_t count)
{
    double *compression = malloc((count + 1) * sizeof *compression);
    if (!compression)
        return false;
    for (size_t i = 0; i < count; i++) {
        compression[i] = compression_of(constants, seeds->fluid[i], (double)seeds->pressure[i]);
        seeds->density[i] *= (float)(1 + compression[i]);
    }
    balance_move(balance, gravity, compression, seeds->position);
    hold(constants, seeds, count);
    free(compression);
    return true;
}

/* Starts in balance, under the gravity in the box's first pose. */
static bool balance_seeds(const Constants *constants, const WorldDef *def, const bool take[FLUIDS_MAX],
                          const Seeds *seeds, size_t count)
{
    BoxState box;
    double gravity[3];
    Balance balance;
    bool ok = balance_create(&balance, def, &constants->periodic, count, seeds->position, seeds->fluid, take);
    box_state_at(def->motions, def->motion_count, def->box_size[1], 0, &box);
    quat_rotate_inverse(box.orientation, def->gravity, gravity);
    if (ok) {
        balance_pressure(&balance, gravity, seeds->position, seeds->pressure);
        for (size_t i = 0; i < count; i++)
            if (!take[seeds->fluid[i]] || (seeds->pressure[i] < 0 && !def->negative_pressure))
                seeds->pressure[i] = 0;
        ok = !constants->method->pressure || press_seeds(constants, &balance, gravity, seeds, count);
    }
    balance_destroy(&balance);
    return ok;
}

/* Allocates for `count` particles, with optional density and pressure. */
static bool seeds_create(Seeds *seeds, size_t count, bool dense, bool pressed)
{
    seeds->position = malloc((count + 1) * 3 * sizeof *seeds->position);
    seeds->velocity = calloc(3 * count + 1, sizeof *seeds->velocity);
    seeds->fluid = malloc(count + 1);
    seeds->density = dense ? malloc((count + 1) * sizeof *seeds->density) : NULL;
    seeds->pressure = pressed ? calloc(count + 1, sizeof *seeds->pressure) : NULL;
    return seeds->position && seeds->velocity && seeds->fluid && (seeds->density || !dense) &&
           (seeds->pressure || !pressed);
}

/* Seeds on the lattice, then jitter, surfaces, and solids for fluids in balance (`take` NULL: none). */
static bool place_seeds(const Constants *constants, const WorldDef *def, const bool *take, const Seeds *seeds,
                        size_t count)
{
    seed_lattice(def, seeds->position, seeds->fluid);
    if (def->jitter > 0) {
        seed_jitter(def, seeds->position, count);
        hold(constants, seeds, count);
    }
    return (!any_height(def) || raise_seeds(constants, def, seeds, count)) &&
           (!take || def->solid_count == 0 || fit_seeds(constants, def, take, seeds, count));
}

static bool seeds_make(const Constants *constants, const WorldDef *def, Seeds *seeds, InitialState *initial,
                       Error *error)
{
    bool take[FLUIDS_MAX];
    const size_t count = seed_count(def, def->spacing);
    const bool swirls = vortices_any(def), balanced = count > 0 && balances(def, count, take),
               carries = constants->method->carries_density, dense = balanced || (carries && swirls);
    if ((count == 0 && !flow_emits(def)) || count > INT32_MAX)
        return error_set(error, count ? "more than 2^31 particles; use a larger spacing"
                                      : "the fluids' fills hold no particle; use a smaller spacing");
    if (!seeds_create(seeds, count, dense, balanced))
        return error_set(error, "no memory for %zu particles; use a larger spacing", count);

    if (!place_seeds(constants, def, balanced ? take : NULL, seeds, count))
        return error_set(error, "no memory for %zu particles; use a larger spacing", count);
    for (size_t i = 0; dense && i < count; i++)
        seeds->density[i] = (float)def->fluids[seeds->fluid[i]].density;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++)
            seeds->velocity[3 * i + k] = (float)def->fluids[seeds->fluid[i]].velocity[k];
    if (!add_flow(def, seeds, count, error))
        return false;
    if (balanced && !balance_seeds(constants, def, take, seeds, count))
        return error_set(error, "no memory for %zu particles; use a larger spacing", count);
    if (swirls)
        add_vortices(def, seeds, count);
    *initial = (InitialState){.count = count,
                              .position = seeds->position,
                              .velocity = seeds->velocity,
                              .fluid = seeds->fluid,
                              .density = seeds->density,
                              .pressure = seeds->pressure};
    return true;
}

static bool initial_check(const WorldDef *def, const InitialState *initial, Error *error)
{
    if ((initial->count == 0 && initial->capacity == 0 && !flow_emits(def)) || initial->count > INT32_MAX)
        return error_set(error, "an initial state needs 1 to 2^31 - 1 particles");
    for (size_t i = 0; i < initial->count; i++) {
        const float *x = initial->position + 3 * i;
        if (def->dimensions == 2 && (x[2] != 0 || (initial->velocity && initial->velocity[3 * i + 2] != 0)))
            return error_set(error, "particle %zu is not in the plane of a 2D scene", i);
        if (!isfinite(x[0] + x[1] + x[2]))
            return error_set(error, "the position of particle %zu is not finite", i);
        if (initial->density && !(initial->density[i] > 0 && isfinite(initial->density[i])))
            return error_set(error, "the density of particle %zu is not positive", i);
        if (initial->fluid && initial->fluid[i] >= def->fluid_count)
            return error_set(error, "particle %zu belongs to fluid %d, and there are %d", i,
                             initial->fluid[i], def->fluid_count);
    }
    return true;
}

/* Creates floating solids and requests the forces that move them. */
static bool start_bodies(World *world, Error *error)
{
    const BodiesIn in = {.def = &world->def,
                         .walls = &world->constants.walls,
                         .reach = (double)world->constants.support_radius,
                         .sounds = !world->method->incompressible,
                         .leaps = world->method->leaps};
    return bodies_create(&world->bodies, &in, error) &&
           (!world->bodies ||
            world->backend->enable_forces(world->state, bodies_forces(world->bodies), error));
}

bool world_start(World *world, Error *error)
{
    Seeds seeds = {0};
    InitialState initial = {0};
    const bool given = world->def.initial;
    if (given)
        initial = *world->def.initial;
    bool ok = given ? initial_check(&world->def, &initial, error)
                    : seeds_make(&world->constants, &world->def, &seeds, &initial, error);
    if (ok) {
        world->count = world->initial = initial.count;
        world->capacity = flow_capacity(&world->def, initial.count);
        world->capacity = world->capacity > initial.capacity ? world->capacity : initial.capacity;
        world->state =
            world->backend->create(&world->constants, &world->def, &initial, world->capacity, error);
        ok = world->state && start_bodies(world, error);
    }
    seeds_free(&seeds);
    world->def.initial = NULL;
    return ok;
}

WorldDef world_def_default(void)
{
    WorldDef def = {
        .dimensions = 3,
        .gravity = {0, -9.81, 0},
        .support = 2.1, /* 32 neighbours in the lattice; at exactly 2, neighbours at distance h come and go */
        .backend = "cpu",
        .sound_speed = 20, /* ten times the speed after a fall of 0.2 m: density within 1 % in a scene of a
                              hand's size */
        .viscosity_tolerance = 0.001, /* a thousandth of the forces that drive a flow: below the lattice
                                         error */
        .viscosity_iterations = 200,
        .dt = 0.01, /* a frame of 100 Hz */
        .limits = box_limits_default(),
        .substeps = 10,    /* paper 003's stable setting at 8,192 particles */
        .cfl_number = 0.3, /* three quarters of the stable number of the first method at support 2.1 */
        .max_dt = 0.01,
        .most = 100000, /* some 60 MB, and a frame in a tenth of a second */
        .retries = 3,   /* to an eighth of the step: remaining trouble does not depend on the step */
    };
    snprintf(def.method, sizeof def.method, "%s", method_list()[0]->name);
    methods_default(&def);
    backends_default(&def);
    return def;
}

/* Keys for the choice of method and backend. */

#define AT(field) offsetof(WorldDef, field)

static const char *method_name(int index)
{
    return world_methods()[index].name;
}

static const char *backend_name(int index)
{
    return world_backends()[index].name;
}

/* clang-format off */
const Key method_keys[] = {
    MAPPING("solver", "how the fluid is computed"),
    CHOICE("solver.method", 0, method_name, AT(method), "the equations"),
    KEYS_END,
};

const Key backend_keys[] = {
    CHOICE("solver.backend", L, backend_name, AT(backend), "what computes them"),
    BOOLEAN("solver.acceleration", L | I, AT(acceleration), "the acceleration of particles is kept, for pictures and files: what their velocity changed by in the last step, over its time; true where a view shows it, and once true it stays"),
    KEYS_END,
};
/* clang-format on */
