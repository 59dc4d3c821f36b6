/* Seal: a hash in the head of a written scene tells if the file was changed since. */
#ifndef SLOSH_FIT_SEAL_H
#define SLOSH_FIT_SEAL_H

#include <stdbool.h>
#include <stddef.h>

/* Joins the head (comments, with the final line end), the line of the hash, and the body. The caller frees
   the text. Returns NULL if memory is short. */
char *fit_seal(const char *head, const char *body);

/* True if a text of `size` bytes, with a final 0, has the right hash. Cuts the text at the hash. */
bool fit_is_sealed(char *text, size_t size);

#endif
