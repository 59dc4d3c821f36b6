/* The clear fluids of the view splat, against optics: the thickness on a ray, Snell's law, Beer and
 * Lambert's, Fresnel's. */
#include "tests/render/sky.h"
#include "tests/splat/splat_fixture.h"

/* A ball of fluid on a lattice. Returns its radius by its volume, m. */
static double add_ball(SplatScene *scene, const double centre[3], double radius, double spacing)
{
    const int n = (int)(radius / spacing) + 2;
    for (int i = 0; i < (2 * n + 1) * (2 * n + 1) * (2 * n + 1); i++) {
        const int cell[3] = {i % (2 * n + 1) - n, i / (2 * n + 1) % (2 * n + 1) - n,
                             i / (2 * n + 1) / (2 * n + 1) - n};
        const double at[3] = {(cell[0] + 0.31) * spacing, (cell[1] + 0.17) * spacing,
                              (cell[2] + 0.43) * spacing};
        if (dot3(at, at) < radius * radius)
            particles_add(scene->particles, centre[0] + at[0], centre[1] + at[1], centre[2] + at[2], 1, 0);
    }
    return cbrt(3 * (double)scene->particles->count / (4 * M_PI)) * spacing;
}

/* Eye to the front, the ball in the middle; spheres of the view as wide as a spacing. */
static const double RADIUS = 0.3; /* m */

static SplatScene ball_scene(double spacing, double *radius)
{
    SplatScene scene = splat_scene((double[]){0.1, 0.6, 3}, (double[]){0, 0.5, 0}, 20, spacing);
    splat_def(&scene.def)->shading = SPLAT_WATER;
    const double by_volume = add_ball(&scene, (double[]){0, 0.5, 0}, RADIUS, spacing);
    if (radius)
        *radius = by_volume;
    return scene;
}

typedef struct Map {
    int width, height;
    float *texel;
} Map;

static Map read_thickness(const SplatDrawing *drawing)
{
    Map map;
    const unsigned texture = splat_thickness_map(drawing->view);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &map.width);
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_HEIGHT, &map.height);
    map.texel = read_map(texture, GL_RED, map.width * map.height, 1);
    return map;
}

/* The view ray through a place of the picture, 0 .. 1, with depth 1. */
static void ray_at(const SplatScene *scene, double x, double y, double ray[3])
{
    ray[0] = (2 * x - 1) * scene->frame.camera.tangent[0];
    ray[1] = (2 * y - 1) * scene->frame.camera.tangent[1];
    ray[2] = -1;
}

static void in_eye(const SplatScene *scene, const double place[3], double out[3])
{
    float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    matrix_transform(scene->frame.camera.view, at, at);
    for (int k = 0; k < 3; k++)
        out[k] = at[k];
}

/* How far beside the ball's centre a ray passes, m. */
static double passes_at(const double ray[3], const double centre[3])
{
    const double along = dot3(ray, centre) / dot3(ray, ray);
    const double to[3] = {centre[0] - along * ray[0], centre[1] - along * ray[1], centre[2] - along * ray[2]};
    return sqrt(dot3(to, to));
}

/* By the formula in render/views/splat/splat_private.h, over all particles. */
static double thickness_wanted(const SplatScene *scene, const double ray[3])
{
    const double h = scene->state.support_radius, volume = pow(scene->state.spacing, 3);
    double sum = 0;
    for (size_t i = 0; i < scene->particles->count; i++) {
        const float *at = &scene->particles->position[4 * i];
        double centre[3];
        in_eye(scene, (double[]){at[0], at[1], at[2]}, centre);
        const double beside = passes_at(ray, centre) / h;
        sum += beside < 1 ? 4.5 * volume / (M_PI * h * h) * pow(1 - beside * beside, 3.5) : 0;
    }
    return sum;
}

enum { RINGS = 12 };

typedef struct Ring {
    double thickness, chord;
    int texels;
} Ring;

/* Texels against the sum by brute force, one of many; sums up all of them in rings around the ball's centre.
 */
static void compare_texels(const SplatScene *scene, const Map *map, double radius, Ring ring[RINGS])
{
    double centre[3];
    in_eye(scene, (double[]){0, 0.5, 0}, centre);
    for (int i = 0; i < map->width * map->height; i++) {
        double ray[3];
        ray_at(scene, (i % map->width + 0.5) / map->width, (i / map->width + 0.5) / map->height, ray);
        const double beside = passes_at(ray, centre) / radius;
        if (i % 61 == 0 && splat_def(&scene->def)->shape == SPLAT_PERSPECTIVE)
            assert_float_equal(map->texel[i], thickness_wanted(scene, ray), 1e-3 * radius);
        if (beside >= 1)
            continue;
        Ring *at = &ring[(int)(RINGS * beside)];
        at->thickness += (double)map->texel[i];
        at->chord += 2 * radius * sqrt(1 - beside * beside);
        at->texels++;
    }
}

/* Within 2 % out to 0.8 of the radius, with every sprite and shape: the mean over rings, since the lattice's
   own rim is rough. Nearer to the rim the field is too smooth for it. */
static void thickness_of_a_ball_is_its_chord(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        double radius;
        Ring ring[RINGS] = {{0}};
        SplatScene scene = ball_scene(RADIUS / 15, &radius);
        splat_def(&scene.def)->sprite = i & 1 ? SPLAT_POINT : SPLAT_QUAD;
        splat_def(&scene.def)->shape = i & 2 ? SPLAT_PAPER : SPLAT_PERSPECTIVE;
        SplatDrawing drawing = splat_open(&scene, NULL, false);
        const Map map = read_thickness(&drawing);
        compare_texels(&scene, &map, radius, ring);
        for (int k = 0; k < 0.8 * RINGS; k++)
            if (ring[k].texels < 3 || fabs(ring[k].thickness - ring[k].chord) > 0.02 * ring[k].chord)
                fail_msg("%s, %s, ring %d: %g m, chord %g m",
                         splat_sprite_names[splat_def(&scene.def)->sprite],
                         splat_shape_names[splat_def(&scene.def)->shape], k,
                         ring[k].thickness / ring[k].texels, ring[k].chord / ring[k].texels);
        free(map.texel);
        splat_close(&drawing);
        free(scene.particles);
    }
}

/* Linear between texels. */
static double thickness_at(const Map *map, double x, double y)
{
    const double u = x * map->width - 0.5, v = y * map->height - 0.5;
    const int i = (int)floor(u), j = (int)floor(v);
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const int column = i + (k & 1) < 0 ? 0 : i + (k & 1) >= map->width ? map->width - 1 : i + (k & 1);
        const int row = j + (k >> 1) < 0 ? 0 : j + (k >> 1) >= map->height ? map->height - 1 : j + (k >> 1);
        sum += fabs(1 - (k & 1) - (u - i)) * fabs(1 - (k >> 1) - (v - j)) *
               (double)map->texel[row * map->width + column];
    }
    return sum;
}

static float solid_depth; /* reversed */

static void lay_solid(const Target *target)
{
    glClearNamedFramebufferfv(target->framebuffer, GL_DEPTH, 0, &solid_depth);
}

/* At the eye's height, in the middle of the picture, a plane at that depth before it. */
static double thickness_before_solid(double depth)
{
    SplatScene scene = ball_scene(RADIUS / 15, NULL);
    memcpy(scene.def.camera.from, (double[]){0, 0.5, 3}, sizeof scene.def.camera.from);
    scene.world.solid_count = 1;
    scene.world.solids[0] = (SolidDef){.radius = 0.1, .centre = {0, -50, 0}};
    SplatDrawing drawing = splat_open(&scene, NULL, false);
    solid_depth = (float)(scene.frame.camera.near_plane / depth);
    splat_close(&drawing);
    drawing = splat_open(&scene, lay_solid, false);
    const Map map = read_thickness(&drawing);
    const double thickness = thickness_at(&map, 0.5, 0.5);
    free(map.texel);
    splat_close(&drawing);
    free(scene.particles);
    return thickness;
}

static void thickness_ends_at_a_solid(void **state)
{
    (void)state;
    assert_float_equal(thickness_before_solid(3), RADIUS, 0.05 * RADIUS);
    assert_float_equal(thickness_before_solid(5), 2 * RADIUS, 0.02 * 2 * RADIUS);
    assert_true(thickness_before_solid(2) == 0);
}

static void a_position_that_is_no_number(void **state)
{
    (void)state;
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        SplatScene scene = ball_scene(RADIUS / 10, NULL);
        splat_def(&scene.def)->sprite = (SplatSprite)sprite;
        particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
        particles_add(scene.particles, 0, INFINITY, NAN, 1, 0);
        particles_add(scene.particles, 1e30, -1e30, 1e30, 1, 0);
        SplatDrawing drawing = splat_open(&scene, NULL, false);
        const Map map = read_thickness(&drawing);
        for (int i = 0; i < map.width * map.height; i++)
            assert_true(map.texel[i] >= 0 && map.texel[i] < 1.1 * 2 * RADIUS);
        free(map.texel);
        splat_close(&drawing);
        free(scene.particles);
    }
}

/* A picture with column and row encoded to half a pixel: red and green. */
enum { SIDE = 240 };
static uint8_t ground_rgba[4 * SIDE * SIDE];

static void lay_coordinates(const Target *target)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        ground_rgba[4 * i] = (uint8_t)(8 + i % SIDE);
        ground_rgba[4 * i + 1] = (uint8_t)(8 + i / SIDE);
        ground_rgba[4 * i + 2] = 128, ground_rgba[4 * i + 3] = 255;
    }
    glTextureSubImage2D(target->color, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, ground_rgba);
}

static uint8_t *read_rgba(const Target *target)
{
    uint8_t *rgba = calloc(4, SIDE * SIDE);
    assert_non_null(rgba);
    glGetTextureImage(target->color, 0, GL_RGBA, GL_UNSIGNED_BYTE, 4 * SIDE * SIDE, rgba);
    return rgba;
}

/* The angles of incidence and refraction in the plane of ray and normal: sin a = n sin b. */
static void bend(const double ray[3], const double normal[3], double ior, double out[3])
{
    double side[3], cosine = -dot3(ray, normal), length;
    for (int k = 0; k < 3; k++)
        side[k] = ray[k] + cosine * normal[k];
    length = sqrt(dot3(side, side));
    const double a = atan2(length, cosine), b = asin(sin(a) / ior);
    for (int k = 0; k < 3; k++)
        out[k] = -cos(b) * normal[k] + (length > 1e-9 ? sin(b) / length * side[k] : 0);
}

/* From the eye's frame; the box's is the world's here. */
static void in_world(const SplatScene *scene, const double at[3], double out[3])
{
    float to_world[16], place[3] = {(float)at[0], (float)at[1], (float)at[2]};
    matrix_invert_rigid(scene->frame.camera.view, to_world);
    matrix_transform(to_world, place, place);
    for (int k = 0; k < 3; k++)
        out[k] = (double)place[k];
}

/* The share of the straight ray leaving beside the walls: all at 2.5 spacings from the walls, none at
   0.75. */
static double leaves_inside(const SplatScene *scene, const double place[3], const double unit[3],
                            double thick)
{
    double end[3], least = 1e9;
    for (int k = 0; k < 3; k++)
        end[k] = place[k] + thick * unit[k];
    in_world(scene, end, end);
    for (int k = 0; k < 3; k++) {
        const double half = scene->state.box_size[k] / 2;
        least = fmin(least, half - fabs(end[k] - (k == 1 ? half : 0)));
    }
    const double share = fmin(fmax((least / scene->state.spacing - 0.75) / 1.75, 0), 1);
    return share * share * (3 - 2 * share);
}

/* How far on it meets a wall. */
static double way_in_box(const SplatScene *scene, const double from[3], const double to[3])
{
    double start[3], next[3], least = 1e9;
    for (int k = 0; k < 3; k++)
        next[k] = from[k] + to[k];
    in_world(scene, from, start);
    in_world(scene, next, next);
    for (int k = 0; k < 3; k++) {
        const double way = next[k] - start[k], size = scene->state.box_size[k], low = k == 1 ? 0 : -size / 2;
        if (fabs(way) > 1e-9)
            least = fmin(least, (low + (way > 0 ? size : 0) - start[k]) / way);
    }
    return fmax(least, 0);
}

/* A pixel's ray through the fluid: bent where it enters and, beside the walls, where it leaves, as through a
 * ball. */
typedef struct Way {
    double thick; /* of fluid on it, m */
    double at[2]; /* where it leaves the box, on the picture, in pixels */
} Way;

static Way way_of(const SplatScene *scene, const SplatPixel *pixel, const Map *map, int x, int y)
{
    Way way = {.thick = thickness_at(map, (x + 0.5) / SIDE, (y + 0.5) / SIDE)};
    double ray[3], unit[3], normal[3], inner[3], outer[3], outward[3], place[3];
    ray_at(scene, (x + 0.5) / SIDE, (y + 0.5) / SIDE, ray);
    const double length = sqrt(dot3(ray, ray)), of_normal = sqrt(dot3(pixel->normal, pixel->normal));
    const double ior = splat_def(&scene->def)->ior;
    for (int k = 0; k < 3; k++)
        unit[k] = ray[k] / length, normal[k] = pixel->normal[k] / of_normal, place[k] = pixel->depth * ray[k];
    bend(unit, normal, ior, inner);
    const double inside = leaves_inside(scene, place, unit, way.thick), into = dot3(inner, normal);
    way.thick *= 1 + inside * (fmin(fmax(into / fmin(dot3(unit, normal), -0.25), 1), 4) - 1);
    for (int k = 0; k < 3; k++)
        place[k] += way.thick * inner[k], outward[k] = 2 * into * inner[k] - normal[k];
    if (inside > 0) {
        bend(inner, outward, 1 / ior, outer);
        for (int k = 0; k < 3; k++)
            outer[k] = inside * outer[k] + (1 - inside) * inner[k];
        const double size = sqrt(dot3(outer, outer));
        for (int k = 0; k < 3; k++)
            outer[k] /= size;
        const double on = inside * way_in_box(scene, place, outer);
        for (int k = 0; k < 3; k++)
            place[k] += on * outer[k];
    }
    double *at = way.at;
    for (int k = 0; k < 2; k++)
        at[k] = SIDE * (0.5 + 0.5 * place[k] / (-place[2] * scene->frame.camera.tangent[k]));
    return way;
}

/* A white fluid absorbs no light: the colour is of the bent ray's end. Returns the mean shift in pixels. */
static double compare_bending(double ior)
{
    double shift = 0;
    int compared = 0;
    SplatScene scene = ball_scene(0.03, NULL);
    scene.width = scene.height = SIDE;
    splat_def(&scene.def)->ior = ior;
    for (int k = 0; k < 3; k++)
        scene.world.fluids[0].color[k] = 1;
    SplatDrawing drawing = splat_open(&scene, lay_coordinates, true);
    SplatPixel *pixels = splat_read(&scene, &drawing);
    const Map map = read_thickness(&drawing);
    uint8_t *rgba = read_rgba(&drawing.target);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE, y = i / SIDE;
        double ray[3];
        ray_at(&scene, (x + 0.5) / SIDE, (y + 0.5) / SIDE, ray);
        if (pixels[i].weight <= 0 ||
            dot3(ray, pixels[i].normal) > -0.05 * sqrt(dot3(pixels[i].normal, pixels[i].normal)))
            continue;
        const Way way = way_of(&scene, &pixels[i], &map, x, y);
        const double *at = way.at;
        if (fmin(at[0], at[1]) < 1 || fmax(at[0], at[1]) > SIDE - 1) /* beside the picture */
            continue;
        compared++;
        shift += hypot(at[0] - x - 0.5, at[1] - y - 0.5);
        for (int k = 0; k < 2; k++)
            if (fabs(rgba[4 * i + k] - 8 - (at[k] - 0.5)) > 1)
                fail_msg("pixel %d %d sees %s %d, by Snell's law %.2f", x, y, k ? "row" : "column",
                         rgba[4 * i + k] - 8, at[k] - 0.5);
    }
    assert_true(compared > 5000);
    free(map.texel);
    free(pixels);
    free(rgba);
    splat_close(&drawing);
    free(scene.particles);
    return shift / compared;
}

static void refraction_bends_by_snell(void **state)
{
    (void)state;
    assert_true(compare_bending(1) < 0.01);
    const double water = compare_bending(1.333), glass = compare_bending(1.6);
    if (!(water > 3 && glass > 1.3 * water))
        fail_msg("mean shift: water %g pixels, glass %g", water, glass);
}

static double linear_of(uint8_t code)
{
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static void lay_grey(const Target *target)
{
    memset(ground_rgba, 230, sizeof ground_rgba);
    glTextureSubImage2D(target->color, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, ground_rgba);
}

/* Through a distance of its attenuation the light becomes the fluid's colour. */
static void absorption_by_beer_and_lambert(void **state)
{
    (void)state;
    static const float colour[3] = {0.2F, 0.5F, 0.9F};
    SplatScene scene = ball_scene(0.03, NULL);
    scene.width = scene.height = SIDE;
    splat_def(&scene.def)->attenuation = 0.4;
    memcpy(scene.world.fluids[0].color, colour, sizeof colour);
    SplatDrawing drawing = splat_open(&scene, lay_grey, true);
    SplatPixel *pixels = splat_read(&scene, &drawing);
    const Map map = read_thickness(&drawing);
    uint8_t *rgba = read_rgba(&drawing.target);
    int compared = 0;
    const double most = gl_renderer_is_software() ? 0.006 : 0.009; /* colours are sums of halves */
    for (int i = 0; i < SIDE * SIDE; i++) {
        double ray[3];
        ray_at(&scene, (i % SIDE + 0.5) / SIDE, (i / SIDE + 0.5) / SIDE, ray);
        if (pixels[i].weight <= 0 ||
            dot3(ray, pixels[i].normal) > -0.05 * sqrt(dot3(pixels[i].normal, pixels[i].normal)))
            continue;
        const Way way = way_of(&scene, &pixels[i], &map, i % SIDE, i / SIDE);
        const double thick = way.thick;
        if (fmin(way.at[0], way.at[1]) < 1 || fmax(way.at[0], way.at[1]) > SIDE - 1) /* beside the picture */
            continue;
        compared++;
        for (int k = 0; k < 3; k++) {
            const double wanted = linear_of(230) * pow(colour[k], thick / 0.4);
            if (fabs(linear_of(rgba[4 * i + k]) - wanted) > most)
                fail_msg("through %g m: component %d is %g, not %g", thick, k, linear_of(rgba[4 * i + k]),
                         wanted);
        }
    }
    assert_true(compared > 5000);
    free(map.texel);
    free(pixels);
    free(rgba);
    splat_close(&drawing);
    free(scene.particles);
}

/* A layer of particles, a spacing thick in view, has the fluid's colour. */
static void absorption_in_two_dimensions(void **state)
{
    (void)state;
    static const float colour[3] = {0.2F, 0.5F, 0.9F};
    const double spacing = 0.05;
    SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 20, spacing);
    scene.width = scene.height = SIDE;
    scene.state.box_size[2] = spacing;
    splat_def(&scene.def)->shading = SPLAT_WATER;
    memcpy(scene.world.fluids[0].color, colour, sizeof colour);
    for (int i = 0; i < 20 * 20; i++)
        particles_add(scene.particles, spacing * (i % 20 - 9.5), spacing * (i / 20 + 0.5), 0, 1, 0);
    SplatDrawing drawing = splat_open(&scene, lay_grey, true);
    uint8_t *rgba = read_rgba(&drawing.target);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(linear_of(rgba[4 * (SIDE / 2 * SIDE + SIDE / 2) + k]) - linear_of(230) * colour[k]) <
                    0.01);
    free(rgba);
    splat_close(&drawing);
    free(scene.particles);
}

/* By the angles of incidence and refraction, Born and Wolf, 1.5.2 (20). */
static double fresnel_at(double cosine, double ior)
{
    const double a = acos(fmin(cosine, 1)), b = asin(sin(a) / ior);
    if (a < 1e-6)
        return pow((ior - 1) / (ior + 1), 2);
    return 0.5 * (pow(sin(a - b) / sin(a + b), 2) + pow(tan(a - b) / tan(a + b), 2));
}

/* The direction in the world that a ray is mirrored to. Returns false next to the sun. */
static bool mirrored_to(const SplatScene *scene, const double ray[3], const double normal[3], double world[3])
{
    const float *view = scene->frame.camera.view, *light = scene->frame.light.to;
    double mirror[3], sun = 0;
    for (int k = 0; k < 3; k++)
        mirror[k] = ray[k] - 2 * dot3(ray, normal) * normal[k];
    for (int k = 0; k < 3; k++) {
        world[k] = 0;
        for (int row = 0; row < 3; row++)
            world[k] += view[4 * k + row] * mirror[row];
        sun += world[k] * light[k];
    }
    return sun <= 0.8;
}

/* A black fluid emits no light: only reflections are visible. */
static void reflection_by_fresnel(void **state)
{
    (void)state;
    SplatScene scene = ball_scene(0.03, NULL);
    scene.width = scene.height = SIDE;
    splat_def(&scene.def)->attenuation = 1e-3;
    memset(scene.world.fluids[0].color, 0, sizeof scene.world.fluids[0].color);
    SplatDrawing drawing = splat_open(&scene, lay_grey, false);
    SplatPixel *pixels = splat_read(&scene, &drawing);
    const Map map = read_thickness(&drawing);
    uint8_t *rgba = read_rgba(&drawing.target);
    int compared = 0;
    double greatest = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (i % SIDE + 0.5) / SIDE, y = (i / SIDE + 0.5) / SIDE;
        double ray[3], normal[3];
        if (pixels[i].weight <= 0 || thickness_at(&map, x, y) < 0.05)
            continue;
        ray_at(&scene, x, y, ray);
        const double length = sqrt(dot3(ray, ray)),
                     of_normal = sqrt(dot3(pixels[i].normal, pixels[i].normal));
        for (int k = 0; k < 3; k++)
            ray[k] /= length, normal[k] = pixels[i].normal[k] / of_normal;
        const double cosine = -dot3(ray, normal);
        double mirror[3];
        if (!mirrored_to(&scene, ray, normal, mirror) || cosine < 0.02)
            continue;
        const double share = fresnel_at(cosine, 1.333);
        greatest = fmax(greatest, share);
        compared++;
        for (int k = 0; k < 3; k++) {
            const double wanted = share * sky_light(&scene.def, mirror, k), seen = linear_of(rgba[4 * i + k]);
            if (fabs(seen - wanted) > 0.003 + 0.01 * wanted)
                fail_msg("cosine %g: component %d is %g, not %g", cosine, k, seen, wanted);
        }
    }
    if (compared < 3000 || greatest < 0.15)
        fail_msg("%d pixels, mirrored shares up to %g", compared, greatest);
    free(map.texel);
    free(pixels);
    free(rgba);
    splat_close(&drawing);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(thickness_of_a_ball_is_its_chord, no_gl_errors),
        cmocka_unit_test_teardown(thickness_ends_at_a_solid, no_gl_errors),
        cmocka_unit_test_teardown(a_position_that_is_no_number, no_gl_errors),
        cmocka_unit_test_teardown(refraction_bends_by_snell, no_gl_errors),
        cmocka_unit_test_teardown(reflection_by_fresnel, no_gl_errors),
        cmocka_unit_test_teardown(absorption_by_beer_and_lambert, no_gl_errors),
        cmocka_unit_test_teardown(absorption_in_two_dimensions, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
