/* The cost model of a step on ranks: fitted parameters are recovered, and predictions follow. */
#include "tests/tolerance.h"

#include "app/lab/scaling.h"

#include <string.h>

static const CostModel machine = {.dimensions = 3,
                                  .compute = 2e-6,
                                  .surface = 3.5,
                                  .bytes = 96,
                                  .messages = 5,
                                  .latency = 4e-6,
                                  .bandwidth = 3e9,
                                  .balance = 2e-8,
                                  .wait = 0.05};

static void a_machine_comes_back_from_one_and_two_ranks(void **state)
{
    (void)state;
    CostSample samples[4];
    CostModel fitted;
    Error error = {{0}};
    for (int i = 0; i < 4; i++)
        samples[i] = cost_predict(&machine, i < 3 ? 1e4 * pow(4, i) : 1e4, i < 3 ? 2 : 1, i < 3 ? 2 : 1);
    assert_true(cost_fit(samples, 4, 3, &fitted, &error));
    check_near(fitted.compute, machine.compute, 1e-9 * machine.compute, "compute");
    check_near(fitted.surface, machine.surface, 1e-9 * machine.surface, "surface");
    check_near(fitted.bytes, machine.bytes, 1e-9 * machine.bytes, "bytes");
    check_near(fitted.messages, machine.messages, 1e-9 * machine.messages, "messages");
    check_near(fitted.latency, machine.latency, 1e-6 * machine.latency, "latency");
    check_near(fitted.bandwidth, machine.bandwidth, 1e-6 * machine.bandwidth, "bandwidth");
    const CostSample four = cost_predict(&fitted, 1e5, 4, 2), wanted = cost_predict(&machine, 1e5, 4, 2);
    check_near(cost_step(&four), cost_step(&wanted), 1e-6 * cost_step(&wanted), "a step");
}

/* Faces and neighbours of lattices that can be counted by hand: surface, messages and particles are 1. */
static void ranks_have_the_faces_and_neighbours_of_a_lattice(void **state)
{
    (void)state;
    static const struct {
        int ranks, dimensions;
        double faces, neighbours;
    } known[] = {{1, 3, 0, 0}, {2, 3, 1, 1}, {3, 3, 4.0 / 3, 4.0 / 3}, {4, 3, 2, 3},
                 {8, 3, 3, 7}, {4, 2, 2, 3}, {16, 2, 3, 5.25},         {4096, 3, 5.625, 22.763671875}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const CostModel unit = {
            .dimensions = known[i].dimensions, .surface = 1, .messages = 1, .bandwidth = 1};
        const CostSample sample = cost_predict(&unit, known[i].ranks, known[i].ranks, 1);
        check_near(sample.ghosts, known[i].faces, 1e-12 * known[i].faces, "ghosts");
        check_near(sample.messages, known[i].neighbours, 1e-12 * known[i].neighbours, "messages");
    }
}

static void weak_scaling_ends_at_six_faces(void **state)
{
    (void)state;
    const CostSample many = cost_predict(&machine, 1e9, 4096, 4096),
                     more = cost_predict(&machine, 8e9, 32768, 32768);
    assert_true(more.exchange > many.exchange);
    check_near(more.exchange, many.exchange, 0.1 * many.exchange, "exchange");
    check_near(more.compute, many.compute, 1e-12 * many.compute, "compute");
}

static void noise_makes_no_negative_times(void **state)
{
    (void)state;
    CostSample samples[2] = {cost_predict(&machine, 1e4, 2, 2), cost_predict(&machine, 1e6, 2, 2)};
    CostModel fitted;
    Error error = {{0}};
    samples[0].exchange /= 10; /* less than its bytes take */
    assert_true(cost_fit(samples, 2, 3, &fitted, &error));
    assert_true(fitted.latency >= 0 && fitted.bandwidth > 0);
    assert_true(cost_predict(&fitted, 1e5, 2, 2).exchange > 0);
    samples[0].exchange *= 1000; /* more than any bytes */
    assert_true(cost_fit(samples, 2, 3, &fitted, &error));
    assert_true(fitted.latency >= 0 && fitted.bandwidth > 0);
}

static void one_rank_tells_nothing_of_an_exchange(void **state)
{
    (void)state;
    const CostSample alone = cost_predict(&machine, 1e4, 1, 1);
    CostModel fitted;
    Error error = {{0}};
    assert_false(cost_fit(&alone, 1, 3, &fitted, &error));
    assert_non_null(strstr(error.message, "more than one rank"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_machine_comes_back_from_one_and_two_ranks),
        cmocka_unit_test(ranks_have_the_faces_and_neighbours_of_a_lattice),
        cmocka_unit_test(weak_scaling_ends_at_six_faces),
        cmocka_unit_test(noise_makes_no_negative_times),
        cmocka_unit_test(one_rank_tells_nothing_of_an_exchange),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
