/* Layers that do not change with the fluid: surfaces of formulas or volume data, with kept points
   (sim/surface/sampling.h: the Brownian walk of Tanaka et al. 2012). Points are made for looks from about
   the same distance, and a picture skips surplus points farther away. Hence a moving fluid or layer needs
   no new points; a camera that comes nearer does. Slices and clouds of volume data are pieces, also made
   once, with new random points for each set. */
#ifndef SLOSH_STILL_LAYERS_H
#define SLOSH_STILL_LAYERS_H

#include "render/pbsr/fluid_layers.h"
#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"
#include "render/pbsr/set_image.h"
#include "sim/gl/surface/surface_gpu.h"
#include "sim/surface/polygons.h"

/* The number of grey points: points of uncoloured formulas outside the fluid; the normals are in the box's
   frame. */
enum { OUTSIDE_NUMBER = 15 };

/* Zero-initialise. */
typedef struct StillLayer {
    SurfaceGpu *gpu; /* walks on the GPU for known fields, with the points in GL memory; NULL: threads walk */
    int moving; /* set by the caller: number of sets made while looks change; the rest follows when a look
                   repeats. 0: all sets at each look, so that points do not depend on earlier looks */
    LevelField field;  /* in the layer's frame, as all members below */
    Polygons polygons; /* surface of the points instead of a level of `field`, which then gives only the
                          bounds */
    SetSight sight;    /* the last look's sight, from the layer's frame */
    const FluidLayers *paint; /* the layers that colour points projected by the CPU; NULL: points have
                                 values of their own */
    double to_box[3][4];      /* used with `paint`: maps the layer's frame to the box's frame */
    float turn[3][3];         /* turns the polygons' normals to the box's frame */
    Layer pieces;             /* for slices and clouds; empty for surfaces */
    SurfacePoints points;
    unsigned buffer; /* GL name: `count` points made by the GPU, instead of `points`; 0: made by the CPU */
    size_t count;
    int sets;       /* number of sets of the points; 0: no points */
    double asked;   /* requested density of a set, 1/m2; 0: no request */
    double density; /* reached density, 1/m2 */
    double needed;  /* density needed by the last look, 1/m2; above `density`: the layer is less opaque
                       than requested */
    double wanted;  /* points of a set per surface area that a pixel shows */
    bool few;       /* only `moving` sets were made: more are possible */
    uint64_t made;  /* incremented with each change of the points */
    char note[256]; /* SurfaceResult.note of the present points */
    Error trouble;  /* reason for having no points */
    /* inputs of the points */
    bool followed, begun; /* the inputs are set; the field exists */
    PbsrLayer said;
    unsigned stream; /* random stream: equal layers get independent points */
    int seed, repeat;
    double most, share; /* number of points; fraction of the points that a layer may have, PbsrDef.points */
    double box[3];
} StillLayer;

/* Updates layer `number` of the list, if the layer is a formula or of a file; else does nothing. Returns
   false, with the reason in `trouble`, if there is no such surface or memory is short; the same inputs are
   not tried again. */
bool still_layer_follow(StillLayer *still, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number, const SetSight *sight);

/* Begins a layer of polygons, and takes ownership of the polygons; at least one vertex is needed.
   `stream`: unique; listed layers use their numbers. `share`: fraction of the points that a layer may
   have. */
void still_layer_of_polygons(StillLayer *still, Polygons *polygons, const PbsrDef *def, unsigned stream,
                             double share);

/* Makes the points that a look by `sight` needs, if there are too few. `turned`: the layer may keep
   turning. Only after the layer has begun. Returns false as still_layer_follow. */
bool still_layer_see(StillLayer *still, const PbsrLayer *said, bool turned, unsigned number);

/* True if a repeated look would improve the layer. */
bool still_layer_waits(const StillLayer *still);

/* Prepares the colours of formulas without a colour: the fluid's colours inside the fluid, OUTSIDE_NUMBER
   outside. Call after each look; `layers` must stay valid during projection. */
void still_layer_paint(StillLayer *still, const PbsrLayer *said, const FluidLayers *layers);

/* Present points divided by the points that the opacity needs nearest to the eye; at most 1. */
double still_layer_part(const StillLayer *still);

/* The factor of the number of points at a point's position, by the last look. */
float still_layer_boost(const StillLayer *still, const SurfacePoint *from);

/* Projects set number `set`, modulo the present sets, by the last look. */
void still_layer_project(const StillLayer *still, uint64_t seed, uint64_t set, const SetImage *image);

/* The pieces of a layer: its own, or else the fluid layer's. */
static inline const Layer *layer_pieces(const StillLayer *still, const Layer *fluid)
{
    return still->pieces.point_count > 0 ? &still->pieces : fluid;
}

/* The sight of the pieces. */
static inline const SetSight *layer_pieces_sight(const StillLayer *still, const SetSight *fluid)
{
    return still->pieces.point_count > 0 ? &still->sight : fluid;
}

void still_layer_free(StillLayer *still); /* a zeroed struct is allowed */

#endif
