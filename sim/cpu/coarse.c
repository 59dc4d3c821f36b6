/* A coarse level for a value per particle: trilinear functions on cells twice as wide as those of the grid.
   Sums over particles are made by cells of the grid in float, then added as integers. So they have the same
   bits on any number of threads and ranks. */
#include "sim/cpu/cpu.h"

#include "sim/base/base.h"
#include "sim/cpu/lanes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CORNERS = COARSE_CORNERS,
    CELLS_MOST = 1 << 21, /* of the box */
    NONE = -1,
};

/* Sums as integers count this part of 1. A particle adds COARSE_PART_MOST at most, and weights of the order
 * of 1. */
static const double FIXED = 0x1p36;

/* Vectors of conjugate gradients. */
enum { VALUE, RESIDUAL, DIRECTION, BENT, INVERSE, VECTORS };

/* Sums over particles of a cell. At x in [0, 1] along an axis corners have l_0 = 1 - x and l_1 = x, and
   products l_a l_b are q_(a + b): (1 - x)^2, x (1 - x), x^2. The fourth float of a row of q is
   unused. */
typedef struct CellSums {
    f4 slope[3][3]; /* by axis k: sum weight q q over the two axes other than k */
    f4 hold[3][3];  /* sum hold q q q */
    f4 residual[2]; /* sum residual l l l; corners along x, then y, then z */
    bool holds;
} CellSums;

/* The same of a coarse cell, as integers. */
typedef struct CoarseSums {
    int64_t slope[3][9], hold[27], residual[CORNERS];
} CoarseSums;

typedef double CornerMatrix[CORNERS][CORNERS];

struct CoarseLevel {
    CoarseShape shape;
    int64_t *fluid;                /* per cell: above 0 with fluid */
    int32_t *at, *node_at;         /* number among cells and nodes with fluid, or NONE */
    size_t used, used_nodes, room; /* cells and nodes with fluid; room for cells */
    CoarseSums *sums;
    int32_t (*corner)[CORNERS]; /* nodes of the cells with fluid */
    CornerMatrix *matrix;
    double *vector[VECTORS];
};

/* --- memory --- */

static void drop_cells(CoarseLevel *level)
{
    free(level->sums);
    free(level->corner);
    free(level->matrix);
    free(level->vector[0]);
    level->sums = NULL;
    level->corner = NULL;
    level->matrix = NULL;
    level->vector[0] = NULL;
    level->room = 0;
}

void cpu_coarse_destroy(CoarseLevel *level)
{
    if (!level)
        return;
    drop_cells(level);
    free(level->fluid);
    free(level->at);
    free(level->node_at);
    free(level);
}

static CoarseLevel *create(const Constants *constants)
{
    CoarseLevel *level = calloc(1, sizeof *level);
    if (!level)
        return NULL;
    level->shape = coarse_shape(constants, CELLS_MOST);
    level->fluid = malloc(level->shape.cells * sizeof *level->fluid);
    level->at = malloc(level->shape.cells * sizeof *level->at);
    level->node_at = malloc(level->shape.nodes * sizeof *level->node_at);
    if (level->fluid && level->at && level->node_at)
        return level;
    cpu_coarse_destroy(level);
    return NULL;
}

/* Room for the cells with fluid and for nodes; false if memory is short. */
static bool make_room(CoarseLevel *level)
{
    if (level->used <= level->room)
        return true;
    const size_t room = level->used + level->used / 4 + 64, nodes = CORNERS * room;
    drop_cells(level);
    level->sums = malloc(room * sizeof *level->sums);
    level->corner = malloc(room * sizeof *level->corner);
    level->matrix = malloc(room * sizeof *level->matrix);
    level->vector[0] = malloc(VECTORS * nodes * sizeof *level->vector[0]);
    if (!level->sums || !level->corner || !level->matrix || !level->vector[0])
        return false;
    for (int k = 1; k < VECTORS; k++)
        level->vector[k] = level->vector[0] + (size_t)k * nodes;
    level->room = room;
    return true;
}

/* --- places --- */

/* A coarse cell: x is at (place - from) * over, with the place in cells of the grid. */
typedef struct CoarseCell {
    int at[3];
    float from[3], over[3];
    size_t number;
} CoarseCell;

/* The coarse cell around a cell of the grid. */
static CoarseCell around(const Cpu *cpu, uint32_t cell)
{
    const CoarseShape *shape = &cpu->coarse->shape;
    const CellGrid *cells = &cpu->constants->cells;
    const uint32_t width = (uint32_t)cells->size[0], height = (uint32_t)cells->size[1];
    const int grid[3] = {(int)(cell % width), (int)(cell / width % height), (int)(cell / width / height)};
    CoarseCell found = {.number = 0};
    for (int k = 2; k >= 0; k--) {
        const int last = shape->count[k] - 1, inner = grid[k] > 1 ? grid[k] - 1 : 0,
                  at = inner / shape->wide < last ? inner / shape->wide : last;
        found.at[k] = at;
        found.from[k] = (float)(cells->first[k] + 1 + at * shape->wide);
        found.over[k] = 1 / (float)(at < last ? shape->wide : shape->inner[k] - at * shape->wide);
        found.number = found.number * (size_t)shape->count[k] + (size_t)at;
    }
    return found;
}

/* Not a number: `low`. Without libm: fminf is a call on baseline x86-64. */
static inline float bounded(float x, float low, float high)
{
    return x > low ? (x < high ? x : high) : low;
}

/* Particle i in a coarse cell, 0 to 1 along each axis. */
static inline void place_in(const Cpu *cpu, const CoarseCell *cell, size_t i, float at[3])
{
    const CellGrid *cells = &cpu->constants->cells;
    const float x[3] = {cpu->now.x[i], cpu->now.y[i], cpu->now.z[i]};
    at[0] = at[1] = at[2] = 0;
    for (int k = 0; k < 3 && k < cpu->constants->dimensions; k++)
        at[k] =
            bounded(((x[k] - cells->origin[k]) * cells->inverse[k] - cell->from[k]) * cell->over[k], 0, 1);
}

/* --- sums over particles --- */

typedef struct CoarseJob {
    Cpu *cpu;
    const CoarseTerms *terms;
} CoarseJob;

static inline f4 squares(float x)
{
    return (f4){(1 - x) * (1 - x), x * (1 - x), x * x, 0};
}

static inline void add_particle(const CoarseTerms *terms, size_t i, const float at[3], CellSums *sum)
{
    const f4 qx = squares(at[0]), qy = squares(at[1]), qz = squares(at[2]);
    const float weight = terms->weight[i], hold = bounded(terms->hold[i], 0, COARSE_PART_MOST),
                residual = bounded(terms->residual[i], -COARSE_PART_MOST, COARSE_PART_MOST);
    for (int b = 0; b < 3; b++) {
        sum->slope[0][b] += weight * qy[b] * qz;
        sum->slope[1][b] += weight * qx[b] * qz;
        sum->slope[2][b] += weight * qx[b] * qy;
    }
    if (hold > 0) {
        sum->holds = true;
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                sum->hold[a][b] += hold * qx[a] * qy[b] * qz;
    }
    const f4 flat = {(1 - at[0]) * (1 - at[1]), at[0] * (1 - at[1]), (1 - at[0]) * at[1], at[0] * at[1]};
    sum->residual[0] += residual * (1 - at[2]) * flat;
    sum->residual[1] += residual * at[2] * flat;
}

static int64_t integer_of(float part)
{
    return (int64_t)((double)part * FIXED);
}

static void add_cell(CoarseSums *to, const CellSums *sum)
{
    for (int k = 0; k < 27; k++)
        to->slope[k / 9][k % 9] += integer_of(sum->slope[k / 9][k / 3 % 3][k % 3]);
    for (int k = 0; sum->holds && k < 27; k++)
        to->hold[k] += integer_of(sum->hold[k / 9][k / 3 % 3][k % 3]);
    for (int c = 0; c < CORNERS; c++)
        to->residual[c] += integer_of(sum->residual[c >> 2][c & 3]);
}

/* Cells of the grid in sequence mostly share a coarse cell: `part` has the sums, and is 0 again after. */
static void hand_over(CoarseSums *to, CoarseSums *part)
{
    int64_t *const whole = (int64_t *)(void *)to, *const more = (int64_t *)(void *)part;
    for (size_t k = 0; k < sizeof *to / sizeof *whole; k++)
        if (more[k] != 0)
            __atomic_fetch_add(&whole[k], more[k], __ATOMIC_RELAXED);
    memset(part, 0, sizeof *part);
}

static void sum_range(void *context, size_t begin, size_t end)
{
    const CoarseJob *job = context;
    const Cpu *cpu = job->cpu;
    CoarseLevel *level = cpu->coarse;
    CoarseSums part = {0};
    size_t number = SIZE_MAX;
    const size_t last = cpu_cell_first(cpu, end);
    for (size_t k = cpu_cell_first(cpu, begin); k < last;) {
        const CoarseCell cell = around(cpu, cpu->cell[cpu_owned(cpu, k)]);
        CellSums sum = {.holds = false};
        if (number != SIZE_MAX && number != cell.number)
            hand_over(&level->sums[level->at[number]], &part);
        number = cell.number;
        do {
            const size_t i = cpu_owned(cpu, k);
            float at[3];
            place_in(cpu, &cell, i, at);
            add_particle(job->terms, i, at, &sum);
        } while (++k < last && cpu_cell_goes_on(cpu, k));
        add_cell(&part, &sum);
    }
    if (number != SIZE_MAX)
        hand_over(&level->sums[level->at[number]], &part);
}

/* --- cells and nodes with fluid --- */

static void mark_range(void *context, size_t begin, size_t end)
{
    const CoarseJob *job = context;
    const Cpu *cpu = job->cpu;
    for (size_t k = begin; k < end; k++)
        if (k == begin || !cpu_cell_goes_on(cpu, k))
            __atomic_store_n(&cpu->coarse->fluid[around(cpu, cpu->cell[cpu_owned(cpu, k)]).number], 1,
                             __ATOMIC_RELAXED);
}

static size_t node_of(const CoarseLevel *level, size_t cell, int corner)
{
    size_t node = 0;
    const size_t row = cell / (size_t)level->shape.count[0], slice = row / (size_t)level->shape.count[1];
    const size_t at[3] = {cell % (size_t)level->shape.count[0], row % (size_t)level->shape.count[1], slice};
    for (int k = 2; k >= 0; k--) {
        const size_t along = (size_t)level->shape.along[k], place = at[k] + (corner >> k & 1);
        node = node * along + (place < along ? place : 0); /* across a periodic side; z in the plane */
    }
    return node;
}

/* Numbers the cells with fluid in the order of the box. */
static void number_cells(CoarseLevel *level)
{
    level->used = 0;
    for (size_t k = 0; k < level->shape.cells; k++)
        level->at[k] = level->fluid[k] > 0 ? (int32_t)level->used++ : NONE;
}

static void number_nodes(CoarseLevel *level)
{
    memset(level->node_at, NONE, level->shape.nodes * sizeof *level->node_at);
    level->used_nodes = 0;
    for (size_t k = 0; k < level->shape.cells; k++)
        for (int c = 0; level->at[k] != NONE && c < CORNERS; c++) {
            int32_t *node = &level->node_at[node_of(level, k, c)];
            if (*node == NONE)
                *node = (int32_t)level->used_nodes++;
            level->corner[level->at[k]][c] = *node;
        }
}

/* The sum of l_a l_b over both corners is q_0 + 2 q_1 + q_2 = 1. */
static bool is_thin(const CoarseLevel *level)
{
    static const double times[3] = {1, 2, 1};
    double hold = 0, weight = 0;
    for (size_t k = 0; k < level->used; k++)
        for (int b = 0; b < 3; b++)
            for (int c = 0; c < 3; c++) {
                const CoarseSums *sums = &level->sums[k];
                weight += times[b] * times[c] * (double)sums->slope[0][3 * b + c];
                for (int a = 0; a < 3; a++)
                    hold += times[a] * times[b] * times[c] * (double)sums->hold[9 * a + 3 * b + c];
            }
    return !(hold < (double)COARSE_THIN * weight);
}

/* --- the system of the nodes --- */

/* sum over the cell's particles of weight h grad . h grad + hold; `cell`: the place. */
static void fill_matrix(const Cpu *cpu, const int cell[3], const CoarseSums *sums, CornerMatrix matrix)
{
    const CoarseLevel *level = cpu->coarse;
    double over[3] = {0};
    for (int k = 0; k < 3 && k < cpu->constants->dimensions; k++) {
        const int cells = cell[k] < level->shape.count[k] - 1
                              ? level->shape.wide
                              : level->shape.inner[k] - cell[k] * level->shape.wide;
        const double width =
            cells / (double)(cpu->constants->cells.inverse[k] * cpu->constants->support_radius);
        over[k] = 1 / (FIXED * width * width);
    }
    for (int a = 0; a < CORNERS; a++)
        for (int b = 0; b < CORNERS; b++) {
            const int x = (a & 1) + (b & 1), y = (a >> 1 & 1) + (b >> 1 & 1), z = (a >> 2) + (b >> 2),
                      other[3] = {3 * y + z, 3 * x + z, 3 * x + y};
            double sum = (double)sums->hold[9 * x + 3 * y + z] / FIXED;
            for (int k = 0; k < 3; k++)
                sum += ((a ^ b) >> k & 1 ? -over[k] : over[k]) * (double)sums->slope[k][other[k]];
            matrix[a][b] = sum;
        }
}

static void assemble(const Cpu *cpu)
{
    CoarseLevel *level = cpu->coarse;
    double *residual = level->vector[RESIDUAL], *inverse = level->vector[INVERSE];
    memset(residual, 0, level->used_nodes * sizeof *residual);
    memset(inverse, 0, level->used_nodes * sizeof *inverse);
    for (size_t k = 0; k < level->shape.cells; k++) {
        if (level->at[k] == NONE)
            continue;
        const size_t at = (size_t)level->at[k], row = k / (size_t)level->shape.count[0];
        const int cell[3] = {(int)(k % (size_t)level->shape.count[0]),
                             (int)(row % (size_t)level->shape.count[1]),
                             (int)(row / (size_t)level->shape.count[1])};
        fill_matrix(cpu, cell, &level->sums[at], level->matrix[at]);
        for (int c = 0; c < CORNERS; c++) {
            residual[level->corner[at][c]] += (double)level->sums[at].residual[c] / FIXED;
            inverse[level->corner[at][c]] += level->matrix[at][c][c];
        }
    }
    for (size_t k = 0; k < level->used_nodes; k++)
        inverse[k] = inverse[k] > 0 ? 1 / inverse[k] : 0;
}

/* to = matrix x */
static void multiply(const CoarseLevel *level, const double *x, double *to)
{
    memset(to, 0, level->used_nodes * sizeof *to);
    for (size_t k = 0; k < level->used; k++) {
        const int32_t *corner = level->corner[k];
        double at[CORNERS], sum[CORNERS] = {0};
        for (int c = 0; c < CORNERS; c++)
            at[c] = x[corner[c]];
        for (int b = 0; b < CORNERS; b++)
            for (int a = 0; a < CORNERS; a++)
                sum[a] += level->matrix[k][b][a] * at[b];
        for (int c = 0; c < CORNERS; c++)
            to[corner[c]] += sum[c];
    }
}

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t k = 0; k < count; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Residual over the square root of the diagonal, squared. */
static double power_of(const CoarseLevel *level)
{
    const double *residual = level->vector[RESIDUAL], *inverse = level->vector[INVERSE];
    double sum = 0;
    for (size_t k = 0; k < level->used_nodes; k++)
        sum += residual[k] * residual[k] * inverse[k];
    return sum;
}

/* Conjugate gradients, with the diagonal as preconditioner, until `left` of the residual is left. */
static void solve(CoarseLevel *level, double left)
{
    const size_t count = level->used_nodes;
    double *value = level->vector[VALUE], *residual = level->vector[RESIDUAL],
           *direction = level->vector[DIRECTION], *bent = level->vector[BENT], power = power_of(level);
    const double *inverse = level->vector[INVERSE], enough = left * left * power;
    memset(value, 0, count * sizeof *value);
    for (size_t k = 0; k < count; k++)
        direction[k] = inverse[k] * residual[k];
    for (int done = 0; power > enough && done < COARSE_ITERATIONS_MOST; done++) {
        multiply(level, direction, bent);
        const double curvature = dot(direction, bent, count), go = curvature > 0 ? power / curvature : 0,
                     before = power;
        for (size_t k = 0; k < count; k++) {
            value[k] += go * direction[k];
            residual[k] -= go * bent[k];
        }
        power = go > 0 ? power_of(level) : 0;
        for (size_t k = 0; k < count; k++)
            direction[k] = inverse[k] * residual[k] + power / before * direction[k];
    }
}

/* --- back to the particles --- */

static void add_range(void *context, size_t begin, size_t end)
{
    const CoarseJob *job = context;
    const CoarseTerms *terms = job->terms;
    const Cpu *cpu = job->cpu;
    const CoarseLevel *level = cpu->coarse;
    CoarseCell cell = {.number = 0};
    float of[CORNERS] = {0};
    for (size_t k = begin; k < end; k++) {
        const size_t i = cpu_owned(cpu, k);
        float at[3], sum[4];
        if (k == begin || !cpu_cell_goes_on(cpu, k)) {
            cell = around(cpu, cpu->cell[i]);
            for (int c = 0; c < CORNERS; c++)
                of[c] = (float)level->vector[VALUE][level->corner[level->at[cell.number]][c]];
        }
        if (!(terms->weight[i] > 0))
            continue;
        place_in(cpu, &cell, i, at);
        for (int c = 0; c < 4; c++)
            sum[c] = (1 - at[2]) * of[c] + at[2] * of[4 + c];
        const float low = (1 - at[0]) * sum[0] + at[0] * sum[1], high = (1 - at[0]) * sum[2] + at[0] * sum[3],
                    now = terms->value[i] + terms->scale * ((1 - at[1]) * low + at[1] * high);
        terms->value[i] = now > 0 || terms->negative ? now : 0;
    }
}

/* True if all ranks have memory. */
static bool all_have(Cpu *cpu, bool has)
{
    int64_t lacks = !has;
    if (cpu->add_all)
        cpu->add_all(&lacks, 1);
    cpu->watch.memory |= lacks > 0;
    return lacks == 0;
}

void cpu_coarse_correct(Cpu *cpu, const CoarseTerms *terms)
{
    enum { GRAIN = 8 * CPU_GRAIN };
    CoarseJob job = {cpu, terms};
    if (!cpu->coarse)
        cpu->coarse = create(cpu->constants);
    if (!all_have(cpu, cpu->coarse != NULL))
        return;
    CoarseLevel *level = cpu->coarse;
    memset(level->fluid, 0, level->shape.cells * sizeof *level->fluid);
    parallel_ranges(cpu->threads, cpu->owned, GRAIN, mark_range, &job);
    if (cpu->add_all)
        cpu->add_all(level->fluid, level->shape.cells);
    number_cells(level);
    if (!all_have(cpu, make_room(level)) || level->used == 0)
        return;
    number_nodes(level);
    memset(level->sums, 0, level->used * sizeof *level->sums);
    parallel_ranges(cpu->threads, cpu->owned, GRAIN, sum_range, &job);
    if (cpu->add_all)
        cpu->add_all((int64_t *)(void *)level->sums, level->used * (sizeof *level->sums / sizeof(int64_t)));
    cpu->thin = is_thin(level);
    if (cpu->thin)
        return;
    assemble(cpu);
    solve(level, terms->left);
    parallel_ranges(cpu->threads, cpu->owned, GRAIN, add_range, &job);
}
