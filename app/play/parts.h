/* The parts of a live window, each with its owner. What flows goes one way: input -> what is asked for ->
   model -> picture; only the files that are named below, and play.c, see all of them. */
#ifndef SLOSH_PLAY_PARTS_H
#define SLOSH_PLAY_PARTS_H

#include "app/hand/outline.h"
#include "app/meter/meter.h"
#include "app/play/ask.h"
#include "app/play/camera.h"
#include "app/play/files.h"
#include "app/play/grip.h"
#include "app/play/input.h"
#include "app/play/model.h"
#include "app/play/notice.h"
#include "app/play/overlay.h"
#include "app/play/picture.h"
#include "app/play/readout.h"
#include "app/play/views.h"
#include "app/touch/touch.h"
#include "app/watch/watch.h"
#include "app/window/shake.h"
#include "app/window/window.h"

/* A finger on a gamepad, or on a motion device whose axes have the camera else. */
typedef struct PadFinger {
    double looked_ms;       /* wall time of the last look */
    double press, until_ms; /* of a device: how it presses, and until when without more news */
} PadFinger;

/* A scene whose file is saved in an editor while it is open. */
typedef struct Reload {
    Watch watch;
    size_t opened; /* Model.scenes_opened of what it watches */
    Error broken;  /* why the file is not taken, until it is mended: stands in the picture; "": it is */
} Reload;

typedef struct Play {
    Window *window;
    HandPost *post;
    Input input;
    AskQueue asks; /* done between two pictures */
    Model model;
    PlayCamera camera;
    Grip grip;
    TouchTool touch;
    unsigned solids; /* Model.solids that the views show */
    PadFinger pad;
    unsigned wall_messages; /* SimulatorStatus.messages when a wall was taken */
    BoxTarget wanted;       /* where the hand wants the box, */
    bool outlined;          /* and an outline shows it */
    Readout readout;
    PlayViews views;
    Picture picture;
    Overlay overlay;
    Files files;
    Reload reload;
    PlayMeter meter;
    Notice notice;
    double shake_seconds; /* given: more than 0: a script shakes the box for so long, then all ends */
    WindowShake shake;
    double looked_ms; /* wall time of the last look in the middle of a picture */
    double asked_ms;  /* wall time at which the user was asked whether to close without saving; 0: never */
    bool drawing;     /* a picture is being drawn */
    bool quit;
} Play;

/* What of the picture a camera fills: a panel. Several lie beside what covers the picture. */
static inline CameraSight play_sight_in(const Play *play, int panel)
{
    const double covered = overlay_covered_left(&play->overlay, play->picture.width);
    const PanelPlace at = picture_place(&play->picture, panel, covered);
    const bool one = play->model.open.scene.view_count == 0;
    return (CameraSight){at.width, at.height, one ? covered : 0,
                         play->picture.panels ? panels_legend(play->picture.panels) : 0};
}

/* The same of the chosen view. */
static inline CameraSight play_sight(const Play *play)
{
    return play_sight_in(play, play->picture.chosen);
}

/* How a panel shows the newest state; there must be one. */
static inline Look play_look(const Play *play, int panel)
{
    const CameraSight sight = play_sight_in(play, panel);
    const Picture *picture = &play->picture;
    Look look = {.panel = panel,
                 .at = picture_place(picture, panel, overlay_covered_left(&play->overlay, picture->width)),
                 .width = picture->width,
                 .height = picture->height,
                 .view = views_def(&play->views, &play->model.open.scene, panel),
                 .particles = NULL,
                 .world = NULL};
    look.particles = model_state(&play->model, look.view);
    if (look.particles == &play->model.particles && play->model.open.source->simulates && picture->panels &&
        !renderer_is_flat(panels_renderer(picture->panels, panel)))
        look.world = &play->model.open.scene.world;
    camera_sight(&play->model, look.view, &sight, text_height(picture->text), &look.sight);
    return look;
}

/* events.c: once a loop, between two pictures: all that has come, each event done before the next one is
   looked at. */
void events_take(Play *play);

/* In the middle of a picture: what is held follows a picture sooner. The second one is called between the
   passes of a picture (gl_timer_between, with a Play), and looks only where the mouse or a key holds
   something. */
void events_follow_hand(Play *play);
void events_between_passes(void *of_play);

/* While something else is being done, between two pictures: what moves the box or the finger. */
void events_take_moves(Play *play);

/* hands.c: what the hand does, between two pictures or in the middle of one; there must be a state. */
void hands_look(Play *play);

/* hands.c: how the mouse looks at the fluid in a panel: what is under it, and where the camera looks. */
void hands_ray(const Play *play, const Look *look, SightRay *ray, double forward[3]);

/* hands.c: a solid is put where the mouse is, of that shape (SolidCommand.like; SOLID_LIKE: as the solid
   under the mouse), or the one there is taken out. */
void hands_put(Play *play, int like);
void hands_take(Play *play);

/* hands.c: gravity, in the world's frame, m/s2; so many radians more to the right and away in the picture. */
void hands_set_gravity(Play *play, const double gravity[3]);
void hands_tilt_gravity(Play *play, const double amount[2]);

/* act.c: all that waits, in the order in which it was asked for. */
void act_all(Play *play);

/* Opens a scene: what it was before stays where it cannot be opened. */
bool act_open(Play *play, const char *scene, const SceneSettings *settings, Error *error);

/* After app/play/again.h: the scene has begun anew, or its views are others, or something else of it. */
void act_follow_again(Play *play, bool begun, bool views);

/* reload.c: once a loop, between two pictures: a file that was saved is read again, and what has changed is
   there at once. */
void reload_look(Play *play);

/* draw.c: one picture of the newest state on the screen. While time is paused what lies over the fluid may be
   drawn anew without it: on a software driver a fluid takes a while, and the mouse asks all the time. Whether
   one with the fluid is due. */
void draw_picture(Play *play);
bool draw_needs_fluid(const Play *play);

#endif
