/* A scalar field whose levels are surfaces: the field to sample or to colour points by. Made by the
   functions of its kind (analytic.h, volume_field.h, sph_field.h), constant afterwards, readable by many
   threads at once. */
#ifndef SLOSH_LEVEL_FIELD_H
#define SLOSH_LEVEL_FIELD_H

#include <stdbool.h>

typedef struct LevelKind LevelKind; /* functions of the kind: sim/surface/level_kind.h */

typedef struct LevelField {
    const LevelKind *kind;
    double low[3], high[3]; /* m, the box's frame: bounds of the field; surfaces end there */
    double length;          /* m, typical: width of an analytic field, cell of a volume, h of particles */
    double step;            /* m: a walk's sqrt(2 dt), as advised by Tanaka et al. 2012 for the kind */
    double march[3];        /* m, along x, y, z: step of a line search; thinner parts may be missed */
    union {
        double number[8]; /* analytic field: shape */
        const void *own;  /* any other field: data of the creator, which must outlive the field */
    };
} LevelField;

/* At a position; not finite outside of the field. */
typedef struct LevelSample {
    float value;
    float gradient[3]; /* value's unit per m */
    float bend;        /* Tr(H P), value's unit per m2: P projects out the gradient's direction */
} LevelSample;

void level_at(const LevelField *field, const double place[3], LevelSample *out);

#endif
