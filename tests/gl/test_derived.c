/* Derived scalars and vectors in a GPU backend's buffers, against uploads of the same state: a single
   formula for all sources, orders and strides. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "render/particles/particles.h"

/* Except for scalars of missing columns. */
#define ALL_SCALARS (SCALAR_BIT(SCALAR_COUNT) - 1 - SCALAR_BIT(SCALAR_ACCELERATION))
#define ALL_VECTORS                                                                                          \
    (VECTOR_BIT(VECTOR_COUNT) - 1 - VECTOR_BIT(VECTOR_ACCELERATION) - VECTOR_BIT(VECTOR_FRICTION_BEFORE))
static const ParticleWants everything = {
    .scalars = ALL_SCALARS, .vectors = ALL_VECTORS, .attributes = PARTICLE_ID};

static bool emits(const char *backend)
{
    return strcmp(backend, "fragment") != 0;
}

static WorldDef tank(const char *backend)
{
    WorldDef def = fixture_def(0.4, 0.6, 0.4);
    def.spacing = 0.04;
    def.sound_speed = 20;
    def.dt = 0.002;
    def.substeps = 2;
    *world_threads(&def) = 1;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    fixture_block(&def, 0, -0.2, 0, -0.2, 0, 0.4, 0.2);
    if (emits(backend)) {
        def.most = 5000;
        add_emit(&def.fluids[0], (Emit){.centre = {0.05, 0.5, 0},
                                        .direction = {0, -1, 0},
                                        .radius = 0.05,
                                        .speed = 2,
                                        .start = 0.01});
    }
    add_motion(&def, (Motion){.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 2});
    return def;
}

/* Of the derived ones and pressure, each ordered by id, and the range of each. */
typedef struct Values {
    float *of[SCALAR_COUNT + VECTOR_COUNT];
    ScalarRange range[SCALAR_COUNT];
} Values;

static float *read_ordered(const ParticleAttribute *from, const uint32_t *id, size_t count)
{
    const size_t width = from->stride / 4;
    float *values = malloc(count * from->stride);
    assert_true(values && from->buffer);
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride), values);
    if (id)
        fixture_order(values, id, count, width);
    return values;
}

static Values derive(ParticleBuffers *particles)
{
    Values values = {0};
    const DerivedSpace space = {.flat = false};
    Error error = {0};
    Derived derived = {0};
    Ranges ranges = {0};
    const size_t count = particles->count;
    if (!derived_update(&derived, &everything, &error) || !ranges_create(&ranges, &error))
        fail_msg("%s", error.message);
    derived_fill(&derived, &everything, &space, particles);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    uint32_t *id = particles->id.buffer ? malloc(4 * count) : NULL;
    if (id)
        glGetNamedBufferSubData(particles->id.buffer, (GLintptr)particles->id.offset, (GLsizeiptr)(4 * count),
                                id);
    for (int s = SCALAR_BORN; s < SCALAR_COUNT; s++) {
        if (!(ALL_SCALARS & SCALAR_BIT(s)))
            continue;
        values.of[s] = read_ordered(&particles->scalar[s], id, count);
        values.range[s] = ranges_find(&ranges, &particles->scalar[s], count);
    }
    for (int v = 0; v < VECTOR_COUNT; v++)
        if (ALL_VECTORS & VECTOR_BIT(v))
            values.of[SCALAR_COUNT + v] = read_ordered(&particles->vector[v], id, count);
    free(id);
    ranges_destroy(&ranges);
    derived_destroy(&derived);
    return values;
}

static void free_values(Values *values)
{
    for (int k = 0; k < SCALAR_COUNT + VECTOR_COUNT; k++)
        free(values->of[k]);
}

static float *born_ordered(World *world, size_t count)
{
    float *born = malloc(count * sizeof *born);
    uint32_t *id = malloc(count * sizeof *id);
    ParticleArrays out = {.id = id};
    out.scalar[SCALAR_BORN] = born;
    assert_true(world_read(world, &out));
    fixture_order(born, id, count, 1);
    free(id);
    return born;
}

/* Of the state as it was read, in the order of ids. */
static Values of_uploaded(World *world)
{
    Error error = {0};
    WorldInfo info = info_of(world);
    ParticleBuffers box, particles;
    State read = fixture_read(world);
    ParticleArrays arrays = {.position = read.position, .velocity = read.velocity};
    arrays.scalar[SCALAR_DENSITY] = read.density;
    arrays.scalar[SCALAR_PRESSURE] = read.pressure;
    arrays.scalar[SCALAR_BORN] = born_ordered(world, read.count);
    particle_buffers_describe(&info, &box);
    Upload *upload = upload_create(read.count,
                                   PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_DENSITY) |
                                       PARTICLE_SCALAR(SCALAR_PRESSURE) | PARTICLE_SCALAR(SCALAR_BORN),
                                   &error);
    assert_true(upload && upload_write_arrays(upload, &arrays, &box, &error) &&
                upload_take(upload, &particles));
    Values values = derive(&particles);
    upload_destroy(upload);
    fixture_free(&read);
    free(arrays.scalar[SCALAR_BORN]);
    return values;
}

static void compare(const char *name, const float *one, const float *other, size_t count, size_t width)
{
    double most = 0, apart = 0;
    for (size_t i = 0; i < count * width; i++)
        if (width == 1 || i % 4 < 3) {
            most = fmax(most, fabs((double)one[i]));
            apart = fmax(apart, fabs((double)one[i] - (double)other[i]));
        }
    printf("%s: %.3g of %.3g apart\n", name, apart, most);
    assert_true(most > 0 && apart <= 2e-6 * most);
}

static void any_source_has_the_same(void **state)
{
    const WorldDef def = tank(*state);
    World *world = fixture_world(&def);
    ParticleBuffers shared;
    fixture_step(world, 40);
    Values uploaded = of_uploaded(world);
    world_share(world, particle_wants_attributes(&everything), &shared);
    const size_t count = shared.count;
    Values here = derive(&shared);
    assert_true(!emits(*state) || (here.range[SCALAR_AGE].least < 0.02 && info_of(world).emitted > 10));
    assert_true(fabs(here.range[SCALAR_AGE].greatest - info_of(world).time) < 1e-6);
    for (int s = emits(*state) ? SCALAR_BORN : SCALAR_STATE_COUNT; s < SCALAR_COUNT; s++) {
        if (!here.of[s])
            continue;
        compare(scalar_list[s].name, here.of[s], uploaded.of[s], count, 1);
        const ScalarRange a = here.range[s], b = uploaded.range[s];
        assert_true(fabs(a.low - b.low) + fabs(a.high - b.high) <= 4e-6 * (b.greatest - b.least));
    }
    for (int v = 0; v < VECTOR_COUNT; v++)
        if (here.of[SCALAR_COUNT + v])
            compare(vector_list[v].name, here.of[SCALAR_COUNT + v], uploaded.of[SCALAR_COUNT + v], count, 4);
    free_values(&here);
    free_values(&uploaded);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate_setup_teardown(any_source_has_the_same, NULL, no_gl_errors, "compute"),
        cmocka_unit_test_prestate_setup_teardown(any_source_has_the_same, NULL, no_gl_errors, "fragment"),
    };
    return cmocka_run_group_tests(tests, compare_setup, context_teardown);
}
