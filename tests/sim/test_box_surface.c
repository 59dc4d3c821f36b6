/* The surface of fluid in a box that has turned, or spins: thousands of steps. */
#include "tests/lists.h"

#include "fixture.h"

/* Least squares of y = a + b u over the highest particle of each column of cells one spacing wide, `u` given.
 */
typedef double (*Abscissa)(const float x[3]);

static double fit_surface(const State *s, double width, double spacing, Abscissa u_of)
{
    enum { MAX = 64 };
    static float top[MAX][MAX][3];
    const int n = (int)(width / spacing + 0.5);
    memset(top, 0, sizeof top);
    for (size_t i = 0; i < s->count; i++) {
        const float *x = s->position + 4 * i;
        const int a = (int)((x[0] / width + 0.5) * n), b = (int)((x[2] / width + 0.5) * n);
        if (a >= 0 && a < n && b >= 0 && b < n && x[1] > top[a][b][1])
            memcpy(top[a][b], x, sizeof top[a][b]);
    }
    double count = 0, su = 0, sy = 0, suu = 0, suy = 0;
    for (int a = 1; a < n - 1; a++)
        for (int b = 1; b < n - 1; b++) {
            const double u = u_of(top[a][b]), y = top[a][b][1];
            count++;
            su += u;
            sy += y;
            suu += u * u;
            suy += u * y;
        }
    return (count * suy - su * sy) / (count * suu - su * su);
}

static double along_x(const float x[3])
{
    return x[0];
}

/* A box that turns by 30 degrees: the surface ends level in the world. */
static void tilted_box_ends_level(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1.6, 2.4, 1.6);
    const bool on_cpu = fixture_on_cpu(); /* there 16 columns, else 12 */
    def.spacing = on_cpu ? 0.1 : 0.4 / 3;
    def.sound_speed = fixture_coarse(40, 20);
    def.dt = fixture_coarse(0.0015, 0.005);
    def.fluids[0].viscosity = on_cpu ? 100 : 400; /* at rest sooner */
    fixture_block(&def, 0, -0.8, 0, -0.8, 0.8, 1.0, 0.8);
    add_motion(&def, (Motion){.kind = MOTION_TURN, .axis = {0, 0, 1}, .angle_deg = 30, .duration = 1});
    World *world = fixture_world(&def);
    fixture_step(world, fixture_count(5000, on_cpu ? 800 : 450));
    State s = fixture_read(world);
    /* in the box's frame the level surface falls by tan 30 degrees along x */
    const double slope = fit_surface(&s, 1.6, def.spacing, along_x);
    const double angle = atan(slope) * 180 / M_PI + 30;
    printf("tilted box: surface %.2f degrees off level\n", angle);
    assert_true(fabs(angle) <= (on_cpu ? 1 : 3.5)); /* few layers resist the shear beside walls */
    fixture_free(&s);
    world_destroy(world);
}

static double radius2(const float x[3])
{
    return (double)x[0] * x[0] + (double)x[2] * x[2];
}

/* y = omega^2 r^2 / 2g in a box that spins about its vertical axis. */
static void bucket_has_its_parabola(void **state)
{
    (void)state;
    if (fixture_on_fragment())
        fixture_needs_cpu("two thousand particles; the lone one turns with the box, the tank tilts");
    const double omega = 3.5;
    WorldDef def = fixture_def(1.6, 2.4, 1.6);
    def.spacing = fixture_coarse(0.2 / 3, 0.1);
    def.sound_speed = fixture_coarse(40, 15);
    def.dt = fixture_coarse(0.0012, 0.005);
    def.fluids[0].viscosity = fixture_coarse(100, 300);
    fixture_block(&def, 0, -0.8, 0, -0.8, 0.8, 0.96, 0.8);
    add_motion(&def, (Motion){.kind = MOTION_SPIN, .axis = {0, 1, 0}, .rate = omega});
    World *world = fixture_world(&def);
    fixture_step(world, fixture_count(2500, 300));
    State s = fixture_read(world);
    const double ratio = fit_surface(&s, 1.6, def.spacing, radius2) / (omega * omega / (2 * 9.81));
    printf("bucket: curvature %.3f of omega^2 / 2g\n", ratio);
    assert_true(fabs(ratio - 1) <= fixture_coarse(0.05, 0.1)); /* of 24 columns across it, or 16 */
    fixture_free(&s);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tilted_box_ends_level),
        cmocka_unit_test(bucket_has_its_parabola),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
