/* What stands in the window: the fluid through its view, words over it, and the screen. A picture is drawn in
   steps, so that the hand can be looked at in between (app/play/play.c). */
#ifndef SLOSH_PLAY_PICTURE_H
#define SLOSH_PLAY_PICTURE_H

#include "app/play/notice.h"
#include "app/play/scene.h"
#include "app/window/window.h"
#include "render/frame/text.h"
#include "render/panels.h"
#include "sim/gl/timer.h"

/* Zero-initialise it. */
typedef struct Picture {
    Panels *panels;  /* one for each view that is shown */
    int chosen;      /* the chosen view's */
    GlTimer *timer;  /* NULL on a software renderer, where nothing can be measured without waiting: */
    GlTimer *pauses; /* there one that is off, for what it calls between the passes of a long picture */
    StageTimes gl_times;
    Text *text;
    int width, height;      /* of the framebuffer; 0 while the window is minimised */
    double refresh;         /* pictures a second that the display shows */
    bool dirty;             /* a picture is due though no new state is there; */
    bool finer;             /* the same one is due again, with more of what makes it fine; */
    bool over;              /* of what lies over the fluid alone */
    double begun_ms;        /* wall time at which the last one was begun */
    void *asked;            /* a GLsync: behind all that the GPU was asked to draw; NULL: not asked for yet */
    uint64_t shaders_stamp; /* of the files of --shaders when they were read */
    double shaders_due_ms;  /* wall time of the next look at them */
} Picture;

/* What the display can do; then, when there is a scene, all that draws it. */
void picture_meet(Picture *picture, const Window *window);
bool picture_start(Picture *picture, const PlayScene *open, float letters, Error *error);
void picture_end(Picture *picture);

/* Height of letters in that window, pixels. */
float picture_letters(const Window *window);

/* Where a panel lies, beside what covers that part of the width, 0 .. 1, on the left; and which panel is at a
   place, or the nearest one. Pixels. */
PanelPlace picture_place(const Picture *picture, int panel, double covered_left);
int picture_panel_at(const Picture *picture, double x, double y);

/* Between two pictures. The view has changed, or the panel of the chosen one; the window's size may have, or
   the display's scale: where letters of another height cannot be had the old ones stay. */
void picture_set_view(Picture *picture, const PlayScene *open, int chosen, Notice *notice);
bool picture_follow_size(Picture *picture, const Window *window, Error *error);
bool picture_follow_scale(Picture *picture, float letters); /* whether it has changed */

/* Whether the files of --shaders have changed since the last call; reads them again. False, with a message,
   where one is wrong: the last good ones stay. */
bool picture_shaders_changed(Picture *picture);
bool picture_reload(Picture *picture, const PlayScene *open, Error *error);

bool picture_visible(const Picture *picture);

/* Nothing is to be drawn again but a finer picture of the same, and the last one has its own numbers. */
bool picture_rests(const Picture *picture);

/* The last picture has stood for a while and has numbers of the one before: renderer_behind. */
bool picture_unsettled(const Picture *picture);

/* The steps of a picture. The fluid, a state and a title for each panel, of which so much of the width is
   covered, 0 .. 1; then it goes on the screen's own picture. In its place, as long as there is no state: the
   scene's background. */
void picture_draw(Picture *picture, const ParticleBuffers *const states[], const Title titles[],
                  double covered_left);
void picture_present(Picture *picture);
void picture_clear(const Picture *picture, const ViewDef *view);

/* A line, or as many as it takes in a narrow picture, up to four; NULL: none. */
void picture_words(const Picture *picture, const char *words, float below);

/* Nothing more will be drawn. Whether the GPU has done it: waits 2 ms for that, and is asked until it is
 * true. */
void picture_close(Picture *picture);
bool picture_done(Picture *picture);

#endif
