/* Colormaps: from a number in 0 .. 1 to a colour. */
#ifndef SLOSH_COLORMAP_H
#define SLOSH_COLORMAP_H

#include "sim/base/control_points.h"
#include "sim/base/error.h"
#include "sim/base/scalar.h"

#include <stdbool.h>
#include <stdint.h>

extern const char *const *const colormap_list; /* names, ended by NULL */
extern const char *const colormap_choices[];   /* the same behind "auto" */

/* The name itself, or what "auto" is of that scalar. */
const char *colormap_of(const char *name, Scalar scalar);

enum { COLORMAP_SIZE = 256 };

/* Fills `rgb` with COLORMAP_SIZE sRGB colours; false when there is no colormap of that name. */
bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE]);

/* The same, bent: of a place x in the scalar's range the colour at the curve's y. */
bool colormap_fill_bent(const char *name, const ControlPoints *curve, uint8_t rgb[3 * COLORMAP_SIZE]);

/* A colormap for shaders: a texture of COLORMAP_SIZE x 1 texels, sRGB. */
typedef struct ColorTable {
    unsigned texture;
    const char *name; /* of colormap_list */
    ControlPoints curve;
} ColorTable;

/* False, with the reason, when there is none of that name; color_table_destroy is allowed in either case. */
bool color_table_create(ColorTable *table, const char *name, const ControlPoints *curve, Error *error);
void color_table_destroy(ColorTable *table);

/* Bends it by that curve, and binds it for shaders (COLORMAP_UNIT). */
void color_table_bind(ColorTable *table, const ControlPoints *curve);

/* The same for who keeps one whatever the colormap, from a zeroed one on: makes it that of `name`, where it
   is not yet. */
void color_table_follow(ColorTable *table, const char *name, const ControlPoints *curve);

#endif
