/* What a session in the window was, from its parts. */
#ifndef SLOSH_PLAY_FIGURES_H
#define SLOSH_PLAY_FIGURES_H

#include "app/play/parts.h"
#include "app/play/report.h"

void figures_of(const Play *play, PlayFigures *figures);

#endif
