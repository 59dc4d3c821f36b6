/* Layers that do not change with the fluid: surfaces that are formulas or of volume data, of points that stay
   (sim/surface/sampling.h: the Brownian walk of Tanaka et al. 2012). They are made for looks from about the
   same distance, and a picture leaves out what is too many farther away: so a fluid, or a layer that moves
   makes none anew, a camera that comes nearer does. Slices and the cloud of such data are
   pieces, made once too, over which each set strews points anew. */
#ifndef SLOSH_STILL_LAYERS_H
#define SLOSH_STILL_LAYERS_H

#include "render/pbsr/fluid_layers.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"
#include "render/pbsr/set_image.h"
#include "sim/gl/surface/surface_gpu.h"
#include "sim/surface/polygons.h"

/* Points of formulas outside the fluid whose colours they have are of that number: grey, and their normals in
   the box's frame. */
enum { OUTSIDE_NUMBER = 15 };

/* Zero-initialise it. */
typedef struct StillLayer {
    SurfaceGpu *gpu; /* walks where it has the field, and its points stay in GL's memory; NULL: threads do */
    int moving; /* said by its user: sets that are made while looks change, the rest when one is as the last;
                   0: all at each look, so that points depend on no look before it */
    LevelField field;  /* in the layer's frame, as all below */
    Polygons polygons; /* that points lie on instead of a level of the field, of which bounds alone count */
    SetSight sight;    /* of the last look, from the layer's frame */
    const FluidLayers *paint; /* points that the CPU projects have its colours; NULL: their own values */
    double to_box[3][4];      /* with that: from the layer's frame */
    float turn[3][3];         /* of normals of polygons, to the box's frame */
    Layer pieces;             /* of slices and clouds; none of surfaces */
    SurfacePoints points;
    unsigned buffer; /* GL name: points that the GPU made, `count`, and not those above; 0: it did not */
    size_t count;
    int sets;       /* that the points are dealt to; 0: there are none */
    double asked;   /* density of a set that was asked for, 1/m2; 0: nothing was */
    double density; /* that was reached, 1/m2 */
    double needed;  /* by the last look, 1/m2; more than `density`: the layer is less opaque than said */
    double wanted;  /* points of a set on as much surface as a pixel shows */
    bool few;       /* no more sets than `moving` were made: there may be more */
    uint64_t made;  /* raised with each change of the points */
    char note[256]; /* SurfaceResult.note of the points that there are */
    Error trouble;  /* why there are none */
    /* what they were made for */
    bool followed, begun; /* there is what follows; and it has a field */
    PbsrLayer said;
    unsigned stream; /* of random numbers: layers that are equal fall independently of each other */
    int seed, repeat;
    double most, share; /* points; and which part they are of what a layer may have, PbsrDef.points */
    double box[3];
} StillLayer;

/* Follows a layer that is a formula or of a file, number `number` of the list; nothing of any other. False,
   with the reason in `trouble`, where there is no such surface or memory is short: the same is not tried
   again. */
bool still_layer_follow(StillLayer *still, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number, const SetSight *sight);

/* Begins a layer of polygons, which it takes; there must be a vertex. `stream`: no other layer's; those of
   the list have their numbers. `share`: of the points that a layer may have. */
void still_layer_of_polygons(StillLayer *still, Polygons *polygons, const PbsrDef *def, unsigned stream,
                             double share);

/* Makes the points that a look by `sight` needs, where there are not enough yet. `turned`: it may turn on.
   Only what has begun. False as still_layer_follow. */
bool still_layer_see(StillLayer *still, const PbsrLayer *said, bool turned, unsigned number);

/* Whether the same look again would make it better. */
bool still_layer_waits(const StillLayer *still);

/* Formulas without a colour have that of the fluid where they are in it, and are of OUTSIDE_NUMBER elsewhere;
   behind each look. The layers must stay while it is projected. */
void still_layer_paint(StillLayer *still, const PbsrLayer *said, const FluidLayers *layers);

/* The part of the points that its opacity needs nearest to the eye, up to 1. */
double still_layer_part(const StillLayer *still);

/* How many times as many points as elsewhere there are to be where this one is, by the last look. */
float still_layer_boost(const StillLayer *still, const SurfacePoint *from);

/* Projects set number `set`, modulo the sets that there are, as by the last look. */
void still_layer_project(const StillLayer *still, uint64_t seed, uint64_t set, const SetImage *image);

/* The pieces of a layer: its own, else those of the fluid's. */
static inline const Layer *layer_pieces(const StillLayer *still, const Layer *fluid)
{
    return still->pieces.point_count > 0 ? &still->pieces : fluid;
}

/* What they are seen by. */
static inline const SetSight *layer_pieces_sight(const StillLayer *still, const SetSight *fluid)
{
    return still->pieces.point_count > 0 ? &still->sight : fluid;
}

void still_layer_free(StillLayer *still); /* a zeroed one is allowed */

#endif
