/* Slices and the cloud of volume data, as pieces that points are strewn over: made once. */
#ifndef SLOSH_DATA_PIECES_H
#define SLOSH_DATA_PIECES_H

#include "render/pbsr/layer.h"
#include "render/pbsr/pbsr_def.h"

/* Whether a layer is that. */
bool data_pieces_are(const PbsrLayer *said);

/* Of the field that still_field gives. A slice is as fine as the data. The cloud is as dense as values are
   above the level, 1 at the greatest. False when memory is short, or there is nothing of it. */
bool data_pieces_make(const PbsrLayer *said, const LevelField *field, unsigned number, Layer *out,
                      Error *error);

/* Points of a set as the layer's opacity asks for. */
double data_pieces_density(const PbsrLayer *said);

#endif
