/* Requests to the window: from keys, mouse and wheel, dropped files, the panel and motion devices. Requests
   wait in a queue and are executed in order between two pictures, so that no data of a picture changes during
   its drawing. */
#ifndef SLOSH_PLAY_ASK_H
#define SLOSH_PLAY_ASK_H

#include "app/input/play_commands.h"
#include "render/frame/view.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum AskKind {
    ASK_COMMAND,   /* command, held */
    ASK_SETTING,   /* text: "path=value" of a live key */
    ASK_OPEN,      /* text: the file of a scene */
    ASK_AGAIN,     /* text: "path=value", for a restart of the scene */
    ASK_PARTICLES, /* amount: approximate count, for a restart of the scene */
    ASK_TUNE,      /* device, amount: gain and dead zone */
    ASK_LET_GO,    /* the box stops: the device or mouse that moved the box is gone */
    ASK_TIME,      /* amount: simulated time to show and stay at, s */
    ASK_CHOOSE,    /* amount: position in the picture, pixels: chooses the view at that position */
    ASK_GRAB,      /* takes the camera into the hand, unmoved */
    ASK_TURN,      /* amount: radians to the right and up, for a held camera */
    ASK_PAN,       /* amount: picture heights to the right and up */
    ASK_ZOOM,      /* amount: steps nearer; grabs the camera first */
    ASK_STEER,     /* amount: radians to the right and up, steps nearer; grabs the camera first */
    ASK_GRAVITY,   /* amount: radians of tilt to the right, and away */
    ASK_TOUCH,     /* amount: notches of size, notches of strength */
    ASK_SIZE,      /* amount: size of the box, m */
    ASK_SHUT,      /* gates: emitters and drains to close */
    ASK_CLOSE      /* closes the window */
} AskKind;

typedef struct Ask {
    AskKind kind;
    PlayCommand command;
    bool held;  /* repeated by a held key */
    int device; /* the device's number */
    uint64_t gates;
    double amount[3]; /* unused values are 0 */
    char text[1024];
} Ask;

enum { ASKS_MAX = 64 };

/* Zero-initialise before use. */
typedef struct AskQueue {
    int first, count;
    int lost;           /* count for ask_lost */
    Ask asks[ASKS_MAX]; /* a ring */
} AskQueue;

/* Adds a copy. Consecutive turns, pans and zooms of the camera add up. A full queue drops the request and
   counts the loss. */
void ask_add(AskQueue *queue, const Ask *ask);
void ask_command(AskQueue *queue, PlayCommand command);
void ask_settings(AskQueue *queue, const ViewSetting *settings, int count);

/* The count of dropped requests since the last call. */
int ask_lost(AskQueue *queue);

/* Takes the oldest request; false if there is none. */
bool ask_next(AskQueue *queue, Ask *ask);

#endif
