/* Particles as sprites for the passes of the view splat: quads or points, of all particles or a culled
   list. */
#ifndef SLOSH_SPLAT_SPRITES_H
#define SLOSH_SPLAT_SPRITES_H

#include "render/particles/particle_bind.h"
#include "render/splat/cull.h"
#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_def.h"

typedef struct SplatSprites {
    SplatDef def;
    float point_limit; /* largest GL point of the driver, pixels; 0 on hardware, where quads cost no more */
    unsigned screen;   /* vertex array without attributes */
    QuadIndices quads;
    Cull cull;        /* if splat_culls */
    FluidTiles tiles; /* tiles that listed particles touch; all tiles in the bounds without culling or with
                         a level */
} SplatSprites;

/* Returns false if a shader does not compile; call splat_sprites_destroy in either case. */
bool splat_sprites_create(SplatSprites *sprites, const SplatDef *def, Error *error);
void splat_sprites_destroy(SplatSprites *sprites);

/* True if some frame may be drawn with `sprite`; false for SPLAT_AUTO. */
bool splat_sprites_may(const SplatSprites *sprites, SplatSprite sprite);

/* Quad or point for this frame, for spheres of `radius` (m) in a picture `height` pixels high. */
SplatSprite splat_sprites_choose(const SplatSprites *sprites, const Frame *frame, float radius, float height);

/* True if some sphere may be so small that its sprite is enlarged: shaders/splat/splat_small.glsl. */
bool splat_sprites_small(const Frame *frame);

/* Compiles splat/splat.vert with a fragment shader, for all particles or (`listed`) a culled list. The
   caller deletes the program. Returns 0 on failure. */
unsigned splat_sprites_program(const SplatSprites *sprites, SplatSprite sprite, bool listed,
                               const char *fragment, const char *defines, Error *error);

/* Draws with a program of splat_sprites_program; `list` NULL: all particles. */
void splat_sprites_draw(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                        const ParticleBuffers *particles, const Frame *frame, const CullList *list);

/* Draws a list that is already bound; the number comes from the command in a buffer. */
void splat_sprites_draw_listed(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                               const ParticleBuffers *particles, const Frame *frame, unsigned command);

/* Draws a point per particle with any program, except programs of splat/splat.vert: for these use
   splat_sprites_draw. */
void splat_sprites_draw_points(SplatSprites *sprites, unsigned program, const ParticleBuffers *particles,
                               const Frame *frame, const CullList *list);

/* Sets the GL state for sprites that are blended with the framebuffer by `equation`, without depth test. */
void splat_sprites_begin(unsigned framebuffer, const Frame *frame, unsigned equation);

#endif
