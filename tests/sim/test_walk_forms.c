/* The neighbour walk in several forms: each against brute force; with --time [PARTICLES] each one's time, as
   the rows of the table in docs/performance.md. */
#include "fixture.h"

#include "sim/cpu/pairs.h"
#include "tests/program.h"
#include "walk_forms/forms.h"

#include <time.h>

enum { ROWS, HALVES, SKIN_1, SKIN_2, CURVE, SHAPES };

static const Shape shapes[SHAPES] = {
    [ROWS] = {.edge = 1, .reach = 1},
    [HALVES] = {.edge = 0.5F, .reach = 1},
    [SKIN_1] = {.edge = 1.1F, .reach = 1.1F},
    [SKIN_2] = {.edge = 1.2F, .reach = 1.2F},
    [CURVE] = {.edge = 1, .reach = 1, .curve = true},
};

static void nothing(Cloud *cloud)
{
    (void)cloud;
}

typedef struct Form {
    const char *name;
    int shape;
    Walk *make, *density, *force; /* make: of lists */
} Form;

static const Form forms[] = {
    {"rows of three cells of h, tested in each pass", ROWS, nothing, rows_density, rows_force},
    {"rows of five cells of h/2, tested in each pass", HALVES, nothing, rows_density, rows_force},
    {"lists from rows; gathers", ROWS, lists_of_rows, gathered_density, gathered_force},
    {"lists from rows; packed columns", ROWS, lists_of_rows, packed_density, packed_force},
    {"the same, cells of h/2", HALVES, lists_of_rows, packed_density, packed_force},
    {"lists from blocks; packed columns", ROWS, lists_of_blocks, packed_density, packed_force},
    {"half lists from blocks, each pair once", ROWS, half_lists, once_density, once_force},
    {"**lists side by side: the program**", ROWS, program_lists, program_density, program_force},
    {"the same, a skin of 0.1 h", SKIN_1, program_lists, program_density, program_force},
    {"the same, a skin of 0.2 h", SKIN_2, program_lists, program_density, program_force},
    {"side by side, made by this test", ROWS, turned_lists, program_density, program_force},
    {"the same, cells along a Morton curve", CURVE, turned_lists, program_density, program_force},
};
enum { FORMS = sizeof forms / sizeof *forms };

static bool has_avx2(void)
{
    PairSet set;
    Error none;
    return pair_set_choose(0, &set, &none) && set == PAIR_AVX2; /* the widest that there is */
}

/* What a walk makes of a particle, and the sum of all terms taken as positive: {sum of (1 - r/h)^3 with its
   own, force x, y, z}. */
typedef struct Sums {
    double value[4], size[4];
} Sums;

static void add(Sums *sums, int k, double term)
{
    sums->value[k] += term;
    sums->size[k] += fabs(term);
}

static void add_pair(const float at[4], const float v[4], const float at_j[4], const float v_j[4], double h,
                     Sums *sums)
{
    double d[3], r2 = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = (double)at[k] - (double)at_j[k];
        r2 += d[k] * d[k];
    }
    const double r = sqrt(r2), t = fmax(1 - r / h, 0);
    add(sums, 0, t * t * t);
    for (int k = 0; k < 3; k++) {
        add(sums, 1 + k, t * t * ((double)at[3] + (double)at_j[3]) * d[k] / r);
        add(sums, 1 + k, t * (double)v[3] * (double)v_j[3] * ((double)v_j[k] - (double)v[k]));
    }
}

/* By brute force over all pairs, in double precision. */
static Sums sums_of(const Cloud *cloud, size_t i)
{
    const PairArgs *a = &cloud->args;
    Sums sums = {{1}, {1}};
    for (size_t j = 0; j < a->count; j++)
        if (j != i)
            add_pair(a->place[i], a->motion[i], a->place[j], a->motion[j],
                     (double)cloud->constants.support_radius, &sums);
    return sums;
}

/* Single precision: within 2e-6 of the size of the terms. */
static void check(const Form *form, Cloud *cloud)
{
    const PairArgs *a = &cloud->args;
    form->make(cloud);
    form->density(cloud);
    form->force(cloud);
    for (size_t i = 0; i < a->count; i++) {
        const float got[4] = {a->number_density[i], a->fx[i], a->fy[i], a->fz[i]};
        const Sums sums = sums_of(cloud, i);
        for (int k = 0; k < 4; k++)
            if (!(fabs((double)got[k] - sums.value[k]) <= 2e-6 * sums.size[k]))
                fail_msg("%s: sum %d of particle %zu is %g, not %g", form->name, k, i, (double)got[k],
                         sums.value[k]);
    }
}

static void each_form_is_brute_force(void **state)
{
    (void)state;
    if (!has_avx2())
        skip();
    for (size_t f = 0; f < FORMS; f++) {
        Cloud *cloud = cloud_create(11, &shapes[forms[f].shape]); /* no whole groups, ranges or cells */
        check(&forms[f], cloud);
        cloud_destroy(cloud);
    }
}

/* Of this thread alone: others may be at work. */
static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void time_part(Walk *part, Cloud *cloud, double *least)
{
    const double begin = seconds();
    part(cloud);
    *least = fmin(*least, (seconds() - begin) / (double)cloud->args.count * 1e9);
}

/* How many steps a list is good for, if the fastest move 0.1 c dt a step, dt = 0.4 h / c, and two of them
   half the skin each. */
static int steps_of(const Shape *shape)
{
    const int steps = (int)(0.5F * (shape->reach - 1) / 0.04F);
    return steps > 1 ? steps : 1;
}

static void print_row(const Form *form, const double least[3])
{
    const int steps = steps_of(&shapes[form->shape]);
    const double make = least[0] / steps, both = least[1] + least[2];
    printf("| %s", form->name);
    if (steps > 1)
        printf(", kept for %d steps", steps);
    printf(" | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", least[0], least[1], least[2], make + least[1],
           make + both, make + 2 * both);
}

static double neighbours(Cloud *cloud)
{
    double sum = 0;
    lists_of_blocks(cloud);
    for (size_t i = 0; i < cloud->args.count; i++)
        sum += cloud->length[i];
    return sum / (double)cloud->args.count;
}

/* Rounds of all forms, one behind the other, so that a slow minute meets all of them. */
static int time_forms(double particles)
{
    Cloud *clouds[SHAPES];
    double least[FORMS][3];
    for (int k = 0; k < SHAPES; k++)
        clouds[k] = cloud_create((size_t)(cbrt(particles) + 0.5), &shapes[k]);
    for (size_t f = 0; f < FORMS; f++)
        for (int k = 0; k < 3; k++)
            least[f][k] = INFINITY;
    for (int round = 0; round < 9; round++)
        for (size_t f = 0; f < FORMS; f++) {
            Cloud *cloud = clouds[forms[f].shape];
            time_part(forms[f].make, cloud, &least[f][0]);
            time_part(forms[f].density, cloud, &least[f][1]);
            time_part(forms[f].force, cloud, &least[f][2]);
        }
    printf("| %zu particles, %.1f neighbours | making | density | force | 1 pass | 2 passes | 4 passes |\n"
           "| --- | --- | --- | --- | --- | --- | --- |\n",
           clouds[ROWS]->args.count, neighbours(clouds[ROWS]));
    for (size_t f = 0; f < FORMS; f++)
        print_row(&forms[f], least[f]);
    for (int k = 0; k < SHAPES; k++)
        cloud_destroy(clouds[k]);
    return 0;
}

int main(void)
{
    if (test_argc > 0 && strcmp(test_argv[0], "--time") == 0 && has_avx2())
        return time_forms(test_argc > 1 ? strtod(test_argv[1], NULL) : 100000);
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_form_is_brute_force)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
