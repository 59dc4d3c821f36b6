/* Binding numbers used only by the shaders of glyphs; more in shaders/shared/bindings.h. */
#ifndef SLOSH_GLYPHS_BINDINGS_H
#define SLOSH_GLYPHS_BINDINGS_H

/* Storage buffers, in addition to those of particles and neighbourhood */
#define GLYPH_COMMAND_STORAGE 4
#define GLYPH_ARROWS_STORAGE  5
#define GLYPH_IDS_STORAGE     7

/* Locations of uniforms */
#define GLYPH_COUNT_AT     16 /* particles */
#define GLYPH_ID_STRIDE_AT 19
#define GLYPH_EVERY_AT     20 /* ids */
#define GLYPH_IS_FLUID_AT  24
#define GLYPH_SCALE_AT     32
#define GLYPH_SIZE_AT      33
#define GLYPH_LIFT_AT      34
#define GLYPH_COLOR_AT     35

/* Histogram of magnitudes: bins per octave, the middle bin at 1. */
#define GLYPH_BINS        512
#define GLYPH_OCTAVE_BINS 8

#endif
