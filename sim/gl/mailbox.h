/* A few numbers on their way from the GPU: a buffer written by passes, and a copy in mapped memory with a
   fence. A wait for the copy does not wait for later GPU commands. */
#ifndef SLOSH_MAILBOX_H
#define SLOSH_MAILBOX_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise. */
typedef struct Mailbox {
    unsigned buffer, copy; /* GL names; passes write `buffer` */
    size_t bytes;
    const void *mapped; /* the copy */
    void *fence;        /* fence of the last copy not yet waited for; NULL: none */
} Mailbox;

/* Creates a zeroed buffer of `bytes` with a label; false if memory is short. */
bool mailbox_create(Mailbox *mailbox, const char *label, size_t bytes);
void mailbox_destroy(Mailbox *mailbox); /* a zeroed struct is allowed */

/* Copies the passes' output so far; an earlier copy is lost. */
void mailbox_send(Mailbox *mailbox);

/* Waits for the last copy and returns its memory, valid until the next copy. NULL if no copy was sent since
   the last wait (`fence` is NULL), or the context is lost. */
const void *mailbox_wait(Mailbox *mailbox);

/* The same without waiting: also NULL if the copy has not arrived yet. */
const void *mailbox_look(Mailbox *mailbox);

/* Forgets a sent copy. */
void mailbox_forget(Mailbox *mailbox);

#endif
