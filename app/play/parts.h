/* The parts of a live window, each with its owner. Data flows one way: input -> requests -> model -> picture;
   only play.c and the files named below see all parts. */
#ifndef SLOSH_PLAY_PARTS_H
#define SLOSH_PLAY_PARTS_H

#include "app/input/hand.h"
#include "app/input/touch.h"
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
#include "app/watch/watch.h"
#include "app/window/shake.h"
#include "app/window/window.h"

/* A finger moved by a gamepad, or by a motion device whose axes normally move the camera. */
typedef struct PadFinger {
    double looked_ms;       /* wall time of the last look */
    double press, until_ms; /* of a device: pressure, and its end without further reports */
} PadFinger;

/* Watches the open scene's file for saves by an editor. */
typedef struct Reload {
    Watch watch;
    size_t opened; /* Model.scenes_opened at the start of the watch */
    Error broken;  /* reason for not taking the broken file, shown in the picture; "": none */
} Reload;

typedef struct Play {
    Window *window;
    BoxControl *control;
    Input input;
    AskQueue asks; /* executed between two pictures */
    Model model;
    PlayCamera camera;
    Grip grip;
    TouchTool touch;
    unsigned solids; /* Model.solids shown by the views */
    PadFinger pad;
    unsigned wall_messages; /* SimulatorStatus.messages at the taking of a wall */
    BoxTarget wanted;       /* the hand's target of the box */
    bool outlined;          /* an outline shows the target */
    Readout readout;
    PlayViews views;
    Picture picture;
    Overlay overlay;
    Files files;
    Reload reload;
    PlayMeter meter;
    Notice notice;
    double shake_seconds; /* given: more than 0: a script shakes the box for that time, then all ends */
    WindowShake shake;
    double looked_ms; /* wall time of the last look during a picture */
    double asked_ms;  /* wall time of the question to close without saving; 0: never asked */
    bool drawing;     /* a picture is being drawn */
    bool quit;
} Play;

/* The area of a panel for the camera. Several panels lie beside the overlay's panel, not below. */
static inline CameraSight play_sight_in(const Play *play, int panel)
{
    const double covered = overlay_covered_left(&play->overlay, play->picture.width);
    const PanelPlace at = picture_place(&play->picture, panel, covered);
    const bool one = play->model.open.scene.view_count == 0;
    return (CameraSight){at.width, at.height, one ? covered : 0,
                         play->picture.panels ? panels_legend(play->picture.panels) : 0};
}

/* The area of the chosen view's panel. */
static inline CameraSight play_sight(const Play *play)
{
    return play_sight_in(play, play->picture.chosen);
}

/* A panel's mapping of the newest state to the screen; needs a state. */
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

/* events.c: once per loop, between two pictures: handles all waiting events, each completely before the
   next. */
void events_take(Play *play);

/* Look at the hand during a picture, so that held inputs act sooner. The second function is called between
   the passes of a picture (gl_timer_between, with a Play), and looks only while mouse or keys hold the box, a
   finger or a solid. */
void events_follow_hand(Play *play);
void events_between_passes(void *of_play);

/* During a long operation between two pictures: handles motions of the box and the finger. */
void events_take_moves(Play *play);

/* hands.c: applies the hand's input, between two pictures or during a picture; needs a state. */
void hands_look(Play *play);

/* hands.c: the mouse's ray into a panel, and the camera's direction. */
void hands_ray(const Play *play, const Look *look, SightRay *ray, double forward[3]);

/* hands.c: hands_put puts a solid at the mouse, of the given shape (SolidCommand.like; SOLID_LIKE: like the
   solid under the mouse); hands_take removes the solid there. */
void hands_put(Play *play, int like);
void hands_take(Play *play);

/* hands.c: sets gravity, in the world's frame, m/s2; or tilts by radians to the right and away in the
   picture. */
void hands_set_gravity(Play *play, const double gravity[3]);
void hands_tilt_gravity(Play *play, const double amount[2]);

/* act.c: executes all waiting requests in order. */
void act_all(Play *play);

/* Opens a scene; on failure the old scene stays. */
bool act_open(Play *play, const char *scene, const SceneSettings *settings, Error *error);

/* Call after app/play/again.h: `begun`: the scene was restarted; `views`: its views changed. */
void act_follow_again(Play *play, bool begun, bool views);

/* reload.c: once per loop, between two pictures: rereads a saved file and applies its changes at once. */
void reload_look(Play *play);

/* draw.c: draws the newest state on the screen. While time is paused the overlay may be redrawn over the old
   fluid, as a software driver draws fluid slowly and the mouse moves often. draw_needs_fluid: true if a new
   picture of the fluid is due. */
void draw_picture(Play *play);
bool draw_needs_fluid(const Play *play);

#endif
