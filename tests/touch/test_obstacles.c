/* Solids that are moved, turned, put and taken out while a session runs: recorded, replayed, undone; pushed
   through fluid and into walls they lose no particle. */
#include "tests/history/history_rig.h"

#include "sim/solids/solid.h"

#define POOL(size, deep)                                                                                     \
    "box: {size: " size "}\n"                                                                                \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -" deep "], max: [0.5, 0.4, " deep "]}}]}]\n"                  \
    "solids: [{sphere: {centre: [0.1, 0.75, 0], radius: 0.2}}]\n"
#define STEPS "sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"
#define LARGE POOL("[1, 1, 1]", "0.5") "particles: {spacing: 0.1}\n"
#define FLAT  POOL("[1, 1]", "0") "particles: {spacing: 0.04}\n"

static const struct {
    const char *name, *text;
} scenes[] = {
    {"mueller", LARGE "solver: {threads: 1, " STEPS},
    {"wcsph", LARGE "solver: {method: wcsph, threads: 2, sound_speed: 15, step: {dt: 0.01, substeps: 10}}\n"},
    {"dfsph", LARGE "solver: {method: dfsph, threads: 2, " STEPS},
    {"pbf", LARGE "solver: {method: pbf, threads: 2, " STEPS},
    {"compute", LARGE "solver: {backend: compute, reproducible: true, " STEPS},
    {"2D", FLAT "solver: {threads: 1, " STEPS},
};
enum { SCENES = sizeof scenes / sizeof *scenes, FRAMES = 12, MIB = 1 << 20 };

static void send(Rig *rig, const SolidCommand *solid)
{
    const SimCommand command = {.kind = SIM_SOLID, .solid = *solid};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

static void move(Rig *rig, int solid, double x, double y, double angle)
{
    send(rig, &(SolidCommand){.act = SOLID_ACTION_MOVE,
                              .solid = solid,
                              .at = {x, y, 0},
                              .turn = {0, 0, sin(0.5 * angle), cos(0.5 * angle)}});
}

static void put(Rig *rig, int like, double x)
{
    send(rig, &(SolidCommand){.act = SOLID_ACTION_PUT, .like = like, .at = {x, 0.2, 0}, .size = 0.12});
}

static const WorldDef *def_of(Rig *rig)
{
    rig_turn(rig);
    return &rig->simulator->run.scene.world;
}

/* All are there, finite, in the box and in no solid. */
static void none_is_lost(Rig *rig, size_t count, const char *name)
{
    const WorldDef *def = def_of(rig);
    WorldInfo info;
    world_info(rig->simulator->run.world, &info);
    float *x = malloc(4 * (info.count + 1) * sizeof *x);
    assert_true(x && world_read(rig->simulator->run.world, &(ParticleArrays){.position = x}));
    if (info.count != count || info.lost > 0 || info.trouble.ended)
        fail_msg("%s: %zu of %zu particles, %zu lost; %s", name, info.count, count, (size_t)info.lost,
                 step_trouble_words(info.trouble.what));
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < (size_t)def->dimensions; k++) {
            const double low = k == 1 ? 0 : -0.5, at = (double)x[4 * i + k];
            if (!(at >= low - 1e-4 && at <= low + 1 + 1e-4))
                fail_msg("%s: particle %zu at %g %g %g", name, i, (double)x[4 * i], (double)x[4 * i + 1],
                         (double)x[4 * i + 2]);
        }
    }
    free(x);
}

/* It is dragged down to the floor, into a corner and back while it turns. */
static void drag(Rig *rig, int frame)
{
    static const double way[FRAMES][2] = {{0, -0.2},    {0, -0.4},   {0, -0.7},   {0.3, -0.7},
                                          {0.5, -0.75}, {0.5, -0.9}, {-0.6, 0.1}, {-0.7, -0.6},
                                          {-0.7, -0.8}, {0, 0},      {0, 0},      {0, 0}};
    if (frame < FRAMES - 2)
        move(rig, 0, way[frame][0], way[frame][1], 0.4 * frame);
}

static void it_is_replayed_and_undone(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        uint64_t hash[FRAMES + 1];
        Rig rig;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        rig_ready(&rig);
        const size_t count = rig.status.particles;
        hash[0] = rig_hash(&rig);
        for (int i = 1; i <= FRAMES; i++) {
            drag(&rig, i - 1);
            if (i == 4)
                put(&rig, SOLID_LIKE_BOX, -0.3);
            if (i == 9)
                send(&rig, &(SolidCommand){.act = SOLID_ACTION_TAKE, .solid = 1});
            rig_step(&rig);
            hash[i] = rig_hash(&rig);
            assert_int_equal(def_of(&rig)->solid_count, i >= 4 && i < 9 ? 2 : 1);
            none_is_lost(&rig, count, scenes[s].name);
        }
        if (*rig.status.message)
            fail_msg("%s: %s", scenes[s].name, rig.status.message);
        rig_save(&rig, "a.rec");
        for (int i = FRAMES - 1; i >= 0; i -= 3) {
            rig_go(&rig, 0.01 * i);
            if (rig_hash(&rig) != hash[i] || def_of(&rig)->solid_count != (i >= 4 && i < 9 ? 2 : 1))
                fail_msg("%s: frame %d is another one", scenes[s].name, i);
        }
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == hash[FRAMES]);
        rig_close(&rig);
        assert_true(replay("a.rec") > 0);
    }
}

/* Down to the floor and against the floor, into a corner and out, beside a new box: with every method. */
static void pushed_into_walls_it_loses_none(void **state)
{
    (void)state;
    static const double way[][2] = {{-0.1, -0.75}, {-0.6, -0.75}, {-0.6, -0.75}, {0.4, -0.75}, {0.4, 0.2}};
    for (int s = 0; s < SCENES; s++) {
        Rig rig;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        rig_ready(&rig);
        const size_t count = rig.status.particles;
        double lowest = INFINITY;
        for (int i = 0; i < 100; i++) {
            if (i % 20 == 0)
                move(&rig, 0, way[i / 20][0], way[i / 20][1], 0.25 * i);
            if (i == 20)
                put(&rig, SOLID_LIKE_BOX, 0.2);
            if (i == 40)
                move(&rig, 1, 0, -1, 0.3);
            rig_step(&rig);
            SolidPose pose;
            solid_pose_at(&def_of(&rig)->solids[0], rig.status.time, &pose);
            lowest = fmin(lowest, (double)pose.x[1]);
            none_is_lost(&rig, count, scenes[s].name);
        }
        if (!(lowest < (scenes[s].text == scenes[SCENES - 1].text ? 0.3 : 0.06)) ||
            strstr(rig.status.message, "no room"))
            fail_msg("%s: down to %g m; %s", scenes[s].name, lowest, rig.status.message);
        rig_close(&rig);
    }
}

static BoxState body_of(Rig *rig, int solid)
{
    WorldInfo info;
    rig_turn(rig);
    world_info(rig->simulator->run.world, &info);
    return info.floating[solid];
}

/* A light ball, then a light box fall and swim; the ball is taken out, and the box goes on as it was. */
static void what_is_light_falls_and_swims(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        enum { BALL_AT = 2, BOX_AT = 5, OUT_AT = 60, LIGHT_FRAMES = 90 };
        const SolidCommand ball = {
            .act = SOLID_ACTION_PUT, .at = {-0.25, 0.2, 0}, .size = 0.12, .density = 500};
        SolidCommand box = ball;
        uint64_t hash[LIGHT_FRAMES + 1];
        double from[2] = {0, 0};
        Rig rig;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        rig_ready(&rig);
        const size_t count = rig.status.particles;
        box.like = SOLID_LIKE_BOX;
        box.at[0] = 0.3;
        hash[0] = rig_hash(&rig);
        for (int i = 1; i <= LIGHT_FRAMES; i++) {
            BoxState before = {.orientation = {0, 0, 0, 1}};
            if (i == BALL_AT)
                send(&rig, &ball);
            if (i == BOX_AT)
                send(&rig, &box);
            if (i == OUT_AT) {
                before = body_of(&rig, 2);
                send(&rig, &(SolidCommand){.act = SOLID_ACTION_TAKE, .solid = 1});
            }
            rig_step(&rig);
            hash[i] = rig_hash(&rig);
            none_is_lost(&rig, count, scenes[s].name);
            if (i == BALL_AT || i == BOX_AT)
                from[i == BOX_AT] = body_of(&rig, 1 + (i == BOX_AT)).position[1];
            if (i == OUT_AT && fabs(body_of(&rig, 1).position[1] - before.position[1]) > 0.03)
                fail_msg("%s: the box jumps from %g to %g m", scenes[s].name, before.position[1],
                         body_of(&rig, 1).position[1]);
            if (i == OUT_AT - 1)
                for (int k = 0; k < 2; k++) {
                    const double y = body_of(&rig, 1 + k).position[1];
                    if (!(from[k] > 0.45 && y < from[k] - 0.02 && y > 0.2))
                        fail_msg("%s: solid %d from %g to %g m", scenes[s].name, 1 + k, from[k], y);
                }
        }
        if (strstr(rig.status.message, "solid")) /* the fluid alone may boil after the splash */
            fail_msg("%s: %s", scenes[s].name, rig.status.message);
        assert_int_equal(def_of(&rig)->solid_count, 2);
        rig_save(&rig, "a.rec");
        for (int i = LIGHT_FRAMES - 5; i >= 0; i -= 14) {
            rig_go(&rig, 0.01 * i);
            if (rig_hash(&rig) != hash[i])
                fail_msg("%s: frame %d is another one", scenes[s].name, i);
        }
        rig_close(&rig);
        assert_true(replay("a.rec") > 0);
    }
}

static void size_to(Rig *rig, double width, double height)
{
    const SimCommand command = {.kind = SIM_SIZE, .size = {width, height, 1}};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

/* The box shrinks step by step, however much is asked for, and grows at once; none is lost, and all is
 * undone. */
static void the_box_changes_its_size(void **state)
{
    (void)state;
    static const int in[] = {0, 2, 5};
    for (int s = 0; s < 3; s++) {
        enum { SIZES = 30 };
        uint64_t hash[SIZES + 1];
        Rig rig;
        rig_open(&rig, scenes[in[s]].text, 64 * MIB);
        rig_ready(&rig);
        const size_t count = rig.status.particles;
        const double spacing = def_of(&rig)->spacing;
        hash[0] = rig_hash(&rig);
        for (int i = 1; i <= SIZES; i++) {
            if (i <= 20)
                size_to(&rig, 0.7, 1);
            if (i == 25)
                size_to(&rig, 1, 1.3);
            rig_step(&rig);
            const double width = def_of(&rig)->box_size[0],
                         must = i >= 25 ? 1 : 1 - BOX_SHRINK_MOST * spacing * (i < 20 ? i : 20);
            if (fabs(width - must) > 1e-9)
                fail_msg("%s: the box is %g m wide, not %g", scenes[in[s]].name, width, must);
            none_is_lost(&rig, count, scenes[in[s]].name);
            hash[i] = rig_hash(&rig);
        }
        if (*rig.status.message)
            fail_msg("%s: %s", scenes[in[s]].name, rig.status.message);
        rig_save(&rig, "a.rec");
        rig_go(&rig, 0.01 * 12);
        assert_true(rig_hash(&rig) == hash[12]);
        rig_go(&rig, 0);
        assert_true(rig_hash(&rig) == hash[0] && def_of(&rig)->box_size[0] == 1);
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == hash[SIZES] && def_of(&rig)->box_size[1] == 1.3);
        size_to(&rig, 0.01, 1);
        rig_step(&rig);
        assert_non_null(strstr(rig.status.message, "a side of the box must be 6 spacings"));
        rig_close(&rig);
        assert_true(replay("a.rec") > 0);
    }
}

/* The solid reaches the target within the speed limit. */
static void it_follows_the_hand(void **state)
{
    (void)state;
    const double far[3] = {0.5, 0, 0}, near[3] = {0.1, 0.2, 0}, turn[4] = {0, 0, 1, 1};
    SolidHand hand = {.moved = false};
    BoxState part;
    assert_true(solid_hand_move(&hand, far, turn, 1, 1, 10, 3));
    double fastest = 0;
    for (int i = 0; i <= 100; i++) {
        if (i == 50)
            assert_true(solid_hand_move(&hand, near, turn, 1.5, 1, 10, 3));
        solid_hand_at(&hand, 1 + 0.01 * i, &part);
        fastest = fmax(fastest, fabs(part.velocity[0]));
    }
    solid_hand_at(&hand, 5, &part);
    assert_true(fabs(part.position[0] - 0.1) < 1e-3 && fabs(part.position[1] - 0.2) < 1e-3);
    assert_true(fabs(part.orientation[2] - sqrt(0.5)) < 1e-3 && fabs(part.velocity[0]) < 1e-3);
    assert_true(fastest > 0.3 && fastest < 1.5);
    assert_false(solid_hand_move(&hand, (double[3]){NAN, 0, 0}, turn, 2, 1, 10, 3));
}

/* In a single step; a missing solid; a new start has the scene's solids; a new solid is placed above the
   fluid. */
static void commands_of_one_step(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    rig_ready(&rig);
    const size_t count = rig.status.particles;
    put(&rig, SOLID_LIKE_BALL, -0.3);
    move(&rig, 1, 0, 0.1, 0);
    move(&rig, 1, 0, 0.2, 0);
    move(&rig, 7, 0, 0, 0);
    rig_step(&rig);
    assert_non_null(strstr(rig.status.message, "there is no solid 7; the scene has 2"));
    assert_true(fabs(def_of(&rig)->solids[1].hand.at[1] - 0.2) < 1e-9 &&
                def_of(&rig)->solids[1].centre[1] > 0.5);
    assert_true(rig.status.solids > 0);
    put(&rig, SOLID_LIKE, 0.3);
    rig_step(&rig);
    assert_true(def_of(&rig)->solid_count == 3 && def_of(&rig)->solids[2].radius == 0.2);
    none_is_lost(&rig, count, "one step");
    rig_save(&rig, "a.rec");
    simulator_reset(rig.simulator);
    do
        rig_turn(&rig);
    while (rig.status.frames > 0);
    rig_step(&rig);
    assert_int_equal(def_of(&rig)->solid_count, 1);
    rig_close(&rig);
    assert_true(replay("a.rec") > 0);
}

static void a_backend_without_solids_says_so(void **state)
{
    (void)state;
    Rig rig;
    rig_open(
        &rig,
        "box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\n"
        "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.3, 0.5]}}]}]\nsolver: {backend: fragment, " STEPS,
        64 * MIB);
    rig_ready(&rig);
    put(&rig, SOLID_LIKE_BALL, 0);
    rig_step(&rig);
    assert_non_null(strstr(rig.status.message, "backend fragment has no solids"));
    assert_int_equal(def_of(&rig)->solid_count, 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_follows_the_hand),
        cmocka_unit_test(it_is_replayed_and_undone),
        cmocka_unit_test(pushed_into_walls_it_loses_none),
        cmocka_unit_test(what_is_light_falls_and_swims),
        cmocka_unit_test(the_box_changes_its_size),
        cmocka_unit_test(commands_of_one_step),
        cmocka_unit_test(a_backend_without_solids_says_so),
    };
    return cmocka_run_group_tests(tests, rig_setup, rig_teardown);
}
