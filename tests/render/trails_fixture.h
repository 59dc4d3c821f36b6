/* Particles with ids, moving by a rule, state by state, in a new order each time. */
#ifndef SLOSH_TRAILS_FIXTURE_H
#define SLOSH_TRAILS_FIXTURE_H

#include "tests/render/fixture.h"

#include "render/overlays/trails/trails_private.h"

enum { MOVERS_MAX = 4096 };

typedef struct Movers {
    size_t count;
    float position[4 * MOVERS_MAX], value[MOVERS_MAX];
    uint32_t id[MOVERS_MAX], fluid[MOVERS_MAX];
    ParticleBuffers state; /* but for the attributes */
    Upload *upload;
} Movers;

static inline Movers *movers_create(void)
{
    Error error = {0};
    Movers *movers = calloc(1, sizeof *movers);
    assert_non_null(movers);
    movers->state = box_state(0, 0.05);
    movers->upload =
        upload_create(MOVERS_MAX, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_ID, &error);
    assert_non_null(movers->upload);
    return movers;
}

static inline void movers_destroy(Movers *movers)
{
    upload_destroy(movers->upload);
    free(movers);
}

static inline void movers_clear(Movers *movers)
{
    movers->count = 0;
}

static inline void movers_add(Movers *movers, uint32_t id, double x, double y, double z, double value)
{
    float *at = &movers->position[4 * movers->count];
    assert_true(movers->count < MOVERS_MAX);
    at[0] = (float)x, at[1] = (float)y, at[2] = (float)z, at[3] = 1e-6F;
    movers->value[movers->count] = (float)value;
    movers->id[movers->count++] = id;
}

/* The added particles as the state of the time. */
static inline ParticleBuffers movers_upload(Movers *movers, double time)
{
    Error error = {0};
    ParticleBuffers out;
    ParticleArrays arrays = {.position = movers->position, .id = movers->id, .fluid = movers->fluid};
    arrays.scalar[SCALAR_SPEED] = movers->value;
    movers->state.count = movers->count;
    movers->state.time = time;
    movers->state.step++;
    assert_true(upload_write_arrays(movers->upload, &arrays, &movers->state, &error));
    assert_true(upload_take(movers->upload, &out));
    return out;
}

/* A view of trails alone: each particle has one. */
static inline ViewDef trails_view(void)
{
    ViewDef def = bare_view();
    text_set(def.kind, "none");
    def.range_auto = false;
    def.range[0] = 0, def.range[1] = 1;
    trails_def(&def)->show = true;
    trails_def(&def)->stride = 1;
    trails_def(&def)->every = 0.005;
    return def;
}

#endif
