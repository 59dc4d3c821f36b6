/* The life of foam: amounts by id from state to state, against exp(-t / FOAM_LIFE). */
#include "tests/render/fixture.h"

#include "render/water/foam_private.h"
#include "render/water/water.h"
#include "shaders/water/foam_bindings.h"

enum { MOST = 6000 };

typedef struct FoamState {
    size_t count;
    double time;
    float id[MOST], air[2 * MOST]; /* trapped air, and the share of old foam that is seen */
} FoamState;

static float amount[MOST]; /* of the last state, in its order */

static GLuint buffer_of(const float *values, size_t floats)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)(floats * sizeof *values), values, 0);
    return buffer;
}

/* All particles are fast; positions do not count. */
static void take(FoamLife *life, const FoamState *state, bool ids)
{
    static float fast[4 * MOST];
    for (size_t i = 0; i < sizeof fast / sizeof *fast; i++)
        fast[i] = 3;
    const GLuint places = buffer_of(fast, 4 * state->count), air = buffer_of(state->air, 2 * state->count),
                 id = buffer_of(state->id, state->count);
    ParticleBuffers buffers = {
        .count = state->count, .time = state->time, .spacing = 0.01, .box_size = {1, 1, 1}};
    buffers.position = buffers.velocity = (ParticleAttribute){places, 0, 16};
    buffers.scalar[SCALAR_TRAPPED_AIR] = (ParticleAttribute){air, 0, 8};
    if (ids)
        buffers.scalar[SCALAR_ID] = (ParticleAttribute){id, 0, 4};
    foam_life_recall(life, &buffers);
    foam_life_update(life, &buffers, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(life->amounts, 0, (GLsizeiptr)(state->count * sizeof *amount), amount);
    glDeleteBuffers(3, (GLuint[]){places, air, id});
}

static FoamLife created(void)
{
    Error error = {0};
    FoamLife life = {0};
    if (!foam_life_create(&life, &error))
        fail_msg("%s", error.message);
    return life;
}

/* Air from none to all, ids far apart as after an hour of an emitter, in no order. */
static FoamState first_state(void)
{
    static FoamState state;
    state = (FoamState){.count = 2000, .time = 0.3};
    for (size_t i = 0; i < state.count; i++) {
        state.id[i] = (float)(i * 7919 % state.count * 4096);
        state.air[2 * i] = (float)i / (float)state.count;
        state.air[2 * i + 1] = 1;
    }
    return state;
}

/* Another order and more particles: every second of before, and new ones; none makes foam. */
static FoamState later_state(const FoamState *first, double time)
{
    static FoamState state;
    state = (FoamState){.count = MOST, .time = time};
    for (size_t i = 0; i < state.count; i++) {
        const size_t old = first->count - 1 - i;
        state.id[i] = i < first->count && i % 2 ? first->id[old] : (float)(1 + i * 4096);
        state.air[2 * i + 1] = 1;
    }
    return state;
}

static void what_is_left_is_known_by_ids(void **unused)
{
    (void)unused;
    static float made[MOST];
    FoamLife life = created();
    const FoamState first = first_state(), later = later_state(&first, 1.0);
    take(&life, &first, true);
    memcpy(made, amount, sizeof made);
    assert_true(made[0] == 0 && made[first.count - 1] == 1);
    take(&life, &later, true);
    size_t foams = 0;
    for (size_t i = 0; i < later.count; i++) {
        const bool known = i < first.count && i % 2 && made[first.count - 1 - i] > FOAM_LEAST;
        const double left = known ? made[first.count - 1 - i] * exp(-0.7 / FOAM_LIFE) : 0;
        assert_true(fabs(amount[i] - (left > FOAM_LEAST ? left : 0)) < 1e-6);
        foams += known;
    }
    assert_true(foams > 500);
    memcpy(made, amount, sizeof made);
    take(&life, &later, true); /* time stands still */
    assert_memory_equal(made, amount, sizeof made);
    foam_life_destroy(&life);
}

static void check_sum(const char *what, const FoamState *state, double wanted)
{
    double sum = 0;
    for (size_t i = 0; i < state->count; i++)
        sum += amount[i];
    printf("%s: %.6g, wanted %.6g\n", what, sum, wanted);
    assert_true(fabs(sum - wanted) <= 1e-5 * wanted);
}

/* Steps of any length leave the same; new foam replaces less of old; time that goes back, and states without
   ids, have no past. */
static void the_past_ends(void **unused)
{
    (void)unused;
    FoamLife life = created();
    FoamState state = first_state();
    for (size_t i = 0; i < state.count; i++)
        state.air[2 * i] = i % 2 ? 9 : 0;
    const double half = (double)state.count / 2;
    take(&life, &state, true);
    check_sum("made", &state, half);
    for (size_t i = 0; i < state.count; i++)
        state.air[2 * i] = 0;
    for (int step = 1; step <= 10; step++) {
        state.time = 0.3 + 0.05 * step;
        take(&life, &state, true);
    }
    check_sum("half a second later", &state, half * exp(-0.5 / FOAM_LIFE));
    state.air[0] = state.air[2] = 9;
    take(&life, &state, true);
    check_sum("two make more", &state, 2 + (half - 1) * exp(-0.5 / FOAM_LIFE));
    take(&life, &state, false);
    check_sum("without ids", &state, 2);
    take(&life, &state, true);
    state.time = 0.79, state.air[0] = 0;
    take(&life, &state, true);
    check_sum("time back", &state, 1);
    state.time = 6, state.air[2] = 0;
    take(&life, &state, true);
    assert_true(amount[1] < FOAM_LEAST);
    foam_life_destroy(&life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_is_left_is_known_by_ids, no_gl_errors),
        cmocka_unit_test_teardown(the_past_ends, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
