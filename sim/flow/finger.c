#include "sim/flow/flow.h"

#include "sim/base/key_rows.h"
#include "sim/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* s: a mouse reports positions in jumps of some 10 ms, which the fluid must not feel. */
static const double RESPONSE = 0.03;

/* Maximum of w q, at q^2 = 1/5. */
static const double PEAK = 0.28621670111997307;

bool finger_take(FingerState *state, const Finger *wanted, int dimensions)
{
    const FingerWay way = (FingerWay)wanted->way;
    const bool begins = !finger_on(state);
    if (wanted->way == (double)FINGER_NONE) {
        *state = (FingerState){.point = {0}};
        return true;
    }
    if (!(wanted->way > 0 && wanted->way < FINGER_POUR + FINGER_FLUIDS) || (double)way != wanted->way ||
        !isfinite(wanted->at[0] + wanted->at[1] + wanted->at[2]) || !(wanted->radius > 0) ||
        !isfinite(wanted->radius) || !(wanted->strength >= 0) || !isfinite(wanted->strength) ||
        (finger_fluid(wanted) >= 0 && !(wanted->strength > 0)))
        return false;
    state->wanted = *wanted;
    if (dimensions == 2)
        state->wanted.at[2] = 0;
    if (begins)
        memcpy(state->point, state->wanted.at, sizeof state->point);
    return true;
}

bool finger_sound(const FingerState *state)
{
    FingerState taken = {.point = {0}};
    return finger_take(&taken, &state->wanted, 3) &&
           isfinite(state->point[0] + state->point[1] + state->point[2]);
}

double finger_acceleration(const FingerState *state)
{
    return state->wanted.way == (double)FINGER_PULL || state->wanted.way == (double)FINGER_PUSH
               ? state->wanted.strength
               : 0;
}

/* Follows by an implicit step: stable for every dt, no library function. */
static void follow(FingerState *state, double dt, double moved[3])
{
    const double u = dt / RESPONSE;
    for (int k = 0; k < 3; k++) {
        moved[k] = (state->wanted.at[k] - state->point[k]) * u / (1 + u);
        state->point[k] += moved[k];
    }
}

void finger_step(FingerState *state, const FingerLimits *limits, double dt, FingerStep *step)
{
    const Finger *wanted = &state->wanted;
    double moved[3];
    *step = (FingerStep){.on = false};
    if (!finger_on(state))
        return;
    follow(state, dt, moved);
    step->on = finger_fluid(wanted) < 0;
    const double speed = sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]) / dt;
    const double slower = speed > limits->speed ? limits->speed / speed : 1;
    for (int k = 0; k < 3; k++) {
        step->at[k] = (float)(state->point[k] - 0.5 * moved[k]);
        step->velocity[k] = (float)(slower * moved[k] / dt);
    }
    step->radius = (float)wanted->radius;
    step->inverse_radius2 = (float)(1 / (wanted->radius * wanted->radius));
    const double gain = fmin(wanted->strength * dt, limits->gain) / (PEAK * wanted->radius);
    if (wanted->way == (double)FINGER_STIR)
        step->grip = (float)fmin(wanted->strength * dt, 1e6);
    else
        step->kick = (float)(wanted->way == (double)FINGER_PUSH ? gain : -gain);
}

#define AT(field) offsetof(TouchDef, field)

/* Values at strength 1: stirred fluid takes the pointer's speed within some pictures; a pull lifts water
   against gravity and holds a handful. */
static const double STIR_RATE = 40, ACCELERATION = 40; /* 1/s; m/s2 */

/* Poured fluid has the speed after a fall of FALL spacings, and half the ball's width: some 20 particles
   per layer. */
static const double FALL = 4, WIDTH = 0.5, G = 9.81;

const TouchWay touch_ways[] = {
    {"stir", "the fluid goes along with the pointer"}, {"pull", "the fluid comes to the pointer"},
    {"push", "the fluid goes away from the pointer"},  {"pour", "fluid comes from the pointer"},
    {"hold", "solids go along with the pointer"},      {0}};

/* clang-format off */
const Key touch_keys[] = {
    MAPPING("touch", "how a user touches the fluid in the window"),
    CHOICE_OF("touch.way", L | I | KEY_INDEX, touch_ways, AT(way), "what the left button does"),
    NUMBER("touch.radius", L | I, "spacings", 1, 100, AT(radius), "of the ball about the pointer in which the fluid feels it"),
    NUMBER("touch.strength", L | I, "", 0.01, 100, AT(strength), "1: stirred fluid follows within 25 ms, pull and push reach 40 m/s2, poured fluid is as fast as what falls over 4 spacings, at most 0.3 of sound"),
    INTEGER("touch.fluid", L | I, 0, FINGER_FLUIDS - 1, AT(fluid), "which fluid is poured: 0 is fluids[0]; beyond the last one that"),
    KEYS_END,
};
/* clang-format on */

TouchDef touch_def_default(void)
{
    return (TouchDef){
        .way = FINGER_STIR - 1,
        .radius = 5, /* a hand in a box of some 30 spacings */
        .strength = 1,
    };
}

double touch_radius(const TouchDef *def, FingerWay way, double spacing)
{
    return (way == FINGER_POUR ? WIDTH : 1) * def->radius * spacing;
}

Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing)
{
    const bool pours = way == FINGER_POUR;
    const double unit = pours ? sqrt(2 * G * FALL * spacing) : way == FINGER_STIR ? STIR_RATE : ACCELERATION;
    return (Finger){.way = (double)way + (pours ? def->fluid : 0),
                    .at = {at[0], at[1], at[2]},
                    .radius = touch_radius(def, way, spacing),
                    .strength = def->strength * unit};
}

const char *finger_way_name(FingerWay way)
{
    return way == FINGER_NONE ? "none" : touch_ways[(way < FINGER_POUR ? way : FINGER_POUR) - 1].name;
}

FingerWay finger_way_find(const char *name)
{
    int way = FINGER_NONE;
    while (way < FINGER_WAYS && strcmp(finger_way_name((FingerWay)way), name) != 0)
        way++;
    return (FingerWay)way;
}

/* Spacings: greatest distance of a touch, less than a lattice's diagonal; and of a neighbour able to cover a
   face. */
static const double TOUCH = 1.3, COVER = 1.6;

/* A neighbour covers a face alone if the direction to the neighbour has a greater cosine to the face's
   normal. A lattice's diagonal has less. */
static const double STRAIGHT = 0.75;

/* Several neighbours with cosines above AROUND cover a face together if they stand around the face's middle:
   their mean direction across the normal is shorter than ASIDE. At a step of a surface all are on one
   side. */
static const double AROUND = 0.5, ASIDE = 0.4;

/* A wall closes faces of particles within WALL spacings: fills keep half a spacing from walls. A solid closes
   a face if the point a spacing behind is within SOLID spacings of the solid: there a lattice has no
   points. */
static const double WALL = 1, SOLID = 0.75;

/* Particles by cell, of side COVER spacings at least. */
typedef struct PourBins {
    const WorldDef *def;
    const Periodic *periodic;
    const float *position;
    double low[3], inverse[3]; /* m, 1/m */
    long size[3];
    size_t *begin;
    uint32_t *particle;
    BoxState pose[SOLIDS_MAX]; /* of the solids */
} PourBins;

static long cell_along(const PourBins *bins, int k, double x)
{
    const long cell = (long)floor((x - bins->low[k]) * bins->inverse[k]);
    return cell < 0 ? 0 : cell < bins->size[k] ? cell : bins->size[k] - 1;
}

static size_t cell_of(const PourBins *bins, const float x[3])
{
    return (size_t)((cell_along(bins, 2, x[2]) * bins->size[1] + cell_along(bins, 1, x[1])) * bins->size[0] +
                    cell_along(bins, 0, x[0]));
}

static void bins_shape(PourBins *bins, size_t count)
{
    const WorldDef *def = bins->def;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            low = fmin(low, bins->position[3 * i + (size_t)k]);
            high = fmax(high, bins->position[3 * i + (size_t)k]);
        }
        if (bins->periodic->axis[k]) {
            low = bins->periodic->low[k];
            high = low + bins->periodic->size[k];
        }
        bins->low[k] = low;
        bins->size[k] = (long)fmax(1, floor((high - low) / (COVER * def->spacing)));
        bins->inverse[k] = (double)bins->size[k] / fmax(high - low, def->spacing);
    }
}

static bool bins_create(PourBins *bins, size_t count, const uint8_t *fluid, const bool take[FLUIDS_MAX])
{
    bins_shape(bins, count);
    const size_t cells = (size_t)(bins->size[0] * bins->size[1] * bins->size[2]);
    bins->begin = calloc(cells + 2, sizeof *bins->begin);
    bins->particle = malloc((count + 1) * sizeof *bins->particle);
    if (!bins->begin || !bins->particle)
        return false;
    for (size_t i = 0; i < count; i++)
        if (take[fluid[i]])
            bins->begin[cell_of(bins, bins->position + 3 * i) + 2]++;
    for (size_t c = 2; c < cells + 2; c++)
        bins->begin[c] += bins->begin[c - 1];
    for (size_t i = 0; i < count; i++)
        if (take[fluid[i]])
            bins->particle[bins->begin[cell_of(bins, bins->position + 3 * i) + 1]++] = (uint32_t)i;
    return true;
}

/* Cells next to `cell` along an axis, including `cell`; returns their number. */
static int cells_near(const PourBins *bins, int k, long cell, long near[3])
{
    const long size = bins->size[k];
    int count = 0;
    for (long d = -1; d <= 1 && count < size; d++) {
        const long other = bins->periodic->axis[k] ? (cell + d + size) % size : cell + d;
        if (other >= 0 && other < size)
            near[count++] = other;
    }
    return count;
}

/* Neighbours behind the faces of a particle. */
typedef struct SurfaceCover {
    unsigned straight;  /* faces with a neighbour straight behind */
    int around[6];      /* number of neighbours roughly behind each face */
    double aside[6][3]; /* sums of their directions across the face's normal */
} SurfaceCover;

/* Add a neighbour at `way`, r m away. */
static void cover(SurfaceCover *to, const float way[3], double r)
{
    for (int k = 0; k < 3; k++) {
        const int bit = 2 * k + (way[k] > 0);
        if (fabs((double)way[k]) > STRAIGHT * r)
            to->straight |= 1U << bit;
        if (fabs((double)way[k]) <= AROUND * r)
            continue;
        to->around[bit]++;
        for (int a = 0; a < 3; a++)
            to->aside[bit][a] += a == k ? 0 : (double)way[a] / r;
    }
}

static bool covers_together(const SurfaceCover *from, int bit)
{
    const double *aside = from->aside[bit], most = ASIDE * from->around[bit];
    return from->around[bit] > 1 &&
           aside[0] * aside[0] + aside[1] * aside[1] + aside[2] * aside[2] < most * most;
}

/* Add the touches of particle i in a cell; NULL only adds to `faces` and counts. */
static size_t touch_cell(const PourBins *bins, size_t i, size_t cell, Touch *to, SurfaceCover *faces)
{
    const double spacing = bins->def->spacing;
    size_t found = 0;
    for (size_t k = bins->begin[cell]; k < bins->begin[cell + 1]; k++) {
        const size_t j = bins->particle[k];
        Touch touch = {.other = (uint32_t)j};
        for (size_t a = 0; a < 3; a++)
            touch.way[a] = bins->position[3 * j + a] - bins->position[3 * i + a];
        periodic_nearest(bins->periodic, touch.way);
        const double r = sqrt((double)(touch.way[0] * touch.way[0] + touch.way[1] * touch.way[1] +
                                       touch.way[2] * touch.way[2]));
        if (j == i || r > COVER * spacing)
            continue;
        cover(faces, touch.way, r);
        if (r > TOUCH * spacing || r < 0.01 * spacing)
            continue;
        touch.weight = (float)(1 / (r * r));
        if (to)
            to[found] = touch;
        found++;
    }
    return found;
}

static size_t touch_all(const PourBins *bins, size_t i, Touch *to, SurfaceCover *faces)
{
    long near[3][3];
    int count[3];
    size_t found = 0;
    for (int k = 0; k < 3; k++)
        count[k] = cells_near(bins, k, cell_along(bins, k, bins->position[3 * i + (size_t)k]), near[k]);
    for (int z = 0; z < count[2]; z++)
        for (int y = 0; y < count[1]; y++)
            for (int x = 0; x < count[0]; x++) {
                const long cell = (near[2][z] * bins->size[1] + near[1][y]) * bins->size[0] + near[0][x];
                found += touch_cell(bins, i, (size_t)cell, to ? to + found : NULL, faces);
            }
    return found;
}

void touch_normal(int bit, double normal[3])
{
    for (int k = 0; k < 3; k++)
        normal[k] = k != bit / 2 ? 0 : bit % 2 ? 1 : -1;
}

static bool wall_closes(const WorldDef *def, int bit, const float x[3])
{
    const int k = bit / 2;
    const double low = k == 1 ? 0 : -0.5 * def->box_size[k], reach = WALL * def->spacing;
    if (def->periodic[k])
        return false;
    return bit % 2 ? low + def->box_size[k] - x[k] < reach : x[k] - low < reach;
}

/* The rest of the way to a solid's surface from half a spacing towards the solid. */
static void gap_at(const PourBins *bins, int s, const float x[3], float gap[3])
{
    const WorldDef *def = bins->def;
    double d[3], normal[3];
    for (int a = 0; a < 3; a++)
        d[a] = x[a] - bins->pose[s].position[a];
    quat_rotate_inverse(bins->pose[s].orientation, d, d);
    const double left = solid_distance(&def->solids[s], def->dimensions, d) - 0.5 * def->spacing;
    solid_normal(&def->solids[s], def->dimensions, d, normal);
    quat_rotate(bins->pose[s].orientation, normal, normal);
    for (int a = 0; a < 3; a++)
        gap[a] = (float)(-fmax(left, 0) * normal[a]);
}

/* The solid behind the face; -1: no solid closes the face. */
static int solid_closes(const PourBins *bins, int bit, const float x[3])
{
    const WorldDef *def = bins->def;
    double normal[3];
    touch_normal(bit, normal);
    for (int s = 0; s < def->solid_count; s++) {
        double d[3];
        for (int a = 0; a < 3; a++)
            d[a] = x[a] + def->spacing * normal[a] - bins->pose[s].position[a];
        quat_rotate_inverse(bins->pose[s].orientation, d, d);
        if (solid_distance(&def->solids[s], def->dimensions, d) < SOLID * def->spacing)
            return s;
    }
    return -1;
}

static void see_faces(const PourBins *bins, size_t i, const SurfaceCover *covers, const Touches *touches)
{
    const float *x = bins->position + 3 * i;
    for (int bit = 0; bit < 2 * bins->def->dimensions; bit++) {
        if (covers->straight >> bit & 1U || wall_closes(bins->def, bit, x))
            continue;
        const int solid = solid_closes(bins, bit, x);
        if (solid < 0 && covers_together(covers, bit))
            continue;
        uint8_t *faces = solid < 0 ? touches->open : touches->solid;
        faces[i] = (uint8_t)(faces[i] | 1U << bit);
        if (solid >= 0)
            gap_at(bins, solid, x, touches->gap + 3 * i);
    }
}

static bool touches_find(Touches *touches, const PourBins *bins, const uint8_t *fluid,
                         const bool take[FLUIDS_MAX])
{
    const size_t count = touches->count;
    touches->begin = malloc((count + 1) * sizeof *touches->begin);
    touches->open = calloc(count + 1, 1);
    const bool solids = bins->def->solid_count > 0;
    touches->solid = solids ? calloc(count + 1, 1) : NULL;
    touches->gap = solids ? calloc(3 * count + 1, sizeof *touches->gap) : NULL;
    if (!touches->begin || !touches->open || (solids && (!touches->solid || !touches->gap)))
        return false;
    touches->begin[0] = 0;
    for (size_t i = 0; i < count; i++) {
        SurfaceCover covers = {0};
        const bool takes = take[fluid[i]];
        touches->begin[i + 1] = touches->begin[i] + (takes ? touch_all(bins, i, NULL, &covers) : 0);
        if (takes)
            see_faces(bins, i, &covers, touches);
    }
    touches->at = malloc((touches->begin[count] + 1) * sizeof *touches->at);
    for (size_t i = 0; touches->at && i < count; i++) {
        SurfaceCover covers = {0};
        if (take[fluid[i]])
            touch_all(bins, i, touches->at + touches->begin[i], &covers);
    }
    return touches->at != NULL;
}

bool touches_create(Touches *touches, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX])
{
    PourBins bins = {.def = def, .periodic = periodic, .position = position};
    *touches = (Touches){.count = count};
    for (int k = 0; k < def->solid_count; k++)
        solid_pose(&def->solids[k], 0, &bins.pose[k]);
    const bool ok = bins_create(&bins, count, fluid, take) && touches_find(touches, &bins, fluid, take);
    free(bins.begin);
    free(bins.particle);
    return ok;
}

void touches_destroy(Touches *touches)
{
    free(touches->begin);
    free(touches->at);
    free(touches->open);
    free(touches->solid);
    free(touches->gap);
    *touches = (Touches){0};
}
