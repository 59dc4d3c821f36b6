/* Reports of `slosh bench --ablate`: a table, JSON. */
#ifndef SLOSH_ABLATE_REPORT_H
#define SLOSH_ABLATE_REPORT_H

#include "app/ablate/ablate.h"

/* Prints one line per term, and a legend below. */
void ablate_print(const Ablation *ablation, FILE *file);

/* Writes an array: for each scene the whole scene, then one row per term; unknown values are null. Returns
   false with the reason if the file can't be written. */
bool ablate_write_json(const Ablation *ablations, size_t count, const char *path, Error *error);

#endif
