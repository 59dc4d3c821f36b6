/* The handles in the picture (render/frame/handle.h): the mouse finds, takes and drags handles, keys move the
   view's plane in steps. The results are live settings, like the panel's. A held handle keeps the mouse from
   the camera and the box.

   Each panel has the handles of its own view. The mouse acts in the panel below the cursor; a held handle
   belongs to the chosen view.

   When walls may be taken, walls have handles too, in views of the scene's own state: app/input/touch.h.

   Handles appear only in the window, not in screenshots and videos. */
#ifndef SLOSH_PLAY_GRIP_H
#define SLOSH_PLAY_GRIP_H

#include "app/play/camera.h"
#include "app/play/model.h"
#include "app/window/window.h"
#include "render/frame/handle.h"
#include "render/frame/text.h"
#include "render/frame/view.h"
#include "render/panels.h"

/* A panel's mapping of the newest state to the screen. */
typedef struct Look {
    int panel;
    PanelPlace at;     /* in the picture */
    int width, height; /* of the picture, pixels */
    const ViewDef *view;
    const ParticleBuffers *particles;
    const WorldDef *world; /* world with movable walls; NULL: none */
    Sight sight;
} Look;

typedef struct Grip {
    int over;        /* handle under the mouse or held, plus 1; 0: none */
    int panel;       /* panel of the handle */
    bool taken;      /* a handle is held */
    Handle handle;   /* the held handle at the start */
    SightRay first;  /* of the mouse at the start */
    double mouse[2]; /* pixels of the whole picture */
    bool moved;      /* since the last query of settings or size */
    bool walls;      /* the box's walls have handles */
    bool wall;       /* the held handle belongs to a wall */
} Grip;

/* Resets: no handle is held. */
void grip_begin(Grip *grip);

/* Updates the mouse position; call before the event's other effects. */
void grip_follow(Grip *grip, const WindowEvent *event);

/* Handles an event in the panel under the mouse, or of the held handle; returns true if the event belongs to
   the grip alone. `free`: nothing else uses the mouse. */
bool grip_event(Grip *grip, const Look *look, const WindowEvent *event, bool free);

/* Settings of the panel's view for the drag since the last call; returns their count. */
int grip_settings(Grip *grip, const Look *look, ViewSetting settings[VIEW_SETTINGS_MAX]);

/* Box size for the drag of a wall since the last call, m; false: no drag. */
bool grip_size(Grip *grip, const Look *look, double size[3]);

/* Settings for a key step in the chosen view; returns 0, with a message, if the view has no plane. */
int grip_step(const Model *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX]);

/* Draws a ring like a handle's, in a colour of its own. */
void grip_draw_ring(const Look *look, const Handle *ring, Text *text, uint32_t rgba);

void grip_draw(const Grip *grip, const Look *look, Text *text);

#endif
