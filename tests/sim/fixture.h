/* Small worlds for the solver's tests. */
#ifndef SLOSH_TEST_FIXTURE_H
#define SLOSH_TEST_FIXTURE_H

#include "tests/lists.h"

#include "sim/gpu/gl.h"
#include "sim/step/backend.h"
#include "sim/step/method.h"
#include "sim/world.h"

/* cmocka's needs */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The backend that the solver's tests run on: SLOSH_TEST_BACKEND, cpu without it. */
static inline const char *fixture_backend(void)
{
    const char *name = getenv("SLOSH_TEST_BACKEND");
    return name ? name : "cpu";
}

static inline bool fixture_on_cpu(void)
{
    return strcmp(fixture_backend(), "cpu") == 0;
}

/* The method of tests that name none: SLOSH_TEST_METHOD, mueller without it. */
static inline const char *fixture_method(void)
{
    const char *name = getenv("SLOSH_TEST_METHOD");
    return name ? name : "mueller";
}

/* Whether the method of a def has no sound: then what rests is not pressed. */
static inline bool fixture_incompressible(const WorldDef *def)
{
    return method_find(def->method)->incompressible;
}

static inline bool fixture_fine(void)
{
    return fixture_on_cpu() && strcmp(fixture_method(), "mueller") == 0;
}

/* How many: particles, steps; fewer on a GPU, which may be a software renderer, and with a method whose steps
   take longer. */
static inline int fixture_count(int many, int few)
{
    return fixture_fine() ? many : few;
}

/* How large: spacings, steps, bounds; coarser then. */
static inline double fixture_coarse(double fine, double coarse)
{
    return fixture_fine() ? fine : coarse;
}

/* Ends a test of what only the CPU has, or that no backend changes. */
static inline void fixture_needs_cpu(const char *what)
{
    if (fixture_on_cpu())
        return;
    printf("skipped on %s: %s\n", fixture_backend(), what);
    skip();
}

static inline bool fixture_on_fragment(void)
{
    return strcmp(fixture_backend(), "fragment") == 0;
}

/* Ends a test of what backend fragment refuses, all but mueller with viscosity, walls and a moving box. */
static inline void fixture_needs(const char *term)
{
    if (!fixture_on_fragment())
        return;
    printf("skipped: backend fragment has no %s\n", term);
    skip();
}

/* All methods, and how many of the list, from the first, the backend supports: for tests over all
   methods. */
static const char *const fixture_method_names[]
    __attribute__((unused)) = {"mueller", "wcsph", "dfsph", "pbf"};

static inline int fixture_methods(void)
{
    return fixture_on_fragment() ? 1 : fixture_on_cpu() ? 4 : 2;
}

/* Ends a test that is of mueller's sums or of its pressure. */
static inline void fixture_needs_mueller(const char *what)
{
    if (strcmp(fixture_method(), "mueller") == 0)
        return;
    printf("skipped with %s: %s\n", fixture_method(), what);
    skip();
}

/* A box of that size with one inviscid fluid of density 1000 and no fill; spacing 0.1 m, and no sentinel. */
static inline WorldDef fixture_def(double width, double height, double depth)
{
    WorldDef def = world_def_default();
    def.box_size[0] = width;
    def.box_size[1] = height;
    def.box_size[2] = depth;
    def.spacing = 0.1;
    def.fluid_count = 1;
    def.fluids[0] = (FluidDef){.name = "water", .density = 1000};
    def.dt = 0.002;
    def.substeps = 1;
    def.retries = 0; /* tests the effect of a step */
    def.reproducible = true;
    snprintf(def.backend, sizeof def.backend, "%s", fixture_backend());
    snprintf(def.method, sizeof def.method, "%s", fixture_method());
    return def;
}

/* Layers of fragment's grid, where that is the backend. */
static inline void fixture_layers(WorldDef *def, int layers)
{
    if (fixture_on_fragment())
        ((FragmentDef *)backend_def(def, backend_find("fragment")))->grid_layers = layers;
}

static inline void fixture_block(WorldDef *def, int fluid, double x0, double y0, double z0, double x1,
                                 double y1, double z1)
{
    FluidDef *f = &def->fluids[fluid];
    add_fill(f, (Fill){.kind = FILL_BLOCK, .min = {x0, y0, z0}, .max = {x1, y1, z1}});
}

/* Fails the test with the reason when the world can't be made. */
static inline World *fixture_world(const WorldDef *def)
{
    Error error = {0};
    World *world = world_create(def, &error);
    if (!world)
        fail_msg("%s", error.message);
    return world;
}

static inline void fixture_step(World *world, int frames)
{
    Error error = {0};
    for (int i = 0; i < frames; i++)
        if (!world_step(world, NULL, &error))
            fail_msg("%s", error.message);
}

/* All that world_read gives, ordered by id; free with fixture_free. */
typedef struct State {
    size_t count;
    float *position, *velocity, *density, *pressure; /* 4, 4, 1, 1 a particle */
    uint32_t *fluid;
} State;

static inline void fixture_order(float *values, const uint32_t *id, size_t count, size_t width)
{
    float *ordered = malloc(count * width * sizeof *ordered);
    for (size_t i = 0; i < count; i++)
        memcpy(ordered + id[i] * width, values + i * width, width * sizeof *ordered);
    memcpy(values, ordered, count * width * sizeof *ordered);
    free(ordered);
}

static inline State fixture_read(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    const size_t n = info.count;
    State s = {n, malloc(16 * n), malloc(16 * n), malloc(4 * n), malloc(4 * n), malloc(4 * n)};
    uint32_t *id = malloc(4 * n);
    ParticleArrays out = {.position = s.position, .velocity = s.velocity, .fluid = s.fluid, .id = id};
    out.scalar[SCALAR_DENSITY] = s.density;
    out.scalar[SCALAR_PRESSURE] = s.pressure;
    world_read(world, &out);
    fixture_order(s.position, id, n, 4);
    fixture_order(s.velocity, id, n, 4);
    fixture_order(s.density, id, n, 1);
    fixture_order(s.pressure, id, n, 1);
    fixture_order((float *)s.fluid, id, n, 1); /* only bits move */
    free(id);
    return s;
}

static inline void fixture_free(State *s)
{
    free(s->position);
    free(s->velocity);
    free(s->density);
    free(s->pressure);
    free(s->fluid);
}

/* A fixed sequence of numbers in [0, 1). */
static inline double fixture_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

#endif
