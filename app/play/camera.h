/* The camera of the window: as the scene has it, or in the user's hand (app/hand/orbit.h). It changes the
   view of the scene that is open; the picture is to be told. */
#ifndef SLOSH_PLAY_CAMERA_H
#define SLOSH_PLAY_CAMERA_H

#include "app/hand/orbit.h"
#include "app/play/model.h"
#include "render/frame/handle.h"

/* Zero-initialise it. */
typedef struct PlayCamera {
    bool held; /* it is in the hand */
    Orbit orbit;
} PlayCamera;

/* What of the picture the camera fills. */
typedef struct CameraSight {
    int width, height;   /* pixels */
    double covered_left; /* of the width, 0 .. 1 */
    double legend;       /* at least so much of it is left free on the right */
} CameraSight;

/* The camera as it is now, automatic or in the hand. */
Orbit camera_now(const PlayCamera *camera, const Model *model, const CameraSight *sight);

/* How a view shows the newest state; letters are so many pixels high. */
void camera_sight(const Model *model, const ViewDef *view, const CameraSight *sight, double letters,
                  Sight *out);

/* From now on it is in the hand. */
void camera_grab(PlayCamera *camera, const Model *model, const CameraSight *sight);

/* The hand has moved `orbit`. */
void camera_moved(const PlayCamera *camera, Model *model);

/* As the file has it. */
void camera_home(PlayCamera *camera, Model *model);

#endif
