#include "sim/points/points.h"

#include "sim/base/formula.h"
#include "sim/points/walk.h"

#include <math.h>

static const double finest = 1.0 / 32; /* of a width: the march of analytic fields */
static const double paper = 1e-2;      /* of a width: sqrt(2 dt), Tanaka et al. 2012, section 4 */

SIMD_INLINE f8 number(const LevelField *field, int k)
{
    return f8_splat((float)field->number[k]);
}

SIMD_INLINE void sphere_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 x = p->x - number(field, 0), y = p->y - number(field, 1), z = p->z - number(field, 2);
    const f8 r = f8_sqrt(x * x + y * y + z * z), inverse = f8_splat(1) / r;
    *out =
        (LaneSample){number(field, 3) - r, -x * inverse, -y * inverse, -z * inverse, f8_splat(-2) * inverse};
}

SIMD_INLINE void torus_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 x = p->x - number(field, 0), y = p->y - number(field, 1), z = p->z - number(field, 2);
    const f8 rho = f8_sqrt(x * x + z * z), beyond = rho - number(field, 4);
    const f8 t = f8_sqrt(beyond * beyond + y * y), inverse = f8_splat(1) / t;
    const f8 radial = beyond * inverse / rho;
    *out = (LaneSample){number(field, 3) - t, -x * radial, -y * inverse, -z * radial, -(inverse + radial)};
}

SIMD_INLINE void gyroid_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 turns = number(field, 0), k = number(field, 1), square = k * k;
    f8 sx, cx, sy, cy, sz, cz;
    f8_sincos(turns * p->x, &sx, &cx);
    f8_sincos(turns * p->y, &sy, &cy);
    f8_sincos(turns * p->z, &sz, &cz);
    const f8 a = sx * cy, b = sy * cz, c = sz * cx;
    const f8 straight[3] = {-square * (a + c), -square * (a + b), -square * (b + c)};
    const f8 mixed[3] = {-square * cx * sy, -square * cy * sz, -square * cz * sx};
    *out = (LaneSample){a + b + c, k * (cx * cy - sz * sx), k * (cy * cz - sx * sy), k * (cz * cx - sy * sz),
                        f8_splat(0)};
    out->bend = lane_bend(out, straight, mixed);
}

SIMD_INLINE void wave_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 turns = number(field, 0), k = number(field, 1), high = number(field, 2), none = f8_splat(0);
    f8 sx, cx, sz, cz;
    f8_sincos(turns * p->x, &sx, &cx);
    f8_sincos(turns * p->z, &sz, &cz);
    const f8 wave = high * cx * cz, straight[3] = {-k * k * wave, none, -k * k * wave};
    const f8 mixed[3] = {none, none, k * k * high * sx * sz};
    *out = (LaneSample){number(field, 3) + wave - p->y, -k * high * sx * cz, f8_splat(-1),
                        -k * high * cx * sz, none};
    out->bend = lane_bend(out, straight, mixed);
}

SIMD_INLINE void plane_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 x = number(field, 0), y = number(field, 1), z = number(field, 2);
    *out = (LaneSample){x * p->x + y * p->y + z * p->z - number(field, 3), x, y, z, f8_splat(0)};
}

/* Eight places one by one, in double precision. */
SIMD_INLINE void formula_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    f8 straight[3], mixed[3];
    for (int lane = 0; lane < LANES; lane++) {
        FormulaJet jet;
        formula_jet(field->own, (double[3]){(double)p->x[lane], (double)p->y[lane], (double)p->z[lane]},
                    &jet);
        out->value[lane] = (float)jet.value;
        out->x[lane] = (float)jet.slope[0];
        out->y[lane] = (float)jet.slope[1];
        out->z[lane] = (float)jet.slope[2];
        for (int k = 0; k < 3; k++) {
            straight[k][lane] = (float)jet.bend[k];
            mixed[k][lane] = (float)jet.bend[3 + k];
        }
    }
    out->bend = lane_bend(out, straight, mixed);
}

LEVEL_KIND(formula)
LEVEL_KIND(sphere)
LEVEL_KIND(torus)
LEVEL_KIND(gyroid)
LEVEL_KIND(wave)
LEVEL_KIND(plane)

/* A field of a given width, with derived steps. */
static LevelField field_of(const LevelKind *kind, const double low[3], const double high[3], double length)
{
    LevelField field = {.kind = kind, .length = length, .number = {0}};
    field.step = paper * length;
    for (int k = 0; k < 3; k++) {
        field.march[k] = finest * length;
        field.low[k] = low[k];
        field.high[k] = high[k];
    }
    return field;
}

static LevelField about(const LevelKind *kind, const double centre[3], const double half[3])
{
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = centre[k] - 1.1 * half[k];
        high[k] = centre[k] + 1.1 * half[k];
    }
    LevelField field = field_of(kind, low, high, 2 * half[0]);
    for (int k = 0; k < 3; k++)
        field.number[k] = centre[k];
    return field;
}

LevelField level_sphere(const double centre[3], double radius)
{
    LevelField field = about(&sphere_kind, centre, (double[3]){radius, radius, radius});
    field.number[3] = radius;
    return field;
}

LevelField level_torus(const double centre[3], double ring, double tube)
{
    LevelField field = about(&torus_kind, centre, (double[3]){ring + tube, tube, ring + tube});
    for (int k = 0; k < 3; k++)
        field.march[k] = fmin(field.march[k], tube / 8);
    field.step = fmin(field.step, tube / 8);
    field.number[3] = tube;
    field.number[4] = ring;
    return field;
}

LevelField level_gyroid(const double low[3], const double high[3], double period)
{
    LevelField field = field_of(&gyroid_kind, low, high, period);
    field.number[0] = 1 / period;
    field.number[1] = 2 * M_PI / period;
    return field;
}

LevelField level_wave(const double low[3], const double high[3], double height, double amplitude,
                      double period)
{
    LevelField field = field_of(&wave_kind, low, high, period);
    field.number[0] = 1 / period;
    field.number[1] = 2 * M_PI / period;
    field.number[2] = amplitude;
    field.number[3] = height;
    return field;
}

static double longest_side(const double low[3], const double high[3])
{
    return fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
}

LevelField level_plane(const double low[3], const double high[3], const double point[3],
                       const double normal[3])
{
    LevelField field = field_of(&plane_kind, low, high, longest_side(low, high));
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; k++) {
        field.number[k] = normal[k] / length;
        field.number[3] += field.number[k] * point[k];
    }
    return field;
}

LevelField level_formula(const Formula *formula, const double low[3], const double high[3])
{
    LevelField field = field_of(&formula_kind, low, high, longest_side(low, high));
    for (int k = 0; k < 3; k++)
        field.march[k] /= 2; /* what a user draws may be thinner than a sphere of the box's width */
    field.own = formula;
    return field;
}
