/* What layers lie on that do not change with the fluid: the field of a formula or of volume data, and its
   pose. */
#ifndef SLOSH_STILL_FIELD_H
#define SLOSH_STILL_FIELD_H

#include "render/pbsr/pbsr_def.h"
#include "render/pbsr/set_image.h"

/* In a frame of its own, which is the box's where the layer is not moved. False with the reason: a file that
   could not be read, values that are no numbers. */
bool still_field(const PbsrLayer *said, const double box[3], LevelField *field, Error *error);

/* From the layer's frame to the box's, without the shift. */
void still_turn(const PbsrLayer *said, double turn[3][3]);

/* The sight of what is in the layer's frame: of its places, and of the values of its data. */
SetSight still_sight(const PbsrLayer *said, const LevelField *field, const SetSight *sight);

/* Whether it may be seen outside the box. */
bool still_leaves(const PbsrLayer *said, const double box[3]);

#endif
