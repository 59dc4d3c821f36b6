/* Immediate-mode widgets over a picture: the C side of the bridge to Dear ImGui for interactive windows.

   A frame is ui_begin, the windows with widgets from the top down, ui_end. Windows are opaque and drawn
   into a texture, which is copied over each picture: unchanged windows cost only the copy. Positions are
   framebuffer pixels from the left and the top; colours are sRGB with alpha, 0xRRGGBBAA; text is UTF-8 of
   Latin-1, superscripts and arrows. Needs a current OpenGL 4.5 core context. A Text may be in use at the
   same time. */
#ifndef SLOSH_UI_H
#define SLOSH_UI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "sim/base/base.h"
#include "sim/error.h"

/* The scale of a slider: converts values to positions and back, without state. */
typedef struct UiScale {
    double low, high;   /* the ends of the slider, low < high */
    bool logarithmic;   /* then low > 0 */
    bool whole;         /* whole numbers only */
    double least, most; /* limits of typed values */
    const char *unit;   /* for display, "" without a unit */
    const char *zero;   /* shown in place of 0, NULL: none */
} UiScale;

/* 0 at the low end, 1 at the high end; values beyond are clamped. */
double ui_scale_share(const UiScale *scale, double value);

/* The value at a position, with no more digits than a hand can choose. */
double ui_scale_value(const UiScale *scale, double share);

/* A typed value, clamped to the limits. */
double ui_scale_typed(const UiScale *scale, double value);

/* "0.02 s": the text shown on the slider. */
void ui_scale_text(const UiScale *scale, double value, char *text, size_t size);

typedef struct Ui Ui;

enum { /* editing keys, for text fields */
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
    char text[32];  /* typed since the last ui_begin */
    unsigned keys;  /* UI_KEY_*: down now, or pressed since the last ui_begin */
    bool changed;   /* the contents have just changed: build the windows in this frame, without delay */
} UiInput;

/* `pixels`: letter height, 13 or more. Returns NULL if no font is found or memory is short. */
Ui *ui_create(float pixels, Error *error);
void ui_destroy(Ui *ui); /* NULL is allowed */

/* Sets the letter height, after the display's scale has changed. Returns false on failure and changes
   nothing. */
bool ui_set_pixels(Ui *ui, float pixels, Error *error);
float ui_pixels(const Ui *ui);

/* Begins a frame for a picture of width x height. Returns false if the previous windows can be reused: for
   a fifth of a second without relevant input. Then call no widgets before the next ui_begin, but do call
   ui_end. */
bool ui_begin(Ui *ui, int width, int height, const UiInput *input);

/* Draws the windows over the framebuffer bound for drawing. */
void ui_end(Ui *ui);

/* True while windows have no final size and position; new windows are still invisible. Lasts some frames. */
bool ui_needs_redraw(const Ui *ui);

/* State of the last frame. ui_wants_mouse, ui_wants_keys: true if mouse or keys belong to the windows; keys
   belong to a text field, or to an open list or picker, which Escape closes.
   ui_covers: true if a window covers a position, so that a press there belongs to the window. */
bool ui_wants_mouse(const Ui *ui);
bool ui_wants_keys(const Ui *ui);
bool ui_covers(const Ui *ui, float x, float y);

/* A window as high as its contents, up to `height_most`; then with a scroll bar. All widgets must be in
   windows. */
typedef struct UiWindow {
    const char *id;
    float place[2], pivot[2]; /* the part of the window at `place`: 0, 0 is the upper left corner; 1, 1 the
                                 lower right corner */
    float width, height_most; /* pixels */
    float label_share;        /* fraction of the width for labels; the rest is for values */
} UiWindow;
void ui_window_begin(Ui *ui, const UiWindow *window);
void ui_window_end(Ui *ui);

/* The heading of a window: a click hides or shows the rest. Returns true if the rest is shown.
   `help`: as in UiField. */
bool ui_title(Ui *ui, const char *text, const char *help);
void ui_text(Ui *ui, const char *text);    /* wrapped, like ui_faint and ui_warning */
void ui_faint(Ui *ui, const char *text);   /* less important text */
void ui_warning(Ui *ui, const char *text); /* more important text */
void ui_gap(Ui *ui);                       /* half a line of space */

/* A warning in a fixed space of `lines` lines, even without text; text that does not fit ends in "...".
   `help`: as in UiField. */
void ui_notice(Ui *ui, float lines, const char *text, const char *help);

/* A heading: a click hides or shows the section. Returns true if the section is shown. */
bool ui_section(Ui *ui, const char *name, bool open_at_start);

/* A line of two columns; both wrap. */
void ui_row(Ui *ui, const char *label, const char *value);

/* Describes a widget. `id`: unique in the window. `label`: in front of the widget (in a button: inside).
   `help`: shown when the mouse rests on the widget (NULL: none). */
typedef struct UiField {
    const char *id, *label, *help;
} UiField;

/* Buttons fill lines from left to right; ui_gap ends a line. `lit`: highlighted, in effect now. Returns
   true when pressed. */
bool ui_button(Ui *ui, const UiField *field, bool lit);

/* A picture with text beside, as a button of fixed width. Cards fill lines from left to right; ui_gap ends
   a line. ui_card returns true when pressed. */
typedef struct UiCard {
    const char *id, *title, *text;
    unsigned texture; /* a GL texture with the first row at the top; 0: not available yet, an empty frame */
    float shape;      /* width of the picture divided by its height */
    float width;      /* pixels, of the whole card */
} UiCard;
bool ui_card(Ui *ui, const UiCard *card, bool lit);

/* Return true when the user has changed the value. */
bool ui_checkbox(Ui *ui, const UiField *field, bool *value);
bool ui_choice(Ui *ui, const UiField *field, int *chosen, const char *const *names); /* NULL ends the names */
bool ui_color(Ui *ui, const UiField *field, float srgb[3]);

/* One to three numbers side by side: drag along the scale, or type after Ctrl+click or a double click.
   Typed values may be scale->least to scale->most. */
bool ui_sliders(Ui *ui, const UiField *field, double *values, int count, const UiScale *scale);

/* A curve of 0 to `most`. The left button drags a point, a double click elsewhere adds a point, the right
   button removes a point. */
bool ui_curve(Ui *ui, const UiField *field, ControlPoints *points, double most);

/* Reserves an area for drawing, as wide as the window, `letters` letter heights high; `rect`: left, top,
   right, bottom. Returns false if scrolled out of view. */
bool ui_area(Ui *ui, float letters, float rect[4]);
void ui_fill(Ui *ui, float x0, float y0, float x1, float y1, uint32_t rgba);
void ui_words(Ui *ui, float x, float y, uint32_t rgba,
              const char *text); /* one line, from the upper left corner */
float ui_words_width(const Ui *ui, const char *text);
bool ui_mouse_in(const Ui *ui, const float rect[4], float *x); /* true if the mouse is inside; `x`:
                                                                  position inside */

/* A part of an area that the user can press and drag; the caller draws. `field` needs no label. `x`, `y`:
   position of the mouse as fractions of width and height; 0 .. 1 inside, also defined outside. */
typedef struct UiGrip {
    bool hovered, pressed; /* the mouse rests on the grip; the left button went down there in this frame */
    bool held;             /* the button is still down, wherever the mouse is */
    float x, y;
} UiGrip;
UiGrip ui_grip(Ui *ui, const UiField *field, const float rect[4]);

/* For tests: called for each text and widget of a frame with the id (of a text: the text), the rectangle,
   and the width that the text needs. NULL ends watching. */
typedef void UiWatcher(void *user, const char *id, const float rect[4], float needed);
void ui_watch(Ui *ui, UiWatcher *watcher, void *user);

#ifdef __cplusplus
}
#endif

#endif
