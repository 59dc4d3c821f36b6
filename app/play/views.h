/* Several views of what runs in the window, each in a panel of its own. The scene's `view` is the one that is
   chosen: camera, keys and settings are its; `views` of the scene has all that are shown, with the chosen one
   among them, and view_count is 0 while one alone is shown. */
#ifndef SLOSH_PLAY_VIEWS_H
#define SLOSH_PLAY_VIEWS_H

#include "app/scene/scene.h"

/* Zero-initialise it. */
typedef struct PlayViews {
    int known;  /* entries of the scene's `views` that have been made */
    int chosen; /* place of the scene's `view` among them */
    bool free;  /* each camera on its own; false: they move together */
} PlayViews;

/* A scene was opened, `file` is the same as its file has it: its views are shown, the first of them chosen.
   Cameras are free where some differ. */
void views_open(PlayViews *views, Scene *scene, Scene *file);

/* Shows 1, 2 or 4, in turn; a view that is not there yet is like the chosen one, drawn in another way. */
void views_cycle(PlayViews *views, Scene *scene);

/* Chooses the view in that panel; false: it was. `file` gets as its view what camera-home goes back to. */
bool views_choose(PlayViews *views, Scene *scene, Scene *file, int panel);

/* Cameras move together, from where the chosen one is, or each on its own. */
void views_link(PlayViews *views, Scene *scene);

/* After any change of the chosen view. */
void views_follow(const PlayViews *views, Scene *scene);

/* What a panel shows. */
const ViewDef *views_def(const PlayViews *views, const Scene *scene, int panel);

/* The panel of the chosen view. */
int views_panel(const PlayViews *views, const Scene *scene);

#endif
