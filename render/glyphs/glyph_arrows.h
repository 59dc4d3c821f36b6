/* The arrows of the present state on the GPU: feet and vectors.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_GLYPH_ARROWS_H
#define SLOSH_GLYPH_ARROWS_H

#include "render/glyphs/glyph_tally.h"
#include "render/particles/neighbourhood.h"
#include "render/particles/particle_bind.h"

/* Zero-initialise. */
typedef struct GlyphArrows {
    unsigned particles, samples; /* programs */
    Neighbourhood neighbourhood;
    bool sorts;           /* `neighbourhood` has been created, at least in part */
    unsigned arrows;      /* buffer: foot and vector, two vec4 per arrow */
    GlyphTallies tallies; /* counts, and the drawing command: six indices per arrow */
    unsigned no_scalar;   /* buffer: replaces a missing scalar */
    size_t capacity;      /* capacity in arrows */
    size_t most;          /* largest number of arrows of the last run; 0: none */
    double apart;         /* approximate distance between arrows, m */
    bool coarser;         /* spacing is larger than asked: there would be too many arrows */
} GlyphArrows;

/* Returns false if a shader does not compile; call glyph_arrows_destroy in either case. */
bool glyph_arrows_create(GlyphArrows *arrows, Error *error);
void glyph_arrows_destroy(GlyphArrows *arrows);

/* Makes the arrows of a state. */
void glyph_arrows_make(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame);

/* The counts of the last arrows, of the same state: as glyph_tallies_follow. */
const GlyphTally *glyph_arrows_count(GlyphArrows *arrows, const ParticleBuffers *particles,
                                     const Frame *frame);

#endif
