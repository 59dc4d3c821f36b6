/* The view pbsr's own settings: their keys and defaults. */
#ifndef SLOSH_PBSR_DEF_H
#define SLOSH_PBSR_DEF_H

#include "render/frame/view.h"
#include "sim/base/room.h"
#include "sim/surface/ranged_volume.h"

enum { PBSR_LAYERS_MAX = 8, PBSR_FILE_SIZE = 96 };

/* What a layer is of: one of these, or behind them, PBSR_SCALARS + a Scalar, where that is at the level. */
enum {
    PBSR_SURFACE,
    PBSR_VOLUME,
    PBSR_SLICE_X,
    PBSR_SLICE_Y,
    PBSR_SLICE_Z,
    PBSR_SPHERE, /* formulas: render/pbsr/still_layers.h */
    PBSR_TORUS,
    PBSR_GYROID,
    PBSR_WAVE,
    PBSR_SOLIDS, /* of the scene: render/pbsr/solid_layers.h */
    PBSR_SCALARS
};

/* Who makes and projects the points of fluids. */
typedef enum PbsrMethod { PBSR_AUTO, PBSR_CPU, PBSR_GPU } PbsrMethod;

/* How points come onto a surface. */
typedef enum PbsrSampler { PBSR_SAMPLER_AUTO, PBSR_SAMPLER_WALK, PBSR_SAMPLER_TRIANGLES } PbsrSampler;

/* Between which values a surface runs: those of a file, trilinear, and the sum over the fluid's particles; or
   by PBSR_BY_GRID + a VolumeInterpolation those of a file, and those of the fluid's grid. */
enum { PBSR_BY_ITSELF, PBSR_BY_GRID };

typedef struct IN_A_ROOM PbsrLayer {
    int of;
    int sampler;               /* a PbsrSampler */
    int interpolation;         /* PBSR_BY_ITSELF or behind it */
    const RangedVolume *data;  /* of the file, from who read the scene; NULL: it has none */
    char file[PBSR_FILE_SIZE]; /* of volume data; "none": the layer is of the fluid, or a formula */
    double position[3];        /* m: moved by that, in the box's frame */
    double axis[3], angle_deg; /* after it was turned about the middle of what it is made of; of any length */
    double level; /* of the fluid's surface: of the field; of a slice: its place on its axis, m; of a scalar:
                     in its unit; of a formula: a length, m */
    double opacity;  /* 0 .. 1: of a surface seen from the front; of volume one spacing deep */
    double color[3]; /* linear; black: what the view's colours are by */
} PbsrLayer;

typedef struct IN_A_ROOM PbsrDef {
    PbsrLayer layers[PBSR_LAYERS_MAX];
    int layer_count; /* 0: the fluid's surface alone */
    int repeat;      /* sets of a picture at rest: L_R */
    int moving;      /* sets of a picture while something moves; 0: by the budget */
    double budget;   /* ms of a picture that others follow */
    double cell;     /* of the grid, spacings */
    double curved;   /* so many times as many points more where a fluid's surface is bent */
    double edges;    /* so many times as many points more where a surface is seen edge on */
    double points;   /* of a layer whose points stay, as many sets as that is; 24 bytes each */
    int seed;
    PbsrMethod method;
} PbsrDef;

extern const ViewKind view_pbsr;
extern const PbsrDef pbsr_usual; /* the defaults */
extern const Key pbsr_keys[];    /* ended by a row without a path */
extern const ViewGrade pbsr_grades[];

/* Those of that def; not const, as memchr's result is not. */
PbsrDef *pbsr_def(const ViewDef *def);

/* Of what a layer is of; NULL behind the last. */
const char *pbsr_layer_name(int index);

/* ViewKind.files */
int pbsr_files(const ViewDef *def, ViewFile files[VIEW_FILES_MAX]);

/* Whether it is of a file. */
bool pbsr_of_file(const PbsrLayer *layer);

/* What is between its values, where they stand on a grid. */
VolumeInterpolation pbsr_interpolation(const PbsrLayer *layer);

/* Whether it is no part of the fluid: of a file, or a formula. */
bool pbsr_still(const PbsrLayer *layer);

/* Whether it is a formula without a colour: it has those of the fluid. */
bool pbsr_painted(const PbsrLayer *layer);

/* Whether it has a colour of its own. */
bool pbsr_colored(const PbsrLayer *layer);

/* The layers that there are; how many, at least 1. */
int pbsr_layers(const PbsrDef *def, PbsrLayer layers[PBSR_LAYERS_MAX]);

/* Which scalars the layers are of, SCALAR_BIT. */
uint64_t pbsr_scalars(const PbsrDef *def);

#endif
