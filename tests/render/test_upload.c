/* The ring of slots: what is written is what the GPU reads, round and round, without touching what is still
 * drawn. */
#include "render/particles/particles.h"
#include "sim/world.h"
#include "tests/lists.h"
#include "tests/render/fixture.h"

#include <epoxy/gl.h>

enum { COUNT = 1000 };

/* State number `number`: values that identify the state. */
static void fill(Particles *particles, int number)
{
    particles->count = 0;
    for (int i = 0; i < COUNT; i++)
        particles_add(particles, i, number, -i, number + i * 0.001, (unsigned)(number + i) % 3);
}

static ParticleArrays arrays_of(Particles *particles)
{
    ParticleArrays arrays = {.position = particles->position, .fluid = particles->fluid};
    arrays.scalar[SCALAR_SPEED] = particles->speed;
    return arrays;
}

static void assert_on_gpu(const ParticleAttribute *attribute, const void *wanted, size_t size)
{
    static char bytes[16 * COUNT];
    assert_true(attribute->buffer != 0);
    assert_int_equal(attribute->offset % 256, 0);
    assert_int_equal(attribute->stride, size / COUNT);
    glGetNamedBufferSubData(attribute->buffer, (GLintptr)attribute->offset, (GLsizeiptr)size, bytes);
    assert_memory_equal(bytes, wanted, size);
}

/* From the slots, or from the GPU's own memory. */
static void more_states_than_slots(bool copies)
{
    enum { STATES = 3 * SLOTS + 1 };
    Error error = {0};
    Particles *particles = calloc(1, sizeof *particles);
    Upload *upload = upload_create(COUNT, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID, &error);
    GLuint first = 0;
    assert_true(upload_set_copies(upload, copies, &error));
    for (int number = 0; number < STATES; number++) {
        ParticleBuffers box = box_state(COUNT, 0.1), buffers;
        fill(particles, number);
        ParticleArrays arrays = arrays_of(particles);
        assert_true(upload_write_arrays(upload, &arrays, &box, &error));
        assert_true(upload_take(upload, &buffers));
        first = number == 0 ? buffers.position.buffer : first;
        assert_true(number != 1 || (buffers.position.buffer == first) == copies);
        assert_on_gpu(&buffers.position, particles->position, 16 * COUNT);
        assert_on_gpu(&buffers.fluid, particles->fluid, 4 * COUNT);
        assert_on_gpu(&buffers.scalar[SCALAR_SPEED], particles->speed, 4 * COUNT);
        assert_int_equal(buffers.velocity.buffer, 0); /* not asked for */
        assert_int_equal(buffers.scalar[SCALAR_DENSITY].buffer, 0);
    }
    upload_destroy(upload);
    free(particles);
}

static void test_more_states_than_slots(void **state)
{
    (void)state;
    more_states_than_slots(false);
    more_states_than_slots(true);
}

/* What is drawn stays whole, however many states are written meanwhile, and the newest comes next. */
static void test_drawn_state_stays(void **state)
{
    (void)state;
    Error error = {0};
    Particles *particles = calloc(1, sizeof *particles);
    Upload *upload = upload_create(COUNT, PARTICLE_SCALAR(SCALAR_SPEED), &error);
    ParticleBuffers box = box_state(COUNT, 0.1), drawn, before, again;
    assert_true(upload_set_copies(upload, false, &error));
    assert_false(upload_take(upload, &drawn));
    for (int number = 0; number < 40; number++) {
        fill(particles, number);
        ParticleArrays arrays = arrays_of(particles);
        box.step = (uint64_t)number;
        assert_true(upload_write_arrays(upload, &arrays, &box, &error));
        assert_true(upload_has_new(upload));
        if (number % 7 == 0) {
            before = drawn;
            assert_true(upload_take(upload, &drawn));
            assert_false(upload_has_new(upload));
            assert_int_equal(drawn.step, number);
        }
        assert_true(upload_has_new(upload) || upload_take(upload, &again));
        fill(particles, number - number % 7);
        assert_on_gpu(&drawn.position, particles->position, 16 * COUNT);
        if (number >= 7) { /* in flight */
            fill(particles, number - number % 7 - 7);
            assert_on_gpu(&before.position, particles->position, 16 * COUNT);
        }
    }
    upload_destroy(upload);
    free(particles);
}

static void test_too_many(void **state)
{
    (void)state;
    Error error = {0};
    Particles *particles = calloc(1, sizeof *particles);
    Upload *upload = upload_create(COUNT - 1, 0, &error);
    ParticleBuffers box = box_state(COUNT, 0.1);
    fill(particles, 0);
    ParticleArrays arrays = arrays_of(particles);
    assert_false(upload_write_arrays(upload, &arrays, &box, &error));
    assert_non_null(strstr(error.message, "999"));
    upload_destroy(upload);
    upload_destroy(NULL);
    free(particles);
}

/* A world's state goes the same way, with its pose and time. */
static void test_world(void **state)
{
    (void)state;
    Error error = {0};
    float position[6] = {0, 0.2F, 0, 0.1F, 0.3F, 0.1F}, seen[8];
    InitialState initial = {.count = 2, .position = position};
    WorldDef def = world_def_default();
    memcpy(def.box_size, (double[3]){1, 1, 1}, sizeof def.box_size);
    def.spacing = 0.05;
    def.initial = &initial;
    def.fluid_count = 1;
    def.fluids[0] = (FluidDef){.name = "water", .density = 1000, .viscosity = 0.1};
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.1, .frequency = 1});
    World *world = world_create(&def, &error);
    if (!world)
        fail_msg("%s", error.message);
    Upload *upload = upload_create(2, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_ID, &error);
    ParticleBuffers buffers;
    assert_true(world_step(world, NULL, &error));
    assert_true(upload_write(upload, world, &error));
    assert_true(upload_take(upload, &buffers));
    WorldInfo info;
    world_info(world, &info);
    assert_int_equal(buffers.count, 2);
    assert_memory_equal(&buffers.box, &info.box, sizeof info.box);
    assert_true(buffers.box.position[0] != 0 && buffers.time == info.time && buffers.spacing == 0.05);
    float read[8];
    world_read(world, &(ParticleArrays){.position = read});
    glGetNamedBufferSubData(buffers.position.buffer, (GLintptr)buffers.position.offset, sizeof seen, seen);
    assert_memory_equal(seen, read, sizeof seen);
    upload_destroy(upload);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_more_states_than_slots, no_gl_errors),
        cmocka_unit_test_teardown(test_drawn_state_stays, no_gl_errors),
        cmocka_unit_test_teardown(test_too_many, no_gl_errors),
        cmocka_unit_test_teardown(test_world, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
