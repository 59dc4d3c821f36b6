/* A method's declarations hold: columns read and written by passes, and the equation of state. */
#include "sim/cpu/cpu.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/step/backend.h"
#include "sim/step/world.h"
#include "tests/sim/fixture.h"
#include "tests/sim/toy_method.h"

/* A plane with all possible terms: two fluids, the second viscous, around a ball. */
static WorldDef full_def(const Method *method)
{
    WorldDef def = fixture_def(1, 1, 1);
    snprintf(def.method, sizeof def.method, "%s", method->name);
    def.dimensions = 2;
    def.spacing = 0.04;
    def.support = 2.6;
    def.sound_speed = 20;
    def.dt = 0.0005;
    def.negative_pressure = true;
    def.tension_model = TENSION_COHESION;
    def.fluid_count = 2;
    def.fluids[0].surface_tension = 0.1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 3};
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.3, 0}, .radius = 0.15, .slip = SLIP_NONE};
    wcsph_def(&def)->delta_sph = 0.1;
    wcsph_def(&def)->shifting = 0.2;
    wcsph_def(&def)->viscosity_form = VISCOSITY_RADIAL;
    wcsph_def(&def)->corrected_gradient = true;
    if (method == &method_wcsph)
        def.tension_model = TENSION_CURVATURE;
    fixture_block(&def, 0, -0.5, 0, 0, 0, 0.6, 0);
    fixture_block(&def, 1, 0, 0, 0, 0.5, 0.5, 0);
    return def;
}

/* Whether a list of words with blanks between them has that word. */
static bool names(const char *list, const char *word)
{
    const size_t size = strlen(word);
    for (const char *at = list; (at = strstr(at, word)); at += size)
        if ((at == list || at[-1] == ' ') && (at[size] == ' ' || at[size] == 0))
            return true;
    return false;
}

/* How many words of the list are columns, of which some methods have a name twice, as every method's and as
   their own. */
static int columns_named(const Method *method, const char *list)
{
    const ColumnRows rows = column_rows(method->columns, 0, NULL);
    int found = 0;
    for (int k = 0; k < rows.count; k++) {
        bool twice = false;
        for (int before = 0; before < k; before++)
            twice |= strcmp(rows.row[before]->name, rows.row[k]->name) == 0;
        found += !twice && names(list, rows.row[k]->name);
    }
    return found;
}

static int words(const char *list)
{
    int count = list[0] != 0;
    for (const char *at = list; (at = strchr(at, ' ')); at++)
        count++;
    return count;
}

static void passes_name_columns_that_exist(void **state)
{
    (void)state;
    for (const Method *const *method = method_list(); *method; method++)
        for (const Pass *const *pass = (*method)->passes; *pass; pass++) {
            if (columns_named(*method, (*pass)->reads) != words((*pass)->reads))
                fail_msg("%s, %s reads %s", (*method)->name, (*pass)->name, (*pass)->reads);
            if (columns_named(*method, (*pass)->writes) != words((*pass)->writes))
                fail_msg("%s, %s writes %s", (*method)->name, (*pass)->name, (*pass)->writes);
        }
}

/* How many of the rows' components that are saved are scalars by that name and unit. */
static int scalars_of(const ColumnDef *row, Scalar only)
{
    char name[32];
    int found = 0;
    for (; row && row->name; row++)
        for (int k = 0; row->flags & COLUMN_SAVED && column_own(row) >= 0 && k < row->components; k++) {
            int known = 0;
            snprintf(name, sizeof name, row->components > 1 ? "%s_%c" : "%s", row->name, 'x' + k);
            for (int s = SCALAR_OWN; s < SCALAR_OWN_END; s++)
                if (strcmp(name, scalar_list[s].name) == 0 && strcmp(row->unit, scalar_list[s].unit) == 0) {
                    known++;
                    found += (Scalar)s == only;
                }
            if (known != 1)
                fail_msg("OWN_SCALAR_LIST has %d rows of %s in %s", known, name, row->unit);
        }
    return found;
}

static void what_is_saved_is_a_scalar(void **state)
{
    (void)state;
    for (int s = SCALAR_OWN; s < SCALAR_OWN_END; s++) {
        int found = 0;
        for (const Method *const *method = method_list(); *method; method++)
            if (strcmp((*method)->name, "toy") != 0) /* it stands in no list of the program */
                found += scalars_of((*method)->columns, (Scalar)s);
        for (const Term *const *term = shared_terms; *term; term++)
            found += scalars_of((*term)->columns, (Scalar)s);
        if (found == 0)
            fail_msg("no column is %s", scalar_list[s].name);
    }
}

/* The fluids' particles in a column's component: what stands for solids is the backend's. */
static bool same(const Cpu *cpu, const ColumnDef *row, int component, ParticleColumns *a, ParticleColumns *b)
{
    const size_t size = column_size(row);
    const char *of_a = *column_array(a, row, component), *of_b = *column_array(b, row, component);
    for (size_t i = 0; of_a && i < cpu->count; i++)
        if (cpu->now.fluid[i] < FLUIDS_MAX && memcmp(of_a + i * size, of_b + i * size, size) != 0)
            return false;
    return true;
}

/* NaN, or absurd numbers. */
static void poison(Cpu *cpu, const ColumnDef *row)
{
    for (int c = 0; c < row->components; c++) {
        void *array = *column_array(&cpu->now, row, c);
        if (array)
            memset(array, 0xff, cpu->count * column_size(row));
    }
}

/* A pass turned `before` into `after`, and into `poisoned` with different numbers in unread columns. */
static void check_column(const Cpu *cpu, const Pass *pass, const ColumnDef *row, ParticleColumns *before,
                         ParticleColumns *after, ParticleColumns *poisoned)
{
    const bool writes = names(pass->writes, row->name);
    for (int c = 0; c < row->components; c++) {
        const bool left = same(cpu, row, c, before, after);
        if (!left && !writes)
            fail_msg("pass %s changes %s, which it does not name", pass->shader, row->name);
        if (!left && !same(cpu, row, c, after, poisoned))
            fail_msg("pass %s: %s depends on a column that it does not name", pass->shader, row->name);
    }
}

/* A pass leaves all columns except written columns, and has the same results for any content of unread
   columns. */
static void check_pass(const World *world, const Pass *pass)
{
    static const ApparentGravity apparent = {.origin = {0.5F, -9.81F, 0}};
    const PassInput input = {.dt = 0.0005F, .apparent = &apparent};
    Cpu *cpu = world->state;
    const ColumnRows rows = column_rows(world->method->columns, 0, &world->constants);
    ParticleColumns before = {0}, after = {0};
    assert_true(columns_create(&before, &rows, cpu->count, NULL));
    assert_true(columns_create(&after, &rows, cpu->count, NULL));
    columns_copy(&rows, &cpu->now, &before, NULL, 0, cpu->count);
    world->backend->run(cpu, pass, &input);
    columns_copy(&rows, &cpu->now, &after, NULL, 0, cpu->count);
    columns_copy(&rows, &before, &cpu->now, NULL, 0, cpu->count);
    for (int k = 0; k < rows.count; k++)
        if (!names(pass->reads, rows.row[k]->name))
            poison(cpu, rows.row[k]);
    cpu->thin = false; /* found by the coarse level: as after a grid */
    world->backend->run(cpu, pass, &input);
    for (int k = 0; k < rows.count; k++)
        check_column(cpu, pass, rows.row[k], &before, &after, &cpu->now);
    columns_copy(&rows, &after, &cpu->now, NULL, 0, cpu->count);
    columns_destroy(&before);
    columns_destroy(&after);
}

/* Returns the passes that a world with or without solids needs. */
static int check_passes(const Method *method, bool solids)
{
    int checked = 0;
    WorldDef def = full_def(method);
    def.viscosity_solver = VISCOSITY_IMPLICIT;
    def.solid_count = solids ? def.solid_count : 0;
    World *world = fixture_world(&def);
    fixture_step(world, 5);
    world->backend->grid(world->state);
    for (const Pass *const *pass = method->passes; *pass; pass++)
        if (!(*pass)->needed || (*pass)->needed(&world->constants)) {
            check_pass(world, *pass);
            checked++;
        }
    world_destroy(world);
    return checked;
}

static void passes_read_and_write_what_they_name(void **state)
{
    (void)state;
    fixture_needs_cpu("columns are its own");
    for (const Method *const *method = method_list(); *method; method++) {
        int all = 0, alone = 0;
        for (const Pass *const *pass = (*method)->passes; *pass; pass++) {
            all++;
            alone += (*pass)->corrects; /* beside no solids */
        }
        assert_int_equal(check_passes(*method, true), all - alone);
        if (alone > 0)
            assert_int_equal(check_passes(*method, false), all);
    }
}

/* d e / dx = p / (rho0 c^2 (1 + x)^2). */
static void check_energy(const Method *method, const Constants *constants, double x)
{
    const double d = 1e-3 * fabs(x), slope = (method->energy(x + d) - method->energy(x - d)) / (2 * d);
    const double c = (double)constants->sound_speed;
    for (int f = 0; f < constants->fluid_count; f++) {
        const double p = (double)method->pressure(constants, f, (float)x),
                     rho = (1 + x) * (double)constants->density[f];
        assert_float_equal(p * (double)constants->density[f] / (rho * rho * c * c * slope), 1, 1e-5);
    }
}

static void energy_is_the_integral_of_pressure(void **state)
{
    (void)state;
    static const double at[] = {-0.3, -0.01, 1e-4, 0.02, 0.4};
    for (const Method *const *method = method_list(); *method; method++) {
        const WorldDef def = full_def(*method);
        Constants constants;
        Error error;
        assert_true(!(*method)->energy == !(*method)->pressure);
        assert_true(constants_create(&constants, &def, &error));
        for (size_t k = 0; (*method)->energy && (*method)->pressure && k < sizeof at / sizeof *at; k++)
            check_energy(*method, &constants, at[k]);
        constants_destroy(&constants);
    }
}

/* The pass and the method say the same. */
static void particles_have_the_pressure_of_their_method(void **state)
{
    (void)state;
    fixture_needs_cpu("columns are its own");
    for (const Method *const *method = method_list(); *method; method++) {
        const WorldDef def = full_def(*method);
        World *world = fixture_world(&def);
        fixture_step(world, 5);
        world->backend->run(world->state, (*method)->settle, &(PassInput){0});
        const Cpu *cpu = world->state;
        const ColumnRows rows = column_rows((*method)->columns, COLUMN_SAVED, &world->constants);
        const int place = columns_place(&rows, SCALAR_BOUNDARY_PART),
                  mean = columns_place(&rows, SCALAR_BOUNDARY_MEAN);
        const float *part = place >= 0 ? cpu->now.own[place] : NULL;
        for (size_t k = 0; (*method)->pressure && k < cpu->owned; k++) {
            const size_t i = cpu_owned(cpu, k);
            const int fluid = cpu->now.fluid[i];
            if (mean >= 0 && cpu->now.own[mean][i] != 0)
                continue; /* next to a solid its part is in no column */
            const float c2 = world->constants.sound_speed * world->constants.sound_speed;
            assert_float_equal(cpu->now.pressure[i],
                               (*method)->pressure(&world->constants, fluid,
                                                   particle_compression(&cpu->now, &world->constants, i) +
                                                       (part ? part[i] : 0)),
                               1e-6F * c2 * world->constants.density[fluid]);
        }
        world_destroy(world);
    }
}

int main(void)
{
    toy_method_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_name_columns_that_exist),
        cmocka_unit_test(what_is_saved_is_a_scalar),
        cmocka_unit_test(passes_read_and_write_what_they_name),
        cmocka_unit_test(energy_is_the_integral_of_pressure),
        cmocka_unit_test(particles_have_the_pressure_of_their_method),
    };
    return cmocka_run_group_tests_name("sim.method", tests, NULL, NULL);
}
