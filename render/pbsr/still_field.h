/* The fields of still layers, of a formula or volume data, and the layers' poses. */
#ifndef SLOSH_STILL_FIELD_H
#define SLOSH_STILL_FIELD_H

#include "render/pbsr/pbsr_def.h"
#include "render/pbsr/set_image.h"

/* The field in the layer's own frame, which is the box's frame without a pose. Returns false with the
   reason: a file could not be read, or values are NaN. */
bool still_field(const PbsrLayer *said, const double box[3], LevelField *field, Error *error);

/* Rotation from the layer's frame to the box's, without the translation. */
void still_turn(const PbsrLayer *said, double turn[3][3]);

/* The sight for positions in the layer's frame and for the values of the layer's data. */
SetSight still_sight(const PbsrLayer *said, const LevelField *field, const SetSight *sight);

/* True if the layer may be visible outside the box. */
bool still_leaves(const PbsrLayer *said, const double box[3]);

#endif
