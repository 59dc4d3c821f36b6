/* Parts of the overlay glyphs: counts read back from the GPU, and the arrows of a state. */
#ifndef RENDER_OVERLAYS_GLYPHS_GLYPHS_PRIVATE_H
#define RENDER_OVERLAYS_GLYPHS_GLYPHS_PRIVATE_H

#include "render/overlays/glyphs/glyphs.h"

#include "render/particles/particles.h"
#include "shaders/glyphs/glyphs_bindings.h"
#include "sim/gpu/particle_buffers.h"

/* Reads back counts of the arrows from the GPU, waiting or one picture late.

   Needs a current OpenGL 4.5 core context. */

enum { GLYPH_COMMAND_WORDS = 5 };

typedef struct GlyphTally {
    uint32_t bins[GLYPH_BINS]; /* histogram of magnitudes above 0, GLYPH_OCTAVE_BINS bins per octave, the
                                  middle bin at 1 */
    uint32_t left_out;         /* number of NaN vectors and positions */
} GlyphTally;

/* Identifies a tally: a state and the settings of its arrows. */
typedef struct GlyphTallySource {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute vectors;
    GlyphsDef def;
} GlyphTallySource;

/* Zero-initialise. */
typedef struct GlyphTallies {
    Mailbox box; /* its buffer: GLYPH_COMMAND_WORDS of glDrawElementsIndirect, then a GlyphTally */
    GlyphTallySource asked, of; /* request in flight; source of `tally` */
    GlyphTally tally;           /* the last answer */
    bool known;                 /* an answer has arrived */
} GlyphTallies;

/* The magnitude that nineteen of twenty arrows (of those above 0) do not exceed, to a bin of an eighth of
   an octave, rounded up to 1, 1.5, 2, 3, 5 or 7 times a power of ten. 0 without arrows. */
double glyph_typical_magnitude(const GlyphTally *tally);

/* The arrows of the present state on the GPU: feet and vectors.

   Needs a current OpenGL 4.5 core context. */

/* Zero-initialise. */
typedef struct GlyphArrows {
    unsigned particles, samples; /* programs */
    unsigned arrows;             /* buffer: foot and vector, two vec4 per arrow */
    GlyphTallies tallies;        /* counts, and the drawing command: six indices per arrow */
    unsigned no_scalar;          /* buffer: replaces a missing scalar */
    size_t capacity;             /* capacity in arrows */
    size_t most;                 /* largest number of arrows of the last run; 0: none */
    double apart;                /* approximate distance between arrows, m */
    bool coarser;                /* spacing is larger than asked: there would be too many arrows */
} GlyphArrows;

/* Returns false if a shader does not compile; call glyph_arrows_destroy in either case. */
bool glyph_arrows_create(GlyphArrows *arrows, Error *error);
void glyph_arrows_destroy(GlyphArrows *arrows);

/* Makes the arrows of a state. */
void glyph_arrows_make(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame);

/* The counts of the last arrows, of the same state: as glyph_tallies_update. */
const GlyphTally *glyph_arrows_count(GlyphArrows *arrows, const ParticleBuffers *particles,
                                     const Frame *frame);

#endif
