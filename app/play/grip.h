/* The handles in the picture (render/frame/handle.h): the mouse finds, takes and drags them, keys step what
   they are of. What it does are live settings, as those of the panel. A handle that is taken keeps the mouse
   from the camera and from the box.

   Of several panels each has the handles of its own view; the mouse acts in the panel under it, and one that
   is taken is the chosen view's.

   While the walls are to be taken they have handles, too, in views of the scene's own state:
   app/touch/walls.h.

   Handles are drawn over the window's own picture, not into screenshots and videos. */
#ifndef SLOSH_PLAY_GRIP_H
#define SLOSH_PLAY_GRIP_H

#include "app/play/camera.h"
#include "app/play/model.h"
#include "app/window/window.h"
#include "render/frame/handle.h"
#include "render/frame/text.h"
#include "render/frame/view.h"
#include "render/panels.h"

/* How a panel shows the newest state. */
typedef struct Look {
    int panel;
    PanelPlace at;     /* in the picture, */
    int width, height; /* of so many pixels */
    const ViewDef *view;
    const ParticleBuffers *particles;
    const WorldDef *world; /* whose walls may be taken; NULL: none */
    Sight sight;
} Look;

typedef struct Grip {
    int over;        /* the handle under the mouse or in the hand, plus 1; 0: none */
    int panel;       /* where it is */
    bool taken;      /* it is in the hand: */
    Handle handle;   /* as it was then */
    SightRay first;  /* of the mouse then */
    double mouse[2]; /* pixels of the whole picture */
    bool moved;      /* since it was last asked for what it does */
    bool walls;      /* the walls of the box have handles */
    bool wall;       /* the one that is taken is a wall's */
} Grip;

/* Nothing is held. */
void grip_begin(Grip *grip);

/* The mouse is where an event has it: before all else that the event does. */
void grip_follow(Grip *grip, const WindowEvent *event);

/* Takes notice of an event in the panel under the mouse, or in that of the handle that is taken; whether it
   is the grip's alone. `free`: nothing else has the mouse. */
bool grip_event(Grip *grip, const Look *look, const WindowEvent *event, bool free);

/* What the drag since the last call asks of the panel's view; how many settings. */
int grip_settings(Grip *grip, const Look *look, ViewSetting settings[VIEW_SETTINGS_MAX]);

/* The size that the drag of a wall since the last call asks for, m; false: none. */
bool grip_size(Grip *grip, const Look *look, double size[3]);

/* What a key asks of the chosen view; 0, with a word to the user, where the view is of no plane. */
int grip_step(const Model *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX]);

/* A ring as handles have it, in no colour of theirs. */
void grip_draw_ring(const Look *look, const Handle *ring, Text *text, uint32_t rgba);

void grip_draw(const Grip *grip, const Look *look, Text *text);

#endif
