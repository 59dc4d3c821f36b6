/* The surface of the view splat at a level above zero: phi^-1(I) of the field phi(x) = sum V_i W(x - x_i,
   h_i) (Adams et al. 2006, eq. 1; their future work, section 6), by root finding along the rays. W is
   poly6 (Müller 2003, eq. 20) with the sphere's radius as support; V is a particle's volume at rest,
   spacing^3.

   Each round splats the spheres once and sums the field and its slope at four depths behind the ray's
   first sphere. The root is the first crossing of the cubic Hermite pieces, refined by one Newton step on
   another splatted sum. If the field does not reach the level, the next round continues behind. A round
   that no pixel needs is not drawn. */
#ifndef SLOSH_SPLAT_LEVEL_H
#define SLOSH_SPLAT_LEVEL_H

#include "render/splat/splat_maps.h"
#include "render/splat/splat_sprites.h"

/* Each round covers 2 radii: a ray may cross at most 47 radii, or 23 gaps, of support below the level;
   surfaces farther behind are lost. */
enum { SPLAT_LEVEL_ROUNDS = 24 };

typedef struct SplatLevel {
    unsigned next[SPLAT_POINT + 1], sum[SPLAT_POINT + 1], single[SPLAT_POINT + 1]; /* programs, by sprite */
    unsigned open, step, open_found, root, asking;                                 /* programs */
    unsigned queries[SPLAT_LEVEL_ROUNDS]; /* true if some pixel still searches; the first query is not used */
    unsigned target_number;               /* number of the target that gave the maps their size */
    unsigned march, value, slope;         /* RGBA32F: see splat_level_step.frag */
    unsigned march_framebuffer, sum_framebuffer, single_framebuffer, next_framebuffer;
} SplatLevel;

/* Depth that the first round searches behind the first sphere, m: culling must keep all spheres in this
   range. */
float splat_level_range(const Frame *frame);

/* V W(0): the field in the centre of a lone particle. In a flat box W is the two-dimensional kernel, so
   that the field in the one layer is about 1 too. */
double splat_level_gain(double radius, double spacing, bool flat);

float splat_level_gain_of(const Frame *frame, const ParticleBuffers *particles);

/* The distance from a lone particle at which the field equals the level, m; 0 if the field never reaches
   the level. */
double splat_level_alone(double level, double gain, double radius);

/* Returns false if a shader does not compile; call splat_level_destroy in either case. */
bool splat_level_create(SplatLevel *level, SplatSprites *sprites, Error *error);
void splat_level_destroy(SplatLevel *level);

/* Replaces the spheres' nearest depths in maps->nearest by the depths of the level. Sets maps->limit and
   lists for blending at these depths. */
void splat_level_find(SplatLevel *level, const SplatMaps *maps, SplatSprites *sprites, SplatSprite sprite,
                      const ParticleBuffers *particles, const Frame *frame);

#endif
