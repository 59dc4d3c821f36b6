#include "sim/flow/flow.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

long emit_layers(const Emit *emit, double spacing, double begin, double end, long *first)
{
    const double each = spacing / emit->speed, slack = 1e-9;
    const double from = begin - emit->start;
    const double to = emit->duration > 0 ? fmin(end - emit->start, emit->duration) : end - emit->start;
    *first = (long)fmax(0, ceil(from / each - slack));
    const long after = (long)ceil(to / each - slack);
    return after > *first ? after - *first : 0;
}

/* Two unit vectors across the emitter's direction; in two dimensions the second leaves the plane. */
static void across(const Emit *emit, int dimensions, double a[3], double b[3])
{
    const double *d = emit->direction, norm = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double u[3] = {d[0] / norm, d[1] / norm, d[2] / norm};
    if (dimensions == 2) {
        a[0] = -u[1], a[1] = u[0], a[2] = 0;
        b[0] = b[1] = 0, b[2] = 1;
        return;
    }
    int least = 0; /* axis most across the direction */
    for (int k = 1; k < 3; k++)
        if (fabs(u[k]) < fabs(u[least]))
            least = k;
    double e[3] = {0};
    e[least] = 1;
    cross_product(u, e, a);
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int k = 0; k < 3; k++)
        a[k] /= length;
    cross_product(u, a, b);
}

double emit_time(const Emit *emit, double spacing, long index)
{
    return emit->start + (double)index * spacing / emit->speed;
}

/* Points (u / 2, v / 2) spacings of the lattice, u and v odd or even by `odd`: all points within the rim, and
   a share of the points on the rim. The `square` of a point is u^2 + v^2. */
typedef struct Pattern {
    int odd[2];
    bool line;     /* v is 0 */
    long rim;      /* square of the points on the rim */
    long whole;    /* points within the rim */
    long on_rim;   /* points on the rim */
    double filled; /* points on the rim with a particle, per layer */
} Pattern;

/* Greatest number, odd or even by `odd`, whose square is at most `square`; negative: none. */
static long greatest(long square, int odd)
{
    long u = square < 0 ? -1 : (long)sqrt((double)square);
    u -= u > 0 && u * u > square;
    return u % 2 == odd ? u : u - 1;
}

/* Number of points with a square of at most `most`. */
static long points_within(const Pattern *p, long most)
{
    const long top = p->line ? 0 : greatest(most, p->odd[1]);
    long count = 0;
    for (long v = -top; v <= top; v += 2)
        count += most >= v * v ? greatest(most - v * v, p->odd[0]) + 1 : 0;
    return count;
}

/* Pattern with so many particles per layer. */
static Pattern pattern_of(int odd_u, int odd_v, bool line, double particles)
{
    Pattern p = {.odd = {odd_u, odd_v}, .line = line};
    long low = -1, high = 4; /* the rim is in (low, high] */
    while ((double)points_within(&p, high) <= particles)
        high *= 2;
    while (high - low > 1) {
        const long middle = low + (high - low) / 2;
        if ((double)points_within(&p, middle) <= particles)
            low = middle;
        else
            high = middle;
    }
    p.rim = high;
    p.whole = points_within(&p, low);
    p.on_rim = points_within(&p, high) - p.whole;
    p.filled = fmax(particles - (double)p.whole, 0);
    return p;
}

/* Sum of the squares of a layer's points. */
static double moment(const Pattern *p)
{
    const long top = p->line ? 0 : greatest(p->rim, p->odd[1]);
    double sum = p->filled * (double)p->rim;
    for (long v = -top; v <= top; v += 2) {
        const double n = (double)(greatest(p->rim - 1 - v * v, p->odd[0]) + 1); /* n numbers, 2 apart */
        sum += n > 0 ? n * ((n * n - 1) / 3 + (double)(v * v)) : 0;
    }
    return sum;
}

/* The roundest pattern: least moment. */
static Pattern pattern_for(const Emit *emit, int dimensions, double spacing)
{
    const double r = (1 + 1e-9) * emit->radius / spacing;
    const bool line = dimensions == 2;
    Pattern best = pattern_of(0, 0, line, line ? 2 * r : M_PI * r * r);
    for (int odd = 1; odd < (line ? 2 : 4); odd += line ? 1 : 2) { /* (1, 0) or (1, 1), as (0, 1) is (1, 0) */
        const Pattern other = pattern_of(1, odd / 2, line, line ? 2 * r : M_PI * r * r);
        best = moment(&other) < moment(&best) ? other : best;
    }
    return best;
}

size_t emit_most(const Emit *emit, int dimensions, double spacing)
{
    const Pattern p = pattern_for(emit, dimensions, spacing);
    return (size_t)(p.whole + p.on_rim);
}

/* True if place `number` on the rim, counted over all layers, has a particle. */
static bool is_filled(const Pattern *p, double number)
{
    const double share = p->filled / (double)p->on_rim;
    return floor((number + 1) * share + 0.5) > floor(number * share + 0.5);
}

void emit_place(const Emit *emit, int dimensions, double spacing, long index, double time, EmitLayer *layer)
{
    const double *d = emit->direction, norm = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double way = (time - emit_time(emit, spacing, index)) * emit->speed;
    const Pattern pattern = pattern_for(emit, dimensions, spacing);
    const long top = pattern.line ? 0 : greatest(pattern.rim, pattern.odd[1]);
    double a[3], b[3], number = (double)index * (double)pattern.on_rim;
    across(emit, dimensions, a, b);
    layer->count = 0;
    for (int k = 0; k < 3; k++)
        layer->velocity[k] = (float)(emit->speed * d[k] / norm);
    for (long v = -top; v <= top; v += 2) {
        const long reach = greatest(pattern.rim - v * v, pattern.odd[0]);
        for (long u = -reach; u <= reach; u += 2) {
            if (u * u + v * v == pattern.rim && !is_filled(&pattern, number++))
                continue;
            const double p = 0.5 * (double)u * spacing, q = 0.5 * (double)v * spacing;
            for (int k = 0; layer->position && k < 3; k++)
                layer->position[3 * layer->count + (size_t)k] =
                    (float)(emit->centre[k] + way * d[k] / norm + p * a[k] + q * b[k]);
            layer->count++;
        }
    }
}

Guide flow_guide(const WorldDef *def, int fluid, const Emit *emit)
{
    const double *d = emit->direction, norm = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    Guide guide = {.fluid = fluid,
                   .radius = (float)(emit->radius + 0.5 * def->spacing),
                   .depth = (float)(def->support * def->spacing)};
    for (int k = 0; k < 3; k++) {
        guide.centre[k] = (float)emit->centre[k];
        guide.direction[k] = (float)(d[k] / norm);
        guide.velocity[k] = (float)(emit->speed * d[k] / norm);
    }
    return guide;
}

void gate_name(int gate, char name[GATE_NAME_SIZE])
{
    if (gate < EMITTERS_MAX)
        snprintf(name, GATE_NAME_SIZE, "fluids[%d].emit[%d]", gate / EMITS_MAX, gate % EMITS_MAX);
    else
        snprintf(name, GATE_NAME_SIZE, "drains[%d]", gate - EMITTERS_MAX);
}

int gate_find(const char *name)
{
    char own[GATE_NAME_SIZE];
    for (int gate = 0; gate < GATES_MAX; gate++) {
        gate_name(gate, own);
        if (strcmp(own, name) == 0)
            return gate;
    }
    return -1;
}

uint64_t flow_closed_gates(const WorldDef *def)
{
    uint64_t closed = 0;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            closed |= (uint64_t)def->fluids[f].emits[i].closed << gate_of_emitter(f, i);
    for (int k = 0; k < def->drain_count; k++)
        closed |= (uint64_t)def->drains[k].closed << gate_of_drain(k);
    return closed;
}

int flow_guides(const WorldDef *def, double time, uint64_t closed, Guide guides[EMITTERS_MAX])
{
    int count = 0;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++) {
            const Emit *emit = &def->fluids[f].emits[i];
            if (!gate_is_closed(closed, gate_of_emitter(f, i)) && time >= emit->start &&
                (emit->duration == 0 || time < emit->start + emit->duration))
                guides[count++] = flow_guide(def, f, emit);
        }
    return count;
}

bool flow_emits(const WorldDef *def)
{
    int emits = 0;
    for (int f = 0; f < def->fluid_count; f++)
        emits += def->fluids[f].emit_count;
    return emits > 0 || def->pours;
}

size_t flow_capacity(const WorldDef *def, size_t initial)
{
    const size_t most = (size_t)def->most;
    return flow_emits(def) && most > initial ? most : initial;
}

static bool emit_check(const Emit *emit, int dimensions, double spacing)
{
    const double *d = emit->direction, norm2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    return emit->speed > 0 && emit->speed < INFINITY && emit->radius > 0 && emit->radius < INFINITY &&
           emit->radius < 1e4 * spacing && norm2 > 0 && norm2 < INFINITY && emit->duration >= 0 &&
           emit->start >= 0 && (dimensions == 3 || (d[2] == 0 && emit->centre[2] == 0));
}

bool flow_check(const WorldDef *def, Error *error)
{
    if (def->drain_count < 0 || def->drain_count > DRAINS_MAX)
        return error_set(error, "a world has up to %d drains, not %d", DRAINS_MAX, def->drain_count);
    if (flow_emits(def) && def->most < 1)
        return error_set(error, "a world with emitters may hold at least 1 particle, not %d", def->most);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        if (fluid->emit_count < 0 || fluid->emit_count > EMITS_MAX)
            return error_set(error, "a fluid has up to %d emitters, not %d", EMITS_MAX, fluid->emit_count);
        for (int i = 0; i < fluid->emit_count; i++)
            if (!emit_check(&fluid->emits[i], def->dimensions, def->spacing))
                return error_set(
                    error,
                    "fluid %d, emitter %d: speed, radius and direction must not be zero, nor the radius 10,000 spacings, nor may it leave the plane of a 2D scene",
                    f, i);
    }
    return true;
}
