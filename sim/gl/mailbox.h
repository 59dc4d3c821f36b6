/* A few numbers that the GPU finds out, on their way to this side: a buffer that passes write, and a copy of
   it in mapped memory behind a fence. Waiting for it waits for nothing that was asked of the GPU after the
   copy. */
#ifndef SLOSH_MAILBOX_H
#define SLOSH_MAILBOX_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise it. */
typedef struct Mailbox {
    unsigned buffer, copy; /* GL names; passes write `buffer` */
    size_t bytes;
    const void *mapped; /* the copy */
    void *fence;        /* behind the last copy that was not waited for; NULL: none */
} Mailbox;

/* A zeroed buffer of `bytes`, labelled; false when memory is short. */
bool mailbox_create(Mailbox *mailbox, const char *label, size_t bytes);
void mailbox_destroy(Mailbox *mailbox); /* a zeroed one is allowed */

/* Copies what the passes so far have written; an earlier copy is lost. */
void mailbox_send(Mailbox *mailbox);

/* The last copy, which stays until the next one; NULL when none was sent since the last wait (`fence` is NULL
   then), or the context is lost. */
const void *mailbox_wait(Mailbox *mailbox);

/* The same without waiting: NULL as long as the copy has not arrived, too. */
const void *mailbox_look(Mailbox *mailbox);

/* Forgets a copy that was sent. */
void mailbox_forget(Mailbox *mailbox);

#endif
