/* The box becomes smaller under a hand: by every method and backend none is lost, the fluid stays as dense
   and as calm as it was, and the session is replayed and undone to the same bits. */
#include "tests/history/history_rig.h"

#define POOL(size, deep, spacing)                                                                            \
    "box: {size: " size "}\nparticles: {spacing: " spacing "}\n"                                             \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -" deep "], max: [0.5, 0.4, " deep "]}}]}]\nsolver: {"
#define LARGE POOL("[1, 1, 1]", "0.5", "0.1")
#define SOLID                                                                                                    \
    "solids: [{sphere: {centre: [0.1, 0.2, 0], radius: 0.15}}, {box: {centre: [-0.2, 0.4, 0], size: [0.2, 0.2, " \
    "0.2]}, density: 500}]\n"
#define FLAT   POOL("[1, 1]", "0", "0.04")
#define STEPS  "sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"
#define WCSPH  "method: wcsph, sound_speed: 15, step: {dt: 0.01, substeps: 10}}\n"
#define ON_GPU "backend: compute, reproducible: true, "

static const struct {
    const char *name, *text;
    double width;       /* m, to which the box of 1 m goes: on the software driver a frame takes long */
    double calm, dense; /* bounds: root mean square of the speed, m/s; mean error of the density */
    bool same;          /* replayed by the CPU to the same bits */
} scenes[] = {
    {"mueller", LARGE "threads: 1, " STEPS, 0.9, 0.2, 0.02, true},
    {"solids", SOLID LARGE "threads: 1, " STEPS, 0.9, 0.32, 0.02, true},
    {"2D", FLAT "threads: 1, " STEPS, 0.9, 0.2, 0.02, true},
    {"wcsph", LARGE "threads: 2, " WCSPH, 0.9, 0.35, 0.012, true},
    {"dfsph", LARGE "threads: 2, method: dfsph, " STEPS, 0.9, 0.12, 0.002, true},
    {"pbf", LARGE "threads: 2, method: pbf, " STEPS, 0.9, 0.2, 0.004, true},
    {"compute", LARGE ON_GPU STEPS, 0.98, 0.12, 0.02, false},
    {"solids on compute", SOLID LARGE ON_GPU STEPS, 0.99, 0.3, 0.02, false},
    {"wcsph on compute", LARGE ON_GPU WCSPH, 0.99, 0.05, 0.012, false},
    {"dfsph on compute", LARGE ON_GPU "method: dfsph, " STEPS, 0.99, 0.05, 0.002, false},
    {"pbf on compute", LARGE ON_GPU "method: pbf, " STEPS, 0.99, 0.1, 0.004, false},
    {"fragment", LARGE "backend: fragment, " STEPS, 0.99, 0.12, 0.02, false},
};
enum { SCENES = sizeof scenes / sizeof *scenes, MIB = 1 << 20, REST = 6, MOST = 150 };

typedef struct Seen {
    double calm, dense; /* as above: the largest */
} Seen;

static const WorldDef *def_of(const Rig *rig)
{
    return &rig->simulator->run.scene.world;
}

/* All are there, and in the box. */
static void look(const Rig *rig, size_t count, const char *name, Seen *seen)
{
    World *world = rig->simulator->run.world;
    const double *size = def_of(rig)->box_size;
    WorldGauge gauge;
    WorldInfo info;
    world_info(world, &info);
    float *x = calloc(8 * count, sizeof *x), *v = x + 4 * count;
    assert_true(x && info.count == count &&
                world_read(world, &(ParticleArrays){.position = x, .velocity = v}));
    double square = 0;
    for (size_t i = 0; i < 4 * count; i++) {
        const size_t k = i % 4;
        const double low = k == 1 ? 0 : -0.5 * size[k % 3], at = (double)x[i];
        square += k < 3 ? (double)v[i] * (double)v[i] : 0;
        if (k < 3 && !(at >= low - 1e-4 && at <= low + size[k] + 1e-4))
            fail_msg("%s: a particle at %g along %c, in a box of %g m", name, at, "xyz"[k], size[k]);
    }
    free(x);
    if (info.lost > 0 || info.trouble.count > 0)
        fail_msg("%s: %zu are lost, the sentinel went back %u times", name, (size_t)info.lost,
                 info.trouble.count);
    world_gauge_request(world);
    while (!world_gauge(world, &gauge))
        usleep(100);
    seen->calm = fmax(seen->calm, sqrt(square / (double)count));
    seen->dense = fmax(seen->dense, gauge.density_error_mean);
}

/* Until the box is as small as it is to be; how many frames. */
static int shrink(Rig *rig, size_t count, int s, uint64_t hash[MOST + 1])
{
    const char *name = scenes[s].name;
    const double size[3] = {scenes[s].width, 1, 1};
    Seen seen = {0};
    int frames = 0;
    for (; frames < REST; frames++) {
        hash[frames] = rig_hash(rig);
        rig_step(rig);
    }
    simulator_resize(rig->simulator, size);
    do {
        hash[frames++] = rig_hash(rig);
        rig_step(rig);
        look(rig, count, name, &seen);
    } while (rig->status.resizing && frames < MOST);
    hash[frames] = rig_hash(rig);
    if (def_of(rig)->box_size[0] != size[0] || *rig->status.message)
        fail_msg("%s: %g m wide, %s", name, def_of(rig)->box_size[0], rig->status.message);
    if (!(seen.calm < scenes[s].calm && seen.dense < scenes[s].dense))
        fail_msg("%s: %.3f m/s, %.4f off the density", name, seen.calm, seen.dense);
    print_message("%s: %d frames, %.3f m/s, %.4f off the density\n", name, frames, seen.calm, seen.dense);
    return frames;
}

static void it_becomes_smaller(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        uint64_t hash[MOST + 1];
        Rig rig;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        rig_ready(&rig);
        const int frames = shrink(&rig, rig.status.particles, s, hash);
        rig_save(&rig, "a.rec");
        rig_go(&rig, 0.01 * (REST + 2));
        if (rig_hash(&rig) != hash[REST + 2] || !(def_of(&rig)->box_size[0] > scenes[s].width))
            fail_msg("%s: another state in the past", scenes[s].name);
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == hash[frames] && def_of(&rig)->box_size[0] == scenes[s].width);
        rig_close(&rig);
        if (scenes[s].same)
            assert_true(replay("a.rec") > 0);
    }
}

/* The walls stop where the fluid has no room, and the size is asked for no more. */
static void it_says_when_it_is_full(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, FLAT "threads: 1, " STEPS, 64 * MIB);
    rig_ready(&rig);
    simulator_resize(rig.simulator,
                     (double[3]){1, 0.39, 1}); /* above the fluid there is room, but not for it */
    for (int i = 0; i < 800 && (i == 0 || rig.status.resizing); i++)
        rig_step(&rig);
    assert_non_null(strstr(rig.status.message, "the fluid has no room in a smaller box"));
    assert_false(rig.status.resizing);
    const unsigned messages = rig.status.messages;
    rig_step(&rig);
    assert_true(rig.status.messages == messages);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_becomes_smaller),
        cmocka_unit_test(it_says_when_it_is_full),
    };
    return cmocka_run_group_tests(tests, rig_setup, rig_teardown);
}
