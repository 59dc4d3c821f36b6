/* "did you mean ...?": the known name that is nearest to a word. */
#ifndef SLOSH_SCENE_SUGGEST_H
#define SLOSH_SCENE_SUGGEST_H

typedef struct Suggestion {
    const char *word;
    const char *best; /* the nearest name offered so far; NULL while none is near enough to be meant */
    int distance;     /* of `best` */
} Suggestion;

Suggestion suggest_for(const char *word);
void suggest_offer(Suggestion *suggestion, const char *name);

/* Letters to insert, drop, replace or swap with their neighbour to make b of a. */
int edit_distance(const char *a, const char *b);

#endif
