/* Binding numbers used only by the shaders of slices; more in shaders/shared/bindings.h. */
#ifndef SLOSH_SLICE_BINDINGS_H
#define SLOSH_SLICE_BINDINGS_H

/* Texture units */
#define SUMS_UNIT  1
#define VEIL_UNIT  6 /* sums of the opacity's scalar */
#define GREEN_UNIT 8 /* sums of the fluids' colours; red: SUMS_UNIT */
#define BLUE_UNIT  9

/* Locations of uniforms */
#define SHOWN_AT    16
#define CUT_AT      17
#define ISOLINES_AT 18
#define FLAT_AT     19
#define OPACITY_AT  20

/* Values of the uniform shown */
#define SLICE_MEAN  0 /* sum V W s over sum V W */
#define SLICE_RAW   1 /* sum V W s */
#define SLICE_FIELD 2 /* sum V W */
#define SLICE_TINTS 3 /* the fluids' colours */

#endif
