/* Reads back counts of the arrows from the GPU, waiting or one picture late.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_GLYPH_TALLY_H
#define SLOSH_GLYPH_TALLY_H

#include "render/glyphs/glyphs_def.h"
#include "shaders/glyphs/glyphs_bindings.h"
#include "sim/gl/mailbox.h"

enum { GLYPH_COMMAND_WORDS = 5 };

typedef struct GlyphTally {
    uint32_t bins[GLYPH_BINS]; /* histogram of magnitudes above 0, GLYPH_OCTAVE_BINS bins per octave, the
                                  middle bin at 1 */
    uint32_t left_out;         /* number of NaN vectors and positions */
} GlyphTally;

/* Identifies a tally: a state and the settings of its arrows. */
typedef struct GlyphTallyOf {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute vectors;
    GlyphsDef def;
} GlyphTallyOf;

/* Zero-initialise. */
typedef struct GlyphTallies {
    Mailbox box;            /* its buffer: GLYPH_COMMAND_WORDS of glDrawElementsIndirect, then a GlyphTally */
    GlyphTallyOf asked, of; /* request in flight; source of `tally` */
    GlyphTally tally;       /* the last answer */
    bool known;             /* an answer has arrived */
} GlyphTallies;

/* Returns false if memory is short; call glyph_tallies_destroy in either case. */
bool glyph_tallies_create(GlyphTallies *tallies, Error *error);
void glyph_tallies_destroy(GlyphTallies *tallies);

/* The tally of the arrows just made, for the same state. If frame->behind is NULL, waits for the GPU. Else
   waits only for the first tally of a vector, since vectors have different units. Later tallies may be of
   an earlier state or earlier settings; then *frame->behind becomes true. Valid until the next call. */
const GlyphTally *glyph_tallies_follow(GlyphTallies *tallies, const ParticleBuffers *particles,
                                       const Frame *frame);

/* The magnitude that nineteen of twenty arrows (of those above 0) do not exceed, to a bin of an eighth of
   an octave, rounded up to 1, 1.5, 2, 3, 5 or 7 times a power of ten; 0 without arrows. */
double glyph_usual(const GlyphTally *tally);

#endif
