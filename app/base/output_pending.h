/* Temporary files and folders of unfinished outputs, for removal by a signal that ends the program. Only
   output and output_folder add entries. */
#ifndef SLOSH_OUTPUT_PENDING_H
#define SLOSH_OUTPUT_PENDING_H

enum { OUTPUT_TEMP_SIZE = 1056 }; /* of a temporary name */

void output_pending_add(const char *temp);

/* Call after renaming or removal. */
void output_pending_forget(const char *temp);

/* Removes a folder and its files, but not its subfolders. May be called from a signal handler. */
void output_remove_folder(const char *path);

/* Removes the temporary files and folders of all unfinished outputs; returns their number. May be called from
   a signal handler. */
int output_discard_all(void);

#endif
