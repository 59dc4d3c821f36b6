/* Whether a scene that `slosh fit` wrote is still as it was written: a sum of it stands in its head. */
#ifndef SLOSH_FIT_SEAL_H
#define SLOSH_FIT_SEAL_H

#include <stdbool.h>
#include <stddef.h>

/* The head (comments, with the end of their last line), the line of the sum, the body; the caller frees it.
   NULL without memory. */
char *fit_seal(const char *head, const char *body);

/* Of a text of `size` bytes and a 0 behind them; it is cut at the sum. */
bool fit_is_sealed(char *text, size_t size);

#endif
