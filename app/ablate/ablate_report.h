/* What `slosh bench --ablate` says: a table, JSON. */
#ifndef SLOSH_ABLATE_REPORT_H
#define SLOSH_ABLATE_REPORT_H

#include "app/ablate/ablate.h"

/* A line a term, and below them what the figures are of. */
void ablate_print(const Ablation *ablation, FILE *file);

/* An array: of each scene the whole one, then a row a term; what is not known is null. False with the reason
   when the file can't be written. */
bool ablate_write_json(const Ablation *ablations, size_t count, const char *path, Error *error);

#endif
