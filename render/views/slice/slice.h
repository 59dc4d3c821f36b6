/* Settings of the view slice: keys, names and defaults. */
#ifndef RENDER_VIEWS_SLICE_SLICE_H
#define RENDER_VIEWS_SLICE_SLICE_H

#include "render/frame/view.h"
#include "sim/base/base.h"

typedef enum SliceShow {
    SLICE_PLANE, /* at its position in space */
    SLICE_FLAT   /* filling the picture, a sample per pixel */
} SliceShow;

typedef enum SliceParticles {
    SLICE_ALONE,  /* the plane without particles */
    SLICE_BEHIND, /* with particles on the side away from the normal */
    SLICE_BOTH    /* with all particles */
} SliceParticles;

typedef struct MAY_ALIAS SliceDef {
    double point[3], normal[3]; /* plane in the box's frame; point in m, normal of any nonzero length */
    double play;                /* m/s of simulated time along the normal, to and fro through the box */
    SliceShow show;
    int kernel;               /* index in plane_kernels; 0: the solver's kernel */
    bool raw;                 /* show the plain sum; else divide by the sum of kernels */
    int samples;              /* samples along the longer side, if shown in space */
    double cut;               /* samples with a smaller sum V W are empty */
    SliceParticles particles; /* particles shown with the plane in space, drawn by the first view of the
                                 list */
    double opacity;           /* of the plane in space */
    int isolines;             /* number of isolines between the ends of the range; 0: none */
} SliceDef;

extern const ViewKind view_slice;

/* The settings of a def; not const, like memchr's result. */
static inline SliceDef *slice_def(const ViewDef *def)
{
    return view_own_settings(def, &view_slice);
}

extern const SliceDef slice_usual; /* the defaults */
extern const Key slice_keys[];     /* ended by a row without a path */
extern const ViewGrade slice_grades[];

#endif
