/* Colormaps: from a number in 0 .. 1 to a colour. */
#ifndef SLOSH_COLORMAP_H
#define SLOSH_COLORMAP_H

#include "sim/base/control_points.h"
#include "sim/base/error.h"
#include "sim/base/scalar.h"

#include <stdbool.h>
#include <stdint.h>

extern const char *const *const colormap_list; /* names, ended by NULL */
extern const char *const colormap_choices[];   /* "auto", then the names */

/* Returns `name`, or the colormap that "auto" stands for with this scalar. */
const char *colormap_of(const char *name, Scalar scalar);

enum { COLORMAP_SIZE = 256 };

/* Fills `rgb` with COLORMAP_SIZE sRGB colours. Returns false if `name` is unknown. */
bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE]);

/* As colormap_fill, bent by a curve: position x in the scalar's range gets the colour at the curve's y. */
bool colormap_fill_bent(const char *name, const ControlPoints *curve, uint8_t rgb[3 * COLORMAP_SIZE]);

/* A colormap for shaders: a texture of COLORMAP_SIZE x 1 texels, sRGB. */
typedef struct ColorTable {
    unsigned texture;
    const char *name; /* one of colormap_list */
    ControlPoints curve;
} ColorTable;

/* Returns false, with the reason, if `name` is unknown; color_table_destroy is allowed in either case. */
bool color_table_create(ColorTable *table, const char *name, const ControlPoints *curve, Error *error);
void color_table_destroy(ColorTable *table);

/* Bends the colormap by `curve` and binds the texture for shaders (COLORMAP_UNIT). */
void color_table_bind(ColorTable *table, const ControlPoints *curve);

/* For owners of one table for changing colormaps: changes the table to `name` and `curve` if different.
   The table may be zeroed. */
void color_table_follow(ColorTable *table, const char *name, const ControlPoints *curve);

#endif
