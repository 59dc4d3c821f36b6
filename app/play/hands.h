/* What the hand does: by mouse, keys and gamepad, and by motion devices. It moves the box at once, through
   the simulator's own queue; all else that it asks for is queued. */
#ifndef SLOSH_PLAY_HANDS_H
#define SLOSH_PLAY_HANDS_H

#include "app/play/parts.h"

/* Between two pictures, or in the middle of one; there must be a state. */
void hands_look(Play *play);

#endif
