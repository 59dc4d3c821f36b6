/* A tank of clear fluid at rest in the view splat: its sides are the walls of the box, its top the level, and
   light is absorbed along the way between. */
#include "tests/splat/splat_fixture.h"
#include "tests/volume/still_water.h"

enum { SIDE = 160 };
static const double SPACING = 0.05, LEVEL = 0.5, WALL[3] = {0.5, 0, 0.25}; /* m */
static const float COLOUR[3] = {0.2F, 0.5F, 0.9F};

/* A lattice that is half a spacing from each wall, seen from the front, the right and above. */
static SplatScene tank(void)
{
    SplatScene scene = splat_scene((double[]){0.7, 1.1, 1.6}, (double[]){0, 0.3, 0}, 35, SPACING);
    scene.width = scene.height = SIDE;
    memcpy(scene.state.box_size, (double[]){2 * WALL[0], 1, 2 * WALL[2]}, sizeof scene.state.box_size);
    memcpy(scene.world.fluids[0].color, COLOUR, sizeof COLOUR);
    splat_def(&scene.def)->shading = SPLAT_WATER, splat_def(&scene.def)->attenuation = 0.4;
    splat_def(&scene.def)->shape = SPLAT_SHAPE_AUTO, splat_def(&scene.def)->filter = SPLAT_FILTER_AUTO;
    splat_def(&scene.def)->drops = true;
    for (int i = 0; i < 20 * 10 * 10; i++)
        particles_add(scene.particles, SPACING * (i % 20 - 9.5), SPACING * (i / 20 % 10 + 0.5),
                      SPACING * (i / 200 - 4.5), 1, 0);
    return scene;
}

/* A pixel's ray from the eye, and where it is between the walls, for a depth of 1 m: the floor is one, no lid
   is. */
typedef struct Through {
    double from[3], way[3], enter, leave;
} Through;

static Through sight_of(const SplatScene *scene, int x, int y)
{
    Through sight = {.enter = -1e30, .leave = 1e30};
    const Camera *camera = &scene->frame.camera;
    const double ray[3] = {(2 * (x + 0.5) / SIDE - 1) * camera->tangent[0],
                           (2 * (y + 0.5) / SIDE - 1) * camera->tangent[1], -1};
    for (int k = 0; k < 3; k++) {
        const float *column = &camera->view[4 * k];
        sight.from[k] = scene->def.camera.from[k];
        sight.way[k] = column[0] * ray[0] + column[1] * ray[1] + column[2] * ray[2];
        const double low = k == 1 ? 0 : -WALL[k], high = k == 1 ? 1e9 : WALL[k];
        const double a = (low - sight.from[k]) / sight.way[k], b = (high - sight.from[k]) / sight.way[k];
        sight.enter = fmax(sight.enter, fmin(a, b)), sight.leave = fmin(sight.leave, fmax(a, b));
    }
    return sight;
}

static double height_at(const Through *sight, double depth)
{
    return sight->from[1] + depth * sight->way[1];
}

/* In the box, m. Ellipsoids round its edges by a fraction of a spacing: the shortest ways miss them. */
static double way_of(const Through *sight)
{
    return sqrt(dot3(sight->way, sight->way)) * (sight->leave - sight->enter);
}

/* How far the top may be beside its level, in spacings: measured 0.052, the mean 0.021 below; and within half
   a spacing of the sides, where the last bumps have nothing beyond to be smoothed with, 0.201. */
static const double TOP = 0.06, RIM = 0.25;

typedef struct Tally {
    int panes, top, rim, none;
} Tally;

/* The least way to a side. */
static double from_walls(const Through *sight, double depth)
{
    return fmin(WALL[0] - fabs(sight->from[0] + depth * sight->way[0]),
                WALL[2] - fabs(sight->from[2] + depth * sight->way[2]));
}

static void check_depth(const Through *sight, double depth, int x, int y, Tally *tally)
{
    const double to_level = (LEVEL - sight->from[1]) / sight->way[1];
    const double enters = height_at(sight, sight->enter) - LEVEL,
                 leaves = height_at(sight, sight->leave) - LEVEL;
    if (sight->enter >= sight->leave || leaves > 0.1 * SPACING) {
        tally->none++;
        if (depth < 1e29)
            fail_msg("pixel %d %d: %g m, where no fluid is", x, y, depth);
    } else if (enters < -0.6 * SPACING && way_of(sight) > 1.5 * SPACING) {
        tally->panes++;
        if (fabs(-depth - sight->enter) > 1e-5)
            fail_msg("pixel %d %d: pane at %g m, not %g", x, y, -depth, sight->enter);
    } else if (enters > 0 && leaves < 0) {
        const bool rim = from_walls(sight, to_level) < 0.5 * SPACING;
        const double above = (height_at(sight, depth) - LEVEL) / SPACING;
        tally->top += !rim, tally->rim += rim;
        if (depth > 0 && depth < 1e29 && fabs(above) > (rim ? RIM : TOP))
            fail_msg("pixel %d %d: %g spacings above the level", x, y, above);
        if (!rim && (depth < 0 || depth > 1e29))
            fail_msg("pixel %d %d: %g m, where the top is", x, y, depth);
    }
}

/* Of clear and of opaque fluid. */
static void the_surface_is_the_walls_and_the_level(void **state)
{
    (void)state;
    static const SplatShading shadings[] = {SPLAT_WATER, SPLAT_PHONG};
    for (int k = 0; k < 2; k++) {
        Tally tally = {0};
        SplatScene scene = tank();
        splat_def(&scene.def)->shading = shadings[k];
        SplatPixel *pixels = splat_drawn(&scene);
        for (int i = 0; i < SIDE * SIDE; i++) {
            const Through sight = sight_of(&scene, i % SIDE, i / SIDE);
            check_depth(&sight, pixels[i].shown_depth, i % SIDE, i / SIDE, &tally);
        }
        if (tally.panes < 2000 || tally.top < 2000 || tally.rim < 200 || tally.none < 5000)
            fail_msg("compared: %d of panes, %d of the top, %d of its rim, %d beside", tally.panes, tally.top,
                     tally.rim, tally.none);
        free(pixels);
        free(scene.particles);
    }
}

static double linear_of(uint8_t code)
{
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static uint8_t grey[4 * SIDE * SIDE];

static void lay_grey(const Target *target)
{
    memset(grey, 230, sizeof grey);
    glTextureSubImage2D(target->color, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, grey);
}

/* What comes through the water alone, over grey. */
static uint8_t *seen_through(SplatScene *scene, double attenuation)
{
    uint8_t *rgba = calloc(4, SIDE * SIDE);
    assert_non_null(rgba);
    splat_def(&scene->def)->attenuation = attenuation;
    SplatDrawing drawing = splat_open(scene, lay_grey, true);
    glGetTextureImage(drawing.target.color, 0, GL_RGBA, GL_UNSIGNED_BYTE, 4 * SIDE * SIDE, rgba);
    splat_close(&drawing);
    return rgba;
}

/* Fluid thickness from a pixel's green, m, relative to a fluid without absorption. */
static double thickness_seen(const uint8_t *rgba, const uint8_t *clear)
{
    return 0.4 * log(linear_of(rgba[1]) / linear_of(clear[1])) / log((double)COLOUR[1]);
}

/* The pixel's path in the tank. `sides`: number of reflections; -1 if entering next to an edge rounded by
   ellipsoids. */
static double wanted_way(const Through *sight, int *sides)
{
    static const double low[] = {-0.5, 0, -0.25}, high[] = {0.5, 0.5, 0.25}, near = 1.5;
    const double length = sqrt(dot3(sight->way, sight->way)), top = (LEVEL - sight->from[1]) / sight->way[1];
    const double enter = fmax(top, sight->enter);
    double at[3], to[3];
    int close = 0;
    for (int k = 0; k < 3; k++) {
        at[k] = sight->from[k] + enter * sight->way[k], to[k] = sight->way[k] / length;
        close += fmin(at[k] - low[k], high[k] - at[k]) < near * SPACING;
    }
    const double way = way_in_water(low, high, at, to, sides);
    *sides = close > 1 ? -1 : *sides;
    return way;
}

/* Water is as deep at the edges of a tank as elsewhere, since its sides mirror what comes from within. */
static void sides_mirror_from_within(void **state)
{
    (void)state;
    int compared = 0, mirrored = 0;
    double worst = 0;
    SplatScene scene = tank();
    uint8_t *clear = seen_through(&scene, 1e6), *blue = seen_through(&scene, 0.4);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const Through sight = sight_of(&scene, i % SIDE, i / SIDE);
        int sides;
        if (way_of(&sight) < 1.5 * SPACING || height_at(&sight, sight.leave) > LEVEL - SPACING)
            continue;
        const double way = wanted_way(&sight, &sides), seen = thickness_seen(&blue[4 * i], &clear[4 * i]);
        if (sides < 0)
            continue;
        compared++, mirrored += sides > 0;
        worst = fmax(worst, fabs(seen - way) / (way + SPACING));
    }
    printf("%d of %d pixels by sides, the worst %.3f of the way off\n", mirrored, compared, worst);
    assert_true(compared > 1500 && mirrored > 500 && worst < 0.05);
    free(clear);
    free(blue);
    free(scene.particles);
}

/* The darkest of the pixels around a place of the box; `rgba` of the last drawing. */
static int darkest_at(const SplatScene *scene, const double place[3], const uint8_t *rgba)
{
    float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    int darkest = 255;
    matrix_transform(scene->frame.camera.view, at, at);
    for (int i = 0; i < 9; i++) {
        const double u = at[0] / -at[2] / scene->frame.camera.tangent[0],
                     v = at[1] / -at[2] / scene->frame.camera.tangent[1];
        const int x = (int)(SIDE * (0.5 + 0.5 * u)) + i % 3 - 1,
                  y = (int)(SIDE * (0.5 + 0.5 * v)) + i / 3 - 1;
        darkest = rgba[4 * (y * SIDE + x)] < darkest ? rgba[4 * (y * SIDE + x)] : darkest;
    }
    return darkest;
}

/* Fluid that neither bends nor tints, over grey. */
static SplatScene clear_tank(void)
{
    SplatScene scene = tank();
    splat_def(&scene.def)->ior = 1, splat_def(&scene.def)->attenuation = 0.01;
    for (int k = 0; k < 3; k++)
        scene.world.fluids[0].color[k] = 1, scene.world.fluids[1].color[k] = 0;
    return scene;
}

static uint8_t *draw_over_grey(SplatScene *scene)
{
    uint8_t *rgba = calloc(4, SIDE * SIDE);
    assert_non_null(rgba);
    SplatDrawing drawing = splat_open(scene, lay_grey, true);
    glGetTextureImage(drawing.target.color, 0, GL_RGBA, GL_UNSIGNED_BYTE, 4 * SIDE * SIDE, rgba);
    splat_close(&drawing);
    return rgba;
}

/* Where the fluid stands before the rest of the box. */
static void a_drop_behind_is_seen_through(void **state)
{
    (void)state;
    static const double at[3] = {-0.1, 0.2, -0.55}, beside[3] = {0.1, 0.2, -0.55};
    SplatScene scene = clear_tank();
    scene.state.box_size[2] = 1.4;
    particles_add(scene.particles, at[0], at[1], at[2], 1, 1);
    uint8_t *rgba = draw_over_grey(&scene);
    if (darkest_at(&scene, at, rgba) > 60 || darkest_at(&scene, beside, rgba) < 225)
        fail_msg("%d at the black drop, %d beside it", darkest_at(&scene, at, rgba),
                 darkest_at(&scene, beside, rgba));
    free(rgba);
    free(scene.particles);
}

/* Only edges behind belong to the view: the rest is an overlay. */
static void edges_behind_are_seen_through(void **state)
{
    (void)state;
    static const double behind[3] = {0, 0, -0.25}, before[3] = {0.5, 0.2, 0.25};
    for (int i = 0; i < 2; i++) {
        SplatScene scene = clear_tank();
        scene.def.box = i == 1;
        uint8_t *rgba = draw_over_grey(&scene);
        const int far = darkest_at(&scene, behind, rgba), near = darkest_at(&scene, before, rgba);
        if ((i == 0 ? far < 225 : far > 170) || near < 225)
            fail_msg("%s: %d at the edge behind, %d at the edge before", i == 0 ? "no box" : "box", far,
                     near);
        free(rgba);
        free(scene.particles);
    }
}

/* A heap of jelly, whose thickness varies: as smooth in a scene with a solid, which is far outside the
   picture. */
static void a_solid_elsewhere_changes_nothing(void **state)
{
    (void)state;
    uint8_t *seen[2];
    int most = 0;
    for (int i = 0; i < 2; i++) {
        SplatScene scene = clear_tank();
        size_t kept = 0;
        splat_def(&scene.def)->shading = SPLAT_JELLY, splat_def(&scene.def)->attenuation = 0.4;
        memcpy(scene.world.fluids[0].color, COLOUR, sizeof COLOUR);
        for (size_t p = 0; p < scene.particles->count; p++) {
            const float *at = &scene.particles->position[4 * p];
            if (at[1] < 0.15 + 0.5 * fabs(at[0]))
                memcpy(&scene.particles->position[4 * kept++], at, 4 * sizeof *at);
        }
        scene.particles->count = kept;
        scene.world.solid_count = i;
        scene.world.solids[0] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 9, 9}, .radius = 0.1};
        seen[i] = draw_over_grey(&scene);
        free(scene.particles);
    }
    for (int i = 0; i < 4 * SIDE * SIDE; i++)
        most = abs(seen[0][i] - seen[1][i]) > most ? abs(seen[0][i] - seen[1][i]) : most;
    if (most > 1)
        fail_msg("%d of 255 apart", most);
    free(seen[0]);
    free(seen[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_surface_is_the_walls_and_the_level, no_gl_errors),
        cmocka_unit_test_teardown(a_drop_behind_is_seen_through, no_gl_errors),
        cmocka_unit_test_teardown(edges_behind_are_seen_through, no_gl_errors),
        cmocka_unit_test_teardown(sides_mirror_from_within, no_gl_errors),
        cmocka_unit_test_teardown(a_solid_elsewhere_changes_nothing, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
