/* Beside a covered side of the picture: every view, solid, line and shadow equals a wider picture with
   the same axis in the middle, without a cover. So off-axis drawing is compared with on-axis drawing, and
   a pass without the axis shows a displacement. */
#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/trails/trails.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"
#include "tests/render/fixture.h"

#define SPACING 0.1

enum { WIDE = 96, HIGH = 72, COVERED = 24, WIDER = WIDE + COVERED };
static uint8_t beside[3 * WIDE * HIGH], whole[3 * WIDER * HIGH];

static Upload *upload_moving(Particles *particles, ParticleBuffers *out, double turn)
{
    static uint32_t id[PARTICLES_MAX];
    static float velocity[4 * PARTICLES_MAX];
    static Particles moved;
    Error error = {0};
    ParticleBuffers state = box_state(particles->count, SPACING);
    state.time += turn;
    state.box = (BoxState){.position = {0.1, 0.05, 0}, .orientation = {0, 0.1, 0.05, sqrt(0.9875)}};
    moved = *particles;
    for (size_t i = 0; i < particles->count; i++) {
        const float *at = &particles->position[4 * i], c = cosf((float)turn), s = sinf((float)turn);
        float *to = &moved.position[4 * i];
        id[i] = (uint32_t)i;
        to[0] = at[0] * c - (at[1] - 0.5F) * s;
        to[1] = 0.5F + at[0] * s + (at[1] - 0.5F) * c;
        to[3] = (float)(SPACING * SPACING * SPACING);
        velocity[4 * i] = 0.5F - at[1];
        velocity[4 * i + 1] = at[0];
    }
    ParticleArrays arrays = {
        .position = moved.position, .velocity = velocity, .id = id, .fluid = moved.fluid};
    arrays.scalar[SCALAR_SPEED] = moved.speed;
    Upload *upload = upload_create(
        particles->count, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_ID | PARTICLE_VELOCITY,
        &error);
    assert_non_null(upload);
    assert_true(upload_write_arrays(upload, &arrays, &state, &error) && upload_take(upload, out));
    return upload;
}

static WorldDef world_of(bool solid)
{
    WorldDef world = bare_world();
    world.solid_count = solid;
    world.solids[0] =
        (SolidDef){SOLID_SPHERE, .centre = {-0.45, 0.4, 0.1}, .radius = 0.25, .color = {0.75F, 0.20F, 0.12F}};
    return world;
}

/* With trails: of the last states. */
static void draw(const ViewDef *def, const WorldDef *world, int width, double covered, uint8_t *rgb)
{
    Error error = {0};
    Renderer *renderer = renderer_create(def, world, width, HIGH, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    Particles *particles = particles_wave(SPACING);
    particles_spare(particles, world, SPACING);
    renderer_set_covered(renderer, (CoveredParts){.left = covered});
    for (int i = trails_def(def)->show ? -12 : 0; i <= 0; i++) {
        ParticleBuffers state;
        Upload *upload = upload_moving(particles, &state, 0.04 * i);
        renderer_draw(renderer, &state, NULL);
        upload_destroy(upload);
    }
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    free(particles);
}

static void check(const char *name, const ViewDef *def, bool solid)
{
    const WorldDef world = world_of(solid);
    int different = 0, drawn = 0;
    draw(def, &world, WIDE, (double)COVERED / WIDE, beside);
    draw(def, &world, WIDER, 0, whole);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++) {
            const uint8_t *a = &beside[3 * (y * WIDE + x)], *b = &whole[3 * (y * WIDER + x)];
            int worst = 0;
            for (int k = 0; k < 3; k++)
                worst = abs(a[k] - b[k]) > worst ? abs(a[k] - b[k]) : worst;
            different += worst > 12;
            drawn += abs(a[0] - a[2]) > 60; /* of a clear colour */
        }
    if (50 * different > WIDE * HIGH || drawn < 100)
        fail_msg("%s: %d of %d pixels differ, %d are coloured", name, different, WIDE * HIGH, drawn);
}

static ViewDef view_of(const char *kind)
{
    ViewDef def = bare_view();
    text_set(def.kind, kind);
    def.color_by = SCALAR_FLUID;
    def.box = def.floor = true;
    def.camera_auto = false;
    def.camera = (CameraDef){{0.9, 1.3, 2.6}, {0, 0.4, 0}, 45};
    return def;
}

static void of_balls(void **state)
{
    (void)state;
    ViewDef def = view_of("spheres");
    check("spheres", &def, true);
    def.opacity.by = 1 + SCALAR_SPEED;
    def.opacity.curve = (ControlPoints){2, {0, 1}, {0.3, 1}};
    check("spheres by opacity", &def, false);
    def = view_of("spheres"); /* all in view: points */
    def.camera = (CameraDef){{1.8, 2.3, 5.6}, {0, 0.4, 0}, 45};
    check("spheres far away", &def, false);
}

static void of_splats(void **state)
{
    (void)state;
    ViewDef def = view_of("splat");
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        splat_def(&def)->sprite = (SplatSprite)sprite;
        check("splat", &def, true);
    }
    def = view_of("splat");
    splat_def(&def)->shape = SPLAT_PAPER;
    check("splat of the paper", &def, false);
    splat_def(&def)->shape = SPLAT_ELLIPSOID, splat_def(&def)->drops = true;
    check("ellipsoids", &def, false);
    def = view_of("splat");
    splat_def(&def)->filter = SPLAT_NARROW_RANGE;
    check("narrow range", &def, false);
    def = view_of("splat");
    splat_def(&def)->level = 0.12;
    check("a level", &def, false);
    def = view_of("splat");
    splat_def(&def)->shading = SPLAT_WATER;
    check("water of splats", &def, true);
}

static void of_volumes(void **state)
{
    (void)state;
    ViewDef def = view_of("volume");
    volume_def(&def)->raycast.jitter = false;
    volume_def(&def)->cells = 32;
    for (int look = RAYCAST_WATER; look <= RAYCAST_TRANSLUCENT; look++) {
        volume_def(&def)->raycast.look = (RaycastLook)look;
        check("volume", &def, true);
    }
    def = view_of("volume");
    volume_def(&def)->show = VOLUME_SLICE;
    volume_def(&def)->cells = 32;
    def.color_by = SCALAR_SPEED;
    check("slice of a volume", &def, false);
}

static void of_planes(void **state)
{
    (void)state;
    ViewDef def = view_of("slice");
    memcpy(slice_def(&def)->normal, (double[3]){0.3, 0.2, 1}, sizeof(double[3]));
    check("slice", &def, false);
    slice_def(&def)->particles = SLICE_BEHIND;
    check("slice before particles", &def, false);
}

/* Random points fall on different pixels in a wider picture: equal in number, not in pixels. */
static void of_points(void **state)
{
    (void)state;
    ViewDef def = view_of("pbsr");
    pbsr_def(&def)->repeat = 100;
    check("pbsr", &def, true);
}

static void of_overlays(void **state)
{
    (void)state;
    static const TrailsMethod by[] = {TRAILS_AUTO, TRAILS_QUADS};
    ViewDef def = view_of("none");
    def.color_by = SCALAR_SPEED;
    def.range_auto = false;
    def.range[1] = 3;
    for (int i = 0; i < 2; i++) {
        trails_def(&def)->show = true;
        trails_def(&def)->stride = 4;
        trails_def(&def)->width = 3;
        trails_def(&def)->by = by[i];
        check("trails", &def, false);
    }
    trails_def(&def)->show = false;
    glyphs_def(&def)->show = true;
    glyphs_def(&def)->at = GLYPHS_GRID;
    glyphs_def(&def)->cell = 0.2;
    check("glyphs", &def, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(of_balls, no_gl_errors),
        cmocka_unit_test_teardown(of_splats, no_gl_errors),
        cmocka_unit_test_teardown(of_volumes, no_gl_errors),
        cmocka_unit_test_teardown(of_planes, no_gl_errors),
        cmocka_unit_test_teardown(of_points, no_gl_errors),
        cmocka_unit_test_teardown(of_overlays, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
