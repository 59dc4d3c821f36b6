/* Settings of the view pbsr: keys and defaults. */
#ifndef RENDER_VIEWS_PBSR_PBSR_H
#define RENDER_VIEWS_PBSR_PBSR_H

#include "render/frame/view.h"
#include "sim/base/base.h"
#include "sim/def.h"
#include "sim/points/points.h"

enum { PBSR_LAYERS_MAX = 8 };

/* Kinds of layers; from PBSR_SCALARS on, PBSR_SCALARS + a Scalar: the isosurface of a scalar. */
enum {
    PBSR_SURFACE,
    PBSR_VOLUME,
    PBSR_SLICE_X,
    PBSR_SLICE_Y,
    PBSR_SLICE_Z,
    PBSR_SPHERE, /* formulas: render/views/pbsr/pbsr_private.h */
    PBSR_TORUS,
    PBSR_GYROID,
    PBSR_WAVE,
    PBSR_FORMULA, /* a formula of the user's own */
    PBSR_SOLIDS,  /* solids of the scene: render/views/pbsr/pbsr_private.h */
    PBSR_SCALARS
};

/* The processor that makes and projects the points of fluids. */
typedef enum PbsrMethod { PBSR_AUTO, PBSR_CPU, PBSR_GPU } PbsrMethod;

/* Methods of placing points on a surface. */
typedef enum PbsrSampler { PBSR_SAMPLER_AUTO, PBSR_SAMPLER_WALK, PBSR_SAMPLER_TRIANGLES } PbsrSampler;

/* Interpolation of a surface's values. PBSR_BY_ITSELF: trilinear for a file, the sum over particles for
   the fluid. PBSR_BY_GRID + a VolumeInterpolation: between the values of a file, or of the fluid's grid. */
enum { PBSR_BY_ITSELF, PBSR_BY_GRID };

typedef struct MAY_ALIAS PbsrLayer {
    int of;
    int sampler;               /* a PbsrSampler */
    int interpolation;         /* PBSR_BY_ITSELF, or PBSR_BY_GRID and up */
    const RangedVolume *data;  /* the file's data, set by the scene's reader; NULL: none */
    const char *formula;       /* of PBSR_FORMULA: of x, y, z, m, in the box's frame; "none": none */
    const char *file;          /* volume data; "none": the layer is of the fluid, or a formula */
    double position[3];        /* translation in the box's frame, m */
    double axis[3], angle_deg; /* rotation about the layer's middle, before the translation; `axis` has any
                                  length */
    int motion_count;
    const Motion *motions; /* on top of that pose, as of a solid: all together, turns about the middle */
    double level;    /* fluid's surface: value of the field; slice: position on the axis, m; scalar: in the
                        scalar's unit; formula: a length, m */
    double opacity;  /* 0 .. 1: of a surface seen from the front; of volume one spacing deep */
    double color[3]; /* linear; black: the view's colours */
} PbsrLayer;

typedef struct MAY_ALIAS PbsrDef {
    PbsrLayer layers[PBSR_LAYERS_MAX];
    int layer_count; /* 0: the fluid's surface alone */
    int repeat;      /* sets of a picture at rest: L_R */
    int moving;      /* sets of a picture during motion; 0: by the budget */
    double budget;   /* ms per picture if further pictures follow */
    double cell;     /* side of a grid cell, spacings */
    double curved;   /* relative number of extra points where a fluid's surface is curved */
    double edges;    /* relative number of extra points where a surface is seen edge-on */
    double points;   /* kept points of a rigid layer, in as many sets as fit; 24 bytes each */
    int seed;
    PbsrMethod method;
} PbsrDef;

extern const ViewKind view_pbsr;
extern const PbsrDef pbsr_usual; /* the defaults */
extern const Key pbsr_keys[];    /* ended by a row without a path */
extern const ViewGrade pbsr_grades[];

/* The settings of a def; not const, like memchr's result. */
static inline PbsrDef *pbsr_def(const ViewDef *def)
{
    return view_own_settings(def, &view_pbsr);
}

/* Name of a kind of layer; NULL after the last. */
const char *pbsr_layer_name(int index);

/* True if the layer is of a file. */
bool pbsr_is_of_file(const PbsrLayer *layer);

/* The interpolation of values on a grid. */
VolumeInterpolation pbsr_interpolation(const PbsrLayer *layer);

/* True if the layer is not of the fluid: of a file, or a formula. */
bool pbsr_is_rigid(const PbsrLayer *layer);

/* True if the layer is a plane through the fluid. */
bool pbsr_is_slice(const PbsrLayer *layer);

/* True for a formula without a colour, which takes the fluid's colours. */
bool pbsr_takes_fluid_colors(const PbsrLayer *layer);

/* True if the layer has a colour of its own. */
bool pbsr_has_color(const PbsrLayer *layer);

/* Fills in the layers; returns their number, at least 1. */
int pbsr_layers(const PbsrDef *def, PbsrLayer layers[PBSR_LAYERS_MAX]);

/* The same with the poses at `time`, s: position, axis and angle are with the motions. */
int pbsr_layers_at(const PbsrDef *def, double time, PbsrLayer layers[PBSR_LAYERS_MAX]);

/* ViewKind.files of the view. */
int pbsr_files(const ViewDef *def, ViewFile files[VIEW_FILES_MAX]);

/* The scalars of the layers, SCALAR_BIT. */
uint64_t pbsr_scalars(const PbsrDef *def);

#endif
