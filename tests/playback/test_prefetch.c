/* A recorded file read for pictures: requested steps are shown, read ahead of the view, in bounded
   memory. */
#include "tests/patience.h"
#include "tests/playback/recorded_fixture.h"

#include "app/run/playback/playback.h"
#include "sim/world.h"

#include <epoxy/gl.h>
#include <hdf5.h>

enum { STEPS = 60 };

static Error error;

/* Steps 0.1 s apart, of 1 + k particles. */
static Prefetch *open_prefetch(size_t bytes)
{
    size_t counts[STEPS];
    Recorded recorded;
    for (size_t k = 0; k < STEPS; k++)
        counts[k] = 1 + k;
    write_file("a.h5part", counts, STEPS, 0.1);
    open_recorded(&recorded, "a.h5part", NULL);
    Prefetch *prefetch =
        prefetch_create(&(PrefetchSetup){.recorded = &recorded, .attributes = ~0U, .bytes = bytes}, &error);
    must(prefetch, &error);
    assert_null(recorded.reader); /* taken over */
    return prefetch;
}

/* That step is on the GPU. */
static void assert_shown(Prefetch *prefetch, size_t index, const PrefetchStatus *status)
{
    ParticleBuffers particles;
    assert_true(status->answered && !status->failed);
    assert_int_equal(status->index, index);
    assert_true(fabs(status->time - 0.1 * (double)index) < 1e-9);
    assert_true(prefetch_take(prefetch, &particles));
    assert_int_equal(particles.count, index + 1);
    assert_true(fabs(particles.time - 0.1 * (double)index) < 1e-9);
    float place[4];
    glGetNamedBufferSubData(particles.position.buffer,
                            (GLintptr)(particles.position.offset + index * particles.position.stride),
                            sizeof place, place);
    const double wanted = 0.9 * (double)(index + 1) / (double)(index + 2) - 0.45;
    assert_true(fabs((double)place[0] - wanted) < 1e-6);
}

static void assert_seek(Prefetch *prefetch, double time, double lead, size_t index)
{
    PrefetchStatus status;
    prefetch_seek(prefetch, time, lead);
    must(prefetch_wait(prefetch, &status, &error), &error);
    assert_shown(prefetch, index, &status);
}

/* Forwards, backwards, and anywhere; steps grow, so that the room on the GPU must. */
static void what_is_asked_for_is_shown(void **state)
{
    (void)state;
    Prefetch *prefetch = open_prefetch(1U << 20);
    for (size_t k = 0; k < STEPS; k++)
        assert_seek(prefetch, 0.1 * (double)k, 0.1, k);
    for (size_t k = STEPS; k-- > 0;)
        assert_seek(prefetch, 0.1 * (double)k + 0.05, -0.1, k);
    for (size_t k = 0; k < 200; k++)
        assert_seek(prefetch, 0.1 * (double)(k * 7919 % STEPS), 0, k * 7919 % STEPS);
    assert_seek(prefetch, -5, 0, 0);
    assert_seek(prefetch, 1e9, 0, STEPS - 1);
    prefetch_destroy(prefetch);
}

static void neighbours_are_known(void **state)
{
    (void)state;
    PrefetchStatus status;
    Prefetch *prefetch = open_prefetch(1U << 20);
    assert_false(prefetch_has_new(prefetch));
    prefetch_seek(prefetch, 0, 0);
    must(prefetch_wait(prefetch, &status, &error), &error);
    assert_true(prefetch_has_new(prefetch));
    assert_true(status.steps == STEPS && status.first == 0 && fabs(status.last - 5.9) < 1e-9);
    assert_true(status.before == 0 && fabs(status.after - 0.1) < 1e-9);
    for (size_t k = 1; k < STEPS; k++) { /* a step on */
        prefetch_seek(prefetch, status.after, 0);
        must(prefetch_wait(prefetch, &status, &error), &error);
        assert_shown(prefetch, k, &status);
        assert_true(fabs(status.before - 0.1 * (double)(k - 1)) < 1e-9);
    }
    assert_true(status.after == status.time);
    prefetch_destroy(prefetch);
}

static bool has_read(Prefetch *prefetch, size_t count, PrefetchStatus *status)
{
    const double until = wall_ms() + PATIENCE_MS;
    do {
        must(prefetch_status(prefetch, status, &error), &error);
        usleep(1000);
    } while (status->read < count && wall_ms() < until);
    return status->read >= count;
}

/* Steps that were read when for a while no more are. From call to call there are no more than places. */
static size_t read_in_the_end(Prefetch *prefetch)
{
    PrefetchStatus status;
    must(prefetch_status(prefetch, &status, &error), &error);
    const size_t before = status.read;
    for (int calm = 0; calm < 4; calm++) {
        const size_t read = status.read;
        usleep(50000);
        must(prefetch_status(prefetch, &status, &error), &error);
        assert_true(status.read <= before + PREFETCH_CACHE_MOST);
        calm = status.read == read ? calm : -1;
    }
    return status.read;
}

static void steps_are_read_ahead(void **state)
{
    (void)state;
    PrefetchStatus status;
    Prefetch *prefetch = open_prefetch(1U << 20);
    assert_seek(prefetch, 0, 0.1, 0);
    assert_true(has_read(prefetch, 1 + PREFETCH_CACHE_MOST - 2, &status));
    assert_int_equal(status.found, 0);
    for (size_t k = 1; k < PREFETCH_CACHE_MOST - 2; k++)
        assert_seek(prefetch, 0.1 * (double)k, 0.1, k);
    must(prefetch_status(prefetch, &status, &error), &error);
    assert_int_equal(status.found, PREFETCH_CACHE_MOST - 3);           /* none was waited for */
    assert_true(read_in_the_end(prefetch) <= 2 * PREFETCH_CACHE_MOST); /* and none twice */
    prefetch_destroy(prefetch);
}

/* With changing strides the cache stays: no step is read again and again. */
static void reading_ahead_comes_to_an_end(void **state)
{
    (void)state;
    Prefetch *prefetch = open_prefetch(1U << 20);
    static const double leads[] = {0.1, 0.5, -0.3, 0.2, -0.1, 1.1};
    for (size_t k = 0; k < sizeof leads / sizeof *leads; k++) {
        assert_seek(prefetch, 3, leads[k], 30);
        read_in_the_end(prefetch);
    }
    assert_seek(prefetch, 0, 0.1, 0); /* all cached steps are nearer than the next wanted step */
    read_in_the_end(prefetch);
    assert_seek(prefetch, 0, 1, 0);
    read_in_the_end(prefetch);
    prefetch_destroy(prefetch);
}

/* The memory bounds what is kept, whatever the file's size. */
static void few_steps_are_kept(void **state)
{
    (void)state;
    PrefetchStatus status;
    Prefetch *prefetch = open_prefetch(0);
    for (size_t k = 0; k < STEPS; k++)
        assert_seek(prefetch, 0.1 * (double)k, 0.1, k);
    must(prefetch_status(prefetch, &status, &error), &error);
    assert_int_equal(status.cached_most, PREFETCH_CACHE_LEAST);
    prefetch_destroy(prefetch);
    prefetch = open_prefetch(64U << 10); /* fewer with growth */
    assert_seek(prefetch, 0, 0, 0);
    must(prefetch_status(prefetch, &status, &error), &error);
    const size_t many = status.cached_most;
    assert_seek(prefetch, 5.9, 0, STEPS - 1);
    must(prefetch_status(prefetch, &status, &error), &error);
    assert_true(status.cached_most < many && status.cached_most >= PREFETCH_CACHE_LEAST);
    prefetch_destroy(prefetch);
}

static void a_step_that_cannot_be_read(void **state)
{
    (void)state;
    PrefetchStatus status;
    Recorded recorded;
    write_file("a.h5part", (const size_t[]){1, 2, 3}, 3, 0.1);
    const hid_t file = H5Fopen("a.h5part", H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, "Step#1/y", H5P_DEFAULT) >= 0);
    H5Fclose(file);
    open_recorded(&recorded, "a.h5part", NULL);
    Prefetch *prefetch = prefetch_create(&(PrefetchSetup){.recorded = &recorded, .attributes = ~0U}, &error);
    assert_seek(prefetch, 0, 0.1, 0);
    prefetch_seek(prefetch, 0.1, 0.1);
    assert_false(prefetch_wait(prefetch, &status, &error));
    assert_string_equal(error.message, "a.h5part: Step#1: 'y' is missing or of another length");
    assert_true(status.failed && status.index == 0);                   /* the shown step stays, */
    assert_true(fabs(status.time - 0.1) < 1e-9 && status.before == 0); /* and one can step on from there */
    assert_true(fabs(status.after - 0.2) < 1e-9);
    assert_seek(prefetch, 0.2, 0.1, 2);
    prefetch_destroy(prefetch);
}

/* Also while it is asked for steps all the time. */
static void a_file_that_grows_is_followed(void **state)
{
    (void)state;
    PrefetchStatus status;
    Recorded recorded;
    const Scene scene = tank_scene(NULL);
    SnapshotWriter *file = snapshot_create("a.h5part", &scene, &error);
    must(file, &error);
    append(file, 1, 0);
    open_recorded(&recorded, "a.h5part", NULL);
    Prefetch *prefetch = prefetch_create(&(PrefetchSetup){.recorded = &recorded, .attributes = ~0U}, &error);
    assert_seek(prefetch, 10, 0, 0);
    for (size_t k = 1; k < 4; k++) {
        append(file, 1 + k, 0.1 * (double)k);
        const double until = wall_ms() + PATIENCE_MS;
        do {
            prefetch_seek(prefetch, k == 2 ? 10 + wall_ms() : 10, 0);
            must(prefetch_wait(prefetch, &status, &error), &error);
            usleep(1000);
        } while (status.index < k && wall_ms() < until);
        assert_shown(prefetch, k, &status);
    }
    snapshot_close(file);
    prefetch_destroy(prefetch);
}

/* Between two steps the later one; beyond the end the last. */
static void the_step_at_or_after_a_time(void **state)
{
    (void)state;
    Recorded recorded;
    const size_t counts[] = {1, 2, 3, 4};
    write_file("a.h5part", counts, 4, 0.1);
    open_recorded(&recorded, "a.h5part", NULL);
    Prefetch *prefetch = prefetch_create(
        &(PrefetchSetup){.recorded = &recorded, .attributes = ~0U, .at_or_after = true}, &error);
    must(prefetch, &error);
    assert_seek(prefetch, -1, 0, 0);
    assert_seek(prefetch, 0.1, 0.1, 1);
    assert_seek(prefetch, 0.1001, 0.1, 2);
    assert_seek(prefetch, 0.25, 0, 3);
    assert_seek(prefetch, 9, 0, 3);
    prefetch_destroy(prefetch);
}

/* Told, and shown on is what was opened. */
static void a_file_that_is_replaced(void **state)
{
    (void)state;
    PrefetchStatus status;
    Prefetch *prefetch = open_prefetch(1U << 20);
    const size_t counts[] = {1};
    const double until = wall_ms() + PATIENCE_MS;
    write_file("b.h5part", counts, 1, 0.1);
    assert_seek(prefetch, 0.2, 0, 2);
    must(prefetch_status(prefetch, &status, &error), &error);
    assert_false(status.replaced);
    assert_int_equal(status.particles, 3);
    assert_int_equal(rename("b.h5part", "a.h5part"), 0);
    while (!status.replaced && wall_ms() < until) {
        usleep(10000);
        must(prefetch_status(prefetch, &status, &error), &error);
    }
    assert_true(status.replaced);
    assert_seek(prefetch, 0.4, 0, 4);
    prefetch_destroy(prefetch);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(what_is_asked_for_is_shown),
        TEST(neighbours_are_known),
        TEST(steps_are_read_ahead),
        TEST(reading_ahead_comes_to_an_end),
        TEST(few_steps_are_kept),
        TEST(a_step_that_cannot_be_read),
        TEST(a_file_that_grows_is_followed),
        TEST(the_step_at_or_after_a_time),
        TEST(a_file_that_is_replaced),
    };
    return cmocka_run_group_tests(tests, context_begin, context_end);
}
