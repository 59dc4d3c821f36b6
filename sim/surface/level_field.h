/* A scalar field whose levels are surfaces: what the samplers walk on and what colours their points.

   A field is made by one of the functions of its kind (analytic.h, volume_field.h, sph_field.h), is constant
   from then on, and may be read by many threads at once. */
#ifndef SLOSH_LEVEL_FIELD_H
#define SLOSH_LEVEL_FIELD_H

#include <stdbool.h>

typedef struct LevelKind LevelKind; /* its functions: sim/surface/level_kind.h */

typedef struct LevelField {
    const LevelKind *kind;
    double low[3], high[3]; /* m, the box's frame: the field is there and nowhere else; surfaces end there */
    double length;   /* m, typical: the width of what is analytic, the cell of a volume, h of particles */
    double step;     /* m: a walk's sqrt(2 dt), as Tanaka et al. 2012 advise for the kind */
    double march[3]; /* m, along x, y, z: how finely a line looks; what is thinner may be missed */
    union {
        double number[8]; /* of an analytic one: its shape */
        const void *own;  /* of another: belongs to who made it, which must outlive the field */
    };
} LevelField;

/* At a place; not finite where the field is not. */
typedef struct LevelSample {
    float value;
    float gradient[3]; /* 1/m of the value */
    float bend;        /* Tr(H P), 1/m2 of the value: P cuts off what is along the gradient */
} LevelSample;

void level_at(const LevelField *field, const double place[3], LevelSample *out);

#endif
