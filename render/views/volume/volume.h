/* Settings of the view volume: keys, names and defaults. */
#ifndef RENDER_VIEWS_VOLUME_VOLUME_H
#define RENDER_VIEWS_VOLUME_VOLUME_H

#include "render/frame/view.h"
#include "sim/base/base.h"

typedef enum VolumeBounds { VOLUME_BOX, VOLUME_FLUID } VolumeBounds;
typedef enum VolumeMethod {
    VOLUME_AUTO,     /* the fastest on this driver */
    VOLUME_GEOMETRY, /* a geometry shader makes a point for each slice that a particle cuts */
    VOLUME_LAYERS,   /* one instance of the points per slice that a particle may cut, without a geometry
                        shader */
    VOLUME_PLANES,   /* four slices per pass, in red, green, blue, alpha (Iwasaki et al. 2006) */
    VOLUME_SCATTER,  /* compute: each particle adds to its voxels */
    VOLUME_GATHER,   /* compute: each voxel sums over the particles around, by cell lists */
    VOLUME_SLABS,    /* sums on the CPU, a slab per thread */
    VOLUME_IWASAKI,  /* planes as published: particles clustered by passes on the CPU and sent in each pass,
                        each pass read back, the volume sent at the end */
    VOLUME_DIRECT    /* no volume: the field is summed at the sample, by cell lists */
} VolumeMethod;
typedef enum VolumeShow {
    VOLUME_SHADED,
    VOLUME_SLICE,
    VOLUME_ENTRY, /* entry points of the rays, as red, green, blue */
    VOLUME_EXIT,
    VOLUME_LENGTH, /* distance between entry and exit, as a fraction of the volume's diagonal */
    VOLUME_STEPS,  /* number of steps, of 64, through the colormap */
    VOLUME_NORMALS
} VolumeShow;

/* How the view draws the scene's solids. */
typedef enum VolumeSolids { VOLUME_SOLIDS_SURFACE, VOLUME_SOLIDS_VOXELS } VolumeSolids;

/* The surface of opaque and water: by rays to the field's level; or triangles by marching cubes, smooth or
   as facets with edges. */
typedef enum VolumeSurface { VOLUME_RAYS, VOLUME_MESH, VOLUME_FACETS } VolumeSurface;

/* How the view volume casts its rays. */
typedef enum RaycastLook { RAYCAST_OPAQUE, RAYCAST_WATER, RAYCAST_TRANSLUCENT } RaycastLook;

typedef struct MAY_ALIAS RaycastDef {
    RaycastLook look;
    double level;     /* the field's level at the surface of opaque and water */
    double step;      /* distance between samples, cells */
    double threshold; /* opacity that ends a ray; more than 0, 1: never */
    double ramp[2];   /* field values where opacity begins and is full; a jump if the second is not larger */
    double opacity;   /* full opacity: of fluid one spacing deep, 0 .. 1 */
    double skin;      /* opacity of the layer where opacity begins: per surface crossed, 0 .. 1 */
    ControlPoints curve; /* by position on `ramp`: fraction of the full opacity, 0 .. 1 */
    double ior;          /* refractive index of water */
    double attenuation;  /* of water: distance at which white light takes the fluid's colour, m; 0: two
                            fifths of the box's longest side, in two dimensions the layer's depth */
    bool shadows;        /* the fluid's shadow on itself, by marching toward the light; false: by the
                            shadow map */
    bool jitter;         /* rays start at varied fractions of a step: no visible bands */
    bool skip;           /* skip empty bricks; false: march everywhere between the faces of the volume */
} RaycastDef;

typedef struct MAY_ALIAS VolumeDef {
    int cells;       /* cells along the box's longest side, if `cell` is 0 */
    double cell;     /* side of a cell, in spacings; 0: by `cells` */
    int cells_least; /* not a key, for quality `best`: cells get no smaller than an eighth of a spacing,
                        but at least this number of cells; 0: use `cells` as given */
    VolumeBounds bounds;
    VolumeMethod method;
    VolumeShow show;
    VolumeSolids solids;
    VolumeSurface surface;
    int slice_axis; /* 0 to 2: x y z; axis perpendicular to the slice */
    double slice;   /* position along the axis, 0 .. 1 of the box */
    RaycastDef raycast;
} VolumeDef;

extern const ViewKind view_volume;

/* How ViewDef.opacity depends on a scalar: not at all; on the colours' scalar; on another scalar, which
   needs a second volume. */
typedef enum VolumeOpacity { VOLUME_EVEN, VOLUME_BY_COLOR, VOLUME_BY_OWN } VolumeOpacity;
VolumeOpacity volume_opacity(const ViewDef *def);

/* VOLUME_RAYS where the look has no surface. */
VolumeSurface volume_surface(const ViewDef *def);

extern const ControlPreset volume_presets[];

/* The settings of a def; not const, like memchr's result. */
static inline VolumeDef *volume_def(const ViewDef *def)
{
    return view_own_settings(def, &view_volume);
}

extern const VolumeDef volume_usual; /* the defaults */
extern const Key volume_keys[];      /* ended by a row without a path */
extern const ViewGrade volume_grades[];

/* Names of the enums, ended by NULL. */
extern const char *const volume_bounds_names[],
    *const volume_method_names[], *const volume_show_names[], *const volume_solids_names[],
                                                                  *const volume_surface_names[],
                                                                      *const volume_axis_names[],
                                                                          *const raycast_look_names[];

#endif
