/* The window's picture: the fluid in its views, text above, and the screen. A picture is drawn in steps, with
   looks at the hand in between (app/play/play.c). */
#ifndef SLOSH_PLAY_PICTURE_H
#define SLOSH_PLAY_PICTURE_H

#include "app/play/notice.h"
#include "app/play/scene.h"
#include "app/window/window.h"
#include "render/frame/text.h"
#include "render/panels.h"
#include "sim/gl/timer.h"

/* Zero-initialise before use. */
typedef struct Picture {
    Panels *panels;  /* one per shown view */
    int chosen;      /* panel of the chosen view */
    GlTimer *timer;  /* NULL on a software renderer, where measuring would wait: */
    GlTimer *pauses; /* there a disabled timer, for its calls between the passes of a long picture */
    StageTimes gl_times;
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
} Picture;

/* picture_meet: reads the display's properties; picture_start: with a scene, makes all objects for
   drawing. */
void picture_meet(Picture *picture, const Window *window);
bool picture_start(Picture *picture, const PlayScene *open, float letters, Error *error);
void picture_end(Picture *picture);

/* Text height in the window, pixels. */
float picture_letters(const Window *window);

/* Place of a panel, if `covered_left` of the width, 0 .. 1, is covered on the left; and the panel at a
   position, or the nearest panel. Pixels. */
PanelPlace picture_place(const Picture *picture, int panel, double covered_left);
int picture_panel_at(const Picture *picture, double x, double y);

/* Call between two pictures: set_view after a change of the view or of the chosen panel; follow_size and
   follow_scale for the window's size and the display's scale. If new letters fail the old letters stay. */
void picture_set_view(Picture *picture, const PlayScene *open, int chosen, Notice *notice);
bool picture_follow_size(Picture *picture, const Window *window, Error *error);
bool picture_follow_scale(Picture *picture, float letters); /* returns true if changed */

/* True if the files of --shaders have changed since the last call. picture_reload: reads the files again;
   returns false, with a message, if a file is wrong: the last good shaders stay. */
bool picture_shaders_changed(Picture *picture);
bool picture_reload(Picture *picture, const PlayScene *open, Error *error);

bool picture_visible(const Picture *picture);

/* True if no new picture is due, except a finer one, and the last picture shows its own numbers. */
bool picture_rests(const Picture *picture);

/* True if the last picture is old enough but shows numbers of the picture before: renderer_behind. */
bool picture_unsettled(const Picture *picture);

/* Steps of a picture. draw: the fluid, with a state and a title per panel; `covered_left` of the width is
   covered, 0 .. 1. present: copies the fluid to the screen's picture. clear: shows the scene's background
   while there is no state. */
void picture_draw(Picture *picture, const ParticleBuffers *const states[], const Title titles[],
                  double covered_left);
void picture_present(Picture *picture);
void picture_clear(const Picture *picture, const ViewDef *view);

/* Writes one line, or up to four in a narrow picture; NULL: none. */
void picture_words(const Picture *picture, const char *words, float below);

/* close: ends drawing. done: true if the GPU has finished; waits up to 2 ms, so call until true. */
void picture_close(Picture *picture);
bool picture_done(Picture *picture);

#endif
