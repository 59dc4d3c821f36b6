/* The scenes from which the window's list lets choose, with pictures that the program makes: a second process
   draws them into the user's cache while the list is shown, so that the fluid in the window goes on. */
#ifndef SLOSH_SCENE_CARDS_H
#define SLOSH_SCENE_CARDS_H

#include "app/shelf/scene_list.h"

#include <sys/types.h>

#include <stdbool.h>

typedef struct SceneCard {
    const char *title, *text, *path;
    unsigned texture; /* its picture; 0: not there yet */
    bool lit;         /* the open one */
} SceneCard;

enum { CARD_SHELVES = 2 };

/* Scenes of one folder. */
typedef struct CardShelf {
    SceneList list;
    char folder[1024]; /* of the scenes; "": those that come with slosh */
    char cache[1024];  /* of their pictures; "": there can be none */
    bool made;         /* the other process was there, or is */
} CardShelf;

/* Zero-initialise it. */
typedef struct SceneCards {
    int count;
    SceneCard *cards; /* owned; of all shelves */
    int shelf_count;
    CardShelf shelves[CARD_SHELVES];
    pid_t maker;      /* 0: none */
    double looked_ms; /* wall time of the last look for new pictures */
} SceneCards;

/* The scenes beside the open one, and those that come with slosh. False with the reason why there are no
   pictures, or no list; cards_close in any case. Needs the context, as the next two. */
bool cards_open(SceneCards *cards, const char *scene, Error *error);

/* Whether pictures have come since the last call. */
bool cards_follow(SceneCards *cards);

void cards_close(SceneCards *cards);

#endif
