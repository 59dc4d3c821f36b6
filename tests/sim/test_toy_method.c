/* A method that the program does not have: springs that harden with the age of their particles, a column of
   its own. It is listed, is saved, and has the same bits on any number of threads. */
#include "sim/cpu/pass.h"
#include "sim/world/substep.h"
#include "sim/world/world_state.h"
#include "tests/sim/fixture.h"

static void body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        p->own[0][i] += range->input->dt * (float)p->id[i];
        p->ax[i] = -(50 + 1000 * p->own[0][i]) * p->x[i];
        p->volume[i] = 1 / range->cpu->constants->rest_number_density;
    }
}

static const CpuPass on_cpu = {.loops = {{body, CPU_GRAIN}}};
static const Pass spring = {.name = "spring", .cpu = &on_cpu, .reads = "position", .writes = "age volume"};
enum { KEPT = COLUMN_SAVED | COLUMN_SORTED };
static const ColumnDef columns[] = {{"age", "s", COLUMN_OWN(0), 1, .flags = KEPT}, {0}};

static void substep(const Substep *step)
{
    step->backend->drift(step->state, &step->first_half);
    step->backend->grid(step->state);
    substep_run(step, &spring, step->dt);
    substep_kick(step);
    step->backend->drift(step->state, &step->second_half);
}

static Method toy = {.name = "toy",
                     .help = "springs that harden",
                     .columns = columns,
                     .passes = (const Pass *const[]){&spring, NULL},
                     .settle = &spring,
                     .substep = substep};

static void toy_lives(void **state)
{
    (void)state;
    Error error;
    WorldState saved = {.count = 0};
    toy.kernels = method_find("mueller")->kernels, method_add(&toy);
    WorldDef def = fixture_def(1, 1, 1);
    strcpy(def.method, "toy"), fixture_block(&def, 0, -0.4, 0, -0.4, 0.2, 0.5, 0.4);
    World *one = fixture_world(&def), *three = (def.threads = 3, fixture_world(&def));
    fixture_step(one, 30);
    assert_true(world_save(one, &saved, &error) && world_load(three, &saved, &error));
    fixture_step(one, 5), fixture_step(three, 5);
    assert_float_equal(saved.particles.own[0][5], 0.06 * saved.particles.id[5], 1e-4);
    assert_true(world_hash(one) && world_hash(one) == world_hash(three));
    assert_string_equal(world_methods()[2].name, "toy");
    world_state_free(&saved), world_destroy(one), world_destroy(three);
}

int main(void)
{
    return cmocka_run_group_tests(((const struct CMUnitTest[]){cmocka_unit_test(toy_lives)}), NULL, NULL);
}
