#include "sim/cpu/cpu.h"
#include "sim/cpu/lanes.h"

#include <math.h>
#include <string.h>

typedef struct DriftJob {
    Cpu *cpu;
    const BoxStep *step;
} DriftJob;

/* Number of times solids and walls held particle i. `sums`: NULL if forces are not requested. */
static size_t guard(const DriftJob *drift, const WallsFar *inside, size_t i, float x[3], float v[3],
                    CpuForceSums *sums)
{
    const Constants *s = drift->cpu->constants;
    const CpuParticles *p = &drift->cpu->now;
    const SolidStep *solids = drift->step->solids;
    const float before[3] = {p->x[i], p->y[i], p->z[i]}, mass = s->mass[p->fluid[i]];
    float free[3] = {v[0], v[1], v[2]};
    WayBounds way = way_bounds(before, x);
    bool by_solid = false, by_wall = false;
    for (int k = 0; solids && k < s->solid_count; k++)
        if (!solid_step_beside(&solids[k], s->dimensions, &way) &&
            solid_guard(&s->solids[k], &solids[k], s->dimensions, before, x, v)) {
            by_solid = true;
            way = way_bounds(before, x);
            cpu_force_of_guard(sums, 1 + k, mass, x, v, free);
        }
    if (walls_near(inside, x)) {
        by_wall = s->method->leaps ? walls_fold(&s->walls, 0.5f / drift->step->dt, x, v)
                                   : walls_guard(&s->walls, x, v);
        cpu_force_of_guard(sums, 0, mass, x, v, free);
    }
    return (size_t)by_solid + (size_t)by_wall;
}

/* place_move of sim/box/box.h. */
static inline f4 four_move(f4 x, f4 *left, f4 way, const bool wide)
{
    const f4 sum = x + way, added = sum - x;
    if (!wide)
        return sum;
    const f4 all = *left + ((x - (sum - added)) + (way - added)), moved = sum + all;
    *left = all - (moved - sum);
    return moved;
}

/* Moves particles i to i + 3 before `end`, in a box at rest. False without a move if a wall is near. */
static inline bool drift_free(const CpuParticles *p, const WallsFar *inside, float dt, size_t i, size_t end,
                              const bool wide)
{
    float *const place[3] = {p->x, p->y, p->z}, *const speed[3] = {p->vx, p->vy, p->vz};
    f4 x[3], left[3];
    for (int k = 0; k < 3; k++) {
        left[k] = wide ? four_get(p->own[COLUMNS_LEFT + k], i, end) : f4_splat(0);
        x[k] = four_move(four_get(place[k], i, end), &left[k], f4_load(speed[k], i) * f4_splat(dt), wide);
    }
    if (i4_bits(four_near_walls(inside, x[0], x[1], x[2]) & four_before(i, end)) != 0)
        return false;
    for (int k = 0; k < 3; k++) {
        four_put(place[k], i, end, x[k]);
        if (wide)
            four_put(p->own[COLUMNS_LEFT + k], i, end, left[k]);
    }
    return true;
}

/* Number of times guards held particles of the run [begin, end). */
static inline size_t drift_each(const DriftJob *drift, const WallsFar *inside, size_t begin, size_t end,
                                CpuForceSums *sums, const bool wide)
{
    const Cpu *cpu = drift->cpu;
    const CpuParticles *p = &cpu->now;
    /* While lists are in use, particles keep the positions of the lists: cpu_leave wraps. */
    const bool solids = drift->step->solids, wraps = cpu->constants->periodic.any && !cpu->lists.ready;
    size_t held = 0;
    for (size_t i = begin; i < end; i++) {
        float x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        float left[3] = {0};
        for (int k = 0; wide && k < 3; k++)
            left[k] = p->own[COLUMNS_LEFT + k][i];
        box_advance(drift->step, x, wide ? left : NULL, v);
        if (solids || walls_near(inside, x)) {
            const float free[3] = {x[0], x[1], x[2]};
            held += guard(drift, inside, i, x, v, sums);
            place_put(free, x, wide ? left : NULL);
        }
        if (wraps)
            periodic_wrap(&cpu->constants->periodic, x, wide ? left : NULL);
        for (int k = 0; wide && k < 3; k++)
            p->own[COLUMNS_LEFT + k][i] = left[k];
        p->x[i] = x[0];
        p->y[i] = x[1];
        p->z[i] = x[2];
        p->vx[i] = v[0];
        p->vy[i] = v[1];
        p->vz[i] = v[2];
    }
    return held;
}

static inline size_t drift_run(const DriftJob *drift, size_t begin, size_t end, CpuForceSums *sums,
                               const bool wide)
{
    const Constants *s = drift->cpu->constants;
    const WallsFar inside = walls_far(&s->walls, 0);
    size_t held = 0;
    if (!drift->step->still || drift->step->solids || s->periodic.any)
        return drift_each(drift, &inside, begin, end, sums, wide);
    for (size_t i = begin; i < end; i += FOUR) {
        const size_t stop = i + FOUR < end ? i + FOUR : end;
        if (!drift_free(&drift->cpu->now, &inside, drift->step->dt, i, stop, wide))
            held += drift_each(drift, &inside, i, stop, sums, wide);
    }
    return held;
}

static void drift_range(void *context, size_t begin, size_t end)
{
    const DriftJob *drift = context;
    const bool sums_forces = drift->cpu->forces;
    CpuForceSums sums;
    size_t held = 0;
    sums.any = false;
    for (size_t i = begin, stop; cpu_run(drift->cpu, &i, end, &stop); i = stop)
        held += drift->cpu->constants->wide ? drift_run(drift, i, stop, sums_forces ? &sums : NULL, true)
                                            : drift_run(drift, i, stop, sums_forces ? &sums : NULL, false);
    if (sums_forces)
        cpu_force_sums_merge(drift->cpu, &sums);
    if (held)
        __atomic_fetch_add(&drift->cpu->guarded, held, __ATOMIC_RELAXED);
}

void cpu_drift(void *state, const BoxStep *step)
{
    Cpu *cpu = state;
    DriftJob drift = {cpu, step};
    if (cpu->forces)
        cpu_force_sums_begin(cpu);
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, drift_range, &drift);
    if (step->solids)
        cpu_boundary_move(cpu, step->solids);
    if (cpu->forces)
        cpu_add_drift_forces(cpu);
}

static void wrap_range(void *context, size_t begin, size_t end)
{
    const Cpu *cpu = context;
    const CpuParticles *p = &cpu->now;
    const bool wide = cpu->constants->wide;
    for (size_t i = begin; i < end; i++) {
        float x[3] = {p->x[i], p->y[i], p->z[i]}, left[3] = {0};
        if (!cpu_owns(cpu, i))
            continue;
        for (int k = 0; wide && k < 3; k++)
            left[k] = p->own[COLUMNS_LEFT + k][i];
        periodic_wrap(&cpu->constants->periodic, x, wide ? left : NULL);
        for (int k = 0; wide && k < 3; k++)
            p->own[COLUMNS_LEFT + k][i] = left[k];
        p->x[i] = x[0];
        p->y[i] = x[1];
        p->z[i] = x[2];
    }
}

void cpu_enter(void *state)
{
    ((Cpu *)state)->lists.ready = false; /* lists made by a new or loaded world belong to no step */
}

void cpu_leave(void *state)
{
    Cpu *cpu = state;
    if (cpu->constants->periodic.any)
        parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, wrap_range, cpu);
}

typedef struct KickJob {
    Cpu *cpu;
    const float *gravity;
    float dt;
} KickJob;

/* Atomic maximum of non-negative values: their bits have the same order. */
static void atomic_greatest(float *greatest, float value)
{
    uint32_t bits, *at = (uint32_t *)greatest;
    memcpy(&bits, &value, sizeof bits);
    uint32_t seen = __atomic_load_n(at, __ATOMIC_RELAXED);
    while (bits > seen &&
           !__atomic_compare_exchange_n(at, &seen, bits, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        ;
}

/* Drag of the walls, sim/box/box.h, implicit: v' = v + (a + g - k v') dt. So the drag cannot
   overshoot, however near the wall. The remaining a + g replaces a. */
static void hold_by_walls(const KickJob *kick, size_t begin, size_t end)
{
    Cpu *cpu = kick->cpu;
    const Constants *s = cpu->constants;
    const CpuParticles *p = &cpu->now;
    const float *g = kick->gravity, dt = kick->dt;
    for (size_t i = begin; i < end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]}, drag = wall_drag_at(&s->drag, x);
        if (drag == 0)
            continue;
        const int fluid = p->fluid[i];
        const float k =
            s->viscosity[fluid] / s->mass[fluid] * cpu->now.volume[i] / s->rest_number_density * drag;
        const float lid = s->lid ? k / drag * wall_drag_lid(&s->drag, x) : 0, *v = s->lid_velocity;
        cpu->now.ax[i] = (cpu->now.ax[i] + g[0] - k * p->vx[i] + lid * v[0]) / (1 + k * dt) - g[0];
        cpu->now.ay[i] = (cpu->now.ay[i] + g[1] - k * p->vy[i] + lid * v[1]) / (1 + k * dt) - g[1];
        cpu->now.az[i] = (cpu->now.az[i] + g[2] - k * p->vz[i] + lid * v[2]) / (1 + k * dt) - g[2];
    }
}

static void kick_run(const KickJob *kick, size_t begin, size_t end)
{
    Cpu *cpu = kick->cpu;
    const CpuParticles *p = &cpu->now;
    const float fastest = cpu->constants->method->leaps
                              ? 1e18F
                              : cpu->constants->support_radius / kick->dt; /* with a finite square */
    const f4 dt = f4_splat(kick->dt), fastest2 = f4_splat(fastest * fastest), far = f4_splat(INFINITY);
    const f4 none = f4_splat(0);
    f4 speed2 = none, acceleration2 = none, volume = far;
    i4 bounded = {-1, -1, -1, -1}; /* also 0 for NaN */
    if (cpu->constants->no_slip && !cpu->constants->implicit.on)
        hold_by_walls(kick, begin, end);
    for (size_t i = begin; i < end; i += FOUR) {
        const i4 there = four_before(i, end);
        const f4 ax = f4_load(p->ax, i) + f4_splat(kick->gravity[0]),
                 ay = f4_load(p->ay, i) + f4_splat(kick->gravity[1]),
                 az = f4_load(p->az, i) + f4_splat(kick->gravity[2]);
        const f4 vx = four_get(p->vx, i, end) + ax * dt, vy = four_get(p->vy, i, end) + ay * dt,
                 vz = four_get(p->vz, i, end) + az * dt;
        const f4 v2 = f4_select(there, vx * vx + vy * vy + vz * vz, none), a2 = ax * ax + ay * ay + az * az;
        four_put(p->vx, i, end, vx);
        four_put(p->vy, i, end, vy);
        four_put(p->vz, i, end, vz);
        bounded &= v2 <= fastest2;
        speed2 = f4_greater(v2, speed2);
        acceleration2 = f4_greater(f4_select(there, a2, none), acceleration2);
        volume = f4_lesser(f4_select(there, f4_load(p->volume, i), far), volume);
    }
    for (int k = 1; k < FOUR; k++) {
        speed2[0] = fmaxf(speed2[0], speed2[k]);
        acceleration2[0] = fmaxf(acceleration2[0], acceleration2[k]);
        volume[0] = fminf(volume[0], volume[k]);
    }
    atomic_greatest(&cpu->watch.max_speed, sqrtf(speed2[0]));
    atomic_greatest(&cpu->watch.max_acceleration, sqrtf(acceleration2[0]));
    atomic_greatest(&cpu->watch.max_density_ratio, 1 / (volume[0] * cpu->constants->rest_number_density));
    if (i4_bits(bounded) != 15)
        __atomic_store_n(&cpu->watch.bounded, false, __ATOMIC_RELAXED);
}

static void kick_range(void *context, size_t begin, size_t end)
{
    const KickJob *kick = context;
    for (size_t i = begin, stop; cpu_run(kick->cpu, &i, end, &stop); i = stop)
        kick_run(kick, i, stop);
}

void cpu_kick(void *state, const float gravity[3], float dt)
{
    Cpu *cpu = state;
    KickJob kick = {cpu, gravity, dt};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, kick_range, &kick);
    if (cpu->forces)
        cpu_add_kick_forces(cpu, dt);
}

typedef struct FingerJob {
    Cpu *cpu;
    const FingerStep *finger;
} FingerJob;

static void touch_run(const FingerJob *touch, size_t begin, size_t end)
{
    const CpuParticles *p = &touch->cpu->now;
    const FingerStep *finger = touch->finger;
    for (size_t i = begin; i < end; i++) {
        float d[3] = {p->x[i] - finger->at[0], p->y[i] - finger->at[1], p->z[i] - finger->at[2]};
        float v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        periodic_nearest(&touch->cpu->constants->periodic, d);
        finger_apply(finger, d, v);
        p->vx[i] = v[0];
        p->vy[i] = v[1];
        p->vz[i] = v[2];
    }
}

static void touch_range(void *context, size_t begin, size_t end)
{
    const FingerJob *touch = context;
    for (size_t i = begin, stop; cpu_run(touch->cpu, &i, end, &stop); i = stop)
        touch_run(touch, i, stop);
}

void cpu_touch(void *state, const FingerStep *finger)
{
    Cpu *cpu = state;
    FingerJob touch = {cpu, finger};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, touch_range, &touch);
}

StepWatch cpu_watch(void *state)
{
    Cpu *cpu = state;
    const StepWatch seen = cpu->watch;
    cpu->watch = (StepWatch){.bounded = true};
    return seen;
}
