/* Immediate-mode widgets over a picture: the C side of the bridge to Dear ImGui for windows that people use.

   A frame is ui_begin, the windows with their widgets from the top down, ui_end. Windows are opaque and are
   drawn into a texture of their own; from there they are copied over each picture, so that one that has not
   changed costs a copy. Places are pixels of the framebuffer from the left and the top; colours are sRGB with
   alpha, 0xRRGGBBAA; text is UTF-8 of Latin-1, superscripts and arrows. Needs a current OpenGL 4.5 core
   context. A Text may be in use beside it. */
#ifndef SLOSH_UI_H
#define SLOSH_UI_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "render/ui/ui_scale.h"
#include "sim/base/control_points.h"
#include "sim/base/error.h"

typedef struct Ui Ui;

enum { /* editing keys, for fields that are typed into */
       UI_KEY_ENTER = 1 << 0,
       UI_KEY_ESCAPE = 1 << 1,
       UI_KEY_BACKSPACE = 1 << 2,
       UI_KEY_DELETE = 1 << 3,
       UI_KEY_LEFT = 1 << 4,
       UI_KEY_RIGHT = 1 << 5,
       UI_KEY_HOME = 1 << 6,
       UI_KEY_END = 1 << 7,
       UI_KEY_TAB = 1 << 8,
       UI_KEY_A = 1 << 9,
       UI_KEY_C = 1 << 10,
       UI_KEY_V = 1 << 11,
       UI_KEY_X = 1 << 12,
       UI_KEY_CTRL = 1 << 13,
       UI_KEY_SHIFT = 1 << 14
};

typedef struct UiInput {
    float mouse[2]; /* pixels */
    bool button[3]; /* left, right, middle: down now, or pressed since the last ui_begin */
    float wheel;    /* notches away from the user since the last ui_begin */
    double dt;      /* s since the last ui_begin */
    char text[32];  /* typed since then */
    unsigned keys;  /* UI_KEY_*: down now, or pressed since then */
    bool changed;   /* what the windows show changes at once, not only by and by: show it in this picture */
} UiInput;

/* With letters `pixels` high: 13 and more. NULL when no font is found or memory is short. */
Ui *ui_create(float pixels, Error *error);
void ui_destroy(Ui *ui); /* NULL is allowed */

/* The display's scale has changed. On failure all stays as it was. */
bool ui_set_pixels(Ui *ui, float pixels, Error *error);
float ui_pixels(const Ui *ui);

/* Begins a frame for a picture of that size. False when the windows of the frame before will do, which is so
   for a fifth of a second when no input concerns them: then no widget may be called until the next ui_begin,
   but ui_end still is. */
bool ui_begin(Ui *ui, int width, int height, const UiInput *input);

/* Draws the windows over the framebuffer that is bound for drawing. */
void ui_end(Ui *ui);

/* Whether windows do not have their size and place yet, one that is new not even a look: it takes frames. */
bool ui_unsettled(const Ui *ui);

/* As of the last frame: whether the mouse, or the keys, are the windows' own; and whether a window lies at a
   place, so that a press there is its own. */
bool ui_wants_mouse(const Ui *ui);
bool ui_wants_keys(const Ui *ui);
bool ui_covers(const Ui *ui, float x, float y);

/* A window whose height is that of its content, up to `height_most`; then it scrolls. All widgets stand in
 * one. */
typedef struct UiWindow {
    const char *id;
    float place[2],
        pivot[2]; /* where that part of it is: pivot 0, 0 its upper left corner, 1, 1 its lower right one */
    float width, height_most; /* pixels */
    float label_share;        /* of the width, for labels; the rest is for what they name */
} UiWindow;
void ui_window_begin(Ui *ui, const UiWindow *window);
void ui_window_end(Ui *ui);

/* A heading over everything: a click hides or shows what follows. True: what follows is to be shown. */
bool ui_title(Ui *ui, const char *text);
void ui_text(Ui *ui, const char *text);    /* wrapped, as the next two */
void ui_faint(Ui *ui, const char *text);   /* what matters less */
void ui_warning(Ui *ui, const char *text); /* what matters more */
void ui_gap(Ui *ui);                       /* half a line */

/* A warning in a place of so many lines, whether there is one or not: what does not fit ends in "...". `help`
   as of UiField. */
void ui_notice(Ui *ui, float lines, const char *text, const char *help);

/* A heading: a click hides or shows what follows. True: what follows is to be shown. */
bool ui_section(Ui *ui, const char *name, bool open_at_start);

/* A line of two columns; both wrap. */
void ui_row(Ui *ui, const char *label, const char *value);

/* What a widget is: `id` is its own in its window; the label stands before it (a button's: in it); `help`
   appears when the mouse rests on it (NULL: nothing). */
typedef struct UiField {
    const char *id, *label, *help;
} UiField;

/* Buttons fill a line, then the next; ui_gap ends it. `lit`: it is in force now. True when pressed. */
bool ui_button(Ui *ui, const UiField *field, bool lit);

/* A picture with words beside it, as a button of that width: cards fill a line, then the next; ui_gap ends
   it. True when pressed. */
typedef struct UiCard {
    const char *id, *title, *text;
    unsigned texture; /* a GL texture with its first row at the top; 0: none yet, an empty frame */
    float shape;      /* width of the picture over its height */
    float width;      /* pixels, of all of it */
} UiCard;
bool ui_card(Ui *ui, const UiCard *card, bool lit);

/* These return true when the user has changed the value. */
bool ui_checkbox(Ui *ui, const UiField *field, bool *value);
bool ui_choice(Ui *ui, const UiField *field, int *chosen, const char *const *names); /* NULL ends the names */
bool ui_color(Ui *ui, const UiField *field, float srgb[3]);

/* One to three numbers side by side, by dragging along the scale, or typed after Ctrl+click or a double
   click: then anything from scale->least to scale->most. */
bool ui_sliders(Ui *ui, const UiField *field, double *values, int count, const UiScale *scale);

/* A curve of 0 to `most`. The left button drags a point, a double click where there is none makes one, the
   right button takes one away. */
bool ui_curve(Ui *ui, const UiField *field, ControlPoints *points, double most);

/* Room for a drawing as wide as the window, as high as that many letters: left, top, right, bottom. False
   when it is scrolled out of view. */
bool ui_area(Ui *ui, float letters, float rect[4]);
void ui_fill(Ui *ui, float x0, float y0, float x1, float y1, uint32_t rgba);
void ui_words(Ui *ui, float x, float y, uint32_t rgba,
              const char *text); /* one line, from its upper left corner */
float ui_words_width(const Ui *ui, const char *text);
bool ui_mouse_in(const Ui *ui, const float rect[4], float *x); /* whether the mouse is there; and where */

/* A part of an area that can be pressed and dragged; what it looks like is the caller's. `field` needs no
   label. `x` and `y`: where the mouse is in it, shares of its width and height, 0 .. 1 also beyond its
   edges. */
typedef struct UiGrip {
    bool hovered, pressed; /* the mouse rests on it; its left button went down on it just now */
    bool held;             /* that button is down since then, wherever the mouse is now */
    float x, y;
} UiGrip;
UiGrip ui_grip(Ui *ui, const UiField *field, const float rect[4]);

/* For tests: is called for each text and widget of a frame with its id (a text: itself), its place, and the
   width that its text needs in that place. NULL ends it. */
typedef void UiWatcher(void *user, const char *id, const float rect[4], float needed);
void ui_watch(Ui *ui, UiWatcher *watcher, void *user);

#ifdef __cplusplus
}
#endif

#endif
