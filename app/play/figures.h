/* Figures of a session in the window. */
#ifndef SLOSH_PLAY_FIGURES_H
#define SLOSH_PLAY_FIGURES_H

#include "app/meter/report.h"
#include "app/play/parts.h"

void figures_of(const Play *play, PlayFigures *figures);

#endif
