/* Slices and clouds of volume data, as pieces for random points: made once. */
#ifndef SLOSH_DATA_PIECES_H
#define SLOSH_DATA_PIECES_H

#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"

/* True if the layer is a slice or cloud of a file. */
bool data_pieces_are(const PbsrLayer *said);

/* Makes the pieces from still_field's field. A slice has the data's resolution. A cloud's density is
   proportional to the value above the level, 1 at the largest value. Returns false if memory is short, or
   if the result would be empty. */
bool data_pieces_make(const PbsrLayer *said, const LevelField *field, unsigned number, Layer *out,
                      Error *error);

/* Density of the points of a set, from the layer's opacity. */
double data_pieces_density(const PbsrLayer *said);

#endif
