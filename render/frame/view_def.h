/* What a scene says of its picture: plain data. */
#ifndef SLOSH_VIEW_DEF_H
#define SLOSH_VIEW_DEF_H

#include "sim/base/scalar.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct CameraDef {
    double from[3]; /* eye, m, world's frame */
    double to[3];   /* looked at, m */
    double fov_deg; /* vertical field of view, degrees */
} CameraDef;

/* Of the view splat; names by index stand in render/splat/splat_names.c. */
typedef enum SplatWeights { SPLAT_NO_WEIGHTS, SPLAT_W1, SPLAT_W1W2 } SplatWeights;
typedef enum SplatShape { SPLAT_PERSPECTIVE, SPLAT_PAPER, SPLAT_ELLIPSOID } SplatShape;
typedef enum SplatSprite { SPLAT_AUTO, SPLAT_QUAD, SPLAT_POINT } SplatSprite;
typedef enum SplatShading { SPLAT_PHONG, SPLAT_WATER, SPLAT_JELLY } SplatShading;
typedef enum SplatShow {
    SPLAT_SHADED,
    SPLAT_DEPTH,
    SPLAT_NORMALS,
    SPLAT_WEIGHT,
    SPLAT_THICKNESS,
    SPLAT_CULLED
} SplatShow;

typedef enum SplatFilter { SPLAT_NO_FILTER, SPLAT_NARROW_RANGE } SplatFilter;

typedef struct SplatDef {
    double eps; /* how far below the surface spheres still blend, in radii */
    SplatWeights weights;
    SplatShape shape;
    SplatSprite sprite;
    SplatShow show;
    bool cull;  /* leave out hidden spheres before they are drawn */
    bool drops; /* a particle with few neighbours shrinks to a drop of its own volume */
    SplatShading shading;
    double ior;         /* index of refraction, of water and jelly */
    double attenuation; /* through which white light becomes the fluid's colour, m; 0: a fifth of the
                           box's longest side, in two dimensions the layer's depth */
    double level;       /* of the field that is the surface, 0 .. 1; 0: the union of the spheres */
    SplatFilter filter;
    double filter_size;    /* half the kernel's width, in radii */
    double filter_range;   /* depths farther apart are two surfaces, in radii */
    int filter_iterations; /* of one pass along x and one along y */
    bool antialias;        /* smooth outlines, and spheres smaller than a pixel */
} SplatDef;

/* Of the view volume; names by index stand in render/volume/volume_names.c. */
typedef enum VolumeBounds { VOLUME_BOX, VOLUME_FLUID } VolumeBounds;
typedef enum VolumeMethod {
    VOLUME_AUTO,     /* the fastest on this driver */
    VOLUME_GEOMETRY, /* a geometry shader makes one point a slice that a particle cuts */
    VOLUME_LAYERS,  /* as many instances of the points as a particle may cut slices, without a geometry shader
                     */
    VOLUME_PLANES,  /* four slices a pass, in red, green, blue, alpha (Iwasaki et al. 2006) */
    VOLUME_SCATTER, /* compute: each particle adds to its voxels */
    VOLUME_GATHER,  /* compute: each voxel sums over the particles around, by cell lists */
    VOLUME_SLABS,   /* sums on the CPU, each thread in slabs of its own */
    VOLUME_DIRECT   /* no volume: the field is summed at the sample, by cell lists */
} VolumeMethod;
typedef enum VolumeShow {
    VOLUME_SHADED,
    VOLUME_SLICE,
    VOLUME_ENTRY, /* where rays enter, as red, green, blue */
    VOLUME_EXIT,
    VOLUME_LENGTH, /* of the way between them, of the volume's diagonal */
    VOLUME_STEPS,  /* taken, of 64, through the colormap */
    VOLUME_NORMALS
} VolumeShow;

typedef struct VolumeDef {
    int cells;   /* along the box's longest side, where `cell` is 0 */
    double cell; /* side of a cell, in spacings; 0: by `cells` */
    VolumeBounds bounds;
    VolumeMethod method;
    VolumeShow show;
    int slice_axis; /* 0 to 2: x y z; which the slice shown lies across */
    double slice;   /* where along it, 0 .. 1 of the box */
} VolumeDef;

/* How the view volume casts its rays; names by index stand in render/volume/raycast_names.c. */
typedef enum RaycastLook { RAYCAST_OPAQUE, RAYCAST_WATER, RAYCAST_TRANSLUCENT } RaycastLook;

typedef struct RaycastDef {
    RaycastLook look;
    double level;     /* of the field, where the surface of opaque and water is */
    double step;      /* between two samples, cells */
    double threshold; /* opacity at which a ray ends; more than 0, 1: never */
    double
        ramp[2]; /* the field at which opacity begins and where it is full; at once where that is not above */
    double opacity;     /* full: of fluid one spacing deep, 0 .. 1 */
    double skin;        /* opacity of the layer in which that begins: of each surface crossed, 0 .. 1 */
    double by_scalar;   /* how much of the opacity goes with the scalar shown, 0 .. 1 */
    double ior;         /* index of refraction, of water */
    double attenuation; /* as SplatDef has it, of water */
    bool shadows;       /* of the fluid on itself, by marching toward the light; else by the shadow map */
    bool jitter;        /* rays start at different parts of a step, so that no bands show */
    bool skip;          /* empty bricks: else all between the faces of the volume is marched through */
} RaycastDef;

typedef struct ViewDef {
    char kind[NAME_SIZE];     /* see view_list; "none" draws nothing */
    Scalar color_by;          /* SCALAR_FLUID takes the fluids' own colours */
    char colormap[NAME_SIZE]; /* see colormap_list */
    bool range_auto;          /* the range follows each state; else range[0] .. range[1] */
    double range[2];          /* in the scalar's unit */
    double radius;            /* of a particle, in spacings; 0: the view's default */
    SplatDef splat;
    VolumeDef volume;
    RaycastDef raycast;
    bool legend;      /* draw the legend */
    bool box;         /* draw the box's edges */
    bool floor;       /* draw the floor below the box */
    bool camera_auto; /* the camera shows the whole box; else `camera` */
    CameraDef camera;
    double background[3]; /* linear RGB 0..1, at the horizon */
} ViewDef;

/* What there is to be shown, and how. */
typedef struct Subject {
    const ViewDef *def;
    const WorldDef *world; /* all 0 where it is not known */
} Subject;

/* Defaults of all that views share: their own settings are zeros. */
ViewDef view_def_shared(void);

#endif
