/* Drops of a clear fluid on their own in the view splat, against optics: a ball of fluid is a lens. */
#include "tests/splat/splat_fixture.h"

enum { SIDE = 240 };
static const double CENTRE[3] = {0.1, 0.5, 0.1}, ATTENUATION = 0.1; /* m */

/* A particle; `spacing` gives the drop. */
static SplatScene drop_scene(double spacing)
{
    SplatScene scene = splat_scene((double[]){0, 0.6, 2.2}, (double[]){0, 0.5, 0}, 20, spacing);
    scene.width = scene.height = SIDE;
    splat_def(&scene.def)->shading = SPLAT_WATER, splat_def(&scene.def)->attenuation = ATTENUATION;
    splat_def(&scene.def)->shape = SPLAT_SHAPE_AUTO, splat_def(&scene.def)->filter = SPLAT_FILTER_AUTO;
    splat_def(&scene.def)->drops = true;
    particles_add(scene.particles, CENTRE[0], CENTRE[1], CENTRE[2], 1, 0);
    return scene;
}

static double radius_of(double spacing)
{
    return spacing * cbrt(3 / (4 * M_PI));
}

static void in_eye(const SplatScene *scene, const double place[3], double out[3])
{
    float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    matrix_transform(scene->frame.camera.view, at, at);
    for (int k = 0; k < 3; k++)
        out[k] = at[k];
}

/* What a ray, which goes through the pixel, meets of the drop. */
typedef struct Meeting {
    double ray[3], place[3], normal[3];
    double beside; /* of the ray from the centre, in radii */
} Meeting;

static Meeting meeting_of(const SplatScene *scene, double radius, int x, int y)
{
    Meeting meeting;
    double centre[3], length2 = 0, along, beside2 = 0;
    in_eye(scene, CENTRE, centre);
    const double way[3] = {(2 * (x + 0.5) / SIDE - 1) * scene->frame.camera.tangent[0],
                           (2 * (y + 0.5) / SIDE - 1) * scene->frame.camera.tangent[1], -1};
    length2 = dot3(way, way);
    for (int k = 0; k < 3; k++)
        meeting.ray[k] = way[k] / sqrt(length2);
    along = dot3(meeting.ray, centre);
    for (int k = 0; k < 3; k++)
        beside2 += pow(along * meeting.ray[k] - centre[k], 2);
    meeting.beside = sqrt(beside2) / radius;
    along -= radius * sqrt(fmax(1 - beside2 / (radius * radius), 0));
    for (int k = 0; k < 3; k++) {
        meeting.place[k] = along * meeting.ray[k];
        meeting.normal[k] = (meeting.place[k] - centre[k]) / radius;
    }
    return meeting;
}

/* By the angles in the plane of ray and centre: each of the two surfaces turns the ray by a - b towards the
   centre, sin a = n sin b, and what is between turns the place by 180 degrees - 2 b. */
static void through_drop(const Meeting *m, double radius, double ior, double place[3], double way[3])
{
    const double cosine = -dot3(m->ray, m->normal), a = acos(fmin(cosine, 1)), b = asin(sin(a) / ior);
    double side[3] = {0}, turn = 2 * b - M_PI, out = turn - a; /* about the centre, from the normal on */
    for (int k = 0; k < 3 && sin(a) > 1e-9; k++)
        side[k] = (m->ray[k] + cosine * m->normal[k]) / sin(a);
    for (int k = 0; k < 3; k++) {
        const double centre = m->place[k] - radius * m->normal[k];
        place[k] = centre + radius * (cos(turn) * m->normal[k] - sin(turn) * side[k]);
        way[k] = cos(out) * m->normal[k] - sin(out) * side[k];
    }
}

/* On the picture, in pixels, where that ray leaves the box: 2 m, 1 m, 1 m. */
static void exit_of(const SplatScene *scene, const double place[3], const double way[3], double at[2])
{
    const float *view = scene->frame.camera.view;
    double least = 1e30, end[3];
    for (int k = 0; k < 3; k++) {
        const double origin = scene->frame.camera.eye[k], *p = place;
        const double x = origin + view[4 * k] * p[0] + view[4 * k + 1] * p[1] + view[4 * k + 2] * p[2];
        const double d = view[4 * k] * way[0] + view[4 * k + 1] * way[1] + view[4 * k + 2] * way[2];
        const double low = k == 0 ? -1 : k == 1 ? 0 : -0.5, high = k == 0 ? 1 : k == 1 ? 1 : 0.5;
        least = fmin(least, ((d < 0 ? low : high) - x) / d);
    }
    for (int k = 0; k < 3; k++)
        end[k] = place[k] + least * way[k];
    for (int k = 0; k < 2; k++)
        at[k] = end[2] < 0 ? SIDE * (0.5 + 0.5 * end[k] / (-end[2] * scene->frame.camera.tangent[k])) : -1;
}

/* A picture that tells its own columns and rows. */
static uint8_t rgba[4 * SIDE * SIDE];

static void lay_coordinates(const Target *target)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        rgba[4 * i] = (uint8_t)(8 + i % SIDE), rgba[4 * i + 1] = (uint8_t)(8 + i / SIDE);
        rgba[4 * i + 2] = 128, rgba[4 * i + 3] = 255;
    }
    glTextureSubImage2D(target->color, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

static void lay_grey(const Target *target)
{
    memset(rgba, 230, sizeof rgba);
    glTextureSubImage2D(target->color, 0, 0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

/* Without the light of its surface; into rgba. */
static void draw(SplatScene *scene, SplatGround *ground)
{
    SplatDrawing drawing = splat_open(scene, ground, true);
    glGetTextureImage(drawing.target.color, 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof rgba, rgba);
    splat_close(&drawing);
}

static void a_drop_is_a_lens(void **state)
{
    (void)state;
    static const double spacing = 0.3;
    const double radius = radius_of(spacing);
    int compared = 0, upside_down = 0;
    SplatScene scene = drop_scene(spacing);
    for (int k = 0; k < 3; k++)
        scene.world.fluids[0].color[k] = 1;
    draw(&scene, lay_coordinates);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE, y = i / SIDE;
        const Meeting meeting = meeting_of(&scene, radius, x, y);
        double place[3], way[3], at[2];
        if (meeting.beside > 0.75) /* the rim is half a pixel wider, which is much there */
            continue;
        through_drop(&meeting, radius, 1.333, place, way);
        exit_of(&scene, place, way, at);
        if (fmin(at[0], at[1]) < 1 || fmax(at[0], at[1]) > SIDE - 1)
            continue;
        compared++;
        upside_down += meeting.beside > 0.3 && (at[1] - SIDE / 2.0) * meeting.normal[1] < 0;
        for (int k = 0; k < 2; k++)
            if (fabs(rgba[4 * i + k] - 8 - (at[k] - 0.5)) > 2)
                fail_msg("pixel %d %d sees %s %d, by optics %.2f", x, y, k ? "row" : "column",
                         rgba[4 * i + k] - 8, at[k] - 0.5);
    }
    if (compared < 500 || upside_down < 300)
        fail_msg("compared %d pixels, %d of them upside down", compared, upside_down);
    free(scene.particles);
}

static double linear_of(double code)
{
    const double value = code / 255;
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

/* The chord inside: 2 R cos b. */
static void a_drop_absorbs_along_its_chord(void **state)
{
    (void)state;
    static const double spacing = 0.2;
    static const float colour[3] = {0.2F, 0.5F, 0.9F};
    const double radius = radius_of(spacing);
    int compared = 0;
    SplatScene scene = drop_scene(spacing);
    memcpy(scene.world.fluids[0].color, colour, sizeof colour);
    draw(&scene, lay_grey);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const Meeting meeting = meeting_of(&scene, radius, i % SIDE, i / SIDE);
        if (meeting.beside > 0.5) /* beyond it what is seen is beside the picture */
            continue;
        compared++;
        const double chord = 2 * radius * sqrt(1 - pow(meeting.beside / 1.333, 2));
        for (int k = 0; k < 3; k++) {
            const double wanted = linear_of(230) * pow(colour[k], chord / ATTENUATION);
            if (fabs(linear_of(rgba[4 * i + k]) - wanted) > 0.01)
                fail_msg("pixel %d %d, component %d: %g, not %g", i % SIDE, i / SIDE, k,
                         linear_of(rgba[4 * i + k]), wanted);
        }
    }
    assert_true(compared > 400);
    free(scene.particles);
}

/* Black drops over grey: the darkened amount is the area of the discs, however small. */
static void a_drop_covers_its_disc(void **state)
{
    (void)state;
    static const double spacings[] = {0.2, 0.05, 0.02, 0.008, 0.003};
    for (int i = 0; i < 5; i++) {
        SplatScene scene = drop_scene(spacings[i]);
        double centre[3], taken = 0;
        splat_def(&scene.def)->attenuation = 1e-5;
        splat_def(&scene.def)->sprite = i & 1 ? SPLAT_QUAD : SPLAT_POINT;
        for (int k = 0; k < 3; k++)
            scene.world.fluids[0].color[k] = 1e-4F;
        draw(&scene, lay_grey);
        in_eye(&scene, CENTRE, centre);
        for (int p = 0; p < SIDE * SIDE; p++)
            taken += 1 - linear_of(rgba[4 * p]) / linear_of(230);
        const double pixels =
            radius_of(spacings[i]) * SIDE / (2 * scene.frame.camera.tangent[1] * -centre[2]);
        const double wanted = M_PI * pixels * pixels;
        if (fabs(taken - wanted) > 0.03 * wanted + 0.05)
            fail_msg("radius %g pixels: covers %g, not %g", pixels, taken, wanted);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_drop_is_a_lens, no_gl_errors),
        cmocka_unit_test_teardown(a_drop_absorbs_along_its_chord, no_gl_errors),
        cmocka_unit_test_teardown(a_drop_covers_its_disc, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
