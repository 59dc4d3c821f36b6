/* Overlay `trails`: stored points per particle, through all changes of time and particles. */
#include "tests/render/trails_fixture.h"

#include "render/frame/view.h"
#include "render/overlays/trails/trails_private.h"

typedef struct Point {
    float x, y, z, value;
} Point;

static TrailStore make_store(const ViewDef *def, const WorldDef *world)
{
    static const WorldDef unknown;
    Error error = {0};
    TrailStore store = {0};
    const Subject subject = {def, world ? world : &unknown};
    if (!trail_store_create(&store, &subject, &error))
        fail_msg("%s", error.message);
    return store;
}

/* The slot's point of a column; false where nobody is seen there. */
static bool point_of(const TrailStore *store, uint64_t column, unsigned slot, Point *point)
{
    const size_t at = trail_store_column(store, column) + slot;
    uint32_t owner;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(store->owners, (GLintptr)(at * sizeof owner), sizeof owner, &owner);
    glGetNamedBufferSubData(store->places, (GLintptr)(at * sizeof *point), sizeof *point, point);
    return owner & 1;
}

static uint32_t id_of(const TrailStore *store, uint64_t column, unsigned slot)
{
    uint32_t owner;
    const size_t at = trail_store_column(store, column) + slot;
    glGetNamedBufferSubData(store->owners, (GLintptr)(at * sizeof owner), sizeof owner, &owner);
    return owner / 2 - 1;
}

/* `count` particles on circles about the box's middle, in an order that changes from state to state. */
static void turn(Movers *movers, int count, double time)
{
    const int shift = (int)(time * 1000) % count;
    movers_clear(movers);
    for (int k = 0; k < count; k++) {
        const int id = (k * 7 + shift) % count;
        const double radius = 0.1 + 0.3 * id / count, angle = 2 * time + id;
        movers_add(movers, (uint32_t)id, radius * cos(angle), 0.5 + radius * sin(angle), 0.001 * id, time);
    }
}

static void take_turn(TrailStore *store, Movers *movers, const ViewDef *def, int count, double time)
{
    turn(movers, count, time);
    const ParticleBuffers particles = movers_upload(movers, time);
    trail_store_add_state(store, &particles, def);
}

/* The worst distance of all points kept from their circles, m. */
static double worst_of_turn(const TrailStore *store, int count)
{
    double worst = 0;
    for (uint64_t k = store->ring.begin; k < store->ring.end; k++)
        for (int id = 0; id < count; id++) {
            Point point;
            const double time = trail_ring_at(&store->ring, k)->time;
            const double radius = 0.1 + 0.3 * id / count, angle = 2 * time + id;
            assert_true(point_of(store, k, (unsigned)id, &point));
            assert_int_equal(id_of(store, k, (unsigned)id), id);
            worst = fmax(worst, fabs(point.x - radius * cos(angle)));
            worst = fmax(worst, fabs(point.y - 0.5 - radius * sin(angle)));
            worst = fmax(worst, fabs(point.value - time));
        }
    return worst;
}

static void particles_are_found_in_any_order(void **state)
{
    (void)state;
    enum { COUNT = 300 };
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i <= 250; i++)
        take_turn(&store, movers, &def, COUNT, 0.008 * i);
    const double worst = worst_of_turn(&store, COUNT);
    if (!(worst < 2e-7))
        fail_msg("%g m off", worst);
    /* a second in steps of 8 ms, and an older point at the trail's faded end */
    assert_in_range(store.ring.end - store.ring.begin, 126, 127);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static void points_are_no_closer_than_asked_for(void **state)
{
    (void)state;
    ViewDef def = trails_view();
    Movers *movers = movers_create();
    trails_def(&def)->every = 0.05;
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i <= 150; i++) {
        take_turn(&store, movers, &def, 10, 0.01 * i);
        assert_true(trail_ring_at(&store.ring, store.ring.head)->time == 0.01 * i);
        Point point;
        assert_true(point_of(&store, store.ring.head, 3, &point));
        assert_true(fabs(point.value - 0.01 * i) < 1e-6);
    }
    for (uint64_t k = store.ring.begin + 1; k < store.ring.end; k++)
        assert_true(fabs(trail_ring_at(&store.ring, k)->time - trail_ring_at(&store.ring, k - 1)->time -
                         0.05) < 1e-9);
    assert_true(worst_of_turn(&store, 10) < 2e-7);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* Step back: what is newer than the present state goes, and the rest goes on. */
static void time_may_go_back(void **state)
{
    (void)state;
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i <= 50; i++)
        take_turn(&store, movers, &def, 20, 0.01 * i);
    for (int i = 49; i >= 30; i--) {
        take_turn(&store, movers, &def, 20, 0.01 * i);
        assert_true(trail_ring_at(&store.ring, store.ring.end - 1)->time <= 0.01 * i);
        assert_int_equal(store.ring.end - store.ring.begin, i + 1);
        assert_false(trail_ring_at(&store.ring, store.ring.end - 1)->broken);
    }
    for (int i = 31; i <= 60; i++)
        take_turn(&store, movers, &def, 20, 0.01 * i);
    assert_int_equal(store.ring.end - store.ring.begin, 61);
    assert_true(worst_of_turn(&store, 20) < 2e-7);
    for (uint64_t k = store.ring.begin + 1; k < store.ring.end; k++)
        assert_true(trail_ring_joins(&store.ring, k));
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* The scene from its start. */
static void a_reset_empties_them(void **state)
{
    (void)state;
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i <= 50; i++)
        take_turn(&store, movers, &def, 20, 0.01 * i);
    take_turn(&store, movers, &def, 20, 0);
    assert_int_equal(store.ring.end - store.ring.begin, 1);
    assert_false(trail_ring_joins(&store.ring, store.ring.end - 1));
    movers->state.box_size[0] = 1; /* a new scene with later time */
    take_turn(&store, movers, &def, 20, 0.3);
    assert_int_equal(store.ring.end - store.ring.begin, 1);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static void a_jump_is_no_path(void **state)
{
    (void)state;
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i <= 20; i++)
        take_turn(&store, movers, &def, 20, 0.01 * i);
    take_turn(&store, movers, &def, 20, 0.26); /* the window stood still for a moment */
    assert_true(trail_ring_joins(&store.ring, store.ring.head));
    take_turn(&store, movers, &def, 20, 0.27);
    take_turn(&store, movers, &def, 20, 0.8);
    assert_false(trail_ring_joins(&store.ring, store.ring.head));
    take_turn(&store, movers, &def, 20, 0.81);
    assert_true(trail_ring_joins(&store.ring, store.ring.head));
    take_turn(&store, movers, &def, 20, 7);
    assert_false(trail_ring_joins(&store.ring, store.ring.head));
    /* a film that plays fast */
    for (int i = 1; i <= 3; i++)
        take_turn(&store, movers, &def, 20, 7 + 0.4 * i);
    assert_true(trail_ring_joins(&store.ring, store.ring.head));
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* Ids from an emitter to a drain: each keeps a trail, never the trail of a different particle. */
static void particles_come_and_go(void **state)
{
    (void)state;
    enum { ALIVE = 1500, STATES = 60, STEP = 100 }; /* more ids in all than there are slots */
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i < STATES; i++) {
        movers_clear(movers);
        for (int k = ALIVE - 1; k >= 0; k--)
            movers_add(movers, (uint32_t)(i * STEP + k), 0.0001 * (i * STEP + k), 0.5, 0, 0);
        const ParticleBuffers particles = movers_upload(movers, 0.01 * i);
        trail_store_add_state(&store, &particles, &def);
        int seen = 0;
        for (unsigned slot = 0; slot < (unsigned)store.slots; slot++) {
            Point point;
            if (!point_of(&store, store.ring.head, slot, &point))
                continue;
            const uint32_t id = id_of(&store, store.ring.head, slot);
            assert_in_range(id, i * STEP, i * STEP + ALIVE - 1);
            assert_true(fabs(point.x - 0.0001 * id) < 1e-6);
            seen++;
        }
        assert_int_equal(seen, ALIVE);
    }
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* For two candidates the older keeps the trail until removal. */
static void the_older_keeps_its_trail(void **state)
{
    (void)state;
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    for (int i = 0; i < 8; i++) {
        const bool both = i >= 2, old = i < 5;
        movers_clear(movers);
        if (both)
            movers_add(movers, 5 + 1024 * 3, 0.7, 0.5, 0, 0);
        if (old)
            movers_add(movers, 5, 0.2, 0.5, 0, 0);
        const ParticleBuffers particles = movers_upload(movers, 0.01 * i);
        trail_store_add_state(&store, &particles, &def);
        assert_int_equal(store.slots, 1024);
        assert_int_equal(id_of(&store, store.ring.head, 5), old ? 5 : 5 + 1024 * 3);
    }
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static int seen_in_head(const TrailStore *store)
{
    int seen = 0;
    Point point;
    for (unsigned slot = 0; slot < (unsigned)store->slots; slot++)
        seen += point_of(store, store->ring.head, slot, &point);
    return seen;
}

static void some_are_chosen(void **state)
{
    (void)state;
    ViewDef def = trails_view();
    TrailsDef *own = trails_def(&def);
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    own->stride = 7;
    take_turn(&store, movers, &def, 300, 0);
    assert_int_equal(seen_in_head(&store), 43);
    own->stride = 1;
    own->region_min[0] = -2, own->region_min[1] = 0.5, own->region_min[2] = -1;
    own->region_max[0] = 2, own->region_max[1] = 2, own->region_max[2] = 1;
    take_turn(&store, movers, &def, 300, 0.01);
    int above = 0;
    for (size_t i = 0; i < movers->count; i++)
        above += movers->position[4 * i + 1] >= 0.5F;
    assert_in_range(above, 100, 200);
    assert_int_equal(seen_in_head(&store), above);
    take_turn(&store, movers, &def, 300, 0.8); /* chosen once: half of these are below now */
    assert_int_equal(seen_in_head(&store), above);
    snprintf(own->ids, sizeof own->ids, "250, 4 5000");
    memset(own->region_min, 0, sizeof own->region_min);
    memset(own->region_max, 0, sizeof own->region_max);
    take_turn(&store, movers, &def, 300, 0.81);
    assert_int_equal(store.listed_count, 3);
    assert_int_equal(seen_in_head(&store), 2);
    assert_int_equal(id_of(&store, store.ring.head, 0), 250);
    assert_int_equal(id_of(&store, store.ring.head, 1), 4);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static void ids_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int count;
    } cases[] = {{"all", 0},
                 {"7", 1},
                 {" 1,2  3 ", 3},
                 {"", -1},
                 {"-1", -1},
                 {"1.5", -1},
                 {"a", -1},
                 {"99999999999999999999", -1},
                 {"9223372036854775808", -1},
                 {"4000000000 5000000000", 2},
                 {"1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16", 16},
                 {"1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17", -1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t ids[TRAILS_LISTED_MAX];
        TrailsDef def = trails_usual;
        snprintf(def.ids, sizeof def.ids, "%s", cases[i].text);
        if (trails_listed_ids(&def, ids) != cases[i].count)
            fail_msg("\"%s\"", cases[i].text);
    }
}

/* By clicks, with any number of digits; a seventeenth is refused, and a second click removes. */
static void a_click_adds_up_to_sixteen(void **state)
{
    (void)state;
    ViewDef view = trails_view();
    ViewSetting settings[VIEW_SETTINGS_MAX];
    char words[160];
    uint32_t ids[TRAILS_LISTED_MAX];
    TrailsDef *own = trails_def(&view);
    for (int i = 0; i <= TRAILS_LISTED_MAX; i++) {
        const bool fits = i < TRAILS_LISTED_MAX;
        assert_int_equal(overlay_trails.choose(&view, (uint32_t)(INT32_MAX - i), settings, words), 2 * fits);
        if (!fits)
            break;
        const char *list = strchr(settings[0].text, '=') + 1;
        assert_true(strlen(list) < sizeof own->ids);
        snprintf(own->ids, sizeof own->ids, "%s", list);
        own->show = true;
        assert_int_equal(trails_listed_ids(own, ids), i + 1);
    }
    assert_non_null(strstr(words, "16 particles have a trail, and no more can"));
    assert_int_equal(overlay_trails.choose(&view, INT32_MAX, settings, words), 2);
    assert_null(strstr(settings[0].text, "2147483647"));
}

/* Ten particles rise through a plane in turn; after going back the plane is uncrossed. */
static void those_that_cross_a_plane_are_chosen(void **state)
{
    (void)state;
    ViewDef def = trails_view();
    TrailsDef *own = trails_def(&def);
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    own->plane_point[1] = 0.5;
    own->plane_normal[1] = 3;
    static const int states[] = {0, 1, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, 2, 3};
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        movers_clear(movers);
        for (int k = 0; k < 10; k++) /* number k crosses on its way to state k + 1 */
            movers_add(movers, (uint32_t)k, 0.1 * k, 0.5 + 0.01 * (states[i] - k - 0.5), 0, 0);
        const ParticleBuffers particles = movers_upload(movers, 0.01 * states[i]);
        trail_store_add_state(&store, &particles, &def);
        if (seen_in_head(&store) != states[i])
            fail_msg("state %d: %d have crossed", states[i], seen_in_head(&store));
    }
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static void there_are_so_many_at_most(void **state)
{
    (void)state;
    ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    store.capacity = 300000;
    take_turn(&store, movers, &def, 300, 0);
    assert_int_equal(store.stride, 15);
    assert_int_equal(store.slots, TRAILS_MOST);
    trails_def(&def)->every = 0.001;
    take_turn(&store, movers, &def, 300, 0.01);
    assert_true((double)store.slots * store.ring.capacity <= 8 << 20);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* A state without the scalar that is shown: a point has no number then, not 0. */
static void a_scalar_that_is_not_there_is_no_number(void **state)
{
    (void)state;
    Point point;
    ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    def.color_by = SCALAR_PRESSURE;
    take_turn(&store, movers, &def, 20, 0);
    assert_true(point_of(&store, store.ring.head, 3, &point) && isnan(point.value));
    trail_store_destroy(&store);
    movers_destroy(movers);
}

static void what_is_nowhere_has_no_point(void **state)
{
    (void)state;
    const ViewDef def = trails_view();
    Movers *movers = movers_create();
    TrailStore store = make_store(&def, NULL);
    movers_add(movers, 0, 0.1, 0.1, 0, 0);
    movers_add(movers, 1, NAN, 0.1, 0, 0);
    movers_add(movers, 2, 0.1, INFINITY, 0, 0);
    const ParticleBuffers particles = movers_upload(movers, 0);
    trail_store_add_state(&store, &particles, &def);
    assert_int_equal(seen_in_head(&store), 1);
    movers_clear(movers);
    const ParticleBuffers none = movers_upload(movers, 0.01);
    trail_store_add_state(&store, &none, &def);
    assert_int_equal(seen_in_head(&store), 0);
    trail_store_destroy(&store);
    movers_destroy(movers);
}

/* No attribute, no state between pictures, no object of GL: numbers of buffers tell. */
static void hidden_ones_cost_nothing(void **state)
{
    (void)state;
    Error error = {0};
    ViewDef def = trails_view();
    double before;
    ParticleWants wants = {0}, none = {0};
    overlays_want(&def, &wants);
    assert_int_equal(wants.attributes, PARTICLE_ID);
    assert_true(overlays_every(&def, &before) == 0.005 && before == 1);
    trails_def(&def)->show = false;
    overlays_want(&def, &none);
    assert_true(none.attributes == 0 && none.scalars == 0 && none.vectors == 0);
    assert_true(isinf(overlays_every(&def, &before)) && before == 0);
    const WorldDef world = {0};
    const Subject subject = {&def, &world};
    Overlays overlays = {0};
    for (int shown = 1; shown >= 0; shown--) {
        trails_def(&def)->show = shown;
        assert_true(overlays_update(&overlays, &subject, &error));
        for (int i = 0; overlay_list[i]; i++)
            assert_true((overlays.state[i] != NULL) == (shown && overlay_list[i] == &overlay_trails));
    }
    overlays_destroy(&overlays);
}

#define TEST(name) cmocka_unit_test_teardown(name, no_gl_errors)

/* A curve that falls is the range's mirror: 0.25 is coloured as 0.75. */
static void a_curve_bends_their_colors(void **state)
{
    (void)state;
    enum { WIDE = 120, HIGH = 90 };
    static uint8_t straight[3 * WIDE * HIGH], bent[3 * WIDE * HIGH];
    Error error = {0};
    ViewDef def = trails_view();
    Movers *movers = movers_create();
    trails_def(&def)->width = 0.1;
    def.range[0] = -0.5, def.range[1] = 0.5;
    Renderer *renderer = renderer_create(&def, NULL, WIDE, HIGH, &error);
    assert_non_null(renderer);
    for (int i = 0; i < 4; i++) {
        movers_clear(movers);
        movers_add(movers, 1, -0.3 + 0.2 * i, 0.5, 0, 0.25);
        const ParticleBuffers particles = movers_upload(movers, 0.1 * i);
        if (i == 3) {
            def.range[0] = 0, def.range[1] = 1;
            def.color_curve = (ControlPoints){2, {0, 1}, {1, 0}};
        }
        renderer_draw(renderer, &particles, NULL);
        renderer_read(renderer, straight);
        assert_true(renderer_set_def(renderer, &def, NULL, &error));
        renderer_draw(renderer, &particles, NULL);
        renderer_read(renderer, bent);
    }
    for (int i = 0; i < 3 * WIDE * HIGH; i++)
        assert_true(abs(straight[i] - bent[i]) <= 2);
    def.color_curve = control_points_straight();
    assert_true(renderer_set_def(renderer, &def, NULL, &error));
    const ParticleBuffers particles = movers_upload(movers, 0.3);
    renderer_draw(renderer, &particles, NULL);
    renderer_read(renderer, straight);
    assert_memory_not_equal(straight, bent, sizeof bent);
    renderer_destroy(renderer);
    movers_destroy(movers);
}

/* What was gathered stays where a def is refused. */
static void a_refused_view_loses_no_trail(void **state)
{
    (void)state;
    enum { WIDE = 120, HIGH = 90 };
    static uint8_t before[3 * WIDE * HIGH], after[3 * WIDE * HIGH];
    Error error = {0};
    ViewDef def = trails_view();
    Movers *movers = movers_create();
    Renderer *renderer = renderer_create(&def, NULL, WIDE, HIGH, &error);
    assert_non_null(renderer);
    ParticleBuffers particles;
    for (int i = 0; i < 4; i++) {
        movers_clear(movers);
        movers_add(movers, 1, -0.3 + 0.2 * i, 0.5, 0, 0.25);
        particles = movers_upload(movers, 0.1 * i);
        renderer_draw(renderer, &particles, NULL);
    }
    renderer_read(renderer, before);
    text_set(def.kind, "blob");
    trails_def(&def)->show = false;
    assert_false(renderer_set_def(renderer, &def, NULL, &error));
    renderer_draw(renderer, &particles, NULL);
    renderer_read(renderer, after);
    assert_memory_equal(before, after, sizeof before);
    renderer_destroy(renderer);
    movers_destroy(movers);
}

/* A full ring loses the oldest column, and never the present state's data. */
static void columns_are_in_their_order(void **state)
{
    (void)state;
    TrailRing ring;
    assert_true(trail_ring_create(&ring, 100, 1, 4));
    for (int i = 0; i < 40; i++) { /* every other state becomes fixed */
        trail_ring_add(&ring, 0.5 * i, SCALAR_SPEED);
        assert_true(trail_ring_at(&ring, ring.head)->time == 0.5 * i);
        for (uint64_t k = ring.begin; k < ring.head; k++)
            assert_true(trail_ring_at(&ring, k)->time < trail_ring_at(&ring, k + 1)->time);
        assert_true(i < 10 || ring.head - ring.begin >= 3);
    }
    trail_ring_destroy(&ring);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_in_their_order),
        TEST(particles_are_found_in_any_order),
        TEST(points_are_no_closer_than_asked_for),
        TEST(time_may_go_back),
        TEST(a_refused_view_loses_no_trail),
        TEST(a_reset_empties_them),
        TEST(a_jump_is_no_path),
        TEST(particles_come_and_go),
        TEST(the_older_keeps_its_trail),
        TEST(some_are_chosen),
        TEST(ids_are_read),
        TEST(a_click_adds_up_to_sixteen),
        TEST(those_that_cross_a_plane_are_chosen),
        TEST(there_are_so_many_at_most),
        TEST(a_scalar_that_is_not_there_is_no_number),
        TEST(what_is_nowhere_has_no_point),
        TEST(hidden_ones_cost_nothing),
        TEST(a_curve_bends_their_colors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
