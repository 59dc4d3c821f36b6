/* Opacity of points by pixels: the formulas of Tanaka et al. 2012, section 3, noise, and transparent surfaces
   that overlap against exact compositing in the order of depth. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/views/pbsr/pbsr_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Eq. 1, tilted: alpha of n points on an area of which a pixel is the fraction `part`. */
static double opacity_of_points(double n, double part, double theta)
{
    const double tilted = part / cos(theta);
    if (!(n > 0))
        return 0;
    return tilted < 1 ? -expm1(n * log1p(-tilted)) : 1;
}

/* Eq. 1 turned: n for alpha, without tilt. */
static double points_of_opacity(double alpha, double part)
{
    return log1p(-fmin(alpha, OPACITY_MOST)) / log1p(-part);
}

static void formulas_turn_back(void **state)
{
    (void)state;
    for (int i = 0; i < 19; i++) {
        const double alpha = 0.05 * i, part = 1e-4, n = points_of_opacity(alpha, part);
        assert_float_equal(opacity_of_points(n, part, 0), alpha, 1e-12);
        assert_float_equal(point_density_of_opacity(alpha, part), n, n * part + 1e-12); /* s / S to 0 */
        assert_float_equal(point_density_of_opacity(alpha, 2e-6), -log(1 - alpha) / 2e-6, 1e-4);
    }
    assert_float_equal(opacity_of_points(100, 0.01, 0), 1 - pow(0.99, 100), 1e-12);
    assert_float_equal(opacity_of_points(100, 0.01, PI / 3), 1 - pow(0.98, 100), 1e-12);
    assert_float_equal(opacity_of_points(0, 0.01, 1), 0, 0);
    assert_float_equal(opacity_of_points(1, 0.5, PI / 3 + 0.01), 1, 0); /* an image of less than a pixel */
    assert_float_equal(point_density_of_opacity(1, 0.01), point_density_of_opacity(OPACITY_MOST, 0.01), 0);
    const float tangent[2] = {0.5F, 0.25F};
    assert_float_equal(pixel_area(tangent, 100, 50, 2), 0.02 * 0.02, 1e-12);
}

/* An eye at z = `away` that looks along -z at a square of side 1 m around the origin. */
static SetSight sight_from(double away, int pixels)
{
    SetSight sight = {.near_plane = 0.01F, .width = pixels, .height = pixels, .scale = 1};
    const float focal = (float)(away * pixels);
    sight.row[0][0] = sight.row[1][1] = focal;
    sight.row[2][2] = -1;
    sight.row[2][3] = (float)away;
    for (int k = 0; k < 4; k++) {
        sight.row[0][k] += 0.5F * (float)pixels * sight.row[2][k];
        sight.row[1][k] += 0.5F * (float)pixels * sight.row[2][k];
    }
    sight.pixel = 1 / (focal * focal);
    return sight;
}

static SetImage image_for(const SetSight *sight)
{
    const size_t pixels = (size_t)sight->width * (size_t)sight->height;
    SetImage image = {.depth = calloc(pixels, 4), .word = calloc(pixels, 4)};
    assert_true(image.depth && image.word);
    return image;
}

static void image_free(SetImage *image)
{
    free(image->depth);
    free(image->word);
}

/* Squares that are triangles, through the origin, turned about x, far beyond the picture's edges. */
static LayerPieces plane_tilted(double theta, double alpha, int squares)
{
    LayerPieces layer = {
        .density = point_density_of_opacity(alpha, 1), .curved = 3, .support = 1}; /* not bent */
    const int side = squares + 1;
    assert_true(layer_reserve(&layer, (size_t)(side * side), (size_t)(2 * squares * squares)));
    for (int i = 0; i < side * side; i++) {
        const int column = i % side, row = i / side;
        const double u = 1.4 * column / squares - 0.7, v = (1.4 * row / squares - 0.7) / cos(theta);
        layer.point[layer.point_count++] =
            (LayerPoint){.at = {(float)u, (float)(v * cos(theta)), (float)(v * sin(theta))},
                         .normal = {0, -(float)sin(theta), (float)cos(theta)},
                         .inside = 1};
        if (column == squares || row == squares)
            continue;
        const uint32_t at = (uint32_t)i, up = (uint32_t)side;
        const uint32_t two[2][3] = {{at, at + 1, at + up}, {at + 1, at + up + 1, at + up}};
        memcpy(layer.triangle + layer.triangle_count, two, sizeof two);
        layer.triangle_count += 2;
    }
    return layer;
}

/* How many of the sets have a point in each pixel. */
static void count_sets(LayerPieces *layer, const SetSight *sight, int sets, uint64_t seed, int *counts)
{
    SetImage image = image_for(sight);
    const int pixels = sight->width * sight->height;
    assert_true(layer_make_shares(layer, sight));
    memset(counts, 0, (size_t)pixels * sizeof *counts);
    for (int set = 0; set < sets; set++) {
        set_image_clear(&image, sight);
        layer_project(layer, seed, (uint64_t)set, sight, &image);
        for (int i = 0; i < pixels; i++)
            counts[i] += image.depth[i] > 0;
    }
    image_free(&image);
}

enum { PIXELS = 32, SETS = 48 };

/* Against 1 - (1 - s / (S cos))^n with the n of the opacity that was asked for; `squares`: triangles larger
   and smaller than pixels; `edges`: of the sight. */
static void compare_opacity(double alpha, double theta, int squares, double edges)
{
    SetSight sight = sight_from(1000, PIXELS);
    const double part = 1e-6, n = points_of_opacity(alpha, part) * (1 + edges * pow(1 - cos(theta), 4)),
                 asked = opacity_of_points(n, part, theta);
    sight.edges = (float)edges;
    set_sight_find_eye(&sight);
    LayerPieces layer = plane_tilted(theta, alpha, squares);
    int counts[PIXELS * PIXELS];
    double sum = 0;
    count_sets(&layer, &sight, SETS, 1, counts);
    for (int i = 0; i < PIXELS * PIXELS; i++)
        sum += counts[i];
    const double drawn = PIXELS * PIXELS * SETS, error = sqrt(asked * (1 - asked) / drawn);
    if (fabs(sum / drawn - asked) > 3 * error)
        fail_msg("alpha %g, tilt %g, edges %g: %g, not %g +- %g", alpha, theta * 180 / PI, edges, sum / drawn,
                 asked, error);
    layer_free(&layer);
}

/* A tilted square at 1 m: within each triangle far points are thinned out. A pixel shows s w / |n x| of
   the plane, with the ray x from the eye, the unit normal n and the depth w. */
static void large_triangles_are_thinned_out(void **state)
{
    (void)state;
    enum { SIDE = 64, EDGE = 4, BLOCK = 14, BLOCKS = (SIDE - 2 * EDGE) / BLOCK };
    const double alpha = 0.3, theta = PI / 6;
    const SetSight sight = sight_from(1, SIDE);
    LayerPieces layer = plane_tilted(theta, alpha, 1);
    static int counts[SIDE * SIDE];
    count_sets(&layer, &sight, SETS, 1, counts);
    for (int block = 0; block < BLOCKS * BLOCKS; block++) {
        double found = 0, asked = 0, square = 0;
        for (int i = 0; i < BLOCK * BLOCK; i++) {
            const int x = EDGE + BLOCK * (block % BLOCKS) + i % BLOCK,
                      y = EDGE + BLOCK * (block / BLOCKS) + i / BLOCK;
            const double up = (y + 0.5) / SIDE - 0.5; /* of the ray (.., up, -1); the normal (0, -sin, cos) */
            const double chance = 1 - pow(1 - alpha, 1 / (cos(theta) + sin(theta) * up));
            asked += SETS * chance;
            square += SETS * chance * (1 - chance);
            found += counts[x + SIDE * y];
        }
        if (fabs(found - asked) > 4 * sqrt(square))
            fail_msg("block %d: %g, not %g +- %g", block, found, asked, sqrt(square));
    }
    layer_free(&layer);
}

static void opacity_is_as_asked(void **state)
{
    (void)state;
    const double alphas[] = {0.05, 0.1, 0.2, 0.4, 0.6, 0.9};
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++)
        for (int tilt = 0; tilt <= 75; tilt += 15)
            compare_opacity(alphas[i], tilt * PI / 180, tilt % 2 ? 3 : 60, 0);
    for (int tilt = 0; tilt <= 75; tilt += 25)
        compare_opacity(0.1, tilt * PI / 180, 20, 4);
}

/* Points without normals have no edges, at no extra cost; a piece that needs more points than available
   is noted. */
static void slices_and_large_pieces(void **state)
{
    (void)state;
    SetSight sight = sight_from(1000, PIXELS);
    LayerPieces layer = plane_tilted(0, 0.4, 3);
    float expected[2];
    for (int edges = 0; edges <= 12; edges += 12) {
        sight.edges = (float)edges;
        set_sight_find_eye(&sight);
        for (size_t i = 0; i < layer.point_count; i++)
            memset(layer.point[i].normal, 0, sizeof layer.point[i].normal);
        assert_true(layer_make_shares(&layer, &sight));
        expected[edges > 0] = layer.share[0].expected;
        int counts[PIXELS * PIXELS];
        double sum = 0, drawn = PIXELS * PIXELS * SETS;
        count_sets(&layer, &sight, SETS, 1, counts);
        for (int i = 0; i < PIXELS * PIXELS; i++)
            sum += counts[i];
        assert_true(fabs(sum / drawn - 0.4) < 3 * sqrt(0.4 * 0.6 / drawn));
    }
    assert_true(expected[0] > 0 && expected[0] == expected[1]);
    assert_float_equal(layer_part(&layer), 1, 0);
    layer_free(&layer);
    sight = sight_from(1000, 4000);
    layer = plane_tilted(0, 0.4, 1); /* 1.4 m: half of 5600 x 5600 pixels a triangle */
    assert_true(layer_make_shares(&layer, &sight));
    const double needed = -log(1 - 0.4) * 5600 * 5600 / 2;
    assert_float_equal(layer_part(&layer), 4e6 / needed, 1e-4);
    layer_free(&layer);
}

/* The standard deviation over pixels of the mean of so many sets. */
static double noise_of(LayerPieces *layer, const SetSight *sight, int sets, uint64_t seed)
{
    const int pixels = sight->width * sight->height;
    int *counts = malloc((size_t)pixels * sizeof *counts);
    double sum = 0, squares = 0;
    count_sets(layer, sight, sets, seed, counts);
    for (int i = 0; i < pixels; i++) {
        sum += counts[i];
        squares += (double)counts[i] * counts[i];
    }
    free(counts);
    return sqrt(squares / pixels - sum / pixels * (sum / pixels)) / sets;
}

static void noise_falls_with_the_root(void **state)
{
    (void)state;
    const SetSight sight = sight_from(1000, 64);
    LayerPieces layer = plane_tilted(0, 0.3, 20);
    for (int sets = 4; sets <= 64; sets *= 4) {
        const double found = noise_of(&layer, &sight, sets, (uint64_t)sets), asked = opacity_noise(0.3, sets);
        assert_true(fabs(found / asked - 1) < 0.1);
    }
    layer_free(&layer);
}

/* ---- three overlapping spheres ---- */

enum { SPHERES = 3, BALL_SETS = 256, BALL_PIXELS = 64, PIECES = 150000 };

static const double RIM_MOST = 0.01; /* of a pixel, where a sphere ends and its mesh does not quite */

typedef struct Ball {
    double at[3], radius, alpha;
} Ball;

static const Ball balls[SPHERES] = {
    {{-0.12, -0.05, 0.05}, 0.26, 0.3}, {{0.13, -0.06, -0.1}, 0.24, 0.5}, {{0.0, 0.14, 0.02}, 0.22, 0.2}};

static const double SUPPORT = 0.23; /* one ball is as bent as counts */

static double bend_of_ball(const Ball *ball, double curved)
{
    return 1 + curved * fmin(SUPPORT / ball->radius, 1);
}

static LayerPieces ball_layer(const Ball *ball, unsigned number, double curved)
{
    enum { ROUND = 160, RINGS = 80 };
    LayerPieces layer = {.density = point_density_of_opacity(ball->alpha, 1),
                         .number = number,
                         .curved = curved,
                         .support = SUPPORT};
    assert_true(layer_reserve(&layer, ROUND * (RINGS + 1), 2 * ROUND * RINGS));
    for (uint32_t i = 0; i < ROUND * (RINGS + 1); i++) {
        const uint32_t ring = i / ROUND;
        const double a = 2 * PI * (i % ROUND) / ROUND, b = PI * ring / RINGS;
        const double n[3] = {sin(b) * cos(a), cos(b), sin(b) * sin(a)};
        LayerPoint *point = &layer.point[layer.point_count++];
        *point = (LayerPoint){.inside = 1};
        for (int k = 0; k < 3; k++) {
            point->at[k] = (float)(ball->at[k] + ball->radius * n[k]);
            point->normal[k] = (float)n[k];
        }
        if (ring == RINGS)
            continue;
        const uint32_t right = i % ROUND == ROUND - 1 ? i + 1 - ROUND : i + 1;
        const uint32_t two[2][3] = {{i, right, i + ROUND}, {right, right + ROUND, i + ROUND}};
        memcpy(layer.triangle + layer.triangle_count, two, sizeof two);
        layer.triangle_count += 2;
    }
    return layer;
}

/* A small piece of a sphere: optical depth of a pixel at the given distance. */
typedef struct Piece {
    int pixel, ball;
    float w, depth;
} Piece;

static int by_pixel_and_w(const void *a, const void *b)
{
    const Piece *one = a, *other = b;
    if (one->pixel != other->pixel)
        return one->pixel - other->pixel;
    return (one->w > other->w) - (one->w < other->w);
}

/* Pieces of equal area, on a spiral: Swinbank and Purser, "Fibonacci grids", 2006. */
static void add_pieces(Piece *pieces, int ball, const SetSight *sight, double curved)
{
    const Ball *b = &balls[ball];
    for (int i = 0; i < PIECES; i++) {
        const double y = 1 - (2 * i + 1.0) / PIECES, r = sqrt(1 - y * y), a = i * PI * (3 - sqrt(5));
        const double at[3] = {b->at[0] + b->radius * r * cos(a), b->at[1] + b->radius * y,
                              b->at[2] + b->radius * r * sin(a)};
        double seen[3];
        for (int k = 0; k < 3; k++) {
            const float *row = sight->row[k];
            seen[k] =
                (double)row[0] * at[0] + (double)row[1] * at[1] + (double)row[2] * at[2] + (double)row[3];
        }
        const double area = 4 * PI * b->radius * b->radius / PIECES, w = seen[2];
        const int pixel = (int)(seen[0] / w) + BALL_PIXELS * (int)(seen[1] / w);
        pieces[i] = (Piece){
            pixel, ball, (float)w,
            (float)(-log(1 - b->alpha) * bend_of_ball(b, curved) * area / ((double)sight->pixel * w * w))};
    }
}

/* The probability of each sphere in a pixel: all pieces in depth order. */
static void composite(const SetSight *sight, double curved, double (*chance)[SPHERES])
{
    Piece *pieces = malloc(SPHERES * PIECES * sizeof *pieces);
    double passed = 1;
    for (int ball = 0; ball < SPHERES; ball++)
        add_pieces(pieces + ball * PIECES, ball, sight, curved);
    qsort(pieces, SPHERES * PIECES, sizeof *pieces, by_pixel_and_w);
    for (int i = 0; i < SPHERES * PIECES; i++) {
        if (i > 0 && pieces[i].pixel != pieces[i - 1].pixel)
            passed = 1;
        chance[pieces[i].pixel][pieces[i].ball] += passed * -expm1(-(double)pieces[i].depth);
        passed *= exp(-(double)pieces[i].depth);
    }
    free(pieces);
}

/* Turned about y, then raised, so that the eye looks down from there. */
static SetSight sight_turned(double turn, double rise, double away)
{
    SetSight sight = sight_from(away, BALL_PIXELS);
    for (int r = 0; r < 3; r++) { /* box to eye: x' = c x + s z, z' = c z - s x */
        float *row = sight.row[r];
        const double x = (double)row[0], y = (double)row[1], z = (double)row[2];
        const double risen = sin(rise) * y + cos(rise) * z;
        row[1] = (float)(cos(rise) * y - sin(rise) * z);
        row[0] = (float)(cos(turn) * x - sin(turn) * risen);
        row[2] = (float)(sin(turn) * x + cos(turn) * risen);
    }
    return sight;
}

/* How often each sphere is what a pixel shows. */
static void count_balls(const SetSight *sight, uint64_t seed, double curved, int (*counts)[SPHERES])
{
    LayerPieces layers[SPHERES];
    SetImage image = image_for(sight);
    for (unsigned k = 0; k < SPHERES; k++) {
        layers[k] = ball_layer(&balls[k], k, curved);
        assert_true(layer_make_shares(&layers[k], sight));
    }
    for (int set = 0; set < BALL_SETS; set++) {
        set_image_clear(&image, sight);
        for (int k = 0; k < SPHERES; k++)
            layer_project(&layers[k], seed, (uint64_t)set, sight, &image);
        for (int i = 0; i < BALL_PIXELS * BALL_PIXELS; i++)
            if (image.depth[i] > 0)
                counts[i][image.word[i] >> 28]++;
    }
    for (int k = 0; k < SPHERES; k++)
        layer_free(&layers[k]);
    image_free(&image);
}

/* How far, in pixels, the outline of the nearest of the spheres' is from a pixel's middle. */
static double from_rim(const SetSight *sight, int x, int y)
{
    double nearest = HUGE_VAL;
    for (int ball = 0; ball < SPHERES; ball++) {
        double seen[3];
        for (int r = 0; r < 3; r++) {
            seen[r] = (double)sight->row[r][3];
            for (int k = 0; k < 3; k++)
                seen[r] += (double)sight->row[r][k] * balls[ball].at[k];
        }
        const double radius = balls[ball].radius / sqrt((double)sight->pixel) / seen[2],
                     away = hypot(x + 0.5 - seen[0] / seen[2], y + 0.5 - seen[1] / seen[2]);
        nearest = fmin(nearest, fabs(away - radius));
    }
    return nearest;
}

/* Each pixel within four sigma of the binomial, the mean of each 16 x 16 block within 1 %. Returns the
   number of outliers in pixels without an outline. */
static int compare_balls(double turn, double rise, double curved)
{
    int beyond = 0;
    const SetSight sight = sight_turned(turn, rise, 2);
    int(*counts)[SPHERES] = calloc(BALL_PIXELS * BALL_PIXELS, sizeof *counts);
    double blocks[16][SPHERES] = {{0}};
    double(*chances)[SPHERES] = calloc(BALL_PIXELS * BALL_PIXELS, sizeof *chances);
    composite(&sight, curved, chances);
    count_balls(&sight, 7, curved, counts);
    for (int i = 0; i < BALL_PIXELS * BALL_PIXELS; i++) {
        const int x = i % BALL_PIXELS, y = i / BALL_PIXELS;
        const double *chance = chances[i];
        for (int k = 0; k < SPHERES; k++) {
            const double found = (double)counts[i][k] / BALL_SETS,
                         least = from_rim(&sight, x, y) > 1.5 ? 0 : RIM_MOST,
                         open = chance[k] < 0.5 ? chance[k] + least : chance[k] - least,
                         sigma = sqrt(open * (1 - open) / BALL_SETS);
            beyond += least == 0 && fabs(found - chance[k]) > 4 * sigma;
            if (fabs(found - chance[k]) > (least > 0 ? 4 : 5) * sigma + least)
                fail_msg("turn %g, rise %g, pixel %d %d, sphere %d: %g, not %g +- %g", turn, rise, x, y, k,
                         found, chance[k], sigma);
            blocks[x / 16 + 4 * (y / 16)][k] += (found - chance[k]) / 256;
        }
    }
    for (int i = 0; i < 16 * SPHERES; i++)
        assert_true(fabs(blocks[i / SPHERES][i % SPHERES]) < 0.01);
    free(counts);
    free(chances);
    return beyond;
}

static void spheres_are_composited(void **state)
{
    (void)state;
    int beyond = 0;
    for (int side = 0; side < 4; side++)
        beyond += compare_balls(side * PI / 2, 0, 0);
    beyond += compare_balls(0, PI / 2, 0) + compare_balls(0, -PI / 2, 0) + compare_balls(1.1, 0.6, 0) +
              compare_balls(1.1, 0.6, 1.5);
    assert_in_range(beyond, 0, 3); /* of 11,000; by chance 0.7 */
}

/* An eye like sight_from, with the same field of view from anywhere. */
static SetSight sight_at(double away)
{
    SetSight sight = sight_from(away, 256);
    const float focal = 1024;
    sight.row[0][0] = sight.row[1][1] = focal;
    sight.pixel = 1 / (focal * focal);
    return sight;
}

/* A look's result does not depend on earlier looks; for looks in direct sequence a repetition is needed. */
static void looks_do_not_depend_on_others(void **state)
{
    (void)state;
    const PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.05};
    const PbsrDef def = {.repeat = 16, .points = 6e4, .seed = 3};
    const double box[3] = {1, 0, 1}, aways[] = {9, 2, 9};
    RigidLayer fresh = {.sets = 0}, rigid = {.sets = 0};
    for (int moving = 0; moving <= 2; moving += 2) {
        rigid.moving = moving;
        for (int look = 0; look < 3; look++) {
            const SetSight sight = sight_at(aways[look]);
            rigid_layer_free(&fresh);
            assert_true(rigid_layer_update(&fresh, &said, &def, box, 0, &sight));
            assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
            if (moving > 0) {
                assert_true(rigid_layer_is_unfinished(&rigid) == (look != 1)); /* no more sets fit there */
                assert_true(look == 2 || rigid.sets <= moving);
                assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
            }
            assert_false(rigid_layer_is_unfinished(&rigid));
            assert_int_equal(rigid.sets, fresh.sets);
            assert_true(rigid.points.count == fresh.points.count);
            assert_memory_equal(rigid.points.point, fresh.points.point,
                                fresh.points.count * sizeof *fresh.points.point);
        }
        assert_int_equal(fresh.sets, 16);
        rigid_layer_free(&rigid);
    }
    rigid_layer_free(&fresh);
}

/* A sphere around the origin, seen in the middle, with both sides parallel to the picture: the share of
   sets with a point in a pixel, and the tolerance. */
static double middle_of(const RigidLayer *rigid, int sets, double *error)
{
    enum { SIDE = 24 };
    const SetSight sight = sight_at(1); /* as large as all */
    SetImage image = image_for(&sight);
    double sum = 0;
    for (int set = 0; set < sets; set++) {
        set_image_clear(&image, &sight);
        rigid_layer_project(rigid, 1, (uint64_t)set, &image);
        for (int i = 0; i < SIDE * SIDE; i++)
            sum += image.depth[128 - SIDE / 2 + i % SIDE + 256 * (128 - SIDE / 2 + i / SIDE)] > 0;
    }
    image_free(&image);
    *error = 0.5 / sqrt(SIDE * SIDE * sets);
    return sum / (SIDE * SIDE * sets);
}

/* The standard deviation there, over pixels, of the mean of all sets. */
static double noise_of_middle(const RigidLayer *rigid, int side)
{
    enum { MOST = 8 };
    const SetSight sight = sight_at(1);
    SetImage image = image_for(&sight);
    int counts[MOST * MOST] = {0};
    double sum = 0, squares = 0;
    for (int set = 0; set < rigid->sets; set++) {
        set_image_clear(&image, &sight);
        rigid_layer_project(rigid, 1, (uint64_t)set, &image);
        for (int i = 0; i < side * side; i++)
            counts[i] += image.depth[128 - side / 2 + i % side + 256 * (128 - side / 2 + i / side)] > 0;
    }
    image_free(&image);
    for (int i = 0; i < side * side; i++) {
        sum += (double)counts[i] / (side * side);
        squares += (double)counts[i] * counts[i] / (side * side);
    }
    return sqrt(squares - sum * sum) / rigid->sets;
}

/* Consecutive points of a walk are close, but sets are nearly independent, even for a sphere 40 pixels
   wide. */
static void sets_of_walks_are_independent(void **state)
{
    (void)state;
    enum { SEEDS = 4, ACROSS = 8 };
    const PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.3};
    const double box[3] = {1, 0, 1}; /* its middle is the origin */
    const SetSight sight = sight_at(20);
    for (int sets = 4; sets <= 64; sets *= 16) {
        double square = 0;
        for (int seed = 0; seed < SEEDS; seed++) {
            const PbsrDef def = {.repeat = sets, .points = 1.2e7, .seed = seed};
            RigidLayer rigid = {.sets = 0};
            assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
            assert_int_equal(rigid.sets, sets);
            square += pow(noise_of_middle(&rigid, ACROSS), 2) / SEEDS;
            rigid_layer_free(&rigid);
        }
        const double part = sqrt(square) / opacity_noise(1 - 0.7 * 0.7, sets);
        if (fabs(part - 1) > 0.1)
            fail_msg("%d sets: the noise is %g of what it should be", sets, part);
    }
}

/* Persistent points have correct opacity from near and far; with changing looks only nearer eyes cause
   new points. */
static void still_layers_stay(void **state)
{
    (void)state;
    PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.3, .axis = {0, 0, 1}};
    const PbsrDef def = {.repeat = 16, .points = 1.2e7, .seed = 3};
    const double box[3] = {1, 0, 1};        /* its middle is the origin */
    const double aways[] = {5, 8, 4.85, 3}; /* 4.85: by the reserve */
    RigidLayer rigid = {.moving = 16};
    size_t count = 0;
    for (int look = 0; look < 4; look++) {
        const SetSight sight = sight_at(aways[look]);
        double off;
        said.angle_deg = 40 * (look + 1); /* a ball, as seen from anywhere */
        if (!rigid_layer_update(&rigid, &said, &def, box, 0, &sight))
            fail_msg("%s", rigid.trouble.message);
        assert_float_equal(rigid_layer_fraction(&rigid), 1, 0);
        const double asked = 1 - 0.7 * 0.7, found = middle_of(&rigid, rigid.sets, &off);
        if (fabs(found - asked) > 4 * off)
            fail_msg("from %g m: %g, not %g +- %g", aways[look], found, asked, off);
        if (look == 0)
            count = rigid.points.count;
        else if (look < 3)
            assert_true(rigid.points.count == count);
        else
            assert_true(rigid.points.count > count);
    }
    assert_int_equal(rigid.sets, 16);
    rigid_layer_free(&rigid);
}

/* Two equal layers have the opacity of two, not of a single layer. */
static void equal_layers_are_two(void **state)
{
    (void)state;
    enum { SIDE = 24 };
    const PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.3};
    const PbsrDef def = {.repeat = 16, .points = 1.2e7, .seed = 3};
    const double box[3] = {1, 0, 1}, asked = 1 - pow(0.7, 4); /* of each, two sides */
    const SetSight sight = sight_at(5);
    RigidLayer rigid[2] = {{.sets = 0}};
    SetImage image = image_for(&sight);
    double sum = 0;
    for (unsigned k = 0; k < 2; k++)
        assert_true(rigid_layer_update(&rigid[k], &said, &def, box, k, &sight));
    for (uint64_t set = 0; set < 16; set++) {
        set_image_clear(&image, &sight);
        for (int k = 0; k < 2; k++)
            rigid_layer_project(&rigid[k], 1, set, &image);
        for (int i = 0; i < SIDE * SIDE; i++)
            sum += image.depth[128 - SIDE / 2 + i % SIDE + 256 * (128 - SIDE / 2 + i / SIDE)] > 0;
    }
    const double drawn = SIDE * SIDE * 16, error = sqrt(asked * (1 - asked) / drawn);
    if (fabs(sum / drawn - asked) > 4 * error)
        fail_msg("%g, not %g +- %g", sum / drawn, asked, error);
    image_free(&image);
    for (int k = 0; k < 2; k++)
        rigid_layer_free(&rigid[k]);
}

/* What a pixel is to have of a sphere of radius 0.4 m, seen from 5 m, and the cosine there. */
static double edge_opacity(const PbsrLayer *said, double edges, int x, int y, double *cosine)
{
    const double u = (x + 0.5 - 128) / 1024, v = (y + 0.5 - 128) / 1024, square = u * u + v * v;
    const double by = 5 * sqrt(square / (1 + square)) / said->level; /* the ray passes the middle, radii */
    *cosine = by < 1 ? sqrt(1 - by * by) : 0;
    const double more = 1 + edges * pow(1 - *cosine, 4);
    return by < 1 ? 1 - pow(1 - said->opacity, 2 * more / *cosine) : 0;
}

/* At grazing angles a sphere has the opacity of `edges`, elsewhere the plain opacity. Points of a walk
   are close together: over seeds rings vary 2.5 times as much as by chance, with a correct mean. */
static void edges_are_denser(void **state)
{
    (void)state;
    PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.1, .axis = {0, 0, 1}};
    const PbsrDef def = {.repeat = 16, .points = 1.2e7, .seed = 3};
    const double box[3] = {1, 0, 1}, from[] = {0.97, 0.5, 0.25}, to[] = {1, 0.6, 0.35};
    SetSight sight = sight_at(5);
    for (int way = 0; way < 4; way++) {
        RigidLayer rigid = {.sets = 0};
        SetImage image = image_for(&sight);
        double found[3] = {0}, asked[3] = {0}, pixels[3] = {0}, cosine;
        sight.edges = way % 2 ? 4 : 0;
        said.sampler = way < 2 ? PBSR_SAMPLER_TRIANGLES : PBSR_SAMPLER_WALK;
        const double chance = way < 2 ? 4 : 4 * 2.5;
        assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
        for (int set = 0; set < rigid.sets; set++) {
            set_image_clear(&image, &sight);
            rigid_layer_project(&rigid, 1, (uint64_t)set, &image);
            for (int i = 0; i < 256 * 256; i++) {
                const double opacity = edge_opacity(&said, (double)sight.edges, i % 256, i / 256, &cosine);
                for (int k = 0; k < 3; k++)
                    if (cosine > from[k] && cosine < to[k]) {
                        pixels[k]++;
                        asked[k] += opacity;
                        found[k] += image.depth[i] > 0;
                    }
            }
        }
        for (int k = 0; k < 3; k++) {
            const double mean = asked[k] / pixels[k], off = sqrt(mean * (1 - mean) / pixels[k]);
            if (fabs(found[k] / pixels[k] - mean) > chance * off)
                fail_msg("edges %g, cosine %g to %g: %g, not %g +- %g", (double)sight.edges, from[k], to[k],
                         found[k] / pixels[k], mean, off);
        }
        image_free(&image);
        rigid_layer_free(&rigid);
    }
}

/* An impossible layer is tried once; a layer too dense for the memory is made once and noted. */
static void still_layers_that_fall_short(void **state)
{
    (void)state;
    const PbsrLayer none = {.of = PBSR_WAVE, .level = 100, .opacity = 0.3};
    const PbsrDef def = {.repeat = 2, .points = 1.2e7, .seed = 3};
    const double box[3] = {1, 1, 1};
    const SetSight sight = sight_at(5);
    RigidLayer rigid = {.sets = 0};
    for (int look = 0; look < 3; look++) {
        assert_false(rigid_layer_update(&rigid, &none, &def, box, 0, &sight));
        assert_true(rigid.trouble.message[0] && rigid.made == 1 && rigid.sets == 0);
    }
    rigid_layer_free(&rigid);
    const PbsrLayer said = {.of = PBSR_SPHERE, .level = 0.4, .opacity = 0.3};
    assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
    const uint64_t made = rigid.made;
    rigid.density = 0.5 * rigid.needed; /* as where memory ends */
    assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
    assert_true(rigid.made == made);
    assert_float_equal(rigid_layer_fraction(&rigid), 0.5, 1e-12);
    char words[400];
    PbsrDef shown = {.repeat = 2, .layer_count = 1, .layers = {said}};
    const FluidLayers none_of_fluid = {.count = 1};
    const FluidWalk no_walk = {.walks = false};
    const DrawnLayers drawn = {
        .def = &shown, .layers = &none_of_fluid, .walks = &no_walk, .rigid = &rigid, .sets = 2};
    assert_true(layers_describe_missing(&drawn, words, sizeof words) == strlen(words));
    assert_string_equal(words, "layer 1, sphere 0.4 m, is 0.16 opaque where it is nearest, not 0.3");
    const double needed = rigid.needed;
    rigid.density = needed;
    FluidLayers too_large = none_of_fluid;
    DrawnLayers other = drawn;
    too_large.layers[0].beyond = 2;
    other.layers = &too_large;
    strcpy(rigid.note, "the sampler's words");
    assert_true(layers_describe_missing(&other, words, sizeof words) > 0);
    assert_string_equal(
        words,
        "layer 1, sphere 0.4 m, is 0.16 opaque where it is nearest, not 0.3; layer 1, sphere 0.4 m: the sampler's words");
    rigid.note[0] = '\0';
    PbsrLayer *idle = &shown.layers[0];
    rigid.density = rigid.needed;
    idle->angle_deg = 30;
    assert_true(layers_describe_missing(&drawn, words, sizeof words) > 0);
    assert_string_equal(words, "layer 1 is not turned: its axis is [0, 0, 0]");
    idle->axis[1] = 1;
    assert_true(layers_describe_missing(&drawn, words, sizeof words) == 0);
    idle->of = PBSR_SOLIDS;
    idle->opacity = 0;
    idle->interpolation = PBSR_BY_GRID + VOLUME_CATMULL_ROM;
    idle->sampler = PBSR_SAMPLER_WALK;
    shown.curved = 1;
    assert_true(layers_describe_missing(&drawn, words, sizeof words) > 0);
    assert_string_equal(
        words, "position, angle and motion of layer 1 have no effect: it stays where it is in the box; "
               "sampler of layer 1 has no effect: its points fall on it at random; "
               "curved has no effect on layer 1: it is no surface of the fluid by triangles; "
               "interpolation of layer 1 has no effect: it is of no file, and no walk on the "
               "fluid's surface");
    idle->of = PBSR_SURFACE;
    idle->sampler = PBSR_SAMPLER_AUTO;
    assert_true(layers_describe_missing(&drawn, words, sizeof words) > 0);
    assert_non_null(
        strstr(words, "interpolation of layer 1 has no effect: it is no walk on the fluid's surface; set "
                      "sampler: walk"));
    layer_text(&(PbsrLayer){.of = PBSR_SURFACE, .level = 120, .file = "a.b/head.yaml"}, words);
    assert_string_equal(words, "surface 120 of head");
    layer_text(&(PbsrLayer){.of = PBSR_SLICE_X, .level = 0.1, .angle_deg = 30, .file = "none"}, words);
    assert_string_equal(words, "slice_x at 0.1 m, moved");
    layer_text(&(PbsrLayer){.of = PBSR_SLICE_X, .level = 0.1, .file = "head"}, words);
    assert_string_equal(words, "slice_x 0.1 m of head");
    rigid_layer_free(&rigid);
}

/* More surface than the bounds have faces: sets are as many as fit, each as dense as asked for. */
static void points_that_are_kept_have_a_limit(void **state)
{
    (void)state;
    const PbsrLayer said = {.of = PBSR_GYROID, .level = 0.2, .opacity = 0.3};
    const double box[3] = {1, 1, 1};
    const SetSight sight = sight_at(26);
    int before = 0;
    for (int limit = 100000; limit < 300000; limit *= 2) {
        const double points = limit;
        const PbsrDef def = {.repeat = 64, .points = points, .seed = 3};
        RigidLayer rigid = {.sets = 0};
        assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
        if ((double)rigid.points.count > points || (double)rigid.points.count < 0.7 * points)
            fail_msg("%zu points of %g", rigid.points.count, points);
        assert_float_equal(rigid_layer_fraction(&rigid), 1, 0);
        assert_true(rigid.sets > 1.5 * before && rigid.sets < 64);
        before = rigid.sets;
        rigid_layer_free(&rigid);
    }
}

/* A fluid in x < 0.2 of a box about the origin, whose colour grows along x + 2 y. */
enum { GRID = 32 };

static void make_fluid(FluidLayers *layers)
{
    FluidField *fluid = &layers->fluid;
    fluid->grid = (VolumeGrid){{GRID, GRID, GRID}, {-1, -1, -1}, 2.0 / GRID};
    fluid->field = calloc(GRID * GRID * GRID, sizeof *fluid->field);
    fluid->mean[0] = calloc(GRID * GRID * GRID, sizeof *fluid->field);
    assert_true(fluid->field && fluid->mean[0]);
    layers->color = fluid->mean[0];
    for (int k = 0; k < 3; k++)
        fluid->side[k] = 2.0 / GRID;
    for (int i = 0; i < GRID * GRID * GRID; i++) {
        const int index[3] = {i % GRID, i / GRID % GRID, i / GRID / GRID};
        double place[3];
        for (int k = 0; k < 3; k++)
            place[k] = fluid->grid.corner[k] + (index[k] + 0.5) * fluid->side[k];
        fluid->field[i] = place[0] < 0.2 ? 1 : 0;
        fluid->mean[0][i] = (float)(place[0] + 2 * place[1]);
    }
}

/* At the fluid for every motion and turn of the layer; empty beyond the fluid, and with the layer's own
   colour. */
static void formulas_have_the_fluids_colors(void **state)
{
    (void)state;
    FluidLayers fluid = {.count = 0};
    RigidLayer rigid = {.sets = 0};
    PbsrLayer said = {.of = PBSR_TORUS, .level = 0.2, .opacity = 0.6, .axis = {0, 1, 2}, .angle_deg = 50};
    const PbsrDef def = {.repeat = 4, .points = 1e7, .seed = 3};
    const double box[3] = {1, 0, 1};
    SetSight sight = sight_at(5);
    sight.low = -2;
    sight.scale = 0.25F;
    make_fluid(&fluid);
    said.position[0] = 0.15;
    assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
    rigid_layer_set_colors(&rigid, &said, &fluid);
    const SetImage image = image_for(&sight);
    rigid_layer_project(&rigid, 1, 0, &image);
    int inside = 0, outside = 0;
    for (int i = 0; i < sight.width * sight.height; i++) {
        float share;
        memcpy(&share, &image.depth[i], sizeof share);
        if (!image.depth[i])
            continue;
        const float w = sight.near_plane / share;
        double place[2];
        for (int k = 0; k < 2; k++) /* x w = focal x + half of the part w */
            place[k] = (double)(((float)(k ? i / sight.width : i % sight.width) + 0.5F -
                                 0.5F * (float)(k ? sight.height : sight.width)) *
                                w / sight.row[k][k]);
        const int value = (int)(image.word[i] >> 20 & 255);
        if (fabs(place[0] - 0.2) < 0.05)
            continue;
        const double expected = 254 * 0.25 * (place[0] + 2 * place[1] + 2);
        if ((place[0] < 0.2 ? fabs(value - expected) > 2 : value != 255) ||
            image.word[i] >> 28 != (place[0] < 0.2 ? 0 : OUTSIDE_NUMBER))
            fail_msg("at %g, %g m: %d, not %g", place[0], place[1], value, expected);
        inside += place[0] < 0.2;
        outside += place[0] > 0.2;
    }
    assert_true(inside > 30 && outside > 30);
    said.color[0] = 1;
    rigid_layer_set_colors(&rigid, &said, &fluid);
    assert_null(rigid.paint);
    free(image.depth);
    free(image.word);
    rigid_layer_free(&rigid);
    fluid_layers_free(&fluid);
}

static void equal_seeds_give_equal_points(void **state)
{
    (void)state;
    const SetSight sight = sight_from(1000, PIXELS);
    LayerPieces layer = plane_tilted(0.5, 0.4, 10);
    int one[PIXELS * PIXELS], same[PIXELS * PIXELS], other[PIXELS * PIXELS];
    count_sets(&layer, &sight, 4, 1, one);
    count_sets(&layer, &sight, 4, 1, same);
    count_sets(&layer, &sight, 4, 2, other);
    assert_memory_equal(one, same, sizeof one);
    assert_memory_not_equal(one, other, sizeof one);
    layer_free(&layer);
}

/* A cloud of even density, a metre deep, has the opacity of the depth. */
static void cells_are_even(void **state)
{
    (void)state;
    enum { SIDE = 24 };
    const SetSight sight = sight_from(1000, PIXELS);
    LayerPieces layer = {.density = point_density_of_opacity(0.4, 1), .cell = {1.0 / 12, 1.0 / 12, 1.0 / 12}};
    int counts[PIXELS * PIXELS];
    double sum = 0;
    assert_true(layer_reserve(&layer, SIDE * SIDE * 12, 0));
    for (int i = 0; i < SIDE * SIDE * 12; i++) {
        const int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        LayerPoint *point = &layer.point[layer.point_count++];
        *point = (LayerPoint){.inside = 1};
        for (int k = 0; k < 3; k++)
            point->at[k] = (float)((at[k] + 0.5) / 12 - (k < 2 ? 1 : 0.5));
    }
    count_sets(&layer, &sight, SETS, 3, counts);
    for (int i = 0; i < PIXELS * PIXELS; i++)
        sum += counts[i];
    const double drawn = PIXELS * PIXELS * SETS, error = sqrt(0.4 * 0.6 / drawn);
    assert_true(fabs(sum / drawn - 0.4) < 3 * error);
    layer_free(&layer);
}

/* Cells behind the eye and beside the picture cost no points, and visible cells keep the number of
   points. */
static void cells_out_of_sight_cost_nothing(void **state)
{
    (void)state;
    enum { SIDE = 21 };
    const SetSight sight = sight_from(0.2, PIXELS); /* inside */
    SetImage image = image_for(&sight);
    LayerPieces layer = {.density = 1, .cell = {0.1, 0.1, 0.1}};
    size_t projected[2] = {0};
    int drawn[2] = {0};
    for (int part = 0; part < 2; part++) { /* all, then those of the picture and a margin before the eye */
        assert_true(layer_reserve(&layer, SIDE * SIDE * SIDE, 0));
        for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
            const double at[3] = {0.1 * (i % SIDE - 10), 0.1 * (i / SIDE % SIDE - 10),
                                  0.1 * (i / SIDE / SIDE - 10)};
            const double w = 0.2 - at[2], most = 0.5 * fmax(w + 0.1, 0) / 0.2 + 0.101;
            if (part == 0 || (w > -0.1 && fabs(at[0]) < most && fabs(at[1]) < most))
                layer.point[layer.point_count++] =
                    (LayerPoint){.at = {(float)at[0], (float)at[1], (float)at[2]}, .inside = 1};
        }
        assert_true(layer_make_shares(&layer, &sight));
        for (uint64_t set = 0; set < 16; set++) {
            set_image_clear(&image, &sight);
            projected[part] += layer_project(&layer, 1, set, &sight, &image);
            for (int i = 0; i < PIXELS * PIXELS; i++)
                drawn[part] += image.depth[i] > 0;
        }
    }
    assert_true(drawn[0] > 1000 && drawn[0] == drawn[1]); /* not a random number more */
    assert_true(projected[0] == projected[1]);
    assert_true(projected[0] < 45000); /* 41,503 */
    layer_free(&layer);
    image_free(&image);
}

/* Non-finite points, points behind the eye and missing points leave no mark. */
static void nothing_is_drawn_of_nothing(void **state)
{
    (void)state;
    const SetSight sight = sight_from(2, PIXELS);
    SetImage image = image_for(&sight);
    const LayerPoint points[] = {{.at = {NAN, 0, 0}, .inside = 1},  {.at = {0, 0, NAN}, .inside = 1},
                                 {.at = {0, 0, 2.5F}, .inside = 1}, {.at = {0, 0, 0}, .inside = -1},
                                 {.at = {0, 0, 0}, .inside = NAN},  {.at = {INFINITY, 0, 0}, .inside = 1},
                                 {.at = {0.6F, 0, 0}, .inside = 1}};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        set_image_add(&image, &sight, &points[i], 0);
    for (int i = 0; i < PIXELS * PIXELS; i++)
        assert_int_equal(image.depth[i], 0);
    image_free(&image);
}

/* The order of points is of no account, not even where two are as deep as each other. */
static void the_nearest_stays(void **state)
{
    (void)state;
    const SetSight sight = sight_from(2, 1);
    const LayerPoint points[] = {{.at = {0.01F, 0, 0.3F}, .normal = {1, 0, 0}, .value = 0.2F, .inside = 1},
                                 {.at = {-0.01F, 0, 0.3F}, .normal = {0, 1, 0}, .value = 0.7F, .inside = 1},
                                 {.at = {0, 0, 0.1F}, .value = 0.9F, .inside = 1}};
    SetImage one = image_for(&sight), other = image_for(&sight);
    for (int i = 0; i < 3; i++) {
        set_image_add(&one, &sight, &points[i], (unsigned)i);
        set_image_add(&other, &sight, &points[2 - i], (unsigned)(2 - i));
    }
    assert_int_equal(one.depth[0], other.depth[0]);
    assert_int_equal(one.word[0], other.word[0]);
    assert_int_equal(one.word[0] >> 28, 1);
    image_free(&one);
    image_free(&other);
}

/* A cloud of constant value, as deep as wide; turning or moving remakes no piece. */
static void clouds_of_data_are_as_opaque_as_said(void **state)
{
    (void)state;
    enum { SIDE = 12 };
    static float value[SIDE * SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE * SIDE; i++)
        value[i] = 3;
    RangedVolume data = {.low = 0, .high = 3, .volume = {.size = {SIDE, SIDE, SIDE}, .value = value}};
    for (int k = 0; k < 3; k++) {
        data.volume.spacing[k] = 0.5 / (SIDE - 1);
        data.volume.corner[k] = -0.25;
    }
    PbsrLayer said = {.of = PBSR_VOLUME, .opacity = 0.4, .file = "a file", .data = &data, .axis = {0, 1, 0}};
    const PbsrDef def = {.repeat = 16, .points = 1.2e7, .seed = 3};
    const double box[3] = {1, 0, 1};
    const SetSight sight = sight_at(5);
    RigidLayer rigid = {.sets = 0};
    for (int turn = 0; turn <= 90; turn += 90) {
        double off, found;
        said.angle_deg = turn;
        said.position[0] = turn > 0 ? 0.05 : 0;
        if (!rigid_layer_update(&rigid, &said, &def, box, 0, &sight))
            fail_msg("%s", rigid.trouble.message);
        const LayerPoint *pieces = rigid.pieces.point;
        found = middle_of(&rigid, 16, &off);
        if (fabs(found - said.opacity) > 4 * off)
            fail_msg("turned by %d: %g, not %g +- %g", turn, found, said.opacity, off);
        assert_true(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
        assert_ptr_equal(pieces, rigid.pieces.point);
    }
    said.level = 3;
    assert_false(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
    assert_string_equal(rigid.trouble.message, "no value is above the level 3: they are 0 to 3");
    said.of = PBSR_SLICE_X;
    assert_false(rigid_layer_update(&rigid, &said, &def, box, 0, &sight));
    assert_non_null(strstr(rigid.trouble.message, "is beside the data"));
    rigid_layer_free(&rigid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formulas_turn_back),
        cmocka_unit_test(opacity_is_as_asked),
        cmocka_unit_test(large_triangles_are_thinned_out),
        cmocka_unit_test(slices_and_large_pieces),
        cmocka_unit_test(noise_falls_with_the_root),
        cmocka_unit_test(spheres_are_composited),
        cmocka_unit_test(still_layers_stay),
        cmocka_unit_test(equal_layers_are_two),
        cmocka_unit_test(looks_do_not_depend_on_others),
        cmocka_unit_test(formulas_have_the_fluids_colors),
        cmocka_unit_test(sets_of_walks_are_independent),
        cmocka_unit_test(clouds_of_data_are_as_opaque_as_said),
        cmocka_unit_test(edges_are_denser),
        cmocka_unit_test(still_layers_that_fall_short),
        cmocka_unit_test(points_that_are_kept_have_a_limit),
        cmocka_unit_test(equal_seeds_give_equal_points),
        cmocka_unit_test(cells_are_even),
        cmocka_unit_test(cells_out_of_sight_cost_nothing),
        cmocka_unit_test(nothing_is_drawn_of_nothing),
        cmocka_unit_test(the_nearest_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
