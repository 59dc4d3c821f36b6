/* Messages of the window: a line in the picture for some seconds, and on standard error. */
#ifndef SLOSH_PLAY_NOTICE_H
#define SLOSH_PLAY_NOTICE_H

#include <stdbool.h>

/* Zero-initialise before use. */
typedef struct Notice {
    bool quiet; /* only errors go to standard error */
    char words[320];
    double until_ms;   /* wall time */
    bool fresh, stood; /* for notice_changed */
} Notice;

void notice_tell(Notice *notice, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Reports an error, even with --quiet. */
void notice_error(Notice *notice, const char *message);

/* The line shown now, or NULL. */
const char *notice_now(const Notice *notice);

/* True if the line has changed since the last call: then a picture is due. */
bool notice_changed(Notice *notice);

#endif
