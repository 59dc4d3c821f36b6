/* What a signal that ends the program has to remove: the temporary files and folders of outputs in the
   making. Only output and output_folder add to them. */
#ifndef SLOSH_OUTPUT_PENDING_H
#define SLOSH_OUTPUT_PENDING_H

enum { OUTPUT_TEMP_SIZE = 1056 }; /* of the name of one of them */

void output_pending_add(const char *temp);

/* It has got its name, or is gone. */
void output_pending_forget(const char *temp);

/* A folder and the files in it, but not what lies in folders of it. May be called from a signal handler. */
void output_remove_folder(const char *path);

/* Removes the temporary files and folders of all outputs in the making. May be called from a signal handler.
 */
void output_discard_all(void);

#endif
