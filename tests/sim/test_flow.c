/* Emitters and drains: amount, order, limit, and saved state. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/flow/flow.h"
#include "sim/start/start.h"
#include "sim/state.h"

static WorldDef jet_def(int dimensions)
{
    WorldDef def = fixture_def(4, 1, 1);
    def.dimensions = dimensions;
    memset(def.gravity, 0, sizeof def.gravity);
    def.spacing = 0.05;
    def.sound_speed = 20;
    def.most = 5000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {-1.8, 0.5, 0}, .direction = {3, 0, 0}, .radius = 0.2, .speed = 2});
    return def;
}

static WorldInfo info_of(const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info;
}

/* Each id once, none that was never given. */
static void check_ids(World *world, size_t initial)
{
    const WorldInfo info = info_of(world);
    uint32_t *id = malloc((info.count + 1) * sizeof *id);
    const size_t born = initial + info.emitted;
    bool *seen = calloc(born + 1, sizeof *seen);
    world_read(world, &(ParticleArrays){.id = id});
    assert_int_equal(info.count, born - info.drained);
    for (size_t i = 0; i < info.count; i++) {
        assert_true(id[i] < born && !seen[id[i]]);
        seen[id[i]] = true;
    }
    free(id);
    free(seen);
}

/* A layer each time that the fluid has gone a spacing, from `start` on, for `duration`, whatever the steps.
 */
static void layers_come_in_time(void **state)
{
    (void)state;
    const Emit emit = {.direction = {0, 1, 0}, .radius = 0.1, .speed = 2, .start = 1, .duration = 0.5};
    const double steps[] = {0.001, 0.0137, 0.05, 0.4};
    for (int s = 0; s < 4; s++) {
        long first, sum = 0, next = 0;
        for (long i = 0; (double)i * steps[s] < 3; i++) {
            const long count =
                emit_layers(&emit, 0.05, (double)i * steps[s], (double)(i + 1) * steps[s], &first);
            if (count > 0)
                assert_int_equal(first, next);
            next = count > 0 ? first + count : next;
            sum += count;
        }
        assert_int_equal(sum, 20); /* 0.5 s x 2 m/s / 0.05 m */
    }
}

/* Emitted fluid is a lattice at rest density with the correct velocity; the rate is speed times area. */
static void a_jet_is_a_lattice(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int m = 0; m < fixture_methods(); m++) {
            WorldDef def = jet_def(dimensions);
            snprintf(def.method, sizeof def.method, "%s", fixture_method_names[m]);
            World *world = fixture_world(&def);
            assert_int_equal(info_of(world).count, 0);
            const int layers = fixture_count(40, 12);
            fixture_step(world, layers * 25 / 2); /* 1 s */
            check_ids(world, 0);
            State s = fixture_read(world);
            assert_int_equal(s.count, lround((dimensions == 3 ? M_PI * 4 * 4 : 2 * 4) * layers));
            const double end = -1.8 + 0.05 * layers;
            double front = -INFINITY;
            int inside = 0;
            for (size_t i = 0; i < s.count; i++) {
                const float *x = s.position + 4 * i, *v = s.velocity + 4 * i;
                const bool inner = hypot(x[1] - 0.5, x[2]) < 0.09 && x[0] > -1.7 && x[0] < end - 0.2;
                front = fmax(front, x[0]);
                inside += inner;
                if (inner && fabs(s.density[i] / 1000 - 1) > 0.01)
                    fail_msg("%dD: in the jet, at x = %g, the density is %g", dimensions, x[0], s.density[i]);
                assert_true(fabs(v[0] - 2) < 0.1);
            }
            assert_true(inside > fixture_count(60, 10) && fabs(front - end) < 0.06);
            fixture_free(&s);
            world_destroy(world);
        }
}

/* Radii from less than a spacing to many. A layer is the disk's area (in 2D the width) times a spacing,
   to a particle in the sum. The layer lies within the disk to half a spacing, and no two particles are
   nearer than a spacing. */
static void a_layer_is_the_disk(void **state)
{
    (void)state;
    fixture_needs_cpu("no backend changes it");
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int r = 1; r < 120; r++) {
            Emit emit = {.direction = {0, 1, 0}, .radius = 0.0031 * r, .speed = 1};
            const double in_spacings = emit.radius / 0.05,
                         each = dimensions == 3 ? M_PI * in_spacings * in_spacings : 2 * in_spacings;
            const size_t most = emit_most(&emit, dimensions, 0.05);
            size_t sum = 0;
            float *x = malloc(3 * most * sizeof *x);
            for (long k = 0; k < 40; k++) {
                EmitLayer layer = {.position = x};
                emit_place(&emit, dimensions, 0.05, k, emit_time(&emit, 0.05, k), &layer);
                assert_true(layer.count <= most);
                sum += layer.count;
                if (fabs((double)sum - each * (double)(k + 1)) > 0.51)
                    fail_msg("%dD, radius %g: %zu in %ld layers, not %g", dimensions, emit.radius, sum, k + 1,
                             each * (double)(k + 1));
                for (size_t i = 0; i < layer.count; i++) {
                    const double out = hypot(x[3 * i], x[3 * i + 2]) - emit.radius;
                    assert_true(out < 0.5 * 0.05 && fabsf(x[3 * i + 1]) < 1e-6F);
                    for (size_t j = 0; j < i; j++)
                        assert_true(hypot(x[3 * i] - x[3 * j], x[3 * i + 2] - x[3 * j + 2]) > 0.0499);
                }
            }
            free(x);
        }
}

/* Up to the bound and no further; where a drain takes some away, on again. */
static void the_bound_holds(void **state)
{
    (void)state;
    WorldDef def = jet_def(3);
    const int most = fixture_count(1000, 300);
    def.most = most;
    World *world = fixture_world(&def);
    fixture_step(world, most / 2);
    assert_int_equal(info_of(world).count, most);
    assert_int_equal(info_of(world).emitted, most);
    world_destroy(world);

    add_drain(&def, (Fill){.kind = FILL_BALL, .centre = {-0.8, 0.5, 0}, .radius = 0.5});
    world = fixture_world(&def);
    for (int i = 0; i < most; i++) {
        fixture_step(world, 1);
        assert_true(info_of(world).count <= (size_t)most);
    }
    const WorldInfo info = info_of(world);
    assert_true(info.drained > (fixture_on_cpu() ? 1500 : 50) && info.emitted > (size_t)most);
    check_ids(world, 0);
    State s = {.count = info.count, .position = malloc(16 * info.count)};
    world_read(world, &(ParticleArrays){.position = s.position});
    for (size_t i = 0; i < s.count; i++) /* a step's way at most is between it and the last draining */
        assert_true(hypot(hypot(s.position[4 * i] + 0.8, s.position[4 * i + 1] - 0.5),
                          s.position[4 * i + 2]) > 0.5 - 0.02);
    free(s.position);
    world_destroy(world);
}

/* A full box accepts no fluid, without blow-up: the emitter is a pump. */
static void a_full_box_takes_nothing(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    def.most = 100000;
    def.sound_speed = 30;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    add_emit(&def.fluids[0],
             (Emit){.centre = {0, 0.5, 0}, .direction = {0, 1, 0}, .radius = 0.2, .speed = 1});
    World *world = fixture_world(&def);
    fixture_step(world, fixture_count(300, 100));
    WorldSums sums;
    world_sums(world, &sums);
    printf("full box: %lu came in, fastest %g\n", (unsigned long)info_of(world).emitted, sums.max_speed);
    assert_true(info_of(world).emitted < 40 && sums.max_speed < 3);
    world_destroy(world);
}

/* Least distance of two particles. */
static double least_distance(World *world)
{
    State s = fixture_read(world);
    double least2 = INFINITY;
    for (size_t i = 0; i < s.count; i++)
        for (size_t j = 0; j < i; j++) {
            double d2 = 0;
            for (int k = 0; k < 3; k++)
                d2 += pow(s.position[4 * i + k] - s.position[4 * j + k], 2);
            least2 = fmin(least2, d2);
        }
    fixture_free(&s);
    return sqrt(least2);
}

/* A disk on a wall, or as a wall, emits as usual. */
static void a_wall_may_hold_the_disk(void **state)
{
    (void)state;
    const double centres[3][3] = {{-2, 0.5, 0}, {-1.8, 0, 0}, {-1.8, 1, 0}},
                 directions[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    for (int i = 0; i < 3; i++) {
        WorldDef def = jet_def(3);
        Emit *emit = own_emits(&def.fluids[0]);
        memcpy(emit->centre, centres[i], sizeof emit->centre);
        memcpy(emit->direction, directions[i], sizeof emit->direction);
        emit->radius = 0.15;
        World *world = fixture_world(&def);
        fixture_step(world, 100); /* 0.2 s: eight layers of 9 pi */
        assert_int_equal(info_of(world).emitted, lround(8 * 9 * M_PI));
        world_destroy(world);
    }
}

/* Two opposed disks in the same place: only a single particle of two has space. Also not inside a hollow
   solid, nor near a passing solid. */
static void nothing_comes_where_something_is(void **state)
{
    (void)state;
    WorldDef def = jet_def(3);
    own_emits(&def.fluids[0])->centre[0] = 0;
    add_emit(&def.fluids[0], def.fluids[0].emits[0])->direction[0] = -1;
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    assert_true(info_of(world).emitted > 0 && least_distance(world) > 0.8 * def.spacing);
    world_destroy(world);

    for (int moves = 0; moves < 2; moves++) {
        def = jet_def(3);
        SolidDef *ball = &def.solids[def.solid_count++];
        *ball = (SolidDef){.kind = SOLID_SPHERE, .centre = {-1.8, 0.5, 0}, .radius = 0.45, .axis = {0, 1, 0}};
        if (moves)
            add_solid_motion(
                ball, (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.01, .frequency = 2});
        world = fixture_world(&def);
        fixture_step(world, 100);
        assert_int_equal(info_of(world).emitted, 0);
        world_destroy(world);
    }
}

static WorldDef busy_def(const char *method)
{
    WorldDef def = fixture_def(1.2, 0.9, 0.8);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.spacing = 0.06;
    def.dt = 0.004;
    def.substeps = 2;
    def.retries = 3;
    def.most = 3000;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 800, .viscosity = 3};
    fixture_block(&def, 0, -0.6, 0, -0.4, 0.2, 0.3, 0.4);
    add_emit(
        &def.fluids[1],
        (Emit){
            .centre = {-0.2, 0.8, 0}, .direction = {0.3, -1, 0}, .radius = 0.13, .speed = 2, .start = 0.05});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0.4, 0, -0.4}, .max = {0.6, 0.2, 0.4}});
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 2});
    SolidDef *paddle = &def.solids[def.solid_count++];
    *paddle = (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.3, 0}, .radius = 0.15, .slip = SLIP_NONE};
    add_solid_motion(paddle,
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 0, 1}, .amplitude = 0.1, .frequency = 3});
    return def;
}

/* With emitters, a drain, a moving solid and a moving box; also into a world that holds more, or fewer. */
static void save_load_step_is_step(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        const WorldDef def = busy_def(fixture_method_names[m]);
        World *world = fixture_world(&def);
        WorldState saved = {0}, late = {0};
        Error error = {0};
        fixture_step(world, fixture_count(100, 70));
        assert_true(info_of(world).emitted > 100 && info_of(world).drained > 0);
        assert_true(world_save(world, &saved, &error));
        fixture_step(world, fixture_count(60, 10));
        const uint64_t hash = world_hash(world);
        const WorldInfo then = info_of(world);
        assert_true(world_save(world, &late, &error));
        for (int start = 0; start < 2; start++) {
            World *other = fixture_world(&def);
            if (start && !world_load(other, &late, &error))
                fail_msg("%s", error.message);
            if (!world_load(other, &saved, &error))
                fail_msg("%s", error.message);
            fixture_step(other, fixture_count(60, 10));
            const WorldInfo now = info_of(other);
            assert_true(now.count == then.count && now.emitted == then.emitted &&
                        now.drained == then.drained);
            assert_true(world_hash(other) == hash);
            world_destroy(other);
        }
        saved.particles.id[0] = saved.particles.id[1];
        assert_false(world_load(world, &saved, &error));
        assert_true(world_hash(world) == hash);
        world_state_free(&saved);
        world_state_free(&late);
        world_destroy(world);
    }
}

/* By id, of all that were born: s; -1 where it is not there any more. */
static float *births_of(World *world, size_t *count)
{
    const WorldInfo info = info_of(world);
    uint32_t *id = malloc((info.count + 1) * sizeof *id);
    float *born = malloc((info.count + 1) * sizeof *born);
    ParticleArrays out = {.id = id};
    out.scalar[SCALAR_BORN] = born;
    assert_true(world_read(world, &out));
    *count = info.count + info.drained;
    float *all = malloc((*count + 1) * sizeof *all);
    for (size_t i = 0; i < *count; i++)
        all[i] = -1;
    for (size_t i = 0; i < info.count; i++)
        all[id[i]] = born[i];
    free(id);
    free(born);
    return all;
}

/* Whether a layer of the emitter comes out then. */
static bool is_of(const Emit *emit, double spacing, double born)
{
    const double layers = (born - emit->start) * emit->speed / spacing;
    return layers > -1e-4 && fabs(layers - round(layers)) < 1e-4;
}

/* With two emitters at separate times, each particle has the time of a layer, within the frame of first
   appearance. */
static void births_are_times_of_layers(void **state)
{
    (void)state;
    enum { IDS_MOST = 4000 };
    WorldDef def = busy_def("mueller");
    add_emit(&def.fluids[0], (Emit){.centre = {0.3, 0.8, 0.1},
                                    .direction = {0, -1, 0},
                                    .radius = 0.1,
                                    .speed = 1.37,
                                    .start = 0.0313});
    const size_t initial = seed_count(&def, def.spacing);
    double *seen = calloc(IDS_MOST, sizeof *seen);
    size_t count, of[2] = {0};
    World *world = fixture_world(&def);
    for (int frame = 0; frame < fixture_count(60, 40); frame++) {
        fixture_step(world, 1);
        const double now = info_of(world).time;
        float *born = births_of(world, &count);
        assert_true(count < IDS_MOST);
        for (size_t i = 0; i < count; i++) {
            if (born[i] < 0)
                continue;
            if (i < initial) {
                assert_true(born[i] == 0);
                continue;
            }
            seen[i] = seen[i] > 0 ? seen[i] : now;
            assert_true(born[i] > seen[i] - def.dt - 1e-6 && born[i] < seen[i] + 1e-6);
            const bool first = is_of(&def.fluids[0].emits[0], def.spacing, born[i]),
                       second = is_of(&def.fluids[1].emits[0], def.spacing, born[i]);
            assert_true(first || second);
            of[0] += first, of[1] += second;
        }
        free(born);
    }
    assert_true(of[0] > 100 && of[1] > 100 && info_of(world).trouble.count == 0);
    free(seen);
    world_destroy(world);
}

static void same_births(World *one, World *other)
{
    size_t count, others;
    float *a = births_of(one, &count), *b = births_of(other, &others);
    assert_int_equal(count, others);
    assert_memory_equal(a, b, count * sizeof *a);
    free(a);
    free(b);
}

/* Also into a world with a different history; a state without gates leaves all gates open. */
static void births_are_saved(void **state)
{
    (void)state;
    WorldDef def = busy_def("mueller"), other_def;
    const size_t initial = seed_count(&def, def.spacing);
    WorldState saved = {0};
    Error error = {0};
    size_t count;
    World *world = fixture_world(&def);
    fixture_step(world, 30);
    assert_true(info_of(world).emitted > 20 && world_save(world, &saved, &error));
    fixture_step(world, 20);
    other_def = def;
    other_def.dt = 0.003;
    World *other = fixture_world(&other_def);
    fixture_step(other, 70);
    assert_true(world_load(other, &saved, &error));
    fixture_step(other, 20);
    same_births(world, other);

    const size_t before = initial + (size_t)saved.numbers.emitted;
    saved.births.count = 0;
    assert_true(world_load(other, &saved, &error));
    fixture_step(other, 20);
    float *born = births_of(other, &count);
    for (size_t i = 0; i < count; i++)
        assert_true(i < initial  ? born[i] <= 0
                    : i < before ? isnan(born[i]) || born[i] == -1
                                 : born[i] == -1 || born[i] > 0.1F);
    assert_true(count > before);
    free(born);
    world_state_free(&saved);
    world_destroy(world);
    world_destroy(other);
}

/* As if so many more had come and gone before. */
static void count_on(WorldState *saved, size_t initial, uint64_t more)
{
    for (size_t i = 0; i < saved->count; i++)
        saved->particles.id[i] += saved->particles.id[i] >= initial ? more : 0;
    for (size_t k = 0; k < saved->births.count; k++)
        saved->births.of[k].first_id += more;
    saved->numbers.emitted += (double)more;
    saved->numbers.drained += (double)more;
}

/* To the same bits; on a GPU, whose ids are shorter, it is said. */
static void ids_go_on_beyond_32_bits(void **state)
{
    (void)state;
    static const uint64_t more = UINT64_C(1) << 33;
    const WorldDef def = busy_def("mueller");
    const size_t initial = seed_count(&def, def.spacing);
    World *world = fixture_world(&def), *other = fixture_world(&def);
    WorldState saved = {0}, late = {0};
    Error error = {0};
    fixture_step(world, 30);
    assert_true(world_save(world, &saved, &error) && saved.births.count > 2);
    count_on(&saved, initial, more);
    const bool loaded = world_load(other, &saved, &error);
    if (!fixture_on_cpu()) {
        assert_false(loaded);
        assert_non_null(strstr(error.message, "tells 2^31 particles apart"));
    } else if (!loaded) {
        fail_msg("%s", error.message);
    } else {
        fixture_step(world, 30);
        fixture_step(other, 30);
        assert_true(world_save(world, &late, &error) && world_save(other, &saved, &error));
        count_on(&late, initial, more);
        assert_true(late.count == saved.count && late.numbers.emitted == saved.numbers.emitted);
        assert_memory_equal(late.particles.id, saved.particles.id, late.count * sizeof(ParticleId));
        assert_memory_equal(late.particles.x, saved.particles.x, late.count * sizeof(float));
        assert_true(late.births.count == saved.births.count && late.births.of[1].first_id > more);
        assert_memory_equal(late.births.of, saved.births.of, late.births.count * sizeof(Birth));
        assert_true(world_hash(world) == world_hash(other));
        saved.particles.id[3] = saved.particles.id[4];
        assert_false(world_load(other, &saved, &error));
    }
    world_state_free(&saved);
    world_state_free(&late);
    world_destroy(world);
    world_destroy(other);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    fixture_needs_cpu("has no threads");
    uint64_t hash[3];
    for (int t = 0; t < 3; t++) {
        WorldDef def = busy_def("mueller");
        *world_threads(&def) = t + 1;
        World *world = fixture_world(&def);
        fixture_step(world, 100);
        hash[t] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
}

/* A step far too long: the sentinel takes back what had come in. */
static void going_back_takes_back_what_came(void **state)
{
    (void)state;
    WorldDef def = busy_def("mueller");
    def.dt = 0.06;
    def.substeps = 2;
    World *world = fixture_world(&def);
    Error error;
    for (int i = 0; i < fixture_count(20, 8) && world_step(world, NULL, &error); i++)
        check_ids(world, seed_count(&def, def.spacing));
    assert_true(info_of(world).trouble.count > 0);
    check_ids(world, seed_count(&def, def.spacing));
    WorldState saved = {0};
    assert_true(world_save(world, &saved, &error));
    for (size_t k = 1; k < saved.births.count; k++)
        assert_true(saved.births.of[k].first_id > saved.births.of[k - 1].first_id);
    world_state_free(&saved);
    size_t count, of_layer = 0;
    const size_t most = emit_most(&def.fluids[1].emits[0], def.dimensions, def.spacing);
    float *born = births_of(world, &count);
    for (size_t i = seed_count(&def, def.spacing) + 1; i < count; i++) {
        if (born[i] < 0 || born[i - 1] < 0) {
            of_layer = 0;
            continue;
        }
        of_layer = born[i] == born[i - 1] ? of_layer + 1 : 0;
        assert_true(born[i] >= born[i - 1] && born[i] <= info_of(world).time && of_layer < most);
        assert_true(is_of(&def.fluids[1].emits[0], def.spacing, born[i]));
    }
    free(born);
    world_destroy(world);
}

/* Of any who are left the time is the same, and no birth stays of whom none is. */
static void births_of_none_are_left_out(void **state)
{
    (void)state;
    enum { IDS = 400 };
    uint32_t dice = 1;
    ParticleId id[IDS];
    for (int trial = 0; trial < 50; trial++) {
        Births births = {0};
        float was[IDS];
        size_t left = 0, times = 0;
        for (uint32_t first = 7; first < IDS; first += 1 + (dice = dice * 1664525u + 1013904223u) % 9) {
            assert_true(births_reserve(&births, 1));
            births_add(&births, first, (float)first);
        }
        const float last = births.of[births.count - 1].time;
        for (uint32_t i = 0; i < IDS; i++)
            if (((dice = dice * 1664525u + 1013904223u) >> 8) % 20 == 0) {
                was[left] = births_time(&births, i);
                times += was[left] > 0 && (left == 0 || was[left] != was[left - 1]);
                id[left++] = i;
            }
        times += left == 0 || was[left - 1] != last; /* the last birth stays */
        births_keep(&births, id, left);
        for (size_t i = 0; i < left; i++)
            assert_true(births_time(&births, id[i]) == was[i]);
        assert_int_equal(births.count, times);
        births_free(&births);
    }
}

/* A fast jet into a drain: births are as many as twice the layers that are under way, and these are known. */
static void births_of_the_drained_are_forgotten(void **state)
{
    (void)state;
    WorldDef def = jet_def(3);
    Emit *jet = own_emits(&def.fluids[0]);
    jet->radius = 0.0283; /* of a particle */
    jet->speed = 10;
    def.dt = 0.01;
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {-1, 0, -0.5}, .max = {1.9, 1, 0.5}});
    World *world = fixture_world(&def);
    WorldState saved = {0};
    Error error;
    fixture_step(world, 400);
    assert_true(world_save(world, &saved, &error));
    const WorldInfo info = info_of(world);
    assert_true(info.emitted > 790 && info.count < 100);
    assert_true(saved.births.count < (fixture_on_cpu() ? 300 : 1000)); /* a GPU forgets after 16,384 */
    size_t count, known = 0;
    float *born = births_of(world, &count);
    for (size_t i = 0; i < count; i++) {
        if (born[i] < 0)
            continue;
        known++;
        assert_true(is_of(&def.fluids[0].emits[0], def.spacing, born[i]));
        assert_true(info.time - born[i] < 0.2);
    }
    assert_int_equal(known, info.count);
    free(born);
    world_state_free(&saved);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_come_in_time),
        cmocka_unit_test(a_jet_is_a_lattice),
        cmocka_unit_test(a_layer_is_the_disk),
        cmocka_unit_test(the_bound_holds),
        cmocka_unit_test(a_full_box_takes_nothing),
        cmocka_unit_test(a_wall_may_hold_the_disk),
        cmocka_unit_test(nothing_comes_where_something_is),
        cmocka_unit_test(save_load_step_is_step),
        cmocka_unit_test(births_are_times_of_layers),
        cmocka_unit_test(births_are_saved),
        cmocka_unit_test(ids_go_on_beyond_32_bits),
        cmocka_unit_test(births_of_none_are_left_out),
        cmocka_unit_test(births_of_the_drained_are_forgotten),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(going_back_takes_back_what_came),
    };
    return cmocka_run_group_tests_name("sim.flow", tests, NULL, NULL);
}
