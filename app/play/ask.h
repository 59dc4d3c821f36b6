/* What is asked of the window: by keys, mouse and wheel, by a dropped file, by the panel, by motion devices.
   It waits in a queue and is done between two pictures, in the order in which it was asked for: so nothing
   that a picture is made of is replaced while that picture is drawn. */
#ifndef SLOSH_PLAY_ASK_H
#define SLOSH_PLAY_ASK_H

#include "app/hand/play_commands.h"
#include "render/frame/view.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum AskKind {
    ASK_COMMAND,   /* command, held */
    ASK_SETTING,   /* text: "path=value" of a live key */
    ASK_OPEN,      /* text: the file of a scene */
    ASK_AGAIN,     /* text: "path=value", with which the scene begins anew */
    ASK_PARTICLES, /* amount: about so many, with which it does */
    ASK_TUNE,      /* device, amount: gain and dead zone */
    ASK_LET_GO,    /* the box stops where it is: what moved it is gone */
    ASK_TIME,      /* amount: s, simulated: to be shown, and to rest there */
    ASK_CHOOSE,  /* amount: a place in the picture, pixels: the view there becomes the one that all acts on */
    ASK_GRAB,    /* the camera goes into the hand, as it stands */
    ASK_TURN,    /* amount: radians to the right and up, of a camera in the hand */
    ASK_PAN,     /* amount: heights of the picture to the right and up */
    ASK_ZOOM,    /* amount: steps nearer; grabs it first */
    ASK_STEER,   /* amount: radians to the right and up, steps nearer; grabs it first */
    ASK_GRAVITY, /* amount: radians by which it leans to the right, and away */
    ASK_TOUCH,   /* amount: notches larger, notches stronger */
    ASK_SIZE,    /* amount: m, of the box */
    ASK_SHUT,    /* gates: of emitters and drains, those that shall be shut */
    ASK_CLOSE    /* the window */
} AskKind;

typedef struct Ask {
    AskKind kind;
    PlayCommand command;
    bool held;  /* the command comes again because its key is held down */
    int device; /* its number */
    uint64_t gates;
    double amount[3]; /* what is not said is 0 */
    char text[1024];
} Ask;

enum { ASKS_MAX = 64 };

/* Zero-initialise it. */
typedef struct AskQueue {
    int first, count;
    int lost;           /* for ask_lost */
    Ask asks[ASKS_MAX]; /* a ring */
} AskQueue;

/* Adds a copy. Turns, ways and zooms of the camera add up while nothing else comes in between. What comes to
   a full queue is left out, and counted. */
void ask_add(AskQueue *queue, const Ask *ask);
void ask_command(AskQueue *queue, PlayCommand command);
void ask_settings(AskQueue *queue, const ViewSetting *settings, int count);

/* How many have found the queue full since the last call. */
int ask_lost(AskQueue *queue);

/* Takes the oldest; false when there is none. */
bool ask_next(AskQueue *queue, Ask *ask);

#endif
