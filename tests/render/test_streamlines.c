/* Overlay `streamlines`: lines against known fields. */
#include "tests/render/fixture.h"

#include "render/overlays/streamlines/streamlines_private.h"

enum { MOST = 20000 };

typedef struct Flow {
    float position[4 * MOST], velocity[4 * MOST], speed[MOST];
    uint32_t fluid[MOST];
    ParticleBuffers buffers;
    Upload *upload;
} Flow;

typedef void Field(const double at[3], double velocity[3]);

static const double spacing = 0.05;

/* The box up to `surface`, full of fluid in order, with the velocities of a field. */
static Flow *flow_create(Field *field, double surface)
{
    Error error = {0};
    Flow *flow = calloc(1, sizeof *flow);
    assert_non_null(flow);
    size_t i = 0;
    for (double x = -1 + spacing / 2; x < 1; x += spacing)
        for (double y = spacing / 2; y < surface; y += spacing)
            for (double z = -0.5 + spacing / 2; z < 0.5; z += spacing, i++) {
                double v[3];
                assert_true(i < MOST);
                field((double[3]){x, y, z}, v);
                const double at[4] = {x, y, z, pow(spacing, 3)};
                for (size_t k = 0; k < 4; k++)
                    flow->position[4 * i + k] = (float)at[k];
                for (size_t k = 0; k < 3; k++)
                    flow->velocity[4 * i + k] = (float)v[k];
                flow->speed[i] = (float)sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            }
    ParticleBuffers state = box_state(i, spacing);
    ParticleArrays arrays = {.position = flow->position, .velocity = flow->velocity, .fluid = flow->fluid};
    arrays.scalar[SCALAR_SPEED] = flow->speed;
    flow->upload =
        upload_create(MOST, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_VELOCITY, &error);
    assert_non_null(flow->upload);
    assert_true(upload_write_arrays(flow->upload, &arrays, &state, &error));
    assert_true(upload_take(flow->upload, &flow->buffers));
    return flow;
}

static void flow_destroy(Flow *flow)
{
    upload_destroy(flow->upload);
    free(flow);
}

typedef struct Traced {
    size_t lines, points; /* points of a line */
    float (*point)[4];
} Traced;

static Traced traced(const Flow *flow, const ViewDef *def)
{
    Error error = {0};
    const WorldDef world = bare_world();
    StreamLines lines = {0};
    Derived derived = {0};
    ParticleBuffers buffers = flow->buffers;
    ParticleWants wants = {0};
    const Frame frame = {.def = def,
                         .world = &world,
                         .slab = frame_slab_depth(&buffers),
                         .neighbourhood = &derived.neighbourhood};
    overlays_want(def, &wants);
    assert_true(derived_update(&derived, &wants, &error));
    derived_fill(&derived, &wants, &(DerivedSpace){.flat = false}, &buffers);
    if (!stream_lines_create(&lines, &error))
        fail_msg("%s", error.message);
    stream_lines_make(&lines, &buffers, &frame);
    Traced out = {.lines = lines.lines, .points = 2 * (size_t)lines.steps + 1};
    const size_t bytes = out.lines * out.points * sizeof *out.point;
    out.point = calloc(1, bytes + 1);
    assert_non_null(out.point);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (bytes > 0)
        glGetNamedBufferSubData(lines.points, 0, (GLsizeiptr)bytes, out.point);
    stream_lines_destroy(&lines);
    derived_destroy(&derived);
    return out;
}

static ViewDef stream_view(void)
{
    ViewDef def = bare_view();
    text_set(def.kind, "none");
    streamlines_def(&def)->show = true;
    streamlines_def(&def)->cell = 0.2;
    return def;
}

/* The greatest difference of a function along a line from its value at the seed, and the line's length. */
static double drift(const Traced *all, size_t line, double (*kept)(const float at[4]), double *length)
{
    const float(*p)[4] = (const float(*)[4])(all->point + line * all->points);
    const double at_seed = kept(p[all->points / 2]);
    double worst = 0;
    *length = 0;
    for (size_t k = 0; k < all->points; k++)
        worst = fmax(worst, fabs(kept(p[k]) - at_seed));
    for (size_t k = 1; k < all->points; k++)
        *length += sqrt(pow(p[k][0] - p[k - 1][0], 2) + pow(p[k][1] - p[k - 1][1], 2) +
                        pow(p[k][2] - p[k - 1][2], 2));
    return worst;
}

static double radius_of(const float at[4])
{
    return hypot(at[0], at[1] - 0.5);
}

static double height_of(const float at[4])
{
    return at[1];
}

static double psi_of(const float at[4])
{
    return sin(M_PI * at[0]) * sin(M_PI * at[1]);
}

static void turning(const double at[3], double v[3])
{
    v[0] = -(at[1] - 0.5), v[1] = at[0], v[2] = 0;
}

static void uniform(const double at[3], double v[3])
{
    (void)at;
    v[0] = 2, v[1] = v[2] = 0;
}

static void taylor_green(const double at[3], double v[3])
{
    v[0] = sin(M_PI * at[0]) * cos(M_PI * at[1]);
    v[1] = -cos(M_PI * at[0]) * sin(M_PI * at[1]);
    v[2] = 0;
}

static bool near(const float at[4], double x, double y, double reach)
{
    return hypot(at[0] - x, at[1] - y) < reach;
}

/* All lines whose seeds are within `reach` of a place: what is kept, and the least length. */
static void compare(Field *field, double (*kept)(const float at[4]), double x, double reach, double bound,
                    double least_length)
{
    const ViewDef def = stream_view();
    Flow *flow = flow_create(field, 1);
    Traced all = traced(flow, &def);
    size_t seen = 0;
    assert_int_equal(all.lines, 10 * 5);
    for (size_t i = 0; i < all.lines; i++) {
        double length;
        if (!near(all.point[i * all.points + all.points / 2], x, 0.5, reach))
            continue;
        const double off = drift(&all, i, kept, &length);
        if (!(off < bound && length > least_length))
            fail_msg("line %zu is %g m long and %g off", i, length, off);
        seen++;
    }
    assert_true(seen >= 4);
    free(all.point);
    flow_destroy(flow);
}

/* Circles that close; a seed in the middle rests. Within a fiftieth of the spacing per turn. */
static void a_rotation_has_circles(void **state)
{
    (void)state;
    compare(turning, radius_of, 0, 0.35, 0.02 * spacing, 0.5);
}

static void a_uniform_flow_has_straight_lines(void **state)
{
    (void)state;
    compare(uniform, height_of, 0, 2, 1e-4 * spacing, 1.8);
}

static void a_vortex_keeps_its_stream_function(void **state)
{
    (void)state;
    compare(taylor_green, psi_of, 0.2, 0.29, 0.02, 0.5);
}

/* The lower half is full: lines begin and end there, and the seeds above have none. */
static void without_fluid_there_are_no_lines(void **state)
{
    (void)state;
    ViewDef def = stream_view();
    Flow *flow = flow_create(taylor_green, 0.5);
    Traced all = traced(flow, &def);
    size_t some = 0;
    for (size_t i = 0; i < all.lines; i++) {
        double length;
        drift(&all, i, height_of, &length);
        if (all.point[i * all.points + all.points / 2][1] > 0.5 + flow->buffers.support_radius)
            assert_true(length == 0);
        some += length > 0.2;
        for (size_t k = 0; length > 0 && k < all.points; k++)
            assert_true(all.point[i * all.points + k][1] < 0.5 + 0.5 * flow->buffers.support_radius);
    }
    assert_true(some >= 10);
    free(all.point);
    streamlines_def(&def)->plane_point[2] = 3; /* beside the box */
    all = traced(flow, &def);
    assert_int_equal(all.lines, 0);
    free(all.point);
    flow_destroy(flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_rotation_has_circles, no_gl_errors),
        cmocka_unit_test_teardown(a_uniform_flow_has_straight_lines, no_gl_errors),
        cmocka_unit_test_teardown(a_vortex_keeps_its_stream_function, no_gl_errors),
        cmocka_unit_test_teardown(without_fluid_there_are_no_lines, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
