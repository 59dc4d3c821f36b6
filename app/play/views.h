/* Several views of the window, each in a panel of its own. The scene's `view` is the chosen view, for camera,
   keys and settings; `views` has all shown views including the chosen one, and view_count is 0 while only one
   view is shown. */
#ifndef SLOSH_PLAY_VIEWS_H
#define SLOSH_PLAY_VIEWS_H

#include "app/scene/scene.h"

/* Zero-initialise before use. */
typedef struct PlayViews {
    int known;  /* count of initialised entries of the scene's `views` */
    int chosen; /* index of the scene's `view` in `views` */
    bool free;  /* each camera moves alone; false: all move together */
} PlayViews;

/* Call after opening a scene; `file`: the scene as in the file. Shows the scene's views, the first chosen.
   Cameras are free if they differ. */
void views_open(PlayViews *views, Scene *scene, Scene *file);

/* Shows 1, 2 or 4 views in turn; a new view copies the chosen view with the next kind. */
void views_cycle(PlayViews *views, Scene *scene);

/* Chooses the view of that panel; false if already chosen. The view of `file` becomes the target of
   camera-home. */
bool views_choose(PlayViews *views, Scene *scene, Scene *file, int panel);

/* Toggles linked cameras: all move together, starting from the chosen camera, or each alone. */
void views_link(PlayViews *views, Scene *scene);

/* Call after any change of the chosen view. */
void views_follow(const PlayViews *views, Scene *scene);

/* The view of a panel. */
const ViewDef *views_def(const PlayViews *views, const Scene *scene, int panel);

/* The panel of the chosen view. */
int views_panel(const PlayViews *views, const Scene *scene);

#endif
