/* Which arrows there are: feet and vectors of the present state, on the GPU.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_GLYPH_ARROWS_H
#define SLOSH_GLYPH_ARROWS_H

#include "render/glyphs/glyph_tally.h"
#include "render/particles/neighbourhood.h"
#include "render/particles/particle_bind.h"

/* Zero-initialise it. */
typedef struct GlyphArrows {
    unsigned particles, samples; /* programs */
    Neighbourhood neighbourhood;
    bool sorts;           /* `neighbourhood` is there, or what a failure has left of it */
    unsigned arrows;      /* buffer: foot and vector, two vec4 an arrow */
    GlyphTallies tallies; /* and the command that draws: six indices an arrow */
    unsigned no_scalar;   /* buffer: stands in for a scalar that is not there */
    size_t capacity;      /* arrows that there is room for */
    size_t most;          /* that the last run may have made; 0: none */
    double apart;         /* from one to the next, about, m */
    bool coarser;         /* than was asked for: there would be too many */
} GlyphArrows;

/* False when a shader does not compile; glyph_arrows_destroy is needed in either case. */
bool glyph_arrows_create(GlyphArrows *arrows, Error *error);
void glyph_arrows_destroy(GlyphArrows *arrows);

/* Those of that state. */
void glyph_arrows_make(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame);

/* What is counted of those made last, of that state: as glyph_tallies_follow. */
const GlyphTally *glyph_arrows_count(GlyphArrows *arrows, const ParticleBuffers *particles,
                                     const Frame *frame);

#endif
