/* The view slice's own settings: their keys, names and defaults. */
#ifndef SLOSH_SLICE_DEF_H
#define SLOSH_SLICE_DEF_H

#include "render/frame/view.h"
#include "sim/base/room.h"

typedef enum SliceShow {
    SLICE_PLANE, /* where it is in space */
    SLICE_FLAT   /* filling the picture, a sample a pixel */
} SliceShow;

typedef enum SliceParticles {
    SLICE_ALONE,  /* the plane without particles */
    SLICE_BEHIND, /* with those that the normal points away from */
    SLICE_BOTH    /* with all */
} SliceParticles;

typedef struct IN_A_ROOM SliceDef {
    double point[3],
        normal[3]; /* of the plane, box's frame; the point in m, the normal of any length but 0 */
    double play;   /* m/s of simulated time along the normal, to and fro through the box */
    SliceShow show;
    int kernel;               /* of plane_kernels; 0: the solver's */
    bool raw;                 /* the sum as it is; else over that of the kernels */
    int samples;              /* along the longer side where it is shown in space */
    double cut;               /* samples are empty whose sum V W is less */
    SliceParticles particles; /* shown with it in space, as the first view of the list draws them */
    double opacity;           /* of the plane in space */
    int isolines;             /* between the ends of the range; 0: none */
} SliceDef;

extern const ViewKind view_slice;

/* Those of that def; not const, as memchr's result is not. */
SliceDef *slice_def(const ViewDef *def);

extern const SliceDef slice_usual; /* the defaults */
extern const Key slice_keys[];     /* ended by a row without a path */
extern const ViewGrade slice_grades[];

#endif
