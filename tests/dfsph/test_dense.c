/* dfsph's multipliers against a dense solution in double precision: the same system, assembled from all
   pairs, images and boundary particles, solved by elimination, or where multipliers may not be negative by
   projected Gauss and Seidel. */
#include "tests/sim/fixture.h"

#include "shaders/sim/shared/share_most.h"
#include "sim/cpu/cpu.h"
#include "sim/methods/dfsph/dfsph_private.h"
#include "sim/step/world.h"
#include "tests/dfsph/lack.h"

enum { MOST = 128 };

/* Some particles in a corner of a box, out of order. */
typedef struct Cloud {
    int count;
    float x[3 * MOST], v[3 * MOST];
    uint8_t fluid[MOST];
} Cloud;

typedef struct Case {
    int dimensions;
    bool pulls, solid;
} Case;

static const Case cases[] = {{2, true, false},  {3, true, true},  {2, false, true},
                             {3, false, false}, {3, false, true}, {2, true, true}};
enum { CASES = sizeof cases / sizeof *cases };

static const double ball[3] = {0, 0.35, 0};
static const double RADIUS = 0.2;

/* Half a spacing off the ball, if there is one. */
static bool is_free(const Case *c, const float x[3])
{
    double r2 = 0;
    for (int k = 0; k < (c->dimensions == 2 ? 2 : 3); k++)
        r2 += ((double)x[k] - ball[k]) * ((double)x[k] - ball[k]);
    return !c->solid || sqrt(r2) > RADIUS + 0.05;
}

static void cloud_make(const Case *c, Cloud *cloud)
{
    const int side = c->dimensions == 2 ? 10 : 5,
              most = c->dimensions == 2 ? side * side : side * side * side;
    uint32_t seed = 5;
    *cloud = (Cloud){0};
    for (int i = 0; i < most; i++) {
        const int at[3] = {i % side, i / side % side, i / side / side};
        float *x = cloud->x + 3 * cloud->count, *v = cloud->v + 3 * cloud->count;
        for (int k = 0; k < (c->dimensions == 2 ? 2 : 3); k++) {
            const double low = k == 1 ? 0 : -0.5;
            x[k] = (float)(low + 0.097 * (at[k] + 0.5) + 0.01 * (fixture_random(&seed) - 0.5));
            v[k] = (float)(fixture_random(&seed) - 0.5);
        }
        cloud->fluid[cloud->count] = at[0] > side / 2;
        cloud->count += is_free(c, x);
    }
}

static WorldDef def_of(const Case *c)
{
    WorldDef def = fixture_def(1.2, 1.2, c->dimensions == 3 ? 1 : 0);
    def.box_size[0] = 1;
    strcpy(def.method, "dfsph");
    def.dimensions = c->dimensions;
    def.support = c->dimensions == 3 ? 2.1 : 2.6;
    def.negative_pressure = c->pulls;
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 300};
    if (c->solid)
        def.solids[def.solid_count++] = (SolidDef){
            .kind = SOLID_SPHERE, .centre = {ball[0], ball[1], ball[2]}, .radius = RADIUS, .axis = {0, 1, 0}};
    dfsph_def(&def)->tolerance = dfsph_def(&def)->divergence_tolerance = 2e-7;
    dfsph_def(&def)->iterations = 10000;
    dfsph_def(&def)->surface_lack = 1;
    return def;
}

/* Contents of the sums, of particles in the solvers' view. push[l][i]: the force on l of k_i = 1. flow:
   the boundary particles' part of the rates. slope and squares: sums of F x and of F x x^T over boundary
   particles; all: sums of F x over all particles. n: with the lack of a surface. */
typedef struct System {
    int count;
    double n[MOST], inverse_mass[MOST], flow[MOST], slope[MOST][3], squares[MOST][3][3], all[MOST][3];
    double push[MOST][MOST][3];
    double matrix[MOST][MOST], right[MOST];
} System;

typedef struct Sums {
    const World *world;
    double h, scale;
    const Kernel *kernel;
} Sums;

/* F x and W of a particle at `other` for i; false if too far. */
static bool pair(const Sums *sums, const double x[3], const double other[3], double slope[3], double *height)
{
    double d[3], r2 = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = x[k] - other[k];
        r2 += d[k] * d[k];
    }
    const double r = sqrt(r2);
    if (r >= sums->h)
        return false;
    *height = sums->scale * sums->kernel->value(r, sums->h);
    for (int k = 0; k < 3; k++)
        slope[k] = r > 0 ? -sums->scale * sums->kernel->derivative(r, sums->h) / r * d[k] : 0;
    return true;
}

/* Position behind `walls`, digits in base three: none, the lower or the upper wall of each axis. */
static void image_of(const World *world, const double x[3], int walls, double out[3])
{
    for (int k = 0; k < 3; k++, walls /= 3) {
        const double low = k == 1 ? 0 : -0.5 * world->def.box_size[k];
        out[k] = walls % 3 == 0 ? x[k] : 2 * (walls % 3 == 1 ? low : low + world->def.box_size[k]) - x[k];
    }
}

/* What j, at x_j or behind walls, does to i. */
static void meet(System *s, const Sums *sums, double x[][3], int i, int j)
{
    for (int walls = 0; walls < (sums->world->def.dimensions == 2 ? 9 : 27); walls++) {
        double other[3], slope[3], height;
        image_of(sums->world, x[j], walls, other);
        if ((i == j && walls == 0) || !pair(sums, x[i], other, slope, &height))
            continue;
        s->n[i] += height;
        for (int k = 0; k < 3; k++) {
            s->all[i][k] += slope[k];
            s->push[i][i][k] += slope[k];
            s->push[i][j][k] += slope[k];
        }
    }
}

/* A boundary particle, with twice the multiplier of i. */
static void meet_boundary(System *s, const Sums *sums, const double x[3], int i, size_t b)
{
    const CpuParticles *p = &((const Cpu *)sums->world->state)->now;
    const double at[3] = {(double)p->x[b], (double)p->y[b], (double)p->z[b]};
    for (int walls = 0; walls < (sums->world->def.dimensions == 2 ? 9 : 27); walls++) {
        double other[3], slope[3], height;
        image_of(sums->world, at, walls, other);
        if (!pair(sums, x, other, slope, &height))
            continue;
        s->n[i] += height;
        for (int k = 0; k < 3; k++) {
            s->all[i][k] += slope[k];
            s->push[i][i][k] += 2 * slope[k];
            s->slope[i][k] += slope[k];
            for (int m = 0; m < 3; m++)
                s->squares[i][k][m] += slope[k] * (x[m] - other[m]);
        }
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Pressure force on particle l in fluid with `push`: along a solid 1 / (1 - share) of `push`. */
static void pushed(const System *s, const World *world, int l, const double push[3], double out[3])
{
    const double *n = s->slope[l], square = dot(n, n), across = square > 0 ? dot(n, push) / square : 0;
    const Lattice *lattice = &world->constants.lattice;
    double along = 0;
    for (int k = 0; k < 3 && square > 0; k++)
        along += s->squares[l][k][k] - dot(n, s->squares[l][k]) * n[k] / square;
    const double share = fmin(along / (world->def.dimensions - 1) * lattice->gradient_scale /
                                  (lattice->density_scale * lattice->number_density),
                              (double)SHARE_MOST);
    for (int k = 0; k < 3; k++)
        out[k] = push[k] + share / (1 - share) * (push[k] - across * n[k]);
}

static void assemble(System *s, const World *world, const Cloud *cloud, double x[][3])
{
    const Cpu *cpu = world->state;
    const Constants *c = &world->constants;
    const Sums sums = {world, (double)c->support_radius, c->lattice.density_scale,
                       &shape_kernels[DFSPH_KERNEL]};
    const double dt = world->def.dt, n0 = c->lattice.number_density;
    memset(s, 0, sizeof *s);
    s->count = cloud->count;
    for (int i = 0; i < s->count; i++) {
        s->n[i] = sums.scale * sums.kernel->value(0, sums.h);
        s->inverse_mass[i] = 1 / constants_mass(c, cloud->fluid[i]);
        for (int j = 0; j < s->count; j++)
            meet(s, &sums, x, i, j);
        for (size_t b = 0; b < cpu->count; b++)
            if (cpu->now.fluid[b] >= FLUIDS_MAX)
                meet_boundary(s, &sums, x[i], i, b);
        for (int k = 0; k < 3; k++)
            s->all[i][k] /= sums.scale;
        s->n[i] += n0 * lack_at(world, s->all[i], s->n[i] / n0);
    }
    for (int i = 0; i < s->count; i++)
        for (int j = 0; j < s->count; j++)
            for (int l = 0; l < s->count; l++) {
                double push[3];
                pushed(s, world, l, s->push[l][j], push);
                s->matrix[i][j] += dt * dt / n0 * s->inverse_mass[l] * dot(s->push[l][i], push);
            }
}

/* -sum push . v: what velocities make of n_i in a step, over n0. */
static double pressed(const System *s, const World *world, double v[][3], int i)
{
    double sum = 0;
    for (int l = 0; l < s->count; l++)
        for (int k = 0; k < 3; k++)
            sum -= s->push[l][i][k] * v[l][k];
    return world->def.dt * sum / world->constants.lattice.number_density;
}

/* Gauss with pivots by rows. */
static void eliminate(const System *s, double *k)
{
    static double a[MOST][MOST + 1];
    const int n = s->count;
    for (int i = 0; i < n; i++) {
        memcpy(a[i], s->matrix[i], (size_t)n * sizeof **a);
        a[i][n] = s->right[i];
    }
    for (int at = 0; at < n; at++) {
        int best = at;
        for (int i = at + 1; i < n; i++)
            best = fabs(a[i][at]) > fabs(a[best][at]) ? i : best;
        for (int j = 0; j <= n; j++) {
            const double other = a[best][j];
            a[best][j] = a[at][j];
            a[at][j] = other;
        }
        for (int i = 0; i < n; i++) {
            const double part = i == at ? 0 : a[i][at] / a[at][at];
            for (int j = at; part != 0 && j <= n; j++)
                a[i][j] -= part * a[at][j];
        }
    }
    for (int i = 0; i < n; i++)
        k[i] = a[i][n] / a[i][i];
}

static double left(const System *s, const double *k, int i)
{
    double sum = s->right[i];
    for (int j = 0; j < s->count; j++)
        sum -= s->matrix[i][j] * k[j];
    return sum;
}

/* k >= 0, no residual where k > 0, and no positive residual elsewhere. */
static void project(const System *s, double *k)
{
    double most = 1;
    memset(k, 0, MOST * sizeof *k);
    for (int sweep = 0; sweep < 20000 && most > 1e-12; sweep++) {
        most = 0;
        for (int i = 0; i < s->count; i++) {
            const double before = k[i], step = left(s, k, i) / s->matrix[i][i];
            k[i] = fmax(k[i] + step, 0);
            most = fmax(most, fabs(k[i] - before) * s->matrix[i][i]);
        }
    }
    assert_true(most <= 1e-12);
}

/* The solver's multipliers: the residual is as small as reported, and the values equal the dense
   solution. */
static void compare(const char *what, const Case *c, const System *s, const double *found,
                    const StepSolve *said)
{
    double k[MOST], off2 = 0, sum2 = 0, mean = 0;
    int held = 0;
    (c->pulls ? eliminate : project)(s, k);
    for (int i = 0; i < s->count; i++) {
        const double e = left(s, found, i);
        mean += (c->pulls || found[i] > 0 ? fabs(e) : fmax(e, 0)) / s->count;
        off2 += (found[i] - k[i]) * (found[i] - k[i]);
        sum2 += k[i] * k[i];
        held += k[i] != 0;
    }
    printf(
        "%dD%s%s, %s: %d of %d held, %g iterations; left %.1e in the mean, said %.1e; multipliers off by %.1e\n",
        c->dimensions, c->pulls ? ", pulling" : "", c->solid ? ", solid" : "", what, held, s->count,
        said->iterations, mean, said->mean, sqrt(off2 / sum2));
    assert_true(held > s->count / 4);
    assert_float_equal(mean, said->mean, 3e-7);                 /* single precision has 1e-7 */
    assert_true(sqrt(off2 / sum2) < (c->pulls ? 0.02 : 0.001)); /* what pulls has weak modes */
}

/* What the solvers of a step saw and found, by id. */
typedef struct Step {
    double x[MOST][3];                     /* in the middle */
    double falls[MOST][3], flown[MOST][3]; /* velocities before the solver of velocities, and behind it */
    double pressed[MOST], moved[MOST];     /* multipliers of velocities, of places */
} Step;

static void step_of(const World *world, const Cloud *cloud, Step *out)
{
    const Cpu *cpu = world->state;
    const CpuParticles *now = &cpu->now;
    const double dt = world->def.dt;
    for (int i = 0; i < cloud->count; i++)
        for (int k = 0; k < 3; k++) {
            const double v = (double)cloud->v[3 * i + k];
            out->x[i][k] = (double)cloud->x[3 * i + k] + 0.5 * dt * v;
            out->falls[i][k] = v + dt * world->def.gravity[k];
        }
    const double unit2 = pow(world->constants.unit_volume, 2);
    for (size_t i = 0; i < cpu->count; i++) {
        const double v[3] = {(double)now->vx[i], (double)now->vy[i], (double)now->vz[i]};
        const ParticleId id = now->id[i];
        if (now->fluid[i] >= FLUIDS_MAX)
            continue;
        memcpy(out->flown[id], v, sizeof v);
        out->moved[id] = unit2 * (double)now->pressure_term[i];
        out->pressed[id] = unit2 * (double)now->own[KEPT][i];
    }
}

static void check(const Case *c)
{
    static Cloud cloud;
    static System s;
    static Step step;
    WorldDef def = def_of(c);
    cloud_make(c, &cloud);
    def.initial = &(InitialState){
        .count = (size_t)cloud.count, .position = cloud.x, .velocity = cloud.v, .fluid = cloud.fluid};
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    step_of(world, &cloud, &step);
    const double n0 = world->constants.lattice.number_density;
    assemble(&s, world, &cloud, step.x);
    for (int i = 0; i < s.count; i++)
        s.right[i] = (c->pulls ? 0 : fmin(s.n[i] / n0 - 1, 0)) + pressed(&s, world, step.falls, i);
    compare("velocities", c, &s, step.pressed, &world->solves[1]);
    for (int i = 0; i < s.count; i++)
        s.right[i] = s.n[i] / n0 - 1 + pressed(&s, world, step.flown, i);
    compare("places", c, &s, step.moved, &world->solves[0]);
    world_destroy(world);
}

static void multipliers_are_those_of_a_dense_solution(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++)
        check(&cases[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multipliers_are_those_of_a_dense_solution),
    };
    return cmocka_run_group_tests_name("dfsph.dense", tests, NULL, NULL);
}
