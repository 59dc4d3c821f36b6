/* Polls files for changes by an editor. Compares time, size and inode number, so that renaming a new file
   over the old one counts too. */
#ifndef APP_WINDOW_PLAY_PRIVATE_H
#define APP_WINDOW_PLAY_PRIVATE_H

#include "app/window/window.h"

#include "app/files/pictures.h"
#include "app/input/input.h"
#include "app/scene/scene.h"
#include "app/window/model.h"
#include "app/window/panel/panel.h"
#include "app/window/play.h"
#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "render/ui/text.h"
#include "sim/gpu/gl.h"

#include <stdbool.h>
#include <stdint.h>

enum { FILE_WATCH_MAX = 32, FILE_WATCH_PATH_SIZE = 1200 };

typedef struct FileStamp {
    int64_t seconds, nanoseconds, size;
    uint64_t inode;
    bool there;
} FileStamp;

/* Zero-initialise before use. */
typedef struct FileWatch {
    int count;
    struct {
        char path[FILE_WATCH_PATH_SIZE];
        FileStamp mark;
    } files[FILE_WATCH_MAX];
    double looked_ms, changed_ms; /* wall time */
    bool pending;                 /* changing now, or a moment ago */
    bool others;                  /* the pending or last reported change includes more than the first file */
} FileWatch;

/* Several views of the window, each in a panel of its own. The scene's `view` is the chosen view, for camera,
   keys and settings. `views` has all shown views including the chosen one, and view_count is 0 while only one
   view is shown. */

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

/* The window's camera: as in the scene, or in the user's hand (app/input/input.h). Changes the view of the
   open scene; callers must notify the picture. */

/* Zero-initialise before use. */
typedef struct PlayCamera {
    bool held; /* in the user's hand */
    Orbit orbit;
} PlayCamera;

/* The area of the picture for the camera. */
typedef struct CameraSight {
    int width, height; /* pixels */
    CoveredParts covered;
} CameraSight;

/* The present camera, automatic or in the hand. */
Orbit camera_now(const PlayCamera *camera, const PlayModel *model, const CameraSight *sight);

/* The mapping of a view to the screen, for the newest state; `letters`: text height, pixels. */
void camera_to_screen(const PlayModel *model, const ViewDef *view, const CameraSight *sight, double letters,
                      Sight *out);

/* Takes the camera into the hand. */
void camera_grab(PlayCamera *camera, const PlayModel *model, const CameraSight *sight);

/* Call after the hand has moved `orbit`. */
void camera_moved(const PlayCamera *camera, PlayModel *model);

/* Restores the camera of the file. */
void camera_home(PlayCamera *camera, PlayModel *model);

/* The handles in the picture (render/frame/frame.h): the mouse finds, takes and drags handles, keys move the
   view's plane in steps. The results are live settings, like the panel's. A held handle keeps the mouse from
   the camera and the box.

   Each panel has the handles of its own view. The mouse acts in the panel below the cursor; a held handle
   belongs to the chosen view.

   When walls may be taken, walls have handles too, in views of the scene's own state: app/input/input.h.

   Handles appear only in the window, not in screenshots and videos. */

/* A panel's mapping of the newest state to the screen. */
typedef struct PanelViewport {
    int panel;
    PanelRect at;      /* in the picture */
    int width, height; /* of the picture, pixels */
    const ViewDef *view;
    const ParticleBuffers *particles;
    const WorldDef *world; /* world with movable walls; NULL: none */
    Sight sight;
} PanelViewport;

typedef struct HandleTool {
    int over;        /* handle under the mouse or held, plus 1; 0: none */
    int panel;       /* panel of the handle */
    bool taken;      /* a handle is held */
    Handle handle;   /* the held handle at the start */
    SightRay first;  /* of the mouse at the start */
    double mouse[2]; /* pixels of the whole picture */
    bool moved;      /* since the last query of settings or size */
    bool walls;      /* the box's walls have handles */
    bool wall;       /* the held handle belongs to a wall */
} HandleTool;

/* True if the box may be in the panel: also from within, or so near that no corner is seen. `centre`: the
   pixel of the box's centre, in the panel or beyond; below the panel's lower edge for a box behind the eye.
 */
bool camera_sees_box(const PanelViewport *look, double centre[2]);

/* Resets: no handle is held. */
void handle_tool_begin(HandleTool *handle_tool);

/* Updates the mouse position; call before the event's other effects. */
void handle_tool_move(HandleTool *handle_tool, const WindowEvent *event);

/* Handles an event in the panel under the mouse, or of the held handle; returns true if the event belongs to
   the handle tool alone. `free`: nothing else uses the mouse. */
bool handle_tool_event(HandleTool *handle_tool, const PanelViewport *look, const WindowEvent *event,
                       bool free);

/* Settings of the panel's view for the drag since the last call; returns their count. */
int handle_tool_settings(HandleTool *handle_tool, const PanelViewport *look,
                         ViewSetting settings[VIEW_SETTINGS_MAX]);

/* Box size for the drag of a wall since the last call, m; false: no drag. */
bool handle_tool_box_size(HandleTool *handle_tool, const PanelViewport *look, double size[3]);

/* Settings for a key step in the chosen view; returns 0, with a message, if the view has no plane. */
int handle_tool_step(const PlayModel *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX]);

/* Draws a ring like a handle's, in a colour of its own. */
void handle_tool_draw_ring(const PanelViewport *look, const Handle *ring, Text *text, uint32_t rgba);

void handle_tool_draw(const HandleTool *handle_tool, const PanelViewport *look, Text *text);

/* Readout of the picture: value, unit and place under the mouse and at pinned places. Only for views with
   `probe` and `probing` (ViewKind, render/frame/view.h). The panel under the mouse shows the value there,
   and each panel its values at the pins. The readout appears only in the window, not in screenshots and
   videos. */

enum { READOUT_PINS_MAX = VIEW_PROBES_MAX - 1 };

typedef struct Readout {
    double mouse[2];                    /* pixels of the whole picture */
    bool free;                          /* the mouse is over the picture and free */
    bool shown;                         /* the last picture has a value under the mouse */
    int pinning;                        /* count of places waiting to be pinned: */
    double pinned[READOUT_PINS_MAX][2]; /* pixels of the whole picture */
    double pins[READOUT_PINS_MAX][3];   /* m, box's frame */
    int pin_count;
    ViewProbeAnswers found; /* of the last picture, in the mouse's panel: pins, then the mouse */
} Readout;

/* Removes all pins. */
void readout_begin(Readout *readout);

/* Handles an event; returns true if a picture is due. `free`: nothing else uses the mouse. */
bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free);

/* Pins the place under the mouse at the next picture that knows it, or reports why not. */
void readout_pin(Readout *readout, const Panels *panels, Notice *notice);
void readout_unpin(Readout *readout);

/* Reads and draws the values over a picture of width x height, after the panels. Returns true if the next
   picture will know more. */
bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text, Notice *notice);

/* The window's picture: the fluid in its views, text above, and the screen. A picture is drawn in steps, with
   looks at the hand in between (app/window/play.c). */

/* Zero-initialise before use. */
typedef struct PlayPicture {
    Panels *panels;  /* one per shown view */
    Panels *best;    /* the same at best quality, for a picture at rest and for files; NULL: not made yet */
    bool best_shown; /* the last picture is of `best` */
    bool best_fails; /* the last try failed, and was reported */
    double drawn_ms; /* wall time of the end of the last picture of `panels` */
    int chosen;      /* panel of the chosen view */
    GlTimer *timer;  /* NULL on a software renderer, where measuring would wait: */
    GlTimer *pauses; /* there a disabled timer, for its calls between the passes of a long picture */
    StageTimes gl_times;
    GlCalls calls; /* of the driver in the last picture, with a GPU; else 0 */
    Text *text;
    int width, height;      /* of the framebuffer; 0 while the window is minimised */
    double refresh;         /* refresh rate of the display, pictures per second */
    bool dirty;             /* a picture is due without a new state */
    bool finer;             /* the same picture is due again, refined */
    bool over;              /* only the overlay is due */
    double begun_ms;        /* wall time of the last picture's start */
    void *asked;            /* a GLsync after all drawing commands; NULL: not set yet */
    uint64_t shaders_stamp; /* of the files of --shaders at the last reading */
    double shaders_due_ms;  /* wall time of the next check of these files */
} PlayPicture;

/* picture_read_display: reads the display's properties, and makes the letters; picture_start: with a scene,
   makes all objects for drawing. */
bool picture_read_display(PlayPicture *picture, const Window *window, Error *error);
bool picture_start(PlayPicture *picture, const PlayScene *open, Error *error);
void picture_end(PlayPicture *picture);

/* Text height in the window, pixels. */
float picture_letters(const Window *window);

/* Place of a panel, if `covered_left` of the width, 0 .. 1, is covered on the left; and the panel at a
   position, or the nearest panel. Pixels. */
PanelRect picture_place(const PlayPicture *picture, int panel, double covered_left);
int picture_panel_at(const PlayPicture *picture, double x, double y);

/* Call between two pictures: set_view after a change of the view or of the chosen panel; follow_size and
   follow_scale for the window's size and the display's scale. If new letters fail the old letters stay. */
void picture_set_view(PlayPicture *picture, const PlayScene *open, int chosen, Notice *notice);
bool picture_follow_size(PlayPicture *picture, const Window *window, Error *error);
bool picture_follow_scale(PlayPicture *picture, float letters); /* returns true if changed */

/* True if the files of --shaders have changed since the last call. picture_reload: reads the files again;
   returns false, with a message, if a file is wrong: the last good shaders stay. */
bool picture_shaders_changed(PlayPicture *picture);
bool picture_reload(PlayPicture *picture, const PlayScene *open, Error *error);

bool picture_visible(const PlayPicture *picture);

/* True if no new picture is due, except a finer one, and the last picture shows its own numbers. */
bool picture_at_rest(const PlayPicture *picture);

/* True if the last picture is old enough but shows numbers of the picture before: renderer_is_stale. */
bool picture_outdated(const PlayPicture *picture);

/* Steps of a picture. draw: the fluid, with a state and a title per panel; `covered_left` of the width is
   covered, 0 .. 1. present: copies the fluid to the screen's picture. clear: shows the scene's background
   while there is no state. */
void picture_draw(PlayPicture *picture, const ParticleBuffers *const states[], const Title titles[],
                  double covered_left);
void picture_present(PlayPicture *picture);

/* picture_draw_best: draws the same once more at best quality; present then shows that picture. It takes up
   to a second on a software driver. Returns false on failure: the picture stays as it is. picture_best_due:
   true if a picture that rests could be better. picture_panels: the panels of the last picture. */
bool picture_draw_best(PlayPicture *picture, const PlayScene *open, const ParticleBuffers *const states[],
                       const Title titles[], double covered_left, Error *error);
bool picture_best_due(const PlayPicture *picture);
const Panels *picture_panels(const PlayPicture *picture);
void picture_clear(const PlayPicture *picture, const ViewDef *view);

/* Writes words in a box of up to six lines, broken at blanks; NULL: none. The box lies `below` pixels over
   the lower edge, in the middle of the room right of `covered_left` of the width, 0 .. 1. */
void picture_draw_words(const PlayPicture *picture, const char *words, double covered_left, float below);

/* Shows words at once over the last picture, or over the view's background; for what takes long between two
   pictures. */
void picture_say(PlayPicture *picture, const ViewDef *view, const char *words, Window *window);

/* close: ends drawing. done: true if the GPU has finished; waits up to 2 ms, so call until true. */
void picture_close(PlayPicture *picture);
bool picture_done(PlayPicture *picture);

/* Writes screenshots and videos of the window, with new names in the present folder. */

/* Zero-initialise before use. */
typedef struct Capture {
    bool screenshot; /* save the next picture */
    Video *video;    /* NULL: no video */
    char path[1024];
    int width, height;
    double next_ms; /* wall time at which the video's next picture is due */
    size_t pictures;
} Capture;

/* True if the video needs a picture now. */
bool capture_due(const Capture *capture);

/* Saves the last drawn picture as screenshot and video frame, as needed. A screenshot embeds `text` (may be
   NULL). */
void capture_take(Capture *capture, const Panels *panels, int width, int height, const ImageText *text,
                  Notice *notice);

/* Starts a video of that size, or ends the present video. */
void capture_toggle_video(Capture *capture, int width, int height, Notice *notice);

/* Ends a video; returns false if the video could not be written completely. */
bool capture_end(Capture *capture, Notice *notice);

/* The overlay of the picture: the panel, the list of keys and the time line. User input goes to the request
   queue. */

typedef struct PlayOverlay {
    bool panel, help; /* shown */
    bool opener;      /* given: a button opens a closed panel, which had no room at the start */
    bool scenes;      /* the list of scenes is shown */
    SceneBrowser cards;
    bool timeline; /* always shown, even if running and without the mouse near */
    Ui *ui;
    Panel *widgets;
    WidgetInput input;
    float mouse[2];   /* position at the last event */
    unsigned held;    /* pressed mouse buttons, a bit each */
    double moved_ms;  /* wall time of the last move */
    int height;       /* of the last drawn picture */
    bool scrubs;      /* the mouse drags the time line */
    double wished;    /* to this time, s */
    double particles; /* count chosen in the panel, for the release of the mouse; 0: none */
    double time;      /* of the last drawn state, s */
    double drawn_ms;  /* wall time of the last drawing */
    int shown;        /* bits of the last drawn parts */
    bool watches;     /* gauges are watched */
    bool watches_probes;
    const char *warnings[8 + NOTES_MAX];
    int warning_count;
    char lost[64]; /* a warning of lost particles */
    BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
    int device_count;
    uint64_t reports_shown; /* reports of motion devices at the last drawing of their bars */
    double bars_ms;         /* wall time of that drawing */
} PlayOverlay;

/* Data for the overlay beside the model. */
typedef struct PlayOverlayFacts {
    int width, height; /* of the picture */
    double range[2];   /* of the picture's colours */
    double opacity_range[2], size_range[2];
    const char *renderer;
    const FrameTimes *frame_times;
    const StageTimes *gl_times; /* NULL: the stages of a picture cannot be timed */
    const char *about;          /* the head of the scene file; NULL: none */
    const GlCalls *calls;       /* of the last picture */
    bool movie;                 /* a video is being recorded */
} PlayOverlayFacts;

/* Starts the overlay; `letters`: text height, pixels. */
bool play_overlay_start(PlayOverlay *overlay, float letters, Error *error);
void play_overlay_end(PlayOverlay *overlay);                        /* also after a failed start */
void play_overlay_set_letters(PlayOverlay *overlay, float letters); /* keeps the old letters on failure */

/* play_overlay_event: passes an event to the widgets; play_overlay_takes: true if the event belongs to the
   widgets alone, while nothing is dragged. */
void play_overlay_event(PlayOverlay *overlay, const WindowEvent *event);
bool play_overlay_takes(const PlayOverlay *overlay, const PlayModel *model, const WindowEvent *event);

/* Draws the shown parts. Returns true if the next picture will still change: unhandled input, or moving
   windows. */
bool play_overlay_draw(PlayOverlay *overlay, PlayModel *model, const PlayOverlayFacts *facts,
                       RequestQueue *requests);

/* Opens or closes the list of scenes. Returns false with the reason if the list has no pictures; the list
   opens anyway. */
bool play_overlay_toggle_scenes(PlayOverlay *overlay, const PlayModel *model, Error *error);

/* Call once in a while: true if there is more to show without user input. */
bool play_overlay_poll(PlayOverlay *overlay);

/* True if any part is shown. */
bool play_overlay_shown(const PlayOverlay *overlay, const PlayModel *model);

/* Height of the time line above the lower edge, pixels; 0: hidden. */
float play_overlay_covered_below(const PlayOverlay *overlay, const PlayModel *model);

/* Part of the width taken by the panel, 0 .. 1; 0 if less than two fifths would remain. */
double play_overlay_covered_left(const PlayOverlay *overlay, int width);

/* What is said when a scene opens (welcome.c). Zero-initialise before use. */
typedef struct Welcome {
    char opening[192]; /* "opening TITLE ...", until the first picture */
    char about[2048];  /* the head of the scene file; "": a recorded run, or none */
    char words[512];   /* of the first seconds: what the scene is about, and what the hand can do */
    double until_ms;   /* wall time of the end of the words; 0: taken away */
    bool waits, stood; /* for the first picture; for welcome_changed */
} Welcome;

void welcome_begin(Welcome *welcome, const PlayScene *open); /* a scene opens */
void welcome_shown(Welcome *welcome);                        /* after a picture with a state */

/* An event of the user takes the words away; returns true if that changes the picture. */
bool welcome_event(Welcome *welcome, const WindowEvent *event);
const char *welcome_now(const Welcome *welcome); /* NULL: none */
bool welcome_changed(Welcome *welcome);          /* since the last call: then a picture is due */

/* The parts of a live window, each with its owner. Data flows one way: input -> requests -> model -> picture;
   only play.c and the files named below see all parts. */

/* A finger moved by a gamepad, or by a motion device whose axes normally move the camera. */
typedef struct GamepadFinger {
    double looked_ms;       /* wall time of the last look */
    double press, until_ms; /* of a device: pressure, and its end without further reports */
} GamepadFinger;

/* Watches the open scene's file for saves by an editor. */
typedef struct SceneWatch {
    FileWatch watch;
    size_t opened; /* PlayModel.scenes_opened at the start of the watch */
    Error broken;  /* reason for not taking the broken file, shown in the picture; "": none */
} SceneWatch;

typedef struct Play {
    Window *window;
    BoxControl *control;
    PlayInput input;
    RequestQueue requests; /* executed between two pictures */
    PlayModel model;
    PlayCamera camera;
    HandleTool handle_tool;
    TouchTool touch;
    unsigned solids; /* PlayModel.solids shown by the views */
    GamepadFinger pad;
    unsigned wall_messages; /* SimulatorStatus.messages at the taking of a wall */
    BoxTarget wanted;       /* the hand's target of the box */
    bool outlined;          /* an outline shows the target */
    bool box_unseen;        /* no corner of the box is in the chosen view's last picture */
    Readout readout;
    PlayViews views;
    PlayPicture picture;
    PlayOverlay overlay;
    Capture capture;
    SceneWatch scene_watch;
    FrameTimes frame_times;
    Notice notice;
    Welcome welcome;
    double shake_seconds; /* given: more than 0: a script shakes the box for that time, then all ends */
    WindowShake shake;
    double looked_ms;      /* wall time of the last look during a picture */
    double close_asked_ms; /* wall time of the question to close without saving; 0: never asked */
    bool drawing;          /* a picture is being drawn */
    bool quit;
} Play;

/* The area of a panel for the camera. Several panels lie beside the overlay's panel, not below. */
static inline CameraSight play_sight_in(const Play *play, int panel)
{
    const double covered = play_overlay_covered_left(&play->overlay, play->picture.width);
    const PanelRect at = picture_place(&play->picture, panel, covered);
    const bool one = play->model.open.scene.view_count == 0;
    CameraSight sight = {.width = at.width, .height = at.height};
    if (play->picture.panels)
        sight.covered = panels_legend(play->picture.panels, panel);
    sight.covered.left = one ? covered : 0;
    return sight;
}

/* The area of the chosen view's panel. */
static inline CameraSight play_sight(const Play *play)
{
    return play_sight_in(play, play->picture.chosen);
}

/* A panel's mapping of the newest state to the screen; needs a state. */
static inline PanelViewport play_viewport(const Play *play, int panel)
{
    const CameraSight sight = play_sight_in(play, panel);
    const PlayPicture *picture = &play->picture;
    PanelViewport look = {
        .panel = panel,
        .at = picture_place(picture, panel, play_overlay_covered_left(&play->overlay, picture->width)),
        .width = picture->width,
        .height = picture->height,
        .view = views_def(&play->views, &play->model.open.scene, panel),
        .particles = NULL,
        .world = NULL};
    look.particles = model_state(&play->model, look.view);
    if (look.particles == &play->model.particles && play->model.open.source->simulates && picture->panels &&
        !renderer_is_flat(panels_renderer(picture->panels, panel)))
        look.world = &play->model.open.scene.world;
    camera_to_screen(&play->model, look.view, &sight, text_height(picture->text), &look.sight);
    return look;
}

/* The files that see the whole window, in the order of their calls: each calls only files before it.
   hand_input.c, requests.c, actions_hand.c, actions_view.c, actions_time.c, scene_watch.c, events.c, draw.c,
   play.c. */

/* ---- hand_input.c ---- */

/* Applies the hand's input, between two pictures or during a picture; needs a state. */
void play_apply_hand(Play *play);

/* The mouse's ray into a panel, and the camera's direction. */
void play_mouse_ray(const Play *play, const PanelViewport *look, SightRay *ray, double forward[3]);

/* play_put_solid puts a solid at the mouse, of the given shape (SolidCommand.like; SOLID_LIKE: like
   the solid under the mouse). `floats`: it has half the density of the lightest fluid, and falls; not in a
   box with open sides. play_remove_solid removes the solid there. */
void play_put_solid(Play *play, int like, bool floats);
void play_remove_solid(Play *play);

/* Sets gravity, in the world's frame, m/s2; or tilts by radians to the right and away in the
   picture. */
void play_set_gravity(Play *play, const double gravity[3]);
void play_tilt_gravity(Play *play, const double amount[2]);

/* ---- requests.c ---- */

/* Executes all waiting requests in order. */
void requests_execute(Play *play);

/* Opens a scene; on failure the old scene stays. */
bool requests_open_scene(Play *play, const char *scene, const SceneSettings *settings, Error *error);

/* Resets hand, touch, camera and picture; call after a scene was opened by the model. */
void play_follow_scene(Play *play);

/* Call after a change of the chosen view. */
void play_view_changed(Play *play);

/* Chooses the view at a position in the picture, pixels. */
void play_choose_view(Play *play, const double at[2]);

/* play_grab_camera takes the camera into the hand; play_camera_moved: call after a change of its orbit. */
void play_grab_camera(Play *play);
void play_camera_moved(Play *play);

/* Call after scene_restart or scene_reload: `begun`: the scene was restarted; `views`: its views changed. */
void requests_scene_changed(Play *play, bool begun, bool views);

/* ---- actions_hand.c, actions_view.c, actions_time.c: the actions of app/input/action_list.h ---- */

/* The mouse touches the fluid, or turns the camera again; tells the user. */
void play_turn_touch(Play *play, bool on);

/* ---- scene_watch.c ---- */

/* Once per loop, between two pictures: rereads a saved file and applies its changes at once. */
void scene_watch_poll(Play *play);

/* ---- events.c ---- */

/* Once per loop, between two pictures: handles all waiting events, each completely before the
   next. */
void events_process(Play *play);

/* Look at the hand during a picture, so that held inputs act sooner. The second function is called between
   the passes of a picture (gl_timer_between, with a Play), and looks only while mouse or keys hold the box, a
   finger or a solid. */
void events_poll_hand(Play *play);
void events_between_passes(void *of_play);

/* During a long operation between two pictures: handles motions of the box and the finger. */
void events_process_moves(Play *play);

/* ---- draw.c ---- */

/* Draws the newest state on the screen. While time is paused the overlay may be redrawn over the old
   fluid, as a software driver draws fluid slowly and the mouse moves often. draw_needs_fluid: true if a new
   picture of the fluid is due. */
void draw_picture(Play *play);
bool draw_needs_fluid(const Play *play);

/* draw_rests: true if nothing moves and the picture could be better; draw_best_picture then draws it once at
   the best quality. */
bool draw_rests(const Play *play);
void draw_best_picture(Play *play);

/* ---- play_report.c: figures of a session ---- */

void play_figures_fill(const Play *play, PlayFigures *figures);

#endif
