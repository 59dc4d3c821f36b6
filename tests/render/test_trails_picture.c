/* Overlay `trails` in pictures: a path equals the particle's path to the pixel, and cached pictures equal
   new drawings to the bit. */
#include "tests/render/trails_fixture.h"

#include "render/views/pbsr/pbsr.h"

enum { WIDE = 240, HIGH = 180, BYTES = 3 * WIDE * HIGH };

typedef struct Show {
    Movers *movers;
    Renderer *renderer;
    ViewDef def;
    WorldDef world;
} Show;

static Show open_show(void)
{
    Error error = {0};
    Show show = {.movers = movers_create(), .def = trails_view(), .world = bare_world()};
    show.renderer = renderer_create(&show.def, &show.world, WIDE, HIGH, &error);
    if (!show.renderer)
        fail_msg("%s", error.message);
    return show;
}

static void close_show(Show *show)
{
    renderer_destroy(show->renderer);
    movers_destroy(show->movers);
}

static void follow(Show *show)
{
    Error error = {0};
    assert_true(renderer_set_def(show->renderer, &show->def, &show->world, &error));
}

/* The picture of the added states, at the given time. */
static void draw(Show *show, double time, uint8_t rgb[BYTES])
{
    const ParticleBuffers particles = movers_upload(show->movers, time);
    renderer_draw(show->renderer, &particles, NULL);
    renderer_read(show->renderer, rgb);
}

/* The same without trails. */
static void draw_bare(Show *show, uint8_t rgb[BYTES])
{
    Error error = {0};
    ViewDef def = show->def;
    const ParticleBuffers particles = movers_upload(show->movers, show->movers->state.time);
    trails_def(&def)->show = false;
    Renderer *renderer = renderer_create(&def, &show->world, WIDE, HIGH, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &particles, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

/* A particle on a circle about the box's middle, in a leaning plane. */
static void on_circle(double angle, double at[3])
{
    at[0] = 0.4 * cos(angle);
    at[1] = 0.5 + 0.32 * sin(angle);
    at[2] = 0.24 * sin(angle);
}

static void add_on_circle(Movers *movers, double angle)
{
    double at[3];
    on_circle(angle, at);
    movers_clear(movers);
    movers_add(movers, 0, at[0], at[1], at[2], 0.5);
}

static void project(const Show *show, const double at[3], double pixel[2])
{
    Camera camera;
    double depth;
    const ParticleBuffers *state = &show->movers->state;
    camera_make(&show->def, state->box_size, &state->box, (double)WIDE / HIGH, (CoveredParts){0}, &camera);
    assert_true(camera_project(&camera, at, WIDE, HIGH, pixel, &depth));
}

enum { ARC = 400 };

/* Pixels along the arc between two angles. */
static void make_arc(const Show *show, double begin, double end, double arc[ARC][2])
{
    for (int i = 0; i < ARC; i++) {
        double at[3];
        on_circle(begin + (end - begin) * i / (ARC - 1), at);
        project(show, at, arc[i]);
    }
}

/* How far the pixel's centre is from it. */
static double from_arc(double arc[ARC][2], int x, int y)
{
    double nearest = 1e9;
    for (int i = 0; i < ARC; i++)
        nearest = fmin(nearest, hypot(x + 0.5 - arc[i][0], y + 0.5 - arc[i][1]));
    return nearest;
}

static bool differ(const uint8_t *a, const uint8_t *b, int x, int y)
{
    return memcmp(&a[3 * (y * WIDE + x)], &b[3 * (y * WIDE + x)], 3) != 0;
}

/* A rigid rotation: the trail is an arc of the circle, exactly. */
static void the_path_is_the_circle(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES], bare[BYTES];
    Show show = open_show();
    trails_def(&show.def)->width = 2;
    trails_def(&show.def)->length = 0.5;
    follow(&show);
    const double rate = 4, last = 1.2, dt = 0.01;
    for (int i = 0; i <= 120; i++) {
        add_on_circle(show.movers, rate * dt * i);
        draw(&show, dt * i, rgb);
    }
    draw_bare(&show, bare);
    double whole[ARC][2], bright_part[ARC][2]; /* what has not faded to a tenth */
    make_arc(&show, rate * (last - 0.5), rate * last, whole);
    make_arc(&show, rate * (last - 0.45), rate * (last - 0.01), bright_part);
    int drawn = 0;
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++) {
            const double away = from_arc(whole, x, y);
            const double bright = from_arc(bright_part, x, y);
            if (differ(rgb, bare, x, y) && !(away < 1.55))
                fail_msg("pixel %d %d is drawn, %g from the path", x, y, away);
            if (!differ(rgb, bare, x, y) && bright < 0.95)
                fail_msg("pixel %d %d is not drawn, %g from the path", x, y, bright);
            drawn += differ(rgb, bare, x, y);
        }
    assert_in_range(drawn, 100, 1000);
    close_show(&show);
}

static void wild(Movers *movers, double time)
{
    movers_clear(movers);
    for (uint32_t id = 0; id < 200; id++) {
        const double a = id * 0.7 + 3 * time, b = id * 1.3 - 2 * time;
        movers_add(movers, id, 0.8 * sin(a), 0.5 + 0.4 * sin(b + a), 0.4 * cos(b), 0.5 + 0.5 * sin(a));
    }
}

/* Each picture draws only what is new: all drawn anew, after a look from elsewhere, is the same. */
static void keep_and_draw_anew(double every)
{
    static uint8_t kept[BYTES], anew[BYTES], elsewhere[BYTES];
    Show show = open_show();
    trails_def(&show.def)->every = every;
    follow(&show);
    for (int i = 0; i <= 60; i++) {
        wild(show.movers, 0.013 * i);
        draw(&show, 0.013 * i, kept);
    }
    const ParticleBuffers particles = movers_upload(show.movers, 0.013 * 60);
    show.def.camera_auto = false;
    show.def.camera = (CameraDef){{1, 1, 2}, {0, 0.4, 0}, 40};
    follow(&show);
    renderer_draw(show.renderer, &particles, NULL);
    renderer_read(show.renderer, elsewhere);
    assert_memory_not_equal(kept, elsewhere, sizeof kept);
    show.def.camera_auto = true;
    follow(&show);
    for (int i = 0; i < 3; i++) { /* several pictures of one state */
        renderer_draw(show.renderer, &particles, NULL);
        renderer_read(show.renderer, anew);
        assert_memory_equal(kept, anew, sizeof kept);
    }
    close_show(&show);
}

static void what_is_kept_is_what_would_be_drawn(void **state)
{
    (void)state;
    keep_and_draw_anew(0);
    keep_and_draw_anew(0.09); /* most states are replaced by the next one */
}

/* A picture after a step back is of the time, and all following pictures too. */
static void a_step_back_leaves_nothing(void **state)
{
    (void)state;
    enum { STATES = 40, BACK = 15 };
    static uint8_t first[STATES][BYTES], again[BYTES];
    Show show = open_show();
    for (int i = 0; i < STATES; i++) {
        wild(show.movers, 0.01 * i);
        draw(&show, 0.01 * i, first[i]);
    }
    for (int i = STATES - 2; i >= BACK; i--) {
        wild(show.movers, 0.01 * i);
        draw(&show, 0.01 * i, again);
        assert_memory_equal(first[i], again, BYTES);
    }
    for (int i = BACK + 1; i < STATES; i++) {
        wild(show.movers, 0.01 * i);
        draw(&show, 0.01 * i, again);
        assert_memory_equal(first[i], again, BYTES);
    }
    close_show(&show);
}

/* Particles in the order of a solver: the same picture. */
static void the_order_of_particles_is_of_no_account(void **state)
{
    (void)state;
    static uint8_t one[BYTES], other[BYTES];
    for (int turned = 0; turned < 2; turned++) {
        Show show = open_show();
        Movers *movers = show.movers;
        for (int i = 0; i < 30; i++) {
            wild(movers, 0.01 * i);
            for (size_t a = 0, b = movers->count - 1; turned && a < b; a++, b--) {
                float place[4];
                memcpy(place, &movers->position[4 * a], sizeof place);
                memcpy(&movers->position[4 * a], &movers->position[4 * b], sizeof place);
                memcpy(&movers->position[4 * b], place, sizeof place);
                const float value = movers->value[a];
                const uint32_t id = movers->id[a];
                movers->value[a] = movers->value[b], movers->value[b] = value;
                movers->id[a] = movers->id[b], movers->id[b] = id;
            }
            draw(&show, 0.01 * i, turned ? other : one);
        }
        close_show(&show);
    }
    assert_memory_equal(one, other, BYTES);
}

static int pixels_apart(const uint8_t *a, const uint8_t *b)
{
    int count = 0;
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
            count += differ(a, b, x, y);
    return count;
}

/* In a window with a moving eye trails have fewer pieces, and all pieces in the next picture. */
static void pieces_are_few_while_the_camera_moves(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES], all[BYTES], bare[BYTES];
    for (int moving = 0; moving < 3; moving++) {
        Show show = open_show();
        trails_def(&show.def)->every = 0.001;
        trails_def(&show.def)->moving = moving == 0 ? 0 : moving == 1 ? 1000000 : 2000;
        renderer_set_continuous(show.renderer, moving > 0);
        follow(&show);
        for (int i = 0; i <= 60; i++) {
            wild(show.movers, 0.013 * i);
            draw(&show, 0.013 * i, rgb);
            assert_false(renderer_unfinished(show.renderer));
        }
        show.def.camera_auto = false;
        show.def.camera = (CameraDef){{1, 1, 2}, {0, 0.4, 0}, 40};
        follow(&show);
        draw(&show, 0.013 * 60, moving == 0 ? all : rgb);
        const bool few = moving == 2 && gl_renderer_is_software(); /* hardware draws them all at once */
        assert_int_equal(renderer_unfinished(show.renderer), few);
        if (few) { /* curves by chords */
            draw_bare(&show, bare);
            const int drawn = pixels_apart(all, bare), apart = pixels_apart(all, rgb);
            if (apart < 100 || pixels_apart(rgb, bare) < drawn * 9 / 10)
                fail_msg("%d pixels differ of %d, %d have chords", apart, drawn, pixels_apart(rgb, bare));
            renderer_draw(show.renderer, &show.movers->state, NULL);
            renderer_read(show.renderer, rgb);
            assert_false(renderer_unfinished(show.renderer));
        }
        if (moving > 0)
            assert_memory_equal(all, rgb, BYTES);
        close_show(&show);
    }
}

/* Layers before and behind few pieces are redrawn with all pieces. */
static void layers_see_all_pieces(void **state)
{
    (void)state;
    static uint8_t rgb[2][BYTES], first[BYTES];
    for (int more = 0; more < 2; more++) {
        Show show = open_show();
        text_set(show.def.kind, "pbsr");
        trails_def(&show.def)->every = 0.001;
        trails_def(&show.def)->moving = 2000;
        PbsrDef *own = pbsr_def(&show.def);
        own->repeat = own->moving = 8;
        own->layer_count = 1;
        own->layers[0] = (PbsrLayer){.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.8, .color = {1, 0, 0}};
        renderer_set_continuous(show.renderer, more);
        follow(&show);
        ParticleBuffers particles;
        for (int i = 0; i <= 30; i++) {
            wild(show.movers, 0.026 * i);
            particles = movers_upload(show.movers, 0.026 * i);
            renderer_add_state(show.renderer, &particles, NULL);
        }
        renderer_draw(show.renderer, &particles, NULL);
        show.def.camera_auto = false;
        show.def.camera = (CameraDef){{1, 1, 2}, {0, 0.4, 0}, 40};
        follow(&show);
        renderer_draw(show.renderer, &particles, NULL);
        renderer_read(show.renderer, first);
        assert_int_equal(renderer_unfinished(show.renderer), more && gl_renderer_is_software());
        for (int i = 0; i < 4 && renderer_unfinished(show.renderer); i++)
            renderer_draw(show.renderer, &particles, NULL);
        assert_false(renderer_unfinished(show.renderer));
        renderer_read(show.renderer, rgb[more]);
        close_show(&show);
    }
    assert_true(pixels_apart(rgb[0], first) > 100 || !gl_renderer_is_software());
    assert_int_equal(pixels_apart(rgb[0], rgb[1]), 0);
}

static int drawn_pixels(Show *show, const uint8_t *rgb)
{
    static uint8_t bare[BYTES];
    int drawn = 0;
    draw_bare(show, bare);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
            drawn += differ(rgb, bare, x, y);
    return drawn;
}

/* A particle leaving through a side and entering by the opposite side. */
static void no_line_across_periodic_sides(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    for (int periodic = 0; periodic < 2; periodic++) {
        Show show = open_show();
        show.world.periodic[0] = periodic;
        follow(&show);
        for (int i = 0; i < 3; i++) {
            movers_clear(show.movers);
            movers_add(show.movers, 0, i < 2 ? 0.96 + 0.02 * i : -0.99, 0.5, 0, 0);
            draw(&show, 0.01 * i, rgb);
        }
        const int drawn = drawn_pixels(&show, rgb);
        assert_true(periodic ? drawn > 0 && drawn < 30 : drawn > 150);
        close_show(&show);
    }
}

/* A drained trail fades in place; an emitted particle starts a new trail. */
static void who_goes_leaves_a_trail_that_fades(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    Show show = open_show();
    for (int i = 0; i <= 20; i++) {
        movers_clear(show.movers);
        movers_add(show.movers, 3, -0.8 + 0.02 * i, 0.8, 0, 0);
        draw(&show, 0.01 * i, rgb);
    }
    const int before = drawn_pixels(&show, rgb);
    for (int i = 21; i <= 130; i++) {
        movers_clear(show.movers);
        movers_add(show.movers, 1024 + 3, 0.8, 0.1, 0, 0); /* with the same place in memory, at rest */
        draw(&show, 0.01 * i, rgb);
        if (i % 20 == 0 && i <= 80)
            assert_in_range(drawn_pixels(&show, rgb), before - 10, before);
    }
    assert_in_range(before, 40, 200);
    assert_int_equal(drawn_pixels(&show, rgb), 0);
    close_show(&show);
}

/* A block before the path: hidden, or as faint as is asked for. */
static void solids_hide_what_is_behind(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    int drawn[3];
    for (int k = 0; k < 3; k++) {
        Show show = open_show();
        show.world.solids[0] = (SolidDef){SOLID_BOX, .centre = {0, 0.5, 0.3}, .size = {1.8, 0.9, 0.05},
                                          .axis = {0, 1, 0}, .color = {0.5F, 0.5F, 0.5F}};
        show.world.solid_count = k > 0;
        trails_def(&show.def)->through = k == 2 ? 0.5 : 0;
        follow(&show);
        for (int i = 0; i <= 30; i++) {
            movers_clear(show.movers);
            movers_add(show.movers, 0, 0.3 - 0.02 * i, 0.5, -0.2, 0);
            draw(&show, 0.01 * i, rgb);
        }
        drawn[k] = drawn_pixels(&show, rgb);
        close_show(&show);
    }
    assert_true(drawn[0] > 50 && drawn[1] == 0 && drawn[2] > drawn[0] - 20);
}

/* The CPU's drawing for a software driver equals the GPU's, except pixels with centres on an edge; from a
   new place for each tenth state. */
static void cpu_and_gpu_draw_the_same(void **state)
{
    (void)state;
    static uint8_t picture[2][BYTES];
    Show show[2] = {open_show(), open_show()};
    int worst = 0, drawn = 0;
    trails_def(&show[1].def)->by = TRAILS_QUADS;
    for (int k = 0; k < 2; k++) {
        trails_def(&show[k].def)->every = 0.001; /* each state is a point */
        trails_def(&show[k].def)->width = 3;
        show[k].def.camera_auto = false;
    }
    for (int i = 0; i <= 60; i++) {
        for (int k = 0; k < 2; k++) {
            const double near = 0.2 + i / 10; /* at first among the trails */
            show[k].def.camera = (CameraDef){{near, 0.8, 0.3 * near}, {0, 0.4, 0}, 50};
            follow(&show[k]);
            wild(show[k].movers, 0.013 * i);
            draw(&show[k], 0.013 * i, picture[k]);
        }
        int differ_here = 0;
        for (int y = 0; y < HIGH; y++)
            for (int x = 0; x < WIDE; x++) {
                const uint8_t *a = &picture[0][3 * (y * WIDE + x)], *b = &picture[1][3 * (y * WIDE + x)];
                differ_here += abs(a[0] - b[0]) > 8 || abs(a[1] - b[1]) > 8 || abs(a[2] - b[2]) > 8;
            }
        worst = differ_here > worst ? differ_here : worst;
    }
    drawn = drawn_pixels(&show[0], picture[0]);
    if (worst > 20 || drawn < 500)
        fail_msg("%d pixels of %d differ, %d are drawn at last", worst, WIDE * HIGH, drawn);
    close_show(&show[0]);
    close_show(&show[1]);
}

static void assert_color(const Show *show, const uint8_t *rgb, const double place[3], const uint8_t color[3])
{
    double pixel[2];
    project(show, place, pixel);
    const uint8_t *found = &rgb[3 * ((int)pixel[1] * WIDE + (int)pixel[0])];
    for (int c = 0; c < 3; c++)
        if (abs(found[c] - color[c]) > 48) /* faded by 2 % */
            fail_msg("%d %d %d at x = %g", found[0], found[1], found[2], place[0]);
}

/* Lines have colours by the scalar of the time, magenta for NaN; after a change of scalar gray. */
static void colours_are_those_of_the_time(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    Show show = open_show();
    show.def.range_auto = false;
    show.def.range[1] = 1;
    trails_def(&show.def)->width = 4;
    trails_def(&show.def)->length = 1000; /* little has faded */
    trails_def(&show.def)->every = 0.01;
    follow(&show);
    for (int i = 0; i <= 40; i++) {
        movers_clear(show.movers);
        movers_add(show.movers, 0, -0.4 + 0.02 * i, 0.5, 0, i <= 16 ? 0 : i <= 28 ? NAN : 1);
        draw(&show, i, rgb);
    }
    static const double places[3][3] = {{-0.2, 0.5, 0}, {0.05, 0.5, 0}, {0.3, 0.5, 0}};
    static const uint8_t colors[3][3] = {{68, 1, 84}, {255, 0, 203}, {253, 231, 37}}, gray = 65; /* viridis */
    for (int k = 0; k < 3; k++)
        assert_color(&show, rgb, places[k], colors[k]);
    show.def.color_by = show.def.color_by == SCALAR_PRESSURE ? SCALAR_DENSITY : SCALAR_PRESSURE;
    follow(&show);
    draw(&show, 41, rgb);
    for (int k = 0; k < 3; k++)
        assert_color(&show, rgb, places[k], (uint8_t[]){gray, gray, gray});
    close_show(&show);
}

/* States between pictures, as of `slosh render`, are points of the path. */
static void states_between_pictures_count(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES], straight[BYTES];
    Show show = open_show();
    for (int i = 0; i <= 50; i++) {
        add_on_circle(show.movers, 0.06 * i);
        const ParticleBuffers particles = movers_upload(show.movers, 0.01 * i);
        if (i % 50 == 0)
            draw(&show, 0.01 * i, rgb);
        else
            renderer_add_state(show.renderer, &particles, NULL);
    }
    const int drawn = drawn_pixels(&show, rgb);
    double at[3], pixel[2];
    on_circle(1.5, at);
    project(&show, at, pixel);
    draw_bare(&show, straight);
    assert_true(differ(rgb, straight, (int)pixel[0], (int)pixel[1]));
    assert_in_range(drawn, 80, 400);
    close_show(&show);
}

/* Side by side, each straight up. */
static void draw_risers(Show *show, int from, int to, uint8_t rgb[BYTES])
{
    for (int i = from; i <= to; i++) {
        movers_clear(show->movers);
        for (unsigned k = 0; k < 4; k++)
            movers_add(show->movers, 10 * k, -0.3 + 0.2 * k, 0.2 + 0.01 * i, 0, 0.2 * k);
        draw(show, 0.01 * i, rgb);
    }
}

static void list(Show *show, const char *ids)
{
    TrailsDef *own = trails_def(&show->def);
    snprintf(own->ids, sizeof own->ids, "%s", ids);
    follow(show);
}

/* As if listed alone from the start; the free slot is the next particle's. */
static void one_goes_and_the_others_stay(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES], alone[BYTES];
    Show some = open_show(), two = open_show();
    list(&some, "0 20 10");
    list(&two, "0 10");
    draw_risers(&some, 0, 30, rgb);
    draw_risers(&two, 0, 30, alone);
    assert_memory_not_equal(rgb, alone, BYTES);
    list(&some, "0 10");
    draw_risers(&some, 30, 30, rgb); /* the same state: at once */
    assert_memory_equal(rgb, alone, BYTES);
    list(&some, "0 10 30");
    list(&two, "0 10 30");
    draw_risers(&some, 30, 45, rgb);
    draw_risers(&two, 30, 45, alone);
    assert_memory_equal(rgb, alone, BYTES);
    close_show(&some);
    close_show(&two);
}

#define TEST(name) cmocka_unit_test_teardown(name, no_gl_errors)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_path_is_the_circle),        TEST(what_is_kept_is_what_would_be_drawn),
        TEST(a_step_back_leaves_nothing),    TEST(the_order_of_particles_is_of_no_account),
        TEST(no_line_across_periodic_sides), TEST(who_goes_leaves_a_trail_that_fades),
        TEST(solids_hide_what_is_behind),    TEST(colours_are_those_of_the_time),
        TEST(states_between_pictures_count), TEST(one_goes_and_the_others_stay),
        TEST(cpu_and_gpu_draw_the_same),     TEST(pieces_are_few_while_the_camera_moves),
        TEST(layers_see_all_pieces),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
