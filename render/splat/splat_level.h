/* The surface of the view splat at a level above zero: phi^-1(I) of the field phi(x) = sum V_i W(x - x_i,
   h_i) (Adams et al. 2006, eq. 1; their future work, section 6) by root finding along the rays. W is poly6
   (Müller 2003, eq. 20) with the sphere's radius as its support; V a particle's volume at rest, spacing^3.

   Each round splats the spheres once, which adds up the field and its slope at four depths behind the ray's
   first sphere; the first crossing of their cubic Hermite pieces is the root, one step of Newton's on a
   splatted sum refines it. Where the field does not reach the level the next round goes on behind. A round
   that no pixel needs is not drawn. */
#ifndef SLOSH_SPLAT_LEVEL_H
#define SLOSH_SPLAT_LEVEL_H

#include "render/splat/splat_maps.h"
#include "render/splat/splat_sprites.h"

/* Of 2 radii each: what a ray crosses of supports without reaching the level is at most 47 radii or 23 gaps;
   what lies behind is lost. */
enum { SPLAT_LEVEL_ROUNDS = 24 };

typedef struct SplatLevel {
    unsigned next[SPLAT_POINT + 1], sum[SPLAT_POINT + 1], single[SPLAT_POINT + 1]; /* programs, by sprite */
    unsigned open, step, open_found, root, asking;                                 /* programs */
    unsigned queries[SPLAT_LEVEL_ROUNDS]; /* is some pixel still searched? the first is not used */
    unsigned target_number;               /* of the target that the maps were made for */
    unsigned march, value, slope;         /* RGBA32F: see splat_level_step.frag */
    unsigned march_framebuffer, sum_framebuffer, single_framebuffer, next_framebuffer;
} SplatLevel;

/* How far behind the first sphere the first round looks, m: culling must keep the spheres up to there. */
float splat_level_range(const Frame *frame);

/* V W(0): the field in a lone particle's centre. In a flat box W is the kernel of two dimensions, for the
   field is about 1 within its one layer then, too. */
double splat_level_gain(double radius, double spacing, bool flat);

float splat_level_gain_of(const Frame *frame, const ParticleBuffers *particles);

/* Where a lone particle's field is at the level, m; 0 where it does not reach it. */
double splat_level_alone(double level, double gain, double radius);

/* False when a shader does not compile; splat_level_destroy is needed in either case. */
bool splat_level_create(SplatLevel *level, SplatSprites *sprites, Error *error);
void splat_level_destroy(SplatLevel *level);

/* From the spheres' nearest depths in maps->nearest to those of the level there. Sets maps->limit and lists
   for the blending of what is at these depths. */
void splat_level_find(SplatLevel *level, const SplatMaps *maps, SplatSprites *sprites, SplatSprite sprite,
                      const ParticleBuffers *particles, const Frame *frame);

#endif
