/* "did you mean ...?": finds the known name nearest to a word. */
#ifndef SLOSH_SCENE_SUGGEST_H
#define SLOSH_SCENE_SUGGEST_H

typedef struct Suggestion {
    const char *word;
    const char *best; /* the nearest offered name; NULL: none is near enough */
    int distance;     /* of `best` */
} Suggestion;

Suggestion suggest_for(const char *word);
void suggest_offer(Suggestion *suggestion, const char *name);

/* Count of letters to insert, drop, replace or swap with a neighbour to turn a into b. */
int edit_distance(const char *a, const char *b);

#endif
