/* The parts of a live window, each with its owner. What flows goes one way: input -> what is asked for ->
   model -> picture; only act.c, hands.c and play.c see all of them. */
#ifndef SLOSH_PLAY_PARTS_H
#define SLOSH_PLAY_PARTS_H

#include "app/play/ask.h"
#include "app/play/camera.h"
#include "app/play/files.h"
#include "app/play/input.h"
#include "app/play/meter.h"
#include "app/play/model.h"
#include "app/play/notice.h"
#include "app/play/overlay.h"
#include "app/play/picture.h"
#include "app/window/window.h"

typedef struct Play {
    Window *window;
    HandPost *post;
    Input input;
    AskQueue asks; /* done between two pictures */
    Model model;
    PlayCamera camera;
    Picture picture;
    Overlay overlay;
    Files files;
    PlayMeter meter;
    Notice notice;
    bool quit;
} Play;

/* What of the picture the camera fills. */
static inline CameraSight play_sight(const Play *play)
{
    const int width = play->picture.width;
    return (CameraSight){width, play->picture.height, overlay_covered_left(&play->overlay, width)};
}

#endif
