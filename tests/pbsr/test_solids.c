/* Solids as translucent layers: as opaque as said, lit and placed as they turn and move, of the same points.
 */
#include "tests/lists.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/views/pbsr/pbsr_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64, PIXELS = SIDE * SIDE, SETS = 64 };

/* An eye at z = 2 that looks along -z at a square of side 1 m around the origin. */
static SetSight sight_of_all(void)
{
    SetSight sight = {.near_plane = 0.01F, .width = SIDE, .height = SIDE, .scale = 1};
    sight.row[0][0] = sight.row[1][1] = 2 * SIDE;
    sight.row[2][2] = -1;
    sight.row[2][3] = 2;
    for (int k = 0; k < 4; k++) {
        sight.row[0][k] += 0.5F * SIDE * sight.row[2][k];
        sight.row[1][k] += 0.5F * SIDE * sight.row[2][k];
    }
    sight.pixel = 1.0F / (4 * SIDE * SIDE);
    return sight;
}

static SetImage image_for(const SetSight *sight)
{
    SetImage image = {.depth = calloc(PIXELS, 4), .word = calloc(PIXELS, 4)};
    assert_true(image.depth && image.word);
    set_image_clear(&image, sight);
    return image;
}

static void image_free(SetImage *image)
{
    free(image->depth);
    free(image->word);
}

/* Two boxes: the first moves 0.1 m along x within 1 s, the second turns by 70 degrees and moves. */
static WorldDef two_boxes(void)
{
    WorldDef world = {.dimensions = 3, .solid_count = 2};
    world.solids[0] =
        (SolidDef){.kind = SOLID_BOX, .size = {0.4, 0.4, 0.2}, .axis = {0, 1, 0}, .color = {1, 0, 0}};
    add_solid_motion(&world.solids[0],
                     (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.1, .frequency = 0.25});
    world.solids[1] = (SolidDef){.kind = SOLID_BOX,
                                 .centre = {0.2, 0.1, 0.1},
                                 .size = {0.3, 0.1, 0.2},
                                 .axis = {1, 0, 1},
                                 .angle_deg = 20,
                                 .color = {0, 1, 0}};
    add_solid_motion(&world.solids[1],
                     (Motion){.kind = MOTION_TURN, .axis = {1, 2, 3}, .angle_deg = 70, .duration = 1});
    add_solid_motion(&world.solids[1],
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.1, .frequency = 0.25});
    return world;
}

static PbsrDef def_of(double opacity)
{
    PbsrDef def = pbsr_usual;
    def.repeat = SETS;
    def.layer_count = 2;
    def.layers[0] = (PbsrLayer){.of = PBSR_SURFACE, .opacity = 0.4};
    def.layers[1] = (PbsrLayer){.of = PBSR_SOLIDS, .opacity = opacity};
    return def;
}

/* How much of the pixels nearer than 10 to (x, y) the sets of so many solids cover. */
static double covered(const RigidLayer *rigid, int solids, const SetSight *sight, int x, int y)
{
    SetImage image = image_for(sight);
    int found = 0;
    for (uint64_t set = 0; set < SETS; set++) {
        set_image_clear(&image, sight);
        for (int i = 0; i < solids; i++)
            rigid_layer_project(&rigid[i], 1, set, &image);
        for (int i = 0; i < PIXELS; i++)
            found += image.depth[i] && abs(i % SIDE - x) < 10 && abs(i / SIDE - y) < 10;
    }
    image_free(&image);
    return found / (19.0 * 19 * SETS);
}

/* A front and a back are seen through each other. */
static void solids_are_as_opaque_as_said(void **state)
{
    (void)state;
    const SetSight sight = sight_of_all();
    WorldDef world = two_boxes();
    const Frame frame = {.world = &world};
    SolidLayers layers = {.count = 0};
    uint64_t made = 0;
    world.solid_count = 1;
    for (int time = 0; time < 3; time++) {
        const PbsrDef def = def_of(0.4);
        const int moved = time == 1 ? 6 : 0; /* pixels, of 0.1 m at z = 0 */
        solid_layers_update(&layers, &def, time, &frame, &sight);
        assert_int_equal(layers.count, 1);
        const double asked = 1 - 0.6 * 0.6, off = sqrt(asked * (1 - asked) / (19.0 * 19 * SETS));
        const double found = covered(&layers.rigid[0], 1, &sight, SIDE / 2 + moved, SIDE / 2);
        if (fabs(found - asked) > 4 * off)
            fail_msg("at %d s: %g, not %g +- %g", time, found, asked, off);
        assert_float_equal(rigid_layer_fraction(&layers.rigid[0]), 1, 0);
        if (time > 0)
            assert_true(layers.rigid[0].made == made); /* moving solids keep points */
        made = layers.rigid[0].made;
    }
    const PbsrDef more = def_of(0.8);
    solid_layers_update(&layers, &more, 0, &frame, &sight);
    assert_true(layers.rigid[0].made > made);
    const PbsrDef none = {.repeat = SETS, .points = 1.2e7};
    solid_layers_update(&layers, &none, 0, &frame, &sight);
    assert_int_equal(layers.count, 0);
    solid_layers_free(&layers);
}

/* Solids in the same place are as opaque as two solids, not as a single solid. */
static void equal_solids_are_two(void **state)
{
    (void)state;
    const SetSight sight = sight_of_all();
    WorldDef world = two_boxes();
    const Frame frame = {.world = &world};
    const PbsrDef def = def_of(0.3);
    SolidLayers layers = {.count = 0};
    world.solids[1] = world.solids[0];
    solid_layers_update(&layers, &def, 0, &frame, &sight);
    const double asked = 1 - pow(0.7, 4), off = sqrt(asked * (1 - asked) / (19.0 * 19 * SETS)),
                 found = covered(layers.rigid, 2, &sight, SIDE / 2, SIDE / 2);
    if (fabs(found - asked) > 4 * off)
        fail_msg("%g, not %g +- %g", found, asked, off);
    solid_layers_free(&layers);
}

/* All solids together keep no more than a layer may. */
static void solids_share_the_points(void **state)
{
    (void)state;
    const SetSight sight = sight_of_all();
    WorldDef world = two_boxes();
    const Frame frame = {.world = &world};
    PbsrDef def = def_of(0.4);
    SolidLayers layers = {.count = 0};
    def.points = 1e5;
    def.repeat = 4096;
    for (int solids = 1; solids <= SOLIDS_MAX; solids += SOLIDS_MAX - 1) {
        size_t points = 0;
        world.solid_count = solids;
        for (int i = 1; i < solids; i++)
            world.solids[i] = world.solids[0];
        solid_layers_update(&layers, &def, 0, &frame, &sight);
        for (int i = 0; i < solids; i++) {
            assert_true(layers.rigid[i].sets > 1);
            points += layers.rigid[i].points.count;
        }
        if (points > 100000 || points < 50000)
            fail_msg("%d solids have %zu points", solids, points);
    }
    solid_layers_free(&layers);
}

/* A point of the solid's frame, in the box's, in double. */
static LayerPoint placed(const SurfacePoint *from, const BoxState *pose)
{
    LayerPoint point = {.inside = 1};
    float normal[3];
    double at[3], n[3];
    surface_normal_unpack(from->normal, normal);
    for (int k = 0; k < 3; k++) {
        at[k] = (double)from->position[k];
        n[k] = (double)normal[k];
    }
    quat_rotate(pose->orientation, at, at);
    quat_rotate(pose->orientation, n, n);
    for (int k = 0; k < 3; k++) {
        point.at[k] = (float)(at[k] + pose->position[k]);
        point.normal[k] = (float)n[k];
    }
    return point;
}

static int apart(uint32_t a, uint32_t b, int shift)
{
    return abs((int)(a >> shift & 1023) - (int)(b >> shift & 1023));
}

/* Against individually placed points. */
static void solids_stand_as_they_turn(void **state)
{
    (void)state;
    const SetSight sight = sight_of_all();
    const WorldDef world = two_boxes();
    const Frame frame = {.world = &world};
    const PbsrDef def = def_of(0.99); /* opaque enough for all points to stay at its nearest */
    SolidLayers layers = {.count = 0};
    for (int time = 0; time < 2; time++) {
        solid_layers_update(&layers, &def, time, &frame, &sight);
        assert_int_equal(layers.count, 2);
        const RigidLayer *rigid = &layers.rigid[1];
        SetImage image = image_for(&sight), direct = image_for(&sight);
        RigidLayer whole = *rigid;
        whole.wanted = HUGE_VAL; /* none is left out */
        rigid_layer_project(&whole, 1, 3, &image);
        BoxState pose;
        solid_pose(&world.solids[1], time, &pose);
        for (size_t i = 3; i < rigid->points.count; i += (size_t)rigid->sets) {
            const LayerPoint point = placed(&rigid->points.point[i], &pose);
            set_image_add(&direct, &sight, &point, layers.numbers[1]);
        }
        int seen = 0, other = 0;
        for (int i = 0; i < PIXELS; i++) {
            float a, b;
            memcpy(&a, &image.depth[i], sizeof a);
            memcpy(&b, &direct.depth[i], sizeof b);
            seen += b > 0;
            other += fabsf(a - b) > 1e-5F * b || apart(image.word[i], direct.word[i], 0) > 1 ||
                     apart(image.word[i], direct.word[i], 10) > 1 ||
                     image.word[i] >> 28 != direct.word[i] >> 28;
        }
        assert_true(seen > 200);
        assert_true(other <= seen / 100); /* points on the border of a pixel */
        image_free(&image);
        image_free(&direct);
    }
    solid_layers_free(&layers);
}

static void solids_have_their_colors(void **state)
{
    (void)state;
    const SetSight sight = sight_of_all();
    WorldDef world = two_boxes();
    const Frame frame = {.world = &world};
    PbsrDef def = def_of(0.4);
    AverageLook looks[AVERAGE_NUMBERS_MAX] = {{.own = false}};
    SolidLayers layers = {.count = 0};
    for (int i = 2; i < SOLIDS_MAX; i++)
        world.solids[i] = world.solids[i % 2];
    world.solid_count = SOLIDS_MAX;
    assert_int_equal(solid_layers_number(&def), 1);
    assert_int_equal(solid_layers_colors(&world), 2);
    solid_layers_fill_looks(&def, &world, looks);
    solid_layers_update(&layers, &def, 0, &frame, &sight);
    for (int i = 0; i < SOLIDS_MAX; i++) {
        const AverageLook *look = &looks[layers.numbers[i]];
        assert_true(look->own && look->lit);
        assert_memory_equal(look->color, world.solids[i].color, sizeof look->color);
    }
    def.layers[1].color[2] = 1;
    solid_layers_update(&layers, &def, 0, &frame, &sight);
    assert_int_equal(layers.numbers[5], 1);
    assert_int_equal(layers.rigid[5].points.point[0].surface, 1);
    for (int i = 0; i < SOLIDS_MAX; i++)
        world.solids[i].color[2] = (float)i;
    assert_int_equal(solid_layers_colors(&world), SOLIDS_MAX);
    solid_layers_free(&layers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_are_as_opaque_as_said), cmocka_unit_test(equal_solids_are_two),
        cmocka_unit_test(solids_share_the_points),      cmocka_unit_test(solids_stand_as_they_turn),
        cmocka_unit_test(solids_have_their_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
