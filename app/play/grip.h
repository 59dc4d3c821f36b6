/* The handles in the picture (render/frame/handle.h): the mouse finds, takes and drags them, keys step what
   they are of. What it does are live settings, as those of the panel. A handle that is taken keeps the mouse
   from the camera and from the box.

   Handles are drawn over the window's own picture, not into screenshots and videos. */
#ifndef SLOSH_PLAY_GRIP_H
#define SLOSH_PLAY_GRIP_H

#include "app/play/camera.h"
#include "app/play/model.h"
#include "app/window/window.h"
#include "render/frame/handle.h"
#include "render/frame/text.h"
#include "render/frame/view.h"

typedef struct Grip {
    int over;         /* the handle under the mouse or in the hand, plus 1; 0: none */
    bool taken;       /* it is in the hand: */
    Handle handle;    /* as it was then */
    SightRay first;   /* of the mouse then */
    double mouse[2];  /* pixels */
    bool mouse_known; /* by its own events */
    bool moved;       /* since the last grip_settings */
} Grip;

/* Nothing is held. */
void grip_begin(Grip *grip);

/* Takes notice of an event; whether it is the grip's alone. `free`: nothing else has the mouse. */
bool grip_event(Grip *grip, const Model *model, const Sight *sight, const WindowEvent *event, bool free);

/* What the drag since the last call asks for; how many settings. */
int grip_settings(Grip *grip, const Model *model, const Sight *sight,
                  ViewSetting settings[VIEW_SETTINGS_MAX]);

/* What a key asks for; 0, with a word to the user, where the view is of no plane. */
int grip_step(const Model *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX]);

void grip_draw(const Grip *grip, const Model *model, const Sight *sight, Text *text);

#endif
