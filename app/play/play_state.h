/* Inside the live window: what its files share. */
#ifndef SLOSH_PLAY_STATE_H
#define SLOSH_PLAY_STATE_H

#include "app/hand/orbit.h"
#include "app/hand/play_commands.h"
#include "app/held/hand_post.h"
#include "app/output/video.h"
#include "app/panel/panel.h"
#include "app/play/play.h"
#include "app/play/play_meter.h"
#include "app/play/play_scene.h"
#include "app/window/shake.h"
#include "app/window/window.h"
#include "render/frame/text.h"
#include "render/renderer.h"
#include "render/ui/ui.h"
#include "sim/gl/timer.h"

enum { PLAY_KEYS = 512, PLAY_NOTICE_SIZE = 320 };

/* What the mouse, the keys and the gamepad are doing. */
typedef struct PlayInput {
    double mouse[2];  /* pixels */
    PlayCommand drag; /* PLAY_ORBIT, ..., or PLAY_NONE */
    int drag_button;
    bool down[PLAY_KEYS]; /* keys, by their number */
    unsigned pad_buttons; /* at the last look */
    double move_drag[2];  /* since the hand's last update: pixels to the right and up */
    double turn_drag[2];
    double hand_event_ms; /* the first event since then that concerns the box; 0: none */
} PlayInput;

typedef struct PlayUi {
    Ui *ui;
    Panel *panel;
    UiInput input;
    bool buttons_down[3];
    unsigned keys_down;
    double drawn_ms; /* wall time of the last drawing */
    int shown;       /* what was drawn then */
    bool watches;    /* with the gauges */
    const char *warnings[8 + NOTES_MAX];
    int warning_count;
    char lost[64]; /* one of them */
    HandDevice devices[HAND_POST_DEVICES_MAX];
    int device_count;
} PlayUi;

typedef struct PlayMovie {
    Video *video; /* NULL: none */
    char path[1024];
    int width, height;
    double next_ms; /* when the next picture is due */
    size_t pictures;
} PlayMovie;

typedef struct Play {
    const PlaySetup *setup;
    Window *window;
    Renderer *renderer;
    GlTimer *timer; /* NULL on a software renderer, where nothing can be measured without waiting */
    StageTimes gl_times;
    Text *text;
    PlayUi ui;
    PlayScene open;
    PlayScene left;            /* the one before, whose solver has not ended yet; or zero */
    Scene file_scene;          /* as its file has it */
    ParticleBuffers particles; /* what is drawn */
    bool has_particles;
    SimulatorStatus status;
    PlayInput input;
    HandPost *post;
    Devices *devices; /* NULL: left alone */
    Orbit orbit;
    bool orbiting; /* the camera is in the hand */
    PlayMeter meter;
    PlayMovie movie;
    int width, height; /* of the framebuffer */
    double refresh;    /* pictures a second that the display shows */
    double speed;
    bool paused, panel, help, quit;
    bool shoot;     /* the next picture is to be saved */
    bool dirty;     /* a picture is due though no new state is there */
    bool stuck;     /* the solver did not end in time: nothing may be freed */
    unsigned saves; /* of sessions, that were told */
    unsigned messages;
    char notice[PLAY_NOTICE_SIZE];
    double notice_until_ms;
    double drew_ms;  /* wall time at which the last picture was begun */
    double began_ms; /* wall time of the first picture; 0: none yet */
    double began_cpu_ms;
    double simulated_s;         /* of the scenes before, less what was simulated before the first picture */
    double render_ms, panel_ms; /* sums over all pictures */
    double last_render_ms;
    size_t rendered, panels;
    uint64_t reports_shown; /* of motion devices, when their bars were last drawn anew */
    double bars_ms;         /* wall time of that */
    WindowShake script;
    uint64_t shaders_stamp; /* of the files of --shaders when they were read */
    double shaders_due_ms;  /* wall time of the next look at them */
    size_t scenes_opened;
} Play;

/* Shows a line in the picture for some seconds and says it on standard error. */
void play_tell(Play *play, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same for what is wrong, which --quiet does not silence. */
void play_error(Play *play, const char *message);

/* play.c */
void play_listen(Play *play); /* asks the solver how it stands, and shows what it has to say */
void play_view_changed(Play *play);
/* "path=value" of a live key: for the picture now, for the solver from its next step on. */
void play_set(Play *play, const char *setting);

/* play_open.c */
bool play_open(Play *play, const char *scene, const SceneSettings *settings, Error *error);
bool play_leave(Play *play, double patience_ms); /* whether the scene that was open before has ended */
void play_reset(Play *play);
/* Writes the session so far, and waits for it. */
bool play_save_now(Play *play, const char *path, Error *error);

/* play_do.c: does what a row of the list of commands says. */
void play_do(Play *play, PlayCommand command);

/* play_input.c */
void play_shake(Play *play);  /* the script's events that are due */
void play_events(Play *play); /* takes what has come, sends what it means */
void play_event(Play *play, const WindowEvent *event);
void play_hand(Play *play);

/* play_draw.c: one picture on the screen; false when it could not be drawn. */
void play_draw(Play *play);

/* play_panel.c: tells the widgets of an event; whether it is theirs alone; draws them and does what they ask.
 */
void play_panel_event(Play *play, const WindowEvent *event);
bool play_panel_takes(const Play *play, const WindowEvent *event);
void play_panel_draw(Play *play);
/* How much of the width the panel takes from the box, 0 .. 1: one that leaves less than half takes nothing.
 */
double play_covered_left(const Play *play);

/* play_files.c */
void play_name_file(char path[1024], const char *extension); /* a new name with the time */
void play_screenshot(Play *play);                            /* of what was just drawn */
void play_movie_toggle(Play *play);
void play_movie_picture(Play *play);   /* takes what was drawn, when a picture is due */
bool play_movie_due(const Play *play); /* whether the video needs a picture now */
bool play_movie_end(Play *play);       /* false when it could not be written whole */
void play_save(Play *play);            /* the session, under a name of its own */

#endif
