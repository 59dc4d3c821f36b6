/* The view volume's own settings: their keys, names and defaults. */
#ifndef SLOSH_VOLUME_DEF_H
#define SLOSH_VOLUME_DEF_H

#include "render/frame/view.h"
#include "sim/base/room.h"

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

/* How it draws the scene's solids. */
typedef enum VolumeSolids { VOLUME_SOLIDS_SURFACE, VOLUME_SOLIDS_VOXELS } VolumeSolids;

/* How the view volume casts its rays. */
typedef enum RaycastLook { RAYCAST_OPAQUE, RAYCAST_WATER, RAYCAST_TRANSLUCENT } RaycastLook;

typedef struct IN_A_ROOM RaycastDef {
    RaycastLook look;
    double level;     /* of the field, where the surface of opaque and water is */
    double step;      /* between two samples, cells */
    double threshold; /* opacity at which a ray ends; more than 0, 1: never */
    double
        ramp[2]; /* the field at which opacity begins and where it is full; at once where that is not above */
    double opacity;      /* full: of fluid one spacing deep, 0 .. 1 */
    double skin;         /* opacity of the layer in which that begins: of each surface crossed, 0 .. 1 */
    ControlPoints curve; /* on that ramp: the share of the full opacity, 0 .. 1 */
    double ior;          /* index of refraction, of water */
    double attenuation;  /* of water: through which white light becomes the fluid's colour, m; 0: two
                            fifths of the box's longest side, in two dimensions the layer's depth */
    bool shadows;        /* of the fluid on itself, by marching toward the light; else by the shadow map */
    bool jitter;         /* rays start at different parts of a step, so that no bands show */
    bool skip;           /* empty bricks: else all between the faces of the volume is marched through */
} RaycastDef;

typedef struct IN_A_ROOM VolumeDef {
    int cells;       /* along the box's longest side, where `cell` is 0 */
    double cell;     /* side of a cell, in spacings; 0: by `cells` */
    int cells_least; /* no key: of the quality `best`, whose `cells` make cells of an eighth of a spacing at
                        the least, but are not fewer than these; 0: as `cells` say */
    VolumeBounds bounds;
    VolumeMethod method;
    VolumeShow show;
    VolumeSolids solids;
    int slice_axis; /* 0 to 2: x y z; which the slice shown lies across */
    double slice;   /* where along it, 0 .. 1 of the box */
    RaycastDef raycast;
} VolumeDef;

extern const ViewKind view_volume;

/* How ViewDef.opacity goes with a scalar: not at all, with that of the colours, with one of its own, which
   needs another volume. */
typedef enum VolumeOpacity { VOLUME_EVEN, VOLUME_BY_COLOR, VOLUME_BY_OWN } VolumeOpacity;
VolumeOpacity volume_opacity(const ViewDef *def);

extern const ControlPreset volume_presets[];

/* Those of that def; not const, as memchr's result is not. */
VolumeDef *volume_def(const ViewDef *def);

extern const VolumeDef volume_usual; /* the defaults */
extern const Key volume_keys[];      /* ended by a row without a path */
extern const ViewGrade volume_grades[];

/* By their enums, ended by NULL. */
extern const char *const volume_bounds_names[],
    *const volume_method_names[], *const volume_show_names[], *const volume_solids_names[],
                                                                  *const volume_axis_names[],
                                                                      *const raycast_look_names[];

#endif
