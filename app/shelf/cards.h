/* The scenes of the window's list, with pictures. A second process draws the pictures into the user's
   cache while the list is shown, so that the fluid in the window goes on. */
#ifndef SLOSH_SCENE_CARDS_H
#define SLOSH_SCENE_CARDS_H

#include "app/shelf/scene_list.h"

#include <sys/types.h>

#include <stdbool.h>

typedef struct SceneCard {
    const char *title, *text, *path;
    unsigned texture; /* the picture; 0: not ready */
    bool lit;         /* true for the open scene */
} SceneCard;

enum { CARD_SHELVES = 2 };

/* Scenes of one folder. */
typedef struct CardShelf {
    SceneList list;
    char folder[1024]; /* of the scenes; "": the scenes that come with slosh */
    char cache[1024];  /* folder of their pictures; "": no pictures possible */
    bool made;         /* true once the second process was started */
} CardShelf;

/* Zero-initialise before use. */
typedef struct SceneCards {
    int count;
    SceneCard *cards; /* owned; cards of all shelves */
    int shelf_count;
    CardShelf shelves[CARD_SHELVES];
    pid_t maker;      /* the second process; 0: none */
    double looked_ms; /* wall time of the last look for new pictures */
} SceneCards;

/* Lists the scenes beside the open scene, and the scenes that come with slosh. Returns false with the
   reason if there are no pictures or no list; call cards_close in any case. All three functions need a
   current GL context. */
bool cards_open(SceneCards *cards, const char *scene, Error *error);

/* Returns true if pictures have arrived since the last call. */
bool cards_follow(SceneCards *cards);

void cards_close(SceneCards *cards);

#endif
