/* What the render tests share: a context, and fixed particles without a solver. */
#ifndef SLOSH_RENDER_FIXTURE_H
#define SLOSH_RENDER_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "app/run/offscreen.h"
#include "render/particles/particles.h"
#include "render/renderer.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"
#include "tests/gl/draw_check.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static __attribute__((unused)) Headless *test_context;

/* If the environment requests a different renderer than the present, tests are skipped (ctest: skipped). */
static inline void expect_renderer(void)
{
    const char *wanted = getenv("SLOSH_TEST_RENDERER"),
               *name = test_context ? headless_renderer(test_context) : "none";
    if (!wanted || strstr(name, wanted))
        return;
    printf("skipped: this is for the renderer %s, which does not start here; there is %s\n", wanted, name);
    exit(77);
}

static inline int context_setup(void **state)
{
    (void)state;
    Error error = {0};
    test_context = headless_create(HEADLESS_GPU_AUTO, &error);
    expect_renderer();
    if (!test_context) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    gl_context_begin();
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); /* a message belongs to the test that made the error */
    draw_check_set(true);
    return 0;
}

static inline int context_teardown(void **state)
{
    (void)state;
    headless_destroy(test_context);
    return 0;
}

/* After each test. */
static inline int no_gl_errors(void **state)
{
    (void)state;
    return gl_debug_errors() + draw_check_complaints;
}

static inline unsigned texel(unsigned format, unsigned unit)
{
    unsigned texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, 1, 1);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glBindTextureUnit(unit, texture);
    return texture;
}

/* The renderer's bindings for a view drawn by a test without a renderer: empty shadows. Returns the light
   on the floor, zero. */
static inline unsigned no_shadows(void)
{
    static unsigned fluid, solid, floor_light;
    static const float nothing = 0;
    if (!fluid) {
        fluid = texel(GL_DEPTH_COMPONENT32F, SHADOW_UNIT);
        solid = texel(GL_DEPTH_COMPONENT32F, SOLID_SHADOW_UNIT);
        floor_light = texel(GL_R32F, FLOOR_LIGHT_UNIT);
        glClearTexImage(fluid, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
        glClearTexImage(solid, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
        glClearTexImage(floor_light, 0, GL_RED, GL_FLOAT, &nothing);
        glTextureParameteri(solid, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTextureParameteri(solid, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    }
    glBindTextureUnit(SHADOW_UNIT, fluid);
    glBindTextureUnit(SOLID_SHADOW_UNIT, solid);
    return floor_light;
}

enum { PARTICLES_MAX = 20000 };

typedef struct Particles {
    size_t count;
    float position[4 * PARTICLES_MAX];
    float speed[PARTICLES_MAX];
    uint32_t fluid[PARTICLES_MAX];
} Particles;

static inline void particles_add(Particles *particles, double x, double y, double z, double speed,
                                 unsigned fluid)
{
    float *to = &particles->position[4 * particles->count];
    assert_true(particles->count < PARTICLES_MAX);
    to[0] = (float)x, to[1] = (float)y, to[2] = (float)z, to[3] = 1;
    particles->speed[particles->count] = (float)speed;
    particles->fluid[particles->count++] = fluid;
}

/* A box 2 x 1 x 1 m with a wave in it, `spacing` apart, and a ball of the second fluid above. */
static inline Particles *particles_wave(double spacing)
{
    Particles *particles = calloc(1, sizeof *particles);
    int n = (int)(1 / spacing), ball = (int)(0.2 / spacing);
    assert_non_null(particles);
    for (int i = 0; i < 2 * n; i++)
        for (int k = 0; k < n; k++)
            for (int j = 0; j < n; j++) {
                double x = -1 + (i + 0.5) * spacing, y = (j + 0.5) * spacing, z = -0.5 + (k + 0.5) * spacing;
                if (y < 0.34 + 0.16 * cos(2.5 * (x + 1)) + 0.05 * sin(5 * z + x))
                    particles_add(particles, x, y, z, 1 + x + y, 0);
            }
    for (int i = -ball; i <= ball; i++)
        for (int j = -ball; j <= ball; j++)
            for (int k = -ball; k <= ball; k++)
                if (i * i + j * j + k * k <= ball * ball + 1)
                    particles_add(particles, 0.35 + i * spacing, 0.68 + j * spacing, k * spacing, 2.5, 1);
    return particles;
}

/* Removes particles with centres inside a solid, or nearer to a solid than half a spacing. */
static inline void particles_spare(Particles *particles, const WorldDef *world, double spacing)
{
    size_t count = particles->count;
    particles->count = 0;
    for (size_t i = 0; i < count; i++) {
        const float *at = &particles->position[4 * i];
        bool outside = true;
        for (int k = 0; outside && k < world->solid_count; k++) {
            BoxState pose;
            double x[3] = {at[0], at[1], at[2]};
            solid_pose(&world->solids[k], 0, &pose);
            for (int axis = 0; axis < 3; axis++)
                x[axis] -= pose.position[axis];
            quat_rotate_inverse(pose.orientation, x, x);
            outside = solid_distance(&world->solids[k], 3, x) > spacing / 2;
        }
        if (outside)
            particles_add(particles, at[0], at[1], at[2], particles->speed[i], particles->fluid[i]);
    }
}

static inline void text_set(char name[NAME_SIZE], const char *text)
{
    snprintf(name, NAME_SIZE, "%s", text);
}

/* A picture's def that leaves the view alone: no legend, box or floor. */
static inline ViewDef bare_view(void)
{
    ViewDef def = view_def_default();
    def.legend = def.box = def.floor = false;
    snprintf(def.colormap, sizeof def.colormap, "viridis"); /* with colours known to tests */
    splat_def(&def)->drops = false;
    splat_def(&def)->shape = SPLAT_PERSPECTIVE, splat_def(&def)->filter = SPLAT_NO_FILTER;
    return def;
}

/* A world of two fluids. */
static inline WorldDef bare_world(void)
{
    WorldDef world = {0};
    world.fluid_count = 2;
    text_set(world.fluids[0].name, "water");
    text_set(world.fluids[1].name, "oil");
    memcpy(world.fluids[0].color, (float[3]){0.03F, 0.22F, 0.55F}, sizeof world.fluids[0].color);
    memcpy(world.fluids[1].color, (float[3]){0.85F, 0.45F, 0.05F}, sizeof world.fluids[1].color);
    return world;
}

static inline ParticleBuffers box_state(size_t count, double spacing)
{
    return (ParticleBuffers){.count = count,
                             .spacing = spacing,
                             .support_radius = 2.1 * spacing,
                             .box_size = {2, 1, 1},
                             .box = {.orientation = {0, 0, 0, 1}},
                             .time = 1.25};
}

static inline Upload *upload_particles(const Particles *particles, const ParticleBuffers *state,
                                       ParticleBuffers *out)
{
    Error error = {0};
    Upload *upload = upload_create(particles->count, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID, &error);
    ParticleArrays arrays = {.position = (float *)particles->position, .fluid = (uint32_t *)particles->fluid};
    arrays.scalar[SCALAR_SPEED] = (float *)particles->speed;
    assert_non_null(upload);
    assert_true(upload_write_arrays(upload, &arrays, state, &error));
    assert_true(upload_take(upload, out));
    return upload;
}

/* Hardware snaps corners to 1/256 of a pixel, with all interpolated values. Returns the offset of the
   k-th of four neighbouring pictures, in pixels. The bounds of a value grow by the differences. */
enum { SNAP_PLACES = 4 };

static inline bool snaps(void)
{
    return !gl_renderer_is_software();
}

static inline void snap_place(int k, double by[2])
{
    const double far = 1.0 / 128;
    by[0] = (k & 1) ? far : -far;
    by[1] = (k & 2) ? far : -far;
}

#endif
