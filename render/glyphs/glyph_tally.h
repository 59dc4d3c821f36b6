/* What is counted of the arrows, on its way from the GPU: waited for, or a picture late.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_GLYPH_TALLY_H
#define SLOSH_GLYPH_TALLY_H

#include "render/glyphs/glyphs_def.h"
#include "shaders/glyphs/glyphs_bindings.h"
#include "sim/gl/mailbox.h"

enum { GLYPH_COMMAND_WORDS = 5 };

typedef struct GlyphTally {
    uint32_t bins[GLYPH_BINS]; /* magnitudes above 0, GLYPH_OCTAVE_BINS to an octave, the middle one at 1 */
    uint32_t left_out;         /* vectors and places that are no numbers */
} GlyphTally;

/* Whose tally: of a state the arrows that these settings make. */
typedef struct GlyphTallyOf {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute vectors;
    GlyphsDef def;
} GlyphTallyOf;

/* Zero-initialise it. */
typedef struct GlyphTallies {
    Mailbox box;            /* its buffer: GLYPH_COMMAND_WORDS of glDrawElementsIndirect, then a GlyphTally */
    GlyphTallyOf asked, of; /* what is on its way; what `tally` is of */
    GlyphTally tally;       /* the last that came */
    bool known;             /* one came */
} GlyphTallies;

/* False when memory is short; glyph_tallies_destroy is needed in either case. */
bool glyph_tallies_create(GlyphTallies *tallies, Error *error);
void glyph_tallies_destroy(GlyphTallies *tallies);

/* Of the arrows that were just made of that state. Where frame->behind is NULL the GPU is waited for. Else
   only for the first of a vector (another one has another unit): it may be that of an earlier state or of
   earlier settings, and *frame->behind becomes true. Stays up to the next call. */
const GlyphTally *glyph_tallies_follow(GlyphTallies *tallies, const ParticleBuffers *particles,
                                       const Frame *frame);

/* Of all magnitudes above 0 nineteen of twenty are at most that, to a bin of an eighth of an octave, rounded
   up to 1, 1.5, 2, 3, 5 or 7 times a power of ten; 0 where there are none. */
double glyph_usual(const GlyphTally *tally);

#endif
