/* Worlds on two backends, from the same states. */
#ifndef SLOSH_TEST_COMPARE_H
#define SLOSH_TEST_COMPARE_H

#include "tests/render/fixture.h"
#include "tests/sim/fixture.h"

#include "app/scene/scene.h"
#include "sim/gpu/gl.h"
#include "sim/step/world.h"

static inline int compare_setup(void **state)
{
    if (context_setup(state) != 0)
        return 1;
    backends_add();
    return 0;
}

/* Fluid in the half of a box of 0.8 m, with the sentinel. */
static inline WorldDef pool_on(const char *backend, const char *method)
{
    WorldDef def = fixture_def(0.8, 0.6, 0.5);
    def.sound_speed = 20;
    def.dt = 0.0005;
    def.retries = 3;
    def.reproducible = false;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    snprintf(def.method, sizeof def.method, "%s", method);
    fixture_block(&def, 0, -0.4, 0, -0.25, 0.2, 0.3, 0.25);
    return def;
}

static inline World *world_on(WorldDef def, const char *backend)
{
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    return fixture_world(&def);
}

/* The same state on both. */
static inline void copy_state(World *from, World *to)
{
    WorldState saved = {0};
    Error error;
    if (!world_save(from, &saved, &error) || !world_load(to, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

static inline WorldInfo info_of(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info;
}

/* A shipped scene, coarser with the same steps. */
static inline WorldDef scene_def(const char *name, double spacing)
{
    SceneSettings settings = {0};
    static Scene scene;
    Error error = {0};
    if (!scene_load(name, &settings, &scene, NULL, &error))
        fail_msg("%s", error.message);
    scene.world.spacing = spacing;
    *world_threads(&scene.world) = 1;
    scene.world.reproducible = true;
    return scene.world;
}

static inline void substeps(World *world, int count)
{
    Error error = {0};
    for (int i = 0; i < count; i++)
        if (!world_substep(world, NULL, &error))
            fail_msg("%s", error.message);
}

/* The same order of particles and sums each time. */
static inline void check_same_each_time(WorldDef def, const char *backend, int steps)
{
    uint64_t hash[2];
    for (int run = 0; run < 2; run++) {
        World *world = world_on(def, backend);
        fixture_step(world, steps);
        hash[run] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1]);
}

/* Save, load, step = step. */
static inline void check_save_load_step(WorldDef def, const char *backend, int steps)
{
    World *world = world_on(def, backend), *other = world_on(def, backend);
    fixture_step(world, steps);
    copy_state(world, other);
    fixture_step(world, steps);
    fixture_step(other, steps);
    assert_true(world_hash(world) == world_hash(other));
    world_destroy(world);
    world_destroy(other);
}

typedef struct Who {
    uint32_t id;
    size_t at;
} Who;

static inline int who_before(const void *a, const void *b)
{
    const uint32_t x = ((const Who *)a)->id, y = ((const Who *)b)->id;
    return x < y ? -1 : x > y;
}

/* Output of world_read for ids with gaps. */
typedef struct Snapshot {
    size_t count;
    Who *who;                                 /* in the order of their ids */
    float *position, *velocity, *compression; /* 4, 4, 1 a particle, in the world's order */
    uint32_t *fluid;
} Snapshot;

static inline Snapshot snapshot_read(World *world)
{
    const size_t n = info_of(world).count;
    Snapshot s = {n,
                  malloc((n + 1) * sizeof *s.who),
                  malloc(16 * n + 1),
                  malloc(16 * n + 1),
                  malloc(4 * n + 1),
                  malloc(4 * n + 1)};
    uint32_t *id = malloc(4 * n + 1);
    ParticleArrays out = {.position = s.position, .velocity = s.velocity, .fluid = s.fluid, .id = id};
    out.scalar[SCALAR_COMPRESSION] = s.compression;
    world_read(world, &out);
    for (size_t i = 0; i < n; i++)
        s.who[i] = (Who){id[i], i};
    qsort(s.who, n, sizeof *s.who, who_before);
    free(id);
    return s;
}

static inline void snapshot_free(Snapshot *s)
{
    free(s->who);
    free(s->position);
    free(s->velocity);
    free(s->compression);
    free(s->fluid);
}

/* Who is furthest off, and by how much. */
typedef struct Worst {
    double off;
    uint32_t id;
    float x[3];
} Worst;

static inline void worst_take(Worst *worst, double off, uint32_t id, const float *x)
{
    if (!(off <= worst->off))
        *worst = (Worst){off, id, {x[0], x[1], x[2]}};
}

static inline double apart(const float *a, const float *b)
{
    return sqrt(pow((double)a[0] - (double)b[0], 2) + pow((double)a[1] - (double)b[1], 2) +
                pow((double)a[2] - (double)b[2], 2));
}

/* Kinetic energy and potential energy of height above the box's floor. */
static inline double energy_of(const WorldDef *def, const WorldSums *sums)
{
    return sums->kinetic_energy - sums->mass * def->gravity[1] * sums->centre[1];
}

static inline int float_before(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Where 99 of 100 particles are left of, m. */
static inline double front_of(World *world)
{
    Snapshot s = snapshot_read(world);
    for (size_t i = 0; i < s.count; i++)
        s.compression[i] = s.position[4 * i];
    qsort(s.compression, s.count, sizeof *s.compression, float_before);
    const double front = s.count > 0 ? (double)s.compression[s.count * 99 / 100] : 0;
    snapshot_free(&s);
    return front;
}

typedef struct Drifted {
    double centre, energy, kinetic, front; /* of the box, of the value, of the value, of the box's width */
} Drifted;

static inline Drifted drifted(const WorldDef *def, World *from, World *to)
{
    WorldSums a, b;
    Drifted off = {0};
    world_sums(from, &a);
    world_sums(to, &b);
    for (int k = 0; k < def->dimensions; k++)
        off.centre = fmax(off.centre, fabs(a.centre[k] - b.centre[k]) / def->box_size[k]);
    off.energy = energy_of(def, &b) / energy_of(def, &a) - 1;
    off.kinetic = b.kinetic_energy / a.kinetic_energy - 1;
    off.front = fabs(front_of(to) - front_of(from)) / def->box_size[0];
    return off;
}

/* The state of `from`, every velocity one bit further along x. */
static inline void copy_nearly(World *from, World *to)
{
    WorldState saved = {0};
    Error error;
    if (!world_save(from, &saved, &error))
        fail_msg("%s", error.message);
    for (size_t i = 0; i < saved.count; i++)
        saved.particles.vx[i] = nextafterf(saved.particles.vx[i], 1);
    if (!world_load(to, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

/* Two worlds continue for some steps from the same state. Centre of mass and the front of 99 % stay
   within 1 % of the box, energy within 1 %. The effect of a changed bit in the CPU's run is printed as a
   lower limit. */
static inline void compare_run(const WorldDef *def, const char *what, World *cpu, World *gpu, int steps)
{
    World *near = world_on(*def, "cpu");
    copy_nearly(cpu, near);
    substeps(cpu, steps);
    substeps(gpu, steps);
    substeps(near, steps);
    const Drifted off = drifted(def, cpu, gpu), floor = drifted(def, cpu, near);
    printf(
        "%s, %d steps on: centre of mass off by %.1e of the box, front by %.1e, energy by %.1e, kinetic energy by "
        "%.1e; cpu after one bit more: %.1e, %.1e, %.1e, %.1e\n",
        what, steps, off.centre, off.front, off.energy, off.kinetic, floor.centre, floor.front, floor.energy,
        floor.kinetic);
    assert_true(off.centre < 0.01 && off.front < 0.01 && fabs(off.energy) < 0.01);
    world_destroy(near);
}

/* Least distance of any particle from any solid at the world's time; fails the test when one has left the
 * box. */
static inline double least_clearance(World *world, const WorldDef *def)
{
    const double time = info_of(world).time;
    Snapshot s = snapshot_read(world);
    BoxState pose[SOLIDS_MAX];
    double least = INFINITY;
    for (int k = 0; k < def->solid_count; k++)
        solid_pose(&def->solids[k], time, &pose[k]);
    for (size_t i = 0; i < s.count; i++) {
        const float *x = s.position + 4 * i;
        assert_true(fabsf(x[0]) <= 0.5 * def->box_size[0] + 1e-6 && x[1] >= 0 &&
                    x[1] <= def->box_size[1] + 1e-6);
        assert_true(def->dimensions == 2 ? x[2] == 0 : fabsf(x[2]) <= 0.5 * def->box_size[2] + 1e-6);
        for (int k = 0; k < def->solid_count; k++) {
            double d[3];
            for (int a = 0; a < 3; a++)
                d[a] = x[a] - pose[k].position[a];
            quat_rotate_inverse(pose[k].orientation, d, d);
            least = fmin(least, solid_distance(&def->solids[k], def->dimensions, d));
        }
    }
    snapshot_free(&s);
    return least;
}

/* Result of a step of each from the same state. */
typedef struct StepOff {
    Worst density, velocity; /* of rest density; m/s */
    double thickened, sped;  /* the greatest changes: of rest density; m/s */
} StepOff;

static inline StepOff step_off(const Snapshot *before, const Snapshot *a, const Snapshot *b)
{
    StepOff off = {0};
    for (size_t k = 0, old = 0; k < a->count; k++) {
        const size_t i = a->who[k].at, j = b->who[k].at;
        const uint32_t id = a->who[k].id;
        const float *x = a->position + 4 * i;
        assert_int_equal(id, b->who[k].id);
        worst_take(&off.density, fabs((double)a->compression[i] - (double)b->compression[j]), id, x);
        worst_take(&off.velocity, apart(a->velocity + 4 * i, b->velocity + 4 * j), id, x);
        while (old < before->count && before->who[old].id < id)
            old++;
        if (old == before->count || before->who[old].id != id)
            continue;
        const size_t was = before->who[old].at;
        off.thickened =
            fmax(off.thickened, fabs((double)a->compression[i] - (double)before->compression[was]));
        off.sped = fmax(off.sped, apart(a->velocity + 4 * i, before->velocity + 4 * was));
    }
    return off;
}

/* A step of two worlds in the same state: density within 1e-5 of rest density. Carried densities within
   3e-5 and 1e-3 of the greatest change: the cpu's lists lack boundary particles that came nearer than h
   in half a drift. Velocity changes within 1e-4 of the greatest; of a method whose velocity is a way over the
   step, at least the rounding of four places. */
static inline void compare_one_step(const char *what, World *cpu, World *gpu)
{
    Snapshot before = snapshot_read(cpu);
    substeps(cpu, 1);
    substeps(gpu, 1);
    Snapshot a = snapshot_read(cpu), b = snapshot_read(gpu);
    assert_int_equal(a.count, b.count);
    const StepOff off = step_off(&before, &a, &b);
    const double least = cpu->constants.method->carries_density ? fmin(3e-5, 1e-3 * off.thickened) : 1e-5;
    const double rounded =
        cpu->constants.method->leaps ? 4 * 0x1p-24 * 0.5 * cpu->def.box_size[0] / cpu->stepping.dt : 0;
    const float *x = off.density.x, *y = off.velocity.x;
    printf(
        "%s: density off by %.1e of rest (particle %u), by %.1e of the greatest change, change of velocity by %.1e "
        "of the greatest (particle %u)\n",
        what, off.density.off, off.density.id, off.density.off / off.thickened, off.velocity.off / off.sped,
        off.velocity.id);
    if (!(off.density.off < least))
        fail_msg("%s: density of particle %u at %g %g %g off by %g of rest", what, off.density.id, x[0], x[1],
                 x[2], off.density.off);
    if (!(off.velocity.off < fmax(1e-4 * off.sped, rounded) && off.sped > 1e-3))
        fail_msg("%s: velocity of particle %u at %g %g %g off by %g of the greatest change", what,
                 off.velocity.id, y[0], y[1], y[2], off.velocity.off / off.sped);
    snapshot_free(&before);
    snapshot_free(&a);
    snapshot_free(&b);
}

#endif
