/* Particles as sprites for the passes of the view splat: quads or points, all of them or what culling left.
 */
#ifndef SLOSH_SPLAT_SPRITES_H
#define SLOSH_SPLAT_SPRITES_H

#include "render/particles/particle_bind.h"
#include "render/splat/cull.h"
#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_def.h"

typedef struct SplatSprites {
    SplatDef def;
    float point_limit; /* largest point that the driver draws, pixels; 0 on hardware: quads cost no more there
                        */
    unsigned screen;   /* vertex array without attributes */
    QuadIndices quads;
    Cull cull;        /* where splat_culls */
    FluidTiles tiles; /* what listed particles touch; where nothing is culled or a level is looked for, all of
                         the bounds */
} SplatSprites;

/* False when a shader does not compile; splat_sprites_destroy is needed in either case. */
bool splat_sprites_create(SplatSprites *sprites, const SplatDef *def, Error *error);
void splat_sprites_destroy(SplatSprites *sprites);

/* Whether some frame may be drawn with it: never SPLAT_AUTO. */
bool splat_sprites_may(const SplatSprites *sprites, SplatSprite sprite);

/* For this frame: quad or point, for spheres of that radius (m) in a picture that many pixels high. */
SplatSprite splat_sprites_choose(const SplatSprites *sprites, const Frame *frame, float radius, float height);

/* Whether some sphere may be so small that it is drawn larger than it is: shaders/splat/splat_small.glsl. */
bool splat_sprites_small(const Frame *frame);

/* A program of splat/splat.vert and a fragment shader, for all particles or those listed by culling. The
   caller deletes it; 0 on failure. */
unsigned splat_sprites_program(const SplatSprites *sprites, SplatSprite sprite, bool listed,
                               const char *fragment, const char *defines, Error *error);

/* Draws with such a program: all particles where `list` is NULL. */
void splat_sprites_draw(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                        const ParticleBuffers *particles, const Frame *frame, const CullList *list);

/* The same of a list that is bound already, as many as a command in a buffer says. */
void splat_sprites_draw_listed(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                               const ParticleBuffers *particles, const Frame *frame, unsigned command);

/* Draws a point a particle with any program; those of splat/splat.vert are for splat_sprites_draw. */
void splat_sprites_draw_points(SplatSprites *sprites, unsigned program, const ParticleBuffers *particles,
                               const Frame *frame, const CullList *list);

/* Sets the GL state of passes whose sprites are blended by `equation` with what is in the framebuffer,
 * without depth test. */
void splat_sprites_begin(unsigned framebuffer, const Frame *frame, unsigned equation);

#endif
