/* Results of probing pictures by mouse and at places: against a loop over all particles. */
#include "tests/render/fixture.h"

#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "render/views/pbsr/pbsr.h"
#include "sim/step/method.h"

enum { WIDE = 160, HIGH = 120 };
static const double SPACING = 0.08;

/* A picture, and all values of the particles. */
typedef struct Probed {
    Particles *particles;
    float *velocity;
    float *vorticity; /* as the picture derives it; NULL: not read back */
    uint32_t *id;
    Upload *upload;
    ParticleBuffers state;
    WorldDef world;
    ViewDef def;
    Renderer *renderer;
    Sight sight;
} Probed;

static ViewDef view_of(const char *kind, Scalar scalar)
{
    ViewDef def = bare_view();
    text_set(def.kind, kind);
    def.color_by = scalar;
    def.range_auto = false;
    def.range[1] = 4;
    def.camera_auto = false;
    memcpy(def.camera.from, (double[3]){0.4, 1.3, 2.4}, sizeof def.camera.from);
    memcpy(def.camera.to, (double[3]){0, 0.35, 0}, sizeof def.camera.to);
    def.camera.fov_deg = 45;
    return def;
}

/* Turns about y by 1.5 rad/s, and drifts. */
static void move(Probed *probed)
{
    const size_t count = probed->particles->count;
    probed->velocity = calloc(count + 1, sizeof(float[4]));
    probed->id = calloc(count + 1, sizeof *probed->id);
    for (size_t i = 0; i < count; i++) {
        const float *at = &probed->particles->position[4 * i];
        float *to = &probed->velocity[4 * i];
        probed->particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
        to[0] = 1.5F * at[2] + 0.25F, to[1] = 0.1F, to[2] = -1.5F * at[0];
        probed->id[i] = (uint32_t)(7 * i + 3);
    }
}

static void open_picture(Probed *probed, const ViewDef *def, const WorldDef *world)
{
    Error error = {0};
    const ParticleBuffers state = box_state(0, SPACING);
    *probed = (Probed){.particles = particles_wave(SPACING), .def = *def, .world = *world};
    particles_spare(probed->particles, world, SPACING);
    ParticleBuffers full = state;
    const unsigned attributes =
        PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_VELOCITY | PARTICLE_ID;
    full.count = probed->particles->count;
    full.box.position[0] = 0.1;
    quat_turn((double[3]){0.05, 0.3, 0.1}, full.box.orientation);
    move(probed);
    ParticleArrays arrays = {.position = probed->particles->position,
                             .velocity = probed->velocity,
                             .fluid = probed->particles->fluid,
                             .id = probed->id};
    arrays.scalar[SCALAR_SPEED] = probed->particles->speed;
    probed->upload = upload_create(full.count, attributes, &error);
    assert_true(upload_write_arrays(probed->upload, &arrays, &full, &error));
    assert_true(upload_take(probed->upload, &probed->state));
    probed->renderer = renderer_create(def, world, WIDE, HIGH, &error);
    if (!probed->renderer)
        fail_msg("%s", error.message);
    probed->sight = (Sight){.box = probed->state.box, .width = WIDE, .height = HIGH};
    camera_make(def, probed->state.box_size, &probed->state.box, (double)WIDE / HIGH, (CoveredParts){0},
                &probed->sight.camera);
    renderer_draw(probed->renderer, &probed->state, NULL);
}

static void close_picture(Probed *probed)
{
    renderer_destroy(probed->renderer);
    upload_destroy(probed->upload);
    free(probed->velocity);
    free(probed->vorticity);
    free(probed->id);
    free(probed->particles);
}

/* What is known in the end. */
static ViewProbeAnswers ask(const Probed *probed, const ViewProbeRequest *asks)
{
    ViewProbeAnswers told;
    for (int tries = 0; tries < 3; tries++) {
        if (!renderer_probe(probed->renderer, asks, &told))
            fail_msg("the view %s tells nothing", probed->def.kind);
        if (told.now) {
            assert_true(told.asked && told.placed == told.mouse);
            return told;
        }
        glFinish();
    }
    fail_msg("nothing came");
    return told;
}

static ViewProbeAnswers ask_pixel(const Probed *probed, double x, double y)
{
    const ViewProbeRequest asks = {.mouse = true, .pixel = {x, y}};
    const double pixel[2] = {x, y};
    assert_true(renderer_can_probe(probed->renderer, pixel));
    return ask(probed, &asks);
}

/* The particle with the first ball along a ray; -1: none. `margin`: distance from ambiguity, in radii. */
static int first_ball(const Probed *probed, const double pixel[2], const double *radii, double *margin)
{
    SightRay ray;
    double least = INFINITY, next = INFINITY;
    int first = -1;
    sight_ray(&probed->sight, pixel, &ray);
    *margin = INFINITY;
    for (size_t i = 0; i < probed->particles->count; i++) {
        const float *at = &probed->particles->position[4 * i];
        double along = 0, square = 0;
        for (int k = 0; k < 3; k++) {
            along += (at[k] - ray.from[k]) * ray.along[k];
            square += (at[k] - ray.from[k]) * (at[k] - ray.from[k]);
        }
        const double beside = sqrt(fmax(square - along * along, 0));
        *margin = fmin(*margin, fabs(beside / radii[i] - 1));
        if (beside > radii[i])
            continue;
        const double depth = along - sqrt(radii[i] * radii[i] - beside * beside);
        if (depth < least)
            next = least, least = depth, first = (int)i;
        else
            next = fmin(next, depth);
    }
    *margin = fmin(*margin, (next - least) / SPACING);
    return first;
}

static void check_ball(const Probed *probed, const ViewProbe *told, int first, double value)
{
    const float *at = &probed->particles->position[(size_t)4 * (size_t)first];
    assert_int_equal(told->what, VIEW_PROBE_VALUE);
    assert_int_equal(told->id, 7 * first + 3);
    for (int k = 0; k < 3; k++)
        assert_true(told->at[k] == (double)at[k]);
    if (fabs(told->value - value) > 1e-4)
        fail_msg("particle %d: %g, wanted %g", first, told->value, value);
}

/* Each ball under the mouse has its particle's own number. */
static int check_balls(const Probed *probed, const double *radii, double (*value)(const Probed *, int))
{
    int balls = 0, none = 0;
    for (int i = 0; i < 120; i++) {
        const int column = i % 12, row = i / 12;
        const double pixel[2] = {4.5 + 13 * column, 3.5 + 11 * row};
        double margin;
        const int first = first_ball(probed, pixel, radii, &margin);
        const ViewProbeAnswers told = ask_pixel(probed, pixel[0] + 0.3, pixel[1] - 0.4);
        if (margin < 1e-3)
            continue;
        assert_int_equal(told.mouse, first >= 0);
        assert_int_equal(told.count, first >= 0);
        if (first >= 0)
            check_ball(probed, &told.probe[0], first, value(probed, first));
        balls += first >= 0, none += first < 0;
    }
    assert_true(none > 5);
    return balls;
}

static double speed_of(const Probed *probed, int i)
{
    return (double)probed->particles->speed[i];
}

static double velocity_x_of(const Probed *probed, int i)
{
    return (double)probed->velocity[4 * i];
}

static double vorticity_of(const Probed *probed, int i)
{
    return (double)probed->vorticity[i];
}

/* What is derived is the picture's own; most of the fluid turns by 1.5 rad/s. */
static void read_vorticity(Probed *probed)
{
    ParticleBuffers with = probed->state;
    size_t turning = 0;
    renderer_derive(probed->renderer, &with);
    const ParticleAttribute *from = &with.scalar[SCALAR_VORTICITY];
    assert_true(from->buffer && from->stride == sizeof(float));
    probed->vorticity = calloc(with.count + 1, sizeof(float));
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(with.count * sizeof(float)),
                            probed->vorticity);
    for (size_t i = 0; i < with.count; i++)
        turning += fabsf(probed->vorticity[i] - 3) < 1e-3F;
    assert_true(turning > with.count / 2);
}

static void a_ball_under_the_mouse_has_its_particles_number(void **state)
{
    (void)state;
    static const struct {
        Scalar scalar;
        double (*value)(const Probed *, int);
    } of[] = {{SCALAR_SPEED, speed_of}, {SCALAR_VELOCITY_X, velocity_x_of}, {SCALAR_VORTICITY, vorticity_of}};
    const WorldDef world = bare_world();
    double radii[PARTICLES_MAX];
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const ViewDef def = view_of("spheres", of[i].scalar);
        Probed probed;
        open_picture(&probed, &def, &world);
        for (size_t k = 0; k < probed.particles->count; k++)
            radii[k] = SPACING / 2;
        if (of[i].scalar == SCALAR_VORTICITY)
            read_vorticity(&probed);
        assert_true(check_balls(&probed, radii, of[i].value) > 30);
        const ViewProbeAnswers told = ask_pixel(&probed, WIDE / 2.0, HIGH / 2.0);
        assert_string_equal(told.probe[0].name, scalar_name(of[i].scalar));
        assert_string_equal(told.probe[0].unit, scalar_unit(of[i].scalar));
        close_picture(&probed);
    }
}

/* From half to one and a half of the radius, with the speed. */
static void balls_of_different_sizes(void **state)
{
    (void)state;
    const WorldDef world = bare_world();
    ViewDef def = view_of("spheres", SCALAR_SPEED);
    Probed probed;
    double radii[PARTICLES_MAX];
    def.size.by = 1 + SCALAR_SPEED;
    def.size.range_auto = false;
    memcpy(def.size.range, (double[2]){0, 4}, sizeof def.size.range);
    def.size.curve = (ControlPoints){2, {0, 1}, {0.5, 1.5}};
    open_picture(&probed, &def, &world);
    for (size_t k = 0; k < probed.particles->count; k++) {
        const double share = (double)probed.particles->speed[k] / 4;
        radii[k] = SPACING / 2 * (0.5 + fmin(fmax(share, 0), 1));
    }
    assert_true(check_balls(&probed, radii, speed_of) > 30);
    close_picture(&probed);
}

/* Where the depth of the picture says. */
static bool place_of(const Probed *probed, const float *depth, int x, int y, double at[3])
{
    const double pixel[2] = {x + 0.5, y + 0.5}, here = (double)depth[(HIGH - 1 - y) * WIDE + x];
    const float *view = probed->sight.camera.view;
    SightRay ray;
    double slant = 0;
    sight_ray(&probed->sight, pixel, &ray);
    if (here <= 0)
        return false;
    for (int k = 0; k < 3; k++) { /* the way of the ray along the eye's axis, which is in the world */
        double turned[3];
        quat_rotate(probed->state.box.orientation, ray.along, turned);
        slant -= (double)view[4 * k + 2] * turned[k];
    }
    for (int k = 0; k < 3; k++)
        at[k] = ray.from[k] + ray.along[k] * ((double)probed->sight.camera.near_plane / here / slant);
    return true;
}

/* By the method's kernel. */
static double mean_at(const Probed *probed, const double at[3], const float *of, size_t stride, double *field)
{
    const int kernel = plane_kernel_of(0, &probed->world);
    double sum = 0;
    *field = 0;
    for (size_t i = 0; i < probed->particles->count; i++) {
        const float *x = &probed->particles->position[4 * i];
        const double r = sqrt(pow(x[0] - at[0], 2) + pow(x[1] - at[1], 2) + pow(x[2] - at[2], 2));
        const double w = plane_kernel_value(kernel, 3, r, probed->state.support_radius) * (double)x[3];
        *field += w;
        sum += w * (double)of[stride * i];
    }
    return sum / *field;
}

/* Returns how many. */
static int check_means(const Probed *probed, const float *of, size_t stride)
{
    float depth[WIDE * HIGH];
    int values = 0;
    renderer_read_depth(probed->renderer, depth);
    for (int i = 0; i < 60; i++) {
        const int x = 6 + 25 * (i % 6), y = 5 + 11 * (i / 6);
        double at[3], field;
        const bool there = place_of(probed, depth, x, y, at);
        if (there)
            mean_at(probed, at, of, stride, &field);
        if (there && field < 1e-6)
            continue; /* a layer beside the fluid */
        const ViewProbeAnswers told = ask_pixel(probed, x + 0.7, y + 0.2);
        assert_int_equal(told.mouse, there);
        if (!there)
            continue;
        const ViewProbe *found = &told.probe[0];
        for (int k = 0; k < 3; k++)
            if (fabs(found->at[k] - at[k]) > 1e-5)
                fail_msg("pixel %d %d, axis %d: at %g, wanted %g", x, y, k, found->at[k], at[k]);
        const double wanted = mean_at(probed, found->at, of, stride, &field);
        if (fabs(found->value - wanted) > 1e-5 * 4)
            fail_msg("pixel %d %d: %.7g, wanted %.7g", x, y, found->value, wanted);
        assert_true(found->seen && hypot(found->pixel[0] - x - 0.5, found->pixel[1] - y - 0.5) < 0.01);
        assert_int_equal(found->id, VIEW_NO_ID);
        values++;
    }
    return values;
}

static void a_surface_under_the_mouse_has_the_mean_there(void **state)
{
    (void)state;
    WorldDef world = bare_world();
    Probed probed;
    text_set(world.method, "mueller");
    ViewDef def = view_of("splat", SCALAR_SPEED);
    open_picture(&probed, &def, &world);
    assert_true(check_means(&probed, probed.particles->speed, 1) > 15);
    close_picture(&probed);
    def = view_of("volume", SCALAR_VELOCITY_X);
    volume_def(&def)->cells = 40;
    open_picture(&probed, &def, &world);
    assert_true(check_means(&probed, probed.velocity, 4) > 15);
    close_picture(&probed);
}

/* Of transparent layers the nearest point of all sets is under the mouse, anywhere in its pixel. */
static void of_layers_the_nearest_is_under_the_mouse(void **state)
{
    (void)state;
    WorldDef world = bare_world();
    Probed probed;
    text_set(world.method, "mueller");
    ViewDef def = view_of("pbsr", SCALAR_SPEED);
    PbsrDef *own = pbsr_def(&def);
    own->layers[own->layer_count++] = (PbsrLayer){.of = PBSR_SLICE_Z, .level = -0.11, .opacity = 0.3};
    own->layers[own->layer_count++] = (PbsrLayer){.of = PBSR_SPHERE, .level = 0.35, .opacity = 0.3};
    open_picture(&probed, &def, &world);
    assert_true(check_means(&probed, probed.particles->speed, 1) > 5);
    const double half_pixel = sqrt(0.5) * 2 * tan(def.camera.fov_deg * M_PI / 360) / HIGH * 2.7;
    int on_slice = 0, on_ball = 0;
    for (int i = 0; i < 300; i++) {
        const int column = i % 20, row = i / 20;
        const ViewProbeAnswers told = ask_pixel(&probed, 4.5 + 8 * column, 4.5 + 8 * row);
        if (!told.mouse)
            continue;
        const double *at = told.probe[0].at, middle = probed.state.box_size[1] / 2;
        const double from = sqrt(at[0] * at[0] + (at[1] - middle) * (at[1] - middle) + at[2] * at[2]);
        if (fabs(from - 0.35) < half_pixel)
            on_ball++;
        else if (fabs(at[2] + 0.11) < half_pixel)
            on_slice++;
        else
            fail_msg("(%g, %g, %g) is on no layer", at[0], at[1], at[2]);
    }
    if (on_slice < 15 || on_ball < 5)
        fail_msg("%d places on the slice and %d on the sphere", on_slice, on_ball);
    close_picture(&probed);
}

/* Pins: within, beside all, and as many as there may be. */
static void places_that_are_said(void **state)
{
    (void)state;
    static const char *const kinds[] = {"spheres", "splat", "volume", "pbsr"};
    const WorldDef world = bare_world();
    for (int v = 0; v < 4; v++) {
        const ViewDef def = view_of(kinds[v], SCALAR_SPEED);
        Probed probed;
        ViewProbeRequest asks = {.count = VIEW_PROBES_MAX};
        double field;
        open_picture(&probed, &def, &world);
        for (int i = 0; i < asks.count; i++)
            for (int k = 0; k < 3; k++) /* a little beside a particle; the last is where none is */
                asks.at[i][k] =
                    i == asks.count - 1 ? 0.45 : (double)probed.particles->position[4 * 31 * i + k] + 0.01;
        ViewProbeAnswers told = ask(&probed, &asks);
        assert_int_equal(told.count, VIEW_PROBES_MAX);
        assert_false(told.mouse);
        for (int i = 0; i < told.count - 1; i++) {
            const double mean = mean_at(&probed, asks.at[i], probed.particles->speed, 1, &field);
            const double wanted = v == 0 ? (double)probed.particles->speed[31 * i] : mean;
            assert_int_equal(told.probe[i].what, VIEW_PROBE_VALUE);
            for (int k = 0; k < 3; k++)
                assert_true(told.probe[i].at[k] == asks.at[i][k]);
            if (fabs(told.probe[i].value - wanted) > 4e-5)
                fail_msg("%s, place %d: %g, wanted %g", kinds[v], i, told.probe[i].value, wanted);
        }
        mean_at(&probed, asks.at[told.count - 1], probed.particles->speed, 1, &field);
        assert_true(field == 0 && told.probe[told.count - 1].what == VIEW_PROBE_EMPTY);
        close_picture(&probed);
    }
}

static void fluids_have_names_and_solids_nothing(void **state)
{
    (void)state;
    WorldDef world = bare_world();
    const ViewDef def = view_of("spheres", SCALAR_FLUID);
    Probed probed;
    double pixel[2], margin, radii[PARTICLES_MAX];
    int named[2] = {0};
    world.solids[0] = (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.5, 0.7, 0.1}, .radius = 0.25};
    world.solid_count = 1;
    open_picture(&probed, &def, &world);
    for (size_t k = 0; k < probed.particles->count; k++)
        radii[k] = SPACING / 2;
    for (int i = 0; i < 120; i++) {
        const int column = i % 12, row = i / 12;
        const double at[2] = {4.5 + 13 * column, 3.5 + 11 * row};
        const int first = first_ball(&probed, at, radii, &margin);
        const ViewProbeAnswers told = ask_pixel(&probed, at[0], at[1]);
        if (!told.mouse || first < 0 || margin < 1e-3)
            continue;
        const unsigned fluid = probed.particles->fluid[first];
        assert_string_equal(told.probe[0].words, world.fluids[fluid].name);
        assert_string_equal(told.probe[0].name, "fluid");
        named[fluid]++;
    }
    assert_true(named[0] > 10 && named[1] > 0);
    assert_true(sight_pixel(&probed.sight, (double[3]){-0.5, 0.8, 0.2}, pixel));
    assert_int_equal(ask_pixel(&probed, pixel[0], pixel[1]).count, 0);
    close_picture(&probed);
}

/* Where the state lacks the scalar the picture shows fluids, and so do the values, by that name. */
static void fluids_stand_for_what_is_not_there(void **state)
{
    (void)state;
    static const char *const kinds[] = {"volume", "spheres", "splat"};
    const WorldDef world = bare_world();
    for (int v = 0; v < 3; v++) {
        const ViewDef def = view_of(kinds[v], SCALAR_DENSITY);
        Probed probed;
        ViewProbeRequest asks = {.count = 1};
        open_picture(&probed, &def, &world);
        for (int k = 0; k < 3; k++)
            asks.at[0][k] = (double)probed.particles->position[k];
        const ViewProbeAnswers told = ask(&probed, &asks);
        assert_int_equal(told.count, 1);
        assert_non_null(told.probe[0].words);
        assert_string_equal(told.probe[0].name, "fluid");
        assert_string_equal(told.probe[0].unit, "");
        close_picture(&probed);
    }
}

/* Numbers that are none: a ball says so, a mean where most of the fluid has none. */
static void no_number_is_said_to_be_none(void **state)
{
    (void)state;
    static const char *const kinds[] = {"spheres", "splat"};
    const WorldDef world = bare_world();
    for (int v = 0; v < 2; v++) {
        const ViewDef def = view_of(kinds[v], SCALAR_VELOCITY_X);
        Probed probed;
        open_picture(&probed, &def, &world);
        const size_t count = probed.particles->count;
        for (size_t i = 0; i < count; i++)
            probed.velocity[4 * i] = i < count / 2 ? NAN : 1;
        ParticleArrays arrays = {.position = probed.particles->position,
                                 .velocity = probed.velocity,
                                 .fluid = probed.particles->fluid,
                                 .id = probed.id};
        Error error;
        ParticleBuffers next = box_state(count, SPACING);
        arrays.scalar[SCALAR_SPEED] = probed.particles->speed;
        next.step = 1;
        assert_true(upload_write_arrays(probed.upload, &arrays, &next, &error));
        assert_true(upload_take(probed.upload, &probed.state));
        renderer_draw(probed.renderer, &probed.state, NULL);
        ViewProbeRequest asks = {.count = 2};
        for (int k = 0; k < 3; k++) {
            asks.at[0][k] = (double)probed.particles->position[k];
            asks.at[1][k] = (double)probed.particles->position[4 * (count - 1) + k];
        }
        const ViewProbeAnswers told = ask(&probed, &asks);
        assert_int_equal(told.probe[0].what, VIEW_PROBE_NAN);
        assert_int_equal(told.probe[1].what, VIEW_PROBE_VALUE);
        assert_true(fabs(told.probe[1].value - 1) < 1e-6);
        close_picture(&probed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_ball_under_the_mouse_has_its_particles_number, no_gl_errors),
        cmocka_unit_test_teardown(balls_of_different_sizes, no_gl_errors),
        cmocka_unit_test_teardown(a_surface_under_the_mouse_has_the_mean_there, no_gl_errors),
        cmocka_unit_test_teardown(places_that_are_said, no_gl_errors),
        cmocka_unit_test_teardown(of_layers_the_nearest_is_under_the_mouse, no_gl_errors),
        cmocka_unit_test_teardown(fluids_have_names_and_solids_nothing, no_gl_errors),
        cmocka_unit_test_teardown(fluids_stand_for_what_is_not_there, no_gl_errors),
        cmocka_unit_test_teardown(no_number_is_said_to_be_none, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
