/* Does what is asked of the window, between two pictures. */
#ifndef SLOSH_PLAY_ACT_H
#define SLOSH_PLAY_ACT_H

#include "app/play/parts.h"

/* All that waits, in the order in which it was asked for. */
void act_all(Play *play);

/* Opens a scene: what it was before stays where it cannot be opened. */
bool act_open(Play *play, const char *scene, const SceneSettings *settings, Error *error);

#endif
