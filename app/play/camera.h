/* The window's camera: as in the scene, or in the user's hand (app/input/hand.h). Changes the view of the
   open scene; callers must notify the picture. */
#ifndef SLOSH_PLAY_CAMERA_H
#define SLOSH_PLAY_CAMERA_H

#include "app/input/hand.h"
#include "app/play/model.h"
#include "render/frame/handle.h"

/* Zero-initialise before use. */
typedef struct PlayCamera {
    bool held; /* in the user's hand */
    Orbit orbit;
} PlayCamera;

/* The area of the picture for the camera. */
typedef struct CameraSight {
    int width, height;   /* pixels */
    double covered_left; /* of the width, 0 .. 1 */
    double legend;       /* width kept free on the right for the legend, 0 .. 1 */
} CameraSight;

/* The present camera, automatic or in the hand. */
Orbit camera_now(const PlayCamera *camera, const Model *model, const CameraSight *sight);

/* The mapping of a view to the screen, for the newest state; `letters`: text height, pixels. */
void camera_sight(const Model *model, const ViewDef *view, const CameraSight *sight, double letters,
                  Sight *out);

/* Takes the camera into the hand. */
void camera_grab(PlayCamera *camera, const Model *model, const CameraSight *sight);

/* Call after the hand has moved `orbit`. */
void camera_moved(const PlayCamera *camera, Model *model);

/* Restores the camera of the file. */
void camera_home(PlayCamera *camera, Model *model);

#endif
