/* The shape of the shadow of a ball of fluid: round on a solid, and by the formula for two discs on the
 * floor. */
#include "tests/render/solids_fixture.h"

static const double to_light[3] = {-0.40, 0.84, 0.3666};

static double linear_of(int code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

/* Seen from the light: distance of a place from a ball's middle, m. */
static double beside(const double place[3], const double middle[3])
{
    double along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        along += (place[k] - middle[k]) * to_light[k];
        square += (place[k] - middle[k]) * (place[k] - middle[k]);
    }
    return sqrt(fmax(square - along * along, 0));
}

typedef struct Shaded {
    double place[3]; /* m */
    double share;    /* of the light without the ball */
} Shaded;

static Shaded shaded[PIXELS];

/* All pixels that show the plane y = `height` with and without the ball. Returns their number. */
static int shade(SolidsScene *scene, const double middle[3], double height)
{
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    static float depth[PIXELS];
    SolidsScene alone = *scene;
    Camera camera;
    int count = 0;
    alone.particles = calloc(1, sizeof *alone.particles);
    assert_non_null(alone.particles);
    draw_rgb(&alone, false, without);
    particles_add(scene->particles, middle[0], middle[1], middle[2], 1, 0);
    draw_rgb(scene, false, with);
    draw_depth(scene, depth);
    make_camera(scene, &camera);
    for (int i = 0; i < PIXELS; i++) {
        const int at = 3 * ((HEIGHT - 1 - i / WIDTH) * WIDTH + i % WIDTH) + 1;
        double place[2], along[3], *on = shaded[count].place;
        pixel_place(i, place);
        for (int k = 0; k < 3; k++)
            along[k] = place[0] * camera.tangent[0] * camera.view[4 * k] +
                       place[1] * camera.tangent[1] * camera.view[4 * k + 1] - camera.view[4 * k + 2];
        const double t = (height - camera.eye[1]) / along[1];
        for (int k = 0; k < 3; k++)
            on[k] = camera.eye[k] + t * along[k];
        const double there = depth[i] > 0 ? camera.near_plane / depth[i] : t;
        shaded[count].share = linear_of(with[at]) / linear_of(without[at]);
        count += t > 0 && fabs(there - t) < 1e-3 * t;
    }
    free(alone.particles);
    return count;
}

static SolidsScene scene_seen(double x, double y, double z, double at, double radius)
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "spheres");
    scene.def.camera = (CameraDef){{x, y, z}, {0, at, 0}, 16};
    scene.def.radius = radius / scene.state.spacing;
    return scene;
}

/* Dark where the light sees the ball, and nowhere else: but for three texels of the map at the rim. */
static void round_on_a_solid(void **state)
{
    (void)state;
    const double middle[3] = {-0.4, 0.95, 0.37}, radius = 0.12, rim = 3.2 * 2.694 / 512;
    SolidsScene scene = scene_seen(1.5, 2.5, -1.2, 0.06, radius);
    SolidDef *plate = scene_add(&scene, SOLID_BOX, 0, 0.03, 0);
    int inside = 0, outside = 0, wrong = 0;
    plate->size[0] = 2, plate->size[1] = 0.06, plate->size[2] = 1;
    const int count = shade(&scene, middle, 0.06);
    for (int i = 0; i < count; i++) {
        const double away = beside(shaded[i].place, middle) - radius;
        inside += away<-rim, outside += away> rim && away < radius;
        wrong += (away < -rim && shaded[i].share > 0.5) || (away > rim && shaded[i].share < 0.9);
    }
    if (!(inside > 500 && outside > 1000 && wrong == 0))
        fail_msg("%d of %d pixels in the shadow and %d around", wrong, inside, outside);
    free(scene.particles);
}

/* The part of a disc of radius a that a disc of radius b covers, whose middle is d away. */
static double covered(double a, double b, double d)
{
    if (d >= a + b)
        return 0;
    if (d <= fabs(a - b))
        return fmin(b * b / (a * a), 1);
    const double one = acos((d * d + a * a - b * b) / (2 * d * a)),
                 other = acos((d * d + b * b - a * a) / (2 * d * b));
    return (a * a * (one - sin(2 * one) / 2) + b * b * (other - sin(2 * other) / 2)) / (M_PI * a * a);
}

/* Of the floor's light 0.4 is the sky's. The map's texels smooth the rim a little. */
static void soft_on_the_floor(void **state)
{
    (void)state;
    static const double radii[] = {0.12, 0.05};
    for (int ball = 0; ball < 2; ball++) {
        const double middle[3] = {-0.29, 0.5, 0.266}, light = 0.035 * 2.694, radius = radii[ball];
        SolidsScene scene = scene_seen(1.3, 3.5, -1, -0.11, radius);
        double off = 0, most = 0;
        int part = 0;
        scene.def.floor = true;
        const int count = shade(&scene, middle, -0.045 * sqrt(6));
        for (int i = 0; i < count; i++) {
            const double wanted = 1 - covered(light, radius, beside(shaded[i].place, middle)),
                         found = (shaded[i].share - 0.4) / 0.6;
            off += fabs(found - wanted), most = fmax(most, fabs(found - wanted));
            part += wanted < 0.95;
        }
        off /= part;
        if (!(part > 400 && off < 0.04 && most < 0.17))
            fail_msg("radius %g: off by %g, at most %g; %d pixels in the shadow", radius, off, most, part);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(round_on_a_solid, no_gl_errors),
        cmocka_unit_test_teardown(soft_on_the_floor, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
